"""What generated packages are made of, beside `strict.Element`: typed names for pyecore's parts, and what runs at import.

To type checkers pyecore is untyped, so generated code takes everything from here and passes `mypy --strict` by itself. At run
time this adds what pyecore lacks: names that are no Python names, literals with texts, data types for Java classes, and links
between packages that refer to each other in a circle. No model and no metamodel is known here.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, MutableSequence
from datetime import datetime
from decimal import Decimal
from importlib.util import resolve_name
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from pyecore import ecore

from robosmi.model.elements.compact_slots import computed
from robosmi.model.elements.construct import initialise
from robosmi.model.elements.datatypes import XML_NAMESPACE_URI, XML_TYPE_URI
from robosmi.model.elements.ecore_bootstrap import add_literal, promote, quick_constructor
from robosmi.model.elements.feature_values import FeatureCollection
from robosmi.model.elements.pyecore_internals import key_of, set_key
from robosmi.model.elements.python_names import MEMBER
from robosmi.model.elements.strict import Element

_Type = TypeVar("_Type", bound=type)
_Value = TypeVar("_Value")


if TYPE_CHECKING:
    from robosmi.model.elements.ecore import EDataType, EPackage
    from robosmi.model.elements.strict import EnumLiteral

    Classifier: TypeAlias = type[Element] | type[EnumLiteral] | EDataType
    """What a generated module has for a classifier: a class, or the object for a data type."""

    GeneratedModule: TypeAlias = ModuleType
    """The module of a package, as those of other packages know it."""

    class MetaEClass(type):
        """The metaclass of generated classes."""

    def EAttribute(
        *,
        name: str = "",
        eType: EDataType | type[EnumLiteral] | None = None,
        default_value: _Value | None = None,
        defaultValueLiteral: str | None = None,
        lower: int = 0,
        upper: int = 1,
        ordered: bool = True,
        unique: bool = True,
        changeable: bool = True,
        derived: bool = False,
        transient: bool = False,
        volatile: bool = False,
        unsettable: bool = False,
        iD: bool = False,
    ) -> _Value:
        """An attribute of a generated class; an element has the attribute's value in its place."""

    def EReference(
        *,
        name: str = "",
        eType: type[_Value] | None = None,
        lower: int = 0,
        upper: int = 1,
        ordered: bool = True,
        unique: bool = True,
        changeable: bool = True,
        derived: bool = False,
        transient: bool = False,
        volatile: bool = False,
        unsettable: bool = False,
        containment: bool = False,
    ) -> _Value:
        """A reference of a generated class; an element has the one that it refers to, or a list of them, in its place."""

    def __getattr__(name: str) -> EDataType:
        """Ecore's data types by name."""

    class AnnotatedBase(Element):
        """What a class inherits from that inherits from Ecore's EModelElement."""

        eAnnotations: MutableSequence[Any]

    class NamedBase(AnnotatedBase):
        """What a class inherits from that inherits from Ecore's ENamedElement."""

        name: str | None

    class EStringToStringMapEntry(Element):
        """Ecore's own class of pairs of texts, which pyecore has as a dict."""

        key: str | None
        value: str | None

        def __init__(self, *, key: str | None = None, value: str | None = None) -> None: ...

else:
    EAttribute, EReference = (quick_constructor(each) for each in (ecore.EAttribute, ecore.EReference))
    _INIT = Element.__init__

    class MetaEClass(ecore.MetaEClass):
        """pyecore's metaclass, with features whose name in Python is not their name in the metamodel.

        Such a feature has both names: the Python one for people, its own for pyecore, which asks for it by that name. A
        name that something else has (`delete`, `__init__`, the Python name of another feature) is not set over it. Whether
        a class is abstract is asked until it has an element.
        """

        _concrete = False

        def __call__(cls, /, *given: Any, **features: Any) -> Any:
            """A new element."""
            if "_concrete" in cls.__dict__:
                if cls.__init__ is _INIT and cls.__new__ is Element.__new__ and not given:
                    made = object.__new__(cls)
                    initialise(made, features)
                    return made
                return type.__call__(cls, *given, **features)
            made = super().__call__(*given, **features)
            cls._concrete = True
            return made

        def __init__(cls, name: str, bases: tuple[type, ...], namespace: dict[str, Any]) -> None:
            type.__init__(cls, name, bases, namespace)
            promote(cls, Element)
            for key, feature in namespace.items():
                if not isinstance(feature, ecore.EStructuralFeature):
                    continue
                if feature.derived_class is ecore.ECollection:
                    feature.derived_class = FeatureCollection
                computed(feature)
                if key_of(feature) == key:
                    continue
                other = getattr(cls, feature.name, None)
                hidden = other is not None and getattr(other, "name", None) != feature.name
                if feature.name in MEMBER or feature.name.startswith("__") or hidden:
                    set_key(feature, key)
                    cls._renamed = {**cls._renamed, feature.name: key}
                else:
                    setattr(cls, feature.name, feature)
            for mixin in bases:
                if not issubclass(mixin, ecore.EObject):
                    for key in {*namespace} & {*vars(mixin)}:
                        if isinstance(namespace[key], ecore.EStructuralFeature):
                            setattr(cls, key, _OwnCode(vars(mixin)[key], namespace[key]))

    class MetaEcoreSubclass(MetaEClass, type(ecore.EPackage), type(ecore.EModelElement)):
        """The metaclass of generated classes that inherit from one of Ecore's own."""

        __instancecheck__ = type.__instancecheck__  # for pyecore's, a module that is a package would be an element

    def _with(base: type) -> Any:
        """A strict class that stands for one of Ecore's, and has no EClass of its own."""
        return type.__new__(MetaEcoreSubclass, base.__name__, (Element, base), {"__doc__": base.__doc__, "eClass": base.eClass})

    AnnotatedBase, NamedBase = _with(ecore.EModelElement), _with(ecore.ENamedElement)

    class _OwnCode:
        """The user's property that computes a derived feature; all else that is asked of it is the feature's (`eType`)."""

        def __init__(self, code: property, feature: ecore.EStructuralFeature) -> None:
            vars(self).update(code=code, feature=feature)

        def __get__(self, element: Any, owner: type | None = None) -> Any:
            return self if element is None else self.code.__get__(element, owner)

        def __set__(self, element: Any, value: object) -> None:
            self.code.__set__(element, value)

        def __getattr__(self, name: str) -> Any:
            return getattr(self.feature, name)

        def __setattr__(self, name: str, value: object) -> None:
            setattr(self.feature, name, value)

    def __getattr__(name: str) -> Any:
        """pyecore's data types and classes by name."""
        if name.startswith("E") and hasattr(ecore, name):
            return getattr(ecore, name)
        raise AttributeError(name)

    EStringToStringMapEntry = ecore.EObject.__class__("EStringToStringMapEntry", (Element,), {})
    EStringToStringMapEntry.eClass = ecore.EClass("EStringToStringMapEntry", metainstance=EStringToStringMapEntry)
    for _name in ("key", "value"):
        setattr(EStringToStringMapEntry, _name, EAttribute(name=_name, eType=ecore.EString))
        EStringToStringMapEntry.eClass.eStructuralFeatures.append(getattr(EStringToStringMapEntry, _name))


def find_classifier(classifiers: dict[str, Classifier]) -> Callable[[str], Classifier | None]:
    """The function of a generated module that finds a classifier by its name in the metamodel."""
    return classifiers.get


def package(name: str, uri: str, prefix: str) -> EPackage:
    """The EPackage of a generated module."""
    made: EPackage = ecore.EPackage(name=name, nsURI=uri, nsPrefix=prefix)
    return made


def abstract(cls: _Type) -> _Type:
    """Class decorator: an abstract EClass."""
    cls.eClass.abstract = True  # type: ignore[attr-defined]
    return cls


def interface(cls: _Type) -> _Type:
    """Class decorator: an EClass that is an interface, and abstract."""
    cls.eClass.interface = True  # type: ignore[attr-defined]
    return abstract(cls)


def named(name: str) -> Callable[[_Type], _Type]:
    """Class decorator: the EClass's name, if it is not a valid Python name."""

    def rename(cls: _Type) -> _Type:
        classifiers = sys.modules[cls.__module__].eClassifiers
        classifiers[name] = classifiers.pop(cls.__name__)
        cls.eClass.name = name  # type: ignore[attr-defined]
        return cls

    return rename


def supertypes(*bases: Any) -> Callable[[_Type], _Type]:
    """Class decorator: the supertypes in the metamodel's order, where Python needs another."""

    def reorder(cls: _Type) -> _Type:
        _inherit(cls, bases)
        return cls

    return reorder


def _inherit(cls: Any, bases: tuple[Any, ...]) -> None:
    cls.eClass.eSuperTypes.clear()
    cls.eClass.eSuperTypes.extend(base.eClass for base in bases)


def enumeration(
    name: str, literals: dict[str, int], texts: dict[str, str] | None = None, names: dict[str, str] | None = None
) -> Any:
    """An Ecore enumeration.

    Args:
        name: its name in the metamodel.
        literals: name -> value, in order.
        texts: name -> text in model files, where that is not the name.
        names: name -> Python attribute, where the name is none.
    """
    result = ecore.EEnum(name)
    by_text = {}
    for literal, value in literals.items():
        made = add_literal(result, literal, value)
        text = (texts or {}).get(literal, literal)
        if text != literal:
            made.literal = text
        by_text[text] = made
        result.__dict__[(names or {}).get(literal, literal)] = made
    result.from_string = lambda text: by_text.get(text) or result.getEEnumLiteral(name=text)
    return result


def _truth(text: str) -> bool:
    return text == "true"


_JAVA: dict[str, tuple[type, Any, Callable[[str], Any] | None]] = {
    **dict.fromkeys(("int", "short", "long", "byte"), (int, 0, int)),
    **dict.fromkeys(("java.lang.Integer", "java.lang.Short", "java.lang.Long", "java.lang.Byte"), (int, None, int)),
    **dict.fromkeys(("float", "double"), (float, 0.0, float)),
    **dict.fromkeys(("java.lang.Float", "java.lang.Double"), (float, None, float)),
    **dict.fromkeys(("java.lang.String", "java.lang.Character", "char", "java.lang.CharSequence"), (str, None, None)),
    "java.math.BigInteger": (int, None, int),
    "boolean": (bool, False, _truth),
    "java.lang.Boolean": (bool, None, _truth),
    "java.math.BigDecimal": (Decimal, None, Decimal),
    "java.util.Date": (datetime, None, ecore.EDate.from_string),
}
"""Java class -> Python type, default value, conversion from text. Values of any other class are whatever they are."""


def python_type(java: str) -> type | None:
    """The Python type for a Java class, or None where any value does."""
    return _JAVA[java][0] if java in _JAVA else None


def datatype(name: str, java: str = "") -> EDataType:
    """An Ecore data type that stands for a Java class; a value of an unknown class is any value, in model files its text."""
    kind, default, convert = _JAVA.get(java, (object, None, None))
    made = ecore.EDataType(name, eType=kind, default_value=default, from_string=convert)
    made.instanceClassName_ = java or None
    if kind is bool:
        made.to_string = lambda value: "true" if value else "false"
    result: EDataType = made
    return result


_XML = {
    "boolean": "Boolean",
    "java.lang.Boolean": "BooleanObject",
    "double": "Double",
    "java.lang.Double": "DoubleObject",
    "float": "Float",
    "java.lang.Float": "FloatObject",
    "int": "Int UnsignedShort",
    "java.lang.Integer": "IntObject UnsignedShortObject",
    "long": "Long UnsignedInt",
    "java.lang.Long": "LongObject UnsignedIntObject",
    "short": "Short UnsignedByte",
    "java.lang.Short": "ShortObject UnsignedByteObject",
    "byte": "Byte",
    "java.lang.Byte": "ByteObject",
    "java.math.BigInteger": "Integer NegativeInteger NonNegativeInteger NonPositiveInteger PositiveInteger UnsignedLong",
    "java.math.BigDecimal": "Decimal",
    "java.lang.Object": "AnySimpleType",
}
XML_JAVA = {name: java for java, names in _XML.items() for name in names.split()}
"""Data type of XML Schema -> Java class; all others are texts (XMLType.ecore of EMF)."""
_XML_TYPES: dict[str, EDataType] = {}
_XML_PACKAGE = package("type", XML_TYPE_URI, "type")
_XML_NAMESPACE = package("namespace", XML_NAMESPACE_URI, "xml")
_OF_XML_NAMESPACE = ("LangType", "LangTypeNull", "SpaceType", "SpaceTypeObject")


def xml_type(name: str) -> EDataType:
    """A data type of XML Schema, or of the attributes `xml:lang` and `xml:space`, the same object for the same name."""
    if name not in _XML_TYPES:
        made = _XML_TYPES[name] = datatype(name, XML_JAVA.get(name, "java.lang.String"))
        owner = _XML_NAMESPACE if name in _OF_XML_NAMESPACE else _XML_PACKAGE
        owner.eClassifiers.append(made)  # so that a metamodel that is written can name it
    return _XML_TYPES[name]


def classifier(module: str, made: Any) -> None:
    """Put an enumeration or a data type into its package."""
    owner = sys.modules[module]
    owner.eClassifiers[made.name] = made
    owner.eClass.eClassifiers.append(made)


def operations(cls: Any, *made: Any) -> None:
    """The EOperations of a class, in place of those that pyecore guesses from its methods."""
    cls.eClass.eOperations.clear()
    cls.eClass.eOperations.extend(made)


class Later:
    """Placeholder for a base class in a package that is not defined yet, because the two inherit from each other."""

    def __mro_entries__(self, bases: tuple[Any, ...]) -> tuple[type, ...]:
        real = any(not isinstance(base, Later) for base in bases)
        return () if real or bases[0] is not self else (Element,)


def inherit(cls: Any, *bases: Any) -> None:
    """Set the base classes of a class, now that they are defined."""
    cls.__bases__ = bases
    _inherit(cls, bases)


def _is_defined(module: str) -> bool:
    """Whether the classes of a module are defined, even if it is still being imported."""
    return getattr(sys.modules.get(module), "_defined", False) is True


_WAITING: list[tuple[ModuleType, list[str], Callable[[], None]]] = []


def linked(module: str, *needs: str) -> Callable[[Callable[[], None]], Callable[[], None]]:
    """Function decorator: run it as soon as the classes of this module and of those that it needs are defined.

    Packages that refer to each other cannot all be complete when the first of them links its references; whichever is
    imported first, the last one to be defined runs what waits.
    """

    def register(function: Callable[[], None]) -> Callable[[], None]:
        own = sys.modules[module]
        own._defined = True  # type: ignore[attr-defined]
        names = [resolve_name(name, module) for name in needs]
        _WAITING[:] = [entry for entry in _WAITING if sys.modules.get(entry[0].__name__) is entry[0]]  # failed imports left some
        _WAITING.append((own, names, function))
        if all(name not in sys.modules or _is_defined(name) for name in names):  # else one of them goes on after this import
            for name in names:
                importlib.import_module(name)
        ready = [entry for entry in _WAITING if all(_is_defined(name) for name in entry[1])]
        for entry in ready:
            if entry in _WAITING:  # linking may import, and importing may link
                _WAITING.remove(entry)
                entry[2]()
        return function

    return register


def subpackages(module: str, *inner: ModuleType) -> None:
    """Put sub-packages into their package."""
    owner: Any = sys.modules[module]
    owner.eSubpackages.extend(inner)
    for package_module in inner:
        package_module.eSuperPackage = owner  # type: ignore[attr-defined]
        owner.eClass.eSubpackages.append(package_module.eClass)
