"""What a program stores in the EEPROM is compared: the bytes, their places, and what the next run makes of them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.chains.verify import verify
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL, after_a_restart, stored_events
from robosmi.verify.host_model import load_host_model
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace, StoredByte
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE
from tests.tools import require_engine, require_verification

PROGRAM = Path(__file__).parent / "stored" / "eep.c"
PRESSES = Path(__file__).parent / "stored" / "presses.toml"


def test_each_function_that_stores_is_one_of_the_platform() -> None:
    model = load_host_model("propeller")
    declared = {name for folder in model.headers for path in folder.rglob("*.h") for name in re.findall(r"\w+", path.read_text())}
    assert model.stores
    assert model.stores <= declared


@pytest.fixture(scope="module")
def migrated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    require_verification()
    require_engine("simavr")
    output = tmp_path_factory.mktemp("stored") / "out"
    robosmi.migrate([PROGRAM], output, bind={"P2": "D4", "P3": "D9"})
    return output


def _edited(output: Path, before: str, after: str) -> None:
    sketch = output / "eep" / "eep.ino"
    text = sketch.read_text()
    assert before in text
    sketch.write_text(text.replace(before, after))


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("ee_putInt(n, 32768)", "ee_putInt(n + 1, 32768)"),
        ("ee_putInt(n, 32768)", "ee_putInt(n, 32772)"),
        ("ee_putInt(n, 32768);", ""),
        ("n = ee_getInt(32768)", "n = 0"),  # shows when the robot is started again
        ("ee_putInt(n, 32768)", "ee_putInt(n, 32768); ee_putByte(1, 32800)"),
    ],
)
def test_a_sketch_that_stores_otherwise_is_different(before: str, after: str, migrated: Path) -> None:
    sketch = migrated / "eep" / "eep.ino"
    original = sketch.read_text()
    try:
        _edited(migrated, before, after)
        verdict = verify(migrated, scenarios=[PRESSES], engine="simavr").verdict
    finally:
        sketch.write_text(original)
    assert verdict.verdict == DIFFERENT_VERDICT
    assert verdict.first_difference is not None
    assert verdict.first_difference[1].channel == EEPROM_CHANNEL
    assert EEPROM_CHANNEL not in verdict.not_compared


def test_the_same_bytes_are_no_difference(migrated: Path) -> None:
    verdict = verify(migrated, scenarios=[PRESSES], engine="simavr").verdict
    assert verdict.verdict == NO_DIFFERENCE
    assert verdict.outputs[EEPROM_CHANNEL]
    first, again = verdict.scenarios
    assert not first.scenario.stored
    assert again.scenario.stored == ((32768, 2, 0, 0, 0),)


def test_a_program_that_stores_nothing_in_any_scenario_is_listed(migrated: Path, tmp_path: Path) -> None:
    nothing = tmp_path / "nothing.toml"
    nothing.write_text("horizon_ms = 500\n")
    verdict = verify(migrated, scenarios=[nothing], engine="simavr").verdict
    assert EEPROM_CHANNEL in verdict.not_compared
    assert verdict.outputs[EEPROM_CHANNEL] is False
    assert verdict.partial


def test_what_a_run_keeps_is_the_start_of_the_next() -> None:
    stored = (StoredByte(1.0, 32769, 7), StoredByte(2.0, 32768, 5), StoredByte(3.0, 40, 1), StoredByte(4.0, 32769, 8))
    trace = PinTrace("", "running", 10.0, (), (), (), (), stored=stored, store_bytes=1024)
    again = after_a_restart(Scenario("a", 10, stored=((41, 3),)), trace)
    assert again.stored == ((40, 1, 3), (32768, 5, 8))


def test_addresses_repeat_beyond_the_memory_of_the_target() -> None:
    trace = PinTrace("", "running", 10.0, (), (), (), (), stored=(StoredByte(1.0, 32772, 7),), store_bytes=1024)
    [event] = stored_events(trace)
    assert event.value == ("byte 7 at address 4",)


def test_a_memory_of_unknown_size_has_the_addresses_that_the_program_gives() -> None:
    trace = PinTrace("", "running", 10.0, (), (), (), (), stored=(StoredByte(1.0, 32772, 7),))
    [event] = stored_events(trace)
    assert event.value == ("byte 7 at address 32772",)
