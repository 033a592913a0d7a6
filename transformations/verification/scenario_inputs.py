"""What a search for scenarios lets the inputs of a program show: values at rest, one after the other, together, and at random.

Each is made of the signals that the devices at the ports have. What is found with them is `scenario_search`'s to tell.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import product

from msgspec import Struct

from robosmi.data_text import Json
from robosmi.transformations.verification.played_devices import CONSOLE, TYPING
from robosmi.transformations.verification.port_devices import BoundPort, at_rest
from robosmi.transformations.verification.simulated_kinds import device_facts
from robosmi.typed import replaced
from robosmi.verify.scenario import POINTS, Points

Signals = Mapping[str, Mapping[str, Points]]

_APART_MS = 250.0
"""Inputs do not change nearer to one another than this: which of two is seen first would be a matter of luck."""
FIRST_TEXT_MS = 900.0
"""When a text is sent that is the only thing that happens: libraries for serial lines take up to half a second to begin."""
LONGEST_MS = 24_000.0
"""A series ends there, however many values are left."""
_LEAST_PRESSES = 5
_QUARTERS = 8
"""So often a contact of a knob that is turned changes."""


class ScenarioInput(Struct, frozen=True):
    """A signal of a port: the port's name, the setting, the values that it takes, how long it keeps one, and its device.

    `ends` are the least and the most that the device can give, where it measures something. With `happens` a value is something
    that happens at an instant, such as a text that is sent. `series` are values that come one after the other in one scenario,
    `near` is how near to a border values are tried, as a port has it.
    """

    name: str
    setting: str
    values: tuple[Json, ...]
    hold_ms: float
    device: str
    ends: tuple[Json, ...] = ()
    series: tuple[Json, ...] = ()
    near: tuple[float, float] | None = None

    def with_ends(self) -> ScenarioInput:
        """The signal with its ends among its values."""
        return replaced(self, values=(*self.values, *(end for end in self.ends if end not in self.values)))

    @property
    def happens(self) -> bool:
        """Whether a value is something that happens at an instant."""
        return bool(device_facts().get(self.device, {}).get("happens", False))

    @property
    def takes_text(self) -> bool:
        """Whether its values are texts that a program reads."""
        return self.device == TYPING or bool(device_facts().get(self.device, {}).get("takes_text", False))

    @property
    def is_contact(self) -> bool:
        """Whether it has two values, as a button."""
        return not self.happens and len(self.values) == 2


def scenario_inputs(ports: Sequence[BoundPort], texts: Sequence[str], types: bool, steps: int = 0) -> list[ScenarioInput]:
    """The inputs of a program, with what they may show.

    Args:
        ports: the ports.
        texts: what the program may understand, of what is typed or sent to it.
        types: whether it reads what is typed.
        steps: how many steps of a variable the program tells apart: as often, and once more round, buttons are pressed.
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
                rest = at_rest(port.device, port.kinds).get(setting)
                each = ScenarioInput(port.name, setting, tuple(taken), known["hold_ms"], port.device, ends, near=port.near)
                made.append(replaced(each, series=_series(each, rest, steps)))
    if types:
        each = ScenarioInput(CONSOLE, POINTS, (*texts, *facts[TYPING]["values"][POINTS]), facts[TYPING]["hold_ms"], TYPING)
        made.append(replaced(each, series=_series(each, None, steps)))
    return made


def _keys(port: BoundPort, ports: Sequence[BoundPort], lines: Sequence[str]) -> list[Json]:
    """The places of a matrix at some ports: each number of a pin of the first kind with each one of the second."""
    called = [name for each in ports if each.group == port.group for name in each.pin.split()] if lines else []
    numbers = [sorted(int(name.removeprefix(line)) for name in called if name.startswith(line)) for line in lines]
    return [list(place) for place in product(*numbers)] if lines else []


def _series(each: ScenarioInput, rest: Json, steps: int) -> tuple[Json, ...]:
    """What an input shows one after the other: all that happens, all keys of a matrix, or the presses of a button."""
    if each.happens:
        return each.values
    if device_facts().get(each.device, {}).get("keys"):
        return tuple(value for key in each.values if key is not None for value in (key, None))
    if steps and each.is_contact and rest in each.values:
        pressed = next(value for value in each.values if value != rest)
        return (pressed, rest) * max(_LEAST_PRESSES, 2 * steps + 1)
    return ()


def series_points(each: ScenarioInput, slower: int = 1) -> Points:
    """The instants of an input's series, as far as the longest scenario goes.

    Args:
        each: the input.
        slower: by how much longer than usual each value is held.
    """
    step = max(_APART_MS, each.hold_ms) * slower
    times = [FIRST_TEXT_MS + number * step for number in range(len(each.series))]
    return tuple((at, value) for at, value in zip(times, each.series, strict=True) if at + step <= LONGEST_MS)


def random_signals(inputs: Sequence[ScenarioInput], horizon: float, chance: random.Random) -> Mapping[str, Mapping[str, Points]]:
    """Some inputs that change some times, no two of them at nearly the same instant."""
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
    """Signals in which one input shows one value all the time; what happens once comes when the program has begun."""
    return {each.name: {each.setting: ((FIRST_TEXT_MS if each.happens else 0.0, value),)}}


def in_turn(each: ScenarioInput, values: Sequence[Json], horizon: float) -> Points:
    """A signal that shows values one after the other, each for as long as the input keeps one, as far as the horizon goes."""
    step = max(each.hold_ms, horizon / 4)
    return tuple((at * step, value) for at, value in enumerate(values) if at * step < horizon)


def together(inputs: Sequence[ScenarioInput], number: int) -> dict[str, dict[str, Points]]:
    """Signals in which all inputs show one of their values all the time, each that of a number, counted round and round."""
    signals: dict[str, dict[str, Points]] = {}
    for each in inputs:
        signals.setdefault(each.name, {})[each.setting] = ((0.0, each.values[number % len(each.values)]),)
    return signals


def turned(one: ScenarioInput, other: ScenarioInput, backwards: bool) -> dict[str, dict[str, Points]]:
    """Signals of two contacts as a knob makes them that is turned: the second one follows the first one, or goes before it.

    Args:
        one: the first contact, an input of two values.
        other: the second one.
        backwards: whether the second one goes before.
    """
    signals: dict[str, dict[str, Points]] = {}
    for each, late in ((other, False), (one, True)) if backwards else ((one, False), (other, True)):
        begin = FIRST_TEXT_MS + late * each.hold_ms
        times = [begin + number * 2 * each.hold_ms for number in range(_QUARTERS)]
        signals.setdefault(each.name, {})[each.setting] = tuple(
            (at, value) for at, value in zip(times, each.series, strict=False)
        )
    return signals
