"""Templates that are merely found run only after `robosmi trust`; an output folder without a name is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robosmi.cli.main import main
from robosmi.errors import SourceError
from robosmi.generate import Gen


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "project"
    (folder / ".robosmi" / "templates").mkdir(parents=True)
    (folder / ".robosmi" / "templates" / "own.j2").write_text("hello")
    monkeypatch.chdir(folder)
    return folder


def test_found_templates_run_only_while_they_are_as_they_were_trusted(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SourceError, match="not trusted") as refused:
        Gen(project / "out").text("own.j2")
    assert refused.value.exit_code == 3
    assert "robosmi trust" in (refused.value.fix or "")
    assert main(["trust", str(project), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["result"]["trusted"] == ["templates/own.j2"]
    assert Gen(project / "out").text("own.j2") == "hello"
    (project / ".robosmi" / "templates" / "more.j2").write_text("more")
    with pytest.raises(SourceError, match="changed since"):
        Gen(project / "out").text("own.j2")


def test_a_template_folder_that_is_named_runs(project: Path) -> None:
    assert Gen(project / "out", project / ".robosmi" / "templates").text("own.j2") == "hello"


def test_trust_moves_with_nothing_and_follows_no_link(project: Path, tmp_path: Path) -> None:
    (project / ".robosmi" / "templates" / "link").symlink_to(tmp_path)
    assert main(["trust", str(project)]) == 3
    assert main(["trust", str(tmp_path)]) == 3


def test_a_command_that_needs_found_templates_exits_with_3(project: Path, examples: Path, tmp_path: Path) -> None:
    source = examples / "line_follower" / "line_follower.c"
    assert main(["migrate", str(source), "-o", str(tmp_path / "out"), "--json"]) == 3
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("words", [["migrate", "a.c"], ["generate", "plan.xmi"], ["metamodels", "generate", "a.ecore"]])
def test_an_output_folder_without_a_name_is_refused(words: list[str], project: Path) -> None:
    assert main([*words, "-o", ""]) == 2
