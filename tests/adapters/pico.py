"""Compiles adapters for the Raspberry Pi Pico with the stand-in of its core, each one alone with just what it declares.

`python -m tests.adapters.pico [TEXT [ARCHITECTURE]]` takes the adapters whose `header/name` contains that text, and prints what
the compiler says and what the hardware layer lacks. An architecture without a layer of its own (`other`) has the one on the
Arduino API, which is compiled with the Pico's core, too.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path

from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.m2t.adapter_text import adapter_text
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, PinTrace, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.adapters.bench import NO_PIN, ROOT, pieces
from tests.adapters.test_files import KEYS, STAND_INS, program

CORE = ROOT / "platform_repo" / "arduino" / "stand_ins" / "hardware" / "rp2040" / "rp2040"
OPTIONS = [
    "-mcpu=cortex-m0plus", "-mthumb", "-Os", "-std=gnu++23", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics",
    "-Werror=return-type", "-Wno-volatile", "-DF_CPU=200000000L", "-DARDUINO=10819", "-DARDUINO_ARCH_RP2040",
    "-DARDUINO_RASPBERRY_PI_PICO", "-Wall", "-Wextra", "-Wno-unused-variable",
]  # fmt: skip
"""As the recipes of the stand-in core have them, and the warnings; a piece alone may have variables that other pieces use."""


def folders() -> list[str]:
    """Where headers of the target are found: those of libraries for AVR boards only are behind the core's own."""
    own = [CORE / "cores" / "rp2040", CORE / "variants" / "rpipico", *sorted(CORE.glob("libraries/*/src"))]
    others = [STAND_INS / name / place for name in ("SD", "DHT_sensor_library") for place in (".", "src")]
    return [f"-I{path}" for path in (*own, *others)]


def said(wanted: Iterable[tuple[str, str]], folder: Path, architecture: str = "rp2040") -> str:
    """The compiler's messages about some adapters in one program; what the layer lacks for one that is not served.

    With another architecture the program has the pieces that are for that one, and is compiled with the same core.
    """
    keys = sorted(wanted)
    needed = AdapterPieces(pieces(), architecture=architecture).needed(keys, architecture)
    setup = "\n".join(f"  {statement}" for piece in needed.pieces for statement in piece.setup)
    text = program(needed.pieces, set(keys) - needed.unserved.keys())
    (folder / "adapters.cpp").write_text(f"{text}\nvoid setup() {{\n{setup}\n}}\n")
    command = ["arm-none-eabi-g++", *OPTIONS, *folders(), "-c", "adapters.cpp", "-o", "adapters.o"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    lines = (line for line in done.stderr.splitlines() if line.startswith("adapters.cpp:") or "error" in line)
    return "\n".join([*dict.fromkeys(needed.unserved.values()), *lines])


def run(
    uses: Iterable[str],
    program_text: str,
    milliseconds: float,
    folder: Path,
    architecture: str = "rp2040",
    devices: Sequence[DeviceUse] = (),
) -> PinTrace:
    """Compile a program that calls adapters (`header/name`) for the Pico, run it on a simulated one, and tell what was seen.

    The adapters are those of an architecture: of one that has no hardware layer of its own, on the Arduino API alone.
    """
    known = AdapterPieces(pieces(), architecture=architecture)
    needed = known.needed([(header, name) for header, name in (use.rsplit("/", 1) for use in uses)], "rp2040")
    assert not needed.unserved
    text = adapter_text([adapter_element(piece) for piece in needed.pieces], {}, NO_PIN)
    sketch = folder / "case"
    sketch.mkdir()
    (sketch / "case.ino").write_text(f"#include <Arduino.h>\n{text}\n{program_text}")
    report = compile_sketch(sketch, "pico", keep=folder)
    assert report.ok, report.diagnostics
    assert report.elf is not None
    return simulate(job(report.elf, report.hex, load_board("pico"), milliseconds * 1000, list(devices)))


def main(only: str = "", architecture: str = "rp2040") -> int:
    """Compile the adapters whose names contain a text; the number of those that do not compile."""
    tried = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for key in KEYS:
            if only in "/".join(key):
                tried += 1
                if text := said([key], Path(folder), architecture):
                    wrong += 1
                    print(f"{'/'.join(key)}:\n{text}", flush=True)
    print(f"{tried} adapters compiled alone for the Pico, {wrong} with a warning or an error")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
