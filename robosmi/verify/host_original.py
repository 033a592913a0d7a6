"""An original that runs on this machine, in a host model of its platform (see `Original`)."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Sequence

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.verify.original import LibraryCall, OriginalRun, SourceCoverage, Variation
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_calls import library_calls, with_place
from robosmi.verify.original_coverage import coverage, reached
from robosmi.verify.original_run import run_original
from robosmi.verify.simulation import DeviceUse

_SECOND_S = 0.002
"""Measured with polling programs."""


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
        return self.program.store_bytes

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
