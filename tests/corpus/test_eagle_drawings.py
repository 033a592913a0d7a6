"""EAGLE schematics of other people against the boards that EAGLE made of them.

A `.brd` beside a schematic has for each signal the pads on it (`contactref`), which EAGLE itself has worked out. Here the pads
are found by the file alone: pin to pad by the device's `connect`, pad to signal by the board, and nothing of the reader is
used. For each pin of the board that runs the program, the pins on its net are compared. `drawings/eagle.csv` lists the pairs,
and those that are stale, judged by a person: the board was changed after the schematic, or the other way. The drawings are no
part of the project: ROBOSMI_DRAWINGS names a folder with `OWNER+REPOSITORY/PATH` of each.
"""

from __future__ import annotations

import csv
import os
from collections import Counter
from pathlib import Path

import pytest
from lxml import etree

from robosmi.metamodels import hardware
from robosmi.transformations.t2m.eagle import read_circuit

TABLE = Path(__file__).parent / "drawings" / "eagle.csv"


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
        pytest.skip("none of the EAGLE drawings is in ROBOSMI_DRAWINGS")
    return found


def of_board(schematic: Path) -> dict[tuple[str, str], frozenset[tuple[str, str]]]:
    """For each (part, connector) the (part, connector) on its signal, as the `.brd` has it."""
    drawn = parsed(schematic)
    wired: dict[tuple[str, str], str] = {}
    for part in drawn.iter("part"):
        wired.update({(part.get("name", ""), pad): pin for pad, pin in pads_of(drawn, part).items()})
    signals: dict[tuple[str, str], frozenset[tuple[str, str]]] = {}
    for signal in parsed(schematic.with_suffix(".brd")).iter("signal"):
        contacts = [(c.get("element", ""), c.get("pad", "")) for c in signal.iter("contactref")]
        ends = frozenset((element, wired[element, pad]) for element, pad in contacts if (element, pad) in wired)
        signals.update(dict.fromkeys(ends, ends))
    return signals


def pads_of(drawn: etree._Element, part: etree._Element) -> dict[str, str]:
    """Pad -> pin of a part, with its gate where several gates have a pin of that name."""
    libraries = [
        library
        for library in drawn.iter("library")
        if library.get("name") == part.get("library") and library.get("urn") == part.get("library_urn")
    ]
    for library in libraries:
        for chosen in library.iter("deviceset"):
            if chosen.get("name") != part.get("deviceset"):
                continue
            symbols = {
                symbol.get("name"): [pin.get("name", "") for pin in symbol.iter("pin")] for symbol in library.iter("symbol")
            }
            counts = Counter(pin for gate in chosen.iter("gate") for pin in symbols[gate.get("symbol")])
            device = next(d for d in chosen.iter("device") if d.get("name") == part.get("device"))
            return {
                pad: c.get("pin", "") if counts[c.get("pin", "")] == 1 else f"{c.get('gate')}.{c.get('pin')}"
                for c in device.iter("connect")
                for pad in c.get("pad", "").split()
            }
    return {}


def parsed(path: Path) -> etree._Element:
    """The root of a file of EAGLE's."""
    return etree.fromstring(path.read_bytes(), etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False))


def told_and_meant(path: Path) -> tuple[set[tuple[str, ...]], set[tuple[str, ...]]]:
    """(part, pin, other part, its connector) for each pin of a board: what the reader tells, what the `.brd` means."""
    circuit, _ = read_circuit(path)
    nets: dict[int, hardware.Net] = {id(connector): net for net in circuit.nets for connector in net.connectors}
    owners = {id(connector): component for component in circuit.components for connector in component.connectors}
    signals = of_board(path)
    elements = {part for part, _ in signals}
    told: set[tuple[str, ...]] = set()
    meant: set[tuple[str, ...]] = set()
    for component in circuit.components:
        if component.role is not hardware.Role.Board or component.title not in elements:
            continue
        for connector in component.connectors:
            if not connector.pin:
                continue
            here = (component.title, connector.connectorId)
            if (net := nets.get(id(connector))) is not None:
                ends = {(owners[id(other)].title, other.connectorId) for other in net.connectors}
                told |= {(*here, *end) for end in ends - {here} if end in signals or end[0] in elements}
            meant |= {(*here, *end) for end in signals.get(here, frozenset()) - {here}}
    return told, meant


def test_the_pins_of_the_boards_are_those_that_eagle_gave_them() -> None:
    counts: Counter[str] = Counter()
    wrong = []
    for row, path in drawings():
        if row["stale"] or not path.with_suffix(".brd").is_file():
            continue
        told, meant = told_and_meant(path)
        counts.update(right=len(told & meant), told=len(told), meant=len(meant), drawings=bool(meant))
        if told != meant:
            wrong.append(f"{row['repository']} {row['path']}: {sorted(told ^ meant)}")
    print(f"EAGLE: {counts['drawings']} drawings, {counts['told']} told, {counts['meant']} meant, {counts['right']} right")
    assert counts["meant"] > 0
    assert counts["right"] >= 0.99 * counts["told"], wrong
    assert counts["right"] >= 0.99 * counts["meant"], wrong


def test_every_drawing_is_read() -> None:
    for _, path in drawings():
        circuit, _ = read_circuit(path)
        assert circuit.components
        assert circuit.nets
