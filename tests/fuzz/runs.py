"""Runs into one folder, at once and killed: `python -m tests.fuzz.runs [ROUNDS KILLS]`; prints counts, exits with 1 on a fault.

In each round two to four migrations begin at once, by turns in a new folder and in one that is there; what is there in the end
must be what one of them makes alone, byte for byte. Then runs are killed with signal 9 before their n-th step that Python tells
(opening, making, moving, removing a file), first runs and later ones by turns. The next run is by the same user, by one who has
not made the journal, or in a place that the folder was moved to: it recovers, or it stops and changes nothing, and the first
user's next run recovers. Runs are forked processes, since starting an interpreter each time would take longer than the race.
"""

from __future__ import annotations

import functools
import os
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import robosmi
from robosmi.errors import StoppedError
from robosmi.files.recovery import STAGE, interrupted
from robosmi.generate import Gen
from tests.running import tree

FILES = 40
LINES = 500
VERSIONS = 4
_STEPS = {"open", "os.mkdir", "os.rename", "os.remove", "os.rmdir", "os.chmod"}
_PROGRAM = '#include "simpletools.h"\nint main() {{ high({pin}); pause({pause}); print("{pause}"); }}\n'


def forked(work: Callable[[], object]) -> int:
    """Fork a process that does some work and exits with 0 if it succeeds."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            work()
            code = 0
        finally:
            os._exit(code)
    return child


def ended(child: int) -> int:
    """Wait for a process and return how it ended."""
    return os.waitpid(child, 0)[1]


# ---- at once


def programs(root: Path) -> list[Path]:
    """Programs of one name that differ."""
    made = []
    for number in range(VERSIONS):
        path = root / "programs" / str(number) / "blink.c"
        path.parent.mkdir(parents=True)
        path.write_text(_PROGRAM.format(pin=number, pause=number * 100))
        made.append(path)
    return made


def rounds(count: int, root: Path) -> int:
    """Run migrations at the same time; returns the number of rounds that went wrong."""
    given = programs(root)
    alone = []
    for number, program in enumerate(given):
        robosmi.migrate([program], root / "alone" / str(number))
        alone.append(tree(root / "alone" / str(number)))
    wrong, ends = 0, [0] * VERSIONS
    start = time.perf_counter()
    for number in range(count):
        folder = root / "at-once" / str(number // 2)
        children = [
            forked(functools.partial(robosmi.migrate, [given[(number + one) % VERSIONS]], folder))
            for one in range(2 + number % 3)
        ]
        codes = [ended(child) for child in children]
        found = tree(folder)
        beside = [path for path in folder.parent.iterdir() if path.name.startswith(STAGE)]
        if any(codes) or found not in alone or beside:
            wrong += 1
        else:
            ends[alone.index(found)] += 1
        if number % 2:
            shutil.rmtree(folder)
    print(
        f"{count} rounds of two to four runs at once in {time.perf_counter() - start:.0f} s: {wrong} wrong; "
        f"the programs that came last: {' '.join(map(str, ends))}",
        flush=True,
    )
    return wrong


# ---- killed


def run(folder: Path, version: int) -> None:
    """One run: it writes all files there are, all of one version."""
    g = Gen(folder, {"t": "{{ body }}"})

    def body(n: int) -> dict[str, str]:
        return {"body": f"{version}\n" * LINES + "."}

    g.rule(domain=range(FILES), template="t", target=lambda n: f"{n % 3}/{n}")(body)
    g.run()


def steps(work: Callable[[], object]) -> int:
    """Number of steps of some work that Python reports to audit hooks."""
    reading, writing = os.pipe()

    def counted() -> None:
        found = [0]
        sys.addaudithook(lambda event, _: found.__setitem__(0, found[0] + (event in _STEPS)))
        work()
        os.write(writing, str(found[0]).encode())

    code = ended(forked(counted))
    os.close(writing)
    with os.fdopen(reading) as answer:
        assert code == 0
        return int(answer.read())


def killed_at(step: int, work: Callable[[], object]) -> None:
    """Do some work in a process that is killed before its n-th step."""

    def doomed() -> None:
        left = [step]

        def hook(event: str, _: object) -> None:
            if event in _STEPS:
                left[0] -= 1
                if left[0] == 0:
                    os.kill(os.getpid(), signal.SIGKILL)

        sys.addaudithook(hook)
        work()

    ended(forked(doomed))


def versions(folder: Path) -> set[str]:
    """The versions present in a folder; an incomplete file counts as `broken`, a missing file as `missing`."""
    files = {path for path in folder.glob("[0-9]/*") if path.is_file()}
    texts = [path.read_text() for path in files]
    found = {text.partition("\n")[0] if text.count("\n") == LINES and text[-1] == "." else "broken" for text in texts}
    return found | ({"missing"} if 0 < len(files) < FILES else set())


def whole(folder: Path, version: int) -> bool:
    """Whether all files are of one version, and nothing lies beside them or beside the folder."""
    beside = [path for path in folder.parent.iterdir() if path.name.startswith(STAGE)]
    files = sum(path.is_file() for path in folder.rglob("*"))
    return versions(folder) == {str(version)} and files == FILES and not beside


@contextmanager
def another_user(root: Path) -> Iterator[None]:
    """Act as a user who has no record of the first user's runs."""
    before = os.environ["ROBOSMI_HOME"]
    os.environ["ROBOSMI_HOME"] = str(root / "another-home")
    try:
        yield
    finally:
        os.environ["ROBOSMI_HOME"] = before


def stops_or_recovers(folder: Path, version: int) -> bool:
    """Whether the next run, by a user who does not know the killed one, changes nothing if files wait, and else succeeds."""
    before = tree(folder)
    left = any((folder / STAGE).glob("*"))
    try:
        run(folder, version)
    except StoppedError:
        return left and tree(folder) == before
    return not left and whole(folder, version)


def kills(count: int, root: Path) -> int:
    """Kill runs; returns the number of recoveries that went wrong."""
    folder, wrong, journals, none = root / "killed", 0, 0, 0
    first = steps(lambda: run(folder, 1))
    shutil.rmtree(folder)
    run(folder, 1)
    later = steps(lambda: run(folder, 2))
    start = time.perf_counter()
    for number in range(count):
        shutil.rmtree(folder, ignore_errors=True)
        if number % 2:
            run(folder, 1)
        points, at = (later, number // 2) if number % 2 else (first, number // 2)
        killed_at(1 + at * points // max(count // 2, 1) % points, lambda: run(folder, 2))
        journals += interrupted(folder)
        none += not folder.exists()
        good = "broken" not in versions(folder) and (interrupted(folder) or versions(folder) in (set(), {"1"}, {"2"}))
        if number % 4 >= 2 and folder.exists():
            if number % 8 < 4:
                with another_user(root):
                    good &= stops_or_recovers(folder, 3)
            else:
                folder.rename(root / "moved")
                good &= stops_or_recovers(root / "moved", 3)
                (root / "moved").rename(folder)
        run(folder, 4)
        wrong += not (good and whole(folder, 4))
    print(
        f"{count} kills at {first} points of a first run and {later} of a later one in {time.perf_counter() - start:.0f} s "
        f"({journals} with a journal left, {none} before the folder was there): {wrong} wrong",
        flush=True,
    )
    return wrong


def main(words: list[str]) -> int:
    """Both, with the counts of the command line."""
    with tempfile.TemporaryDirectory() as root:
        os.environ["ROBOSMI_HOME"] = f"{root}/home"
        at_once, killed = [int(word) for word in words] or [500, 300]
        return int(bool(rounds(at_once, Path(root)) + kills(killed, Path(root))))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
