"""The one interface through which every language here sees a model, whatever its technology; a driver is one subclass of `Model`.

Elements are plain Python objects on which `element.feature` reads a feature, and writes it where the technology can change.
EMF's are pyecore EObjects; all others derive from `ModelElement`. A type is an object that `isinstance` takes: a Python class or
an EClass. A driver says which types there are, gives all elements in containment order and knows identities; the rest is here.
A model whose technology cannot be changed refuses `create`, `delete`, `save` and assignments with a `ReadOnlyError`.
Not here: any technology (`emf`, `plain_xml`, `table`), how a file finds its driver (`opening`), queries (`robosmi.query`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias, TypeGuard

from robosmi.errors import ModelError, did_you_mean, some_of
from robosmi.model.elements import structure
from robosmi.model.elements.ecore import DynamicEObject, EClass, EClassifier, EEnum, EEnumLiteral, EObject, Scalar
from robosmi.model.elements.feature_errors import LABELS, not_named

Node: TypeAlias = "EObject | ModelElement"
"""An element of any technology."""
DynamicNode: TypeAlias = "DynamicEObject | ModelElement"
"""An element of any technology of which only its model knows the features."""
Type: TypeAlias = "EClassifier | type"
"""A type of elements: a class of Ecore, or a Python class."""
Kind: TypeAlias = "str | Type | TypeHandle"
"""How a type may be given: itself, its name, or by a model."""
FeatureValue: TypeAlias = "Item | Iterable[Item]"
"""What a feature may be given."""
Item: TypeAlias = "Scalar | ModelElement"
"""One value: an element of any technology, or a plain value."""
ItemOrItems: TypeAlias = "Item | Sequence[Item]"
"""What a feature holds."""


class UnknownTypeError(ModelError, AttributeError):
    """A type name that no model knows."""


class AmbiguousTypeWarning(UserWarning):
    """A type name that several models or packages have; the first counts."""


class ReadOnlyError(ModelError, AttributeError):
    """A change of a model that cannot be changed."""


def unknown_type(name: str, known: Iterable[str]) -> UnknownTypeError:
    """The error for a type that is not there, with the nearest that is."""
    names = sorted(set(known))
    fix = f"use one of: {some_of(names, name, 40)}" if names else "query inside `with Run(model):`"
    return UnknownTypeError(f"there is no type '{name}'{did_you_mean(name, names)}", fix=fix)


class ModelElement(ABC):
    """Base class of the elements of technologies other than EMF.

    Features are attributes; names that begin with an underscore are the driver's own and no query sees them.
    """

    __slots__ = ("__weakref__",)

    if TYPE_CHECKING:  # what features there are only the technology knows

        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

    @abstractmethod
    def eContainer(self) -> ModelElement | None:
        """The element that contains this one, or None."""

    @abstractmethod
    def _contents(self) -> list[ModelElement]:
        """What this element contains directly."""

    @abstractmethod
    def _features(self) -> list[str]:
        """The names of its features, in order."""


class Model(ABC):
    """A model of any technology.

    Args:
        name: what `M!Book` calls it.
        path: the file or folder it was read from, None for none.
    """

    read_only = False
    """Whether the technology refuses changes."""

    def __init__(self, name: str = "M", path: Path | None = None) -> None:
        self.name = name
        self.path = path

    # Types

    @abstractmethod
    def types(self) -> Iterator[tuple[str, Type]]:
        """All types that can be named, as (qualified name, type); without a metamodel, those that occur."""

    def find_type(self, name: str) -> Type | None:
        """The type of that name, simple or qualified (`library::Book`), or None."""
        return next((kind for path, kind in self.types() if name in (path, path.rpartition("::")[2])), None)

    def type_names(self) -> list[str]:
        """The simple names of all types."""
        return [path.rpartition("::")[2] for path, _ in self.types()]

    def type_named(self, name: str) -> Type:
        """The type of that name (`Book`, `library::Book`, with or without `M!`).

        Raises:
            UnknownTypeError: there is none.
        """
        model, _, plain = name.rpartition("!")
        found = self.find_type(plain) if model in ("", self.name) else None
        if found is None:
            raise unknown_type(name, self.type_names())
        return found

    def type_of(self, element: Node) -> Type:
        """The exact type of an element."""
        return type_of(element)

    def literal(self, name: str) -> EEnumLiteral:
        """An enumeration literal, `Genre#fiction`.

        Raises:
            UnknownTypeError: there is none; most technologies have no enumerations.
        """
        raise unknown_type(name, [])

    # Extents

    @abstractmethod
    def all_contents(self) -> Iterator[Node]:
        """All elements, a container before what it contains."""

    def all_of_kind(self, kind: Kind) -> Sequence[Node]:
        """The elements of a type and its subtypes, in the order of `all_contents`.

        Args:
            kind: a type, or its name.

        Raises:
            UnknownTypeError: a name that there is not.
        """
        wanted = self._class_of(kind)
        return [x for x in self.all_contents() if isinstance(x, wanted)]

    def all_of_type(self, kind: Kind) -> Sequence[Node]:
        """The elements of exactly a type, in the order of `all_contents`.

        Raises:
            UnknownTypeError: a name that there is not.
        """
        wanted = self._class_of(kind)
        return [x for x in self.all_contents() if x.__class__ is wanted]

    def _class_of(self, kind: Kind) -> type:
        return class_of(self.type_named(kind) if isinstance(kind, str) else kind)

    # Identity

    @abstractmethod
    def element(self, identity: str) -> DynamicNode | None:
        """The element with that id, or None."""

    @abstractmethod
    def id_of(self, element: Node) -> str:
        """The id of an element, which `element` takes; the same for the same content of the file."""

    @abstractmethod
    def owns(self, element: Item) -> bool:
        """Whether the element is in this model."""

    # Change

    def create(self, kind: Kind, /, **features: FeatureValue) -> DynamicNode:
        """A new element of this model.

        Args:
            kind: a type, or its name.
            features: their first values.

        Raises:
            ReadOnlyError: the model cannot be changed.
            UnknownTypeError: there is no such type.
            ModelError: the type has no instances of its own, or no such feature.
        """
        self._refuse("create an element")

    def delete(self, element: Node) -> None:
        """Remove an element with all its contents from this model, and from references to it if the technology supports that.

        Raises:
            ReadOnlyError: the model cannot be changed.
            ModelError: the element is not in this model.
        """
        self._refuse("delete an element")

    def save(self, path: str | Path | None = None) -> None:
        """Write the model, whole or not at all.

        Args:
            path: the file; the one it was read from if None.

        Raises:
            ReadOnlyError: the technology cannot be written.
            ModelError: there is no path.
            SourceError: the file cannot be written.
        """
        self._refuse("save")

    def _refuse(self, what: str) -> NoReturn:
        raise read_only(what, self.name)

    def _target(self, path: str | Path | None) -> Path:
        if path is None and self.path is None:
            raise ModelError(f"the model {self.name} has no file", fix="give a path to save it to")
        return Path(path) if path is not None else self.path  # type: ignore[return-value]

    def _check_owned(self, element: Node) -> None:
        if not self.owns(element):
            raise ModelError(f"{element!r} is not in the model {self.name}", fix="delete it in the model that holds it")

    # Types as attributes: m.Book.all, m.Book(name="x")

    def __getitem__(self, name: str) -> TypeHandle:
        """A type to query: `m["library::Book"].all`; `m.Book` is short for `m["Book"]`.

        Raises:
            UnknownTypeError: there is none.
        """
        return TypeHandle(self, self.type_named(name))

    def __getattr__(self, name: str) -> TypeHandle:
        if name[:1] == "_":
            raise AttributeError(name)
        return self[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self.type_names() if name.isidentifier())]

    def _collected(self, items: Sequence[Node]) -> Any:
        """How a type handle returns several elements; layers above return collections of their own."""
        return items

    def __repr__(self) -> str:
        place = f" of {self.path.name}" if self.path is not None else ""
        return f"<{type(self).__name__} {self.name}{place}>"

    def _repr_html_(self) -> str:
        from robosmi.model.elements.html_table import html_table, tree_html  # for notebooks only
        from robosmi.quoting import html_attribute

        counted = Counter(name_of(type_of(element)) for element in self.all_contents())
        tops = [element for element in self.all_contents() if element.eContainer() is None]
        table = html_table(("type", "elements"), counted.most_common())
        return f"<p>{html_attribute(repr(self))}</p>{table}{tree_html(tops, label, contents_of)}"


class TypeHandle:
    """A type of one model: `m.Book.all`, `m.Book.all_of_type`, `m.Book.has(x)`, `m.Book(name="x")`, `m.Genre.fiction`.

    It is taken wherever a type is: `isinstance(x, m.Book)`, `q.of_kind(m.Book)`.

    Args:
        model: the model.
        kind: the type.
    """

    __slots__ = ("kind", "model")

    def __init__(self, model: Model, kind: Type) -> None:
        self.model = model
        self.kind = kind

    @property
    def name(self) -> str:
        """The simple name of the type."""
        return name_of(self.kind)

    @property
    def all(self) -> Any:
        """The elements of this type and its subtypes (EOL `T.all`)."""
        return self.model._collected(self.model.all_of_kind(self.kind))

    all_of_kind = all
    all_instances = all

    @property
    def all_of_type(self) -> Any:
        """The elements of exactly this type (EOL `T.allOfType`)."""
        return self.model._collected(self.model.all_of_type(self.kind))

    def has(self, value: Item) -> bool:
        """Whether the value is an element of this model and of this type or a subtype."""
        return isinstance(value, class_of(self.kind)) and bool(self.model.owns(value))

    def __call__(self, /, *values: FeatureValue, **features: FeatureValue) -> DynamicNode:
        """A new element of this type in the model; see `Model.create`. Values need the names of their features."""
        if values or isinstance(self.kind, EEnum):
            raise not_named(self.kind, values)
        return self.model.create(self.kind, **features)

    def __instancecheck__(self, value: Item) -> bool:
        return isinstance(value, class_of(self.kind))

    def __getattr__(self, name: str) -> EEnumLiteral:
        if name[:1] == "_":
            raise AttributeError(name)
        if not hasattr(self.kind, "eLiterals"):
            known = ("all", "all_of_type", "has", "name")
            meant = f" (did you mean '{_OF_EOL[name]}'?)" if name in _OF_EOL else did_you_mean(name, known)
            raise UnknownTypeError(f"the type {self.name} has no '{name}'{meant}", fix=f"use one of: {', '.join(known)}")
        return self.model.literal(f"{self.name}#{name}")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TypeHandle) and other.kind is self.kind and other.model is self.model

    def __hash__(self) -> int:
        return hash((id(self.model), id(self.kind)))

    def __repr__(self) -> str:
        return f"<type {self.name} of {self.model.name}>"


_OF_EOL = {"allInstances": "all", "all_instances": "all", "allOfKind": "all", "all_of_kind": "all", "allOfType": "all_of_type"}
"""EOL's names for what a type handle has."""


def read_only(what: str, name: str) -> ReadOnlyError:
    """The error for a change of a model that cannot be changed."""
    return ReadOnlyError(f"cannot {what}: the model {name} is read-only", fix="change a copy in a technology that can, as XMI")


def refuse_unknown_attribute(model: Model, name: str) -> None:
    """Refuse to set what a model does not have, which would be an attribute of the Python object and never be saved.

    Classes of others that inherit from ours have attributes of their own.

    Raises:
        ModelError: it has no such attribute.
    """
    if type(model).__module__ in _GUARDED and name[:1] != "_" and name not in _SET_BY_MODELS and not hasattr(type(model), name):
        raise ModelError(
            f"the model {model.name} has no '{name}' that can be set",
            fix="set features of elements; make elements with M.Type(...), add roots with add(ELEMENT)",
        )


_GUARDED = ("robosmi.model.emf", "robosmi.model.lazy_model", "robosmi.model.plain_xml", "robosmi.query.models")
_SET_BY_MODELS = ("name", "path", "findings", "metamodel", "model", "read_only")


def is_element(value: Any) -> TypeGuard[DynamicNode]:
    """Whether the value is an element of a model; enumeration literals are not."""
    return isinstance(value, ModelElement) or (isinstance(value, EObject) and not isinstance(value, EEnumLiteral))


def type_of(element: Node) -> Type:
    """The exact type of an element: its EClass, or its Python class."""
    return element.__class__ if isinstance(element, ModelElement) else element.eClass


def class_of(kind: Kind) -> type:
    """The Python class of a type.

    Raises:
        TypeError: it is none.
    """
    if isinstance(kind, TypeHandle):
        kind = kind.kind
    if isinstance(kind, type):
        return kind
    if isinstance(kind, EClass):
        return kind.python_class
    raise TypeError(f"{kind!r} is no type")


def name_of(kind: Type) -> str:
    """The simple name of a type."""
    return str(kind.__name__ if isinstance(kind, type) else kind.name)


def features_of(element: Node) -> list[str]:
    """The names of an element's features, in order."""
    return element._features() if isinstance(element, ModelElement) else structure.feature_names(element.eClass)


def contents_of(element: Node) -> Sequence[DynamicNode]:
    """What an element contains directly."""
    return element._contents() if isinstance(element, ModelElement) else structure.contents(element)


def walk(root: Node) -> Iterator[DynamicNode]:
    """An element of any technology and everything it contains, a container before its contents; nothing recurses."""
    return _walk(root) if isinstance(root, ModelElement) else structure.walk(root)


def _walk(root: ModelElement) -> Iterator[ModelElement]:
    stack: list[ModelElement] = [root]
    while stack:
        element = stack.pop()
        yield element
        stack.extend(reversed(element._contents()))


def label(element: Node) -> str:
    """A short description of an element: its type and its name."""
    kind = name_of(type_of(element))
    known = set(features_of(element))
    for feature in LABELS:
        if feature in known and isinstance(value := getattr(element, feature), (str, int)) and value != "":
            return f"{kind} {value}"
    return kind
