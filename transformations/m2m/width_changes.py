"""Turns the wants of `width_rules` into text changes: where each is written, and how several at one place combine.

A place in a macro's body belongs to every use of the macro, so a cast is written there only if all uses need the same one; else
it is written in the argument. Wants without a possible place are returned, to be reported.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from msgspec import Struct

from robosmi.transformations.m2m.macro_order import MacroOrder
from robosmi.transformations.m2m.width_rules import Walk
from robosmi.transformations.m2m.width_wants import NAME, ORDER, READ, SHIFT, TEXT, WIDEN, Want
from robosmi.transformations.queries.macro_definitions import TextPlace
from robosmi.transformations.queries.numbers import Number
from robosmi.transformations.queries.typed import TypedExpression

_LITERAL = re.compile(r"(0[xX][0-9a-fA-F]+|0[bB][01]+|\d+)([uU]?)([lL]*)")
_COMPOUND_FORMS = frozenset(["binary", "conditional", "assign", "compound"])


class WidthEdit(NamedTuple):
    """A change of a unit's text: byte range, new text, rule."""

    unit: str
    start: int
    end: int
    text: str
    rule: str


class _Cast(Struct):
    """The cast inserted before an expression: its type, whether plain char is read as unsigned, whether it needs parentheses."""

    number: Number | None = None
    read: bool = False
    enclosed: bool = False


class Writer(Struct):
    """Writes wants into texts.

    Attributes:
        texts: path of a unit -> its bytes.
        walk: the walk that found the wants.
        order: the macros of the program and their uses.
        lambdas: the target's language has lambda expressions.
        lost: the wants for which there is no possible place.
    """

    texts: Mapping[str, bytes]
    walk: Walk
    order: MacroOrder
    lambdas: bool = True
    lost: list[Want] = []
    _casts: dict[TextPlace, _Cast] = {}
    _edits: dict[WidthEdit, None] = {}

    def edits(self) -> list[WidthEdit]:
        """All changes; of those at one place the outer ones come first."""
        for want in self.walk.wants:
            done = {
                WIDEN: self._widen,
                READ: self._read,
                NAME: self._name,
                SHIFT: self._shift,
                TEXT: self._text,
                ORDER: self._order,
            }[want.rule]
            if not done(want):
                self.lost.append(want)
        for place in sorted(self._casts, key=lambda p: (p.unit, p.start, -p.end)):
            cast = self._casts[place]
            if cast.number is not None and not cast.read and self.order.computed_before(place):
                zero = "0" + ("" if cast.number.signed else "U") + ("LL" if cast.number.bits > 32 else "L")
                self._edits[WidthEdit(place.unit, place.end, place.end, "))", WIDEN)] = None
                self._edits[WidthEdit(place.unit, place.start, place.start, f"({zero} + (", WIDEN)] = None
                continue
            words = [(f"({_spelt(cast.number)})", WIDEN)] if cast.number is not None else []
            words += [("(uint8_t)", READ)] if cast.read else []
            if cast.enclosed:
                words[-1] = (words[-1][0] + "(", words[-1][1])
                self._edits[WidthEdit(place.unit, place.end, place.end, ")", words[-1][1])] = None
            for word, rule in words:
                self._edits[WidthEdit(place.unit, place.start, place.start, word, rule)] = None
        return list(self._edits)

    def _slice(self, place: TextPlace) -> str:
        return self.texts[place.unit][place.start : place.end].decode("latin-1")

    def _widen(self, want: Want) -> bool:
        number = want.number
        assert number is not None
        node = want.node
        if node.form == "literal" and node.inner:
            place = node.inner[0]
            match = _LITERAL.fullmatch(self._slice(place))
            if match is not None:
                letters = ("" if number.signed else match[2] or "U") + ("LL" if number.bits > 32 else "L")
                self._edits[WidthEdit(place.unit, place.start, place.end, match[1] + letters, WIDEN)] = None
                return True
        place_ = self._place(node, {f"{number.bits} {number.signed} {k}" for k in ("number", "char", "character")}, number)
        if place_ is None:
            return False
        cast = self._cast(place_, node)
        cast.number = number
        return True

    def _read(self, want: Want) -> bool:
        here = self.walk.here.int_bits
        place = self._place(want.node, {f"{here} True char", f"{here} True character"}, None)
        if place is None:
            return False
        self._cast(place, want.node).read = True
        return True

    def _cast(self, place: TextPlace, node: TypedExpression) -> _Cast:
        cast = self._casts.setdefault(place, _Cast())
        bare = place in node.inner  # without the parentheses that it may have
        compound = node.form in _COMPOUND_FORMS and (bare or not node.bracketed)
        parameter = place.body and bare and re.fullmatch(r"\w+", self._slice(place)) is not None
        cast.enclosed = cast.enclosed or compound or (parameter and node.form != "literal")
        return cast

    def _place(self, node: TypedExpression, fits: set[str], number: Number | None) -> TextPlace | None:
        """The outermost place for a cast that fits all uses of that place; None if there is none."""
        for place in node.layers:
            seen = self.walk.seen.get(place, set())
            shared = place.body or place not in node.places[:1]
            if shared and (place in self.walk.changed or (place.body and not self.order.stays(place))):
                continue
            if not shared or (seen <= fits) or (number is not None and not number.signed and seen <= fits):
                return place
        return None

    def _name(self, want: Want) -> bool:
        place = next((p for p in want.node.inner if self._slice(p) == want.node.name), None)
        if place is None:
            return False
        self._edits[WidthEdit(place.unit, place.start, place.end, want.text, NAME)] = None
        return True

    def _text(self, want: Want) -> bool:
        """Insert the length `l` for 32 bits into the conversions of a format."""
        written = want.node.text
        if want.text or "PRI" in written or "SCN" in written:
            return not want.text  # the target's own macros name its widths
        place = next((p for p in want.node.inner if self._slice(p) == written), None)
        if place is None:
            return False
        for offset in want.offsets:
            self._edits[WidthEdit(place.unit, place.start + offset, place.start + offset, "l", TEXT)] = None
        return True

    def _order(self, want: Want) -> bool:
        """Wrap a comparison function for `qsort` or `bsearch` in a lambda that reduces its 32-bit result to the sign."""
        place = next(iter(want.node.inner), None)
        if place is None or not self.lambdas or not re.fullmatch(r"&?\s*\w+", self._slice(place)):
            return False
        name = self._slice(place).lstrip("& \t\n")
        text = f"[](const void *a, const void *b) -> int {{ int32_t order = {name}(a, b); return (order > 0) - (order < 0); }}"
        self._edits[WidthEdit(place.unit, place.start, place.end, text, ORDER)] = None
        return True

    def _shift(self, want: Want) -> bool:
        """Write `a <<= n` as `a = (int32_t)a << n`."""
        left, right = want.node.children[:2]
        assert want.number is not None
        whole = next(iter(want.node.inner), None)
        first = next((p for p in left.places if whole and p.unit == whole.unit and p.start == whole.start), None)
        second = next((p for p in right.places if whole and p.unit == whole.unit and p.end == whole.end), None)
        if whole is None or first is None or second is None or not _plain(left):
            return False
        middle = self.texts[whole.unit][first.end : second.start].decode("latin-1")
        operator = want.node.operator
        if operator not in middle:
            return False
        start = first.end + middle.index(operator)
        read = "(uint8_t)" if left.kind.char and self.walk.resigned else ""
        written = f"= ({_spelt(want.number)}){read}{self._slice(first)} {want.text}"
        self._edits[WidthEdit(whole.unit, start, start + len(operator), written, SHIFT)] = None
        if right.form in _COMPOUND_FORMS and not right.bracketed:
            self._edits[WidthEdit(whole.unit, second.start, second.start, "(", SHIFT)] = None
            self._edits[WidthEdit(whole.unit, second.end, second.end, ")", SHIFT)] = None
        return True


def _plain(node: TypedExpression) -> bool:
    """Whether an expression has no side effects, so that it can be written twice."""
    if node.form in ("call", "assign", "compound") or node.operator in ("++", "--"):
        return False
    return all(_plain(child) for child in node.children)


def _spelt(number: Number | None) -> str:
    assert number is not None
    return f"{'' if number.signed else 'u'}int{number.bits}_t"
