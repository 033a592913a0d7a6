"""The target's side of a verification: the migrated program on a simulator, in each scenario.

A simulator may crash, as libsimavr does if a program writes far beyond its memory. Then the next one that is installed runs the
scenario, unless the user has named one.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor

from robosmi.errors import EngineCrashError, VerificationError
from robosmi.metamodels import platform
from robosmi.transformations.verification.jobs import job, shows_console
from robosmi.transformations.verification.played_devices import brief_pins, played
from robosmi.transformations.verification.port_devices import BoundPort
from robosmi.verify.compile_report import CompileReport
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace, end_simulations, engines_for, simulate

LIMIT_S = 60.0
"""Seconds of processor time for each run of the target, the nominal run of the source, and all its varied runs together."""
NOTHING_SEEN = PinTrace("", "crashed", 0.0, (), (), (), ())
"""The trace of a run of which no simulator has reported anything."""


class TargetSide:
    """The migrated program on its board.

    Attributes:
        board: the board.
        shows_console: whether what the program prints can be seen.
    """

    def __init__(
        self, board: platform.Board, report: CompileReport, ports: Sequence[BoundPort], wanted: str | None = None,
        whole: bool = False,
    ) -> None:  # fmt: skip
        """Find the engines.

        Args:
            board: the board.
            report: the result of compiling the program.
            ports: the ports.
            wanted: the engine that the user has named, or None.
            whole: whether all changes of the pins are recorded, of those too that no channel shows.

        Raises:
            UsageError: no engine has that name, or none knows the board.
            MissingToolError: none that knows it is installed.
        """
        chip = board.microcontroller
        mcu = str(chip.name) if chip is not None else ""
        self.board = board
        self.shows_console = shows_console(mcu)
        self._report, self._ports = report, ports
        self._brief = [] if whole else brief_pins(ports, target=True)
        self._names = [each.name for each in engines_for(mcu, wanted)]
        self._crashed: set[str] = set()
        self._instead: set[str] = set()
        self._over = False

    @property
    def engine(self) -> str:
        """The engine's name, with the names of those that ran where it crashed."""
        if not self._instead:
            return self._names[0]
        instead = ", ".join(name for name in self._names if name in self._instead)
        return f"{self._names[0]} ({instead} where {' and '.join(n for n in self._names if n in self._crashed)} crashed)"

    def run(self, scenarios: Sequence[Scenario]) -> Iterator[PinTrace | VerificationError]:
        """The trace of each scenario, or the error that prevented it: in order, as many in parallel as there are cores."""
        cores = os.cpu_count() or 1
        pool = ThreadPoolExecutor(cores)
        waiting: deque[Future[PinTrace | VerificationError]] = deque()
        try:
            for scenario in scenarios:
                waiting.append(pool.submit(self._run, scenario))
                if len(waiting) > cores:  # one more than cores, so that none of them idles during a comparison
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        except BaseException:  # also an interruption: the other runs are not needed then
            self._over = True
            end_simulations()
            raise
        finally:
            pool.shutdown(cancel_futures=True)

    def _run(self, scenario: Scenario) -> PinTrace | VerificationError:
        assert self._report.elf is not None
        assert self._report.hex is not None
        devices = played(self._ports, scenario, target=True)
        asked = job(self._report.elf, self._report.hex, self.board, scenario.horizon_ms * 1000, devices, self._brief)
        crash: VerificationError | None = None
        for name in self._names:
            try:
                trace = simulate(asked, name, LIMIT_S)
            except EngineCrashError as error:
                crash = crash or error
                if self._over:
                    break
                self._crashed.add(name)
            except VerificationError as error:
                return crash or error
            else:
                if crash is not None:
                    self._instead.add(name)
                return trace
        assert crash is not None
        return crash
