"""Breaks every adapter that a case proves, in each way, and prints the cases that do not notice.

`python -m tests.adapters.mutants [NAME]` takes the cases whose names contain that text. Adapters in C are broken in the same way.
"""

from __future__ import annotations

import sys

from tests.adapters import bench_c
from tests.adapters.bench import BESIDE, CASES, Uno, broken, notices, pieces
from tests.adapters.bench_c import UnoInC
from tests.adapters.cases import load_cases


def main(only: str = "") -> int:
    """Run the cases whose names contain a text; 1 if a broken adapter goes unnoticed."""
    load_cases()
    tried, unnoticed = 0, list[str]()
    for bench, all_pieces in ((Uno, pieces()), (UnoInC, bench_c.pieces())):
        known = {f"{piece.header}/{piece.name}": piece for piece in all_pieces}
        for name, (case, adapters) in CASES.items():
            there = only in name and {*adapters, *BESIDE[name]} <= known.keys()
            for adapter in adapters if there else ():
                for way, text in broken(known[adapter]).items() if known[adapter].kind == "adapter" else ():
                    tried += 1
                    if not notices(case, adapter, text, bench):
                        unnoticed.append(f"{bench.__name__} {name}: {adapter} {way}")
                        print(unnoticed[-1], flush=True)
    print(f"{tried} broken adapters, {len(unnoticed)} unnoticed")
    return int(bool(unnoticed))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
