"""Findings, completions and choices for the texts that the user edits: project files, pin tables, scenarios.

The readers and checks are those of the commands: they read the texts as if these were saved. Nothing is written; an answer to a
choice is the new text of the project file.

Completions are what may stand at a place of such a text: tables, keys, ports, pins, parts, roles, rules.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Literal

from msgspec import Struct

from robosmi.base.data_text import as_texts
from robosmi.diagnostics import Finding
from robosmi.errors import RobosmiError
from robosmi.generate.project_entries import changed_project, key_of
from robosmi.inputs import SETTINGS, SOURCE, provided, read_bytes, read_once, read_text
from robosmi.metamodels import migration, platform
from robosmi.plugins import content, registry
from robosmi.project import FILE_NAME, LEVELS, MIGRATE, RANK, TABLES, Project, default_text, defaults, load_project
from robosmi.query import Q
from robosmi.quoting import toml
from robosmi.report import Report
from robosmi.report.rules import finding_rules
from robosmi.resources import project_of_input
from robosmi.transformations.chains.check import check
from robosmi.transformations.chains.stages.edited_plan import STORED
from robosmi.transformations.chains.stages.models import MigrationModels, stored_models
from robosmi.transformations.chains.stages.readers import PROGRAM, is_drawing
from robosmi.transformations.chains.stages.reading import source_platforms
from robosmi.transformations.knowledge.board_models import board_names, load_board
from robosmi.transformations.knowledge.part import ROLES
from robosmi.transformations.knowledge.parts_catalogue import Catalogue
from robosmi.transformations.knowledge.platforms.target_platform import target_facts, target_names
from robosmi.transformations.queries.plans.answers import answer
from robosmi.transformations.queries.plans.choices import AvailableChoice, available_choices, the_choice
from robosmi.transformations.queries.plans.plan import as_findings
from robosmi.transformations.t2m.pin_table import COLUMNS, recognises
from robosmi.transformations.verification.bound_devices.played_devices import CONSOLE, signals_of
from robosmi.transformations.verification.bound_devices.port_devices import bound_ports
from robosmi.verify.scenario import KEYS, read_scenario

Kind = Literal["project", "pin table", "scenario", "other"]
_OFFERED = 5
"""Answers of a choice that an editor offers, the best first."""
_BEGINS = ("main", "setup")
"""Functions of which a file of a program has one."""

_KEY = re.compile(r"""\s*(?:"([^"]*)"|'([^']*)'|([\w.-]+))\s*=""")
_BARE = re.compile(r"[\w-]+", re.ASCII)
_ACCEPT = ("rule", "element", "reason")
_SWITCH, _REST = ("true", "false"), ("low", "high")


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
                return _in_project(lines[:line], begun, self._plans_at(path.parent), path.parent)
            if kind == "scenario":
                return _in_scenario(lines[:line], begun, self._plans_at(path.parent))
            return _in_pin_table(path, lines, line, begun) if kind == "pin table" else (column, [])

    def answers(self, path: Path, line: int) -> list[ChoiceEdit]:
        """The answers to the choice whose entry stands in a line of a project file; those to all open choices elsewhere."""
        if self.kind(path) != "project":
            return []
        found: list[ChoiceEdit] = []
        lines = self.texts[path].splitlines()
        table, key = _key_at(lines, line)
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


class Suggestion(Struct, frozen=True):
    """A word that may stand at a place, and what it means."""

    text: str
    detail: str = ""


_Place = tuple[int, list[Suggestion]]
"""The column from which a line is replaced, and what may stand there."""


def _key_at(lines: Sequence[str], line: int) -> tuple[str, str]:
    """The table and the key of the entry in a line; empty texts where there is none."""
    found = _KEY.match(lines[line]) if line < len(lines) else None
    return (_table(lines[:line]), next(name for name in found.groups() if name is not None)) if found else ("", "")


def _in_project(above: Sequence[str], begun: str, plans: Sequence[MigrationModels], folder: Path) -> _Place:
    """What may stand in a line of a project file.

    Args:
        above: the lines above it.
        begun: the line up to the place.
        plans: the plans of the programs beside the file.
        folder: its folder.
    """
    if begun.lstrip().startswith("["):
        return begun.rindex("[") + 1, _words(TABLES)
    table = _table(above)
    if "=" not in begun:
        return _keys(begun, _project_keys(table, plans))
    return _values(begun, _project_values(table, _key_at([*above, begun], len(above))[1], plans, folder))


def _in_scenario(above: Sequence[str], begun: str, plans: Sequence[MigrationModels]) -> _Place:
    """What may stand in a line of a scenario; as `_in_project`."""
    if begun.lstrip().startswith("["):
        return begun.rindex("[") + 1, [Suggestion("signals", "inputs over time")]
    if "=" in begun:
        return len(begun), []
    if not _table(above):
        return _keys(begun, _words(KEYS))
    ports = [port for models in plans for port in bound_ports(models.plan) if port.device]
    named = [Suggestion(name, port.device) for port in ports for name in (port.component, port.name, port.target) if name]
    return _keys(begun, [*named, Suggestion(CONSOLE, "typed texts")])


def _in_pin_table(path: Path, lines: Sequence[str], line: int, begun: str) -> _Place:
    """What may stand in a line of a pin table.

    Args:
        path: its file.
        lines: its lines.
        line: number of the line, from 0.
        begun: the line up to the place.
    """
    if path.suffix.lower() == ".toml":
        if "=" not in begun:
            return _keys(begun, _words(COLUMNS))
        column = _key_at([begun], 0)[1]
        rows = [{key: value} for key, value in re.findall(r'^\s*(\w+)\s*=\s*"([^"]*)"', "\n".join(lines), re.MULTILINE)]
        return _values(begun, _cells(path, column, rows))
    first = next((n for n, text in enumerate(lines) if text.strip() and not text.startswith("#")), 0)
    header = lines[first] if lines else ""
    separator = max(",;\t", key=header.count)
    start = begun.rfind(separator) + 1
    if line <= first:
        return start, [each for each in _words(COLUMNS) if each.text not in header.lower().split(separator)]
    names = [name.strip().lower() for name in header.split(separator)]
    number = len(next(csv.reader([begun], delimiter=separator), [""])) - 1 if begun else 0
    column = names[number] if number < len(names) else ""
    others = [text for n, text in enumerate(lines) if n > first and n != line and not text.startswith("#")]
    rows = [dict(zip(names, (cell.strip() for cell in row), strict=False)) for row in csv.reader(others, delimiter=separator)]
    return start, [
        Suggestion(f'"{each.text}"' if separator in each.text else each.text, each.detail) for each in _cells(path, column, rows)
    ]


def _cells(path: Path, column: str, rows: Sequence[Mapping[str, str]]) -> list[Suggestion]:
    """What a column of a pin table may hold, with what the other rows hold."""
    if column == "pin":
        used = {row.get("pin", "") for row in rows}
        return [each for each in _pins(_board(path, rows)) if each.text not in used]
    if column == "part":
        return [Suggestion(title, role) for title, role in Catalogue(path.parent).titles().items()]
    if column == "title":
        return _words(dict.fromkeys(row["title"] for row in rows if row.get("title")))
    listed = {"role": ROLES, "driver": _SWITCH, "rest": _REST, "board": board_names(path.parent) if column == "board" else ()}
    return _words(listed.get(column, ()))


def _board(path: Path, rows: Sequence[Mapping[str, str]]) -> platform.Board:
    named, usual = next((row["board"] for row in rows if row.get("board")), ""), default_text("migrate", "target")
    try:
        return load_board(named or target_facts(load_project(path.parent).target or usual).board, path.parent)
    except RobosmiError:  # no such board, which is reported
        return load_board(target_facts(usual).board, path.parent)


def _pins(board: platform.Board) -> list[Suggestion]:
    return [Suggestion(str(pin.label), ", ".join(map(str, (*pin.abilities, *pin.aliases)))) for pin in board.pins]


def _project_keys(table: str, plans: Sequence[MigrationModels]) -> list[Suggestion]:
    if table == "migrate":
        return _words(MIGRATE)
    if table == "rank":
        return _words(RANK)
    if table == "accept":
        return _words(_ACCEPT)
    if table == "severity":
        return _rules()
    if table == "roles":
        circuits = [models.plan.circuit for models in plans if models.plan.circuit is not None]
        return [Suggestion(str(c.title), f"{c.partTitle}, now {c.role.name}") for each in circuits for c in each.components]
    kind = {"bind": "port", "libraries": "library"}.get(table.partition(".")[0])
    choices = [choice for models in plans for choice in available_choices(models.plan) if choice.kind == kind]
    return [Suggestion(c.subject, "open" if c.chosen is None else f"is {c.chosen}") for c in choices]


def _project_values(table: str, key: str, plans: Sequence[MigrationModels], folder: Path) -> list[Suggestion]:
    if table == "migrate":
        if key == "hardware":
            return _words(path.name for path in sorted(folder.iterdir()) if path.is_file() and is_drawing(path))
        known = {"target": target_names, "source_platform": source_platforms, "from": board_names}
        return _words(known[key]()) if key in known else []
    if table == "rank":
        return _words(registry().names("ranker"))
    if table == "accept" and key == "rule":
        made = {str(found.rule): str(found.message) for models in plans for found in models.plan.findings}
        return [Suggestion(rule, message) for rule, message in made.items()]
    if table == "severity":
        return _words(LEVELS)
    if table == "roles":
        return _words(ROLES)
    if table.partition(".")[0] == "bind":
        return _bound(key, plans)
    chosen = [c for models in plans for c in available_choices(models.plan) if table == "libraries" and key == c.subject]
    return [Suggestion(option.value, option.why) for choice in chosen for option in choice.options]


def _bound(key: str, plans: Sequence[MigrationModels]) -> list[Suggestion]:
    """The pins for a port, the best first; all pins of the board where the port is not known."""
    found: list[Suggestion] = []
    for models in plans:
        drawn = {str(c.name): c for c in models.plan.connections}
        options = [o for c in available_choices(models.plan) if c.kind == "port" and c.subject == key for o in c.options]
        found += [_pin(drawn.get(option.value), option.value, option.why) for option in options]
        if not options and models.plan.board is not None:
            found += _pins(models.plan.board)
    return found


def _pin(connection: migration.Connection | None, value: str, why: str) -> Suggestion:
    if connection is None or connection.pin is None:
        return Suggestion(value, why)
    title = f"{connection.component.title}; " if connection.component is not None else ""
    return Suggestion(str(connection.pin.label), f"{title}{why}")


def _table(above: Sequence[str]) -> str:
    heads = [line.strip() for line in above if line.lstrip().startswith("[")]
    return heads[-1].partition("]")[0].lstrip("[").replace('"', "").strip() if heads else ""


def _words(words: Iterable[str]) -> list[Suggestion]:
    return [Suggestion(word) for word in words]


def _rules() -> list[Suggestion]:
    return [Suggestion(rule.id, rule.name) for rule in finding_rules().values()]


def _keys(begun: str, found: Iterable[Suggestion]) -> _Place:
    """Keys of a table, in quotation marks where TOML needs them."""
    start = len(begun) - len(begun.lstrip())
    return start, [Suggestion(s.text if _BARE.fullmatch(s.text) else toml(s.text), s.detail) for s in found]


def _values(begun: str, found: Iterable[Suggestion]) -> _Place:
    """Values of a key, in quotation marks."""
    after = begun.index("=") + 1
    start = after + len(begun[after:]) - len(begun[after:].lstrip())
    return start, [Suggestion(toml(each.text), each.detail) for each in found]
