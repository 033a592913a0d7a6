"""Each device on both sides of a verification: a right migration has no difference there, and each wrong one has.

A case is a folder with a program, a scenario, and in `case.toml` the pins of its ports, the faults that are put into its sketch
(text there, text instead) and the channel on which something happens.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.transformations.chains.verify import verify
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE, Verdict
from tests.tools import require_verification

CASES = sorted((Path(__file__).parent / "device_cases").iterdir())


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_verification("simavr")


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_a_right_migration_has_no_difference_and_wrong_ones_have(case: Path, tmp_path: Path) -> None:
    facts: dict[str, Any] = tomllib.loads((case / "case.toml").read_text())
    robosmi.migrate([case / "program.c"], tmp_path, bind=facts.get("bind", {}))
    right = judged(tmp_path, case)
    assert right.verdict == NO_DIFFERENCE, right.sentence()
    assert facts["channel"] in {channel["name"] for channel in right.channels() if channel["status"] == "same"}
    [sketch] = tmp_path.glob("*/*.ino")
    text = sketch.read_text()
    for old, new in facts["wrong"]:
        changed = re.sub(re.escape(old).replace(r"\ ", r"\s*"), new.replace("\\", r"\\"), text)
        assert changed != text, f"{old} is not in the sketch"
        sketch.write_text(changed)
        wrong = judged(tmp_path, case)
        assert wrong.verdict == DIFFERENT_VERDICT, f"{old} -> {new}: {wrong.sentence()}"


def judged(out: Path, case: Path) -> Verdict:
    """The verdict under the case's scenario."""
    return verify(out, scenarios=[case / "scenario.toml"]).verdict
