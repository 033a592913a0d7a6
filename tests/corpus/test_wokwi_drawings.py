"""Wokwi diagrams of other people against the sketches that run on them, and against a walk of its own through their connections.

`drawings/wokwi.csv` has for each diagram with a board of the Arduino AVR family what its sketch says: the pins that it uses as
constants or, as far as they are wired, by registers and buses, less serial lines; and where drawing and sketch differ, which of
them is at fault (`reader`, `drawing` or `sketch`), as a person judged it. The diagrams are no part of the project:
ROBOSMI_DRAWINGS names a folder with `OWNER+REPOSITORY/PATH` of each.
"""

from __future__ import annotations

import csv
import json
import os
from collections import Counter
from pathlib import Path

import networkx as nx
import pytest

from robosmi.errors import SourceError
from robosmi.transformations.chains.hardware import hardware

TABLE = Path(__file__).parent / "drawings" / "wokwi.csv"


def rows() -> list[dict[str, str]]:
    """The rows of the table."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter=";"))


def test_every_disagreement_is_judged_and_the_readers_are_one_in_a_hundred_at_most() -> None:
    found = rows()
    faults = Counter(row["fault"] for row in found)
    assert len(found) >= 149
    assert {*faults} <= {"", "reader", "drawing", "sketch"}
    assert all(bool(row["fault"]) == bool(row["drawing_only"] or row["sketch_only"]) == bool(row["why"]) for row in found)
    assert faults["reader"] <= 0.01 * len(found)


def drawings() -> list[tuple[dict[str, str], Path]]:
    """The rows whose drawings are there; the test is skipped where none is."""
    folder = os.environ.get("ROBOSMI_DRAWINGS")
    if not folder:
        pytest.skip("ROBOSMI_DRAWINGS does not name a folder with the drawings")
    listed = [(row, Path(folder) / row["repository"].replace("/", "+") / row["path"]) for row in rows()]
    found = [(row, path) for row, path in listed if path.is_file()]
    assert found, "none of the drawings is there"
    return found


def judged(told: set[str], meant: set[str], counts: Counter[str]) -> bool:
    """Count correct, found and true connections; True if the found ones are exactly the true ones."""
    counts.update(right=len(told & meant), told=len(told), meant=len(meant))
    return told == meant


def reached(path: Path) -> set[str]:
    """`PIN COMPONENT` for each pin of the board, by a walk through the connections that shares nothing with the reader."""
    document = json.loads(path.read_text("utf-8-sig"))
    kinds: dict[str, str] = {}
    twice = set()
    for part in document["parts"]:
        twice.update({part["id"]} & kinds.keys())
        kinds[part["id"]] = part["type"]
    graph: nx.Graph[str] = nx.Graph()
    for connection in document["connections"]:
        ends = [str(end) for end in connection[:2]]
        if not any(
            end.startswith("$") or end.partition(":")[0] in twice | ({end.partition(":")[0]} - kinds.keys()) for end in ends
        ):
            graph.add_edge(*(node(end, kinds) for end in ends))
    walls = {n for net in nx.connected_components(graph) if any(supplies(n, kinds) for n in net) for n in net}
    graph.remove_nodes_from(walls)
    through = {n.partition(":")[0] for n in graph if kinds[n.partition(":")[0]] == "wokwi-resistor"}
    pins = {n for n in graph if "arduino" in kinds[n.partition(":")[0]]}
    taken = {net: n for net in map(frozenset, nx.connected_components(graph)) for n in net if n in pins}
    found = set()
    for pin in pins:
        seen, todo = set(), [next(net for net in taken if pin in net)]
        while todo:
            net = todo.pop()
            seen.add(net)
            for end in net:
                part = end.partition(":")[0]
                if part in through:
                    other = next(
                        (n for n in map(frozenset, nx.connected_components(graph)) if {f"{part}:1", f"{part}:2"} & n - net), net
                    )
                    todo += [other] if other not in seen and other not in taken else []
                elif end not in pins and "breadboard" not in kinds[part] and kinds[part] not in QUIET:
                    found.add(f"{label(pin.partition(':')[2], kinds[pin.partition(':')[0]])} {part}")
    return found


QUIET = ("wokwi-logic-analyzer", "wokwi-junction", "wokwi-text")
CONTACTS = ("wokwi-pushbutton", "wokwi-pushbutton-6mm")


def node(end: str, kinds: dict[str, str]) -> str:
    """The representative of all pins joined to this one: a row of a breadboard, a contact of a button, an equal pin."""
    part, _, pin = end.partition(":")
    if "breadboard" in kinds[part] or kinds[part] in CONTACTS or "arduino" in kinds[part] or "max7219" in kinds[part]:
        pin = pin if pin == "3.3V" else pin.partition(".")[0]
    return f"{part}:{pin}"


def supplies(end: str, kinds: dict[str, str]) -> bool:
    """Whether a pin is a supply or a ground of a board, or a symbol of one."""
    part, _, pin = end.partition(":")
    return kinds[part] in ("wokwi-gnd", "wokwi-vcc") or (
        "arduino" in kinds[part] and pin in ("GND", "5V", "3.3V", "VIN", "IOREF")
    )


def label(pin: str, kind: str) -> str:
    """The label of a board's pin."""
    named = {"SDA": "D20", "SCL": "D21"} if kind.endswith("mega") else {}
    return named.get(pin) or (f"D{pin}" if pin.isdigit() else pin)


def test_a_walk_of_its_own_reaches_the_same_components() -> None:
    counts: Counter[str] = Counter()
    wrong = []
    for row, path in drawings():
        told = {f"{m['pin']} {m['component']}" for m in hardware(path).result["mappings"] if m["pin"] != "RESET"}
        if not judged(told, reached(path), counts):
            wrong.append(f"{row['repository']} {row['path']}: {sorted(told ^ reached(path))}")
    assert counts["right"] >= 0.99 * counts["told"], wrong
    assert counts["right"] >= 0.99 * counts["meant"], wrong


def test_the_pins_are_those_of_the_sketches_but_for_the_faults_of_others() -> None:
    counts: Counter[str] = Counter()
    wrong = []
    for row, path in drawings():
        told = {mapping["pin"] for mapping in hardware(path).result["mappings"]}
        meant = ({*row["sketch"].split()} - {*row["sketch_only"].split()}) | {*row["drawing_only"].split()}
        if not judged(told, meant, counts):
            wrong.append(f"{row['repository']} {row['path']}: {sorted(told ^ meant)}")
    assert counts["right"] >= 0.99 * counts["told"], wrong
    assert counts["right"] >= 0.99 * counts["meant"], wrong


def test_every_diagram_is_read_and_of_others_the_damage_is_named() -> None:
    """Of boards that nobody knows, too: their parts and nets are read."""
    folder = os.environ.get("ROBOSMI_DRAWINGS")
    if not folder:
        pytest.skip("ROBOSMI_DRAWINGS does not name a folder with the drawings")
    counts: Counter[str] = Counter()
    for path in sorted(Path(folder).rglob("diagram.json")):
        try:
            made = hardware(path)
        except SourceError as error:
            if "has no board" in str(error) and json.loads(path.read_text())["parts"] == []:
                counts["empty"] += 1
                continue
            if "not valid JSON" not in str(error) or error.location is None or not error.location.line:
                raise
            counts["damaged"] += 1
            continue
        counts["of a board that is known" if made.board_models else "of another board"] += 1
        counts["parts"] += len(made.circuit.components)
    print(f"Wokwi: {dict(counts)}")
    assert counts["damaged"] <= 0.01 * (counts["of a board that is known"] + counts["of another board"])
