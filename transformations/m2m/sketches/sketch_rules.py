"""The rules that change the text of a program whose platform stays; each is a function in a module of its own subject."""

from __future__ import annotations

from robosmi.transformations.m2m.sketches.sketch_edits import SketchRule

RULES: tuple[SketchRule, ...] = ()
"""All rules. Where edits of two of them overlap, that of the earlier one counts."""
