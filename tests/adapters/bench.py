"""Tests the behaviour of adapters: a program that calls them is compiled with just the pieces it needs, and simulated.

A case is a function with `@proves(...)`: it runs programs on the `Uno` that it is given and asserts what the documentation of
the source's library says. The same cases are run again with each adapter that they prove broken on purpose, and then have to
fail (`mutants`).
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
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
from robosmi.verify.toolchains.boards import Board, load_boards
from robosmi.verify.toolchains.build import Build
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.libraries import LibraryFolders
from robosmi.verify.toolchains.recipes import DataRecipes
from robosmi.verify.toolchains.sketch import choose_board, find_sketch
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain_data import Toolchain, load_toolchains
from robosmi.verify.toolchains.tools import Installed, find_installed

ROOT = Path(__file__).parents[2]
ADAPTERS = ROOT / "platform_repo" / "arduino" / "adapters" / "propeller"
NO_PIN = "255"
MOTORS = """
#define NO_PIN 255
static const struct MotorPins { uint8_t port, enable, first, second, awake; } motor_pins[] = {
  {12, NO_PIN, 5, 6, NO_PIN},
  {13, NO_PIN, 9, 10, NO_PIN},
};
"""
"""The table that a program with two channels of motor drivers has before its adapters."""
NOTHING_TO_DO = {
    "simpletools.h/ee_config",  # the memory is in the microcontroller and has no pins
    "abdrive360.h/drive_suppress_eeprom",  # nothing of the drive is kept in it
    "servo360.h/servo360_monitorRun", "servo360.h/servo360_monitorEnd",  # the library as it is shipped leaves its monitor out
    "pthread.h/pthread_set_affinity_thiscog_np",  # a thread never leaves its cog here
}  # fmt: skip
"""Adapters with empty bodies -> the reason; no case can distinguish them from broken ones."""


@cache
def _toolchains() -> tuple[Toolchain, ...]:
    """The toolchains without their analysis of the stack, which no case looks at and which takes as long as the compiler."""
    return tuple(each._replace(stack=replace(each.stack, values={})) for each in load_toolchains())


@cache
def _platform(number: int) -> tuple[list[Board], Installed, LibraryFolders]:
    """The boards, the tools and the libraries of a toolchain, found once for all cases."""
    toolchain = _toolchains()[number]
    installed = find_installed(toolchain)
    return load_boards(toolchain.platform), installed, LibraryFolders(toolchain, installed.core)


def built(folder: Path, board: str | None, keep: Path) -> CompileReport:
    """Build a program as `compile_sketch` does, for cases: what is the same for all is found once.

    Args:
        folder: the sketch's folder.
        board: the board's name; None takes the one of the project file.
        keep: the folder for the program.
    """
    sketch, found = find_sketch(folder)
    number, toolchain = next((n, each) for n, each in enumerate(_toolchains()) if each.path == found.path)
    boards, installed, libraries = _platform(number)
    chosen = choose_board(sketch, boards, toolchain, board)
    with temporary_folder("build") as place:
        return Build(sketch, chosen, toolchain, DataRecipes(toolchain, installed, chosen), libraries, Path(place)).report(keep)


@cache
def pieces() -> tuple[AdapterPiece, ...]:
    """All pieces of all adapter files."""
    return tuple(piece for path in sorted(ADAPTERS.rglob("*.cpp")) for piece in read_adapter_file(path))


class NotBuiltError(Exception):
    """A program does not compile, or not without warnings, so that nothing is judged."""


@dataclass
class Uno:
    """A bench with an Uno for programs that call adapters.

    Attributes:
        changed: `header/name` of a piece -> its text instead of the file's: adapters that are broken on purpose.
        ports: name of a conventional port -> the literal of its pin.
        numbers: number of a port of the source -> the literal of its pin.
    """

    changed: Mapping[str, str] = field(default_factory=dict)
    ports: Mapping[str, str] = field(default_factory=dict)
    numbers: Mapping[int, str] = field(default_factory=dict)

    def sketch(self, program: str, uses: Sequence[str], first: str = "") -> str:
        """The text of a sketch:

        the pieces that `uses` (`header/name`) need behind what comes first, then the program with their statements in `setup`.
        """
        known = AdapterPieces(
            (replace(piece, text=self.changed.get(f"{piece.header}/{piece.name}", piece.text)) for piece in pieces()),
            architecture="avr",
        )
        needed = known.needed([(header, name) for header, name in (use.rsplit("/", 1) for use in uses)], "atmega328p")
        if needed.unserved:
            raise NotBuiltError(needed.unserved)
        setup = "".join(f"\n  {statement}" for piece in needed.pieces for statement in piece.setup)
        elements = [adapter_element(piece) for piece in needed.pieces]
        text = f"#include <Arduino.h>\n{first}{adapter_text(elements, self.ports, NO_PIN, self.numbers)}\n{program}"
        return text.replace("void setup() {", f"void setup() {{{setup}", 1)

    def run(
        self,
        program: str,
        uses: Sequence[str],
        milliseconds: float,
        devices: Sequence[DeviceUse] = (),
        engine: str | None = None,
        first: str = "",
    ) -> PinTrace:
        """Compile a program (with `setup` and `loop`), run it, and tell what was seen. Warnings of the compiler are failures."""
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / "case"
            folder.mkdir()
            (folder / "case.ino").write_text(self.sketch(program, uses, first))
            report = built(folder, "uno", Path(place))
            said = [finding for finding in report.diagnostics if finding.severity.name != "info"]
            if not report.ok or (said and not self.changed) or report.elf is None or report.hex is None:
                raise NotBuiltError(said)
            asked = job(report.elf, report.hex, load_board("uno"), milliseconds * 1000, devices)
            return simulate(asked, engine)


Case = Callable[[Uno], None]
CASES: dict[str, tuple[Case, tuple[str, ...]]] = {}
"""Name of each case -> the case, and the `header/name` of the adapters that it proves."""


BESIDE: dict[str, tuple[str, ...]] = {}
"""Name of a case -> the `header/name` of adapters that it uses without proving them, which a target may lack."""
NOT_IN_C: set[str] = set()
"""Names of the cases that do not hold for adapters in C."""


def proves(*adapters: str, beside: Sequence[str] = (), in_c: bool = True) -> Callable[[Case], Case]:
    """Register a case as proof of adapters: it fails when one of them is broken.

    It may use other adapters (`beside`). Cases with `in_c=False` do not hold for adapters in C, which state another limit.
    """

    def register(case: Case) -> Case:
        assert case.__name__ not in CASES
        CASES[case.__name__] = case, adapters
        BESIDE[case.__name__] = tuple(beside)
        if not in_c:
            NOT_IN_C.add(case.__name__)
        return case

    return register


def notices(case: Case, adapter: str, text: str, bench: type[Uno] = Uno) -> bool:
    """Whether a case fails on a bench when an adapter's text is replaced by this one.

    Raises:
        NotBuiltError: the text does not compile, so that nothing is judged.
    """
    try:
        case(bench({adapter: text}))
    except NotBuiltError:
        raise
    except Exception:  # an assertion, or a pulse that is not there to be looked at
        return True
    return False


_SIGNATURE = re.compile(r"\b(?P<name>\w+)\s*\((?P<parameters>(?:[^()]|\([^()]*\))*)\)\s*\{")
_LAST_NAME = re.compile(r"(\w+)\s*$")


def broken(piece: AdapterPiece) -> dict[str, str]:
    """An adapter broken in each way that makes sense for it: name of the way -> the broken text."""
    name = piece.target_name or piece.name
    if macro := re.search(rf"#define {name}\(.*\) ", piece.text):
        return {"does nothing": f"{piece.text[: macro.end()]}(int32_t)0"}
    found = next(match for match in _SIGNATURE.finditer(piece.text) if match["name"] == name)
    given = [each.strip() for each in found["parameters"].split(",") if each.strip() not in ("", "void")]
    line = piece.text[: found.start()].rsplit("\n", 1)[-1]
    returned = line.replace("inline", "").replace("static", "").strip()
    zero = "0" if piece.location.path.endswith(".c") else "{}"
    nothing = "" if returned.endswith("void") else f"return {zero}; "
    names = [match[1] for each in given if "..." not in each and (match := _LAST_NAME.search(each.split("=")[0]))]
    unused = "".join(f"(void){each}; " for each in names)
    ways = {"does nothing": f"{piece.text[: found.end()]} {unused}{nothing}}}"}
    kinds = [_LAST_NAME.sub("", each.split("=")[0]).strip() for each in given]
    different = len(given) > 1 and kinds[0] == kinds[1] and "=" not in found["parameters"]
    if different and not set(names[:2]) <= set(piece.symmetric):
        swapped = ", ".join([given[1], given[0], *given[2:]])
        ways["swaps its arguments"] = piece.text[: found.start("parameters")] + swapped + piece.text[found.end("parameters") :]
    return ways
