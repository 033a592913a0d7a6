"""A board of another core is one file of a project: its pins have the core's numbers, its buses the board's places."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification import api_build
from robosmi.transformations.verification.engines.api import Api
from robosmi.verify.toolchains.boards import find_board, load_boards
from robosmi.verify.toolchains.toolchain_data import load_toolchains
from tests.running import run
from tests.tools import require_engine, require_tools

FILE = Path(__file__).parent / "added_board" / "xiao-rp2040.toml"
PROGRAM = """#include "simpletools.h"
int main()
{
  while(1)
  {
    high(26);
    pause(100);
    low(26);
    pause(100);
  }
}
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with the board's file, a program and its wiring; the current folder."""
    boards = tmp_path / ".robosmi" / "platform_repo" / "arduino" / "boards"
    boards.mkdir(parents=True)
    shutil.copy(FILE, boards)
    (tmp_path / "blink.c").write_text(PROGRAM)
    (tmp_path / "wiring.csv").write_text("pin,part,title\nD2,Red LED,lamp\n")
    monkeypatch.chdir(tmp_path)
    assert run("trust", ".").code == 0
    return tmp_path


def migrated(*more: str) -> str:
    """The sketch of the program for the board."""
    done = run(
        "migrate", "blink.c", "--target", "xiao-rp2040", "--hardware", "wiring.csv", "--bind", "P26=D2", "-o", "out", *more
    )
    assert done.code == 0, done.err
    return Path("out/blink/blink.ino").read_text()


def test_pins_have_the_numbers_of_the_core(project: Path) -> None:
    """D2 of this board is pin 28; its core takes 2 for another one."""
    assert "lampWriteP1 = 28;" in migrated()
    assert "rp2040:rp2040:seeed_xiao_rp2040" in (project / "out" / "blink" / "sketch.yaml").read_text()
    assert "board = seeed_xiao_rp2040" in (project / "out" / "blink" / "platformio.ini").read_text()


def test_its_program_runs_at_its_pins(project: Path) -> None:
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    migrated()
    compiled = run("compile", "out", "--json")
    assert compiled.code == 0, compiled.err
    assert compiled.result["board"] == "xiao-rp2040"
    seen = run("simulate", "out", "--seconds", "1", "--json")
    assert {event["pin"] for event in seen.result["events"]} == {"D2"}


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('SDA = "GPIO6"', 'SDA = "GPIO9"', "'GPIO9', which no pin of this board has"),
        ('port = "GPIO6"', 'port = "GPIO66"', "GPIO66"),
        ("D2 = 28, ", "D22 = 28, ", "is not a pin of this board"),
        ('mcu = "rp2040"', 'mcu = "rp2400"', "an unknown microcontroller (did you mean 'rp2040'?)"),
        ("rp2040:rp2040:seeed_xiao_rp2040", "rp2040:rp2040:rpipico", "is also the name of the board 'pico'"),
    ],
)
def test_a_mistake_in_its_file_is_an_error_with_its_place(old: str, new: str, said: str, project: Path) -> None:
    file = project / ".robosmi" / "platform_repo" / "arduino" / "boards" / FILE.name
    file.write_text(file.read_text().replace(old, new))
    done = run("migrate", "blink.c", "--target", "xiao-rp2040", "-o", "out")
    assert done.code == 3
    assert said in done.err
    assert FILE.name in done.err
    assert not (project / "out").exists()


def test_a_board_that_the_stand_in_does_not_know_needs_data(project: Path) -> None:
    require_tools("arm-none-eabi-g++")
    migrated()
    done = run("compile", "out", "--board", "rp2040:rp2040:seeed_xiao_rp2350")
    assert done.code == 2
    assert "unknown board" in done.err


def test_a_board_of_the_stm32_core_is_one_file_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its A0 is place 46 of the core's pins; a timer of the core's Servo is not free for PWM; no other core takes its place."""
    boards = tmp_path / ".robosmi" / "platform_repo" / "arduino" / "boards"
    boards.mkdir(parents=True)
    shutil.copy(FILE.parent / "nucleo-f103rb.toml", boards)
    (tmp_path / "blink.c").write_text(PROGRAM)
    (tmp_path / "wiring.csv").write_text("pin,part,title\nA0,Red LED,lamp\n")
    monkeypatch.chdir(tmp_path)
    assert run("trust", ".").code == 0
    done = run("migrate", "blink.c", "--target", "nucleo-f103rb", "--hardware", "wiring.csv", "--bind", "P26=A0", "-o", "out")
    assert done.code == 0, done.err
    assert "STMicroelectronics:stm32:Nucleo_64:pnum=NUCLEO_F103RB" in Path("out/blink/sketch.yaml").read_text()
    board = load_board("nucleo-f103rb")
    assert board.microcontroller is not None
    assert board.microcontroller.architecture == "stm32"
    assert {str(timer) for use in board.microcontroller.uses for timer in use.timers} == {"TIM3", "TIM4"}


def test_a_microcontroller_of_its_own_is_judged_with_the_names_of_its_pins(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A table for it leaves those of all others as they are; sketches write PC13, and the model of the API has that name."""
    data = tmp_path / ".robosmi" / "platform_repo"
    for name, place in (
        ("bluepill", "arduino/boards/bluepill"),
        ("stm32f103c8", "mcus/stm32f103c8"),
        ("judged", "simulation/api"),
    ):
        (data / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(FILE.with_name(f"{name}.toml"), data / f"{place}.toml")
    monkeypatch.chdir(tmp_path)
    assert run("trust", ".").code == 0
    assert all(Api().serves(mcu) for mcu in ("stm32f103c8", "ra4m1"))
    (toolchain,) = (each for each in load_toolchains() if each.platform == "arduino")
    defines = api_build._properties(find_board("bluepill", load_boards("arduino")), toolchain)["api.defines"]
    assert {"API_NAME(PC13,17)", "API_NAME(A1,21)"} <= {*re.findall(r"API_NAME\(\w+,\d+\)", defines)}
    for echo, too_high in (("PB4", False), ("PB5", True)):  # PB4 is 5 V tolerant by its data, PB5 is not
        table = tmp_path / f"{echo}.csv"
        table.write_text(f"pin,part,title,connector,board\nPB3,HC-SR04,eye,Trig,bluepill\n{echo},HC-SR04,eye,Echo,\n")
        assert ("RS258" in {finding.rule for finding in hardware(table).findings}) == too_high
