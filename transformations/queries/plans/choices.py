"""Every choice that a user can make, as the contract's `choices[]`: a pin for each port, a library for each component.

A choice that was made keeps its options. A port is offered the pins that the drawing proposes, then each free pin that can do
what the program does with the port, then pins that other ports have, then `none`, which comes first where nothing that is drawn
fits. `answers` tells what a choice is called in a command and in a project file.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msgspec import Struct

from robosmi.base.data_text import Json
from robosmi.errors import UsageError, did_you_mean
from robosmi.metamodels import hardware, migration, platform
from robosmi.transformations.knowledge.part import GIVEN, ROLES
from robosmi.transformations.queries.plans.motors import free_motors
from robosmi.transformations.queries.plans.port_pins import NOT_WIRED, measures

NO_LIBRARY = "none"
"""The answer that a component needs no library."""


class Choice(Struct, frozen=True):
    """A decision of the plan under its identity: `port:NAME`, `library:ELEMENTID` or `role:ELEMENTID`."""

    id: str
    kind: str
    subject: str
    decision: migration.Decision


def choices(plan: migration.MigrationPlan) -> list[Choice]:
    """The choices of pins and libraries of a plan, in its order."""
    ports = [Choice(f"port:{b.name}", "port", str(b.name), b) for b in plan.portBindings]
    return ports + [
        Choice(f"library:{c.component.elementId}", "library", str(c.component.title), c)
        for c in plan.libraryChoices
        if c.component is not None
    ]


def the_choice(plan: migration.MigrationPlan, name: str) -> Choice:
    """The choice with this identity, or the only one whose port, component or `#elementId` is called so.

    Raises:
        UsageError: there is none, or more than one.
    """
    known = choices(plan)
    exact = [c for c in known if c.id == name]
    found = exact or [c for c in known if name in _names(c)]
    if len(found) == 1:
        return found[0]
    if found:
        raise UsageError(f"'{name}' is ambiguous", fix=f"use one of: {', '.join(c.id for c in found)}")
    ids = [c.id for c in known]
    raise UsageError(f"unknown choice '{name}'{did_you_mean(name, ids)}", fix=f"use one of: {', '.join(ids) or 'there are none'}")


def _names(choice: Choice) -> tuple[str, ...]:
    decision = choice.decision
    if isinstance(decision, migration.PortBinding):
        return (str(decision.name), *(str(each) for each in decision.names))
    component = decision.component if isinstance(decision, migration.LibraryChoice) else None
    return (choice.subject, f"#{component.elementId}") if component is not None else (choice.subject,)


class Option(NamedTuple):
    """An answer that the user may give: what to choose, how much speaks for it (0 to 1), and why."""

    value: str
    score: float
    why: str


class AvailableChoice(NamedTuple):
    """A choice as the user sees it.

    Attributes:
        id: what commands call it.
        kind: port, library or role.
        subject: what it is about.
        options: the answers, the best first.
        chosen: the answer that holds, None where there is none.
        by: who chose it, a literal of `migration.ChosenBy`.
        at: when, None where that is not known.
        why: what spoke for it.
    """

    id: str
    kind: str
    subject: str
    options: list[Option]
    chosen: str | None
    by: str
    at: str | None
    why: str

    def to_json(self) -> dict[str, Json]:
        """The choice in the contract's form."""
        return {**self._asdict(), "options": [option._asdict() for option in self.options]}


def available_choices(plan: migration.MigrationPlan) -> list[AvailableChoice]:
    """Every choice that the user may make: ports, then libraries, then roles of components whose role is unclear."""
    made = [
        AvailableChoice(
            id=choice.id,
            kind=choice.kind,
            subject=choice.subject,
            options=list(_options(plan, choice.decision)),
            chosen=None if choice.decision.open else choice.decision.choice,
            by=choice.decision.chosenBy.name,
            at=choice.decision.chosenAt or None,
            why=reason(choice.decision),
        )
        for choice in choices(plan)
    ]
    return made + [_role(component) for component in unclear_components(plan)]


def reason(decision: migration.Decision) -> str:
    """Why a decision was made; empty if the user gave no reason, which plans of earlier versions store as a text."""
    return "; ".join(str(each) for each in decision.evidence if each != "chosen by a person")


def choices_json(plan: migration.MigrationPlan) -> list[dict[str, Json]]:
    """Every choice that the user may make in the contract's form."""
    return [choice.to_json() for choice in available_choices(plan)]


def unclear_components(plan: migration.MigrationPlan) -> list[hardware.Component]:
    """The components at a pin whose role is unknown, so that the user may give it, and those whose role the user has given."""
    reached = {id(c.component): c.component for c in plan.connections if c.component is not None}
    given = [c for c in (plan.circuit.components if plan.circuit is not None else ()) if c.roleEvidence == GIVEN]
    return [*(c for c in reached.values() if c.role is hardware.Role.Unknown), *given]


def _role(component: hardware.Component) -> AvailableChoice:
    """The choice of a component's role: until the user says it, the component is taken for something that is read."""
    given = component.roleEvidence == GIVEN
    return AvailableChoice(
        id=f"role:{component.elementId}",
        kind="role",
        subject=component.title,
        options=[Option(role, 0.0, "") for role in ROLES if role not in ("Unknown", "Board")],
        chosen=component.role.name if given else hardware.Role.Input.name,
        by=migration.ChosenBy.person.name if given else migration.ChosenBy.defaultValue.name,
        at=None,
        why="" if given else "its role is unknown; RoboSMi treats it as an input device",
    )


def _options(plan: migration.MigrationPlan, decision: migration.Decision) -> Iterator[Option]:
    ranked = [(str(o.label), float(o.score), "; ".join(o.reasons)) for o in decision.options]
    if isinstance(decision, migration.PortBinding):
        named = {c.name: c.pin for c in plan.connections}
        ranked = [(label, score, _why_on(named.get(label), why, plan, decision)) for label, score, why in ranked]
        ranked = _with_motors(ranked, [str(motor.name) for motor in free_motors(plan, decision)])
        fitting = bool(ranked)
        offered = {id(named[label]) for label, _, _ in ranked if named.get(label) is not None}
        ranked += [
            (str(c.name), 0.0, _why_on(c.pin, _why_drawn(c.pin, decision), plan, decision))
            for c in plan.connections
            if c.pin is not None and id(c.pin) not in offered
        ]
        ranked += [(str(pin.label), 0.0, _pin_why(pin)) for pin in free_pins(plan, decision) if id(pin) not in offered]
        if all(label != NOT_WIRED for label, _, _ in ranked):
            first = not fitting and len(plan.connections) > 0  # nothing that is drawn fits
            why = "nothing that is drawn fits" if first else "not connected: its calls do nothing"
            ranked.insert(0 if first else len(ranked), (NOT_WIRED, 0.0, why))
        ranked = _free_first(ranked, plan, decision)
    elif isinstance(decision, migration.LibraryChoice):
        likely = decision.recommendation == NO_LIBRARY
        why = "probably no library needed" if likely else "no library needed"
        ranked.insert(0 if likely else len(ranked), (NO_LIBRARY, 0.0, why))
    chosen = "" if decision.open else str(decision.choice)
    if chosen and all(value != chosen for value, _, _ in ranked):
        ranked.insert(0, (chosen, float(decision.confidence), reason(decision)))
    yield from (Option(value, score, why) for value, score, why in ranked)


_MOTOR = 0.3
"""Score of a motor instead of a servo: as of a part that a function is usually used with."""


def _with_motors(ranked: list[tuple[str, float, str]], motors: list[str]) -> list[tuple[str, float, str]]:
    """The options with the motors that may stand for a servo before the weak matches."""
    strong = [option for option in ranked if option[1] >= _MOTOR]
    new = [name for name in motors if all(name != label for label, _, _ in strong)]
    weak = [option for option in ranked if option not in strong and option[0] not in new]
    return [*strong, *((name, _MOTOR, "turns a motor instead of a servo") for name in new), *weak]


def _free_first(
    ranked: list[tuple[str, float, str]], plan: migration.MigrationPlan, binding: migration.PortBinding
) -> list[tuple[str, float, str]]:
    """The options in their order, with those that another port has behind the free ones, and before a `none` at the end."""
    chosen = "" if binding.open else str(binding.choice)
    taken = [option for option in ranked if option[0] != chosen and used_by(plan, binding, option[0])]
    free = [option for option in ranked if option not in taken]
    end = len(free) - (len(free) > 1 and free[-1][0] == NOT_WIRED)
    return [*free[:end], *taken, *free[end:]]


def free_pins(plan: migration.MigrationPlan, binding: migration.PortBinding) -> list[platform.Pin]:
    """The pins of the board that no other port has, on which nothing is drawn, and which have the port's direction."""
    taken = {id(c.pin) for c in plan.connections if c.pin is not None}
    taken |= {id(b.pin) for b in plan.portBindings if b is not binding and b.pin is not None}
    pins = plan.board.pins if plan.board is not None else ()
    return [pin for pin in pins if id(pin) not in taken and _serves(pin, binding)]


def _serves(pin: platform.Pin, binding: migration.PortBinding) -> bool:
    """Whether a pin has the port's direction, and a converter where the port needs one.

    Each digital pin can read and write; one that is only analog can read.
    """
    if "digital" in pin.abilities:
        return measures(pin, binding)
    return "analog_in" in pin.abilities and binding.signal is migration.Signal.read


def _why_drawn(pin: platform.Pin, binding: migration.PortBinding) -> str:
    return "drawn; no evidence for it" if measures(pin, binding) else f"drawn; {pin.label} cannot measure a voltage"


def _why_on(pin: platform.Pin | None, why: str, plan: migration.MigrationPlan, binding: migration.PortBinding) -> str:
    """What speaks for a connection, after the other port that has its pin already, which matters most."""
    other = _user_of(pin, plan, binding)
    return "; ".join([*([f"used by port '{other}'"] if other else []), *([why] if why else [])])


def used_by(plan: migration.MigrationPlan, binding: migration.PortBinding, value: str) -> str:
    """The other port that has the pin of an option, empty if none has."""
    return _user_of(next((c.pin for c in plan.connections if c.name == value), None), plan, binding)


def _user_of(pin: platform.Pin | None, plan: migration.MigrationPlan, binding: migration.PortBinding) -> str:
    """The first other port on a pin, or whose component answers there."""
    if pin is None:
        return ""
    others = (b for b in plan.portBindings if b is not binding)
    return next((str(b.name) for b in others if b.pin is pin or (b.answer is not None and b.answer.pin is pin)), "")


def _pin_why(pin: platform.Pin) -> str:
    can = ", ".join(str(ability) for ability in pin.abilities)
    return f"free; {can}{f'; {pin.reserved}' if pin.reserved else ''}"
