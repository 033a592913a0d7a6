"""`{% quoting "c" %}`: quotes every value that a template prints according to the place where it is printed.

The template's syntax tree is walked once, when it is read: the text between the expressions determines the place of each
(`languages`), and a quoting filter is wrapped around values from outside. Literal texts of the template are not quoted, nor is
what `| safe` or a function of `robosmi.quoting` marks. A template without the declaration is unchanged and prints as EGL does.

A quoted value is right for its place whatever the text beside it, but two texts may combine: an empty value makes those before
and after it adjacent, and so the end of a comment, an escape or a URL. A template with such a place is refused when it is read.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from jinja2 import Environment, nodes
from jinja2.exceptions import TemplateSyntaxError
from jinja2.parser import Parser

from robosmi.generate.languages import LANGUAGES, NOWHERE, Language
from robosmi.generate.quoting_filters import NOTHING, hidden

_PRINTING = ("print", "println")
_MARKING = ("start_preserve", "start_control")
_OWN = ("stop_preserve", "stop_control", "set_content_type", "chop", "part", "stop")


def parsed(environment: Environment, source: str, name: str | None, filename: str | None) -> nodes.Template:
    """Parse a template and add the quoting that it declares.

    Raises:
        TemplateSyntaxError: it does not parse, or prints where nothing can be quoted.
    """
    parser = Parser(environment, source, name, filename)
    tree = parser.parse()
    language = LANGUAGES.get(getattr(parser, "quoting", NOTHING))
    if language is not None:
        _Walk(language, {macro.name for macro in tree.find_all(nodes.Macro)}, name, filename).through(tree.body, language.start)
    return tree


class _Walk:
    """The traversal of one template."""

    def __init__(self, language: Language, macros: set[str], name: str | None, filename: str | None) -> None:
        self.language, self.macros, self.name, self.filename = language, macros | {"caller", "super"}, name, filename
        self.last, self.before = "", ""  # place of the last value, and the template's text up to what comes next

    def through(self, body: Iterable[nodes.Node], state: Any) -> Any:
        """Add quoting to what these nodes print; returns the state after them."""
        for node in body:
            state = self._node(node, state)
        return state

    def _node(self, node: nodes.Node, state: Any) -> Any:
        if isinstance(node, nodes.Output):
            for place, child in enumerate(node.nodes):
                if isinstance(child, nodes.TemplateData):
                    self._border(child, self.last, child.data)
                    self.before += child.data
                    state = self.language.advance(state, child.data)
                else:
                    node.nodes[place] = self._expression(child, state)
                    self.last = self.language.place(state)
                    self._border(child, self.last, VALUE)
                    self.before += VALUE
                    state = self.language.advance(state, "x")
        elif isinstance(node, nodes.If):
            behind = self._branch(node, node.body, state)
            for other in node.elif_:
                self._branch(node, other.body, state)
            self._branch(node, node.else_, state)
            return behind if node.body else state
        elif isinstance(node, nodes.For):
            behind = self._branch(node, node.body, state)
            self._branch(node, node.else_, state)
            return behind
        elif isinstance(node, (nodes.Macro, nodes.Block, nodes.AssignBlock, nodes.CallBlock, nodes.FilterBlock)):
            if isinstance(node, nodes.CallBlock):
                self._region(node.call)
            self.through(node.body, self.language.start)
        elif hasattr(node, "body"):
            return self.through(node.body, state)
        return state

    def _border(self, node: nodes.Node, place: str, text: str) -> None:
        """Refuse a value next to template text that could combine with it."""
        if problem := fault(place, self.before, text):
            raise self._error(node, problem)

    def _branch(self, node: nodes.Node, body: list[nodes.Node], state: Any) -> Any:
        """Process a part that is printed conditionally; it must leave the state as it was."""
        behind = self.through(body, state)
        before, after = self._settled(state), self._settled(behind)
        if before != after:
            raise self._error(node, f"what is printed here or not begins as {before} and ends as {after}")
        return behind if self.language.place(behind) in (self.language.place(state), "yaml_key") else state

    def _settled(self, state: Any) -> str:
        """The state, with the beginning of a line in Markdown or YAML equated with the rest of the line."""
        place = self.language.place(state)
        return {"markdown_block": "markdown", "yaml_key": "yaml"}.get(place, place)

    def _expression(self, node: nodes.Expr, state: Any) -> nodes.Expr:
        """The expression wrapped in a call that quotes its value for its place."""
        if isinstance(node, nodes.Call) and self._is_own(node, state):
            return node
        if not self.language.whole:
            if isinstance(node, nodes.Const) and isinstance(node.value, str):
                if self.language.place(self.language.advance(state, node.value)) != self.language.place(state):
                    raise self._error(node, "a text in an expression must not begin or end a comment, string or tag")
                return node
            if isinstance(node, nodes.CondExpr):
                node.expr1 = self._expression(node.expr1, state)
                node.expr2 = self._expression(node.expr2, state) if node.expr2 is not None else None
                return node
            if isinstance(node, nodes.Concat):
                node.nodes = [self._expression(part, state) for part in node.nodes]
                return node
        place = self.language.place(state)
        if place == NOWHERE:
            raise self._error(node, "no value can be printed here so that it stays text")
        return nodes.Filter(node, hidden(place), [], [], None, None, lineno=node.lineno)

    def _is_own(self, node: nodes.Call, state: Any) -> bool:
        """Whether a call prints text that is quoted already: a macro of the template, or a region's marker."""
        called = node.node
        if isinstance(called, nodes.Name):
            return called.name in self.macros and self.language.place(state) == self.language.place(self.language.start)
        if not isinstance(called, nodes.Getattr) or not isinstance(called.node, nodes.Name) or called.node.name != "out":
            return False
        if called.attr in _PRINTING and node.args:
            node.args[0] = self._expression(node.args[0], state)
        elif called.attr in _MARKING:
            self._identity(node.args, 2 if len(node.args) > 2 else 0)
        return called.attr in (*_PRINTING, *_MARKING, *_OWN)

    def _region(self, call: nodes.Call) -> None:
        """Quote the id of a block `protected` or `controlled`: the third argument, after the context and the tag."""
        if isinstance(call.node, nodes.ExtensionAttribute) and call.node.name == "_region":
            self._identity(call.args, 2)

    def _identity(self, arguments: list[nodes.Expr], place: int) -> None:
        if len(arguments) > place:
            name = hidden(self.language.comment)
            arguments[place] = nodes.Filter(arguments[place], name, [], [], None, None, lineno=arguments[place].lineno)

    def _error(self, node: nodes.Node, message: str) -> TemplateSyntaxError:
        return TemplateSyntaxError(message, node.lineno, self.name, self.filename)


# ---- texts beside a value: the template's own, with `VALUE` for each value in them

VALUE = "\ue000"
"""The placeholder for a printed value in the text of a template."""

_ESCAPE = (re.compile(rf"(?<!\\)(?:\\\\)*\\(?:x[0-9A-Fa-f]*|[0-7]{{0,2}}|[uU][0-9A-Fa-f]*){VALUE}"), "would go on with an escape")
_COMMENT = (
    (re.compile(rf"{VALUE}\?{VALUE}*/|\?{VALUE}+\?*{VALUE}*/|\?{VALUE}*\?{VALUE}*/{VALUE}"), "could make a trigraph"),
    (re.compile(rf"(?:\\|\?\?/)[ \t]*{VALUE}[ \t{VALUE}]*\n"), "could join the line to the next where it is empty"),
)
_STRING = (
    _ESCAPE,
    (re.compile(rf"{VALUE}\?[{VALUE}/?]|\?\?{VALUE}|\?{VALUE}+\?"), "could make a trigraph"),
)
_RULES: dict[str, tuple[tuple[re.Pattern[str], str], ...]] = {
    "c_word": (
        (re.compile(rf"{VALUE}[\"']"), "could be the prefix of a string"),
        (re.compile(rf"/{VALUE}+[/*]"), "could begin a comment where it is empty"),
    ),
    "c_comment": _COMMENT,
    "c_block_comment": (*_COMMENT, (re.compile(rf"\*{VALUE}+/"), "could end the comment where it is empty")),
    "c_string": _STRING,
    "c_char": _STRING,
    "dot_string": ((re.compile(rf"(?<!\\)(?:\\\\)*\\{VALUE}"), "would be part of an escape"),),
    "html": ((re.compile(rf"&#?\w*{VALUE}"), "would be part of a character's reference"),),
    "html_attribute": (
        (re.compile(rf"&#?\w*{VALUE}"), "would be part of a character's reference"),
        (re.compile(rf"(?i)<meta\b[^>]*{VALUE}[^>]*\bhttp-equiv"), "would be what the tag does"),
    ),
    "html_url": (
        (re.compile(rf"&#?\w*{VALUE}"), "would be part of a character's reference"),
        (re.compile(rf"[\"'][^\"'/?#:]*{VALUE}[^\"'/?#:]*:"), "could be the scheme of an address"),
        (
            re.compile(rf"(?i)[\"']\s*+(?!(?:https?|mailto|ftp):)[^\"'/?#:{VALUE}]*+:[^\"']*{VALUE}"),
            "would go on such an address",
        ),
    ),
    "html_comment": ((re.compile(rf"-{VALUE}+[->!]"), "could end the comment where it is empty"),),
}
_RULES |= {
    place: ((re.compile(rf"{VALUE}(?!{VALUE}|\Z|{behind})(?=((?s:.{{1,12}})))"), "would be no whole value"),)
    for place, behind in {
        "yaml": r"[ \t]*\n|[ \t]+#|:(?:\s|\Z)",
        "yaml_key": r":(?:\s|\Z)",
        "yaml_flow": r"[ \t]*[,\]}\n]|:(?:\s|\Z)",
        "toml": r"[ \t]*(?:[\n#,\]}=.]|\Z)",
        "csv": r"[,;\t|\r\n]",
    }.items()
}
_REACH = 400  # characters before a value that can matter


def fault(place: str, before: str, text: str) -> str:
    """What could go wrong with a value between the template's texts; empty if nothing.

    Args:
        place: the kind of place of the value (`c_comment`).
        before: the template's text up to and including the value.
        text: the template's text after it, up to and including the next value.
    """
    whole = before[-_REACH:] + text
    end = min(len(before), _REACH)
    for pattern, problem in _RULES.get(place, ()):
        for found in pattern.finditer(whole):
            if found.end() >= end and VALUE in found[0]:
                beside = "".join([found[0], *found.groups("")]).replace(VALUE, "")
                return f"a value beside '{beside}' {problem}"
    return ""
