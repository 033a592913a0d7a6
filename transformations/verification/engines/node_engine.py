"""What engines have in common whose simulator is a package of npm, run by node beside the worker.

A program in JavaScript beside the engine runs the instructions and asks this side whenever something happens at a pin that a
device is connected to, at the times at which devices want to act, and at each step of the two-wire bus. Between, it keeps a log.
Questions and answers are lines of JSON; the programs' first lines explain them.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
from abc import abstractmethod
from pathlib import Path
from typing import Any, ClassVar

from msgspec.structs import replace

from robosmi import inputs, resources
from robosmi.base.data_text import Json, json_written
from robosmi.errors import MissingToolError, VerificationError
from robosmi.verify.bench import Bench
from robosmi.verify.simulation import ConsoleByte, Job, PinTrace, Wave

PACKAGES = "ROBOSMI_NPM"
"""Environment variable: the folder in which `npm install` was run."""
_ENDS_S = 10.0
"""Time in seconds that node may take to end when it has closed its output."""


def _packages() -> list[Path]:
    """The folders with npm packages, in the order in which they are searched."""
    named = os.environ.get(PACKAGES)
    return [Path(place) / "node_modules" for place in ([named] if named else []) + [str(resources.user_data() / "npm")]]


class NodeEngine:
    """An engine (see `Engine`) with a simulator from npm.

    Attributes:
        name: of the engine, and of the package.
        steps_cost: see `Engine`.
        wanted: the package as npm is asked for it; the name if empty.
        mcus: the microcontrollers that it knows.
        bench: the bench of a run.
    """

    name: ClassVar[str]
    steps_cost: ClassVar[float] = 0.0
    wanted: ClassVar[str] = ""
    mcus: ClassVar[frozenset[str]]
    bench: ClassVar[type[NodeBench]]

    def missing(self) -> str | None:
        """What is not installed here; None if it can run."""
        if shutil.which("node") is None:
            return f"install node (Debian: apt-get install nodejs npm), then {self.name}"
        if self.version() is None:
            return f"npm install --prefix {_packages()[-1].parent} {self.wanted or self.name}"
        return None

    def version(self) -> str | None:
        """The version that is installed; None if it is not."""
        for folder in _packages():
            try:
                found: str = json.loads(inputs.read_text(folder / self.name / "package.json", inputs.SETTINGS))["version"]
            except (OSError, ValueError, KeyError):
                continue
            return found
        return None

    def serves(self, mcu: str) -> bool:
        """Whether it knows the microcontroller."""
        return mcu in self.mcus

    def run(self, job: Job) -> PinTrace:
        """Run a program, with node as a child of this process."""
        if advice := self.missing():
            raise MissingToolError(f"{self.name} is not installed", fix=advice)
        path = os.pathsep.join(str(folder) for folder in _packages())
        program = Path(__file__).with_name(f"{self.name}_run.cjs")
        with subprocess.Popen(
            ["node", str(program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, encoding="latin-1", env=os.environ | {"NODE_PATH": path},
        ) as process:  # fmt: skip
            try:
                return self.bench(process, job, f"{self.name} {self.version()}").run()
            finally:
                process.kill()


class NodeBench(Bench):
    """One program on one simulated microcontroller.

    Args:
        process: node, running the engine's program.
        job: what to run.
        title: the simulator with its version.
    """

    def __init__(self, process: subprocess.Popen[str], job: Job, title: str) -> None:
        super().__init__(tuple(job.pins), self.ticks_hz(job))
        self.job = job
        self._process, self._title = process, title
        self._cycle = 0
        self._commands: list[list[Json]] = []
        self._console: list[ConsoleByte] = []

    # ---- what differs from engine to engine

    @staticmethod
    @abstractmethod
    def ticks_hz(job: Job) -> int:
        """The unit of time that the program counts in."""

    @abstractmethod
    def question(self) -> dict[str, Json]:
        """What the program has to know of the job, beside what all of them get."""

    @abstractmethod
    def noted(self, values: list[Any]) -> None:
        """Record an entry of the log about waves, without its kind and time."""

    @property
    @abstractmethod
    def waves(self) -> list[Wave]:
        """The waves so far, by time."""

    # ---- the interface for devices

    @property
    def cycle(self) -> int:
        """The cycles since reset."""
        return self._cycle

    def wake_at(self, cycle: int) -> None:
        """Do nothing: each answer to the simulator says when it has to ask again."""

    def set_level(self, pin: str, level: int | None) -> None:
        """Drive a pin from outside, low or high; None lets go of it."""
        self._commands.append(["set", pin, level])

    def join(self, pin: str, other: str) -> None:
        """Close a contact between two pins."""
        self._commands.append(["join", pin, other])

    def part(self, pin: str, other: str) -> None:
        """Open the contact between two pins."""
        self._commands.append(["part", pin, other])

    def set_voltage(self, pin: str, millivolts: float) -> None:
        """Put a voltage on a pin of the converter."""
        self._commands.append(["adc", self.job.analog[pin], millivolts / 1000])

    def send(self, data: bytes) -> None:
        """Let bytes arrive on the program's console."""
        self._commands.append(["send", list(data)])

    # ---- the run

    def run(self) -> PinTrace:
        """Run until the horizon."""
        job = self.job
        self.connect(job.devices, job.brief)
        own = self.question()
        begun, self._commands = self._commands, []
        end = round(job.horizon_us * self.clock_hz / 1e6)
        shared: dict[str, Json] = {"pins": dict(job.pins), "end": end, "reached": job.reached}
        self._write({**own, **shared, "reactive": sorted(self.heeded), "brief": sorted(self.brief)})
        while (told := self._read())["ask"] != "end":
            self._note(told["log"])
            self._cycle = told["t"]
            if told["ask"] == "start":
                self._commands = begun
            elif told["ask"] == "bus":
                self._commands.append(["answer", self._bus(told)])
            self._commands.append(["wake", self.wake()])
            self._write(self._commands)
            self._commands = []
        self._note(told["log"])
        self._cycle = min(told["t"], end) if told["crashed"] else end
        self.ended()
        state = "crashed" if told["crashed"] else "running"
        trace = self.trace(self._title, state, job.horizon_us, self.waves, self._console)
        reached, jumped, passed = (tuple(told.get(each, ())) for each in ("reached", "jumped", "passed"))
        return replace(trace, reached=reached, jumped=jumped, passed=passed, console_baud=told.get("baud", 0.0))

    def _note(self, log: list[list[Any]]) -> None:
        for kind, cycle, first, *more in log:
            self._cycle = cycle
            if kind == "p":
                self.pin_changed(first, more[0])
            elif kind == "w":
                self.noted([first, *more])
            else:
                self._console.append(ConsoleByte(self.now, first))

    def _bus(self, told: dict[str, Any]) -> int:
        address = told["address"]
        if told["bus"] == "start":
            return int(self.bus_start(address, told["read"]))
        if told["bus"] == "write":
            return int(self.bus_write(address, told["byte"]))
        if told["bus"] == "read":
            return self.bus_read(address)
        self.bus_stop(address)
        return 0

    def _write(self, value: Json) -> None:
        stream = self._process.stdin
        if stream is None:
            raise VerificationError("node has no standard input")
        try:
            stream.write(json_written(value) + "\n")
            stream.flush()
        except OSError as error:
            raise self._ended() from error

    def _read(self) -> dict[str, Any]:
        line = self._process.stdout.readline() if self._process.stdout is not None else ""
        if not line:
            raise self._ended()
        told: dict[str, Any] = json.loads(line)
        return told

    def _ended(self) -> VerificationError:
        if self._process.wait(_ENDS_S) == -signal.SIGXCPU:
            os.kill(os.getpid(), signal.SIGXCPU)  # the time limit is this process's as well
        said = self._process.stderr.read() if self._process.stderr is not None else ""
        lines = [line for line in said.splitlines() if "Error" in line]
        name = self._title.partition(" ")[0]
        return VerificationError(f"{name} failed: {lines[0] if lines else 'no message'}", fix="try another engine")
