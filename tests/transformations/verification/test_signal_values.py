"""What a scenario may say of a signal: what its device can show, and an advice for all else, before anything is compiled."""

from __future__ import annotations

from typing import Any

import pytest

from robosmi.errors import UsageError
from robosmi.transformations.verification.bound_devices.played_devices import check_signal
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts


@pytest.mark.parametrize(
    ("device", "setting", "value", "why"),
    [
        ("levels", "points", "up", "not a level"),
        ("levels", "points", 7, "0 or 1"),
        ("voltages", "points", -20, "outside its device's range"),
        ("voltages", "points", None, "not a number"),
        ("capacitor", "points", "dark", "not a number"),
        ("ranger", "points", -3, "outside its device's range"),
        ("dht22", "celsius", 1_000_000, "from -40 to 80"),
        ("dht22", "humidity", [40], "not a number"),
        ("typing", "points", 5, "not a text"),
        ("serial_line", "points", [300], "or list of bytes"),
        ("keypad", "points", [1], "not a list of 2 whole numbers"),
        ("sony_remote", "points", [200, 1], "outside its device's range"),
        ("lis3dh", "points", [0, 0], "not a list of 3 numbers"),
        ("bme680", "points", [0.5, 1, 2, 3], "not a list of 4 whole numbers"),
        ("bme680", "points", [1, 1, 70_000, 1], "outside its device's range"),
        ("registers", "points", 256, "from 0 to 255"),
    ],
)
def test_what_a_device_cannot_show_is_told_with_its_place(device: str, setting: str, value: Any, why: str) -> None:
    with pytest.raises(UsageError) as caught:
        check_signal("X", setting, ((20.0, value),), device_facts()[device])
    assert "'X'" in caught.value.message
    assert "20 ms" in caught.value.message
    assert why in f"{caught.value.message} {caught.value.fix}"


def test_that_nothing_is_there_is_called_as_the_file_writes_it() -> None:
    with pytest.raises(UsageError, match='has "none" at 20 ms'):
        check_signal("X", "points", ((20.0, None),), device_facts()["voltages"])


def test_whatever_scenarios_are_generated_of_can_be_shown() -> None:
    for facts in device_facts().values():
        for setting, values in facts.get("values", {}).items():
            shown = [None if value == "none" else value for value in (*values, *facts.get("ends", {}).get(setting, ()))]
            assert setting in facts["takes"]
            check_signal("X", setting, tuple((0.0, value) for value in shown), facts)
