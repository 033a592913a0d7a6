"""Tracks the syntactic place of a template's expressions: in a comment, a string, a table cell, an attribute.

A language reads the template's own text piece by piece; the values printed between the pieces are quoted and so do not change
the state. `contexts` adds the quoting to a template; `quoting_filters` maps a place to its function of `robosmi.quoting`.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any, TypeVar

from robosmi.generate import data_places

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
    "toml": Language(data_places.Lines(), data_places.toml, data_places.toml_place, whole=True),
    "yaml": Language(data_places.Lines(), data_places.yaml, data_places.yaml_place, whole=True),
    "csv": Language("", _line, data_places.csv_place, whole=True),
    "terminal": Language("", _line, lambda _: "terminal"),
}
"""What a template may declare: `{% quoting "c" %}`."""
