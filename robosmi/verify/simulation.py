"""Running a compiled program on a simulated microcontroller: what is asked (`Job`), what was seen (`PinTrace`), who runs it
(`Engine`).

An engine is content, a class registered as `engine` under its name; devices are content, too, registered as `device` (their
base is in `bench`). Both run in a process of their own (`worker`), so that a crash, an endless loop or the licence of an engine
stays there. Nothing here knows a microcontroller: pins are the labels of a board with their port and bit, times are
microseconds of simulated time, counted from reset.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from functools import cache, cached_property, partial
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from msgspec import Struct
from msgspec.structs import asdict, replace

from robosmi.base.data_text import Json, as_table, json_of, json_written
from robosmi.errors import EngineCrashError, InternalError, MissingToolError, TimeLimitError, UsageError, VerificationError
from robosmi.plugins import content, registry
from robosmi.verify.toolchains.processes import ending_with_us
from robosmi.verify.toolchains.processor_time import HANGS

LEVELS = (0, 1, "z", "p")
"""How a program drives a pin: low, high, not at all (an input), or weakly high (an input with its pull-up on)."""


class DeviceUse(Struct, frozen=True):
    """A device connected to pins or to the console.

    Attributes:
        kind: name under which the device is registered.
        pins: the device's name of a pin -> label of the board's pin.
        settings: its other settings as JSON values: a signal over time, a measured value, an address.
    """

    kind: str
    pins: Mapping[str, str] = {}
    settings: Mapping[str, Any] = {}


class Job(Struct, frozen=True):
    """The description of one run.

    Attributes:
        elf: path of the linked program.
        hex: path of the same program as Intel HEX; an engine uses the format that it reads.
        mcu: name of the microcontroller, as compilers spell it.
        clock_hz: its clock frequency.
        supply_mv: its supply and the reference of its analog-to-digital converter, in millivolts.
        pins: label of each pin of the board -> port letter and bit (`B5`).
        analog: label -> channel of the converter.
        timers: description of the timers for the engine, as stored for the microcontroller in the repository.
        horizon_us: the duration of the run in microseconds.
        devices: the connected devices.
        brief: the pins of which only the first change to each level is wanted, which takes less time (see `Bench.connect`).
        reached: whether to record which instructions run, if the engine can.
        stack_room: the first and the last address of the data memory for heap and stack; None to record no stack depth.
        store_bytes: the size of the microcontroller's own EEPROM; 0 if it has none.
    """

    elf: str
    hex: str
    mcu: str
    clock_hz: int
    supply_mv: int
    pins: Mapping[str, str]
    analog: Mapping[str, int]
    timers: Mapping[str, Any]
    horizon_us: float
    devices: Sequence[DeviceUse] = ()
    brief: Sequence[str] = ()
    reached: bool = False
    stack_room: tuple[int, int] | None = None
    store_bytes: int = 0


class PinChange(NamedTuple):
    """A program drives a pin differently from `at_us` on: `level` is one of `LEVELS`."""

    at_us: float
    pin: str
    level: int | str


class Wave(NamedTuple):
    """A wave that a timer makes at a pin from `at_us` on: frequency `hz` and duty cycle `duty` (0 to 1); 0 Hz ends it."""

    at_us: float
    pin: str
    hz: float
    duty: float


class ConsoleByte(NamedTuple):
    """A byte that the program sent on its console (its first serial port)."""

    at_us: float
    byte: int


class DeviceEvent(NamedTuple):
    """An observation of a device; the device's documentation explains `what` and the JSON value."""

    at_us: float
    device: int
    what: str
    value: Json


class StoredByte(NamedTuple):
    """The program changes a byte that the board keeps without power, from `at_us` on."""

    at_us: float
    address: int
    byte: int


class PinTrace(Struct, frozen=True, dict=True):
    """The observations of one run.

    Attributes:
        engine: name and version of the engine.
        state: `running` if the horizon was reached, `done` if the program stopped itself, `crashed` if it ran into an error.
        simulated_us: the simulated time of the run.
        changes: how the program drove the pins, in order of time.
        waves: the timers' waves, in order of time.
        console: the bytes it sent, in order of time.
        device_events: the devices' observations, in order of time.
        reached: the byte addresses of the instructions that ran, if requested and supported by the engine.
        jumped: those of them after which another one than the next word ran, by a jump, a call or a skip.
        passed: those after which the next word ran.
        stack_bytes: the greatest stack depth in bytes, if requested and supported by the engine.
        console_baud: the last baud rate of the console; 0 if unknown.
        rests_until_us: the horizon if the program stopped itself, since its pins stay as they are until then; else 0.
        stored: the changes of what the board keeps without power (its EEPROM), in order of time.
        store_bytes: the size of that memory, beyond which addresses repeat; 0 if the board has none, or the engine does not
            show it.
    """

    engine: str
    state: str
    simulated_us: float
    changes: tuple[PinChange, ...]
    waves: tuple[Wave, ...]
    console: tuple[ConsoleByte, ...]
    device_events: tuple[DeviceEvent, ...]
    reached: tuple[int, ...] = ()
    stack_bytes: int | None = None
    console_baud: float = 0.0
    rests_until_us: float = 0.0
    stored: tuple[StoredByte, ...] = ()
    store_bytes: int = 0
    jumped: tuple[int, ...] = ()
    passed: tuple[int, ...] = ()

    @property
    def known_us(self) -> float:
        """The time until which the levels of the pins are known."""
        return max(self.simulated_us, self.rests_until_us)

    @property
    def text(self) -> str:
        """The console's bytes as text; what is no UTF-8 is shown as U+FFFD."""
        return bytes(each.byte for each in self.console).decode("utf-8", "replace")

    def until(self, at_us: float) -> PinTrace:
        """The trace as if the run had ended at a time."""
        if self.simulated_us <= at_us:
            return self
        return replace(
            self,
            simulated_us=at_us,
            rests_until_us=0.0,
            changes=tuple(each for each in self.changes if each.at_us <= at_us),
            waves=tuple(each for each in self.waves if each.at_us <= at_us),
            console=tuple(each for each in self.console if each.at_us <= at_us),
            device_events=tuple(each for each in self.device_events if each.at_us <= at_us),
            stored=tuple(each for each in self.stored if each.at_us <= at_us),
        )

    @cached_property
    def _by_pin(self) -> Mapping[str, Sequence[tuple[float, int | str]]]:
        """The changes of each pin, since all channels ask for them, several times each."""
        found: dict[str, list[tuple[float, int | str]]] = {}
        for at_us, pin, level in self.changes:
            found.setdefault(pin, []).append((at_us, level))
        return found

    def levels(self, pin: str) -> Sequence[tuple[float, int | str]]:
        """The changes of one pin: time in microseconds and level."""
        return self._by_pin.get(pin, [])

    def pulses(self, pin: str) -> list[tuple[float, float]]:
        """The high pulses of one pin: begin and width in microseconds. A pulse ends when the pin is no longer driven high."""
        found, begun = [], None
        for at_us, level in self.levels(pin):
            if level == 1 and begun is None:
                begun = at_us
            elif level != 1 and begun is not None:
                found.append((begun, at_us - begun))
                begun = None
        return found


class Engine(Protocol):
    """A simulator of microcontrollers.

    Attributes:
        name: how it is asked for.
        steps_cost: how many times longer a run takes if it records which instructions run; 0 if it cannot.
    """

    name: str
    steps_cost: float

    def missing(self) -> str | None:
        """The instruction for installing what the engine needs; None if it can run."""

    def version(self) -> str | None:
        """The version that is installed, `unknown` where it does not tell; None if it is not installed."""

    def serves(self, mcu: str) -> bool:
        """Whether it knows the microcontroller."""

    def run(self, job: Job) -> PinTrace:
        """Run a program in this process until the horizon, or until it stops itself.

        Raises:
            VerificationError: the program cannot be loaded, or the simulator gave up.
        """


def engine_for(mcu: str, name: str | None = None) -> Engine:
    """The engine of that name, or the first installed one that knows the microcontroller.

    Raises:
        UsageError: no engine has that name, or it does not know the microcontroller.
        MissingToolError: none that knows it is installed.
    """
    return engines_for(mcu, name)[0]


def engines_for(mcu: str, name: str | None = None) -> list[Engine]:
    """The engine of that name alone, or all installed ones that know the microcontroller, in the order in which they are tried.

    Raises:
        UsageError: no engine has that name, or it does not know the microcontroller.
        MissingToolError: none that knows it is installed.
    """
    if name is not None:
        engine: Engine = content("engine", name)()
        if not engine.serves(mcu):
            raise UsageError(f"the engine '{name}' does not know the microcontroller '{mcu}'", fix="omit --engine")
        if advice := engine.missing():
            raise MissingToolError(f"the engine '{name}' is not installed", fix=advice)
        return [engine]
    serving = serving_engines(mcu)
    if installed := [each for each in serving if each.missing() is None]:
        return installed
    advices = "; or ".join(str(each.missing()) for each in serving)
    raise MissingToolError(f"no simulator for the microcontroller '{mcu}' is installed", fix=advices)


def serving_engines(mcu: str) -> list[Engine]:
    """The engines that know the microcontroller, installed or not.

    Raises:
        UsageError: none does.
    """
    known: list[Engine] = [content("engine", each)() for each in engine_names()]
    if not (serving := [each for each in known if each.serves(mcu)]):
        fix = f"add a table [{mcu}] to simulation/api.toml (docs/how-to/add-a-board.md), or use another board"
        raise UsageError(f"no engine knows the microcontroller '{mcu}'", fix=fix)
    return serving


def engine_names() -> list[str]:
    """The names of the engines, in the order in which they are tried."""
    return list(registry().entries.get("engine", {}))


def simulate(job: Job, engine: str | None = None, limit_s: float | None = None) -> PinTrace:
    """Run a program on a simulator, in a process of its own.

    Args:
        job: what to run.
        engine: name of the engine; the first that is installed and knows the microcontroller if None.
        limit_s: seconds of processor time after which the run is given up, so that other work on this machine decides nothing;
            `usual_limit_s` if None. By the clock a run may take `HANGS` times as long: a process that waits for ever uses no
            processor time.

    Raises:
        UsageError: no engine has that name, none knows the microcontroller, or a device is used wrongly.
        MissingToolError: the engine is not installed.
        TimeLimitError: the time limit is over.
        VerificationError: the program cannot be loaded.
        EngineCrashError: the engine crashed.
    """
    limit_s = usual_limit_s(job.horizon_us) if limit_s is None else limit_s
    chosen = engine_for(job.mcu, engine)
    asked = asdict(job) | {"devices": [asdict(one) for one in job.devices]}
    question = json_written({"engine": chosen.name, "job": asked, "limit_s": limit_s})
    command = [sys.executable, "-P", "-m", "robosmi.verify.worker"]  # no module of the current folder
    start = partial(
        subprocess.Popen[str], command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
        start_new_session=True, env=_environment(),
    )  # fmt: skip
    with ending_with_us(start) as process:
        try:
            answer, complaint = process.communicate(question, timeout=HANGS * limit_s)
        except subprocess.TimeoutExpired:
            raise too_long(HANGS * limit_s, ", by the clock") from None
    code = process.returncode
    if code == -signal.SIGXCPU:
        raise too_long(limit_s)
    if code != 0 or not answer:
        ended = f"signal {-code} ended its process" if code < 0 else f"its process ended with {code}"
        last = (complaint.strip().splitlines() or [ended])[-1]
        raise EngineCrashError(f"the engine '{chosen.name}' crashed: {last}", fix="try another engine: --engine NAME")
    return _trace(as_table(json_of(answer)), chosen.name)


def usual_limit_s(horizon_us: float) -> float:
    """The processor time that a run may take.

    The slowest engine needs 3 s for each second of a program that asks its pins all the time.
    """
    return max(60.0, 5 * horizon_us / 1e6)


def too_long(limit_s: float, what: str = " of processor time") -> TimeLimitError:
    """The error that ends a run at its time limit."""
    return TimeLimitError(f"the simulation exceeded {limit_s:g} s{what}", fix="simulate less time")


def _environment() -> dict[str, str]:
    """This process's environment; the worker finds this very package, wherever it was imported from."""
    return os.environ | {"PYTHONPATH": os.pathsep.join([_root(), *filter(None, [os.environ.get("PYTHONPATH")])])}


@cache
def _root() -> str:
    import robosmi

    return str(Path(robosmi.__file__).parents[1])


def _trace(answer: dict[str, Any], engine: str) -> PinTrace:
    if "error" in answer:
        errors = {each.__name__: each for each in (UsageError, MissingToolError, VerificationError)}
        raise errors.get(answer["error"], VerificationError)(answer["message"], fix=answer["fix"])
    pins: dict[str, str] = {}  # one text for each pin, not for each change
    try:
        return PinTrace(
            answer["engine"], answer["state"], answer["simulated_us"],
            tuple(PinChange(at_us, pins.setdefault(pin, pin), level) for at_us, pin, level in answer["changes"]),
            tuple(Wave(*each) for each in answer["waves"]),
            tuple(ConsoleByte(*each) for each in answer["console"]),
            tuple(DeviceEvent(*each) for each in answer["device_events"]),
            tuple(answer["reached"]),
            answer["stack_bytes"],
            answer["console_baud"],
            answer["rests_until_us"],
            tuple(StoredByte(*each) for each in answer["stored"]),
            answer["store_bytes"],
            tuple(answer["jumped"]),
            tuple(answer["passed"]),
        )  # fmt: skip
    except (KeyError, TypeError, ValueError) as error:
        raise InternalError(f"the engine '{engine}' returned no valid trace: {error}") from error
