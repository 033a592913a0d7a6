"""Reader of KiCad's files: sheets, labels, buses, units, libraries, and damaged files, which give no wrong pin."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.metamodels import hardware as hw
from robosmi.transformations.m2m.circuits.connector_mapping import map_connectors
from robosmi.transformations.queries.circuits.circuit import component_named
from robosmi.transformations.queries.circuits.former_titles import former_name, former_title
from robosmi.transformations.t2m.kicad import read_circuit
from tests.transformations.t2m.drawn import pins, said
from tests.transformations.t2m.kicad.support import (
    LIBRARY,
    below,
    bus,
    entry,
    label,
    led,
    placed,
    schematic,
    symbol,
    uno,
    wire,
)

CACHES = Path(__file__).parents[1] / "drawing_readers" / "kicad"


def test_wires_cross_without_a_junction_and_join_with_one(tmp_path: Path) -> None:
    crossed = [uno(), led("D1", 150, 20), led("D2", 130, 60), wire(100, 20, 150, 20), wire(130, 10, 130, 60)]
    assert pins(schematic(tmp_path / "a.kicad_sch", *crossed)) == {"D2": "D1"}
    joined = [*crossed, "(junction (at 130 20))"]
    circuit, _ = read_circuit(schematic(tmp_path / "b.kicad_sch", *joined))
    titles = {id(c): component.title for component in circuit.components for c in component.connectors}
    assert {frozenset(titles[id(c)] for c in net.connectors) for net in circuit.nets} == {frozenset({"A1", "D1", "D2"})}


def test_labels_join_on_their_sheet_and_global_ones_everywhere_and_by_accident_what_bears_their_name(tmp_path: Path) -> None:
    entries = [
        uno(), led("D1", 150, 200), led("D2", 170, 200), led("D3", 190, 200), label("LAMP", 100, 20), label("LAMP", 150, 200),
        label("BUS", 100, 30, "global_label"), label("BUS", 170, 200, "global_label"),
        label("MOTOR", 100, 40), label("MOTOR", 190, 200, "global_label"),
    ]  # fmt: skip
    assert pins(schematic(tmp_path / "a.kicad_sch", *entries)) == {"D2": "D1", "D3": "D2", "D4": "D3"}


def test_sheets_below_are_read_twice_with_parts_of_their_own_and_their_labels_stay_there(tmp_path: Path) -> None:
    schematic(tmp_path / "lamp.kicad_sch", led("D1", 50, 50), label("IN", 50, 50, "hierarchical_label"), label("X", 50, 60))
    root = [uno(), below("left", "lamp.kicad_sch", ("IN", 100, 20)), below("right", "lamp.kicad_sch", ("IN", 100, 30))]
    path = schematic(tmp_path / "robot.kicad_sch", *root, label("X", 100, 50))
    circuit, _ = read_circuit(path)
    assert pins(path) == {"D2": "left/D1", "D3": "right/D1"}
    assert {c.elementId for c in circuit.components} == {"A1-100-0", "left-id/D1-50-50", "right-id/D1-50-50"}
    assert [*circuit.companions] == ["lamp.kicad_sch"]


def test_a_component_is_called_by_its_reference_and_its_former_title_still_names_it(tmp_path: Path) -> None:
    """The names of sheets are in the title only where several parts have one reference; settings may have them everywhere."""
    schematic(tmp_path / "lamp.kicad_sch", led("D1", 50, 50), led("D7", 50, 150), label("IN", 50, 150, "hierarchical_label"))
    root = [uno(), led("D1", 300, 50), below("front", "lamp.kicad_sch", ("IN", 100, 20))]
    path = schematic(tmp_path / "robot.kicad_sch", *root)
    circuit, _ = read_circuit(path)
    assert sorted(c.title for c in circuit.components) == ["A1", "D1", "D7", "front/D1"]
    lamp = component_named(circuit, "D7")
    assert component_named(circuit, "front/D7") is lamp
    assert former_title(lamp) == "front/D7"
    assert component_named(circuit, "D1").elementId == "D1-300-50"
    (connection,) = map_connectors(circuit)[0]
    assert (connection.name, former_name(connection)) == ("D7WriteP1", "frontD7WriteP1")
    for name in ("D7", "front/D7"):
        given = read_circuit(path, roles={name: "Input"})[0]
        assert {c.title: c.role.name for c in given.components}["D7"] == "Input"


PICO = [*(f"GPIO{n}" for n in range(23)), "GPIO26_ADC0", "GPIO27_ADC1", "GPIO28_ADC2", "RUN", "3V3_EN", "ADC_VREF", "AGND"]
"""Names of the pins of KiCad's symbols of the Pico (KiCad 8 and newer) and of those of the library KiCad-RP-Pico."""


@pytest.mark.parametrize(
    ("kind", "value", "board"),
    [
        ("MCU_Module:RaspberryPi_Pico", "", "pico"),
        ("MCU_Module:RaspberryPi_Pico_Debug", "", "pico"),
        ("MCU_Module:RaspberryPi_Pico_Extensive", "", "pico"),
        ("MCU_Module:RaspberryPi_Pico_W", "", "picow"),
        ("MCU_Module:RaspberryPi_Pico_W_Debug", "", "picow"),
        ("MCU_RaspberryPi_and_Boards:Pico", "", "pico"),
        ("MCU_RaspberryPi_and_Boards:Pico", "Raspberry Pi Pico W", "picow"),
        ("MCU_Module:RaspberryPi_Pico", "Pico 2", ""),
    ],
)
def test_a_pico_is_known_with_its_pins_and_a_pico_2_is_not(kind: str, value: str, board: str, tmp_path: Path) -> None:
    library = [*LIBRARY, symbol(kind, PICO)]
    entries = [placed(kind, "A1", 100, 0, value), led("D1", 100, 150), led("D2", 100, 240)]
    circuit, _ = read_circuit(schematic(tmp_path / "robot.kicad_sch", *entries, library=library))
    drawn = component_named(circuit, "A1")
    assert drawn.boardName == board
    if board:
        assert [c.pin for c in drawn.connectors][:26] == [f"GP{n}" for n in (*range(23), 26, 27, 28)]
        assert not any(c.pin for c in drawn.connectors[26:])
        assert {f"{c.boardConnectors[0].pin}" for c in map_connectors(circuit)[0]} == {"GP15", "GP16", "GP27", "GP28"}


DEVKIT = [
    "SENSOR_VP/GPIO36/ADC1_CH0", "VDET_1/GPIO34/ADC1_CH6", "32K_XP/GPIO32/ADC1_CH4", "DAC_1/ADC2_CH8/GPIO25",
    "MTMS/GPIO14/ADC2_CH6", "SD_DATA2/GPIO9", "CMD", "ADC2_CH2/GPIO2", "GPIO16", "GPIO17", "U0TXD/GPIO1", "CHIP_PU", "5V",
]  # fmt: skip
"""Names of pins of Espressif's symbol ESP32-DevKitC (espressif/kicad-libraries)."""
C3 = ["GPIO2", "GPIO3", "GPIO19/USB_D-", "GPIO8", "GPIO20/U0RXD", "GPIO21/U0TXD", "RST", "3V3"]
TEENSY = [
    "8_TX2_IN1",
    "13_SCK_CRX1_LED",
    "14_A0_TX3_SPDIF_OUT",
    "19_A5_SCL0",
    "0_RX1_CRX2_CS1",
    "1_TX1_CTX2_MISO1",
    "VBAT",
    "ON_OFF",
]
"""Names of pins of the symbol Teensy4.0 (XenGi/teensy_library)."""
NANO = ["D0/RX", "D1/TX", "D2", "D11_MOSI", "D13_SCK", "A0", "A4/SDA", "RESET", "AREF"]
UNO = ["D0/RX", "D1/TX", "D2", "D13", "A0", "A5", "SDA", "SCL", "IOREF", "BOOT"]
"""Names of pins of symbols of Arduino boards (Alarm-Siren/arduino-kicad-library)."""


@pytest.mark.parametrize(
    ("kind", "names", "board", "labels"),
    [
        ("Espressif:ESP32-DevKitC", DEVKIT, "esp32", "IO36 IO34 IO32 IO25 IO14 - - IO2 IO16 IO17 IO1 - -"),
        ("PCM_Espressif:ESP32-C3-DevKitM-1", C3, "esp32c3", "IO2 IO3 IO19 IO8 IO20 IO21 - -"),
        ("teensy:Teensy4.0", TEENSY, "teensy40", "D8 D13 A0 A5 D0 D1 - -"),
        ("arduino-library:Arduino_Nano_33_BLE_Socket", NANO, "nano33ble", "D0 D1 D2 D11 D13 A0 A4 - -"),
        ("arduino-library:Arduino_Nano_RP2040_Connect_Tile", NANO, "nano-rp2040", "D0 D1 D2 D11 D13 A0 A4 - -"),
        ("arduino-library:Arduino_Uno_R4_Minima_Shield", UNO, "uno-r4-minima", "D0 D1 D2 D13 A0 A5 A4 A5 - -"),
        ("arduino-library:Arduino_Zero_Shield", UNO, "zero", "D0 D1 D2 D13 A0 A5 SDA SCL - -"),
        ("arduino-library:Arduino_Uno_R4_WiFi_Shield", UNO, "", ""),
        ("Espressif:ESP32-S3-DevKitC", C3, "", ""),
    ],
)
def test_a_board_of_32_bits_is_known_with_its_pins(kind: str, names: list[str], board: str, labels: str, tmp_path: Path) -> None:
    path = schematic(tmp_path / "robot.kicad_sch", placed(kind, "A1", 100, 0), library=[*LIBRARY, symbol(kind, names)])
    drawn = component_named(read_circuit(path)[0], "A1")
    assert drawn.boardName == board
    if board:
        assert [c.pin or "-" for c in drawn.connectors] == labels.split()


def test_members_of_a_bus_go_into_a_sheet_by_their_names(tmp_path: Path) -> None:
    schematic(tmp_path / "lamps.kicad_sch", led("D1", 50, 50), label("L[0..7]", 0, 0, "hierarchical_label"), label("L3", 50, 50))
    path = schematic(
        tmp_path / "robot.kicad_sch", uno(), below("lamps", "lamps.kicad_sch", ("L[0..7]", 0, 0)), label("L3", 100, 20)
    )
    assert pins(path) == {"D2": "D1"}


def lamps(folder: Path, name: str, inside: str, *members: str) -> None:
    """A sheet with lamps D1, D2, ... on members of a bus that comes in from above."""
    leds = [led(f"D{n}", 20 * n, 50) for n in range(1, len(members) + 1)]
    labels = [label(member, 20 * n, 50) for n, member in enumerate(members, 1)]
    schematic(folder / f"{name}.kicad_sch", label(inside, 0, 0, "hierarchical_label"), *leds, *labels)


@pytest.mark.parametrize(
    ("inside", "members", "outside", "labels"),
    [
        ("L[0..7]", ["L3"], "L[0..7]", ["L3"]),
        ("IN[7..0]", ["IN3"], "L[0..7]", ["L3"]),  # by their places, which are counted upwards
        ("USB{DP DM}", ["USB.DM"], "USB{DP DM}", ["USB.DM"]),
        ("{OE A[0..3]}", ["OE", "A2"], "{OE A[0..3]}", ["OE", "A2"]),
        ("X{PAIR}", ["X.N"], "X{PAIR}", ["X.N"]),
    ],
)
def test_members_of_a_bus_are_told_by_the_names_on_its_lines(
    inside: str, members: list[str], outside: str, labels: list[str], tmp_path: Path
) -> None:
    lamps(tmp_path, "lamps", inside, *members)
    lines = [bus(0, 0, 60, 0), label(outside, 30, 0), entry(40, 0), '(bus_alias "PAIR" (members "P" "N"))']
    wires = [label(text, 100, 20 + 10 * n) for n, text in enumerate(labels)]
    path = schematic(tmp_path / "robot.kicad_sch", uno(), below("lamps", "lamps.kicad_sch", (inside, 60, 0)), *lines, *wires)
    assert pins(path) == {f"D{2 + n}": f"D{n + 1}" for n in range(len(labels))}


@pytest.mark.parametrize("text", ["${NET}", "MOTOR_${SIDE}", "${A}_${B}", "${LED}[1]"])
def test_a_text_variable_is_no_group(text: str, tmp_path: Path) -> None:
    path = schematic(tmp_path / "robot.kicad_sch", uno(), led("D1", 300, 50), label(text, 100, 20), label(text, 300, 50))
    assert pins(path) == {"D2": "D1"}


def test_a_bus_leads_from_sheet_to_sheet_whatever_its_name_is_in_each(tmp_path: Path) -> None:
    lamps(tmp_path, "lamps", "L[0..3]", "L2")
    schematic(tmp_path / "brain.kicad_sch", uno(), label("B2", 100, 20), label("B[0..3]", 0, 0, "hierarchical_label"))
    sheets = [below("lamps", "lamps.kicad_sch", ("L[0..3]", 60, 0)), below("brain", "brain.kicad_sch", ("B[0..3]", 0, 0))]
    path = schematic(tmp_path / "robot.kicad_sch", *sheets, bus(0, 0, 60, 0))
    assert pins(path) == {"D2": "D1"}


def test_entries_that_meet_at_a_bus_join_nothing_and_a_label_at_one_is_that_of_its_wire(tmp_path: Path) -> None:
    parts = [uno(), led("D1", 96, 20), led("D2", 300, 50), bus(98, 0, 98, 60), entry(98, 18)]
    met = schematic(tmp_path / "a.kicad_sch", *parts, "(bus_entry (at 98 18) (size -2 2))")
    assert pins(met) == {}
    named = schematic(tmp_path / "b.kicad_sch", *parts, label("L1", 98, 18), label("L1", 300, 50))
    assert pins(named) == {"D2": "D2"}


def test_a_missing_sheet_is_said_and_a_sheet_outside_the_folder_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    schematic(tmp_path / "out.kicad_sch", led("D9", 50, 50), label("IN", 50, 50, "hierarchical_label"))
    root = [uno(), led("D1", 150, 20), wire(100, 20, 150, 20), below("a", "gone.kicad_sch", ("IN", 100, 20))]
    root.append(below("b", "../out.kicad_sch", ("IN", 100, 30)))
    path = schematic(tmp_path / "in" / "robot.kicad_sch", *root)
    assert len(said(read_circuit(path)[1], "RS214")) == 2
    assert pins(path) == {"D2": "D1"}


def test_a_sheet_that_has_itself_in_it_is_refused(tmp_path: Path) -> None:
    schematic(tmp_path / "b.kicad_sch", below("again", "a.kicad_sch"))
    with pytest.raises(SourceError, match="contains itself") as refused:
        read_circuit(schematic(tmp_path / "a.kicad_sch", below("b", "b.kicad_sch")))
    assert refused.value.fix


def test_units_of_a_reference_are_one_part_and_parts_without_a_number_are_told_apart(tmp_path: Path) -> None:
    two = '(symbol "Amp:LM358" (symbol "LM358_1_1" (pin input line (at 0 0 0) (name "A") (number "1")))'
    two += '(symbol "LM358_2_1" (pin input line (at 0 0 0) (name "B") (number "5"))))'
    entries = [
        uno(), placed("Amp:LM358", "U1", 100, 20), placed("Amp:LM358", "U1", 100, 30, unit=2), led("D?", 100, 40),
        led("D?", 100, 50),
    ]  # fmt: skip
    circuit, findings = read_circuit(schematic(tmp_path / "a.kicad_sch", *entries, library=[*LIBRARY, two]))
    assert [c.title for c in circuit.components] == ["A1", "U1", "D?", "D?"]
    assert said(findings, "RS206") == []


def test_a_reference_that_stands_twice_is_two_parts_and_said(tmp_path: Path) -> None:
    circuit, findings = read_circuit(schematic(tmp_path / "a.kicad_sch", uno(), led("D1", 100, 20), led("D1", 100, 30)))
    assert ["'D1' occurs twice" in message for message in said(findings, "RS206")] == [True]
    assert len({c.elementId for c in circuit.components}) == 3


def test_a_header_that_names_a_device_is_that_device_and_others_are_unknown(tmp_path: Path) -> None:
    entries = [uno(), placed("Connector:Conn_01x04", "J1", 100, 20, "HC-SR04"), placed("Connector:Conn_01x04", "J2", 100, 70)]
    circuit, _ = read_circuit(schematic(tmp_path / "a.kicad_sch", *entries))
    assert [c.role for c in circuit.components] == [hw.Role.Board, hw.Role.Input, hw.Role.Unknown]


def test_an_eeschema_drawing_without_its_library_has_parts_and_no_pins(tmp_path: Path) -> None:
    path = tmp_path / "robot.sch"
    path.write_bytes((CACHES / "legacy" / "robot.sch").read_bytes())
    circuit, findings = read_circuit(path)
    assert len(circuit.components) == 19
    assert [*circuit.nets] == []
    assert ["no library next to" in message for message in said(findings, "RS214")] == [True]


def test_a_netlist_with_pins_and_parts_that_are_not_there(tmp_path: Path) -> None:
    text = (CACHES / "netlist" / "robot.net").read_text()
    path = tmp_path / "robot.net"
    path.write_text(text.replace('(node (ref R1) (pin 1))', "").replace('(ref "R1") (pin 2)', '(ref "R1") (pin 7)')
        .replace('(ref "Basic Servo1") (pin 1)', '(ref "Servo9") (pin 1)'))  # fmt: skip
    found = pins(path)
    assert "D9" not in found
    assert "Red (633nm)-LED1" not in found.values()
    assert {f.rule for f in read_circuit(path)[1]} >= {"RS207", "RS208"}


def test_a_pin_on_two_nets_of_a_netlist_is_left_out_of_the_second_and_said(tmp_path: Path) -> None:
    text = (CACHES / "netlist" / "robot.net").read_text()
    path = tmp_path / "robot.net"
    path.write_text(text.replace('(node (ref "R1") (pin 2))', '(node (ref "R1") (pin 2))(node (ref "Basic Servo1") (pin 1))'))
    assert path.read_text() != text
    assert pins(path) == pins(CACHES / "netlist" / "robot.net")
    assert ["is on two nets; it was left out of" in message for message in said(read_circuit(path)[1], "RS208")] == [True]


def test_names_have_letters_that_mean_something_to_the_parser_of_lisp_and_nothing_to_kicad(tmp_path: Path) -> None:
    path = tmp_path / "a.net"
    path.write_text(
        "(export (version D) (components (comp (ref A[1]) (value Arduino_UNO_R3)) (comp (ref 'D1') (value a\\b]c)))\n"
        "(nets (net (code 1) (name N[0]) (node (ref A[1]) (pin 1)) (node (ref 'D1') (pin 2)))))"
    )
    circuit, _ = read_circuit(path)
    assert [c.title for c in circuit.components] == ["A[1]", "'D1'"]
    assert [p.value for c in circuit.components for p in c.properties if p.name == "value"] == ["Arduino_UNO_R3", "a\\b]c"]
    assert [[(c.component.title, c.connectorId) for c in net.connectors if c.component] for net in circuit.nets] == [
        [("A[1]", "1"), ("'D1'", "2")]
    ]


@pytest.mark.parametrize("deep", ["[" * 10_000, "'" * 10_000])
def test_other_brackets_are_no_lists_however_many_there_are(deep: str, tmp_path: Path) -> None:
    circuit, _ = read_circuit(schematic(tmp_path / "a.kicad_sch", uno(), f"(title_block (comment 1 {deep}))", led("D1", 100, 20)))
    assert [c.title for c in circuit.components] == ["A1", "D1"]


def test_a_field_with_a_number_of_thousands_of_digits_is_no_field(tmp_path: Path) -> None:
    path = tmp_path / "a.sch"
    path.write_text(
        f'EESchema Schematic File Version 4\n$Comp\nL R R1\nU 1 1 5A\nP 10 10\nF {"9" * 5_000} "x"\n$EndComp\n$EndSCHEMATC\n'
    )
    assert [c.title for c in read_circuit(path)[0].components] == ["R1"]


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ("(kicad_sch (version 1)", "ends before its lists do"),
        ('(kicad_sch (version "1)', "no end"),
        ("(kicad_sch))", r"has no '\('"),
        ("(kicad_sch) (more)", "after its end"),
        ("(kicad_sch " + "(" * 100_000, "lists inside lists"),
        ("(kicad_pcb (version 1))", "neither a schematic nor a netlist"),
        ("(export (version D) (components))", "no components or no nets"),
        ("(kicad_sch\n(wire (pts (xy nan 2) (xy 1 2))))", "'nan' is not a coordinate"),
        ("(kicad_sch\n(wire (pts (xy 1e309 2) (xy 1 2))))", "'inf' is not a coordinate"),
        ("(kicad_sch\n(junction (at x 2)))", "'x' is not a coordinate"),
        ('(kicad_sch\n(label "A" (at 5)))', "'at' is followed by 1 of 2 numbers"),
        ("v 20130925 2\nC 40000 40000 0 0 0 title-B.sym\n", "schematic of gEDA"),
        ("v {xschem version=3.4.4 file_version=1.2}\nG {}\n", "schematic of xschem"),
        ("<Qucs Schematic 0.0.19>\n<Properties>\n", "schematic of Qucs"),
        ("# EESchema Netlist Version 1.1 created now\n", "KiCad 3 and before"),
        ("EESchema Schematic File Version 4\n$Comp\nL R R1\n", "ends within an entry"),
        ("EESchema Schematic File Version 4\nWire Wire Line\n\t1 2 x 4\n$EndSCHEMATC\n", "expected 4 numbers"),
        ("EESchema Schematic File Version 4\n", "ends before its"),
    ],
)
def test_what_is_damaged_is_refused_with_place_and_cause(text: str, cause: str, tmp_path: Path) -> None:
    path = tmp_path / "a.sch"
    path.write_text(text)
    with pytest.raises(SourceError, match=cause) as refused:
        read_circuit(path)
    assert refused.value.fix
    assert refused.value.location is not None
    assert refused.value.location.line


def test_five_hundred_parts_are_read_at_once(tmp_path: Path) -> None:
    entries = [
        uno(),
        *(led(f"D{n}", 1000 + 20 * n, 500) for n in range(500)),
        *(wire(1000 + 20 * n, 500, 1020 + 20 * n, 500) for n in range(499)),
    ]
    path = schematic(tmp_path / "a.kicad_sch", *entries)
    read_circuit(path)
    took = []
    for _ in range(3):
        started = time.process_time()
        circuit, _ = read_circuit(path)
        took.append(time.process_time() - started)
    assert len(circuit.components) == 501
    assert min(took) <= 0.5


def test_a_hundred_thousand_parts_are_refused_before_they_are_parsed(tmp_path: Path) -> None:
    path = schematic(tmp_path / "a.kicad_sch", *(led(f"D{n}", n, 0) for n in range(100_000)))
    started = time.process_time()
    with pytest.raises(SourceError, match="more than 50,000 symbols"):
        read_circuit(path)
    assert time.process_time() - started < 10


def test_a_local_symbol_of_a_supply_names_a_net_of_its_sheet_alone(tmp_path: Path) -> None:
    """KiCad 9 has both; a global one joins sheets."""
    for form, joined in (("local", False), ("global", True)):
        library = [*LIBRARY, symbol("power:VDD", ["VDD"], f"(power {form})", "power_in")]
        inner = [led("D1", 300, 0), placed("power:VDD", "#PWR2", 300, 0)]
        schematic(tmp_path / "inner.kicad_sch", *inner, library=library)
        outer = [led("D2", 300, 0), placed("power:VDD", "#PWR1", 300, 0), below("S", "inner.kicad_sch")]
        path = schematic(tmp_path / "a.kicad_sch", *outer, library=library)
        circuit, _ = read_circuit(path)
        one, other = (next(c for c in circuit.components if c.title == title).connectors[0].net for title in ("D2", "D1"))
        assert (one is other) is joined
        assert one is not None
        assert one.title == "VDD"


def test_names_of_nets_are_as_a_person_wrote_them(tmp_path: Path) -> None:
    path = schematic(
        tmp_path / "a.kicad_sch", uno(), led("D1", 300, 0), label("PWM{slash}A", 100, 20), label("PWM{slash}A", 300, 0)
    )
    assert [net.title for net in read_circuit(path)[0].nets] == ["PWM/A"]
    netlist = tmp_path / "a.net"
    nets = "".join(
        f'(net (code {n}) (name "{name}") (node (ref A1) (pin {n})) (node (ref D1) (pin {n})))'
        for n, name in ((1, "/Motors/PWM{slash}A"), (2, "Net-(A1-SDA/A4)"))
    )
    parts = "(comp (ref A1) (value Uno)) (comp (ref D1) (value LED))"
    netlist.write_text(f"(export (version D) (components {parts}) (libparts) (nets {nets}))")
    assert {net.title for net in read_circuit(netlist)[0].nets} == {"PWM/A", ""}


def test_symbols_that_kicad_has_rescued_are_what_they_were(tmp_path: Path) -> None:
    """A resistor of a rescue library conducts as any other, and the lamp behind it is on the pin."""
    library = [*LIBRARY, symbol("robot-rescue:R-Device", ["1", "2"]), symbol("robot-rescue:LED-RESCUE-robot", ["1", "2"])]
    parts = [placed("robot-rescue:R-Device", "R1", 300, 0, "220"), placed("robot-rescue:LED-RESCUE-robot", "D1", 400, 0)]
    labels = [label("A", 100, 20), label("A", 300, 0), label("B", 300, 10), label("B", 400, 0)]
    path = schematic(tmp_path / "a.kicad_sch", uno(), *parts, *labels, library=library)
    circuit, _ = read_circuit(path)
    assert [(c.partId, c.role) for c in circuit.components[1:]] == [("Device:R", hw.Role.Passive), ("LED", hw.Role.Output)]
    assert pins(path) == {"D2": "D1"}


@pytest.mark.parametrize("none", ["", "~"])
def test_pins_to_which_nobody_gave_a_number_are_pins_each(tmp_path: Path, none: str) -> None:
    pin = '(pin passive line (at 0 {} 0) (name "{}") (number "{}"))'
    names = ["VCC", "TRIG", "ECHO", "GND", "GND"]
    listed = " ".join(pin.format(-10 * n, name, none) for n, name in enumerate(names))
    echo = f'(symbol "Own:HC-SR04" (symbol "HC-SR04_1_1" {listed}))'
    entries = [
        uno(), placed("Own:HC-SR04", "U1", 300, 0), wire(100, 20, 300, 10), wire(100, 30, 300, 20), wire(100, 160, 300, 40),
    ]  # fmt: skip
    path = schematic(tmp_path / "a.kicad_sch", *entries, library=[*LIBRARY, echo])
    circuit, findings = read_circuit(path)
    assert pins(path) == {"D2": "U1", "D3": "U1"}
    nets = {c.connectorId: c.net for c in circuit.components[1].connectors}
    assert list(nets) == ["VCC", "TRIG", "ECHO", "GND", "GND.2"]
    assert len({id(net) for net in nets.values() if net is not None}) == 3
    assert said(findings, "RS208") == []


def test_a_number_of_two_pins_on_different_nets_is_on_none_and_said(tmp_path: Path) -> None:
    one = '(pin passive line (at 0 {} 0) (name "{}") (number "1"))'
    double = f'(symbol "Own:X" (symbol "X_1_1" {one.format(0, "A")} {one.format(-10, "B")}))'
    entries = [uno(), placed("Own:X", "U1", 300, 0), wire(100, 20, 300, 0), wire(100, 30, 300, 10), led("D1", 100, 40)]
    path = schematic(tmp_path / "a.kicad_sch", *entries, library=[*LIBRARY, double])
    assert pins(path) == {"D4": "D1", "D5": "D1"}
    assert ["1 of 'U1' belongs to pins on several nets" in text for text in said(read_circuit(path)[1], "RS208")] == [True]


def test_pins_without_a_number_in_a_netlist_are_told_apart_by_what_they_do(tmp_path: Path) -> None:
    pair = "".join(f'(pin (num "") (name "{name}") (type "passive"))' for name in ("TRIG", "ECHO"))
    board = "".join(f'(pin (num "{n}") (name "D{n}") (type "passive"))' for n in range(14))
    parts = [("A1", "Arduino_UNO_R3", board), ("U1", "HC-SR04", pair)]
    components = "".join(f'(comp (ref "{r}") (value "{n}") (libsource (lib "Own") (part "{n}")))' for r, n, _ in parts)
    library = "".join(f'(libpart (lib "Own") (part "{n}") (pins {listed}))' for _, n, listed in parts)
    nets = "".join(
        f'(net (code {n}) (name "N{n}") (node (ref "A1") (pin "{n}")) (node (ref "U1") (pin "") (pinfunction "{name}")))'
        for n, name in ((2, "TRIG"), (3, "ECHO"))
    )
    path = tmp_path / "a.net"
    path.write_text(f"(export (version E) (components {components}) (libparts {library}) (nets {nets}))")
    assert pins(path) == {"D2": "U1", "D3": "U1"}


@pytest.mark.parametrize(
    ("pins_of_part", "shared"),
    [
        (["G", "D", "S"], "G"),
        (["A", "B", "C", "D", "E", "F", "G", "DP"], "G"),
        (["A", "R", "G", "B"], "G"),
        (["~", "-", "+", "V-", "V+"], "+"),
        (["~", "-", "+", "V-", "V+"], "-"),
    ],
)
def test_gates_segments_colours_and_inputs_of_two_parts_are_no_rail(pins_of_part: list[str], shared: str, tmp_path: Path) -> None:
    """`G` and `+` name a ground and a supply alone, and signals beside the other names of such parts."""
    y = 90 - 10 * pins_of_part.index(shared)  # so that the shared pins are at D9's place
    entries = [
        uno(),
        placed("my:part", "U1", 200, y),
        placed("my:part", "U2", 250, y),
        wire(100, 90, 200, 90),
        wire(200, 90, 250, 90),
    ]
    path = schematic(tmp_path / "a.kicad_sch", *entries, library=[*LIBRARY, symbol("my:part", pins_of_part)])
    circuit, _ = read_circuit(path)
    assert [(net.rail, [c.name for c in net.connectors if c.pin == ""]) for net in circuit.nets] == [(False, [shared, shared])]


def test_two_sensors_with_plus_and_minus_are_fed_by_these(tmp_path: Path) -> None:
    entries = [uno(), placed("my:part", "U1", 200, 80), placed("my:part", "U2", 250, 80), wire(200, 90, 250, 90)]
    path = schematic(tmp_path / "a.kicad_sch", *entries, library=[*LIBRARY, symbol("my:part", ["OUT", "+", "-"])])
    assert [net.rail for net in read_circuit(path)[0].nets] == [True]


@pytest.mark.parametrize("pin", ["~{CHRG}", "CE", "EN", "STAT"])
def test_what_steers_a_supply_or_tells_of_it_makes_no_rail(pin: str, tmp_path: Path) -> None:
    charger = symbol("Battery_Management:TP4056", ["GND", "VCC", "BAT", pin])
    entries = [
        uno(), placed("Battery_Management:TP4056", "U1", 200, 60), led("D1", 250, 90), wire(100, 90, 200, 90),
        wire(200, 90, 250, 90),
    ]  # fmt: skip
    path = schematic(tmp_path / "a.kicad_sch", *entries, library=[*LIBRARY, charger])
    assert next(c.role for c in read_circuit(path)[0].components if c.title == "U1") is hw.Role.Power
    assert pins(path) == {"D9": "D1"}
