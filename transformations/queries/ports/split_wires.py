"""Components with one wire per direction where the source uses one for both, such as a ranger with trigger and echo.

Which functions can serve them is data of their adapters (`split` of a pin); which port such a component has is decided in the
plan.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robosmi.metamodels import migration, platform


def split_functions(uses: Iterable[migration.AdapterUse]) -> frozenset[str]:
    """Names of the functions whose adapters can use separate wires for the two directions."""
    return frozenset(str(use.name) for use in uses if use.adapter is not None and any(pin.split for pin in use.adapter.pins))


def wires_of(component: object, connections: Sequence[migration.Connection]) -> dict[str, migration.Connection]:
    """The one connection of a component that the board writes (`write`) and the one it reads (`read`); else empty."""
    mine = [c for c in connections if c.component is component and c.pin is not None]
    asked = [c for c in mine if c.signal is migration.Signal.write]
    heard = [c for c in mine if c.signal is migration.Signal.read]
    if component is None or len(asked) != 1 or len(heard) != 1 or asked[0].pin is heard[0].pin:
        return {}
    return {"write": asked[0], "read": heard[0]}


def written_pin(binding: migration.PortBinding, connections: Sequence[migration.Connection]) -> platform.Pin | None:
    """The pin that the board writes for a port whose component has a wire per direction; None for any other port."""
    wires = wires_of(binding.answer.component, connections) if binding.answer is not None else {}
    return wires["write"].pin if wires else None


def answering_pin(binding: migration.PortBinding) -> platform.Pin | None:
    """The pin that the board reads for a port whose component has a wire per direction; None for any other port."""
    return binding.answer.pin if binding.answer is not None else None
