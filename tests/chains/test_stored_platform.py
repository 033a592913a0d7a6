"""A stored plan says the same whatever has become of the platform repository since it was made."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi import resources
from tests.running import run, tree


@pytest.fixture
def changed_repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A data folder that describes the platforms and boards differently from the built-in one."""
    folder = tmp_path / "changed" / "platform_repo"
    built_in = resources.built_in("platform_repo")
    for name in ("propeller", "arduino", "boards", "mcus"):
        shutil.copytree(built_in / name, folder / name, ignore=shutil.ignore_patterns("*.sqlite", "stand_ins"))

    def change(name: str, old: str, new: str) -> None:
        path = folder / name
        text = path.read_text()
        assert old in text, f"{name} has no {old}"
        path.write_text(text.replace(old, new))

    (folder / "parts").mkdir()
    for name in ("electrical.toml", "names.toml"):
        shutil.copy(built_in / "parts" / name, folder / "parts" / name)
    change("parts/electrical.toml", "peak_ma = ", "peak_ma = 9")
    change("parts/electrical.toml", "sda = [", 'sda = ["signal", ')
    change("parts/electrical.toml", "supply_ma = [", "supply_ma = [[5.0, 1], ")
    change("parts/names.toml", "bus_only = [", 'bus_only = ["resistor", "led", "servo", ')
    change("parts/names.toml", 'read = ["echo"', 'read = ["signal", "anode", "echo"')
    change("propeller/platform.toml", "int_bits = 32", "int_bits = 64")
    change("propeller/platform.toml", '"CNT", ', "")
    change("propeller/platform.toml", "cog_run = 0", "cog_ran = 0")
    change("propeller/meanings.toml", "blocking = true", "blocking = false")
    change("propeller/api.json", '"drive_speed"', '"drove_speed"')
    change("propeller/cogs.toml", "drive_speed", "drove_speed")
    change("arduino/platform.toml", "intBits = 16", "intBits = 32")
    change("arduino/platform.toml", 'generator = "arduino_sketch"', 'generator = "none"')
    change("boards/uno.toml", "volts = 5.0", "volts = 1.8")
    for old, new in (("Timer2", "Timer3"), ("Timer1", "Timer2"), ("Timer3", "Timer1")):  # an output has one pin
        change("boards/uno.toml", f'timer = "{old}"', f'timer = "{new}"')
    change("boards/uno.toml", '"arduino_Uno_Rev3(fix)"', '"another"')
    change("mcus/atmega328p.toml", 'timers = ["Timer1"]', 'timers = ["Timer0"]')
    change("arduino/libraries/takes.toml", "Timer1", "Timer0")
    change("arduino/boards/uno.toml", "arduino:avr:uno", "arduino:avr:other")
    monkeypatch.setenv("ROBOSMI_PATH", str(folder.parent))
    return folder


def said(path: Path) -> list[Any]:
    """The findings of `check` about a stored plan."""
    outcome = run("check", path, "--json")
    assert outcome.code in (0, 1), outcome.err
    return [outcome.result, outcome.document["findings"]]


def test_check_and_generate_ask_the_stored_platforms(
    case_study: Path, tmp_path: Path, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    robosmi.migrate([case_study], out)
    plan = out / "models" / "plan.xmi"
    before, files = said(plan), tree(out)
    request.getfixturevalue("changed_repository")
    assert said(plan) == before
    assert before[1]
    robosmi.generate_sketch(plan, out)
    assert tree(out) == files


def test_the_changes_are_ones_that_a_new_plan_would_show(
    line_follower: Path, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    """The test above could else not fail."""
    robosmi.migrate([line_follower], tmp_path / "out")
    drawing = line_follower.with_name("line_following_robot.fzz")
    before = said(drawing)
    request.getfixturevalue("changed_repository")
    assert said(drawing)[1] != before[1]
    outcome = run("migrate", line_follower, "-o", tmp_path / "new")
    assert outcome.code == 3
    assert "'target.generator' is 'none', which is none of" in outcome.err
