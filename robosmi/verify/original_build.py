"""The original program as a program of this machine: the user's files, unchanged, compiled and linked with a host model.

What the user's files and the model's libraries call `x` is linked as the model's prefix and `x`, so that no name of theirs can
reach this machine's C library: what is not among the model's functions, nor among those that it lets through, ends the run with
its name. As on the platform, a function of the program goes before the library's of the same name. Running it is
`original_run`'s, what was covered `original_coverage`'s.

A program that has other files than its own is refused: the compiler writes what it has read as a rule for `make`.

Of the directives in the assembler text that a compiler makes, only those that compilers write are let through. The text may
hold more than the compiler's own: assembler statements of the program, and the names, sections, identifications and file names
that it gives, which a compiler copies as they are. Directives that read another file (`.incbin`, `.include`), or that could
make such a directive from parts (`.macro`, `.irp`), are refused before the assembler runs.

The assembler reads quotes in its own way: behind `.type x,` it takes one away, and the text ends at the next semicolon. So
quotes are refused but in the few forms in which compilers write them, each a line of its own.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, VerificationError
from robosmi.verify.host_model import HostModel
from robosmi.verify.joined_objects import Counters, elf_at, joined, read_tool_file, rename
from robosmi.verify.linked_names import PROGRAM_DATA, AllowedNames, check_linked, library_names, names_of
from robosmi.verify.sandbox import FLAGS, SOURCE, Launcher, launcher
from robosmi.verify.toolchains import archives
from robosmi.verify.toolchains.machine_faults import check_machine
from robosmi.verify.toolchains.processes import in_parallel
from robosmi.verify.toolchains.processor_time import HANGS, used_s
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.tools import run, tool_version

_MESSAGE = re.compile(r"^(?P<path>[^\n:]+):(?P<line>\d+):(?:(?P<column>\d+):)? (?:fatal )?error: (?P<message>.*)$", re.MULTILINE)
_IN_MACRO = re.compile(
    r"^<[\w-]+>: (?:fatal )?error: (?P<message>.*)\n"
    r"(?P<path>[^\n:]+):(?P<line>\d+):(?:(?P<column>\d+):)? note: in expansion of macro",
    re.MULTILINE,
)
"""A compiler message about the expansion of a macro from the command line; its note has the place."""
_TWICE = re.compile(r"multiple definition of [`']([^`']+)'")
_CXX = (".cpp", ".cc", ".cxx", ".C")
_GENERATED = "unmodelled.c"
_FIRST = "predefined.h"
"""What the compiler of the platform defines; read before the program, which also keeps gcc from precompiled headers."""
_MOST_DATA = 1 << 24
"""Bytes of data of a program, some hundred times what its platform has."""
VARIANT = "$"
"""Separator in the file name of a replacement for a header without a model; what follows it only makes names unique."""

_PREREQUISITE = re.compile(r"(?:\\.|[^\s\\])+")
_ESCAPED = re.compile(r"\\(.)")

_NAME = r"[\w.$\x80-\xff]+"
_TEXT = r'"(?:[^"\\]|\\.)*"'
_DIRECTIVES = (
    r"\.(?:file|loc|ident|text|data|bss|section|pushsection|popsection|previous|globl|global|local|weak|weakref|hidden|internal"
    r"|protected|type|size|comm|lcomm|set|equ|align|p2align|balign|skip|space|zero|byte|value|short|word|hword|2byte|long|int"
    r"|4byte|quad|8byte|octa|float|single|double|tfloat|ascii|asciz|string|uleb128|sleb128|symver|subsection|code32|cfi_\w+)"
)
_OPERANDS = r"[-\w.$,+@%()*: \t]*"
_ORDINARY = re.compile(rf"[ \t]*(?:{_NAME}:|{_DIRECTIVES}(?:[ \t]{_OPERANDS})?|[a-z]\w*(?:[ \t]{_OPERANDS})?)?", re.ASCII)
"""Nearly every line of a compiler; what others say is looked at statement by statement."""
_QUOTED = re.compile(
    rf"[ \t]*(?:\.(?:ascii|asciz|string|ident)[ \t]+{_TEXT}"
    rf"|\.file[ \t]+(?:\d+[ \t]+)?{_TEXT}(?:[ \t]+{_TEXT})?(?:[ \t]+md5[ \t]+0x[\da-f]+)?"
    rf'|\.(?:push)?section[ \t]+[-\w.$\x80-\xff]+,[ \t]*"[\w?]*"(?:,[@%]\w+(?:,{_NAME})*)?'
    r'|#[ \t]*\d+[ \t]+"[^"\\;]*"(?: \d)?)[ \t]*',  # a place in the program, as comment
    re.ASCII,
)
"""The lines with quotes."""
_LABEL = re.compile(rf"[ \t]*{_NAME}[ \t]*:", re.ASCII)
_ASSIGNMENT = re.compile(rf"[ \t]*{_NAME}[ \t]*=", re.ASCII)
_WORD = re.compile(r"[ \t]*(?:(\.?[A-Za-z_\d][\w.]*)|$)", re.ASCII)
_NEVER = re.compile(r"\.\s*(?:incbin|include|macro|irpc?|rept|altmacro)\b", re.ASCII | re.IGNORECASE)
_SIGNS = ('"', "'", "/*", "\\", "\r", "\f", "\v", "\0")
"""Signs with which the assembler would read the rest of a line in another way than here."""


class OriginalProgram(Struct, frozen=True):
    """A program that is ready to run.

    Attributes:
        binary: the program; it lies in the folder that it was built in, with all that measuring its coverage takes.
        launcher: starts it in its sandbox.
        model: the host model.
        sources: the user's files.
        compiler: name and version of the compiler.
        unmodelled: functions that it calls and that neither it nor the model has; reaching one ends a run.
        stubbed: those that do nothing instead.
        counters: where each function's coverage counters are in the data that a run leaves.
        data_bytes: the size of that data.
        store_bytes: how many bytes of the board's memory that it keeps without power are told apart; what lies beyond is recorded
            at its address modulo this number, as on a target with less memory. All if 0; None if the program may use the pins of
            that memory itself.
    """

    binary: Path
    launcher: Launcher
    model: HostModel
    sources: tuple[Path, ...]
    compiler: str
    unmodelled: tuple[str, ...]
    stubbed: tuple[str, ...]
    counters: tuple[Counters, ...]
    data_bytes: int
    store_bytes: int | None = None


def build_original(
    sources: Sequence[Path],
    model: HostModel,
    folder: Path,
    include_folders: Sequence[Path] = (),
    headers: Mapping[str, str] | None = None,
    limit_s: float = 60.0,
    *,
    only: Collection[Path] | None = None,
    trusted: bool = False,
    stubs: Mapping[str, bool] | None = None,
) -> OriginalProgram:
    """Compile and link a program.

    Args:
        sources: the user's C files; they are only read.
        model: the host model of their platform.
        folder: an empty folder of the caller's, in which everything is made.
        include_folders: where headers of the program are looked for, beside the file that includes them.
        headers: name -> text of further headers, looked for last.
        limit_s: seconds of processor time for all of it.
        only: the files that the program may include, and those of the model; any if None.
        trusted: whether the user trusts the program, so that it may also run where the system has no sandbox for it.
        stubs: functions that do nothing if there is no model of them -> whether they return a fraction.

    Raises:
        MissingToolError: the host's compiler is not installed, or cannot make programs of the platform's word size; or the
            system has no sandbox.
        VerificationError: the program does not compile or link, or that takes too long.
    """
    files = None if only is None else frozenset(path.resolve() for path in only)
    build = _Build(model, folder.resolve(), used_s() + limit_s, files, trusted, dict(stubs or {}))
    return build.program([path.resolve() for path in sources], [path.resolve() for path in include_folders], headers or {})


def missing_tools(model: HostModel) -> str | None:
    """The instruction for installing what is missing to build programs with a host model; None if nothing is."""
    with temporary_folder("original") as place:
        try:
            _Build(model, Path(place), used_s() + 10).probe()
        except MissingToolError as error:
            return error.fix
    return None


_LEAST_S = 1.0
"""Processor time that a step may take once it has begun, in seconds."""


class _Build(Struct, dict=True):
    # until: the processor time of this process and its children at which no further step begins
    model: HostModel
    folder: Path
    until: float
    only: frozenset[Path] | None = None
    trusted: bool = False
    stubs: dict[str, bool] = {}

    def program(self, sources: list[Path], include_folders: list[Path], headers: Mapping[str, str]) -> OriginalProgram:
        self._find_tools()
        started_by = self._launcher()
        library = self._library()
        known = _defined(self.tools["names"], library)
        more = self.folder / "headers"
        more.mkdir(exist_ok=True)
        for name, text in headers.items():
            (more / name).parent.mkdir(parents=True, exist_ok=True)
            (more / name).write_text(text, encoding="utf-8")
        (self.folder / _FIRST).write_text(self.model.predefined_text)
        flags = [*self._flags("machine"), *self._flags("program"), *self._flags("hooks"), "-include", str(self.folder / _FIRST)]
        flags += [f"-I{path}" for path in include_folders]
        headers_of = {
            language: [*self._wrapped(language), *self._headers(), "-isystem", str(more)]
            for language in {_language(path) for path in sources}
        }
        objects = [self.folder / f"{number}-{path.stem}.o" for number, path in enumerate(sources)]
        for _ in in_parallel(
            lambda job: self._compile(*job, [*flags, *headers_of[_language(job[0])]]), list(zip(sources, objects, strict=True))
        ):
            pass
        made = joined(objects, self.folder, self.model, known, self._run)
        binary = self.folder / "original"
        self._link(binary, made.path, *([self._stubs(made.unmodelled)] if made.unmodelled else []), library)
        linked = elf_at(binary)
        check_linked(linked)
        data_bytes = sum(section.size for section in linked.sections if section.name == PROGRAM_DATA)
        if data_bytes > _MOST_DATA:
            raise VerificationError(
                f"the program's data are {data_bytes} bytes", fix=f"reduce them to at most {_MOST_DATA} bytes"
            )
        unknown = tuple(dict.fromkeys(_as_written(name) for name in made.unmodelled))
        left = tuple(name for name in unknown if name not in self.stubs)
        stubbed = tuple(name for name in unknown if name in self.stubs)
        return OriginalProgram(
            binary, started_by, self.model, tuple(sources), self.compiler, left, stubbed, made.counters, data_bytes
        )

    def _compile(self, source: Path, target: Path, flags: Sequence[str]) -> None:
        """Compile a file of the program, and look at the files and the assembler text that it consists of."""
        text, used = target.with_suffix(".s"), target.with_suffix(".d")
        prefix = f"-fmacro-prefix-map={source.parent}/="  # of __FILE__
        self._run("command", *flags, prefix, "-MD", "-MF", str(used), "-S", "-x", _language(source), str(source), "-o", str(text))
        included = self._files_of(used)
        if self.only is not None:
            _check_used(included, self.only, (self.folder, *self.model.headers))
        check_directives(read_tool_file(text).decode("latin-1"))
        read = [word for each in ("--MD", str(used)) for word in ("-Xassembler", each)]
        self._run("command", *self._flags("machine"), *read, "-c", str(text), "-o", str(target))
        for path in self._files_of(used):  # it also lists the names of sources in the text, which it does not open
            if path not in (text, self.folder / source.name, *included):
                raise _assembler_error(path.name)

    def _files_of(self, rule: Path) -> list[Path]:
        return list(used_files(read_tool_file(rule).decode("utf-8", "surrogateescape"), self.folder))

    # ---- the model, compiled once

    def _library(self) -> Path:
        flags = [*self._flags("machine"), *self._flags("program"), *self._flags("chip"), self.model.predefined_text]
        name = f"host-{self.model.platform}-{archives.digest(self.model.files, self.compiler, flags)}.a"
        return archives.cached(name) or archives.store(self._compile_model(name), name)

    def _compile_model(self, name: str) -> Path:
        folder = self.folder / "model"
        folder.mkdir(exist_ok=True)
        include = f"-I{self.model.folder / 'include'}"
        first = folder / _FIRST
        first.write_text(self.model.predefined_text)
        program = [*self._flags("program"), "-include", str(first), "-O1", *self._headers()]
        kinds = {"chip": [*self._flags("chip"), include], "libraries": program}
        jobs, objects = [], []
        for part, flags in kinds.items():
            for path in self.model.sources(part):
                objects.append(folder / f"{part}-{path.stem}.o")
                jobs.append(["command", *self._flags("machine"), *flags, "-c", str(path), "-o", str(objects[-1])])
        self.probe()
        self._run_all(jobs)
        chip = {path: names_of(elf_at(path)) for path in objects if path.name.startswith("chip-")}
        allowed = AllowedNames(self.model.same, frozenset[str]().union(*(names.defined for names in chip.values())))
        for path in (path for path in objects if path not in chip):
            names = names_of(elf_at(path))
            weak = [word for each in names.defined for word in ("--weaken-symbol", self.model.prefix + each)]
            rename(path, path, names, allowed, self.model.prefix, self._run)
            self._run("rename", *weak, str(path))
        library = folder / name
        self._run("archiver", "rcs", str(library), *(str(path) for path in objects))
        return library

    def _find_tools(self) -> None:
        self.tools = self.model.tools()
        self.compiler = f"{self.model.compiler.text('command')} {compiler_version(self.tools['command'])}"

    def probe(self) -> None:
        """Make sure that the compiler makes programs of the platform's word size.

        Raises:
            MissingToolError: it does not, or is not there.
        """
        self._find_tools()
        self._launcher()
        probe = self.folder / "probe.c"
        probe.write_text("#include <stdio.h>\nint main(void) { return 0; }\n")
        command = [
            self.tools["command"],
            *self._flags("machine"),
            *self._flags("link"),
            str(probe),
            "-o",
            str(self.folder / "probe"),
        ]
        done = self._start(command)
        if done.returncode != 0:
            raise MissingToolError(
                f"{self.compiler} cannot build such programs here ({' '.join(self._flags('machine')[:1])})",
                fix=self.model.install,
            )

    def _launcher(self) -> Launcher:
        def compile_it(target: Path) -> subprocess.CompletedProcess[str]:
            return self._start([self.tools["command"], *FLAGS, str(SOURCE), "-o", str(target)])

        return launcher(compile_it, self.compiler, self.folder, not self.trusted)

    # ---- linking

    def _stubs(self, unmodelled: Iterable[str]) -> Path:
        """Functions that end the run with their name, or do nothing."""
        source, target = self.folder / _GENERATED, self.folder / "unmodelled.o"
        source.write_text("void host_unmodelled(const char *name);\n" + "".join(self._stub(name) for name in unmodelled))
        self._run("command", *self._flags("machine"), "-c", str(source), "-o", str(target))
        return target

    def _stub(self, name: str) -> str:
        written = _as_written(name)
        if written not in self.stubs:
            return f'void {self.model.prefix}{name}(void) {{ host_unmodelled("{written}"); }}\n'
        # a caller finds a whole number or a pointer where it looks for the half of a longer one
        return f"{'double' if self.stubs[written] else 'long long'} {self.model.prefix}{name}(void) {{ return 0; }}\n"

    def _link(self, binary: Path, *parts: Path) -> None:
        command = [self.tools["command"], *(str(part) for part in parts), *self._flags("link"), "-o", str(binary)]
        done = self._start(command)
        if done.returncode != 0:
            raise _unusual("linked with the host model", done)

    # ---- running tools

    def _flags(self, name: str) -> tuple[str, ...]:
        return self.model.compiler.texts(name)

    def _headers(self) -> list[str]:
        return [word for path in self.model.headers for word in ("-isystem", str(path))]

    def _wrapped(self, language: str) -> list[str]:
        """The flags by which a C++ source includes the headers of the model, which are C, with C linkage; none for C."""
        if language != "c++":
            return []
        wrapped = self.folder / "cplusplus"
        for folder in self.model.headers:
            for header in folder.rglob("*.h"):
                name = header.relative_to(folder)
                (wrapped / name).parent.mkdir(parents=True, exist_ok=True)
                (wrapped / name).write_text(f'extern "C" {{\n#include_next <{name.as_posix()}>\n}}\n')
        return [*self._flags("cplusplus"), "-isystem", str(wrapped)]

    def _run_all(self, jobs: Sequence[Sequence[str]]) -> None:
        for _ in in_parallel(lambda job: self._run(*job), jobs):
            pass

    def _run(self, role: str, *arguments: str) -> str:
        done = self._start([self.tools[role], *arguments])
        if done.returncode == 0:
            return done.stdout
        if found := _MESSAGE.search(done.stderr) or _IN_MACRO.search(done.stderr):
            place = Location(found["path"], int(found["line"]), int(found["column"] or 1))
            if Path(found["path"]) in self.model.libraries:
                raise VerificationError(
                    f"the model of a library does not compile on this machine: {found['message']}", location=place,
                    fix=f"correct that file: it is compiled like programs of '{self.model.platform}', only with their headers",
                )  # fmt: skip
            taken = found["message"].startswith("conflicting types for")
            raise VerificationError(
                f"the original does not compile on this machine: {found['message']}", location=place,
                fix="rename it in the program: a platform header declares that name" if taken
                else "give the program's other files and header folders; or the host model lacks that name",
            )  # fmt: skip
        if twice := set(_TWICE.findall(done.stderr)):
            raise VerificationError(f"the program defines {', '.join(sorted(twice))} more than once", fix="remove all but one")
        raise _unusual(f"compiled on this machine by '{self.model.compiler.text(role)}'", done)

    def _start(self, command: Sequence[str]) -> subprocess.CompletedProcess[str]:
        if (left_s := self.until - used_s()) <= 0:
            raise VerificationError(
                "the original takes too long to compile on this machine", fix="give fewer or smaller files, or raise the limit"
            )
        try:
            return check_machine(command[0], run(command, self.folder, _environment(), HANGS * max(left_s, _LEAST_S)))
        except MissingToolError as error:
            raise MissingToolError(error.message, fix=self.model.install) from error


def _language(source: Path) -> str:
    """The language of a source: a compiler takes other files than sources, too, going by their names."""
    return "c++" if source.suffix in _CXX else "c"


def _as_written(name: str) -> str:
    """A name as the program writes it (see `VARIANT`)."""
    return name.partition(VARIANT)[0]


def _unusual(what: str, done: subprocess.CompletedProcess[str]) -> VerificationError:
    """The error of a tool that does not take what the compiler has made of the program."""
    return VerificationError(
        f"the program cannot be {what}: {done.stderr.strip()[-500:]}",
        fix="remove assembler text and unusual attributes from the program",
    )


@cache
def _defined(tool: str, archive: Path) -> frozenset[str]:
    """The names that an archive defines; its name says its content (see `archives`), so that it is read once."""
    return frozenset(library_names(run([tool, str(archive)]).stdout))


def _environment() -> dict[str, str]:
    """A compiler that speaks English and takes nothing from its surroundings but where programs are."""
    import os

    return {"PATH": os.environ.get("PATH", os.defpath), "LC_ALL": "C"}


@cache
def compiler_version(path: str) -> str:
    """The version that a compiler tells, `unknown` if it tells none."""
    return tool_version(path, ["--version"])


def used_files(rule: str, folder: Path) -> Iterator[Path]:
    """The files that a rule names after its target.

    Args:
        rule: the text of the rule.
        folder: where the compiler ran.
    """
    for word in _PREREQUISITE.findall(rule.partition(": ")[2].replace("\\\n", " ")):
        yield (folder / _ESCAPED.sub(r"\1", word).replace("$$", "$")).resolve()


def _check_used(used: Iterable[Path], only: Collection[Path], places: Collection[Path]) -> None:
    """Check that a program consists of no other files than it may.

    Args:
        used: the files that the compiler has read.
        only: the program's own.
        places: folders of the model, whose files any program may include.

    Raises:
        VerificationError: it has read another one.
    """
    for path in used:
        if path not in only and not any(path.is_relative_to(place) for place in places):
            raise VerificationError(
                f"the plan does not store a file that the original includes: {path}", fix="migrate the program again"
            )


def check_directives(text: str) -> None:
    """Check the text that a compiler has made of a program.

    Args:
        text: the assembler text, a character for each byte.

    Raises:
        VerificationError: it has a directive, or a form of text, that no compiler writes.
    """
    suspicious = _NEVER.search(text) is not None
    for line in text.split("\n"):
        if (suspicious or not _ORDINARY.fullmatch(line)) and not _QUOTED.fullmatch(line):
            _check_line(line)


def _check_line(line: str) -> None:
    if never := _NEVER.search(line):
        raise _assembler_error(never[0])
    for sign in _SIGNS:
        if sign in line:
            raise _assembler_error(sign)
    for statement in line.partition("#")[0].split(";"):  # the rest is a comment
        _check_statement(statement)


def _check_statement(statement: str) -> None:
    while label := _LABEL.match(statement):
        statement = statement[label.end() :]
    if _ASSIGNMENT.match(statement):
        return
    word = _WORD.match(statement)
    if word is None:
        raise _assembler_error(statement)
    if word[1] and word[1].startswith(".") and not re.fullmatch(_DIRECTIVES, word[1], re.ASCII):
        raise _assembler_error(word[1])


def _assembler_error(what: str) -> VerificationError:
    """The error for assembler text that is not compiled."""
    return VerificationError(
        f"the program has assembler text that cannot be compiled on this machine: {what.strip()!r}",
        fix="remove assembler text from the program",
    )
