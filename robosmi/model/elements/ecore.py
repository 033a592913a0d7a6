"""Types for pyecore's classes: declares once what this package uses of them.

pyecore has no annotations, so a type checker treats each of its classes as `Any`. Here they are declared for type checkers with
the features and methods that RoboSMi uses; at run time they are pyecore's own classes under the same names. Private names of
pyecore are in `pyecore_internals`, the base class of generated elements is in `strict`.
"""
# ruff: noqa: D102  the methods are Ecore's, and only declared here

from __future__ import annotations

from collections.abc import Callable, Iterable, MutableSequence, Sequence
from datetime import datetime
from decimal import Decimal
from types import ModuleType
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Protocol, TypeAlias, TypeVar


class Listener(Protocol):
    """An observer that is notified of changes of an element or a resource."""

    def notifyChanged(self, notification: Notification, /) -> None:
        """Called after each change."""


class Notification:
    """One change, as pyecore reports it."""

    feature: EStructuralFeature | None
    notifier: EObject
    new: Value
    old: Value


class Decoder(Protocol):
    """Finds elements of other resources by their URI."""

    def can_resolve(self, path: str, from_resource: Resource, /) -> bool:
        """Whether it knows URIs of that form."""


class Resource(Protocol):
    """Where root elements are kept."""

    listeners: list[Listener]

    @property
    def contents(self) -> Iterable[EObject]:
        """The root elements."""

    def remove(self, root: EObject, /) -> None:
        """Take a root out."""


class ReadResource(Resource, Protocol):
    """A resource of pyecore's that was read from a file."""

    decoders: Sequence[Decoder]


if TYPE_CHECKING:
    T = TypeVar("T")

    class Slots(dict[str, Any]):
        """The fields of an element by key; what lies in the slot of a feature, only that feature says."""

        def get(self, key: str, default: Any = None, /) -> Any: ...

    class EObject:
        """A model element of any class."""

        __dict__: Slots
        eClass: ClassVar[EClass]
        listeners: list[Listener]
        dyn_inst: EObject

        def __init__(self, /, **features: Argument) -> None: ...
        @property
        def eResource(self) -> Resource | None: ...
        @property
        def eContents(self) -> Sequence[EObject]: ...
        def eContainer(self) -> EObject | None: ...
        def eContainmentFeature(self) -> EReference | None: ...
        def eAllContents(self) -> Iterable[EObject]: ...
        def eIsSet(self, feature: str | EStructuralFeature) -> bool: ...
        def eGet(self, feature: str | EStructuralFeature) -> Any: ...
        def eSet(self, feature: str | EStructuralFeature, value: Value) -> None: ...
        def delete(self, recursive: bool = True) -> None: ...

    class DynamicEObject(EObject):
        """An element of a class that only its metamodel knows: what type a feature has is not known to a type checker."""

        @property
        def eContents(self) -> list[Any]: ...
        def eContainer(self) -> Any: ...
        def eAllContents(self) -> Iterable[Any]: ...
        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

    class PyEcoreValue:
        """What lies in the slot of a feature."""

        owner: EObject
        feature: EStructuralFeature
        is_ref: bool
        is_cont: bool
        generic_type: EClassifier | None

    class EValue(PyEcoreValue):
        """The holder of one value."""

        def __init__(self, owner: EObject, feature: EStructuralFeature) -> None: ...

    class ECollection(PyEcoreValue, MutableSequence[T], Generic[T]):
        """The values of a feature of many."""

        @staticmethod
        def create(owner: EObject, feature: EStructuralFeature) -> ECollection[Any]: ...

    class EList(ECollection[T]):
        """Values in order."""

    class EBag(EList[T]):
        """Values in no order."""

    class EAbstractSet(ECollection[T]):
        """Values of which each occurs once."""

        items: list[T]
        map: dict[T, int]

    class EOrderedSet(EAbstractSet[T]):
        """Values of which each occurs once, in order."""

    class ESet(EOrderedSet[T]):
        """Values of which each occurs once, in no order."""

    class EModelElement(EObject):
        """What a metamodel consists of."""

        eAnnotations: ECollection[EAnnotation]

        def getEAnnotation(self, source: str) -> EAnnotation | None: ...

    class EAnnotation(EModelElement):
        """A note on a part of a metamodel."""

        source: str | None
        details: dict[str, str | None]
        contents: ECollection[EObject]
        references: ECollection[EObject]

        def __init__(self, source: str | None = None, **features: Argument) -> None: ...

    class ENamedElement(EModelElement):
        """A part of a metamodel that has a name."""

        name: str

        def __init__(self, name: str | None = None, **features: Argument) -> None: ...

    class EPackage(ENamedElement):
        """Classifiers under one namespace."""

        nsURI: str | None
        nsPrefix: str | None
        eClassifiers: ECollection[EClassifier]
        eSubpackages: ECollection[EPackage]
        eSuperPackage: EPackage | None

        def __init__(
            self, name: str | None = None, nsURI: str | None = None, nsPrefix: str | None = None, **features: Argument
        ) -> None: ...
        def getEClassifier(self, name: str) -> EClassifier | None: ...

    class ETypedElement(ENamedElement):
        """A part of a metamodel that has a type and a multiplicity."""

        eType: EClassifier
        eGenericType: EGenericType | None
        lowerBound: int
        upperBound: int
        ordered: bool
        unique: bool
        required: bool

        def __init__(self, name: str | None = None, eType: EClassifier | None = None, **features: Argument) -> None: ...
        @property
        def many(self) -> bool: ...

    class EOperation(ETypedElement):
        """An operation of a class."""

        eParameters: ECollection[EParameter]
        eExceptions: ECollection[EClassifier]
        eGenericExceptions: ECollection[EGenericType]
        eTypeParameters: ECollection[ETypeParameter]
        eContainingClass: EClass

        def __init__(
            self,
            name: str | None = None,
            eType: EClassifier | None = None,
            params: Iterable[EParameter] | None = None,
            **features: Argument,
        ) -> None: ...

    class EParameter(ETypedElement):
        """A parameter of an operation."""

    class ETypeParameter(ENamedElement):
        """A type that is open in a class or operation."""

        eBounds: ECollection[EGenericType]

    class EGenericType(EObject):
        """A type with arguments, or a type parameter."""

        eClassifier: EClassifier | None
        eTypeParameter: ETypeParameter | None
        eTypeArguments: ECollection[EGenericType]
        eUpperBound: EGenericType | None
        eLowerBound: EGenericType | None

    class EClassifier(ENamedElement):
        """A class, a data type or an enumeration."""

        ePackage: EPackage
        instanceClassName: str | None
        instanceTypeName: str | None
        eTypeParameters: ECollection[ETypeParameter]

    class EDataType(EClassifier):
        """A type of plain values."""

        eType: type | None
        default_value: Value
        serializable: bool
        type_as_factory: bool
        instanceClassName_: str | None
        from_string: Callable[[str], Scalar]
        to_string: Callable[[Any], str]

    class EEnum(EDataType):
        """An enumeration."""

        eLiterals: ECollection[EEnumLiteral]

        def getEEnumLiteral(self, name: str | None = None, value: int = 0) -> EEnumLiteral | None: ...

    class EEnumLiteral(ENamedElement):
        """A literal of an enumeration."""

        value: int
        literal: str | None
        eEnum: EEnum

        def __init__(self, name: str | None = None, value: int = 0, **features: Argument) -> None: ...

    class EStructuralFeature(ETypedElement):
        """An attribute or a reference; what only one of them has is asked after `is_reference` or `is_attribute`."""

        containment: bool
        eOpposite: EReference | None
        iD: bool

        changeable: bool
        derived: bool
        transient: bool
        unsettable: bool
        volatile: bool
        eContainingClass: EClass
        is_reference: bool
        is_attribute: bool
        derived_class: type
        defaultValueLiteral: str | None
        default_value: Value
        get_default_value: Callable[[], Value]

    class EAttribute(EStructuralFeature):
        """A feature whose values are plain."""

        def __get__(self, instance: EObject | None, owner: type | None = None) -> Any: ...
        def __set__(self, instance: EObject, value: Any) -> None: ...

    class EReference(EStructuralFeature):
        """A feature whose values are elements."""

        eKeys: Sequence[EAttribute]
        resolveProxies: bool

    class EClass(EClassifier):
        """A class of model elements."""

        abstract: bool
        interface: bool
        python_class: type[DynamicEObject]
        eStructuralFeatures: ECollection[EStructuralFeature]
        eOperations: ECollection[EOperation]
        eSuperTypes: ECollection[EClass]
        eGenericSuperTypes: ECollection[EGenericType]
        eAttributes: list[EAttribute]
        eReferences: list[EReference]

        def __new__(
            cls,
            name: str | None = None,
            superclass: EClass | tuple[EClass, ...] | None = None,
            metainstance: type | None = None,
            **features: Argument,
        ) -> EClass: ...
        def __call__(self, /, **features: Argument) -> DynamicEObject: ...
        def findEStructuralFeature(self, name: str) -> Any: ...
        def eAllStructuralFeatures(self) -> Iterable[EStructuralFeature]: ...
        def eAllReferences(self) -> set[EReference]: ...
        def eAllAttributes(self) -> set[EAttribute]: ...
        def eAllSuperTypes(self) -> Iterable[EClass]: ...
        def eAllOperations(self) -> Iterable[EOperation]: ...

    class EProxy(EObject):
        """A placeholder for an element of a resource that has not been loaded yet."""

        resolved: bool

        def force_resolve(self) -> EObject: ...

    nsURI: str
    eClass: EPackage
    EBoolean: EDataType
    EDate: EDataType
    EDouble: EDataType
    EInt: EDataType
    EJavaObject: EDataType
    ELong: EDataType
    EString: EDataType
    EStringToStringMapEntry: EClass
else:
    from pyecore.ecore import (  # noqa: F401  offered under these names
        EAnnotation,
        EAttribute,
        EBoolean,
        EClass,
        EClassifier,
        EDataType,
        EDate,
        EDouble,
        EEnum,
        EEnumLiteral,
        EGenericType,
        EInt,
        EJavaObject,
        ELong,
        EModelElement,
        ENamedElement,
        EObject,
        EOperation,
        EPackage,
        EParameter,
        EProxy,
        EReference,
        EString,
        EStringToStringMapEntry,
        EStructuralFeature,
        ETypedElement,
        ETypeParameter,
        eClass,
        nsURI,
    )
    from pyecore.valuecontainer import EAbstractSet, EBag, ECollection, EList, EOrderedSet, ESet, EValue  # noqa: F401

    DynamicEObject = EObject

Scalar: TypeAlias = "bool | int | float | str | bytes | Decimal | datetime | EObject | None"
"""What a feature of one value holds."""
Value: TypeAlias = "Scalar | ECollection[Scalar]"
"""What a feature holds; for one of many a collection."""
Package: TypeAlias = "EPackage | ModuleType"
"""A package, or the Python package that was generated for one."""
Argument: TypeAlias = "Value | type | Callable[[str], Scalar] | Iterable[Scalar]"
"""What the constructor of one of Ecore's classes takes for a feature."""
