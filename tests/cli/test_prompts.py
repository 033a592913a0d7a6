"""The prompt for open choices: what is shown, what is answered, and that the answer is remembered."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from robosmi.cli.commands.migrate import Answers, ask_libraries, ask_ports, may_ask
from robosmi.errors import SourceError
from robosmi.generate.project_entries import added_to_project, with_entries
from robosmi.plugins import content
from robosmi.project import defaults, load_project
from robosmi.recommend.history import History

CHOICE = {
    "component": "Servo1", "component_model_index": "4",
    "candidates": [{"library": "Servo", "reasons": ["usual"]}, {"library": "ServoEasing", "reasons": ["words"]}],
}  # fmt: skip


@pytest.mark.parametrize(
    ("answer", "said"),
    [("1", {"#4": "Servo"}), ("2", {"#4": "ServoEasing"}), ("0", {"#4": "none"}), ("", {}), (" U8g2 ", {"#4": "U8g2"})],
)
def test_answers(answer: str, said: Mapping[str, str]) -> None:
    out = io.StringIO()
    assert ask_libraries([CHOICE], answer=lambda _: answer, out=out) == said
    assert "Which library drives 'Servo1'?" in out.getvalue()
    assert "1  Servo: usual" in out.getvalue()


def test_a_number_that_is_not_listed_is_asked_again() -> None:
    answers, out = iter(["3", "2"]), io.StringIO()
    assert ask_libraries([CHOICE], answer=lambda _: next(answers), out=out) == {"#4": "ServoEasing"}
    assert "no number 3" in out.getvalue()


def test_the_end_of_input_leaves_the_rest_open() -> None:
    answers: Iterator[str] = iter(["1"])

    def end(_: str) -> str:
        try:
            return next(answers)
        except StopIteration:
            raise EOFError from None

    second = {**CHOICE, "component_model_index": "5"}
    assert ask_libraries([CHOICE, second], answer=end, out=io.StringIO()) == {"#4": "Servo"}


def test_nobody_is_asked_without_a_terminal() -> None:
    assert not may_ask(yes=False, as_json=False), "the tests' own streams are no terminal"


def test_an_answer_is_a_persons_choice_and_is_remembered(
    line_follower: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(defaults()["choices"], "limit", 1.01)  # nothing is sure enough
    line_follower.write_text(line_follower.read_text() + "\nvoid more() { other_light(); }\n")
    asked: list[str] = []

    def ask(choices: Sequence[Mapping[str, Any]]) -> dict[str, str]:
        asked.extend(str(choice["component"]) for choice in choices)
        assert all(len(choice["candidates"]) >= 5 for choice in choices)
        return {f"#{choice['component_model_index']}": choice["candidates"][1]["library"] for choice in choices}

    made = content("chain", "migrate")([line_follower], tmp_path / "out", ask=ask)
    assert asked == ["Red (633nm)-LED1"], "other_light() has no body yet; what rc_time reads needs no library"
    by = {c.component.title: (c.chosenBy.name, c.choice, c.open) for c in made.models.plan.libraryChoices}
    person, library, is_open = by["Red (633nm)-LED1"]
    assert (person, is_open) == ("person", False)
    assert by["HIH4030 1"] == ("rule", "none", False)
    remembered = [entry for entry in History().entries() if entry.library == library]
    assert [(entry.count, entry.target) for entry in remembered] == [(1, "uno")]


PORT = {"name": "LED", "names": ["P26"], "options": [{"label": "LedWriteP1", "reasons": ["both names contain 'led'"]}]}
PINS = ["D8", "D13", "LedWriteP1"]


@pytest.mark.parametrize(
    ("answer", "said"),
    [("1", {"LED": "LedWriteP1"}), ("0", {"LED": "none"}), ("none", {"LED": "none"}), ("", {}), (" D13 ", {"LED": "D13"})],
)
def test_a_port_is_asked_for(answer: str, said: Mapping[str, str]) -> None:
    out = io.StringIO()
    assert ask_ports([PORT], PINS, answer=lambda _: answer, out=out) == said
    assert "Which pin is port 'LED' (P26) on?" in out.getvalue()
    assert "1  LedWriteP1: " in out.getvalue()


def test_a_pin_that_is_not_there_is_asked_for_again() -> None:
    answers, out = iter(["D77", "4", "D8"]), io.StringIO()
    assert ask_ports([PORT], PINS, answer=lambda _: next(answers), out=out) == {"LED": "D8"}
    assert "the board has no pin D77" in out.getvalue()
    assert "no number 4" in out.getvalue()


def test_answers_for_ports_are_taken_and_kept_in_the_project_file(line_follower: Path, tmp_path: Path) -> None:
    project = line_follower.parent / "robosmi.toml"
    text = project.read_text()
    project.write_text(text.replace('leftQTI = "D10"\n', ""))
    replies = iter(["D10", "y"])
    answers = Answers(answer=lambda _: next(replies), out=io.StringIO())
    made = content("chain", "migrate")(
        [line_follower], tmp_path / "out", ask_ports=answers.ports, outside=lambda: answers.offer(line_follower.parent)
    )
    assert {b.name: b.choice for b in made.models.plan.portBindings}["leftQTI"] == "HIH40302ReadP1"
    kept = project.read_text()
    assert load_project(project.parent).bind["leftQTI"] == "D10"
    assert [line for line in text.splitlines() if "#" in line] == [line for line in kept.splitlines() if "#" in line]


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("", '[bind]\nLED = "D8"\n"rows[2]" = "none"\n'),
        ("# mine\n", '# mine\n\n[bind]\nLED = "D8"\n"rows[2]" = "none"\n'),
        ('[bind] # here\na = "D1"\n\n[roles]\nU1 = "Input"', None),
        ('[bind]\na = "D1"\n', '[bind]\na = "D1"\nLED = "D8"\n"rows[2]" = "none"\n'),
        ('[bind]\r\na = "D1"\r\n', '[bind]\r\na = "D1"\r\nLED = "D8"\r\n"rows[2]" = "none"\r\n'),
    ],
)
def test_entries_come_to_the_end_of_their_table(text: str, kept: str | None) -> None:
    made = with_entries(text, "bind", {"LED": "D8", "rows[2]": "none"})
    expected = '[bind] # here\na = "D1"\nLED = "D8"\n"rows[2]" = "none"\n\n[roles]\nU1 = "Input"\n'
    assert made == (kept if kept is not None else expected)


@pytest.mark.parametrize("text", ["bind = 3\n", "[bind\n", '[[bind]]\na = "D1"\n'])
def test_a_file_in_which_entries_would_change_others_stays_as_it_is(text: str, tmp_path: Path) -> None:
    path = tmp_path / "robosmi.toml"
    path.write_text(text)
    with pytest.raises(SourceError):
        added_to_project(tmp_path, {"bind": {"LED": "D8"}})
    assert path.read_text() == text


@pytest.mark.parametrize(
    ("text", "made"),
    [
        ('bind = { a = "D1" } # one line\n', 'bind = { a = "D1", LED = "D8"} # one line\n'),
        ('[libraries]\nx = """\n[bind]\n"""\n', '[libraries]\nx = """\n[bind]\n"""\n\n[bind]\nLED = "D8"\n'),
        ('[bind]\nLED = "D1"\n', '[bind]\nLED = "D1"\n'),
    ],
)
def test_entries_are_added_in_whatever_form_the_table_has(text: str, made: str, tmp_path: Path) -> None:
    (tmp_path / "robosmi.toml").write_text(text)
    files = added_to_project(tmp_path, {"bind": {"LED": "D8"}}).files
    new = dict(files).get(tmp_path / "robosmi.toml", (b"", text.encode()))[1]
    assert new == made.encode()


def test_a_role_of_a_library_is_set_where_toml_takes_it_for_a_table() -> None:
    text = '[bind]\ndrive.left = "D1"  # measured\n'
    assert with_entries(text, "bind", {"drive.left": "D2"}) == '[bind]\ndrive.left = "D2"  # measured\n'
    assert with_entries(text, "bind", {"drive.left": None, "LED": "D8"}) == '[bind]\nLED = "D8"\n'
