"""Queries over models in the style of the Epsilon Object Language (EOL), in Python.

`Q` and its kinds `Bag`, `Set`, `OrderedSet` with EOL's operations; `Map`, `Tuple`; extents, model views and types; `get` and
`call` for properties and operations by name; `@operation`, `ext` and `Run`. Operators and the operations on numbers, texts and
anything are functions in the modules of these names. Nothing here knows a metamodel. docs/reference/eol.md compares it with EOL.
"""

from __future__ import annotations

from robosmi.model.elements.driver import UnknownTypeError
from robosmi.model.elements.structure import root_of
from robosmi.query import anything, built_in, numbers, operators, strings
from robosmi.query.collections import Bag, Lazy, Map, OrderedSet, Q, Set, Tuple
from robosmi.query.extents import all_contents, all_of_kind, all_of_type, ancestor_of_kind
from robosmi.query.live_collections import collection
from robosmi.query.models import (
    ModelView,
    all_instances,
    create,
    delete,
    id_of,
    literal_named,
    literal_of,
    model_named,
    owning_model,
)
from robosmi.query.numbers import integer_range
from robosmi.query.operations import call, call_built_in
from robosmi.query.operators import elvis, implies, xor
from robosmi.query.own_operations import cached, operation
from robosmi.query.problems import OperandError, UndefinedError, UnknownOperationError, UnknownPropertyError
from robosmi.query.properties import get, get_safe, has_property
from robosmi.query.run import Run, current_run, ext
from robosmi.query.types import is_kind_of, is_type_of, type_named, type_of
from robosmi.query.values import EolType, Long, as_string, equal

built_in.put_together()

__all__ = [
    "Bag",
    "EolType",
    "Lazy",
    "Long",
    "Map",
    "ModelView",
    "OperandError",
    "OrderedSet",
    "Q",
    "Run",
    "Set",
    "Tuple",
    "UndefinedError",
    "UnknownOperationError",
    "UnknownPropertyError",
    "UnknownTypeError",
    "all_contents",
    "all_instances",
    "all_of_kind",
    "all_of_type",
    "ancestor_of_kind",
    "anything",
    "as_string",
    "cached",
    "call",
    "call_built_in",
    "collection",
    "create",
    "current_run",
    "delete",
    "elvis",
    "equal",
    "ext",
    "get",
    "get_safe",
    "has_property",
    "id_of",
    "implies",
    "integer_range",
    "is_kind_of",
    "is_type_of",
    "literal_named",
    "literal_of",
    "model_named",
    "numbers",
    "operation",
    "operators",
    "owning_model",
    "root_of",
    "strings",
    "type_named",
    "type_of",
    "xor",
]
