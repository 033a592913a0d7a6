"""Finds the program's own headers, which are read, stored and carried over with it.

They are the headers, and included `.c` files, that a source file or another such header includes and that no platform provides.
They are searched like by a C compiler: beside the including file, then in the given folders. A header with the name of a
platform header is the program's own if its sources define most of the functions that the platform's header declares, as the
sources of a library do; else it is a copy of the platform's.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Sequence
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.queries.source_text import INCLUDED

OUTSIDE = "RS113"
"""The rule for a header that is taken from outside of the program's folders."""
_INCLUDE = re.compile(r'#\s*include\s*[<"]([^>"\n]+)[>"]')


def with_headers(paths: Sequence[Path], include_dirs: Sequence[Path], api: ApiIndex) -> list[Path]:
    """The files of a program, followed by its own headers that they include directly or indirectly.

    Args:
        paths: the source files.
        include_dirs: folders with headers.
        api: what is known of the source platform; its headers are not the program's.
    """
    found = list(paths)
    seen = {os.path.realpath(path) for path in paths}
    defined: set[str] | None = None
    for path in found:  # grows while it is walked
        for name in _included(path):
            if not name.lower().endswith(INCLUDED):
                continue
            place = next((p for p in (folder / name for folder in (path.parent, *include_dirs)) if p.is_file()), None)
            if place is not None and os.path.realpath(place) not in seen:
                if api.header_kind(name) is not None:
                    defined = _defined(paths) if defined is None else defined
                    if not _written(api.functions_of(name), defined):
                        continue
                seen.add(os.path.realpath(place))
                found.append(place)
    return found


def from_outside(headers: Iterable[Path], folders: Iterable[Path]) -> list[Finding]:
    """Says of each header of a program that lies outside of its folders that it is taken over: a person may not know of it.

    Args:
        headers: the headers that the program reaches.
        folders: those of its sources and project file, and those that a person names for headers.
    """
    inside = {Path(os.path.realpath(folder)) for folder in folders}
    found = [(path, Path(os.path.realpath(path))) for path in headers]
    return [
        Finding(
            OUTSIDE, Severity.warning, f"'{real}' lies outside of the program's folders and is copied with it",
            Location(str(path)), fix="name its folder with -I where it belongs to the program, else take its #include out",
        )
        for path, real in found if not inside & {*real.parents}
    ]  # fmt: skip


def _written(functions: Collection[str], defined: Collection[str]) -> bool:
    """Whether most of a header's functions are defined in the program."""
    return 2 * sum(name in defined for name in functions) > len(functions)


def _defined(paths: Sequence[Path]) -> set[str]:
    """The names of the functions that source files define: names before a parameter list and a body."""
    found: set[str] = set()
    for path in paths:
        depth, name, before = 0, "", ""
        for kind, _, _, text in tokens(_read(path)):
            if kind in ("comment", "directive"):
                continue
            if text == "(" and depth == 0:
                name = before
            elif text == "{" and depth == 0 and before == ")":
                found.add(name)
            depth += (text in "({") - (text in ")}") if kind == "punct" else 0
            before = text
    return found


def _read(path: Path) -> bytes:
    """The bytes of a file; empty if it cannot be read, which its reader reports."""
    try:
        return inputs.read_bytes(path, inputs.SOURCE)
    except OSError:
        return b""


def _included(path: Path) -> list[str]:
    """The names in a file's include directives."""
    data = _read(path)
    directives = (text for kind, _, _, text in tokens(data) if kind == "directive") if b"include" in data else ()
    return [match[1].replace("\\", "/") for directive in directives if (match := _INCLUDE.match(directive))]
