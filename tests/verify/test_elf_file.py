"""The program that is kept: its lines are told, and what is no program is left alone."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from robosmi.verify.toolchains.build import without_relocations
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_tools


def test_a_program_that_is_kept_tells_the_lines_of_its_instructions(tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-addr2line", "arduino-core-avr")
    (tmp_path / "lines").mkdir()
    text = "volatile int count;\nvoid setup() { DDRB = 32; }\nvoid loop() {\n  count++;\n  PORTB ^= 32;\n}\n"
    (tmp_path / "lines" / "lines.ino").write_text(text)
    report = compile_sketch(tmp_path / "lines", keep=tmp_path)
    assert report.elf is not None
    assert report.flash_bytes is not None
    addresses = "\n".join(hex(address) for address in range(0, report.flash_bytes, 2))
    told = subprocess.run(
        ["avr-addr2line", "-i", "-e", report.elf], input=addresses, capture_output=True, text=True, check=True
    ).stdout
    assert {int(line) for line in re.findall(r"lines\.ino:(\d+)", told)} >= {2, 4, 5}


@pytest.mark.parametrize("data", [b"", b"\x7fELF", b"\x7fELF\x01\x01" + bytes(70), b"\x7fELF\x02\x02" + bytes(250), bytes(80)])
def test_what_is_no_whole_program_stays_as_it_is(data: bytes) -> None:
    assert without_relocations(data) == data
