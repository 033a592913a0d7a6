"""Tells at the end of a run how many processor seconds it took, and which tests took most (plug-in for conftest.py).

Seconds of the processor, not of the clock: other work on the machine adds none. They are those of the processes that run tests,
with all programs that these started and waited for; EMF's judge tells its own.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from heapq import nlargest
from typing import Any

import pytest

from robosmi.verify.toolchains.processor_time import used_s

_DEAREST, _DEAR = 5, 1.0
"""So many tests are named, if they took more seconds than this."""
_KEY = "processor_seconds"


class ProcessorSeconds:
    """The plug-in.

    Attributes:
        tier: the tier that runs.
        seconds: of each test; the cases of a parametrised one together.
        total: of the whole run.
        tests: how many tests ran.
        starts: whether this process had its tests run by others, which tell their own seconds.
    """

    def __init__(self, tier: str) -> None:
        self.tier = tier
        self.seconds: dict[str, float] = {}
        self.total = 0.0
        self.tests = 0
        self.starts = False

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Measure a test with its fixtures."""
        begun = used_s()
        try:
            return (yield)
        finally:
            self._add(item.nodeid.partition("[")[0], used_s() - begun)
            self.tests += 1

    def _add(self, name: str, seconds: float) -> None:
        self.seconds[name] = self.seconds.get(name, 0.0) + seconds

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Hand over what a process of pytest-xdist has measured; the one that started it adds its own time."""
        self.total += sum(os.times()[:2]) if self.starts else used_s()
        output = getattr(session.config, "workeroutput", None)
        if output is not None:
            output[_KEY] = {"seconds": self.seconds, "total": self.total, "tests": self.tests}

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """Add what a process of pytest-xdist has measured; one that crashed has told nothing."""
        self.starts = True
        told = getattr(node, "workeroutput", {}).get(_KEY)
        if told is not None:
            for name, seconds in told["seconds"].items():
                self._add(name, seconds)
            self.total += told["total"]
            self.tests += told["tests"]

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Print the sum, and the tests that took most."""
        if not self.tests:
            return
        terminalreporter.write_line(f"{self.total:,.0f} processor seconds for {self.tests:,} tests of the tier {self.tier}")
        for name, seconds in nlargest(_DEAREST, self.seconds.items(), key=lambda each: each[1]):
            if seconds > _DEAR:
                terminalreporter.write_line(f"  {seconds:6.1f} {name}")
