"""What a search may do is counted by its runs, not by this machine's clock, which is the outer limit alone."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.search import search_effort
from robosmi.transformations.verification.search.search_effort import SearchEffort
from robosmi.verify.original import OriginalRun
from robosmi.verify.simulation import PinChange, PinTrace


def a_run(changes: int) -> OriginalRun:
    """One with so many changes at a pin, in six seconds."""
    trace = PinTrace("e", "running", 6e6, tuple(PinChange(float(at), "P3", at % 2) for at in range(changes)), (), (), ())
    return OriginalRun(trace, "running", "", b"")


def test_what_runs_record_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [0.0]
    monkeypatch.setattr(search_effort, "monotonic", lambda: clock[0])
    quick, busy = (SearchEffort(10.0, begun_s=0.0) for _ in range(2))
    quick.add(a_run(10), 3)
    busy.add(a_run(100_000), 3)
    assert quick.spent_s < busy.spent_s < 10.0
    clock[0] = 25.0  # a busy machine: the same is found
    assert not busy.is_over()
    assert busy.is_over(0.25)
    busy.add(a_run(100_000), 5)
    assert busy.is_over()
    assert not quick.is_over()
    assert not quick.late
    clock[0] = 30.0
    assert quick.is_over()
    assert quick.late


def test_a_search_that_is_given_up_is_over() -> None:
    effort = SearchEffort(240.0)
    assert not effort.is_over()
    effort.given_up = True
    assert effort.is_over()


def test_a_limit_by_the_clock_replaces_the_usual_one(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [0.0]
    monkeypatch.setattr(search_effort, "monotonic", lambda: clock[0])
    effort = SearchEffort(10.0, begun_s=0.0, clock_s=12.0)
    effort.add(a_run(10))
    clock[0] = 11.0
    assert not effort.is_over()
    assert not effort.cut
    assert effort.left_s == 1.0
    clock[0] = 12.0
    assert effort.is_over()
    assert effort.cut
    assert effort.left_s == 0.0
