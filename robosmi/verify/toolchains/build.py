"""One sketch, built for one board in a temporary folder: compile, archive, link, measure.

The sketch's own folder is only read; the tools run in it, so that their messages name its files. The commands come from
`recipes`; libraries are found by `libraries`, messages read by `messages`, archives cached by `archives`. Which sketch and which
board is decided by `toolchain`.

The linker is asked to keep relocations, because the stack depth is computed from them. But other tools then take the file for one
that is still to be linked: `addr2line` of binutils 2.26 reports wrong lines. So the relocations are removed from a linked ELF
program (System V ABI 4.1) before it is handed out.

A compilation database (as Clang defines it) serves tools that read sources. A build compiles one text made of the sketch's files;
in the database each file has an entry of its own, with arguments that make Clang read it as the compiler does. The toolchain's
table `[database]` adds to these.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.progress_events import announce
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import MissingToolError
from robosmi.plugins import content
from robosmi.verify.toolchains import archives, messages
from robosmi.verify.toolchains.boards import Board
from robosmi.verify.toolchains.compile_report import (
    BADLY_NAMED,
    LITTLE_RAM,
    NO_BOARD_FILE,
    OTHER_ARCHITECTURE,
    STAND_IN_USED,
    CompileReport,
    StackBound,
)
from robosmi.verify.toolchains.libraries import (
    STAND_IN,
    CompiledLibrary,
    LibraryFolders,
    missing_headers,
    read_files,
    resolve,
)
from robosmi.verify.toolchains.machine_faults import check_machine
from robosmi.verify.toolchains.processes import in_parallel
from robosmi.verify.toolchains.recipes import Recipes
from robosmi.verify.toolchains.sketch import Sketch, check_not_precompiled, check_plain
from robosmi.verify.toolchains.toolchain_data import Toolchain
from robosmi.verify.toolchains.tools import run

if TYPE_CHECKING:
    from robosmi.base.data_text import Json


class Build(Struct):
    """One sketch, built for one board.

    Attributes:
        folder: an empty folder to build in.
    """

    sketch: Sketch
    board: Board
    toolchain: Toolchain
    recipes: Recipes
    index: LibraryFolders
    folder: Path

    def report(self, keep: Path | None = None) -> CompileReport:
        """Compile, link, measure."""
        check_plain(self.sketch.folder)
        main = self.folder / f"{self.sketch.main.name}{self.toolchain.languages[0].suffixes[0]}"
        main.write_text(self.sketch.text(self.toolchain), encoding="utf-8", errors="surrogateescape", newline="")
        sources = [main, *(path.resolve() for path in self.sketch.sources)]
        if (told := self._prepare()) is not None:
            return self._no_program([messages.unread("preparing the build", told)])
        libraries = resolve(sources, self.index, self.toolchain.suffixes, self._missing)
        objects, said, failed = self._compile_sketch(sources, libraries)
        findings, elsewhere = messages.compiler_findings(said, self.toolchain.messages, self.sketch.folder)
        report = self._no_program(self._about_sketch(libraries) + findings, libraries, elsewhere)
        if failed:
            read = any(finding.severity is Severity.error for finding in findings)
            return report if read else _with(report, [messages.unread("compiling", said)])
        try:
            used = [(library, self._archive_library(library, libraries)) for library in libraries]
        except _Broken as broken:
            errors, more = messages.compiler_findings(broken.text, self.toolchain.messages, self.sketch.folder)
            return _with(replace(report, warnings_elsewhere=elsewhere + more), errors or [broken.finding()])
        return self._link(objects, [archive for _, archive in used if archive], report, keep)

    # ---- compiling

    def _no_program(
        self, findings: Sequence[Finding], libraries: Sequence[CompiledLibrary] = (), elsewhere: int = 0
    ) -> CompileReport:
        """The report of a build that has no program, or none yet."""
        return CompileReport(
            ok=False,
            fits=None,
            fits_on=None,
            board=self.board.name,
            tool=self.recipes.title,
            flash_bytes=None,
            ram_bytes=None,
            flash_limit=self.board.flash_bytes,
            ram_limit=self.board.ram_bytes,
            libraries=tuple(libraries),
            diagnostics=tuple(findings),
            warnings_elsewhere=elsewhere,
            commands=tuple(self._commands(list(libraries))),
        )

    def _run(self, command: Sequence[str], cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
        """Run a command of the recipes to its end, with its output as text.

        Raises:
            SourceError: the machine let it down, as a full disk does.
        """
        return check_machine(command[0], run(command, cwd, self.recipes.environment))

    def _run_all(self, commands: Iterable[Sequence[str]]) -> str | None:
        """Run commands one after the other; returns what the first that fails prints, or None."""
        for command in commands:
            done = self._run(command, self.folder)
            if done.returncode != 0:
                return done.stderr or done.stdout or f"'{command[0]}' ends with {done.returncode}"
        return None

    def _prepare(self) -> str | None:
        return self._run_all(self.recipes.prepare(self.folder, self.sketch.main.stem))

    def _about_sketch(self, libraries: Iterable[CompiledLibrary]) -> list[Finding]:
        """The findings about a sketch before it is compiled."""
        place = Location(str(self.sketch.main))
        findings = [
            Finding(
                STAND_IN_USED,
                Severity.info,
                f"the library '{library.name}' is not installed; compiled with a stand-in",
                place,
                fix=f"install it before uploading: robosmi libraries install {shlex.quote(library.name)}",
                evidence={"library": library.name, "compatible_with": library.version},
            )
            for library in libraries
            if library.source == STAND_IN
            and not library.folder.is_relative_to(self.recipes.core)  # else the core is said to be one
        ]
        findings += [
            Finding(
                OTHER_ARCHITECTURE,
                Severity.warning,
                f"the library '{library.name}' is for {', '.join(library.others)}, not {self.toolchain.architecture}",
                place,
                fix="try it on the board, or use a library that lists the board's architecture",
            )
            for library in libraries
            if library.others
        ]
        if not self.sketch.well_named:
            name = self.sketch.folder.resolve().name + self.sketch.main.suffix
            message = f"the main file's name must match its folder: {name}"
            findings.append(Finding(BADLY_NAMED, Severity.warning, message, place, fix=f"rename it to {name}, or the folder"))
        return findings

    def _own_includes(self, libraries: Iterable[CompiledLibrary]) -> list[Path]:
        """Where the sketch's headers are found: its own folder (the tools run in it) first."""
        return [Path("."), *(library.include for library in libraries)]

    @staticmethod
    def _library_includes(library: CompiledLibrary, libraries: Iterable[CompiledLibrary]) -> list[Path]:
        """Where a library's headers are found: its own folders first; the sketch's folder is not among them."""
        return [*library.own_includes(), *(other.include for other in libraries if other is not library)]

    def _missing(self, source: Path, libraries: list[CompiledLibrary]) -> list[str]:
        """The headers that the preprocessor does not find when it reads a file of the sketch or of a library."""
        owner = next((library for library in libraries if source.is_relative_to(library.include)), None)
        includes = self._own_includes(libraries) if owner is None else self._library_includes(owner, libraries)
        said = self._run(self.recipes.scan(source, "library" if owner else "sketch", includes), self.sketch.folder)
        check_not_precompiled(self.sketch.folder / name for name in read_files(said.stdout))
        return missing_headers(said.stdout, self.sketch.folder)

    def _compile(self, sources: Sequence[Path], use: str, includes: Sequence[Path], into: Path) -> tuple[list[Path], str, bool]:
        """Compile files in parallel; returns the objects, the messages, and whether one failed."""
        into.mkdir(exist_ok=True)
        announce(f"compile {quantity(len(sources), 'file')} of the {use}")
        objects = [into / f"{number}-{source.name}.o" for number, source in enumerate(sources)]

        def one(job: tuple[Path, Path]) -> tuple[str, bool]:
            source, target = job
            shown = Path(os.path.relpath(source, self.sketch.folder.resolve())) if source in own else source
            done = self._run(self.recipes.compile(shown, target, use, includes), self.sketch.folder)
            return done.stderr, done.returncode != 0

        own = {path.resolve() for path in self.sketch.sources}
        results = list(in_parallel(one, zip(sources, objects, strict=True)))
        return objects, "".join(text for text, _ in results), any(failed for _, failed in results)

    def _compile_sketch(self, sources: Sequence[Path], libraries: list[CompiledLibrary]) -> tuple[list[Path], str, bool]:
        return self._compile(sources, "sketch", self._own_includes(libraries), self.folder / "sketch")

    def _commands(self, libraries: list[CompiledLibrary]) -> Iterator[dict[str, Json]]:
        includes = self._own_includes(libraries)
        told = partial(self.recipes.database, includes=includes)
        return entries(self.sketch, self.toolchain, self._run, told)

    # ---- archives of libraries and of the core

    def _archive(self, name: str, sources: Sequence[Path], use: str, includes: Sequence[Path]) -> Path:
        """The archive of sources, from the cache or made now."""
        if found := archives.cached(name):
            return found
        into = self.folder / name.removesuffix(".a")
        objects, said, failed = self._compile(sources, use, includes, into)
        archive = into / name
        if not failed:
            complaint = self._run_all(self.recipes.archive(archive, objects))
            failed, said = complaint is not None, said + (complaint or "")
        if failed:
            raise _Broken(name, said)
        return archives.store(archive, name)

    def _name(self, what: str, files: Iterable[Path], sources: Sequence[Path], use: str, includes: Sequence[Path]) -> str:
        compiles = [
            self.recipes.compile(Path(f"x{suffix}"), Path("x.o"), use, includes)
            for suffix in sorted({path.suffix for path in sources})
        ]
        plain_compiles = [[word.replace(str(self.folder), ".") for word in command] for command in compiles]
        key = archives.digest(files, self.recipes.title, plain_compiles)
        plain = "".join(letter if letter.isalnum() else "_" for letter in what)
        return f"{plain}-{self.board.name}-{key}.a"

    def _archive_library(self, library: CompiledLibrary, libraries: list[CompiledLibrary]) -> Path | None:
        """The archive of a library, or None if it is headers only."""
        sources = library.files(self.toolchain.suffixes)
        if not sources:
            return None
        includes = self._library_includes(library, libraries)
        folders = [*self.recipes.core_folders, *(used.include for used in libraries)]
        files = [file for folder in folders for file in archives.files_below(folder)]
        return self._archive(self._name(library.name, files, sources, "library", includes), sources, "library", includes)

    def core_archive(self) -> Path | None:
        """The archive of the core for this board, from the cache or made now; None if the toolchain has no core to compile.

        Raises:
            MissingToolError: the installed core does not compile.
        """
        if not self.recipes.core_folders:
            return None
        files = [path for folder in self.recipes.core_folders for path in archives.files_below(folder)]
        sources = [path for path in files if path.suffix in self.toolchain.suffixes]
        files += [path for folder in (*self.recipes.board_folders, *self.board.folders) for path in archives.files_below(folder)]
        try:
            return self._archive(self._name("core", files, sources, "core", []), sources, "core", [])
        except _Broken as broken:
            raise MissingToolError(
                f"{self.recipes.core_title} does not compile: {broken.first()}",
                location=Location(str(self.recipes.core)),
                fix=f"reinstall it, or install another version and set its folder in {self.toolchain.core.text('env')}",
            ) from broken

    # ---- linking

    def _link(self, objects: list[Path], libraries: list[Path], report: CompileReport, keep: Path | None) -> CompileReport:
        core = self.core_archive()
        elf = self.folder / f"{self.sketch.main.stem}.elf"
        link = self.recipes.link(elf, objects, libraries, core)
        if (complaint := self._run_all(self.recipes.before_link(elf, objects, libraries, core))) is not None:
            return _with(report, [messages.unread("preparing the link", complaint)])
        done = self._run(link)
        overflow = False
        if done.returncode != 0:
            own = [self.sketch.main, *self.sketch.parts, *self.sketch.sources]
            undefined = messages.linker_findings(done.stderr, self.toolchain.messages, own)
            overflow = bool(self.toolchain.messages.pattern("overflow").search(done.stderr))
            if undefined or not overflow:
                unread = messages.assembler_findings(done.stderr, self.toolchain.messages, own)
                return _with(report, undefined or unread or [messages.unread("linking", done.stderr)])
            self._run([*link, *self.toolchain.link.texts("measure")])
        elif not elf.is_file():
            return _with(report, [messages.unread("linking", f"'{link[0]}' ends without an error and makes no {elf.name}")])
        flash, ram = self._measure(elf) if elf.is_file() else (None, None)
        limits = (flash, self.board.flash_bytes), (ram or 0, self.board.ram_bytes)
        fits = not overflow and all(used is not None and (most is None or used <= most) for used, most in limits)
        report = replace(report, ok=True, fits=fits, fits_on=self.board.name if fits else None, flash_bytes=flash, ram_bytes=ram)
        if elf.is_file():
            report = replace(report, stack=self._stack(elf))
        if fits:
            report = _with(report, self._little_ram(ram, report.stack))
        return self._keep(report, elf, keep) if keep is not None and not overflow else report

    def _measure(self, elf: Path) -> tuple[int, int | None]:
        """Flash and RAM in bytes; None for a RAM that nothing tells."""
        return self.recipes.sizes(self._run(self.recipes.size(elf)).stdout)

    def _stack(self, elf: Path) -> StackBound | None:
        """The stack bound of the program, if there is an analysis of its processor's code."""
        command = self.recipes.disassemble(elf)
        if command is None:
            return None
        found: StackBound | None = content("query", "stack_bound")(self._run(command).stdout, self.toolchain.architecture)
        return found

    def _little_ram(self, ram: int | None, stack: StackBound | None) -> list[Finding]:
        if ram is None or self.board.ram_bytes is None:
            return []
        percent = 100 * ram // self.board.ram_bytes
        left = self.board.ram_bytes - ram
        short = stack is not None and stack.bytes > left
        if percent <= self.toolchain.size.number("ram_warn_percent") and not short:
            return []
        most = f", which needs up to {stack.bytes}" if stack is not None else ""
        message = f"the program's variables use {percent} % of the RAM; {left} bytes are left for the stack{most}"
        fix = "make arrays smaller, or move constant texts to flash"
        return [Finding(LITTLE_RAM, Severity.warning, message, Location(str(self.sketch.main)), fix=fix)]

    def _keep(self, report: CompileReport, elf: Path, keep: Path) -> CompileReport:
        if (complaint := self._run_all(self.recipes.convert(elf))) is not None:
            return _with(replace(report, ok=False), [messages.unread("converting", complaint)])
        if (gap := self.recipes.unconverted) is not None:
            report = _with(report, [Finding(NO_BOARD_FILE, Severity.info, gap, Location(str(self.sketch.main)))])
        kept = keep / elf.name
        kept.write_bytes(without_relocations(inputs.read_bytes(elf, inputs.MODEL)))
        program = self.recipes.program(elf)
        made = program != elf and program.is_file()
        return replace(report, elf=kept, hex=Path(shutil.copy2(program, keep)) if made else None)


class _Broken(Exception):
    """Sources that are not the user's do not compile."""

    def __init__(self, name: str, text: str) -> None:
        super().__init__(name)
        self.name = name
        self.text = text

    def finding(self) -> Finding:
        return messages.unread(f"compiling {self.name}", self.text)

    def first(self) -> str:
        return next((line for line in self.text.splitlines() if "error" in line), self.name)


def _with(report: CompileReport, findings: Sequence[Finding]) -> CompileReport:
    return replace(report, diagnostics=(*report.diagnostics, *findings))


# ---- relocations

_MAGIC = b"\x7fELF"
_LAYOUTS = {1: (4, 0x20, 0x2E), 2: (8, 0x28, 0x3A)}
"""For each ELF class: the size of an offset in bytes, and where the offset of the section headers, their size and number are."""
_LEAST = 0x40
"""An upper bound on the size of an ELF header in bytes."""
_RELOCATIONS = (4, 9)
_TYPE = 4
"""The place of the type in a section header, and its size in bytes."""


def without_relocations(data: bytes) -> bytes:
    """A linked program with its relocation sections marked as unused; data that is not ELF is returned unchanged."""
    layout = _LAYOUTS.get(data[4]) if data.startswith(_MAGIC) and len(data) > _LEAST else None
    if layout is None:
        return data
    little = data[5] == 1
    width, at, counts = layout
    start = _number(data, at, width, little)
    size, number = _number(data, counts, 2, little), _number(data, counts + 2, 2, little)
    if size < 2 * _TYPE:
        return data
    made = bytearray(data)
    for header in range(start, min(start + size * number, len(data) - size + 1), size):
        if _number(data, header + _TYPE, _TYPE, little) in _RELOCATIONS:
            for place in range(header + _TYPE, header + 2 * _TYPE):
                made[place] = 0
    return bytes(made)


def _number(data: bytes, at: int, width: int, little: bool) -> int:
    value = 0
    for place in range(at, at + width):
        value = value + (data[place] << 8 * (place - at)) if little else value * 256 + data[place]
    return value


# ---- the compilation database

_SEARCHED = re.compile(r"^#include <\.\.\.>.*\n((?: .*\n)*)", re.MULTILINE)
"""The list of system include folders in a compiler's verbose output."""


def entries(
    sketch: Sketch,
    toolchain: Toolchain,
    start: Callable[[Sequence[str]], subprocess.CompletedProcess[str]],
    command: Callable[[str], list[str]],
) -> Iterator[dict[str, Any]]:
    """The entries: `directory`, `file` (relative to it) and `arguments`.

    The main file and those that continue it may have an ending that no compiler knows: their language is named, and what stands
    before them in the program (the prologue's headers, the files they continue) is included.

    Args:
        sketch: the sketch.
        toolchain: of the sketch.
        start: runs a command.
        command: the compiler and the arguments that files of a suffix of the sketch are compiled with.
    """
    folder = sketch.folder.resolve()
    searched: dict[str, list[str]] = {}

    def entry(path: Path, suffix: str, more: Sequence[str]) -> dict[str, Any]:
        compiler, *flags = command(suffix)
        if suffix not in searched:
            searched[suffix] = _system_includes(compiler, toolchain, start)
        shown = os.path.relpath(path.resolve(), folder)
        target = toolchain.database.table("targets", needed=False).text(toolchain.architecture, "")
        told = [f"--target={target}"] if target else []
        first = [compiler, *told, *toolchain.database.texts("arguments", ())]
        return {
            "directory": str(folder),
            "file": shown,
            "arguments": [*first, *flags, *searched[suffix], *more, shown],
        }

    before = [part for name in re.findall("#include <(.+)>", toolchain.sketch.text("prologue")) for part in ("-include", name)]
    suffix = toolchain.languages[0].suffixes[0]
    for path in (sketch.main, *sketch.parts):
        named = [] if path.suffix in toolchain.suffixes else ["-x", toolchain.sketch.text("language")]
        yield entry(path, suffix, [*named, *before])
        before += ["-include", path.name]
    for path in sketch.sources:
        yield entry(path, path.suffix, [])


def _system_includes(
    compiler: str, toolchain: Toolchain, start: Callable[[Sequence[str]], subprocess.CompletedProcess[str]]
) -> list[str]:
    """The compiler's own include folders, which Clang knows only if it comes with the target's tools."""
    asked = toolchain.database.texts("tell_includes", ())
    found = _SEARCHED.search(start([compiler, *asked]).stderr) if asked else None
    folders = [os.path.normpath(line.strip()) for line in found[1].splitlines()] if found else []
    return [f"-isystem{folder}" for folder in folders]
