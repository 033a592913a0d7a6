"""The engine `rp2040js`: the simulator of that name (npm, MIT); an RP2040 with its first core.

Its program is `rp2040js_run.cjs`. `rp2040js_repairs.cjs` has what the simulator does otherwise than the chip, `rp2040js_rom.cjs`
a boot ROM. `rp2040js_rounds.cjs` skips rounds of waiting loops, to the cycle. `rp2040js_bus.cjs` reads a two-wire bus that a
program makes at any two pins. Flash has no wait states and calls of the ROM take no time: programs run a little faster than on
a chip. The console is `Serial` on USB, which a PC opens about 11 ms after the start.
"""

from __future__ import annotations

import subprocess
from typing import Any

from robosmi.base.data_text import Json
from robosmi.transformations.verification.engines.node_engine import NodeBench, NodeEngine
from robosmi.verify.simulation import Job, Wave

_NANOSECONDS = 1_000_000_000
_ONE_CHANGE_US = 5.0
"""Microseconds in which several changes of a wave count as one: a slice is set up register by register."""


class _Run(NodeBench):
    """One program; time is counted in nanoseconds, since programs choose the clock themselves."""

    def __init__(self, process: subprocess.Popen[str], job: Job, title: str) -> None:
        super().__init__(process, job, title)
        self._waves: list[Wave] = []

    @staticmethod
    def ticks_hz(job: Job) -> int:
        """Nanoseconds."""
        return _NANOSECONDS

    def question(self) -> dict[str, Json]:
        """The linked program, the converter's reference, and whether devices are on a two-wire bus."""
        return {"elf": self.job.elf, "volts": self.job.supply_mv / 1000, "bus": self.has_bus}

    def noted(self, values: list[Any]) -> None:
        """Record a wave."""
        wave = Wave(self.now, *values)
        own = next((at for at in range(len(self._waves) - 1, -1, -1) if self._waves[at].pin == wave.pin), None)
        if own is not None and wave.at_us - self._waves[own].at_us < _ONE_CHANGE_US:
            del self._waves[own]
        self._waves.append(wave)
        self.wave_changed(wave.pin, wave.hz, wave.duty)

    @property
    def waves(self) -> list[Wave]:
        """See `NodeBench`."""
        return self._waves


class Rp2040js(NodeEngine):
    """The engine (see `Engine`)."""

    name = "rp2040js"
    wanted = "rp2040js@1.4.1"
    mcus = frozenset({"rp2040"})
    bench = _Run
