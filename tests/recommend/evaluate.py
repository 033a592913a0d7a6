"""The evaluation of the rankers: `python -m tests.recommend.evaluate [--seconds]` prints the figures of the formula and of ours.

On the labelled parts of tests/evaluation: the paper's ranker, and ours as shipped,
without the model numbers and trade names of its tables, and without the tables. The confidence is measured by
cross-validation over queries (five folds): Brier score and reliability. With --seconds also the time of a query.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable
from dataclasses import dataclass

from robosmi.recommend.ranking import Recommendation
from robosmi.transformations.knowledge.libraries.library_ranking import tfidf_ranker
from tests.recommend.fit import Sample, fit, samples
from tests.recommend.labelled import VIEWS, Labelled, labelled, ranker

COLUMNS = ("top1", "canonical", "top5", "mrr", "ndcg5", "none_abstained", "library_answered", "abstention", "end_to_end")
GOALS = {"top1": 0.95, "top5": 1.0, "abstention": 0.95, "end_to_end": 0.92}
FOLDS = 5


@dataclass(frozen=True)
class Judged:
    """One answer: how sure the ranker was, and whether it was handled right."""

    query: int
    view: str
    confidence: float
    right: bool


def cross_validated(data: Labelled, found: list[Sample], view: str) -> tuple[list[Recommendation], list[Judged]]:
    """Answers in one view, each by a model that has not seen its query in any view."""
    answers: list[Recommendation | None] = [None] * len(data.queries)
    judged = []
    for fold in range(FOLDS):
        model = fit([sample for sample in found if sample.query % FOLDS != fold])
        ranking = ranker(view, model)
        for number in range(fold, len(data.queries), FOLDS):
            answer = ranking.rank(data.components[number], limit=10)
            right = data.score([answer], [number])["end_to_end"] == 1.0
            answers[number] = answer
            judged.append(Judged(number, view, answer.confidence, right))
    return [answer for answer in answers if answer is not None], judged


def brier(judged: Iterable[Judged]) -> float:
    """Mean squared distance between confidence and outcome; 0 is best, 0.25 is a coin."""
    listed = list(judged)
    return sum((each.confidence - each.right) ** 2 for each in listed) / len(listed)


def reliability(judged: Iterable[Judged]) -> list[tuple[str, int, float, float]]:
    """For ranges of confidence: range, number of answers, their mean confidence, the share that was right."""
    listed, table = list(judged), []
    for low, high in ((0.0, 0.5), (0.5, 0.7), (0.7, 0.8), (0.8, 0.9), (0.9, 0.95), (0.95, 1.01)):
        inside = [each for each in listed if low <= each.confidence < high]
        if inside:
            mean = sum(each.confidence for each in inside) / len(inside)
            table.append((f"{low:.2f}-{min(high, 1.0):.2f}", len(inside), mean, sum(e.right for e in inside) / len(inside)))
    return table


def row(name: str, figures: dict[str, float]) -> str:
    """One line of the table."""
    return f"{name:58}" + "".join(f"{figures[column]:9.3f}" for column in COLUMNS)


def main(arguments: list[str]) -> int:
    """Print everything; 1 if a goal is missed."""
    data = labelled()
    print(f"{'':58}" + "".join(f"{column[:8]:>9}" for column in COLUMNS))
    paper = tfidf_ranker(architecture="avr")
    print(row("the paper's formula (--ranker tfidf)", data.score([paper.rank(c) for c in data.components])))
    for view in VIEWS:
        ranking = ranker(view)
        start = time.perf_counter()
        answers = [ranking.rank(component, limit=10) for component in data.components]
        seconds = (time.perf_counter() - start) / len(answers)
        figures = data.score(answers)
        print(row(view, figures) + (f"  {seconds * 1000:.1f} ms" if "--seconds" in arguments else ""))
        if view == VIEWS[0]:
            missed = [f"{name} {figures[name]:.3f} < {goal}" for name, goal in GOALS.items() if figures[name] < goal]
    print(f"\ndecision and confidence fitted on other queries ({FOLDS} folds)")
    found = samples(data)
    for view in VIEWS:
        answers, judged = cross_validated(data, found, view)
        print(row(view, data.score(answers)))
        print(f"  Brier score {brier(judged):.3f}; always saying the mean: {_mean_brier(judged):.3f}")
        for name, count, mean, share in reliability(judged):
            print(f"  confidence {name}: {count:4} answers, mean {mean:.2f}, right {share:.2f}")
    print("\n" + (f"missed: {', '.join(missed)}" if missed else f"all goals reached: {GOALS}"))
    return bool(missed)


def _mean_brier(judged: list[Judged]) -> float:
    share = sum(each.right for each in judged) / len(judged)
    return share * (1 - share)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
