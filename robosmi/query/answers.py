"""Results of queries for scripts and terminals: `as_json` and `as_lines`.

Elements become their type, id and name. Call these functions inside the run whose models contain the elements. `expression`
evaluates queries.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from datetime import date
from decimal import Decimal
from typing import TYPE_CHECKING, Any

from robosmi.errors import ModelError, UsageError
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.driver import Model, TypeHandle, features_of, is_element, name_of, type_of
from robosmi.model.elements.ecore import EEnumLiteral
from robosmi.query.collections import Lazy
from robosmi.query.models import id_of
from robosmi.query.values import EolType, as_string, collection_kind

if TYPE_CHECKING:
    from robosmi.base.data_text import Json
    from robosmi.query.values import Answer

MAX_DEPTH = 100
MAX_DIGITS = 4000
MAX_LETTERS = 10_000_000


def as_json(value: Answer) -> Any:
    """A value as JSON has it: collections as arrays, maps as objects (as pairs if a key is no text), literals by name.

    An element is `{"type", "id", "name"}`, without `name` where it has none; a number that JSON lacks (NaN) is its text.

    Raises:
        UsageError: it is no value, as a model or a function, or it is nested too deep or too long to be shown.
    """
    return _json(value, 0)


def _json(value: Any, depth: int) -> Any:
    if depth > MAX_DEPTH:
        raise UsageError(f"the value is nested deeper than {MAX_DEPTH} levels", fix="ask for less")
    if isinstance(value, str) and len(value) > MAX_LETTERS:
        raise UsageError(f"the text has more than {MAX_LETTERS:,} characters", fix="ask for less")
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, int):
        if value.bit_length() > 3 * MAX_DIGITS:
            raise UsageError(f"the number has more than {MAX_DIGITS} digits", fix="ask for less")
        return int(value)
    if isinstance(value, float):
        return value if math.isfinite(value) else as_string(value)
    if isinstance(value, EEnumLiteral):
        return str(value.name)
    if is_element(value):
        return element_json(value)
    if isinstance(value, Mapping):
        entries = [(_json(k, depth + 1), _json(v, depth + 1)) for k, v in value.items()]
        return dict(entries) if all(isinstance(k, str) for k, _ in entries) else [list(entry) for entry in entries]
    if collection_kind(value) is not None or isinstance(value, Lazy):
        return [_json(x, depth + 1) for x in value]
    if isinstance(value, (TypeHandle, EolType)):
        return value.name
    if isinstance(value, (date, Decimal)):
        return str(value)
    if isinstance(value, Model) or callable(value):
        what = "a model" if isinstance(value, Model) else "a function or type"
        raise UsageError(f"the value is {what}, which cannot be shown", fix="ask for what it holds, as Book.all or f(x)")
    return str(value)


def element_json(element: Any) -> dict[str, Any]:
    """An element by its type, its id, and its name if it has one."""
    try:
        identity = id_of(element)
    except ModelError:
        identity = None  # of no model any more
    shown: dict[str, Any] = {"type": name_of(type_of(element)), "id": identity}
    names = ("name", "a_name")
    if (feature := next((n for n in names if n in features_of(element)), None)) and isinstance(
        name := feature_value(element, feature), str
    ):
        shown["name"] = name
    return shown


def as_lines(plain: Answer) -> list[str]:
    """What `as_json` gave, as text: a collection or map one item a line, anything else as EOL prints it."""
    if isinstance(plain, list):
        return [_line(item) for item in plain]
    if isinstance(plain, dict) and not _is_element_form(plain):
        return [f"{key}: {_line(item)}" for key, item in plain.items()]
    return [_line(plain)]


def _is_element_form(plain: dict[str, Json]) -> bool:
    return plain.keys() <= {"type", "id", "name"} and plain.keys() >= {"type", "id"}


def _line(value: Answer) -> str:
    if isinstance(value, dict) and _is_element_form(value):
        return " ".join(str(value[key]) for key in ("type", "id", "name") if value.get(key) is not None)
    if isinstance(value, list):
        return f"[{', '.join(_line(x) for x in value)}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{k}: {_line(v)}' for k, v in value.items())}}}"
    return as_string(value) if not isinstance(value, str) else value
