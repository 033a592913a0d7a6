"""`platformio.ini`: each board by its name there, and the libraries that the sketch uses."""

from __future__ import annotations

import configparser
from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels.platform import Microcontroller
from robosmi.transformations.chains.libraries import pin_library
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.m2m.choices.library_choice import LibraryModels
from robosmi.verify.toolchains.boards import load_boards
from tests.running import run
from tests.tiers import one_of_each

IDLE = Path(__file__).parent / "bench" / "idle.c"
NAMES = {
    "bt": "btatmega328", "diecimila": "diecimilaatmega328", "ethernet": "ethernet", "fio": "fio", "leonardo": "leonardo",
    "lilypad": "lilypadatmega328", "lilypadusb": "LilyPadUSB", "mega": "megaatmega2560", "megaadk": "megaADK", "micro": "micro",
    "mini": "miniatmega328", "nano": "nanoatmega328new", "pro8mhz": "pro8MHzatmega328", "promini": "pro16MHzatmega328",
    "uno": "uno", "yun": "yun", "pico": "pico", "picow": "rpipicow",
    "nano-rp2040": "arduino_nano_connect", "uno-r4-minima": "uno_r4_minima", "teensy40": "teensy40",
    "nucleo-f401re": "nucleo_f401re", "nano33ble": "nano33ble", "zero": "zero",
    "esp32": "esp32dev", "esp32c3": "esp32-c3-devkitm-1",
}  # fmt: skip
"""As PlatformIO's package `atmelavr` calls its definitions of boards (`boards/NAME.json`), each with the microcontroller, clock,
variant and protocol of ours; those of other processors as their platforms do."""
OTHER_PLATFORMS: dict[str, tuple[str, dict[str, str]]] = {
    "rp2040": ("https://github.com/maxgerhardt/platform-raspberrypi.git", {"board_build.core": "earlephilhower"}),
    "ra4m1": ("renesas-ra", {}), "imxrt1062": ("teensy", {}), "stm32f401re": ("ststm32", {}), "nrf52840": ("nordicnrf52", {}),
    "samd21g18a": ("atmelsam", {}), "esp32": ("espressif32", {}), "esp32c3": ("espressif32", {}),
}  # fmt: skip
"""Microcontroller -> the platform that has Arduino's core of our data, and what it has to be told."""


def settings(path: Path) -> configparser.ConfigParser:
    """The file as PlatformIO reads it: its reader is the one of Python's library, with these comments."""
    parser = configparser.ConfigParser(inline_comment_prefixes=("#", ";"), interpolation=None)
    assert parser.read(path) == [str(path)]
    return parser


def chip(board: str) -> Microcontroller:
    """The microcontroller of a board."""
    found = load_board(board).microcontroller
    assert found is not None
    return found


def test_each_board_has_its_name() -> None:
    assert {board.name for board in load_boards("arduino")} == set(NAMES)


@pytest.mark.parametrize("board", one_of_each(sorted(NAMES), lambda name: chip(name).name))
def test_the_file_of_a_board(board: str, tmp_path: Path) -> None:
    robosmi.migrate([IDLE], tmp_path / "out", target=board)
    found = settings(tmp_path / "out" / "idle" / "platformio.ini")
    assert dict(found["platformio"]) == {"src_dir": ".", "default_envs": board}
    name, more = OTHER_PLATFORMS.get(str(chip(board).name), ("atmelavr", {}))
    assert dict(found[f"env:{board}"]) == {"platform": name, "board": NAMES[board], "framework": "arduino", **more}
    fqbn = next(each.full_names[0] for each in load_boards("arduino") if each.name == board)
    text = (tmp_path / "out" / "idle" / "sketch.yaml").read_text()
    assert f"fqbn: {fqbn}\n" in text
    assert ("platform_index_url: https://" in text) == (not fqbn.startswith("arduino:"))


@pytest.mark.parametrize("example", ["line_follower", "environmental_monitoring"])
def test_its_libraries_are_those_of_the_sketch_project(example: str, examples: Path, tmp_path: Path) -> None:
    (program,) = (examples / example).glob("*.c")
    assert run("migrate", program, "-o", tmp_path / "out").code == 0
    (sketch,) = (path.parent for path in (tmp_path / "out").glob("*/platformio.ini"))
    listed = settings(sketch / "platformio.ini")["env:uno"]["lib_deps"].split("\n")[1:]
    lines = (sketch / "sketch.yaml").read_text().splitlines()
    wanted = [
        line.strip().removeprefix("- ") for line in lines[lines.index("    libraries:") + 1 :] if line.startswith("      - ")
    ]
    assert listed == [f"{name} @ {version.rstrip(')')}" for name, _, version in (line.partition(" (") for line in wanted)]


def test_a_library_that_the_core_brings_is_not_listed_until_the_user_pins_it(tmp_path: Path) -> None:
    """The Servo of the index has no RP2040, and would go before the one of the Pico's core."""
    assert [brought_to(board) for board in ("pico", "zero", "uno")] == [["Servo"], [], []]
    source, wiring = tmp_path / "turn.c", tmp_path / "wiring.csv"
    source.write_text('#include "servo.h"\nint main(void) { servo_angle(3, 900); }\n')
    wiring.write_text("pin,part,title\nGP3,Basic Servo,arm\n")
    words = ("--target", "pico", "--hardware", wiring, "--bind", "P3=GP3", "--library", "arm=Servo")
    assert run("migrate", source, *words, "-o", tmp_path / "out").code == 0
    sketch = tmp_path / "out" / "turn"
    assert "#include <Servo.h>" in (sketch / "turn.ino").read_text()
    assert "lib_deps" not in settings(sketch / "platformio.ini")["env:pico"]
    assert "Servo" not in (sketch / "sketch.yaml").read_text()
    pin_library(tmp_path / "out", "Servo", "1.2.1")
    assert settings(sketch / "platformio.ini")["env:pico"]["lib_deps"].split() == ["Servo", "@", "1.2.1"]


def brought_to(board: str) -> list[str]:
    """What the core of a board brings of a servo's library."""
    facts = target_facts(board)
    LibraryModels(facts, load_board(board)).get("Servo")
    return [*facts.own_platform.coreLibraries]


def test_the_files_are_named_for_what_they_are(tmp_path: Path) -> None:
    outcome = run("migrate", IDLE, "-o", tmp_path / "out", "--bench", "--json")
    artifacts = outcome.document["artifacts"]
    kinds = {Path(entry["path"]).relative_to(tmp_path / "out").as_posix(): entry["kind"] for entry in artifacts}
    assert kinds["idle/idle.ino"] == "sketch"
    assert (kinds["idle/sketch.yaml"], kinds["idle/platformio.ini"]) == ("project", "project")
    assert {kinds[f"bench/idle_bench/{name}"] for name in ("idle_bench.ino", "sketch.yaml")} == {"bench"}


def test_a_c_program_has_a_makefile_and_no_such_file(tmp_path: Path) -> None:
    robosmi.migrate([IDLE], tmp_path / "out", target="avr-c")
    assert not list((tmp_path / "out").rglob("platformio.ini"))
