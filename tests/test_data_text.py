"""Texts in TOML and JSON: what Python's own readers end in otherwise is an error with a text for a person."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from robosmi.base.data_text import as_number, json_of, toml_of


@pytest.mark.parametrize("read", [toml_of, json_of])
@pytest.mark.parametrize(
    ("value", "cause"), [("[" * 100_000, "nested too deeply"), ("9" * 10_000, "more than 4300 digits"), ("]", "nvalid|xpecting")]
)
def test_a_text_that_cannot_be_read_is_a_value_error(read: Callable[[str], Any], value: str, cause: str) -> None:
    with pytest.raises(ValueError, match=cause):
        read(f"a = {value}" if read is toml_of else value)


def test_what_can_be_read_is() -> None:
    assert toml_of(b"a = [1, 2]") == {"a": [1, 2]}
    assert toml_of(b"\xef\xbb\xbfa = 1") == toml_of("\ufeffa = 1") == {"a": 1}
    assert json_of('{"a": [1, 2]}') == {"a": [1, 2]}


@pytest.mark.parametrize("part", ["a", '"a.\\" = b"', "'='", "a \t"])
def test_a_dotted_key_without_end_is_refused_at_once(part: str) -> None:
    with pytest.raises(ValueError, match="more than 100 parts"):
        toml_of("x = 1\n" + ".".join([part] * 30_000) + " = 1")


def test_dots_of_texts_comments_and_numbers_are_no_parts_of_keys() -> None:
    dots = "a." * 300 + "b"
    text = f'# {dots}\na.b.c = "{dots}"\nd = """\n{dots}"""\ne = \'\'\'\n{dots}\'\'\'\nf = [{"1.5, " * 300}]\n'
    assert toml_of(text)["d"] == dots


@pytest.mark.parametrize("value", ["1", True, None, [1]])
def test_what_is_no_number_is_refused(value: Any) -> None:
    assert as_number(1) == 1
    with pytest.raises(ValueError, match="it is not a number"):
        as_number(value)
