"""Each device on both sides of a verification: a right migration has no difference there, and each wrong one has.

A case is a folder with a program, a scenario, and in `case.toml` the pins of its ports, the faults that are put into its sketch
(text there, text instead) and the channel on which something happens.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.transformations.chains.verify import verify
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE, Verdict
from tests.tiers import sample
from tests.tools import require_verification

CASES = sorted((Path(__file__).parent / "device_cases").iterdir())


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_verification("simavr")


@pytest.mark.parametrize("case", sample(CASES, 4), ids=[case.name for case in CASES])
def test_a_right_migration_has_no_difference_and_a_wrong_one_has(case: Path, tmp_path: Path) -> None:
    facts = migrated(case, tmp_path)
    right = judged(tmp_path, case)
    assert right.verdict == NO_DIFFERENCE, right.sentence()
    assert facts["channel"] in {channel["name"] for channel in right.channels() if channel["status"] == "same"}
    assert_different(facts["wrong"][:1], tmp_path, case)


@pytest.mark.exhaustive
@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_every_wrong_migration_has_a_difference(case: Path, tmp_path: Path) -> None:
    facts = migrated(case, tmp_path)
    assert_different(facts["wrong"][1:], tmp_path, case)


def migrated(case: Path, out: Path) -> dict[str, Any]:
    """Migrate the program of a case; returns what its `case.toml` says."""
    facts: dict[str, Any] = tomllib.loads((case / "case.toml").read_text())
    robosmi.migrate([case / "program.c"], out, bind=facts.get("bind", {}))
    return facts


def assert_different(faults: Sequence[tuple[str, str]], out: Path, case: Path) -> None:
    """Put each fault into the sketch alone, and see that it is found."""
    [sketch] = out.glob("*/*.ino")
    text = sketch.read_text()
    for old, new in faults:
        changed = re.sub(re.escape(old).replace(r"\ ", r"\s*"), new.replace("\\", r"\\"), text)
        assert changed != text, f"{old} is not in the sketch"
        sketch.write_text(changed)
        wrong = judged(out, case)
        assert wrong.verdict == DIFFERENT_VERDICT, f"{old} -> {new}: {wrong.sentence()}"


def judged(out: Path, case: Path) -> Verdict:
    """The verdict under the case's scenario."""
    return verify(out, scenarios=[case / "scenario.toml"]).verdict
