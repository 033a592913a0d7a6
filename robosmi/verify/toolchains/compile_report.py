"""What a compile check found, as a plain value with the contract's JSON form, and the rules its findings come from.

No tool is run and no message is read here; `toolchain` makes the report, `messages` the findings.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from msgspec import Struct

from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding, Severity
from robosmi.verify.toolchains.libraries import CompiledLibrary

COMPILER_ERROR = "RS801"
COMPILER_WARNING = "RS802"
MISSING_HEADER = "RS803"
LINK_ERROR = "RS804"
TOO_BIG = "RS805"
STAND_IN_USED = "RS806"
LITTLE_RAM = "RS807"
BADLY_NAMED = "RS808"
OTHER_BOARD = "RS809"
OTHER_FACTS = "RS810"
NO_BOARD_DATA = "RS811"
NO_BOARD_FILE = "RS812"
OTHER_ARCHITECTURE = "RS813"

RULES = {
    COMPILER_ERROR: "the compiler reports an error",
    COMPILER_WARNING: "the compiler warns about the user's own files",
    MISSING_HEADER: "a header is not in the sketch, the core, an installed library or a stand-in",
    LINK_ERROR: "a used name is defined nowhere, or twice",
    TOO_BIG: "the program needs more flash or RAM than the board has",
    STAND_IN_USED: "a library or the board's core is not installed; the check used a stand-in",
    LITTLE_RAM: "the program fits, but little RAM is left for the stack",
    BADLY_NAMED: "the main file's name does not match its folder",
    OTHER_BOARD: "the program uses the pins of another board",
    OTHER_FACTS: "the board's file and the compiler's core contradict each other",
    NO_BOARD_DATA: "the board is one of an installed core and has no data here: only what the core says is checked",
    NO_BOARD_FILE: "the tool of the core that makes the file for the board is not installed",
    OTHER_ARCHITECTURE: "an installed library does not list the board's architecture",
}
"""Every rule of the compile check: id -> meaning."""


class StackBound(NamedTuple):
    """An upper bound on the stack of a compiled program.

    Attributes:
        bytes: the stack of main and all functions it calls, plus that of interrupts.
        interrupts: the part of it that is for interrupts.
        recursive: names of functions that call themselves, directly or indirectly; counted once.
        unknown: names of functions with frames of variable size; only their fixed part is counted.
        deepest: names of the functions on the deepest call chain, beginning with main.
    """

    bytes: int
    interrupts: int
    recursive: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    deepest: tuple[str, ...] = ()

    @property
    def certain(self) -> bool:
        """Whether it really is a bound: no recursion, and all frames have a known size."""
        return not self.recursive and not self.unknown

    def to_json(self) -> dict[str, Json]:
        """The contract's form."""
        return {"bytes": self.bytes, "interrupts": self.interrupts, "certain": self.certain, "recursive": list(self.recursive),
                "unknown": list(self.unknown), "deepest": list(self.deepest)}  # fmt: skip


class CompileReport(Struct, frozen=True):
    """The result of a compile check.

    Attributes:
        ok: it compiles and links, whatever its size.
        fits: it is not too big for the board; None if unknown, because it does not compile.
        fits_on: name of a board that it fits on: this one, another one that it was compiled for as well, or None.
        board: name of the board it was compiled for.
        tool: compiler and core with their versions.
        flash_bytes, ram_bytes: the memory it needs; None if it does not link.
        flash_limit, ram_limit: the memory of the board, in bytes; None where its core does not say.
        stack: the bound on its stack; None if it does not link, or its processor's code cannot be analysed.
        libraries: the libraries it was compiled with, in the order in which they were found.
        diagnostics: findings, in the order of the sketch's text.
        warnings_elsewhere: the number of suppressed warnings about files outside of the sketch.
        seconds: the duration of the check.
        elf, hex: the program, if it was to be kept; of some cores, `hex` is a file of another kind (`.uf2`, `.bin`).
        commands: entries of a compilation database for the sketch's files.
        database: the file with these, if it was to be kept.
        stand_in_core: the core that is not installed, if a stand-in was taken for it; else empty.
    """

    ok: bool
    fits: bool | None
    fits_on: str | None
    board: str
    tool: str
    flash_bytes: int | None
    ram_bytes: int | None
    flash_limit: int | None
    ram_limit: int | None
    stack: StackBound | None = None
    libraries: tuple[CompiledLibrary, ...] = ()
    diagnostics: tuple[Finding, ...] = ()
    warnings_elsewhere: int = 0
    seconds: float = 0.0
    elf: Path | None = None
    hex: Path | None = None
    commands: tuple[dict[str, Json], ...] = ()
    database: Path | None = None
    stand_in_core: str = ""

    @property
    def exit_code(self) -> int:
        """6 if it does not compile, 1 if it does not fit, else 0 (findings and `--fail-on` are the command's matter)."""
        return 6 if not self.ok else 0 if self.fits else 1

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings of severity error."""
        return tuple(finding for finding in self.diagnostics if finding.severity is Severity.error)

    def artifacts(self) -> list[dict[str, str]]:
        """The files that were left, as the contract lists them."""
        program = self.hex.suffix[1:] if self.hex is not None else "hex"
        kept = {"elf": self.elf, program: self.hex, "compilation database": self.database}
        return [{"path": str(path), "kind": kind} for kind, path in kept.items() if path is not None]

    def to_json(self) -> dict[str, Json]:
        """The contract's form of a compile result."""
        return {
            "ok": self.ok,
            "fits": self.fits,
            "fits_on": self.fits_on,
            "board": self.board,
            "tool": self.tool,
            "flash_bytes": self.flash_bytes,
            "ram_bytes": self.ram_bytes,
            "flash_limit": self.flash_limit,
            "ram_limit": self.ram_limit,
            "stack": None if self.stack is None else self.stack.to_json(),
            "libraries": [library.to_json() for library in self.libraries],
            "stand_in_core": self.stand_in_core or None,
            "diagnostics": [finding.to_json() for finding in self.diagnostics],
            "warnings_elsewhere": self.warnings_elsewhere,
            "seconds": round(self.seconds, 3),
        }
