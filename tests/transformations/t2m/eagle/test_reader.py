"""Reader of EAGLE schematics: what symbols stand for, modules and supplies, and damaged files, which give no wrong pin."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from robosmi.diagnostics import Severity
from robosmi.errors import SourceError
from robosmi.metamodels import hardware as hw
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.t2m.eagle import read_circuit
from robosmi.transformations.t2m.eagle.reader import MOST_PARTS, connectors_of, recognises
from tests.transformations.t2m.drawn import pins, said
from tests.transformations.t2m.eagle.support import CHIP, HEADER, TWO, UNO, Pins, device, net, part, schematic


def test_a_bare_chip_is_the_uno_by_its_ports_and_the_value_goes_before_the_symbol(tmp_path: Path) -> None:
    parts = [part("IC1", "MEGA168", "ATMEGA328P"), part("Q1", "CRYSTAL", "8MHz"), part("J1", "PINHD-1X4", "HC-SR04")]
    nets = [net("TRIG", "IC1.(PCINT1)PB1", "J1.2"), net("X", "IC1.(PCINT6)PB6", "Q1.1")]
    path = schematic(tmp_path, [device("MEGA168", CHIP), device("CRYSTAL", TWO), device("PINHD-1X4", HEADER)], parts, nets)
    circuit, findings = read_circuit(path)
    assert circuit.components[0].boardName == "uno"
    assert pins(path)["D9"] == "J1"
    assert "bare ATMEGA328P" in said(findings, "RS215")[0]
    assert ["8MHz" in message and "16 MHz" in message for message in said(findings, "RS218")] == [True]


def test_another_chip_is_named_and_pins_that_the_board_lacks_are_an_error(tmp_path: Path) -> None:
    tiny = schematic(tmp_path, [device("ATTINY2313", CHIP)], [part("IC1", "ATTINY2313"), part("R1", "ATTINY2313")], [])
    assert "ATTINY2313" in said(read_circuit(tiny)[1], "RS215")[0]
    chip = [*CHIP, ("ADC6", "io")]
    path = schematic(tmp_path, [device("ATMEGA328P", chip), device("R", TWO)], [part("IC1", "ATMEGA328P"), part("R1", "R")],
        [net("SENSE", "IC1.ADC6", "R1.1")])  # fmt: skip
    assert [f.severity for f in read_circuit(path)[1] if f.rule == "RS216"] == [Severity.error]


def test_headers_are_unknown_and_not_walked_through_but_for_those_that_name_a_device(tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", UNO), device("PINHD-1X4", HEADER)]
    parts = [part("U1", "ARDUINO_UNO"), part("J1", "PINHD-1X4", "HC-SR04"), part("J2", "PINHD-1X4"), part("J3", "PINHD-1X4")]
    path = schematic(
        tmp_path, libraries, parts, [net("TRIG", "U1.D2", "J1.2"), net("GRIPPER", "U1.D3", "J2.1"), net("Z", "J2.2", "J3.1")]
    )
    circuit, _ = read_circuit(path)
    roles = {c.title: (c.role, c.partTitle) for c in circuit.components}
    assert roles["J1"] == (hw.Role.Input, "HC-SR04")
    assert roles["J2"] == (hw.Role.Unknown, "GRIPPER, Z")
    assert pins(path) == {"D2": "J1", "D3": "J2"}


def test_a_header_is_what_its_reference_says(tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", UNO), device("PINHD-1X4", HEADER)]
    parts = [part("U1", "ARDUINO_UNO"), part("KEYPAD", "PINHD-1X4"), part("ENDSTOP", "PINHD-1X4")]
    path = schematic(tmp_path, libraries, parts, [net("A", "U1.D2", "KEYPAD.1"), net("B", "U1.D3", "ENDSTOP.1")])
    assert {c.title: c.role for c in read_circuit(path)[0].components[1:]} == dict.fromkeys(("KEYPAD", "ENDSTOP"), hw.Role.Input)


def test_connectors_of_any_library_end_a_path_but_for_sockets_of_cards(tmp_path: Path) -> None:
    """A jack, a terminal, a DIL socket with the name of its chip; the card in a socket is a part."""
    kinds = {"RJ45": "con-tyco", "KRE-2P": "kre", "DIL16": "ic-package", "USD-SOCKET": "SparkFun-Connectors"}
    described = {"DIL16": "Dual In Line Socket", "RJ45": "Jack"}
    libraries = [device("ARDUINO_UNO", UNO)] + [
        device(kind, HEADER, described.get(kind, "")).replace(f'library name="lib-{kind.lower()}"', f'library name="{library}"')
        for kind, library in kinds.items()
    ]
    parts = [part("U1", "ARDUINO_UNO")] + [
        part(name, kind).replace(f'library="lib-{kind.lower()}"', f'library="{kinds[kind]}"')
        for name, kind in {"X1": "RJ45", "PEDAL": "KRE-2P", "74HC4050": "DIL16", "U3": "USD-SOCKET"}.items()
    ]
    nets = [net(f"N${n}", f"U1.D{n}", f"{name}.1") for n, name in ((2, "X1"), (3, "PEDAL"), (4, "74HC4050"), (10, "U3"))]
    path = schematic(tmp_path, libraries, parts, nets)
    roles = {c.title: (c.role.name, c.driver) for c in read_circuit(path)[0].components[1:]}
    assert pins(path) == {"D2": "X1", "D3": "PEDAL", "D4": "74HC4050", "D10": "U3"}
    assert roles == {
        "X1": ("Unknown", False), "PEDAL": ("Unknown", False), "74HC4050": ("Output", True), "U3": ("Both", False),
    }  # fmt: skip


LED_OUT = {
    "pins named like the pins that they are on": (["D2", "D3", "AD0", "IO5"], ["D2", "D3", "A0", "D5"], []),
    "a bus beside such pins": (["D2", "D3", "MOSI", "SCK"], ["D2", "D3", "D11", "D13"], []),
    "a socket with RESET of the board": (["N$1", "N$2", "N$3", "N$4", "N$5"], ["D2", "D3", "D4", "D5", "RESET"], []),
    "a programmer": (["MOSI", "MISO", "SCK", "RST"], ["D11", "D12", "D13", "RESET"], []),
    "beside drawn devices": (["LEFT", "RIGHT"], ["D2", "D3"], ["D2", "D3"]),
}
KEPT = {
    "a bus with chip select": (["MOSI", "MISO", "SCK", "CE", "CSN"], ["D11", "D12", "D13", "D9", "D10"], []),
    "nets with names of their own": (["BUMP_L", "BUMP_R", "D7", "D8"], ["D2", "D3", "D4", "D5"], []),
    "a net that resets a device": (["CLOCK", "LATCH", "DATA", "CHAR", "REG_RESET"], ["D2", "D3", "D4", "D5", "D6"], []),
    "nets without names": (["N$1", "N$2", "N$3", "N$4"], ["D2", "D3", "D4", "D5"], []),
    "a supply beside a drawn device": (["LEFT", "GND"], ["D2", "GND@1"], ["D2"]),
    "three pins": (["D2", "D3", "D4"], ["D2", "D3", "D4"], []),
}


@pytest.mark.parametrize("size", ["R0805", "C0603"])
def test_a_library_called_by_the_size_of_a_resistor_or_capacitor_makes_the_part_one(size: str, tmp_path: Path) -> None:
    libraries = [device("UNO", UNO), device("LED", TWO, "LED"), device("2-2176053-0", TWO).replace("lib-2-2176053-0", size)]
    parts = [part("U1", "UNO"), part("LED1", "LED"), part("X4", "2-2176053-0").replace("lib-2-2176053-0", size)]
    path = schematic(tmp_path, libraries, parts, [net("N$1", "U1.D2", "X4.1"), net("N$2", "X4.2", "LED1.1")])
    assert {m["pin"]: m["component"] for m in hardware(path).result["mappings"]} == {"D2": "LED1"}


@pytest.mark.parametrize("case", [*LED_OUT, *KEPT])
def test_a_header_that_only_leads_pins_out_is_no_part(case: str, tmp_path: Path) -> None:
    names, on, devices = (LED_OUT | KEPT)[case]
    libraries = [
        device("ARDUINO_UNO", [*UNO, ("RESET", "io")]), device("PINHD-1X8", [(str(n), "pas") for n in range(1, 9)]),
        device("LED", TWO, "LED"),
    ]  # fmt: skip
    parts = [part("JP1", "PINHD-1X8"), part("U1", "ARDUINO_UNO")] + [part(f"LED{n}", "LED") for n in range(len(devices))]
    nets = [
        net(name, f"U1.{pin}", f"JP1.{n}", *(f"LED{devices.index(pin)}.1" for _ in [0] if pin in devices))
        for n, (name, pin) in enumerate(zip(names, on, strict=True), 1)
    ]
    path = schematic(tmp_path, libraries, parts, nets)
    circuit, findings = read_circuit(path)
    header = circuit.components[0]
    assert [header.role.name, bool(said(findings, "RS259"))] == (["Passive", True] if case in LED_OUT else ["Unknown", False])
    assert ("JP1" in {m["component"] for m in hardware(path).result["mappings"]}) == (case in KEPT)


def test_a_plug_that_is_called_so_is_for_a_programmer_whatever_else_is_on_it(tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", UNO), device("PINHD-1X4", HEADER)]
    parts = [part("U1", "ARDUINO_UNO"), part("J1", "PINHD-1X4", "ISP/SPI"), part("DISP", "PINHD-1X4")]
    path = schematic(
        tmp_path, libraries, parts, [net("CLK", "U1.D13", "J1.1"), net("X", "U1.D2", "DISP.1"), net("Y", "J1.2", "DISP.2")]
    )
    assert pins(path) == {"D2": "DISP"}


def test_points_to_measure_at_are_no_parts_and_a_pad_to_touch_is_one(tmp_path: Path) -> None:
    kinds = {"TP1": "TP_SP", "TP2": "TEST-POINT-3", "UP": "CAP-PAD-15MM", "BTN1": "22-27-2021"}
    libraries = [device("ARDUINO_UNO", UNO)] + [
        device(kind, [("1", "pas")] if kind[0] != "2" else TWO, "Connector" * (kind[0] == "2")) for kind in kinds.values()
    ]
    parts = [part("U1", "ARDUINO_UNO")] + [part(name, kind) for name, kind in kinds.items()]
    path = schematic(tmp_path, libraries, parts, [net(f"N${n}", f"U1.D{n}", f"{name}.1") for n, name in enumerate(kinds, 2)])
    assert pins(path) == {"D4": "UP", "D5": "BTN1"}
    assert {c.title: c.role for c in read_circuit(path)[0].components}["UP"] is hw.Role.Input


def test_a_board_with_the_names_of_its_chip_has_its_pins_by_their_ports_and_headers_called_so_lead_them_out(
    tmp_path: Path,
) -> None:
    """`(AD0)PA0` is an address line of the chip, and D22 of the board, not A0."""
    mega: Pins = [(f"(AD{n})PA{n}", "io") for n in range(8)] + [(f"PF{n}(ADC{n})", "io") for n in range(8)]
    libraries = [device("MEGAARDUINO_1", mega), device("PINHD-1X4", HEADER), device("LED", TWO, "LED")]
    parts = [part("U1", "MEGAARDUINO_1"), part("PF", "PINHD-1X4"), part("LED1", "LED"), part("LED2", "LED")]
    nets = [net(f"N${n}", f"U1.PF{n}(ADC{n})", f"PF.{n}") for n in range(1, 5)]
    path = schematic(tmp_path, libraries, parts, [*nets, net("A", "U1.(AD0)PA0", "LED1.1"), net("B", "U1.PF0(ADC0)", "LED2.1")])
    assert read_circuit(path)[0].components[0].boardName == "mega"
    assert pins(path) == {"A0": "LED2", "D22": "LED1"}


@pytest.mark.parametrize("symbol", ["ATMEGA32U4TQFP", "ATMEGA32U4-AU"])
def test_a_bare_chip_with_usb_is_the_leonardo_and_lines_of_the_programmer_are_no_ports(symbol: str, tmp_path: Path) -> None:
    """`(PD0/MISO)PB3` is PB3: the zero of the programmer's PDO is none of a port."""
    chip: Pins = [(f"(ADC{n})PF{n}", "io") for n in (0, 1, 4, 5, 6, 7)] + [
        ("(SCL/INT0)PD0", "io"),
        ("(PD0/MISO/PCINT3)PB3", "io"),
    ]
    chip += [(f"X{n}", "pas") for n in range(30)]
    libraries = [device(symbol, chip), device("1X4--3.5MM", HEADER, "3.5mm terminal block"), device("LED", TWO, "LED")]
    parts = [part("U1", symbol), part("JP5", "1X4--3.5MM"), part("LED1", "LED"), part("LED2", "LED")]
    nets = [
        net("A", "U1.(ADC7)PF7", "JP5.1"),
        net("B", "U1.(SCL/INT0)PD0", "LED1.1"),
        net("C", "U1.(PD0/MISO/PCINT3)PB3", "LED2.1"),
    ]
    path = schematic(tmp_path, libraries, parts, nets)
    assert read_circuit(path)[0].components[0].boardName == "leonardo"
    assert pins(path) == {"A0": "JP5", "D3": "LED1", "D14": "LED2"}


def test_a_role_from_the_user_makes_a_header_a_part(tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", UNO), device("PINHD-1X4", HEADER)]
    nets = [net(f"D{n}", f"U1.D{n}", f"JP1.{n - 1}") for n in range(2, 6)]
    path = schematic(tmp_path, libraries, [part("U1", "ARDUINO_UNO"), part("JP1", "PINHD-1X4")], nets)
    assert read_circuit(path)[0].components[1].role is hw.Role.Passive
    assert read_circuit(path, roles={"JP1": "Input"})[0].components[1].role is hw.Role.Input


def test_inputs_of_the_converter_are_called_ain_unless_the_symbol_has_a0(tmp_path: Path) -> None:
    old = [(f"PWM/{n}", "io") for n in range(2, 8)] + [("AIN0", "io"), ("AIN4/SDA", "io"), ("MISO/12", "io")]
    parts = [part("U1", "UNO"), part("J1", "PINHD-1X4")]
    nets = [net("N$1", "U1.AIN0", "J1.1"), net("N$2", "U1.AIN4/SDA", "J1.2"), net("N$3", "U1.MISO/12", "J1.3")]
    assert pins(schematic(tmp_path, [device("UNO", old), device("PINHD-1X4", HEADER)], parts, nets)) == {
        "A0": "J1", "A4": "J1", "D12": "J1",
    }  # fmt: skip
    both = [*UNO, ("AIN0", "io")]
    path = schematic(
        tmp_path, [device("UNO", both), device("PINHD-1X4", HEADER)], parts,
        [net("N$1", "U1.AIN0", "J1.1"), net("N$2", "U1.A0", "J1.2")],
    )  # fmt: skip
    assert [(m["pin"], [c["name"] for c in m["connectors"]]) for m in hardware(path).result["mappings"]] == [("A0", ["2"])]


@pytest.mark.parametrize(
    ("symbol", "board"),
    [("NANO_FOOTPRINT", "nano"), ("ARD-NANO", "nano"), ("UNO", "uno"), ("ARDUINO_NANO_EVERY", ""), ("NANO_33_IOT", ""),
     ("ARDUINO_NANO_ESP32", ""), ("ARDUINO_UNO_R4_WIFI", ""), ("A000066", "uno"), ("A000005", "nano"), ("A000062", "")],
)  # fmt: skip
def test_boards_are_known_by_their_names_and_those_of_other_microcontrollers_are_not(
    symbol: str, board: str, tmp_path: Path
) -> None:
    path = schematic(tmp_path, [device(symbol, UNO), device("LED", TWO)], [part("J1", symbol), part("LED1", "LED")], [])
    assert read_circuit(path)[0].components[0].boardName == board


@pytest.mark.parametrize(("name", "reached"), [("VIN", False), ("+5V", False), ("G", True), ("SENSE", True)])
def test_a_net_that_is_called_like_a_supply_is_a_rail(name: str, reached: bool, tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", UNO), device("R", TWO, "Resistor"), device("LED", TWO, "LED")]
    parts = [part("U1", "ARDUINO_UNO"), part("R1", "R"), part("LED1", "LED")]
    path = schematic(tmp_path, libraries, parts, [net("A", "U1.D2", "R1.1"), net(name, "R1.2", "LED1.1")])
    assert pins(path) == ({"D2": "LED1"} if reached else {})


def test_a_divider_measures_the_supply_of_a_driver_and_not_the_driver(tmp_path: Path) -> None:
    libraries = [
        device("ARDUINO_UNO", UNO), device("R", TWO, "Resistor"), device("LED", [("+", "pas"), ("-", "pas")], "LED"),
        device("L293D", [("1A", "in"), ("VCC2", "pwr")]),
    ]  # fmt: skip
    parts = [part("U1", "ARDUINO_UNO"), part("R1", "R"), part("IC1", "L293D"), part("R2", "R"), part("LED1", "LED")]
    nets = [net("A", "U1.A0", "R1.1"), net("B", "R1.2", "IC1.VCC2"), net("C", "U1.D5", "IC1.1A")]
    nets += [net("D", "U1.D2", "R2.1"), net("E", "R2.2", "LED1.+")]
    assert pins(schematic(tmp_path, libraries, parts, nets)) == {"D2": "LED1", "D5": "IC1"}


def test_a_resistor_whose_symbol_is_named_after_a_board_is_no_board(tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", UNO), device("ESP32_WROVER_R", TWO, "RESISTOR"), device("LED", TWO, "LED")]
    parts = [part("U1", "ARDUINO_UNO"), part("R1", "ESP32_WROVER_R"), part("LED1", "LED")]
    path = schematic(tmp_path, libraries, parts, [net("A", "U1.D9", "R1.1"), net("B", "R1.2", "LED1.1")])
    assert pins(path) == {"D9": "LED1"}


def test_solder_jumpers_are_not_crossed(tmp_path: Path) -> None:
    parts = [part("U1", "ARDUINO_UNO"), part("SJ1", "SJ"), part("LED1", "LED")]
    libraries = [device("ARDUINO_UNO", UNO), device("SJ", TWO, "Solder jumper"), device("LED", TWO, "LED")]
    path = schematic(tmp_path, libraries, parts, [net("A", "U1.D2", "SJ1.1"), net("B", "SJ1.2", "LED1.1")])
    assert "LED1" not in pins(path).values()
    assert ["'SJ1' counts as open" in message for message in said(read_circuit(path)[1], "RS217")] == [True]


def test_grounds_of_a_board_are_one_and_other_pins_with_counters_are_not(tmp_path: Path) -> None:
    parts = [part("U1", "ARDUINO_UNO"), part("IC1", "AD623")]
    chip = [("RG@1", "io"), ("RG@2", "io"), ("GND", "pwr")]
    path = schematic(tmp_path, [device("ARDUINO_UNO", UNO), device("AD623", chip)], parts,
        [net("N$1", "IC1.RG@1", "U1.D2"), net("N$2", "IC1.RG@2", "U1.D3"), net("GND", "U1.GND@2", "IC1.GND")])  # fmt: skip
    circuit, _ = read_circuit(path)
    ground = next(n for n in circuit.nets if any(c.connectorId == "GND" for c in n.connectors))
    assert {c.connectorId for c in ground.connectors} == {"GND", "GND@1", "GND@2"}
    assert len(circuit.nets) == 3


def test_nets_go_through_the_ports_of_modules(tmp_path: Path) -> None:
    inner = (
        '<modules><module name="LAMP"><ports><port name="IN"/></ports><parts>' + part("LED1", "LED") + "</parts>"
        f"<sheets><sheet><nets>{net('IN', 'LED1.1')}</nets></sheet></sheets></module></modules>"
    )
    instances = '<moduleinsts><moduleinst name="M1" module="LAMP"/><moduleinst name="M2" module="LAMP"/></moduleinsts>'
    port = '<net name="{0}"><segment><pinref part="U1" gate="A" pin="{0}"/><portref moduleinst="{1}" port="IN"/></segment></net>'
    libraries = [device("ARDUINO_UNO", UNO), device("LED", TWO, "LED")]
    nets = [port.format("D2", "M1"), port.format("D3", "M2")]
    path = schematic(tmp_path, libraries, [part("U1", "ARDUINO_UNO")], nets, inner, instances)
    assert pins(path) == {"D2": "M1:LED1", "D3": "M2:LED1"}


def test_supplies_of_gates_that_are_not_drawn_are_on_the_net_of_their_name(tmp_path: Path) -> None:
    library = device("SERVO", [("VCC", "pwr"), ("GND", "pwr")], gates=2).replace(
        'gate name="B"', 'gate name="B" addlevel="request"'
    )
    placed = '<instances><instance part="M1" gate="A"/></instances>'
    parts = [part("U1", "ARDUINO_UNO"), part("M1", "SERVO")]
    path = schematic(tmp_path, [device("ARDUINO_UNO", UNO), library], parts, [net("GND", "U1.GND@1", "M1.GND")], "", placed)
    circuit, _ = read_circuit(path)
    ground = next(n for n in circuit.nets if any(c.connectorId == "GND@1" for c in n.connectors))
    assert {"A.GND", "B.GND"} <= {c.connectorId for c in ground.connectors}


def test_supply_pins_without_a_wire_are_on_the_net_of_their_name_or_supply_symbol(
    tmp_path: Path,
) -> None:
    """As in boards of EAGLE: `GND@2` beside a wired `GND@1`, `VSS` where a symbol VSS is on the net GND; a wired pin stays."""
    chip = device("CHIP", [("GND@1", "pwr"), ("GND@2", "pwr"), ("VSS", "pwr"), ("VDD", "pwr"), ("SDA", "io")])
    libraries = [device("ARDUINO_UNO", UNO), chip, device("VSS", [("VSS", "sup")]), device("GND", [("GND", "sup")])]
    parts = [part("U1", "ARDUINO_UNO"), part("IC1", "CHIP"), part("SUPPLY1", "VSS"), part("SUPPLY2", "GND")]
    nets = [net("GND", "U1.GND@1", "IC1.GND@1", "SUPPLY1.VSS", "SUPPLY2.GND"), net("N$1", "U1.D2", "IC1.VDD")]
    placed = "".join(f'<instance part="{name}" gate="A"/>' for name in ("U1", "IC1", "SUPPLY1", "SUPPLY2"))
    path = schematic(tmp_path, libraries, parts, nets, "", f"<instances>{placed}</instances>")
    circuit, _ = read_circuit(path)
    joined = [{f"{c.component.title}.{c.connectorId}" for c in n.connectors if c.component is not None} for n in circuit.nets]
    assert {"U1.GND@1", "U1.GND@2", "IC1.GND@1", "IC1.GND@2", "IC1.VSS", "SUPPLY1.VSS", "SUPPLY2.GND"} in joined
    assert {"U1.D2", "IC1.VDD"} in joined
    assert not any("IC1.SDA" in net and len(net) > 1 for net in joined)


def test_pins_and_parts_that_are_not_there_and_doubled_names_are_left_out_and_said(tmp_path: Path) -> None:
    parts = [part("U1", "ARDUINO_UNO"), part("LED1", "LED"), part("LED1", "LED"), part("X1", "GONE")]
    nets = [net("A", "U1.D2", "LED1.1"), net("B", "U1.D99", "X1.1"), net("C", "U1.D4", "LED7.1"), net("D", "U1.D5", "X1.2")]
    path = schematic(tmp_path, [device("ARDUINO_UNO", UNO), device("LED", TWO, "LED")], parts, nets)
    circuit, findings = read_circuit(path)
    assert pins(path) == {"D5": "X1"}
    assert {f.rule for f in findings} >= {"RS206", "RS207", "RS208", "RS214"}
    assert len({c.elementId for c in circuit.components}) == 4


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ('<?xml version="1.0"?><!DOCTYPE eagle [<!ENTITY a SYSTEM "file:///etc/passwd">]><eagle>&a;</eagle>', "DOCTYPE"),
        ('<!DOCTYPE eagle SYSTEM "eagle.dtd"><eagle><drawing><board/></drawing></eagle>', "a board of EAGLE"),
        ("<eagle><drawing/></eagle>", "without a schematic"),
        ("Some schematic 1.0\nof another tool", "not a schematic of a supported tool"),
        ("<schematic/>", "its root is <schematic>"),
        ("<eagle>" + "<a>" * 5000, "not well-formed"),
    ],
)  # fmt: skip
def test_what_is_no_schematic_is_refused(text: str, cause: str, tmp_path: Path) -> None:
    path = tmp_path / "a.sch"
    path.write_text(text)
    with pytest.raises(SourceError, match=cause) as refused:
        read_circuit(path)
    assert refused.value.fix
    assert "passwd" not in str(refused.value)


@pytest.mark.parametrize("head", [b"\x10\x80", b"\x10\x00\x01\x02"])
def test_a_binary_file_of_an_older_eagle_is_recognised_and_refused(head: bytes, tmp_path: Path) -> None:
    path = tmp_path / "old.sch"
    path.write_bytes(head + bytes(100))
    assert recognises(path.read_bytes())
    with pytest.raises(SourceError, match="EAGLE 5 and before"):
        read_circuit(path)


def test_a_module_that_has_itself_in_it_is_refused(tmp_path: Path) -> None:
    inst = '<moduleinsts><moduleinst name="M1" module="M"/></moduleinsts>'
    inner = f'<modules><module name="M"><parts/><sheets><sheet>{inst}</sheet></sheets></module></modules>'
    with pytest.raises(SourceError, match="contains itself"):
        read_circuit(schematic(tmp_path, [], [], [], inner, inst))


@pytest.mark.parametrize(
    ("inner", "times", "deep", "cause"),
    [("", 10, 16, "more than 1,000 module instances"), (net("n", "R1.1") * 3_000, 500, 1, "more than 500,000 elements")],
)
def test_module_instances_that_grow_beyond_measure_are_refused(
    inner: str, times: int, deep: int, cause: str, tmp_path: Path
) -> None:
    def instances(level: int) -> str:
        listed = "".join(f'<moduleinst name="I{n}" module="M{level}"/>' for n in range(times))
        return f"<moduleinsts>{listed if level < deep else ''}</moduleinsts>"

    made = (
        f'<module name="M{level}"><sheets><sheet>{instances(level + 1)}<nets>{inner}</nets></sheet></sheets></module>'
        for level in range(deep)
    )
    path = schematic(tmp_path, [], [], [], f"<modules>{''.join(made)}</modules>", instances(0))
    with pytest.raises(SourceError, match=cause) as refused:
        read_circuit(path)
    assert refused.value.location is not None
    assert refused.value.location.line


def test_five_hundred_parts_are_read_at_once_and_a_hundred_thousand_are_refused(tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", UNO), device("R", TWO, "RESISTOR"), device("LED", TWO, "LED")]
    parts = [
        part("U1", "ARDUINO_UNO"),
        *(part(f"R{n}", "R", "220") for n in range(250)),
        *(part(f"D{n}", "LED") for n in range(250)),
    ]
    nets = [net(f"N${n}", f"R{n}.2", f"D{n}.1") for n in range(250)]
    path = schematic(tmp_path, libraries, parts, nets)
    read_circuit(path)
    took = []
    for _ in range(3):
        started = time.process_time()
        read_circuit(path)
        took.append(time.process_time() - started)
    assert min(took) <= 0.5
    many = schematic(tmp_path, libraries, [part(f"R{n}", "R") for n in range(100_000)], [])
    with pytest.raises(SourceError, match=f"more than {MOST_PARTS:,} parts"):
        read_circuit(many)


def test_a_display_with_pins_called_like_those_of_a_board_is_none(tmp_path: Path) -> None:
    """What the library is called does not count, nor a name without the pins of a board."""
    display: Pins = [(f"D{n}", "io") for n in range(8)]
    libraries = [device("ARDUINO_UNO", UNO), device("LCD20X4", display), device("ARDUINO_UNO_LOGO", TWO)]
    libraries[1] = libraries[1].replace("lib-lcd20x4", "arduino_shield")
    parts = [
        part("U1", "ARDUINO_UNO"),
        part("DIS1", "LCD20X4").replace("lib-lcd20x4", "arduino_shield"),
        part("X1", "ARDUINO_UNO_LOGO"),
    ]
    path = schematic(tmp_path, libraries, parts, [net("A", "U1.D2", "DIS1.D4")])
    assert {c.title for c in read_circuit(path)[0].components if c.role is hw.Role.Board and c.boardName} == {"U1"}
    assert pins(path) == {"D2": "DIS1"}


def test_the_port_of_a_crystal_is_none_that_the_board_lacks(tmp_path: Path) -> None:
    """A library may call it by its port alone; without the crystal it is a pin like others, which the board has not."""
    parts = [part("IC1", "ATMEGA328P"), part("Q1", "CRYSTAL", "16MHz"), part("LED1", "LED")]
    libraries = [device("ATMEGA328P", CHIP), device("CRYSTAL", TWO), device("LED", TWO)]
    nets = [net("X", "IC1.(PCINT6)PB6", "Q1.1"), net("Y", "IC1.(PCINT7)PB7", "LED1.1")]
    path = schematic(tmp_path, libraries, parts, nets)
    assert ["(PCINT7)PB7" in text and "PB6" not in text for text in said(read_circuit(path)[1], "RS216")] == [True]


def test_what_a_chip_lacks_is_said_once(tmp_path: Path) -> None:
    path = schematic(tmp_path, [device("ATMEGA328P", [*CHIP, ("ADC6", "io")]), device("R", TWO)],
        [part("IC1", "ATMEGA328P"), part("R1", "R")], [net("SENSE", "IC1.ADC6", "R1.1")])  # fmt: skip
    rules = [finding.rule for finding in read_circuit(path)[1]]
    assert (rules.count("RS216"), rules.count("RS257")) == (1, 0)


def test_what_a_drawn_board_lacks_has_advice_that_helps(tmp_path: Path) -> None:
    libraries = [device("ARDUINO_UNO", [*UNO, ("A6", "io")]), device("LED", TWO)]
    path = schematic(tmp_path, libraries, [part("U1", "ARDUINO_UNO"), part("LED1", "LED")], [net("L", "U1.A6", "LED1.1")])
    found = [finding for finding in read_circuit(path)[1] if finding.rule == "RS257"]
    assert ["drawn_as" not in str(finding.fix) for finding in found] == [True]


def test_gates_of_a_part_without_its_library_are_told_apart(tmp_path: Path) -> None:
    nets = [
        f'<net name="{name}"><segment><pinref part="U1" gate="A" pin="{pin}"/><pinref part="X1" gate="{gate}" pin="1"/>'
        "</segment></net>"
        for name, pin, gate in (("L", "D2", "-1"), ("R", "D3", "-2"))
    ]
    path = schematic(tmp_path, [device("ARDUINO_UNO", UNO)], [part("U1", "ARDUINO_UNO"), part("X1", "MPT2")], nets)
    circuit, findings = read_circuit(path)
    assert {c.connectorId for c in circuit.components[1].connectors} == {"-1.1", "-2.1"}
    assert pins(path) == {"D2": "X1", "D3": "X1"}
    assert said(findings, "RS208") == []


def _with_gates(folder: Path, library: bool) -> Path:
    """Gates and pins with dots in their names: `A.B` has `OUT`, `B` has `A.B.OUT`, and both have others of the same names."""
    gates = {"A": ["B.OUT", "X"], "A.B": ["OUT", "X"], "B": ["OUT", "A.B.OUT"]}
    symbols = "".join(
        f'<symbol name="{gate}">' + "".join(f'<pin name="{pin}" direction="io"/>' for pin in own) + "</symbol>"
        for gate, own in gates.items()
    )
    listed = "".join(f'<gate name="{gate}" symbol="{gate}"/>' for gate in gates)
    amp = (
        f'<library name="lib-amp"><symbols>{symbols}</symbols><devicesets><deviceset name="AMP"><gates>{listed}</gates>'
        '<devices><device name=""/></devices></deviceset></devicesets></library>'
    )
    nets = [
        f'<net name="N{number}"><segment><pinref part="U1" gate="A" pin="D{number}"/>'
        f'<pinref part="IC1" gate="{gate}" pin="{pin}"/></segment></net>'
        for number, (gate, pin) in enumerate(((gate, pin) for gate, own in gates.items() for pin in own), 2)
    ]
    libraries = [device("ARDUINO_UNO", UNO), *([amp] if library else [])]
    return schematic(folder, libraries, [part("U1", "ARDUINO_UNO"), part("IC1", "AMP")], nets)


@pytest.mark.parametrize("library", [True, False])
def test_pins_are_told_apart_by_gate_and_name_whatever_the_names_have_in_them(tmp_path: Path, library: bool) -> None:
    path = _with_gates(tmp_path, library)
    circuit, findings = read_circuit(path)
    assert said(findings, "RS208") == []
    assert pins(path) == {f"D{number}": "IC1" for number in range(2, 8)}
    on = {
        next(other.pin for other in c.net.connectors if other.pin): displayed_name(c)
        for c in circuit.components[1].connectors if c.net is not None
    }  # fmt: skip
    assert on == {"D2": "B.OUT", "D3": "A.X", "D4": "OUT of A.B", "D5": "A.B.X", "D6": "OUT of B", "D7": "A.B.OUT"}


def test_no_two_pins_have_one_connector() -> None:
    names = ["", "A", "A.B", "B", "OUT", "OUT of A", "A.OUT", "A.OUT.2", "of", "."]
    listed = [(gate, pin) for gate in names for pin in names]
    found = connectors_of(listed)
    assert list(found) == listed
    assert len(set(found.values())) == len(listed)


def test_headers_whose_nets_are_called_like_pins_of_a_board_are_one_that_is_not_drawn(tmp_path: Path) -> None:
    parts = [part("JP1", "PINHD-1X4"), part("JP2", "PINHD-1X4"), part("R1", "R")]
    nets = [net(f"IO{n}", f"JP1.{n}") for n in range(1, 5)] + [net(f"A{n}", f"JP2.{n}") for n in range(1, 5)]
    libraries = [device("PINHD-1X4", HEADER), device("R", TWO)]
    findings = read_circuit(schematic(tmp_path, libraries, parts, nets))[1]
    assert ["JP1, JP2 seem to be its headers" in text for text in said(findings, "RS219")] == [True]
    chip = [part("IC1", "EXPANDER"), *parts]
    ports = device("EXPANDER", [(f"PA{n}", "io") for n in range(8)])
    findings = read_circuit(schematic(tmp_path, [*libraries, ports], chip, nets))[1]
    assert said(findings, "RS219") == []


@pytest.mark.parametrize("kind", ["ARDUINOR3-NOIOREF-NOTEXT", "ARDUINOSHIELD"])
def test_symbols_of_shields_are_the_uno(kind: str, tmp_path: Path) -> None:
    path = schematic(tmp_path, [device(kind, UNO), device("LED", TWO)], [part("Q1", kind), part("D1", "LED")],
        [net("L", "Q1.D3", "D1.1")])  # fmt: skip
    assert read_circuit(path)[0].components[0].boardName == "uno"
    assert pins(path) == {"D3": "D1"}
