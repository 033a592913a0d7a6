"""The engine `avr8js`: the simulator of that name (npm, MIT); an ATmega328P only. Its program is `avr8js_run.cjs`."""

from __future__ import annotations

import subprocess
from typing import Any

from robosmi import inputs
from robosmi.base.data_text import Json
from robosmi.errors import VerificationError
from robosmi.transformations.verification.engines.avr_timers import Timers
from robosmi.transformations.verification.engines.node_engine import NodeBench, NodeEngine
from robosmi.verify.simulation import Job, Wave


class _Run(NodeBench):
    """One program; the timers' waves follow from what it writes into their registers."""

    def __init__(self, process: subprocess.Popen[str], job: Job, title: str) -> None:
        super().__init__(process, job, title)
        self._timers = Timers(job.timers, job.pins, job.clock_hz, self.wave_changed)

    @staticmethod
    def ticks_hz(job: Job) -> int:
        """Cycles of the processor."""
        return job.clock_hz

    def question(self) -> dict[str, Json]:
        """The program in Intel HEX, and the registers whose writes are to be reported.

        Raises:
            VerificationError: the program cannot be read.
        """
        job = self.job
        try:
            text = inputs.read_text(job.hex, inputs.OUTPUT, "ascii")
        except (OSError, ValueError) as error:
            raise VerificationError(f"'{job.hex}' cannot be read: {error}", fix="compile the program again") from error
        return {"hex": text, "clock": job.clock_hz, "registers": list(self._timers.registers)}

    def noted(self, values: list[Any]) -> None:
        """Record a write of a register."""
        self._timers.written(self.now, *values)

    @property
    def waves(self) -> list[Wave]:
        """See `NodeBench`."""
        return self._timers.waves


class Avr8js(NodeEngine):
    """The engine (see `Engine`)."""

    name = "avr8js"
    steps_cost = 1.0
    mcus = frozenset({"atmega328p"})
    bench = _Run
