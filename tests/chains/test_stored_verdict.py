"""Runs after a comparison: they report its verdict while the sketch is the same, and do not fail because of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.verification.judgement.stored_verdict import FILE, SCHEMA, StoredVerdict, sketch_digests
from tests.running import Outcome, run

PROGRAM = Path(__file__).parents[2] / "docs" / "examples" / "line_follower" / "line_follower.c"


@pytest.fixture(scope="module")
def migrated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp("migrated") / "out"
    assert run("migrate", PROGRAM, "-o", output).code == 0
    return output


def store(output: Path, rule: str) -> None:
    """Store a verdict on the sketch as it is, as `verify` does."""
    verdict = StoredVerdict(SCHEMA, sketch_digests(output), rule, "a verdict", "see: robosmi verify")
    (output / "models" / FILE).write_bytes(verdict.to_bytes())


def levels(outcome: Outcome, rule: str) -> list[str]:
    return [finding["severity"] for finding in outcome.document["findings"] if finding["rule"] == rule]


@pytest.mark.parametrize("rule", ["RS851", "RS853"])
@pytest.mark.parametrize("command", ["migrate", "generate"])
def test_a_verdict_of_an_earlier_run_is_a_warning_and_no_failure_of_this_one(command: str, rule: str, migrated: Path) -> None:
    store(migrated, rule)
    place = PROGRAM if command == "migrate" else migrated / "models" / "plan.xmi"
    outcome = run(command, place, "-o", migrated, "--json")
    assert levels(outcome, rule) == ["warning"]
    assert outcome.code == 0
    assert "a verdict" in (migrated / "line_follower" / "MIGRATION.md").read_text(encoding="utf-8")
    assert run(command, place, "-o", migrated, "--fail-on", "warning").code == 1


def test_a_verdict_on_another_sketch_is_not_reported(migrated: Path) -> None:
    store(migrated, "RS851")
    sketch = migrated / "line_follower" / "line_follower.ino"
    sketch.write_text(sketch.read_text(encoding="utf-8") + "\n// mine\n", encoding="utf-8")
    outcome = run("migrate", PROGRAM, "-o", migrated, "--json")
    assert levels(outcome, "RS851") == []
