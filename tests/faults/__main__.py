"""Mutation score of `verify`: `python -m tests.faults [--count 100] [--seed 1] [--jobs 2] [--rewritings] [STUDY...]`.

For each case study the program is migrated and verified, then one seeded fault at a time is put into the sketch or its
adapters, and the program is compared again. Faults of all kinds take turns until so many were compared. Faults whose lines no
scenario executes, that do not compile, or that give the same machine code are dropped and only counted. Results are stored in
`kept/STUDY.json`; `equivalent.toml` lists by hand, with reasons, the faults whose program behaves like the right one. A hundred
faults take a quarter of an hour or more on two cores. An interrupted campaign goes on when it is started again, as long as the
program, its scenarios and `verify` are the same.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import tempfile
import tomllib
from collections.abc import Collection, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field
from itertools import islice
from pathlib import Path

from tests.faults.campaign import STUDIES, Outcome, Study, executed
from tests.faults.harmless import rewritings
from tests.faults.seeding import KINDS, Fault, faults

HERE = Path(__file__).parent
KEPT = HERE / "kept"
_NO_FAULT = ("same machine code", "not-compiled")


def equivalent() -> dict[tuple[str, str], str]:
    """(study, name of the fault) -> why the faulty program is equivalent to the right one."""
    listed = tomllib.loads((HERE / "equivalent.toml").read_text()).get("fault", [])
    return {(each["study"], each["fault"]): each["reason"] for each in listed}


def stale(study: str, possible: Collection[str]) -> list[str]:
    """The listed equivalent faults of a study that no longer exist, because the program's text has changed since.

    Args:
        study: the study's name.
        possible: the names of all its faults.
    """
    return [fault for name, fault in equivalent() if name == study and fault not in possible]


def in_turns(listed: list[Fault], seed: int) -> Iterator[Fault]:
    """The faults in random order, one of each kind in turn."""
    chance = random.Random(seed)
    by_kind = {kind: [fault for fault in listed if fault.kind == kind] for kind in KINDS}
    for each in by_kind.values():
        chance.shuffle(each)
    while any(by_kind.values()):
        for each in by_kind.values():
            if each:
                yield each.pop()


def run(study: Study, count: int, seed: int, jobs: int, kept: Path) -> dict[str, object]:
    """Try faults of a study until so many were compared that are not listed as equivalent; returns the results as JSON.

    Args:
        study: the case study.
        count: how many faults to compare.
        seed: seed of their order.
        jobs: how many to compare at the same time.
        kept: the file of results; those of the same program are taken from it.
    """
    reached = study.reached()
    listed = [fault for name, text in study.files.items() for fault in faults(name, text)]
    there = [f for f in listed if executed(f.lines, study.files[f.file], reached, f.file, study.files)]
    for name in stale(study.name, {fault.name for fault in listed}):
        print(f"{study.name}: listed as equivalent, but no fault of the program as it is now: {name}", flush=True)
    done = _outcomes(kept, study)
    known = equivalent()
    made = _Table(study, seed, len(listed), len(there), known)

    def judge(fault: Fault) -> tuple[Fault, Outcome]:
        return fault, done.get(fault.name) or study.judge({fault.file: fault.put_into(study.files[fault.file])})

    waiting = in_turns(there, seed)
    with ThreadPoolExecutor(jobs) as pool:
        while made.counted < count:
            batch = list(islice(waiting, min(2 * jobs, count - made.counted)))
            if not batch:
                break
            for fault, outcome in pool.map(judge, batch):
                if line := made.add(fault, outcome):
                    print(line, flush=True)
            kept.write_text(json.dumps(made.result(), indent=1) + "\n")
    return made.result()


def _outcomes(kept: Path, study: Study) -> dict[str, Outcome]:
    """The stored outcomes, if they are of this very program, its scenarios and this `verify`; else empty."""
    told = json.loads(kept.read_text()) if kept.is_file() else {}
    if told.get("program") != study.digest:
        return {}
    return {
        each["fault"]: Outcome(
            each["verdict"],
            each.get("told", ""),
            each.get("scenario", ""),
            each.get("channel", ""),
            tuple(each.get("functions", ())),
        )
        for each in told["faults"]
    }


@dataclass
class _Table:
    """The outcomes of the faults so far."""

    study: Study
    seed: int
    possible: int
    executed: int
    known: dict[tuple[str, str], str]
    tried: dict[str, tuple[Fault, Outcome, str]] = field(default_factory=dict)
    dropped: dict[str, int] = field(default_factory=lambda: dict.fromkeys(_NO_FAULT, 0))

    @property
    def counted(self) -> int:
        """How many of the faults are not equivalent, and so count for the score."""
        return sum(not reason for _, _, reason in self.tried.values())

    def add(self, fault: Fault, outcome: Outcome) -> str:
        """Add an outcome; returns a line for the log, empty if the fault is dropped or is the same as another."""
        if outcome.verdict in _NO_FAULT:
            self.dropped[outcome.verdict] += 1
            return ""
        if fault.name in self.tried:
            return ""
        reason = "" if outcome.verdict == "different" else self.known.get((self.study.name, fault.name), "")
        self.tried[fault.name] = fault, outcome, reason
        seen = "noticed" if outcome.verdict == "different" else "EQUIVALENT" if reason else "SURVIVES"
        what = f"[{fault.kind}] line {fault.line}, {fault.name} ({outcome.verdict} {outcome.told})"
        return f"{self.study.name} {len(self.tried)} {seen} {what}"

    def result(self) -> dict[str, object]:
        """The results as JSON."""
        counted = [(fault, outcome) for fault, outcome, reason in self.tried.values() if not reason]
        noticed = [fault for fault, outcome in counted if outcome.verdict == "different"]
        by_kind = {
            kind: f"{sum(f.kind == kind for f in noticed)} of {sum(f.kind == kind for f, _ in counted)}"
            for kind in KINDS
            if any(f.kind == kind for f, _ in counted)
        }
        return {
            "verdict": self.study.right.verdict.sentence(), "program": self.study.digest, "seed": self.seed,
            "possible": self.possible, "executed": self.executed, "dropped": self.dropped, "faults_that_count": len(counted),
            "noticed": len(noticed), "score_pct": round(100 * len(noticed) / max(1, len(counted)), 1),
            "equivalent": len(self.tried) - len(counted), "by_kind": by_kind,
            "faults": [
                {"kind": f.kind, "line": f.line, "fault": f.name, **{k: v for k, v in asdict(o).items() if v},
                 **({"equivalent": reason} if reason else {})}
                for f, o, reason in self.tried.values()
            ],
        }  # fmt: skip


def main() -> int:
    """Run the studies; 1 if a harmless rewriting was called different."""
    parser = argparse.ArgumentParser(prog="python -m tests.faults")
    parser.add_argument("studies", nargs="*", default=list(STUDIES))
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scenarios", type=int, default=1, help="seed of the search for scenarios")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--rewritings", action="store_true", help="the harmless rewritings only")
    asked = parser.parse_args()
    alarms = 0
    for name in asked.studies:
        with tempfile.TemporaryDirectory(prefix="robosmi-faults-") as place:
            study = Study.made(name, Path(place), asked.scenarios)
            print(name, study.right.verdict.sentence(), flush=True)
            if asked.rewritings:
                for each in rewritings(name):
                    outcome = study.judge(each.put_into(study.files), early=False)
                    alarms += outcome.verdict != "no-difference-found"
                    print(f"{name} {each.name} ({each.kind}): {outcome.verdict} {outcome.told}", flush=True)
                continue
            KEPT.mkdir(exist_ok=True)
            result = run(study, asked.count, asked.seed, asked.jobs, KEPT / f"{name}.json")
            print(name, {k: v for k, v in result.items() if k != "faults"}, flush=True)
    return int(alarms > 0)


if __name__ == "__main__":
    sys.exit(main())
