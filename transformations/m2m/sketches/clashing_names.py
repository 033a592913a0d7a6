"""Renames the program's functions and variables that the C library or the core of the other board declares, too."""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.target_names import TargetNames
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.partition.renaming import RENAME, renamings
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.macros.tokens import name_tokens

_MEMBER = (b".", b">")


def clashing_names(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits: at every place of the name but behind `.` and `->`, where it is a member of something else."""
    if not sketch.facts.clashes:
        return
    names = TargetNames(None).extended(frozenset(sketch.facts.clashes), frozenset(), frozenset())
    for renaming in renamings(sketch.views, sketch.sources, names):
        for view in sketch.views:
            data = sketch.sources[str(view.unit.path)]
            places = [
                Replacement(start, end, renaming.new)
                for start, end, name in name_tokens(data)
                if name == renaming.name and not data[:start].rstrip().endswith(_MEMBER)
            ]
            own = view.unit is renaming.element.eContainer()
            if places:
                element: ccode.Located = renaming.element if own else view.unit
                yield SketchEdit(element, RENAME, f"the core of the board declares '{renaming.name}', too", tuple(places))
