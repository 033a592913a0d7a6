"""Widths of numbers: where 32 bits of the source must stay 32 bits on the target.

`widths` is the rule; `width_rules` hold one kind of place each.
Imports `partition` and `language`; the chain imports it.
"""
