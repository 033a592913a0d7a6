"""EOL's operations on types, models and enumeration literals, for `call` and `get` by name; each takes the type or model first.

In Python one writes `m.Book.all`, `m.owns(x)`, `m.create(...)`: see `ModelView`. Operations on elements are in `anything`.
Source: EolModelElementType, IModel and ModelElementTypeOperations of Epsilon.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msgspec import Struct

from robosmi.model.driver import Model, TypeHandle, name_of, unknown_type
from robosmi.model.ecore import EClass, EObject
from robosmi.model.features import eclass_of
from robosmi.model.in_order import INHERITED, inherited
from robosmi.query.collections import Q
from robosmi.query.run import current_run
from robosmi.query.words import snake

if TYPE_CHECKING:
    from robosmi.functions import Function
    from robosmi.query.values import Answer


def _of_model(kind: Any) -> tuple[Model, Any]:
    """The model that a type's instances are asked for, and the type as it knows it."""
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
