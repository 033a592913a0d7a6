"""Where a board's processor has the source's widths, a program keeps its types; on an AVR board it does not."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.errors import PlatformDataError, SourceError
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.queries.numbers import Machine

PROGRAM = """#include "simpletools.h"

int values[4];
unsigned int total;

int scaled(int a, long b)
{
  return a * b / 100;
}

int main()
{
  int n = 70000;
  char c = 200;
  values[0] = scaled(n, n);
  total += c > 100;
  print("%d %u\\n", values[0], total);
}
"""


def sketch(target: str, folder: Path) -> str:
    (folder / "numbers.c").write_text(PROGRAM)
    made = robosmi.migrate([folder / "numbers.c"], folder / target, hardware=_board(target, folder), target=target)
    return next(made.sketch.glob("*.ino")).read_text()


def _board(target: str, folder: Path) -> Path:
    """A drawing with nothing but a part at a pin that both boards have."""
    file = folder / f"{target}.csv"
    file.write_text(f"pin,part,title\n{'GP' if target == 'pico' else 'D'}9,LED,lamp\n")
    return file


def test_a_program_for_the_pico_keeps_its_types(tmp_path: Path) -> None:
    text = sketch("pico", tmp_path)
    assert "int32_t" not in text
    for line in ("int values[4];", "unsigned int total;", "int scaled(int a, long b)", "int n = 70000;", "char c = 200;"):
        assert line in text


def test_a_program_for_the_pico_waits_for_the_console_for_some_time_only(tmp_path: Path) -> None:
    """Its console is USB: what is printed before it is open is lost, and there may never be a computer."""
    lines = [line.strip() for line in sketch("pico", tmp_path).splitlines()]
    assert lines[lines.index("Serial.begin(115200);") + 1] == "while (!Serial && millis() < 3000) {}"
    assert "while (!Serial" not in sketch("uno", tmp_path)


@pytest.mark.parametrize(("said", "waits"), [("500", "while (!Serial && millis() < 500) {}"), ("0", "")])
def test_the_project_file_says_how_long_it_waits(said: str, waits: str, tmp_path: Path) -> None:
    (tmp_path / "robosmi.toml").write_text(f'[migrate]\nconsole_wait_ms = "{said}"\n')
    text = sketch("pico", tmp_path)
    assert ("while (!Serial" in text) == bool(waits)
    assert waits in text
    again = robosmi.generate_sketch(tmp_path / "pico" / "models" / "plan.xmi", tmp_path / "again")
    assert text.encode() in again.contents.values()


@pytest.mark.parametrize("said", ["-1", "soon", "600001", "1.5"])
def test_a_time_that_is_none_is_an_error_with_its_line(said: str, tmp_path: Path) -> None:
    (tmp_path / "robosmi.toml").write_text(f'[migrate]\nconsole_wait_ms = "{said}"\n')
    with pytest.raises(SourceError, match="is no time") as caught:
        sketch("pico", tmp_path)
    assert caught.value.location is not None
    assert caught.value.location.line == 2
    assert not (tmp_path / "pico").exists()


def test_a_program_for_an_uno_has_the_widths_of_the_source(tmp_path: Path) -> None:
    text = sketch("uno", tmp_path)
    for line in ("int32_t values[4];", "uint32_t total;", "int32_t n = 70000;", "(uint8_t)c > 100L"):
        assert line in text


@pytest.mark.parametrize(
    ("target", "machine", "double", "architecture"),
    [("uno", (16, 32, 16, True), 32, "avr"), ("pico", (32, 32, 32, False), 64, "rp2040")],
)
def test_the_widths_are_those_of_the_processor(
    target: str, machine: tuple[int, int, int, bool], double: int, architecture: str
) -> None:
    platform = target_facts(target).model.platform
    assert platform is not None
    found = Machine.of(platform)
    assert (found.int_bits, found.long_bits, found.pointer_bits, found.char_signed) == machine
    assert (platform.doubleBits, platform.architecture) == (double, architecture)


def test_an_unknown_key_of_an_architecture_is_refused(tmp_path: Path) -> None:
    shipped = Path(robosmi.__file__).parent.parent / "platform_repo"
    text = (shipped / "arduino" / "platform.toml").read_text() if shipped.is_dir() else ""
    own = tmp_path / ".robosmi" / "platform_repo" / "arduino" / "platform.toml"
    own.parent.mkdir(parents=True)
    own.write_text(text.replace("[architectures.rp2040]\n", "[architectures.rp2040]\nintBit = 16\n"))
    with pytest.raises(PlatformDataError) as caught:
        target_facts("pico", tmp_path)
    assert "intBit" in str(caught.value)
