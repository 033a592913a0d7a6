"""Progress on the terminal: silent at first and in a pipe, one line that is wiped, and nothing over a prompt."""

from __future__ import annotations

import io
import sys
import time

import pytest

from robosmi.base.progress_events import announce, remark
from robosmi.chain import Chain
from robosmi.cli import progress as module
from robosmi.cli.main import main
from robosmi.report import Report


class Terminal(io.StringIO):
    """A standard error that is a terminal."""

    def isatty(self) -> bool:
        return True


def slow(seconds: float) -> Chain:
    """Two steps, the second of which takes that long."""
    chain = Chain(None)
    chain.call(lambda: 1, makes="one", step="first step")

    def second(one: int) -> int:
        time.sleep(seconds)
        return one

    chain.call(second, makes="two", step="second step")
    return chain


def test_in_a_pipe_nothing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with module.progress() as told:
        assert told is None


def test_a_short_command_says_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    with module.progress() as told:
        assert slow(0.0).start(progress=told).value("two") == 1
    assert terminal.getvalue() == ""


def test_a_long_one_shows_its_step_and_wipes_the_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    monkeypatch.setattr(module, "QUIET", 0.02)
    with module.progress() as told:
        slow(0.3).start(progress=told).value("two")
        shown = terminal.getvalue()
        time.sleep(0.05)  # a person is asked something: nothing is written over it
        assert terminal.getvalue() == shown
    assert shown == "\r\x1b[Ksecond step ...\r\x1b[K"
    assert terminal.getvalue() == shown


def test_an_error_leaves_no_line_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    monkeypatch.setattr(module, "QUIET", 0.02)
    chain = Chain(None)

    def divide() -> float:
        time.sleep(0.3)
        return 1 / 0

    chain.call(divide, makes="one", step="divide")
    with pytest.raises(ZeroDivisionError), module.progress() as told:
        chain.start(progress=told).value("one")
    assert terminal.getvalue() == "\r\x1b[Kdivide ...\r\x1b[K"


def test_what_is_said_within_a_command_is_shown_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    monkeypatch.setattr(module, "QUIET", 0.02)
    monkeypatch.setenv("COLUMNS", "40")
    with module.progress():
        time.sleep(0.1)
        announce("run scenario 3 of 12")
        announce(f"read \x1b[31m{'x' * 100}")
        with module.progress():
            time.sleep(0.1)
            announce("within")
    first, second, third = [line for line in terminal.getvalue().split("\r\x1b[K") if line]
    assert first == "run scenario 3 of 12 ..."
    assert len(second) <= 40
    assert "\x1b" not in second
    assert third == "within ..."
    assert terminal.getvalue().endswith("\r\x1b[K")


def test_what_nobody_hears_is_said_all_the_same() -> None:
    announce("nothing listens")
    remark("nothing listens")


def test_a_remark_stays_above_the_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    monkeypatch.setattr(module, "QUIET", 0.02)
    with module.progress():
        time.sleep(0.1)
        announce("search")
        remark("known\x1b[31m already")
    assert "\x1b[31m" not in terminal.getvalue()
    assert "\n" in terminal.getvalue()
    assert terminal.getvalue().endswith("search ...\r\x1b[K")


def test_in_a_log_a_long_command_has_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", log := io.StringIO())
    with module.progress():
        announce("something short")
        remark("a remark")
    assert log.getvalue() == "a remark\n"
    monkeypatch.setattr(module, "LONG", 0.0)
    with module.progress():
        announce("search")
        announce("compare")
    assert log.getvalue() == "a remark\nsearch ...\n"


def test_every_command_has_a_line_of_progress(monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[str] = []

    def slow(arguments: object) -> Report:
        announce("something long")
        return Report("explain")

    monkeypatch.setattr("robosmi.cli.commands.explain.run", slow)
    monkeypatch.setattr(module._Line, "said", lambda line, what: heard.append(what))
    monkeypatch.setattr(sys, "stderr", Terminal())
    assert main(["explain"]) == 0
    assert heard == ["something long"]
