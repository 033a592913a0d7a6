"""A header of one's own that nobody has but an adapter file: `migrate` and `analyse` know of it what the file says."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.running import Outcome, run
from tests.tools import require_tools


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    folder = tmp_path / "project"
    shutil.copytree(Path(__file__).parent / "own_header", folder)
    return folder / "signal.c"


def about(outcome: Outcome, rule: str) -> list[str]:
    return [found["message"] for found in outcome.document["findings"] if found["rule"] == rule]


def test_a_header_with_an_adapter_file_is_nothing_to_write(program: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    made = run("migrate", program, "-o", tmp_path / "out", "--json")
    assert about(made, "RS103") == []
    assert [said.split(":")[0] for said in about(made, "RS109")] == [
        "the function beacon_sound is declared nowhere; inferred signature"
    ]
    assert [task for task in made.document["tasks"] if "beacon.h" in task["message"]] == []
    assert "beacon.h" not in (tmp_path / "out" / "signal" / "signal.ino").read_text()
    assert "RS501" in {task["rule"] for task in made.document["tasks"]}  # beacon_sound has no adapter
    headers = {adapter["name"]: adapter["header"] for adapter in made.result["plan"]["adapters"]}
    assert headers["beacon_flash"] == "beacon.h"
    assert headers["beacon_sound"] == "unknown"
    counts = made.result["plan"]["call_sites"]["by_header"]
    assert counts["beacon.h"]["with_body"] == counts["beacon.h"]["total"] == 1
    rows = [line for line in (tmp_path / "out" / "signal" / "MIGRATION.md").read_text().splitlines() if "beacon_flash(" in line]
    assert [line.split(" | ")[1] for line in rows if line.startswith("| `")] == ["beacon.h"]


def test_the_header_itself_may_be_given_too(program: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    headers = tmp_path / "headers"
    headers.mkdir()
    (headers / "beacon.h").write_text("void beacon_flash(int pin, int times);\nvoid beacon_sound(int pin);\n")
    made = run("migrate", program, "-I", headers, "-o", tmp_path / "out", "--json")
    assert [said.split(" as ")[0] for said in about(made, "RS109")] == ["the program declares the function beacon_sound"]


def test_without_the_adapter_file_it_is_unknown(program: Path, tmp_path: Path) -> None:
    shutil.rmtree(program.parent / "adapters")
    made = run("migrate", program, "-o", tmp_path / "out", "--json")
    assert len(about(made, "RS103")) == 1
    assert len(about(made, "RS109")) == 2
    assert "RS503" in {task["rule"] for task in made.document["tasks"]}


def test_analyse_names_the_adapter_file(program: Path) -> None:
    seen = run("analyse", program, "--json")
    assert about(seen, "RS103") == []
    assert len(about(seen, "RS109")) == 1
    (unit,) = seen.result["units"]
    files = {call["name"]: call.get("adapter") for call in unit["unknown_calls"]}
    assert files == {"beacon_flash": str(program.parent / "adapters" / "beacon.cpp"), "beacon_sound": None}
    text = run("analyse", program).out
    assert "beacon.cpp): beacon_flash (1 call)" in text
    assert "unknown: beacon_sound (1 call)" in text
