"""An original that runs on this machine, in a host model of its platform (see `Original`).

To explain what is seen at its pins, a part of a run is repeated, and its process reports the calls of library functions that it
is in. Their addresses become names and source lines with the tools that built the program.
"""

from __future__ import annotations

import hashlib
from bisect import bisect_right
from collections.abc import Collection, Iterable, Sequence
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.verify.original import LibraryCall, OriginalRun, SourceCoverage, Variation
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_coverage import coverage, reached
from robosmi.verify.original_run import run_original
from robosmi.verify.simulation import DeviceUse
from robosmi.verify.toolchains.tools import run

_SECOND_S = 0.002
"""Measured with polling programs."""

_MOST_PLACES = 5000
"""So many places of calls no program of the platform has."""
_CALL_BYTES = 1
"""A return address minus this many bytes lies within the call instruction."""


class HostOriginal(Struct, frozen=True):
    """A program that is linked with a host model.

    Attributes:
        program: the program.
    """

    program: OriginalProgram

    @property
    def title(self) -> str:
        """The host model."""
        return self.program.model.title

    @property
    def compiler(self) -> str:
        """The compiler of this machine."""
        return self.program.compiler

    @property
    def stubbed(self) -> Sequence[str]:
        """The functions that do nothing since the model lacks them."""
        return self.program.stubbed

    @property
    def stores(self) -> frozenset[str]:
        """The functions that store bytes, as the model names them."""
        return self.program.model.stores

    @property
    def store_bytes(self) -> int:
        """How many bytes of the board's memory are told apart."""
        return self.program.store_bytes or 0

    @property
    def second_s(self) -> float:
        """See `Original`."""
        return _SECOND_S

    @property
    def counts_bytes(self) -> int:
        """The size of the program's data with its coverage counters."""
        return self.program.data_bytes

    def run(
        self, horizon_us: float, devices: Sequence[DeviceUse] = (), variation: Variation | None = None, limit_s: float = 60.0,
        brief: Collection[str] = (),
    ) -> OriginalRun:  # fmt: skip
        """See `Original`; the cause of a crash has its source line."""
        run = run_original(self.program, horizon_us, devices, variation, limit_s, brief=brief)
        return with_place(self.program, run)

    def reached(self, counts: bytes) -> frozenset[int]:
        """See `Original`."""
        return reached(self.program, counts)

    def coverage(self, runs: Iterable[bytes]) -> SourceCoverage:
        """See `Original`.

        Raises:
            MissingToolError: the coverage tool is not installed.
        """
        return coverage(self.program, runs)

    def calls(self, devices: Sequence[DeviceUse], begin_us: float, end_us: float, limit_s: float = 60.0) -> list[LibraryCall]:
        """See `Original`."""
        return library_calls(self.program, devices, begin_us, end_us, limit_s)

    def is_store_comparable(self, pins: Collection[str]) -> bool:
        """Whether all that is written into the memory comes from functions that store, none from the program's own bus."""
        model = self.program.model
        return model.store is not None and model.store_pins.isdisjoint(pins)

    def with_store_bytes(self, count: int) -> HostOriginal:
        """See `Original`."""
        return HostOriginal(replace(self.program, store_bytes=count))

    def digest(self) -> bytes:
        """See `Original`: the files of the host model."""
        digest = hashlib.sha256()
        for path in self.program.model.files:
            digest.update(f"\0{path.name}\0".encode() + inputs.read_bytes(path, inputs.DATA))
        return digest.digest()


def library_calls(
    program: OriginalProgram, devices: Sequence[DeviceUse], begin_us: float, end_us: float, limit_s: float = 60.0
) -> list[LibraryCall]:
    """The calls of a part of a run, by time; those that follow one another from the same place are one.

    Args:
        program: the original.
        devices: what is connected to its pins.
        begin_us, end_us: the part, in microseconds of virtual time.
        limit_s: seconds of processor time.
    """
    made = run_original(program, end_us, devices, None, limit_s, begin_us).calls
    functions = _functions(program)
    places = _places(program, {site for _, site, _, _ in made})
    found: list[LibraryCall] = []
    for at_us, site, inside, prints in made:
        called = LibraryCall(
            at_us, _named(functions, inside).removeprefix(program.model.prefix), *places.get(site, ("", 0)), prints
        )
        if not found or (called.function, called.line) != (found[-1].function, found[-1].line):
            found.append(called)
        elif prints:
            found[-1] = replace(found[-1], prints=True)
    return found


def with_place(program: OriginalProgram, run: OriginalRun) -> OriginalRun:
    """A run whose cause includes the source line, if the program crashed and its process reported the place."""
    if run.status not in ("crashed", "recursion") or not run.calls:
        return run
    site = run.calls[-1][1]
    file, line = _places(program, {site})[site]
    return replace(run, cause=f"{run.cause} ({Path(file).name}:{line})") if line else run


def _functions(program: OriginalProgram) -> list[tuple[int, str]]:
    said = run([program.model.tools()["names"], "-n", str(program.binary)]).stdout
    words = [line.split() for line in said.splitlines()]
    return [(int(each[0], 16), each[2]) for each in words if len(each) == 3 and each[1] in "TtWw"]


def _named(functions: Sequence[tuple[int, str]], address: int) -> str:
    number = bisect_right(functions, (address, chr(0x10FFFF)))
    return functions[number - 1][1] if number else ""


def _places(program: OriginalProgram, addresses: set[int]) -> dict[int, tuple[str, int]]:
    """Address -> file and line."""
    if not addresses:
        return {}
    listed = sorted(addresses)[:_MOST_PLACES]
    command = [
        program.model.tools()["places"],
        "-e",
        str(program.binary),
        *(f"{max(each - _CALL_BYTES, 0):#x}" for each in listed),
    ]
    found = {}
    for address, line in zip(listed, run(command).stdout.splitlines(), strict=True):
        file, _, number = line.split(" (")[0].rpartition(":")
        found[address] = file, int(number) if number.isdigit() else 0
    return found
