"""Operations on the adapters of a plan: which pieces are emitted, in which order, and what they require of the program."""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import ccode, migration, platform
from robosmi.transformations.knowledge.adapters.adapter_checks import parameters_of
from robosmi.transformations.knowledge.api_facts import DIRECTIONS, PinFacts, PinParameter

_WORDS = {literal: word for word, literal in DIRECTIONS.items()}


def closure(adapters: Iterable[platform.Adapter]) -> list[platform.Adapter]:
    """The transitive closure of what pieces need, each piece once and after the pieces it depends on."""
    found: dict[platform.Adapter, None] = {}

    def add(piece: platform.Adapter, above: tuple[platform.Adapter, ...]) -> None:
        above = (*above, piece)
        for needed in piece.needs:
            if needed not in found and needed not in above:
                add(needed, above)
        found[piece] = None

    for adapter in adapters:
        if adapter not in found:
            add(adapter, ())
    return list(found)


def emitted(plan: migration.MigrationPlan) -> list[platform.Adapter]:
    """The adapter pieces of a plan's program for its functions, symbols and changed text, with their dependencies."""
    symbols = [use.adapter for use in plan.symbolUses]
    functions = [use.adapter for use in plan.adapterUses]
    return closure(piece for piece in (*symbols, *functions, *plan.helpers) if piece is not None)


def setup_statements(plan: migration.MigrationPlan) -> list[str]:
    """The statements that the pieces need at the start of the program, each once."""
    return list(dict.fromkeys(str(statement) for piece in emitted(plan) for statement in piece.setup))


def rest_levels(plan: migration.MigrationPlan) -> list[migration.Connection]:
    """One connection for each pin that is driven to a rest level before anything else runs."""
    return list({c.pin: c for c in reversed(list(plan.connections)) if c.restLevel and c.pin is not None}.values())[::-1]


def limits(use: migration.AdapterUse) -> list[str]:
    """The limits of a use's adapter and of the pieces it depends on: what they do not do, as sentences."""
    pieces = closure([use.adapter]) if use.adapter is not None else []
    return list(dict.fromkeys(str(limit) for piece in reversed(pieces) for limit in piece.limits))


def port_calls(plan: migration.MigrationPlan, binding: migration.PortBinding) -> list[ccode.Call]:
    """The calls of platform functions that drive or read a port, in text order, with those that macros expand to.

    Args:
        plan: the plan.
        binding: the port's binding.
    """
    calls = [c for flow in plan.portFlows if any(b is binding for b in flow.bindings) for c in flow.calls]
    if (port := binding.conventionalPort) is not None:
        uses = [
            u for u in plan.adapterUses if u.adapter is not None and any(port is p for a in closure([u.adapter]) for p in a.ports)
        ]
        calls += [c for use in uses for c in use.calls]
    return sorted(calls, key=lambda c: int(c.startOffset))


class OwnFunctionPins:
    """The pins of the functions of a plan that its source platform does not know, as the markers of their adapters declare them.

    Args:
        plan: a stored plan.
    """

    index = None

    def __init__(self, plan: migration.MigrationPlan) -> None:
        self._adapters = {
            str(use.name): use.adapter for use in plan.adapterUses if use.function is None and use.adapter is not None
        }

    def of(self, function: str, header: str) -> PinFacts | None:
        """The pins of a function; None where its adapter declares none, or the platform knows it.

        Args:
            function: its name.
            header: not asked, since a program calls one function of a name.
        """
        adapter = self._adapters.get(function)
        if adapter is None:
            return None
        names = parameters_of(str(adapter.text), str(adapter.targetName or adapter.name))
        pins = [
            PinParameter(names.index(str(pin.name)), str(pin.name), _WORDS[pin.direction.name])
            for pin in adapter.pins
            if pin.name in names
        ]
        return PinFacts(tuple(pins), ()) if pins else None

    def levels_read(self) -> frozenset[str]:
        """The functions that read digital levels at a pin where no component of a certain kind is expected."""
        return frozenset(name for name, adapter in self._adapters.items() if any(_reads_levels(pin) for pin in adapter.pins))


def _reads_levels(pin: platform.AdapterPin) -> bool:
    digital = pin.capability == platform.PinCapability.digital and pin.direction == platform.Direction.input
    return digital and not pin.componentRole
