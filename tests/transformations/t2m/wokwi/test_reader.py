"""Reader of Wokwi diagrams: pins of drawn robots, and damaged diagrams, which are refused with place or give no wrong pin."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import pytest

from robosmi.diagnostics import Finding
from robosmi.errors import SourceError
from robosmi.metamodels import hardware as hw
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.t2m.wokwi import read_circuit
from robosmi.transformations.t2m.wokwi.document import MOST_PARTS, recognises

PROGRAM = Path(__file__).parents[4] / "docs" / "examples" / "line_follower" / "line_follower.c"


def part(identity: str, kind: str, **attributes: str) -> dict[str, Any]:
    """A part of a diagram."""
    return {"type": kind, "id": identity, "top": 0, "left": 0, "attrs": attributes}


def diagram(folder: Path, parts: list[Any], connections: list[Any], **more: Any) -> Path:
    """A diagram on disk, an entry to a line, the first part in line 3."""
    listed = [",\n".join(json.dumps(entry) for entry in entries) for entries in (parts, connections)]
    rest = "".join(f", {json.dumps(key)}: {json.dumps(value)}" for key, value in more.items())
    path = folder / "diagram.json"
    path.write_text(
        f'{{"version": 1, "editor": "wokwi",\n"parts": [\n{listed[0]}\n],\n"connections": [\n{listed[1]}\n]{rest}}}\n'
    )
    return path


def pins(path: Path) -> dict[str, str]:
    """The component on each pin of the board."""
    return {m["pin"]: m["component"] for m in hardware(path).result["mappings"]}


def said(findings: list[Finding], rule: str) -> list[tuple[str, int | None]]:
    """Message and line of the findings of a rule; each has a fix."""
    found = [f for f in findings if f.rule == rule]
    assert all(f.fix for f in found)
    return [(f.message, f.location.line if f.location else None) for f in found]


UNO = part("uno", "wokwi-arduino-uno")
LED = part("led1", "wokwi-led", color="red")


def test_breadboards_conduct_by_row_and_by_rail_and_resistors_are_on_the_way(tmp_path: Path) -> None:
    parts = [UNO, part("bb1", "wokwi-breadboard-half"), part("r1", "wokwi-resistor", value="220"), LED]
    wires = [
        ["uno:13", "bb1:10t.a", "green", ["v0"]],
        ["bb1:10t.e", "r1:1", "", ["$bb"]],
        ["r1:2", "bb1:10b.f", "", ["$bb"]],
        ["led1:A", "bb1:10b.j", "", ["$bb"]],
        ["led1:C", "bb1:bn.25", "black", []],
        ["uno:GND.1", "bb1:bn.1", "black", []],
    ]
    result = hardware(diagram(tmp_path, parts, wires)).result
    assert [(m["pin"], m["component"], m["connectors"], [v["title"] for v in m["via"]]) for m in result["mappings"]] == [
        ("D13", "led1", [{"id": "A", "name": "A"}], ["r1"])
    ]
    circuit, _ = read_circuit(tmp_path / "diagram.json")
    assert {net.voltage for net in circuit.nets if net.rail} == {"GND"}


def test_of_a_contact_and_of_a_chain_the_connector_counts_that_has_the_wire(tmp_path: Path) -> None:
    """Not the other end of the same contact, nor what hands an input on to the next display."""
    parts = [UNO, part("b", "wokwi-pushbutton"), part("m1", "wokwi-max7219-matrix"), part("m2", "wokwi-max7219-matrix")]
    wires = [
        ["uno:2", "b:1.r", "green", []],
        ["uno:GND.1", "b:2.l", "black", []],
        ["uno:10", "m1:CS", "green", []],
        ["m1:CS.2", "m2:CS", "green", []],
    ]
    result = hardware(diagram(tmp_path, parts, wires)).result
    assert [(m["pin"], m["component"], [c["id"] for c in m["connectors"]]) for m in result["mappings"]] == [
        ("D2", "b", ["1.r"]), ("D10", "m1", ["CS"]), ("D10", "m2", ["CS"]),
    ]  # fmt: skip


@pytest.mark.parametrize(("kind", "board"), [("wokwi-pi-pico", "pico"), ("board-pi-pico", "pico"), ("board-pi-pico-w", "picow")])
def test_a_pico_is_known_with_its_pins(kind: str, board: str, tmp_path: Path) -> None:
    path = diagram(tmp_path, [part("pico", kind), LED], [["pico:GP15", "led1:A", "", []], ["led1:C", "pico:GND.4", "", []]])
    circuit, _ = read_circuit(path)
    assert circuit.components[0].boardName == board
    assert {c.pin for c in circuit.components[0].connectors} >= {f"GP{n}" for n in (*range(23), 26, 27, 28)}
    assert pins(path) == {"GP15": "led1"}


@pytest.mark.parametrize(
    ("kind", "board", "pin", "label"),
    [
        ("board-esp32-devkit-c-v4", "esp32", "2", "IO2"),
        ("board-esp32-devkit-c-v4", "esp32", "VP", "IO36"),
        ("board-esp32-devkit-c-v4", "esp32", "TX", "IO1"),
        ("board-esp32-devkit-c-v4", "esp32", "D2", ""),  # a line of the flash, GPIO9
        ("board-esp32-devkit-v1", "esp32", "D2", "IO2"),
        ("board-esp32-devkit-v1", "esp32", "VN", "IO39"),
        ("board-esp32-devkit-v1", "esp32", "RX2", "IO16"),
        ("wokwi-esp32-devkit-v1", "esp32", "D15", "IO15"),
        ("board-esp32-c3-devkitm-1", "esp32c3", "8", "IO8"),
        ("board-esp32-c3-devkitm-1", "esp32c3", "TX", "IO21"),
    ],
)
def test_an_esp32_is_known_with_its_pins(kind: str, board: str, pin: str, label: str, tmp_path: Path) -> None:
    path = diagram(tmp_path, [part("esp", kind), LED], [[f"esp:{pin}", "led1:A", "", []]])
    circuit, _ = read_circuit(path)
    assert circuit.components[0].boardName == board
    assert pins(path) == ({label: "led1"} if label else {})


@pytest.mark.parametrize("kind", ["board-esp32-s3-devkitc-1", "board-pi-pico-2", "board-franzininho-wifi", "board-xiao-esp32-c3"])
def test_a_board_of_another_microcontroller_is_not_taken_for_one_that_is_known(kind: str, tmp_path: Path) -> None:
    circuit, _ = read_circuit(diagram(tmp_path, [part("esp", kind), LED], [["esp:2", "led1:A", "", []]]))
    assert circuit.components[0].boardName == ""


@pytest.mark.parametrize(
    ("kind", "pin"), [("wokwi-breadboard-half", "31t.a"), ("wokwi-breadboard-mini", "tp.1"), ("wokwi-breadboard", "10t.f")]
)
def test_a_hole_that_a_breadboard_lacks_joins_nothing(kind: str, pin: str, tmp_path: Path) -> None:
    wires = [["uno:13", f"bb1:{pin}", "green", []], [f"bb1:{pin}", "led1:A", "green", []]]
    path = diagram(tmp_path, [UNO, part("bb1", kind), LED], wires)
    assert pins(path) == {}
    assert len(said(read_circuit(path)[1], "RS208")) == 2


@pytest.mark.parametrize(
    ("board", "pin", "label"),
    [
        ("uno", "A4.2", "A4"), ("uno", "0", "D0"), ("nano", "11.2", "D11"), ("nano", "A7", "A7"), ("mega", "SDA", "D20"),
        ("mega", "53", "D53"), ("mega", "A15", "A15"),
    ],
)  # fmt: skip
def test_each_pin_of_a_board_has_its_label(board: str, pin: str, label: str, tmp_path: Path) -> None:
    kind = f"wokwi-arduino-{board}"
    assert pins(diagram(tmp_path, [part("b", kind), LED], [[f"b:{pin}", "led1:A", "", []]])) == {label: "led1"}


def test_title_and_identity_are_the_id_and_the_module_is_the_type(tmp_path: Path) -> None:
    lcd = part("lcd1", "wokwi-lcd1602", pins="i2c")
    path = diagram(tmp_path, [UNO, lcd], [["uno:A4", "lcd1:SDA", "", []], ["uno:A5", "lcd1:SCL", "", []]])
    told = next(c for c in hardware(path).result["components"] if c["title"] == "lcd1")
    assert (told["model_index"], told["module_id"]) == ("lcd1", "wokwi-lcd1602")
    assert "I2C" in told["part_title"]
    assert pins(path) == {"A4": "lcd1", "A5": "lcd1"}
    plain = diagram(tmp_path, [UNO, part("lcd1", "wokwi-lcd1602")], [["uno:A4", "lcd1:SDA", "", []]])
    assert pins(plain) == {}


def test_a_pin_that_supplies_a_part_is_written(tmp_path: Path) -> None:
    ranger, screen = part("us1", "wokwi-hc-sr04"), part("oled1", "board-ssd1306")
    wires = [["us1:VCC", "uno:7"], ["us1:TRIG", "uno:8"], ["us1:ECHO", "uno:9"], ["us1:GND", "uno:10"], ["oled1:VCC", "uno:4"]]
    path = diagram(tmp_path, [UNO, ranger, screen], [[*wire, "", []] for wire in wires])
    signals = {m["pin"]: m["signal"] for m in hardware(path).result["mappings"]}
    assert signals == {"D4": "write", "D7": "write", "D8": "write", "D9": "read", "D10": "write"}


def test_the_serial_monitor_is_no_component_and_a_chip_of_ones_own_is_unknown(tmp_path: Path) -> None:
    chip = part("chip1", "chip-hc-sr04")
    wires = [["$serialMonitor:TX", "uno:0", "", []], ["uno:1", "$serialMonitor:RX", "", []], ["uno:7", "chip1:MISO", "", []]]
    circuit, findings = read_circuit(diagram(tmp_path, [UNO, chip], wires))
    assert [(c.title, c.role.name) for c in circuit.components] == [("uno", "Board"), ("chip1", "Unknown")]
    assert len(said(findings, "RS203")) == 1
    assert pins(tmp_path / "diagram.json") == {"D7": "chip1"}


def test_a_button_whose_one_contact_ties_the_pin_to_ground_is_no_mapping(tmp_path: Path) -> None:
    wires = [["uno:2", "btn1:1.l", "", []], ["uno:GND.1", "btn1:1.r", "", []], ["uno:3", "btn2:1.l", "", []]]
    wires.append(["uno:GND.2", "btn2:2.r", "", []])
    path = diagram(tmp_path, [UNO, part("btn1", "wokwi-pushbutton"), part("btn2", "wokwi-pushbutton")], wires)
    assert pins(path) == {"D3": "btn2"}
    [told] = [f.message for f in hardware(path).findings if f.rule == "RS228"]
    assert "btn1" in told
    assert "1.l" in told
    assert "1.r" in told


def test_what_repeats_an_input_is_passed_through(tmp_path: Path) -> None:
    parts = [UNO, part("m1", "wokwi-max7219-matrix"), part("m2", "wokwi-max7219-matrix")]
    wires = [
        ["uno:10", "m1:CS", "", []],
        ["m1:CS.2", "m2:CS", "", []],
        ["uno:11", "m1:DIN", "", []],
        ["m1:DOUT", "m2:DIN", "", []],
    ]
    found = hardware(diagram(tmp_path, parts, wires)).result["mappings"]
    assert {(m["pin"], m["component"]) for m in found} == {("D10", "m1"), ("D10", "m2"), ("D11", "m1")}


@pytest.mark.parametrize(
    ("parts", "wires", "rule", "words", "line"),
    [
        ([UNO, LED], [["uno:13", "led2:A", "", []]], "RS207", "led2", 7),
        ([UNO, part("b", "wokwi-pushbutton")], [["uno:13", "b:SIG", "", []]], "RS208", "has no pin 'SIG'", 7),
        ([UNO, LED], [["uno:14", "led1:A", "", []]], "RS208", "has no pin '14'", 7),
        ([UNO, LED], [["uno", "led1:A", "", []]], "RS208", "has no pin ''", 7),
        ([UNO, LED, LED], [["uno:13", "led1:A", "", []]], "RS206", "twice", 5),
        ([UNO, LED], [["uno:13"]], "RS214", "entry 1 of the connections", 7),
        ([UNO, LED], [{"from": "uno:13"}], "RS214", "entry 1 of the connections", 7),
        ([UNO, LED, 7], [], "RS214", "entry 3 of the parts", 5),
        ([UNO, {"id": "x"}], [], "RS214", "'x' has no type", 4),
    ],
)
def test_what_cannot_be_told_is_left_out_and_said(
    parts: list[Any], wires: list[Any], rule: str, words: str, line: int, tmp_path: Path
) -> None:
    path = diagram(tmp_path, parts, wires)
    told = said(read_circuit(path)[1], rule)
    assert told
    assert words in told[0][0]
    assert told[0][1] == line
    assert pins(path) == {}


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ('{"parts": [', "not valid JSON"),
        ('{"parts": [{"type": "wokwi-led", "id": "a"}', "not valid JSON"),
        ('{"parts": []} more', "after its end"),
        ('{"parts": [] "connections": []}', "',' is expected"),
        ('{"parts": [], "parts": []}', "'parts' occurs twice"),
        ('{"parts": {}}', "'parts' is not a list"),
        ('{"connections": []}', "it has no list of parts"),
        ("[]", "'{' is expected"),
        ("{}", "it has no list of parts"),
        ('{"parts": [{"a": ' + "[" * 100_000, "nested too deeply"),
        ('{"parts": [], "version": ' + "9" * 10_000 + "}", "digits"),
        ("\udcff", "it is not UTF-8"),
    ],
)
def test_what_is_no_diagram_is_refused_with_its_place(text: str, cause: str, tmp_path: Path) -> None:
    path = tmp_path / "diagram.json"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(SourceError, match=cause) as refused:
        read_circuit(path)
    assert refused.value.location is not None
    assert refused.value.location.path == str(path)
    assert refused.value.fix


@pytest.mark.parametrize(("boards", "words"), [([], "no board"), ([UNO, part("nano", "wokwi-arduino-nano")], "2 boards")])
def test_a_program_moves_to_one_board_only(boards: list[Any], words: str, tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=words) as refused:
        plan_migration([PROGRAM], hardware=diagram(tmp_path, [*boards, LED], []))
    assert refused.value.fix


@pytest.mark.parametrize("kind", ["board-esp32-s3-devkitc-1", "board-franzininho-wifi", "board-xiao-esp32-c3"])
def test_a_board_of_another_family_is_read_and_no_program_is_moved_to_it(kind: str, tmp_path: Path) -> None:
    path = diagram(tmp_path, [part("board", kind), LED], [["board:D5", "led1:A", "", []], ["board:GND.1", "led1:C", "", []]])
    made = hardware(path)
    assert [b["module_id"] for b in made.result["boards"]] == [kind]
    assert [m["component"] for m in made.result["mappings"]] == ["led1"]
    assert {net.voltage for net in made.circuit.nets if net.rail} == {"GND"}
    with pytest.raises(SourceError, match="unknown board"):
        plan_migration([PROGRAM], hardware=path)


def test_a_board_of_a_type_that_nobody_knows_is_one_where_no_other_is(tmp_path: Path) -> None:
    wires = [["b:D5", "led1:A", "", []], ["b:GND.1", "led1:C", "", []]]
    path = diagram(tmp_path, [part("b", "board-acme-9000"), LED], wires)
    made = hardware(path)
    assert [(b["title"], b["module_id"]) for b in made.result["boards"]] == [("b", "board-acme-9000")]
    assert pins(path) == {"D5": "led1"}
    assert "type begins with 'board-'" in made.circuit.components[0].roleEvidence
    with pytest.raises(SourceError, match="unknown board 'b'"):
        plan_migration([PROGRAM], hardware=path)
    beside = hardware(diagram(tmp_path, [part("b", "board-acme-9000"), LED, UNO], wires))
    assert [b["title"] for b in beside.result["boards"]] == ["uno"]


def test_five_hundred_parts_take_half_a_second_and_too_many_are_refused(tmp_path: Path) -> None:
    leds = [part(f"led{n}", "wokwi-led", label=f"lamp {n}") for n in range(500)]
    path = diagram(tmp_path, [UNO, *leds], [[f"uno:{2 + n % 12}", f"led{n}:A", "green", []] for n in range(500)])
    read_circuit(path)  # the data of the parts are read
    best = min(_seconds(path) for _ in range(3))
    assert best <= 0.5, f"{best:.2f} s"
    many = ",".join(['{"type":"wokwi-led","id":"a"}'] * (MOST_PARTS + 1))
    path.write_text(f'{{"editor": "wokwi", "parts": [{many}]}}')
    with pytest.raises(SourceError, match="more than 20,000 parts"):
        read_circuit(path)


def _seconds(path: Path) -> float:
    start = time.perf_counter()
    circuit, _ = read_circuit(path)
    assert len(circuit.components) == 501
    return time.perf_counter() - start


def test_other_json_is_no_diagram() -> None:
    assert not recognises(b'{"parts": [{"type": "wheel"}]}')
    assert not recognises(b'{"schema": "robosmi/1", "command": "wokwi-x"}')
    assert recognises(b'\xef\xbb\xbf{"parts": [ {"id": "a", "type": "board-ssd1306"} ]}')
    assert recognises(b'{ "connections": [["uno:1", "$serialMonitor:RX"]], "parts" : []}')


def test_a_wire_has_its_colour_its_ends_and_its_net(tmp_path: Path) -> None:
    circuit, _ = read_circuit(diagram(tmp_path, [UNO, LED], [["uno:13", "led1:A", "green", []], ["led1:C", "led1:C", "", []]]))
    first, second = circuit.wires
    assert (first.color, [(e.component.title, e.connectorId) for e in first.ends if e.component]) == (
        "green",
        [("uno", "13"), ("led1", "A")],
    )
    assert isinstance(first.net, hw.Net)
    assert len(second.ends) == 1


def test_all_symbols_of_a_supply_are_one_net(tmp_path: Path) -> None:
    parts = [
        UNO,
        LED,
        part("b", "wokwi-pushbutton"),
        *(part(f"{kind}{n}", f"wokwi-{kind}") for kind in ("gnd", "vcc") for n in (1, 2)),
    ]
    pairs = [
        ("led1:C", "gnd1:GND"),
        ("uno:GND.1", "gnd2:GND"),
        ("uno:5V", "vcc1:VCC"),
        ("vcc2:VCC", "b:1.l"),
        ("uno:13", "led1:A"),
    ]
    circuit, _ = read_circuit(diagram(tmp_path, parts, [[*pair, "", []] for pair in pairs]))
    rails: list[Any] = [net for net in circuit.nets if net.rail]
    nets = [{str(c.eContainer().title) for c in net.connectors} - {"uno"} for net in rails]
    assert sorted(map(sorted, nets)) == [["b", "vcc1", "vcc2"], ["gnd1", "gnd2", "led1"]]


def test_half_of_a_character_in_a_name_is_one_that_files_can_hold(tmp_path: Path) -> None:
    path = tmp_path / "diagram.json"
    path.write_text(
        '{"editor": "wokwi", "parts": [{"type": "wokwi-arduino-uno", "id": "uno"}, {"type": "wokwi-led", "id": "\\ud800"}],'
        ' "connections": [["uno:13", "\\ud800:A", "\\udfff", []]]}'
    )
    table = tmp_path / "a.csv"
    table.write_text(hardware(path).pin_table(table), encoding="utf-8")
    assert [(m["pin"], m["component"]) for m in hardware(table).result["mappings"]] == [("D13", "\ufffd")]
