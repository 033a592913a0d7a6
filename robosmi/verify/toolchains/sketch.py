"""A sketch on disk: its folder, its files, its project file. Nothing is written and nothing is run.

A sketch is a folder `<name>` with `<name><suffix>` in it; the suffix and everything else that depends on a platform comes from
the toolchain's data. In an output folder only what no link leads out of is read; a user's own sketch may have links to
anywhere.

The project file says for which board and with which libraries the sketch was generated. It is YAML; its name and its keys come
from the toolchain's data. The part of YAML that such files use is read: block mappings and lists, comments, quoted texts.
Anything else is refused with its line, not guessed. Lines are recorded, because errors name them; that, and one dependency
less, is why no YAML library is used.

A platform's builder may make prototypes of functions that a sketch uses above their definition; a toolchain's data say whether
it does. Such builders put them before the first function. Only functions that need one get one, on the line of the first
function, so that lines keep their numbers. Templates, methods, functions in namespaces and those with default arguments get
none, as they need none or no prototype of them would compile.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, SourceError, UsageError
from robosmi.generate.manifest import NAME as MANIFEST
from robosmi.generate.output_paths import Places
from robosmi.inputs import InputRejectedError, check_ordinary
from robosmi.verify.toolchains.boards import Board, find_board
from robosmi.verify.toolchains.toolchain_data import Toolchain, load_toolchains

_HIDDEN = re.compile(
    r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE
)
_HEAD = re.compile(r"([^()=]*+)\((?:[^()=]++|\([^()]*+\))*+\)\s*+")
"""Matches what precedes a body: type and name, and parameters without default values."""
_TYPE = re.compile(r"[\w:<>,*&\s]++", re.ASCII)
_WITHOUT = re.compile(r"\s*(?:template|typedef|using|namespace|extern)\b")


class Sketch(NamedTuple):
    """A sketch's files.

    Attributes:
        folder: its folder, as the caller named it.
        main: its main file.
        parts: further files of the same suffix, which continue the main file, by name.
        sources: files that are compiled on their own.
        project_file: what its project file says, or None if there is none.
    """

    folder: Path
    main: Path
    parts: tuple[Path, ...]
    sources: tuple[Path, ...]
    project_file: ProjectFile | None

    @property
    def well_named(self) -> bool:
        """Whether the main file bears the folder's name, as the platform's own tools demand."""
        return self.main.stem == self.folder.resolve().name

    def text(self, toolchain: Toolchain) -> str:
        """The program text that is compiled: the toolchain's prologue, then each file under its own name, with prototypes.

        Raises:
            SourceError: a file cannot be read.
        """
        line = toolchain.sketch.text("line")
        text = toolchain.sketch.text("prologue")
        for path in (self.main, *self.parts):
            try:
                content = inputs.read_text(path, inputs.OUTPUT, "utf-8-sig", "surrogateescape")
            except OSError as error:
                raise SourceError(f"the file cannot be read: {error}", location=Location(str(path))) from error
            text += line.replace("{file}", path.name) + content + ("" if content.endswith("\n") else "\n")
        return with_prototypes(text) if toolchain.sketch.flag("prototypes", False) else text


def find_sketch(path: Path, project: Path | None = None) -> tuple[Sketch, Toolchain]:
    """The sketch at a path, with its toolchain: its main file, its folder, or the folder above that (what was generated).

    Args:
        path: file or folder.
        project: the project folder, whose toolchains count, too; the current folder if None.

    Raises:
        PlatformDataError: a toolchain's data is damaged.
        SourceError: there is none, or a link leads out of the output folder that it is in.
        UsageError: there are several.
    """
    if not path.exists():
        nowhere = "the path is a broken link" if path.is_symlink() else "no such file or folder"
        raise SourceError(nowhere, location=Location(str(path)), fix="give the output folder of `robosmi migrate`, or a sketch")
    toolchains = load_toolchains(project)
    for toolchain in toolchains:
        suffix = toolchain.sketch.text("suffix")
        if path.is_file() and path.suffix == suffix:
            return _sketch(path, toolchain), toolchain
        if path.is_dir() and (main := _main(path, toolchain.sketch)):
            return _sketch(main, toolchain), toolchain
    found: list[tuple[Path, Toolchain]] = []
    if path.is_dir():
        for toolchain in toolchains:
            suffix = toolchain.sketch.text("suffix")
            mains = (sub / f"{sub.name}{suffix}" for sub in sorted(path.iterdir()) if sub.is_dir())
            known = {main.parent for main, _ in found}  # a folder is a sketch of the first toolchain that knows it
            found += [(main, toolchain) for main in mains if main.is_file() and main.parent not in known]
    if len(found) > 1:
        names = ", ".join(main.parent.name for main, _ in found)
        raise UsageError(
            f"there are several sketches: {names}", location=Location(str(path)), fix="give the folder of one of them"
        )
    if not found:
        wanted = " or ".join(f"<name>/<name>{toolchain.sketch.text('suffix')}" for toolchain in toolchains)
        raise SourceError("no sketch found", location=Location(str(path)), fix=f"give a folder with {wanted}")
    return _sketch(found[0][0], found[0][1]), found[0][1]


def _main(folder: Path, data: DataTable) -> Path | None:
    """The main file of a sketch's folder: the one that bears its name, else the only one.

    Raises:
        UsageError: there are several, which together would be a sketch if one bore the folder's name.
    """
    suffix = data.text("suffix")
    named = folder / f"{folder.resolve().name}{suffix}"
    if named.is_file():
        return named
    found = sorted(path for path in folder.glob(f"*{suffix}") if path.is_file())
    if len(found) > 1:
        if not data.flag("parts", True):
            return None
        raise UsageError(
            f"none of the {len(found)} files *{suffix} has the folder's name",
            location=Location(str(folder)),
            fix=f"rename the main file to {named.name}, or give one file to compile",
        )
    return found[0] if found else None


def check_inside(folder: Path) -> None:
    """Make sure that a folder in an output folder, and what is in it, lies inside; any other folder may have links.

    Args:
        folder: a sketch's folder, or one beside it.

    Raises:
        SourceError: a link leads out of the output folder, or its record of the last run is a named pipe, device or socket.
    """
    as_named = Path(os.path.abspath(folder))
    for own in {as_named, as_named.resolve()}:
        record = own.parent / MANIFEST
        if os.path.lexists(record):
            try:
                check_ordinary(record)
            except InputRejectedError as error:
                message = f"the record of the last run cannot be read: {error.strerror}"
                raise SourceError(message, location=Location(str(record)), fix="replace it with an ordinary file") from None
            except OSError:  # a link that leads nowhere
                pass
            Places(own.parent).check_inside(own.name)


def check_plain(folder: Path) -> None:
    """Make sure that a sketch's folder has no precompiled header, which a compiler would load in the place of a header, unseen,
    and no named pipe, device or socket, for which it would wait.

    Args:
        folder: the sketch's folder.

    Raises:
        SourceError: there is one.
    """
    for path in sorted(folder.rglob("*")):
        if path.suffix in _PRECOMPILED:
            raise _precompiled(path)
        try:
            check_ordinary(path)
        except InputRejectedError as error:
            message = f"the sketch's folder cannot be compiled: {error.strerror}"
            raise SourceError(message, location=Location(str(path)), fix="remove it") from None
        except OSError:  # a folder, or a link that leads nowhere
            continue


_PRECOMPILED = (".gch", ".pch")


def check_not_precompiled(headers: Iterable[Path]) -> None:
    """Make sure that none of the headers that a file reads has a precompiled one beside it, wherever it lies.

    Args:
        headers: the headers.

    Raises:
        SourceError: one has.
    """
    for header in headers:
        for ending in _PRECOMPILED:
            if os.path.lexists(path := Path(f"{header}{ending}")):
                raise _precompiled(path)


def _precompiled(path: Path) -> SourceError:
    message = "a precompiled header lies here, which a compiler would load in the place of the header"
    return SourceError(message, location=Location(str(path)), fix="remove it")


def _sketch(main: Path, toolchain: Toolchain) -> Sketch:
    folder, data = main.parent, toolchain.sketch
    check_inside(folder)
    joined = data.flag("parts", True)
    parts = sorted(path for path in folder.glob(f"*{data.text('suffix')}") if path.is_file() and path != main) if joined else []
    deep = folder / data.text("recursive")
    files = [*folder.glob("*"), *(deep.rglob("*") if deep.is_dir() else ())]
    sources = sorted(path for path in files if path.suffix in toolchain.suffixes and path.is_file() and path != main)
    _check_names((main, *parts, *sources))
    name = data.text("project_file", "")
    project_file = _project_file(folder / name, data) if name and (folder / name).is_file() else None
    return Sketch(folder, main, tuple(parts), tuple(sources), project_file)


def _check_names(files: Iterable[Path]) -> None:
    """Make sure that no file has a name that a compiler takes for an option, or for the name of a file with options.

    The path before it does not help: compilers pass the name alone to the programs that they consist of.

    Raises:
        SourceError: a name begins so.
    """
    for path in files:
        if path.name.startswith(("-", "@")):
            raise SourceError(
                f"a compiler takes '{path.name}' for {'an option' if path.name[0] == '-' else 'a file with options'}",
                location=Location(str(path)), fix=f"rename the file so that it does not begin with '{path.name[0]}'",
            )  # fmt: skip


def _project_file(path: Path, data: DataTable) -> ProjectFile:
    if "project_patterns" in data.values:
        return search_project_file(path, data.table("project_patterns").pattern("board"))
    keys = data.table("project_keys")
    return read_project_file(path, {key: keys.text(key) for key in PROJECT_KEYS})


def choose_board(sketch: Sketch, boards: list[Board], toolchain: Toolchain, wanted: str | None = None) -> Board:
    """The board to compile for: the one asked for, else the project file's, else the toolchain's default.

    Raises:
        UsageError: no board is called as asked for.
        SourceError: no board is called as the project file says.
        PlatformDataError: the toolchain's default is no board.
    """
    if wanted is not None:
        return find_board(wanted, boards)
    given = sketch.project_file
    if given is not None and given.board is not None:
        try:
            return find_board(given.board, boards)
        except UsageError as error:
            raise SourceError(error.message, location=Location(str(given.path), given.board_line), fix=error.fix) from error
    try:
        return find_board(toolchain.default_board, boards)
    except UsageError as error:
        place = Location(str(toolchain.path))
        raise PlatformDataError(f"'default_board': {error.message}", location=place, fix=error.fix) from error


# ---- the project file

_QUOTED = re.compile(r"\"(?:\\.|[^\"\\])*\"|'(?:''|[^'])*'")
_KEY = re.compile(rf"^(?P<key>{_QUOTED.pattern}|\w(?:[^:#]*[^:#\s])?)\s*:(?:\s++(?P<value>.*))?$")
PROJECT_KEYS = ("profiles", "default_profile", "default_board", "board", "libraries")
"""What a toolchain says of the keys of its project files."""
_FLOW = ("{", "[", "&", "*", "!", "|", ">", "%", "@", "`")


class ProjectEntry(NamedTuple):
    """A scalar of the file: the keys and list indices that lead to it, its text (may be empty) and its line (from 1)."""

    path: tuple[str | int, ...]
    value: str
    line: int


class ProjectFile(NamedTuple):
    """What a sketch's project file says.

    Attributes:
        path: the file.
        board: full name of the board of the default profile, or None.
        board_line: the line it stands in, or None.
        libraries: name -> version (empty if none is given) of the default profile.
    """

    path: Path
    board: str | None
    board_line: int | None
    libraries: dict[str, str]


def read_project_file(path: Path, keys: Mapping[str, str]) -> ProjectFile:
    """The board and libraries of the default profile, which is the one that the file names, or the only one there is.

    Args:
        path: the file.
        keys: how the file calls `profiles`, `default_profile`, `default_board` (which names the board without profiles), and in a
            profile `board` and `libraries`.

    Raises:
        SourceError: the file cannot be read, is not in the form this module knows, or its default profile does not exist.
    """
    try:
        text = inputs.read_text(path, inputs.SETTINGS, "utf-8-sig")
    except OSError as error:
        fix = inputs.fix_of(error, "check its permissions")
        raise SourceError(f"the file cannot be read: {error.strerror}", location=Location(str(path)), fix=fix) from error
    except UnicodeDecodeError as error:
        message = f"the file is not UTF-8 text ({error.reason} at byte {error.start})"
        raise SourceError(message, location=Location(str(path)), fix="save it as UTF-8") from error
    entries = parse(text, path)
    by_path = {entry.path: entry for entry in entries}
    profiles = list(
        dict.fromkeys(entry.path[1] for entry in entries if entry.path[0] == keys["profiles"] and len(entry.path) > 2)
    )
    default = by_path.get((keys["default_profile"],))
    default = default if default and default.value else None
    profile = default.value if default else profiles[0] if len(profiles) == 1 else None
    if default and default.value not in profiles:
        raise SourceError(
            f"the default profile '{default.value}' is not among the profiles",
            location=Location(str(path), default.line),
            fix=f"name one of: {', '.join(str(name) for name in profiles) or 'there is none'}",
        )
    board = by_path.get((keys["profiles"], profile, keys["board"])) if profile is not None else None
    board = board or by_path.get((keys["default_board"],))
    listed = (keys["profiles"], profile, keys["libraries"])
    libraries = [entry.value for entry in entries if entry.value and entry.path[:3] == listed]
    return ProjectFile(
        path, board.value if board else None, board.line if board else None, dict(_library(each) for each in libraries)
    )


def search_project_file(path: Path, board: re.Pattern[str]) -> ProjectFile:
    """The board that a project file of any other form names; it names no libraries.

    Args:
        path: the file.
        board: finds the line; its first group is the name.

    Raises:
        SourceError: the file cannot be read.
    """
    try:
        text = inputs.read_text(path, inputs.SETTINGS)
    except (OSError, UnicodeDecodeError) as error:
        raise SourceError(f"the file cannot be read: {error}", location=Location(str(path))) from error
    found = board.search(text)
    line = text.count("\n", 0, found.start()) + 1 if found else None
    return ProjectFile(path, found[1] if found else None, line, {})


def _library(text: str) -> tuple[str, str]:
    name, _, version = text.partition("(")
    return name.strip(), version.rstrip(") ").strip()


def parse(text: str, path: Path) -> list[ProjectEntry]:
    """The scalars of a file in block style.

    Args:
        text: the file's text.
        path: for messages.

    Raises:
        SourceError: a line is in another style of YAML, or indented against its neighbours.
    """
    entries: list[ProjectEntry] = []
    levels: list[tuple[int, tuple[str | int, ...]]] = [(-1, ())]
    counts: dict[tuple[str | int, ...], int] = {}

    def refuse(line: int, why: str) -> SourceError:
        return SourceError(
            f"{why}", location=Location(str(path), line), fix="write it as plain `key: value` lines, indented by spaces"
        )

    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.rstrip()
        body = line.lstrip(" ")
        if not body or body.startswith("#") or body in ("---", "..."):
            continue
        if "\t" in line[: len(line) - len(line.lstrip())]:
            raise refuse(number, "a tab indents the line")
        indent = len(line) - len(body)
        while body == "-" or body.startswith("- "):
            # An item may stand as far left as the key of its list, so equal indents end an item but not a key.
            while levels[-1][0] > indent or (levels[-1][0] == indent and _is_item(levels[-1][1])):
                levels.pop()
            parent = levels[-1][1]
            index = counts[parent] = counts.get(parent, -1) + 1
            levels.append((indent, (*parent, index)))
            rest = body[1:].lstrip(" ")
            indent, body = indent + len(body) - len(rest), rest
        if not body:
            continue
        found = _KEY.match(body)
        if found:
            while levels[-1][0] >= indent:
                levels.pop()
            key = (*levels[-1][1], _unquote(found["key"]))
            value = _scalar(found["value"] or "")
            if value.startswith(_FLOW):
                raise refuse(number, f"'{value[:20]}': unsupported YAML style")
            levels.append((indent, key))
            entries.append(ProjectEntry(key, _unquote(value), number))
        elif _is_item(levels[-1][1]) and not body.startswith(_FLOW):
            entries.append(ProjectEntry(levels[-1][1], _unquote(_scalar(body)), number))
        else:
            raise refuse(number, f"'{body[:40]}' is not a `key: value` line")
    parents = {entry.path[:depth] for entry in entries for depth in range(1, len(entry.path))}
    return [entry for entry in entries if entry.path not in parents]


def _is_item(path: tuple[str | int, ...]) -> bool:
    return bool(path) and isinstance(path[-1], int)


def _scalar(text: str) -> str:
    """The text without a comment at its end."""
    text = text.strip()
    if text[:1] in ('"', "'"):
        quoted = _QUOTED.match(text)
        return quoted[0] if quoted else text
    return "" if text.startswith("#") else re.split(r"\s#", text, maxsplit=1)[0].strip()


def _unquote(text: str) -> str:
    if not _QUOTED.fullmatch(text):
        return text
    if text[0] == "'":
        return text[1:-1].replace("''", "'")
    return re.sub(r"\\(?:x(..)|u(....)|U(.{8})|(.))", _unescaped, text[1:-1])


def _unescaped(found: re.Match[str]) -> str:
    number = found[1] or found[2] or found[3]
    try:
        return chr(int(number, 16)) if number else {"n": "\n", "t": "\t", "r": "\r", "0": "\0"}.get(found[4], found[4])
    except (ValueError, OverflowError):  # no number, or beyond Unicode
        return found[0]


class _Definition(NamedTuple):
    start: int
    head: str
    name: str


def with_prototypes(text: str) -> str:
    """The text of a sketch with the prototypes that it lacks."""
    plain = _HIDDEN.sub(lambda hidden: re.sub(r"[^\n]", " ", hidden[0]), text)
    found = list(_definitions(plain))
    outside = _outside(plain)
    lacking: dict[str, str] = {}
    for one in found:
        used = re.search(rf"\b{one.name}\b", plain[: one.start])
        # a type stands in front of a declared name, and `=` in front of a call that gives a variable its first value
        declared = re.search(rf"(?:\A|[;{{}}])\s*[\w:][\w:<>,*&\s]*[*&\s]{one.name}\s*\([^;{{}}]*\)\s*;", outside[: one.start])
        if used is not None and declared is None:
            lacking.setdefault(one.name, f"{' '.join(one.head.split())}; ")
    if not lacking:
        return text
    place = found[0].start
    return f"{text[:place]}{''.join(lacking.values())}{text[place:]}"


def _definitions(plain: str) -> Iterator[_Definition]:
    """The functions that are defined at file scope, in order."""
    depth = start = 0
    for mark in re.finditer(r"[{};]", plain):
        if mark[0] == "{":
            head = _head(plain[start : mark.start()]) if depth == 0 else None
            if head is not None:
                yield head._replace(start=start + head.start)
            depth += 1
        elif mark[0] == "}":
            depth = max(depth - 1, 0)
        if depth == 0:
            start = mark.end()


def _head(piece: str) -> _Definition | None:
    """The function whose body follows a piece of text, if a prototype can be made of it."""
    found = _HEAD.fullmatch(piece)
    if found is None or _WITHOUT.match(piece) is not None or "::" in found[1]:
        return None
    before = found[1].strip()
    name = re.split(r"\W+", before, flags=re.ASCII)[-1]
    kind = before.removesuffix(name).rstrip()
    if not name or name[0].isdigit() or _TYPE.fullmatch(kind) is None or kind[-1] in ":,<":
        return None
    return _Definition(len(piece) - len(piece.lstrip()), piece.strip(), name)


def _outside(plain: str) -> str:
    """The text with all that is within braces blank."""
    depth, parts = 0, []
    for piece in re.split(r"([{}])", plain):
        depth = max(depth - (piece == "}"), 0)
        parts.append(" " * len(piece) if depth else piece)
        depth += piece == "{"
    return "".join(parts)
