"""What is known of simulated devices is read with each key that a person may have misspelt."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError
from robosmi.transformations.verification.bound_devices.simulated_kinds import FILE, _read, device_facts


def test_a_key_that_no_device_has_is_told_with_the_nearest_one(tmp_path: Path) -> None:
    file = tmp_path / Path(FILE).name
    file.write_text("[keypad]\nhappen = true\n", encoding="utf-8")
    with pytest.raises(PlatformDataError, match=r"'keypad\.happen' .*'happens'") as told:
        _read(file)
    assert told.value.location is not None
    assert told.value.location.path == str(file)


def test_all_keys_of_the_repository_mean_something() -> None:
    assert {"capacitor", "keypad"} <= set(device_facts())
