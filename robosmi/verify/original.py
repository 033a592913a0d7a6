"""The original as one side of a comparison, whatever runs it: a host model of its platform, or a simulator of its own board.

`HostOriginal` runs a program that is compiled for this machine; another side runs the original's own machine code on an engine. A
comparison, a search for scenarios and a verdict know only what is here: how to run the program, what a run shows and covers.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from msgspec import Struct

from robosmi.verify.simulation import DeviceUse, PinTrace


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


class SourceCoverage(Struct, frozen=True):
    """How often runs have reached each line and branch.

    Attributes:
        lines: (file, line) -> count, for each line with code.
        branches: (file, line, number of the branch on that line from 0) -> count, for each way out of a decision.
        functions: (file, line) -> name of the function that the line is in.
    """

    lines: Mapping[tuple[str, int], int]
    branches: Mapping[tuple[str, int, int], int]
    functions: Mapping[tuple[str, int], str] = {}

    def without(self, functions: Collection[tuple[str, str]]) -> SourceCoverage:
        """The coverage without the lines of some functions: name of the file without its folder, name of the function."""
        dead = {place for place, name in self.functions.items() if (Path(place[0]).name, name) in functions}
        return SourceCoverage(
            {place: count for place, count in self.lines.items() if place not in dead},
            {place: count for place, count in self.branches.items() if place[:2] not in dead},
            {place: name for place, name in self.functions.items() if place not in dead},
        )

    @property
    def line_percent(self) -> float:
        """The percentage of lines with code that were reached; 100 if there are none."""
        return _percent(self.lines.values())

    @property
    def branch_percent(self) -> float:
        """The percentage of branches taken at least once; 100 if there are none."""
        return _percent(self.branches.values())

    @property
    def missed_branches(self) -> list[tuple[str, int, int]]:
        """The branches that no run has taken: file, line, number on that line."""
        return sorted(place for place, count in self.branches.items() if not count)


def _percent(counts: Iterable[int]) -> float:
    known = list(counts)
    return 100.0 * sum(count > 0 for count in known) / len(known) if known else 100.0


class LibraryCall(Struct, frozen=True):
    """A call that the program makes.

    Attributes:
        at_us: when, in microseconds of virtual time.
        function: what it calls, as the program names it.
        file, line: from where.
        prints: whether it writes on the console.
    """

    at_us: float
    function: str
    file: str
    line: int
    prints: bool = False

    def __str__(self) -> str:
        return f"{self.function} ({Path(self.file).name}:{self.line})"

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        place = {"file": Path(self.file).name, "line": self.line}
        return {"function": self.function, **place, "at_ms": round(self.at_us / 1000, 3)}


class Original(Protocol):
    """A program that is ready to run in scenarios."""

    @property
    def title(self) -> str:
        """What runs it, for people."""

    @property
    def compiler(self) -> str:
        """Name and version of the compiler."""

    @property
    def stubbed(self) -> Sequence[str]:
        """The functions that do nothing, since what runs the program lacks them."""

    @property
    def stores(self) -> frozenset[str]:
        """The functions by which programs store bytes that the board keeps without power."""

    @property
    def store_bytes(self) -> int:
        """How many bytes of that memory are told apart; all if 0."""

    @property
    def second_s(self) -> float:
        """Estimated seconds of a typical machine for each simulated one."""

    @property
    def counts_bytes(self) -> int:
        """The size of what a run leaves as `OriginalRun.counts`."""

    def run(
        self, horizon_us: float, devices: Sequence[DeviceUse] = (), variation: Variation | None = None, limit_s: float = 60.0,
        brief: Collection[str] = (),
    ) -> OriginalRun:  # fmt: skip
        """Run the program to its end or to the horizon.

        Args:
            horizon_us: how long, in microseconds of virtual time.
            devices: what is connected to its pins.
            variation: how the run differs from the nominal one, as far as what runs it can tell the difference.
            limit_s: seconds of processor time.
            brief: the pins of which only the first change to each level is wanted.

        Raises:
            UsageError: a device is not known, or is used wrongly.
            VerificationError: the program cannot be started.
        """

    def reached(self, counts: bytes) -> frozenset[int]:
        """The edges of the program's flow that a run has taken, as numbers that mean the same in each run of one program."""

    def coverage(self, runs: Iterable[bytes]) -> SourceCoverage:
        """Lines and branches that runs have reached together, by what each left (`OriginalRun.counts`)."""

    def calls(self, devices: Sequence[DeviceUse], begin_us: float, end_us: float, limit_s: float = 60.0) -> list[LibraryCall]:
        """The calls of library functions in a part of a run, by time; none if what runs the program cannot tell."""

    def is_store_comparable(self, pins: Collection[str]) -> bool:
        """Whether what the program stores can be compared with a target, with these pins of the source in use."""

    def with_store_bytes(self, count: int) -> Original:
        """The same program, with so many bytes of that memory told apart."""

    def digest(self) -> bytes:
        """A digest of all that its runs rest on beside its sources."""
