"""The table of the evaluation: a row is a claim of the paper, what is expected, and a function that measures it.

A row is a function with the decorator `row`. It returns what was got and whether that is within the row's tolerance; it raises
`Missing` where it cannot measure. The verdict follows: within its tolerance, a row has the verdict that its author foresaw
(reproduced, exceeded, or differs, with the reason); outside, it fails the evaluation.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from robosmi.errors import MissingToolError, RobosmiError
from tests.evaluation.sources import FETCH, corpus_folder

REPRODUCED, EXCEEDED, DIFFERS, NEVER, NOT_RUN, OUTSIDE = (
    "reproduced", "exceeded", "differs", "not reproducible", "not run", "outside its tolerance",
)  # fmt: skip
QUESTIONS = {
    "RQ1": "Can RoboSMi support migration between hardware platforms? (validation, step by step)",
    "RQ2": "What is the level of automation?",
    "RQ3": "What is the impact of the adapter pattern?",
    "RQ4": "What is the generality level?",
    "none": "What cannot be reproduced",
}
"""The paper's research questions (5.1), and what belongs to none."""


class Missing(Exception):
    """A row cannot be measured here.

    Args:
        what: what is missing.
        how: how to get it.
    """

    def __init__(self, what: str, how: str) -> None:
        super().__init__(f"{what}; {how}")


def require(*programs: str, how: str) -> None:
    """Check that programs are installed.

    Raises:
        Missing: one of them is not.
    """
    if missing := [name for name in programs if shutil.which(name) is None]:
        raise Missing(f"not installed: {', '.join(missing)}", how)


@dataclass(frozen=True)
class Got:
    """What a row measured, as a text that does not depend on the machine, and whether it is within the tolerance."""

    text: str
    within: bool = True


@dataclass
class Setting:
    """What rows measure with.

    Attributes:
        scratch: a folder for what rows write.
        given: the folder that `--corpus` names, or None.
    """

    scratch: Path
    given: Path | None = None

    @cached_property
    def corpus(self) -> Path:
        """The folder with other people's programs.

        Raises:
            Missing: there is none.
        """
        found = corpus_folder(self.given)
        if found is None:
            where = f"'{self.given}' has no program of the corpus" if self.given else "the corpus of programs is not here"
            raise Missing(where, f"run: {FETCH}")
        return found


Measure = Callable[[Setting], Got]


@dataclass(frozen=True)
class Row:
    """A row.

    Attributes:
        name: its name, such as `A1`.
        question: one of `QUESTIONS`.
        claim: what is claimed.
        place: where the paper claims it; `extension` for what goes beyond the paper.
        expected: what should come out.
        tolerance: how far off it may be.
        how: how it is measured.
        verdict: the verdict within the tolerance.
        reason: why it differs, or cannot be reproduced.
        quick: whether it needs neither network, compiler, simulator, corpus nor more than seconds.
        measure: measures it; None where nothing can.
    """

    name: str
    question: str
    claim: str
    place: str
    expected: str
    tolerance: str
    how: str
    verdict: str
    reason: str
    quick: bool
    measure: Measure | None


ROWS: dict[str, Row] = {}
"""All rows whose modules are imported; `rows` has them in order."""


def row(
    name: str, question: str, claim: str, place: str, expected: str, how: str, *, tolerance: str = "exact",
    verdict: str = REPRODUCED, reason: str = "", quick: bool = True,
) -> Callable[[Measure], Measure]:  # fmt: skip
    """Decorator: register a function as a row; see `Row`."""

    def registered(measure: Measure) -> Measure:
        _add(Row(name, question, claim, place, expected, tolerance, how, verdict, reason, quick, measure))
        return measure

    return registered


def rows() -> list[Row]:
    """All rows, by section and number."""
    return sorted(
        ROWS.values(), key=lambda each: (each.name[0], int("".join(c for c in each.name[1:] if c.isdigit())), each.name)
    )


def never(name: str, claim: str, place: str, reason: str) -> None:
    """Register a claim that nobody but its authors can check."""
    _add(Row(name, "none", claim, place, "as printed", "none", "nothing can be run", NEVER, reason, True, None))


def _add(made: Row) -> None:
    if made.name in ROWS:
        raise ValueError(f"two rows are called {made.name}")
    if made.question not in QUESTIONS or (made.verdict in (DIFFERS, NEVER)) != bool(made.reason):
        raise ValueError(f"row {made.name}: an unknown question, or a verdict without its reason")
    ROWS[made.name] = made


@dataclass(frozen=True)
class Outcome:
    """A row with its verdict."""

    row: Row
    got: str
    verdict: str

    @property
    def told(self) -> str:
        """The verdict with its reason."""
        return f"{self.verdict} ({self.row.reason})" if self.verdict in (DIFFERS, NEVER) else self.verdict

    def to_json(self) -> dict[str, Any]:
        """One element of the document of `--json`."""
        of = self.row
        return {
            "row": of.name, "claim": of.claim, "place": of.place, "expected": of.expected, "got": self.got, "verdict": self.told,
            "how": of.how, "tolerance": of.tolerance, "question": of.question,
        }  # fmt: skip


def outcomes(chosen: Iterable[Row], setting: Setting, *, quick: bool) -> Iterator[Outcome]:
    """The outcome of each row; what is missing makes a row 'not run'."""
    for each in chosen:
        yield _outcome(each, setting, quick)


def _outcome(of: Row, setting: Setting, quick: bool) -> Outcome:
    if of.measure is None:
        return Outcome(of, "-", of.verdict)
    if quick and not of.quick:
        return Outcome(of, "-", f"{NOT_RUN} (left out by --quick; run: python -m tests.evaluation --only {of.name})")
    try:
        got = of.measure(setting)
    except Missing as missing:
        return Outcome(of, "-", f"{NOT_RUN} ({missing})")
    except MissingToolError as missing:
        return Outcome(of, "-", f"{NOT_RUN} ({missing.message}{'; ' + missing.fix if missing.fix else ''})")
    except RobosmiError as error:
        return Outcome(of, f"the product failed: {error}", OUTSIDE)
    return Outcome(of, got.text, of.verdict if got.within else OUTSIDE)
