"""Findings, completions and choices for the texts that the user edits: project files, pin tables, scenarios.

The readers and checks are those of the commands: they read the texts as if these were saved. Nothing is written; an answer to a
choice is the new text of the project file.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Literal

from msgspec import Struct

from robosmi.base.data_text import as_texts
from robosmi.diagnostics import Finding
from robosmi.errors import RobosmiError
from robosmi.generate.project_entries import changed_project, key_of
from robosmi.inputs import SETTINGS, SOURCE, provided, read_bytes, read_once, read_text
from robosmi.metamodels import migration
from robosmi.plugins import content, registry
from robosmi.project import FILE_NAME, Project, defaults, load_project
from robosmi.query import Q
from robosmi.report import Report
from robosmi.resources import project_of_input
from robosmi.transformations.chains.check import check
from robosmi.transformations.chains.editing.suggestions import Suggestion, in_pin_table, in_project, in_scenario, key_at
from robosmi.transformations.chains.stages.edited_plan import STORED
from robosmi.transformations.chains.stages.models import MigrationModels, stored_models
from robosmi.transformations.chains.stages.readers import PROGRAM
from robosmi.transformations.queries.plans.answers import answer
from robosmi.transformations.queries.plans.choices import AvailableChoice, available_choices, the_choice
from robosmi.transformations.queries.plans.plan import as_findings
from robosmi.transformations.t2m.pin_table import recognises
from robosmi.transformations.verification.bound_devices.played_devices import signals_of
from robosmi.transformations.verification.bound_devices.port_devices import bound_ports
from robosmi.verify.scenario import read_scenario

Kind = Literal["project", "pin table", "scenario", "other"]
_OFFERED = 5
"""Answers of a choice that an editor offers, the best first."""
_BEGINS = ("main", "setup")
"""Functions of which a file of a program has one."""


class Examined(Struct):
    """What the commands say of a text: findings and tasks, and the errors that would stop them."""

    findings: list[Finding] = []
    errors: list[RobosmiError] = []


class ChoiceEdit(Struct, frozen=True):
    """An answer to a choice.

    Attributes:
        title: what it does, for a menu.
        best: whether nothing fits better.
        text: the project file's text with the answer.
    """

    title: str
    best: bool
    text: str


class Editor:
    """The texts that are being edited, by the paths of their files."""

    def __init__(self) -> None:
        self.texts = dict[Path, str]()
        self._plans: tuple[object, list[MigrationModels], list[RobosmiError]] = (None, [], [])

    def kind(self, path: Path) -> Kind:
        """What a file is, by its name and content."""
        text = self.texts.get(path, "")
        if path.name == FILE_NAME:
            return "project"
        if path.suffix.lower() == ".toml" and ("horizon_ms" in text or "[signals]" in text):
            return "scenario"
        return "pin table" if path.suffix.lower() in (".csv", ".toml") and recognises(text.encode()) else "other"

    def examine(self, path: Path) -> Examined:
        """What the commands say of a text and of the program beside it."""
        done, kind = Examined(), self.kind(path)
        with self._as_saved():
            try:
                if kind == "project":
                    self._of_programs(done, path.parent)
                elif kind == "scenario":
                    self._of_scenario(done, path)
                elif kind == "pin table":
                    done.findings += check(path).findings
                    if load_project(path.parent).hardware == path:
                        self._of_programs(done, path.parent)
            except RobosmiError as error:
                done.errors.append(error)
        done.findings = list({finding.id: finding for finding in done.findings}.values())
        return done

    def suggestions(self, path: Path, line: int, column: int) -> tuple[int, list[Suggestion]]:
        """What may stand at a place of a text.

        Args:
            path: its file.
            line: from 0.
            column: from 0, in characters.

        Returns:
            The column from which the text is replaced, and what may take its place.
        """
        kind, lines = self.kind(path), self.texts.get(path, "").splitlines()
        begun = lines[line][:column] if line < len(lines) else ""
        without = "\n".join([*lines[:line], "", *lines[line + 1 :]])  # a line that is being written is often no TOML
        with self._as_saved({path: without} if kind != "pin table" else {}), project_of_input(path):
            if kind == "project":
                return in_project(lines[:line], begun, self._plans_at(path.parent), path.parent)
            if kind == "scenario":
                return in_scenario(lines[:line], begun, self._plans_at(path.parent))
            return in_pin_table(path, lines, line, begun) if kind == "pin table" else (column, [])

    def answers(self, path: Path, line: int) -> list[ChoiceEdit]:
        """The answers to the choice whose entry stands in a line of a project file; those to all open choices elsewhere."""
        if self.kind(path) != "project":
            return []
        found: list[ChoiceEdit] = []
        lines = self.texts[path].splitlines()
        table, key = key_at(lines, line)
        with self._as_saved():
            for models in self._plans_at(path.parent):
                choices = available_choices(models.plan)
                named = [choice for choice in choices if table and key in _entry(models.plan, choice)[1]]
                for choice in named or [choice for choice in choices if choice.chosen is None]:
                    found += self._edits(models.plan, choice, path)
        return found

    def _edits(self, plan: migration.MigrationPlan, choice: AvailableChoice, path: Path) -> Iterator[ChoiceEdit]:
        table, names, own = _entry(plan, choice)
        pins = {str(c.name): c for c in plan.connections}
        for number, option in enumerate(choice.options[:_OFFERED]):
            drawn = pins.get(option.value)
            value = str(drawn.pin.label) if drawn is not None and drawn.pin is not None else option.value
            said = f" ({drawn.component.title})" if drawn is not None and drawn.component is not None else ""
            try:
                change = changed_project(path.parent, {table: {key_of(path, table, names, own): value}})
            except RobosmiError:  # the text does not parse yet, which is reported
                return
            best = number == 0 and option.score > max((o.score for o in choice.options[1:]), default=0.0)
            for _, new in change.files.values():
                yield ChoiceEdit(f"{choice.subject} = {value}{said}", best, (new or b"").decode())

    def _of_programs(self, done: Examined, folder: Path) -> None:
        """The findings of migrating each program of a folder, as its project file judges them."""
        project = load_project(folder)
        for models in self._plans_at(folder):
            done.findings += _judged(models, project)
        done.errors += self._plans[2]

    def _of_scenario(self, done: Examined, path: Path) -> None:
        """Whether a scenario fits a program beside it, or the migration in whose folder it is."""
        scenario = read_scenario(path)
        wrong: list[RobosmiError] = []
        for models in self._plans_at(path.parent):
            try:
                signals_of(bound_ports(models.plan), scenario)
                return
            except RobosmiError as error:
                wrong.append(error)
        done.errors += wrong[:1]

    def _plans_at(self, folder: Path) -> list[MigrationModels]:
        """The plan of the migration that a folder is in; else those that migrating the programs of the folder would make."""
        output = next((up for up in (folder, *folder.parents) if (up / STORED).is_file()), None)
        if output is not None:
            return [stored_models(output)]
        files = [path for path in _sources(folder) if _is_program(path)]
        key = (folder, tuple(self._read(path) for path in [folder / FILE_NAME, *files, *self.texts]))
        if key != self._plans[0]:
            plans, errors = list[MigrationModels](), list[RobosmiError]()
            for file in files:
                try:
                    plans.append(content("chain", "plan")([file]))
                except RobosmiError as error:
                    errors.append(error)
            self._plans = key, plans, errors
        return self._plans[1]

    def _read(self, path: Path) -> bytes:
        try:
            return read_bytes(path, SETTINGS if path.name == FILE_NAME else SOURCE)
        except OSError:
            return b""

    @contextmanager
    def _as_saved(self, other: Mapping[Path, str] | None = None) -> Iterator[None]:
        """Let every reader see the texts as if they were saved; `other` says what some have instead."""
        with ExitStack() as stack:
            stack.enter_context(read_once())
            for path, text in {**self.texts, **(other or {})}.items():
                stack.enter_context(provided(path, text.encode("utf-8", "surrogatepass")))
            yield


def _judged(models: MigrationModels, project: Project) -> Sequence[Finding]:
    report = Report("lsp")
    report.findings = [*models.notes, *as_findings(Q(models.plan.findings), models.places)]
    report.judge(project.severity, project.accept)
    return [*report.findings, *as_findings(Q(models.plan.tasks), models.places)]


def _entry(plan: migration.MigrationPlan, choice: AvailableChoice) -> tuple[str, tuple[str, ...], str]:
    """The table of the project file for a choice, the keys that mean it, and the key to write."""
    if choice.kind == "role":
        identity = f"#{choice.id.partition(':')[2]}"
        titles = [str(c.title) for c in plan.circuit.components] if plan.circuit is not None else []
        return "roles", (choice.subject, identity), choice.subject if titles.count(choice.subject) == 1 else identity
    decision = the_choice(plan, choice.id).decision
    how = answer(plan, decision)
    others = tuple(map(str, decision.names)) if isinstance(decision, migration.PortBinding) else (choice.subject,)
    return how.table, (how.subject, *others), how.subject


def _sources(folder: Path) -> list[Path]:
    readers, known = defaults()["readers"], {*registry().names(PROGRAM)}
    endings = {end for end, names in readers.items() if known & {*([names] if isinstance(names, str) else as_texts(names))}}
    try:
        return sorted(path for path in folder.iterdir() if path.suffix.lower() in endings)
    except OSError:
        return []


def _is_program(path: Path) -> bool:
    try:
        text = read_text(path, SOURCE, errors="replace")
    except OSError:
        return False
    return any(f"{name}(" in text or f"{name} (" in text for name in _BEGINS)
