"""Commands interrupted by a person (Ctrl-C) at any point: a word and exit code 130, no trace of Python, no half output.

Usage: python -m tests.fuzz.interrupts [--points N] [--signals N]. By hand (`make fuzz`); tests/cli/test_interrupts.py has a few.
A migration, first or later, is interrupted before its n-th step that Python tells of (opening, making, moving, removing a file,
importing), in a forked process; then real processes are sent the signal at times spread over their life. After each the output
folder holds what was there before or all of the new files, nothing lies beside it, and the next run makes what it always makes.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from robosmi.cli.main import main as command
from robosmi.files.recovery import STAGE
from tests.running import tree

STEPS = frozenset(["open", "os.mkdir", "os.rename", "os.remove", "os.rmdir", "os.chmod", "os.listdir", "os.scandir", "import"])
PROGRAM = '#include "simpletools.h"\nint main() {{ high({pin}); pause(100); print("{pin}"); }}\n'
SIGNS = ("Traceback", "bug of robosmi", "Exception ignored", "Fatal Python")


def words(folder: Path, version: int) -> list[str]:
    """The command line of a migration into a folder; versions make different files."""
    program = folder.parent / str(version) / "blink.c"
    program.parent.mkdir(exist_ok=True)
    program.write_text(PROGRAM.format(pin=version))
    return ["migrate", str(program), "-o", str(folder)]


def forked(folder: Path, version: int, hook: Callable[[str, tuple[object, ...]], None] | None) -> tuple[int, str]:
    """A migration in a forked process with an audit hook; its exit code and what it said on standard error."""
    said = folder.parent / "said"
    given = words(folder, version)
    child = os.fork()
    if child == 0:
        code = 99
        try:
            signal.signal(signal.SIGINT, signal.default_int_handler)  # which a shell takes from what it starts in the background
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, 1)
            os.dup2(os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 2)
            sys.stdout, sys.stderr = os.fdopen(1, "w"), os.fdopen(2, "w")
            if hook is not None:
                sys.addaudithook(hook)
            code = command(given)
        except BaseException as error:
            print(f"Traceback: {error!r}", file=sys.stderr)
        finally:
            sys.stderr.flush()
            os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), said.read_text()


def counted(folder: Path, version: int) -> int:
    """Number of a migration's steps that Python reports to audit hooks."""
    reading, writing = os.pipe()

    def hook(event: str, _: tuple[object, ...]) -> None:
        if event in STEPS:
            os.write(writing, b".")

    forked(folder, version, hook)
    os.close(writing)
    with os.fdopen(reading, "rb") as steps:
        return len(steps.read())


def interrupting(point: int) -> Callable[[str, tuple[object, ...]], None]:
    """A hook that raises KeyboardInterrupt, as Ctrl-C does, before the n-th step."""
    left = [point]

    def hook(event: str, _: tuple[object, ...]) -> None:
        if event in STEPS:
            left[0] -= 1
            if left[0] == 0:
                os.kill(os.getpid(), signal.SIGINT)

    return hook


def wrong(folder: Path, code: int, said: str, allowed: list[dict[str, str]]) -> str:
    """What is wrong after an interruption; empty for nothing."""
    if code not in (0, 130):
        return f"exit code {code}: {said[-300:]}"
    if any(sign in said for sign in SIGNS):
        return f"it says {said[-300:]!r}"
    if code == 130 and said.count("robosmi: interrupted") != 1:
        return f"it says {said[-300:]!r}"
    if tree(folder) not in allowed if folder.exists() else {} not in allowed:
        return "the output is neither the old nor the new one"
    beside = [path.name for path in folder.parent.iterdir() if path.name.startswith(STAGE)]
    return f"{beside[0]} is left" if beside else ""


def points(count: int, root: Path) -> Counter[str]:
    """Interrupt forked migrations; the outcomes."""
    folder, found = root / "out", Counter[str]()
    made: list[dict[str, str]] = []
    for version in (1, 2):
        forked(folder, version, None)
        made.append(tree(folder))
    later = counted(folder, 1)
    shutil.rmtree(folder)
    first = counted(folder, 1)
    for number in range(count):
        shutil.rmtree(folder, ignore_errors=True)
        old: dict[str, str] = {}
        if number % 2:
            forked(folder, 1, None)
            old = tree(folder)
        steps = later if number % 2 else first
        at = 1 + (number // 2) * steps // max(count // 2, 1) % steps
        code, said = forked(folder, 2, interrupting(at))
        fault = wrong(folder, code, said, [old, made[1] if number % 2 else alone(root)])
        if not fault:
            forked(folder, 2, None)
            fault = "" if tree(folder) == (made[1] if number % 2 else alone(root)) else "the next run makes something else"
        found[(fault and "wrong") or ("interrupted" if code else "came through")] += 1
        if fault:
            print(f"step {at} of {steps} of a {'later' if number % 2 else 'first'} run: {fault}", file=sys.stderr)
    return found


_ALONE: dict[Path, dict[str, str]] = {}


def alone(root: Path) -> dict[str, str]:
    """The files that a first run of version 2 generates."""
    if root not in _ALONE:
        shutil.rmtree(root / "alone", ignore_errors=True)
        (root / "alone").mkdir()
        forked(root / "alone" / "out", 2, None)
        _ALONE[root] = tree(root / "alone" / "out")
    return _ALONE[root]


def signals(count: int, root: Path) -> Counter[str]:
    """Send the signal to real processes; the outcomes. What comes before our first line of code is Python's to say."""
    folder, found = root / "signals" / "out", Counter[str]()
    folder.parent.mkdir()
    given = [sys.executable, "-m", "robosmi", *words(folder, 2)]
    begun = time.monotonic()
    subprocess.run(given, capture_output=True, check=True)
    whole = time.monotonic() - begun
    made = tree(folder)
    for number in range(count):
        shutil.rmtree(folder, ignore_errors=True)
        with subprocess.Popen(
            given, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        ) as process:  # fmt: skip
            time.sleep(0.05 + number * whole / count)
            process.send_signal(signal.SIGINT)
            said = process.communicate()[1]
        if process.returncode < 0 or "<frozen site>" in said or "import site" in said or "_run_module_as_main" in said:
            found["before the program"] += 1
            fault = "half made" if folder.exists() else ""
        else:
            fault = wrong(folder, process.returncode, said, [{}, made])
            found[(fault and "wrong") or ("interrupted" if process.returncode else "came through")] += 1
        if fault:
            print(f"after {0.05 + number * whole / count:.3f} s: {fault}", file=sys.stderr)
    return found


def main() -> int:
    """The command line; the exit code is 1 when something was left behind or printed that must not be."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=300)
    parser.add_argument("--signals", type=int, default=60)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        root = Path(place)
        os.environ["ROBOSMI_HOME"] = f"{root}/home"
        (root / "points").mkdir()
        at_points = points(arguments.points, root / "points")
        print(f"interrupts: {at_points.total()} steps of migrations: {at_points['wrong']} wrong {dict(at_points)}", flush=True)
        sent = signals(arguments.signals, root)
        print(f"interrupts: {sent.total()} signals to processes: {sent['wrong']} wrong {dict(sent)}")
    if not at_points["interrupted"]:
        print("interrupts: no step was interrupted: this shows nothing", file=sys.stderr)
    return int(at_points["wrong"] + sent["wrong"] > 0 or not at_points["interrupted"])


if __name__ == "__main__":
    sys.exit(main())
