"""Runs the whole programs, or those whose names contain a text, as they are and with faults: `python -m tests.families [TEXT]`.

Prints where a correct program differs from the library's documentation, and each fault that was not noticed.
"""

from __future__ import annotations

import sys

from tests.families.played import CASES, Case, NotMadeError, Spoilt


def main(only: str = "") -> int:
    """Run the programs whose names contain a text; 1 if one is not correct, or a fault goes unnoticed."""
    cases = [Case(folder) for folder in CASES if only in folder.name]
    tried = bad = 0
    for case in cases:
        found = _played(case)
        for fault in found:
            print(f"{case.folder.name}: {fault}", flush=True)
        bad += bool(found)
        for spoilt in [] if found else case.wrong():
            tried += 1
            noticed = _played(case, spoilt)
            if not noticed or noticed[0].startswith("is not made"):
                bad += 1
                print(f"{case.folder.name}: not noticed: {spoilt.why} {' '.join(noticed)}", flush=True)
    print(f"{len(cases)} programs, {tried} faults, {bad} not as they should be")
    return int(bool(bad))


def _played(case: Case, spoilt: Spoilt | None = None) -> list[str]:
    try:
        return case.faults(spoilt)
    except NotMadeError as error:
        return [f"is not made: {error}"]


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
