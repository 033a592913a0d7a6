"""Components with a wire for each direction where the source has one for both, such as a ranger with trigger and echo.

Which functions can serve them is data of their adapters (`split` of a pin); which port is on such a component is the plan's.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robosmi.metamodels import migration, platform


def split_functions(uses: Iterable[migration.AdapterUse]) -> frozenset[str]:
    """The functions whose adapters can serve a component with a wire for each direction."""
    return frozenset(str(use.name) for use in uses if use.adapter is not None and any(pin.split for pin in use.adapter.pins))


def wires_of(component: object, connections: Sequence[migration.Connection]) -> dict[str, migration.Connection]:
    """The connection by which a component is asked (`write`), and by which it answers (`read`), where it has each once."""
    mine = [c for c in connections if c.component is component and c.pin is not None]
    asked = [c for c in mine if c.signal is migration.Signal.write]
    heard = [c for c in mine if c.signal is migration.Signal.read]
    if component is None or len(asked) != 1 or len(heard) != 1 or asked[0].pin is heard[0].pin:
        return {}
    return {"write": asked[0], "read": heard[0]}


def asking_pin(binding: migration.PortBinding, connections: Sequence[migration.Connection]) -> platform.Pin | None:
    """The pin that asks of a port whose component has a wire for each direction; None for any other."""
    wires = wires_of(binding.answer.component, connections) if binding.answer is not None else {}
    return wires["write"].pin if wires else None


def answering_pin(binding: migration.PortBinding) -> platform.Pin | None:
    """The pin that answers of such a port; None for any other."""
    return binding.answer.pin if binding.answer is not None else None
