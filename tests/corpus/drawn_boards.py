"""Compares drawings of other people with the boards (PCBs) that the drawing tools made of them: the part shared by all tools.

ROBOSMI_DRAWINGS names a folder with `OWNER+REPOSITORY/PATH` of each drawing that a table of `drawings/` lists.
"""

from __future__ import annotations

import csv
import os
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from itertools import combinations
from pathlib import Path

import pytest

from robosmi.errors import RobosmiError
from robosmi.metamodels import hardware as hw
from robosmi.transformations.chains.hardware import hardware

Pad = tuple[str, str]
"""A part by its reference, and its connector or pad."""
Rows = list[tuple[dict[str, str], Path]]


def drawings(tool: str) -> Rows:
    """The rows of a tool's table whose drawings are there; the test is skipped where none is."""
    folder = os.environ.get("ROBOSMI_DRAWINGS")
    if not folder:
        pytest.skip("ROBOSMI_DRAWINGS does not name a folder with the drawings")
    table = Path(__file__).parent / "drawings" / f"{tool.lower()}.csv"
    with table.open(encoding="utf-8", newline="") as file:
        listed = [
            (row, Path(folder) / row["repository"].replace("/", "+") / row["path"]) for row in csv.DictReader(file, delimiter=";")
        ]
    found = [(row, path) for row, path in listed if path.is_file()]
    if not found:
        pytest.skip(f"none of the {tool} drawings is in ROBOSMI_DRAWINGS")
    return found


def told_and_meant(
    circuit: hw.Circuit, on_board: Mapping[Pad, frozenset[Pad]], reference: Callable[[str], str] = str
) -> tuple[set[tuple[str, ...]], set[tuple[str, ...]]]:
    """The connections of each pin of a board as (part, pin, other part, connector): as the reader found them, and as they are.

    Args:
        circuit: the circuit that the reader made.
        on_board: pad of the PCB -> all pads on its net.
        reference: converts a title in the drawing to the PCB's name of the part.
    """
    nets: dict[int, hw.Net] = {id(connector): net for net in circuit.nets for connector in net.connectors}
    owners = {id(connector): reference(part.title) for part in circuit.components for connector in part.connectors}
    known = {part for part, _ in on_board}
    told: set[tuple[str, ...]] = set()
    meant: set[tuple[str, ...]] = set()
    for component in circuit.components:
        name = reference(component.title)
        if component.role is not hw.Role.Board or name not in known:
            continue
        for connector in component.connectors:
            if not connector.pin:
                continue
            here = (name, connector.connectorId)
            if (net := nets.get(id(connector))) is not None:
                ends = {(owners[id(other)], other.connectorId) for other in net.connectors}
                told |= {(*here, *end) for end in ends - {here} if end[0] in known}
            meant |= {(*here, *end) for end in on_board.get(here, frozenset()) - {here}}
    return told, meant


def all_told_and_meant(
    circuit: hw.Circuit, on_board: Mapping[Pad, frozenset[Pad]], reference: Callable[[str], str] = str
) -> tuple[set[tuple[str, ...]], set[tuple[str, ...]]]:
    """All connections as (part, connector, part, connector): as the reader found them, and as they are.

    Only connectors on nets of the PCB are judged, of parts with a unique reference. Arguments as in `told_and_meant`.
    """
    counts = Counter(reference(part.title) for part in circuit.components)
    owners = {id(c): reference(part.title) for part in circuit.components for c in part.connectors}
    judged = {(owners[id(c)], c.connectorId) for part in circuit.components for c in part.connectors} & on_board.keys()
    judged = {end for end in judged if counts[end[0]] == 1}

    def pairs(nets: Iterable[Iterable[Pad]]) -> set[tuple[str, ...]]:
        return {(*one, *other) for ends in nets for one, other in combinations(sorted(judged & {*ends}), 2)}

    told = pairs([(owners[id(c)], c.connectorId) for c in net.connectors] for net in circuit.nets)
    return told, pairs(set(on_board.values()))


def check_figures(
    tool: str, suffix: str, judged: Callable[[Path], tuple[set[tuple[str, ...]], set[tuple[str, ...]]]], what: str
) -> None:
    """Check precision and recall over all drawings with a PCB beside them that is not stale; print the counts."""
    counts: Counter[str] = Counter()
    wrong = []
    for row, path in drawings(tool):
        if row["stale"] or not path.with_suffix(suffix).is_file():
            continue
        told, meant = judged(path)
        counts.update(right=len(told & meant), told=len(told), meant=len(meant), drawings=bool(meant))
        if told != meant:
            wrong.append(f"{row['repository']} {row['path']}: {sorted(told ^ meant)}")
    print(
        f"{tool}, {what}: {counts['drawings']} drawings, {counts['told']} told, {counts['meant']} meant, {counts['right']} right"
    )
    assert counts["meant"] > 0
    assert counts["right"] >= 0.99 * counts["told"], wrong
    assert counts["right"] >= 0.99 * counts["meant"], wrong


def check_all_read(tool: str) -> None:
    """Check that every available drawing is analysed, with or without a board as its row says; print the counts."""
    counts: Counter[str] = Counter()
    refused = []
    for row, path in drawings(tool):
        try:
            made = hardware(path)
        except RobosmiError as error:
            refused.append(str(error))
            continue
        assert made.circuit.tool == tool
        what = "with a board" if made.result["boards"] else "without a board"
        counts[f"{row['board']} {what}"] += 1
        counts["parts"] += len(made.circuit.components)
        counts["nets"] += len(made.circuit.nets)
    print(f"{tool}: read {dict(counts)}, refused {len(refused)}")
    assert refused == []
