"""Reads TOML and JSON texts into Python values; any fault is reported as a `ValueError` with a message for persons.

Python's own readers also raise `RecursionError` for deeply nested texts, and give programmers' advice about numbers with
thousands of digits. The caller interprets the values and adds the file's name to the message.
"""

from __future__ import annotations

import json
import re
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TypeAlias

from robosmi.base.user_cache import CachedResults

Json: TypeAlias = "bool | int | float | str | Sequence[Json] | Mapping[str, Json] | None"
"""A value that JSON can represent; tuples are written as lists."""
MOST_PARTS = 100
"""Limit on the parts of a dotted key in TOML, since the time of Python's reader grows quadratically with them."""
_TOKEN = re.compile(
    r'''""".*?"""|\'{3}.*?\'{3}|#[^\n]*|(?P<part>"(?:\\.|[^"\\\n])*"|'[^'\n]*'|[A-Za-z0-9_-]+|[ \t]+)|(?P<dot>\.)|.''', re.DOTALL
)


_DECODER = json.JSONDecoder()


def json_written(
    value: Json,
    *,
    indent: int | None = None,
    sort_keys: bool = False,
    ensure_ascii: bool = True,
    separators: tuple[str, str] | None = None,
) -> str:
    """A value as a text in JSON, with the options of `json.dumps`."""
    return json.dumps(value, indent=indent, sort_keys=sort_keys, ensure_ascii=ensure_ascii, separators=separators)


@contextmanager
def _readable_errors() -> Iterator[None]:
    try:
        yield
    except (tomllib.TOMLDecodeError, json.JSONDecodeError, UnicodeDecodeError):
        raise
    except RecursionError:
        raise ValueError("it is nested too deeply") from None
    except ValueError as error:
        if "integer string conversion" in str(error):
            raise ValueError(f"a number in it has more than {sys.get_int_max_str_digits()} digits") from None
        raise


def toml_of(text: str | bytes) -> dict[str, Json]:
    """The value of a text in TOML 1.0, which is UTF-8 if it is given as bytes.

    Raises:
        ValueError: it is no TOML (`tomllib.TOMLDecodeError`), is nested too deeply, or has a number or a key that is too long.
    """
    with _readable_errors():
        text = (text if isinstance(text, str) else text.decode("utf-8")).removeprefix("\ufeff")  # some editors write a mark
        if any(line.count(".") >= MOST_PARTS for line in text.split("\n")) and _parts(text) > MOST_PARTS:
            raise ValueError(f"a key in it has more than {MOST_PARTS} parts")
        return tomllib.loads(text)


def line_of_error(error: Exception, text: str) -> int | None:
    """The line at which the reader of TOML stopped; None where it does not say."""
    if str(error).endswith("(at end of document)"):
        return text.rstrip("\n").count("\n") + 1
    found = re.search(r"\(at line (\d+), column \d+\)\Z", str(error))
    return int(found[1]) if found is not None else None


def data_toml(text: str) -> dict[str, Json]:
    """The value of a TOML text that every run reads, such as a file of the platform repository.

    Python's reader takes a millisecond for 5 KB, so values are cached from one run to the next.

    Raises:
        ValueError: as for `toml_of`.
    """
    if (cached := _TABLES.get(text)) is not None:
        return cached
    value = toml_of(text)
    _TABLES.put(text, value)
    return value


_TABLES: CachedResults[dict[str, Json]] = CachedResults("tables.json", "1", dict, 500)


def _parts(text: str) -> int:
    """The parts of the longest dotted key; dots in texts, comments and numbers do not count."""
    longest = dots = 0
    for token in _TOKEN.finditer(text):
        dots = dots + (token.lastgroup == "dot") if token.lastgroup else 0
        longest = max(longest, dots + 1)
    return longest


def json_at(text: str, place: int) -> tuple[Json, int]:
    """The value in JSON that begins at a place of a text, and the place behind it.

    Raises:
        ValueError: there is no JSON (`json.JSONDecodeError`, with the place in the text), or as for `json_of`.
    """
    with _readable_errors():
        found: tuple[Json, int] = _DECODER.raw_decode(text, place)
        return found


def json_of(text: str | bytes) -> Json:
    """The value of a text in JSON.

    Raises:
        ValueError: it is no JSON (`json.JSONDecodeError`), is nested too deeply, or has a number that is too long.
    """
    with _readable_errors():
        found: Json = json.loads(text)
        return found


def as_table(value: Json) -> dict[str, Json]:
    """A value that must be an object of JSON, or a table of TOML.

    Raises:
        ValueError: it is another one.
    """
    if not isinstance(value, dict):
        raise ValueError(f"it is not a table: {value!r}")
    return value


def as_list(value: Json) -> list[Json]:
    """A value that must be a list.

    Raises:
        ValueError: it is another one.
    """
    if not isinstance(value, (list, tuple)):
        raise ValueError(f"it is not a list: {value!r}")
    return list(value)


def as_text(value: Json) -> str:
    """A value that must be a text.

    Raises:
        ValueError: it is another one.
    """
    if not isinstance(value, str):
        raise ValueError(f"it is not a text: {value!r}")
    return value


def as_number(value: Json) -> float:
    """A value that must be a number, with a fraction or without.

    Raises:
        ValueError: it is another one.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"it is not a number: {value!r}")
    return value


def as_whole(value: Json) -> int:
    """A value that must be a whole number.

    Raises:
        ValueError: it is another one.
    """
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"it is not a whole number: {value!r}")
    return value


def as_texts(value: Json) -> list[str]:
    """A value that must be a list of texts.

    Raises:
        ValueError: it is another one.
    """
    return [as_text(each) for each in as_list(value)]


def line_of_key(text: str, key: str) -> int | None:
    """The first line of a TOML text in which a key or a table of that name is written; None where none is found."""
    found = re.search(rf"^[ \t]*(?:\[{{1,2}}[ \t]*)?[\"']?{re.escape(key)}[\"']?[ \t]*[\].=]", text, re.MULTILINE)
    return text.count("\n", 0, found.start()) + 1 if found is not None else None


def line_of_value(text: str, value: str) -> int | None:
    """The first line of a TOML text in which a text is a value; None where none is found."""
    place = text.find(f'"{value}"') if value else -1
    return text.count("\n", 0, place) + 1 if place >= 0 else None
