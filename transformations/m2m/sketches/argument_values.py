"""Arguments mean on the target what they mean on their own board: values that are recognised by their type, or bare numbers.

`write(0)` may be a byte or a text, `EEPROM.put(2, 500)` stores as many bytes as the value has, `println(round(x))` prints two
decimals where `round` is no macro, and the number of an interrupt's mode is another one on other cores.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.platform_model import split_parameters
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit, is_written
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constants.wrapped_values import WrappedValues
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.expression_type import type_of
from robosmi.transformations.queries.numbers import COMPARISONS
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
from robosmi.transformations.queries.portability.pin_origins import PinOrigins
from robosmi.transformations.queries.signature_text import parameter_type

_RULE = "argument-value"
_BY_VALUE = frozenset(["analogWrite", "attachInterrupt"])
"""Functions whose arguments have rules of their own."""
_OVERLOADED = frozenset(["print", "println"])
_DECIMALS = {"print": 1, "println": 1, "String": 1, "dtostrf": 2}
"""What makes text of a real number, its first argument -> the position of its decimals."""
_BASES = {"itoa": 2, "String": 1}
"""What makes text of an int -> the position of its base."""
_BASE_NAMES = {"HEX": 16, "OCT": 8, "BIN": 2, "DEC": 10}
_EXACT_DECIMALS = 6
"""A float has 7 digits: one before the point leaves so many behind it."""
_SEEDS = frozenset(["randomSeed", "srandom", "srand"])


def argument_values(sketch: MovedSketch) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of zeros that are written, of modes of interrupts, and of results that are whole numbers on the source board."""
    yield from _zeros(sketch)
    yield from _modes(sketch)
    yield from _whole_results(sketch)
    yield from _interrupts(sketch)
    yield from _equal_constants(sketch)
    if sketch.move.source.architecture != sketch.move.target.architecture:
        yield from _seeds(sketch)


def _seeds(sketch: MovedSketch) -> Iterator[PortabilityPlace]:
    """The constants from which random numbers start: on another core another sequence follows."""
    for view in sketch.views:
        own = {function.name for function in view.of_kind(ccode.Function) if function.body is not None}
        for call in (each for name in sorted(_SEEDS - own) for each in _called(view, name)):
            if _owner(call) or len(call.arguments) != 1:
                continue
            numbers = {value.number for value in view.values.of(call.arguments[0])}
            if numbers and None not in numbers:
                yield sketch.place("random_sequence", call, f"{call.calleeName}({expression_text(call.arguments[0])})")


def _decimals(sketch: MovedSketch, values: WrappedValues) -> Iterator[PortabilityPlace]:
    """The texts of real numbers with more decimals than a float has, which is what a double is on AVR."""
    for view in sketch.views:
        for given, decimals in _written_numbers(view, _DECIMALS):
            kind = values.number(given)
            if kind is not None and kind.real and any(each is not None and each > _EXACT_DECIMALS for each in decimals):
                yield sketch.place("real_digits", given, expression_text(given))


def _digits(sketch: MovedSketch, values: WrappedValues) -> Iterator[SketchEdit]:
    """The edits of ints that are written to a base other than 10: a negative one has as many digits as an int there."""
    bits = values.here.int_bits
    for view in sketch.views:
        for given, bases in _written_numbers(view, _BASES):
            if not {None, 10}.intersection(bases) and is_written(view, given) and values.may_be_negative(given):
                start, end = int(given.startOffset), int(given.endOffset)
                reason = f"its digits are those of {bits} bits on its own board"
                yield SketchEdit(given, _RULE, reason, (inserted(start, f"(uint{bits}_t)("), inserted(end, ")")))


def _written_numbers(view: CodeView, positions: Mapping[str, int]) -> Iterator[tuple[ccode.Expression, set[int | None]]]:
    """The numbers that calls make text of, and the values of the argument at a position, which says how."""
    made = [(str(each.calleeName), list(each.arguments)) for each in view.of_kind(ccode.Call)]
    made += [(str(each.className), list(each.arguments)) for each in view.of_kind(ccode.ConstructorCall)]
    for name, arguments in made:
        if name in positions and positions[name] < len(arguments):
            how = arguments[positions[name]]
            known = _BASE_NAMES.get(str(how.name)) if isinstance(how, ccode.NameReference) else None
            yield arguments[0], {known} if known else {each.number for each in view.values.of(how)}


def _zeros(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of the arguments of `write` that are a literal 0, or a macro for it."""
    objects = frozenset(sketch.facts.writes_bytes)
    zeros = {str(macro.name) for view in sketch.views for macro in view.unit.macros if _is_zero(str(macro.body or ""))}
    for view in sketch.views if objects else ():
        for call in _called(view, "write"):
            if _owner(call) not in objects or len(call.arguments) != 1:
                continue
            given = call.arguments[0]
            literal = isinstance(given, ccode.IntegerLiteral) and not given.value
            if literal or (isinstance(given, ccode.NameReference) and given.name in zeros):
                reason = "0 is the byte here, and no text"
                yield SketchEdit(given, "zero-byte", reason, (inserted(int(given.startOffset), "(uint8_t)"),))


def _modes(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of the modes of interrupts that are written as a number: another core has other numbers."""
    modes = sketch.facts.interrupt_modes
    for view in sketch.views if modes else ():
        for call in _called(view, "attachInterrupt"):
            given = call.arguments[2] if len(call.arguments) > 2 and not _owner(call) else None
            if isinstance(given, ccode.IntegerLiteral) and 0 <= int(given.value) < len(modes):
                change = Replacement(int(given.startOffset), int(given.endOffset), modes[int(given.value)])
                yield SketchEdit(given, _RULE, f"{given.value} is this mode on its own board", (change,))


def _interrupts(sketch: MovedSketch) -> Iterator[PortabilityPlace]:
    """The numbers of interrupts that are those of the same pins there: they are wrong where a port gets another pin."""
    here, there, origins = sketch.move.source.interrupts, sketch.move.target.interrupts, PinOrigins(sketch.views)
    for view in sketch.views:
        for call in (each for name in ("attachInterrupt", "detachInterrupt") for each in _called(view, name)):
            if _owner(call) or not call.arguments or origins.is_result_of(call.arguments[0], view, "digitalPinToInterrupt"):
                continue
            numbers = {value.number for value in view.values.of(call.arguments[0])}
            same = [pin for number, pin in here.items() if pin == there.get(number) and numbers & {None, number}]
            if same:
                told = sketch.place("interrupt_of_port", call, ", ".join(same))
                yield replace(told, name=f"{expression_text(call.arguments[0])}: {told.name}")


def _whole_results(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of calls that give a whole number on the source board only, where what takes the result does not convert it."""
    for name in sketch.facts.real_results:
        for view in sketch.views:
            own = [function for function in view.of_kind(ccode.Function) if function.name == name]
            for call in _called(view, name) if not own else ():
                if not _owner(call) and not _converts(call):
                    reason = f"'{name}' gives a whole number on its own board"
                    yield SketchEdit(call, _RULE, reason, (inserted(int(call.startOffset), "(long)"),))


def _equal_constants(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of constants that a float is compared with for equality: on AVR each double is a float.

    A float never equals a double such as 0.1, which no float is.
    """
    if sketch.move.source.int_bits >= sketch.move.target.int_bits:
        return
    macros = {str(macro.name): str(macro.body or "").strip("() ") for view in sketch.views for macro in view.unit.macros}
    for view in sketch.views:
        for equality in view.of_kind(ccode.Binary):
            if equality.operator not in ("==", "!="):
                continue
            for given, other in ((equality.left, equality.right), (equality.right, equality.left)):
                kind = type_of(other, {}) if _is_between_floats(given, macros) else None
                if given is not None and kind is not None and kind.base == "float" and not kind.depth and is_written(view, given):
                    reason = "the constant is a float on its own board"
                    yield SketchEdit(given, _RULE, reason, (inserted(int(given.startOffset), "(float)"),))


def _is_between_floats(constant: ccode.Expression | None, macros: Mapping[str, str]) -> bool:
    """Whether a constant, or a macro for one, has a value that no float has."""
    number = constant.operand if isinstance(constant, ccode.Unary) and constant.operator in ("-", "+") else constant
    text = str(number.text) if isinstance(number, ccode.FloatingLiteral) else ""
    if isinstance(number, ccode.NameReference) and number.target is None:
        text = macros.get(str(number.name), "")
    try:
        value = float(text)
        (nearest,) = struct.unpack("f", struct.pack("f", value))
        return bool(nearest != value)
    except (ValueError, OverflowError):
        return False


def _converts(call: ccode.Call) -> bool:
    """Whether what takes a result gives the same for a whole number and for a real one that has its value."""
    outer = call.eContainer()
    if isinstance(outer, ccode.Binary):
        other = outer.right if outer.left is call else outer.left
        return outer.operator in COMPARISONS or isinstance(other, ccode.FloatingLiteral)
    if isinstance(outer, ccode.Call) and str(outer.calleeName) not in _OVERLOADED:
        at = next((number for number, argument in enumerate(outer.arguments) if argument is call), -1)
        known = outer.callee.parameters if outer.callee is not None else ()
        return 0 <= at < len(known)
    plain = isinstance(outer, ccode.Assignment) and outer.operator == "="
    return plain or isinstance(outer, (ccode.Variable, ccode.Cast, ccode.Return, ccode.Index, ccode.ExpressionStatement))


def stored_values(sketch: MovedSketch, values: WrappedValues) -> Iterator[SketchEdit]:
    """The edits of values without a variable that are stored in the EEPROM, which takes as many bytes as their type has.

    The types of variables change where they are declared (`object_bytes`).
    """
    if "EEPROMClass" not in sketch.facts.methods:
        return
    for view in sketch.views:
        for call in _called(view, "put"):
            given = call.arguments[1] if len(call.arguments) == 2 and _owner(call) == "EEPROM" else None
            kind = _type_there(given, values)
            if given is not None and kind:
                start, end = int(given.startOffset), int(given.endOffset)
                reason = "it is stored in the bytes that it has on its own board"
                yield SketchEdit(given, _RULE, reason, (inserted(start, f"({kind})("), inserted(end, ")")))


def taken_values(sketch: MovedSketch, values: WrappedValues) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of arguments that the platform takes in 16 bits on the source board, and of digits; values of no pulse width."""
    bits = values.here.int_bits
    yield from _decimals(sketch, values)
    yield from _digits(sketch, values)
    for view in sketch.views:
        for called in view.called().values():
            entry = called.entry
            taken = split_parameters(entry.parameters) if entry is not None and entry.kind == "function" else []
            numbers = [values.here.number(parameter_type(each)) for each in taken]
            for call in called.calls if called.name not in _BY_VALUE else ():
                if call.viaMacro or isinstance(call.calleeExpression, ccode.Member):
                    continue
                for argument, number in zip(call.arguments, numbers, strict=False):
                    if number is None or number.real or number.fixed or number.bits != bits:
                        continue
                    of = values.number(argument)
                    wraps = of is not None and not of.real and of.bits == bits and values.exceeds(argument, of)
                    if not wraps and not values.cuts(argument, number):
                        continue
                    reason = f"'{call.calleeName}' takes {bits} bits on its own board"
                    start, end = int(argument.startOffset), int(argument.endOffset)
                    cut = f"({'' if number.signed else 'u'}int{bits}_t)("
                    yield SketchEdit(argument, _RULE, reason, (inserted(start, cut), inserted(end, ")")))
        for call in _called(view, "analogWrite"):
            given = call.arguments[1] if len(call.arguments) > 1 else None
            found = values.range_of(given)
            if found is not None and found.given and not found.within(0, 255):
                yield sketch.place("pwm_value", call, expression_text(given))


def _type_there(given: ccode.Expression | None, values: WrappedValues) -> str:
    """The type that gives a value its own size; empty for one that has it, and for variables."""
    place = given
    while isinstance(place, (ccode.Index, ccode.Member)):
        place = place.array if isinstance(place, ccode.Index) else place.object
    if isinstance(place, ccode.NameReference) and isinstance(place.target, (ccode.Variable, ccode.Parameter, ccode.Field)):
        return ""
    if isinstance(given, ccode.CharacterLiteral):  # a char, other than in C
        return ""
    number = values.number(given)
    if isinstance(given, ccode.FloatingLiteral) or (number is not None and number.real):
        return "float"
    bits = values.here.int_bits
    if number is None or number.fixed or number.bits != bits:
        return ""
    return f"{'' if number.signed else 'u'}int{bits}_t"


def _called(view: CodeView, name: str) -> Sequence[ccode.Call]:
    return [call for call in view.of_kind(ccode.Call) if call.calleeName == name and not call.viaMacro]


def _owner(call: ccode.Call) -> str:
    """The object whose method is called; empty for a function."""
    member = call.calleeExpression
    owner = member.object if isinstance(member, ccode.Member) else None
    return str(owner.name) if isinstance(owner, ccode.NameReference) else ""


def _is_zero(body: str) -> bool:
    try:
        return not int(body.strip("() "), 0)
    except ValueError:
        return False
