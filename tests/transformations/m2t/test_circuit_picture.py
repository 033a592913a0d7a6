"""The picture of a circuit: every connection and component can be found, no text lies over another, no wire ends nowhere."""

from __future__ import annotations

import json
import os
import re
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import pytest
from lxml import etree

from robosmi import resources
from robosmi.errors import RobosmiError
from robosmi.metamodels import hardware as hw
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.m2t.circuits.circuit_layout import text_width
from robosmi.transformations.m2t.circuits.circuit_picture import MOST_LINES, circuit_picture, net_colours, rail_names, svg
from robosmi.transformations.queries.circuits.drawn_symbols import symbol_names
from robosmi.transformations.t2m.fritzing import read_circuit
from tests.evaluation.scoring.sketches import labelled_sketches
from tests.evaluation.sources import sketch_file
from tests.transformations.t2m.eagle import support as eagle
from tests.transformations.t2m.fritzing.support import CASES, FIXTURES

SVG = "{http://www.w3.org/2000/svg}"
READERS = Path(__file__).resolve().parents[1] / "t2m" / "drawing_readers"
SKETCHES = [*CASES.values(), *sorted(p for p in FIXTURES.glob("*.fz") if p.stem != "nothing_connected")]
DRAWINGS = [
    *SKETCHES,
    *sorted(p for p in READERS.rglob("*.*") if p.stem in ("robot", "unknown")),
    *filter(None, map(sketch_file, labelled_sketches())),
    *(
        path
        for folder in filter(None, [os.environ.get("ROBOSMI_DRAWINGS")])
        for path in sorted(Path(folder).rglob("*.*"))
        if path.suffix in (".json", ".sch", ".kicad_sch", ".net", ".fz", ".fzz")
    ),
]
"""All drawings at hand; those of a folder that ROBOSMI_DRAWINGS names, too."""
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
_EXACT = 0.02


class Span(NamedTuple):
    """The area of a text."""

    left: float
    top: float
    right: float
    bottom: float
    text: str


def spans(picture: str) -> list[Span]:
    """The areas of a picture's texts."""
    found = []
    for element in etree.fromstring(picture.encode()).iter(f"{SVG}text"):
        text, size = "".join(map(str, element.itertext())), float(element.get("font-size", "12"))
        width = text_width(text, size, element.get("font-weight") == "bold")
        x, y = float(element.get("x", "0")), float(element.get("y", "0"))
        left = x - width * {"middle": 0.5, "end": 1.0}.get(element.get("text-anchor", ""), 0.0)
        found.append(Span(left, y - 0.75 * size, left + width, y + 0.2 * size, text))
    return found


def overlapping(texts: list[Span]) -> list[tuple[str, str]]:
    """The pairs of texts that overlap."""
    listed = sorted(texts, key=lambda span: span.top)
    found = []
    for place, one in enumerate(listed):
        for other in listed[place + 1 :]:
            if other.top >= one.bottom:
                break
            if one.left < other.right and other.left < one.right:
                found.append((one.text, other.text))
    return found


def drawn_wires(root: etree._Element) -> list[etree._Element]:
    """The wires of a picture."""
    return [path for path in root.iter(f"{SVG}path") if path.get("class") == "wire"]


def overlaid(picture: str) -> list[str]:
    """The nets of which a wire is not made of straight horizontal and vertical pieces, or lies on one of another net."""
    level: dict[tuple[bool, float], list[tuple[float, float, str]]] = {}
    wrong = []
    for wire in drawn_wires(etree.fromstring(picture.encode())):
        numbers = [float(number) for number in _NUMBER.findall(wire.get("d", ""))]
        trunk = str(wire.get("data-net") or wire.get("data-from", ""))  # one line for several wires
        for (x, y), (a, b) in pairwise(zip(numbers[::2], numbers[1::2], strict=True)):
            if x != a and y != b:
                wrong.append(trunk)
            first, last = sorted((x, a) if y == b else (y, b))
            level.setdefault((y == b, y if y == b else x), []).append((first, last, trunk))
    for pieces in level.values():
        pieces.sort()
        for place, (_, end, trunk) in enumerate(pieces):
            wrong += [trunk for start, _, other in pieces[place + 1 :] if start < end - _EXACT and other != trunk]
    return wrong


def loose_ends(picture: str) -> list[str]:
    """The wires of a picture that do not begin and end at two dots on edges of boxes."""
    root = etree.fromstring(picture.encode())
    dots = {(float(c.get("cx", "0")), float(c.get("cy", "0"))) for c in root.iter(f"{SVG}circle")}
    boxes = [
        tuple(float(r.get(key, "0")) for key in ("x", "y", "width", "height"))
        for r in root.iter(f"{SVG}rect")
        if r.get("class") == "frame"
    ]
    wrong = []
    for path in drawn_wires(root):
        numbers = [float(number) for number in _NUMBER.findall(path.get("d", ""))]
        if numbers[:2] == numbers[-2:]:
            wrong.append(path.get("d", ""))
        for x, y in (numbers[:2], numbers[-2:]):
            at_dot = any(abs(x - a) < _EXACT and abs(y - b) < _EXACT for a, b in dots)
            at_box = any(
                top - _EXACT <= y <= top + height + _EXACT and min(abs(x - left), abs(x - left - width)) < _EXACT
                for left, top, width, height in boxes
            )
            if not (at_dot and at_box):
                wrong.append(path.get("d", ""))
    return wrong


def crossed(picture: str) -> list[str]:
    """The wires that cross a box."""
    root = etree.fromstring(picture.encode())
    boxes = [
        tuple(float(r.get(key, "0")) for key in ("x", "y", "width", "height"))
        for r in root.iter(f"{SVG}rect")
        if r.get("class") == "frame"
    ]
    wrong = []
    for wire in (path.get("d", "") for path in drawn_wires(root)):
        numbers = [float(number) for number in _NUMBER.findall(wire)]
        corners = list(zip(numbers[::2], numbers[1::2], strict=True))
        for (x, y), (a, b) in pairwise(corners):
            if any(
                max(x, a) > left + _EXACT
                and min(x, a) < left + width - _EXACT
                and max(y, b) > top + _EXACT
                and min(y, b) < top + height - _EXACT
                for left, top, width, height in boxes
            ):
                wrong.append(wire)
    return wrong


def outside(picture: str) -> list[str]:
    """The texts that are not completely inside the picture."""
    root = etree.fromstring(picture.encode())
    width, height = (float(root.get(key, "0")) for key in ("width", "height"))
    return [s.text for s in spans(picture) if not (s.left >= 0 and s.top >= 0 and s.right <= width and s.bottom <= height)]


def texts(picture: str) -> list[str]:
    """The texts of a picture."""
    return [" ".join(span.text.split()) for span in spans(picture)]


@pytest.mark.parametrize("path", SKETCHES, ids=lambda p: p.stem)
def test_every_sketch_can_be_drawn(path: Path) -> None:
    circuit, _ = read_circuit(path)
    picture = circuit_picture(circuit)
    boxes = {box.number: box for box in picture.boxes}
    for link in picture.links:
        for place in (link.one, link.other):
            assert place.row < len(boxes[place.box].rows)
        assert abs(boxes[link.one.box].column - boxes[link.other.box].column) <= 1  # no line passes a column of boxes


def test_no_text_lies_over_another_and_no_wire_ends_nowhere_in_any_drawing() -> None:
    drawn, wrong = 0, []
    for path in DRAWINGS:
        try:
            made = hardware(path)
        except RobosmiError:  # a drawing without a board, or a damaged one
            continue
        picture = made.picture()
        drawn += 1
        wrong += [f"{path}: '{one}' and '{other}'" for one, other in overlapping(spans(picture))]
        wrong += [f"{path}: the wire {wire} ends nowhere" for wire in loose_ends(picture)]
        wrong += [f"{path}: the wire {wire} goes through a box" for wire in crossed(picture)]
        wrong += [f"{path}: the wire of {net} lies on another" for net in overlaid(picture)]
        wrong += [f"{path}: '{text}' leaves the picture" for text in outside(picture)]
    assert wrong == []
    assert drawn >= 10


def test_where_nothing_is_connected_what_is_said_is_in_the_picture(tmp_path: Path) -> None:
    path = tmp_path / "diagram.json"
    lamp = '{"type": "wokwi-led", "id": "lamp"}'
    path.write_text(
        '{"editor": "wokwi", "parts": [{"type": "wokwi-arduino-uno", "id": "uno"},\n' + f"{lamp}, {lamp}],\n"
        '"connections": [["uno:4", "lamp:A", "", []]]}\n'
    )
    picture = hardware(path).picture()
    assert "not connected: uno, lamp, lamp" in texts(picture)
    assert outside(picture) == []


def test_no_two_nets_of_any_drawing_have_one_name_or_colour() -> None:
    for path in DRAWINGS:
        try:
            circuit = hardware(path).circuit
        except RobosmiError:
            continue
        names = rail_names(net for net in circuit.nets if net.rail)
        colours = net_colours(circuit.nets, names)
        assert max(Counter(names.values()).values(), default=1) == 1, path
        assert max(Counter(colours.values()).values(), default=1) == 1, path
        for net in circuit.nets:
            kinds = {c.kind.name for c in net.connectors if c.component is not None and c.component.role is hw.Role.Board}
            if net.rail and kinds & {"supply", "ground"} == {"supply"}:
                assert not names[id(net)].startswith("GND"), path


def test_the_line_follower_as_a_picture() -> None:
    found = texts(hardware(CASES["line_following_robot"]).picture())
    for wanted in ("Arduino Uno", "Basic Servo1", "HIH4030 2", "Red (633nm)-LED1", "R1", "D8", "D12", "pulse", "GND", "5V", "9V"):
        assert wanted in found
    assert "Breadboard1" not in found


def test_what_is_wrong_stands_at_its_component_and_at_its_pin() -> None:
    made = hardware(CASES["line_following_robot"])
    boxes = {box.title: box for box in circuit_picture(made.circuit, made.findings).boxes}
    assert boxes["HIH4030 1"].marks[0].text.startswith("RS240 ")
    assert boxes["Arduino Uno"].marks[0].text.startswith("RS250 ")
    assert len({mark.message for box in boxes.values() for mark in box.marks}) == len(made.findings)
    assert boxes["Red (633nm)-LED1"].marks == []
    marked = [row.text for row in boxes["HIH4030 1"].rows if row.mark_colour]
    assert marked == ["OUT"]


def test_ports_of_the_source_stand_at_the_pins() -> None:
    made = hardware(CASES["line_following_robot"])
    found = texts(svg(made.circuit, (), {"D10": ["leftQTI"], "D9": ["abdrive.right_servo", "P13"]}))
    assert "D10 = leftQTI" in found
    assert "D9 = abdrive.right_servo, P13" in found


def test_a_supply_stays_one_where_the_ground_of_a_servo_hangs_on_it(tmp_path: Path) -> None:
    path = tmp_path / "diagram.json"
    path.write_text(
        '{"editor": "wokwi", "parts": [{"type": "wokwi-arduino-uno", "id": "uno"}, {"type": "wokwi-servo", "id": "arm"},\n'
        '{"type": "wokwi-servo", "id": "leg"}], "connections": [["uno:5V", "arm:GND", "", []],\n'
        '["uno:GND.1", "leg:GND", "", []], ["uno:9", "arm:PWM", "", []]]}\n'
    )
    made = hardware(path)
    rows = {(box.title, row.text): row for box in circuit_picture(made.circuit, made.findings).boxes for row in box.rows}
    assert rows["arm", "GND"].tag == "5V"
    assert rows["leg", "GND"].tag == "GND"
    assert rows["arm", "GND"].tag_colour != rows["leg", "GND"].tag_colour


def test_many_wires_are_bundled_by_component_and_each_row_says_where_it_leads(tmp_path: Path) -> None:
    lcd = [("RS", 12), ("E", 11), ("D0", 2), ("D1", 3), ("D2", 4), ("D3", 5), ("D4", 6), ("D5", 7), ("D6", 8), ("D7", 9)]
    wires = [f'["uno:{pin}", "{part}:{name}", "", []]' for part in ("lcd1", "lcd2", "lcd3") for name, pin in lcd]
    parts = [f'{{"type": "wokwi-lcd1602", "id": "lcd{number}"}}' for number in (1, 2, 3)]
    path = tmp_path / "diagram.json"
    board = '{"type": "wokwi-arduino-uno", "id": "uno"}'
    path.write_text(f'{{"editor": "wokwi", "parts": [{", ".join([board, *parts])}], "connections": [{", ".join(wires)}]}}')
    picture = circuit_picture(hardware(path).circuit)
    assert len(wires) > MOST_LINES
    assert sorted(link.wires for link in picture.links) == [10, 10, 10]
    boxes = {box.title: box for box in picture.boxes}
    assert {row.text: row.tag for row in boxes["lcd2"].rows} == {name: f"D{pin}" for name, pin in lcd}
    assert next(row.tag for row in boxes["uno"].rows if row.text == "D12") == "lcd1 RS, lcd2 RS, lcd3 RS"
    made = hardware(path).picture()
    assert overlapping(spans(made)) == []
    assert loose_ends(made) == []


def test_pins_of_one_component_that_are_tied_to_one_another_get_no_line_where_wires_are_bundled(tmp_path: Path) -> None:
    segments = [(part, pin) for part in ("seg1", "seg2", "seg3") for pin in "ABCDEFG"]
    wires = [f'["uno:{2 + n % 12}", "{part}:{pin}", "", []]' for n, (part, pin) in enumerate(segments)]
    tied = '["seg1:COM.1", "seg1:COM.2", "", []], ["seg1:COM.1", "r1:1", "", []], ["r1:2", "uno:5V", "", []]'
    parts = [f'{{"type": "wokwi-7segment", "id": "seg{number}"}}' for number in (1, 2, 3)]
    board = '{"type": "wokwi-arduino-uno", "id": "uno"}, {"type": "wokwi-resistor", "id": "r1"}'
    path = tmp_path / "diagram.json"
    path.write_text(
        f'{{"editor": "wokwi", "parts": [{", ".join([board, *parts])}], "connections": [{", ".join([*wires, tied])}]}}'
    )
    picture = circuit_picture(hardware(path).circuit)
    assert picture.links
    assert all(link.one.box != link.other.box for link in picture.links)
    tags = {row.tag for box in picture.boxes if box.title == "seg1" for row in box.rows if row.text.startswith("COM")}
    assert any("r1 1" in tag for tag in tags)
    assert loose_ends(hardware(path).picture()) == []


def test_symbols_of_supplies_are_one_table_of_rails_that_have_the_names_of_their_nets(tmp_path: Path) -> None:
    libraries = [eagle.device("ARDUINO-UNO", eagle.UNO), eagle.device("VM", [("VM", "sup")]), eagle.device("MOTOR", eagle.TWO)]
    symbols = [f"VM{number}" for number in range(9)]
    parts = [eagle.part("B1", "ARDUINO-UNO"), eagle.part("M1", "MOTOR"), *(eagle.part(name, "VM") for name in symbols)]
    nets = [eagle.net("VMOT", "M1.1", *(f"{name}.VM" for name in symbols)), eagle.net("N$1", "B1.D9", "M1.2")]
    made = hardware(eagle.schematic(tmp_path, libraries, parts, nets))
    picture = circuit_picture(made.circuit, made.findings)
    boxes = {box.title: box for box in picture.boxes}
    assert {*boxes} == {"B1", "M1", "Rails"}
    assert [(row.text, row.tag) for row in boxes["Rails"].rows] == [("1 connector", "VMOT")]
    tags = {row.text: (row.tag, row.tag_colour) for row in boxes["M1"].rows}
    assert tags["1"] == ("VMOT", boxes["Rails"].rows[0].tag_colour)
    assert tags["2"] == ("", "")


def test_a_column_that_is_too_long_is_folded_and_its_lines_go_round_it(tmp_path: Path) -> None:
    leds = [f'{{"type": "wokwi-led", "id": "led{number}"}}' for number in range(64)]
    wires = [f'["uno:{2 + number % 8}", "led{number}:A", "", []]' for number in range(64)]
    path = tmp_path / "diagram.json"
    board = '{"type": "wokwi-arduino-uno", "id": "uno"}'
    path.write_text(f'{{"editor": "wokwi", "parts": [{", ".join([board, *leds])}], "connections": [{", ".join(wires)}]}}')
    picture = hardware(path).picture()
    root = etree.fromstring(picture.encode())
    width, height = (float(root.get(key, "0")) for key in ("width", "height"))
    assert height < 1_600 < 2 * width
    assert len(drawn_wires(root)) == 64
    assert overlaid(picture) == []
    assert overlapping(spans(picture)) == []
    assert loose_ends(picture) == []
    assert crossed(picture) == []


def test_links_are_the_signal_nets() -> None:
    circuit, _ = read_circuit(CASES["line_following_robot"])
    links = [link.text for link in circuit_picture(circuit).links]
    assert sorted(links) == [
        "Arduino Uno D10 - HIH4030 2 OUT",
        "Arduino Uno D11 - HIH4030 1 OUT",
        "Arduino Uno D12 - R1 Pin 0",
        "Arduino Uno D8 - Basic Servo2 pulse",
        "Arduino Uno D9 - Basic Servo1 pulse",
        "R1 Pin 1 - Red (633nm)-LED1 anode",
    ]


def test_each_wire_tells_the_pin_and_the_port_that_it_leads_to_also_behind_a_resistor() -> None:
    made = hardware(CASES["line_following_robot"])
    drawn = drawn_wires(etree.fromstring(svg(made.circuit, (), {"D12": ["led"]}).encode()))
    told = Counter((wire.get("data-pin"), wire.get("data-port")) for wire in drawn)
    assert told == {("D8", None): 1, ("D9", None): 1, ("D10", None): 1, ("D11", None): 1, ("D12", "led"): 2}
    assert len({wire.get("data-net") for wire in drawn}) == 6


def test_a_picture_is_named_and_described_for_those_who_do_not_see_it() -> None:
    root = etree.fromstring(hardware(CASES["line_following_robot"]).picture().encode())
    assert root.get("role") == "img"
    assert root.findtext(f"{SVG}title")
    described = root.findtext(f"{SVG}desc") or ""
    assert "Basic Servo1" in described
    assert "6 signal wires" in described
    assert all(wire.findtext(f"{SVG}title") for wire in drawn_wires(root))


def _diagram(folder: Path, parts: dict[str, str], connections: list[tuple[str, str]]) -> Path:
    path = folder / "diagram.json"
    listed = [{"type": kind, "id": name} for name, kind in parts.items()]
    path.write_text(json.dumps({"editor": "wokwi", "parts": listed, "connections": [[a, b, "", []] for a, b in connections]}))
    return path


_BOARDS = {
    "wokwi-arduino-uno": {"D13": (1, 4), "D8": (1, 9), "D7": (1, 11), "D0": (1, 18), "A0": (-1, 13), "A5": (-1, 18)},
    "wokwi-arduino-nano": {"D13": (-1, 0), "A7": (-1, 10), "D12": (1, 0), "D2": (1, 10), "D1": (1, 14)},
    "wokwi-arduino-mega": {"A15": (-1, 24), "D13": (1, 4), "D22": (-1, 30), "D23": (1, 30), "D53": (1, 45)},
    "wokwi-pi-pico": {"GP0": (-1, 0), "GP15": (-1, 19), "GP28": (1, 6), "GP16": (1, 19)},
}


@pytest.mark.parametrize("board", _BOARDS)
def test_the_pins_of_a_board_are_where_they_are_at_the_board(tmp_path: Path, board: str) -> None:
    pins = _BOARDS[board]
    parts = {"board": board, **{f"led{number}": "wokwi-led" for number, _ in enumerate(pins)}}
    connections = [(f"board:{label.removeprefix('D')}", f"led{number}:A") for number, label in enumerate(pins)]
    made = hardware(_diagram(tmp_path, parts, connections))
    [box] = [each for each in circuit_picture(made.circuit).boxes if each.is_board]
    assert {row.pin: row.slot for row in box.rows if row.pin} == pins
    root = etree.fromstring(made.picture().encode())
    [frame] = [g[1] for g in root.iter(f"{SVG}g") if g.get("data-symbol") == "board"]
    left, width = float(frame.get("x", "0")), float(frame.get("width", "0"))
    drawn = {g.get("data-pin"): g.find(f"{SVG}circle") for g in root.iter(f"{SVG}g") if g.get("data-pin")}
    edges = {label: (float(dot.get("cx", "0")) - left) / width for label, dot in drawn.items() if dot is not None}
    assert edges == {label: (side + 1) / 2 for label, (side, _) in pins.items()}
    assert overlapping(spans(made.picture())) == []


def test_a_ground_is_at_the_pin_that_the_drawing_names(tmp_path: Path) -> None:
    parts = {"uno": "wokwi-arduino-uno", "led": "wokwi-led"}
    made = hardware(_diagram(tmp_path, parts, [("uno:7", "led:A"), ("led:C", "uno:GND.3"), ("uno:3.3V", "uno:AREF")]))
    [box] = [each for each in circuit_picture(made.circuit).boxes if each.is_board]
    grounds = {row.text: row.slot for row in box.rows if row.text.startswith("GND")}
    assert grounds["GND.1"] == (1, 3)
    assert grounds["GND.3"] == (-1, 10)
    idle = [pin.text for pin in box.idle]
    assert idle.count("D7") == 0
    assert {"D0", "D13", "A5", "VIN"} <= set(idle)


@pytest.mark.parametrize(
    ("kind", "pin", "symbol"),
    [
        ("wokwi-led", "A", "led"), ("wokwi-resistor", "1", "resistor"), ("wokwi-servo", "PWM", "servo"),
        ("wokwi-pushbutton", "1.l", "button"), ("wokwi-hc-sr04", "TRIG", "ranger"), ("wokwi-lcd1602", "RS", "display"),
        ("board-ssd1306", "SDA", "display"), ("wokwi-buzzer", "1", "speaker"), ("wokwi-potentiometer", "SIG", "potentiometer"),
        ("wokwi-photoresistor-sensor", "AO", "light_sensor"), ("wokwi-dht22", "SDA", "climate_sensor"),
        ("wokwi-ir-receiver", "DAT", "ir_receiver"), ("wokwi-relay-module", "IN", "relay"),
        ("wokwi-7segment", "A", "seven_segment"),
        ("wokwi-membrane-keypad", "R1", "keypad"), ("wokwi-stepper-motor", "A+", "motor"), ("wokwi-ds1307", "SDA", "part"),
    ],
)  # fmt: skip
def test_a_part_is_drawn_as_what_it_is(tmp_path: Path, kind: str, pin: str, symbol: str) -> None:
    made = hardware(_diagram(tmp_path, {"uno": "wokwi-arduino-uno", "it": kind}, [("uno:7", f"it:{pin}")]))
    root = etree.fromstring(made.picture().encode())
    drawn = {g.get("data-component"): g for g in root.iter(f"{SVG}g") if g.get("data-component")}
    assert drawn["it"].get("data-symbol") == symbol
    assert [use.get("href") for use in drawn["it"].iter(f"{SVG}use")] == [f"#part-{symbol}"]
    assert [each.get("id") for each in root.iter(f"{SVG}symbol")] == [f"part-{symbol}"]


def test_each_symbol_that_the_data_names_is_drawn_and_no_other_one() -> None:
    source = resources.find("templates", "circuit/symbols.svg.j2").read_text(encoding="utf-8")
    names = set(re.findall(r'symbol == "(\w+)"', source))
    assert names | {"part"} == set(symbol_names())


def test_titles_that_are_markup_do_no_harm() -> None:
    circuit, _ = read_circuit(FIXTURES / "one_sided.fz")
    circuit.components[0].title = '<script>"&\\\x07 -->'
    circuit.name = '</title><a href="x">'
    assert any(text.startswith('<script>"&') for text in texts(svg(circuit)))
