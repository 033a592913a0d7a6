"""How much a search may do: counted in what its runs do, so that the same seed finds the same whatever else this machine does.

What a run takes is estimated from what it records and from how long it simulates, with figures of a usual machine. The machine's
own clock is the outer limit only.
"""

from __future__ import annotations

from time import monotonic

from msgspec import Struct, field

from robosmi.verify.original_run import OriginalRun

_RUN_S = 0.02
"""To start a run and to ask which lines it has reached."""
_RECORD_S = 15e-6
_SIMULATED_PART = 0.002
"""Seconds for each simulated one, of a program that polls."""
_OUTER = 3.0
"""The clock's limit is so many times the budget: a busy machine takes longer."""


class SearchEffort(Struct):
    """What was done of what may be done.

    Attributes:
        budget_s: seconds of a usual machine.
        spent_s: how many of them are spent.
        begun_s: when the search began, by this machine's clock.
        given_up: whether nothing more is wanted.
    """

    budget_s: float
    spent_s: float = 0.0
    begun_s: float = field(default_factory=monotonic)
    given_up: bool = False

    def add(self, run: OriginalRun, times: int = 1) -> None:
        """Count a run, or several like it."""
        trace = run.trace
        records = len(trace.changes) + len(trace.waves) + len(trace.console) + len(trace.device_events)
        self.spent_s += times * (_RUN_S + _RECORD_S * records + _SIMULATED_PART * trace.simulated_us / 1e6)

    def is_over(self, share: float = 1.0) -> bool:
        """Whether a share of the budget is spent, or as much of the time that the clock allows."""
        return (
            self.given_up or self.spent_s >= share * self.budget_s or monotonic() - self.begun_s >= share * _OUTER * self.budget_s
        )
