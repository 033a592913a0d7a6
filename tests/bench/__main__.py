"""Measures time and memory, and ends with one table: `python -m tests.bench [--ratios] [NAME...]`, or `make bench`.

NAME is one of the modules in `NAMES`; without one all are measured. `--ratios` measures `ratios` only, which is cheap and for CI.
Each module is measured in a process of its own. What cannot be measured because a tool or a corpus is missing stands in the table
with what to install. Exit 1 if a figure is over its bound, or if measuring fails.
"""

from __future__ import annotations

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context

from tests.bench.figures import Figure, measured, not_measured, table

NAMES = (
    "ratios",
    "commands",
    "c_source",
    "recommend",
    "drawings",
    "xmi",
    "large",
    "rules",
    "query",
    "generate",
    "simulation",
    "page",
    "corpus",
)


def main() -> int:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="modules to measure")
    parser.add_argument("--ratios", action="store_true", help="measure the cheap ratios only")
    given = parser.parse_args()
    if unknown := set(given.names) - set(NAMES):
        parser.error(f"no module is called {', '.join(sorted(unknown))}; there are: {', '.join(NAMES)}")
    figures: list[Figure] = []
    failed = False
    for name in ["ratios"] if given.ratios else given.names or NAMES:
        print(f"{name} ...", flush=True)
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            try:
                found, error = pool.submit(measured, name).result()
            except BrokenProcessPool as broken:  # killed, or out of memory
                found, error = [], str(broken)
        figures += found
        if error:
            failed = True
            figures.append(not_measured(name, "measuring failed; see above"))
            print(error, file=sys.stderr, flush=True)
    print()
    print(table(figures))
    return 1 if failed or not all(figure.ok for figure in figures) else 0


if __name__ == "__main__":
    sys.exit(main())
