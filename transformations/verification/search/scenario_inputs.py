"""The values that a search for scenarios gives to a program's inputs: constant, in sequence, combined, and at random.

The signals are those of the devices at the program's ports; `scenario_search` runs the program with them.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import product

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import Json
from robosmi.transformations.verification.bound_devices.played_devices import CONSOLE, TYPING
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort, at_rest
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
