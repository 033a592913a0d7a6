"""Finds the expressions that have to be written differently so that a narrower target computes what the source computes.

The rule: an operator that the source computes in n bits is computed in at least n bits with the same signedness; plain char is
read as unsigned where its value is widened. The walk goes from the operands up to the operators and tracks the type of each
expression on the target, assuming that the wants below it are met, so one pass is enough. `widths` turns a want into a
text change; types of declarations are in `queries.width_types`. Source: ISO/IEC 9899:1999, 6.3.1 and 6.5.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from msgspec import Struct

from robosmi.transformations.m2m.widths.width_formats import conversions, has_format, required_length
from robosmi.transformations.m2m.widths.width_requirements import DEDUCED, NAME, ORDER, READ, SHIFT, TEXT, WIDEN, WidthRequirement
from robosmi.transformations.queries.macros.macro_definitions import TextPlace
from robosmi.transformations.queries.numbers import COMPARISONS, Machine, Number
from robosmi.transformations.queries.typed import NumberKind, TypedExpression

_ARITHMETIC = frozenset(["+", "-", "*", "/", "%", "&", "|", "^"])
_TRUTH = Number(8, False)
_COMPOUND_FORMS = frozenset(["binary", "conditional", "assign", "compound"])


class Walk(Struct):
    """The walk over the typed expressions of a program.

    Attributes:
        here, there: the integer types of source and target.
        names: name of a standard function or macro with int in its type -> its wider counterpart.
        wants: what has to be written differently, in the order of the walk.
        seen: place in a macro's body or argument -> the kinds of values found there: one use may pass an int, another a float.
        handing: functions of the program that pass a format on to the standard library.
        changed: places that are assigned or whose address is taken, so that no cast can be written there.
        lambdas: how many lambdas and functions are around the place of the walk whose results take the types of what they return.
        resigned: whether plain char is signed on the target and unsigned on the source.
    """

    here: Machine
    there: Machine
    names: Mapping[str, str] = {}
    wants: list[WidthRequirement] = []
    seen: dict[TextPlace, set[str]] = {}
    changed: set[TextPlace] = set()
    handing: set[str] = set()
    lambdas: int = 0
    resigned: bool = False

    def __post_init__(self) -> None:
        self.resigned = self.there.char_signed and not self.here.char_signed

    def run(self, top: list[TypedExpression]) -> None:
        """Walk over the declarations of a unit."""
        for node in top:
            self.value(node)

    def value(self, node: TypedExpression) -> Number | None:
        """The type of an expression on the target after its conversion to what its context expects; None if it is no number."""
        rule = _RULES.get(node.form)
        number = rule(self, node) if rule is not None else self._others(node)
        for place in node.layers:
            self.seen.setdefault(place, set()).add(_seen_as(self.here, node))
        wanted = node.converted.number
        if self.resigned and wanted is not None and not node.converted.char and (wanted.real or wanted.bits > 8):
            return self._read(node, number)
        return number

    def _read(self, node: TypedExpression, number: Number | None) -> Number | None:
        """Want a plain char to be read as unsigned."""
        high = node.form == "character" and node.value is not None and 127 < node.value < 256
        if high or (node.kind.char and node.form != "character"):
            self.wants.append(WidthRequirement(READ, node))
            return Number(8, False)
        return number

    def widen(self, node: TypedExpression, number: Number) -> None:
        """Want an operand to be cast to a wider type."""
        self.wants.append(WidthRequirement(WIDEN, node, number))

    # ---- expressions without an operator

    def _others(self, node: TypedExpression) -> Number | None:
        for child in node.children:
            self.value(child)
        return node.kind.target

    def _literal(self, node: TypedExpression) -> Number | None:
        text = node.text.lower()
        suffix = text[len(text.rstrip("ul")) :]
        decimal = not (text.startswith("0") and len(text.rstrip("ul")) > 1)
        return self.there.constant(node.value, suffix, decimal=decimal) if node.value is not None else None

    def _character(self, node: TypedExpression) -> Number | None:
        if node.value is not None and not -128 <= node.value < 256:
            return self.there.integer
        return Number(8, self.there.char_signed)

    def _name(self, node: TypedExpression) -> Number | None:
        self._others(node)
        return node.kind.number if node.origin == "platform" else node.kind.target

    def _macro(self, node: TypedExpression) -> Number | None:
        if node.name in self.names:
            self.wants.append(WidthRequirement(NAME, node, text=self.names[node.name]))
            return node.kind.number
        return None

    def _member(self, node: TypedExpression) -> Number | None:
        self._others(node)
        declared = node.kind.target
        if node.bits < 0 or declared is None:
            return declared
        if node.bits < self.there.int_bits or (node.bits == self.there.int_bits and declared.signed):
            return self.there.integer
        return declared  # GCC keeps the type of one as wide as an unsigned int, too

    def _call(self, node: TypedExpression) -> Number | None:
        arguments = node.children[1:]
        if node.origin == "platform":
            self._arguments_of_adapter(node)
            return node.kind.number
        if node.children:
            self.value(node.children[0])
        numbers = [self.value(argument) for argument in arguments]
        for place in node.deduced:
            if place <= len(arguments):
                self._deduce(arguments[place - 1], numbers[place - 1])
        if node.fixed > 0 and (has_format(node.name) if node.origin == "standard" else node.name in self.handing):
            self._format(node, arguments, numbers)
        elif node.origin != "standard":
            first = node.fixed if node.fixed >= 0 else len(arguments)  # of what the parameters do not name
            for argument, number in zip(arguments[first:], numbers[first:], strict=True):
                passed = argument.converted.number
                if passed is not None and not passed.real and self._promoted(number) != passed:
                    self.widen(argument, passed)
        if node.origin != "standard":
            return node.kind.target
        if node.name in _ORDERED and len(arguments) > _ORDERED[node.name]:
            self.wants.append(WidthRequirement(ORDER, arguments[_ORDERED[node.name]]))
        if node.name in self.names and node.children:
            self.wants.append(WidthRequirement(NAME, node.children[0], text=self.names[node.name]))
            return node.kind.number
        return self.there.number(node.kind.base) if node.kind.base in _PLAIN else node.kind.target

    def _format(self, node: TypedExpression, arguments: list[TypedExpression], numbers: list[Number | None]) -> None:
        """Check a call's format and the arguments that it describes."""
        text, reads = arguments[node.fixed - 1], node.name.endswith("scanf")
        if text.form != "text":
            self.wants.append(WidthRequirement(TEXT, text, text="?"))
            return
        offsets = []
        given = zip(conversions(text.text, reads), arguments[node.fixed :], numbers[node.fixed :], strict=False)
        for conversion, argument, number in given:
            length, letter, offset = conversion
            if reads:
                wide = not length and letter in "diuxXo"
            else:
                sure = argument.form == "literal"
                wide, made = required_length(self.there, conversion, self._promoted(number), argument.converted.number, sure)
                if made is not None:
                    self.widen(argument, made)
            offsets += [offset] if wide else []
        if offsets:
            self.wants.append(WidthRequirement(TEXT, text, offsets=tuple(offsets)))

    def _arguments_of_adapter(self, node: TypedExpression) -> None:
        """Visit an adapter's arguments: those for `...` need no casts, since it expects the source's plain char there."""
        for place, argument in enumerate(node.children[1:]):
            if argument.kind.char and 0 <= node.fixed <= place:
                argument.converted = argument.kind
            self.value(argument)

    def _cast(self, node: TypedExpression) -> Number | None:
        number = node.kind.number
        for child in node.children:
            if self.resigned and number is not None and (number.real or number.bits > 8) and child.kind.number is not None:
                child.converted = node.kind
            self.value(child)
        return node.kind.target

    def _size(self, node: TypedExpression) -> Number | None:
        self._others(node)
        return Number(self.there.pointer_bits, False)

    def _declaration(self, node: TypedExpression) -> Number | None:
        for place, child in enumerate(node.children):
            number = self.value(child)
            if place in node.deduced:
                self._deduce(child, number)
        return node.kind.target

    def _lambda(self, node: TypedExpression) -> Number | None:
        self.lambdas += 1
        self._others(node)
        self.lambdas -= 1
        return None

    def _return(self, node: TypedExpression) -> Number | None:
        for child in node.children:
            number = self.value(child)
            if self.lambdas:
                self._deduce(child, number)
        return None

    def _deduce(self, node: TypedExpression, number: Number | None) -> None:
        """Want a narrower number to be cast whose type is taken by what gets it."""
        wanted = node.converted.number
        if number is None or wanted is None or wanted.real or node.kind.enumeration:
            return
        if number.bits < wanted.bits and wanted.bits >= self.here.int_bits:
            self.wants.append(WidthRequirement(DEDUCED, node, wanted))

    # ---- operators

    def _promoted(self, number: Number | None) -> Number | None:
        made = self.there.promoted(number) if number is not None else None
        return Number(made.bits, made.signed, made.real) if made is not None else None

    def _unary(self, node: TypedExpression) -> Number | None:
        if not node.children:
            return node.kind.target
        if node.operator == "!":
            _as_it_is(node.children)
        number = self.value(node.children[0])
        if node.operator in ("++", "--", "&"):
            self._assigned(node.children[0])
        if node.operator == "!":
            return _TRUTH
        if node.operator in ("+", "-", "~"):
            wanted = node.kind.number
            if wanted is not None and not wanted.real and self._promoted(number) != wanted:
                self.widen(node.children[0], wanted)
            return wanted
        return node.kind.target if node.operator != "&" else None

    def _assigned(self, node: TypedExpression) -> None:
        self.changed.update(node.layers)

    def _binary(self, node: TypedExpression) -> Number | None:
        if len(node.children) != 2:
            return self._others(node)
        if node.operator in ("&&", "||"):
            _as_it_is(node.children)
        left, right = (self.value(child) for child in node.children[:2])
        first, second = node.children[:2]
        if node.operator in ("&&", "||"):
            return _TRUTH
        if node.operator == ",":
            return right
        if node.operator in ("<<", ">>"):
            wanted = node.kind.number
            if wanted is not None and self._promoted(left) != wanted:
                self.widen(first, wanted)
            return wanted
        pointers = first.kind.pointer or second.kind.pointer
        if node.operator in COMPARISONS:
            if not pointers:
                self._agree(first.converted.number, (first, left), (second, right))
            return _TRUTH
        if pointers:
            return Number(self.there.pointer_bits, True) if node.kind.number is not None else None
        if node.operator in _ARITHMETIC:
            self._agree(node.kind.number, (first, left), (second, right))
        return node.kind.number

    def _agree(self, wanted: Number | None, *operands: tuple[TypedExpression, Number | None]) -> None:
        """Cast as few of two operands as needed so that their common type is the wanted one."""
        if wanted is None or wanted.real:
            return
        left, right = (number if number is not None else self.there.integer for _, number in operands)
        if self._computes(wanted, left, right):
            return
        able = [operand for operand, other in zip(operands, (right, left), strict=True) if self._computes(wanted, wanted, other)]
        if able:
            self.widen(min(able, key=lambda o: self._reluctance(o[0], o[1], wanted))[0], wanted)
        else:
            for operand, _ in operands:
                self.widen(operand, wanted)

    def _computes(self, wanted: Number, left: Number, right: Number) -> bool:
        common = self.there.common(left, right)
        return (common.bits, common.signed) == (wanted.bits, wanted.signed)

    def _reluctance(self, node: TypedExpression, number: Number | None, wanted: Number) -> tuple[bool, ...]:
        """Sort key for choosing which operand is cast: the smallest is preferred.

        An operand that has the wanted type on the source comes first, then a literal that can take a suffix, then narrow and
        simple ones.
        """
        here = _promoted_here(self.here, node) or wanted
        return (
            (here.bits, here.signed) != (wanted.bits, wanted.signed),
            node.form != "literal" or len(node.inner) != 1,
            number is not None and number.bits >= wanted.bits,
            node.form == "character",
            node.form in _COMPOUND_FORMS and not node.bracketed,
        )

    def _conditional(self, node: TypedExpression) -> Number | None:
        _as_it_is(node.children[:1])
        numbers = [self.value(child) for child in node.children]
        for place, child in enumerate(node.children):
            if child.form == "member" and child.bits >= 0:
                numbers[place] = child.kind.target  # GCC does not promote a bit-field there
        first, second = numbers[1:] if len(numbers) == 3 else (None, None)
        enumerations = {child.kind.enumeration for child in node.children[1:]}
        if first is not None and second is not None and len(enumerations) == 1 and enumerations != {""}:
            return max(
                first, second, key=lambda number: number.bits
            )  # a cast would make a number of it: no enumeration takes one
        if len(numbers) == 3 and node.kind.number is not None:
            self._agree(node.kind.number, (node.children[1], numbers[1]), (node.children[2], numbers[2]))
            return node.kind.number
        return node.kind.target

    def _index(self, node: TypedExpression) -> Number | None:
        for child in node.children:
            if child.kind.char:  # an index of type char is converted nowhere else
                child.converted = NumberKind(self.here.integer)
            self.value(child)
        return node.kind.target

    def _assign(self, node: TypedExpression) -> Number | None:
        numbers = [self.value(child) for child in node.children]
        if not numbers:
            return node.kind.target
        self._assigned(node.children[0])
        return numbers[0]

    def _compound(self, node: TypedExpression) -> Number | None:
        if len(node.children) != 2:
            return self._others(node)
        left, right = node.children[:2]
        first, second = self.value(left), self.value(right)
        self._assigned(left)
        declared, wanted = left.kind.number, right.converted.number
        if declared is None or declared.real or wanted is None or wanted.real:
            return first
        operator = node.operator[:-1]
        narrow = declared.bits < self.here.int_bits
        if operator in ("<<", ">>"):
            small = right.value is not None and 0 <= right.value < self.there.int_bits
            if narrow and not (small and (operator == "<<" or not left.kind.char or not self.resigned)):
                self.wants.append(WidthRequirement(SHIFT, node, self.here.promoted(declared), operator, right))
            return first
        if operator in ("/", "%") and left.kind.char and self.resigned:
            self.wants.append(WidthRequirement(SHIFT, node, wanted, operator, right))
            return first
        found = first if first is not None else self.there.integer
        common = self.there.common(found, second if second is not None else self.there.integer)
        if (common.bits, common.signed) != (wanted.bits, wanted.signed):
            self.widen(right, wanted)
        return first

    def _switch(self, node: TypedExpression) -> Number | None:
        if not node.children:
            return None
        for child in node.children[1:]:
            self.value(child)
        selector = node.children[0]
        number = self._promoted(self.value(selector))
        wanted = _promoted_here(self.here, selector)
        if number is not None and wanted is not None and number != wanted:
            values = [v for v in _cases(node.children[1:]) if v is not None]
            least, most = (0, 127) if selector.bits >= 0 else (number.least, number.most)  # a bit-field may be promoted or not
            if any(not least <= v <= most for v in values):
                self.widen(selector, Number(wanted.bits, wanted.signed))
        return None


def _as_it_is(nodes: list[TypedExpression]) -> None:
    """Mark operands that are only compared with zero: a plain char needs no cast there."""
    for node in nodes:
        if node.kind.char:
            node.converted = node.kind


_ORDERED = {"qsort": 3, "bsearch": 4}
"""Standard library functions that call a comparison function of the program, and the index of the argument that passes it."""
_PLAIN = frozenset(["int", "unsigned int"])


def _promoted_here(machine: Machine, node: TypedExpression) -> Number | None:
    """The type of an expression after integer promotion on the source."""
    number = node.kind.number
    if number is not None and 0 <= node.bits < machine.int_bits:
        return machine.integer
    return machine.promoted(number) if number is not None else None


def _seen_as(machine: Machine, node: TypedExpression) -> str:
    number = node.kind.number
    if number is None:
        return "pointer" if node.kind.pointer else "other"
    if number.real:
        return "real"
    promoted = _promoted_here(machine, node) or number
    char = "char" if node.kind.char else "character" if node.form == "character" and (node.value or 0) > 127 else "number"
    return f"{promoted.bits} {promoted.signed} {char}"


def _cases(nodes: list[TypedExpression]) -> Iterator[int | None]:
    """The case values of a switch, without those of switches nested in it."""
    for node in nodes:
        if node.form == "case":
            yield node.value
        if node.form != "switch":
            yield from _cases(node.children)


_RULES: dict[str, Callable[[Walk, TypedExpression], Number | None]] = {
    "literal": Walk._literal,
    "character": Walk._character,
    "name": Walk._name,
    "macro": Walk._macro,
    "member": Walk._member,
    "call": Walk._call,
    "cast": Walk._cast,
    "declaration": Walk._declaration,
    "lambda": Walk._lambda,
    "return": Walk._return,
    "size": Walk._size,
    "unary": Walk._unary,
    "index": Walk._index,
    "binary": Walk._binary,
    "conditional": Walk._conditional,
    "assign": Walk._assign,
    "compound": Walk._compound,
    "switch": Walk._switch,
}
