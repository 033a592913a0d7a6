"""Verify migrations of real programs and tabulate the verdicts.

`ROBOSMI_CORPUS=DIR python -m tests.corpus.verify_corpus [COUNT] [SECONDS]`, the seconds being those of the search for scenarios.
Programs are taken at even distances in the order of their names; without drawings, so that their ports are bound to pins of the
target as long as there are any. A line for each: verdict, scenarios, branches, reason or first difference.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections import Counter
from pathlib import Path

import robosmi
from robosmi.errors import RobosmiError, UsageError
from robosmi.transformations.chains.verify import verify
from tests.corpus.migrate_corpus import programs


def bound(files: list[Path], folder: Path) -> None:
    """Migrate a program, with its ports on pins of the target that nothing else has."""
    made = robosmi.plan_migration(files)
    free = [f"D{n}" for n in (2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13)] + [f"A{n}" for n in range(6)]
    bind: dict[str, str] = {}
    for binding in made.plan.portBindings:
        if not free:
            break
        analog = str(binding.name).startswith("AD") or ".channel_" in str(binding.name)
        pin = next((p for p in free if p.startswith("A") == analog), free[0])
        free.remove(pin)
        bind[str(binding.name)] = pin
    robosmi.migrate(files, folder, bind=bind)


def main() -> None:
    """Verify some programs of the corpus."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    budget = float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
    found = [list(files) for files in programs(Path(os.environ["ROBOSMI_CORPUS"]))]
    chosen = found[:: max(1, len(found) // count)][: count + 5]
    verdicts: Counter[str] = Counter()
    for files in chosen:
        if sum(verdicts.values()) == count:
            break
        with tempfile.TemporaryDirectory() as place:
            out = Path(place) / "out"
            try:
                try:
                    bound(files, out)
                except UsageError:
                    robosmi.migrate(files, out)
            except RobosmiError as error:
                print(f"{files[0].name}: not migrated: {error.message}", flush=True)
                continue
            try:
                verdict = verify(out, budget_s=budget).verdict
            except RobosmiError as error:
                verdicts["error"] += 1
                print(f"{files[0].name}: ERROR {type(error).__name__}: {error.message}", flush=True)
                continue
            verdicts[verdict.verdict] += 1
            print(f"{files[0].name}: {verdict.sentence()}", flush=True)
    print(dict(verdicts))


if __name__ == "__main__":
    main()
