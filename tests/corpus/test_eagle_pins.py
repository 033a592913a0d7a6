"""EAGLE schematics of other people against labels: which part is on which pin of the board that runs the program.

A person labelled them from the nets, before the reader had read them. `drawings/eagle_pins.csv` has for each drawing `PIN:PART`
(`BOARD.PIN:PART` where there are several boards), and what counts neither way (`*` for any pin or part), such as plain connectors
beside a drawn device. Its `set` is `tune` for the drawings that the rules were made with, `held` for those that were first
measured with them, and `later` for those that were labelled and measured after that. The drawings are no part of the project:
ROBOSMI_DRAWINGS names a folder with `OWNER+REPOSITORY/PATH` of each.
"""

from __future__ import annotations

import csv
import os
from collections import Counter
from pathlib import Path

import pytest

from robosmi.errors import RobosmiError
from robosmi.transformations.chains.hardware import hardware

TABLE = Path(__file__).parent / "drawings" / "eagle_pins.csv"


def rows() -> list[dict[str, str]]:
    """The rows of the table."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter=";"))


def found_in(path: Path, labelled: str, boards: set[str]) -> set[str]:
    """What the reader finds on the boards that are labelled, as the labels have it; nothing of a drawing that it refuses."""
    try:
        mappings = hardware(path).result["mappings"]
    except RobosmiError:
        return set()
    wanted = [m for m in mappings if m["board"] in {labelled, *boards}]
    return {f"{m['board']}." * (m["board"] in boards) + f"{m['pin']}:{m['component']}" for m in wanted}


def scores(row: dict[str, str], path: Path) -> tuple[float, float]:
    """Precision and recall of one drawing."""
    meant, either = {*row["pins"].split()}, {*row["optional"].split()}
    boards = {label.partition(".")[0] for label in meant if "." in label.partition(":")[0]}
    told = set()
    for each in found_in(path, row["board"], boards):
        pin, _, part = each.partition(":")
        if each in meant or either.isdisjoint((each, f"*:{part}", f"{pin}:*")):
            told.add(each)
    right = len(told & meant)
    return right / len(told) if told else 0.0, right / len(meant)


def test_the_labels_are_of_forty_drawings_and_half_were_held_out() -> None:
    found = rows()
    assert len({(row["repository"], row["path"]) for row in found}) == len(found) >= 40
    sets = Counter(row["set"] for row in found)
    assert sets["tune"] == sets["held"] >= 20
    assert {*sets} == {"tune", "held", "later"}
    assert all(row["pins"] for row in found)


@pytest.mark.parametrize("part", ["tune", "held", "later"])
def test_the_parts_on_the_pins_are_those_of_the_labels(part: str) -> None:
    folder = os.environ.get("ROBOSMI_DRAWINGS")
    if not folder:
        pytest.skip("ROBOSMI_DRAWINGS does not name a folder with the drawings")
    listed = [(row, Path(folder) / row["repository"].replace("/", "+") / row["path"]) for row in rows() if row["set"] == part]
    found = {path: scores(row, path) for row, path in listed if path.is_file()}
    if not found:
        pytest.skip("none of the drawings is in ROBOSMI_DRAWINGS")
    precision, recall = (sum(score[i] for score in found.values()) / len(found) for i in (0, 1))
    print(f"EAGLE, {part}: {len(found)} drawings, precision {precision:.3f}, recall {recall:.3f}")
    wrong = {str(path): score for path, score in found.items() if min(score) < 1}
    assert min(precision, recall) >= 0.95, wrong
