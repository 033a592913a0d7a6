"""The launcher that starts the original program inside its sandbox (`sandbox.c`), compiled once for each compiler.

The program's code is a stranger's. The launcher sets the limits of its process and the filter of system calls, and only then
starts it; a kernel that cannot do this is reported before anything runs.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

from msgspec import Struct

from robosmi.errors import MissingToolError
from robosmi.verify.toolchains import archives
from robosmi.verify.toolchains.tools import run

SOURCE = Path(__file__).with_suffix(".c")
FLAGS = ("-m64", "-static", "-O1", "-Wall", "-Wextra")
TRUST = "--trust-original"
"""The option with which the user lets a program run outside of the sandbox."""
_CHECK_S = 10.0


class Launcher(Struct, frozen=True):
    """The compiled launcher.

    Attributes:
        path: the program.
        strict: whether the original starts only inside the whole sandbox.
    """

    path: Path
    strict: bool = True

    def command(self, program: Path | None, seconds: int) -> list[str]:
        """The command that starts a program from this process.

        Args:
            program: what to start; if None, the launcher only tries what it needs.
            seconds: the program's processor time.
        """
        words = [str(self.path), str(os.getpid()), str(seconds), str(int(self.strict))]
        return words if program is None else [*words, str(program)]


def launcher(
    compile_it: Callable[[Path], subprocess.CompletedProcess[str]], compiler: str, place: Path, strict: bool
) -> Launcher:
    """The launcher, from the cache of compiled archives where it is there.

    Args:
        compile_it: compiles `SOURCE` with `FLAGS` into the file that it is given.
        compiler: name and version of the compiler.
        place: a folder of the caller's.
        strict: see `Launcher`.

    Raises:
        MissingToolError: the compiler cannot make it, or the kernel lacks what it needs.
    """
    name = f"sandbox-{archives.digest([SOURCE], compiler, FLAGS)}"
    found = archives.cached(name)
    if found is None:
        made = place / "sandbox"
        done = compile_it(made)
        if done.returncode != 0:
            raise MissingToolError(
                f"{compiler} cannot build the sandbox launcher: {done.stderr.strip()[-300:]}",
                fix="install a 64-bit compiler with the C library's headers and static libraries",
            )
        found = archives.store(made, name)
    made_launcher = Launcher(found, strict)
    if reason := _missing(made_launcher):
        raise refusal(reason)
    return made_launcher


@cache
def _missing(tried: Launcher) -> str:
    """What the kernel lacks; empty if it has everything."""
    done = run(tried.command(None, 1), limit_s=_CHECK_S)
    if done.returncode == 0:
        return ""
    return done.stderr.strip() or f"the launcher ended with code {done.returncode}"


def refusal(reason: str) -> MissingToolError:
    """The error of a kernel that cannot keep a program in the sandbox.

    Args:
        reason: what it lacks.
    """
    return MissingToolError(
        f"this system cannot run a program in a sandbox; missing: {reason}",
        fix=f"use Linux on x86-64 with seccomp; or, only if you fully trust the program, robosmi verify {TRUST}",
    )
