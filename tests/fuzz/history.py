"""Many processes write into one history of choices: none is refused, and every choice is counted.

Usage: python -m tests.fuzz.history [--writers N] [--records N] [--rounds N]. By hand (`make fuzz`); the test run has a short
one (`tests/recommend/test_history.py`). All writers of a round begin at once, with a file that is not there yet.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any


@dataclass
class Outcome:
    """The result of a round.

    Attributes:
        kept: how many choices the history contains at the end.
        refused: the messages of the refused ones.
        slowest: seconds of the slowest record.
    """

    kept: int = 0
    refused: list[str] = field(default_factory=list)
    slowest: float = 0.0


def _write(place: Path, number: int, each: int, gate: Any, results: Any) -> None:
    from robosmi.recommend.history import History

    refused, slowest = [], 0.0
    gate.wait()
    for n in range(each):
        begun = time.monotonic()
        try:
            History(place).record("part", "title", f"library {n % 3}", target=f"board {number % 2}")
        except Exception as error:
            refused.append(str(error))
        slowest = max(slowest, time.monotonic() - begun)
    results.put((refused, slowest))


def write_at_once(place: Path, writers: int, each: int) -> Outcome:
    """Let processes write into one history at once.

    Args:
        place: the file of the history, which is not there yet; nor need its folder be.
        writers: number of processes.
        each: number of choices that each records.
    """
    from robosmi.recommend.history import History

    context = multiprocessing.get_context("spawn")
    gate, results = context.Barrier(writers), context.Queue()
    processes = [context.Process(target=_write, args=(place, n, each, gate, results)) for n in range(writers)]
    for process in processes:
        process.start()
    outcome = Outcome()
    for _ in processes:
        refused, slowest = results.get(timeout=3600)
        outcome.refused += refused
        outcome.slowest = max(outcome.slowest, slowest)
    for process in processes:
        process.join()
    outcome.kept = sum(entry.count for entry in History(place).entries())
    return outcome


def main() -> int:
    """The command line; the exit code is 1 when a choice was lost or refused."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--writers", type=int, default=16)
    parser.add_argument("--records", type=int, default=10_000, help="choices in all rounds together")
    parser.add_argument("--rounds", type=int, default=5, help="each begins with a new file")
    arguments = parser.parse_args()
    each = arguments.records // (arguments.rounds * arguments.writers)
    wanted = each * arguments.rounds * arguments.writers
    kept = refused = 0
    slowest = 0.0
    for _ in range(arguments.rounds):
        with tempfile.TemporaryDirectory() as scratch:
            outcome = write_at_once(Path(scratch) / "new" / "history.sqlite", arguments.writers, each)
        kept, refused = kept + outcome.kept, refused + len(outcome.refused)
        slowest = max(slowest, outcome.slowest)
        for message in outcome.refused[:3]:
            print(message, file=sys.stderr)
    print(
        f"history: {wanted} choices by {arguments.writers} processes into {arguments.rounds} new files: "
        f"{wanted - refused - kept} lost, {refused} refused; slowest {slowest:.2f} s"
    )
    return int(kept != wanted or refused > 0)


if __name__ == "__main__":
    sys.exit(main())
