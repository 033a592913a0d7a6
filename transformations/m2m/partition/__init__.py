"""Retain, adapt, drop, hoist: what becomes of each element of the program (paper, section 3.4).

`platform_dependence` is the rule, `dispositions` decides, `text_changes` lists the edits of the text and makes them.
Imports `language`, `adapters`, `ports`; the plan and the widths import it.
"""
