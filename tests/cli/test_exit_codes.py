"""The exit codes of the contract, each by a run that ends with it, and the options that change them."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path
from typing import NoReturn

import pytest

from robosmi.cli.commands import doctor
from robosmi.cli.main import main
from robosmi.project import defaults
from tests.running import run, tree
from tests.tools import require_tools


def test_0_is_done(line_follower: Path) -> None:
    assert run("analyse", line_follower).code == 0


def test_1_is_done_with_a_finding_of_the_level(cases: Path) -> None:
    outcome = run("analyse", cases / "syntax.c", "--json")
    assert outcome.code == 1
    assert outcome.document["ok"] is True
    assert any(f["severity"] == "error" and f["location"]["line"] == 4 for f in outcome.document["findings"])


@pytest.mark.parametrize(("level", "code"), [("info", 1), ("warning", 1), ("error", 0), ("never", 0)])
def test_fail_on_sets_the_level(level: str, code: int, line_follower: Path, tmp_path: Path) -> None:
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--fail-on", level, "--json")
    assert {f["severity"] for f in outcome.document["findings"]} == {"info", "warning"}
    assert outcome.code == code


def test_fail_on_never_lets_errors_pass(cases: Path) -> None:
    assert run("analyse", cases / "syntax.c", "--fail-on", "never").code == 0


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["migrat"],
        ["migrate"],
        ["--unknown"],
        ["analyse"],
        ["recommend"],
        ["metamodels"],
        ["metamodels", "melt"],
        ["doctor", "--fail-on", "often"],
        ["doctor", "--nothing"],
    ],
)
def test_2_is_wrong_usage_and_says_what_to_do(words: list[str]) -> None:
    outcome = run(*words)
    assert (outcome.code, outcome.out) == (2, "")
    assert "\n  do: " in outcome.err


def test_an_unknown_command_is_answered_with_the_nearest() -> None:
    assert "did you mean 'migrate'?" in run("migrat").err


def test_an_unknown_command_is_a_document_under_json() -> None:
    outcome = run("migrat", "--json")
    assert outcome.code == 2
    assert outcome.rules() == {"RS901"}


def test_3_is_an_input_that_cannot_be_used(tmp_path: Path) -> None:
    assert run("hardware", tmp_path / "missing.fzz").code == 3


def test_4_is_a_missing_tool(migrated: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    monkeypatch.setenv("ROBOSMI_LIBRARIES", "")
    outcome = run("compile", migrated, "--json")
    assert outcome.code == 4
    assert outcome.rules() == {"RS904"}
    assert "install" in outcome.document["findings"][0]["fix"]


def test_5_is_an_open_choice_under_strict_and_writes_nothing(
    line_follower: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(defaults()["choices"], "limit", 1.01)  # no ranking is that sure
    before = tree(tmp_path)
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--strict")
    assert outcome.code == 5
    assert "open choices (1): LED" in outcome.err
    assert tree(tmp_path) == before


def test_strict_goes_on_when_everything_is_decided(line_follower: Path, tmp_path: Path) -> None:
    decided = ["--library", "HIH4030 1=none", "--library", "HIH4030 2=none", "--library", "Red (633nm)-LED1=none"]
    decided += ["--bind", "P14=D2", "--bind", "P15=D3"]
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--strict", "--json", *decided)
    assert outcome.code == 0
    assert outcome.result["plan"]["open_choices"] == 0


def test_6_is_a_sketch_that_does_not_compile(migrated: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    sketch = migrated / "line_follower" / "line_follower.ino"
    sketch.write_text(sketch.read_text().replace("void setup() {", "void setup() { no_such_thing();"))
    outcome = run("compile", migrated, "--json")
    assert outcome.code == 6
    assert outcome.document["ok"] is False
    assert outcome.result["ok"] is False
    assert any("no_such_thing" in f["message"] and f["location"]["line"] for f in outcome.document["findings"])


@pytest.mark.parametrize("error", [KeyError("nowhere"), SystemExit(0)])
def test_70_is_our_own_bug_without_a_traceback(
    error: BaseException, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(_: object) -> NoReturn:
        raise error

    monkeypatch.setattr(doctor, "run", broken)
    assert main(["doctor", "--json"]) == 70
    printed = capsys.readouterr()
    assert '"RS970"' in printed.out
    assert "Traceback" not in printed.err
    assert "please report it" in printed.err


def test_a_bug_shows_where_it_is_when_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_: object) -> NoReturn:
        raise KeyError("nowhere")

    monkeypatch.setattr(doctor, "run", broken)
    monkeypatch.setenv("ROBOSMI_DEBUG", "1")
    with pytest.raises(KeyError, match="nowhere"):
        main(["doctor"])


def test_130_is_an_interrupted_run(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: object) -> NoReturn:
        raise KeyboardInterrupt

    monkeypatch.setattr(doctor, "run", interrupted)
    outcome = run("doctor")
    assert (outcome.code, outcome.err) == (130, "robosmi: interrupted\n")


def test_a_reader_that_closes_the_pipe_is_no_error(line_follower: Path) -> None:
    command = f"'{sys.executable}' -m robosmi analyse '{line_follower}' --json | head -c 10; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("{")


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["analyse", "line_follower.c", "--fail-on", "info"], 1),
        (["analyse", "line_follower.c", "--fail-on", "info", "--json"], 1),
        (["analyse", "--nothing", "--json"], 2),
        (["verify", ".", "--json"], 3),
        (["analyse", "--help"], 0),
    ],
)
def test_a_closed_pipe_keeps_the_exit_code(words: list[str], code: int, line_follower: Path) -> None:
    read, write = os.pipe()
    os.close(read)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "robosmi", *words], stdout=write, stderr=subprocess.PIPE, text=True, check=False,
            cwd=line_follower.parent,
        )  # fmt: skip
    finally:
        os.close(write)
    assert done.returncode == code
    assert "Traceback" not in done.stderr
    assert "ipe" not in done.stderr


def test_a_pipe_that_breaks_within_a_command_is_not_taken_for_success(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_: object) -> NoReturn:
        raise BrokenPipeError(errno.EPIPE, "Broken pipe")

    monkeypatch.setattr(doctor, "run", broken)
    outcome = run("doctor")
    assert outcome.code == 3
    assert "Broken pipe" in outcome.err


def test_dry_run_says_the_same_and_writes_nothing(line_follower: Path, tmp_path: Path) -> None:
    before = tree(tmp_path)
    dry = run("migrate", line_follower, "-o", tmp_path / "out", "--dry-run", "--json")
    assert dry.code == 0
    assert tree(tmp_path) == before
    assert dry.document["artifacts"] == []
    real = run("migrate", line_follower, "-o", tmp_path / "out", "--json")
    assert dry.result["plan"] == real.result["plan"]


def test_dry_run_of_generate_writes_nothing(migrated: Path, tmp_path: Path) -> None:
    before = tree(tmp_path)
    assert run("generate", migrated / "models" / "plan.xmi", "-o", tmp_path / "again", "--dry-run").code == 0
    assert tree(tmp_path) == before


def test_dry_run_stops_where_the_run_would_stop(migrated: Path, line_follower: Path) -> None:
    plan = migrated / "models" / "plan.xmi"
    plan.write_text(plan.read_text() + "\n")
    before = tree(migrated)
    assert run("migrate", line_follower, "-o", migrated, "--dry-run").code == 5
    assert tree(migrated) == before


def test_strict_of_generate_stops_at_an_open_choice(line_follower: Path, tmp_path: Path) -> None:
    (line_follower.parent / "robosmi.toml").unlink()
    migrated = tmp_path / "open"
    assert run("migrate", line_follower, "-o", migrated).code == 0
    outcome = run("generate", migrated / "models" / "plan.xmi", "-o", tmp_path / "again", "--strict")
    assert outcome.code == 5
    assert not (tmp_path / "again").exists()
