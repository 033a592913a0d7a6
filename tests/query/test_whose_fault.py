"""Whose fault it is when a rule raises: the user's rule, a call of ours that it makes, or a rule of ours."""

from __future__ import annotations

import types
from typing import Any

import pytest

from robosmi.errors import InternalError, RobosmiError, RuleError
from robosmi.query.collections import Q
from robosmi.transform import ETL
from robosmi.validate import EVL
from tests.library import empty, library


def ours(function: Any) -> Any:
    """Disguise a function as one of this package's."""
    made = types.FunctionType(
        function.__code__, function.__globals__, function.__name__, function.__defaults__, function.__closure__
    )
    made.__module__ = "robosmi.transformations.constraints.made_up"
    return made


def raised_by(check: Any) -> RobosmiError:
    L = library()
    v = EVL(L)
    v.context(L.Book).constraint(name="Known")(check)
    with pytest.raises(RobosmiError) as raised:
        v.run()
    return raised.value


def test_a_rule_of_the_user_is_the_users() -> None:
    error = raised_by(lambda b: [][0])
    assert isinstance(error, RuleError)
    assert error.message.startswith("the check of Known fails for")
    assert error.fix == "correct the function at this line, or guard it"


def test_a_rule_of_ours_is_a_bug_of_ours() -> None:
    error = raised_by(ours(lambda b: [][0]))
    assert isinstance(error, InternalError)
    assert error.exit_code == 70
    assert "the check of Known fails for" in error.message
    assert "report it" in str(error.fix)
    assert error.location is not None


def test_a_rule_of_ours_that_asks_another_of_ours_says_which_one_failed() -> None:
    L = library()
    v = EVL(L)
    book = v.context(L.Book)
    book.constraint(name="Inner", lazy=True)(ours(lambda b: [][0]))
    book.constraint(name="Outer")(ours(lambda b: v.satisfies(b, "Inner")))
    with pytest.raises(InternalError, match="the check of Inner fails"):
        v.run()


def test_what_the_world_does_to_a_rule_of_ours_is_no_bug() -> None:
    def full(b: Any) -> None:
        raise OSError(28, "No space left on device")

    error = raised_by(ours(full))
    assert isinstance(error, RuleError)
    assert "No space left" in error.message


def test_an_error_of_ours_on_purpose_in_a_rule_of_ours_is_about_the_model() -> None:
    error = raised_by(ours(lambda b: b.nme))
    assert isinstance(error, RuleError)
    assert "did you mean 'name'" in error.message


def test_code_of_ours_that_a_rule_of_the_user_calls_is_named() -> None:
    nothing: Any = None
    error = raised_by(lambda b: Q([b]).collect(nothing))
    assert isinstance(error, RuleError)
    assert "robosmi.query." in str(error.fix)
    assert "bug to report" in str(error.fix)


def test_a_transformation_of_ours_is_a_bug_of_ours() -> None:
    L, P = library(), empty("prices", "P")
    t = ETL(L, P)
    t.rule(L.Book, to=P.Price, name="Made")(ours(lambda b, p: [][0]))
    with pytest.raises(InternalError, match="the rule Made fails"):
        t.run()
