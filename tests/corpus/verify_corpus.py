"""Verify migrations of real programs and tabulate the verdicts.

`ROBOSMI_CORPUS=DIR python -m tests.corpus.verify_corpus [--only TEXT] [--budget SECONDS] [--table FILE]`, the seconds being those
of the search for scenarios of each program. Which programs, and how their ports are wired, is in `verified_programs.toml`; ports
that it does not name are bound to free pins of the target. A row for each: verdict, scenarios, simulated time, lines and branches
reached, the reason or the first difference, and its cause as the file has it. With `--table` the rows are written as a table of
Markdown.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import tomllib
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import robosmi
from robosmi.errors import RobosmiError
from robosmi.transformations.chains.verify import verify
from robosmi.verify.traces.verdict import NO_DIFFERENCE, Verdict
from tests.corpus.migrate_corpus import programs

CHOSEN = Path(__file__).parent / "verified_programs.toml"
_DIGITAL = [f"D{n}" for n in (2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13)]
_ANALOG = [f"A{n}" for n in range(6)]


def migrated(files: list[Path], wiring: Mapping[str, str], folder: Path) -> None:
    """Migrate a program; ports that nobody wired are on pins of the target that nothing else has, as long as there are any."""
    made = robosmi.plan_migration(files)
    bind = dict(wiring)
    free = [pin for pin in (*_DIGITAL, *_ANALOG) if pin not in wiring.values()]
    open_ports: list[tuple[str, int]] = []
    pins: dict[int, str] = {}  # of a port that has several names
    for binding in made.plan.portBindings:
        wired = next((wiring[name] for name in (str(binding.name), *map(str, binding.names)) if name in wiring), None)
        if wired is None:
            open_ports.append((str(binding.name), int(binding.sourcePin)))
        else:
            pins[int(binding.sourcePin)] = wired
    for name, number in open_ports:
        analog = name.startswith("AD") or ".channel_" in name
        fitting = [pin for pin in free if pin.startswith("A") or not analog]
        if analog or number < 0 or number not in pins:
            if not fitting:
                continue
            pins[number] = next((pin for pin in fitting if analog and pin.startswith("A")), fitting[0])
            free.remove(pins[number])
        bind[name] = pins[number]
    robosmi.migrate(files, folder, bind=bind)


def row(files: list[Path], entry: Mapping[str, Any], budget: float) -> tuple[str, list[str]]:
    """The verdict on one program, and its row in the table."""
    with tempfile.TemporaryDirectory() as place:
        out = Path(place) / "out"
        try:
            migrated(files, entry.get("bind", {}), out)
            verdict = verify(out, budget_s=budget).verdict
        except RobosmiError as error:
            return "error", ["error", "", "", "", "", f"{type(error).__name__}: {error.message}"]
    return verdict.verdict, cells(verdict)


def cells(verdict: Verdict) -> list[str]:
    """The columns of a row behind the program's name."""
    reached = [f"{verdict.lines_pct:.0f}", f"{verdict.branches_pct:.0f}"] if verdict.counted else ["", ""]
    why = list(verdict.all_reasons())
    if (first := verdict.first_difference) is not None:
        told = "another text" if len(first[1].message) > _LONG_TEXT else first[1].message
        why.insert(0, f"'{first[0].scenario.name}' at {first[1].at_ms:.1f} ms, {first[1].channel}: {told}")
    told = "; ".join(why)
    told = told if len(told) <= _MOST else f"{told[:_MOST]} ..."
    return [verdict.verdict, str(len(verdict.scenarios)), f"{verdict.simulated_s:.1f}", *reached, told]


HEADINGS = ["program", "verdict", "scenarios", "s", "lines %", "branches %", "message", "cause"]
_LONG_TEXT = 100
_MOST = 200
"""Greatest number of characters of a message in the table."""


INTRODUCTION = """# Real programs and their verdicts

Programs of public repositories, migrated to an Arduino Uno without a drawing and compared with their originals under generated
scenarios (`ROBOSMI_CORPUS=DIR python -m tests.corpus.verify_corpus --budget 20 --table FILE`; the corpus is not part of this
repository). Columns: scenarios, simulated seconds, lines and branches of the source that these reach, what the verdict tells,
and for each that is not `no-difference-found` the cause, as far as it was found out by hand.

"""


def table(rows: list[list[str]]) -> str:
    """Rows as a table of Markdown."""
    lines = [HEADINGS, ["---"] * len(HEADINGS), *rows]
    return "".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |\n" for line in lines)


def main() -> None:
    """Verify the chosen programs of the corpus."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="")
    parser.add_argument("--budget", type=float, default=20.0)
    parser.add_argument("--table", type=Path)
    asked = parser.parse_args()
    corpus = Path(os.environ["ROBOSMI_CORPUS"])
    units = {str(files[0].relative_to(corpus)): list(files) for files in programs(corpus)}
    verdicts: Counter[str] = Counter()
    rows: list[list[str]] = []
    for entry in tomllib.loads(CHOSEN.read_text())["program"]:
        if asked.only not in entry["path"]:
            continue
        said, cells_of = row(units[entry["path"]], entry, asked.budget)
        verdicts[said] += 1
        cause = entry.get("cause", "not known") if said != NO_DIFFERENCE else ""
        rows.append([entry["path"], *cells_of, cause])
        print(" | ".join(rows[-1]), flush=True)
    print(dict(verdicts))
    if asked.table is not None:
        asked.table.write_text(INTRODUCTION + table(rows))


if __name__ == "__main__":
    main()
