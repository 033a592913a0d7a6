"""The text changes that keep the source's widths of numbers, as decisions of a plan.

A decision is about one declaration or macro and contains all its changes. `width_rules` finds what the expressions want;
`queries.width_types` has the types of declarations.

`Writer` turns these wants into text changes: where each is written, and how several at one place combine. A place in a macro's
body belongs to every use of the macro, so a cast is written there only if all uses need the same one; else it is written in the
argument. Wants without a possible place are returned, to be reported.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import accumulate

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode, migration
from robosmi.query import all_of_kind
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.macro_order import MacroOrder
from robosmi.transformations.m2m.partition.platform_dependence import Dependence
from robosmi.transformations.m2m.widths.width_formats import handing_on
from robosmi.transformations.m2m.widths.width_requirements import DEDUCED, NAME, ORDER, READ, SHIFT, TEXT, WIDEN, WidthRequirement
from robosmi.transformations.m2m.widths.width_rules import Walk
from robosmi.transformations.queries.macros.macro_definitions import TextPlace
from robosmi.transformations.queries.numbers import Machine, Number
from robosmi.transformations.queries.typed import TypedExpression, raised_recursion_limit
from robosmi.transformations.queries.width_types import retyped, retyped_words

TYPE = "type"
"""The rule of a change of a declared type."""
_REASONS = {
    TYPE: "the type has as many bits as on the source",
    "widen": "the source computes it in more bits",
    "gives-type": "what takes its type has as many bits as on the source",
    "unsigned-char": "plain char has no sign on the source",
    "wider-function": "the function or macro has as many bits as on the source",
    "spelled-out": "the source computes it in more bits before it stores it",
    "format": "the text names what is passed",
    "order": "the function gives more bits than the library takes",
}


class Widened(Struct):
    """What has to be written differently in a program to keep the widths of its numbers.

    Attributes:
        widenings: the decisions, in the order of units and lines.
        lost: wants that no text change can meet.
        unread: uses of macros that are nested too deeply to be analysed.
    """

    widenings: list[migration.Widening] = []
    lost: list[WidthRequirement] = []
    unread: list[TextPlace] = []


def widenings(
    units: Sequence[ccode.SourceUnit],
    texts: Mapping[str, bytes],
    typed: Mapping[str, list[TypedExpression]],
    machines: tuple[Machine, Machine],
    names: Mapping[str, str],
    renamed: Mapping[str, str],
    cplusplus: bool = True,
) -> Widened:
    """Find what has to be written differently in a program so that its numbers keep their widths.

    Args:
        units: the program's units.
        texts: path of a unit -> its bytes.
        typed: path of a unit -> its typed expressions.
        machines: the integer types of source and target.
        names: name of a standard function, type or macro with an int in it -> its wider counterpart.
        renamed: the program's own names that change -> their new names.
        cplusplus: the target's language is C++.
    """
    here, there = machines
    walk = Walk(here, there, names)
    with raised_recursion_limit():
        walk.handing = {name for top in typed.values() for name in handing_on(top)}
    writer = Writer(texts, walk, MacroOrder(units, texts), cplusplus)
    with raised_recursion_limit():
        for unit in units:
            walk.run(typed.get(unit.path, []))
    written = writer.edits()
    made = Widened(lost=writer.lost)
    for unit in units:
        edits = [(each._replace(text=_renamed(each.text, renamed)), rule) for each, rule in written.get(unit.path, ())]
        if there.int_bits < here.int_bits:
            edits += [(each, TYPE) for each in _types(unit, texts[unit.path], here, names)]
        if walk.resigned:
            edits += [(each, "unsigned-char") for each in _bit_fields(unit, texts[unit.path])]
        made.widenings += _decisions(unit, edits)
    return made


def _bit_fields(unit: ccode.SourceUnit, data: bytes) -> Iterator[Replacement]:
    """Make bit fields of plain char unsigned: a cast on reading comes too late, since the highest bit is already the sign."""
    written: set[int] = set()
    for record in (d for d in all_of_kind(unit, ccode.Record)):
        for member in record.fields:
            use = member.valueType
            if not member.bitWidth or use is None or use.pointerDepth or not _is_plain_char(use):
                continue
            words = use.spelling.removeprefix("const ").removeprefix("volatile ")
            found = re.compile(rb"\b%s\b" % re.escape(words.encode())).search(data, member.startOffset, member.endOffset)
            if found is not None and found.start() not in written:
                written.add(found.start())
                yield Replacement(found.start(), found.end(), "unsigned char")


def _is_plain_char(use: ccode.TypeUse) -> bool:
    """Whether a type is char without signed or unsigned, resolved through typedefs."""
    declared: ccode.TypeUse | None = use
    while declared is not None and isinstance(declared.declaration, ccode.Typedef):
        declared = declared.declaration.aliased
    words = declared.spelling.split() if declared is not None and not declared.pointerDepth else []
    return [word for word in words if word not in ("const", "volatile")] == ["char"]


def lost_findings(widened: Widened, units: Sequence[ccode.SourceUnit], texts: Mapping[str, bytes]) -> list[Finding]:
    """RS319: expressions that lose their width because no text change is possible or a macro could not be analysed.

    Args:
        widened: what was found.
        units: of the program.
        texts: path of a unit -> its bytes.
    """
    known = {unit.path for unit in units}
    found: dict[tuple[str, int, int], Finding] = {}
    for want in widened.lost:
        places = (*want.node.places, *want.node.inner)
        place = places[0] if places else None
        if place is None or place.unit not in known:
            continue
        before = texts[place.unit][: place.start]
        line, column = before.count(b"\n") + 1, place.start - before.rfind(b"\n")
        location = Location(place.unit, line, column)
        found.setdefault(
            (place.unit, place.start, place.end),
            Finding("RS319", Severity.warning, f"{_LOST[want.rule]}, and no change of the text fits all its uses", location,
                    fix="write it with int32_t, or with a cast, in the source"),
        )  # fmt: skip
    for place in widened.unread:
        before = texts[place.unit][: place.start]
        location = Location(place.unit, before.count(b"\n") + 1, place.start - before.rfind(b"\n"))
        name = texts[place.unit][place.start : place.end].decode("ascii", "replace")
        message = f"'{name}' stands for too many nested macros: its result may lose its width"
        fix = "write int32_t into the first of them: `#define NAME ((int32_t)...)`"
        found.setdefault((place.unit, place.start, place.end), Finding("RS319", Severity.warning, message, location, fix=fix))
    return [found[key] for key in sorted(found)]


def text_findings(widened: Widened, units: Sequence[ccode.SourceUnit], texts: Mapping[str, bytes]) -> list[Finding]:
    """RS329: uses of macros that stringify an argument (`#x`) whose text changes.

    Args:
        widened: what was found.
        units: of the program.
        texts: path of a unit -> its bytes.
    """
    found = []
    for unit in units:
        changed = [(int(c.startOffset), int(c.endOffset)) for w in widened.widenings for c in w.changes if c.unit is unit]
        for use in unit.macroUses if changed else ():
            written = _as_text(use.macro) if use.macro is not None else frozenset()
            for number, (start, end) in enumerate(_arguments(texts[unit.path], use)) if written else ():
                if number in written and any(start <= first and last <= end for first, last in changed):
                    place = Location(unit.path, int(use.line), int(use.column))
                    message = f"'{use.name}' turns its argument into a text, which changes where numbers keep their widths"
                    found.append(
                        Finding(
                            "RS329", Severity.warning, message, place, fix="pass the text to the macro as an argument of its own"
                        )
                    )
                    break
    return found


def _as_text(macro: ccode.Macro) -> frozenset[int]:
    """The indices of a macro's parameters that its body stringifies."""
    words = set(re.findall(r"(?<!#)#\s*([A-Za-z_]\w*)", str(macro.body or ""))) if macro.functionLike else set()
    return frozenset(number for number, name in enumerate(macro.parameters) if name in words)


def _arguments(data: bytes, use: ccode.MacroUse) -> list[tuple[int, int]]:
    """The byte ranges of the arguments of a macro's use."""
    begin = int(use.startOffset)
    inside = [t for t in tokens(data[begin : use.endOffset]) if t[0] != "comment"]
    found: list[tuple[int, int]] = []
    depth, start = 0, 0
    for _, first, last, text in inside:
        depth += text in ("(", "[", "{")
        if depth == 1 and text in (",", ")"):
            found.append((begin + start, begin + first))
        if depth == 1 and text in ("(", ","):
            start = last
        depth -= text in (")", "]", "}")
    return found


_LOST = {
    "widen": "the source computes this in more bits",
    "gives-type": "what takes its type has more bits on the source",
    "unsigned-char": "plain char has no sign on the source",
    "wider-function": "the function has fewer bits on the target",
    "spelled-out": "the source computes this in more bits before it stores it",
    "order": "the library takes fewer bits than the function gives",
    "format": "the format is not in the text, and integers that are passed for it have 32 bits",
}


def retype_decisions(dependence: Dependence, bits: int, names: Mapping[str, str]) -> None:
    """Apply the changed types to the texts of other decisions and to the adapters, so that they agree with the program.

    Args:
        dependence: the decisions.
        bits: the width of int on the source.
        names: types of the standard library with an int in them -> their wider counterparts.
    """
    for disposition in dependence.dispositions:
        copy = disposition.hoisted
        for change in (*disposition.changes, *(copy.changes if copy is not None else ())):
            change.replacement = retyped(change.replacement, bits, names)
    for use in dependence.adapters:
        for kind in (use.result, *(p.valueType for p in use.parameters)):
            if kind is not None:
                kind.spelling = retyped(kind.spelling, bits, names)
                kind.emptyValue = retyped(kind.emptyValue, bits, names) if kind.emptyValue else kind.emptyValue
    for symbol in dependence.symbols:
        if symbol.placeholder:
            symbol.placeholder = retyped(symbol.placeholder, bits, names)


def cast_pins(widenings: Iterable[migration.Widening], bindings: Iterable[migration.PortBinding]) -> None:
    """Cast the names of pins that take the place of numbers whose type counts, as in `put(lamp, 1L)` for `put(8, 1L)`."""
    written = {(c.unit, c.startOffset, c.endOffset): c for w in widenings for c in w.changes if c.rule == DEDUCED}
    for moved in (change for binding in bindings for change in binding.changes) if written else ():
        change = written.get((moved.unit, moved.startOffset, moved.endOffset))
        if change is not None and change.startOffset < change.endOffset:
            letters = change.replacement.lstrip("0123456789xXabcdefABCDEF")
            change.endOffset = change.startOffset
            change.replacement = f"({_spelt(Number(64 if 'LL' in letters else 32, 'U' not in letters))})"


def _renamed(text: str, renamed: Mapping[str, str]) -> str:
    return re.sub(r"[A-Za-z_]\w*", lambda word: renamed.get(word[0], word[0]), text) if renamed else text


def _types(unit: ccode.SourceUnit, data: bytes, here: Machine, names: Mapping[str, str]) -> Iterator[Replacement]:
    """The changes of types in a unit's declarations, except in the head of main, whose type the language fixes."""
    heads = [
        (int(d.startOffset), int(d.body.startOffset if d.body is not None else d.endOffset))
        for d in unit.declarations
        if isinstance(d, ccode.Function) and d.name == "main"
    ]
    for each in retyped_words(data, here.int_bits, names):
        if not any(first <= each.start < behind for first, behind in heads):
            yield each


def _decisions(unit: ccode.SourceUnit, edits: Iterable[tuple[Replacement, str]]) -> Iterator[migration.Widening]:
    """Group the changes of a unit, each with its rule, by declaration or macro into decisions."""
    tops: list[ccode.Located] = sorted([*unit.declarations, *unit.macros], key=lambda e: (int(e.startOffset), -int(e.endOffset)))
    found: dict[ccode.Located | None, list[tuple[Replacement, str]]] = {}
    starts = [int(t.startOffset) for t in tops]
    reach = list(accumulate((int(t.endOffset) for t in tops), max))
    for edit, rule in edits:
        owner = None
        for number in range(bisect_right(starts, edit.start) - 1, -1, -1):
            if edit.end <= tops[number].endOffset or reach[number] < edit.end:
                owner = tops[number] if edit.end <= tops[number].endOffset else None
                break
        found.setdefault(owner, []).append((edit, rule))
    for owner in sorted(found, key=lambda o: int(o.startOffset) if o is not None else -1):
        reasons = list(dict.fromkeys(_REASONS[rule] for _, rule in found[owner]))
        yield migration.Widening(
            element=owner, choice="fix", chosenBy=migration.ChosenBy.rule, confidence=1.0, evidence=list(reasons),
            changes=[
                migration.TextChange(
                    unit=unit, startOffset=e.start, endOffset=e.end, replacement=e.text, rule=rule, reason=_REASONS[rule],
                    step=migration.Step.code,
                )
                for e, rule in sorted(found[owner], key=lambda pair: pair[0].start)
            ],
        )  # fmt: skip


# ---- from wants to text changes

_LITERAL = re.compile(r"(0[xX][0-9a-fA-F]+|0[bB][01]+|\d+)([uU]?)([lL]*)")
_COMPOUND_FORMS = frozenset(["binary", "conditional", "assign", "compound"])


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
    lost: list[WidthRequirement] = []
    _casts: dict[TextPlace, _Cast] = {}
    _edits: dict[tuple[str, Replacement, str], None] = {}

    def edits(self) -> dict[str, list[tuple[Replacement, str]]]:
        """All changes: path of a unit -> replacements, each with its rule; of those at one place the outer ones come first."""
        for want in self.walk.wants:
            done = {
                WIDEN: self._widen,
                DEDUCED: self._widen,
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
                self._add(place.unit, Replacement(place.end, place.end, "))"), WIDEN)
                self._add(place.unit, Replacement(place.start, place.start, f"({zero} + ("), WIDEN)
                continue
            words = [(f"({_spelt(cast.number)})", WIDEN)] if cast.number is not None else []
            words += [("(uint8_t)", READ)] if cast.read else []
            if cast.enclosed:
                words[-1] = (words[-1][0] + "(", words[-1][1])
                self._add(place.unit, Replacement(place.end, place.end, ")"), words[-1][1])
            for word, rule in words:
                self._add(place.unit, Replacement(place.start, place.start, word), rule)
        found: dict[str, list[tuple[Replacement, str]]] = {}
        for unit, replacement, rule in self._edits:
            found.setdefault(unit, []).append((replacement, rule))
        return found

    def _add(self, unit: str, replacement: Replacement, rule: str) -> None:
        self._edits[unit, replacement, rule] = None

    def _slice(self, place: TextPlace) -> str:
        return self.texts[place.unit][place.start : place.end].decode("latin-1")

    def _widen(self, want: WidthRequirement) -> bool:
        number = want.number
        assert number is not None
        node = want.node
        if node.form == "literal" and node.inner:
            place = node.inner[0]
            match = _LITERAL.fullmatch(self._slice(place))
            if match is not None:
                letters = ("" if number.signed else match[2] or "U") + ("LL" if number.bits > 32 else "L")
                self._add(place.unit, Replacement(place.start, place.end, match[1] + letters), want.rule)
                return True
        place_ = self._place(node, {f"{number.bits} {number.signed} {k}" for k in ("number", "char", "character")}, number)
        if place_ is None:
            return False
        cast = self._cast(place_, node)
        cast.number = number
        return True

    def _read(self, want: WidthRequirement) -> bool:
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

    def _name(self, want: WidthRequirement) -> bool:
        place = next((p for p in want.node.inner if self._slice(p) == want.node.name), None)
        if place is None:
            return False
        self._add(place.unit, Replacement(place.start, place.end, want.text), NAME)
        return True

    def _text(self, want: WidthRequirement) -> bool:
        """Insert the length `l` for 32 bits into the conversions of a format."""
        written = want.node.text
        if want.text or "PRI" in written or "SCN" in written:
            return not want.text  # the target's own macros name its widths
        place = next((p for p in want.node.inner if self._slice(p) == written), None)
        if place is None:
            return False
        for offset in want.offsets:
            self._add(place.unit, Replacement(place.start + offset, place.start + offset, "l"), TEXT)
        return True

    def _order(self, want: WidthRequirement) -> bool:
        """Wrap a comparison function for `qsort` or `bsearch` in a lambda that reduces its 32-bit result to the sign."""
        place = next(iter(want.node.inner), None)
        if place is None or not self.lambdas or not re.fullmatch(r"&?\s*\w+", self._slice(place)):
            return False
        name = self._slice(place).lstrip("& \t\n")
        a, b, order = (f"{local}_" if local == name else local for local in ("a", "b", "order"))
        compared = f"int32_t {order} = {name}({a}, {b}); return ({order} > 0) - ({order} < 0);"
        text = f"[](const void *{a}, const void *{b}) -> int {{ {compared} }}"
        self._add(place.unit, Replacement(place.start, place.end, text), ORDER)
        return True

    def _shift(self, want: WidthRequirement) -> bool:
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
        self._add(whole.unit, Replacement(start, start + len(operator), written), SHIFT)
        if right.form in _COMPOUND_FORMS and not right.bracketed:
            self._add(whole.unit, Replacement(second.start, second.start, "("), SHIFT)
            self._add(whole.unit, Replacement(second.end, second.end, ")"), SHIFT)
        return True


def _plain(node: TypedExpression) -> bool:
    """Whether an expression has no side effects, so that it can be written twice."""
    if node.form in ("call", "assign", "compound") or node.operator in ("++", "--"):
        return False
    return all(_plain(child) for child in node.children)


def _spelt(number: Number | None) -> str:
    assert number is not None
    return f"{'' if number.signed else 'u'}int{number.bits}_t"
