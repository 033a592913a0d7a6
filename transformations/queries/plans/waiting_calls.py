"""The state of each call of a platform function: whether it works, waits for a pin, or has no body.

A call works when its adapter has a body and every port that it can reach has a pin. The states describe the plan as it is;
nothing is decided here.
"""

from __future__ import annotations

from collections import Counter

from robosmi.metamodels import ccode, migration
from robosmi.query import Q
from robosmi.transformations.queries.plans.plan_adapters import closure, limits
from robosmi.transformations.queries.plans.port_pins import NO_PIN, NOT_WIRED, PIN_RULE
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.ports.macro_calls import MacroCalls

WORKS, WITH_CARE, WAITS, NOT_WIRED_CALL, TO_WRITE, NO_SUPPORT = (
    "works", "works_with_care", "waits_for_port", "not_wired", "to_write", "not_supported",
)  # fmt: skip
CALL_STATES = (WORKS, WITH_CARE, WAITS, NOT_WIRED_CALL, TO_WRITE, NO_SUPPORT)
"""The states of calls: with a body; with one that has limits; with one whose port has no pin yet, or is none of the source at
all; with one that is not wired by the user's word; without a body; of what the target lacks."""
NO_PORT = "RS326"
"""The rule of numbers that are no port of the source; calls with such a number do nothing."""
RUN_TIME = "RS327"
"""The rule of ports that only the running program knows; calls with such a port do nothing until one is bound."""


def open_conventions(plan: migration.MigrationPlan, use: migration.AdapterUse) -> Q[migration.PortBinding]:
    """The ports without a pin that the adapter of a use drives or reads by convention."""
    ports = {id(port) for piece in closure([use.adapter]) for port in piece.ports} if use.adapter is not None else set()
    return Q(plan.portBindings).select(lambda b: b.open and b.conventionalPort is not None and id(b.conventionalPort) in ports)


def unwired_needs(plan: migration.MigrationPlan, use: migration.AdapterUse) -> tuple[list[migration.PortBinding], bool]:
    """The ports of components that an adapter requires by convention, such as encoders, and that are not wired.

    The second result says whether all such ports are. An adapter requires the kind of component that its own piece names;
    others that it drives or reads are optional.
    """
    if use.adapter is None or not use.adapter.componentRole:
        return [], False
    role = use.adapter.componentRole
    ports = {id(port) for piece in closure([use.adapter]) for port in piece.ports if port.componentRole == role}
    needed = [b for b in plan.portBindings if b.conventionalPort is not None and id(b.conventionalPort) in ports]
    missing = [b for b in needed if not b.open and b.choice == NOT_WIRED]
    return missing, bool(missing) and len(missing) == len(needed)


def ports_of_runs_bound(plan: migration.MigrationPlan) -> bool:
    """Whether the user has bound ports that only the running program knows, so that RS327 asks nothing."""
    return any(b.origin == "given" and b.chosenBy is migration.ChosenBy.person for b in plan.portBindings)


def lacks_pin(flow: migration.PortFlow) -> bool:
    """Whether the calls of a flow get no pin because no place in the source could look up their ports."""
    return bool(flow.anything and not flow.bindings and all(change.rule == NO_PIN for change in flow.changes))


class CallStates:
    """The states of a plan's calls.

    Args:
        plan: the plan.
    """

    def __init__(self, plan: migration.MigrationPlan) -> None:
        self.plan = plan
        self._of_macros = MacroCalls(plan)
        told = (NO_PORT,) if ports_of_runs_bound(plan) else (NO_PORT, RUN_TIME)
        nowhere = {id(e): e for finding in plan.findings if finding.rule in told for e in finding.elements}
        self._nowhere = nowhere.keys()
        self._registers = sum(isinstance(element, ccode.NameReference) for element in nowhere.values())
        self._wrong = {id(e) for finding in plan.findings if finding.rule == PIN_RULE for e in finding.elements}
        flows = [f for f in plan.portFlows if f.bindings]
        unknown = [f for f in plan.portFlows if f.anything and not f.bindings]
        self._raw = {id(c) for f in plan.portFlows if lacks_pin(f) for c in f.calls}
        self._waiting = {id(c) for f in flows if any(b.open for b in f.bindings) for c in f.calls}
        if not ports_of_runs_bound(plan):
            self._waiting |= {id(c) for f in unknown for c in f.calls}
        self._unwired = {id(c) for f in flows if all(_left_out(b) for b in f.bindings) for c in f.calls}

    def of(self, use: migration.AdapterUse, call: ccode.Call) -> str:
        """The state of one call of an adapter's function."""
        if use.status is migration.AdapterStatus.unsupported:
            return NO_SUPPORT
        if use.status is migration.AdapterStatus.todo or id(call) in self._wrong:
            return TO_WRITE
        ports = self._of_macros.ports(use, call) if call.viaMacro else None
        waits = id(call) in self._waiting if ports is None else any(b.open for b in ports)
        if waits or id(call) in self._nowhere or id(call) in self._raw or open_conventions(self.plan, use):
            return WAITS
        unwired = id(call) in self._unwired if ports is None else bool(ports) and all(_left_out(port) for port in ports)
        if unwired_needs(self.plan, use)[1] or unwired:
            return NOT_WIRED_CALL
        return WITH_CARE if limits(use) else WORKS

    def counts(self) -> dict[str, int]:
        """How many calls are in each state, every state named, and `total`, their sum; those of macros at each place of use.

        An access of a register that may reach ports without a pin counts as a call that waits.
        """
        found = Counter(self.of(use, call) for use in self.plan.adapterUses for call in (*use.calls, *self._of_macros.of(use)))
        if retains_platform(self.plan):  # without adapters; what is known of its calls is that some wait
            found[WAITS] += len(self._waiting)
        else:
            found[WAITS] += self._registers
        return {"total": found.total(), **{state: found[state] for state in CALL_STATES}}


def _left_out(binding: migration.PortBinding) -> bool:
    """Whether the user said that a port is not wired."""
    return not binding.open and binding.choice == NOT_WIRED and binding.chosenBy is migration.ChosenBy.person
