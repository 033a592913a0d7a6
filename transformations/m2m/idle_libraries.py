"""Closes open choices of libraries that would change nothing, because the adapters handle the component without a library."""

from __future__ import annotations

from robosmi.metamodels import ccode, hardware, migration
from robosmi.transformations.m2m.library_choice import NO_LIBRARY
from robosmi.transformations.m2m.plan_checks import port_calls
from robosmi.transformations.queries.plan_adapters import closure

_READY = (migration.AdapterStatus.filled, migration.AdapterStatus.care)


def close_idle_choices(plan: migration.MigrationPlan) -> None:
    """Choose no library for a component if all calls at its ports have adapters with bodies, and none of these uses a
    candidate.
    """
    uses = {str(use.name): use for use in plan.adapterUses}
    for choice in plan.libraryChoices:
        if not choice.open or choice.component is None:
            continue
        calls = _calls(plan, choice.component)
        told = [uses.get(str(call.calleeName)) for call in calls]
        pieces = [use.adapter for use in told if use is not None and use.adapter is not None and use.status in _READY]
        if not calls or len(pieces) < len(calls):
            continue
        names = {str(name) for piece in closure(pieces) for name in piece.libraries}
        if names.isdisjoint(str(library.name) for library in choice.candidates):
            functions = ", ".join(dict.fromkeys(str(call.calleeName) for call in calls))
            choice.chosenBy, choice.open, choice.choice = migration.ChosenBy.rule, False, NO_LIBRARY
            choice.evidence.append(f"what the program does here needs none: {functions}")


def _calls(plan: migration.MigrationPlan, component: hardware.Component) -> list[ccode.Call]:
    """The platform calls at the ports of a component; empty if one of these ports is open or has no known call."""
    found: list[ccode.Call] = []
    for binding in plan.portBindings:
        connections = [each for each in (binding.connection, binding.answer) if each is not None]
        if any(each.component is component for each in connections):
            calls = port_calls(plan, binding)
            if binding.open or not calls:
                return []
            found += calls
    return found
