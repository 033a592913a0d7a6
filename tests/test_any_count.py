"""The count of explicit `Any` in annotations."""

from __future__ import annotations

import pytest

from tests.any_count import any_count


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("from typing import Any\ndef f(x: dict[str, Any], *y: Any, **z: int) -> Any: ...", 3),
        ("import typing as t\nx: t.Any = 1\nasync def f() -> list[t.Any]: ...", 2),
        ("from typing import Any as Whatever\nx: Whatever | None = None", 1),
        ("from typing import Any\ndef f(x: 'list[Any]') -> None: ...", 1),
        ("from typing import Any\nAlias = dict[str, Any]\nx: Alias = {}\ny = Any", 0),
        ("from elsewhere import Any\nx: Any = 1", 0),
    ],
)
def test_only_annotations_with_any_of_typing_count(source: str, expected: int) -> None:
    assert any_count(source) == expected
