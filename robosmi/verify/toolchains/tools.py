"""Finds a toolchain's programs and core on this machine and their versions, and runs the programs.

Processes for building are started here. What to start is data (`toolchain_data`); the output is interpreted by `messages` and
`toolchain`.

Compilers read a stranger's texts, in which templates, constant expressions, macros and large arrays of a few lines let them
take gigabytes. So memory, processor time and length of files are limited. Linux enforces the limits (`prlimit`); on other
systems only the clock ends a compiler.
"""

from __future__ import annotations

import errno
import os
import re
import shutil
import signal
import subprocess
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from time import monotonic
from typing import IO, NamedTuple

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, VerificationError
from robosmi.verify.toolchains.machine_faults import check_machine
from robosmi.verify.toolchains.processes import ending_with_us
from robosmi.verify.toolchains.processor_time import ticks_asleep
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain_data import Toolchain, ToolEntry, places

LIMIT_S = 120.0
"""Seconds that one run of a compiler may take."""
_LOOK_S = 1.0
"""Seconds after which, again and again, a process is looked at that has not ended yet."""

MEMORY_MB, PROCESSOR_S, FILE_MB = 500, 10, 256
"""Limits of each process: of its address space, of its processor time, and of the length of a file that it writes."""
_WAITS_LOOKS = 5
"""Looks, one each second, after which a process that only sleeps is taken to wait for ever."""

_WORDS = {
    re.compile(rf"out of memory|memory exhausted|{re.escape(os.strerror(errno.ENOMEM))}|std::bad_alloc"): (
        "RLIMIT_AS",
        f"{MEMORY_MB} MB of memory",
    ),
    re.compile(re.escape(signal.strsignal(signal.SIGXCPU) or "SIGXCPU") if hasattr(signal, "SIGXCPU") else r"(?!)"): (
        "RLIMIT_CPU",
        f"{PROCESSOR_S} s of processor time",
    ),
    re.compile(
        rf"{re.escape(signal.strsignal(signal.SIGXFSZ) or 'SIGXFSZ')}|{re.escape(os.strerror(errno.EFBIG))}"
        if hasattr(signal, "SIGXFSZ")
        else r"(?!)"
    ): ("RLIMIT_FSIZE", f"{FILE_MB} MB in a file"),
}
"""What compilers say when they reach a limit -> the limit, and what it allows."""
_OF_THE_PROGRAM = re.compile(r"^\s*\d* \||:\d+(?::\d+)?: (?:error|warning|note): ")
"""A line that quotes the program, or is about a line of it: `#error` may use any words."""
_VALUES = {"RLIMIT_AS": MEMORY_MB << 20, "RLIMIT_CPU": PROCESSOR_S, "RLIMIT_FSIZE": FILE_MB << 20}


class Installed(NamedTuple):
    """A toolchain as found on this machine.

    Attributes:
        commands: tool key -> path of the program.
        core: the core's folder.
        core_version: what the core says about its version, or `unknown`.
        version: the version of the tool that links.
    """

    commands: Mapping[str, str]
    core: Path
    core_version: str
    version: str
    environment: Mapping[str, str]

    def run(self, tool: str, arguments: Sequence[str], cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
        """Run a tool to its end, with its output as text.

        Raises:
            SourceError: the machine let it down, as a full disk does.
        """
        return check_machine(self.commands[tool], run([self.commands[tool], *arguments], cwd, self.environment))


def run(
    command: Sequence[str],
    cwd: Path | None = None,
    environment: Mapping[str, str] | None = None,
    limit_s: float = LIMIT_S,
    stdin: IO[bytes] | None = None,
    reads_files: bool = True,
    advice: str = "look for an #include or .incbin of a special file, or for macros, templates or arrays that grow endlessly",
) -> subprocess.CompletedProcess[str]:
    """Run a command to its end, in a session of its own and with a folder of its own for temporary files.

    Args:
        command: the program and its arguments.
        cwd: the folder in which it runs; the current one if None.
        environment: of the process; this process's if None.
        limit_s: seconds after which it is given up.
        stdin: the file that it reads as its input; none if None.
        reads_files: whether it waits for nothing else, as a compiler: one that reads a pipe, and so waits for ever, is stopped.
        advice: what to do where it does not end.

    Raises:
        MissingToolError: the program cannot be started.
        VerificationError: it did not end in time, or took more than the limits allow. It and what it has started are
            ended, as after an interruption.
    """
    with temporary_folder("tool") as place, ExitStack() as stack:
        variables = {**(os.environ if environment is None else environment), "TMPDIR": place}
        start = partial(
            subprocess.Popen[str], command, cwd=cwd, env=variables, stdin=stdin or subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, encoding="utf-8", errors="replace", start_new_session=True,
        )  # fmt: skip
        try:
            process = stack.enter_context(ending_with_us(start))
        except OSError as error:
            raise MissingToolError(f"'{command[0]}' cannot be started: {error}") from error
        limits = _limit(process.pid)
        end = monotonic() + limit_s
        waiting = IdleWatch(process.pid)
        while True:
            try:
                said, complained = process.communicate(timeout=max(0.01, min(end - monotonic(), _LOOK_S)))
                break
            except subprocess.TimeoutExpired:
                too_long = f"exceeded {limit_s:.0f} s" if monotonic() >= end else ""
                if not too_long and reads_files and waiting.look():
                    too_long = "waited for a named pipe or a device"
                if too_long:
                    raise VerificationError(f"'{Path(command[0]).name}' {too_long} and was stopped", fix=advice) from None
    if too_much := exceeded(limits, process.returncode, complained):
        raise VerificationError(f"'{Path(command[0]).name}' exceeded {too_much} and was stopped", fix=advice)
    return subprocess.CompletedProcess(command, process.returncode, said, complained)


def find_tool(entry: ToolEntry, toolchain: Toolchain) -> str | None:
    """The path of a program: on PATH, else in one of the toolchain's own places."""
    path = os.environ.get("PATH", os.defpath)
    for folders in (path, *(str(place) for place in places(toolchain.tool_places))):
        if folders and (found := shutil.which(entry.command, path=folders)):
            return found
    return None


def find_core(toolchain: Toolchain) -> Path | None:
    """The core's folder: the one the environment variable names, else the first of the toolchain's places that holds one.

    Raises:
        MissingToolError: the environment variable names a folder without a core.
    """
    env, needed = toolchain.core.text("env"), toolchain.core.text("must_have")
    for named in filter(None, os.environ.get(env, "").split(os.pathsep)):
        folder = Path(named)
        listed, own = (toolchain.core.text(key, "") for key in ("listed_by", "known_by"))
        if listed and (folder / listed).is_file() and not (folder / own).exists():
            continue  # a core of another architecture
        if not (folder / needed).is_file():
            raise MissingToolError(
                f"{env} names a folder without {toolchain.core.text('name')}: there is no {needed} in it",
                location=Location(named),
                fix=f"set {env} to the folder with {needed}, or unset it",
            )
        return folder
    return next((place for place in places(toolchain.core.texts("places")) if (place / needed).is_file()), None)


def core_version(toolchain: Toolchain, core: Path) -> str:
    """What the core says about its version, or `unknown`."""
    file = core / toolchain.core.text("version_file")
    text = inputs.read_text(file, inputs.SETTINGS, errors="replace") if file.is_file() else ""
    if found := toolchain.core.pattern("version_pattern").search(text):
        return found[1].strip()
    return "unknown"


def tool_version(path: str, arguments: Sequence[str], environment: Mapping[str, str] | None = None) -> str:
    """The version that a program tells (the last number with dots of the first line that is not blank), or `unknown`."""
    said = run([path, *arguments], environment=environment)
    first = next((line for line in (said.stdout or said.stderr).splitlines() if line.strip()), "")
    numbers = re.findall(r"\d+(?:\.\d+)+", first)
    return numbers[-1] if numbers else "unknown"


def install_fix(toolchain: Toolchain, packages: Iterable[str]) -> str:
    """How packages are installed."""
    return toolchain.install.replace("{packages}", " ".join(dict.fromkeys(packages)))


def environment(toolchain: Toolchain) -> dict[str, str]:
    """The environment that the tools run in."""
    unset = toolchain.environment.texts("unset", ())
    result = {name: value for name, value in os.environ.items() if name not in unset}
    settings = toolchain.environment.table("set")
    return result | {name: settings.text(name) for name in settings.values}


def find_installed(toolchain: Toolchain) -> Installed:
    """The toolchain's tools and core on this machine.

    Raises:
        MissingToolError: something is missing; all that is missing is named, with the command that installs it.
    """
    found = {key: find_tool(entry, toolchain) for key, entry in toolchain.tools.items()}
    missing = [toolchain.tools[key].command for key, path in found.items() if path is None]
    packages = [toolchain.tools[key].package for key, path in found.items() if path is None]
    core = find_core(toolchain)
    if core is None:
        missing.append(toolchain.core.text("name"))
        packages += toolchain.core.texts("packages")
    if missing or core is None:
        raise MissingToolError(f"not installed: {', '.join(missing)}", fix=install_fix(toolchain, packages))
    commands = {key: path for key, path in found.items() if path is not None}
    linker = toolchain.tool(toolchain.link)
    env = environment(toolchain)
    version = tool_version(commands[linker.key], linker.version, env)
    return Installed(commands, core, core_version(toolchain, core), version, env)


def _limit(process: int) -> frozenset[str]:
    """Limit a process that was just started, and those that it has started meanwhile; any later one inherits the limits.

    Args:
        process: its number.

    Returns:
        The names of the limits that are tighter than those that it had.
    """
    try:
        from resource import RLIM_INFINITY, getrlimit, prlimit
    except ImportError:
        return frozenset()
    import resource

    tighter: set[str] = set()
    todo = [process]
    while todo:
        one = todo.pop()
        for name, most in _VALUES.items():
            kind = getattr(resource, name)
            soft, hard = getrlimit(kind)
            if soft == RLIM_INFINITY or soft > most:
                tighter.add(name)
                with suppress(OSError):  # it has ended
                    prlimit(one, kind, (most, hard))
        todo += _started_by(one)  # after the limits, so that none is missed
    return frozenset(tighter)


def _started_by(process: int) -> Iterator[int]:
    with suppress(OSError):
        for task in Path(f"/proc/{process}/task").iterdir():
            with suppress(OSError):
                yield from map(int, inputs.read_text(task / "children", inputs.RECORD).split())


class IdleWatch:
    """Tells whether a process waits for something that never comes, as a compiler does that opens a named pipe."""

    def __init__(self, process: int) -> None:
        self.process = process
        self.seen: dict[int, int | None] = {}
        self.looks = 0

    def look(self) -> bool:
        """Whether it, and all that it has started, slept and used no processor time at each of the last `_WAITS_LOOKS` looks."""
        now = dict(_sleeping(self.process))
        self.looks = self.looks + 1 if now and now == self.seen and None not in now.values() else 0
        self.seen = now
        return self.looks >= _WAITS_LOOKS


def _sleeping(process: int) -> Iterator[tuple[int, int | None]]:
    """A process and those that it has started, each with its ticks of processor time; None for one that does not sleep."""
    todo = [process]
    while todo:
        one = todo.pop()
        with suppress(OSError):  # it has ended, or this system does not tell
            yield one, ticks_asleep(one)
        todo += _started_by(one)


def exceeded(tighter: frozenset[str], code: int, complained: str) -> str:
    """What a process took more of than it may, as words for a message; empty if it did not.

    Args:
        tighter: the limits that are ours, as `_limit` gives them.
        code: the exit code of the process.
        complained: what it wrote to its errors.
    """
    if code == 0:
        return ""
    said = [line for line in complained.splitlines() if not _OF_THE_PROGRAM.search(line)]
    if code < 0:
        said.append(signal.strsignal(-code) or "")
    for words, (name, allowed) in _WORDS.items():
        if name in tighter and any(words.search(line) for line in said):
            return allowed
    return ""
