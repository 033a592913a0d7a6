"""The calls of platform functions that a program's own macros make where they are used, and the ports that they reach.

The model has them as the macros expand. Where a call does not say its ports itself, its flow says which may come (`CallStates`).
"""

from __future__ import annotations

from functools import cached_property

from robosmi.metamodels import ccode, migration
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.flows.pin_uses import pin_number
from robosmi.transformations.queries.values import Values


class MacroCalls:
    """The calls that bodies of macros make in a plan's program.

    Args:
        plan: the plan.
    """

    def __init__(self, plan: migration.MigrationPlan) -> None:
        self._units = list(plan.program.units) if plan.program is not None else []
        self._program = plan.program
        self._bindings = [b for b in plan.portBindings if b.conventionalPort is None]
        self._values: dict[int, Values] = {}

    @cached_property
    def _made(self) -> dict[str, list[ccode.Call]]:
        found: dict[str, list[ccode.Call]] = {}
        for unit in self._units:
            for call in all_of_kind(unit, ccode.Call):
                if call.viaMacro:
                    found.setdefault(str(call.calleeName), []).append(call)
        return found

    def of(self, use: migration.AdapterUse) -> list[ccode.Call]:
        """The calls of an adapter's function that macros make, one for each place where such a macro is used."""
        return self._made.get(str(use.name), [])

    def ports(self, use: migration.AdapterUse, call: ccode.Call) -> list[migration.PortBinding] | None:
        """The ports that such a call reaches; None if its arguments have values unknown here, or none of them is a port."""
        found: dict[int, migration.PortBinding] = {}
        parameters = [*use.function.parameters] if use.function is not None else []
        given = [(a, int(p.span)) for a, p in zip(call.arguments, parameters, strict=False) if p.isPort]
        for argument, span in given:
            numbers = [value.number for value in self._values_at(argument).of(argument)]
            if None in numbers:
                return None
            known = {pin_number(n) + i for n in numbers if n is not None for i in range(max(1, span))}
            found.update((id(b), b) for b in self._bindings if b.sourcePin in known)
        return list(found.values()) if given else None

    def _values_at(self, element: ccode.Expression) -> Values:
        unit = ancestor_of_kind(element, ccode.SourceUnit)
        assert self._program is not None
        assert unit is not None
        if id(unit) not in self._values:
            self._values[id(unit)] = Values(self._program, unit)
        return self._values[id(unit)]
