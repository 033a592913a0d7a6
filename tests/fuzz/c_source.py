"""Fuzz the reader of C programs and what follows it: damaged copies of real programs, none of which may crash, hang or lie.

Usage: python -m tests.fuzz.c_source [--inputs N] [--seed N] [--seconds N] [--corpus FOLDER]. By hand (`make fuzz`), not in CI.
The inputs are read in a process of their own with bounded memory, which is started again where it dies; an input that ends in
anything but a model or a `RobosmiError`, takes longer than the limit (`costs`), or whose numbers do not add up is kept beside its
traceback. The same seed gives the same inputs.
"""

from __future__ import annotations

import argparse
import multiprocessing
import random
import resource
import sys
import tempfile
import time
import traceback
from collections import Counter
from multiprocessing.connection import Connection
from pathlib import Path

from tests.fuzz.costs import PATIENCE, SECONDS, Costs, megabytes, spent_by

ROOT = Path(__file__).resolve().parents[2]
SOURCES = (ROOT / "tests" / "transformations" / "t2m" / "c_source", ROOT / "docs" / "examples")
ADDRESSES = 3000
"""Address space in megabytes of the reading process; more than it uses."""
_ODD = (
    *(b"", b"(" * 300, b"{" * 300, b"!" * 3000, b"*" * 20, b"\0", b"\xff", b"\xef\xbb\xbf", b"#if 1\n", b"#else\n", b"#endif\n"),
    *(
        b'#include "input.c"\n',
        b"#define x x x\n",
        b"#define F(a) a a\n",
        b"F(F(F(1)))",
        b"else if (1) ;",
        b"case 1:",
        b"/*",
        b'"',
    ),
    *(b"struct {", b"typedef", b"0x", b"99999999999999999999", b"'", b"\\\n", b"??/", b"__attribute__((", b"asm(", b'"'),
)


def mutated(data: bytes, other: bytes, chance: random.Random) -> bytes:
    """A damaged copy of a program: bytes, tokens or lines changed, lost, doubled or taken from another one."""
    for _ in range(chance.choice((1, 1, 1, 2, 4, 16))):
        place = chance.randrange(len(data) + 1)
        kind = chance.randrange(7)
        if kind == 0 and data:
            place = min(place, len(data) - 1)
            data = data[:place] + bytes([chance.randrange(256)]) + data[place + 1 :]
        elif kind == 1:
            data = data[:place] + data[place + chance.randrange(1, 60) :]
        elif kind == 2:
            start = chance.randrange(len(other) + 1)
            data = data[:place] + other[start : start + chance.randrange(1, 500)] + data[place:]
        elif kind == 3:
            data = data[:place] + chance.choice(_ODD) + data[place:]
        elif kind == 4:
            marks = [i for i, byte in enumerate(data) if byte in b"(){}[];,\"'*#"]
            place = chance.choice(marks) if marks else 0
            data = data[:place] + data[place + 1 :]
        elif kind == 5:
            lines = data.split(b"\n")
            number = chance.randrange(len(lines))
            lines[number : number + 1] = [lines[number]] * chance.choice((0, 2, 60))
            data = b"\n".join(lines)
        else:
            data = data[: chance.randrange(len(data) + 1)]
    return data[:400_000]


def run_one(path: Path) -> str:
    """Read and analyse one input; "read" or "refused".

    Raises:
        Exception: a fault of ours.
    """
    from robosmi.errors import InternalError, RobosmiError
    from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
    from robosmi.transformations.queries.reports.analysis import analysis
    from robosmi.transformations.t2m.c_source import read_program

    try:
        program, findings = read_program(path)
    except InternalError:
        raise
    except RobosmiError as error:
        if not error.message or not error.fix:
            raise
        return "refused"
    size = path.stat().st_size
    for unit in program.units:
        assert int(unit.callsInText) == int(unit.callsInModel) + len(unit.unresolved), "calls do not add up"
        for declaration in unit.declarations:
            assert str(unit.encoding) == "UTF-16" or 0 <= int(declaration.startOffset) <= int(declaration.endOffset) <= size
    analysis(program, findings, ApiIndex.load("propeller"))
    return "read"


def worker(connection: Connection) -> None:
    """Read the inputs whose paths arrive, and answer with the outcome or the traceback."""
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESSES << 20, ADDRESSES << 20))
    while (path := connection.recv()) is not None:
        try:
            state, said = run_one(path), ""
        except BaseException:
            state, said = "failed", traceback.format_exc()
        connection.send((state, said, megabytes()))


class Reader:
    """The reading process, started again where it died."""

    def __init__(self) -> None:
        self.costs = Costs()
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._connection, theirs = context.Pipe()
        self._process = context.Process(target=worker, args=(theirs,), daemon=True)
        self._process.start()
        theirs.close()

    def read(self, path: Path) -> tuple[str, str]:
        """State and traceback of one input."""
        process = self._process.pid or 0
        before, begun = spent_by(process), time.monotonic()
        self._connection.send(path)
        try:
            took = 0.0
            while not (answered := self._connection.poll(1)) and took < SECONDS and time.monotonic() - begun < PATIENCE:
                took = spent_by(process) - before
            took = spent_by(process) - before
            state, text, memory = self._connection.recv() if answered else ("", "", 0)
            self.costs.add(took, time.monotonic() - begun, memory)
            if answered and took < SECONDS:
                return str(state), str(text)
            reason = ("failed", f"took {took:.1f} s of processor time")
        except (EOFError, ConnectionError):
            self._process.join(5)
            reason = ("failed", f"the process died: exit code {self._process.exitcode}")
        self._process.kill()
        self._process.join()
        self._start()
        return reason

    def close(self) -> None:
        """End the process."""
        self._connection.send(None)
        self._process.join(5)


def main() -> int:
    """The command line; the exit code is 1 when an input crashed, hung or gave numbers that do not add up."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=0, help="stop after this time (default: never)")
    parser.add_argument("--corpus", type=Path, action="append", default=[], help="a folder with further programs")
    parser.add_argument("--keep", type=Path, default=Path("out") / "fuzz", help="where inputs that fail are kept")
    arguments = parser.parse_args()
    paths = [
        p for folder in (*SOURCES, *arguments.corpus) for p in sorted(folder.rglob("*")) if p.suffix in (".c", ".cpp", ".ino")
    ]
    programs = [(p.suffix, p.read_bytes()) for p in paths if p.is_file() and p.stat().st_size < 100_000]
    chance = random.Random(arguments.seed)
    states, begun = Counter[str](), time.monotonic()
    reader = Reader()
    with tempfile.TemporaryDirectory() as scratch:
        for number in range(arguments.inputs):
            ending, data = chance.choice(programs)
            data = mutated(data, chance.choice(programs)[1], chance)
            path = Path(scratch) / f"input{ending}"
            path.write_bytes(data)
            state, text = reader.read(path)
            states[state] += 1
            if state == "failed":
                arguments.keep.mkdir(parents=True, exist_ok=True)
                (arguments.keep / f"{arguments.seed}-{number}{ending}").write_bytes(data)
                (arguments.keep / f"{arguments.seed}-{number}.txt").write_text(text)
                print(f"{number}: {text.strip().splitlines()[-1]}", file=sys.stderr)
            if arguments.seconds and time.monotonic() - begun > arguments.seconds:
                break
    reader.close()
    print(f"programs: {sum(states.values())} inputs from {len(programs)} programs: {dict(states)}; {reader.costs}")
    return int(states["failed"] > 0 or reader.costs.over())


if __name__ == "__main__":
    sys.exit(main())
