"""Edits of ten kinds between regenerations: the short form of `tests.fuzz.edits`, and the judge of both."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.fuzz.edits import KINDS, run
from tests.fuzz.edits_judge import Round, faults

BASE = b"head\nvoid one() {\n  // TODO\n}\nvoid two() {\n  // TODO\n}\n"
EDITED = b"head\nvoid one() {\n  EDIT\n}\nvoid two() {\n  // TODO\n}\n"
MADE = b"new\nvoid one() {\n  // TODO\n}\nvoid two() {\n  // TODO\n}\n"
GOOD = b"new\nvoid one() {\n  EDIT\n}\nvoid two() {\n  // TODO\n}\n"
ONE = Round("o", BASE, EDITED, MADE, GOOD, {"RS512"})


def test_no_edit_is_lost_in_sixty_regenerations() -> None:
    tally = run(60, seed=20, each=6)
    assert tally.wrong == []
    assert set(KINDS) <= set(tally.edits)
    assert {"kept", "RS511", "stopped"} <= set(tally.outcomes), "the runs reach too little"


@pytest.mark.parametrize(
    "good",
    [
        ONE,
        replace(ONE, edited=BASE, after=MADE, rules=set()),
        replace(ONE, edited=EDITED.replace(b"\n", b"\r\n"), after=GOOD.replace(b"\n", b"\r\n")),
        replace(ONE, edited=b"\xef\xbb\xbf" + EDITED[:-1], after=b"\xef\xbb\xbf" + GOOD[:-1]),
        replace(ONE, after=EDITED, rules={"RS516"}),
        replace(ONE, after=b"<<<<<<< yours\n" + GOOD, rules={"RS511"}, old=[EDITED]),
        replace(ONE, made=None, after=EDITED, rules={"RS514"}),
        replace(ONE, made=None, edited=BASE, after=None, rules=set()),
        replace(ONE, edited=None, after=MADE, rules={"RS517"}),
    ],
)
def test_the_judge_finds_no_fault_where_an_edit_is_kept_or_reported(good: Round) -> None:
    assert list(faults(good)) == []


@pytest.mark.parametrize(
    ("bad", "fault"),
    [
        (replace(ONE, after=MADE), "lost: '  EDIT'"),
        (replace(ONE, after=EDITED), "not made: 'new'"),
        (replace(ONE, after=None), "the file is gone"),
        (replace(ONE, edited=BASE.replace(b"void two() {\n", b""), after=MADE), "back: 'void two() {'"),
        (replace(ONE, after=GOOD.replace(b"  EDIT\n", b"").replace(b"two() {\n", b"two() {\n  EDIT\n")), "misplaced: '  EDIT'"),
        (replace(ONE, edited=EDITED.replace(b"\n", b"\r\n")), "line ends"),
        (replace(ONE, edited=EDITED.replace(b"{\n", b"{\r\n", 1), after=GOOD.replace(b"two() {\n", b"two() {\r\n")), "line end"),
        (replace(ONE, edited=b"\xef\xbb\xbf" + EDITED), "byte order mark"),
        (replace(ONE, edited=EDITED[:-1]), "last line break"),
        (replace(ONE, after=b"<<<<<<< yours\n" + GOOD), "not reported"),
        (replace(ONE, rules={"RS511"}), "no old file"),
        (replace(ONE, rules={"RS511"}, old=[BASE]), "no old file"),
        (replace(ONE, rules={"RS516"}), "was changed"),
        (replace(ONE, made=None, after=None), "no longer made"),
        (replace(ONE, made=None, after=EDITED, rules=set()), "no longer made"),
        (replace(ONE, edited=None, after=MADE, rules=set()), "without a word"),
    ],
)  # fmt: skip
def test_the_judge_finds_what_is_lost(bad: Round, fault: str) -> None:
    assert [found for found in faults(bad) if fault in found]
