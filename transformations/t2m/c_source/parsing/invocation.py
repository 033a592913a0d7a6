"""The arguments that libclang is called with, and virtual files that exist for it alone.

These are our own standard headers and the prelude, which declares what nothing else does (`prelude`). The arguments are those
of our measurements of libclang.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from functools import cache

from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.headers import INCLUDED

VIRTUAL = "/robosmi.virtual"
HEADERS = f"{VIRTUAL}/include"
PRELUDE = f"{VIRTUAL}/prelude.h"
_NAME = re.compile(rb"[A-Za-z_]\w*")
_QUIET = [
    "-ferror-limit=0", "-Wno-everything", "-Wno-implicit-function-declaration", "-Wno-int-conversion", "-Wno-implicit-int",
    "-Wno-incompatible-function-pointer-types", "-Wno-return-type", "-fno-spell-checking",
]  # fmt: skip


def arguments(api: ApiIndex, language: str, include_dirs: Sequence[str], defines: Sequence[str]) -> list[str]:
    """The parser's arguments, but for the prelude.

    Args:
        api: the source platform; it says the standard of C, the target and what the vendor's compiler defines.
        language: `C` or `C++`.
        include_dirs: folders with headers.
        defines: macros from outside, `NAME` or `NAME=VALUE`.
    """
    settings = api.settings["parser"]
    cxx = language == "C++"
    standard = "gnu++14" if cxx else settings["standard"]
    return [
        "-x", "c++" if cxx else "c", f"-std={standard}", "-nostdinc", "-target", settings["target"], *_QUIET, *predefined(api),
        *(f"-U{name}" for name in settings.get("undefined", [])),
        *(f"-D{define}" for define in (*settings.get("defines", []), *defines)),
        *(f"-I{os.path.abspath(folder)}" for folder in include_dirs), "-isystem", HEADERS,
    ]  # fmt: skip


def predefined(api: ApiIndex) -> list[str]:
    """The arguments by which the parser has the macros of the platform's own compiler in the place of its own; none without them.

    Args:
        api: the source platform.
    """
    macros = api.settings["parser"].get("predefined", [])
    return ["-undef", *(f"-D{macro}" for macro in macros)] if macros else []


def standard_headers(api: ApiIndex, text: bytes | None) -> dict[str, bytes]:
    """Our own standard headers, by the name that an include has.

    Args:
        api: the source platform, which may add its own.
        text: only those that this text can reach, since each costs time even where it is not read; None for all.
    """
    headers = api.virtual_headers()
    if text is None:
        return dict(headers)
    reached: set[str] = set()
    pending = [*included(text), "stdarg.h"]
    while pending:
        name = pending.pop()
        if name in headers and name not in reached:
            reached.add(name)
            pending += included(headers[name])
    return {name: headers[name] for name in sorted(reached)}


def included(text: bytes) -> set[str]:
    """The names of the headers that a text includes, whatever its conditions."""
    return {os.fsdecode(name) for name in INCLUDED.findall(text)}


def unsaved(headers: dict[str, bytes], others: Iterable[tuple[str, bytes]] = ()) -> list[clang.UnsavedFile]:
    """Standard headers by name, and other texts by path, as files for the parser alone."""
    return clang.unsaved({f"{HEADERS}/{name}": text for name, text in headers.items()} | dict(others))


@cache
def names_in(header: bytes) -> frozenset[str]:
    """All names in a header of our own."""
    return frozenset(name.decode() for name in _NAME.findall(header))
