"""What a program leaves behind in the EEPROM is compared nowhere, and the verdict says so."""

from __future__ import annotations

import re
from pathlib import Path

import robosmi
from robosmi.transformations.chains.verify import verify
from robosmi.verify.host_model import load_host_model
from tests.tools import require_verification

PROGRAM = Path(__file__).parent / "stored" / "eep.c"


def test_each_function_that_stores_is_one_of_the_platform() -> None:
    model = load_host_model("propeller")
    declared = {name for folder in model.headers for path in folder.rglob("*.h") for name in re.findall(r"\w+", path.read_text())}
    assert model.stored
    assert {name for names in model.stored.values() for name in names} <= declared


def test_the_verdict_lists_what_is_stored_as_not_compared(tmp_path: Path) -> None:
    require_verification()
    robosmi.migrate([PROGRAM], tmp_path / "out", bind={"P2": "D4", "P3": "D9"})
    assert "what the program stores in the EEPROM" in verify(tmp_path / "out", generate=False).verdict.not_compared
