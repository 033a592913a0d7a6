"""The figures of the readers of drawings: a Uno and 500 parts, each wired, for Fritzing and each form of Wokwi, EAGLE, KiCad.

Each figure is the best of several readings in this process, in processor time; the note has the median, and the ratio to a bare
parse of the same text (`json`, `lxml`, `sexpdata`, splitting into lines).
"""

from __future__ import annotations

import json
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import sexpdata
from lxml import etree

from robosmi.plugins import content
from robosmi.transformations.chains.stages.readers import DRAWING
from tests.bench.figures import Figure
from tests.transformations.t2m.eagle import support as eagle
from tests.transformations.t2m.kicad import support as kicad

PARTS = 500
BOUND = 500
"""Milliseconds for 500 parts."""


def wokwi(folder: Path) -> Path:
    """A diagram with lamps on all pins."""
    parts = [{"type": "wokwi-arduino-uno", "id": "uno"}]
    parts += [{"type": "wokwi-led", "id": f"led{n}"} for n in range(PARTS)]
    wires = [[f"uno:{2 + n % 12}", f"led{n}:A", "green", []] for n in range(PARTS)]
    path = folder / "diagram.json"
    path.write_text(json.dumps({"version": 1, "editor": "wokwi", "parts": parts, "connections": wires}, indent=1))
    return path


def in_eagle(folder: Path) -> Path:
    """A schematic with lamps on all pins."""
    libraries = [eagle.device("ARDUINO_UNO", eagle.UNO), eagle.device("LED", eagle.TWO, "LED")]
    parts = [eagle.part("U1", "ARDUINO_UNO"), *(eagle.part(f"LED{n}", "LED") for n in range(PARTS))]
    nets = [eagle.net(f"N{pin}", f"U1.D{pin}", *(f"LED{n}.1" for n in range(pin, PARTS, 14))) for pin in range(14)]
    return eagle.schematic(folder, libraries, parts, nets)


def in_kicad(folder: Path) -> Path:
    """A schematic with lamps on wires from all pins."""
    lamps = [kicad.led(f"D{n}", 1000 + 20 * n, 500) for n in range(PARTS)]
    labels = [kicad.label(f"N{n % 14}", 1000 + 20 * n, 500) for n in range(PARTS)]
    wires = [kicad.wire(100, 10 * pin, 60, 10 * pin) for pin in range(14)]
    named = [kicad.label(f"N{pin}", 60, 10 * pin) for pin in range(14)]
    return kicad.schematic(folder / "robot.kicad_sch", kicad.uno(), *lamps, *labels, *wires, *named)


def in_fritzing(folder: Path) -> Path:
    """A sketch with lamps on all pins: a Uno, wires, and lamps."""
    layer = 'layer="breadboard"'

    def instance(kind: str, index: int, ends: list[tuple[str, int, str]]) -> str:
        connectors = "".join(
            f'<connector connectorId="{own}" {layer}><connects>'
            f'<connect connectorId="{there}" modelIndex="{other}" {layer}/></connects></connector>'
            for own, other, there in ends
        )
        return (
            f'<instance moduleIdRef="{kind}" modelIndex="{index}" path=""><title>{kind}{index}</title><views>'
            f"<breadboardView {layer}><connectors>{connectors}</connectors></breadboardView></views></instance>"
        )

    pins = [f"connector{51 + n % 14}" for n in range(PARTS)]  # D0 to D13
    parts = [instance("arduino_Uno_Rev3(fix)", 1, [(pin, 1000 + n, "connector0") for n, pin in enumerate(pins)])]
    for n, pin in enumerate(pins):
        wire, lamp = 1000 + n, 2000 + n
        parts.append(instance("WireModuleID", wire, [("connector0", 1, pin), ("connector1", lamp, "connector1")]))
        parts.append(instance("5mmColorLEDModuleID", lamp, [("connector1", wire, "connector1")]))
    path = folder / "robot.fz"
    path.write_text(f'<module fritzingVersion="0.9.6b"><instances>{"".join(parts)}</instances></module>')
    return path


def netlist(folder: Path) -> Path:
    """A netlist with lamps on all pins."""
    parts = ['(comp (ref "A1") (value "Arduino_UNO_R3") (libsource (lib "MCU_Module") (part "Arduino_UNO_R3")))']
    parts += [f'(comp (ref "D{n}") (value "LED") (libsource (lib "Device") (part "LED")))' for n in range(PARTS)]
    pins = "".join(f'(pin (num "{n + 1}") (name "{name}"))' for n, name in enumerate(kicad.UNO))
    library = f'(libpart (lib "MCU_Module") (part "Arduino_UNO_R3") (pins {pins}))'
    nets = [
        f'(net (code "{pin}") (name "N{pin}") (node (ref "A1") (pin "{pin + 1}"))'
        + "".join(f'(node (ref "D{n}") (pin "1"))' for n in range(pin, PARTS, 14)) + ")"
        for pin in range(14)
    ]  # fmt: skip
    text = "\n".join(['(export (version "E")', "(components", *parts, ")", f"(libparts {library})", "(nets", *nets, "))"])
    path = folder / "robot.net"
    path.write_text(text)
    return path


def legacy(folder: Path) -> Path:
    """An EESchema schematic with lamps, and its library."""
    pins = "\n".join(f"X {name} {n + 1} 0 {-100 * n} 0 R 50 50 1 1 P" for n, name in enumerate(kicad.UNO))
    symbols = [("Arduino_UNO_R3", pins), ("LED", "X K 1 0 0 0 R 50 50 1 1 P\nX A 2 300 0 0 L 50 50 1 1 P")]
    library = "\n".join(f"DEF {name} U 0 40 Y Y 1 F N\nDRAW\n{drawn}\nENDDRAW\nENDDEF" for name, drawn in symbols)
    (folder / "old-cache.lib").write_text(f"EESchema-LIBRARY Version 2.4\n{library}\n")
    parts = [("Arduino_UNO_R3", "A1", 0, 0), *(("LED", f"D{n}", 10_000 + 1_000 * n, 0) for n in range(PARTS))]
    entries = [
        f"$Comp\nL {symbol} {name}\nU 1 1 {number:08X}\nP {x} {y}\n\t1    {x} {y}\n\t1    0    0    -1\n$EndComp"
        for number, (symbol, name, x, y) in enumerate(parts)
    ]
    entries += [f"Text Label {10_000 + 1_000 * n} 0 0 50 ~ 0\nN{n % 14}" for n in range(PARTS)]
    entries += [f"Text Label 0 {100 * pin} 0 50 ~ 0\nN{pin}" for pin in range(14)]
    path = folder / "old.sch"
    path.write_text("\n".join(["EESchema Schematic File Version 4", *entries, "$EndSCHEMATC"]) + "\n")
    return path


FORMS: list[tuple[str, str, Callable[[Path], Path], Callable[[bytes], object]]] = [
    ("Fritzing .fz", "fritzing", in_fritzing, etree.fromstring),
    ("Wokwi diagram.json", "wokwi", wokwi, json.loads),
    ("EAGLE .sch", "eagle", in_eagle, etree.fromstring),
    ("KiCad .kicad_sch", "kicad", in_kicad, lambda data: sexpdata.loads(data.decode())),
    ("KiCad .net", "kicad", netlist, lambda data: sexpdata.loads(data.decode())),
    ("EESchema .sch", "kicad", legacy, lambda data: [line.split() for line in data.decode().splitlines()]),
]


def measured(run: Callable[[], object], times: int) -> tuple[float, float]:
    """Best and median processor time of some runs, seconds."""
    found = []
    for _ in range(times):
        start = time.process_time()
        run()
        found.append(time.process_time() - start)
    return min(found), statistics.median(found)


def figures() -> Iterator[Figure]:
    """The time to read each form of drawing."""
    with tempfile.TemporaryDirectory() as name:
        for title, reader, draw, parse in FORMS:
            path = draw(Path(name))
            read = content(DRAWING, reader)
            circuit, _ = read(path)
            assert len(circuit.components) == PARTS + 1, title
            assert sum(len(net.connectors) for net in circuit.nets) >= PARTS, title
            data = path.read_bytes()
            (best, median), bare = measured(partial(read, path), 7), measured(partial(parse, data), 7)[0]
            note = f"median {median * 1000:.0f} ms, {best / bare:.1f} x a bare parse"
            yield Figure(f"{title}, {PARTS} parts", best * 1000, "ms", BOUND, note=note)
