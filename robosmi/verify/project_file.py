"""The project file beside a sketch: which board and which libraries it was generated for.

The file is YAML; its name and its keys come from the toolchain's data. Read here is the part of YAML that such files are written
in: block mappings and lists, comments, quoted texts. Anything else is refused with its line, not guessed. Lines are kept, because
errors name them; that, and one dependency less, is why no YAML library is used.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError

_QUOTED = re.compile(r"\"(?:\\.|[^\"\\])*\"|'(?:''|[^'])*'")
_KEY = re.compile(rf"^(?P<key>{_QUOTED.pattern}|\w[^:#]*?)\s*:(?:\s+(?P<value>.*))?$")
PROJECT_KEYS = ("profiles", "default_profile", "default_board", "board", "libraries")
"""What a toolchain says of the keys of its project files."""
_FLOW = ("{", "[", "&", "*", "!", "|", ">", "%", "@", "`")


class ProjectEntry(NamedTuple):
    """A scalar of the file: the keys and list indices that lead to it, its text and its line (from 1)."""

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
        message = f"the file is no text in UTF-8 ({error.reason} at byte {error.start})"
        raise SourceError(message, location=Location(str(path)), fix="save it as UTF-8") from error
    entries = parse(text, path)
    by_path = {entry.path: entry for entry in entries}
    profiles = list(
        dict.fromkeys(entry.path[1] for entry in entries if entry.path[0] == keys["profiles"] and len(entry.path) > 2)
    )
    default = by_path.get((keys["default_profile"],))
    profile = default.value if default else profiles[0] if len(profiles) == 1 else None
    if default and default.value not in profiles:
        raise SourceError(
            f"the default profile '{default.value}' is not among the profiles",
            location=Location(str(path), default.line),
            fix=f"name one of: {', '.join(str(name) for name in profiles) or 'there is none'}",
        )
    board = by_path.get((keys["profiles"], profile, keys["board"])) if profile is not None else None
    board = board or by_path.get((keys["default_board"],))
    libraries = [e.value for e in entries if profile is not None and e.path[:3] == (keys["profiles"], profile, keys["libraries"])]
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
                raise refuse(number, f"'{value[:20]}' is a style of YAML that is not read here")
            levels.append((indent, key))
            if value:
                entries.append(ProjectEntry(key, _unquote(value), number))
        elif _is_item(levels[-1][1]) and not body.startswith(_FLOW):
            entries.append(ProjectEntry(levels[-1][1], _unquote(_scalar(body)), number))
        else:
            raise refuse(number, f"'{body[:40]}' is not a `key: value` line")
    return entries


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
