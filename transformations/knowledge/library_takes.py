"""What a library takes for itself, timers and pins, as the target's data has it: told with the choice, for hardware checks.

A library that no entry names takes nothing that is known; that is not the same as nothing. Which pins lose their PWM with
a timer is in the board's data.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from robosmi import resources
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.project import read_data

_KEYS = frozenset(("names", "timers", "pins", "when"))


@dataclass(frozen=True, slots=True)
class Takes:
    """What one library takes.

    Attributes:
        timers: timers of the processor, as the boards' data calls them.
        pins: labels of pins.
        when: under which condition, or empty for always.
    """

    timers: tuple[str, ...] = ()
    pins: tuple[str, ...] = ()
    when: str = ""

    def __str__(self) -> str:
        """As evidence of a plan: one sentence without full stop."""
        taken = ", ".join((*self.timers, *self.pins))
        return f"takes {taken}{f' when {self.when}' if self.when else ''}"


def library_takes(platform: str, project: Path | None = None, *, functions: bool = False) -> Mapping[str, Takes]:
    """What libraries of a target take, by the library's name; empty where the target has no such data.

    Args:
        platform: folder of the target in the platform repository.
        project: the project folder; the current folder if None.
        functions: what functions of the target's core take instead, by the function's name.

    Raises:
        PlatformDataError: the data are damaged.
    """
    for folder in resources.folders("platform_repo", project):
        path = folder / platform / "libraries" / "takes.toml"
        if path.is_file():
            return _read(path, path.stat().st_mtime_ns, "function" if functions else "library")
    return {}


@lru_cache(maxsize=4)
def _read(path: Path, mtime_ns: int, kind: str) -> Mapping[str, Takes]:
    found: dict[str, Takes] = {}
    for entry in read_data(path).get(kind, []):
        lists = [entry.get(key, []) for key in ("names", "timers", "pins")]
        if not lists[0] or not set(entry) <= _KEYS or not all(isinstance(text, str) for each in lists for text in each):
            raise PlatformDataError(
                f"an entry is no {kind} with what it takes: {entry}",
                location=Location(str(path)),
                fix="write names, timers, pins",
            )
        for name in lists[0]:
            found.setdefault(name, Takes(tuple(lists[1]), tuple(lists[2]), str(entry.get("when", ""))))
    return found
