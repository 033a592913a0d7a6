"""EAGLE schematics of other people against the boards that EAGLE made of them.

A `.brd` beside a schematic has for each signal the pads on it (`contactref`), which EAGLE itself has worked out. Here the pads
are found by the file alone: pin to pad by the device's `connect`, pad to signal by the board, and nothing of the reader is
used. For each pin of the board that runs the program, the pins on its net are compared. `drawings/eagle.csv` lists the pairs,
and those that are stale, judged by a person: the board was changed after the schematic, or the other way. The drawings are no
part of the project: ROBOSMI_DRAWINGS names a folder with `OWNER+REPOSITORY/PATH` of each.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from lxml import etree

from robosmi.transformations.t2m.eagle import read_circuit
from tests.corpus.drawn_boards import all_told_and_meant, check_all_read, check_figures, told_and_meant


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


def test_the_pins_of_the_boards_are_those_that_eagle_gave_them() -> None:
    check_figures("EAGLE", ".brd", lambda path: told_and_meant(read_circuit(path)[0], of_board(path)), "pins of boards")


def test_all_parts_are_joined_as_eagle_joined_them() -> None:
    check_figures("EAGLE", ".brd", lambda path: all_told_and_meant(read_circuit(path)[0], of_board(path)), "all parts")


def test_every_drawing_is_read() -> None:
    check_all_read("EAGLE")
