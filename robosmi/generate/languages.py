"""Tracks the syntactic place of a template's expressions: in a comment, a string, a table cell, an attribute.

A language reads the template's own text piece by piece; the values printed between the pieces are quoted and so do not change
the state. `contexts` adds the quoting to a template; `quoting_filters` maps a place to its function of `robosmi.quoting`.

In YAML, TOML and CSV a value may be printed only as a whole value at a place where one is expected. Next to other characters of
its line it would become part of a longer value with quotation marks inside, and in a multi-line string it could end the string.
Such places are refused; in a YAML block scalar (`|`, `>`) a value is a line.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any, TypeVar

from msgspec import Struct
from msgspec.structs import replace

# ---- YAML, TOML, CSV

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


# ---- languages: C, Markdown, HTML, Graphviz

State = TypeVar("State")
NOWHERE = ""
"""The place of an expression that cannot be quoted, such as the name of a tag."""


class Language:
    """A language of templates, as a lexer over the template's own text.

    Attributes:
        start: the state at the beginning of a text.
        advance: a function from a state and a piece of text to the state after it.
        place: a function from a state to the kind of place of a value printed there, `NOWHERE` if none can be.
        whole: whether an expression is one value, which is quoted as a whole and not part by part.
        comment: the kind of place of a region's id in its markers.
    """

    def __init__(
        self,
        start: State,
        advance: Callable[[State, str], State],
        place: Callable[[State], str],
        whole: bool = False,
        comment: str = "terminal",
    ) -> None:
        self.start: Any = start
        self.advance: Callable[[Any, str], Any] = advance
        self.place: Callable[[Any], str] = place
        self.whole = whole
        self.comment = comment


_C_OPENS = re.compile(
    r'(?P<raw>\b(?:u8|[uUL])?R"[^()\\\s]{0,16}\()|'
    r'(?P<line>//)|(?P<block>/\*)|(?P<header>#[ \t]*include[ \t]*[<"])|(?P<string>")|(?P<char>\')'
)
_C_CLOSES = {
    "c_comment": re.compile(r"\n"),
    "c_block_comment": re.compile(r"\*/"),
    "c_header": re.compile(r'[>"\n]'),
    "c_string": re.compile(r'(?:\\.|[^"\\\n])*(?P<end>["\n])'),
    "c_char": re.compile(r"(?:\\.|[^'\\\n])*(?P<end>['\n])"),
}
_C_PLACES = {"line": "c_comment", "block": "c_block_comment", "header": "c_header", "string": "c_string", "char": "c_char"}
_C_RAW = "raw "
"""The prefix of a raw string's end delimiter; nothing can be quoted in a raw string."""


def _c(state: str, text: str) -> str:
    position = 0
    while True:
        if state == "c_word":
            found = _C_OPENS.search(text, position)
            if found is None:
                return state
            if found["raw"]:
                delimiter = found["raw"].partition('"')[2][:-1]
                state = f'{_C_RAW}){delimiter}"'
            else:
                state = _C_PLACES[str(found.lastgroup)]
        elif state.startswith(_C_RAW):
            end = text.find(state[len(_C_RAW) :], position)
            if end < 0:
                return state
            position = end + len(state) - len(_C_RAW)
            state = "c_word"
            continue
        else:
            closes = _C_CLOSES[state]
            found = closes.match(text, position) if "end" in closes.groupindex else closes.search(text, position)
            if found is None:
                return state
            state = "c_word"
        position = found.end()


_ITEM = re.compile(r"\s*(?:(?:[-*+]|\d{1,9}[.)])\s+|>\s?|\[[ xX]\]\s+)*")


def _markdown(state: tuple[str, bool], text: str) -> tuple[str, bool]:
    """The line so far, and whether it is in a fenced block."""
    line, fenced = state
    lines = (line + text).split("\n")
    for whole in lines[:-1]:
        fenced ^= whole.lstrip().startswith(("```", "~~~"))
    return lines[-1], fenced


def _markdown_place(state: tuple[str, bool]) -> str:
    line, fenced = state
    if fenced:
        return "markdown_code"
    if re.search(r"\]\([^)]*$", line):  # where a link leads to
        return NOWHERE
    cell = "_cell" if line.lstrip().startswith("|") else ""
    if line.count("`") % 2:
        return f"markdown_code{cell}"
    return "markdown_block" if _ITEM.fullmatch(line) else f"markdown{cell}"


_TAG = re.compile(r"<(?P<comment>!--)|<(?P<name>/?(?:[A-Za-z?!][^\s>]*|\Z))")
_IN_TAG = re.compile(r"(?P<name>[^\s=\"'>]+)\s*=\s*(?P<quote>[\"'])|(?P<end>>)")
_URLS = frozenset({"href", "src", "action", "formaction", "cite", "poster", "data", "background", "xlink:href"})
_NOT_TEXT = ("style", "srcdoc", "srcset", "imagesrcset", "ping", "http-equiv")
_NOT_TEXT_IN = {
    "meta": ("content",),
    "meta!": ("content",),
    "script": ("src", "href", "xlink:href"),
    "base": ("href",),
} | dict.fromkeys(("animate", "set", "animatetransform", "animatemotion"), ("to", "from", "by", "values", "attributename"))
"""Attributes whose value is a list of addresses, or is executed."""
_RAW = ("script", "style")
_NAMED = "+"
"""Suffix for the name of a `meta` tag that has a name, so that its content is not executed."""


def _html(state: tuple[str, str], text: str) -> tuple[str, str]:
    """The state after a piece of HTML: `text`, `tag`, `comment`, `raw` or a quotation mark, and the current tag or attribute."""
    where, name = state
    position = 0
    while True:
        if where == "text":
            found = _TAG.search(text, position)
            where, name = ("text", "") if found is None else ("comment", "") if found["comment"] else ("tag", found["name"])
        elif where == "tag":
            found = _IN_TAG.search(text, position)
            if found is not None and found["end"]:
                where, name = ("raw" if name.lower() in _RAW else "text"), name
            elif found is not None:
                where, name = found["quote"], f"{_known(name, found['name'].lower())} {found['name']}"
        else:
            end = "-->" if where == "comment" else f"</{name}" if where == "raw" else where
            found = re.compile(re.escape(end), re.IGNORECASE).search(text, position)
            if found is not None:
                where, name = ("text", "") if where == "comment" else ("tag", name.partition(" ")[0] if where != "raw" else "/")
        if found is None:
            return where, name
        position = found.end()


def _known(tag: str, attribute: str) -> str:
    """The name of a tag; for `meta` with a suffix that tells whether its content is plain text."""
    if tag.lower() == "meta" and attribute in ("name", "property", "itemprop"):
        return f"{tag}{_NAMED}"
    return tag.removesuffix(_NAMED) + "!" if attribute == "http-equiv" else tag


def _html_place(state: tuple[str, str]) -> str:
    where, name = state
    if where in ('"', "'"):
        attribute = name.rpartition(" ")[2].lower()
        tag = name.partition(" ")[0].lower()
        if attribute.startswith("on") or attribute in _NOT_TEXT or attribute in _NOT_TEXT_IN.get(tag, ()):
            return NOWHERE
        return "html_url" if attribute in _URLS or attribute.endswith(":href") else "html_attribute"
    return {"text": "html", "comment": "html_comment"}.get(where, NOWHERE)


def _dot(state: tuple[str, int], text: str) -> tuple[str, int]:
    """The state after a piece of Graphviz: `code`, `string`, `label` or `attribute`, and the nesting of `<` `>` in a label."""
    where, depth = state
    for letter in re.findall(r"\\.|[<>\"]|--|->", text):
        if letter == '"':
            where = {"code": "string", "string": "code", "label": "attribute", "attribute": "label"}[where]
        elif letter in "<>" and where in ("code", "label"):
            depth += 1 if letter == "<" else -1
            where = "label" if depth > 0 else "code"
    return where, depth


_DOT_PLACES = {"code": "c_word", "string": "dot_string", "label": "dot_label", "attribute": "html_attribute"}


def _line(state: str, text: str) -> str:
    """The line so far."""
    return (state + text).rpartition("\n")[2]


LANGUAGES = {
    "c": Language("c_word", _c, lambda state: NOWHERE if state.startswith(_C_RAW) else str(state), comment="c_block_comment"),
    "markdown": Language(("", False), _markdown, _markdown_place, comment="html_comment"),
    "html": Language(("text", ""), _html, _html_place, comment="html_comment"),
    "xml": Language(("text", ""), _html, _html_place, comment="html_comment"),
    "svg": Language(("text", ""), _html, _html_place, comment="html_comment"),
    "dot": Language(("code", 0), _dot, lambda state: _DOT_PLACES[state[0]], comment="c_block_comment"),
    "plantuml": Language("", _line, lambda _: "plantuml"),
    "toml": Language(Lines(), toml, toml_place, whole=True),
    "yaml": Language(Lines(), yaml, yaml_place, whole=True),
    "csv": Language("", _line, csv_place, whole=True),
    "terminal": Language("", _line, lambda _: "terminal"),
}
"""What a template may declare: `{% quoting "c" %}`."""
