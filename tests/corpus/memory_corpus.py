"""Compares estimates of memory with the linker's figures and with the stack seen on a simulator, for programs of a corpus.

Usage: python -m tests.corpus.memory_corpus FOLDER [--only TEXT] [--seconds N]. Each program is migrated and compiled for the
Uno; with `--seconds` it also runs on simavr, with a pattern in its free memory. A run shows the stack of what happens in it,
the bound read off the code covers all that may happen: the estimated stack should be near that bound. The estimate of the rest
should be within 10 % of .data and .bss. Constants of the estimate are tuned on the programs that are not `held_out`.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from msgspec.structs import replace

import robosmi
from robosmi.errors import RobosmiError
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.queries.plans.waiting_calls import NO_SUPPORT, TO_WRITE, CallStates
from robosmi.transformations.queries.resources.memory import Memory, memory
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.corpus.migrate_corpus import programs

NEAR = 0.1


@dataclass(frozen=True)
class Row:
    """The figures of one program.

    Attributes:
        path: its source.
        estimate: the estimate of its memory.
        linked: bytes of .data and .bss.
        written: whether each call of the platform reaches a body.
        stack: bytes of stack seen on the simulator; None if it did not run or has no room.
        bound: upper bound of the stack in bytes, read off the compiled program; None if there is none.
        interrupts: how many bytes of the bound are for interrupts.
    """

    path: str
    estimate: Memory
    linked: int
    written: bool
    stack: int | None = None
    bound: int | None = None
    interrupts: int = 0

    @property
    def estimated(self) -> int:
        """The estimate of RAM and stack together, in bytes."""
        return self.estimate.total + self.estimate.depth

    @property
    def error(self) -> float:
        """The relative error of the estimate against the linker's figure."""
        return self.estimate.total / self.linked - 1

    def __str__(self) -> str:
        """One line of the table."""
        stack = (
            f"stack {self.stack:4} estimated {self.estimate.depth:4} at most {self.bound or 0:4}"
            if self.stack is not None
            else ""
        )
        body = "" if self.written else "  (functions without a body)"
        return f"{self.linked:6} estimated {self.estimate.total:6} {100 * self.error:+7.1f} %  {stack}  {self.path}{body}"


def stack_room(elf: Path) -> tuple[int, int]:
    """The first and the last address that a program leaves for heap and stack."""
    listed = subprocess.run(["avr-nm", str(elf)], check=True, capture_output=True, text=True).stdout
    found = {words[-1]: int(words[0], 16) & 0xFFFF for line in listed.splitlines() if len(words := line.split()) == 3}
    return found["_end"], found["__stack"]


def stack_bytes(report: CompileReport, seconds: float) -> int | None:
    """The bytes of stack that a program takes on the simulator; None if it leaves no room for any."""
    if report.elf is None or report.hex is None or not report.fits:
        return None
    asked = job(report.elf, report.hex, load_board("uno"), seconds * 1e6)
    return simulate(replace(asked, stack_room=stack_room(report.elf)), "simavr").stack_bytes


def row(files: Sequence[Path], name: str, seconds: float) -> Row | None:
    """The figures of one program; None if it cannot be migrated or compiled."""
    with tempfile.TemporaryDirectory() as scratch:
        output = Path(scratch)
        try:
            plan = robosmi.migrate(list(files), output / "out").models.plan
            report = compile_sketch(output / "out", keep=output)
        except RobosmiError:
            return None
        if not report.ok or not report.ram_bytes:
            return None
        states = CallStates(plan).counts()
        stack = stack_bytes(report, seconds) if seconds else None
        known = report.stack if report.stack is not None and report.stack.certain else None
        sizes = (known.bytes, known.interrupts) if known is not None else (None, 0)
        return Row(name, memory(plan), report.ram_bytes, not (states[TO_WRITE] + states[NO_SUPPORT]), stack, *sizes)


def summary(rows: Sequence[Row]) -> list[str]:
    """The distribution of the errors, over all programs and over those without unwritten functions."""
    lines = []
    for title, chosen in (("all", rows), ("with a body for each call", [each for each in rows if each.written])):
        errors = sorted(abs(each.error) for each in chosen)
        if not errors:
            continue
        near = sum(error <= NEAR for error in errors)
        parts = ", ".join(
            f"{part} % within {100 * errors[min(len(errors) - 1, len(errors) * part // 100)]:.1f} %" for part in (50, 75, 90)
        )
        lines.append(f"{title}: {len(errors)} programs, {near} within 10 % ({100 * near / len(errors):.1f} %); {parts}")
    return lines


def stack_summary(rows: Sequence[Row]) -> list[str]:
    """How close estimate, bound and observed stack are, over the programs that ran and have a bound."""
    ran = [each for each in rows if each.stack and each.bound]
    if not ran:
        return []
    lines = [f"{len(ran)} programs with a bound and a run"]
    deep = [each for each in ran if (each.stack or 0) >= (each.bound or 0) - each.interrupts]
    for title, pairs in (
        ("bound / seen", [(each.bound, each.stack) for each in ran]),
        ("bound / seen, where the run came to the deepest place", [(each.bound, each.stack) for each in deep]),
        ("estimated stack / bound", [(each.estimate.depth, each.bound) for each in ran]),
        ("estimated stack / seen", [(each.estimate.depth, each.stack) for each in ran]),
        ("estimated RAM and stack / linker's and bound", [(each.estimated, each.linked + (each.bound or 0)) for each in ran]),
        ("estimated RAM and stack / linker's and seen", [(each.estimated, each.linked + (each.stack or 0)) for each in ran]),
    ):
        ratios = sorted((of or 0) / (against or 1) for of, against in pairs)
        if not ratios:
            continue
        near = sum(abs(ratio - 1) <= NEAR for ratio in ratios)
        below = sum(ratio < 1 for ratio in ratios)
        median, most = ratios[len(ratios) // 2], ratios[len(ratios) * 9 // 10]
        lines.append(f"  {title}: {near} of {len(ratios)} within 10 %, {below} below; median {median:.2f}, 90 % up to {most:.2f}")
    return lines


def held_out(name: str) -> bool:
    """Whether a program belongs to the test half, on which nothing is tuned; decided by the digest of its path."""
    return bool(sha256(name.encode()).digest()[0] & 1)


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--seconds", type=float, default=0.0, help="simulated time of each program; 0 leaves the stack out")
    arguments = parser.parse_args()
    rows = []
    for files in programs(arguments.corpus):
        name = str(files[0].relative_to(arguments.corpus))
        if arguments.only in name and (found := row(files, name, arguments.seconds)) is not None:
            rows.append(found)
            print(found, flush=True)
    for title, chosen in (
        ("all", rows),
        ("train", [each for each in rows if not held_out(each.path)]),
        ("held out", [each for each in rows if held_out(each.path)]),
    ):
        print("\n".join([f"--- {title}", *summary(chosen), *stack_summary(chosen)]))


if __name__ == "__main__":
    main()
