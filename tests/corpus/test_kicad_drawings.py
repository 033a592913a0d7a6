"""KiCad schematics of other people against the boards that KiCad made of them.

A `.kicad_pcb` beside a schematic has the net of each pad, which KiCad itself has worked out. For each pin of the board that runs
the program, the pins on its net are compared with the pads on the pad's net, by reference and number; nothing of the reader is
used for the pads. `drawings/kicad.csv` lists the drawings, and those pairs that are stale, judged by a person: the board was
changed after the schematic, or the other way. The drawings are no part of the project: ROBOSMI_DRAWINGS names a folder with
`OWNER+REPOSITORY/PATH` of each.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import sexpdata

from robosmi.transformations.t2m.kicad import read_circuit
from tests.corpus.drawn_boards import all_told_and_meant, check_all_read, check_figures, told_and_meant


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


def sheetless(title: str) -> str:
    """The board's name of a part, of its title in the drawing."""
    return title.rpartition("/")[2]


def test_the_pins_of_the_boards_are_those_that_kicad_gave_them() -> None:
    def judged(path: Path) -> tuple[set[tuple[str, ...]], set[tuple[str, ...]]]:
        return told_and_meant(read_circuit(path)[0], pads(path.with_suffix(".kicad_pcb")), sheetless)

    check_figures("KiCad", ".kicad_pcb", judged, "pins of boards")


def test_all_parts_are_joined_as_kicad_joined_them() -> None:
    def judged(path: Path) -> tuple[set[tuple[str, ...]], set[tuple[str, ...]]]:
        return all_told_and_meant(read_circuit(path)[0], pads(path.with_suffix(".kicad_pcb")), sheetless)

    check_figures("KiCad", ".kicad_pcb", judged, "all parts")


def test_every_drawing_is_read() -> None:
    """With a board or without; a sheet may be empty, so parts are not asked for."""
    check_all_read("KiCad")
