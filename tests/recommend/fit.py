"""Fits the decision model on the labelled development queries: `python -m tests.recommend.fit` writes `decision.toml` anew.

Each query is taken in three views (`labelled.VIEWS`), so that the coefficients also hold for parts that no table names.
Multinomial and binary logistic regression, L2-regularised, in plain Python; the same input gives the
same coefficients. `evaluate` measures the model by cross-validation, never on what it was fitted on.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from operator import mul
from pathlib import Path

from robosmi import resources
from robosmi.recommend.decision import DECISIONS, FEATURES, DecisionModel, softmax
from tests.recommend.labelled import VIEWS, Labelled, labelled, ranker

_STEPS, _ENOUGH = 2000, 1e-4
_L2 = 0.001
_HEAD = """\
# Coefficients of the decision whether a part needs a library, and of the confidence (robosmi/recommend/decision.py).
# Fitted by `python -m tests.recommend.fit` on 153 labelled parts, each with and without what the tables of devices know.

"""


@dataclass(frozen=True)
class Sample:
    """One query in one view: its figures, its class, and whether the first candidate was right (None if it has no right one)."""

    query: int
    view: str
    features: list[float]
    need: str
    first: bool | None


def samples(data: Labelled) -> list[Sample]:
    """All queries in all views."""
    found = []
    for view in VIEWS:
        ranking = ranker(view)
        for number, component in enumerate(data.components):
            part, ranked = ranking.weigh(component)
            need = data.queries[number]["class"]
            grades = data.grades(number)
            best = ranking.index.library(ranked[0][1].library).name
            first = None if need == "none" else grades.get(best, 0) > 0
            found.append(Sample(number, view, ranking.features(component, part, ranked), need, first))
    return found


def fit(found: list[Sample]) -> DecisionModel:
    """The model for these samples."""
    needs = _logistic([s.features for s in found], [[float(s.need == d) for d in DECISIONS] for s in found], 0.5)
    judged = [s for s in found if s.need == "library"]
    # two classes are the logistic model: right against wrong, of which one row is enough
    first = _logistic([s.features for s in judged], [[float(bool(s.first)), float(not s.first)] for s in judged], 0.5)
    return DecisionModel(tuple(map(tuple, needs)), tuple(a - b for a, b in zip(*first, strict=True)))


def _logistic(rows: list[list[float]], wanted: list[list[float]], bound: float) -> list[list[float]]:
    """Multinomial logistic regression; each step is a Newton step with the upper bound of the Hessian (Boehning 1992)."""
    width, classes, many = len(rows[0]), len(wanted[0]), len(rows)
    curve = [
        [bound * sum(r[i] * r[j] for r in rows) / many + (_L2 if i == j else 0.0) for j in range(width)] for i in range(width)
    ]
    inverse = _inverse(curve)
    weights = [[0.0] * width for _ in range(classes)]
    for _ in range(_STEPS):
        slopes = [[_L2 * w for w in row] for row in weights]
        for row, target in zip(rows, wanted, strict=True):
            chances = softmax([sum(map(mul, w, row)) for w in weights])
            for slope, chance, want in zip(slopes, chances, target, strict=True):
                error = (chance - want) / many
                for n, value in enumerate(row):
                    slope[n] += error * value
        steps = [[sum(map(mul, line, slope)) for line in inverse] for slope in slopes]
        weights = [[w - s for w, s in zip(row, step, strict=True)] for row, step in zip(weights, steps, strict=True)]
        if max(abs(s) for step in steps for s in step) < _ENOUGH:
            break
    return weights


def _inverse(matrix: list[list[float]]) -> list[list[float]]:
    """Gauss-Jordan; the matrix is symmetric and positive definite, so no pivot is 0."""
    size = len(matrix)
    work = [[*row, *(float(i == j) for j in range(size))] for i, row in enumerate(matrix)]
    for i in range(size):
        work[i] = [value / work[i][i] for value in work[i]]
        for j in range(size):
            if j != i and work[j][i]:
                work[j] = [a - work[j][i] * b for a, b in zip(work[j], work[i], strict=True)]
    return [row[size:] for row in work]


def to_toml(model: DecisionModel) -> str:
    """The data file."""
    tables = dict(zip((*DECISIONS, "first"), (*model.needs, model.first), strict=True))
    blocks = (
        f"[{name}]\n" + "".join(f"{f} = {w:.4f}\n" for f, w in zip(FEATURES, row, strict=True)) for name, row in tables.items()
    )
    return _HEAD + "\n".join(blocks)


if __name__ == "__main__":
    target = resources.built_in("platform_repo") / "arduino/libraries/decision.toml" if len(sys.argv) < 2 else Path(sys.argv[1])
    target.write_text(to_toml(fit(samples(labelled()))), encoding="utf-8")
    print(f"wrote {target}")
