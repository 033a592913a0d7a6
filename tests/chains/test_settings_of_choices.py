"""What becomes of a choice where the project file is a link, read-only, not to be read, or not there: nothing is half-written."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from robosmi.cli.commands.migrate import Answers
from robosmi.generate.undo import undo
from robosmi.plugins import content
from robosmi.transformations.chains.page import PlanPage
from robosmi.transformations.chains.stages.models import load_models
from tests.chains.conftest import SETTINGS
from tests.running import run, tree


def in_plan(robot: Path) -> tuple[str, str]:
    """The plan's choice for the port, and who made it."""
    (binding,) = load_models(robot / "out" / "models" / "plan.xmi").plan.portBindings
    return str(binding.choice), str(binding.chosenBy.name)


def test_a_linked_project_file_is_written_through_and_stays_a_link(robot: Path, tmp_path: Path) -> None:
    shared = tmp_path / "shared.toml"
    project = robot / "robosmi.toml"
    project.rename(shared)
    project.symlink_to("../shared.toml")
    outcome = run("choose", robot / "out", "eye=D9", "--json")
    assert outcome.code == 0, outcome.err
    assert "RS415" not in outcome.rules()
    assert project.is_symlink()
    assert shared.read_text() == f'{SETTINGS}\n[bind]\neye = "D9"\n'
    assert in_plan(robot) == ("D9", "person")
    assert str(shared) in undo(robot / "out").restored
    assert project.is_symlink()
    assert shared.read_text() == SETTINGS
    assert sorted(path.name for path in tmp_path.iterdir()) == ["robot", "shared.toml"]


def test_the_file_that_a_linked_project_file_leads_to_is_named(robot: Path, tmp_path: Path) -> None:
    """Who looks for the value has to know which file has changed."""
    project = robot / "robosmi.toml"
    told = f"{project} (a link to {tmp_path / 'shared.toml'})"
    assert str(tmp_path / "shared.toml") not in run("choose", robot / "out", "eye=D8").out
    project.rename(tmp_path / "shared.toml")
    project.symlink_to("../shared.toml")
    assert told in run("choose", robot / "out", "eye=D9").out
    page = PlanPage(robot / "out")
    page.document(live=True, nonce="x")
    assert told in page.act("choose", {"id": "port:eye", "value": "D7", "plan": page.plan})["message"]
    said = io.StringIO()
    answers = Answers(lambda _: "y", said)
    answers.said["bind"] = {"ear": "D4"}
    assert list(answers.offer(robot)) == [tmp_path / "shared.toml"]
    assert told in said.getvalue()


@pytest.mark.parametrize("what", ["the file", "its folder"])
def test_where_it_is_read_only_the_choice_stays_in_the_plan_and_that_is_said(
    what: str, robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = robot / "robosmi.toml"
    project.write_text(f'{SETTINGS}[bind]\neye = "D4"\n')
    if what == "the file":
        project.chmod(0o444)
    else:  # root may write into any folder, so that the system is not asked
        monkeypatch.setattr(
            "robosmi.generate.project_entries.os.access", lambda path, _, **more: bool(more) or Path(path) != robot
        )
    outcome = run("choose", robot / "out", "eye=D9", "--json")
    assert outcome.code == 0, outcome.err
    (said,) = [f for f in outcome.document["findings"] if f["rule"] == "RS415"]
    assert f'{project if what == "the file" else robot} is read-only, and says eye = "D4", which counts' in said["message"]
    assert said["fix"].startswith("make it writable and choose again")
    assert outcome.result["project_file"] is None
    page = PlanPage(robot / "out")
    page.document(live=True, nonce="x")
    told = page.act("choose", {"id": "port:eye", "value": "D10", "plan": page.plan})
    assert told["state"] == "saved"
    assert "only in the plan" in told["message"]
    assert in_plan(robot) == ("D10", "person")
    assert project.read_text() == f'{SETTINGS}[bind]\neye = "D4"\n'


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[bind\n", "line 1"),
        ("[binds]\n", "'binds' is no table"),
        ('bind = "D9"\n', "[bind]"),
        ("[bind]\neye = 3\n", "[bind] must hold texts only, and 'eye' is none"),
        ("\xff", "cannot be read"),
    ],
)
def test_one_that_means_nothing_stops_before_anything_is_written(text: str, said: str, robot: Path) -> None:
    (robot / "robosmi.toml").write_bytes(text.encode("latin-1"))
    before = tree(robot)
    page = PlanPage(robot / "out")
    page.document(live=True, nonce="x")
    told = page.act("choose", {"id": "port:eye", "value": "D9", "plan": page.plan})
    assert (told["state"], said in told["message"]) == ("refused", True)
    words: list[list[str | Path]] = [["choose", robot / "out", "eye=D9"], ["migrate", robot / "blink.c", "-o", robot / "out"]]
    for command in words:
        outcome = run(*command)
        assert outcome.code == 3
        assert said in outcome.err
    assert tree(robot) == before


def test_a_link_that_leads_nowhere_stops_before_anything_is_written(robot: Path) -> None:
    (robot / "robosmi.toml").unlink()
    (robot / "robosmi.toml").symlink_to("gone.toml")
    before = tree(robot / "out")
    outcome = run("choose", robot / "out", "eye=D9")
    assert outcome.code == 3
    assert "a link to a file that is not there" in outcome.err
    assert tree(robot / "out") == before
    assert not (robot / "gone.toml").exists()


def test_the_mode_and_the_line_ends_of_the_file_stay(robot: Path) -> None:
    project = robot / "robosmi.toml"
    project.write_bytes(SETTINGS.replace("\n", "\r\n").encode())
    project.chmod(0o640)
    assert run("choose", robot / "out", "eye=D9").code == 0
    assert project.stat().st_mode & 0o777 == 0o640
    assert project.read_bytes() == f'{SETTINGS}\n[bind]\neye = "D9"\n'.replace("\n", "\r\n").encode()


@pytest.mark.parametrize("kept", ["y", ""])
def test_what_is_answered_at_a_prompt_is_written_with_the_plan_and_undone_with_it(kept: str, robot: Path) -> None:
    replies = iter(["D9", kept])
    answers = Answers(answer=lambda _: next(replies), out=io.StringIO())
    before = tree(robot)
    content("chain", "migrate")([robot / "blink.c"], robot / "out", ask_ports=answers.ports, outside=lambda: answers.offer(robot))
    assert in_plan(robot) == ("D9", "person")
    assert ('eye = "D9"' in (robot / "robosmi.toml").read_text()) == (kept == "y")
    undo(robot / "out")
    assert tree(robot) == before


def test_a_prompt_does_not_offer_what_cannot_be_kept(robot: Path) -> None:
    (robot / "robosmi.toml").chmod(0o444)
    out = io.StringIO()
    replies = iter(["D9"])
    answers = Answers(answer=lambda _: next(replies), out=out)
    content("chain", "migrate")([robot / "blink.c"], robot / "out", ask_ports=answers.ports, outside=lambda: answers.offer(robot))
    assert "saved only in the plan" in out.getvalue()
    assert in_plan(robot) == ("D9", "person")
