"""Labelled Fritzing sketches against `robosmi hardware --json`: which pin reaches which component, and what is said of it.

A mapping is one pin of one board and one component. For each labelled mapping these are judged, too: connectors (some of the
label's, not more wrong ones than right ones, and none of the component's others), role (where the label says Both, any role
that is not passive), driver, signal, and the generated name.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.evaluation.sources import LABELS, read_lines

LEVELS = ("connectors", "role", "driver", "signal", "name")
_NAME = re.compile(r"[A-Za-z_]\w*(Read|Write|Bus)P[1-9]\d*", re.ASCII)


def labelled_sketches(path: Path = LABELS / "sketches.jsonl") -> list[dict[str, Any]]:
    """The labels, by name."""
    return read_lines(path)


@dataclass
class SketchScore:
    """The counts over sketches.

    Attributes:
        sketches: how many were judged.
        right, extra, missed: pairs of pin and component.
        levels: level -> mappings that are right in it.
        wrong: name of a sketch -> what is not right.
    """

    sketches: int = 0
    right: int = 0
    extra: int = 0
    missed: int = 0
    levels: Counter[str] = field(default_factory=Counter)
    wrong: dict[str, list[str]] = field(default_factory=dict)

    @property
    def mappings(self) -> int:
        """How many are labelled in the judged sketches."""
        return self.right + self.missed

    @property
    def precision(self) -> float:
        """The share of the answered pairs that are right."""
        return self.right / (self.right + self.extra) if self.right + self.extra else 0.0

    @property
    def recall(self) -> float:
        """The share of the labelled pairs that were answered."""
        return self.right / self.mappings if self.mappings else 1.0

    def add(self, label: Mapping[str, Any], mappings: Iterable[Mapping[str, Any]]) -> None:
        """Judge the mappings that the command gave for one sketch."""
        wanted = {(m["board"], m["pin"], m["component"]): m for m in label["mappings"]}
        free = {tuple(pair) for pair in label["optional"]} - wanted.keys()
        listed = list(mappings)
        got = {_pair(m): m for m in listed}
        counts = Counter(pair for pair in map(_pair, listed) if pair not in free)
        hits = [pair for pair in wanted if pair in counts]
        self.sketches += 1
        self.right += len(hits)
        self.extra += counts.total() - len(hits)
        self.missed += len(wanted) - len(hits)
        bad = [f"{pair} is extra" for pair in (counts - Counter(list(wanted))).elements()]
        bad += [f"{pair} is missing" for pair in wanted.keys() - counts.keys()]
        owners = defaultdict[str, set[Any]](set)
        for m in listed:
            owners[str(m["name"])].add((str(m["component_model_index"]), frozenset(_ids(m))))
        for pair in hits:
            right = _levels(wanted, got[pair], pair, len(owners[str(got[pair]["name"])]))
            self.levels.update(level for level in LEVELS if right[level])
            bad += [f"{level} of {pair}" for level in LEVELS if not right[level]]
        if bad:
            self.wrong[label["name"]] = bad


def _pair(mapping: Mapping[str, Any]) -> tuple[str, str, str]:
    return str(mapping["board_model_index"]), str(mapping["pin"]), str(mapping["component_model_index"])


def _ids(mapping: Mapping[str, Any]) -> set[str]:
    return {str(connector["id"]) for connector in mapping["connectors"]}


def _levels(wanted: Mapping[Any, Any], got: Mapping[str, Any], pair: tuple[str, str, str], owners: int) -> dict[str, bool]:
    label, ids = wanted[pair], _ids(got)
    mine = set(label["connectors"])
    others = {c for p, m in wanted.items() if p != pair and p[2] == pair[2] for c in m["connectors"]} - mine
    either = got["role"] in ("Input", "Output", "Both")
    return {
        "connectors": bool(ids & mine) and len(ids - mine) <= len(ids & mine) and not ids & others,
        "role": either if label["role"] == "Both" else got["role"] == label["role"],
        "driver": bool(got["driver"]) == label["driver"],
        "signal": got["signal"] == label["signal"],
        "name": _NAME.fullmatch(str(got["name"])) is not None and owners == 1,
    }
