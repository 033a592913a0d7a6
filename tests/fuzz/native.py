"""Programs that attack this machine in many forms of the compiler, the assembler and the linker; none may have an effect on it.

Usage: python -m tests.fuzz.native [--count N] [--first N] [--verify]. Run by hand (`make fuzz`), not by CI. With `--verify` each
is migrated and verified, as a person would do it, with a harmless sketch; else it is built and run. A variation combines what
stands for a name of the C library or of the model (kinds of symbols, binding, visibility, labels, versions, threads), where
data and code lie (sections), what is to run before main (constructors, arrays of pointers, code of `.init`) and what it tries
(`tests.host_model.attacked`). An escape is an effect that the judge sees; a failure is an end that is no result of a run.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import tomllib
import traceback
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from string import Template
from time import monotonic

import robosmi
from robosmi.errors import RobosmiError
from robosmi.transformations.chains.verify import verify
from robosmi.transformations.verification.originals import original_program
from robosmi.verify.host_model import load_host_model
from robosmi.verify.original_coverage import coverage
from robosmi.verify.original_run import run_original
from tests.host_model.attacked import ATTACKS, EFFECTS, judge

SECONDS, VERIFY_SECONDS = 60.0, 600.0
"""A build and a run that take longer hang; so does a verification, whose some hundred runs may have to share the machine."""
_SKETCH = "#include <Arduino.h>\nvoid setup() { pinMode(13, OUTPUT); }\nvoid loop() {}\n"
"""What stands for the migrated program, which is compiled first: it is not attacked."""
_PARTS = tomllib.loads((ATTACKS / "variations.toml").read_text())


def variation(number: int) -> str:
    """The text of a program; the same for each call with a number."""
    chance = random.Random(number)

    def filled(text: str, n: int) -> str:
        chosen = {name: chance.choice(values) for name, values in _PARTS["choices"].items()}
        return Template(text).substitute(chosen, n=n, name=chance.choice(_PARTS["names"])).strip()

    stand_ins = [filled(chance.choice(_PARTS["stand_ins"]), n) for n in range(chance.randint(1, 3))]
    starts = [_PARTS["starts"][number % len(_PARTS["starts"])], *chance.choices(_PARTS["starts"], k=chance.randint(0, 1))]
    parts = [*stand_ins, *(filled(start, 10 + n) for n, start in enumerate(starts))]
    return "\n".join(('#include "attack.h"', *parts, '#include "body.h"', ""))


def built_and_run(program_text: Path, folder: Path) -> str:
    """How a program ends on the host model."""
    program = original_program([program_text], load_host_model("propeller"), folder)
    run = run_original(program, 100_000, limit_s=2.0)
    coverage(program, [run.counts])
    return run.cause if run.status == "crashed" else run.status


def verified(program_text: Path, folder: Path) -> str:
    """The verdict on a program; all that `verify` makes is in a folder, so that a process that is left is seen."""
    made = robosmi.migrate([program_text], folder / "out", bind={"P3": "D13"})
    for part in made.sketch.glob("*.*"):
        part.unlink()
    (made.sketch / f"{made.sketch.name}.ino").write_text(_SKETCH)
    before, tempfile.tempdir = tempfile.tempdir, str(folder)
    try:
        verdict = verify(folder / "out", budget_s=2.0).verdict
    finally:
        tempfile.tempdir = before
    return f"{verdict.verdict}: {'; '.join(verdict.reasons)[:60]}"


def ended(number: int, place: Path, way: Callable[[Path, Path], str] = built_and_run) -> tuple[str, list[str]]:
    """How a variation ends, and what the judge has seen of it.

    Args:
        number: of the variation.
        place: an empty folder with a short path.
        way: what is done with it: returns how it ends.
    """
    source, folder = place / "source", place / "built"
    for each in (source, folder):
        each.mkdir()
    attack = place / "attack.c"
    attack.write_text(variation(number))
    chance = random.Random(-number)
    with judge(place / "at") as judged:
        program_text = judged.source(attack, source, chance.randrange(len(EFFECTS)), chance.choice((1, len(EFFECTS))))
        begun = monotonic()
        try:
            outcome = way(program_text, folder)
        except RobosmiError as error:
            outcome = f"not run: {error.message[:60]}"
        except Exception:
            outcome = f"FAILURE {traceback.format_exc()}"
        if monotonic() - begun > (VERIFY_SECONDS if way is verified else SECONDS):
            outcome = f"FAILURE: {monotonic() - begun:.0f} s"
        return outcome, judged.seen(folder)


def main() -> int:
    """Try variations, and print how they end."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--verify", action="store_true")
    given = parser.parse_args()
    way = verified if given.verify else built_and_run
    outcomes: Counter[str] = Counter()
    escapes = failures = 0
    for number in range(given.first, given.first + given.count):
        with tempfile.TemporaryDirectory(prefix="at-") as place:
            outcome, seen = ended(number, Path(place), way)
        outcomes[outcome.split(":")[0] if given.verify or outcome.startswith("not run") else outcome.splitlines()[0]] += 1
        if seen or outcome.startswith("FAILURE"):
            escapes += bool(seen)
            failures += outcome.startswith("FAILURE")
            print(f"--- {number}: {outcome}\n{seen}\n{variation(number)}")
    for outcome, count in outcomes.most_common():
        print(f"{count:5}  {outcome}")
    print(f"{given.count} variations, {escapes} escapes, {failures} failures")
    return int(bool(escapes or failures))


if __name__ == "__main__":
    sys.exit(main())
