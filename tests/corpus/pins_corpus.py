"""How often the check of pins (RS345) fires over a corpus: each firing is a wrong pin, or a flow that the check cannot follow.

Usage: python -m tests.corpus.pins_corpus FOLDER [--part K/N] [--only TEXT]. Each program is migrated without pins, and with each
port that it uses on a pin of its own. Run by hand.
"""

from __future__ import annotations

import argparse
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

import robosmi
from robosmi.errors import RobosmiError
from robosmi.transformations.queries.plans.port_pins import PIN_RULE
from tests.corpus.migrate_corpus import programs

_PINS = [*(f"D{n}" for n in range(2, 70))]


def fired(files: tuple[Path, ...], output: Path, *, bound: bool) -> list[str]:
    """The messages of the check for one program.

    Args:
        files: its sources.
        output: where the sketch is made.
        bound: put each port on a pin of its own.
    """
    bind: dict[str, str] = {}
    if bound:
        ports = [b for b in robosmi.plan_migration(list(files), target="mega").plan.portBindings if b.sourcePin >= 0]
        bind = {f"P{b.sourcePin}": pin for b, pin in zip(ports, _PINS, strict=False)}
    made = robosmi.migrate(list(files), output, target="mega", bind=bind)
    return [str(f.message) for f in made.models.plan.findings if f.rule == PIN_RULE]


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--part", default="1/1", help="the K-th of N parts of the corpus")
    arguments = parser.parse_args()
    part, parts = map(int, arguments.part.split("/"))
    counts: Counter[str] = Counter()
    for files in programs(arguments.corpus)[part - 1 :: parts]:
        if arguments.only not in str(files[0]):
            continue
        for bound in (False, True):
            start = time.monotonic()
            with tempfile.TemporaryDirectory() as scratch:
                try:
                    said = fired(files, Path(scratch) / "out", bound=bound)
                except RobosmiError as error:
                    counts["refused"] += 1
                    print(f"{files[0]}: refused: {error}"[:200])
                    continue
                except Exception:
                    counts["crashed"] += 1
                    print(f"{files[0]}: {traceback.format_exc()}")
                    continue
            counts[f"{'bound' if bound else 'unbound'}: programs"] += 1
            counts[f"{'bound' if bound else 'unbound'}: fired"] += bool(said)
            for message in said:
                print(f"{files[0]} ({'bound' if bound else 'unbound'}, {time.monotonic() - start:.1f} s): {message}", flush=True)
    print("\n".join(f"{name}: {count}" for name, count in counts.items()))


if __name__ == "__main__":
    main()
