"""Libraries for parts as Wokwi, EAGLE and KiCad name them: `python -m tests.recommend.drawn_parts` prints the figures.

`data/drawn_parts.csv` lists distinct parts with what the tool says of them, whether a program needs a library for each, and the
libraries that would do: labelled by a person before the ranking was looked at.
"""

from __future__ import annotations

import csv
import sys
from dataclasses import dataclass
from pathlib import Path

from robosmi.recommend.component import ComponentQuery
from robosmi.transformations.knowledge.libraries.library_ranking import device_ranker

TABLE = Path(__file__).with_name("data") / "drawn_parts.csv"
LEAST = 0.85


@dataclass(frozen=True)
class Figures:
    """The judged answers of the ranking.

    Attributes:
        parts: number of all parts.
        needed: number of those that need a library.
        wrong: parts for which the ranking decides wrongly whether they need one.
        missed: parts that need a library and whose first candidate is none of the right ones.
    """

    parts: int
    needed: int
    wrong: list[str]
    missed: list[str]

    @property
    def decision(self) -> float:
        """The share of parts whose decision is right."""
        return 1 - len(self.wrong) / self.parts

    @property
    def top_1(self) -> float:
        """The share of those that need a library whose first candidate is right."""
        return 1 - len(self.missed) / self.needed


def labelled() -> list[dict[str, str]]:
    """The rows."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter=";"))


def figures() -> Figures:
    """The ranking's answers, judged."""
    rows = labelled()
    ranker = device_ranker("arduino", architecture="avr")
    wrong, missed = [], []
    for number, row in enumerate(rows):
        answer = ranker.rank(_query(number, row))
        name = f"{row['tool']}: {row['title']}"
        if answer.decision != row["decision"]:
            wrong.append(f"{name}: {answer.decision}, not {row['decision']}")
        if row["decision"] == "library" and answer.candidates[0].library not in row["libraries"].split("|"):
            missed.append(f"{name}: {answer.candidates[0].library}")
    return Figures(len(rows), sum(row["decision"] == "library" for row in rows), wrong, missed)


def _query(number: int, row: dict[str, str]) -> ComponentQuery:
    return ComponentQuery(
        id=str(number),
        title=row["title"],
        label=row["label"],
        family=row["family"],
        tags=tuple(row["tags"].split()),
        description=row["description"],
        connectors=tuple(row["connectors"].split(",")),
    )


def main() -> int:
    """Print the figures; the exit code is 1 where one is below its bound."""
    found = figures()
    print(f"parts as drawing tools name them: {found.parts}, of which {found.needed} need a library")
    print(f"  decision {found.decision:.3f} (at least {LEAST}), top-1 {found.top_1:.3f} (at least {LEAST})")
    for line in (*found.wrong, *found.missed):
        print(f"  {line}")
    return int(min(found.decision, found.top_1) < LEAST)


if __name__ == "__main__":
    sys.exit(main())
