"""Text changes that bind ports: a port's number is replaced by its pin, or calls look up the pin at run time; never both.

Which of the two is decided by the program's data flow (`queries.ports.port_flows`). A replaced number is a change of the port's
binding, a look-up one of the flow. A number that is on no pin of the target becomes an invalid pin, never another port's.

A call inside a macro whose port cannot be looked up would drive another pin of the target, so it gets an invalid pin. Neither
the macro's text nor its use belongs to the port alone. So around the use a macro with the function's name passes no pin; the
preprocessor meets it when it has expanded the use. RS335 reports that such calls do nothing yet.

Writes and reads of port registers become calls for the pins that their bits are bound to, one for each bit
(`change_registers`). A statement changes only if all its pins are bound. What it does with other bits of the register is
nothing that the program uses. A value that calls something, or reads a register itself, is computed once.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_of_kind
from robosmi.transformations.knowledge.platforms.board_pins import CHANNEL, BoardPins
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.value_flows import PinArgument, PortPlace
from robosmi.transformations.queries.macros.tokens import name_tokens
from robosmi.transformations.queries.names import named_type
from robosmi.transformations.queries.plans.port_pins import NO_PIN, UNBOUND, bound_pin, text_in_place
from robosmi.transformations.queries.plans.retained_pins import AS_WRITTEN, OF_INTERRUPT, RetainedPins
from robosmi.transformations.queries.ports.port_statements import (
    HIGH,
    HIGH_IF,
    INPUT,
    IS_CLEAR,
    IS_SET,
    LEVEL,
    LOW,
    LOW_IF,
    OUTPUT,
    PULL_UP,
    READ,
    TOGGLE,
    TOGGLE_IF,
    VALUE,
    WAIT_CLEAR,
    WAIT_SET,
    PinStep,
    PortStatement,
    is_pure,
    port_statements,
)  # fmt: skip
from robosmi.transformations.queries.ports.ports import FlowPorts, ProgramPorts
from robosmi.transformations.queries.ports.register_idioms import CHANGE, CONVERT, idiom_statements
from robosmi.transformations.queries.ports.register_values import register_value
from robosmi.transformations.queries.ports.timer_outputs import ATTACH, PULSE, PWM
from robosmi.transformations.queries.values import Value

RULE = "port"
"""Id of the rule that replaces a port's number by a pin."""
MOVES = frozenset({RULE, AS_WRITTEN, OF_INTERRUPT})
"""Ids of the rules of the places where a port's number is written."""
BY_REGISTER = "port-register"
"""Id of the rule that replaces a statement about a register (`change_registers`)."""
LOOK_UP = "port-look-up"
"""Id of the rule that looks up a port's pin where the port is passed to a platform function."""
OWN_NUMBER = "number-of-source"
"""Id of the rule that writes a constant of the source board as the number that it is there."""
SAME_NUMBERS = "its numbers mean the same pins on the target"
"""The reason of a flow whose numbers stay, and are not looked up."""
NEXT = "enumerator-after-port"
"""Id of the rule that keeps the value of an enumerator that follows a replaced one."""
_NAME = re.compile(r"[A-Za-z_]\w*")
_IN_WORD = re.compile(rb"\w\w")
_REASONS = 4

_CALLS = {
    HIGH: "digitalWrite({pin}, HIGH)", LOW: "digitalWrite({pin}, LOW)", TOGGLE: "digitalWrite({pin}, !digitalRead({pin}))",
    OUTPUT: "pinMode({pin}, OUTPUT)", INPUT: "pinMode({pin}, INPUT)", PULL_UP: "pinMode({pin}, INPUT_PULLUP)",
    CHANGE: "attachInterrupt(digitalPinToInterrupt({pin}), {handler}, CHANGE)", CONVERT: "analogRead({pin})",
    VALUE: "digitalWrite({pin}, {value} >> {bit} & 1)", LEVEL: "digitalWrite({pin}, {value} ? HIGH : LOW)",
    HIGH_IF: "if ({value} >> {bit} & 1) digitalWrite({pin}, HIGH)",
    LOW_IF: "if (!({value} >> {bit} & 1)) digitalWrite({pin}, LOW)",
    TOGGLE_IF: "if ({value} >> {bit} & 1) digitalWrite({pin}, !digitalRead({pin}))",
    READ: "(digitalRead({pin}) << {bit})", IS_SET: "digitalRead({pin})", IS_CLEAR: "!digitalRead({pin})",
    WAIT_SET: "do {} while (!digitalRead({pin}))", WAIT_CLEAR: "do {} while (digitalRead({pin}))",
    PWM: "analogWrite({pin}, {value})", PULSE: "{handler}.writeMicroseconds({value})",
    ATTACH: "{handler}.attach({pin}, 200, 3000{value})",  # any pulse that the library can make, and the first one
}  # fmt: skip
_ONCE = frozenset([HIGH_IF, LOW_IF, TOGGLE_IF])
"""What is a statement, and no expression."""
_OF_TIMER = frozenset([PWM, PULSE, ATTACH])
_SHIFT = re.compile(r"\b_BV(?=\s*\()")


def port_changes(
    ports: ProgramPorts,
    bindings: Sequence[migration.PortBinding],
    sources: Mapping[str, bytes],
    *,
    arrays: bool = False,
    kept: RetainedPins | None = None,
) -> list[migration.PortFlow]:
    """Make the flows of a plan, and the text changes of flows and bindings.

    A flow without a number, such as the parameter of a function that is never called, is included: its calls were considered.

    Args:
        ports: the program's ports.
        bindings: the decision for each port; their changes are set here.
        sources: path of a unit -> its bytes.
        arrays: whether the target has a helper that looks up arrays of ports.
        kept: the pins of both boards for a program whose platform stays; None for any other.
    """
    numbers = {b.sourcePin: b for b in bindings if b.sourcePin >= 0 and b.origin != "convention"}
    for binding in bindings:
        binding.changes.clear()
    found, number = [], 1
    shut = disabled_pins([argument for each in ports.flows for argument in each.flow.arguments], sources)
    moved = {id(place.element) for each in ports.flows if each.moved for place in each.flow.places}
    for each in ports.flows:
        if each.moved:
            for place in _distinct(each.flow.places):
                if place.value in numbers:
                    following = _next(place, moved, sources) if kept is None else []
                    changed = [_moved(place, numbers[place.value], sources, kept), *following]
                    numbers[place.value].changes.extend(changed)
            changes: list[migration.TextChange] = []
        elif kept is not None and (_alike(each, numbers, kept) or _same_channels(each, numbers, sources, kept)):
            each.flow.kept.insert(0, SAME_NUMBERS)
            changes = []
        else:
            changes = list(_own_numbers(each, sources, kept)) if kept is not None else []
            looked: set[tuple[str, int, int]] = set()
            for argument, known in zip(each.flow.arguments, each.values, strict=True):
                changes += shut.pop(id(argument.call), []) if argument.unplaced else []
                at = (str(argument.unit.path), argument.start, argument.end)
                if _is_torn(sources[at[0]], argument.start, argument.end):
                    continue  # a macro that is passed to another makes the call, and its own text is looked up
                if _asks(argument, known) and at not in looked:
                    looked.add(at)  # several functions may be given the same argument of a macro
                    around = _around(argument, sources, number, arrays)
                    number += argument.parameter.number is not None
                    changes += _look_up(argument, around) if around is not None else []
                    left = [f"'{argument.function}' looks up the numbers of its array itself"] if around is None else []
                    each.flow.kept[:0] = [text for text in left if text not in each.flow.kept]
        if each.numbers or changes or any(True for _ in each.calls):
            found.append(_flow(each, changes, numbers))
    return found


def _own_numbers(each: FlowPorts, sources: Mapping[str, bytes], kept: RetainedPins) -> Iterator[migration.TextChange]:
    """Write the numbers of the source board in the place of its constants, where they get into a flow that is looked up."""
    ranges = [(unit, int(e.startOffset), int(e.endOffset)) for unit, e in (*each.flow.calculated, *each.flow.given)]
    ranges += [(place.unit, place.start, place.end) for place in each.flow.places]
    done: set[tuple[str, int]] = set()
    for unit, start, end in ranges:
        for first, last, name in name_tokens(sources[unit.path][start:end]):
            number, at = kept.constants.get(name), (str(unit.path), start + first)
            if number is None or at in done:
                continue
            done.add(at)
            yield migration.TextChange(
                unit=unit, startOffset=at[1], endOffset=start + last, replacement=str(number), rule=OWN_NUMBER,
                reason=f"{name} is {number} on the board of the sketch, and is looked up by that", step=migration.Step.hardware,
            )  # fmt: skip


def _alike(each: FlowPorts, numbers: Mapping[int, migration.PortBinding], kept: RetainedPins) -> bool:
    """Whether all numbers that a flow can have mean the pins that their ports are bound to."""
    labels = kept.target.labels
    bound = [(n, bound_pin(numbers[n])) for n in each.numbers if n in numbers]
    same = all(pin is not None and labels.get(number) == pin.label for number, pin in bound)
    return same and (not each.anything or all(labels.get(n) == label for n, label in kept.source.labels.items()))


def _same_channels(
    each: FlowPorts, numbers: Mapping[int, migration.PortBinding], sources: Mapping[str, bytes], kept: RetainedPins
) -> bool:
    """Whether all numbers of a flow are written as channels, which are those of the bound pins on the target, too."""
    flow, here, there = each.flow, kept.source, kept.target
    if not kept.alike or each.anything or flow.computed or flow.calculated or not each.numbers or not each.written:
        return False
    if any(argument.parameter.numbering != CHANNEL or argument.given is None for argument in flow.arguments):
        return False
    bound = {number: bound_pin(numbers[number]) for number in each.numbers if number in numbers}
    labels = {number: pin.label for number, pin in bound.items() if pin is not None}
    if not set(each.numbers) <= set(labels):
        return False
    same = {channel for channel, n in here.channels.items() if n in labels and _on_channel(there, channel) == labels[n]}
    texts = [(place, sources[place.unit.path][place.start : place.end]) for place in flow.places]
    as_written = (replacement(numbers[p.value], text, kept)[0] == AS_WRITTEN for p, text in texts if p.value in numbers)
    return set(each.written) <= same and all(place.value in labels for place, _ in texts) and all(as_written)


def _on_channel(board: BoardPins, channel: int) -> str | None:
    return board.labels.get(board.channels.get(channel, -1))


def explicit_enumerators(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> None:
    """Give enumerators that follow a moved one their values, in a plan whose platform stays.

    Args:
        plan: the plan with the changes of its ports.
        sources: path of a unit -> its bytes.
    """
    at = {
        (str(change.unit.path), int(change.startOffset)): (binding, change)
        for binding in plan.portBindings
        for change in binding.changes
        if change.unit is not None and change.rule in MOVES
    }
    for binding in plan.portBindings:
        for old in [change for change in binding.changes if change.rule == NEXT]:
            binding.changes.remove(old)
    for unit in plan.program.units if plan.program is not None and at else ():
        text = sources[unit.path]
        for enumeration in all_of_kind(unit, ccode.Enumeration):
            before: migration.PortBinding | None = None
            for literal in enumeration.literals:
                start, end = int(literal.startOffset), int(literal.endOffset)
                own, implicit = at.get((str(unit.path), start)), b"=" not in text[start:end]
                if own is not None and (own[1].rule != AS_WRITTEN or (implicit and before is not None)):
                    before, change = own
                    pin = bound_pin(before)
                    if change.rule == AS_WRITTEN and pin is not None:
                        change.rule, change.replacement = RULE, f"{literal.name} = {pin_literal(pin)}"
                elif own is None and implicit and before is not None:
                    before.changes.append(
                        migration.TextChange(
                            unit=unit, startOffset=end, endOffset=end, replacement=f" = {int(literal.value)}", rule=NEXT,
                            reason="its value was one more than that of the one before", step=migration.Step.hardware,
                        )
                    )  # fmt: skip
                    before = None
                else:
                    before = None


def looked_up(ports: ProgramPorts) -> list[str]:
    """The names of the look-up helpers that the program's calls need: `port` for single ports, `ports` for arrays."""
    asked = [
        "port" if argument.parameter.number is None else "ports"
        for each in ports.flows
        if not each.moved
        for argument, known in zip(each.flow.arguments, each.values, strict=True)
        if _asks(argument, known)
    ]
    return sorted(set(asked))


def _flow(
    each: FlowPorts, changes: list[migration.TextChange], numbers: Mapping[int, migration.PortBinding]
) -> migration.PortFlow:
    first = each.flow.arguments[0]
    names = list(dict.fromkeys(p.name for p in each.flow.places if p.name))[:3]
    why = each.flow.kept[:_REASONS] if not each.moved else ["only platform functions use its numbers, as pins"]
    return migration.PortFlow(
        name=", ".join(names) or f"{first.function} {_where(first)}",
        choice="target" if each.moved else "source",
        chosenBy=migration.ChosenBy.rule,
        confidence=1.0,
        evidence=why,
        anything=each.anything and bool(each.numbers or changes or any(argument.unplaced for argument in each.flow.arguments)),
        bindings=[numbers[n] for n in each.numbers if n in numbers],
        calls=list({id(call): call for call in each.calls}.values()),
        changes=changes,
    )


def _where(argument: PinArgument) -> str:
    """The place of a call that takes a pin: its line, or the macro whose body contains it."""
    taker = argument.call if argument.call is not None else argument.construction
    macros = [m for m in argument.unit.macros if m.startOffset <= argument.start < m.endOffset] if taker is None else []
    line = taker.line if taker is not None else 0
    return f"in the macro '{macros[0].name}'" if macros else f"in line {line}"


def _distinct(places: Sequence[PortPlace]) -> Iterator[PortPlace]:
    seen = set()
    for place in places:
        key = (place.unit.path, place.start)
        if key not in seen:
            seen.add(key)
            yield place


def _moved(
    place: PortPlace, binding: migration.PortBinding, sources: Mapping[str, bytes], kept: RetainedPins | None
) -> migration.TextChange:
    original = sources[place.unit.path][place.start : place.end]
    rule, text = replacement(binding, original, kept)
    start = place.start
    if kept is None and (name := _NAME.match(original.decode("utf-8", errors="replace"))) is not None:
        start, text = start + len(name[0].encode()), text.removeprefix(name[0])  # another rule may change the name
    return migration.TextChange(
        unit=place.unit, startOffset=start, endOffset=place.end, replacement=text,
        rule=rule, reason=f"{binding.name} is {binding.choice or 'not bound'} on the target", step=migration.Step.hardware,
    )  # fmt: skip


def _next(place: PortPlace, moved: set[int], sources: Mapping[str, bytes]) -> list[migration.TextChange]:
    """The change that gives an enumerator an explicit value if its value followed from a replaced one."""
    literal = place.element
    owner = literal.eContainer() if isinstance(literal, ccode.EnumerationLiteral) else None
    if not isinstance(literal, ccode.EnumerationLiteral) or not isinstance(owner, ccode.Enumeration):
        return []
    following = list(owner.literals)[list(owner.literals).index(literal) + 1 :][:1]
    text = sources[place.unit.path]
    if not following or id(following[0]) in moved or b"=" in text[following[0].startOffset : following[0].endOffset]:
        return []
    at, value = int(following[0].endOffset), int(following[0].value)
    return [
        migration.TextChange(
            unit=place.unit, startOffset=at, endOffset=at, replacement=f" = {value}", rule=NEXT,
            reason=f"its value was one more than that of {place.name}", step=migration.Step.hardware,
        )
    ]  # fmt: skip


def replacement(binding: migration.PortBinding, original: bytes, kept: RetainedPins | None) -> tuple[str, str]:
    """The rule and the text of the change of a port's number; an enumerator keeps its name."""
    value, given, pin = text_in_place(binding), original.decode("utf-8", errors="replace"), bound_pin(binding)
    if kept is not None and pin is not None:
        return kept.written(binding, pin, given)
    name = _NAME.match(given)
    if kept is not None and name is not None and name[0] in kept.source.names:
        return RULE, value
    return RULE, f"{name[0]} = {value}" if name is not None else value


def _asks(argument: PinArgument, known: Sequence[Value]) -> bool:
    """Whether an argument's source number has to be translated to a target pin; constants that are all negative are no pins."""
    given = argument.argument
    named = given.operand if isinstance(given, ccode.Unary) and given.operator == "&" else None
    if isinstance(named, ccode.NameReference) and not isinstance(named.target, (ccode.Variable, ccode.Parameter)):
        return False  # an object of the platform, such as &Wire
    numbers = [value.number for value in known]
    return argument.translated and not (numbers and all(n is not None and n < 0 for n in numbers))


def _look_up(argument: PinArgument, around: tuple[str, str]) -> list[migration.TextChange]:
    """The insertions that wrap an argument in a look-up of its pin."""
    reason = f"'{argument.function}' gets a number of the source"
    places = ((argument.start, around[0]), (argument.end, around[1]))
    return [
        migration.TextChange(
            unit=argument.unit, startOffset=at, endOffset=at, replacement=text, rule=LOOK_UP, reason=reason,
            step=migration.Step.hardware,
        )
        for at, text in places
    ]  # fmt: skip


def _around(argument: PinArgument, sources: Mapping[str, bytes], place: int, arrays: bool) -> tuple[str, str] | None:
    """The text before and after an argument that looks up its pin; None for an array if the target has no helper for arrays."""
    if argument.parameter.number is None:
        return ("port_of_channel(" if argument.parameter.numbering == CHANNEL else "port("), ")"
    given = list(argument.call.arguments) if argument.call is not None else []
    if not arrays or argument.parameter.number >= len(given):
        return None
    count = given[argument.parameter.number]
    text = sources[argument.unit.path][count.startOffset : count.endOffset].decode(errors="replace")
    return f"ports<{place}>(", f", {text})"


# ---- calls inside macros


class _Use(Struct, frozen=True):
    """The text range of a macro's outermost use that expands to such calls."""

    unit: ccode.SourceUnit
    start: int
    end: int


def disabled_pins(arguments: Iterable[PinArgument], sources: Mapping[str, bytes]) -> dict[int, list[migration.TextChange]]:
    """Make the directives around each macro use that expands to calls whose ports cannot be looked up.

    Args:
        arguments: the pin arguments of the program's calls; only those without a place in the text are considered.
        sources: path of a unit -> its bytes.

    Returns:
        `id()` of the first call at each use -> the changes there.
    """
    found: dict[tuple[str, int], tuple[_Use, list[PinArgument]]] = {}
    for one in arguments:
        if one.unplaced and one.call is not None and one.taken:
            use = _outermost(one.unit, one.call)
            found.setdefault((str(use.unit.path), use.start), (use, []))[1].append(one)
    return {id(given[0].call): list(_directives_around(use, given, sources[str(use.unit.path)])) for use, given in found.values()}


def _outermost(unit: ccode.SourceUnit, call: ccode.Call) -> _Use:
    at = int(call.startOffset)
    uses = [(int(use.startOffset), -int(use.endOffset)) for use in unit.macroUses if use.startOffset <= at < use.endOffset]
    start, minus_end = min(uses, default=(at, -int(call.endOffset)))
    return _Use(unit, start, -minus_end)


def _directives_around(use: _Use, given: list[PinArgument], data: bytes) -> Iterator[migration.TextChange]:
    """Put the directives on lines of their own before and after the use; before it they replace the indentation if possible."""
    functions = list(dict.fromkeys(each.function for each in given))
    before = "".join(f"{_directive(name, [each for each in given if each.function == name])}\n" for name in functions)
    after = "".join(f"\n#undef {name}" for name in functions)
    line = data.rfind(b"\n", 0, use.start) + 1
    blanks = data[line : use.start]
    own_line = bool(blanks) and not blanks.strip() and not data[:line].rstrip(b"\r\n").endswith(b"\\")
    start, text = (line, before + blanks.decode()) if own_line else (use.start, f"\n{before}")
    yield _change(use.unit, start, use.start, text, functions)
    end = use.end + len(data[use.end :]) - len(data[use.end :].lstrip(b" \t"))
    end = end + 1 if data[end : end + 1] == b";" else use.end
    rest = data[end:].split(b"\n", 1)[0].strip()
    yield _change(use.unit, end, end, after + "\n" * bool(rest and not rest.startswith(b"//")), functions)


def _directive(function: str, given: list[PinArgument]) -> str:
    """A macro definition that calls the function with an invalid pin, and with a length of 0 for arrays of pins."""
    calls = [each.call for each in given if each.call is not None]
    names = [f"a{i}" for i in range(min(len(call.arguments) for call in calls))]
    texts = list(names)
    for each in given:
        pin = each.parameter
        if pin.number is None:
            texts[pin.position] = UNBOUND
        elif pin.number < len(texts):
            texts[pin.number] = "0"
    more = any(len(call.arguments) > len(names) for call in calls)
    parameters, passed = ", ".join([*names, *["..."] * more]), ", ".join([*texts, *["##__VA_ARGS__"] * more])
    return f"#define {function}({parameters}) {function}({passed})  // no pin: the port that the macro passes cannot be looked up"


def _change(unit: ccode.SourceUnit, start: int, end: int, text: str, functions: list[str]) -> migration.TextChange:
    return migration.TextChange(
        unit=unit, startOffset=start, endOffset=end, replacement=text, rule=NO_PIN, step=migration.Step.hardware,
        reason=f"a macro passes {', '.join(functions)} a number of the source, which cannot be looked up",
    )  # fmt: skip


def _is_torn(data: bytes, start: int, end: int) -> bool:
    """Whether a range begins or ends inside of a word, so that it is not the text of an expression."""
    return any(0 < at < len(data) and _IN_WORD.match(data, at - 1) is not None for at in (start, end))


class _Change(Struct, frozen=True):
    """A statement with the bindings and pins of its steps."""

    statement: PortStatement
    bindings: tuple[migration.PortBinding, ...]
    literals: tuple[str, ...]

    @property
    def start(self) -> int:
        return int(self.statement.element.startOffset)

    @property
    def end(self) -> int:
        return int(self.statement.element.endOffset)

    def contains(self, other: _Change) -> bool:
        """Whether another statement is a part of this one."""
        inside = self.start <= other.start and other.end <= self.end
        return inside and self is not other and self.statement.view.unit is other.statement.view.unit


def change_registers(
    views: Sequence[CodeView], bindings: Sequence[migration.PortBinding], sources: Mapping[str, bytes], same_registers: bool,
    drives_pins: bool,
) -> None:  # fmt: skip
    """Add the changes of the statements to the bindings of their first pins.

    Args:
        views: a view of each unit of the program.
        bindings: the bindings of its ports.
        sources: path of a unit -> its bytes.
        same_registers: whether the target's microcontroller has the registers, too; then only statements change whose pins are
            not at the same bits there.
        drives_pins: whether analogWrite and servos of the target take the place of timers that drive pins.
    """
    numbers = {int(binding.sourcePin): binding for binding in bindings}
    found: list[_Change] = []
    idioms = [] if same_registers else [s for s in idiom_statements(views) if drives_pins or s.steps[0].what not in _OF_TIMER]
    for each in (*port_statements(views), *idioms):
        bound = [numbers.get(step.number) for step in each.steps]
        pins = [bound_pin(binding) if binding is not None else None for binding in bound]
        if not all(pins):
            continue
        if same_registers and all(_is_in_place(step, pin, views) for step, pin in zip(each.steps, pins, strict=True)):
            continue
        literals = tuple(pin_literal(pin) for pin in pins if pin is not None)
        found.append(_Change(each, tuple(binding for binding in bound if binding is not None), literals))
    for change in found:
        if any(other.contains(change) for other in found):
            continue
        names = ", ".join(str(binding.name) for binding in change.bindings)
        change.bindings[0].changes.append(
            migration.TextChange(
                unit=change.statement.view.unit, startOffset=change.start, endOffset=change.end,
                replacement=_text(change, found, sources), rule=BY_REGISTER, step=migration.Step.hardware,
                reason=f"the bits of the register are {names}",
            )
        )  # fmt: skip


def _is_in_place(step: PinStep, pin: platform.Pin | None, views: Sequence[CodeView]) -> bool:
    """Whether a pin of the target is at the port and bit that the pin of a step has on the source board."""
    board = views[0].api.board
    places = {number: port for port, number in board.ports.items()} if board is not None else {}
    return pin is not None and str(pin.port) == places.get(step.number)


def _text(change: _Change, changes: Sequence[_Change], sources: Mapping[str, bytes]) -> str:
    statement = change.statement
    steps = list(zip(statement.steps, change.literals, strict=True))
    if all(step.what in _OF_TIMER for step, _ in steps):
        return _of_timer(change, _value(statement.steps[0].value, change, changes, sources))
    given = {id(step.value): step.value for step in statement.steps if step.value is not None}
    once = any(step.what in _ONCE for step, _ in steps) or not all(is_pure(value, statement.view) for value in given.values())
    if not once or len(given) != 1 or all(step.what == LEVEL for step, _ in steps):
        calls = [_call(step, literal, statement, f"({_value(step.value, change, changes, sources)})") for step, literal in steps]
        if _reads(statement):
            return calls[0] if len(calls) == 1 else f"({' | '.join(calls)})"
        return ", ".join(calls)
    inside = " ".join(f"{_call(step, literal, statement, 'bits')};" for step, literal in steps)
    [value] = given.values()
    return f"[](uint8_t bits) {{ {inside} }}({_value(value, change, changes, sources)})"


def _of_timer(change: _Change, text: str) -> str:
    """What takes the place of a statement of a timer that drives pins."""
    statement = change.statement
    called = statement.handler.split(",")
    filled = zip(statement.steps, change.literals, called, strict=True)
    return ", ".join(
        _call(step, literal, replace(statement, handler=name), _scaled(step, statement, text)) for step, literal, name in filled
    )


def _scaled(step: PinStep, statement: PortStatement, text: str) -> str:
    """The text of a value in the unit of the call that takes it; of a first pulse with its comma."""
    value, scale = register_value(step.value, statement.view.values), statement.scale
    if step.what == ATTACH:
        return f", {round(value * scale)}" if value is not None else ""
    if value is not None:
        return str(round(value * scale))
    factor = f"{scale.numerator}UL * " if scale.numerator != 1 else ""
    return f"{factor}({text}) / {scale.denominator}" if scale != 1 else text


def _reads(statement: PortStatement) -> bool:
    """Whether a statement is an expression that reads pins."""
    return all(step.what in (READ, CONVERT) for step in statement.steps)


def _is_asked(value: ccode.Expression) -> bool:
    """Whether only that a value is zero or not counts."""
    outer = value.eContainer()
    if isinstance(outer, (ccode.If, ccode.Loop, ccode.ConditionalExpression)):
        return outer.condition is value
    if isinstance(outer, (ccode.Unary, ccode.Binary)):
        return outer.operator in ("!", "&&", "||")
    use = outer.valueType if isinstance(outer, ccode.Variable) else None
    if isinstance(outer, ccode.Assignment) and outer.operator == "=":
        use = named_type(outer.left)
    return use is not None and str(use.canonical) == "bool"


def _call(step: PinStep, literal: str, statement: PortStatement, value: str) -> str:
    filled = {"pin": literal, "bit": str(step.bit), "handler": statement.handler, "value": value}
    alone = len(statement.steps) == 1 and _is_asked(statement.element)
    what = IS_SET if step.what == READ and (not step.bit or alone) else step.what
    return re.sub(r"\{(pin|bit|handler|value)\}", lambda found: filled[found[1]], _CALLS[what])


def _value(value: ccode.Expression | None, change: _Change, changes: Sequence[_Change], sources: Mapping[str, bytes]) -> str:
    """The text of a value, in which registers are read by their pins."""
    if value is None:
        return ""
    data, start, end = sources[str(change.statement.view.unit.path)], int(value.startOffset), int(value.endOffset)
    inner = [c for c in changes if change.contains(c) and start <= c.start and c.end <= end]
    text, at = "", start
    for each in sorted((c for c in inner if not any(o.contains(c) for o in inner)), key=lambda c: c.start):
        text += data[at : each.start].decode("utf-8", "replace") + _text(each, changes, sources)
        at = each.end
    return _SHIFT.sub("bit", text + data[at:end].decode("utf-8", "replace"))
