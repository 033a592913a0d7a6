"""The target's side of a verification: the migrated program on a simulator, in each scenario.

A simulator may crash, as libsimavr does if a program writes far beyond its memory. Then the next one that is installed runs the
scenario, unless the user has named one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from robosmi.errors import EngineCrashError, VerificationError
from robosmi.metamodels import platform
from robosmi.transformations.verification.bound_devices.played_devices import brief_pins, played
from robosmi.transformations.verification.bound_devices.port_devices import VOLTAGES, BoundPort
from robosmi.transformations.verification.jobs import job, shows_console, store_bytes
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import DeviceUse, PinTrace, engines_for, simulate
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.processes import in_parallel

LIMIT_S = 60.0
"""Seconds of processor time for each run of the target, the nominal run of the source, and all its varied runs together."""
EMPTY_TRACE = PinTrace("", "crashed", 0.0, (), (), (), ())
"""The trace of a run of which no simulator has reported anything."""


class TargetSide:
    """The migrated program on its board.

    Attributes:
        board: the board.
        shows_console: whether what the program prints can be seen.
        store_bytes: the size of the board's own EEPROM, if simulators show it; 0 if not.
    """

    def __init__(
        self, board: platform.Board, report: CompileReport, ports: Sequence[BoundPort], wanted: str | None = None,
        whole: bool = False, source_mv: float = 0.0,
    ) -> None:  # fmt: skip
        """Find the engines.

        Args:
            board: the board.
            report: the result of compiling the program.
            ports: the ports.
            wanted: the engine that the user has named, or None.
            whole: whether all changes of the pins are recorded, of those too that no channel shows.
            source_mv: the supply of the source board, if parts that show a voltage are fed by their board; 0 if they show the
                same voltage on both.

        Raises:
            UsageError: no engine has that name, or none knows the board.
            MissingToolError: none that knows it is installed.
        """
        chip = board.microcontroller
        mcu = str(chip.name) if chip is not None else ""
        self.board = board
        self.shows_console = shows_console(mcu)
        self.store_bytes = store_bytes(mcu)
        self._report, self._ports = report, ports
        self._part = board.volts * 1000 / source_mv if source_mv else 1.0
        self._brief = [] if whole else brief_pins(ports, target=True)
        self._names = [each.name for each in engines_for(mcu, wanted)]
        self._used: set[int] = set()

    @property
    def engine(self) -> str:
        """The engine's name, with the names of those that ran where it crashed."""
        if not any(self._used):
            return self._names[0]
        instead = ", ".join(self._names[number] for number in sorted(self._used) if number)
        return f"{self._names[0]} ({instead} where {' and '.join(self._names[: max(self._used)])} crashed)"

    def run(self, scenarios: Sequence[Scenario]) -> Iterator[PinTrace | VerificationError]:
        """The trace of each scenario, or the error that prevented it: in order, as many in parallel as there are cores."""
        for outcome, engine in in_parallel(self._run, scenarios):
            if isinstance(outcome, PinTrace):
                self._used.add(engine)
            yield outcome

    def _run(self, scenario: Scenario) -> tuple[PinTrace | VerificationError, int]:
        """The outcome of a scenario, and the number of the engine that it is from: the first that does not crash, if any."""
        assert self._report.elf is not None
        devices = [_fed(use, self._part) for use in played(self._ports, scenario, target=True)]
        asked = job(self._report.elf, self._report.hex, self.board, scenario.horizon_ms * 1000, devices, self._brief)
        crash: VerificationError | None = None
        for number, name in enumerate(self._names):
            try:
                return simulate(asked, name), number
            except EngineCrashError as error:
                crash = crash or error
            except VerificationError as error:
                return crash or error, number
        assert crash is not None
        return crash, 0


def _fed(use: DeviceUse, part: float) -> DeviceUse:
    """A device that shows a part of its board's supply, on a board with so many times the supply of the source board."""
    if use.kind != VOLTAGES or part == 1.0:
        return use
    points = [[at_ms, None if value is None else value * part] for at_ms, value in use.settings["points"]]
    return replace(use, settings={**use.settings, "points": points})
