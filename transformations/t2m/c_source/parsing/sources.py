"""Which files a program is made of: files as given, a folder, or the compile commands that a build tool wrote.

A folder stands for the C and C++ sources and sketches below it; `compile_commands.json` (JSON Compilation Database of Clang)
also says with which include folders and macros each file is compiled. Nothing is read of the sources here.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable, Sequence

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError, UsageError
from robosmi.transformations.knowledge.api_data import SketchSettings
from robosmi.transformations.queries.source_text import HEADERS
from robosmi.transformations.t2m.c_source.parsing.sketch import SketchFiles, is_tab, sketch_of
from robosmi.transformations.t2m.c_source.parsing.source import is_cplusplus

ENDINGS = (".c", ".cc", ".cpp", ".cxx", ".ino", ".pde", ".C")
COMMANDS = "compile_commands.json"
MOST_FILES = 5000
_BUILD_FOLDERS = frozenset(["build", "cmake-build-debug", "node_modules", "__pycache__"])


class Compiled(Struct, frozen=True):
    """A source file with the include folders and macros that it is compiled with; those given for all files come last.

    `given` is true for a file that was named itself, false for one that was found in a folder or in compile commands. `tabs` are
    the files that are one text, for those of a sketch.
    """

    path: str
    include_dirs: tuple[str, ...]
    defines: tuple[str, ...]
    given: bool = False
    tabs: tuple[str, ...] = ()


def source_files(
    paths: Iterable[str | os.PathLike[str]],
    include_dirs: Sequence[str] = (),
    defines: Sequence[str] = (),
    sketch: SketchSettings | None = None,
) -> list[Compiled]:
    """The files of a program, each once, in the order given; those of a folder sorted, those of a sketch behind its tabs.

    Raises:
        SourceError: a folder holds no sources, or the compile commands cannot be read.
        UsageError: a file is given twice.
    """
    found: dict[str, Compiled] = {}
    for given in paths:
        path = os.fspath(given)
        if os.path.isdir(path) and os.path.isfile(os.path.join(path, COMMANDS)):
            path = os.path.join(path, COMMANDS)
        if os.path.basename(path) == COMMANDS and os.path.isfile(path):
            files = _of_commands(path, include_dirs, defines)
        elif sketch is not None and (tab := _tab(path, sketch)) is not None:
            files = _of_sketch(sketch_of(tab, sketch), path, include_dirs, defines)
        elif os.path.isdir(path):
            files = [Compiled(name, tuple(include_dirs), tuple(defines)) for name in _of_folder(path)]
        else:
            files = [Compiled(path, tuple(include_dirs), tuple(defines), True)]
        for file in files:
            key = os.path.realpath(file.path)
            if file.given and key in found and found[key].given:
                raise UsageError(f"'{file.path}' is given twice", fix="give each source file once")
            found.setdefault(key, file)
    return list(found.values())


def is_cplusplus_program(files: Sequence[Compiled]) -> bool:
    """Whether a program is a sketch, or has C++ sources and none in C, so that its headers are C++."""
    sources = [file.path for file in files if not file.path.lower().endswith(HEADERS)]
    if any(file.tabs for file in files):  # which include the headers
        return True
    return any(map(is_cplusplus, sources)) and all(map(is_cplusplus, sources))


def _tab(path: str, sketch: SketchSettings) -> str | None:
    """The tab that a path names, or the first one directly in a folder; None if there is none."""
    if not os.path.isdir(path):
        return path if is_tab(path, sketch) else None
    return next((os.path.join(path, name) for name in sorted(os.listdir(path)) if is_tab(name, sketch)), None)


def _of_sketch(sketch: SketchFiles, given: str, include_dirs: Sequence[str], defines: Sequence[str]) -> list[Compiled]:
    tabs = set(sketch.tabs)
    return [
        Compiled(path, tuple(include_dirs), tuple(defines), path == given, sketch.tabs if path in tabs else ())
        for path in sketch.files
    ]


def _of_folder(folder: str) -> list[str]:
    """The sources below a folder, without hidden folders and those of build tools; rings of links are walked once."""
    files: list[str] = []
    seen: set[str] = set()
    for place, folders, names in os.walk(folder, followlinks=True):
        real = os.path.realpath(place)
        if real in seen:
            folders.clear()
            continue
        seen.add(real)
        folders[:] = sorted(f for f in folders if not f.startswith(".") and f not in _BUILD_FOLDERS)
        files += [os.path.join(place, name) for name in sorted(names) if name.endswith(ENDINGS)]
        if len(files) > MOST_FILES:
            raise TooLargeError(
                f"this folder has more than {MOST_FILES} source files",
                location=Location(folder), fix="give the folder of one program",
            )  # fmt: skip
    if not files:
        raise SourceError(
            "this is a folder without C sources",
            location=Location(folder),
            fix=f"give a folder with sources ({', '.join(ENDINGS)}), source files, or the output folder of a migration",
        )  # fmt: skip
    return files


def _of_commands(path: str, include_dirs: Sequence[str], defines: Sequence[str]) -> list[Compiled]:
    """The files of a compilation database.

    Raises:
        SourceError: it is damaged, or names no file.
    """
    fix = "generate it again with the build tool"
    try:
        entries = json_of(inputs.read_bytes(path, inputs.TABLE))
    except (OSError, ValueError) as error:
        raise SourceError(f"the compile commands cannot be read: {error}", location=Location(path), fix=fix) from error
    files = []
    for entry in entries if isinstance(entries, list) else ():
        if not isinstance(entry, dict) or not isinstance(entry.get("file"), str):
            raise SourceError("an entry of the compile commands has no file", location=Location(path), fix=fix)
        folder = os.path.join(os.path.dirname(path), str(entry.get("directory", "")))
        words = entry.get("arguments")
        if not isinstance(words, list):
            try:
                words = shlex.split(str(entry.get("command", "")))
            except ValueError:  # a quote that is not closed
                words = str(entry.get("command", "")).split()
        own_folders, own_defines = _options([str(word) for word in words], folder)
        if entry["file"].endswith(ENDINGS):
            name = os.path.normpath(os.path.join(folder, entry["file"]))
            files.append(Compiled(name, (*own_folders, *include_dirs), (*own_defines, *defines)))
    if not files:
        raise SourceError("the compile commands list no C source", location=Location(path), fix=fix)
    return files


def _options(words: Sequence[str], folder: str) -> tuple[list[str], list[str]]:
    """Include folders and macros of a command."""
    folders: list[str] = []
    defines: list[str] = []
    for i, word in enumerate(words):
        for option, values in (("-I", folders), ("-isystem", folders), ("-iquote", folders), ("-D", defines)):
            if word.startswith(option):
                value = word[len(option) :] or (words[i + 1] if i + 1 < len(words) else "")
                if value:
                    values.append(value if values is defines else os.path.normpath(os.path.join(folder, value)))
                break
    return list(dict.fromkeys(folders)), list(dict.fromkeys(defines))
