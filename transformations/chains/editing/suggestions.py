"""What may stand at a place of a project file, a pin table or a scenario: tables, keys, ports, pins, parts, roles, rules."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from robosmi.errors import RobosmiError
from robosmi.metamodels import migration, platform
from robosmi.plugins import registry
from robosmi.project import LEVELS, MIGRATE, RANK, TABLES, default_text, load_project
from robosmi.quoting import toml
from robosmi.report.rules import finding_rules
from robosmi.transformations.chains.stages.models import MigrationModels
from robosmi.transformations.chains.stages.readers import is_drawing
from robosmi.transformations.chains.stages.reading import source_platforms
from robosmi.transformations.knowledge.board_models import board_names, load_board
from robosmi.transformations.knowledge.part import ROLES
from robosmi.transformations.knowledge.parts_catalogue import Catalogue
from robosmi.transformations.knowledge.platforms.target_platform import target_facts, target_names
from robosmi.transformations.queries.plans.choices import available_choices
from robosmi.transformations.t2m.pin_table import COLUMNS
from robosmi.transformations.verification.bound_devices.played_devices import CONSOLE
from robosmi.transformations.verification.bound_devices.port_devices import bound_ports
from robosmi.verify.scenario import KEYS

_KEY = re.compile(r"""\s*(?:"([^"]*)"|'([^']*)'|([\w.-]+))\s*=""")
_BARE = re.compile(r"[\w-]+", re.ASCII)
_ACCEPT = ("rule", "element", "reason")
_SWITCH, _REST = ("true", "false"), ("low", "high")


class Suggestion(Struct, frozen=True):
    """A word that may stand at a place, and what it means."""

    text: str
    detail: str = ""


Place = tuple[int, list[Suggestion]]
"""The column from which a line is replaced, and what may stand there."""


def key_at(lines: Sequence[str], line: int) -> tuple[str, str]:
    """The table and the key of the entry in a line; empty texts where there is none."""
    found = _KEY.match(lines[line]) if line < len(lines) else None
    return (_table(lines[:line]), next(name for name in found.groups() if name is not None)) if found else ("", "")


def in_project(above: Sequence[str], begun: str, plans: Sequence[MigrationModels], folder: Path) -> Place:
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
    return _values(begun, _project_values(table, key_at([*above, begun], len(above))[1], plans, folder))


def in_scenario(above: Sequence[str], begun: str, plans: Sequence[MigrationModels]) -> Place:
    """What may stand in a line of a scenario; as `in_project`."""
    if begun.lstrip().startswith("["):
        return begun.rindex("[") + 1, [Suggestion("signals", "inputs over time")]
    if "=" in begun:
        return len(begun), []
    if not _table(above):
        return _keys(begun, _words(KEYS))
    ports = [port for models in plans for port in bound_ports(models.plan) if port.device]
    named = [Suggestion(name, port.device) for port in ports for name in (port.component, port.name, port.target) if name]
    return _keys(begun, [*named, Suggestion(CONSOLE, "typed texts")])


def in_pin_table(path: Path, lines: Sequence[str], line: int, begun: str) -> Place:
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
        column = key_at([begun], 0)[1]
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


def _keys(begun: str, found: Iterable[Suggestion]) -> Place:
    """Keys of a table, in quotation marks where TOML needs them."""
    start = len(begun) - len(begun.lstrip())
    return start, [Suggestion(s.text if _BARE.fullmatch(s.text) else toml(s.text), s.detail) for s in found]


def _values(begun: str, found: Iterable[Suggestion]) -> Place:
    """Values of a key, in quotation marks."""
    after = begun.index("=") + 1
    start = after + len(begun[after:]) - len(begun[after:].lstrip())
    return start, [Suggestion(toml(each.text), each.detail) for each in found]
