"""How many expressions of the package have an explicit `Any` in their type, by room, as mypy's report counts them.

`make lint` runs this. The bound below only goes down: who types something lowers it, and who needs more has lost a type.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

BOUND = 10_700
"""Upper bound for the whole package: the last count, rounded up."""


def counted(configuration: Path) -> Counter[str]:
    """Room of the package -> expressions; the column `Explicit` of the report, which resolves aliases."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [
                sys.executable,
                "-m",
                "mypy",
                "--config-file",
                configuration,
                "--strict",
                "--any-exprs-report",
                folder,
                "-p",
                "robosmi",
            ],
            check=True,
        )
        lines = (Path(folder) / "types-of-anys.txt").read_text(encoding="utf-8").splitlines()
    column = lines[0].split().index("Explicit")
    found: Counter[str] = Counter()
    for line in lines[2:]:
        name, *numbers = line.split()
        if name.partition(".")[0] == "robosmi":
            found[".".join(name.split(".")[:2])] += int(numbers[column - 1])
    return found


def main() -> None:
    """Print the counts, the largest first; exit code 1 if there are more than the bound."""
    found = counted(Path(sys.argv[1]))
    total = found.total()
    for room, number in [*found.most_common(), ("explicit Any in all", total)]:
        print(f"{number:7,} {room}")
    if total > BOUND:
        sys.exit(f"there are {total:,} explicit Any, and may be {BOUND:,} (tests/any_count.py)")


if __name__ == "__main__":
    main()
