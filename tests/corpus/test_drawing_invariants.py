"""Invariants of all drawings of other people that are read; no labels are needed to see them broken.

A reader that joins separate things (pins without a number, labels of two sheets, bus rows) makes nets that nobody draws: both
ends of a lamp on one net, two pins of a board connected to each other, a supply connected to ground. People draw a few of
these, too; `odd_drawings.csv` lists each, judged by a person with the drawing. Any other one is a fault of a reader, or a row
to be judged. ROBOSMI_DRAWINGS names a folder with `OWNER+REPOSITORY/PATH` of each.
"""

from __future__ import annotations

import csv
import os
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from robosmi.errors import RobosmiError
from robosmi.metamodels import hardware as hw
from robosmi.transformations.chains.hardware import HardwareAnalysis, hardware

JUDGED = Path(__file__).parent / "odd_drawings.csv"
ENDINGS = (".json", ".sch", ".kicad_sch", ".net", ".fz", ".fzz")
MOST_OF_ALL = 0.6
"""Share of a drawing's wired connectors that one net may hold."""
LEAST_CONNECTORS = 12

Odd = tuple[str, str, str]
"""An oddity: its kind, the part, and pins or net names."""


def of_nets(circuit: hw.Circuit) -> Iterator[Odd]:
    """Nets that join what people keep apart, and a net that contains nearly all connectors."""
    wired = sum(len(net.connectors) for net in circuit.nets)
    for net in circuit.nets:
        connectors = list(net.connectors)
        parts = {id(connector.component): connector.component for connector in connectors if connector.component is not None}
        symbols = {part.partTitle for part in parts.values() if part.role is hw.Role.Power and len(part.connectors) == 1}
        if len(symbols - {"PWR FLAG", "PWR_FLAG"}) > 1:
            yield "supplies", "", " ".join(sorted(symbols))
        if len(connectors) > LEAST_CONNECTORS and len(connectors) > MOST_OF_ALL * wired:
            yield "nearly all", "", f"{len(connectors)} of {wired}"
        for part in parts.values():
            own = [c for c in connectors if c.component is part]
            pins = sorted({str(connector.pin) for connector in own if connector.pin})
            if len(pins) > 1:
                yield "pins tied", str(part.title), " ".join(pins)
            kinds = {connector.kind for connector in own}
            if {hw.ConnectorKind.supply, hw.ConnectorKind.ground} <= kinds:
                yield "supply on ground", str(part.title), " ".join(sorted(str(c.name or c.connectorId) for c in own))
        by_name = not any(
            owner.role is hw.Role.Power or (owner.role is hw.Role.Board and c.kind is not hw.ConnectorKind.signal)
            for c in connectors
            if (owner := c.component) is not None
        )
        if net.rail and by_name and (pins := sorted(str(c.pin) for c in connectors if c.pin)):
            yield "pin lost to a rail of names", "", " ".join(pins)


def of_parts(circuit: hw.Circuit) -> Iterator[Odd]:
    """Parts with all wired connectors on one net, although nothing inside the part joins them."""
    for part in circuit.components:
        wired = [connector for connector in part.connectors if connector.net is not None]
        inside = [{id(connector) for connector in bus.connectors} for bus in part.buses]
        if len(wired) < 2 or len({id(connector.net) for connector in wired}) > 1:
            continue
        if not any({id(connector) for connector in wired} <= joined for joined in inside):
            yield "one net", str(part.title), str(len(wired))


def of_mappings(made: HardwareAnalysis) -> Iterator[Odd]:
    """Components with more mappings than connectors and pins, and mappings with connectors of other components."""
    connectors = {part.elementId: {str(c.connectorId) for c in part.connectors} for part in made.circuit.components}
    boards = {part.elementId: {str(c.pin) for c in part.connectors if c.pin} for part in made.circuit.components}
    seen: Counter[str] = Counter()
    for mapping in made.result["mappings"]:
        identity, title = mapping["component_model_index"], mapping["component"]
        if not {c["id"] for c in mapping["connectors"]} <= connectors[identity]:
            yield "connector of nobody", title, " ".join(c["id"] for c in mapping["connectors"])
        if mapping["pin"] not in boards[mapping["board_model_index"]]:
            yield "pin of nobody", title, mapping["pin"]
        told = repr((identity, mapping["board_model_index"], mapping["pin"], sorted(c["id"] for c in mapping["connectors"])))
        seen[told] += 1
        if seen[told] > 1:
            yield "told twice", title, mapping["pin"]


def odd_drawings(folder: Path) -> tuple[set[tuple[str, ...]], int]:
    """All oddities in the drawings of a folder, each with its path, and the number of drawings read."""
    found: set[tuple[str, ...]] = set()
    read = 0
    for path in (p for p in sorted(folder.rglob("*.*")) if p.suffix in ENDINGS):
        try:
            made = hardware(path)
        except RobosmiError:  # the tests of each tool hold which may be refused
            continue
        read += 1
        place = path.relative_to(folder).as_posix()
        for odd in (*of_nets(made.circuit), *of_parts(made.circuit), *of_mappings(made)):
            found.add((place, *odd))
    return found, read


def test_nothing_is_odd_in_a_drawing_but_what_its_author_drew_so() -> None:
    folder = os.environ.get("ROBOSMI_DRAWINGS")
    if not folder:
        pytest.skip("ROBOSMI_DRAWINGS does not name a folder with the drawings")
    with JUDGED.open(encoding="utf-8", newline="") as file:
        judged = {(row["path"], row["odd"], row["part"], row["what"]) for row in csv.DictReader(file, delimiter=";")}
    found, read = odd_drawings(Path(folder))
    print(f"drawings read: {read}; odd and judged: {len(found & judged)}; odd and new: {len(found - judged)}")
    assert read > 0
    assert sorted(found - judged) == []
