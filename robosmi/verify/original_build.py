"""The original program as a program of this machine: the user's files, unchanged, compiled and linked with a host model.

What the user's files and the model's libraries call `x` is linked as the model's prefix and `x`, so that no name of theirs can
reach this machine's C library: what is not among the model's functions, nor among those that it lets through, ends the run with
its name. As on the platform, a function of the program goes before the library's of the same name. Running it is
`original_run`'s, what was covered `original_coverage`'s.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from time import monotonic

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import InternalError, MissingToolError, VerificationError
from robosmi.verify.host_model import HostModel
from robosmi.verify.toolchains import archives
from robosmi.verify.toolchains.machine_faults import check_machine
from robosmi.verify.toolchains.processes import in_parallel
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.tools import run, tool_version

_MODEL_NAME = re.compile(r"host_|__gcov|__sanitizer|__(?:start|stop)_program_|_GLOBAL_OFFSET_TABLE_")
_ARITHMETIC = re.compile(
    r"__(?:u?(?:div|mod|divmod|cmp)[sdt]i\d|(?:ash[lr]|lshr|mul|neg|ffs|clz|ctz|popcount|parity)[sd]i\d|fix\w+|float\w+)"
)
"""What gcc calls for arithmetic that the machine has no instruction for."""
_COUNTERS = re.compile(r"__gcov0\.")
_MESSAGE = re.compile(r"^(?P<path>[^\n:]+):(?P<line>\d+):(?:(?P<column>\d+):)? (?:fatal )?error: (?P<message>.*)$", re.MULTILINE)
_IN_MACRO = re.compile(
    r"^<[\w-]+>: (?:fatal )?error: (?P<message>.*)\n"
    r"(?P<path>[^\n:]+):(?P<line>\d+):(?:(?P<column>\d+):)? note: in expansion of macro",
    re.MULTILINE,
)
"""A compiler message about the expansion of a macro from the command line; its note has the place."""
_TWICE = re.compile(r"multiple definition of [`']([^`']+)'")
_GENERATED = "unmodelled.c"
VARIANT = "$"
"""Separator in the file name of a replacement for a header without a model; what follows it only makes names unique."""


class OriginalProgram(Struct, frozen=True):
    """A program that is ready to run.

    Attributes:
        binary: the program; it lies in the folder that it was built in, with all that measuring its coverage takes.
        model: the host model.
        sources: the user's files.
        compiler: name and version of the compiler.
        unmodelled: functions that it calls and that neither it nor the model has; reaching one ends a run.
        counters: place and size in bytes of each function's coverage counters in the data that a run leaves.
    """

    binary: Path
    model: HostModel
    sources: tuple[Path, ...]
    compiler: str
    unmodelled: tuple[str, ...]
    counters: tuple[tuple[int, int], ...]


def build_original(
    sources: Sequence[Path],
    model: HostModel,
    folder: Path,
    include_folders: Sequence[Path] = (),
    headers: Mapping[str, str] | None = None,
    limit_s: float = 60.0,
) -> OriginalProgram:
    """Compile and link a program.

    Args:
        sources: the user's C files; they are only read.
        model: the host model of their platform.
        folder: an empty folder of the caller's, in which everything is made.
        include_folders: where headers of the program are looked for, beside the file that includes them.
        headers: name -> text of further headers, looked for last.
        limit_s: seconds of this machine's time for all of it.

    Raises:
        MissingToolError: the host's compiler is not installed, or cannot make programs of the platform's word size.
        VerificationError: the program does not compile or link, or that takes too long.
    """
    build = _Build(model, folder.resolve(), monotonic() + limit_s)
    return build.program([path.resolve() for path in sources], [path.resolve() for path in include_folders], headers or {})


def missing_tools(model: HostModel) -> str | None:
    """The instruction for installing what is missing to build programs with a host model; None if nothing is."""
    with temporary_folder("original") as place:
        try:
            _Build(model, Path(place), monotonic() + 10).probe()
        except MissingToolError as error:
            return error.fix
    return None


class _Build(Struct, dict=True):
    model: HostModel
    folder: Path
    until: float

    def program(self, sources: list[Path], include_folders: list[Path], headers: Mapping[str, str]) -> OriginalProgram:
        self._find_tools()
        library = self._library()
        known = set(_defined(self.tools["names"], library))
        more = self.folder / "headers"
        for name, text in headers.items():
            (more / name).parent.mkdir(parents=True, exist_ok=True)
            (more / name).write_text(text, encoding="utf-8")
        flags = [*self._flags("machine"), *self._flags("program"), *self._flags("hooks")]
        flags += [f"-I{path}" for path in include_folders] + self._headers() + ["-isystem", str(more)]
        objects = [self.folder / f"{number}-{path.stem}.o" for number, path in enumerate(sources)]
        jobs = [
            ["command", *flags, f"-fmacro-prefix-map={path.parent}/=", "-c", str(path), "-o", str(target)]  # of __FILE__
            for path, target in zip(sources, objects, strict=True)
        ]
        self._run_all(jobs)
        joined, named = self.folder / "joined.o", self.folder / "program.o"
        self._run(
            "linker", "-r", "-m", self.model.compiler.text("linker_machine"), "-o", str(joined), *(str(path) for path in objects)
        )
        names = self._names(joined)
        if "main" not in names.defined:
            raise VerificationError("the program has no function main", fix="name the file that has it, too")
        sections = {".bss": "program_data", ".init_array": "program_setup", ".text": "program_text"}
        renamed = [word for old, new in sections.items() for word in ("--rename-section", f"{old}={new}")]
        self._rename(joined, named, names, *renamed)
        known |= {self.model.prefix + name for name in names.defined}
        unmodelled = sorted(name for name in names.undefined if self._is_own(name) and self.model.prefix + name not in known)
        binary = self.folder / "original"
        self._link(binary, named, *([self._stubs(unmodelled)] if unmodelled else []), library)
        unknown = tuple(dict.fromkeys(_as_written(name) for name in unmodelled))
        return OriginalProgram(binary, self.model, tuple(sources), self.compiler, unknown, names.counters)

    # ---- the model, compiled once

    def _library(self) -> Path:
        flags = [*self._flags("machine"), *self._flags("program"), *self._flags("chip")]
        name = f"host-{self.model.platform}-{archives.digest(self.model.files, self.compiler, flags)}.a"
        return archives.cached(name) or archives.keep(self._compile_model(name), name)

    def _compile_model(self, name: str) -> Path:
        folder = self.folder / "model"
        folder.mkdir(exist_ok=True)
        include = f"-I{self.model.folder / 'include'}"
        kinds = {"chip": [*self._flags("chip"), include], "libraries": [*self._flags("program"), "-O1", *self._headers()]}
        jobs, objects = [], []
        for part, flags in kinds.items():
            for path in self.model.sources(part):
                objects.append(folder / f"{part}-{path.stem}.o")
                jobs.append(["command", *self._flags("machine"), *flags, "-c", str(path), "-o", str(objects[-1])])
        self.probe()
        self._run_all(jobs)
        for path in objects:
            if path.name.startswith("libraries-"):
                names = self._names(path)
                weak = [word for each in names.defined for word in ("--weaken-symbol", self.model.prefix + each)]
                self._rename(path, path, names)
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
                f"{self.compiler} cannot make programs of this kind here ({' '.join(self._flags('machine')[:1])})",
                fix=self.model.install,
            )

    # ---- names

    def _is_own(self, name: str) -> bool:
        return not (_MODEL_NAME.match(name) or _ARITHMETIC.fullmatch(name) or name in self.model.same)

    def _names(self, path: Path) -> _Names:
        return _read_names(self._run("names", "-S", str(path)))

    def _rename(self, path: Path, target: Path, names: _Names, *more: str) -> None:
        own = {name for name in names.undefined if self._is_own(name)}
        own |= {name for name in names.defined if not _MODEL_NAME.match(name)}
        table = target.with_suffix(".names")
        table.write_text("".join(f"{name} {self.model.prefix}{name}\n" for name in sorted(own)))
        self._run("rename", f"--redefine-syms={table}", *more, str(path), str(target))

    # ---- linking

    def _stubs(self, unmodelled: Iterable[str]) -> Path:
        """Functions that end the run with their name."""
        source, target = self.folder / _GENERATED, self.folder / "unmodelled.o"
        source.write_text(
            "void host_unmodelled(const char *name);\n"
            + "".join(
                f'void {self.model.prefix}{name}(void) {{ host_unmodelled("{_as_written(name)}"); }}\n' for name in unmodelled
            )
        )
        self._run("command", *self._flags("machine"), "-c", str(source), "-o", str(target))
        return target

    def _link(self, binary: Path, *parts: Path) -> None:
        command = [self.tools["command"], *(str(part) for part in parts), *self._flags("link"), "-o", str(binary)]
        done = self._start(command)
        if done.returncode != 0:
            raise InternalError(f"the program cannot be linked with the host model: {done.stderr.strip()[-500:]}")

    # ---- running tools

    def _flags(self, name: str) -> tuple[str, ...]:
        return self.model.compiler.texts(name)

    def _headers(self) -> list[str]:
        return [word for path in self.model.headers for word in ("-isystem", str(path))]

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
                    fix=f"mend that file: it is compiled as programs of '{self.model.platform}' are, with their headers alone",
                )  # fmt: skip
            taken = found["message"].startswith("conflicting types for")
            raise VerificationError(
                f"the original does not compile on this machine: {found['message']}", location=place,
                fix="rename it in the program: a header of its platform declares that name" if taken
                else "name the program's other files and folders of headers; or the model of its platform lacks that name",
            )  # fmt: skip
        if twice := set(_TWICE.findall(done.stderr)):
            raise VerificationError(f"the program defines {', '.join(sorted(twice))} more than once", fix="keep one of them")
        raise InternalError(f"'{self.model.compiler.text(role)}' failed: {done.stderr.strip()[-500:]}")

    def _start(self, command: Sequence[str]) -> subprocess.CompletedProcess[str]:
        try:
            return check_machine(command[0], run(command, self.folder, _environment(), self.until - monotonic()))
        except MissingToolError as error:
            raise MissingToolError(error.message, fix=self.model.install) from error


def _as_written(name: str) -> str:
    """A name as the program writes it (see `VARIANT`)."""
    return name.partition(VARIANT)[0]


class _Names(Struct, frozen=True):
    """The global names of an object or archive, and the place and size of its coverage counters."""

    defined: frozenset[str]
    undefined: frozenset[str]
    counters: tuple[tuple[int, int], ...]


def _read_names(said: str) -> _Names:
    """Parse the output of `nm -S`: value and size (if any), kind and name."""
    found = [words for line in said.splitlines() if len(words := line.split()) >= 2]
    return _Names(
        frozenset(name for *_, kind, name in found if kind not in "Uw" and (kind.isupper() or kind in "vu")),
        frozenset(name for *_, kind, name in found if kind in "Uw"),
        tuple((int(words[0], 16), int(words[1], 16)) for words in found if len(words) == 4 and _COUNTERS.match(words[3])),
    )


@cache
def _defined(tool: str, archive: Path) -> frozenset[str]:
    """The names that an archive defines; its name says its content (see `archives`), so that it is read once."""
    return _read_names(run([tool, "-S", str(archive)]).stdout).defined


def _environment() -> dict[str, str]:
    """A compiler that speaks English and takes nothing from its surroundings but where programs are."""
    import os

    return {"PATH": os.environ.get("PATH", os.defpath), "LC_ALL": "C"}


@cache
def compiler_version(path: str) -> str:
    """The version that a compiler tells, `unknown` if it tells none."""
    return tool_version(path, ["--version"])
