"""Takes over the user's choices from a stored plan into the plan made anew, and decides which of several choices counts.

The order is: flag, project file, stored plan, history, rule. A stored choice for something that no longer exists is dropped
with a finding; differences between flag, project file and stored plan are reported as well. `chains.stages.edited_plan`
reads the stored plan.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import migration
from robosmi.transformations.knowledge.platforms.board_pins import pins_by_name
from robosmi.transformations.queries.circuits.former_titles import former_name, former_title

DIFFERENT, GONE = "RS413", "RS414"


class UserChoice(Struct, frozen=True):
    """The user's choice: the value, the reason, and the time (as `Decision.chosenAt`)."""

    value: str
    why: tuple[str, ...] = ()
    at: str = ""


class StoredChoices(Struct, frozen=True):
    """The user's choices in a stored plan.

    Attributes:
        ports: name of a port -> pin or connection, or `none`.
        libraries: (elementId, title) of a component -> library, or `none`.
        place: the plan's file, for messages.
    """

    ports: Mapping[str, UserChoice] = {}
    libraries: Mapping[tuple[str, str], UserChoice] = {}
    place: Path | None = None


NOTHING = StoredChoices()
"""The choices if there is no stored plan."""


def choices_of_persons(plan: migration.MigrationPlan, place: Path | None = None) -> StoredChoices:
    """The choices that persons have made in a plan.

    Args:
        plan: the plan, settled.
        place: where it is stored.
    """
    made = [d for d in (*plan.portBindings, *plan.libraryChoices) if d.chosenBy is migration.ChosenBy.person and not d.open]
    return StoredChoices(
        {str(d.name): _said(d) for d in made if isinstance(d, migration.PortBinding)},
        {
            (str(d.component.elementId), str(d.component.title)): _said(d)
            for d in made
            if isinstance(d, migration.LibraryChoice) and d.component is not None
        },
        place,
    )


def _said(decision: migration.Decision) -> UserChoice:
    return UserChoice(str(decision.choice), tuple(decision.evidence), str(decision.chosenAt))


def explain(decision: migration.Decision, said: UserChoice | None) -> None:
    """Copy reason and time of the user's decision from the stored plan, if it chose the same."""
    if said is not None and said.value == decision.choice and decision.chosenBy is migration.ChosenBy.person:
        decision.chosenAt = said.at
        if said.why or said.at:  # one that is made without a reason has none
            decision.evidence.clear()
            decision.evidence.extend(said.why)


def differences(
    plan: migration.MigrationPlan,
    flags: Mapping[str, Mapping[str, str]],
    project: Mapping[str, Mapping[str, str]],
    project_place: Path | None,
    stored: StoredChoices,
) -> list[Finding]:
    """Findings about choices that several places make differently, and about stored choices that no longer apply.

    Args:
        plan: the plan that was made from them.
        flags: the command line's choices under the keys `bind` and `libraries`.
        project: the project file's choices under the same keys.
        project_place: the project file.
        stored: the stored plan's choices.
    """
    found: list[Finding] = []
    for decision, subject, kind, kept in _subjects(plan, stored):
        of_flag = _of(flags.get(kind, {}), decision)
        of_project = _of(project.get(kind, {}), decision)
        told = [("the command line", of_flag), (project_place.name if project_place else "the project file", of_project)]
        told.append(("the last plan", kept.value if kept is not None else None))
        counted = [(who, value) for who, value in told if value is not None]
        different = {value for _, value in counted}
        if len(different) > 1 and len({_meant(value, plan) for value in different}) > 1:
            others = "; ".join(f"{who} has {value}" for who, value in counted[1:])
            message = f"{subject}: {counted[0][1]} from {counted[0][0]} is used; {others}"
            place = Location(str(project_place)) if project_place is not None and of_project is not None else None
            found.append(Finding(DIFFERENT, Severity.info, message, place, fix="use one value everywhere, or remove the others"))
        elif kept is not None and len(counted) == 1 and decision.choice != kept.value:
            found.append(_gone(subject, kept, stored))
    found += _lost(plan, stored)
    return found


def _subjects(
    plan: migration.MigrationPlan, stored: StoredChoices
) -> Iterator[tuple[migration.Decision, str, str, UserChoice | None]]:
    for binding in plan.portBindings:
        yield binding, f"the port '{binding.name}'", "bind", stored.ports.get(str(binding.name))
    for choice in plan.libraryChoices:
        if choice.component is not None:
            component = choice.component
            titles = (str(component.title), former_title(component))
            said = next((found for t in titles if (found := stored.libraries.get((str(component.elementId), t)))), None)
            yield choice, f"the library of '{component.title}'", "libraries", said


def _of(said: Mapping[str, str], decision: migration.Decision) -> str | None:
    """The value that one source of choices gives a decision, under any of the names of its subject."""
    if isinstance(decision, migration.PortBinding):
        return next((said[name] for name in (decision.name, *decision.names) if name in said), None)
    component = decision.component if isinstance(decision, migration.LibraryChoice) else None
    names = (f"#{component.elementId}", component.title, former_title(component)) if component is not None else ()
    return next((said[name] for name in names if name in said), None)


def _meant(value: str, plan: migration.MigrationPlan) -> object:
    """A value in normal form, so that different names of one pin or connection compare equal."""
    for connection in plan.connections:
        if connection.pin is not None and value in (connection.name, former_name(connection)):
            return id(connection.pin)
    pin = pins_by_name(plan.board).get(value) if plan.board is not None else None
    return id(pin) if pin is not None else value.lower()


def _lost(plan: migration.MigrationPlan, stored: StoredChoices) -> list[Finding]:
    """Findings about stored choices whose port or component no longer exists."""
    ports = {str(b.name) for b in plan.portBindings}
    drawn = [c.component for c in plan.libraryChoices if c.component is not None]
    components = {(str(c.elementId), title) for c in drawn for title in (str(c.title), former_title(c))}
    gone = [_gone(f"the port '{name}'", said, stored) for name, said in stored.ports.items() if name not in ports]
    return gone + [
        _gone(f"the library of '{title}'", said, stored)
        for (identity, title), said in stored.libraries.items()
        if (identity, title) not in components
    ]


def _gone(subject: str, said: UserChoice, stored: StoredChoices) -> Finding:
    message = f"{subject}: the last plan has {said.value}, which the program and its hardware no longer have"
    place = Location(str(stored.place)) if stored.place is not None else None
    return Finding(GONE, Severity.warning, message, place, fix="choose again, if it is still needed")
