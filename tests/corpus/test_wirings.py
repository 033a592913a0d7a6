"""The wirings of drawings at hand, handed back for Wokwi and as a table: read again they give the same pins.

Those of the project are always there; those of other people, of any tool, where ROBOSMI_DRAWINGS names a folder with them.
Parts that Wokwi lacks are listed by the export, and so no part of what has to be read again.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from robosmi.errors import RobosmiError
from robosmi.metamodels import migration
from robosmi.project import Project
from robosmi.transformations.chains.hardware import HardwareAnalysis, hardware
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.m2m.circuits.wokwi_wiring import wokwi_wiring
from robosmi.transformations.m2t.pin_table import pin_table
from robosmi.transformations.m2t.sketch_project import diagram_text
from robosmi.transformations.t2m.wokwi.document import read_diagram
from tests.wiring.elements import wokwi_elements

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "tests" / "wiring" / "blink.c"
ENDINGS = (".json", ".sch", ".kicad_sch", ".net", ".fz", ".fzz")
PinMap = dict[tuple[str, str], tuple[str, ...]]
"""(pin, component) -> titles of the parts between them."""


class Handed(NamedTuple):
    """The exports of one drawing: its pin map, the files (None for none), parts drawn, and titles of those only listed."""

    drawing: Path
    pins: PinMap
    table: Path | None
    diagram: Path | None
    parts: int
    listed: frozenset[str]


def drawings() -> Iterator[Path]:
    """All drawings at hand."""
    yield from sorted((ROOT / "docs" / "examples").rglob("*.fzz"))
    yield from sorted((ROOT / "tests" / "transformations" / "t2m" / "drawing_readers").rglob("robot.*"))
    for folder in filter(None, [os.environ.get("ROBOSMI_DRAWINGS")]):
        yield from (p for p in sorted(Path(folder).rglob("*.*")) if p.suffix in ENDINGS)


def told(mappings: Iterable[Mapping[str, Any]]) -> PinMap:
    """The pin map of a report."""
    return {(m["pin"], m["component"]): tuple(via["title"] for via in m["via"]) for m in mappings}


def planned(connections: Iterable[migration.Connection]) -> PinMap:
    """The pin map of a plan."""
    return {
        (
            c.pin.label if c.pin is not None else "",
            (c.component.title or f"#{c.component.elementId}") if c.component else "",
        ): tuple(via.title for via in c.via)
        for c in connections
    }


def read(path: Path) -> HardwareAnalysis | None:
    """A drawing with one board that the repository knows, else None."""
    try:
        made = hardware(path)
    except RobosmiError:
        return None
    return made if len(made.result["boards"]) == 1 and made.board_models else None


@pytest.fixture(scope="module")
def handed(tmp_path_factory: pytest.TempPathFactory) -> list[Handed]:
    """The exports of each available drawing with exactly one known board."""
    folder = tmp_path_factory.mktemp("handed")
    return [handed_back(path, made, folder / str(number)) for number, path in enumerate(drawings()) if (made := read(path))]


def handed_back(path: Path, made: HardwareAnalysis, folder: Path) -> Handed:
    """Export the wiring of a drawing as a table and for Wokwi, into a new folder."""
    folder.mkdir()
    board = next(iter(made.board_models.values())).name
    plan = plan_migration([PROGRAM], project=Project(), hardware=path, target=board).plan
    wanted = planned(plan.connections)
    table, diagram = folder / "wiring.csv", folder / "diagram.json"
    if wanted:
        table.write_text(pin_table(list(plan.connections), board, table, {}, {}), encoding="utf-8")
    try:
        drawn = wokwi_wiring(plan)
    except RobosmiError:  # Wokwi does not draw the board
        return Handed(path, wanted, table if wanted else None, None, 0, frozenset())
    diagram.write_text(diagram_text(drawn, "test"), encoding="utf-8")
    return Handed(path, wanted, table if wanted else None, diagram, len(drawn.parts), frozenset(p.title for p in drawn.not_drawn))


def test_what_is_handed_back_has_the_same_pins(handed: list[Handed]) -> None:
    counts: Counter[str] = Counter()
    wrong = []
    for each in handed:
        counts.update({"drawings": 1, "pins": len(each.pins)})
        if each.table is not None and (found := told(hardware(each.table).result["mappings"])) != each.pins:
            wrong.append(f"{each.drawing}: as a table: {sorted(found.items() ^ each.pins.items())}")
        if each.diagram is None:
            counts["no board of Wokwi"] += 1
            continue
        gone = each.listed
        rest = {key: tuple(via for via in ways if via not in gone) for key, ways in each.pins.items() if key[1] not in gone}
        counts.update({"pins drawn": len(rest), "parts drawn": each.parts, "parts listed": len(gone)})
        untitled = any(component.startswith("#") for _, component in rest)  # these have names of the export's own there
        counts["untitled"] += untitled
        if (found := told(hardware(each.diagram).result["mappings"])) != rest and not untitled:
            wrong.append(f"{each.drawing}: for Wokwi: {sorted(found.items() ^ rest.items())}")
    print(f"wirings handed back: {dict(counts)}")
    assert counts["drawings"] >= 5
    assert wrong == []


def test_what_is_handed_back_for_wokwi_are_types_and_pins_of_its_elements(handed: list[Handed]) -> None:
    elements = wokwi_elements()
    counts: Counter[str] = Counter()
    wrong = []
    for each in handed:
        if each.diagram is None:
            continue
        made = read_diagram(each.diagram)
        kinds = {part.identity: part for part in made.parts}
        own = {part.kind for part in read_diagram(each.drawing).parts} if each.drawing.suffix == ".json" else set()
        wrong += [f"{each.drawing}: {kind} is no type" for kind in {part.kind for part in made.parts} - {*elements} - own]
        for identity, _, pin in (end.rpartition(":") for connection in made.connections for end in connection.ends):
            part = kinds[identity]
            if part.kind not in elements:
                counts["of types that only the drawing has"] += 1
            elif part.attributes and pin not in elements[part.kind]:
                counts["of types with attributes, which have other pins"] += 1
            else:
                counts["pins of elements"] += 1
                if not {pin, f"{pin}.1"} & {*elements[part.kind]}:  # Wokwi takes COM for COM.1
                    wrong.append(f"{each.drawing}: {identity}:{pin} is no pin of {part.kind}")
    print(f"ends of wires: {dict(counts)}")
    assert wrong == []
