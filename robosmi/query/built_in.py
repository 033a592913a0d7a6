"""The built-in operations put together: which function or method each name means, by kind of target, and how `q.name` is read.

Operations on elements and other values are functions of `any_operations`, `numbers`, `strings` and `operators`, or methods of the
collections and maps. Those on types, models and enumeration literals are here: `call` and `get` use them by name, and each takes
the type or model first. In Python one writes `m.Book.all`, `m.owns(x)`, `m.create(...)`: see `ModelView`.
How a name finds its operation is in `operations`, which knows none of them, since many of them call operations by name.
Source: EolModelElementType, IModel and ModelElementTypeOperations of Epsilon.
"""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from robosmi.model.elements.containment_order import INHERITED, inherited
from robosmi.model.elements.driver import Model, TypeHandle, name_of, unknown_type
from robosmi.model.elements.ecore import EClass, EObject
from robosmi.model.elements.features import eclass_of
from robosmi.query import any_operations, models, numbers, operators, properties, strings, types
from robosmi.query.collections import Q, map_of
from robosmi.query.naming import snake
from robosmi.query.operations import TABLES, Table
from robosmi.query.run import current_run
from robosmi.query.values import as_string, equal, key

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.query.values import Answer


def _of_model(kind: Any) -> tuple[Model, Any]:
    """The model with a type's instances, and the model's own form of the type."""
    if isinstance(kind, TypeHandle):
        return kind.model, kind.kind
    for model in current_run().models:
        if any(known is kind for _, known in model.types()):
            return model, kind
    raise unknown_type(name_of(kind), [name for model in current_run().models for name in model.type_names()])


def all_of_kind(kind: Any) -> Q[Any]:
    """The instances of a type and its subtypes (EOL `T.all`, `T.allInstances()`, `T.allOfKind()`).

    Raises:
        UnknownTypeError: no model of the run has the type.
    """
    model, own = _of_model(kind)
    return Q(model.all_of_kind(own))


def all_of_type(kind: Answer) -> Q[Any]:
    """The instances of exactly a type (EOL `T.allOfType()`).

    Raises:
        UnknownTypeError: no model of the run has the type.
    """
    model, own = _of_model(kind)
    return Q(model.all_of_type(own))


def create_instance(kind: Answer) -> Any:
    """A new element in the type's model (EOL `T.createInstance()`, `new T`).

    Raises:
        UnknownTypeError: no model of the run has the type.
        ModelError: the type is abstract, or its model cannot be changed.
    """
    model, own = _of_model(kind)
    return model.create(own)


def is_instantiable(kind: Answer) -> bool:
    """Whether elements of the type can be made."""
    model, own = _of_model(kind)
    return not (model.read_only or any(getattr(own, name, False) is True for name in ("abstract", "interface")))


class _Inherited(Struct, frozen=True):
    """What a class has and inherits, in Ecore's order, by EMF's name for it."""

    name: str

    def __call__(self, kind: TypeHandle | EClass) -> Q[EObject]:
        """What it is for a class."""
        return Q(inherited(eclass_of(kind.kind if isinstance(kind, TypeHandle) else kind), self.name))


def _contents(model: Model) -> Q[Any]:
    return Q(model.all_contents())


TYPES: dict[str, Function] = {
    "all": all_of_kind,
    "all_instances": all_of_kind,
    "all_of_kind": all_of_kind,
    "all_of_type": all_of_type,
    "create_instance": create_instance,
    "is_instantiable": is_instantiable,
    "get_name": name_of,
    **{snake(name): _Inherited(name) for name in INHERITED},
}
"""Operations of types."""

MODELS: dict[str, Function] = {
    "all_contents": _contents,
    "all_instances": lambda model: _contents(model),
    "get_all_of_kind": lambda model, kind: Q(model.all_of_kind(kind)),
    "get_all_of_type": lambda model, kind: Q(model.all_of_type(kind)),
    "get_element_by_id": lambda model, identity: model.element(identity),
    "get_element_id": lambda model, element: model.id_of(element),
    "owns": lambda model, element: model.owns(element),
    "create_instance": lambda model, kind: model.create(kind),
    "delete_element": lambda model, element: model.delete(element),
    "has_type": lambda model, name: model.find_type(name) is not None,
    "get_type_of": lambda model, element: model.type_of(element),
    "get_name": lambda model: model.name,
}
"""Operations of models."""

LITERALS: dict[str, Function] = {
    "get_name": lambda literal: literal.name,
    "get_value": lambda literal: literal.value,
    "get_literal": lambda literal: getattr(literal, "literal", None) or literal.name,
}
"""Operations of enumeration literals; `name`, `value` and `literal` are properties too."""


def _public(module: Any, *without: str) -> Table:
    """The functions a module defines, by name, without a `_` at the end."""
    found = {
        n.rstrip("_"): f
        for n, f in vars(module).items()
        if n[0] != "_" and inspect.isfunction(f) and f.__module__ == module.__name__
    }
    return {n: f for n, f in found.items() if n not in without}


_ELEMENT: Table = {
    **{n: f for n, f in _public(any_operations).items() if n.startswith("e_")},
    "id": models.id_of,
}
_ANY: Table = {
    **{n: f for n, f in _public(any_operations).items() if not n.startswith("e_")},
    "as_double": any_operations.as_real,
    "as_float": any_operations.as_real,
    "as_string": as_string,
    "type": types.type_of,
    "is_type_of": types.is_type_of,
    "is_kind_of": types.is_kind_of,
    "instance_of": types.is_kind_of,
    "get_native_type": any_operations.native_type,
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
    "Literal": LITERALS, "Map": _MAP, "Model": MODELS, "Number": _NUMBER, "String": _STRING,
    "Type": TYPES,
}  # fmt: skip


def put_together() -> None:
    """Give `operations` its tables, and collections the way to read a property of their items."""
    for kind, table in TABLES.items():
        table.update(_BY_KIND[kind])
    Q._read = staticmethod(properties.of_items)
