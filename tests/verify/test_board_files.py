"""The files of boards and microcontrollers against the core's own files, and against each other."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import PlatformDataError, UsageError
from robosmi.metamodels import platform
from robosmi.transformations.knowledge.board_models import board_file, board_names, load_board, load_mapping, table_of
from robosmi.transformations.knowledge.drawn_boards import drawn_board
from robosmi.verify.toolchains.boards import find_board, load_boards
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import KNOWN_PLACES, require_tools

ARDUINO = "arduino"
BOARDS = {name: load_board(name) for name in board_names()}
MAPPINGS = {name: load_mapping(ARDUINO, board) for name, board in BOARDS.items()}
CHOSEN_WHEN_USED = {"esp32", "esp32c3", "nano33ble"}  # the core gives a pin an output when it is used
WITHOUT_LED = {""}
"""The LED of a Pico W hangs on its radio."""
OF_THE_CORE = [name for name, mapping in MAPPINGS.items() if mapping.boardId.startswith("arduino:avr:")]
MICROCONTROLLERS = {str(b.microcontroller.name): b.microcontroller for b in BOARDS.values() if b.microcontroller is not None}


def labels(board: platform.Board, ability: str) -> set[str]:
    """The pins of a board with an ability."""
    return {pin.label for pin in board.pins if ability in pin.abilities}


@pytest.mark.parametrize("name", BOARDS)
def test_a_board_holds_together(name: str) -> None:
    board, mapping = BOARDS[name], MAPPINGS[name]
    names = [name for pin in board.pins for name in (pin.label, *pin.aliases)]
    assert len(names) == len(set(names)) > 10
    ports = [pin.port for pin in board.pins]
    assert all(ports)
    assert len(ports) == len(set(ports))
    interrupts = {name.pin: name.interrupt for name in mapping.pinNames}
    for pin in board.pins:
        assert bool(pin.timer) == ("pwm" in pin.abilities)
        assert bool(pin.channel) == bool(pin.timer) or name in CHOSEN_WHEN_USED
        assert (interrupts[pin] >= 0) == ("interrupt" in pin.abilities)
    assert board.led in labels(board, "digital") | WITHOUT_LED


@pytest.mark.parametrize("name", BOARDS)
def test_the_timers_and_buses_of_a_board_are_its_microcontrollers(name: str) -> None:
    board = BOARDS[name]
    chip = board.microcontroller
    assert chip is not None
    assert {pin.timer for pin in board.pins if pin.timer} <= {timer.name for timer in chip.timers}
    for bus in chip.buses:
        on_bus = {pin.port: pin for pin in board.pins}
        for signal, port in zip(bus.signals, bus.ports, strict=True):
            if port in on_bus:
                assert bus.name in on_bus[port].abilities, f"{port} of {name}"
                known = (on_bus[port].label, *on_bus[port].aliases)
                assert bus.name == "uart" or signal in known, f"{signal} of {name}"


@pytest.mark.parametrize("name", MICROCONTROLLERS)
def test_what_is_taken_of_a_microcontroller_is_there(name: str) -> None:
    chip = MICROCONTROLLERS[name]
    assert {use.name for use in chip.uses} >= {"tone", "Servo"}
    for use in chip.uses:
        assert set(use.timers) <= {timer.name for timer in chip.timers}
        assert set(use.buses) <= {bus.name for bus in chip.buses}


@pytest.mark.parametrize("name", [name for name, chip in MICROCONTROLLERS.items() if chip.architecture == "avr"])
def test_tone_takes_the_timer_that_the_core_gives_it(name: str) -> None:
    """As Tone.cpp of the core chooses it by the compiler's macro for the microcontroller."""
    require_tools("arduino-core-avr")
    text = (KNOWN_PLACES["arduino-core-avr"].parent / "Tone.cpp").read_text()
    macros = {"atmega32u4": "__AVR_ATmega32U4__", "atmega2560": "__AVR_ATmega2560__"}
    block = text[text.index("#if defined(__AVR_ATmega1280__)") :]
    branches = re.split(r"^#(?:el)?(?:if|se)", block[: block.index("#endif")], flags=re.MULTILINE)[1:]
    chosen = next((b for b in branches if macros.get(name, "no macro of it") in b.partition("\n")[0]), branches[-1])
    found = re.search(r"^#define USE_TIMER(\d)", chosen, re.MULTILINE)
    assert found is not None
    taken = next(use for use in MICROCONTROLLERS[name].uses if use.name == "tone")
    assert list(taken.timers) == [f"Timer{found[1]}"]


def test_most_boards_are_the_cores() -> None:
    assert len(OF_THE_CORE) >= 16


@pytest.mark.parametrize("name", OF_THE_CORE)  # a board of another core has no entry in this one's files
def test_a_board_is_what_the_core_says(name: str) -> None:
    """PWM, ports, interrupts and memory as in the core's variants/*/pins_arduino.h and boards.txt."""
    require_tools("arduino-core-avr")
    board, mapping, chip = BOARDS[name], MAPPINGS[name], BOARDS[name].microcontroller
    assert chip is not None
    root = KNOWN_PLACES["arduino-core-avr"].parents[2]
    listed = (root / "boards.txt").read_text()
    for key, value in (("upload.maximum_size", mapping.flashBytes), ("upload.maximum_data_size", mapping.ramBytes)):
        _, _, short, *options = mapping.boardId.split(":")
        plain = chip.name.removesuffix("p")
        option = options[0].removeprefix("cpu=") if options else rf"(?:16MHz)?{plain}"
        found = re.findall(rf"^{short}\.(?:menu\.cpu\.{option}\.)?{re.escape(key)}=(\d+)", listed, re.MULTILINE)
        assert str(value) in found
    assert f"build.board={mapping.define}\n" in listed
    header = (root / "variants" / mapping.variant / "pins_arduino.h").read_text()
    while other := re.search(r'#include "\.\./(\w+)/pins_arduino\.h"', header):  # a variant that only adds to another
        header = (root / "variants" / other[1] / "pins_arduino.h").read_text()
    by_number = {_number(pin, board): pin for pin in board.pins}
    for number, (timer, channel) in enumerate(re.findall(r"NOT_ON_TIMER|TIMER(\d)([ABCD])", _array(header, "timer"))):
        if number in by_number:
            pin = by_number[number]
            assert (pin.timer.removeprefix("Timer"), pin.channel) == (timer, channel), pin.label
    ports = re.findall(r"\bP([A-L])\b", _array(header, "port"))
    bits = re.findall(r"_BV\(\s*(?:P[A-L])?(\d)\s*\)", _array(header, "bit_mask"))
    assert len(ports) == len(bits) > 10
    for number, (port, bit) in enumerate(zip(ports, bits, strict=True)):
        if number in by_number:
            assert by_number[number].port == f"P{port}{bit}", by_number[number].label


def _number(pin: platform.Pin, board: platform.Board) -> int:
    """The number that the core gives a pin: a digital label's own, an analogue one's behind the last digital pin."""
    digital = next((name for name in (pin.label, *pin.aliases) if re.fullmatch(r"D\d+", name)), "")
    if digital:
        return int(digital[1:])
    first = board.pins[[p.label for p in board.pins].index("A0")]
    return _number(first, board) + int(pin.label[1:])


def _array(header: str, of: str) -> str:
    table = header[header.index(f"digital_pin_to_{of}_PGM[]") :]
    table = re.sub(r"//[^\n]*", "", table[: table.index("};")])
    return re.sub(r"#if defined\(__AVR_ATmega8__\).*?#else(.*?)#endif", r"\1", table, flags=re.DOTALL)


def test_the_uno_as_everybody_knows_it() -> None:
    uno = BOARDS["uno"]
    assert labels(uno, "pwm") == {"D3", "D5", "D6", "D9", "D10", "D11"}
    assert labels(uno, "analog_in") == {f"A{n}" for n in range(6)}
    assert labels(uno, "interrupt") == {"D2", "D3"}
    assert {pin.label for pin in uno.pins if pin.reserved} == {"D0", "D1"}


def test_a_board_has_its_pins_in_order_and_its_platform_its_names() -> None:
    uno, mapping = BOARDS["uno"], MAPPINGS["uno"]
    assert [pin.label for pin in uno.pins] == [f"D{i}" for i in range(14)] + [f"A{i}" for i in range(6)]
    assert [name.literal for name in mapping.pinNames][-7:] == ["13", "A0", "A1", "A2", "A3", "A4", "A5"]
    assert (mapping.boardId, mapping.flashBytes, uno.volts) == ("arduino:avr:uno", 32256, 5.0)


def test_an_unknown_board() -> None:
    with pytest.raises(UsageError, match=r"unknown board 'unno'"):
        load_board("unno")


def test_a_leonardo_has_no_timer_2_and_tone_takes_timer_3() -> None:
    chip = BOARDS["leonardo"].microcontroller
    assert chip is not None
    assert "Timer2" not in {timer.name for timer in chip.timers}
    assert [timer for use in chip.uses if use.name == "tone" for timer in use.timers] == ["Timer3"]


@pytest.mark.parametrize("name", BOARDS)
def test_what_a_tool_draws_of_a_board_are_all_its_pins(name: str) -> None:
    """A board need not be drawn by any tool; where one draws it, its first part has all pins that are brought out."""
    board = BOARDS[name]
    path = board_file(name)
    assert path is not None
    drawn = table_of(path).tables("drawn_as", needed=False)
    ids = [(entry.text("tool"), module) for entry in drawn for module in entry.texts("modules")]
    assert len(ids) == len(set(ids))
    wanted = {pin.label for pin in board.pins if pin.reserved not in ("on the ICSP header only", "not brought out")}
    for tool, module in ids[:1]:
        found = drawn_board(module, tool)
        assert found is not None
        assert wanted <= set(found.pins.values())


@pytest.mark.parametrize("name", ["nano", "arduino:avr:nano", "arduino:avr:nano:cpu=atmega328old"])
def test_a_board_is_found_by_each_of_its_names(name: str) -> None:
    assert find_board(name, load_boards(ARDUINO)).name == "nano"


def test_a_board_with_another_chip_is_not_taken_for_it() -> None:
    with pytest.raises(UsageError, match="unknown board"):
        find_board("arduino:avr:nano:cpu=atmega168", load_boards(ARDUINO))


@pytest.mark.parametrize(
    ("part", "old", "new", "message"),
    [
        (
            "arduino/boards",
            "ram_bytes = 2048",
            "ram_byte = 2048",
            r"'ram_byte' is not a key of it \(did you mean 'ram_bytes'\?\)",
        ),
        ("arduino/boards", "ram_bytes = 2048", 'ram_bytes = "2 K"', "'ram_bytes' must be a whole number"),
        ("arduino/boards", "interrupts = { D2", "interrupts = { D99", "'interrupts.D99' is not a pin of this board"),
        ("arduino/boards", 'define = "AVR_UNO"', "", "'define' is missing"),
        ("arduino/boards", "fqbn =", "fbqn =", r"'fbqn' is not a key of it \(did you mean 'fqbn'\?\)"),
        (
            "arduino/boards",
            "arduino:avr:uno",
            "arduino:avr:mini",
            "'fqbn' is 'arduino:avr:mini', .* the board 'mini'",
        ),
        ("boards", 'label = "D4"', 'label = "D5"', "'pins' has D5 twice"),
        ("boards", 'port = "PD4"', 'port = "PD5"', "'pins' has PD5 twice"),
        (
            "boards",
            'abilities = ["digital", "pwm"]',
            'abilities = ["digtal"]',
            r"'pins\[5\].abilities' has 'digtal', which is none of",
        ),
        (
            "boards",
            'timer = "Timer2"',
            'timer = "Timer7"',
            r"'pins\[3\].timer' is 'Timer7', which is not a timer of the microcontroller",
        ),
        (
            "boards",
            'port = "PD4"',
            'port = "PZ9"',
            "the port of 'D4' is 'PZ9', which is not a pin of the microcontroller 'atmega328p'",
        ),
        ("boards", 'port = "PD4"', 'port = "PE0"', "the port of 'D4' is 'PE0'"),
        ("boards", 'channel = "B"', 'channel = "Z"', r"'pins\[3\].channel' is 'Z', which is none of: A, B, C, D"),
        ("boards", 'timer = "Timer2", channel = "B"', 'channel = "B"', "is 'B', but the pin has no timer"),
        ("boards", 'timer = "Timer2", channel = "B"', 'timer = "Timer2", channel = "A"', "'pins' has Timer2 channel A twice"),
        ("boards", 'aliases = ["RX"]', 'aliases = ["D9"]', "gives 'D0' the alias 'D9', which is a name of 'D9'"),
        ("boards", 'aliases = ["RX"]', 'aliases = ["TX"]', "gives 'D0' the alias 'TX', which is a name of 'D1'"),
        ("mcus", 'ports = "', 'ports = "(', "'ports' is not a regular expression"),
        ("boards", "aliases = []", "alias = []", r"'pins\[2\].alias' is not a key of it \(did you mean 'aliases'\?\)"),
        ("boards", "volts = 5.0", "volts = 5.0\nvolt = 5.0", "'volt' is not a key of it"),
        ("boards", 'led = "D13"', 'led = "D31"', "'led' is 'D31', which is not a pin of this board"),
        (
            "boards",
            'mcu = "atmega328p"',
            'mcu = "atmega328q"',
            "'mcu' is 'atmega328q', an unknown microcontroller",
        ),
        ("boards", "pins = [", "pins = [[", "cannot be read"),
        ("mcus", "pin_ma", "pin_mA", r"'pin_mA' is not a key of it \(did you mean 'pin_ma'\?\)"),
        ("mcus", 'functions = ["tone"]', 'function = ["tone"]', r"'takes\[0\].function' is not a key of it"),
        ("mcus", "ram_bytes = 2048", "ram = 2048", "'ram' is not a key of it"),
        ("mcus", "ram_bytes = 2048", "", "'ram_bytes' is missing"),
    ],
)
def test_a_damaged_file_names_file_and_key(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, part: str, old: str, new: str, message: str
) -> None:
    built_in = board_file("uno")
    assert built_in is not None
    name = "atmega328p.toml" if part == "mcus" else "uno.toml"
    text = (built_in.parents[1] / part / name).read_text()
    assert old in text
    path = tmp_path / "platform_repo" / part / name
    path.parent.mkdir(parents=True)
    path.write_text(text.replace(old, new, 1))
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    with pytest.raises(PlatformDataError, match=message) as caught:
        load_boards(ARDUINO)
    assert str(caught.value).startswith(str(path))


def test_a_drawn_connector_of_no_pin_is_an_error_of_the_boards_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    built_in = board_file("uno")
    assert built_in is not None
    path = tmp_path / "platform_repo" / "boards" / "uno.toml"
    path.parent.mkdir(parents=True)
    path.write_text(built_in.read_text().replace('D0 = ["connector61"]', 'D99 = ["connector61"]', 1))
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    with pytest.raises(PlatformDataError, match=r"'drawn_as\[0\].connectors.D99' is not a pin of this board"):
        drawn_board("arduino_Uno_Rev3(fix)", "fritzing")


def test_a_file_can_add_how_another_tool_draws_a_board(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "platform_repo" / "boards" / "uno.toml"
    path.parent.mkdir(parents=True)
    path.write_text('[[drawn_as]]\ntool = "gadget"\nmodules = ["Uno Rev3"]\n[drawn_as.connectors]\nD9 = ["9"]\n')
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    assert len(load_board("uno").pins) == 20
    found = drawn_board("Uno Rev3", "gadget")
    assert found is not None
    assert (found.name, found.title, dict(found.pins)) == ("uno", "Arduino Uno", {"9": "D9"})
    assert drawn_board("arduino_Uno_Rev3(fix)", "fritzing") is not None
    assert all(drawn_board(name, "gadget") == found for name in ("uno rev3", "UNO REV3", " UnoRev3 "))
    assert drawn_board("Uno Rev4", "gadget") is None
    assert drawn_board("uno", "pin table") is not None
    path.write_text(path.read_text().replace("D9 =", "D99 ="))
    with pytest.raises(PlatformDataError, match=r"'drawn_as\[0\].connectors.D99' is not a pin of this board"):
        drawn_board("Uno Rev3", "gadget")
    path.rename(path.with_name("nobodys.toml"))
    with pytest.raises(PlatformDataError, match="is of the board 'nobodys', but no other file has this board's pins"):
        drawn_board("Uno Rev3", "gadget")


def test_a_board_of_another_core_with_another_order_of_pins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its variant lies beside its file, its core's version is its own, and the program is compiled with both."""
    require_tools("arduino-core-avr", "avr-gcc")
    built_in = board_file("uno")
    assert built_in is not None
    place = tmp_path / "data" / "platform_repo" / "arduino"
    (place / "boards").mkdir(parents=True)
    shutil.copytree(KNOWN_PLACES["arduino-core-avr"].parents[2] / "variants" / "standard", place / "variants" / "crossed")
    header = place / "variants" / "crossed" / "pins_arduino.h"
    header.write_text(header.read_text().replace("#define LED_BUILTIN 13", "#define LED_BUILTIN 7"))
    mapping = (built_in.parents[1] / "arduino" / "boards" / "uno.toml").read_text() + built_in.read_text()
    for old, new in (("arduino:avr:uno", "acme:avr:crossed"), ('"standard"', '"crossed"'), ('name = "uno"', 'name = "crossed"')):
        mapping = mapping.replace(old, new)
    mapping = mapping[: mapping.index("# Connectors of the part in the drawing")]
    (place / "boards" / "crossed.toml").write_text(mapping)
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path / "data"))
    program = tmp_path / "robot.c"
    program.write_text("int main(void) { for (;;) { } }\n")
    robosmi.migrate([program], tmp_path / "out", target="crossed")
    listed = tmp_path / "out" / "robot" / "sketch.yaml"
    assert "      - platform: acme:avr\n" in listed.read_text()
    sketch = tmp_path / "out" / "robot" / "robot.ino"
    sketch.write_text(sketch.read_text() + 'static_assert(LED_BUILTIN == 7, "the variant is its own");\n')
    assert compile_sketch(tmp_path / "out").ok
    (place / "boards" / "crossed.toml").write_text('core = "2.0.1"\n' + mapping)
    robosmi.migrate([program], tmp_path / "again", target="crossed")
    assert "      - platform: acme:avr (2.0.1)\n" in (tmp_path / "again" / "robot" / "sketch.yaml").read_text()


def test_one_file_can_hold_a_board_and_how_a_platform_calls_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hardware, mapping = board_file("uno"), board_file("uno")
    assert hardware is not None
    assert mapping is not None
    text = (hardware.parents[1] / "arduino" / "boards" / "uno.toml").read_text() + hardware.read_text()
    path = tmp_path / "platform_repo" / "arduino" / "boards" / "mine.toml"
    path.parent.mkdir(parents=True)
    path.write_text(text.replace("arduino:avr:uno", "arduino:avr:mine").replace('name = "uno"', 'name = "mine"'))
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    assert find_board("arduino:avr:mine", load_boards(ARDUINO)).name == "mine"
    assert len(load_board("mine").pins) == 20
