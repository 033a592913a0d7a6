"""The rules that find the places of a kind, one function each.

A rule gives a line and what stands there. Kinds without a rule of their own are found by `named`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from fnmatch import fnmatchcase

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.portability_facts import Chip, PlaceKind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.expression_type import field_of, of_use
from robosmi.transformations.queries.portability.analysed_program import AnalysedProgram, At
from robosmi.transformations.queries.portability.pin_origins import PinOrigin

Found = Iterator[tuple[At, str]]
Rule = Callable[[PlaceKind, AnalysedProgram], Found]
_BYTES = frozenset(["char", "signed char", "unsigned char", "bool", "int8_t", "uint8_t", "byte", "boolean"])
_INTS = frozenset(["int", "signed int", "signed", "unsigned int", "unsigned", "word", "size_t"])
_WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_VECTOR = re.compile(r"\(\s*(\w+)")
_WITHOUT_BITS = re.compile(r"(PORT|PIN|DDR)([A-L])")
_PIN_WORDS = frozenset(["pin", "pins"])


def named(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Uses of names, includes of headers, and declarations with types."""
    for number, view in enumerate(seen.views):
        for include in view.unit.includes:
            if _matches(str(include.header), kind.headers) and not _matches(str(include.header), kind.not_headers):
                yield At(view.unit, int(include.line)), str(include.header)
        for use in seen.names[number] if kind.names else ():
            if _matches(use.name, kind.names):
                yield At(view.unit, use.line), use.name
        for type_use in view.of_kind(ccode.TypeUse) if kind.types else ():
            holder = ancestor_of_kind(type_use, ccode.Located)
            object_ = not {"*", "&"}.intersection(str(type_use.spelling)) and not type_use.pointerDepth
            if holder is not None and object_ and kind_of_type(type_use) in kind.types:
                yield At(view.unit, int(holder.line)), kind_of_type(type_use)


def kind_of_type(use: ccode.TypeUse) -> str:
    """The name of a type without qualifiers, pointers and references."""
    words = str(use.spelling).replace("*", " ").replace("&", " ").split()
    return " ".join(word for word in words if word not in ("const", "volatile", "struct", "class"))


def _matches(name: str, patterns: tuple[str, ...]) -> bool:
    return any(fnmatchcase(name, pattern) for pattern in patterns)


def registers(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Registers that the other microcontroller lacks, or has for other pins."""
    names = frozenset(seen.facts.registers.get(kind.registers, ()))
    there = seen.facts.microcontrollers.get(seen.move.target.chip, Chip()).registers
    for number, view in enumerate(seen.views):
        for use in seen.names[number]:
            if use.name in names and not (use.name in there and _same_pins(use.name, seen)):
                yield At(view.unit, use.line), use.name


def _same_pins(register: str, seen: AnalysedProgram) -> bool:
    """Whether a register of a port has the same pins at its bits on both boards; true for all other registers."""
    match = _WITHOUT_BITS.fullmatch(register)
    if match is None:
        return True
    prefix = f"P{match[2]}"
    return _pins(prefix, seen.move.source.ports) == _pins(prefix, seen.move.target.ports)


def _pins(prefix: str, ports: Mapping[str, str]) -> dict[str, str]:
    return {port: label for port, label in ports.items() if port.startswith(prefix)}


def interrupt_vectors(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Interrupt functions for vectors that the other microcontroller lacks."""
    there = seen.facts.microcontrollers.get(seen.move.target.chip, Chip()).vectors
    for number, view in enumerate(seen.views):
        for use in seen.names[number]:
            vector = _VECTOR.search(use.text)
            if _matches(use.name, kind.names) and not (vector is not None and vector[1] in there):
                yield At(view.unit, use.line), vector[1] if vector is not None else use.name


def board_conditions(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Conditional directives that ask for a board or processor."""
    for view in seen.views:
        for each in view.unit.conditionals:
            name = next((word for word in re.findall(r"\w+", str(each.condition or "")) if _matches(word, kind.conditions)), "")
            if name:
                yield At(view.unit, int(each.line)), name


def board_numbers(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Numbers of the board, in directives and in the program."""
    found = dict.fromkeys([*board_conditions(kind, seen), *named(kind, seen)])
    yield from found


def calls_of_null(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Pointers to functions that are null, and that the program only calls."""
    for view in seen.views:
        for variable in view.of_kind(ccode.Variable):
            use, called = variable.valueType, [each for each in variable.references if _is_called(each)]
            is_function = use is not None and "(*" in str(use.spelling)
            if is_function and _is_null(variable.initializer) and called and len(called) == len(variable.references):
                yield At(view.unit, int(called[0].line)), str(variable.name)


def _is_called(reference: ccode.NameReference) -> bool:
    outer = reference.eContainer()
    return isinstance(outer, ccode.Call) and outer.calleeExpression is reference


def _is_null(value: Element | None) -> bool:
    named = isinstance(value, ccode.NameReference) and value.name in ("NULL", "nullptr")
    return named or (isinstance(value, ccode.IntegerLiteral) and not value.value)


def sizes_of_int(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """`sizeof(int)`, where int has another width."""
    if seen.move.source.int_bits == seen.move.target.int_bits:
        return
    for view in seen.views:
        for size in view.of_kind(ccode.SizeOf):
            spelling = str(size.measured.spelling) if size.measured is not None else ""
            if " ".join(spelling.split()) in _INTS:
                yield At(view.unit, int(size.line)), f"sizeof({spelling})"


def bytes_of_objects(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Objects that are copied, stored or sent as bytes, where their size or layout differs."""
    if seen.move.source.architecture == seen.move.target.architecture:
        return
    for view in seen.views:
        for call in view.of_kind(ccode.Call):
            if any(map(_has_layout, _objects_of(call, kind))):
                yield At(view.unit, int(call.line)), f"{call.calleeName}()"
        for cast in view.of_kind(ccode.Cast):
            inner = cast.operand
            of_object = (isinstance(inner, ccode.Unary) and inner.operator == "&") or _is_of_objects(inner)
            if inner is not None and of_object and cast.target is not None and is_of_bytes(cast.target) and _has_layout(inner):
                yield At(view.unit, int(cast.line)), f"the cast of {expression_text(inner)}"


def _objects_of(call: ccode.Call, kind: PlaceKind) -> list[ccode.Expression]:
    """The arguments whose bytes a call copies, or moves from or to the EEPROM."""
    arguments = list(call.arguments)
    if str(call.calleeName) in kind.functions:
        return arguments[:2]
    return arguments[1:] if str(call.calleeName) in kind.stores and _on_eeprom(call) else []


def _on_eeprom(call: ccode.Call) -> bool:
    callee = call.calleeExpression
    held = callee.object if isinstance(callee, ccode.Member) else None
    return isinstance(held, ccode.NameReference) and held.name == "EEPROM"


def is_of_bytes(use: ccode.TypeUse) -> bool:
    """Whether a type is a pointer to bytes."""
    return str(use.spelling).count("*") == 1 and kind_of_type(use) in _BYTES


def _is_of_objects(element: ccode.Expression | None) -> bool:
    """Whether an expression is an array, a row of one, or a pointer to what has another size or layout."""
    indexed = 0
    while isinstance(element, ccode.Index):
        element, indexed = element.array, indexed + 1
    held = field_of(element, {}) if isinstance(element, ccode.Member) else getattr(element, "target", None)
    use = held.valueType if isinstance(held, (ccode.Variable, ccode.Parameter, ccode.Field)) else None
    if use is None or str(use.arrayDims or "").count("[") > indexed:
        return use is not None
    kind = of_use(use)
    wider = kind is not None and (kind.base in _INTS or kind.base == "double" or isinstance(kind.declaration, ccode.Record))
    return wider and kind is not None and kind.depth == indexed + 1


def _has_layout(argument: ccode.Expression) -> bool:
    """Whether what an argument is, or points to, may have another size or layout; not so for bytes, and for what is not known."""
    while isinstance(argument, (ccode.Cast, ccode.Unary)) and argument.operand is not None:
        argument = argument.operand
    while isinstance(argument, ccode.Index) and argument.array is not None:
        argument = argument.array
    target = field_of(argument, {}) if isinstance(argument, ccode.Member) else getattr(argument, "target", None)
    use = target.valueType if isinstance(target, (ccode.Variable, ccode.Parameter, ccode.Field)) else None
    return use is not None and kind_of_type(use) not in _BYTES | {"void"} and "void" not in str(use.spelling).split()


def times_in_int(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """A variable of 16 bits that takes milliseconds or microseconds."""
    if seen.move.source.int_bits == seen.move.target.int_bits:
        return
    for view in seen.views:
        declared: list[ccode.Variable | ccode.Field] = [*view.of_kind(ccode.Variable), *view.of_kind(ccode.Field)]
        for variable in declared:
            if _in_int(variable.valueType) and _takes_time(variable.initializer, kind):
                yield At(view.unit, int(variable.line)), str(variable.name)
        for assignment in view.of_kind(ccode.Assignment):
            target = assignment.left.target if isinstance(assignment.left, ccode.NameReference) else None
            typed = target if isinstance(target, (ccode.Variable, ccode.Field, ccode.Parameter)) else None
            takes = assignment.operator == "=" and _takes_time(assignment.right, kind)
            if typed is not None and takes and _in_int(typed.valueType):
                yield At(view.unit, int(assignment.line)), str(typed.name)


def _in_int(use: ccode.TypeUse | None) -> bool:
    """Whether a variable has the width of int, which differs; int16_t has not."""
    return use is not None and kind_of_type(use) in _INTS and not use.arrayDims and not use.pointerDepth


def _takes_time(value: ccode.Expression | None, kind: PlaceKind) -> bool:
    if isinstance(value, ccode.Binary):
        return value.operator in ("+", "-") and (_takes_time(value.left, kind) != _takes_time(value.right, kind))
    if isinstance(value, ccode.Cast):
        return _takes_time(value.operand, kind)
    return isinstance(value, ccode.Call) and str(value.calleeName) in kind.functions


def interrupt_numbers(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Numbers of interrupts that mean another pin on the other board."""
    for view in seen.views:
        for call in _calls(view, kind):
            given = call.arguments[0]
            numbers = {value.number for value in view.values.of(given)}
            if None in numbers and seen.origins.is_result_of(given, view, "digitalPinToInterrupt"):
                continue
            if any(_other_interrupt(each, seen) for each in numbers):
                yield At(view.unit, int(call.line)), expression_text(given)


def _calls(view: CodeView, kind: PlaceKind) -> list[ccode.Call]:
    found = [call for call in view.of_kind(ccode.Call) if str(call.calleeName) in kind.functions and call.arguments]
    return [call for call in found if not isinstance(call.calleeExpression, ccode.Member)]


def _other_interrupt(number: int | None, seen: AnalysedProgram) -> bool:
    """Whether a number means another pin there; one that the text does not tell does so if any of the source's does."""
    here, there = seen.move.source.interrupts, seen.move.target.interrupts
    if number is None:
        return any(there.get(each) != pin for each, pin in here.items())
    return number not in here or here[number] != there.get(number)


def analog_numbers(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Channels of the converter in the place of pins, where the other board takes them for pins."""
    for view in seen.views:
        for call in _calls(view, kind):
            argument = call.arguments[0]
            if isinstance(argument, ccode.IntegerLiteral) and _other_channel(int(argument.value), seen):
                yield At(view.unit, int(call.line)), str(argument.value)


def _other_channel(number: int, seen: AnalysedProgram) -> bool:
    here, there = seen.move.source, seen.move.target
    is_channel = f"A{number}" in here.aliases
    return is_channel and here.architecture != there.architecture


def pins_as_analog_numbers(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Numbers that are those of analogue pins on the source board, and of other pins on the other board."""
    here, there = seen.move.source.numbers, seen.move.target.numbers
    analog = {number for number, label in here.items() if label.startswith("A") and there.get(number) != label}
    yield from ((at, str(origin.number)) for at, origin in _pin_numbers(analog, seen))


def analog_pins(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """Analogue pins that the other board does not have; the source board lacks them, too, where it is another than was said."""
    here, there = seen.move.source, seen.move.target
    for at, name in named(kind, seen):
        if name not in there.aliases:
            known = name in here.aliases
            yield at, name if known else f"{name}, and neither has {here.title}: give the board of this sketch with --from"


def pin_of_led(kind: PlaceKind, seen: AnalysedProgram) -> Found:
    """The number of the pin with the source board's LED, where the other board has it at another pin."""
    here, there = seen.move.source, seen.move.target
    numbers = {number for number, label in here.numbers.items() if label == here.led and there.numbers.get(number) != there.led}
    for at, origin in _pin_numbers(numbers, seen):
        parent = origin.at.eContainer()
        direct = isinstance(parent, ccode.Call) and str(parent.calleeName) in kind.functions
        if direct or _words_around(origin.at).intersection(kind.words):
            yield at, str(origin.number)


def _words_around(element: Element | None) -> set[str]:
    """The words in the names of what has a number: the constant, member or macro, or the class that is made with it."""
    while element is not None and not isinstance(element, (ccode.Statement, ccode.Function, ccode.SourceUnit)):
        name = element.className if isinstance(element, ccode.ConstructorCall) else getattr(element, "name", "")
        if isinstance(element, (ccode.Declaration, ccode.Macro, ccode.ConstructorCall)) and name:
            return {word.lower() for word in _WORDS.findall(str(name))}
        element = element.eContainer()
    return set()


def _pin_numbers(numbers: set[int], seen: AnalysedProgram) -> Iterator[tuple[At, PinOrigin]]:
    for origin in (*seen.pin_numbers, *_called_pins(seen)):
        at = seen.at(origin.at) if origin.number in numbers else None
        if at is not None:
            yield at, origin


def _called_pins(seen: AnalysedProgram) -> Iterator[PinOrigin]:
    """Constants that are called pins: what uses them may be a library that nobody knows."""
    for view in seen.views:
        for variable in view.of_kind(ccode.Variable):
            if _is_pin(str(variable.name)) and isinstance(variable.initializer, ccode.IntegerLiteral):
                yield PinOrigin(int(variable.initializer.value), variable.initializer)
        for macro in view.unit.macros:
            body = str(macro.body or "").strip("() ")
            if not macro.functionLike and _is_pin(str(macro.name)) and body.isdigit():
                yield PinOrigin(int(body), macro)


def _is_pin(name: str) -> bool:
    return any(word.lower() in _PIN_WORDS for word in _WORDS.findall(name))


RULES: dict[str, Rule] = {
    "port_register": registers,
    "timer_register": registers,
    "adc_register": registers,
    "other_register": registers,
    "isr_vector": interrupt_vectors,
    "call_of_null": calls_of_null,
    "sizeof_int": sizes_of_int,
    "bytes_of_object": bytes_of_objects,
    "int_time": times_in_int,
    "attach_interrupt_number": interrupt_numbers,
    "analog_pin_number": analog_numbers,
    "analog_pin_as_14_to_19": pins_as_analog_numbers,
    "analog_pin_above_A3": analog_pins,
    "pin_13": pin_of_led,
    "board_macro": board_conditions,
    "clock_macro": board_numbers,
    "pin_count": board_numbers,
}
"""Kind -> its rule."""
