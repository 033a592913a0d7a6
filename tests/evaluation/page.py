"""The page docs/method/evaluation.md, and the values that it keeps of rows that need more than seconds.

`measured.json` has for each such row what the last run that could measure it got, the day and the commit.
"""

from __future__ import annotations

import datetime
import json
import subprocess
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path

from tests.evaluation.sources import ROOT
from tests.evaluation.table import DIFFERS, NOT_RUN, QUESTIONS, ROWS, Outcome, rows

PAGE = ROOT / "docs" / "method" / "evaluation.md"
MEASURED = Path(__file__).resolve().parent / "measured.json"
HEAD = """\
# The paper, claim by claim

Each row is a claim of the paper, or of an extension, and what the product gives now. `make evaluate` measures all rows that your
machine can measure, and prints the table. `python -m tests.evaluation --quick` takes those that need no compiler, simulator or
other people's programs; the tests compare this page with them. Other rows show what the last run that could measure them got,
with its day and commit.

"""
THREATS = """\
## Threats to validity

- **Construct.** The case studies are re-creations. The paper prints Listing 1 (an example of its own, `docs/examples/listing_1`),
  figures and prose, but neither its second program nor its drawings. Sizes in bytes depend on comments and names.
- **Internal.** The same people wrote the adapters, the model of the Propeller that stands for the original, and most scenarios.
  Eclipse EMF, compilers and simulators of others judge the results, and planted faults the judge (H5). The authors of the rules
  have seen the labels here; on as many programs that they had not seen, the share of calls with a body was .695 instead of .699.
- **External.** The corpus has one vendor's examples and eight users' programs, for one board. Nothing was run on a real robot.
  G2 is a sample: over all 162 programs 1,086 of the 1,453 calls that an Uno can serve have a body in plain C (.747). What lacks
  one is most of all abdrive360, servo360, pwm2ch, lis3dh, bme680, SD cards, ws2812, and cores, which need the Arduino target.
- **Listing 1 as printed** waits with `waitcnt(230)` for a number of the counter, which comes round every 53.7 s; the sketch goes
  on at once (warning RS334), and `verify` says DIFFERENT. With `CNT + 230`, as in our line follower, there is no difference (E3).
- **Conclusion.** Ranks are over draws from our collection of libraries, not the paper's; ranges show how much they depend on the
  draw.

"""


def load() -> dict[str, dict[str, str]]:
    """Row -> got, verdict, date and commit."""
    found: dict[str, dict[str, str]] = json.loads(MEASURED.read_text(encoding="utf-8")) if MEASURED.is_file() else {}
    return found


def keep(outcomes: Iterable[Outcome]) -> None:
    """Keep what was measured of the rows that are not quick."""
    when = {"date": datetime.date.today().isoformat(), "commit": _commit()}
    new = {
        o.row.name: {"got": o.got, "verdict": o.told, **when} for o in outcomes if not o.row.quick and NOT_RUN not in o.verdict
    }
    made = {name: value for name, value in (load() | new).items() if name in ROWS}
    MEASURED.write_text(json.dumps(made, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _commit() -> str:
    """The commit that was measured; "unknown" without git, or outside of a clone."""
    try:
        head = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return "unknown"
    return head.stdout.strip() or "unknown"


def page(quick: Iterable[Outcome], measured: Mapping[str, Mapping[str, str]]) -> str:
    """The text of the page.

    Args:
        quick: outcomes of the quick rows.
        measured: see `load`.
    """
    fresh = {outcome.row.name: outcome for outcome in quick}
    shown: dict[str, tuple[str, str]] = {}
    for row in rows():
        name = row.name
        if row.quick:
            shown[name] = fresh[name].got, fresh[name].told
        elif name in measured:
            kept = measured[name]
            shown[name] = f"{kept['got']} ({kept['date']}, {kept['commit']})", kept["verdict"]
        else:
            shown[name] = "-", f"{NOT_RUN} (run: python -m tests.evaluation --only {name})"
    counts = Counter(verdict.partition(" (")[0] for _got, verdict in shown.values())
    parts = [HEAD, f"{len(ROWS)} rows: {', '.join(f'{count} {name}' for name, count in counts.most_common())}.\n\n"]
    for question, title in QUESTIONS.items():
        parts.append(f"## {question + ': ' if question != 'none' else ''}{title}\n\n")
        parts.append("| row | claim | place | expected (tolerance) | got | how | verdict |\n|---|---|---|---|---|---|---|\n")
        for row in rows():
            name = row.name
            if row.question == question:
                got, verdict = shown[name]
                cells = (
                    name,
                    row.claim,
                    row.place,
                    f"{row.expected} ({row.tolerance})",
                    got,
                    row.how,
                    verdict.partition(" (")[0],
                )
                parts.append(f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |\n")
        parts.append("\n")
    parts.append(THREATS)
    parts.append("## Where we differ from the paper, and why\n\n")
    parts += [f"- **{row.name}** ({row.place}; {row.claim}): {row.reason}.\n" for row in rows() if row.verdict == DIFFERS]
    return "".join(parts)
