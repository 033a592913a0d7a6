"""Run the original programs of a folder on this machine, without devices, and say what became of each.

    python tests/corpus/run_originals.py FOLDER [--seconds N] [--model PLATFORM]

Each C file that defines `main` is built with its folder's headers and runs for so many seconds of virtual time, twice: both runs
have to see the same. The programs are not part of the project. Exit code 1 if anything crashed here or two runs differ.
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from robosmi.errors import InternalError, RobosmiError
from robosmi.transformations.verification.originals import original_program
from robosmi.verify.host_model import HostModel, load_host_model
from robosmi.verify.original_run import run_original

_MAIN = re.compile(r"^[\w \t*]*\bmain\s*\(", re.MULTILINE)


def outcome(source: Path, model: HostModel, seconds: float) -> tuple[str, str]:
    """Run one program: a status, and the cause."""
    others = [path for path in sorted(source.parent.glob("*.c")) if path != source and not _MAIN.search(_text(path))]
    for sources in ([source], [source, *others]):  # some folders hold one program of several files, some hold several programs
        with tempfile.TemporaryDirectory() as place:
            try:
                program = original_program(sources, model, Path(place))
            except RobosmiError as error:
                if isinstance(error, InternalError):
                    raise
                found = "not built", error.message
                continue
            if program.unmodelled and others and sources == [source]:
                found = "", ""
                continue
            first, second = (run_original(program, seconds * 1e6, limit_s=60) for _ in range(2))
            if first != second:
                return "NOT REPEATED", ""
            return first.status, first.cause
    return found


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace")


def main() -> int:
    """Run them all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--model", default="propeller")
    given = parser.parse_args()
    model, counts, began = load_host_model(given.model), Counter[str](), time.monotonic()
    for source in sorted(given.folder.rglob("*.c")):
        if not _MAIN.search(_text(source)):
            continue
        try:
            status, cause = outcome(source, model, given.seconds)
        except Exception as error:  # a fault of ours, which is what this looks for
            status, cause = "FAULT", f"{type(error).__name__}: {error}"
        counts[status] += 1
        print(f"{status:12} {source.relative_to(given.folder)}{f': {cause}' if cause else ''}")
    took = time.monotonic() - began
    print(
        f"{counts.total()} programs in {took:.0f} s:", ", ".join(f"{number} {status}" for status, number in counts.most_common())
    )
    return int(bool(counts["FAULT"] or counts["NOT REPEATED"]))


if __name__ == "__main__":
    sys.exit(main())
