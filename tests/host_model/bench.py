"""A bench for programs of the Propeller on its host model."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from robosmi.verify import original_build
from robosmi.verify.host_model import HostModel, load_host_model
from robosmi.verify.host_original import HostOriginal
from robosmi.verify.original import OriginalRun, Variation
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_run import run_original
from robosmi.verify.simulation import DeviceUse, PinTrace

ROOT = Path(__file__).parents[2]


def model() -> HostModel:
    """The host model of the Propeller."""
    return load_host_model("propeller")


@contextmanager
def built(text: str) -> Iterator[OriginalProgram]:
    """A program, built in a folder that is removed afterwards."""
    with tempfile.TemporaryDirectory() as place:
        source = Path(place) / "program.c"
        source.write_text(text)
        folder = Path(place) / "built"
        folder.mkdir()
        yield original_build.build_original([source], model(), folder)


@contextmanager
def original(text: str) -> Iterator[HostOriginal]:
    """A program as the side of a verification that runs on this machine."""
    with built(text) as program:
        yield HostOriginal(program)


def run(
    text: str,
    milliseconds: float = 1000.0,
    devices: Sequence[DeviceUse] = (),
    variation: Variation | None = None,
    limit_s: float = 30.0,
) -> OriginalRun:
    """Build and run a program."""
    with built(text) as program:
        return run_original(program, milliseconds * 1000, devices, variation, limit_s)


def ended(text: str, milliseconds: float = 1000.0, devices: Sequence[DeviceUse] = ()) -> PinTrace:
    """The trace of a program that must come to its end."""
    found = run(text, milliseconds, devices)
    assert (found.status, found.cause) == ("finished", "")
    return found.trace


def said(
    statements: str, milliseconds: float = 1000.0, devices: Sequence[DeviceUse] = (), before: str = "", headers: str = ""
) -> list[str]:
    """The words that a main with these statements prints; the program must come to its end."""
    includes = "".join(f"#include <{name}>\n" for name in ("simpletools.h", *headers.split()))
    return ended(f"{includes}{before}\nint main() {{ {statements} }}\n", milliseconds, devices).text.split()
