"""Compare random expressions in migrated sketches with a 32-bit machine, program by program, and print what was compared.

Usage: python -m tests.fuzz.widths [--cases N] [--seed N] [--each N]. Run by hand (`make fuzz`);
`tests/widths/test_cases.py` takes one program. Expressions without a meaning in C (overflows with a sign, division by zero)
are left out and counted.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from tests.widths.expressions import Programs
from tests.widths.machines import measured, truth


def compared(text: str, folder: Path) -> tuple[dict[str, tuple[int, int]], int, int]:
    """Cases that differ with both values (source, sketch), the number compared, and the number without a value."""
    program = folder / "expressions.c"
    program.write_text(text)
    wanted = truth(program, folder)
    found = measured(program, folder)
    return {n: (v, found[n]) for n, v in wanted.items() if found[n] != v}, len(wanted), len(found) - len(wanted)


def main() -> int:
    """The command line; 1 if an expression differs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--each", type=int, default=240, help="cases of one program")
    arguments = parser.parse_args()
    done = wrong = left = 0
    programs = Programs(arguments.seed)
    while done < arguments.cases:
        text = programs.program(arguments.each)
        with tempfile.TemporaryDirectory() as folder:
            different, count, without = compared(text, Path(folder))
        done, wrong, left = done + count, wrong + len(different), left + without
        for name, (wanted, found) in different.items():
            line = next(line for line in text.splitlines() if f"case_{name}(" in line)
            print(f"differs: {found} instead of {wanted}: {line}", flush=True)
    print(f"seed {arguments.seed}: {done - wrong} of {done} expressions as on the source; {left} without a value were left out")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
