"""Mistakes in a declaration or a check are reported with what was probably meant, and never ignored silently."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from robosmi.errors import RobosmiError, RuleError, UsageError
from robosmi.generate import Gen
from robosmi.transform import ETL, Flock
from robosmi.validate import EVL, Fail, Fix
from tests.library import library

FIX = Fix("rename", lambda: None)
ANY_FAIL: Any = Fail
ANY_EVL: Any = EVL
ANY_ETL: Any = ETL
ANY_FLOCK: Any = Flock
ANY_GEN: Any = Gen


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: ANY_FAIL("x", fix=FIX), "'fix=' of a Fail is an extra value"),
        (lambda: ANY_FAIL("x", fixes=[FIX]), "'fixes=' of a Fail is an extra value"),
        (lambda: ANY_FAIL("x", lambda: 3), "not a function"),
        (lambda: ANY_FAIL("x", "rename"), "not a str"),
    ],
)
def test_a_fix_that_would_not_be_offered_is_refused(make: Callable[[], object], what: str) -> None:
    with pytest.raises(UsageError, match=what) as refused:
        make()
    assert "each fix after the message" in str(refused.value.fix)


def test_a_fix_behind_the_message_is_offered_and_values_are_kept() -> None:
    v = EVL(library())
    v.context("Comic").constraint(name="C")(lambda c: Fail("x", FIX, count=3))
    v.run()
    assert [(u.extras, [f.title for f in u.fixes]) for u in v.unsatisfied] == [({"count": 3}, ["rename"])]


def test_a_raised_fail_is_told_with_the_line_and_what_to_write() -> None:
    v = EVL(library())

    def check(c: object) -> object:
        wrong: Any = Fail("x")
        raise wrong

    v.context("Comic").constraint(name="C")(check)
    with pytest.raises(RuleError, match=r"the check of C fails for .*: it raises what is no exception") as refused:
        v.run()
    assert refused.value.fix == "a check returns what it finds: write `return Fail(...)`"
    assert refused.value.location is not None
    assert refused.value.location.path.endswith("test_mistakes.py")
    assert refused.value.location.line == check.__code__.co_firstlineno + 2


@pytest.mark.parametrize(
    ("declare", "message"),
    [
        (
            lambda L: ANY_EVL(L).context("Comic").constraint(lasy=True),
            r"a constraint has no option 'lasy' \(did you mean",
        ),
        (lambda L: ANY_EVL(L).context("Comic").critique(inof=True), r"a critique has no option 'inof' \(did you mean 'info'\?\)"),
        (lambda L: ANY_EVL(L).context("Comic").constraint(info=True), r"a constraint has no option 'info'"),
        (lambda L: ANY_EVL(L).constraint(gard=1), r"a constraint has no option 'gard' \(did you mean 'guard'\?\)"),
        (lambda L: ANY_EVL(L).context("Comic", gard=1), r"a context has no option 'gard' \(did you mean 'guard'\?\)"),
        (lambda L: ANY_FLOCK(L, L).retype("Comic", "Book", wen=1), r"a retyping has no option 'wen' \(did you mean 'when'\?\)"),
        (lambda L: ANY_FLOCK(L, L).migrate("Comic", ignorin=[]), r"no option 'ignorin' \(did you mean 'ignoring'\?\)"),
        (
            lambda L: ANY_GEN("out", {"t": ""}, [L]).rule("Comic", templat="t"),
            r"no option 'templat' \(did you mean",
        ),
        (lambda L: ANY_GEN("out", {"t": ""}, [L]).rule("Comic", template="t", parameters=3), r"no option 'parameters'"),
        (lambda L: ANY_ETL(L).rule("Comic", to=[], lasy=True)(lambda c: None), r"a rule has no option 'lasy'"),
    ],
)
def test_a_misspelt_option_is_told_with_the_nearest(declare: Callable[[Any], object], message: str) -> None:
    with pytest.raises(RobosmiError, match=message):
        declare(library())
