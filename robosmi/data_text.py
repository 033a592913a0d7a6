"""Texts in TOML and JSON as Python values; whatever is wrong with one is a `ValueError` whose text a person can read.

Python's own readers also end in a `RecursionError` for a text that is nested deeply, and in advice to programmers for a number
of thousands of digits. What the values mean is up to who asks for them, and so is the message with the file's name.
"""

from __future__ import annotations

import json
import sys
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


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


def toml_of(text: str | bytes) -> dict[str, Any]:
    """The value of a text in TOML 1.0, which is UTF-8 if it is given as bytes.

    Raises:
        ValueError: it is no TOML (`tomllib.TOMLDecodeError`), is nested too deeply, or has a number that is too long.
    """
    with _readable_errors():
        return tomllib.loads(text if isinstance(text, str) else text.decode("utf-8"))


def json_of(text: str | bytes) -> Any:
    """The value of a text in JSON.

    Raises:
        ValueError: it is no JSON (`json.JSONDecodeError`), is nested too deeply, or has a number that is too long.
    """
    with _readable_errors():
        return json.loads(text)
