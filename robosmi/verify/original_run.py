"""Runs the original program in a process of its own and in virtual time, with the devices that a simulator would have.

The process may only read and write its two pipes (see `sandbox`). It reports what happens at its pins, and asks back when it
reaches the time of a device's action or changes a pin that a device is connected to. `HostBench` takes these records and lets the
devices answer. So a run is reproducible, however fast this machine is. A `Variation` changes the costs of the program's steps, to
find out whether its behaviour depends on them.
"""

from __future__ import annotations

import itertools
import math
import os
import select
import signal
import struct
import subprocess
import threading
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from time import monotonic
from typing import TypeVar

from robosmi.base.data_text import as_list, as_whole
from robosmi.errors import UsageError
from robosmi.verify.bench import ADDRESSES, AIMS, WRITTEN, Bench, Device, Level, device_class
from robosmi.verify.original import OriginalRun, Variation
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.sandbox import refusal
from robosmi.verify.simulation import ConsoleByte, DeviceUse, PinChange, Wave
from robosmi.verify.toolchains.processes import ending_with_us
from robosmi.verify.toolchains.processor_time import HANGS, ticks_asleep

STATES = {"running": "running", "finished": "done"}
"""Status of a run -> state of its trace; any other status is `crashed`."""

_RECORD = struct.Struct("<QIIII")
_SETTINGS = struct.Struct("<QQQQdddddddIIIIIIII")
_MOST_RECORDS = 1_000_000
"""Limit on the records of a run: a trace of this many takes 150 MB and a few seconds."""


_MOST_TEXT = 4096
"""Bytes of a text that the process sends: its status, its cause, or why it was not started."""
_SIGSYS, _SIGKILL = 31, 9
_MORE_RECORDS = 2000
"""Records that the model may still send when it has reached the limit: a buffer of them, and the last one."""
_PATIENCE_MS = 1000
"""Milliseconds after which a process that sends nothing is looked at, whether it sleeps."""
_STATUSES = ("running", "finished", "unmodelled", "crashed", "recursion", "output limit")
"""What a process reports of its end."""


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
    own = _boards_own(program, devices)
    store = program.model.devices[program.model.store] if program.model.store is not None else None
    if store in own:
        bench.store_in(len(devices) + own.index(store), program.store_bytes or 0)
    bench.connect([*devices, *own], brief)
    command = program.launcher.command(program.binary, max(1, math.ceil(limit_s)))
    with ending_with_us(
        lambda: subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd="/", env={},
            bufsize=0, start_new_session=True,
        )
    ) as process, _killed_after(process, HANGS * limit_s):  # fmt: skip
        run = _Conversation(bench, process, monotonic() + HANGS * limit_s, program.data_bytes)
        run.begin(program, horizon_us, variation or Variation(), calls_from_us)
        status, cause, counts = run.result()
    bench.record_stored()
    trace = bench.trace(
        f"{program.model.title}, {program.compiler}", STATES.get(status, "crashed"), horizon_us, bench.waves, bench.console
    )
    return OriginalRun(trace, status, cause, counts, tuple(bench.calls), tuple(bench.mixed_text_us), bench.compared)


def _boards_own(program: OriginalProgram, devices: Sequence[DeviceUse]) -> list[DeviceUse]:
    """The devices that the board has by itself, but for those whose address on the bus is taken.

    The memory on pins that the program does not use itself is on a bus of its own, where no address is taken.
    """
    taken = {_address(use) for use in devices} - {None}
    apart = program.model.store if program.store_bytes is not None else None
    return [use for number, use in enumerate(program.model.devices) if number == apart or _address(use) not in taken]


def _address(use: DeviceUse) -> object:
    try:
        known = device_class(use.kind).setting_names
    except KeyError:
        return None
    return use.settings.get("address", known.get("address"))


def _ended_by(code: int) -> str:
    """The reason why a process ended without telling it, from its exit code (a signal as a negative number)."""
    if code == -_SIGSYS:
        return "it calls the operating system, which is not allowed"
    if code == -_SIGKILL:
        return "it was killed or ran out of memory"
    return f"its process ended with {f'signal {-code}' if code < 0 else f'exit code {code}'} unexpectedly"


class _StuckError(Exception):
    """A process waits for an answer without a question."""


class _Conversation:
    """Records come in, answers go out, until the end or the time limit."""

    def __init__(self, bench: HostBench, process: subprocess.Popen[bytes], until: float, data_bytes: int) -> None:
        assert process.stdin is not None
        assert process.stdout is not None
        self.bench, self.process, self.until, self.data_bytes = bench, process, until, data_bytes
        self._to, self._from = process.stdin.fileno(), process.stdout.fileno()
        self._data, self._at = b"", 0
        os.set_blocking(self._to, False)
        self._readable = select.poll()
        self._readable.register(self._from, select.POLLIN)

    def begin(self, program: OriginalProgram, horizon_us: float, variation: Variation, calls_from_us: float | None) -> None:
        model, bench = program.model, self.bench
        self.latest = 2 * round(horizon_us * model.clock_hz / 1e6) + model.clock_hz
        settings = _SETTINGS.pack(
            round(horizon_us * model.clock_hz / 1e6), 0, _MOST_RECORDS,
            NEVER if calls_from_us is None else max(0, round(calls_from_us * model.clock_hz / 1e6)),
            variation.block_factor, variation.call_factor, variation.noise, variation.late_us,
            variation.early_part, variation.line_part, variation.clock_us,
            model.block_ticks, model.call_ticks, bench.watched, *bench.reacting_pins, bench.bits(bench.brief),
            variation.seed & 0xFFFFFFFF,
        )  # fmt: skip
        self._say(settings)

    def result(self) -> tuple[str, str, bytes]:
        """Status, cause and counters."""
        try:
            return self._result()
        except _StuckError:
            cause = "it waits forever"
        except ForeignRecordsError:
            cause = "it writes into the host model's pipe"
        self.bench.ended()
        return "crashed", cause, b""

    def _result(self) -> tuple[str, str, bytes]:
        bench = self.bench
        unheeded, clock_hz, changed = bench.unheeded, bench.clock_hz, bench.changes.append
        tick: int
        kind: int
        a: int
        b: int
        c: int
        seen = 0
        while records := self._records():
            seen += len(records) // _RECORD.size
            if seen > _MOST_RECORDS + _MORE_RECORDS:
                raise ForeignRecordsError
            begun = self._at - len(records)
            for number, (tick, kind, a, b, c) in enumerate(_RECORD.iter_unpack(records), 1):
                if kind == PIN and a in unheeded and b <= LET_GO:  # nearly all records are such
                    changed(PinChange(tick * 1e6 / clock_hz, unheeded[a], LEVELS[b]))
                    continue
                if tick > self.latest:
                    raise ForeignRecordsError
                bench.tick = tick
                if kind == END:
                    self._at = begun + number * _RECORD.size
                    bench.refuse_too_many()
                    if max(a, b) > _MOST_TEXT or c not in (0, self.data_bytes):
                        raise ForeignRecordsError
                    parts = [self._read(size) for size in (a, b, c)]
                    bench.ended()
                    status, cause, counts = (part or b"" for part in parts)
                    if status.decode("ascii", "replace") not in _STATUSES:
                        raise ForeignRecordsError
                    return status.decode(), cause.decode("utf-8", "replace"), counts
                value = bench.handle_record(kind, a, b, c)
                if value is not None:
                    self._say(bench.answer(value))
            bench.refuse_too_many()
        return self._broken_off()

    def _broken_off(self) -> tuple[str, str, bytes]:
        self.bench.ended()
        if monotonic() >= self.until or (code := self.process.wait()) == -signal.SIGXCPU:
            return "time limit", "", b""
        assert self.process.stderr is not None
        if reason := self.process.stderr.read(_MOST_TEXT):  # the program itself has no such descriptor
            raise refusal(reason.decode("utf-8", "replace"))
        return ("crashed", _ended_by(code), b"")

    def _say(self, data: bytes) -> None:
        try:
            while data:
                try:
                    data = data[os.write(self._to, data) :]
                except BlockingIOError:
                    self._wait_to_write()
        except BrokenPipeError:
            pass  # it has ended: reading tells how

    def _wait_to_write(self) -> None:
        """Wait until the process has read something; the model reads an answer before it sends more."""
        ready = select.poll()
        ready.register(self._to, select.POLLOUT)
        ready.register(self._from, select.POLLIN)
        if any(descriptor == self._from and event & select.POLLIN for descriptor, event in ready.poll()):
            raise ForeignRecordsError

    def _wait_to_read(self) -> None:
        """Wait until the process has sent something, or ended.

        Raises:
            _StuckError: it sleeps, too, until it is sent something.
        """
        before: int | None = None
        while not self._readable.poll(_PATIENCE_MS):
            now = self._sleeping()
            if now is not None and now == before:
                raise _StuckError
            before = now

    def _sleeping(self) -> int | None:
        """The ticks of processor time that the process has used, if it sleeps."""
        try:
            return ticks_asleep(self.process.pid)
        except OSError:
            return None

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
            self._wait_to_read()
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


# ---- the bench of a program that runs in a host model

_Known = TypeVar("_Known")
_COMMAND = struct.Struct("<iiq")
_DECAY_FOR = struct.Struct("<dd")
_FLOAT = struct.Struct("<f")
_WORD = struct.Struct("<I")
PIN, _WAVE, _CONSOLE, _SYNC, _BUS_START, _BUS_WRITE, _BUS_READ, _BUS_STOP, END, _CALL, _AIM, _COMPARED = range(1, 13)
_GO, _LEVEL, _VOLTAGE, _TYPED, _JOIN, _PART, _LEVEL_AHEAD, _DECAY = range(8)
LET_GO = 2
LEVELS: tuple[Level, ...] = (0, 1, "z")
"""What the process calls 0, 1 and 2."""
_STORE_BUS = 0x80
"""A bit above the 7 of an address: that of a device on the pins of the board's own memory."""
_MOST_DECAYS = 1024
"""So many the process can keep of all pins."""
NEVER = (1 << 62) - 1
"""A time that does not come, in ticks."""
_TOGETHER_US = 45_000.0
"""Cores that print within this time print concurrently, since a line may be this much later in another run (see `comparison`)."""


def _number(bits: int) -> float:
    """The number whose bits came as a word."""
    number: float = _FLOAT.unpack(_WORD.pack(bits))[0]
    if math.isnan(number):
        raise ForeignRecordsError
    return number


def _finite(bits: int) -> float:
    number = _number(bits)
    if math.isinf(number):
        raise ForeignRecordsError
    return number


def _byte(value: int) -> int:
    if value > 0xFF:
        raise ForeignRecordsError
    return value


def _one_of(known: Sequence[_Known], number: int) -> _Known:
    if number >= len(known):
        raise ForeignRecordsError
    return known[number]


class ForeignRecordsError(Exception):
    """A process sends what the host model does not: the program has written into the model's pipe."""


class HostBench(Bench):
    """The bench of a program that runs in a host model: its cycles are the ticks of the virtual time."""

    def __init__(self, program: OriginalProgram) -> None:
        model = program.model
        super().__init__([*model.pins, *model.channels], model.clock_hz)
        self.labels = model.pins
        self.numbers = {label: number for number, label in enumerate(model.pins)}
        self.channels = {label: number for number, label in enumerate(model.channels)}
        self.commands: list[bytes] = []
        self.waves: list[Wave] = []
        self.console: list[ConsoleByte] = []
        self.calls: list[tuple[float, int, int, bool]] = []
        self.mixed_text_us: list[float] = []
        self.compared: dict[int, tuple[float, float]] = {}
        self._speaker = 0
        self._waves_have_edges = model.waves_have_edges
        self.tick = 0
        self.next_wake = NEVER
        self._addressed: dict[int, int] = {}  # bus -> what the bench calls the device there
        pins = sorted(self.numbers[label] for label in model.store_pins)
        self._store_buses = {scl << 5 | sda for scl, sda in itertools.permutations(pins, 2)}
        self._with_charge: set[str] = set()
        self._memory: int | None = None
        self._decays = 0

    def store_in(self, number: int, store_bytes: int) -> None:
        """Say which device is the memory that the board keeps without power.

        Args:
            number: of the device.
            store_bytes: how many of its bytes are told apart; all if 0.
        """
        self._memory = number
        self.store_bytes = store_bytes or ADDRESSES

    def store(self, address: int, content: bytes) -> None:
        """Put bytes into that memory."""
        super().store(address, content)
        if self._memory is not None:
            self._devices[self._memory].restore(address, content)

    def place_on_bus(self, device: Device, address: int) -> int:
        """That memory is on a bus of its own, so that a device on other pins may have its address."""
        return address | _STORE_BUS if device.number == self._memory and self._store_buses else address

    def _place(self, bus: int, address: int) -> int:
        own = address | _STORE_BUS
        return own if bus in self._store_buses and own in self._on_bus else address

    def record_stored(self) -> None:
        """Tell what the program has stored from what else devices have noticed."""
        for event in self.events:
            if event.device == self._memory and event.what == WRITTEN:
                address, byte = as_list(event.value)
                self.byte_stored(event.at_us, as_whole(address), as_whole(byte))
        self.events = [event for event in self.events if event.device != self._memory]

    @property
    def cycle(self) -> int:
        """The ticks since the first statement of main."""
        return self.tick

    @property
    def watched(self) -> int:
        """The pins at which a device is, as bits."""
        return self.bits(self._at_pin)

    def bits(self, pins: Collection[str]) -> int:
        """Pins as bits."""
        return sum(1 << number for number, label in enumerate(self.labels) if label in pins)

    @property
    def unheeded(self) -> dict[int, str]:
        """Number -> label of each pin at which no device has to see a change."""
        heeded = {pin for pin, devices in self._at_pin.items() if not all(device.is_played for device in devices)}
        return {number: label for number, label in enumerate(self.labels) if label not in heeded}

    @property
    def reacting_pins(self) -> tuple[int, int, int]:
        """Bit masks of the pins whose devices must react at once when the pin is driven low, driven high, or released."""
        found = [
            sum(1 << number for number, label in enumerate(self.labels) if self._reacts(label, level)) for level in (0, 1, "z")
        ]
        return found[0], found[1], found[2]

    def _reacts(self, pin: str, level: Level) -> bool:
        return any(level in device.reacts_to and not device.is_played for device in self._at_pin.get(pin, ()))

    def join(self, pin: str, other: str) -> None:
        """Close a contact between two pins."""
        self._command(_JOIN, self.numbers[pin], self.numbers[other])

    def part(self, pin: str, other: str) -> None:
        """Open the contact between two pins."""
        self._command(_PART, self.numbers[pin], self.numbers[other])

    def wake_at(self, cycle: int) -> None:
        """Request a call of `wake` at a cycle earlier than any requested before."""
        self.next_wake = cycle

    def set_level(self, pin: str, level: int | None) -> None:
        """Drive a pin from outside, low or high; None releases it."""
        self._command(_LEVEL, self.numbers[pin], LET_GO if level is None else level)

    def set_level_at(self, at_us: float, pin: str, level: int | None, holds: Callable[[], bool] = lambda: True) -> None:
        """Tell the process ahead, which saves one exchange of messages; it forgets it when the pin's level is set before."""
        cycle = round(at_us * self.clock_hz / 1e6)
        if cycle <= self.cycle:
            self.set_level(pin, level)
        else:
            self._command(_LEVEL_AHEAD, self.numbers[pin] | (LET_GO if level is None else level) << 5, cycle)

    def emulates_capacitor(self, pin: str, decays: Sequence[tuple[float, float]]) -> bool:
        """Let the process play a capacitor, as far as it can keep so many decays."""
        if not decays or pin in self._with_charge or self._decays + len(decays) > _MOST_DECAYS:
            return False
        self._with_charge.add(pin)
        self._decays += len(decays)
        for from_us, lasts_us in decays:
            self._command(_DECAY, self.numbers[pin], 0)
            self.commands.append(_DECAY_FOR.pack(from_us, lasts_us))
        return True

    def set_voltage(self, pin: str, millivolts: float) -> None:
        """Set the voltage at a channel of the converter."""
        if pin not in self.channels:
            raise UsageError(f"no converter at '{pin}'", fix=f"use one of: {', '.join(sorted(self.channels))}")
        self._command(_VOLTAGE, self.channels[pin], round(millivolts))

    def send(self, data: bytes) -> None:
        """Let bytes arrive on the program's console."""
        for byte in data:
            self._command(_TYPED, byte, 0)

    def _command(self, kind: int, which: int, value: int) -> None:
        self.commands.append(_COMMAND.pack(kind, which, value))

    def answer(self, value: int = 0) -> bytes:
        """The command to the process: what the devices have done since it last asked, and when they act next."""
        said = b"".join(self.commands) + _COMMAND.pack(_GO, value, self.next_wake)
        self.commands.clear()
        return said

    def handle_record(self, kind: int, a: int, b: int, c: int) -> int | None:
        """Take a record; the value to answer with, None if it asks for no answer.

        Raises:
            ForeignRecordsError: the model sends no such record.
        """
        if kind == PIN:
            pin, level = _one_of(self.labels, a), _one_of(LEVELS, b)
            self.pin_changed(pin, level)
            return 0 if self._reacts(pin, level) else None
        if kind == _WAVE:
            self.waves.append(wave := Wave(self.now, _one_of(self.labels, a), _finite(b), _finite(c)))
            if not self._waves_have_edges:
                self.wave_changed(wave.pin, wave.hz, wave.duty)
            return None
        if kind == _CONSOLE:
            if self.console and self._speaker != b and self.now - self.console[-1].at_us < _TOGETHER_US:
                self.mixed_text_us.append(self.now)
            self._speaker = b
            self.console.append(ConsoleByte(self.now, _byte(a)))
            return None
        if kind == _COMPARED:
            self.compared[a] = (_number(b), _number(c))
            return None
        if kind == _CALL:
            if not self.calls or self.calls[-1][1:] != (a, b, bool(c)):
                self.calls.append((self.now, a, b, bool(c)))
            return None
        if kind == _AIM:
            self.aimed(_one_of(self.labels, a), _one_of(AIMS, b))
            return None
        if kind == _SYNC:
            due = self.wake()
            self.next_wake = NEVER if due is None else due
            return 0
        if kind == _BUS_START:
            self._addressed[a] = place = self._place(a, _byte(b) >> 1)
            return int(self.bus_start(place, bool(b & 1)))
        if kind == _BUS_WRITE:
            return int(self.bus_write(self._addressed.get(a, -1), _byte(b)))
        if kind == _BUS_READ:
            return self.bus_read(self._addressed.get(a, -1))
        if kind == _BUS_STOP:
            self.bus_stop(self._addressed.get(a, -1))
            return 0
        raise ForeignRecordsError
