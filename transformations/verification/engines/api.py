"""The engine `api`: a program that is compiled for this computer, with a model of the Arduino API for the board's core.

It serves boards whose microcontroller no simulator has. The program runs in the sandbox of the originals, in virtual time, on the
simulated chip of the Propeller's host model, which knows nothing of the Propeller's libraries. What is judged is what a program
asks of the API: not the board's registers, timers and interrupts, nor its memory, and no times below some 10 us.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from functools import cache
from pathlib import Path

from robosmi import inputs, resources
from robosmi.base.data_tables import DataTable
from robosmi.errors import MissingToolError, VerificationError
from robosmi.project import read_data
from robosmi.verify.bench import device_class
from robosmi.verify.host_model import HostModel
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_run import run_original
from robosmi.verify.sandbox import FLAGS, SOURCE, Launcher, launcher
from robosmi.verify.simulation import Job, PinTrace, too_long
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.tools import run, tool_version

_COMPILER = "gcc"
_INSTALL = "apt-get install g++ gcc-multilib (an x86-64 machine is needed: the program is one of 32 bits)"
_TITLE = "model of the Arduino API"
_TICKS_HZ = 80_000_000
"""HOST_HZ of the simulated chip."""
_BLOCK_TICKS, _CALL_TICKS = 8, 80
"""A basic block takes 0.1 us and a call of the API 1 us, as on a processor of 50 to 100 MHz."""
_LIMIT_S = 60.0
_MOST_PINS = 32
_I386 = b"\x03\x00"
"""The processor in the header of an ELF file."""
_BUS_CLASS = b"$_ZN7TwoWire"
"""A name in programs that use the class of Wire."""


class Api:
    """The engine (see `Engine`)."""

    name = "api"
    steps_cost = 0.0

    def missing(self) -> str | None:
        """What is not installed here; None if it can run."""
        return _missing(os.environ.get("PATH", ""))

    def version(self) -> str | None:
        """The version of the compiler."""
        return None if self.missing() is not None else tool_version(_COMPILER, ["-dumpfullversion", "-dumpversion"])

    def serves(self, mcu: str) -> bool:
        """Whether the data says that programs for the microcontroller are judged here."""
        return mcu in _microcontrollers()

    def run(self, job: Job) -> PinTrace:
        """Run a program in its sandbox.

        Raises:
            MissingToolError: the system has no sandbox for it.
            TimeLimitError: it takes too long.
            VerificationError: nothing is known of it: it crashes, uses what the model has not, or is one for another processor.
        """
        content = inputs.read_bytes(Path(job.elf), inputs.MODEL)
        if content[18:20] != _I386:
            raise VerificationError("the program is not compiled for this computer", fix="run it by robosmi simulate or verify")
        on_bus = any("address" in device_class(use.kind).setting_names for use in job.devices)
        if on_bus and _BUS_CLASS not in content:
            raise _lacks("two-wire buses that a program makes of two pins")
        with temporary_folder("api") as place:
            binary = Path(place) / "program"
            binary.write_bytes(content)
            binary.chmod(0o500)
            program = OriginalProgram(binary, _launcher(Path(place)), _model(job), (), f"gcc {self.version()}", (), (), (), 0)
            done = run_original(program, job.horizon_us, job.devices, limit_s=_LIMIT_S, brief=job.brief)
        if done.status == "unmodelled":
            raise _lacks(done.cause)
        if done.status == "time limit":
            raise too_long(_LIMIT_S)
        if done.status == "output limit":
            raise VerificationError("the program changes its pins too often", fix="simulate less time")
        if done.status in ("crashed", "recursion"):
            at_ms = done.trace.simulated_us / 1000
            raise VerificationError(
                f"the program crashes on this computer at {at_ms:.1f} ms: it {done.cause.removeprefix('it ')}",
                fix="correct that; the board itself may go on there, as after a division by zero",
            )
        return done.trace


def _lacks(what: str) -> VerificationError:
    return VerificationError(
        f"the model of the Arduino API does not have {what}", fix="test it on the board: nothing is known of it here"
    )


def _model(job: Job) -> HostModel:
    """The board as a host model."""
    return HostModel(
        folder=Path(), platform="arduino", title=_TITLE, headers=(), libraries=(), prefix="$", clock_hz=_TICKS_HZ,
        block_ticks=_BLOCK_TICKS, call_ticks=_CALL_TICKS, pins=tuple(job.pins)[:_MOST_PINS], channels=tuple(job.analog),
        compiler=DataTable(Path(), {}), predefined=(), undefined=(), same=frozenset(), devices=(), waves_have_edges=False,
    )  # fmt: skip


def _launcher(place: Path) -> Launcher:
    def compile_it(target: Path) -> subprocess.CompletedProcess[str]:
        return run([_COMPILER, *FLAGS, str(SOURCE), "-o", str(target)])

    return launcher(compile_it, f"{_COMPILER} {tool_version(_COMPILER, ['-dumpfullversion'])}", place, strict=True)


def _microcontrollers() -> frozenset[str]:
    """Those that the data of all folders names."""
    paths = [folder / "simulation" / "api.toml" for folder in resources.folders("platform_repo")]
    return frozenset(mcu for path in paths if path.is_file() for mcu in read_data(path))


@cache
def _missing(path: str) -> str | None:
    """What to do so that programs of 32 bits can be built and run in the sandbox; None if they can.

    Args:
        path: the folders of programs, by which the answer is remembered.
    """
    if any(shutil.which(tool) is None for tool in (_COMPILER, "g++", "objcopy", "size")):
        return _INSTALL
    with temporary_folder("api") as place:
        folder = Path(place)
        probe = folder / "probe.c"
        probe.write_text("#include <stdio.h>\nint main(void) { return 0; }\n")
        if run([_COMPILER, "-m32", "-static", str(probe), "-o", str(folder / "probe")]).returncode != 0:
            return _INSTALL
        try:
            _launcher(folder)
        except MissingToolError as error:
            return error.fix
    return None
