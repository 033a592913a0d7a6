"""Texts of XML attributes as the values that the driver of plain XML gives for its prefixes (`i_x`, `b_x`), and back."""

from __future__ import annotations

import re
from collections.abc import Iterable

from robosmi.model.elements.driver import FeatureValue, ModelElement
from robosmi.model.elements.ecore import EEnumLiteral, EObject
from robosmi.model.elements.strict import FeatureValueError

_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def typed(kind: str, value: str | None, element: ModelElement, name: str) -> bool | int | float | str | None:
    """The value of an attribute as that prefix asks for it: text, Boolean, whole number or number."""
    if kind in "as":
        return value or ""
    if kind == "b":
        return (value or "").strip().lower() == "true"
    if value is None:
        return None
    try:
        return int(value) if kind == "i" else float(value)
    except ValueError:
        raise FeatureValueError(
            f"{element!r}.{name}: '{value}' is no {'whole ' if kind == 'i' else ''}number", fix="use a_..."
        ) from None


def written(kind: str, value: FeatureValue, element: ModelElement, name: str) -> str:
    """The text of a value that an attribute is given by that prefix; of another kind, and collections, are refused."""
    if isinstance(value, (ModelElement, EObject, Iterable)) and not isinstance(value, (str, EEnumLiteral)):
        raise FeatureValueError(f"{element!r}.{name} does not take {value!r}: it takes one value", fix="write its text: str(...)")
    wanted = {"b": (bool,), "i": (int,), "f": (int, float), "d": (int, float)}.get(kind)
    if wanted is not None and (not isinstance(value, wanted) or (kind != "b" and isinstance(value, bool))):
        raise FeatureValueError(f"{element!r}.{name} does not take {value!r}", fix="give a value of its kind, or use a_...")
    return str(value).lower() if isinstance(value, bool) else str(value)


def checked(text: str, element: ModelElement, name: str) -> str:
    """The text itself, if XML can hold it."""
    if bad := _FORBIDDEN.search(text):
        raise FeatureValueError(f"{element!r}.{name}: XML cannot hold U+{ord(bad.group()):04X}", fix="remove the character")
    return text
