"""The chain `choose`: makes the user's choice in the plan of an output folder, and commits it at once.

The plan records the value, who chose, when and why, and the sketch is generated again. If the project file lies beside the
sources of the plan, the value is stored there, too. Everything is written in one run, which a single `undo` reverts. All front
ends use this function: the command, the page, and any other.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from msgspec import field
from msgspec.structs import asdict, replace

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, UsageError, did_you_mean
from robosmi.files.commit import again_when_changed
from robosmi.files.files import digest
from robosmi.files.recovery import at_work, look_only
from robosmi.files.run_lock import alone
from robosmi.generate.output_paths import Places
from robosmi.generate.project_entries import ProjectChange, changed_project, displayed_path, key_of
from robosmi.metamodels import migration
from robosmi.project import FILE_NAME, Project, load_project
from robosmi.transformations.chains.move import migrate_or_move
from robosmi.transformations.chains.stages.edited_plan import STORED, refuse_unseen
from robosmi.transformations.chains.stages.models import CODE, FOLDER, HARDWARE, MigrationModels, stored_models
from robosmi.transformations.chains.stages.moving import former_output
from robosmi.transformations.chains.stages.output import Generated, produce, remember
from robosmi.transformations.chains.stages.refresh_findings import refresh_findings
from robosmi.transformations.chains.stages.sources import last_run, project_folder
from robosmi.transformations.chains.stages.user_includes import library_of
from robosmi.transformations.constraints.plan_edits import refuse_nonsense
from robosmi.transformations.knowledge.part import ROLES
from robosmi.transformations.m2m.plan_tasks import settle
from robosmi.transformations.m2m.ports.port_binding import bind_as_chosen
from robosmi.transformations.queries.plans.answers import answer
from robosmi.transformations.queries.plans.choices import NO_LIBRARY, Choice, choices_json, the_choice
from robosmi.transformations.queries.plans.plan import open_choices

ROLE = "role:"
"""Prefix of the identity of a choice about a component's role."""
STAYS = "RS415"
"""The rule for a choice that is stored in the plan only."""


class Chosen(Generated):
    """The result of a choice.

    Attributes:
        chosen: identity of each choice -> its value; an empty value reopens the choice.
        project: the project file that was updated, too; None if there is none.
        settings: the content of the project file beside the sources.
        command: the command line for the same choice.
    """

    chosen: dict[str, str] = field(default_factory=dict)
    project: Path | None = None
    settings: Project = field(default_factory=Project)
    command: str = ""

    @property
    def updated_project(self) -> str:
        """The project file that was updated, as a text for persons; empty if there is none."""
        return displayed_path(self.project) if self.project is not None else ""

    def result(self) -> dict[str, Any]:
        """The command's part of the document."""
        plan = self.models.plan
        return {
            "choices": [c for c in choices_json(plan) if c["id"] in self.chosen],
            "open_choices": len(open_choices(plan)),
            "project_file": str(self.project) if self.project is not None else None,
            "command": self.command,
            "sketch": str(self.sketch),
            "written": self.written,
            "diff": self.diff,
        }

    def lines(self, *, every_file: bool = False) -> list[str]:
        """What the user reads: the answers, the changes of the sketch's main file, the names of other files that changed.

        Args:
            every_file: show the changes of all files.
        """
        would = "" if self.written else "would be "
        lines = [f"{identity} {would}{f'= {value}' if value else 'open again'}" for identity, value in self.chosen.items()]
        left = len(open_choices(self.models.plan))
        where = f" and in {self.updated_project}" if self.project is not None else ""
        lines.append(f"{would}saved in the plan{where}; {quantity(left, 'choice')} open")
        if every_file:
            return [*lines, *self.diff.splitlines()]
        main = f"{self.sketch.name}/{self.sketch.name}."
        for name, change in self.changes.items():
            lines += change.splitlines() if name.startswith(main) else ()
        others = [name for name in self.changes if not name.startswith(main)]
        return [*lines, f"also changed: {', '.join(others)} (-v shows how)"] if others else lines


@again_when_changed
def choose(
    output: str | Path,
    answers: Mapping[str, str],
    *,
    why: str = "",
    source: str | Path | None = None,
    seen: str | None = None,
    dry_run: bool = False,
    history: str | None = None,
    read: Callable[[Path], MigrationModels] = stored_models,
) -> Chosen:
    """Choose in the plan of an output folder, and make the sketch again.

    Args:
        output: the output folder of a migration.
        answers: identity of a choice (`port:NAME`, `library:ELEMENTID`), or the name of a port or component -> the value: a
            pin, a connection, a library or `none`; an empty text leaves the choice open again.
        why: the reason, which is kept in the plan.
        source: a source of the program, where the place of the last migration's is not known; robosmi.toml lies beside it.
        seen: the digest of the plan that the person has seen; None to take it as it is.
        dry_run: write nothing.
        history: place of earlier choices, where libraries are counted; the user's own if None.
        read: gives the models that the folder holds, for the caller to change no more; from the files if not told otherwise.

    Raises:
        UsageError: there is no such choice or value.
        SourceError: the folder holds no plan, or it or the project file cannot be read, or the folder not be written.
        StoppedError: the plan is not the one that was seen, another run is at work, or the user's edit would be lost.
    """
    folder = Path(output)
    if not (folder / STORED).is_file():
        raise SourceError("this folder has no plan", location=Location(str(folder)), fix="give the output folder of a migration")
    if any(name.startswith(ROLE) for name in answers):
        return _roles(folder, answers, seen=seen, dry_run=dry_run)
    if dry_run:
        look_only(folder)
    with alone(folder) if dry_run else at_work(folder):
        data = Places(folder).read(STORED) or b""
        refuse_unseen(folder, data, seen)
        models = read(folder)
        unchanged = _as_stored(folder, models) if models.settled else {}
        if not models.settled:
            refuse_nonsense(models.plan)
            settle(models.plan, models.files)
        models.settled = False
        chosen = {}
        for name, value in answers.items():
            choice = the_choice(models.plan, name)
            decide(models.plan, choice, value.strip(), " ".join("".join(c if c.isprintable() else " " for c in why).split()))
            chosen[choice.id] = value.strip()
        settle(models.plan, models.files)
        refresh_findings(models.plan)
        place, reason = project_folder(folder, models.plan, Path(source) if source is not None else None)
        settings, change = Project(), ProjectChange({}, reason)
        if place is not None:
            settings = load_project(place)
            change = _project_change(models, chosen, place, settings, folder)
        made = produce(
            models,
            folder,
            inputs={STORED: data},
            outside=change.files,
            dry_run=dry_run,
            diff=True,
            unchanged=unchanged,
            run=f"choose {' '.join(f'{name}={value}' for name, value in chosen.items())}",
        )
    if change.stays:
        models.notes.append(_stays(folder, change.stays, known=place is not None))
    remember(made, history)
    project = place / FILE_NAME if place is not None and not change.stays else None
    return Chosen(**asdict(made), chosen=chosen, project=project, settings=settings, command=command_for(folder, chosen, why))


def _as_stored(folder: Path, models: MigrationModels) -> dict[str, bytes]:
    """The stored bytes of the models that choices do not change; serializing the code model takes longest."""
    wanted = {str(entry.path): str(entry.digest) for entry in models.plan.inputs if entry.path in (CODE, HARDWARE)}
    places = Places(folder)
    found = {name: places.read(f"{FOLDER}/{name}") or b"" for name in wanted}
    return {name: data for name, data in found.items() if digest(data) == wanted[name]}


def _roles(folder: Path, answers: Mapping[str, str], *, seen: str | None, dry_run: bool) -> Chosen:
    """Set the roles of components. They are read with the drawing, so the last migration is repeated.

    Raises:
        UsageError: there is no such component or role, or pins are chosen with it.
        SourceError: the sources of the plan are not known any more.
    """
    with alone(folder) if dry_run else at_work(folder):
        refuse_unseen(folder, Places(folder).read(STORED) or b"", seen)
        models = stored_models(folder)
        place, reason = project_folder(folder, models.plan)
        run = last_run(folder)
        components = {f"{ROLE}{c.elementId}": c for c in (models.circuit.components if models.circuit is not None else ())}
        titles = [str(c.title) for c in components.values()]
        said: dict[str, str | None] = {}
        for identity, role in answers.items():
            if identity not in components:
                raise UsageError(
                    f"unknown component '{identity}'", fix="choose roles in a command of their own, by the plan's ids"
                )
            if role and role not in ROLES:
                raise UsageError(f"unknown role '{role}'{did_you_mean(role, ROLES)}", fix=f"use one of: {', '.join(ROLES)}")
            component = components[identity]
            names = (f"#{component.elementId}", str(component.title))
            said[names[1] if titles.count(names[1]) == 1 else names[0]] = role or None
        if place is None or run is None:
            entries = ", ".join(f'"{name}" = "{role}"' for name, role in said.items())
            fix = f"write under [roles] in {FILE_NAME} next to the program: {entries}; then migrate again"
            raise SourceError(
                f"a role takes effect when the drawing is read: {reason}", location=Location(str(folder / STORED)), fix=fix
            )
        known, project = load_project(place), place / FILE_NAME
        entries_now = {key_of(project, "roles", (name,), name): role for name, role in said.items()}
        change = changed_project(place, {"roles": entries_now})
        if change.stays:
            fix = "make it writable, then choose again"
            raise SourceError(f"a role is kept there, and {change.stays}", location=Location(str(project)), fix=fix)
        roles = {name: role for name, role in {**known.roles, **entries_now}.items() if role is not None}
        files, arguments = run
        former = arguments.pop("moved_from", None)
        if former is not None and former_output([former]) is not None:
            files = [former]
        made = migrate_or_move(
            files, folder, project=replace(known, roles=roles), outside=lambda: change.files, dry_run=dry_run, **arguments
        )
    chosen = dict(answers)
    return Chosen(**asdict(made), chosen=chosen, project=project, settings=known, command=command_for(folder, chosen))


def decide(plan: migration.MigrationPlan, choice: Choice, value: str, why: str = "") -> None:
    """Make the user's choice of one decision in a plan; texts are updated when the plan is settled.

    Raises:
        UsageError: there is no such value.
    """
    decision = choice.decision
    if isinstance(decision, migration.PortBinding):
        assert plan.board is not None
        bind_as_chosen(decision, value, list(plan.connections), plan.board)
    elif isinstance(decision, migration.LibraryChoice):
        decision.chosen = library_of(plan, value) if value and value.lower() != NO_LIBRARY else None
        decision.choice = decision.chosen.name if decision.chosen is not None else NO_LIBRARY if value else ""
    decision.open = not value
    decision.chosenBy = migration.ChosenBy.person if value else migration.ChosenBy.nobody
    decision.confidence = 1.0 if value else 0.0
    decision.chosenAt = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ") if value else ""
    decision.evidence.clear()
    if value and why:
        decision.evidence.append(why)
    if isinstance(decision, migration.PortBinding) and decision.pin is not None:
        _release(plan, decision)


def _release(plan: migration.MigrationPlan, binding: migration.PortBinding) -> None:
    """Reopen the ports that a rule has bound to a pin which the user now gives another port, as a new migration would."""
    for other in plan.portBindings:
        if other is not binding and other.pin is binding.pin and other.chosenBy is migration.ChosenBy.rule:
            bind_as_chosen(other, "", (), plan.board)  # type: ignore[arg-type]
            other.open, other.chosenBy, other.confidence = True, migration.ChosenBy.nobody, 0.0
            other.evidence.clear()


def _project_change(
    models: MigrationModels, chosen: Mapping[str, str], folder: Path, settings: Project, output: Path
) -> ProjectChange:
    """The changed project file of a folder with the choices, and the reason if it has to stay unchanged.

    A choice by the name of a connection means nothing without its drawing, which is therefore named with it.
    """
    entries: dict[str, dict[str, str | None]] = {}
    for identity, value in chosen.items():
        decision = the_choice(models.plan, identity).decision
        how = answer(models.plan, decision)
        table = _table(how.table, models.plan, settings)
        key = key_of(folder / FILE_NAME, table, names_of(decision), how.subject)
        entries.setdefault(table, {})[key] = value or None
    wires = {str(c.name) for c in models.plan.connections}
    drawing = _drawing(output, folder) if settings.hardware is None and wires & {*chosen.values()} else ""
    if drawing:
        entries = {"migrate": {"hardware": drawing}, **entries}
    change = changed_project(folder, entries)
    entries.pop("migrate", None)
    tables = {"bind": settings.bind, "libraries": settings.libraries}
    tables |= {table: {} for table in entries if table not in tables}
    others = [f'{key} = "{tables[t][key]}"' for t, values in entries.items() for key in values if key in tables[t]]
    if change.stays and others:
        return replace(change, stays=f"{change.stays}, and says {', '.join(others)}, which counts when you migrate again")
    return change


def _drawing(output: Path, folder: Path) -> str:
    """The drawing of the last migration, relative to the project file's folder; empty if it is not in there."""
    run = last_run(output)
    path = Path(str(run[1]["hardware"])).absolute() if run is not None and run[1].get("hardware") else None
    inside = path is not None and path.is_file() and path.is_relative_to(folder)
    return path.relative_to(folder).as_posix() if path is not None and inside else ""


def _table(table: str, plan: migration.MigrationPlan, settings: Project) -> str:
    """The table for a choice: for pins of a plan that was moved to another board than the project's, that of its target."""
    target = str(plan.targetDescription.name) if plan.targetDescription is not None else ""
    own = plan.move is not None and target and settings.target != target
    return f"{table}.{target}" if table == "bind" and own else table


def names_of(decision: migration.Decision) -> tuple[str, ...]:
    """All names by which a project file may refer to the subject of a decision."""
    if isinstance(decision, migration.PortBinding):
        return (str(decision.name), *(str(each) for each in decision.names))
    component = decision.component if isinstance(decision, migration.LibraryChoice) else None
    return (str(component.title), f"#{component.elementId}") if component is not None else ()


def _stays(folder: Path, reason: str, *, known: bool) -> Finding:
    """The finding that a choice is stored in the plan only; `known` if the project file is known but cannot be written."""
    message = f"the choice is saved only in the plan, not in {FILE_NAME}: {reason}"
    way = "make it writable and choose again" if known else "give --source FILE, or migrate again from the sources"
    fix = f"{way}; the plan's choice is used"
    return Finding(STAYS, Severity.info, message, Location(str(folder / STORED)), fix=fix)


def command_for(output: Path, chosen: Mapping[str, str], why: str = "") -> str:
    """The command line that makes the same choice."""
    words = ["robosmi", "choose", str(output), *(f"{identity}={value}" for identity, value in chosen.items())]
    return shlex.join([*words, *(["--why", why] if why else [])])
