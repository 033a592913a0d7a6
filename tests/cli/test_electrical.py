"""Electrical findings on the command line: exit codes, severities and accepted findings of robosmi.toml, in three commands."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.running import run

EXAMPLES = Path(__file__).parents[1] / "transformations" / "constraints"


@pytest.fixture
def motor(tmp_path: Path) -> Path:
    """A drawing with a motor on a pin, in a folder of its own."""
    return Path(shutil.copy(EXAMPLES / "drawings" / "RS251_fails.fz", tmp_path))


@pytest.mark.parametrize("command", ["hardware", "check"])
def test_an_error_in_the_wiring_is_exit_1(command: str, motor: Path) -> None:
    outcome = run(command, motor, "--json")
    assert outcome.code == 1
    assert outcome.rules() == {"RS251"}


@pytest.mark.parametrize("command", ["hardware", "check"])
@pytest.mark.parametrize("element", ["Motor", "#1", "*"])
def test_it_can_be_accepted_by_the_component_s_title_or_index(command: str, element: str, motor: Path) -> None:
    toml = f'[[accept]]\nrule = "RS251"\nelement = "{element}"\nreason = "it is a tiny one"\n'
    (motor.parent / "robosmi.toml").write_text(toml, encoding="utf-8")
    outcome = run(command, motor, "--json")
    assert outcome.code == 0
    (finding,) = outcome.document["findings"]
    assert (finding["severity"], finding["evidence"]["accepted"]) == ("info", "it is a tiny one")


def test_what_is_accepted_for_another_component_is_not_accepted(motor: Path) -> None:
    toml = '[[accept]]\nrule = "RS251"\nelement = "Uno"\nreason = "none"\n'
    (motor.parent / "robosmi.toml").write_text(toml, encoding="utf-8")
    outcome = run("hardware", motor, "--json")
    assert outcome.code == 1
    told = [finding for finding in outcome.document["findings"] if finding["rule"] == "RS911"]
    assert [finding["message"] for finding in told] == ["[[accept]] of RS251 names 'Uno', but none of its findings is about that"]
    named = told[0]["fix"].removeprefix("name one of: ").split(", ")
    assert named[-1] == "*"
    (motor.parent / "robosmi.toml").write_text(toml.replace("Uno", named[0]), encoding="utf-8")
    assert run("hardware", motor).code == 0


@pytest.mark.parametrize(("level", "code"), [("off", 0), ("warning", 0), ("error", 1)])
def test_its_severity_can_be_set(level: str, code: int, motor: Path) -> None:
    (motor.parent / "robosmi.toml").write_text(f'[severity]\nRS251 = "{level}"\n', encoding="utf-8")
    assert run("hardware", motor).code == code


def test_migrate_tells_and_accepts_the_same(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(EXAMPLES / "plans" / "RS260_fails", tmp_path / "in"))
    out = tmp_path / "out"
    options = ("--hardware", folder / "wiring.csv", "--json", "--yes")
    outcome = run("migrate", folder / "robot.c", "-o", out, *options)
    assert outcome.code == 1
    assert "RS260" in outcome.rules()
    assert "RS260" in run("check", out / "models" / "plan.xmi", "--json").rules()
    with (folder / "robosmi.toml").open("a", encoding="utf-8") as project:
        project.write('\n[[accept]]\nrule = "RS260"\nelement = "Warmth"\nreason = "its output bears it"\n')
    again = run("migrate", folder / "robot.c", "-o", out, *options)
    assert again.code == 0
    accepted = [f for f in again.document["findings"] if f["rule"] == "RS260"]
    assert [f["evidence"]["accepted"] for f in accepted] == ["its output bears it"]


def test_both_case_studies_have_warnings_and_exit_0(case_study: Path) -> None:
    drawing = next(case_study.parent.glob("*.fzz"))
    outcome = run("hardware", drawing, "--json")
    assert outcome.code == 0
    assert {f["severity"] for f in outcome.document["findings"]} == {"warning"}
    assert "RS250" in outcome.rules()
