"""EOL's operations on anything: definedness, conversions, output; each takes the value first.

The empty text counts as undefined, as in the engine. Conversions go by a value's text, those of numbers are in `numbers`.
What an element alone has (`e_container`, `e_contents`) is at the end. Source: AnyOperationContributor and
ScalarOperationContributor of Epsilon.
"""

from __future__ import annotations

import re
import sys
from datetime import datetime
from typing import Any, TypeVar

from robosmi.query.collections import Bag, OrderedSet, Q, Set, collection
from robosmi.query.operators import wrapped
from robosmi.query.problems import OperandError
from robosmi.query.values import INT_MAX, INT_MIN, Long, as_string

T = TypeVar("T")

_REAL = re.compile(r"[+-]?(NaN|Infinity|(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?[fFdD]?)")


def is_defined(value: Any) -> bool:
    """Whether there is a value: neither None nor the empty text.

    >>> is_defined(""), is_defined(" "), is_defined(0)
    (False, True, True)
    """
    return value is not None and value != ""


def is_undefined(value: Any) -> bool:
    """Whether the value is None or the empty text."""
    return not is_defined(value)


def if_undefined(value: Any, otherwise: Any) -> Any:
    """The value if it is defined, else the other."""
    return value if is_defined(value) else otherwise


def _text(value: Any, operation: str) -> str:
    if value is None:
        raise OperandError(f"{operation} of nothing")
    return as_string(value)


def is_integer(value: Any) -> bool:
    """Whether the value's text is an Integer of 32 bits."""
    return _parsed(_text(value, "isInteger")) is not None


def _parsed(text: str) -> int | None:
    number = int(text) if re.fullmatch(r"[+-]?[0-9]+", text) else None
    return number if number is not None and INT_MIN <= number <= INT_MAX else None


def as_integer(value: Any) -> int:
    """The Integer that the value's text is; of a single other character its code.

    Raises:
        OperandError: it is none.
    """
    text = _text(value, "asInteger")
    number = _parsed(text)
    if number is None and isinstance(value, str) and len(text) == 1:
        return ord(text)
    if number is None:
        raise OperandError(f"'{text}' is no Integer")
    return number


def as_long(value: Any) -> Long:
    """The Long that the value's text is.

    Raises:
        OperandError: it is none.
    """
    text = _text(value, "asLong")
    if not re.fullmatch(r"[+-]?[0-9]+", text) or wrapped(int(text), long=True) != int(text):
        raise OperandError(f"'{text}' is no Long")
    return Long(text)


def is_real(value: Any) -> bool:
    """Whether the value's text is a number."""
    return _REAL.fullmatch(_text(value, "isReal").strip()) is not None


def as_real(value: Any) -> float:
    """The Real that the value's text is (EOL asReal, asFloat, asDouble), in Python's precision.

    Raises:
        OperandError: it is none.
    """
    text = _text(value, "asReal").strip()
    if _REAL.fullmatch(text) is None:
        raise OperandError(f"'{text}' is no Real")
    return float(text if text.endswith(("NaN", "Infinity")) else text.rstrip("fFdD"))


def as_boolean(value: Any) -> bool:
    """Whether the value's text is "true", in upper or lower case; anything else is false."""
    return _text(value, "asBoolean").lower() == "true"


def as_unicode(value: Any) -> str:
    """The character whose code the value's text is, in hexadecimal digits.

    Raises:
        OperandError: it is none.
    """
    text = _text(value, "asUnicode")
    if not re.fullmatch(r"[0-9a-fA-F]{1,8}", text):
        raise OperandError(f"'{text}' is no hexadecimal number")
    return chr(int(text, 16) % 65536)


_DATE = {
    "yyyy": "%Y",
    "yy": "%y",
    "MMMM": "%B",
    "MMM": "%b",
    "MM": "%m",
    "M": "%m",
    "dd": "%d",
    "d": "%d",
    "HH": "%H",
    "hh": "%I",
    "mm": "%M",
    "ss": "%S",
    "SSS": "%f",
    "a": "%p",
    "EEEE": "%A",
    "EEE": "%a",
}


def as_date(value: Any, pattern: str) -> datetime:
    """The date that the value's text is, by a pattern such as `yyyy-MM-dd`.

    Raises:
        OperandError: the text does not fit the pattern.
    """
    python = re.sub(r"[A-Za-z]+", lambda m: _DATE.get(m[0], m[0]), pattern.replace("%", "%%"))
    try:
        return datetime.strptime(_text(value, "asDate"), python)
    except ValueError as error:
        raise OperandError(f"'{as_string(value)}' is no date of the form {pattern}") from error


def format_(value: Any, pattern: str) -> str:
    """The value written by a pattern such as `%03d`.

    Raises:
        OperandError: the pattern does not take the value.
    """
    shown = as_string(value) if re.search(r"%[-0-9.]*s", pattern) else value
    try:
        return pattern.replace("%n", "\n") % (shown,)
    except (TypeError, ValueError) as error:
        raise OperandError(f"'{pattern}' does not take {as_string(value)}: {error}") from error


def print_(value: T, prefix: Any = "", suffix: Any = "") -> T:
    """Write the value to the standard output, and give it."""
    sys.stdout.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}")
    return value


def println(value: T, prefix: Any = "", suffix: Any = "") -> T:
    """Write the value and a line's end to the standard output, and give it."""
    sys.stdout.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}\n")
    return value


def err(value: T, prefix: Any = "", suffix: Any = "") -> T:
    """Write the value to the standard error output, and give it."""
    sys.stderr.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}")
    return value


def errln(value: T, prefix: Any = "", suffix: Any = "") -> T:
    """Write the value and a line's end to the standard error output, and give it."""
    sys.stderr.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}\n")
    return value


def native_type(value: Any) -> type:
    """The Python class."""
    return type(value)


def size(value: Any) -> int:
    """The size of a collection; of anything else, texts too, 1."""
    return collection(value).size()


def as_sequence(value: Any) -> Q[Any]:
    """A Sequence of a collection's items, or of the one value."""
    return collection(value).as_sequence()


def as_bag(value: Any) -> Bag[Any]:
    """A Bag of a collection's items, or of the one value."""
    return collection(value).as_bag()


def as_set(value: Any) -> Set[Any]:
    """A Set of a collection's items, or of the one value."""
    return collection(value).as_set()


def as_ordered_set(value: Any) -> OrderedSet[Any]:
    """An OrderedSet of a collection's items, or of the one value."""
    return collection(value).as_ordered_set()


def e_container(element: Any) -> Any:
    """The element that contains this one, or None."""
    return element.eContainer()


def e_contents(element: Any) -> Q[Any]:
    """What the element contains directly, features in Ecore's order."""
    from robosmi.query.extents import contents

    return Q(contents(element))


def e_all_contents(element: Any) -> Q[Any]:
    """What the element contains, in pre-order; without itself."""
    from robosmi.query.extents import all_contents

    return Q(list(all_contents(element))[1:])


def e_class(element: Any) -> Any:
    """The element's EClass."""
    return element.eClass


def e_containing_feature(element: Any) -> Any:
    """The feature of the container that holds the element, or None."""
    return element.eContainmentFeature()


def e_is_set(element: Any, feature: Any) -> bool:
    """Whether a feature differs from its default."""
    return bool(element.eIsSet(feature))
