"""Chains of values in memory: what is done when another value is given, what is put in a step's place, what is wrong."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from robosmi.chain import Chain
from robosmi.chain.steps import Step, StepResult
from robosmi.errors import SourceError


class Counted:
    """A chain of four steps that notes which of them are done."""

    def __init__(self, folder: Path | None = None) -> None:
        self.done: list[str] = []
        self.chain = Chain(folder)
        self.chain.given("text", "limit")
        self.chain.call(self.words, makes="words", step="split the text")
        self.chain.call(self.short, makes="short")
        self.chain.call(self.count, makes="count")
        self.chain.call(self.report, makes="report")

    def words(self, text: str) -> list[str]:
        self.done.append("words")
        return text.split()

    def short(self, words: list[str], limit: int) -> list[str]:
        self.done.append("short")
        return [word for word in words if len(word) <= limit]

    def count(self, short: list[str]) -> int:
        self.done.append("count")
        return len(short)

    def report(self, count: int, words: list[str]) -> str:
        self.done.append("report")
        return f"{count} of {len(words)}"


def test_only_what_depends_on_a_value_is_done_again() -> None:
    counted = Counted()
    run = counted.chain.start(text="a bee sees a sea", limit=3)
    assert run.value("report") == "4 of 5"
    assert counted.done == ["words", "short", "count", "report"]
    assert run.value("report") == "4 of 5"
    run.give(limit=1)
    assert counted.done == ["words", "short", "count", "report"]  # nothing before it is asked for
    assert run.value("report") == "2 of 5"
    assert counted.done[4:] == ["short", "count", "report"]


def test_a_value_that_comes_out_the_same_changes_nothing_behind_it() -> None:
    counted = Counted()
    run = counted.chain.start(text="a bee sees a sea", limit=3)
    run.value("report")
    run.give(limit=2)
    run.value("report")
    counted.done.clear()
    run.give(limit=1)  # the same words are short enough
    assert run.value("report") == "2 of 5"
    assert counted.done == ["short"]
    counted.done.clear()
    run.give(limit=1, text="a bee sees a sea")
    assert run.value("report") == "2 of 5"
    assert counted.done == []


def test_what_is_not_needed_is_not_done() -> None:
    counted = Counted()
    run = counted.chain.start(text="a b")
    assert run.value("words") == ["a", "b"]
    assert counted.done == ["words"]
    with pytest.raises(SourceError, match="the value 'limit' was not given"):
        run.value("count")


def test_a_step_that_fails_is_done_again_with_another_value() -> None:
    chain = Chain(None)
    chain.given("number")
    chain.call(lambda number: 1 / number, makes="inverse")
    run = chain.start(number=0)
    with pytest.raises(ZeroDivisionError):
        run.value("inverse")
    run.give(number=4)
    assert run.value("inverse") == 0.25


def test_another_function_stands_in_the_place_of_a_step() -> None:
    counted = Counted()
    counted.chain.replace("split the text", lambda text, limit: [text[:limit]])
    counted.chain.replace("count", lambda words: 100 * len(words))
    assert counted.chain.start(text="a bee", limit=3).value("report") == "100 of 1"
    with pytest.raises(SourceError, match="no step of values 'shorts' \\(did you mean 'short'"):
        counted.chain.replace("shorts", str)


def test_progress_is_told_of_every_step_that_is_done_and_of_no_other() -> None:
    told: list[tuple[str, str]] = []

    def progress(step: Step, result: StepResult | None) -> None:
        told.append((step.name, result.state if result is not None else "begins"))

    run = Counted().chain.start(text="a bee", limit=3, progress=progress)
    run.value("words")
    run.value("short")
    assert told == [("split the text", "begins"), ("split the text", "done"), ("short", "begins"), ("short", "done")]


def test_everything_is_done_by_run_and_has_a_state() -> None:
    counted = Counted()
    done = counted.chain.run(text="a bee", limit=3)
    assert [(r.step.name, r.state) for r in done.steps] == [
        ("split the text", "done"), ("short", "done"), ("count", "done"), ("report", "done"),
    ]  # fmt: skip


def test_values_and_files_go_together(tmp_path: Path) -> None:
    """A function over a model that a file holds: in a second run it is done where it is needed, and the file's change counts."""
    (tmp_path / "prices.csv").write_text("name,price\nant,1\nbee,2\n")
    seen: list[Any] = []

    def total(prices: Any) -> int:
        seen.append(1)
        return sum(int(row.price) for row in prices.prices.all)

    def chain() -> Chain:
        made = Chain(tmp_path)
        made.load("prices", "prices.csv")
        made.call(total, makes="total")
        return made

    assert chain().start().value("total") == 3
    assert [r.state for r in chain().run().steps] == ["up to date", "up to date"]
    assert chain().start().value("total") == 3  # not remembered beyond a run: made where it is needed
    (tmp_path / "prices.csv").write_text("name,price\nant,1\nbee,4\n")
    assert chain().start().value("total") == 5


def test_what_is_wrong_with_a_chain_of_values_is_said() -> None:
    chain = Chain(None)
    chain.given("a")
    chain.call(lambda a, b: (a, b), makes="c")
    with pytest.raises(SourceError, match="'c' uses the model 'b', which no step makes"):
        chain.start(a=1)
    chain.call(lambda c: c, makes="b")
    with pytest.raises(SourceError, match=r"goes in a circle: .*step c"):
        chain.start(a=1)
    with pytest.raises(SourceError, match="the chain has no folder"):
        chain.load("x", "x.xmi")
    counted = Counted()
    with pytest.raises(SourceError, match="asks for no value 'texts' \\(did you mean 'text'"):
        counted.chain.start(texts="a")
    with pytest.raises(SourceError, match="asks for no value 'words'"):  # a step makes it
        counted.chain.start(words=["a"])
    with pytest.raises(SourceError, match="no step makes 'reprt'"):
        counted.chain.start(text="a", limit=1).value("reprt")


def test_a_chain_of_functions_loads_no_language_and_no_graph_library() -> None:
    code = (
        "import sys; from robosmi.chain import Chain; c = Chain(None); c.given('a'); c.call(lambda a: a + 1, makes='b');"
        "assert c.start(a=1).value('b') == 2;"
        "print([m for m in ('networkx', 'jinja2', 'robosmi.transform', 'robosmi.validate') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
