"""An original that runs as its own machine code, on a simulator of its own board (see `Original`).

It is built as the user's tools build it. Two further builds are for questions that this one cannot answer:

What a run covers follows from debugging information and from which instructions ran. This is asked of a build in which the
linker inlines nothing across files, so that the conditional jumps of the user's functions are their own; the simulator that
records instructions at the least cost runs it.

Runs that differ in the costs of the program's steps are those of a build for a slower clock: all steps take longer, while
delays, times and baud rates, which the core derives from the clock, stay.

`MachineLines` has the instructions of each of the user's lines, and those that decide between two ways. The linker inlines
functions across files, so that an instruction belongs to a line of each function that is inlined there. The commands and the
forms of what they print are data of the toolchain (`[original]`).
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.errors import EngineCrashError, TimeLimitError, VerificationError
from robosmi.metamodels import migration, platform
from robosmi.transformations.verification.jobs import job, store_bytes
from robosmi.verify.original import LibraryCall, OriginalRun, SourceCoverage, Variation
from robosmi.verify.simulation import DeviceUse, Job, PinTrace, engines_for, simulate
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.processes import in_parallel
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain import Changed, compile_sketch
from robosmi.verify.toolchains.toolchain_data import Toolchain, fill, load_toolchains
from robosmi.verify.toolchains.tools import Installed, find_installed

_STATUS = {"running": "running", "done": "finished"}
"""State of a trace -> status of a run; any other state is `crashed`."""
_SECOND_S = 1.5
"""Seconds that a simulator takes for a simulated one, measured with an ATmega328P on a typical machine."""

_Line = tuple[str, int]
_PLACE = re.compile(r"^(?P<path>.+):(?P<line>\d+)(?: \(discriminator \d+\))?$")


class CompiledOriginal(Struct, frozen=True):
    """The original, built for a clock.

    Attributes:
        elf, hex: the program.
        clock_hz: the clock.
    """

    elf: Path
    hex: Path | None
    clock_hz: int


class EngineOriginal(Struct, frozen=True):
    """A program for a board that a simulator knows.

    Attributes:
        board: its board.
        compiler: name and version of its compiler and core.
        own: it as it runs on the board.
        traced: it as its lines are traced.
        slower: it with steps that cost more; None if such a build would behave otherwise.
        lines: the instructions of its lines in `traced`.
        engine: the simulator.
        tracer: the simulator that records which instructions run; empty if none does.
        store_bytes: how many bytes of the board's EEPROM are told apart; 0 if it is not compared.
    """

    board: platform.Board
    compiler: str
    own: CompiledOriginal
    traced: CompiledOriginal
    slower: CompiledOriginal | None
    lines: MachineLines
    engine: str
    tracer: str
    store_bytes: int = 0

    @property
    def title(self) -> str:
        """The board on the simulator."""
        return f"{self.board.title} on {self.engine}"

    @property
    def stubbed(self) -> Sequence[str]:
        """None: all that the program calls is there."""
        return ()

    @property
    def stores(self) -> frozenset[str]:
        """None by name: the simulator shows all that is stored."""
        return frozenset()

    @property
    def second_s(self) -> float:
        """See `Original`: twice that of a simulator, since another one may record the instructions."""
        return 2 * _SECOND_S

    @property
    def counts_bytes(self) -> int:
        """A byte for each line, and for each way out of each conditional jump."""
        return len(self._places)

    @property
    def _places(self) -> list[tuple[str, int, int, int]]:
        """File, line, and for a way out of a decision its number on the line from 1 and its address; the order of the counts."""
        found = [(file, line, 0, 0) for file, line in sorted(self.lines.lines)]
        for (file, line), addresses in sorted(self.lines.decisions.items()):
            ways = [address for address in addresses for _ in range(2)]
            found += [(file, line, number, address) for number, address in enumerate(ways, 1)]
        return found

    def run(
        self, horizon_us: float, devices: Sequence[DeviceUse] = (), variation: Variation | None = None, limit_s: float = 60.0,
        brief: Collection[str] = (),
    ) -> OriginalRun:  # fmt: skip
        """See `Original`; a nominal run tells what it covers."""
        build = self.slower if variation is not None and variation.block_factor > 1 and self.slower is not None else self.own
        early = variation.early_part if variation is not None else 0.0

        def asked(of: CompiledOriginal) -> Job:
            made = job(of.elf, of.hex, self.board, horizon_us, devices, sorted(brief))
            return replace(made, clock_hz=round(of.clock_hz * (1 + early)), reached=of is self.traced)

        counted = variation is None and bool(self.tracer)
        jobs = [(self.engine, asked(build)), *([(self.tracer, asked(self.traced))] if counted else [])]
        try:
            traces = list(in_parallel(lambda each: simulate(each[1], each[0], limit_s), jobs))
        except TimeLimitError:
            return OriginalRun(_nothing(), "time limit", "", b"")
        except EngineCrashError as error:
            return OriginalRun(_nothing(), "crashed", error.message, b"")
        trace = traces[0]
        if build is self.slower:
            faster = self.own.clock_hz / build.clock_hz
            trace = replace(trace, waves=tuple(wave._replace(hz=wave.hz * faster) for wave in trace.waves))
        trace = replace(trace, store_bytes=self.store_bytes)
        status = _STATUS.get(trace.state, "crashed")
        cause = "" if status != "crashed" else "its program leaves its code"
        return OriginalRun(trace, status, cause, self._counts(traces[-1]) if counted else b"")

    def _counts(self, trace: PinTrace) -> bytes:
        """What a run covers, from which instructions ran.

        A line is reached if half of its instructions ran, since the compiler moves some of them before a jump.
        """
        ran, jumped, passed = set(trace.reached), set(trace.jumped), set(trace.passed)
        counts = bytearray()
        for file, line, number, address in self._places:
            if number == 0:
                addresses = self.lines.lines[file, line]
                counts.append(2 * len(ran.intersection(addresses)) >= len(addresses))
            else:
                counts.append(address in (jumped if number % 2 else passed))
        return bytes(counts)

    def reached(self, counts: bytes) -> frozenset[int]:
        """See `Original`."""
        return frozenset(number for number, count in enumerate(counts) if count)

    def coverage(self, runs: Iterable[bytes]) -> SourceCoverage:
        """See `Original`: the lines with code, and both ways of each conditional jump of the user's functions."""
        sums = [sum(each) for each in zip(*(counts for counts in runs if counts), strict=True)] or [0] * self.counts_bytes
        told = list(zip(self._places, sums, strict=True))
        lines = {(file, line): count for (file, line, number, _), count in told if number == 0}
        branches = {(file, line, number - 1): count for (file, line, number, _), count in told if number}
        return SourceCoverage(lines, branches)

    def calls(self, devices: Sequence[DeviceUse], begin_us: float, end_us: float, limit_s: float = 60.0) -> list[LibraryCall]:
        """None: simulators do not tell which functions run."""
        return []

    def is_store_comparable(self, pins: Collection[str]) -> bool:
        """Whether the simulator shows the board's EEPROM."""
        return self._own_store > 0

    @property
    def _own_store(self) -> int:
        chip = self.board.microcontroller
        return store_bytes(str(chip.name)) if chip is not None else 0

    def with_store_bytes(self, count: int) -> EngineOriginal:
        """See `Original`."""
        return replace(self, store_bytes=min(count, self._own_store))

    def digest(self) -> bytes:
        """See `Original`: the program and the simulators."""
        digest = hashlib.sha256(f"{self.engine} {self.tracer} {self.board.name}".encode())
        digest.update(inputs.read_bytes(self.own.elf, inputs.OUTPUT))
        return digest.digest()


def source_board_of(plan: migration.MigrationPlan) -> platform.Board | None:
    """The board of a plan's original, where its platform tells boards apart; None where a host model runs the original."""
    mappings = plan.source.boardMappings if plan.source is not None else ()
    return next((mapping.board for mapping in mappings if mapping.board is not None), None)


def engine_original(
    files: Mapping[str, bytes], main: str, platform_name: str, board: platform.Board, place: Path
) -> EngineOriginal:
    """CompiledOriginal an original for its own board.

    Args:
        files: path -> content of its files, relative to its folder.
        main: the path of its main file.
        platform_name: its platform, whose toolchain builds it.
        board: its board.
        place: an empty folder, in which everything is made.

    Raises:
        VerificationError: it does not compile, or its debugging information cannot be read.
        MissingToolError: a tool, the core or a simulator is not installed.
        UsageError: no simulator knows the board.
    """
    toolchain = next(each for each in load_toolchains() if each.platform == platform_name)
    chip = board.microcontroller
    engines = engines_for(str(chip.name) if chip is not None else "")
    sketch = place / Path(main).stem
    for path, text in files.items():
        written = sketch / path
        written.parent.mkdir(parents=True, exist_ok=True)
        written.write_bytes(text)
    data = toolchain.original
    own, report = _built(sketch, board, place / "own", Changed())
    traced, _ = _built(sketch, board, place / "traced", Changed(flags=data.texts("traced")))
    slow_hz = board.clockHertz // data.positive("clock_divisor")
    bound = data.pattern("clock_bound")
    is_bound = any(bound.search(text.decode("utf-8", "replace")) for text in files.values())
    slower = None if is_bound else _built(sketch, board, place / "slower", Changed(slow_hz))[0]
    installed = find_installed(toolchain)
    others = [str(installed.core), *(str(library.folder) for library in report.libraries)]
    lines = _machine_lines(traced.elf, toolchain, installed, _own_file(files, others))
    tracers = sorted((each for each in engines if each.steps_cost), key=lambda each: each.steps_cost)
    return EngineOriginal(board, report.tool, own, traced, slower, lines, engines[0].name, tracers[0].name if tracers else "")


def _built(sketch: Path, board: platform.Board, kept: Path, changed: Changed) -> tuple[CompiledOriginal, CompileReport]:
    """A build of the program.

    Raises:
        VerificationError: it does not compile, or is too big.
    """
    kept.mkdir()
    report = compile_sketch(sketch, str(board.name), keep=kept, changed=changed)
    if report.elf is None:
        errors = [each for each in report.diagnostics if each.severity.name == "error"]
        first = errors[0] if errors else None
        where = first.location if first is not None else None
        raise VerificationError(first.message if first is not None else "it does not compile", location=where)
    return CompiledOriginal(report.elf, report.hex, changed.clock_hz or board.clockHertz), report


def _own_file(files: Iterable[str], others: Sequence[str]) -> Callable[[str], str | None]:
    """From a path of the debugging information to the user's file, or None."""
    names = {Path(path).name: path for path in files}

    def own(path: str) -> str | None:
        return None if any(path.startswith(f"{folder}/") for folder in others) else names.get(Path(path).name)

    return own


def _nothing() -> PinTrace:
    """The trace of a run that was given up."""
    return PinTrace("", "crashed", 0.0, (), (), (), ())


class MachineLines(Struct, frozen=True):
    """The instructions of the user's lines.

    Attributes:
        lines: (file, line) -> addresses of its instructions, those of inlined functions included.
        decisions: (file, line) -> addresses of its own conditional jumps and skips.
    """

    lines: Mapping[_Line, tuple[int, ...]]
    decisions: Mapping[_Line, tuple[int, ...]]


def _machine_lines(elf: Path, toolchain: Toolchain, installed: Installed, own: Callable[[str], str | None]) -> MachineLines:
    """Read the lines of a program with debugging information.

    Args:
        elf: the linked program.
        toolchain, installed: with which it was built.
        own: path of a file as the debugging information has it -> its name if it is the user's, else None.

    Raises:
        VerificationError: the toolchain has no data for this, or a tool fails.
    """
    data = toolchain.original
    if not data.values:
        raise VerificationError(f"nothing tells which lines of a program for {toolchain.title} run")
    conditional, pattern = data.pattern("conditional"), data.pattern("pattern")
    listing = _run(data, "instructions", installed, {"elf": str(elf)})
    kinds = {int(found["address"], 16): found["mnemonic"] for line in listing.splitlines() if (found := pattern.match(line))}
    lines: dict[_Line, list[int]] = {}
    decisions: dict[_Line, list[int]] = {}
    with temporary_folder("lines") as place:
        addresses = Path(place) / "addresses"
        addresses.write_text("\n".join(f"{address:#x}" for address in kinds))
        told = _run(data, "places", installed, {"elf": str(elf), "addresses": str(addresses)})
    address, depth = 0, 0
    for text in told.splitlines():
        if text.startswith("0x"):
            address, depth = int(text, 16), 0
        elif (found := _PLACE.match(text)) and (name := own(found["path"])) is not None and int(found["line"]):
            at = name, int(found["line"])
            lines.setdefault(at, []).append(address)
            if depth == 0 and conditional.fullmatch(kinds[address]):
                decisions.setdefault(at, []).append(address)
            depth += 1
        else:
            depth += 1
    return MachineLines(
        {at: tuple(dict.fromkeys(each)) for at, each in lines.items()}, {at: tuple(each) for at, each in decisions.items()}
    )


def _run(data: DataTable, key: str, installed: Installed, values: Mapping[str, str]) -> str:
    """What the command of an entry prints.

    Raises:
        VerificationError: it fails.
    """
    entry = data.table(key)
    done = installed.run(entry.text("tool"), fill(entry.texts("arguments"), values))
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise VerificationError(f"the lines of the program cannot be read: {said[-1] if said else entry.text('tool')}")
    return done.stdout
