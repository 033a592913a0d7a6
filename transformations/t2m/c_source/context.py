"""The state that the builders share while one unit is built: text, tokens, libclang's tree, known declarations, findings.

No element is made here. `UnitContext` answers questions about places (which token precedes, which macro this comes from) and
about names (what a cursor refers to). One context serves one unit.
"""

from __future__ import annotations

import os
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Mapping, Sequence
from typing import Concatenate, ParamSpec, TypeVar

from msgspec import Struct

from robosmi.diagnostics import Finding, Severity
from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.invocation import HEADERS, VIRTUAL
from robosmi.transformations.t2m.c_source.parsing.source import ReadSource
from robosmi.transformations.t2m.c_source.parsing.translation_unit import Parsed
from robosmi.transformations.t2m.c_source.parsing.tree import Expansion, Node

P = ParamSpec("P")
R = TypeVar("R", bound=Element)
MAX_DEPTH = 150


ExpressionBuilder = Callable[["UnitContext", Node], "ccode.Expression | None"]
StatementBuilder = Callable[["UnitContext", Node], ccode.Statement]
DeclarationBuilder = Callable[["UnitContext", Node], ccode.Declaration]


class Builders(Struct, frozen=True):
    """The functions that make elements of the code model: tables from CXCursorKind to a function of context and cursor.

    The builders call one another through these tables, since declarations contain statements and statements declarations.

    Attributes:
        expressions: return None for a cursor that they cannot take apart.
        statements: for all kinds but expression statements.
        declarations: for declarations at file scope and in blocks.
        block: builds the body of a function.
    """

    expressions: Mapping[int, ExpressionBuilder]
    statements: Mapping[int, StatementBuilder]
    declarations: Mapping[int, DeclarationBuilder]
    block: Callable[[UnitContext, Node], ccode.Block]


class UnitContext:
    """State of building one unit.

    Attributes:
        builders: the functions that make the elements (see `grammar`).
        api: the source platform.
        lib: libclang.
        tokens: the unit's tokens without comments and directives.
        declared: declaration pointer -> element.
        references, calls: elements to link once everything is built, with their cursor.
        covered: offsets of callee names that have a call or a macro use in the model.
        declarators: offsets of names that a declaration declares (they look like calls).
        user_macros: names of macros that the file defines.
        changing: names of macros whose meaning changes within the file.
        divided: offsets of macro uses whose text an operator outside divides: with `ONE` as `0 + 1`, `2 * ONE` is `2 * 0 + 1`.
        making: offset of the macro use that expands to the call whose arguments are being built; None outside of such.
    """

    def __init__(self, parsed: Parsed, api: ApiIndex, builders: Builders, include_dirs: Sequence[str] = ()) -> None:
        self.parsed = parsed
        self.builders = builders
        self.api = api
        self.include_dirs = sorted((os.path.abspath(d) for d in include_dirs), key=len, reverse=True)
        self.lib = clang.library()
        self.source: ReadSource = parsed.source
        self.tokens: list[Token] = [t for t in self.source.tokens if t[0] != "comment" and t[0] != "directive"]
        self._comments: list[Token] = [t for t in self.source.tokens if t[0] == "comment"]
        self._comment_starts = [t[1] for t in self._comments]
        self._starts = [t[1] for t in self.tokens]
        skipped = sorted(parsed.skipped)  # beside each other: the parser gives none within another
        self._skipped_starts, self._skipped_ends = [start for start, _ in skipped], [end for _, end in skipped]
        self.declared: dict[int, ccode.Declaration] = {}
        self.references: list[tuple[ccode.NameReference, Cursor]] = []
        self.calls: list[tuple[ccode.Call, Cursor | None]] = []
        self.call_nodes: list[tuple[ccode.Call, Node, Node | None]] = []
        self.type_uses: list[tuple[ccode.TypeUse, str]] = []
        self.covered: set[int] = set()
        self.declarators: set[int] = set()
        self.user_macros: dict[str, bool] = {}
        self.changing: set[str] = set()
        self.divided: set[int] = set()
        self._own_in_headers: dict[str, bool] = {}
        self.findings: list[Finding] = []
        self.depth = 0
        self.making: int | None = None
        self._expansion_starts: list[int] = []
        self._expansions: list[Expansion] = []
        for expansion in sorted(parsed.expansions, key=lambda e: (e.start, -e.end)):
            self._expansions.append(expansion)
            self._expansion_starts.append(expansion.start)
        self._header_names: dict[int | None, str] = {}
        self.argument_types: dict[tuple[int, int | None, int | None], str] = {}
        self.canonical: dict[int, tuple[str, int, bool, bool]] = {}
        self.attribute_macros: frozenset[str] = frozenset(
            {*api.settings["parser"].get("attribute_macros", []), *parsed.prelude.macros}
        )

    def later(
        self, kind: type, build: Callable[Concatenate[UnitContext, P], R], *arguments: P.args, **named: P.kwargs
    ) -> R | None:
        """A stand-in that builds the element when it is first accessed (`on_demand`); None, as here, to build it at once."""
        return None

    def text(self, node: Node) -> str:
        """The text of a node."""
        return self.source.text(node.start, node.end)

    def token_at(self, offset: int) -> int:
        """The number of the first token that does not start before the offset."""
        return bisect_left(self._starts, offset)

    def token_before(self, offset: int) -> int:
        """The number of the last token that starts before the offset; -1 for none."""
        return bisect_left(self._starts, offset) - 1

    def name_offset(self, cursor: Cursor) -> int:
        """The offset of a declaration's name in the file, -1 if it is in another file."""
        return self.parsed.reader.offset(self.lib.getCursorLocation(cursor))

    def spelling(self, cursor: Cursor) -> str:
        """The name of a cursor."""
        text: str = self.lib.text(self.lib.getCursorSpelling(cursor))
        return text

    def pointer(self, cursor: Cursor) -> int:
        """The address by which libclang identifies a declaration."""
        return cursor.data[0] or 0

    def register(self, cursor: Cursor, element: ccode.Declaration) -> None:
        """Record the element that was built for a declaration."""
        self.declared[self.pointer(cursor)] = element

    def expansions_at(self, offset: int) -> list[Expansion]:
        """Macro uses that start at an offset, the longest first."""
        first = bisect_left(self._expansion_starts, offset)
        last = bisect_right(self._expansion_starts, offset)
        return self._expansions[first:last]

    def enclosing(self, offset: int) -> Expansion | None:
        """The outermost macro use that covers an offset."""
        number = bisect_right(self._expansion_starts, offset)
        found = None
        for expansion in reversed(self._expansions[max(0, number - 40) : number]):
            if expansion.start <= offset < expansion.end:
                found = expansion
        return found

    def function_like(self, expansion: Expansion) -> bool:
        """Whether the macro is used with arguments."""
        return self.source.data[expansion.end - 1 : expansion.end] == b")" and expansion.end - expansion.start > len(
            expansion.name
        )

    def is_own(self, expansion: Expansion) -> bool:
        """Whether the program defines the macro, in the file itself or in a header of its own."""
        name = expansion.name
        if name in self.user_macros:
            return True
        if name not in self._own_in_headers:
            file, _ = clang.file_offset(self.lib.getCursorLocation(self.lib.getCursorReferenced(expansion.cursor)))
            path = clang.file_name(file) if file is not None else ""
            ours = bool(path) and not path.startswith((HEADERS + "/", VIRTUAL + "/"))
            self._own_in_headers[name] = ours and self.api.header_kind(self.header_of_file(file)) is None
        return self._own_in_headers[name]

    def arguments(self, expansion: Expansion) -> list[tuple[int, int]]:
        """The ranges of the arguments of a macro use, trimmed."""
        i = self.token_at(expansion.start) + 2
        ranges: list[tuple[int, int]] = []
        depth, start, end = 0, -1, -1
        while i < len(self.tokens) and self.tokens[i][2] <= expansion.end:
            _, begin, stop, text = self.tokens[i]
            if depth == 0 and text in (",", ")"):
                if start >= 0:
                    ranges.append((start, end))
                start = -1
                if text == ")":
                    break
            else:
                depth += (text in ("(", "[", "{")) - (text in (")", "]", "}"))
                start, end = (begin if start < 0 else start), stop
            i += 1
        return ranges

    def matching(self, number: int) -> int:
        """The number of the token that closes the bracket which is token `number`; the last token when nothing does."""
        depth = 0
        for i in range(number, len(self.tokens)):
            text = self.tokens[i][3]
            if text in ("(", "[", "{"):
                depth += 1
            elif text in (")", "]", "}"):
                depth -= 1
                if depth == 0:
                    return i
        return len(self.tokens) - 1

    def active(self, offset: int) -> bool:
        """Whether the text at an offset was compiled."""
        number = bisect_right(self._skipped_starts, offset)
        return number == 0 or offset >= self._skipped_ends[number - 1]

    def comment(self, node: Node) -> str | None:
        """The comment directly before a declaration, or after it on its last line."""
        if not self._comments:
            return None
        number = bisect_left(self._comment_starts, node.start)
        if number:
            _, start, end, _ = self._comments[number - 1]
            between = self.source.parsed[end : node.start]
            if not between.strip() and between.count(b"\n") <= 1 and self._first_on_line(start):
                return self.source.text(start, end)
        number = bisect_left(self._comment_starts, node.end)
        if number < len(self._comments):
            _, start, end, _ = self._comments[number]
            between = self.source.parsed[node.end : start]
            if b"\n" not in between and not between.strip(b" \t;"):
                return self.source.text(start, end)
        return None

    def _first_on_line(self, offset: int) -> bool:
        return not self.source.parsed[self.source.parsed.rfind(b"\n", 0, offset) + 1 : offset].strip()

    def header_of_file(self, file: int | None) -> str:
        """The name by which an include of this unit would refer to a header; empty for the prelude."""
        known = self._header_names.get(file)
        if known is None:
            known = self._header_names[file] = self._header_name(clang.file_name(file))
        return known

    def _header_name(self, path: str) -> str:
        if path.startswith(HEADERS + "/"):
            return path[len(HEADERS) + 1 :]
        if not path or path.startswith(VIRTUAL + "/"):
            return ""
        path = os.path.abspath(path)
        for folder in (os.path.dirname(os.path.abspath(self.source.path)), *self.include_dirs):
            if path.startswith(folder + os.sep):
                return path[len(folder) + 1 :].replace(os.sep, "/")
        return os.path.basename(path)

    def find(
        self,
        rule: str,
        severity: Severity,
        message: str,
        start: int,
        end: int | None = None,
        fix: str | None = None,
        *,
        header: str = "",
    ) -> None:
        """Add a finding about a range of the text, and about a header where one is named."""
        evidence = {"header": header} if header else {}
        self.findings.append(Finding(rule, severity, message, self.source.location(start, end), fix=fix, evidence=evidence))
