"""The stack that nested interrupt handlers take together."""

from __future__ import annotations

import pytest

from robosmi.transformations.queries.resources.interrupt_stack import HandlerBytes, upon_each_other


@pytest.mark.parametrize(
    ("handlers", "bytes_"),
    [
        ([], 0),
        ([(11, -1)], 11),
        ([(11, -1), (19, -1)], 19),  # neither lets the other in
        ([(11, -1), (50, 50)], 61),
        ([(11, -1), (50, 20)], 50),  # deeper where nothing comes than where the other does
        ([(21, -1), (68, 66), (60, 60)], 66 + 60 + 21),
    ],
)
def test_upon_those_that_let_others_in_comes_the_deepest(handlers: list[tuple[int, int]], bytes_: int) -> None:
    assert upon_each_other(HandlerBytes(*each) for each in handlers) == bytes_
