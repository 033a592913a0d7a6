"""What an Ecore metamodel says, as plain values: packages, classifiers, features, operations, with their places.

pyecore's dynamic classes cannot hold every metamodel (names that hide its own, orders of supertypes that Python refuses),
so the generator works on these. They are made by `ecore_loader`; Ecore's own types are here too, as `ECORE` and `XML_TYPES`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.model.elements.datatypes import ECORE_URI, XML_NAMESPACE_URI, XML_TYPE_URI
from robosmi.model.elements.ordering import post_order

if TYPE_CHECKING:
    from robosmi.model.ecore.ecore_xml import EcoreNode


class _Described(Struct, eq=False, kw_only=True):
    """The constructor arguments common to all descriptions, which are passed by name.

    Attributes:
        node: the XML node in the file; None for Ecore's own elements.
    """

    node: EcoreNode | None = None


class DescribedElement(_Described):
    """Anything with a name and a place."""

    name: str
    location: Location
    documentation: str = ""

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}>"


def _nothing(node: EcoreNode, feature: str) -> list[DescribedElement]:
    """The default of `Package.find`: no node refers to anything."""
    return []


class Package(DescribedElement):
    """An EPackage.

    Attributes:
        source: the .ecore file.
        parent: the package it lies in.
        find: what a node of the file refers to by a feature of Ecore, as far as it is known.
        missing: whether its file is not there; its elements stand for what others refer to, under names that are URIs.
    """

    uri: str = ""
    prefix: str = ""
    source: Path = Path()
    parent: Package | None = None
    find: Callable[[EcoreNode, str], list[DescribedElement]] = _nothing
    classifiers: list[Classifier] = []
    subpackages: list[Package] = []
    missing: bool = False

    @property
    def root(self) -> Package:
        """The outermost package."""
        package = self
        while package.parent is not None:
            package = package.parent
        return package

    @property
    def path(self) -> str:
        """Names from the outermost package on, with dots."""
        names, package = [self.name], self.parent
        while package is not None:
            names.append(package.name)
            package = package.parent
        return ".".join(reversed(names))

    def walk(self) -> Iterator[Package]:
        """The package and all packages in it."""
        stack = [self]
        while stack:
            package = stack.pop()
            yield package
            stack.extend(reversed(package.subpackages))


class Classifier(DescribedElement):
    """An EClassifier."""

    package: Package = None  # type: ignore[assignment]
    type_parameters: list[TypeParameter] = []

    @property
    def path(self) -> str:
        """Its name with those of its packages."""
        return f"{self.package.path}.{self.name}"


class DataType(Classifier):
    """An EDataType; `instance_class` is the Java class it stands for."""

    instance_class: str = ""


class Literal(DescribedElement):
    """An EEnumLiteral; `text` is what model files say."""

    value: int = 0
    text: str = ""


class Enumeration(DataType):
    """An EEnum."""

    literals: list[Literal] = []


class TypeParameter(DescribedElement):
    """An ETypeParameter. Generated code has no type parameters: the first bound stands for it."""

    bounds: list[Classifier | TypeParameter] = []


class Typed(DescribedElement):
    """An ETypedElement. `type` is None for an operation without a result."""

    type: Classifier | TypeParameter | None = None
    lower: int = 0
    upper: int = 1
    ordered: bool = True
    unique: bool = True

    @property
    def many(self) -> bool:
        """Whether it holds several values."""
        return self.upper < 0 or self.upper > 1

    @property
    def classifier(self) -> Classifier | None:
        """The type, once `ecore_loader` has put bounds where type parameters were."""
        assert not isinstance(self.type, TypeParameter)
        return self.type


class Feature(Typed):
    """An EAttribute or EReference."""

    owner: Class = None  # type: ignore[assignment]
    is_reference: bool = False
    containment: bool = False
    opposite: Feature | None = None
    is_id: bool = False
    default: str | None = None
    changeable: bool = True
    volatile: bool = False
    transient: bool = False
    derived: bool = False
    unsettable: bool = False

    @property
    def path(self) -> str:
        """Its name with those of its class and packages."""
        return f"{self.owner.path}.{self.name}"


class Operation(Typed):
    """An EOperation."""

    owner: Class = None  # type: ignore[assignment]
    parameters: list[Typed] = []
    type_parameters: list[TypeParameter] = []


class Class(Classifier):
    """An EClass."""

    abstract: bool = False
    interface: bool = False
    supertypes: list[Class] = []
    features: list[Feature] = []
    operations: list[Operation] = []

    def ancestors(self) -> list[Class]:
        """All supertypes, direct and indirect, each once, farthest first in Ecore's order."""
        return [cls for cls in post_order([self], lambda cls: cls.supertypes) if cls is not self]

    def all_features(self) -> list[Feature]:
        """Features with those of the supertypes first, in Ecore's order."""
        return [feature for cls in (*self.ancestors(), self) for feature in cls.features]


_NOWHERE = Location("Ecore.ecore")
_CLASSES = (
    "EObject EModelElement ENamedElement EAnnotation EPackage EGenericType ETypeParameter ETypedElement EClassifier "
    "EDataType EEnum EEnumLiteral EParameter EOperation EStructuralFeature EAttribute EReference EClass EFactory "
    "EStringToStringMapEntry"
)
_DATA_TYPES = (
    "EBigDecimal EBigInteger EBoolean EBooleanObject EByte EByteArray EByteObject EChar ECharacterObject EDate "
    "EDiagnosticChain EDouble EDoubleObject EEList EEnumerator EFeatureMap EFeatureMapEntry EFloat EFloatObject EInt "
    "EIntegerObject EInvocationTargetException EJavaClass EJavaObject ELong ELongObject EMap EResource EResourceSet "
    "EShort EShortObject EString ETreeIterator"
)
_XML_DATA_TYPES = (
    "AnySimpleType AnyURI Base64Binary Boolean BooleanObject Byte ByteObject Date DateTime Decimal Double DoubleObject "
    "Duration ENTITIES ENTITIESBase ENTITY Float FloatObject GDay GMonth GMonthDay GYear GYearMonth HexBinary ID IDREF "
    "IDREFS IDREFSBase Int Integer IntObject Language Long LongObject NCName NMTOKEN NMTOKENS NMTOKENSBase NOTATION Name "
    "NegativeInteger NonNegativeInteger NonPositiveInteger NormalizedString PositiveInteger QName Short ShortObject "
    "String Time Token UnsignedByte UnsignedByteObject UnsignedInt UnsignedIntObject UnsignedLong UnsignedShort "
    "UnsignedShortObject"
)


def _known(name: str, uri: str, classes: str, datatypes: str) -> Package:
    package = Package(name, _NOWHERE, uri=uri, prefix=name)
    package.classifiers += [Class(c, _NOWHERE, package=package) for c in classes.split()]
    package.classifiers += [DataType(d, _NOWHERE, package=package) for d in datatypes.split()]
    return package


ECORE = _known("ecore", ECORE_URI, _CLASSES, _DATA_TYPES)
"""Ecore itself; only the names of its classifiers."""

XML_TYPES = _known("type", XML_TYPE_URI, "AnyType ProcessingInstruction SimpleAnyType XMLTypeDocumentRoot", _XML_DATA_TYPES)
"""XMLType, EMF's package for the types of XML Schema; only names."""

XML_NAMESPACE = _known(
    "namespace", XML_NAMESPACE_URI, "XMLNamespaceDocumentRoot", "LangType LangTypeNull SpaceType SpaceTypeObject"
)  # fmt: skip
"""XMLNamespace, EMF's package for the attributes `xml:lang`, `xml:space`, `xml:base` and `xml:id`; only names."""

KNOWN = {ECORE_URI: ECORE, XML_TYPE_URI: XML_TYPES, XML_NAMESPACE_URI: XML_NAMESPACE}
"""The packages that every metamodel may refer to, by namespace."""


def is_known(classifier: Classifier) -> bool:
    """Whether it is one of `KNOWN`'s."""
    return KNOWN.get(classifier.package.uri) is classifier.package


def known(package: Package, name: str) -> Classifier | None:
    """The classifier of that name in a package of `KNOWN`."""
    return _INDEX[package.uri].get(name)


_INDEX = {uri: {c.name: c for c in package.classifiers} for uri, package in KNOWN.items()}
EOBJECT = _INDEX[ECORE_URI]["EObject"]
E_JAVA_OBJECT = _INDEX[ECORE_URI]["EJavaObject"]
"""What a type parameter without a bound stands for: any element, any value."""
