"""A plan for one board made again for another: which choices of persons are carried over, which pins are proposed, and what the
two plans have in common.

A choice of a pin means the part that was drawn there. So it is carried over to the pin where the new drawing has that part, and
not to the pin of the same name; a pin without a part is carried over only where the new board has it by that name and it is
free. What is not carried over is listed with its reason.

Where there is no drawing of the new hardware, the parts get pins of the new board (`proposed_pins`). Each pin goes to one that
has the abilities which it needs there: the line of a bus to that line of the new board, an analogue part to an analogue input.
Of these, the pin of the same name or number comes first, then the one that has most of the former pin's abilities and fewest
others, so that pins with rare abilities stay free. Pins that the board itself uses are never proposed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

from msgspec import Struct

from robosmi.errors import SourceError
from robosmi.metamodels import hardware, migration, platform
from robosmi.transformations.m2m.choices.library_choice import NO_LIBRARY
from robosmi.transformations.m2m.choices.stored_choices import StoredChoices, UserChoice
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.queries.circuits.electrical import Role, fed_parts, wiring
from robosmi.transformations.queries.circuits.former_titles import former_name, former_title
from robosmi.transformations.queries.plans.port_pins import NOT_WIRED, bound_pin

KIND = migration.ChangeKind
_D = TypeVar("_D", bound=migration.Decision)

_ANALOG, _DIGITAL = "analog_in", "digital"
_DIGITS = re.compile(r"[0-9]+\Z")


class NewHardware(Struct, frozen=True):
    """The hardware to which a plan is moved.

    Attributes:
        board: the board.
        components: the drawn parts, without the board.
        connections: which pin is connected to which part.
        pins: pin of the former board -> pin of this one, as a pin table proposes; empty with a drawing.
    """

    board: platform.Board
    components: Sequence[hardware.Component] = ()
    connections: Sequence[migration.Connection] = ()
    pins: Mapping[str, str] = {}


class Carried(Struct, frozen=True):
    """What of a plan is carried over.

    Attributes:
        choices: the choices of persons, in the names of the new drawing.
        lost: name of a port or title of a component -> why the user's choice for it does not fit.
    """

    choices: StoredChoices
    lost: Mapping[str, str]


def carried_choices(
    former: migration.MigrationPlan, new: NewHardware, fits: Callable[[str], str], place: Path | None = None
) -> Carried:
    """The choices of persons in a plan that still fit on another board.

    Args:
        former: the plan for the other board, settled.
        new: the hardware.
        fits: library -> why it does not work on the new board; empty if nothing speaks against it.
        place: where the plan is stored, for messages.
    """
    lost: dict[str, str] = {}
    ports: dict[str, UserChoice] = {}
    parts = same_parts(former, new.components)
    for binding in of_persons(former.portBindings):
        value, why = _pin_of(binding, parts, new)
        if value:
            ports[str(binding.name)] = UserChoice(value, tuple(binding.evidence), str(binding.chosenAt))
        else:
            lost[str(binding.name)] = why
    libraries: dict[tuple[str, str], UserChoice] = {}
    for choice in of_persons(former.libraryChoices):
        if choice.component is None:
            continue
        name, part = str(choice.choice), parts.get(str(choice.component.elementId))
        why = "" if name == NO_LIBRARY else fits(name)
        if part is None:
            lost[str(choice.component.title)] = f"the new drawing has no part '{choice.component.title}'"
        elif why:
            lost[str(choice.component.title)] = why
        else:
            said = UserChoice(name, tuple(choice.evidence), str(choice.chosenAt))
            libraries[str(part.elementId), str(part.title)] = said
    return Carried(StoredChoices(ports, libraries, place), lost)


def of_persons(decisions: Iterable[_D]) -> list[_D]:
    """The decisions that persons have made."""
    return [each for each in decisions if each.chosenBy is migration.ChosenBy.person and not each.open]


def same_parts(former: migration.MigrationPlan, components: Sequence[hardware.Component]) -> dict[str, hardware.Component]:
    """Identity of a part in a plan's drawing -> the part of another drawing that is the same.

    The same are those of one title; of the others, those that are the only ones of their kind in both drawings.
    """
    old = [c for c in former.circuit.components if c is not former.boardComponent] if former.circuit is not None else []
    found: dict[str, hardware.Component] = {}
    for names in (_titles, _part_names):
        taken = {id(part) for part in found.values()}
        here = [c for c in old if str(c.elementId) not in found]
        there = [c for c in components if id(c) not in taken]
        for part in here:
            alike = [c for c in there if names(c) & names(part)]
            if len(alike) == 1 and sum(bool(names(c) & names(alike[0])) for c in here) == 1:
                found[str(part.elementId)] = alike[0]
    return found


def _titles(component: hardware.Component) -> set[str]:
    return {str(component.title), former_title(component)}


def _part_names(component: hardware.Component) -> set[str]:
    return {str(component.partTitle).lower(), str(component.partId).lower()} - {""}


def _pin_of(binding: migration.PortBinding, parts: Mapping[str, hardware.Component], new: NewHardware) -> tuple[str, str]:
    """What a port that the user has bound is bound to on the new board, or an empty text and why it fits nothing there."""
    if binding.choice == NOT_WIRED:
        return NOT_WIRED, ""
    if binding.connection is not None:
        found = same_connection(binding.connection, parts, new.connections)
        component = binding.connection.component
        part = f"'{component.title}'" if component is not None else f"{binding.connection.name}"
        return (found, "") if found else ("", f"the new drawing has no part that is the same as {part}")
    pin = bound_pin(binding)
    label = str(pin.label) if pin is not None else str(binding.choice)
    if label in new.pins:
        return new.pins[label], ""
    there = next((each for each in new.board.pins if each.label == label), None)
    if there is None:
        return "", f"{new.board.title} has no pin {label}"
    wired = next((c for c in new.connections if c.pin is there and c.component is not None), None)
    if wired is not None and wired.component is not None:
        return "", f"'{wired.component.title}' is on pin {label} of the new drawing"
    if pin is not None and (lacking := sorted({*pin.abilities} & _NEEDED - {*there.abilities})):
        return "", f"pin {label} of {new.board.title} lacks {', '.join(lacking)}"
    return label, ""


_NEEDED = {"pwm", "analog_in", "interrupt", "uart", "i2c", "spi"}


def same_connection(
    former: migration.Connection, parts: Mapping[str, hardware.Component], connections: Sequence[migration.Connection]
) -> str:
    """The name of the connection of the same part by the same connector; empty if there is none, or more than one."""
    part = parts.get(str(former.component.elementId)) if former.component is not None else None
    if part is None:
        return ""
    mine = [c for c in connections if c.component is part]
    wanted = _called(former)
    exact = [c for c in mine if _called(c) & wanted] or [c for c in mine if c.name in (former.name, former_name(former))]
    found = exact or [c for c in mine if c.signal is former.signal]
    return str(found[0].name) if len(found) == 1 else ""


def _called(connection: migration.Connection) -> set[str]:
    return {" ".join(displayed_name(c).lower().split()) for c in connection.connectors} - {""}


def changes(
    former: migration.MigrationPlan, plan: migration.MigrationPlan, carried: Carried, *, pins_proposed: bool
) -> migration.Move:
    """What changed between two plans of one program for two boards.

    Args:
        former: the plan for the other board.
        plan: the plan that was made from it.
        carried: what was carried over.
        pins_proposed: whether the pins come from a pin table that nobody has approved yet.
    """
    target = former.targetDescription
    made = migration.Move(
        target=target.name if target is not None else "", board=former.board.title if former.board is not None else "",
        pinsProposed=pins_proposed,
    )  # fmt: skip
    bound = {str(b.name): b for b in former.portBindings}
    for binding in plan.portBindings:
        name, said = str(binding.name), carried.choices.ports.get(str(binding.name))
        before = bound.get(name)
        lost = carried.lost.get(name, "")
        proposed = pins_proposed and bound_pin(binding) is not None
        kind = _kind(binding, said is not None and said.value in _values(binding), lost, proposed=proposed)
        made.changes.append(_change(kind, name, pin_text(before) if before else "", pin_text(binding), lost, binding))
    components = [c.component for c in plan.libraryChoices if c.component is not None]
    parts = {str(part.elementId): old for old, part in same_parts(former, components).items()}
    chosen = {str(c.component.elementId): c for c in former.libraryChoices if c.component is not None}
    seen: set[str] = set()
    for choice in plan.libraryChoices:
        if choice.component is None:
            continue
        old = chosen.get(parts.get(str(choice.component.elementId), ""))
        title = str(choice.component.title)
        lost = carried.lost.get(str(old.component.title), "") if old is not None and old.component is not None else ""
        seen |= {str(old.component.title)} if old is not None and old.component is not None else set()
        said = carried.choices.libraries.get((str(choice.component.elementId), title))
        kind = _kind(choice, said is not None and said.value == choice.choice, lost)
        made.changes.append(_change(kind, title, str(old.choice) if old is not None else "", str(choice.choice), lost, choice))
    told = {str(change.subject) for change in made.changes} | seen
    for subject, why in carried.lost.items():
        if subject not in told:
            gone = next((str(c.choice) for c in chosen.values() if c.component is not None and c.component.title == subject), "")
            made.changes.append(migration.PlanChange(kind=KIND.lost, subject=subject, before=gone, why=why))
    return made


def _kind(decision: migration.Decision, carried: bool, lost: str, *, proposed: bool = False) -> migration.ChangeKind:
    if lost:
        return KIND.lost
    if decision.open:
        return KIND.open
    if decision.chosenBy is not migration.ChosenBy.person or (proposed and carried):
        return KIND.proposed
    return KIND.kept if carried else KIND.decided


def _values(binding: migration.PortBinding) -> tuple[str, ...]:
    """The texts by which the user may have chosen what a port is bound to."""
    pin = bound_pin(binding)
    return (str(binding.choice), *((str(pin.label),) if pin is not None else ()))


def _change(
    kind: migration.ChangeKind, subject: str, before: str, after: str, lost: str, decision: migration.Decision
) -> migration.PlanChange:
    by_person = decision.chosenBy is migration.ChosenBy.person
    proposed = "your choice of the part; the pin is proposed" if by_person else "; ".join(decision.evidence)
    why = lost or (proposed if kind is KIND.proposed else "")
    return migration.PlanChange(kind=kind, subject=subject, before=before, after=after, why=why)


def pin_text(binding: migration.PortBinding) -> str:
    """The pin of a port with the part that is there; `not connected`, or empty while the choice is open."""
    if binding.open:
        return ""
    pin = bound_pin(binding)
    if pin is None:
        return "not connected"
    component = binding.connection.component if binding.connection is not None else None
    return f"{pin.label} ({component.title})" if component is not None else str(pin.label)


def update_move(plan: migration.MigrationPlan) -> None:
    """Bring what a plan says about its move in line with its decisions, which the user may have changed since."""
    if plan.move is None:
        return
    now: dict[str, tuple[migration.Decision, str]] = {str(b.name): (b, pin_text(b)) for b in plan.portBindings}
    now |= {str(c.component.title): (c, str(c.choice)) for c in plan.libraryChoices if c.component is not None}
    for change in plan.move.changes:
        decision, after = now.get(str(change.subject), (None, ""))
        if decision is not None and after != change.after:
            change.after, change.why = after, ""
            change.kind = _kind(decision, False, "")


def proposed_pins(plan: migration.MigrationPlan, board: platform.Board) -> dict[str, str]:
    """Pin of a plan's board that is in use -> pin of another board, by their labels.

    Args:
        plan: the plan.
        board: the other board.

    Raises:
        SourceError: the board has too few pins for them.
    """
    used: dict[str, platform.Pin] = {}
    for connection in plan.connections:
        if connection.pin is not None:
            used.setdefault(str(connection.pin.label), connection.pin)
    for binding in plan.portBindings:
        pin = bound_pin(binding)
        if pin is not None and binding.chosenBy is migration.ChosenBy.person:
            used.setdefault(str(pin.label), pin)
    free = [pin for pin in board.pins if not pin.reserved and {_DIGITAL, _ANALOG} & {*pin.abilities}]
    if len(used) > len(free):
        raise SourceError(
            f"{board.title} has {len(free)} free pins, and the parts need {len(used)}",
            fix="choose a board with more pins, or draw the new hardware and give it with --hardware",
        )
    made: dict[str, str] = {}
    order = {str(pin.label): _rank(pin, plan) for pin in used.values()}
    for label, pin in sorted(used.items(), key=lambda each: order[each[0]]):
        best = max(free, key=lambda there: _points(pin, there, plan, free))
        free.remove(best)
        made[label] = str(best.label)
    return {label: made[label] for label in used}


def proposed_volts(plan: migration.MigrationPlan, board: platform.Board) -> dict[str, float]:
    """Identity of a part of a plan's drawing -> the voltage that is to feed it on another board.

    It stays as it is drawn. A sensor that has more than the pins of the other board have, and that works with theirs by its data
    sheet, gets theirs, so that its output does not harm them.
    """
    if plan.circuit is None:
        return {}
    w, made = wiring(plan.circuit), fed_parts(plan.circuit)
    for component in plan.circuit.components:
        rated, identity = w.facts(component).volts, str(component.elementId)
        if component.role is Role.Input and rated is not None and made.get(identity, 0.0) > board.volts >= rated[0]:
            made[identity] = board.volts
    return made


def _rank(pin: platform.Pin, plan: migration.MigrationPlan) -> int:
    """The lines of buses first, then analogue parts: fewer pins can take them."""
    return 0 if _lines(pin, plan) else 1 if _needs_analog(pin, plan) else 2


def _points(
    pin: platform.Pin, there: platform.Pin, plan: migration.MigrationPlan, free: Sequence[platform.Pin]
) -> tuple[bool, bool, bool, int, int, int]:
    had, has = {*pin.abilities}, {*there.abilities}
    needs = {_ANALOG} if _needs_analog(pin, plan) else set()
    wanted = had & {_DIGITAL, "pwm", "interrupt"} | needs
    same = wanted <= has and (there.label == pin.label or (_number(there) == _number(pin) and not {_ANALOG} & (had | has)))
    return (
        bool(_lines(pin, plan) & {*there.aliases}), needs <= has, same,
        len(wanted & has), -len(has - wanted), -free.index(there),
    )  # fmt: skip


def _number(pin: platform.Pin) -> str:
    """The number in a pin's label: pins of the same number are easily taken for each other, and so best remain the same."""
    found = _DIGITS.search(str(pin.label))
    return found[0] if found is not None else str(pin.label)


def _wired(pin: platform.Pin, plan: migration.MigrationPlan) -> list[migration.Connection]:
    return [c for c in plan.connections if c.pin is pin]


def _lines(pin: platform.Pin, plan: migration.MigrationPlan) -> set[str]:
    """The lines of buses (SDA, MOSI ...) that a pin is wired as: names of the pin that a connector there has, too."""
    names = {displayed_name(k).upper() for c in _wired(pin, plan) for k in c.connectors}
    return names & {str(alias) for alias in pin.aliases}


def _needs_analog(pin: platform.Pin, plan: migration.MigrationPlan) -> bool:
    """Whether a part with an analogue output, or a port that is measured, is on a pin with an analogue input."""
    if _ANALOG not in pin.abilities:
        return False
    ports = [b.conventionalPort for b in plan.portBindings if bound_pin(b) is pin and b.conventionalPort is not None]
    measured = any(port.capability is platform.PinCapability.analog for port in ports)
    return measured or bool(_wired(pin, plan)) or not ports
