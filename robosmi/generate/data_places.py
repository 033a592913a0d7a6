"""Where a value may be printed in YAML, TOML or CSV: only as a whole value at a place where one is expected.

A value next to other characters of its line would become part of a longer value with quotation marks inside, and one in a
multi-line string could end it. Such places are refused; in a YAML block scalar (`|`, `>`) a value is a line.
"""

from __future__ import annotations

import re

from msgspec import Struct
from msgspec.structs import replace

NOWHERE = ""
"""The place of a value that cannot be quoted; the same as in `languages`."""
_DASHES = re.compile(r"[ \t]*(?:[-?][ \t]+)*")
_BLOCK = re.compile(r"(?:^|(?:^|[\s:])[:?-][ \t]+|[\w\"')][ \t]*:[ \t]+)(?:[&!]\S+[ \t]+)*[|>](?P<more>[-+0-9]*)[ \t]*(?:#.*)?$")
_KEY = r"(?:[^\s#\"'\[{\]},&*!|>%@`-][^#\"'\[\]{},\n]*?|\"(?:[^\"\\]|\\.)*\"|'(?:[^']|'')*')"
_YAML_BEFORE = re.compile(rf"[ \t]*(?:[-?][ \t]+)*(?:{_KEY}[ \t]*:[ \t]+)?(?:[&!][^\s,\[\]{{}}]*[ \t]+)*")
_YAML_FLOW_BEFORE = re.compile(r"(?s).*(?:[\[{,][ \t]*|:[ \t]+)")
_TOML_BEFORE = re.compile(r"[ \t]*(?:\[\[?[ \t]*)?(?:[^=\"'#]*\.[ \t]*)?|.*[=\[,{][ \t]*")
_TOML_QUOTES = ('"""', "'''")
_COMMENT = re.compile(r"(?:^|\s)#")


class Lines(Struct, frozen=True):
    """The lexer's state after a piece of line-based text.

    Attributes:
        line: the current line so far, with one letter for each printed value.
        depth: the number of open brackets.
        quote: the quotation mark of an open multi-line string, "" for none.
        block: the indentation of the lines of a YAML block scalar; -1 outside of one, None before its first line.
        parent: the indentation that the lines of the block scalar must exceed.
        asked: whether the last non-empty line ends so that the next may contain a value.
    """

    line: str = ""
    depth: int = 0
    quote: str = ""
    block: int | None = -1
    parent: int = 0
    asked: bool = True


def yaml(state: Lines, text: str) -> Lines:
    """The state after a piece of YAML text."""
    *lines, last = (state.line + text).split("\n")
    for line in lines:
        state = _yaml_line(replace(state, line=""), line)
    return replace(state, line=last)


def _yaml_line(state: Lines, line: str) -> Lines:
    if not line.strip() or (line.lstrip().startswith("#") and state.block == -1 and not state.quote):
        return state
    if state.block != -1 and (found := _in_block(state, line)) is not None:
        return replace(state, block=found)
    depth, quote = _brackets(line, state.depth, state.quote, ("'", '"'))
    if not depth and not quote and (opened := _BLOCK.search(line)):
        dashes = _DASHES.match(line)
        own = dashes.end() if dashes and dashes.end() < opened.start() else len(line) - len(line.lstrip())
        digits = re.search(r"\d", opened["more"])
        return Lines(block=own + int(digits[0]) if digits else None, parent=own)
    return Lines(depth=depth, quote=quote, asked=line.rstrip().endswith((":", "-", "?", "---")))


def _in_block(state: Lines, line: str) -> int | None:
    """The indentation of the block scalar that a line belongs to, None if it belongs to none."""
    columns = len(line) - len(line.lstrip(" "))
    wanted = state.block if state.block is not None else columns if columns > state.parent else columns + 1
    return wanted if columns >= wanted else None


def yaml_place(state: Lines) -> str:
    """The kind of place of a value in YAML text."""
    line = state.line
    if state.block != -1 and _in_block(state, f"{line}x") is not None:
        return "yaml_line"
    if _COMMENT.search(line) and not state.quote:
        return "c_comment"
    depth, quote = _brackets(line, state.depth, state.quote, ("'", '"'))
    if quote:
        return NOWHERE
    if depth:
        return "yaml_flow" if _YAML_FLOW_BEFORE.fullmatch(line) or (not line.strip() and state.depth) else NOWHERE
    if not _YAML_BEFORE.fullmatch(line):
        return NOWHERE
    return "yaml" if line.strip() or state.asked else "yaml_key"


def toml(state: Lines, text: str) -> Lines:
    """The state after a piece of TOML text."""
    *lines, last = (state.line + text).split("\n")
    for line in lines:
        depth, quote = _brackets(line, state.depth, state.quote, (*_TOML_QUOTES, "'", '"'))
        state = Lines(depth=max(depth, 0), quote=quote if quote in _TOML_QUOTES else "")
    return replace(state, line=last)


def toml_place(state: Lines) -> str:
    """The kind of place of a value in TOML text."""
    line = state.line
    _, quote = _brackets(line, state.depth, state.quote, (*_TOML_QUOTES, "'", '"'))
    if quote:
        return NOWHERE
    if _COMMENT.search(line):
        return "c_comment"
    return "toml" if _TOML_BEFORE.fullmatch(line) or not line.strip() else NOWHERE


def csv_place(line: str) -> str:
    """The kind of place of a value in a CSV line."""
    return NOWHERE if line.count('"') % 2 or line[-1:] not in ("", ",", ";", "\t", "|") else "csv"


def _brackets(line: str, depth: int, quote: str, quotes: tuple[str, ...]) -> tuple[int, str]:
    """The number of open brackets and the open quotation mark after a line, given those before it."""
    place = 0
    while place < len(line):
        if quote:
            if quote[0] == '"' and line[place] == "\\":
                place += 2
            elif line.startswith(quote, place):
                place, quote = place + len(quote), ""
            else:
                place += 1
            continue
        begins = place == 0 or line[place - 1] in " \t[{,:=("
        opened = next((mark for mark in quotes if line.startswith(mark, place)), "") if begins else ""
        if opened:
            place, quote = place + len(opened), opened
            continue
        if line[place] == "#" and (place == 0 or line[place - 1].isspace()):
            break
        if line[place] in "[{" and (depth or begins):
            depth += 1
        elif line[place] in "]}" and depth:
            depth -= 1
        place += 1
    return depth, quote
