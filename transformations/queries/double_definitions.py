"""RS342: what two files of a program define with external linkage, which no linker accepts, on the source platform neither."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode
from robosmi.transformations.queries.own_headers import is_member
from robosmi.transformations.queries.source_text import is_header

_ONE_OF_MANY = re.compile(rb"\b(?:inline|__inline|__inline__|weak|__weak__)\b")
"""Words of definitions that a linker accepts several of."""


def double_definitions(program: ccode.Program, copies: Mapping[str, bytes], names: Mapping[str, str]) -> Iterator[Finding]:
    """A finding RS342 for each function, and each variable with an initial value, that more than one file defines.

    Args:
        program: the program.
        copies: path of a unit -> its bytes.
        names: path of a unit -> the file as the user knows it.
    """
    found: dict[str, list[tuple[str, ccode.Declaration]]] = {}
    for unit in program.units:
        for declared in unit.declarations if not is_header(unit) else ():  # headers stand in the files that include them
            if _for_all_files(declared, copies[unit.path]):
                found.setdefault(str(declared.name), []).append((names[unit.path], declared))
    for name, (first, *others) in found.items():
        path, declared = first
        folder = os.path.dirname(path)
        elsewhere = [f"{os.path.relpath(other, folder or '.')}:{again.line}" for other, again in others if other != path]
        if elsewhere:
            message = f"'{name}' is also defined in {' and '.join(elsewhere)}: a linker accepts only one definition"
            place, advice = (
                Location(path, declared.line, declared.column),
                "give the files of one program, or remove one definition",
            )
            yield Finding("RS342", Severity.warning, message, place, fix=advice)


def _for_all_files(declared: ccode.Declaration, data: bytes) -> bool:
    if isinstance(declared, ccode.Function) and not is_member(declared):
        end = declared.body.startOffset if declared.body is not None else -1
    elif isinstance(declared, ccode.Variable):
        end = declared.initializer.startOffset if declared.initializer is not None else -1
    else:
        return False
    static = end < 0 or declared.storage.name == "staticStorage"
    return not static and _ONE_OF_MANY.search(data, data.rfind(b"\n", 0, declared.startOffset) + 1, end) is None
