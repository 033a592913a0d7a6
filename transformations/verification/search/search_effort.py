"""The budget of a search, counted by what its runs do, so that the same seed finds the same scenarios on a busy machine.

The time of a run is estimated from the number of its records and from the simulated time, with figures of a typical machine.
The machine's own clock is only the outer limit, unless the user has set that one.
"""

from __future__ import annotations

from time import monotonic

from msgspec import Struct, field

from robosmi.verify.original import OriginalRun

_RUN_S = 0.02
"""Estimated seconds to start a run and to read its coverage."""
_RECORD_S = 15e-6
_OUTER = 3.0
"""The limit by the clock is this many times the budget, since a busy machine takes longer."""


class SearchEffort(Struct):
    """The budget of a search, and what is spent of it.

    Attributes:
        budget_s: the budget, in seconds of a typical machine.
        spent_s: the seconds spent, of a typical machine.
        begun_s: when the search began, by this machine's clock.
        given_up: whether the search ends before its budget does.
        late: whether the clock has ended the search or a part of it, so that another run may find something else.
        clock_s: the limit by the clock, in seconds; None for some times the budget.
        second_s: estimated seconds for each simulated one, of a polling program.
        cut: whether budget or clock have ended the search, or a part of it, though it had more to try.
    """

    budget_s: float
    spent_s: float = 0.0
    begun_s: float = field(default_factory=monotonic)
    given_up: bool = False
    late: bool = False
    clock_s: float | None = None
    cut: bool = False
    second_s: float = 0.002

    @property
    def elapsed_s(self) -> float:
        """Seconds since the search began, by this machine's clock."""
        return monotonic() - self.begun_s

    @property
    def _limit_s(self) -> float:
        return _OUTER * self.budget_s if self.clock_s is None else self.clock_s

    @property
    def left_s(self) -> float:
        """The most seconds that the search may still take: what is left by the clock, or of the budget at the present pace."""
        elapsed_s = self.elapsed_s
        pace = elapsed_s / self.spent_s if self.spent_s else 1.0
        return max(0.0, min(self._limit_s - elapsed_s, (self.budget_s - self.spent_s) * pace))

    def add(self, run: OriginalRun, times: int = 1) -> None:
        """Add the estimated time of a run, or of several like it."""
        trace = run.trace
        records = len(trace.changes) + len(trace.waves) + len(trace.console) + len(trace.device_events)
        self.spent_s += times * (_RUN_S + _RECORD_S * records + self.second_s * trace.simulated_us / 1e6)

    def is_over(self, share: float = 1.0) -> bool:
        """Whether a share of the budget is spent, or as large a share of the limit by the clock."""
        if self.given_up:
            return True
        over = self.spent_s >= share * self.budget_s
        if not over:
            over = self.elapsed_s >= share * self._limit_s
            self.late |= over
        self.cut |= over
        return over

    def has_spent(self, since_s: float, seconds: float) -> bool:
        """Whether a stage of the search has spent what it may.

        Args:
            since_s: what was spent when it began.
            seconds: of a usual machine.
        """
        return self.spent_s - since_s >= seconds or self.is_over()
