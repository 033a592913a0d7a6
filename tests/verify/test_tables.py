"""Tables of TOML files: what has the wrong kind is refused with the file and the key that leads to it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi.base.data_tables import DataTable
from robosmi.errors import PlatformDataError

TABLE = DataTable(
    Path("board.toml"),
    {
        "names": {"D0": "zero", "D1": 1},
        "numbers": {"D0": 0, "D1": "one"},
        "groups": [["a", "b"], "c"],
        "rate": 2.5,
        "on": 1,
    },
    "board.",
)


def test_a_table_that_is_not_there_is_empty_where_it_is_not_needed() -> None:
    absent = TABLE.table("absent", needed=False)
    assert (absent.values, absent.prefix) == ({}, "board.absent.")
    assert (TABLE.texts_by_name("absent"), TABLE.numbers_by_name("absent")) == ({}, {})
    assert TABLE.numbers("absent", ()) == ()
    assert TABLE.decimal("rate") == 2.5


@pytest.mark.parametrize(
    ("read", "said"),
    [
        (lambda: TABLE.texts_by_name("names"), "'board.names.D1' must be a text, it is 1"),
        (lambda: TABLE.numbers_by_name("numbers"), "'board.numbers.D1' must be a whole number, it is 'one'"),
        (lambda: TABLE.lists_of_texts("groups"), "'board.groups' must be a list of lists of texts, it is [['a', 'b'], 'c']"),
        (lambda: TABLE.flag("on"), "'board.on' must be true or false, it is 1"),
        (lambda: TABLE.flag("of"), "'board.of' is missing"),
        (lambda: TABLE.table("absent"), "'board.absent' is missing"),
        (lambda: DataTable(Path("f"), {"a": "b\0"}).text("a"), "'a' has a NUL character"),
        (lambda: DataTable(Path("f"), {"a": ["b", "\0"]}).texts("a"), "'a' has a NUL character"),
        (lambda: DataTable(Path("f"), {"a": [["\0"]]}).lists_of_texts("a"), "'a' has a NUL character"),
        (lambda: DataTable(Path("f"), {"a": -5}).positive("a"), "'a' must be above zero, it is -5"),
    ],
)
def test_a_value_of_another_kind_is_refused(read: Callable[[], object], said: str) -> None:
    with pytest.raises(PlatformDataError) as raised:
        read()
    assert raised.value.message.startswith(said)
