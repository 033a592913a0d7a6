"""`robosmi targets`: what results for each target are proven by."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.transformations.knowledge.platforms.target_platform import target_names
from tests.running import run
from tests.tools import require_engine, require_tools


def known() -> dict[str, Any]:
    """The targets by name."""
    outcome = run("targets", "--json")
    assert outcome.code == 0
    return {target["name"]: target for target in outcome.result["targets"]}


@pytest.mark.processes
def test_all_targets_are_listed_with_their_proof() -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr", "arm-none-eabi-g++")
    require_engine("rp2040js")
    require_engine("simavr")
    found = known()
    assert set(found) == set(target_names())
    assert {name: found[name]["proven_by"] for name in ("uno", "pico")} == dict.fromkeys(("uno", "pico"), "simulated at the pins")
    assert (found["pico"]["core"], found["pico"]["engine"]) == ("stand-in", "rp2040js")
    assert "stand-in" in run("targets").out


@pytest.mark.processes
def test_nothing_is_claimed_where_nothing_is_installed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    found = known()
    assert {target["proven_by"] for target in found.values()} == {"not compiled here"}
    assert "gcc-arm-none-eabi" in found["pico"]["missing"][0]


@pytest.mark.processes
def test_a_target_has_its_full_name_and_its_proof_in_a_word(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    require_engine("api")
    monkeypatch.setenv("HOME", str(tmp_path))
    found = known()
    teensy = found["teensy40"]
    assert (teensy["fqbn"], teensy["title"], teensy["proof"], teensy["installed"]) == (
        "teensy:avr:teensy40", "Teensy 4.0", "api", False,
    )  # fmt: skip
    index = "--additional-urls https://www.pjrc.com/teensy/package_teensy_index.json"  # Arduino's own index has no Teensy
    assert teensy["missing"] == [f"install it: arduino-cli core install teensy:avr {index}, or let ROBOSMI_CORE name its folder"]
    assert "--additional-urls" not in found["zero"]["missing"][0]
    assert teensy["proven_by"] == "judged at the Arduino API, not compiled here"
    assert all(target["missing"] for target in found.values() if target["proof"] in ("none", "api"))


@pytest.mark.processes
def test_what_of_a_board_is_not_simulated_is_said() -> None:
    require_tools("arm-none-eabi-g++")
    require_engine("rp2040js")
    assert "LED" in known()["picow"]["not_simulated"]
    assert "not simulated: the LED" in run("targets").out
    assert known()["pico"]["not_simulated"] is None
    assert known()["leonardo"]["not_simulated"] == "the console over USB"
