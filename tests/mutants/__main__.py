"""The mutation score of the tests: `python -m tests.mutants [--tier check] [--count 60] [--seed 1] [--jobs 2] [--stages 3]`.

One small change at a time is made in a line of the product (`changes`), in memory, and the tests run until one fails: first the
test files that are nearest to the module (`nearest`), then more of them, then all others of the tier. With fewer stages the
score is a lower bound, and it is there much sooner. What no test notices is listed, and is a gap of the tests, unless
`equivalent.toml` says why nothing can tell the change. Results are stored in `out/mutants`: an interrupted campaign goes on, and
one with more stages begins where the other has ended.
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
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.mutants.changes import Change, changes
from tests.mutants.nearest import nearest
from tests.recording.mutant import MUTANT
from tests.source_imports import modules
from tests.tiers import TIERS

ROOT = Path(__file__).parents[2]
OUT = ROOT / "out" / "mutants"
BYTECODE = ROOT / ".pytest_cache" / "bytecode"
RECORDING = ROOT / "tests" / "recording"
"""Its `sitecustomize` puts the mutant in place, in every Python that is started."""
EQUIVALENT = Path(__file__).parent / "equivalent.toml"
LIMIT_S = 3600.0
"""Seconds after which a change has made the tests endless, which is noticed."""


STAGES = (8, 60, None)
"""How many of the nearest test files have run at the end of each stage; None for all."""
NONE_RAN = (0, 5)
"""Exit codes of pytest: all tests passed, or no test of the files is of the tier."""


@dataclass(frozen=True)
class Mutant:
    """A change of a module.

    Attributes:
        module: the module's path, relative to the project.
        change: the change.
        text: the module's text as it is.
    """

    module: str
    change: Change
    text: bytes

    @property
    def name(self) -> str:
        """The name, which lasts as long as the module's text does not change."""
        digest = hashlib.sha256(self.text).hexdigest()[:8]
        return f"{self.module}:{self.change.line}: {self.change.shown(self.text)} ({self.change.start} of {digest})"

    @property
    def lasting(self) -> tuple[str, str, str]:
        """Module, line and change as texts: the name in `equivalent.toml`, which lasts when lines move."""
        line = self.text.splitlines()[self.change.line - 1].decode().strip()
        return self.module, line, self.change.shown(self.text)


@dataclass(frozen=True)
class Outcome:
    """What became of a mutant.

    Attributes:
        stages: how many stages have run.
        test: the test that noticed it, or `no end`; empty for none.
    """

    stages: int = 0
    test: str = ""


class Campaign:
    """Mutants and the tests of one tier.

    Attributes:
        tier: the tier whose tests run.
        jobs: the number of processes among which they are shared out; 0 for one alone.
    """

    def __init__(self, tier: str, jobs: int) -> None:
        self.tier = tier
        self.jobs = jobs
        OUT.mkdir(parents=True, exist_ok=True)
        self.stored = OUT / f"{tier}.json"
        known = json.loads(self.stored.read_text(encoding="utf-8")) if self.stored.is_file() else {}
        self.outcomes = {name: Outcome(**each) for name, each in known.items()}

    def judge(self, mutant: Mutant, stages: int) -> Outcome:
        """Run the tests for a mutant until one notices it or so many stages have run, and store the outcome."""
        outcome = self.outcomes.get(mutant.name, Outcome())
        while not outcome.test and outcome.stages < stages:
            files = nearest(ROOT / mutant.module)
            begin = STAGES[outcome.stages - 1] if outcome.stages else 0
            test = self._failing(mutant, files[begin : STAGES[outcome.stages]])
            outcome = self.outcomes[mutant.name] = Outcome(outcome.stages + 1, test)
            stored = {name: {"stages": each.stages, "test": each.test} for name, each in self.outcomes.items()}
            self.stored.write_text(json.dumps(stored, indent=1), encoding="utf-8")
        return outcome

    def _failing(self, mutant: Mutant, files: list[Path]) -> str:
        """The first test in some files that fails with a mutant; empty if none does."""
        with tempfile.TemporaryDirectory(prefix="robosmi-mutant-") as place:
            file = Path(place) / "mutant.json"
            text = mutant.change.applied(mutant.text).decode()
            file.write_text(json.dumps({"path": os.path.realpath(ROOT / mutant.module), "text": text}))
            around = {MUTANT: str(file), "PYTHONPATH": str(RECORDING), "XDG_CACHE_HOME": place}  # nothing of it lasts
            return self.failing(files, around)

    def failing(self, files: list[Path], around: dict[str, str]) -> str:
        """The first test of the tier in some files that fails, run in this order; empty if none does.

        Args:
            files: the files.
            around: variables of the environment.
        """
        command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "--tier", self.tier]
        command += ["-n", str(self.jobs), "--dist", "worksteal"] if self.jobs else []
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        environment |= {"PYTHONPYCACHEPREFIX": str(BYTECODE), **around}
        try:
            done = subprocess.run(
                [*command, *map(str, files)],
                cwd=ROOT, env=environment, capture_output=True, text=True, timeout=LIMIT_S, check=False,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return "no end"
        if done.returncode in NONE_RAN:
            return ""
        told = [line for line in done.stdout.splitlines() if line.startswith(("FAILED ", "ERROR "))]
        return told[0].split(" - ")[0] if told else f"pytest ends with {done.returncode}"


def possible() -> Iterator[Mutant]:
    """All changes of the product's modules that are written by hand."""
    for path in modules("robosmi", "transformations"):
        text = path.read_bytes()
        for change in changes(text):
            yield Mutant(path.relative_to(ROOT).as_posix(), change, text)


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
    parser.add_argument("--jobs", type=int, default=0, help="processes that share out the tests of a mutant; 0 for one alone")
    parser.add_argument("--stages", type=int, choices=range(1, len(STAGES) + 1), default=len(STAGES))
    parser.add_argument("--only", default="", help="mutants of the modules whose paths contain this text")
    given = parser.parse_args()
    campaign = Campaign(given.tier, given.jobs)
    known = equivalent()
    chosen = sample([each for each in possible() if given.only in each.module], given.count, given.seed)
    counted, seen = 0, 0
    for number, mutant in enumerate(chosen, 1):
        outcome = campaign.judge(mutant, given.stages)
        reason = "" if outcome.test else known.get(mutant.lasting, "")
        counted, seen = counted + (not reason), seen + bool(outcome.test)
        result = outcome.test or (f"EQUIVALENT: {reason}" if reason else "UNNOTICED")
        print(f"{number} [{mutant.change.kind}] {mutant.name}: {result}", flush=True)
    least = "" if given.stages == len(STAGES) else "at least "
    score = 100 * seen / max(1, counted)
    print(f"tier {given.tier}: {least}{seen} of {counted} mutants noticed, {score:.0f} %; {len(chosen) - counted} are equivalent")
    return 0


if __name__ == "__main__":
    sys.exit(main())
