"""The operations of `Q` against EOL's semantics (research: the real engine's answers)."""

from __future__ import annotations

import operator

import pytest

from robosmi.metamodels import ccode
from robosmi.query import Long, OperandError, Q, all_contents, all_of_kind, all_of_type, ancestor_of_kind, root_of


def test_first_order_operations_keep_order_and_source() -> None:
    source = Q([3, 1, 2, 1])
    assert source.select(lambda x: x > 1) == [3, 2]
    assert source.reject(lambda x: x > 1) == [1, 1]
    assert source.collect(lambda x: [x]) == [[3], [1], [2], [1]]
    assert source.select_one(lambda x: x < 3) == 1
    assert source.select_one(lambda x: x > 9) is None
    assert source.sort_by(lambda x: -x) == [3, 2, 1, 1]
    assert source.map_by(lambda x: x % 2) == {1: Q([3, 1, 1]), 0: Q([2])}
    assert source.distinct() == [3, 1, 2]
    assert source.count(1) == 2
    assert source.count(lambda x: x > 1) == 2
    assert source == [3, 1, 2, 1]


def test_empty_collections_answer_as_eol_does() -> None:
    empty: Q[int] = Q()
    assert not empty.exists(bool)
    assert empty.for_all(bool)
    assert not empty.one(bool)
    assert empty.none(bool)
    assert empty.first() is None
    assert empty.last() is None


def test_exists_and_one_stop_as_soon_as_the_answer_is_known() -> None:
    seen: list[int] = []

    def noted(x: int) -> int:
        seen.append(x)
        return x

    assert Q([1, 2, 3]).exists(lambda x: noted(x) == 2)
    assert seen == [1, 2]
    seen.clear()
    assert not Q([1, 1, 1]).one(lambda x: noted(x) == 1)
    assert seen == [1, 1]


def test_closure_is_depth_first_and_ends_on_cycles() -> None:
    graph = {"a": ["b", "c"], "b": ["d"], "c": ["a"], "d": []}
    assert Q(["a"]).closure(lambda x: graph[x]) == ["b", "d", "c", "a"]
    assert Q(["d"]).closure(lambda x: graph[x]) == []
    assert Q([1]).closure(lambda x: x + 1 if x < 3 else None) == [2, 3]


def test_flatten_takes_all_levels_and_leaves_texts_whole() -> None:
    assert Q([[1, [2]], "ab", []]).flatten() == [1, 2, "ab"]


def test_extents_are_in_containment_pre_order() -> None:
    inner = ccode.Call(calleeName="g")
    outer = ccode.Call(calleeName="f", arguments=[inner, ccode.NameReference(name="x")])
    statement = ccode.ExpressionStatement(expression=outer)
    block = ccode.Block(statements=[statement, ccode.EmptyStatement()])
    assert [type(e).__name__ for e in all_contents(block)] == [
        "Block", "ExpressionStatement", "Call", "Call", "NameReference", "EmptyStatement",
    ]  # fmt: skip
    assert all_of_kind(block, ccode.Call) == [outer, inner]
    assert all_of_kind(block, ccode.Expression).collect(lambda e: e is outer) == [True, False, False]
    assert all_of_type(block, ccode.Statement) == []
    assert ancestor_of_kind(inner, ccode.Block) is block
    assert ancestor_of_kind(block, ccode.Block) is None
    assert root_of(inner) is block


def test_an_error_of_the_bodys_own_is_not_taken_for_one_of_the_order() -> None:
    with pytest.raises(TypeError, match="concatenate"):
        Q(["a", "b"]).sort_by(lambda x: operator.add(x, 1))
    with pytest.raises(OperandError, match="no order"):
        Q([1, "a"]).sort_by(lambda x: x)
    seen: list[int] = []
    assert Q([3, 1, 2]).sort_by(lambda x: seen.append(x) or x) == [1, 2, 3]  # type: ignore[func-returns-value]
    assert seen == [3, 1, 2], "the body is called once for each item, in order"


def test_sums_wrap_around_as_eols_and_pythons_own_is_exact() -> None:
    numbers = Q([2**31 - 1, 1])
    assert numbers.sum() == -(2**31)
    assert sum(numbers) == 2**31
    assert Q([2**31 - 1, Long(1)]).sum() == 2**31
    assert Q([2**16, 2**16]).product() == 0
