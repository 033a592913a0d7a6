"""A board of another core is one file of a project: its pins have the core's numbers, its buses the board's places."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError, UsageError
from robosmi.resources import built_in
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.knowledge.board_models import load_board, load_mapping
from robosmi.transformations.verification import api_build
from robosmi.transformations.verification.engines.api import Api
from robosmi.transformations.verification.jobs import api_facts
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


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "D10 = 3 }\ninterrupts",
            "D10 = 2 }\ninterrupts",
            "'numbers.D10' is 2, but the pin is at GPIO3, which is 3 in this core",
        ),
        ("D10 = 3 }\npins", "D10 = 99 }\npins", "'interrupts.D10' is 99, but the pin is at GPIO3"),
        ("D9 = 4, D10 = 3 }\ninterrupts", "D9 = 4 }\ninterrupts", "'numbers.D10' is missing"),
        ("rp2040:rp2040:", "rp2040:rp2400:", "an unknown core (did you mean 'rp2040:rp2040'?)"),
        ("rp2040:rp2040:", "arduino:avr:", "names the core 'arduino:avr', which is not for 'rp2040'"),
        ("volts = 3.3", "volts = 33", "'volts' must be above 0 and at most 6 V, it is 33"),
        ("volts = 3.3", "volts = -3.3", "'volts' must be above 0"),
        ("volts = 3.3", "volts = nan", "'volts' must be above 0"),
        ("i2c = {", "i2x = {", "'buses.i2x' is not a key of it (did you mean 'i2c'?)"),
        ("SDA =", "SDAA =", "'buses.i2c.SDAA' is not a key of it (did you mean 'SDA'?)"),
        ('mcu = "rp2040"', 'mcu = "rp2400"', "or describe it in platform_repo/mcus/rp2400.toml"),
    ],
)
def test_facts_of_a_board_that_cannot_be_are_errors(old: str, new: str, said: str, project: Path) -> None:
    file = project / ".robosmi" / "platform_repo" / "arduino" / "boards" / FILE.name
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new))
    with pytest.raises(PlatformDataError) as caught:
        load_mapping("arduino", load_board("xiao-rp2040", project), project)
    assert said in f"{caught.value.message} {caught.value.fix}"


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        ({"D10 = 3": "D10 = 2"}, "'numbers.D10' is 2, which is also that of D8: programs would use one pin for both"),
        ({"D10 = 3": "D10 = 300"}, "'numbers.D10' is 300, but cores have numbers from 0 to 254"),
        ({"numbers =": "# numbers ="}, "'numbers.D0' is missing"),
        ({"D10 = 3 }\npins": "D10 = 2 }\npins"}, "'interrupts.D10' is 2, which is also that of D8"),
        ({"numbers =": 'literals = { D10 = "2" }\nnumbers ='}, "give two pins one name in programs: 2"),
    ],
)
def test_a_pin_has_a_number_of_its_own_in_every_core(edits: dict[str, str], said: str, project: Path) -> None:
    """In a core that the data do not know, which alone has the numbers of pins; its platform for PlatformIO is left open."""
    file = project / ".robosmi" / "platform_repo" / "arduino" / "boards" / FILE.name
    text = file.read_text().replace("rp2040:rp2040:", "my:cores:")
    file.write_text(text)
    assert load_mapping("arduino", load_board("xiao-rp2040", project), project).platformioPlatform == ""
    for old, new in edits.items():
        assert old in text
        text = text.replace(old, new)
    file.write_text(text)
    with pytest.raises(PlatformDataError) as caught:
        load_mapping("arduino", load_board("xiao-rp2040", project), project)
    assert said in caught.value.message


def test_the_platform_of_an_unknown_core_is_to_be_filled_in(project: Path) -> None:
    file = project / ".robosmi" / "platform_repo" / "arduino" / "boards" / FILE.name
    file.write_text(file.read_text().replace("rp2040:rp2040:", "my:cores:"))
    migrated()
    written = (project / "out" / "blink" / "platformio.ini").read_text()
    assert "; fill in PlatformIO's platform for the core my:cores" in written
    assert "\nplatform =" not in written


@pytest.mark.parametrize(
    ("table", "said"),
    [
        (
            "api = { flags = [], usb_console = false, colour = 1 }\nport_pattern = '(.+)'\ntimers = {}",
            "'my.api.colour' is not a key",
        ),
        ("api = { flags = [], usb_console = false }\nport_pattern = '(.+)'\ntimers = {}\nhue = 1", "'my.hue' is not a key"),
        ("timers = {}", "'my.api' is missing, in all: api, port_pattern, api.flags, api.usb_console"),
    ],
)
def test_a_table_for_the_arduino_api_is_checked(table: str, said: str, project: Path) -> None:
    place = project / ".robosmi" / "platform_repo" / "simulation" / "api.toml"
    place.parent.mkdir()
    place.write_text(f"[my]\n{table}\n")
    with pytest.raises(PlatformDataError) as caught:
        api_facts("my")
    assert said in caught.value.message


def test_a_microcontroller_without_a_table_is_the_cause_why_a_program_is_not_judged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No core that is missing is: it would not help."""
    data = tmp_path / ".robosmi" / "platform_repo"
    for name, place in (("bluepill", "arduino/boards/bluepill"), ("stm32f103c8", "mcus/stm32f103c8")):
        (data / place).parent.mkdir(parents=True)
        shutil.copy(FILE.with_name(f"{name}.toml"), data / f"{place}.toml")
    sketch = tmp_path / "out" / "blink"
    sketch.mkdir(parents=True)
    (sketch / "blink.ino").write_text("void setup() {}\nvoid loop() {}\n")
    (sketch / "sketch.yaml").write_text(
        "profiles:\n  it:\n    fqbn: STMicroelectronics:stm32:GenF1:pnum=BLUEPILL_F103C8\ndefault_profile: it\n"
    )
    monkeypatch.chdir(tmp_path)
    assert run("trust", ".").code == 0
    with pytest.raises(UsageError) as caught:
        api_build.compile_to_run(tmp_path / "out", tmp_path)
    assert "add a table [stm32f103c8] to simulation/api.toml" in str(caught.value.fix)


def test_the_page_names_the_microcontrollers_that_are_there() -> None:
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "add-a-board.md").read_text()
    (listed,) = re.findall(r"^- `mcu` is one of .+?: (.+?)\. Another", page, re.MULTILINE | re.DOTALL)
    assert sorted(re.findall(r"`(\w+)`", listed)) == sorted(
        file.stem for file in (built_in("platform_repo") / "mcus").glob("*.toml")
    )


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
