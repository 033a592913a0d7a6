"""The prompt for open choices: what is shown, what is answered, and that the answer is remembered."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from robosmi.cli.asking import ask_libraries, may_ask
from robosmi.plugins import content
from robosmi.project import defaults
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
    assert "there is no number 3" in out.getvalue()


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
    asked: list[str] = []

    def ask(choices: Sequence[Mapping[str, Any]]) -> dict[str, str]:
        asked.extend(str(choice["component"]) for choice in choices)
        assert all(len(choice["candidates"]) >= 5 for choice in choices)
        return {f"#{choice['component_model_index']}": "HIH4030" for choice in choices if "HIH" in str(choice["component"])}

    made = content("chain", "migrate")([line_follower], tmp_path / "out", ask=ask)
    assert set(asked) == {"HIH4030 1", "HIH4030 2", "Red (633nm)-LED1"}
    by = {c.component.title: (c.chosenBy.name, c.choice, c.open) for c in made.models.plan.libraryChoices}
    assert by["HIH4030 1"] == ("person", "HIH4030", False)
    assert by["Red (633nm)-LED1"] == ("nobody", "", True)
    remembered = [entry for entry in History().entries() if entry.library == "HIH4030"]
    assert [(entry.count, entry.target) for entry in remembered] == [(2, "uno")]
