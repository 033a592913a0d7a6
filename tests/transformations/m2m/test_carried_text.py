"""Text that the target would take otherwise than the source: bytes of other encodings, sections of a linker script."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.verification.engines.simavr import runs_of_hex
from tests.running import run

CASES = Path(__file__).parent / "carried_text"
BINDINGS = {"P0": "D2", "P1": "D3"}


def sketch(name: str, folder: Path, target: str = "uno") -> str:
    """The main file of a case's sketch."""
    made = robosmi.migrate([CASES / f"{name}.c"], folder, hardware=CASES / "hw.csv", target=target, bind=BINDINGS)
    return next(
        data.decode()
        for file, data in made.contents.items()
        if file.endswith((f"{name}.ino", f"{name}.c")) and "models" not in file
    )


def test_the_bytes_of_texts_in_another_encoding_are_sent_as_they_were(tmp_path: Path) -> None:
    text = sketch("latin1", tmp_path / "out")
    literals = [word for kind, _, _, word in tokens(text.encode()) if kind in ("string", "char")]
    assert all(literal.isascii() for literal in literals)
    assert {r'"%d\260 %s %x\n"', r'"\351"', r"'\374'", r"'\xb0'", r"'\xb1'"} <= {*literals}
    assert r'#define DEG "\260"' in text
    assert "/* é */" in text


@pytest.mark.parametrize("target", ["uno", "avr-c"])
def test_a_section_of_the_sources_linker_script_is_taken_out(target: str, tmp_path: Path) -> None:
    text = sketch("sections", tmp_path / "out", target)
    assert "section(" not in text
    assert "__attribute__((aligned(4)))" in text
    assert "__attribute__((noinline))" in text


def test_an_attribute_is_no_call() -> None:
    done = run("analyse", CASES / "sections.c", "--json")
    assert "RS102" not in done.rules()


def test_the_bytes_of_a_hex_file_by_address() -> None:
    text = ":020000040001F9\n:0400000001020304F2\n:020004000506EF\n:02100000AABB89\n:00000001FF\n"
    assert runs_of_hex(text) == [(0x10000, bytes([1, 2, 3, 4, 5, 6])), (0x11000, b"\xaa\xbb")]
    with pytest.raises(ValueError, match="no record"):
        runs_of_hex(":0400000001020304F3")


@pytest.mark.processes
def test_the_simulator_runs_a_function_in_a_section_of_its_own(tmp_path: Path) -> None:
    made = robosmi.migrate([CASES / "sections.c"], tmp_path / "out", hardware=CASES / "hw.csv", bind=BINDINGS)
    file = made.sketch / "sections.ino"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("__attribute__((noinline))", '__attribute__((noinline, section(".own")))'), encoding="utf-8")
    assert run("compile", tmp_path / "out").code == 0
    done = run("simulate", tmp_path / "out", "--seconds", "1", "--json")
    assert done.code == 0
    assert {(event["pin"], event["level"]) for event in done.result["events"]} >= {("D2", 1), ("D3", 1)}
