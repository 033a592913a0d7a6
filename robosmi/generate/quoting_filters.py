"""The filters of every template, and the tag `quoting` that declares its language; what `contexts` puts in is here by its name.

A template whose compiled code is kept from an earlier run needs this alone: `languages` and `contexts` are for its tree.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from jinja2 import Environment, Undefined, nodes
from jinja2.exceptions import TemplateSyntaxError
from jinja2.ext import Extension
from jinja2.parser import Parser
from markupsafe import Markup

from robosmi import quoting
from robosmi.errors import did_you_mean
from robosmi.query.values import as_string
from robosmi.quoting import Quoted

if TYPE_CHECKING:
    from robosmi.base.functions import Function


_KNOWN, _SHORT = 1 << 14, 200
"""The number of quoted texts cached for each place, and the greatest length of a cached text."""
NOTHING = "nothing"
"""The declaration of a template whose values are quoted by the code that passes them in."""

QUOTING: dict[str, Callable[[str], str]] = {
    "c_word": quoting.c_word,
    "c_comment": quoting.c_comment,
    "c_block_comment": quoting.c_block_comment,
    "c_string": quoting.c_string,
    "c_char": quoting.c_char,
    "c_header": quoting.c_header,
    "identifier": quoting.identifier,
    "file_name": quoting.file_name,
    "markdown": quoting.markdown,
    "markdown_block": quoting.markdown_block,
    "markdown_cell": quoting.markdown_cell,
    "markdown_code": quoting.markdown_code,
    "markdown_code_cell": quoting.markdown_code_cell,
    "html": quoting.html,
    "html_attribute": quoting.html_attribute,
    "html_url": quoting.html_url,
    "html_comment": quoting.html_comment,
    "dot_string": quoting.dot_string,
    "dot_label": quoting.dot_label,
    "plantuml": quoting.plantuml,
    "toml": quoting.toml,
    "yaml": quoting.yaml,
    "yaml_key": quoting.yaml,
    "yaml_flow": quoting.toml,
    "yaml_line": quoting.yaml_line,
    "csv": quoting.csv_record_cell,
    "terminal": quoting.terminal,
}
"""Place -> the function that quotes a text there; every template may call each as a filter, too."""


class Declaration(Extension):
    """The tag `quoting`; the language is noted at the parser, whose tree `contexts` then walks."""

    def __init__(self, environment: Environment) -> None:
        super().__init__(environment)
        self.tags = {"quoting"}

    def parse(self, parser: Parser) -> list[nodes.Node]:
        """Jinja's entry; the tag itself prints nothing."""
        from robosmi.generate.languages import LANGUAGES  # wanted where a template is compiled

        line = next(parser.stream).lineno
        language = parser.parse_expression()
        known = (*LANGUAGES, NOTHING)
        if not isinstance(language, nodes.Const) or language.value not in known:
            said = repr(language.value) if isinstance(language, nodes.Const) else "this"
            near = did_you_mean(str(language.value) if isinstance(language, nodes.Const) else "", known)
            raise TemplateSyntaxError(
                f"{said} is no language{near}; there are: {', '.join(known)}", line, parser.name, parser.filename
            )
        if getattr(parser, "quoting", None) not in (None, language.value):
            raise TemplateSyntaxError("a template declares one language", line, parser.name, parser.filename)
        parser.quoting = language.value  # type: ignore[attr-defined]
        return []


def filters() -> dict[str, Function]:
    """The filters of every template: `safe`, one function for each place by its name, and those that `contexts` puts in."""
    found: dict[str, Function] = {"safe": lambda value: Quoted(as_string(value))}
    for place, function in QUOTING.items():
        found[place] = _marked(place, function)
        found[hidden(place)] = _printed(place, function)
    return found


def hidden(place: str) -> str:
    """The name of the filter that `contexts` puts in, which no template can write."""
    return f"({place})"


def _marked(place: str, function: Callable[[str], str]) -> Callable[[Any], Quoted]:
    return lambda value: Quoted(function(as_string(value)), place)


def _printed(place: str, function: Callable[[str], str]) -> Callable[[Any], str]:
    markup = place.startswith("html")
    known: dict[str, str] = {}  # most values stand in a text more than once, or in the next one as well

    def kept(text: str) -> str:
        quoted = known.get(text)
        if quoted is None:
            if len(text) > _SHORT:
                return function(text)
            if len(known) >= _KNOWN:
                known.clear()
            quoted = known[text] = function(text)
        return quoted

    def quote(value: Any) -> str:
        if isinstance(value, Quoted) and value.place in ("", place):
            return str.__str__(value)
        if isinstance(value, Undefined) or (markup and isinstance(value, Markup)):
            return str.__str__(str(value))
        text = kept(as_string(value))
        return Quoted(text, place) if place == "csv" else text  # whose line breaks are the cell's: nothing is put behind them

    return quote
