"""The built-in operations put together: which function or method each name means, by kind of target, and how `q.name` is read.

The functions are in `anything`, `numbers`, `strings`, `operators`, `model_level`, and are methods of the collections and maps.
How a name finds its operation is in `operations`, which knows none of them, since many of them call operations by name.
"""

from __future__ import annotations

import inspect
from typing import Any

from robosmi.query import anything, model_level, models, numbers, operators, properties, strings, types
from robosmi.query.collections import Q, map_of
from robosmi.query.operations import TABLES, Table
from robosmi.query.values import as_string, equal, key


def _public(module: Any, *without: str) -> Table:
    """The functions a module defines, by name, without a `_` at the end."""
    found = {
        n.rstrip("_"): f
        for n, f in vars(module).items()
        if n[0] != "_" and inspect.isfunction(f) and f.__module__ == module.__name__
    }
    return {n: f for n, f in found.items() if n not in without}


_ELEMENT: Table = {
    **{n: f for n, f in _public(anything).items() if n.startswith("e_")},
    "id": models.id_of,
}
_ANY: Table = {
    **{n: f for n, f in _public(anything).items() if not n.startswith("e_")},
    "as_double": anything.as_real,
    "as_float": anything.as_real,
    "as_string": as_string,
    "type": types.type_of,
    "is_type_of": types.is_type_of,
    "is_kind_of": types.is_kind_of,
    "instance_of": types.is_kind_of,
    "get_native_type": anything.native_type,
    "has_property": properties.has_property,
    "owning_model": models.owning_model,
    "equals": lambda x, y: key(x) == key(y),
}
_BOOLEAN: Table = {
    "and": operators.both,
    "or": operators.either,
    "xor": operators.xor,
    "not": operators.negated,
}
_NUMBER: Table = {
    **_public(numbers, "to", "iota", "to_binary", "to_hex", "mod", "integer_range"),
    "as_double": numbers.as_real,
    "as_float": numbers.as_real,
    "ln": numbers.ln,
}
_INTEGER = {n: getattr(numbers, n) for n in ("to", "iota", "to_binary", "to_hex", "mod")}
_STRING = _public(strings)
_MAP: Table = {
    n: (lambda m, *a, _n=n: getattr(map_of(m), _n)(*a))
    for n in ("get", "put", "put_all", "remove", "contains_key", "contains_value", "key_set", "size", "is_empty", "clear")
}
_MAP["values"] = lambda m: map_of(m).value_bag()
_COLLECTION = {n: getattr(Q, n) for n in dir(Q) if n[0] != "_" and callable(getattr(Q, n))}
for _name in ("get", "list", "lazy", "distinct", "index"):
    _COLLECTION.pop(_name, None)
_COLLECTION["equals"] = lambda c, other: equal(c, other)

_BY_KIND = {
    "Any": _ANY, "Boolean": _BOOLEAN, "Collection": _COLLECTION, "Element": _ELEMENT, "Integer": _INTEGER,
    "Literal": model_level.LITERALS, "Map": _MAP, "Model": model_level.MODELS, "Number": _NUMBER, "String": _STRING,
    "Type": model_level.TYPES,
}  # fmt: skip


def put_together() -> None:
    """Give `operations` its tables, and collections the way to read a property of their items."""
    for kind, table in TABLES.items():
        table.update(_BY_KIND[kind])
    Q._read = staticmethod(properties.of_items)
