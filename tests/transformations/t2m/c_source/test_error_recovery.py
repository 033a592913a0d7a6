"""Damaged programs: no call is lost to a missing token, every place is the file's own, and the damage stays a finding."""

from __future__ import annotations

import json
import os
import random
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, strategies as st

from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.parsing.error_recovery import Scratch

DAMAGED = Path(__file__).parent / "damaged"
EXPECTED: dict[str, dict[str, Any]] = json.loads((DAMAGED / "expected.json").read_text())


def test_every_case_has_its_expectation() -> None:
    assert {path.stem for path in DAMAGED.glob("*.c")} == set(EXPECTED)


@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_what_is_read_of_a_damaged_program(name: str) -> None:
    program, findings = read_program(DAMAGED / f"{name}.c")
    calls = sorted(all_of_kind(program, ccode.Call), key=lambda call: int(call.startOffset))
    unit = program.units[0]
    assert [f"{call.line}:{call.calleeName}" for call in calls] == EXPECTED[name]["calls"]
    assert [str(d.name) for d in unit.declarations if isinstance(d, ccode.Function)] == EXPECTED[name]["functions"]
    assert [f"{f.rule}:{f.location.line if f.location else 0}" for f in findings] == EXPECTED[name]["findings"]
    assert int(unit.callsInText) == int(unit.callsInModel) + len(unit.unresolved)


@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_places_are_those_of_the_file(name: str) -> None:
    data = (DAMAGED / f"{name}.c").read_bytes()
    program, _ = read_program(DAMAGED / f"{name}.c")
    for element in all_contents(program.units[0]):
        if isinstance(element, ccode.Located):
            assert 0 <= int(element.startOffset) <= int(element.endOffset) <= len(data)
            assert int(element.line) == data.count(b"\n", 0, int(element.startOffset)) + 1
        text = data[int(element.startOffset) : int(element.endOffset)] if isinstance(element, ccode.Located) else b""
        if isinstance(element, ccode.Call):
            assert text.startswith(str(element.calleeName).encode())
        elif isinstance(element, ccode.NameReference):
            assert text == str(element.name).encode()
        elif isinstance(element, ccode.IntegerLiteral) and text:
            assert text == str(element.text).encode()


def test_the_file_itself_is_what_the_model_is_of() -> None:
    program, _ = read_program(DAMAGED / "windows.c")
    assert int(program.units[0].size) == (DAMAGED / "windows.c").stat().st_size
    assert b"\r\n" in (DAMAGED / "windows.c").read_bytes()


def replaced(start: int, length: int, text: str) -> Replacement:
    """A text in place of so many bytes."""
    return Replacement(start, start + length, text)


edits = st.lists(st.builds(replaced, st.integers(0, 40), st.integers(0, 6), st.text(max_size=5)), max_size=8)


@given(st.binary(min_size=20, max_size=60), edits)
def test_offsets_of_a_copy_lead_back(data: bytes, changes: list[Replacement]) -> None:
    scratch = Scratch(data, changes)
    back = [scratch.source_offset(i) for i in range(len(scratch.data) + 1)]
    assert back == sorted(back)
    assert all(0 <= offset <= len(data) for offset in back)
    assert back[-1] == len(data)
    put_in = {edit.start for edit in scratch.edits}
    for i, offset in enumerate(back[:-1]):
        assert offset in put_in or scratch.data[i] == data[offset]


LEAST = {";": 0.995, ")": 0.995, "(": 0.9, "}": 0.98, "{": 0.96, ",": 0.99}
"""Share of the calls that must be in the model when one token of this kind is left out of real programs."""


def test_real_programs_with_a_token_left_out(tmp_path: Path) -> None:
    corpus = os.environ.get("ROBOSMI_CORPUS")
    if not corpus:
        pytest.skip("ROBOSMI_CORPUS does not name a folder with the corpus")
    chance = random.Random(13)
    for token, least in LEAST.items():
        wanted = found = 0
        for path in sorted(Path(corpus).rglob("*.c"))[:60]:
            data = path.read_bytes()
            places = [t for t in tokens(data) if t[0] == "punct" and t[3] == token]
            if not places or len(data) > 60_000:
                continue
            _, start, end, _ = chance.choice(places)
            damaged = tmp_path / "damaged.c"
            damaged.write_bytes(data[:start] + b" " + data[end:])
            before = read_program(path)[0].units[0]
            unit = read_program(damaged)[0].units[0]
            assert int(unit.callsInText) == int(unit.callsInModel) + len(unit.unresolved)
            wanted += int(before.callsInModel)
            found += min(int(before.callsInModel), int(unit.callsInModel))
        assert wanted > 300
        assert found >= least * wanted, (token, found, wanted)
