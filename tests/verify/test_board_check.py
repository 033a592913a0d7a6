"""A board's file against the core that programs are compiled with: what contradicts is told with place and remedy (RS810)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robosmi.diagnostics import Finding, Severity
from robosmi.errors import PlatformDataError
from robosmi.resources import built_in
from robosmi.verify.toolchains.board_check import arrays, board_findings, constant_findings, size_findings, version_finding
from robosmi.verify.toolchains.boards import load_boards
from robosmi.verify.toolchains.toolchain import compile_sketch
from robosmi.verify.toolchains.toolchain_data import load_toolchains
from robosmi.verify.toolchains.tools import find_installed
from tests.running import run
from tests.tools import require_tools

PLACE = built_in("platform_repo")
HARDWARE, MAPPING = PLACE / "boards" / "uno.toml", PLACE / "arduino" / "boards" / "uno.toml"


def own_board(data: Path, old: str, new: str) -> Path:
    """A board like the Uno in one file of one's own, with a text changed; a channel has one pin."""
    text = MAPPING.read_text() + HARDWARE.read_text()
    text = text[: text.index("# Bare microcontrollers")]
    for was, becomes in (('name = "uno"', 'name = "mine"'), ("arduino:avr:uno", "mine:avr:mine"), (old, new)):
        assert was in text
        taken = re.search(r', "pwm"\], (timer = "Timer0", channel = "A")', text)
        if taken and taken[1] in becomes:
            text = text.replace(taken[0], "]", 1)
        text = text.replace(was, becomes, 1)
    path = data / "platform_repo" / "arduino" / "boards" / "mine.toml"
    path.parent.mkdir(parents=True)
    path.write_text(text)
    return path


def findings(board: str) -> list[Finding]:
    """What the core contradicts of a board."""
    require_tools("arduino-core-avr", "avr-gcc")
    toolchain = next(each for each in load_toolchains() if each.platform == "arduino")
    chosen = next(each for each in load_boards("arduino") if each.name == board)
    return board_findings(chosen, toolchain, find_installed(toolchain))


@pytest.mark.parametrize("name", sorted(board.name for board in load_boards("arduino") if board.architecture == "avr"))
def test_boards_of_the_repository_agree_with_the_core(name: str) -> None:
    assert findings(name) == []


@pytest.mark.parametrize(
    ("old", "new", "cause", "beside"),
    [
        ('port = "PB1"', 'port = "PC6"', "says that D9 is on port PC; in the core that programs are compiled with", 'D9"'),
        ('port = "PB1"', 'port = "PC6"', "(variant 'standard') it is PB", 'D9"'),
        ('port = "PB1"', 'port = "PB6"', "D9 is bit _BV(6) of its port", 'D9"'),
        ('timer = "Timer1", channel = "A"', 'timer = "Timer0", channel = "A"', "the PWM of D9 is TIMER0A", 'D9"'),
        ('["digital"] },', '["digital", "pwm"], timer = "Timer0", channel = "A" },', "it is NOT_ON_TIMER", 'D4"'),
        ("{ D2 = 0, D3 = 1 }", "{ D2 = 1, D3 = 0 }", "the external interrupt of D2 is 1", "interrupts ="),
        ("D9 = 9", "D9 = 29", "the number of D9 is 29", "numbers ="),
        ('led = "D13"', 'led = "D12"', "the lamp of the board is on D12", "led ="),
        (
            "pins = [",
            'literals.A6 = "A6"\npins = [{ label = "A6", port = "PB6", abilities = ["analog_in"] },',
            "A6 is an analogue input",
            'A6"',
        ),
        (
            "pins = [",
            'literals.D25 = "25"\npins = [{ label = "D25", port = "PB6", abilities = ["digital"] },',
            "it is no such pin",
            'D25"',
        ),
        ('variant = "standard"', 'variant = "mega"', "cannot be compiled", "variant ="),
        ('variant = "standard"', 'variant = "no-such"', "pins_arduino.h: No such file", "variant ="),
        ('variant = "standard"', 'variant = "eightanaloginputs"', "", ""),
    ],
)
def test_what_the_variant_contradicts_is_told(
    old: str, new: str, cause: str, beside: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    path = own_board(tmp_path, old, new)
    found = findings("mine")
    assert bool(found) == bool(cause)
    assert [finding.severity for finding in found] == [Severity.error] * len(found)
    told = [finding for finding in found if cause in finding.message]
    assert bool(told) == bool(cause)
    for finding in told:
        assert finding.fix
        assert finding.location is not None
        assert finding.location.path == str(path)
        assert beside in path.read_text().splitlines()[(finding.location.line or 0) - 1]


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [
        ('port = "PB1"', 'port = "PZ9"', "the port of 'D9' is 'PZ9'"),
        ('port = "PB1"', 'port = "xyz"', "the port of 'D9' is 'xyz'"),
        ("flash_bytes = 32256", "flash_bytes = -5", "must be above zero"),
        ('variant = "standard"', 'variant = "a\\u0000b"', "NUL"),
    ],
)
def test_what_cannot_be_is_refused(old: str, new: str, cause: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    path = own_board(tmp_path, old, new)
    with pytest.raises(PlatformDataError, match=cause) as raised:
        load_boards("arduino")
    assert raised.value.location is not None
    assert str(raised.value.location.path) == str(path)


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [
        ("mine:avr:mine", "arduino:avr:unno", "the core does not list that board"),
        ("mine:avr:mine", "arduino:avr:ethernet", "says define AVR_UNO; the core's list has AVR_ETHERNET for"),
        ("mine:avr:mine", "arduino:avr:nano:cpu=atmega168", "says flash_bytes 32256; the core's list has 14336 for"),
        ("flash_bytes = 32256", "flash_bytes = 32768", ""),
    ],
)
def test_what_the_list_of_boards_contradicts_is_told(
    old: str, new: str, cause: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A board with a full name of its own is listed nowhere, and may be otherwise."""
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    path = own_board(tmp_path, old, new)
    monkeypatch.setattr("robosmi.transformations.knowledge.board_models._check_mapping", lambda *_: None)  # the name is another's
    found = findings("mine")
    assert [f.severity for f in found] == [Severity.warning] * len(found)
    assert bool(found) == bool(cause)
    assert not cause or any(cause in f.message and f.location is not None and f.location.path == str(path) for f in found)


def test_compile_and_doctor_say_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_tools("arduino-core-avr", "avr-gcc")
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path / "data"))
    path = own_board(tmp_path / "data", 'port = "PB1"', 'port = "PB6"')
    sketch = tmp_path / "blink" / "blink.ino"
    sketch.parent.mkdir()
    sketch.write_text("void setup() { pinMode(9, OUTPUT); }\nvoid loop() {}\n")
    report = compile_sketch(sketch.parent, "mine")
    assert report.ok
    assert [finding.rule for finding in report.diagnostics] == ["RS810"]
    assert [finding.rule for finding in compile_sketch(sketch.parent, "uno").diagnostics] == []
    outcome = run("doctor", "--json")
    assert outcome.code == 1
    assert [(f["rule"], f["location"]["path"]) for f in outcome.document["findings"]] == [("RS810", str(path))]


def test_the_data_of_assembler_text() -> None:
    lines = ["\t.text", "ports:", "\t.byte\t4", "\t.zero\t2", "mask:", "\t.word\t258", "\t.word\tport+1", "\t.long\t-1"]
    assert arrays(lines) == {"ports": b"\x04\x00\x00", "mask": b"\x02\x01\x00\x00\xff\xff\xff\xff"}


def test_sizes_that_the_core_of_another_architecture_contradicts_are_named() -> None:
    pico = next(board for board in load_boards("arduino") if board.name == "pico")
    assert size_findings(pico, pico) == []
    assert size_findings(pico, pico._replace(flash_bytes=None, ram_bytes=None)) == []
    (found,) = size_findings(pico, pico._replace(name=pico.full_names[0], ram_bytes=520_000))
    assert (found.rule, found.severity) == ("RS810", Severity.warning)
    assert "says ram_bytes 262144; the core's list has 520000 for 'rp2040:rp2040:rpipico'" in found.message
    assert found.location is not None
    assert found.location.line is not None


def test_pins_that_the_headers_of_another_core_contradict_are_named() -> None:
    """D13, D2, A0 and A1 are the board's; D4, which is told in two ways, is not compared."""
    nano = next(board for board in load_boards("arduino") if board.name == "nano-rp2040")
    variant = Path(__file__).parent / "cases" / "pins_of_a_core" / "variant"
    toolchain = next(each for each in load_toolchains() if each.platform == "arduino")
    found = constant_findings(nano, toolchain, [variant.parent / "no core", variant])
    where = "in the core that programs are compiled with (variant 'variant') it is"
    assert [finding.message for finding in found] == [
        f"the file of the board 'nano-rp2040' says that the number of D3 is 15; {where} 16",
        f"the file of the board 'nano-rp2040' says that the number of A2 is 28; {where} 29",
    ]
    assert {(finding.rule, finding.severity) for finding in found} == {("RS810", Severity.error)}
    assert all(finding.location is not None and finding.location.line is not None for finding in found)
    unnamed = nano._replace(claims=lambda: tuple(claim._replace(ask="7") for claim in nano.claims() if claim.key == "numbers"))
    assert constant_findings(unnamed, toolchain, [variant.parent / "no core", variant]) == found  # written as numbers


def test_a_core_of_another_version_than_the_boards_file_is_named() -> None:
    pico = next(board for board in load_boards("arduino") if board.name == "pico")
    assert version_finding(pico, "6.0.0") == []
    assert version_finding(pico._replace(values={}), "5.1.0") == []
    (found,) = version_finding(pico, "5.1.0")
    assert (found.rule, found.severity) == ("RS810", Severity.info)
    assert "is of version 6.0.0 of its core; 5.1.0 builds the program" in found.message
