"""The wirings of drawings at hand, handed back for Wokwi and as a table: read again they give the same pins.

Those of the project are always there; those of other people, of any tool, where ROBOSMI_DRAWINGS names a folder with them.
Parts that Wokwi lacks are listed by the export, and so no part of what has to be read again.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from robosmi.errors import RobosmiError
from robosmi.metamodels import migration
from robosmi.project import Project
from robosmi.transformations.chains.hardware import HardwareAnalysis, hardware
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.m2m.wokwi_wiring import wokwi_wiring
from robosmi.transformations.m2t.pin_table import pin_table
from robosmi.transformations.m2t.wokwi_project import diagram_text

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "tests" / "wiring" / "blink.c"
ENDINGS = (".json", ".sch", ".kicad_sch", ".net", ".fz", ".fzz")
PinMap = dict[tuple[str, str], tuple[str, ...]]
"""Pin and component -> the parts on the way."""


def drawings() -> Iterator[Path]:
    """All drawings at hand."""
    yield from sorted((ROOT / "docs" / "examples").rglob("*.fzz"))
    yield from sorted((ROOT / "tests" / "transformations" / "t2m" / "drawing_readers").rglob("robot.*"))
    for folder in filter(None, [os.environ.get("ROBOSMI_DRAWINGS")]):
        yield from (p for p in sorted(Path(folder).rglob("*.*")) if p.suffix in ENDINGS)


def told(mappings: Iterable[Mapping[str, Any]]) -> PinMap:
    """What a report says."""
    return {(m["pin"], m["component"]): tuple(via["title"] for via in m["via"]) for m in mappings}


def planned(connections: Iterable[migration.Connection]) -> PinMap:
    """What a plan says."""
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


def test_what_is_handed_back_has_the_same_pins(tmp_path: Path) -> None:
    counts: Counter[str] = Counter()
    wrong = []
    for path in drawings():
        made = read(path)
        if made is None:
            continue
        board = next(iter(made.board_models.values())).name
        plan = plan_migration([PROGRAM], project=Project(), hardware=path, target=board).plan
        wanted = planned(plan.connections)
        counts.update(drawings=1, pins=len(wanted))
        table, diagram = tmp_path / "wiring.csv", tmp_path / "diagram.json"
        if wanted:
            table.write_text(pin_table(list(plan.connections), board, table), encoding="utf-8")
            if (found := told(hardware(table).result["mappings"])) != wanted:
                wrong.append(f"{path}: as a table: {sorted(found.items() ^ wanted.items())}")
        try:
            drawn = wokwi_wiring(plan)
        except RobosmiError:  # Wokwi does not draw the board
            counts["no board of Wokwi"] += 1
            continue
        gone = {part.title for part in drawn.not_drawn}
        rest = {key: tuple(via for via in ways if via not in gone) for key, ways in wanted.items() if key[1] not in gone}
        diagram.write_text(diagram_text(drawn, "test"), encoding="utf-8")
        counts["pins drawn"] += len(rest)
        untitled = any(component.startswith("#") for _, component in rest)  # these have names of the export's own there
        if (found := told(hardware(diagram).result["mappings"])) != rest and not untitled:
            wrong.append(f"{path}: for Wokwi: {sorted(found.items() ^ rest.items())}")
    print(f"wirings handed back: {dict(counts)}")
    assert counts["drawings"] >= 5
    assert wrong == []
