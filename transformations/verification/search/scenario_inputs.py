"""The values that a search for scenarios gives to a program's inputs: constant, in sequence, combined, and at random.

The signals are those of the devices at the program's ports; `scenario_search` runs the program with them.

What is typed on the console are texts and numbers that the program compares with what it reads. A number that was read is
followed by names: through assignments, arguments, results of functions and pointers to what is to hold it. Names are not told
apart by the function that they belong to, so that a number too many may be found.
"""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import product

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import Json
from robosmi.metamodels import ccode, migration
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents
from robosmi.transformations.queries.numbers import COMPARISONS
from robosmi.transformations.queries.place_names import named, names_within
from robosmi.transformations.queries.values import Values
from robosmi.transformations.verification.bound_devices.played_devices import CONSOLE, TYPING
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort, at_rest, device_table
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.verify.scenario import POINTS, Points

Signals = Mapping[str, Mapping[str, Points]]

_APART_MS = 250.0
"""Least time between changes of two inputs, in milliseconds: which of two closer ones a program sees first would be chance."""
FIRST_TEXT_MS = 900.0
"""Time at which a single text is sent, in milliseconds: libraries for serial lines take up to half a second to start."""
LONGEST_MS = 24_000.0
"""Time at which a series ends, in milliseconds, even if values are left."""
_LEAST_PRESSES = 5
_SHORTLY_MS = 150.0
_QUARTERS = 8
"""How often each contact of a turned knob changes."""


class ScenarioInput(Struct, frozen=True):
    """An input of a program in a search: one signal of a device at a port, with the values to try.

    Attributes:
        name: the port's name.
        setting: the setting of the device that the signal changes.
        values: the values to try.
        hold_ms: how long a value is held, in milliseconds.
        device: kind of the device.
        ends: the least and the greatest value, if the device measures something.
        series: values that follow one another in one scenario.
        near: how far from a border of the program values are tried, as in `BoundPort`.
        rest: the value while nothing happens; None if there is none.
    """

    name: str
    setting: str
    values: tuple[Json, ...]
    hold_ms: float
    device: str
    ends: tuple[Json, ...] = ()
    series: tuple[Json, ...] = ()
    near: tuple[float, float] | None = None
    rest: Json = None

    def with_ends(self) -> ScenarioInput:
        """The input with its least and greatest value among those to try."""
        return replace(self, values=(*self.values, *(end for end in self.ends if end not in self.values)))

    @property
    def happens(self) -> bool:
        """Whether a value is an event at an instant, such as a text that is sent."""
        return bool(device_facts().get(self.device, {}).get("happens", False))

    @property
    def takes_text(self) -> bool:
        """Whether its values are texts that a program reads."""
        return self.device == TYPING or bool(device_facts().get(self.device, {}).get("takes_text", False))

    @property
    def is_contact(self) -> bool:
        """Whether it is a contact such as a button, with exactly two values."""
        return not self.happens and len(self.values) == 2

    @property
    def pressed(self) -> Json:
        """What a contact shows that it does not show at rest."""
        return next(value for value in self.values if value != self.rest)


def scenario_inputs(ports: Sequence[BoundPort], texts: Sequence[str], types: bool, steps: int = 0) -> list[ScenarioInput]:
    """The inputs of a program, with the values to try.

    Args:
        ports: the ports.
        texts: texts that the program may react to, typed or sent.
        types: whether the program reads what is typed on the console.
        steps: the number of steps of a variable that the program tells apart; buttons are pressed twice as often and once more.
    """
    facts = device_facts()
    made = []
    for port in ports:
        if port.target and port.device and port.group in ("", port.source):
            known = facts.get(port.device, {})
            for setting, values in known.get("values", {}).items():
                taken = [*texts, *values] if known.get("takes_text") else [None if v == "none" else v for v in values]
                taken = [*_keys(port, ports, known.get("keys", [])), *taken]
                ends = tuple(known.get("ends", {}).get(setting, ()))
                if port.most:
                    taken = [value for value in taken if not isinstance(value, (int, float)) or value <= port.most]
                    ends = tuple(min(end, port.most) if isinstance(end, (int, float)) else end for end in ends)
                rest = at_rest(port.device, port.kinds).get(setting)
                each = ScenarioInput(port.name, setting, tuple(taken), known["hold_ms"], port.device, ends, (), port.near, rest)
                made.append(replace(each, series=_series(each, rest, steps)))
    if types:
        each = ScenarioInput(CONSOLE, POINTS, (*texts, *facts[TYPING]["values"][POINTS]), facts[TYPING]["hold_ms"], TYPING)
        made.append(replace(each, series=_series(each, None, steps)))
    return made


def _keys(port: BoundPort, ports: Sequence[BoundPort], lines: Sequence[str]) -> list[Json]:
    """The keys of a matrix at some ports: each number of a pin of the first line's kind with each one of the second's."""
    called = [name for each in ports if each.group == port.group for name in each.pin.split()] if lines else []
    numbers = [sorted(int(name.removeprefix(line)) for name in called if name.startswith(line)) for line in lines]
    return [list(place) for place in product(*numbers)] if lines else []


def _series(each: ScenarioInput, rest: Json, steps: int) -> tuple[Json, ...]:
    """What an input shows in sequence: all events, all keys of a matrix (each released afterwards), or presses of a button."""
    if each.happens:
        return each.values
    if device_facts().get(each.device, {}).get("keys"):
        return tuple(value for key in each.values if key is not None for value in (key, None))
    if steps and each.is_contact and rest in each.values:
        return (each.pressed, rest) * max(_LEAST_PRESSES, 2 * steps + 1)
    return ()


def series_points(each: ScenarioInput, slower: int = 1) -> Points:
    """The points of an input's series, as far as the longest scenario goes.

    Args:
        each: the input.
        slower: the factor by which each value is held longer than usual.
    """
    step = max(_APART_MS, each.hold_ms) * slower
    times = [FIRST_TEXT_MS + number * step for number in range(len(each.series))]
    return tuple((at, value) for at, value in zip(times, each.series, strict=True) if at + step <= LONGEST_MS)


def random_signals(inputs: Sequence[ScenarioInput], horizon: float, chance: random.Random) -> Mapping[str, Mapping[str, Points]]:
    """Random signals for some of the inputs, whose changes are at least `_APART_MS` apart."""
    chosen = [each for each in inputs if chance.random() < 0.7] or list(inputs[:1])
    slots = [at * _APART_MS for at in range(1, int((horizon - 500) / _APART_MS))]
    chance.shuffle(slots)
    signals: dict[str, dict[str, Points]] = {}
    for each in chosen:
        begin = [(0.0, chance.choice(each.values))] if not each.happens and chance.random() < 0.5 else []
        wanted = chance.randint(1, 5)
        at = 0.0
        points: list[tuple[float, Json]] = list(begin)
        for slot in sorted(slots[:wanted]):
            if slot - at >= each.hold_ms:
                points.append((slot, chance.choice(each.values)))
                at = slot
        del slots[:wanted]
        if points:
            signals.setdefault(each.name, {})[each.setting] = tuple(points)
    return signals


def constant(each: ScenarioInput, value: Json) -> dict[str, dict[str, Points]]:
    """Signals in which one input has one value throughout; an event happens once the program has started."""
    return {each.name: {each.setting: ((FIRST_TEXT_MS if each.happens else 0.0, value),)}}


def in_turn(each: ScenarioInput, values: Sequence[Json], horizon: float) -> Points:
    """The points of a signal that takes values in sequence, each for at least `hold_ms`, up to the horizon."""
    step = max(each.hold_ms, horizon / 4)
    return tuple((at * step, value) for at, value in enumerate(values) if at * step < horizon)


def together(inputs: Sequence[ScenarioInput], number: int) -> dict[str, dict[str, Points]]:
    """Signals in which each input holds the value with this index, modulo the number of its values."""
    signals: dict[str, dict[str, Points]] = {}
    for each in inputs:
        signals.setdefault(each.name, {})[each.setting] = ((0.0, each.values[number % len(each.values)]),)
    return signals


def is_steady(signals: Signals) -> bool:
    """Whether all inputs show one value each from the start on."""
    return all(len(points) == 1 and points[0][0] == 0 for settings in signals.values() for points in settings.values())


def press(each: ScenarioInput, ms: float, begin_ms: float) -> Signals:
    """Signals of a button that is pressed once, for some time."""
    return {each.name: {each.setting: ((begin_ms, each.pressed), (begin_ms + ms, each.rest))}}


def pressed_twice(each: ScenarioInput, ms: float, begin_ms: float) -> Signals:
    """Signals of a button that is pressed twice shortly, with some time between."""
    again_ms = begin_ms + _SHORTLY_MS + ms
    times = (begin_ms, begin_ms + _SHORTLY_MS, again_ms, again_ms + _SHORTLY_MS)
    return {each.name: {each.setting: tuple(zip(times, (each.pressed, each.rest) * 2, strict=True))}}


def turned(one: ScenarioInput, other: ScenarioInput, backwards: bool) -> dict[str, dict[str, Points]]:
    """Signals of the two contacts of a knob that is turned: the second one follows the first one, or precedes it.

    Args:
        one: the first contact, an input of two values.
        other: the second one.
        backwards: whether the second one precedes the first one.
    """
    signals: dict[str, dict[str, Points]] = {}
    for each, late in ((other, False), (one, True)) if backwards else ((one, False), (other, True)):
        begin = FIRST_TEXT_MS + late * each.hold_ms
        times = [begin + number * 2 * each.hold_ms for number in range(_QUARTERS)]
        signals.setdefault(each.name, {})[each.setting] = tuple(
            (at, value) for at, value in zip(times, each.series, strict=False)
        )
    return signals


# ---- what a program understands of what is typed

_MOST_TEXTS = 24
_NUMBERS = (50, 70000)
_NUMBER_LINES = ("70000\r", "-40000\r", "4\r30\r-5\r12\r7\r")
_MOST_COMPARED = 12
"""At most this many numbers that a program compares are typed, each with its neighbours."""
_NUMBERS_BEFORE = ("1\r", "1\r1\r")
"""Other numbers that a program may read first."""
_LARGEST = 2**31 - 1


def reads_console(plan: migration.MigrationPlan) -> bool:
    """Whether a plan's program reads what is typed."""
    assert plan.source is not None
    known = device_table(str(plan.source.name)).table("console").texts("reads", ())
    assert plan.program is not None
    if any(use.name in known for use in plan.adapterUses):
        return True
    return not plan.adapterUses and any(
        isinstance(element, ccode.Call) and element.calleeName in known
        for unit in plan.program.units
        for element in all_contents(unit)
    )


def texts_understood(plan: migration.MigrationPlan) -> list[str]:
    """Texts that a plan's program may react to: the characters in its code, and, as lines, the texts that it compares with.

    If it compares with variables, these are the texts in its initializers. If it converts text to numbers, each text is also
    given with a number after it, one of them beyond 16 bits, and there are lines of several numbers.
    """
    shown, words, reads_numbers = _understood(plan)
    texts = [*shown, *(f"{word}\r" for word in words)][:_MOST_TEXTS]
    if not reads_numbers:
        return texts
    behind = [f"{before}{number}\r" for number in _NUMBERS for before in (*(f"{word} " for word in words), *shown)]
    return [*texts, *_NUMBER_LINES, *behind[:_MOST_TEXTS]]


def numbers_understood(plan: migration.MigrationPlan) -> list[tuple[str, int]]:
    """The numbers that a plan's program compares with those that it reads, each with a text to type before it.

    That text is empty, one that the program may react to, or other numbers that it reads first. If the program compares none
    with a constant, 0 stands for them.
    """
    assert plan.program is not None
    assert plan.source is not None
    shown, words, reads_numbers = _understood(plan)
    before = ["", *[*(f"{word} " for word in words), *shown, *(f"{word}\r" for word in words)][:_MOST_TEXTS]]
    numbers = compared_numbers(plan.program, device_table(str(plan.source.name)).table("console").texts("numbers", ()))
    if reads_numbers:
        before += _NUMBERS_BEFORE
        numbers = numbers or [0]
    return [(each, number) for number in numbers[:_MOST_COMPARED] if abs(number) < _LARGEST for each in before]


def _understood(plan: migration.MigrationPlan) -> tuple[list[str], list[str], bool]:
    """The characters and the texts that a plan's program may react to, and whether it converts text to numbers."""
    assert plan.program is not None
    assert plan.source is not None
    console = device_table(str(plan.source.name)).table("console")
    compares, numbers = console.texts("compares", ()), console.texts("numbers", ())
    letters: dict[str, None] = {}
    words: dict[str, None] = {}
    reads_numbers = of_tables = False
    for element in (e for unit in plan.program.units for e in all_contents(unit)):
        if isinstance(element, ccode.CharacterLiteral):
            letters.setdefault(chr(int(element.value) & 0xFF))
        elif isinstance(element, ccode.Call) and element.calleeName in compares:
            literals = [a for a in element.arguments if isinstance(a, ccode.StringLiteral)]
            words |= {str(a.text).strip('"'): None for a in literals}
            of_tables = of_tables or not literals
        elif isinstance(element, ccode.Call):
            reads_numbers = reads_numbers or element.calleeName in numbers
    if of_tables:  # input is compared with the content of a variable
        lists = [e for unit in plan.program.units for e in all_contents(unit) if isinstance(e, ccode.InitializerList)]
        words |= {str(e.text).strip('"'): None for each in lists for e in each.elements if isinstance(e, ccode.StringLiteral)}
    return [letter for letter in letters if letter.isprintable()], list(words), reads_numbers


def compared_numbers(program: ccode.Program, reads: Collection[str]) -> list[int]:
    """The constants with which a program compares numbers that it has read, in text order, each once.

    Args:
        program: the program.
        reads: the names of the functions that read numbers, and give them as results or through arguments.
    """
    units = [(unit, list(all_contents(unit))) for unit in program.units]
    holders = {f"{name}()" for name in reads}
    known = 0
    while known < len(holders):
        known = len(holders)
        for element in (each for _, elements in units for each in elements):
            holders.update(_given(element, holders, reads))
    found: list[int] = []
    for unit, elements in units:
        values = Values(program, unit)
        for element in elements:
            for constant in _compared(element, holders):
                if not any(isinstance(each, ccode.CharacterLiteral) for each in (constant, *all_contents(constant))):
                    found += [value.number for value in values.of(constant) if value.number is not None]
    return list(dict.fromkeys(found))


def _given(element: Element, holders: set[str], reads: Collection[str]) -> Iterator[str]:
    """The names that get a number that was read, or a pointer to what gets one, by an element."""
    if isinstance(element, ccode.Assignment):
        if _holds(element.right, holders):
            yield from _holder(element.left)
    elif isinstance(element, ccode.Variable):
        if _holds(element.initializer, holders):
            yield str(element.name)
    elif isinstance(element, ccode.Function):
        if any(isinstance(each, ccode.Return) and _holds(each.value, holders) for each in all_contents(element)):
            yield f"{element.name}()"
    elif isinstance(element, ccode.Call):
        parameters = [] if element.callee is None else [str(each.name) for each in element.callee.parameters]
        for number, argument in enumerate(element.arguments):
            parameter = parameters[number] if number < len(parameters) else ""
            if element.calleeName in reads or (parameter in holders and _is_address(argument)):
                yield from _holder(argument)
            elif parameter and _holds(argument, holders):
                yield parameter


def _compared(element: Element, holders: set[str]) -> Iterator[Element]:
    """The expressions with which an element compares a number that was read."""
    if isinstance(element, ccode.Binary) and str(element.operator) in COMPARISONS:
        for side, other in ((element.left, element.right), (element.right, element.left)):
            if other is not None and _holds(side, holders):
                yield other
    elif isinstance(element, ccode.Switch) and _holds(element.selector, holders):
        for case in all_contents(element):
            if isinstance(case, ccode.Case) and case.constant is not None:
                yield case.constant


def _is_address(expression: Element) -> bool:
    return isinstance(expression, ccode.Unary) and str(expression.operator) == "&"


def _holder(expression: Element | None) -> Iterator[str]:
    """The name of the variable or member that an expression denotes, or points to; a member's name begins with a point."""
    while isinstance(expression, (ccode.Index, ccode.Unary, ccode.Cast)):
        expression = expression.array if isinstance(expression, ccode.Index) else expression.operand
    yield from named(expression)


def _holds(expression: Element | None, holders: set[str]) -> bool:
    """Whether an expression has a number that was read."""
    return not holders.isdisjoint(names_within(expression))
