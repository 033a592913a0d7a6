"""What adapters in C do, measured by the same cases as those for the Arduino core.

A case's program is written for that core: `setup` and `loop`, its pin numbers, `Serial`. Here it becomes a C program: the pins
that go to adapters become those of avr-libc, and what it uses of the core stands in `core.h`, which no adapter sees.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from msgspec.structs import replace

from robosmi.transformations.knowledge.adapters.adapter_files import read_adapter_file
from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.m2t.adapter_text import adapter_text
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, PinTrace, simulate
from tests.adapters.bench import NO_PIN, ROOT, NotBuiltError, Uno, built

ADAPTERS = ROOT / "platform_repo" / "avr-c" / "adapters" / "propeller"
FLAGS = ["-std=gnu11", "-Os", "-Wall", "-Wextra", "-ffunction-sections", "-fdata-sections", "-DF_CPU=16000000UL"]
MCUS = ("atmega328p", "atmega2560", "atmega32u4")
HEAD = """#include <avr/io.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#define AVR_PIN(port, bit) (((port) - 'A') * 8 + (bit))
#define AVR_ADC(channel) (100 + (channel))
"""
MAKEFILE = "BOARD := uno\nMCU := atmega328p\nF_CPU := 16000000\n"
CORE = (Path(__file__).parent / "core.h").read_text()
PINS = {
    **{str(number): 24 + number for number in range(8)},
    **{str(number): number for number in range(8, 14)},
    **{f"A{number}": 16 + number for number in range(6)},
    "MISO": 12, "SCK": 13, "MOSI": 11, "SCL": 21, "SDA": 20,
}  # fmt: skip
"""Pin of an Uno in the Arduino core's numbering -> its number in the C adapters: 8 times the port (from A on) plus the bit."""


@cache
def pieces() -> tuple[AdapterPiece, ...]:
    """All pieces of all adapter files in C."""
    return tuple(piece for path in sorted(ADAPTERS.rglob("*.c")) for piece in read_adapter_file(path))


def in_c(program: str) -> str:
    """A program for the Arduino core as a C program: pins in calls of adapters, `Serial`, and `main`."""
    for piece in pieces():
        if not piece.pins:
            continue
        said = re.search(r"\((.*)\)", piece.signatures[0])
        names = [parameter.split()[-1].lstrip("*") for parameter in said[1].split(",")] if said else []
        places = [names.index(pin.name) for pin in piece.pins]
        program = re.sub(rf"\b{piece.target_name or piece.name}\(([^()]*)\)", partial(_with_pins, places), program)
    program = re.sub(r"\bSerial\.", "Serial_", program).replace("void setup()", "static void setup(void)")
    program = re.sub(r"(Serial_print\w*\()(?=')", r"\1(char)", program)  # which is an int in C
    return f"{program.replace('void loop()', 'static void loop(void)')}\nint main(void) {{ setup(); for (;;) loop(); }}\n"


def _with_pins(places: Sequence[int], call: re.Match[str]) -> str:
    arguments = call[1].split(",")
    for place in places:
        said = arguments[place].strip()
        arguments[place] = arguments[place].replace(said, str(PINS.get(said, said)))
    return f"{call[0].split('(')[0]}({','.join(arguments)})"


@dataclass
class UnoInC(Uno):
    """A bench with an Uno for adapters in C; see `bench.Uno`."""

    def sketch(self, program: str, uses: Sequence[str], first: str = "") -> str:
        """The text of a C program: the pieces that `uses` (`header/name`) need, then what a program for the core becomes."""
        known = AdapterPieces(
            (replace(piece, text=self.changed.get(f"{piece.header}/{piece.name}", piece.text)) for piece in pieces()),
            architecture="avr",
        )
        wanted = [*uses, "propeller.h/clock_wait"]
        needed = known.needed([(header, name) for header, name in (use.rsplit("/", 1) for use in wanted)], "atmega328p")
        if needed.unserved:
            raise NotBuiltError(needed.unserved)
        ports = {name: str(PINS.get(pin, pin)) for name, pin in self.ports.items()}
        numbers = {number: str(PINS[pin]) for number, pin in self.numbers.items()}
        elements = [adapter_element(piece) for piece in needed.pieces]
        return f"{HEAD}{first}{adapter_text(elements, ports, NO_PIN, numbers)}\n{CORE}\n{in_c(program)}"

    def run(
        self,
        program: str,
        uses: Sequence[str],
        milliseconds: float,
        devices: Sequence[DeviceUse] = (),
        engine: str | None = None,
        first: str = "",
    ) -> PinTrace:
        """Compile a program, run it, and tell what was seen. Warnings of the compiler are failures."""
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / "case"
            folder.mkdir()
            (folder / "case.c").write_text(self.sketch(program, uses, first))
            (folder / "Makefile").write_text(MAKEFILE)
            report = built(folder, None, Path(place))
            said = [finding for finding in report.diagnostics if finding.severity.name != "info"]
            if not report.ok or (said and not self.changed) or report.elf is None or report.hex is None:
                raise NotBuiltError(said)
            asked = job(report.elf, report.hex, load_board("uno"), milliseconds * 1000, devices)
            return simulate(asked, engine)


def alone(key: tuple[str, str], mcu: str, folder: Path) -> str:
    """The compiler's messages about one adapter with just what it needs; empty if the microcontroller cannot serve it."""
    needed = AdapterPieces(pieces(), architecture="avr").needed([key], mcu)
    if needed.unserved:
        return ""
    text = adapter_text([adapter_element(piece) for piece in needed.pieces], {}, NO_PIN)
    (folder / "adapter.c").write_text(f"{HEAD}{text}\nint main(void) {{ return 0; }}\n")
    command = ["avr-gcc", f"-mmcu={mcu}", *FLAGS, "-c", "adapter.c", "-o", "adapter.o"]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder).stderr
