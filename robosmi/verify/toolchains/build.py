"""One sketch, built for one board in a temporary folder: compile, archive, link, measure.

The sketch's own folder is only read; the tools run in it, so that their messages name its files. What tools, flags and messages
there are is data (`toolchain_data`); libraries are found by `libraries`, messages read by `messages`, archives kept
by `archives`. Which sketch and board: `toolchain`.

Also: removes the relocations from linked ELF programs (System V ABI 4.1) before they are handed out.

The linker is asked to keep relocations, because the stack depth is computed from them (`build`). But other tools then take the
file for one that is still to be linked: `addr2line` of binutils 2.26 reports wrong lines.

Also: the entries of a compilation database (as Clang defines it) for the files of a sketch, for tools that read sources.

`build` compiles one text made of the sketch's files; here each file has an entry of its own, with arguments that make Clang
read it as the compiler does. The toolchain's table `[database]` adds to these. Nothing is compiled or written here.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.progress_events import announce
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import MissingToolError
from robosmi.plugins import content
from robosmi.verify.toolchains import archives, messages
from robosmi.verify.toolchains.boards import Board
from robosmi.verify.toolchains.compile_report import (
    BADLY_NAMED,
    LITTLE_RAM,
    STAND_IN_USED,
    CompileReport,
    StackBound,
)
from robosmi.verify.toolchains.libraries import (
    STAND_IN,
    CompiledLibrary,
    LibraryFolders,
    missing_headers,
    resolve,
)
from robosmi.verify.toolchains.processes import in_parallel
from robosmi.verify.toolchains.sketch import Sketch, check_plain
from robosmi.verify.toolchains.toolchain_data import Toolchain, ToolchainLanguage, fill
from robosmi.verify.toolchains.tools import Installed

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
    installed: Installed
    index: LibraryFolders
    folder: Path

    def report(self, keep: Path | None = None) -> CompileReport:
        """Compile, link, measure."""
        check_plain(self.sketch.folder)
        main = self.folder / f"{self.sketch.main.name}{self.toolchain.languages[0].suffixes[0]}"
        main.write_text(self.sketch.text(self.toolchain), encoding="utf-8", errors="surrogateescape", newline="")
        sources = [main, *(path.resolve() for path in self.sketch.sources)]
        libraries = resolve(sources, self.index, self.toolchain.suffixes, self._missing)
        objects, said, failed = self._compile_sketch(sources, libraries)
        findings, elsewhere = messages.compiler_findings(said, self.toolchain.messages, self.sketch.folder)
        report = CompileReport(
            ok=False,
            fits=None,
            fits_on=None,
            board=self.board.name,
            tool=self._tool(),
            flash_bytes=None,
            ram_bytes=None,
            flash_limit=self.board.flash_bytes,
            ram_limit=self.board.ram_bytes,
            libraries=tuple(libraries),
            diagnostics=tuple(self._about_sketch(libraries) + findings),
            warnings_elsewhere=elsewhere,
            commands=tuple(self._commands(libraries)),
        )
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

    def _tool(self) -> str:
        linker = self.toolchain.tool(self.toolchain.link)
        return f"{linker.command} {self.installed.version}, {self.toolchain.core.text('name')} {self.installed.core_version}"

    def _about_sketch(self, libraries: Iterable[CompiledLibrary]) -> list[Finding]:
        """The findings about a sketch before it is compiled."""
        place = Location(str(self.sketch.main))
        findings = [
            Finding(
                STAND_IN_USED,
                Severity.info,
                f"the library '{library.name}' is not installed; compiled with a stand-in",
                place,
                fix=f"install the library '{library.name}' before uploading",
                evidence={"library": library.name, "compatible_with": library.version},
            )
            for library in libraries
            if library.source == STAND_IN
        ]
        if not self.sketch.well_named:
            name = self.sketch.folder.resolve().name + self.sketch.main.suffix
            message = f"the main file's name must match its folder: {name}"
            findings.append(Finding(BADLY_NAMED, Severity.warning, message, place, fix=f"rename it to {name}, or the folder"))
        return findings

    def _flags(self, suffix: str, use: str, mode: str, includes: Sequence[Path]) -> list[str]:
        """The arguments before the file: mode is `compile` or `scan`."""
        language = self.toolchain.language(suffix)
        values = self.board.fill() | {"core": str(self.installed.core)}
        texts = [*language.flags, *language.by_use[use], *self.toolchain.flags.texts("common")]
        texts += self.toolchain.flags.texts(mode)
        return fill(texts, values, {"extra_flags": self.board.extra_flags}) + [f"-I{path}" for path in includes]

    def _own_includes(self, libraries: Iterable[CompiledLibrary]) -> list[Path]:
        """Where the sketch's headers are found: its own folder (the tools run in it) first."""
        return [Path("."), *(library.include for library in libraries)]

    @staticmethod
    def _library_includes(library: CompiledLibrary, libraries: Iterable[CompiledLibrary]) -> list[Path]:
        """Where a library's headers are found: its own folders first; the sketch's folder is not among them."""
        return [*library.own_includes(), *(other.include for other in libraries if other is not library)]

    def _missing(self, source: Path, libraries: list[CompiledLibrary]) -> list[str]:
        """The headers that the preprocessor does not find when it reads a file of the sketch or of a library."""
        tool = self.toolchain.language(source.suffix).tool
        owner = next((library for library in libraries if source.is_relative_to(library.include)), None)
        includes = self._own_includes(libraries) if owner is None else self._library_includes(owner, libraries)
        flags = self._flags(source.suffix, "library" if owner else "sketch", "scan", includes)
        said = self.installed.run(tool, [*flags, str(source)], self.sketch.folder)
        return missing_headers(said.stdout, self.sketch.folder)

    def _compile(self, sources: Sequence[Path], use: str, includes: Sequence[Path], into: Path) -> tuple[list[Path], str, bool]:
        """Compile files in parallel; returns the objects, the messages, and whether one failed."""
        into.mkdir(exist_ok=True)
        announce(f"compile {len(sources)} file{'s' * (len(sources) != 1)} of the {use}")
        objects = [into / f"{number}-{source.name}.o" for number, source in enumerate(sources)]

        def one(job: tuple[Path, Path]) -> tuple[str, bool]:
            source, target = job
            flags = self._flags(source.suffix, use, "compile", includes)
            shown = os.path.relpath(source, self.sketch.folder.resolve()) if source in own else str(source)
            done = self.installed.run(
                self.toolchain.language(source.suffix).tool, [*flags, shown, "-o", str(target)], self.sketch.folder
            )
            return done.stderr, done.returncode != 0

        own = {path.resolve() for path in self.sketch.sources}
        results = list(in_parallel(one, zip(sources, objects, strict=True)))
        return objects, "".join(text for text, _ in results), any(failed for _, failed in results)

    def _compile_sketch(self, sources: Sequence[Path], libraries: list[CompiledLibrary]) -> tuple[list[Path], str, bool]:
        return self._compile(sources, "sketch", self._own_includes(libraries), self.folder / "sketch")

    def _commands(self, libraries: list[CompiledLibrary]) -> Iterator[dict[str, Json]]:
        includes = self._own_includes(libraries)
        told = partial(self._flags, use="sketch", mode="compile", includes=includes)
        return entries(self.sketch, self.toolchain, self.installed, told)

    # ---- archives of libraries and of the core

    def _archive(self, name: str, sources: Sequence[Path], use: str, includes: Sequence[Path]) -> Path:
        """The archive of sources, from the cache or made now."""
        if found := archives.cached(name):
            return found
        into = self.folder / name.removesuffix(".a")
        objects, said, failed = self._compile(sources, use, includes, into)
        archive = into / name
        if not failed:
            data = self.toolchain.archive
            arguments = fill(data.texts("arguments"), {"archive": str(archive)}, {"objects": [str(path) for path in objects]})
            done = self.installed.run(self.toolchain.tool(data).key, arguments)
            failed, said = done.returncode != 0, said + done.stderr
        if failed:
            raise _Broken(name, said)
        return archives.store(archive, name)

    def _name(self, what: str, files: Iterable[Path], sources: Sequence[Path], use: str, includes: Sequence[Path]) -> str:
        flags = [self._flags(suffix, use, "compile", includes) for suffix in sorted({path.suffix for path in sources})]
        key = archives.digest(files, self.installed.commands, self.installed.version, flags)
        plain = "".join(letter if letter.isalnum() else "_" for letter in what)
        return f"{plain}-{self.board.name}-{key}.a"

    def _archive_library(self, library: CompiledLibrary, libraries: list[CompiledLibrary]) -> Path | None:
        """The archive of a library, or None if it is headers only."""
        sources = library.files(self.toolchain.suffixes)
        if not sources:
            return None
        includes = self._library_includes(library, libraries)
        core = [self._core_sources()] if "sources" in self.toolchain.core.values else []
        folders = [*core, *(used.include for used in libraries)]
        files = [file for folder in folders for file in archives.files_below(folder)]
        return self._archive(self._name(library.name, files, sources, "library", includes), sources, "library", includes)

    def _core_sources(self) -> Path:
        return self.installed.core / self.toolchain.core.text("sources")

    def core_archive(self) -> Path:
        """The archive of the core for this board, from the cache or made now.

        Raises:
            MissingToolError: the installed core does not compile.
        """
        files = archives.files_below(self._core_sources())
        sources = [path for path in files if path.suffix in self.toolchain.suffixes]
        for text in fill(self.toolchain.core.texts("board_files"), self.board.fill()):
            files += archives.files_below(self.installed.core / text)
        files += [file for folder in self.board.folders for file in archives.files_below(folder)]
        try:
            return self._archive(self._name("core", files, sources, "core", []), sources, "core", [])
        except _Broken as broken:
            raise MissingToolError(
                f"{self.toolchain.core.text('name')} {self.installed.core_version} does not compile: {broken.first()}",
                location=Location(str(self.installed.core)),
                fix=f"reinstall it, or install another version and set its folder in {self.toolchain.core.text('env')}",
            ) from broken

    # ---- linking

    def _link(self, objects: list[Path], libraries: list[Path], report: CompileReport, keep: Path | None) -> CompileReport:
        data = self.toolchain.link
        elf, hex_file = (self.folder / f"{self.sketch.main.stem}{suffix}" for suffix in (".elf", ".hex"))
        values = self.board.fill() | {"elf": str(elf), "hex": str(hex_file)}
        if "sources" in self.toolchain.core.values:
            values["core_archive"] = str(self.core_archive())
        lists = {"objects": [str(path) for path in objects], "libraries": [str(path) for path in libraries]}
        arguments = fill(data.texts("arguments"), values, lists)
        tool = self.toolchain.tool(data).key
        done = self.installed.run(tool, arguments)
        overflow = False
        if done.returncode != 0:
            own = [self.sketch.main, *self.sketch.parts, *self.sketch.sources]
            undefined = messages.linker_findings(done.stderr, self.toolchain.messages, own)
            overflow = bool(self.toolchain.messages.pattern("overflow").search(done.stderr))
            if undefined or not overflow:
                unread = messages.assembler_findings(done.stderr, self.toolchain.messages, own)
                return _with(report, undefined or unread or [messages.unread("linking", done.stderr)])
            self.installed.run(tool, [*data.texts("measure"), *arguments])
        flash, ram = self._measure(values) if elf.is_file() else (None, None)
        fits = not overflow and flash is not None and flash <= self.board.flash_bytes and (ram or 0) <= self.board.ram_bytes
        report = replace(report, ok=True, fits=fits, fits_on=self.board.name if fits else None, flash_bytes=flash, ram_bytes=ram)
        if elf.is_file():
            report = replace(report, stack=self._stack(values))
        if fits:
            report = _with(report, self._little_ram(ram or 0, report.stack))
        return self._keep(report, values, keep) if keep is not None and not overflow else report

    def _measure(self, values: dict[str, str]) -> tuple[int, int]:
        """Flash and RAM in bytes: the sums of the sections that the data names."""
        data = self.toolchain.size
        done = self.installed.run(self.toolchain.tool(data).key, fill(data.texts("arguments"), values))
        sections = {match["section"]: int(match["bytes"]) for match in data.pattern("pattern").finditer(done.stdout)}
        flash, ram = (sum(sections.get(name, 0) for name in data.texts(kind)) for kind in ("flash", "ram"))
        return flash, ram

    def _stack(self, values: dict[str, str]) -> StackBound | None:
        """The stack bound of the program, if there is an analysis of its processor's code."""
        data = self.toolchain.stack
        if not data.values:
            return None
        done = self.installed.run(self.toolchain.tool(data).key, fill(data.texts("arguments"), values))
        found: StackBound | None = content("query", "stack_bound")(done.stdout, self.toolchain.architecture)
        return found

    def _little_ram(self, ram: int, stack: StackBound | None) -> list[Finding]:
        percent = 100 * ram // self.board.ram_bytes
        left = self.board.ram_bytes - ram
        short = stack is not None and stack.bytes > left
        if percent <= self.toolchain.size.number("ram_warn_percent") and not short:
            return []
        most = f", which needs up to {stack.bytes}" if stack is not None else ""
        message = f"the program's variables use {percent} % of the RAM; {left} bytes are left for the stack{most}"
        fix = "make arrays smaller, or move constant texts to flash"
        return [Finding(LITTLE_RAM, Severity.warning, message, Location(str(self.sketch.main)), fix=fix)]

    def _keep(self, report: CompileReport, values: dict[str, str], keep: Path) -> CompileReport:
        data = self.toolchain.hex
        done = self.installed.run(self.toolchain.tool(data).key, fill(data.texts("arguments"), values))
        if done.returncode != 0:
            return _with(replace(report, ok=False), [messages.unread("converting", done.stderr)])
        elf = keep / Path(values["elf"]).name
        elf.write_bytes(without_relocations(inputs.read_bytes(values["elf"], inputs.MODEL)))
        return replace(report, elf=elf, hex=Path(shutil.copy2(values["hex"], keep)))


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


_SEARCHED = re.compile(r"^#include <\.\.\.>.*\n((?: .*\n)*)", re.MULTILINE)
"""The list of system include folders in a compiler's verbose output."""


def entries(
    sketch: Sketch, toolchain: Toolchain, installed: Installed, flags: Callable[[str], Sequence[str]]
) -> Iterator[dict[str, Any]]:
    """The entries: `directory`, `file` (relative to it) and `arguments`.

    The main file and those that continue it may have an ending that no compiler knows: their language is named, and what stands
    before them in the program (the prologue's headers, the files they continue) is included.

    Args:
        sketch: the sketch.
        toolchain: of the sketch.
        installed: the toolchain on this machine.
        flags: the arguments that files of a suffix of the sketch are compiled with.
    """
    folder = sketch.folder.resolve()
    searched: dict[str, list[str]] = {}

    def entry(path: Path, suffix: str, more: Sequence[str]) -> dict[str, Any]:
        language = toolchain.language(suffix)
        if suffix not in searched:
            searched[suffix] = _system_includes(language, toolchain, installed)
        shown = os.path.relpath(path.resolve(), folder)
        first = [installed.commands[language.tool], *toolchain.database.texts("arguments", ())]
        return {
            "directory": str(folder),
            "file": shown,
            "arguments": [*first, *flags(suffix), *searched[suffix], *more, shown],
        }

    before = [part for name in re.findall("#include <(.+)>", toolchain.sketch.text("prologue")) for part in ("-include", name)]
    suffix = toolchain.languages[0].suffixes[0]
    for path in (sketch.main, *sketch.parts):
        named = [] if path.suffix in toolchain.suffixes else ["-x", toolchain.sketch.text("language")]
        yield entry(path, suffix, [*named, *before])
        before += ["-include", path.name]
    for path in sketch.sources:
        yield entry(path, path.suffix, [])


def _system_includes(language: ToolchainLanguage, toolchain: Toolchain, installed: Installed) -> list[str]:
    """The compiler's own include folders, which Clang knows only if it comes with the target's tools."""
    asked = toolchain.database.texts("tell_includes", ())
    found = _SEARCHED.search(installed.run(language.tool, asked).stderr) if asked else None
    folders = [os.path.normpath(line.strip()) for line in found[1].splitlines()] if found else []
    return [f"-isystem{folder}" for folder in folders]
