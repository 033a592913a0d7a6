"""The mutation score of the tests: `python -m tests.mutants [--tier check] [--count 60] [--seed 1] [--jobs 2] [--stages 3]`.

All tests of the tier run once, and it is recorded which lines each of them runs (`reached`). Then one small change at a time is
made in a line of the product (`changes`), in memory, and the tests that can see it run until one fails: first some of those that
run the line, of as many test files as there are, then the rest of them, then those that run anything else of the module. With
fewer stages the score is a lower bound, and it is there much sooner. What no test notices is listed, and is a gap of the tests,
unless `equivalent.toml` says why nothing can tell the change. Results are stored in `out/mutants`: an interrupted campaign goes
on, and one with more stages begins where the other has ended.
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
from itertools import chain, zip_longest
from pathlib import Path

from tests.mutants import reached
from tests.mutants.changes import Change, changes
from tests.recording.mutant import MUTANT
from tests.source_imports import modules
from tests.tiers import TIERS

ROOT = Path(__file__).parents[2]
OUT = ROOT / "out" / "mutants"
BYTECODE = ROOT / ".pytest_cache" / "bytecode"
RECORDING = ROOT / "tests" / "recording"
"""Its `sitecustomize` puts the mutant in place, in every Python that is started."""
EQUIVALENT = Path(__file__).parent / "equivalent.toml"
LIMIT_S = 1200.0
"""Seconds after which a change has made the tests endless, which is noticed."""
FIRST = 24
"""How many of the tests that run the changed line are tried first."""
STAGES = 3
NONE_RAN = (0, 5)
"""Exit codes of pytest: all tests passed, or there was none."""
NOT_FOUND = 4
"""Exit code of pytest: a test of this name is not there, or not any more."""


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


@dataclass(frozen=True)
class Recording:
    """Which tests of a tier run which lines.

    Attributes:
        folder: where it is stored.
        failures: the tests that fail without a change; they show nothing.
    """

    folder: Path
    failures: frozenset[str]

    def tests_of_lines(self, module: str) -> dict[int, set[str]]:
        """Line of a module -> the tests that run it and pass without a change."""
        of_lines = reached.tests_of_lines(self.folder, ROOT / module)
        return {line: tests - self.failures for line, tests in of_lines.items()}


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

    def record(self, mutants: list[Mutant]) -> Recording:
        """Run all tests of the tier as they are, unless that was done for these modules."""
        texts = {each.module: each.text for each in mutants}
        digest = hashlib.sha256(b"".join(chain.from_iterable((name.encode(), text) for name, text in sorted(texts.items()))))
        folder = OUT / f"{self.tier}-{digest.hexdigest()[:12]}"
        ended = folder / "failures.json"
        if not ended.is_file():
            reached.start(folder, [ROOT / module for module in texts])
            failures = self.failures([], {reached.RECORDED: str(folder)}, "-p", "tests.mutants.reached", limit_s=None)
            ended.write_text(json.dumps(failures), encoding="utf-8")
        return Recording(folder, frozenset(json.loads(ended.read_text(encoding="utf-8"))))

    def judge(self, mutant: Mutant, stages: int, recording: Recording) -> Outcome:
        """Run the tests for a mutant until one notices it or so many stages have run, and store the outcome."""
        outcome = self.outcomes.get(mutant.name, Outcome())
        parts: tuple[list[str], ...] = ()
        while not outcome.test and outcome.stages < stages:
            parts = parts or in_stages(mutant, recording.tests_of_lines(mutant.module))
            tests = parts[outcome.stages]
            outcome = self.outcomes[mutant.name] = Outcome(outcome.stages + 1, self._failing(mutant, tests) if tests else "")
            stored = {name: {"stages": each.stages, "test": each.test} for name, each in self.outcomes.items()}
            self.stored.write_text(json.dumps(stored, indent=1), encoding="utf-8")
        return outcome

    def _failing(self, mutant: Mutant, tests: list[str]) -> str:
        """The first of some tests that fails with a mutant; empty if none does."""
        with tempfile.TemporaryDirectory(prefix="robosmi-mutant-") as place:
            file = Path(place) / "mutant.json"
            text = mutant.change.applied(mutant.text).decode()
            file.write_text(json.dumps({"path": os.path.realpath(ROOT / mutant.module), "text": text}))
            around = {MUTANT: str(file), "PYTHONPATH": str(RECORDING), "XDG_CACHE_HOME": place}  # nothing of it lasts
            return next(iter(self.failures(tests, around, "-x")), "")

    def failures(self, tests: list[str], around: dict[str, str], *options: str, limit_s: float | None = LIMIT_S) -> list[str]:
        """Those of some tests of the tier that fail.

        Args:
            tests: the tests by the names that pytest gives them; none for all.
            around: variables of the environment.
            options: options of pytest.
            limit_s: the seconds after which they are ended.
        """
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--tier", self.tier, *options]
        command += ["-n", str(self.jobs), "--dist", "worksteal"] if self.jobs else []
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        environment |= {"PYTHONPYCACHEPREFIX": str(BYTECODE), **around}
        try:
            done = subprocess.run(
                [*command, *tests], cwd=ROOT, env=environment, capture_output=True, text=True, timeout=limit_s, check=False
            )
        except subprocess.TimeoutExpired:
            return ["no end"]
        if done.returncode in NONE_RAN:
            return []
        files = list(dict.fromkeys(test.partition("::")[0] for test in tests))
        if done.returncode == NOT_FOUND and files != tests:  # the change gives tests other names
            return self.failures(files, around, *options, limit_s=limit_s)
        named = [line for line in done.stdout.splitlines() if line.startswith(("FAILED ", "ERROR "))]
        return [line.partition(" ")[2].split(" - ")[0] for line in named] or [f"pytest ends with {done.returncode}"]


def in_stages(mutant: Mutant, of_lines: dict[int, set[str]]) -> tuple[list[str], ...]:
    """The tests that can see a mutant, in the order in which they run.

    What runs when the module is imported runs in no test: all tests of the module see it.

    Args:
        mutant: the mutant.
        of_lines: line of its module -> the tests that run it.
    """
    lines = range(mutant.change.line, mutant.change.line + mutant.text[mutant.change.start : mutant.change.end].count(b"\n") + 1)
    running = one_of_each_file(chain.from_iterable(of_lines.get(line, ()) for line in lines))
    others = one_of_each_file(set(chain.from_iterable(of_lines.values())).difference(running))
    return running[:FIRST], running[FIRST:], others


def one_of_each_file(tests: Iterable[str]) -> list[str]:
    """Tests in an order that takes one of each file, then a second one of each, and so on."""
    files: dict[str, list[str]] = {}
    for test in sorted(set(tests)):
        files.setdefault(test.partition("::")[0], []).append(test)
    return [test for row in zip_longest(*files.values()) for test in row if test is not None]


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
    parser.add_argument("--stages", type=int, choices=range(1, STAGES + 1), default=STAGES)
    parser.add_argument("--only", default="", help="mutants of the modules whose paths contain this text")
    given = parser.parse_args()
    campaign = Campaign(given.tier, given.jobs)
    known = equivalent()
    chosen = sample([each for each in possible() if given.only in each.module], given.count, given.seed)
    recording = campaign.record(chosen)
    counted, seen = 0, 0
    for number, mutant in enumerate(chosen, 1):
        outcome = campaign.judge(mutant, given.stages, recording)
        reason = "" if outcome.test else known.get(mutant.lasting, "")
        counted, seen = counted + (not reason), seen + bool(outcome.test)
        result = outcome.test or (f"EQUIVALENT: {reason}" if reason else "UNNOTICED")
        print(f"{number} [{mutant.change.kind}] {mutant.name}: {result}", flush=True)
    least = "" if given.stages == STAGES else "at least "
    score = 100 * seen / max(1, counted)
    print(f"tier {given.tier}: {least}{seen} of {counted} mutants noticed, {score:.0f} %; {len(chosen) - counted} are equivalent")
    return 0


if __name__ == "__main__":
    sys.exit(main())
