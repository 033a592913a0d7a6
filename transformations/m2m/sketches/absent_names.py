"""Names of the platform that the core of the other board does not declare: each use is a place."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fnmatch import translate

from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
from robosmi.transformations.queries.portability.names import foreign_names

KIND = "absent_name"


def absent_names(sketch: MovedSketch) -> Iterator[PortabilityPlace]:
    """The uses of such names; those that the program declares itself are others."""
    if not sketch.facts.absent:
        return
    absent = re.compile("|".join(map(translate, sketch.facts.absent)))
    for view in sketch.views:
        for use in foreign_names(view, sketch.sources):
            if absent.match(use.name):
                yield sketch.place_at(KIND, str(view.unit.path), use.line, use.name)
