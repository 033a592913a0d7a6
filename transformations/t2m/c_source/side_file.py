"""Project files of SimpleIDE (`PROGRAM.side`): which sources a program has, and where its headers and libraries are.

A line is a file, an option (`-I FOLDER`, `-L FOLDER`) or, behind `>`, a setting (`>defs::-DNAME`, `>linker::-lNAME`). The first
file is the one of the project, which in a library is the program that tries it out. Paths are relative to the project file;
`NAME -> PLACE` is a file that lies elsewhere.
"""

from __future__ import annotations

import os
import re

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError

ENDING = ".side"
_SOURCES = (".c", ".cc", ".cpp", ".cxx")
_LIBRARY = re.compile(r"-l(\S+)")
_DEFINE = re.compile(r"-D\s*([A-Za-z_]\w*(?:=\S+)?)")


class SideProject:
    """What a project file says, with that of the libraries it is linked with.

    Attributes:
        sources: paths of its sources, the project's first.
        include_dirs: folders with headers, those that are named for headers first.
        defines: macros defined from outside.
        findings: what was left out, and why.
    """

    def __init__(self) -> None:
        self.sources: list[str] = []
        self.include_dirs: list[str] = []
        self.defines: list[str] = []
        self.findings: list[Finding] = []


def adjacent_project(source: str) -> str:
    """The project file of the same name beside a source file, empty where there is none."""
    path = os.path.splitext(source)[0] + ENDING
    return path if os.path.isfile(path) else ""


def read_side(path: str, *, sourced: bool = False) -> SideProject:
    """What a project file says.

    Args:
        path: of the file.
        sourced: whether one without sources is refused.

    Raises:
        SourceError: it cannot be read, or lists no source.
    """
    made = SideProject()
    _read(path, made, library=False, seen=set())
    if sourced and not made.sources:
        raise SourceError("the project file lists no C source", location=Location(path), fix="give the source files")
    return made


def _read(path: str, made: SideProject, *, library: bool, seen: set[str]) -> None:
    seen.add(os.path.realpath(path))
    try:
        text = inputs.read_text(path, inputs.SETTINGS)
    except (OSError, ValueError) as error:
        fix = "make it readable, or give the source files"
        cause = "it is not UTF-8" if isinstance(error, UnicodeDecodeError) else str(error)
        raise SourceError(f"the project file cannot be read: {cause}", location=Location(path), fix=fix) from error
    folder = os.path.dirname(path)
    folders: list[str] = []
    names: list[str] = []
    first = True
    for number, line in enumerate(text.splitlines(), 1):
        said = line.strip()
        if said.startswith(("-I", "-L")):
            place = os.path.normpath(os.path.join(folder, said[2:].strip().replace("\\", "/")))
            (made.include_dirs if said.startswith("-I") else folders).append(place)
        elif said.startswith(">"):
            names += _LIBRARY.findall(said)
            made.defines += _DEFINE.findall(said)
        elif said and not said.startswith("-"):
            if not (library and first):
                _file(said, folder, Location(path, number), made)
            first = False
    for place in folders:
        for name in names:
            other = os.path.join(place, f"lib{name}{ENDING}")
            if os.path.isfile(other) and os.path.realpath(other) not in seen:
                made.include_dirs.append(place)
                _read(other, made, library=True, seen=seen)
    made.include_dirs[:] = dict.fromkeys((*made.include_dirs, *folders))  # libraries often come as headers beside their archives
    made.defines[:] = dict.fromkeys(made.defines)


def _file(said: str, folder: str, place: Location, made: SideProject) -> None:
    name = said.partition("->")[2].strip() or said
    path = os.path.normpath(os.path.join(folder, name.replace("\\", "/")))
    if name.lower().endswith((".h", ".hh", ".hpp")):
        return  # found where it is included
    if not name.lower().endswith(_SOURCES):
        made.findings.append(
            Finding("RS112", Severity.warning, f"'{name}' was left out: it is not C", place, fix="migrate it by hand")
        )
    elif not os.path.isfile(path):
        message = f"'{name}' was left out: no such file"
        made.findings.append(Finding("RS112", Severity.warning, message, place, fix="add the file, or give the sources"))
    elif path not in made.sources:
        made.sources.append(path)
