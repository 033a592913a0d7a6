"""Model and type level of EOL over models of any technology: `ModelView`, ids, enumeration literals, create and delete.

`ModelView` gives the answers of a `robosmi.model.Model` as collections to query on; `with Run(m1, m2):` makes several models (or
views) known to a query, in which types are named `Book`, `library::Book` or `M!Book`. What a technology can do is its driver's.
Source: Kolovos et al., The Epsilon Object Language, section 3.3.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Never, TypeVar, cast, overload

from robosmi.errors import ModelError
from robosmi.model.ecore.metamodel import find_literal
from robosmi.model.elements.driver import (
    AmbiguousTypeWarning,
    DynamicNode,
    FeatureValue,
    Item,
    Kind,
    Model,
    Node,
    Type,
    TypeHandle,
    refuse_unknown_attribute,
    unknown_type,
)
from robosmi.model.elements.ecore import DynamicEObject, EClassifier, EEnum, EEnumLiteral, EObject, EPackage, Package
from robosmi.model.elements.element_factory import new, refuse_unnamed, unlink
from robosmi.model.elements.fragments import fragment_of
from robosmi.model.elements.structure import root_of
from robosmi.model.emf import EmfModel
from robosmi.model.repository import Repository
from robosmi.query.collections import Q
from robosmi.query.run import current_run

if TYPE_CHECKING:
    from robosmi.model.plain_xml import XmlElement, XmlModel

T = TypeVar("T")
D = TypeVar("D")


class ModelView(Model):
    """A model to be queried: what gives many elements gives a `Q`.

    Args:
        model: a model of any technology, a root element of EMF's, or several.
        packages: for root elements the EPackages or generated packages of their classes; found from the roots if None.
        name: what `M!Book` calls it; of a model its own name if None.

    `v.Book.all.select(...)`, `v.Book(name="x")`, `v["library::Book"]`; see `robosmi.model.driver.Model` for all the rest.
    """

    def __init__(
        self, model: Model | EObject | Iterable[EObject], packages: Iterable[Package] | None = None, name: str | None = None
    ) -> None:
        self.model: Model = model if isinstance(model, Model) else EmfModel(model, packages, name or "M")
        super().__init__(name or self.model.name, self.model.path)
        self.read_only = self.model.read_only

    @property
    def roots(self) -> list[DynamicEObject]:
        """The root elements, of EMF's models only."""
        return list(self._emf.roots)

    @property
    def packages(self) -> list[EPackage]:
        """The outermost EPackages, of EMF's models only."""
        return list(self._emf.packages)

    @property
    def root(self) -> XmlElement | None:
        """The root element of a model that has one, as plain XML; it may be given another."""
        return self._xml.root

    @root.setter
    def root(self, element: XmlElement) -> None:
        """Put another element in the place of the root."""
        self._xml.root = element

    @property
    def _xml(self) -> XmlModel:
        from robosmi.model.plain_xml import XmlModel

        if not isinstance(self.model, XmlModel):
            raise ModelError(f"the model {self.name} has no 'root': it may have several roots", fix="use roots")
        return self.model

    def __setattr__(self, name: str, value: object) -> None:
        refuse_unknown_attribute(self, name)
        super().__setattr__(name, value)

    @property
    def _emf(self) -> EmfModel:
        """The model; any name of a type is an attribute, and others raise an error."""
        return cast(EmfModel, self.model)

    def _collected(self, items: Sequence[T]) -> Q[T]:
        return items if isinstance(items, Q) else Q._of(list(items))

    def types(self) -> Iterator[tuple[str, Type]]:
        """All types that can be named, as (qualified name, type)."""
        return self.model.types()

    def find_type(self, name: str) -> Type | None:
        """The type of that name, simple or qualified, or None."""
        return self.model.find_type(name)

    def literal(self, name: str) -> EEnumLiteral:
        """An enumeration literal, `Genre#fiction`.

        Raises:
            UnknownTypeError: there is none.
        """
        return self.model.literal(name)

    def __getitem__(self, name: str) -> TypeHandle:
        model, _, plain = name.rpartition("!")
        if model not in ("", self.name):
            raise unknown_type(name, self.type_names())
        return TypeHandle(self, self.model[plain].kind)

    def all_contents(self) -> Iterator[Node]:
        """All elements in containment pre-order."""
        return self.model.all_contents()

    @overload
    def all(self, kind: type[T]) -> Q[T]: ...
    @overload
    def all(self, kind: str | EClassifier | TypeHandle) -> Q[DynamicNode]: ...
    def all(self, kind: Kind) -> Q[T] | Q[DynamicNode]:
        """The instances of a type and its subtypes (EOL `T.all`, `T.allInstances`, `T.allOfKind`).

        Raises:
            UnknownTypeError: a name that the model does not have.
        """
        return Q._of(list(self.model.all_of_kind(self.type_named(kind) if isinstance(kind, str) else kind)))

    all_of_kind = all
    all_instances = all

    @overload
    def all_of_type(self, kind: type[T]) -> Q[T]: ...
    @overload
    def all_of_type(self, kind: str | EClassifier | TypeHandle) -> Q[DynamicNode]: ...
    def all_of_type(self, kind: Kind) -> Q[T] | Q[DynamicNode]:
        """The instances of exactly a type (EOL `T.allOfType`).

        Raises:
            UnknownTypeError: a name that the model does not have.
        """
        return Q._of(list(self.model.all_of_type(self.type_named(kind) if isinstance(kind, str) else kind)))

    def element(self, identity: str) -> DynamicNode | None:
        """The element of an id or fragment (EOL `getElementById`), or None.

        Raises:
            ModelError: the id is none that this technology could give.
        """
        return self.model.element(identity)

    def id_of(self, element: Node) -> str:
        """The id or fragment of an element (EOL `getElementId`)."""
        return self.model.id_of(element)

    def owns(self, element: Item) -> bool:
        """Whether the element is in this model."""
        return self.model.owns(element)

    def create(self, kind: Kind, /, *values: Never, **features: FeatureValue) -> DynamicNode:
        """A new element of this model (EOL `new T(name = "x")`, `T.createInstance()`); see `Model.create`."""
        resolved = self.type_named(kind) if isinstance(kind, str) else kind
        refuse_unnamed(resolved, values)
        return self.model.create(resolved, **features)

    def delete(self, element: Node) -> None:
        """Take an element with all it contains out of this model (EOL `delete`); see `Model.delete`."""
        self.model.delete(element)

    def save(self, path: str | Path | None = None) -> None:
        """Write the model; see `Model.save`."""
        self.model.save(path)


@overload
def create(kind: type[T], /, *values: Never, **features: FeatureValue) -> T: ...
@overload
def create(kind: str | EClassifier | TypeHandle, /, *values: Never, **features: FeatureValue) -> DynamicNode: ...
def create(kind: Kind, /, *values: Never, **features: FeatureValue) -> T | DynamicNode:
    """A new element of a class or EClass, in no model.

    Raises:
        ModelError: the class is abstract, or has no such feature.
    """
    refuse_unnamed(kind, values)
    made: T | DynamicNode = new(kind, **features)
    return made


def delete(element: EObject) -> None:
    """Take an element with all it contains out of its container and out of all references to it."""
    unlink(element)


@overload
def literal_of(enumeration: EEnum, label: str) -> EEnumLiteral: ...
@overload
def literal_of(enumeration: EEnum, label: str, default: D, /) -> EEnumLiteral | D: ...
def literal_of(enumeration: EEnum, label: str, *default: D) -> EEnumLiteral | D:
    """A literal of an EEnum by its name, else by its literal text.

    Args:
        enumeration: the EEnum.
        label: name or literal text.
        default: given if there is none; without it that is an error.

    Raises:
        UnknownTypeError: there is none.
    """
    found = find_literal(enumeration, label)
    if found is None and not default:
        raise unknown_type(f"{enumeration.name}#{label}", [f"{enumeration.name}#{x.name}" for x in enumeration.eLiterals])
    return default[0] if found is None else found


def literal_named(name: str) -> EEnumLiteral:
    """The enumeration literal `Genre#fiction` or `M!Genre#fiction` of the current run's models (EOL `Genre#fiction`, `toEnum`).

    Raises:
        UnknownTypeError: there is none.
    """
    return Repository(current_run().models).literal(name)


def all_instances(name: str) -> Q[DynamicNode]:
    """All instances of a type of the current run's models and its subtypes: `Book`, `library::Book`, `M!Book`.

    Unqualified, the first model that has the type counts; if another has it too there is a warning.

    Raises:
        UnknownTypeError: no model has it.
    """
    repository = Repository(current_run().models)
    having = repository.having(name)
    if not having:
        raise unknown_type(name, repository.type_names())
    plain = name.rpartition("!")[2]
    if len(having) > 1:
        others = ", ".join(f"{m.name}!{plain}" for m in having)
        warnings.warn(f"the type '{name}' may be any of {others}; the first is used", AmbiguousTypeWarning, stacklevel=2)
    return Q._of(list(having[0].all_of_kind(having[0].find_type(plain) or plain)))


def model_named(name: str) -> Model:
    """The model of the current run with that name.

    Raises:
        ModelError: there is none.
    """
    return Repository(current_run().models).model(name)


def owning_model(element: Item) -> Model | None:
    """The model of the current run that holds the element, or None."""
    return Repository(current_run().models).owning(element)


def id_of(element: Node) -> str:
    """The element's id or fragment (EOL `id()`): `//@sections.0/@items.1`, as EMF writes it.

    Raises:
        ModelError: it is an element of another technology than EMF, and no model of the run holds it.
    """
    model = owning_model(element)
    if model is not None:
        return str(model.id_of(element))
    if not isinstance(element, EObject):
        raise ModelError(f"{element!r} is in no model of the run", fix="query inside `with Run(model):`")
    resource = root_of(element).eResource
    return fragment_of(element, list(resource.contents) if resource is not None else [])
