"""Runs the original program in a process of its own and in virtual time, with the devices that a simulator would have.

The process may only read and write its two pipes. It reports what happens at its pins, and asks back when it reaches the time
of a device's action or changes a pin that a device is connected to; the devices, on a `Bench`, answer. So a run is
reproducible, however fast this machine is. A `Variation` changes the costs of the program's steps, to find out whether its
behaviour depends on them.
"""

from __future__ import annotations

import math
import os
import signal
import struct
import subprocess
import threading
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from time import monotonic

from msgspec import Struct

from robosmi.verify.bench import device_class
from robosmi.verify.host_bench import END, LEVELS, NEVER, PIN, HostBench
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.processes import ending_with_us
from robosmi.verify.processor_time import HANGS
from robosmi.verify.simulation import DeviceUse, PinChange, PinTrace
from robosmi.verify.temporary import temporary_folder

STATES = {"running": "running", "finished": "done"}
"""Status of a run -> state of its trace; any other status is `crashed`."""

_RECORD = struct.Struct("<QIIII")
_SETTINGS = struct.Struct("<QQQQdddddddIIIIIIIII")
_MOST_RECORDS = 1_000_000
"""Limit on the records of a run: a trace of this many takes 150 MB and a few seconds."""


class Variation(Struct, frozen=True):
    """How a run differs from the nominal one.

    Attributes:
        seed: of the noise, and of the program's random numbers.
        block_factor: cost of the program's own steps relative to the nominal cost, which makes a polling loop faster or slower.
        call_factor: the same for calls of library functions.
        noise: relative random variation of each cost: 0.1 is up to 10 % in either direction.
        late_us: the most microseconds by which a waiting call ends late.
        early_part: the fraction of its time by which a waiting call ends early, as with a fast clock.
        line_part: the fraction by which the console's line is faster, so that a program that prints all the time iterates more
            often; negative for slower.
        clock_us: the microseconds by which clocks that count seconds are ahead, so that a polling program sees a second begin
            in another iteration.
    """

    seed: int = 0
    block_factor: float = 1.0
    call_factor: float = 1.0
    noise: float = 0.0
    late_us: float = 0.0
    early_part: float = 0.0
    line_part: float = 0.0
    clock_us: float = 0.0


class OriginalRun(Struct, frozen=True):
    """The result of a run of the original.

    Attributes:
        trace: the observations until the run ended; pins are the platform's, times count from the first statement of main.
        status: `running` if the horizon was reached, `finished` if main and all other cores ended, `unmodelled` if a function
            without a model was called, `crashed`, `recursion` if calls exhausted the stack, `output limit`, or `time limit`.
        cause: the function without a model, or the reason of a crash; empty otherwise.
        counts: the program's static data with its coverage counters; empty if the run was ended from outside.
        calls: if requested, the library calls: (microseconds, return address in the program, address in the called function,
            whether it prints). The last one of a crashed run is where it crashed.
        mixed_text_us: times at which cores print so close together that the order of their texts is random.
        compared: place of a comparison in the program -> the least and the most by which one side was greater than the other.
            The places mean the same in each run of one program.
    """

    trace: PinTrace
    status: str
    cause: str
    counts: bytes
    calls: tuple[tuple[float, int, int, bool], ...] = ()
    mixed_text_us: tuple[float, ...] = ()
    compared: Mapping[int, tuple[float, float]] = {}


def run_original(
    program: OriginalProgram,
    horizon_us: float,
    devices: Sequence[DeviceUse] = (),
    variation: Variation | None = None,
    limit_s: float = 60.0,
    calls_from_us: float | None = None,
    brief: Collection[str] = (),
) -> OriginalRun:
    """Run a program to its end or to the horizon.

    Args:
        program: what to run.
        horizon_us: how long, in microseconds of virtual time.
        devices: what is connected to the platform's pins and channels.
        variation: how the run differs from the nominal one.
        limit_s: seconds of processor time, rounded up; by the clock a run may take `HANGS` times as long.
        calls_from_us: from when on to note calls of library functions; never if None.
        brief: the pins of which only the first change to each level is wanted (see `Bench.connect`).

    Raises:
        UsageError: a device is not known, or is used wrongly.
        VerificationError: the program cannot be started.
    """
    bench = HostBench(program)
    bench.connect([*devices, *_boards_own(program, devices)], brief)
    with temporary_folder("original") as place, ending_with_us(
        lambda: subprocess.Popen(
            [program.binary], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=place, env={},
            bufsize=0, start_new_session=True,
        )
    ) as process, _killed_after(process, HANGS * limit_s):  # fmt: skip
        run = _Conversation(bench, process, monotonic() + HANGS * limit_s)
        run.begin(program, horizon_us, variation or Variation(), limit_s, calls_from_us)
        status, cause, counts = run.result()
    trace = bench.trace(
        f"{program.model.title}, {program.compiler}", STATES.get(status, "crashed"), horizon_us, bench.waves, bench.console
    )
    return OriginalRun(trace, status, cause, counts, tuple(bench.calls), tuple(bench.mixed_text_us), bench.compared)


def _boards_own(program: OriginalProgram, devices: Sequence[DeviceUse]) -> list[DeviceUse]:
    """The devices that the board has by itself, but for those whose address on the bus is taken."""
    taken = {_address(use) for use in devices} - {None}
    return [use for use in program.model.devices if _address(use) not in taken]


def _address(use: DeviceUse) -> object:
    try:
        known = device_class(use.kind).setting_names
    except KeyError:
        return None
    return use.settings.get("address", known.get("address"))


def _ended_by(code: int) -> str:
    """The reason why a process ended without telling it, from its exit code (a signal as a negative number)."""
    if code == -signal.SIGKILL:
        return (
            "it was stopped from outside: it calls the operating system itself, which it may not, or needs more memory than "
            "there is"
        )
    return f"its process ended with {f'signal {-code}' if code < 0 else f'exit code {code}'} before its time"


class _Conversation:
    """Records come in, answers go out, until the end or the time limit."""

    def __init__(self, bench: HostBench, process: subprocess.Popen[bytes], until: float) -> None:
        assert process.stdin is not None
        assert process.stdout is not None
        self.bench, self.process, self.until = bench, process, until
        self._to, self._from = process.stdin.fileno(), process.stdout.fileno()
        self._data, self._at = b"", 0

    def begin(
        self, program: OriginalProgram, horizon_us: float, variation: Variation, limit_s: float, calls_from_us: float | None
    ) -> None:
        model, bench = program.model, self.bench
        settings = _SETTINGS.pack(
            round(horizon_us * model.clock_hz / 1e6), 0, _MOST_RECORDS,
            NEVER if calls_from_us is None else max(0, round(calls_from_us * model.clock_hz / 1e6)),
            variation.block_factor, variation.call_factor, variation.noise, variation.late_us,
            variation.early_part, variation.line_part, variation.clock_us,
            model.block_ticks, model.call_ticks, bench.watched, *bench.asking, bench.bits(bench.brief),
            variation.seed & 0xFFFFFFFF, max(1, math.ceil(limit_s)),
        )  # fmt: skip
        self._say(settings)

    def result(self) -> tuple[str, str, bytes]:
        """Status, cause and counters."""
        bench = self.bench
        unheeded, clock_hz, changed = bench.unheeded, bench.clock_hz, bench.changes.append
        tick: int
        kind: int
        a: int
        b: int
        c: int
        while records := self._records():
            begun = self._at - len(records)
            for number, (tick, kind, a, b, c) in enumerate(_RECORD.iter_unpack(records), 1):
                if kind == PIN and a in unheeded:  # nearly all records are such
                    changed(PinChange(tick * 1e6 / clock_hz, unheeded[a], LEVELS[b]))
                    continue
                bench.tick = tick
                if kind == END:
                    self._at = begun + number * _RECORD.size
                    bench.refuse_too_many()
                    parts = [self._read(size) for size in (a, b, c)]
                    bench.ended()
                    status, cause, counts = (part or b"" for part in parts)
                    return status.decode(), cause.decode("utf-8", "replace"), counts
                value = bench.told(kind, a, b, c)
                if value is not None:
                    self._say(bench.answer(value))
            bench.refuse_too_many()
        return self._broken_off()

    def _broken_off(self) -> tuple[str, str, bytes]:
        self.bench.ended()
        if monotonic() >= self.until or (code := self.process.wait()) == -signal.SIGXCPU:
            return "time limit", "", b""
        return ("crashed", _ended_by(code), b"")

    def _say(self, data: bytes) -> None:
        try:
            while data:
                data = data[os.write(self._to, data) :]
        except BrokenPipeError:
            pass  # it has ended: reading tells how

    def _records(self) -> bytes:
        """The records that are there, at least one; none if the process has ended."""
        first = self._read(_RECORD.size)
        if first is None:
            return b""
        begun = self._at - _RECORD.size
        self._at += (len(self._data) - self._at) // _RECORD.size * _RECORD.size
        return self._data[begun : self._at]

    def _read(self, size: int) -> bytes | None:
        """The given number of bytes; None if the process has ended."""
        while len(self._data) - self._at < size:
            more = os.read(self._from, 65536)
            if not more:
                return None
            self._data, self._at = self._data[self._at :] + more, 0
        self._at += size
        return self._data[self._at - size : self._at]


@contextmanager
def _killed_after(process: subprocess.Popen[bytes], seconds: float) -> Iterator[None]:
    """Context manager: kill a process at a time limit by the clock, so that reading from it needs none."""
    timer = threading.Timer(seconds, process.kill)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
