"""Reads JSON with the line of every value, for files in which each fault is reported at its place.

Python's reader gives no places, keeps the last of two equal keys, and descends recursively. This one is strict RFC 8259 and keeps
a stack of its own. Numbers stay the text that the file has: which number they are is for the reader of the values to say.
"""

from __future__ import annotations

import json
import re
from typing import TypeAlias

MOST_LEVELS = 1000
"""Limit on the objects and lists around a value, that of Jackson, which reads and writes JSON for EMF."""
FEWER_LEVELS = "use fewer levels; a model may be saved as XMI, which has no such limit"

_TOKEN = re.compile(
    r"""(?P<space>[ \t\r\n]*)
    (?: (?P<mark>[\[\]{},:])
      | (?P<text>"[^"\\\x00-\x1f]*(?:\\.[^"\\\x00-\x1f]*)*")
      | (?P<number>-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)(?![0-9A-Za-z.+-])
      | (?P<word>true|false|null)(?![0-9A-Za-z_])
      | (?P<end>\Z) )""",
    re.VERBOSE,
)
_WORDS = {"true": True, "false": False, "null": None}


class JsonError(ValueError):
    """A text that is no JSON; `line` is where, `fix` what to do."""

    def __init__(self, text: str, line: int, fix: str = "correct the file") -> None:
        super().__init__(text)
        self.line = line
        self.fix = fix


class NumberText(str):
    """A number as the file has it."""

    __slots__ = ()


class LocatedObject(dict[str, "LocatedJson"]):
    """An object with its line, and those of its keys."""

    __slots__ = ("line", "lines")

    def __init__(self, line: int) -> None:
        super().__init__()
        self.line = line
        self.lines: dict[str, int] = {}


class LocatedList(list["LocatedJson"]):
    """A list with its line."""

    __slots__ = ("line",)

    def __init__(self, line: int) -> None:
        super().__init__()
        self.line = line


LocatedJson: TypeAlias = "LocatedObject | LocatedList | NumberText | str | bool | None"


def located_json(data: bytes) -> LocatedJson:
    """The value of a text in JSON.

    Raises:
        JsonError: it is no UTF-8, no JSON, is nested more than `MOST_LEVELS` deep, or an object has a key twice.
    """
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise JsonError("the text is no UTF-8", data.count(b"\n", 0, error.start) + 1) from None
    return _Reader(text).read()


class _Reader:
    """One text; `wanted` says what may come next."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.place = 0
        self.line = 1

    def next(self) -> tuple[str, str]:
        """The kind and the text of the next token."""
        found = _TOKEN.match(self.text, self.place)
        if found is None or found.lastgroup is None:
            rest = self.text[self.place :]
            start = rest.lstrip(" \t\r\n")
            line = self.line + rest.count("\n", 0, len(rest) - len(start))
            raise JsonError(f"no JSON begins with {start.split(chr(10))[0][:20]!r}", line)
        self.line += found["space"].count("\n")
        self.place = found.end()
        return found.lastgroup, found[found.lastgroup]

    def problem(self, wanted: str, kind: str, token: str) -> JsonError:
        """The error for a token that does not fit."""
        return JsonError(f"{wanted} is missing before {'the end' if kind == 'end' else repr(token[:20])}", self.line)

    def read(self) -> LocatedJson:
        """The one value of the text."""
        around: list[LocatedObject | LocatedList] = []
        whole = LocatedList(1)
        inside: LocatedObject | LocatedList = whole
        key = ""
        while True:
            kind, token = self.next()
            if token in ("}", "]") and kind == "mark" and not inside and around and (token == "}") == isinstance(inside, dict):
                inside = around.pop()  # one without anything
            else:
                if isinstance(inside, LocatedObject):
                    key = self.key(inside, kind, token)
                    kind, token = self.next()
                value = self.value(kind, token)
                if isinstance(inside, LocatedObject):
                    inside[key] = value
                else:
                    inside.append(value)
                if isinstance(value, (LocatedObject, LocatedList)):
                    around.append(inside)
                    inside = value
                    if len(around) > MOST_LEVELS:
                        raise JsonError(f"the text is nested more than {MOST_LEVELS} levels deep", self.line, FEWER_LEVELS)
                    continue
            while inside is not whole:
                kind, token = self.next()
                if kind == "mark" and token == ",":
                    break
                closing = "}" if isinstance(inside, dict) else "]"
                if kind != "mark" or token != closing:
                    raise self.problem(f"',' or '{closing}'", kind, token)
                inside = around.pop()
            else:
                kind, token = self.next()
                if kind != "end":
                    raise JsonError(f"something follows the value: {token[:20]!r}", self.line)
                return whole[0]
            if self.closes():
                raise JsonError("a ',' stands before the end of an object or a list", self.line)

    def closes(self) -> bool:
        """Whether the next token closes an object or a list."""
        found = _TOKEN.match(self.text, self.place)
        return found is not None and found["mark"] in ("}", "]")

    def key(self, inside: LocatedObject, kind: str, token: str) -> str:
        """A key that is new in its object, with the colon behind it."""
        if kind != "text":
            raise self.problem("a key in quotation marks", kind, token)
        key = self.plain(token)
        if key in inside:
            raise JsonError(f"the key '{key}' stands twice in one object, first in line {inside.lines[key]}", self.line)
        inside.lines[key] = self.line
        kind, token = self.next()
        if token != ":" or kind != "mark":
            raise self.problem("':'", kind, token)
        return key

    def value(self, kind: str, token: str) -> LocatedJson:
        """The value that begins with a token."""
        if kind == "text":
            return self.plain(token)
        if kind == "number":
            return NumberText(token)
        if kind == "word":
            return _WORDS[token]
        if kind == "mark" and token in "{[":
            return LocatedObject(self.line) if token == "{" else LocatedList(self.line)
        raise self.problem("a value", kind, token)

    def plain(self, token: str) -> str:
        """A text without its quotation marks."""
        if "\\" not in token:
            return token[1:-1]
        try:
            found: str = json.loads(token)
        except ValueError:
            raise JsonError(f"a '\\' in {token[:20]} begins no character", self.line) from None
        return found
