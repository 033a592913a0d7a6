"""Breaks every adapter that a case proves, in each way, and prints the cases that do not notice.

`python -m tests.adapters.mutants [NAME]` takes the cases whose names contain that text.
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

from tests.adapters.bench import CASES, broken, notices, pieces


def main(only: str = "") -> int:
    """Run the cases whose names contain a text; 1 if a broken adapter goes unnoticed."""
    for module in sorted(Path(__file__).parent.glob("cases_*.py")):
        importlib.import_module(f"tests.adapters.{module.stem}")
    known = {f"{piece.header}/{piece.name}": piece for piece in pieces()}
    tried, unnoticed = 0, list[str]()
    for name, (case, adapters) in CASES.items():
        for adapter in adapters if only in name else ():
            for way, text in broken(known[adapter]).items() if known[adapter].kind == "adapter" else ():
                tried += 1
                if not notices(case, adapter, text):
                    unnoticed.append(f"{name}: {adapter} {way}")
                    print(unnoticed[-1], flush=True)
    print(f"{tried} broken adapters, {len(unnoticed)} unnoticed")
    return int(bool(unnoticed))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
