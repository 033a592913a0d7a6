"""A misspelt operation of a collection or type is told with the nearest; so is EOL's own spelling of names and of functions."""

from __future__ import annotations

import pytest

from robosmi.errors import RobosmiError
from robosmi.query.expression import evaluate
from tests.library import library


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("Book.all.selct(lambda b: b.year > 2000)", "did you mean 'select'?"),
        ("Book.all.first().authors.notEmpty()", "did you mean 'not_empty'?"),
        ("Book.all.selectOne(lambda b: b.year > 2000)", "did you mean 'select_one'?"),
        ("Book.all.year > 2000", "q.size() > 1"),
        ("Book.allInstances()", "did you mean 'all'?"),
        ("Book.allOfType()", "did you mean 'all_of_type'?"),
        ("Book.all.nmae", "did you mean 'name'?"),
        ("Book.all.select(s | s.year > 2000)", "lambda s: ..."),
        ("Book.all.select(s : Book | s.year > 2000)", ""),
    ],
)
def test_the_nearest_name_is_told(asked: str, told: str) -> None:
    with pytest.raises(RobosmiError) as refused:
        evaluate(asked, [library()])
    assert told in str(refused.value)
