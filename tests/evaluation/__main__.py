"""The evaluation of the paper's claims: `python -m tests.evaluation` (make evaluate) prints the table, row by row.

What a row needs and is not here makes it 'not run', with how to get it. Exit 1 for a row outside its tolerance. A run without
--quick keeps what it measured (tests/evaluation/measured.json); one without --only writes docs/method/evaluation.md.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import textwrap
from collections import Counter
from pathlib import Path

from robosmi.errors import did_you_mean
from tests.evaluation import page
from tests.evaluation.rows import analysis, generality, generation, hardware, libraries
from tests.evaluation.table import OUTSIDE, ROWS, Outcome, Setting, outcomes, rows

MODULES = (analysis, hardware, libraries, generation, generality)
"""They register the rows."""


def main(words: list[str]) -> int:
    """Measure, print, write."""
    parser = argparse.ArgumentParser("python -m tests.evaluation", description=__doc__)
    parser.add_argument(
        "--quick", action="store_true", help="only rows without network, compiler, simulator and other people's programs"
    )
    parser.add_argument(
        "--corpus", type=Path, metavar="DIR", help="what `make corpus` has fetched (default: ROBOSMI_CORPUS, out)"
    )
    parser.add_argument("--only", action="append", default=[], metavar="ROW", help="only this row; can be given again")
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the rows as JSON")
    given = parser.parse_args(words)
    if given.corpus is not None and not given.corpus.is_dir():
        parser.error(f"--corpus: '{given.corpus}' is no folder; give the one that `make corpus` has filled")
    for name in given.only:
        if name not in ROWS:
            parser.error(f"--only: there is no row '{name}'{did_you_mean(name, ROWS)}; rows: {' '.join(ROWS)}")
    written = [given.json] * (given.json is not None) + [page.MEASURED] * (not given.quick) + [page.PAGE] * (not given.only)
    for path in written:  # before hours of measuring
        if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
            parser.error(f"'{path}' cannot be written; give another place, or make it writable")
    with tempfile.TemporaryDirectory(prefix="evaluation-") as home:
        os.environ["ROBOSMI_HOME"] = home
        os.environ.pop("ROBOSMI_HISTORY", None)
        done = []
        chosen = [each for each in rows() if not given.only or each.name in given.only]
        for outcome in outcomes(chosen, Setting(Path(home), given.corpus), quick=given.quick):
            done.append(outcome)
            print(shown(outcome), flush=True)
    counts = Counter(outcome.verdict.partition(" (")[0] for outcome in done)
    print(f"{len(done)} rows: {', '.join(f'{count} {name}' for name, count in counts.most_common())}")
    if given.json is not None:
        given.json.write_text(json.dumps([outcome.to_json() for outcome in done], indent=1) + "\n", encoding="utf-8")
    if not given.quick:
        page.keep(done)
    if not given.only:
        page.PAGE.write_text(page.page([o for o in done if o.row.quick], page.load()), encoding="utf-8")
    return int(any(outcome.verdict == OUTSIDE for outcome in done))


def shown(outcome: Outcome) -> str:
    """A row of the table for a terminal."""
    row = outcome.row
    lines = (
        f"{row.name:4} {outcome.told.partition(' (')[0].upper()}: {row.claim} [{row.place}]",
        f"expected: {row.expected} (tolerance: {row.tolerance})",
        f"got: {outcome.got}" + (f"  {outcome.told.partition(' (')[2].removesuffix(')')}" if "(" in outcome.told else ""),
        f"how: {row.how}",
    )
    return lines[0] + "\n" + "\n".join(textwrap.indent(line, "       ") for line in lines[1:])


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except BrokenPipeError:  # as with `| head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
