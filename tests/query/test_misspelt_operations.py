"""A misspelt operation of a collection or type is told with the nearest; so is EOL's own spelling of names and of functions."""

from __future__ import annotations

from typing import Any

import pytest

from robosmi.errors import RobosmiError
from robosmi.query import Q
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


@pytest.mark.parametrize("items", [Q([]), Q([]).as_set(), Q(["a"]).select(lambda _text: False)])
def test_of_an_empty_collection_too(items: Any) -> None:
    with pytest.raises(RobosmiError, match="did you mean 'not_empty'") as refused:
        items.notEmpty()
    assert refused.value.fix == "write not_empty(...)"
    with pytest.raises(RobosmiError, match="did you mean 'select_one'"):
        items.selectOne(lambda _text: True)
    assert repr(items.notEmpty) == "Q([])"  # a feature may have this name
