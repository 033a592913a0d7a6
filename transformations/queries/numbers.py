"""In which integer type another machine computes an expression: C's conversions with that machine's widths and signedness.

A `Machine` is a platform's integer model; `Numbers` types a program as that machine's compiler does. Nothing is executed; an
expression whose type the model does not tell has none. Ranges of values are computed in `ranges`. Source: ISO/IEC 9899:1999,
6.3.1, 6.4.4.1; widths are data of the platforms.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import Any, TypeGuard

from msgspec import Struct

from robosmi.metamodels import ccode, platform
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.expression_type import FunctionType, ValueType, of_use, type_of

_FIXED = re.compile(r"(u?)int(?:_least|_fast)?(8|16|32|64)_t")
_WORD = re.compile(r"[A-Za-z_]\w*")
_CONSTANT = re.compile(r"(?<![\w.])(0[xX][0-9a-fA-F]+|0[bB][01]+|\d+)([uUlL]*)(?![\w.])")
_REAL = frozenset(["float", "double"])
COMPARISONS = frozenset(["<", ">", "<=", ">=", "==", "!="])
_TRUTHS = COMPARISONS | {"&&", "||"}


class Number(Struct, frozen=True):
    """An arithmetic type: its bits, whether it is signed, a floating type (`real`), of one width on all platforms (`fixed`)."""

    bits: int
    signed: bool
    real: bool = False
    fixed: bool = False

    @property
    def least(self) -> int:
        """The least value of an integer type."""
        return -(1 << (self.bits - 1)) if self.signed else 0

    @property
    def most(self) -> int:
        """The greatest value of an integer type."""
        return (1 << (self.bits - self.signed)) - 1


class Machine(Struct, frozen=True):
    """The integer model of a platform: bits of int, long and pointers, and whether plain char is signed."""

    int_bits: int
    long_bits: int
    pointer_bits: int
    char_signed: bool

    @staticmethod
    def of(model: platform.Platform) -> Machine:
        """The machine of a platform."""
        return Machine(int(model.intBits), int(model.longBits), int(model.pointerBits), bool(model.charSigned))

    @property
    def integer(self) -> Number:
        """The type int."""
        return Number(self.int_bits, True)

    def number(self, base: str) -> Number | None:
        """The arithmetic type of that name, such as `unsigned long` or `uint8_t`; None for any other name."""
        return _number(self, base)

    def promoted(self, number: Number) -> Number:
        """The type of an operand after integer promotion (C99 6.3.1.1)."""
        return self.integer if not number.real and number.bits < self.int_bits else number

    def constant(self, value: int, suffix: str, *, decimal: bool) -> Number:
        """The type of an integer constant by its value, suffix in lower case, and whether it is decimal (C99 6.4.4.1)."""
        unsigned = "u" in suffix
        for bits in [64] if "ll" in suffix else [self.int_bits, self.long_bits, 64]:
            if "l" in suffix and bits < self.long_bits:
                continue
            if not unsigned and value < 1 << (bits - 1):
                return Number(bits, True)
            if (unsigned or not decimal) and value < 1 << bits:
                return Number(bits, False)
        return Number(64, False)

    def enumeration(self, declared: ccode.Enumeration) -> Number:
        """The type to which values of an enumeration are promoted: the first that has them all (ISO/IEC 14882:2011, 4.5)."""
        values = [int(literal.value) for literal in declared.literals]
        least, most = min(values, default=0), max(values, default=0)
        types = (Number(bits, signed) for bits in (self.int_bits, self.long_bits, 64) for signed in (True, False))
        return next((each for each in types if each.least <= least and most <= each.most), Number(64, True))

    def common(self, left: Number, right: Number) -> Number:
        """The common type of two operands after the usual arithmetic conversions (C99 6.3.1.8)."""
        if left.real or right.real:
            return max((x for x in (left, right) if x.real), key=lambda x: x.bits)
        left, right = self.promoted(left), self.promoted(right)
        if left.bits == right.bits:
            return Number(left.bits, left.signed and right.signed)
        wide = max(left, right, key=lambda x: x.bits)
        return Number(wide.bits, wide.signed)


@lru_cache(maxsize=512)
def _number(machine: Machine, base: str) -> Number | None:
    fixed = _FIXED.fullmatch(base)
    if fixed:
        return Number(int(fixed[2]), not fixed[1], fixed=True)
    if base in ("size_t", "uintptr_t"):
        return Number(machine.pointer_bits, False)
    if base in ("bool", "_Bool"):
        return Number(8, False, fixed=True)
    words = base.split()
    if not words or not set(words) <= {"unsigned", "signed", "char", "short", "int", "long", "float", "double"}:
        return None
    if _REAL & set(words):
        return Number(32, True, real=True)
    if "char" in words:
        signed = "signed" in words or (machine.char_signed and "unsigned" not in words)
        return Number(8, signed, fixed=True)
    signed = "unsigned" not in words
    if "short" in words:
        return Number(16, signed, fixed=True)
    longs = words.count("long")
    return Number(machine.int_bits if not longs else machine.long_bits if longs == 1 else 64, signed, fixed=longs > 0)


class Numbers:
    """Computes the types of a program's expressions on a machine.

    Args:
        machine: the machine.
        functions: the types of functions that the program does not define, by name.
        symbols: name that the program does not declare -> its type on the machine.
        macros: name of an object-like macro of the program -> its text.
        aliases: type of the platform's headers -> the type of the language that it is.
        of_operands: macros of the platform whose result has the common type of their arguments.
        holders: what an expression names (`DeclaredUses`), for members of the object that a method is called for.
    """

    def __init__(
        self,
        machine: Machine,
        functions: Mapping[str, FunctionType],
        symbols: Mapping[str, str],
        macros: Mapping[str, str],
        aliases: Mapping[str, str] = MappingProxyType({}),
        of_operands: Collection[str] = (),
        holders: Callable[[ccode.Expression], Sequence[ccode.Variable | ccode.Parameter | ccode.Field]] | None = None,
    ) -> None:
        self.machine = machine
        self._holders = holders
        self._of_operands = of_operands
        self._aliases = aliases
        self.macros = macros
        self.functions = functions
        self.symbols = symbols
        self._known: dict[int, Number | None] = {}
        self._enumerations: dict[int, Number] = {}

    def of(self, expression: ccode.Expression | None) -> Number | None:
        """The arithmetic type of an expression; None where the model does not tell it or where it is none."""
        pending = [expression]
        while pending:  # operands first; no recursion, for expressions nest
            one = pending[-1]
            missing = [x for x in self._operands(one) if x is not None and id(x) not in self._known]
            if missing:
                pending += missing
                continue
            pending.pop()
            if id(one) not in self._known:
                self._known[id(one)] = self._rule(one)
        return self._known[id(expression)]

    def _rule(self, expression: ccode.Expression | None) -> Number | None:
        rule = _RULES.get(type(expression).__name__)
        return rule(self, expression) if rule is not None else self.typed(type_of(expression, self.functions))

    def joins_operands(self, expression: ccode.Expression | None) -> TypeGuard[ccode.Call]:
        """Whether an expression is the use of a macro of the platform whose result has the common type of its arguments."""
        if not isinstance(expression, ccode.Call) or str(expression.calleeName) not in self._of_operands:
            return False
        member = isinstance(expression.calleeExpression, ccode.Member)
        return not member and bool(expression.arguments) and (expression.callee is None or not expression.callee.definition)

    def _operands(self, expression: ccode.Expression | None) -> Sequence[ccode.Expression | None]:
        if isinstance(expression, ccode.NameReference):
            return (_initial_of_auto(expression.target),)
        return list(expression.arguments) if self.joins_operands(expression) else _operands(expression)

    def _called(self, call: ccode.Call) -> Number | None:
        if not self.joins_operands(call):
            return self.typed(type_of(call, self.functions))
        first, *others = map(self._given, call.arguments)
        found = self.machine.promoted(first) if first is not None else None
        for other in others:
            found = self.machine.common(found, other) if found is not None and other is not None else None
        return found

    def _member(self, member: ccode.Member) -> Number | None:
        kind = type_of(member, self.functions)
        if kind is not None or member.object is not None or self._holders is None:
            return self.typed(kind)
        found = {self.typed(of_use(field.valueType)) for field in self._holders(member)}
        return found.pop() if len(found) == 1 else None

    def _assigned(self, assignment: ccode.Assignment) -> Number | None:
        return self._given(assignment.left)

    def typed(self, kind: ValueType | None) -> Number | None:
        """The arithmetic type that a type is on this machine, an enumeration as it is promoted; None for any other type."""
        if kind is None or kind.depth or kind.function:
            return None
        if isinstance(kind.declaration, ccode.Enumeration):
            return self._promoted(kind.declaration)
        return self._plain(kind.base)

    def declared(self, use: ccode.TypeUse | None) -> Number | None:
        """The arithmetic type of a declaration, or of the elements of a declared array; None for any other."""
        if (initial := _initial_of_auto(use.eContainer() if use is not None else None)) is not None:
            return self.of(initial)
        kind = of_use(use)
        return self._plain(kind.base) if kind is not None and (kind.array or not kind.depth) else None

    def _plain(self, base: str) -> Number | None:
        return self.machine.number(self._aliases.get(base, base))

    def _given(self, operand: ccode.Expression | None) -> Number | None:
        return self._known.get(id(operand)) if operand is not None else None

    def _literal(self, literal: ccode.IntegerLiteral) -> Number | None:
        text = str(literal.text).lower()
        return self.machine.constant(int(literal.value), text[len(text.rstrip("ul")) :], decimal=literal.radix == 10)

    def _binary(self, binary: ccode.Binary) -> Number | None:
        operator, left, right = str(binary.operator), self._given(binary.left), self._given(binary.right)
        if operator in _TRUTHS:
            return self.machine.integer
        if operator == ",":
            return right
        if operator in ("<<", ">>"):
            return self.machine.promoted(left) if left is not None and not left.real else None
        return self.machine.common(left, right) if left is not None and right is not None else None

    def _unary(self, unary: ccode.Unary) -> Number | None:
        operator, operand = str(unary.operator), self._given(unary.operand)
        if operator == "!":
            return self.machine.integer
        if operator in ("+", "-", "~"):
            return self.machine.promoted(operand) if operand is not None else None
        return operand if operator in ("++", "--") else self.typed(type_of(unary, self.functions))

    def _conditional(self, choice: ccode.ConditionalExpression) -> Number | None:
        left, right = self._given(choice.whenTrue), self._given(choice.whenFalse)
        return self.machine.common(left, right) if left is not None and right is not None else None

    def _name(self, reference: ccode.NameReference) -> Number | None:
        target = reference.target
        if isinstance(target, ccode.EnumerationLiteral):
            owner, unit = target.eContainer(), ancestor_of_kind(target, ccode.SourceUnit)
            plain = self.machine.integer.least <= int(target.value) <= self.machine.integer.most
            if plain and (unit is None or unit.language == "C"):  # C99 6.7.2.2
                return self.machine.integer
            return self._promoted(owner) if isinstance(owner, ccode.Enumeration) else None
        if target is None and reference.name in self.macros:
            return self._macro(str(reference.name))
        if (initial := _initial_of_auto(target)) is not None:
            return self._given(initial)
        if target is None or isinstance(target, ccode.ExternalSymbol):
            return self.machine.number(self.symbols.get(str(reference.name), ""))
        return self.typed(type_of(reference, self.functions))

    def _promoted(self, declared: ccode.Enumeration) -> Number:
        if id(declared) not in self._enumerations:
            self._enumerations[id(declared)] = self.machine.enumeration(declared)
        return self._enumerations[id(declared)]

    def _macro(self, name: str) -> Number | None:
        """The type of a macro of integers: the widest of those in its text; None for any other macro."""
        pending, seen, found = [name], set[str](), self.machine.integer
        while pending:
            one = pending.pop()
            if one in seen:
                continue
            seen.add(one)
            text = self.macros.get(one)
            if text is None or any(c in text for c in "\"'.?[{&="):
                return None
            for constant in _CONSTANT.finditer(text):
                digits, suffix = constant[1], constant[2]
                base = 16 if digits[:2].lower() == "0x" else 2 if digits[:2].lower() == "0b" else 8 if digits[0] == "0" else 10
                value = int(digits, 10 if digits.strip("0") == "" else base)
                found = self.machine.common(found, self.machine.constant(value, suffix.lower(), decimal=base == 10))
            pending += _WORD.findall(_CONSTANT.sub(" ", text))
        return found


def _initial_of_auto(declared: Element | None) -> ccode.Expression | None:
    """What gives a variable its type that is declared as `auto`; None for any other declaration."""
    use = declared.valueType if isinstance(declared, ccode.Variable) else None
    is_auto = use is not None and str(use.spelling).replace("const", "").strip() == "auto"
    return declared.initializer if is_auto and isinstance(declared, ccode.Variable) else None


def _operands(expression: ccode.Expression | None) -> tuple[ccode.Expression | None, ...]:
    """The operands that an expression's type is computed from."""
    if isinstance(expression, ccode.Binary):
        return (expression.left, expression.right)
    if isinstance(expression, ccode.Unary):
        return (expression.operand,) if expression.operator != "*" else ()
    if isinstance(expression, ccode.Assignment):
        return (expression.left,)
    return (expression.whenTrue, expression.whenFalse) if isinstance(expression, ccode.ConditionalExpression) else ()


_RULES: dict[str, Callable[[Numbers, Any], Number | None]] = {
    "IntegerLiteral": Numbers._literal,
    "CharacterLiteral": lambda self, _: self.machine.integer,
    "FloatingLiteral": lambda self, _: Number(32, True, real=True),
    "SizeOf": lambda self, _: Number(self.machine.pointer_bits, False),
    "Binary": Numbers._binary,
    "Call": Numbers._called,
    "Unary": Numbers._unary,
    "Assignment": Numbers._assigned,
    "ConditionalExpression": Numbers._conditional,
    "Member": Numbers._member,
    "NameReference": Numbers._name,
}
