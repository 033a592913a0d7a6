"""Runs into one folder, at once and killed: `python -m tests.fuzz.runs [ROUNDS KILLS]`; prints counts, exits with 1 on a fault.

In each round two to four runs begin at once, by turns in a new folder and in one that is there. Then runs are killed at points
all over their time, first runs too, and whoever comes next recovers. Every file must be of one run, whole.
"""

from __future__ import annotations

import os
import random
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

from robosmi.generate import Gen
from robosmi.model.commit import STAGE, interrupted

FILES, LINES = 12, 2000


def run(folder: Path, version: int) -> None:
    """One run: as many files as there are, all of one version."""
    g = Gen(folder, {"t": "{{ body }}\n"})

    def body(n: int) -> dict[str, str]:
        return {"body": f"{version}\n" * LINES}

    g.rule(domain=range(FILES), template="t", target=lambda n: f"{n % 3}/{n}")(body)
    g.run()


def started(folder: Path, version: int) -> int:
    """A run in a process of its own."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            run(folder, version)
            code = 0
        finally:
            os._exit(code)
    return child


def whole(folder: Path) -> bool:
    """Whether all files are of one run and nothing lies beside them."""
    texts = {(folder / f"{n % 3}" / f"{n}").read_text() for n in range(FILES)}
    files = sum(path.is_file() for path in folder.rglob("*"))
    beside = [path for path in folder.parent.iterdir() if path.name.startswith(STAGE)]
    return len(texts) == 1 and all(map(of_one_run, texts)) and files == FILES and not beside


def of_one_run(text: str) -> bool:
    """Whether a file is whole."""
    return text.count("\n") == LINES and len(set(text.split())) == 1


def rounds(count: int, root: Path) -> int:
    """Runs at once; the number of rounds that went wrong."""
    wrong = 0
    for number in range(count):
        folder = root / f"at-once-{number // 2}"
        children = [started(folder, number * 10 + one) for one in range(2 + number % 3)]
        codes = [os.waitpid(child, 0)[1] for child in children]
        wrong += any(codes) or not whole(folder)
        if number % 2:
            shutil.rmtree(folder)
    print(f"runs: {count} rounds of two to four runs at once: {wrong} wrong", flush=True)
    return wrong


def kills(count: int, root: Path) -> int:
    """Runs killed, every other one a first run; the number of recoveries that went wrong."""
    chance, wrong, unfinished, none = random.Random(20), 0, 0, 0
    begun = time.monotonic()
    os.waitpid(started(root / "timed", 0), 0)
    usual = time.monotonic() - begun
    for number in range(count):
        folder = root / "killed"
        if number % 2 == 0:
            shutil.rmtree(folder, ignore_errors=True)
        child = started(folder, number)
        time.sleep(chance.random() * usual)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        unfinished += interrupted(folder)
        none += not folder.exists()
        if folder.exists():
            wrong += sum(not of_one_run(path.read_text()) for path in folder.glob("[0-9]/*"))
        run(folder, -number)
        wrong += not whole(folder)
    print(
        f"{count} kills ({unfinished} with a journal left, {none} before the folder was there): {wrong} wrong",
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
