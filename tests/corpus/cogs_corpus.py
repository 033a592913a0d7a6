"""Run the programs of corpora that start cogs or threads of their own, and see whether these and main both get on.

Usage: python -m tests.corpus.cogs_corpus FOLDER... [--only TEXT] [--seconds N]. Each program is migrated without a drawing and
compiled for the Uno, else for the Mega 2560. In a copy of the sketch a mark is put into each function that runs in a cog and into
main: behind the brace of its body and of each loop in it a pin that nothing else drives is turned. What the simulator sees of
these pins says how often each came by, and when last. Programs of one text are run once. Run by hand; 20 programs take minutes.
"""

from __future__ import annotations

import argparse
import re
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import robosmi
from robosmi.errors import RobosmiError
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import PinTrace, simulate
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.corpus.migrate_corpus import programs

STARTS = re.compile(rb"\b(?:cog_run|cogstart|cogstart_stack|pthread_create)\s*\(")
NO_CODE = re.compile(rb"/\*.*?\*/|//[^\n]*", re.DOTALL)
FIRST_PIN = {"uno": 2, "mega": 22}
MARK = " pinMode({pin}, OUTPUT); digitalWrite({pin}, !digitalRead({pin}));"
MAIN = ("setup", "loop")


@dataclass(frozen=True)
class Row:
    """The result for one program.

    Attributes:
        path: its source.
        state: `both` (its cogs and main came by), `one` (not all of them), `tasks` (what it starts is no function of C that can
            be a coroutine: a task with a reason), `too big` (for both boards), `refused` or `not compiled`.
        board: that it ran on.
        turns: name of each function and `main` -> how often its marks were reached, and when last, in milliseconds.
        said: the start of its output, or why it did not run.
    """

    path: str
    state: str
    board: str = ""
    turns: dict[str, tuple[int, float]] = field(default_factory=dict)
    said: str = ""

    def __str__(self) -> str:
        """One line of the table."""
        turns = ", ".join(f"{name} {count} times, last at {last:.0f} ms" for name, (count, last) in self.turns.items())
        return f"{self.state:12} {self.board:4} {self.path}: {turns}  {self.said!r}"


def marked(text: bytes, name: str, pin: int) -> tuple[bytes, int]:
    """A text with marks in the bodies of the functions with a name, and the number of marks."""
    found = [t for t in tokens(text) if t[0] not in ("comment", "directive")]
    words = [t[3] for t in found]
    places, depth, inside = [], 0, None
    for at, word in enumerate(words):
        if word == "{":
            head = _before_brackets(words, at)
            if inside is None and depth == 0 and head is not None and words[head] == name:
                inside = depth
                places.append(found[at][2])
            elif inside is not None and (words[at - 1] == "do" or (head is not None and words[head] in ("while", "for"))):
                places.append(found[at][2])
            depth += 1
        elif word == "}":
            depth -= 1
            if inside == depth:
                inside = None
    for place in reversed(places):
        text = text[:place] + MARK.format(pin=pin).encode() + text[place:]
    return text, len(places)


def _before_brackets(words: Sequence[str], brace: int) -> int | None:
    """The index of the word before the parentheses that end before a brace; None if there are none."""
    if not brace or words[brace - 1] != ")":
        return None
    depth = 0
    for at in range(brace - 1, 0, -1):
        depth += (words[at] == ")") - (words[at] == "(")
        if not depth:
            return at - 1
    return None


def with_marks(sketch: Path, functions: Sequence[str], first: int) -> dict[str, int]:
    """Put marks into the files of a sketch; returns the pin for each function that has marks, and for main."""
    pins: dict[str, int] = {}
    for path in sorted(sketch.iterdir()):
        if path.suffix not in (".ino", ".cpp", ".h"):
            continue
        text = path.read_bytes()
        for number, name in enumerate([*functions, *MAIN]):
            title, pin = ("main", first + len(functions)) if name in MAIN else (name, first + number)
            text, count = marked(text, name, pin)
            if count:
                pins[title] = pin
        path.write_bytes(text)
    return pins


def seen(trace: PinTrace, pins: dict[str, int]) -> dict[str, tuple[int, float]]:
    """How often the marks of each function were reached, and when last, in milliseconds."""
    times = {name: [at for at, level in trace.levels(f"D{pin}") if level in (0, 1)] for name, pin in pins.items()}
    return {name: (len(each), each[-1] / 1000 if each else 0.0) for name, each in times.items()}


def row(files: Sequence[Path], name: str, seconds: float) -> Row:
    """Migrate, mark and run one program."""
    said = ""
    for board, first in FIRST_PIN.items():
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            try:
                made = robosmi.migrate(list(files), folder / "out", target=board)
                together = made.models.plan.concurrency
                functions = sorted({str(each.name) for each in together.functions}) if together is not None else []
                if not functions:
                    return Row(name, "tasks")
                pins = with_marks(made.sketch, functions, first)
                report = compile_sketch(made.sketch, board, keep=folder)
            except RobosmiError as error:
                return Row(name, "refused", board, said=str(error)[:100])
            errors = [f"{f.location}: {f.message}" for f in report.diagnostics if f.severity.name == "error"]
            if not report.ok:
                return Row(name, "not compiled", board, said=(errors or [""])[0][:200])
            if report.fits:
                return _run(name, report, board, pins, functions, seconds)
            said = f"{report.flash_bytes} bytes of flash, {report.ram_bytes} of RAM"
    return Row(name, "too big", said=said)


def _run(name: str, report: CompileReport, board: str, pins: dict[str, int], functions: Sequence[str], seconds: float) -> Row:
    assert report.elf is not None
    assert report.hex is not None
    trace = simulate(job(report.elf, report.hex, load_board(board), seconds * 1e6), "simavr")
    turns = seen(trace, pins)
    all_came = all(turns.get(each, (0, 0.0))[0] for each in [*functions, "main"])
    return Row(name, "both" if all_came else "one", board, turns, trace.text[:60])


def chosen(folders: Sequence[Path], only: str) -> Iterator[tuple[str, tuple[Path, ...]]]:
    """The programs that start cogs, each text once: their names and their files."""
    known: set[bytes] = set()
    for folder in folders:
        for files in programs(folder):
            code = b"".join(NO_CODE.sub(b"", path.read_bytes()) for path in files)
            name = str(files[0].relative_to(folder))
            if STARTS.search(code) and code not in known and only in name:
                known.add(code)
                yield name, files


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--only", default="")
    parser.add_argument("--seconds", type=float, default=3.0, help="simulated time of each program")
    arguments = parser.parse_args()
    states: Counter[str] = Counter()
    for name, files in chosen(arguments.folders, arguments.only):
        found = row(files, name, arguments.seconds)
        states[found.state] += 1
        print(found, flush=True)
    print(", ".join(f"{count} {state}" for state, count in states.most_common()))


if __name__ == "__main__":
    main()
