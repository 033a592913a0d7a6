"""The entries of a compilation database (as Clang defines it) for the files of a sketch, for tools that read sources.

`build` compiles one text made of the sketch's files; here each file has an entry of its own, with arguments that make Clang
read it as the compiler does. The toolchain's table `[database]` adds to these. Nothing is compiled or written here.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from robosmi.verify.sketch import Sketch
from robosmi.verify.toolchain_data import Toolchain, ToolchainLanguage
from robosmi.verify.tools import Installed

_SEARCHED = re.compile(r"^#include <\.\.\.>.*\n((?: .*\n)*)", re.MULTILINE)
"""The list of system include folders in a compiler's verbose output."""


def entries(
    sketch: Sketch, toolchain: Toolchain, installed: Installed, flags: Callable[[str], Sequence[str]]
) -> Iterator[dict[str, Any]]:
    """The entries: `directory`, `file` (relative to it) and `arguments`.

    The main file and those that continue it may have an ending that no compiler knows: their language is named, and what stands
    before them in the program (the prologue's headers, the files they continue) is included.

    Args:
        sketch: the sketch.
        toolchain: of the sketch.
        installed: the toolchain on this machine.
        flags: the arguments that files of a suffix of the sketch are compiled with.
    """
    folder = sketch.folder.resolve()
    searched: dict[str, list[str]] = {}

    def entry(path: Path, suffix: str, more: Sequence[str]) -> dict[str, Any]:
        language = toolchain.language(suffix)
        if suffix not in searched:
            searched[suffix] = _system_includes(language, toolchain, installed)
        shown = os.path.relpath(path.resolve(), folder)
        first = [installed.commands[language.tool], *toolchain.database.texts("arguments", ())]
        return {
            "directory": str(folder),
            "file": shown,
            "arguments": [*first, *flags(suffix), *searched[suffix], *more, shown],
        }

    before = [part for name in re.findall("#include <(.+)>", toolchain.sketch.text("prologue")) for part in ("-include", name)]
    suffix = toolchain.languages[0].suffixes[0]
    for path in (sketch.main, *sketch.parts):
        named = [] if path.suffix in toolchain.suffixes else ["-x", toolchain.sketch.text("language")]
        yield entry(path, suffix, [*named, *before])
        before += ["-include", path.name]
    for path in sketch.sources:
        yield entry(path, path.suffix, [])


def _system_includes(language: ToolchainLanguage, toolchain: Toolchain, installed: Installed) -> list[str]:
    """The compiler's own include folders, which Clang knows only if it comes with the target's tools."""
    asked = toolchain.database.texts("tell_includes", ())
    found = _SEARCHED.search(installed.run(language.tool, asked).stderr) if asked else None
    folders = [os.path.normpath(line.strip()) for line in found[1].splitlines()] if found else []
    return [f"-isystem{folder}" for folder in folders]
