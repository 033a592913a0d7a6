"""Moves an output folder of `migrate` on to another board: the sources and the choices of its plan, with a drawing of the new
hardware or with pins that a pin table proposes.

The folder is only read. What persons chose there counts after the command line, the project file and the plan that is in the
new folder. An entry of [bind] that is a pin of the former board is not used: the plan has it with the part that it means.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from functools import partial
from pathlib import Path
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.errors import StoppedError, UsageError
from robosmi.metamodels import hardware, migration, platform
from robosmi.project import Project, load_project
from robosmi.transformations.chains.stages.hardware_stage import StoredDrawing, stored_drawing
from robosmi.transformations.chains.stages.models import FOLDER, PLAN, MigrationModels, stored_models
from robosmi.transformations.chains.stages.ports import pins_of_project
from robosmi.transformations.chains.stages.reading import read_drawing
from robosmi.transformations.chains.stages.sources import last_run, project_folder
from robosmi.transformations.constraints.plan_edits import refuse_nonsense
from robosmi.transformations.knowledge.electrical_facts import rests_beyond_names
from robosmi.transformations.knowledge.libraries.library_ranking import unsuitable
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, target_facts
from robosmi.transformations.m2m.choices.stored_choices import StoredChoices
from robosmi.transformations.m2m.moved_choices import (
    Carried,
    NewHardware,
    carried_choices,
    changes,
    proposed_pins,
    proposed_volts,
)
from robosmi.transformations.m2m.plan_tasks import settle
from robosmi.transformations.queries.circuits.former_titles import former_name, former_title
from robosmi.transformations.queries.plans.port_pins import NOT_WIRED
from robosmi.transformations.queries.source_text import is_header
from robosmi.transformations.t2m.c_source.parsing.sources import ENDINGS

NOT_APPROVED = "RS348"


class Moving(Struct):
    """A plan on its way to another board.

    Attributes:
        former: the models of the plan for the other board.
        place: the output folder that has them, which is only read.
        carried: the choices that still fit.
        table: the proposed pin table, the path that it is to have and its bytes; None with a drawing.
        approved: whether the user has approved it.
        copied: whether the sources are the copies in the output folder, beside which nothing may be written.
    """

    former: MigrationModels
    place: Path
    carried: Carried
    table: tuple[Path, bytes] | None = None
    approved: bool = False
    copied: bool = False

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Context manager: the proposed pin table can be read, although it is not written yet."""
        with inputs.provided(*self.table) if self.table is not None else nullcontext():
            yield

    def finish(self, plan: migration.MigrationPlan) -> None:
        """Record in the plan for the new board what changed."""
        waits = self.table is not None and not self.approved
        plan.move = changes(self.former.plan, plan, self.carried, pins_proposed=waits)
        if waits and self.table is not None:
            path = self.table[0]
            plan.findings.append(
                migration.PlanFinding(
                    rule=NOT_APPROVED, severity=migration.SeverityLevel.warning, path=f"source/{path.name}",
                    message=f"the pins of {plan.board.title if plan.board is not None else 'the board'} are proposed; "
                    "nobody has approved them yet",
                    fix=f"check {path}, change what is not right, and give it as the drawing: --hardware {path}",
                )
            )  # fmt: skip


def former_output(files: Sequence[str | Path]) -> Path | None:
    """The output folder of an earlier migration, if that is what is given instead of source files.

    A folder that has sources itself is a program's, also where it is its own output folder.
    """
    if len(files) != 1 or not (folder := Path(files[0])).is_dir() or not (folder / FOLDER / PLAN).is_file():
        return None
    return None if any(name.endswith(ENDINGS) for name in os.listdir(folder)) else folder


def check_places(former: Path, output: Path) -> None:
    """Make sure that the new folder is not in the former one, and not around it.

    Raises:
        UsageError: it is.
    """
    here, there = Path(os.path.realpath(former)), Path(os.path.realpath(output))
    if here == there:
        raise UsageError(
            f"-o {output} is the folder that is moved, which stays as it is", fix="give another folder with -o, such as "
            f"-o {former.parent / (here.name + '_moved')}",
        )  # fmt: skip
    if there.is_relative_to(here):
        raise UsageError(f"-o {output} is inside {former}, which stays as it is", fix="give a folder next to it")
    if here.is_relative_to(there):
        raise UsageError(f"-o {output} contains {former}, which stays as it is", fix="give a folder next to it")


class Arguments(Struct, frozen=True):
    """What a plan is moved with.

    Attributes:
        files: the program's source files.
        options: how it is migrated: options of `migrate` by their names.
        copied: whether the files are the copies in the output folder.
    """

    files: list[Path]
    options: dict[str, Any]
    copied: bool = False


def moving(
    former: Path,
    output: Path,
    *,
    target: str | None,
    drawing: Path | None,
    project: Project | None,
    ask: Callable[[Sequence[Mapping[str, str]]], bool] | None,
) -> tuple[Moving, Arguments]:
    """Read the plan of an output folder and prepare its move.

    Args:
        former: the folder.
        output: the folder for the new board.
        target: name of the new target.
        drawing: the drawing of the new hardware; None to propose a pin table.
        project: the project file; the one that `settings_of` finds if None.
        ask: asks the user whether the proposed pins are right; None to ask nobody.

    Raises:
        UsageError: no target is given, or the new folder is in or around the former one.
        SourceError: the folder's plan cannot be read, or the board has too few pins.
        StoppedError: the user does not approve the pins.
    """
    check_places(former, output)
    if target is None:
        raise UsageError(f"{former} is an output folder, and no new board is given", fix="give the board: --target NAME")
    facts = target_facts(target)
    models = stored_models(former)
    refuse_nonsense(models.plan)
    settle(models.plan, models.files)
    arguments = _arguments(former, models)
    settings = project if project is not None else settings_of(former)
    place, table, pins = drawing or _drawing_of(settings, facts), None, dict[str, str]()
    if place is None and models.circuit is not None:
        pins = proposed_pins(models.plan, facts.board_model)
        place = output / FOLDER / "source" / f"{models.plan.name}_{facts.board}.csv"
        table = (place, _table(models.plan, pins, facts, place).encode())
    with inputs.provided(*table) if table is not None else nullcontext():
        read, settings, lost = _read(place, settings, facts)
        new = _hardware_of(read, facts.board_model, pins)
    carried = carried_choices(models.plan, new, partial(_unsuitable, facts), former / FOLDER / PLAN)
    said, more = _pins_that_count(settings, facts, models.plan, new, carried)
    approved = table is not None and ask is not None and _asked(ask, models.plan, pins)
    moved = Moving(models, former, Carried(carried.choices, {**lost, **more, **carried.lost}), table, approved, arguments.copied)
    settings = replace(settings, bind=said, hardware=place, target=target)
    return moved, Arguments(arguments.files, {**arguments.options, "project": settings, "hardware": place, "target": target})


def settings_of(former: Path) -> Project:
    """The project file for an output folder: the one in it, else the one beside the program that its plan was made from.

    Raises:
        SourceError: the plan or the project file cannot be read.
    """
    own = load_project(former)
    if own.path is not None:
        return own
    folder, _ = project_folder(former, stored_models(former).plan)
    return load_project(folder) if folder is not None else own


def _unsuitable(facts: TargetFacts, library: str) -> str:
    return unsuitable(library, facts.libraries, facts.architecture)


def _asked(ask: Callable[[Sequence[Mapping[str, str]]], bool], plan: migration.MigrationPlan, pins: Mapping[str, str]) -> bool:
    rows = [
        {
            "before": str(c.pin.label), "pin": pins[str(c.pin.label)], "name": str(c.name),
            "ports": ", ".join(str(b.name) for b in plan.portBindings if b.connection is c),
        }
        for c in plan.connections
        if c.pin is not None
    ]  # fmt: skip
    if not ask(rows):
        raise StoppedError(
            "the proposed pins are not approved; nothing was written",
            fix="write them as you want them: robosmi wiring OUT --as csv -o pins.csv, change pin and board there, and give the "
            "file with --hardware",
        )
    return True


def _arguments(former: Path, models: MigrationModels) -> Arguments:
    """The program's files and how they were migrated.

    The files are those that were given, while they are as they were; else the copies in the output folder.
    """
    plan, run = models.plan, last_run(former)
    told: dict[str, Any] = {
        "widths": plan.widths.name, "bench": bool(plan.bench), "source_platform": plan.source.name if plan.source else None,
        "defines": [str(each) for each in models.program.defines],
        "adapters": run[1].get("adapters") if run is not None else None,
    }  # fmt: skip
    if run is not None and project_folder(former, plan)[0] is not None:
        files, arguments = run
        told["include_dirs"] = [Path(str(each)) for each in arguments.get("include_dirs", [])]
        told |= {name: arguments[name] for name in ("defines", "ranker") if name in arguments}
        return Arguments([Path(file) for file in files], told)
    units = [(former / FOLDER / str(unit.path), is_header(unit)) for unit in models.program.units]
    told["include_dirs"] = sorted({path.parent for path, header in units if header})
    return Arguments([path for path, header in units if not header], told, copied=True)


def _drawing_of(settings: Project, facts: TargetFacts) -> Path | None:
    """The drawing that the project file names, if it is for that target."""
    return settings.hardware if settings.target in facts.called else None


def _table(plan: migration.MigrationPlan, pins: Mapping[str, str], facts: TargetFacts, path: Path) -> str:
    """The proposed pin table."""
    by_label = {str(pin.label): pin for pin in facts.board_model.pins}
    rows = [
        migration.Connection(
            pin=by_label[pins[str(c.pin.label)]], component=c.component, connectors=list(c.connectors), via=list(c.via),
            name=str(c.name), signal=c.signal,
        )
        for c in plan.connections
        if c.pin is not None
    ]  # fmt: skip
    parts: Sequence[hardware.Component] = list(plan.circuit.components) if plan.circuit is not None else []
    from robosmi.transformations.m2t.pin_table import pin_table  # only a move without a drawing proposes pins

    return pin_table(rows, facts.board, path, rests_beyond_names(parts), proposed_volts(plan, facts.board_model))


def _read(path: Path | None, settings: Project, facts: TargetFacts) -> tuple[StoredDrawing | None, Project, dict[str, str]]:
    """The new drawing, the project file without what is said there of parts that it does not have, and why that is left out."""
    if path is None:
        return None, settings, {}
    titles: set[str] = set()
    if settings.roles or settings.libraries:
        titles = {
            name for c in read_drawing(path, {}, facts.board).circuit.components for name in (str(c.title), former_title(c))
        }
    roles = {name: role for name, role in settings.roles.items() if name in titles}
    lost = {name: f"the new drawing has no part '{name}'" for name in settings.roles if name not in titles}
    libraries = {name: library for name, library in settings.libraries.items() if name in titles}
    for name, library in [*libraries.items()]:
        why = _unsuitable(facts, library) if library.lower() != NOT_WIRED else ""
        if why:
            lost[name] = why
            del libraries[name]
    kept = replace(settings, roles=roles, libraries=libraries)
    return stored_drawing(path, roles, facts), kept, lost


def _hardware_of(drawing: StoredDrawing | None, board: platform.Board, pins: Mapping[str, str]) -> NewHardware:
    if drawing is None:
        return NewHardware(board)
    own = drawing.hardware.board
    components = [c for c in drawing.hardware.circuit.components if c is not own]
    return NewHardware(drawing.board, components, list(drawing.hardware.connections), pins)


def _pins_that_count(
    settings: Project, facts: TargetFacts, former: migration.MigrationPlan, new: NewHardware, carried: Carried
) -> tuple[dict[str, str], dict[str, str]]:
    """The pins that the project file gives and that mean the new board, and why others do not count, by port."""
    said = pins_of_project(settings, facts).pins
    shared = {name: pin for name, pin in said.items() if settings.bind.get(name) == pin}
    connections = {name for c in new.connections for name in (str(c.name), former_name(c))}
    before = {name for pin in (former.board.pins if former.board is not None else ()) for name in (pin.label, *pin.aliases)}
    labels = {name for pin in new.board.pins for name in (pin.label, *pin.aliases)} - before
    ports = {str(alias): str(b.name) for b in former.portBindings for alias in (b.name, *b.names)}
    left_out = [
        name
        for name, pin in shared.items()
        if name in ports and pin != NOT_WIRED and pin not in connections and pin not in labels
    ]
    known = {*carried.choices.ports, *carried.lost, *(ports[name] for name in said if name in ports and name not in shared)}
    was = former.board.title if former.board is not None else "another board"
    lost = {
        ports[name]: f"'{shared[name]}' in [bind] is for {was}; write the pin of {new.board.title} under [bind.{facts.target}]"
        for name in left_out
        if ports[name] not in known
    }
    return {name: pin for name, pin in settings.bind.items() if name not in left_out}, lost


def merged_choices(first: StoredChoices, second: StoredChoices) -> StoredChoices:
    """The choices of two stored plans, those of the first one before the others."""
    return StoredChoices({**second.ports, **first.ports}, {**second.libraries, **first.libraries}, first.place or second.place)
