"""Headers of the program's own that are carried over with it."""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.transformations.queries.source_text import is_header


def file_of(include: ccode.Include) -> ccode.SourceUnit:
    """The unit that an include stands in."""
    unit = include.eContainer()
    assert isinstance(unit, ccode.SourceUnit)
    return unit


def own_header(include: ccode.Include) -> str:
    """File name of the program's own header that an include means, empty where it was not carried over."""
    wanted = str(include.header.replace("\\", "/").rpartition("/")[2])
    program = file_of(include).program
    return next(
        (wanted for u in (program.units if program is not None else ()) if is_header(u) and u.path.rpartition("/")[2] == wanted),
        "",
    )
