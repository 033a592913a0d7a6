"""Signals that are scripted over time: levels at a pin, voltages at a pin of the converter, text typed at the console."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, ClassVar

from robosmi.errors import UsageError
from robosmi.verify.bench import Device


def value_at(points: Sequence[Sequence[Any]], now_us: float) -> Any:
    """The value of a signal at a time, in microseconds; its first value before its first point, None without points."""
    found = points[0][1] if points else None
    for at_ms, value in points:
        if at_ms * 1000 > now_us:
            break
        found = value
    return found


class _Scripted(Device):
    """A signal over time: `points` is a list of [milliseconds, value] in ascending order of time."""

    setting_names: ClassVar[Mapping[str, Any]] = {"points": ...}

    def _play(self, act: Callable[..., None]) -> None:
        """Call `act(value)` at the time of each point.

        Raises:
            UsageError: the points go back in time.
        """
        last = 0.0
        for at_ms, value in self.settings["points"]:
            if at_ms < last:
                raise UsageError(f"the signal goes back in time, from {last:g} to {at_ms:g} ms", fix="sort its points by time")
            last = at_ms
            self.bench.at(at_ms * 1000, partial(act, value))


class Levels(_Scripted):
    """A level at a pin: 0, 1, or null where nothing drives it."""

    pin_names = ("pin",)

    def start(self) -> None:
        """Begin to play the points."""
        self._play(partial(self.bench.set_level, self.pins["pin"]))


class Voltages(_Scripted):
    """A voltage at a pin of the converter, in millivolts."""

    pin_names = ("pin",)

    def start(self) -> None:
        """Begin to play the points."""
        self._play(partial(self.bench.set_voltage, self.pins["pin"]))


class Typing(_Scripted):
    """Text that arrives on the console."""

    def start(self) -> None:
        """Begin to play the points."""
        self._play(lambda text: self.bench.send(text.encode()))
