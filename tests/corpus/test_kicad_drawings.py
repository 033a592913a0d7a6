"""KiCad schematics of other people against the boards that KiCad made of them.

A `.kicad_pcb` beside a schematic has the net of each pad, which KiCad itself has worked out. For each pin of the board that runs
the program, the pins on its net are compared with the pads on the pad's net, by reference and number; nothing of the reader is
used for the pads. `drawings/kicad.csv` lists the drawings, and those pairs that are stale, judged by a person: the board was
changed after the schematic, or the other way. The drawings are no part of the project: ROBOSMI_DRAWINGS names a folder with
`OWNER+REPOSITORY/PATH` of each.
"""

from __future__ import annotations

import csv
import os
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import sexpdata

from robosmi.metamodels import hardware
from robosmi.transformations.t2m.kicad import read_circuit

TABLE = Path(__file__).parent / "drawings" / "kicad.csv"


def drawings() -> list[tuple[dict[str, str], Path]]:
    """The rows whose drawings are there; the test is skipped where none is."""
    folder = os.environ.get("ROBOSMI_DRAWINGS")
    if not folder:
        pytest.skip("ROBOSMI_DRAWINGS does not name a folder with the drawings")
    with TABLE.open(encoding="utf-8", newline="") as file:
        listed = [
            (row, Path(folder) / row["repository"].replace("/", "+") / row["path"]) for row in csv.DictReader(file, delimiter=";")
        ]
    found = [(row, path) for row, path in listed if path.is_file()]
    if not found:
        pytest.skip("none of the KiCad drawings is in ROBOSMI_DRAWINGS")
    return found


def lists(found: list[Any], *heads: str) -> Iterator[list[Any]]:
    """The lists in a list that begin with one of these words."""
    for entry in found:
        if isinstance(entry, list) and entry and isinstance(entry[0], sexpdata.Symbol) and entry[0].value() in heads:
            yield entry


def text(value: Any) -> str:
    """A word or a text."""
    return str(value.value()) if isinstance(value, sexpdata.Symbol) else str(value)


def pads(board: Path) -> dict[tuple[str, str], frozenset[tuple[str, str]]]:
    """For each (reference, pad) all that are on its net."""
    nets: dict[str, set[tuple[str, str]]] = {}
    for footprint in lists(sexpdata.loads(board.read_text(encoding="utf-8")), "footprint", "module"):
        named = [text(t[2]) for t in lists(footprint, "fp_text") if text(t[1]) == "reference"]
        named += [text(t[2]) for t in lists(footprint, "property") if text(t[1]) == "Reference"]
        for pad in lists(footprint, "pad"):
            for net in lists(pad, "net") if named[0] != "REF**" else ():  # drawn on the board only
                nets.setdefault(text(net[-1]), set()).add((named[0], text(pad[1])))
    return {pad: frozenset(found) for found in nets.values() for pad in found}


def told_and_meant(path: Path) -> tuple[set[tuple[str, ...]], set[tuple[str, ...]]]:
    """(reference, pad, other reference, pad) for each pin of a board: what the reader tells, what the `.kicad_pcb` means."""
    circuit, _ = read_circuit(path)
    nets: dict[int, hardware.Net] = {id(connector): net for net in circuit.nets for connector in net.connectors}
    owners = {
        id(connector): component.title.rpartition("/")[2]
        for component in circuit.components
        for connector in component.connectors
    }
    meant_nets = pads(path.with_suffix(".kicad_pcb"))
    references = {reference for reference, _ in meant_nets}
    told: set[tuple[str, ...]] = set()
    meant: set[tuple[str, ...]] = set()
    for component in circuit.components:
        reference = component.title.rpartition("/")[2]
        if component.role is not hardware.Role.Board or reference not in references:
            continue
        for connector in component.connectors:
            if not connector.pin:
                continue
            here = (reference, connector.connectorId)
            if (net := nets.get(id(connector))) is not None:
                ends = {(owners[id(other)], other.connectorId) for other in net.connectors}
                told |= {(*here, *end) for end in ends - {here} if end[0] in references}
            meant |= {(*here, *end) for end in meant_nets.get(here, frozenset()) - {here}}
    return told, meant


def test_the_pins_of_the_boards_are_those_that_kicad_gave_them() -> None:
    counts: Counter[str] = Counter()
    wrong = []
    for row, path in drawings():
        if row["stale"] or not path.with_suffix(".kicad_pcb").is_file():
            continue
        told, meant = told_and_meant(path)
        counts.update(right=len(told & meant), told=len(told), meant=len(meant), drawings=bool(meant))
        if told != meant:
            wrong.append(f"{row['repository']} {row['path']}: {sorted(told ^ meant)}")
    print(f"KiCad: {counts['drawings']} drawings, {counts['told']} told, {counts['meant']} meant, {counts['right']} right")
    assert counts["meant"] > 0
    assert counts["right"] >= 0.99 * counts["told"], wrong
    assert counts["right"] >= 0.99 * counts["meant"], wrong


def test_every_drawing_is_read() -> None:
    """A sheet may be empty, so parts are not asked for."""
    for _, path in drawings():
        circuit, _ = read_circuit(path)
        assert circuit.tool == "KiCad"
