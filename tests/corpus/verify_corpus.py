"""Verify migrations of real programs and tabulate the verdicts.

`ROBOSMI_CORPUS=DIR python -m tests.corpus.verify_corpus [--only TEXT] [--budget SECONDS] [--target BOARD] [--part K/N]
[--table FILE]`, the seconds being those of the search for scenarios of each program, and the part the K-th of N. Which programs,
and how their ports are wired to an Uno, is in `verified_programs.toml`; all other ports are bound to free pins of the target. A
row for each: verdict, scenarios, simulated time, lines and branches reached, the reason or the first difference, and its cause as
the file has it. With `--table` the rows are written as a table of Markdown.
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
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.queries.plans.port_pins import CONSOLE
from robosmi.verify.traces.verdict import NO_DIFFERENCE, Verdict
from tests.corpus.migrate_corpus import programs

CHOSEN = Path(__file__).parent / "verified_programs.toml"
UNO = "uno"


def pins(board: str) -> tuple[list[str], list[str]]:
    """The pins of a board that programs may use: those for digital signals alone, and those that read voltages."""
    usable = [pin for pin in load_board(board).pins if not pin.reserved]
    analog = [str(pin.label) for pin in usable if "analog_in" in pin.abilities]
    return [str(pin.label) for pin in usable if pin.label not in analog], analog


def migrated(files: list[Path], wiring: Mapping[str, str], folder: Path, board: str = UNO) -> None:
    """Migrate a program; ports that nobody wired are on pins of the board that nothing else has, as long as there are any."""
    made = robosmi.plan_migration(files, target=board)
    bind = dict(wiring)
    digital_pins, analog_pins = pins(board)
    free = [pin for pin in (*digital_pins, *analog_pins) if pin not in wiring.values()]
    open_ports: list[tuple[str, int]] = []
    placed: dict[int, str] = {}  # of a port that has several names
    for binding in made.plan.portBindings:
        if binding.choice == CONSOLE:  # it has no pins here
            continue
        wired = next((wiring[name] for name in (str(binding.name), *map(str, binding.names)) if name in wiring), None)
        if wired is None:
            open_ports.append((str(binding.name), int(binding.sourcePin)))
        else:
            placed[int(binding.sourcePin)] = wired
    for name, number in open_ports:
        analog = name.startswith("AD") or ".channel_" in name
        fitting = [pin for pin in free if pin in analog_pins or not analog]
        if analog or number < 0 or number not in placed:
            if not fitting:
                continue
            placed[number] = fitting[0]
            free.remove(placed[number])
        bind[name] = placed[number]
    robosmi.migrate(files, folder, bind=bind, target=board)


def row(files: list[Path], entry: Mapping[str, Any], budget: float, board: str = UNO) -> tuple[str, list[str]]:
    """The verdict on one program, and its row in the table."""
    wiring = entry.get("bind", {}) if board == UNO else {}
    with tempfile.TemporaryDirectory() as place:
        out = Path(place) / "out"
        try:
            migrated(files, wiring, out, board)
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
    parser.add_argument("--target", default=UNO, help="a board")
    parser.add_argument("--part", default="1/1", help="K/N: the K-th of N parts")
    parser.add_argument("--table", type=Path)
    asked = parser.parse_args()
    first, _, step = asked.part.partition("/")
    corpus = Path(os.environ["ROBOSMI_CORPUS"])
    units = {str(files[0].relative_to(corpus)): list(files) for files in programs(corpus)}
    verdicts: Counter[str] = Counter()
    rows: list[list[str]] = []
    for entry in tomllib.loads(CHOSEN.read_text())["program"][int(first) - 1 :: int(step)]:
        if asked.only not in entry["path"]:
            continue
        if entry["path"] not in units:
            verdicts["not in the corpus"] += 1
            continue
        said, cells_of = row(units[entry["path"]], entry, asked.budget, asked.target)
        verdicts[said] += 1
        cause = entry.get("cause", "not known") if said != NO_DIFFERENCE else ""
        rows.append([entry["path"], *cells_of, cause])
        print(" | ".join(rows[-1]), flush=True)
    print(dict(verdicts))
    if asked.table is not None:
        asked.table.write_text(INTRODUCTION + table(rows))


if __name__ == "__main__":
    main()
