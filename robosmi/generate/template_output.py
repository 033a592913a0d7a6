"""`out`, what a template says to the text it makes: regions, content type, printing; and the tags for the same in blocks.

Names and arguments are EGL's, in snake_case. Markers of regions are `regions`', the text is `output`'s.

    {{ out.start_preserve("//", "", "id", true) }}      {% protected "id", start="//" %}
    text                                                text
    {{ out.stop_preserve() }}                           {% endprotected %}
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

from jinja2 import Environment, nodes
from jinja2.ext import Extension
from jinja2.parser import Parser
from jinja2.runtime import Context
from msgspec import Struct

from robosmi.errors import RuleError, did_you_mean
from robosmi.generate.output import Buffer, Chop, Raw, TextPart, chop, outdented
from robosmi.generate.regions import CONTENT_TYPES, CONTROLLED, PROTECTED, CommentStyle
from robosmi.query.values import as_string, collection_kind

if TYPE_CHECKING:
    from robosmi.query.values import Answer


class Stop(Exception):
    """Raised to end a template; what it has printed so far is kept (EGL `out.stop()`)."""


_style = cache(CommentStyle)


class Comments(Struct):
    """The comments that markers may be: those that the templates of one run have used so far, or of a content type."""

    styles: tuple[CommentStyle, ...] = ()

    def add(self, style: CommentStyle) -> None:
        """Note a comment; once is enough."""
        if style not in self.styles:
            self.styles = (*self.styles, style)


class TemplateOutput:
    """The `out` of one template.

    Args:
        comments: the run's comments.
        buffer: the text in the making.
    """

    __slots__ = ("_buffer", "_comments", "_kind", "_last_line", "_own", "_typed", "named", "open", "regions")

    def __init__(self, comments: Comments, buffer: Buffer) -> None:
        self.regions: list[str] = []
        self.named: list[TextPart] = []
        self.open: str | None = None
        self._comments, self._buffer = comments, buffer
        self._own: list[CommentStyle] = []
        self._kind: str | None = None
        self._last_line = ""
        self._typed = False

    def set_content_type(self, name: str) -> str:
        """Choose the comments by the kind of text; a second call in one template does nothing.

        Args:
            name: Java, HTML, VisualBasic, EGL or Perl.

        Raises:
            RuleError: there is no such content type.
        """
        if name not in CONTENT_TYPES:
            raise RuleError(
                f"'{name}' is no content type{did_you_mean(name, CONTENT_TYPES)}", fix=f"use one of: {', '.join(CONTENT_TYPES)}"
            )
        if not self._typed:
            self._typed = True
            self._comments.styles = tuple(_style(*pair) for pair in CONTENT_TYPES[name])
            for style in self._own:
                self._comments.add(style)
        return ""

    def start_preserve(self, *arguments: Any) -> str:
        """The marker that begins a protected region.

        Args:
            arguments: `start, end, id, enabled`: the two parts of a comment (the second may be empty), the region's id, and
                whether it is on (default true); or only `id, enabled`, with the comment of the content type.

        Raises:
            RuleError: a region is open, the id was used before, there is no comment, or the template has controlled regions.
        """
        return self._start(PROTECTED, arguments)

    def start_control(self, *arguments: Any) -> str:
        """The marker that begins a controlled region: the file is the user's, and only this part of it is made anew.

        Args:
            arguments: as for `start_preserve`.

        Raises:
            RuleError: as for `start_preserve`.
        """
        return self._start(CONTROLLED, arguments)

    def stop_preserve(self) -> str:
        """The marker that ends the region.

        Raises:
            RuleError: no region is open.
        """
        if self.open is None:
            raise RuleError("there is no region to stop", fix="start one first, or take this line out")
        self.open = None
        return self._last_line

    stop_control = stop_preserve

    def _start(self, kind: str, arguments: tuple[Any, ...]) -> str:
        count = len(arguments)
        if not 1 <= count <= 4:
            raise RuleError("a region is started with (start, end, id, enabled) or (id, enabled)", fix="give these arguments")
        style = self._style(arguments)
        identity = str(arguments[2] if count > 2 else arguments[0])
        enabled = bool(arguments[-1]) if count in (2, 4) else True
        if self.open is not None or self._kind not in (None, kind) or identity in self.regions:
            raise self._wrong(kind, identity)
        if not identity or identity.isspace() or "\n" in identity:
            raise RuleError(f"'{identity}' cannot be the id of a region", fix="give a text of one line that is not empty")
        self._kind = kind
        self.open = identity
        self.regions.append(identity)
        self._last_line = style.end_line(kind, identity)
        return style.begin_line(kind, identity, enabled)

    def _wrong(self, kind: str, identity: str) -> RuleError:
        """Why a region may not begin here."""
        if self.open is not None:
            message = f"the region '{self.open}' must be stopped before '{identity}' may begin"
            return RuleError(message, fix="stop it first, or take one out")
        if self._kind != kind:
            return RuleError("a template cannot have both protected and controlled regions", fix="use one kind")
        return RuleError(
            f"two regions have the id '{identity}'", fix="derive the id from the element, e.g. region_id(element, 'body')"
        )

    def _style(self, arguments: tuple[Any, ...]) -> CommentStyle:
        if len(arguments) > 2:
            style = _style(arguments[0] or "", arguments[1] or "")
            if style not in self._own:
                self._own.append(style)
                self._comments.add(style)
            return style
        if not self._comments.styles:
            raise RuleError(
                "no comment is known for the region's markers",
                fix='call out.set_content_type("Java") first, or give the comment: start_preserve("//", "", id, true)',
            )
        return self._comments.styles[0]

    def print(self, value: Answer) -> str:
        """The value's text as it is: further lines are not indented (EGL `out.print`). For `{% print out.print(x) %}`."""
        return Raw(as_string(value))

    def println(self, value: Answer = "") -> str:
        """As `print`, with a line break."""
        return Raw(as_string(value) + "\n")

    def chop(self, count: int) -> Chop:
        """Takes the last characters away that were printed in this template or macro. For `{% print out.chop(1) %}`."""
        return chop(count)

    def part(self, name: str, /, *elements: Any, step: str = "") -> str:
        """Says what the lines from here to the next part come from: for `{% do out.part("head", x) %}`, not in a macro.

        Args:
            name: of the part.
            elements: what the trace has for its lines, instead of what the template looks at there; elements, collections of
                them, None for nothing.
            step: step of a method, if the template belongs to one.
        """
        found: list[Any] = []
        for one in elements:
            if collection_kind(one) is not None:
                found += one
            elif one is not None:
                found.append(one)
        self.named.append(TextPart(len(self._buffer.parts), name, tuple(found), step))
        return ""

    def stop(self) -> str:
        """Ends the template; what it has printed stays."""
        raise Stop

    @property
    def line(self) -> int:
        """The number of the line that is being printed (EGL `out.getCurrentLineNumber()`)."""
        return self._buffer.line()


class Blocks(Extension):
    """The tags `protected`, `controlled` and `outdent`, each with its end tag."""

    def __init__(self, environment: Environment) -> None:
        super().__init__(environment)
        self.tags = {"protected", "controlled", "outdent"}

    def parse(self, parser: Parser) -> nodes.Node:
        """Jinja's entry: a call of a method below with the block as `caller`."""
        tag = next(parser.stream)
        values: list[nodes.Expr] = [nodes.ContextReference(), nodes.Const(tag.value)]
        named: list[nodes.Keyword] = []
        while parser.stream.current.type != "block_end":
            if values[2:] or named:
                parser.stream.expect("comma")
            if parser.stream.current.type == "name" and parser.stream.look().type == "assign":
                name = next(parser.stream).value
                parser.stream.skip()
                named.append(nodes.Keyword(name, parser.parse_expression(), lineno=tag.lineno))
            else:
                values.append(parser.parse_expression())
        body = parser.parse_statements((f"name:end{tag.value}",), drop_needle=True)
        method = "_outdent" if tag.value == "outdent" else "_region"
        return nodes.CallBlock(self.call_method(method, values, named), [], [], body).set_lineno(tag.lineno)

    def _region(
        self,
        context: Context,
        kind: str,
        identity: Answer,
        enabled: bool = True,
        *,
        start: str | None = None,
        end: str = "",
        caller: Callable[[], str],
    ) -> str:
        out: TemplateOutput = context["out"]
        begin = out.start_preserve if kind == PROTECTED else out.start_control
        first = begin(identity, enabled) if start is None else begin(start, end, identity, enabled)
        body = caller()
        if body and not body.endswith("\n"):
            body += "\n"
        return f"{first}\n{body}{out.stop_preserve()}\n"

    def _outdent(self, context: Context, kind: str, *indenters: str, caller: Callable[[], str]) -> str:
        return outdented(caller(), indenters or ("\t", "    "))
