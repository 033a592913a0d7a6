"""Check the values of a scenario's signals: only what the device can show, as `platform_repo/simulation` says.

Otherwise the models of the two boards might play an impossible value differently.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from robosmi.diagnostics import Location
from robosmi.errors import UsageError
from robosmi.verify.scenario import Points


def check_signal(name: str, setting: str, points: Points, facts: Mapping[str, Any], place: Location | None = None) -> None:
    """Check the values of a signal against what its device takes.

    Args:
        name: the component, port or pin, as the scenario has it.
        setting: of the device.
        points: the signal.
        facts: facts of the device: `takes`, the kinds of values by setting, and `limits`, the least and the greatest number.
        place: the place of the scenario, for messages.

    Raises:
        UsageError: a value is of another kind, or beyond the limits.
    """
    kinds = facts.get("takes", {}).get(setting)
    if kinds is None:
        return
    limits = facts.get("limits", {}).get(setting)
    for at_ms, value in points:
        fitting = [kind for kind in kinds if _KINDS[kind][1](value)]
        if not fitting or (limits is not None and value is not None and not _is_within(value, *limits)):
            shown = '"none"' if value is None else repr(value)
            said = f"the signal of '{name}' has {shown} at {at_ms:g} ms"
            raise UsageError(
                f"{said}, which its device cannot show" if fitting else f"{said}, which is no {_KINDS[kinds[0]][0]}",
                fix=f"write {' or '.join(_KINDS[kind][0] for kind in kinds)}{_told(limits)}",
                location=place,
            )


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _are(count: int, is_one: Callable[[Any], bool]) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, (list, tuple)) and len(value) == count and all(is_one(each) for each in value)


_KINDS: Mapping[str, tuple[str, Callable[[Any], bool]]] = {
    "level": ("level (0 or 1)", lambda value: _is_whole(value) and value in (0, 1)),
    "number": ("number", _is_number),
    "whole number": ("whole number", _is_whole),
    "text": ("text", lambda value: isinstance(value, str)),
    "bytes": (
        "list of bytes",
        lambda value: isinstance(value, (list, tuple)) and all(_is_whole(b) and b in range(256) for b in value),
    ),
    "2 whole numbers": ("list of 2 whole numbers", _are(2, _is_whole)),
    "3 numbers": ("list of 3 numbers", _are(3, _is_number)),
    "4 whole numbers": ("list of 4 whole numbers", _are(4, _is_whole)),
    "none": ('"none"', lambda value: value is None),
}
"""The data's word for a kind of value -> its name for people, and a test whether a value is one."""


def _is_within(value: Any, least: Any, most: Any) -> bool:
    """Whether a number, or each number of a list, is within its limits; other kinds of values have none."""
    if isinstance(value, (list, tuple)):
        if not isinstance(least, (list, tuple)):
            return True
        return all(_is_within(each, *bounds) for each, *bounds in zip(value, least, most, strict=True))
    return not _is_number(value) or least <= value <= most


def _told(limits: Any) -> str:
    if limits is None:
        return ""
    least, most = limits
    return f", from {least} to {most}"
