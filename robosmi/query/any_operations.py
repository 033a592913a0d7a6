"""EOL's operations on anything: definedness, conversions, output; each takes the value first.

The empty text counts as undefined, as in the engine. Conversions go by a value's text, those of numbers are in `numbers`.
What an element alone has (`e_container`, `e_contents`) is at the end. Source: AnyOperationContributor and
ScalarOperationContributor of Epsilon.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from datetime import datetime
from typing import TYPE_CHECKING, Any, TypeVar

from robosmi.model.elements.by_name import feature_values
from robosmi.model.elements.features import all_features, is_computed, opposite
from robosmi.model.elements.structure import root_of
from robosmi.query.collections import Bag, OrderedSet, Q, Set
from robosmi.query.extents import all_contents, contents
from robosmi.query.live_collections import collection
from robosmi.query.operators import is_long, wrapped
from robosmi.query.problems import OperandError
from robosmi.query.properties import get
from robosmi.query.values import INT_MAX, INT_MIN, Long, as_string

if TYPE_CHECKING:
    from robosmi.model.elements.ecore import EStructuralFeature
    from robosmi.query.values import Answer

T = TypeVar("T")

_REAL = re.compile(r"[+-]?(NaN|Infinity|(\d+(?:\.\d*)?|\.\d+)([eE][+-]?\d+)?[fFdD]?)")


def is_defined(value: Answer) -> bool:
    """Whether there is a value: neither None nor the empty text.

    >>> is_defined(""), is_defined(" "), is_defined(0)
    (False, True, True)
    """
    return value is not None and value != ""


def is_undefined(value: Answer) -> bool:
    """Whether the value is None or the empty text."""
    return not is_defined(value)


def if_undefined(value: Answer, otherwise: Answer) -> Any:
    """The value if it is defined, else the other."""
    return value if is_defined(value) else otherwise


def _text(value: Answer, operation: str) -> str:
    if value is None:
        raise OperandError(f"{operation} of nothing")
    return as_string(value)


def is_integer(value: Answer) -> bool:
    """Whether the value's text is an Integer of 32 bits."""
    return _parsed(_text(value, "isInteger")) is not None


def _parsed(text: str) -> int | None:
    number = int(text) if re.fullmatch(r"[+-]?[0-9]+", text) else None
    return number if number is not None and INT_MIN <= number <= INT_MAX else None


def as_integer(value: Answer) -> int:
    """The Integer that the value's text is; of a single other character its code.

    Raises:
        OperandError: the text is not an Integer.
    """
    text = _text(value, "asInteger")
    number = _parsed(text)
    if number is None and isinstance(value, str) and len(text) == 1:
        return ord(text)
    if number is None:
        raise OperandError(f"'{text}' is no Integer")
    return number


def as_long(value: Answer) -> Long:
    """The Long that the value's text is.

    Raises:
        OperandError: the text is not a Long.
    """
    text = _text(value, "asLong")
    if not re.fullmatch(r"[+-]?[0-9]+", text) or wrapped(int(text), long=True) != int(text):
        raise OperandError(f"'{text}' is no Long")
    return Long(text)


def is_real(value: Answer) -> bool:
    """Whether the value's text is a number."""
    return _REAL.fullmatch(_text(value, "isReal").strip()) is not None


def as_real(value: Answer) -> float:
    """The Real that the value's text is (EOL asReal, asFloat, asDouble), in Python's precision.

    Raises:
        OperandError: the text is not a Real.
    """
    text = _text(value, "asReal").strip()
    if _REAL.fullmatch(text) is None:
        raise OperandError(f"'{text}' is no Real")
    return float(text if text.endswith(("NaN", "Infinity")) else text.rstrip("fFdD"))


def as_boolean(value: Answer) -> bool:
    """Whether the value's text is "true", in upper or lower case; anything else is false."""
    return _text(value, "asBoolean").lower() == "true"


def as_unicode(value: Answer) -> str:
    """The character whose code the value's text is, in hexadecimal digits.

    Raises:
        OperandError: the text is not a hexadecimal number.
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


def as_date(value: Answer, pattern: str) -> datetime:
    """The date that the value's text is, by a pattern such as `yyyy-MM-dd`.

    Raises:
        OperandError: the text does not fit the pattern.
    """
    python = re.sub(r"[A-Za-z]+", lambda m: _DATE.get(m[0], m[0]), pattern.replace("%", "%%"))
    try:
        return datetime.strptime(_text(value, "asDate"), python)
    except ValueError as error:
        raise OperandError(f"'{as_string(value)}' is no date of the form {pattern}") from error


_CONVERSION = re.compile(r"%(?P<flags>[-#+ 0,(]*+)(?P<width>\d+)?(?:\.(?P<digits>\d+))?(?P<kind>[a-zA-Z%])")
_TAKES: dict[str, Callable[[Any], bool]] = {
    **dict.fromkeys("dxXo", lambda x: isinstance(x, int) and not isinstance(x, bool)),
    **dict.fromkeys("feEgG", lambda x: isinstance(x, float)),
    **dict.fromkeys("sSbB", lambda x: True),
    "c": lambda x: (isinstance(x, int) and not isinstance(x, bool)) or (isinstance(x, str) and len(x) == 1),
}


def format_(value: Answer, pattern: str) -> str:
    """The value written by a pattern such as `%03d`, by the rules of Java's formatter: `%d` rejects a Real, `%f` an Integer.

    Raises:
        OperandError: the pattern does not take the value, asks for a second one, or for more than 999,999 characters.

    >>> format_(7, "%03d|"), format_(2.5, "%.2f"), format_(-1, "%x"), format_(1234567, "%,d"), format_(True, "%s")
    ('007|', '2.50', 'ffffffff', '1,234,567', 'true')
    """
    taken = 0

    def written(match: re.Match[str]) -> str:
        nonlocal taken
        kind = match["kind"]
        if kind in "n%":
            return "\n" if kind == "n" else "%"
        taken += 1
        if kind not in _TAKES or taken > 1 or not (value is None or _TAKES[kind](value)):
            raise OperandError(f"'{pattern}' does not take {as_string(value)}")
        if max(len(match["width"] or ""), len(match["digits"] or "")) > 6:
            raise OperandError("the format asks for more than 999,999 characters", fix="ask for less")
        return _formatted(value, match)

    made = _CONVERSION.sub(written, pattern)
    if "%" in _CONVERSION.sub("", pattern):
        raise OperandError(f"'{pattern}' is no format")
    return made


def _formatted(value: Any, match: re.Match[str]) -> str:
    kind, flags, width, digits = match["kind"], match["flags"], match["width"] or "", match["digits"]
    if kind in "bB":
        text = "false" if value is None or value is False else "true"
    elif value is None or kind in "sS":
        text = "null" if value is None else as_string(value)
    elif kind == "c":
        text = chr(value) if isinstance(value, int) else value
    else:
        if kind in "xXo" and value < 0:
            value += 2**64 if is_long(value) else 2**32
        zero = "0" if "0" in flags and "-" not in flags else ""
        sign = "+" if "+" in flags else " " if " " in flags else "-"
        precision = f".{digits}" if digits is not None and kind in "feEgG" else ""
        text = format(value, f"{sign}{zero}{width if zero else ''}{',' if ',' in flags else ''}{precision}{kind}")
    if digits is not None and kind in "sSbB":
        text = text[: int(digits)]
    text = text.upper() if kind in "SBXEG" else text
    return text.ljust(int(width)) if width and "-" in flags else text.rjust(int(width or 0))


def print_(value: T, prefix: Answer = "", suffix: Answer = "") -> T:
    """Write the value to the standard output, and give it."""
    sys.stdout.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}")
    return value


def println(value: T, prefix: Answer = "", suffix: Answer = "") -> T:
    """Write the value and a line's end to the standard output, and give it."""
    sys.stdout.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}\n")
    return value


def err(value: T, prefix: Answer = "", suffix: Answer = "") -> T:
    """Write the value to the standard error output, and give it."""
    sys.stderr.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}")
    return value


def errln(value: T, prefix: Answer = "", suffix: Answer = "") -> T:
    """Write the value and a line's end to the standard error output, and give it."""
    sys.stderr.write(f"{as_string(prefix)}{as_string(value)}{as_string(suffix)}\n")
    return value


def native_type(value: Answer) -> type:
    """The Python class."""
    return value.__class__


def size(value: Answer) -> int:
    """The size of a collection; of anything else, texts too, 1."""
    return collection(value).size()


def as_sequence(value: Answer) -> Q[Any]:
    """A Sequence of a collection's items, or of the one value."""
    return collection(value).as_sequence()


def as_bag(value: Answer) -> Bag[Any]:
    """A Bag of a collection's items, or of the one value."""
    return collection(value).as_bag()


def as_set(value: Answer) -> Set[Any]:
    """A Set of a collection's items, or of the one value."""
    return collection(value).as_set()


def as_ordered_set(value: Answer) -> OrderedSet[Any]:
    """An OrderedSet of a collection's items, or of the one value."""
    return collection(value).as_ordered_set()


def e_container(element: Any) -> Any:
    """The element that contains this one, or None."""
    return element.eContainer()


def e_contents(element: Any) -> Q[Any]:
    """What the element contains directly, features in Ecore's order."""
    return Q(contents(element))


def e_all_contents(element: Any) -> Q[Any]:
    """What the element contains, in pre-order; without itself."""
    return Q(list(all_contents(element))[1:])


def e_class(element: Any) -> Any:
    """The element's EClass."""
    return element.eClass


def e_containing_feature(element: Any) -> Any:
    """The feature of the container that holds the element, or None."""
    return element.eContainmentFeature()


e_containment_feature = e_containing_feature


def e_root_container(element: Any) -> Any:
    """The outermost container, or the element itself."""
    return root_of(element)


def e_resource(element: Any) -> Any:
    """The resource of pyecore's that the element was loaded into, or None."""
    return element.eResource


def e_get(element: Any, feature: Any) -> Any:
    """The value of a feature, given by name or as a feature."""
    return get(element, feature if isinstance(feature, str) else feature.name)


def e_cross_references(element: Any) -> Q[Any]:
    """What the element refers to without containing it, features in Ecore's order."""
    found: list[Any] = []
    for feature in all_features(element.eClass):
        if feature.is_reference and not (feature.containment or is_computed(feature) or _is_container(feature)):
            found += feature_values(element, feature.name)
    return Q(found)


def _is_container(feature: EStructuralFeature) -> bool:
    opposed = opposite(feature)
    return opposed is not None and opposed.containment


def e_is_set(element: Any, feature: Any) -> bool:
    """Whether a feature differs from its default."""
    return bool(element.eIsSet(feature))
