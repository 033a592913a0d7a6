"""Libraries that do not work on the target: each include is a place that names what to use, where that is known."""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.transformations.knowledge.libraries.library_ranking import (
    architecture_facts,
    libraries_by_header,
    library_index,
    unsuitable,
)
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch
from robosmi.transformations.queries.own_headers import own_header
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace

KIND = "unsuitable_library"


def foreign_libraries(sketch: MovedSketch) -> Iterator[PortabilityPlace]:
    """The includes of such libraries: those of the kind's headers, and those whose data does not list the architecture."""
    source, target = sketch.move.source.architecture, sketch.move.target.architecture
    if source == target:
        return
    headers = frozenset(sketch.kinds[KIND].headers)
    for view in sketch.views:
        platform = view.api.name
        for include in view.unit.includes:
            header = str(include.header)
            library = header.rpartition("/")[2].removesuffix(".h")
            if own_header(include):
                continue
            if header in headers:
                found = architecture_facts(platform).replacement(library, target)
                use = f"; use {found.library} there: {found.why}" if found is not None else ""
                yield sketch.place(KIND, include, f"{library} writes registers of AVR microcontrollers{use}")
            elif why := _unsuitable(library, "" if view.api.header_kind(header) else header, platform, target):
                yield sketch.place(KIND, include, why)


def _unsuitable(library: str, header: str, platform: str, target: str) -> str:
    """Why the library of a header does not work there: the one of its name, else each that has the header; empty if one does.

    Args:
        library: the name of the header without its ending.
        header: the header; empty if the platform has it.
        platform: the platform.
        target: the architecture.
    """
    if library_index(platform).library_named(library) is not None:
        return unsuitable(library, platform, target)
    offers = libraries_by_header(header, platform) if header else ()
    whys = [unsuitable(each.name, platform, target) for each in offers]
    return whys[0] if whys and all(whys) else ""
