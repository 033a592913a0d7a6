"""The mutation score of the tests: `python -m tests.mutants [--tier check] [--count 60] [--seed 1] [--jobs 2] [TEST...]`.

The tests of the tier, or those of them that are named, run once and have to pass; so it is known which lines of the product which
tests execute. Then one small change at a time is made in these lines (`changes`), in memory, and the tests run until one fails:
first those that execute the line, then those that execute anything of the module, then all. What no test notices is listed, and
is a gap of the tests, unless `equivalent.toml` says why nothing can tell the change. An interrupted campaign goes on.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import random
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.mutants.changes import Change, changes
from tests.mutants.reached import REACHED, lines_reached
from tests.recording.mutant import MUTANT
from tests.tiers import TIERS

ROOT = Path(__file__).parents[2]
OUT = ROOT / "out" / "mutants"
RECORDING = ROOT / "tests" / "recording"
"""Its `sitecustomize` puts the mutant in place, in every Python that is started."""
EQUIVALENT = Path(__file__).parent / "equivalent.toml"
LIMIT_S = 3600.0
"""Seconds after which a change has made the tests endless, which is noticed."""


@dataclass(frozen=True)
class Mutant:
    """A change of a module.

    Attributes:
        module: the module's path, relative to the project.
        change: the change.
        text: the module's text as it is.
        first: the tests that execute the line.
        then: the tests that execute anything else of the module.
    """

    module: str
    change: Change
    text: bytes
    first: frozenset[str]
    then: frozenset[str]

    @property
    def name(self) -> str:
        """The name, which lasts as long as the module's text does not change."""
        return f"{self.module}:{self.change.line}: {self.change.shown(self.text)}"

    @property
    def lasting(self) -> tuple[str, str, str]:
        """Module, line and change as texts: the name in `equivalent.toml`, which lasts when lines move."""
        line = self.text.splitlines()[self.change.line - 1].decode().strip()
        return self.module, line, self.change.shown(self.text)


class Campaign:
    """Mutants and the tests of one tier.

    Attributes:
        tier: the tier whose tests run.
        jobs: the number of processes among which they are shared out; 0 for one alone.
        tests: paths of those that run; all of the tier if there are none.
    """

    def __init__(self, tier: str, jobs: int, tests: list[str]) -> None:
        self.tier = tier
        self.jobs = jobs
        self.tests = tests
        files = [path for folder in ("robosmi", "transformations", "tests") for path in sorted((ROOT / folder).rglob("*.py"))]
        texts = [path.read_bytes() for path in files] + [test.encode() for test in tests]
        self.digest = hashlib.sha256(b"".join(texts)).hexdigest()[:12]
        OUT.mkdir(parents=True, exist_ok=True)
        self.kept = OUT / f"{tier}-{self.digest}.json"

    def possible(self) -> list[Mutant]:
        """All changes of the lines that the tests execute."""
        begin = OUT / f"reached-{self.tier}-{self.digest}"
        if not (begin.parent / f"{begin.name}.done").is_file():
            print(f"the tier {self.tier} runs once, to see what it executes", flush=True)
            if self._tests(self.tests, {REACHED: str(begin)}, "-p", "tests.mutants.reached") != 0:
                raise SystemExit(f"the tier {self.tier} does not pass as it is")
            (begin.parent / f"{begin.name}.done").touch()
        return list(self._mutants(lines_reached(begin)))

    def _mutants(self, reached: dict[Path, dict[int, set[str]]]) -> Iterator[Mutant]:
        for path, lines in sorted(reached.items()):
            text = path.read_bytes()
            of_module = frozenset(test for tests in lines.values() for test in tests if test)
            for change in changes(text):
                if tests := lines.get(change.line):
                    first = frozenset(filter(None, tests))
                    yield Mutant(path.relative_to(ROOT).as_posix(), change, text, first, of_module - first)

    def judge(self, mutant: Mutant) -> str:
        """What notices a mutant: `a test of its line`, `a test of its module`, `another test`, or nothing: an empty text."""
        with tempfile.TemporaryDirectory(prefix="robosmi-mutant-") as place:
            file = Path(place) / "mutant.json"
            text = mutant.change.applied(mutant.text).decode()
            file.write_text(json.dumps({"path": os.path.realpath(ROOT / mutant.module), "text": text}))
            around = {
                MUTANT: str(file),
                "PYTHONPATH": str(RECORDING),
                "XDG_CACHE_HOME": place,
            }  # nothing that a mutant makes lasts
            if mutant.first and self._tests(mutant.first, around, "-x"):
                return "a test of its line"
            if mutant.then and self._tests(mutant.then, around, "-x"):
                return "a test of its module"
            return "another test" if self._tests(self.tests, around, "-x") else ""

    def _tests(self, tests: Iterable[str], around: dict[str, str], *options: str) -> int:
        """Run tests of the tier, all if none are named; the exit code of pytest."""
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--tier", self.tier, *options]
        command += ["-n", str(self.jobs), "--dist", "worksteal"] if self.jobs else []
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as named:
            named.write("".join(f"{test}\n" for test in sorted(tests)))
            named.flush()
            command += [f"@{named.name}"] if named.tell() else []
            try:
                done = subprocess.run(
                    command, cwd=ROOT, env=os.environ | around, capture_output=True, text=True, timeout=LIMIT_S, check=False
                )
            except subprocess.TimeoutExpired:
                return 1
        if done.returncode and REACHED in around:
            print(done.stdout[-4000:], done.stderr[-1000:])
        return done.returncode


def equivalent() -> dict[tuple[str, str, str], str]:
    """Module, line and change of the mutants that nothing can tell from the product -> the reason, classified by hand."""
    listed = tomllib.loads(EQUIVALENT.read_text(encoding="utf-8")).get("mutant", [])
    return {(each["module"], each["line"], each["change"]): each["reason"] for each in listed}


def sample(mutants: list[Mutant], count: int, seed: int) -> list[Mutant]:
    """Mutants of as many lines: lines in random order, and one change of each."""
    chance = random.Random(seed)
    lines: dict[tuple[str, int], list[Mutant]] = {}
    for each in mutants:
        lines.setdefault((each.module, each.change.line), []).append(each)
    return [chance.choice(lines[place]) for place in chance.sample(sorted(lines), min(count, len(lines)))]


def main() -> int:
    """Judge a sample, and print what was not noticed and the score."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants")
    parser.add_argument("--tier", choices=list(TIERS), default="check")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--only", default="", help="mutants of the modules whose paths contain this text")
    parser.add_argument("tests", nargs="*", help="paths of the tests to run; all of the tier if there are none")
    asked = parser.parse_args()
    campaign = Campaign(asked.tier, asked.jobs, asked.tests)
    known = equivalent()
    noticed: dict[str, str] = json.loads(campaign.kept.read_text()) if campaign.kept.is_file() else {}
    chosen = sample([each for each in campaign.possible() if asked.only in each.module], asked.count, asked.seed)
    for number, mutant in enumerate(chosen, 1):
        if mutant.name not in noticed:
            noticed[mutant.name] = campaign.judge(mutant)
            campaign.kept.write_text(json.dumps(noticed, indent=1))
        said = noticed[mutant.name] or (f"EQUIVALENT: {known[mutant.lasting]}" if mutant.lasting in known else "UNNOTICED")
        print(f"{number} [{mutant.change.kind}] {mutant.name}: {said}", flush=True)
    counted = [each for each in chosen if noticed[each.name] or each.lasting not in known]
    seen, same = sum(bool(noticed[each.name]) for each in counted), len(chosen) - len(counted)
    score = 100 * seen / max(1, len(counted))
    print(f"tier {asked.tier}: {seen} of {len(counted)} mutants noticed, {score:.0f} %; {same} are equivalent")
    return 0


if __name__ == "__main__":
    sys.exit(main())
