"""A keypad: a matrix of contacts between rows and columns."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, ClassVar

from robosmi.verify.bench import Device

_MOST = 8


class Keypad(Device):
    """A matrix of up to eight rows and columns (`row0` ..., `column0` ...).

    Setting `points`: [milliseconds, [row, column]] while that key is held, or null while none is. A held key joins its row
    and its column: what the program drives on one is read on the other.
    """

    optional_pin_names = tuple(f"{line}{number}" for line in ("row", "column") for number in range(_MOST))
    setting_names: ClassVar[Mapping[str, Any]] = {"points": ...}
    heeds_levels = False
    reacts_to = ()

    def start(self) -> None:
        """Begin to play the points."""
        self._held: tuple[str, str] | None = None
        for at_ms, key in self.settings["points"]:
            self.bench.at(at_ms * 1000, partial(self._press, key))

    def _press(self, key: list[int] | None) -> None:
        if self._held is not None:
            self.bench.part(*self._held)
        self._held = None if key is None else (self.pins[f"row{key[0]}"], self.pins[f"column{key[1]}"])
        if self._held is not None:
            self.bench.join(*self._held)
