"""Dynamic classes from descriptions of metamodels: pyecore packages whose elements are as strict as generated ones.

Each call makes classes of its own. They derive from `strict.Element` and are fixed once made; pyecore's own way of making classes
would take any misspelt name, and changes the method resolution of all classes of the process when supertypes cross. What a
file says is `ecore_loader`'s business, Python source code `codegen`'s.
"""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal
from functools import partial
from typing import Any

from pyecore import ecore as pyecore_ecore

from robosmi.errors import ModelError
from robosmi.model import ecore
from robosmi.model.datatypes import default, literal_text
from robosmi.model.ecore import (
    Argument,
    EClass,
    EClassifier,
    EDataType,
    EEnum,
    EModelElement,
    EObject,
    EPackage,
    EReference,
    EStructuralFeature,
)
from robosmi.model.ecore_description import (
    XML_TYPES,
    Class,
    Classifier,
    DataType,
    DescribedElement,
    Enumeration,
    Feature,
    Package,
)
from robosmi.model.ecore_details import Details
from robosmi.model.feature_values import FeatureCollection
from robosmi.model.lean import computed
from robosmi.model.ordering import post_order
from robosmi.model.pyecore_internals import add_silently, contain, set_key
from robosmi.model.python_names import MEMBER, python_name
from robosmi.model.strict import Element
from robosmi.typed import dynamic_attribute

_PRIMITIVE = {"boolean", "byte", "char", "double", "float", "int", "long", "short"}
_XML_TYPES = {
    "Boolean": "boolean", "BooleanObject": "java.lang.Boolean", "Byte": "byte", "Short": "short", "Int": "int", "Long": "long",
    "IntObject": "java.lang.Integer", "LongObject": "java.lang.Long", "Double": "double", "DoubleObject": "java.lang.Double",
    "Float": "float", "FloatObject": "java.lang.Float", "Decimal": "java.math.BigDecimal", "Integer": "java.math.BigInteger",
}  # fmt: skip
_PYTHON: dict[str, type] = {"java.math.BigInteger": int, "java.math.BigDecimal": Decimal}


def make_packages(packages: list[Package]) -> list[EPackage]:
    """pyecore EPackages for described ones.

    Args:
        packages: the outermost packages, as `load_metamodels` gives them.

    Raises:
        ModelError: a class is its own supertype.
    """
    return PackageMaker().make(packages)


class DynamicClass(type(ecore.EObject)):  # type: ignore[misc]
    """The class of dynamic classes: refuses elements of abstract ones, and orders supertypes that Python's own rule refuses."""

    def __call__(cls, /, *args: Any, **features: Any) -> Any:
        """A new element."""
        if cls.eClass.abstract or cls.eClass.interface:
            raise ModelError(f"{cls.__name__} is abstract: it has no instances of its own", fix="create one of a subclass")
        return super().__call__(*args, **features)

    def mro(cls) -> list[type]:
        """Python's method resolution order if there is one, else any order with each class before its supertypes."""
        try:
            return type.mro(cls)
        except TypeError:
            start: list[type] = [cls]
            return list(post_order(start, lambda one: one.__bases__[::-1]))[::-1]


class PackageMaker:
    """Makes packages one after the other; a description that was given before has the package that was made then."""

    def __init__(self) -> None:
        self.made: dict[Classifier, EClassifier] = {}
        self.packages: dict[Package, EPackage] = {}
        self.features: dict[Feature, EStructuralFeature] = {}
        self.xml_types = ecore.EPackage(XML_TYPES.name, XML_TYPES.uri, XML_TYPES.prefix)

    def make(self, packages: list[Package]) -> list[EPackage]:
        """See `make_packages`."""
        before = dict(self.packages)
        try:
            self._make([package for package in packages if package not in self.packages])
        except ModelError:
            self.packages = before
            raise
        return [self.packages[package] for package in packages]

    def _make(self, packages: list[Package]) -> None:
        classes: list[Class] = []
        outermost = []
        for root in packages:
            epackages: dict[Package, EPackage] = {}
            for package in root.walk():
                epackage = epackages[package] = self.packages[package] = ecore.EPackage(package.name, package.uri, package.prefix)
                if package.parent is not None:
                    epackages[package.parent].eSubpackages.append(epackage)
                for classifier in package.classifiers:
                    if isinstance(classifier, Class):
                        classes.append(classifier)
                    else:
                        self.made[classifier] = _datatype(classifier)
            outermost.append((root, epackages))
        for cls in _supertypes_first(classes):
            self.made[cls] = self._class(cls)
        for _, epackages in outermost:
            for package, epackage in epackages.items():
                epackage.eClassifiers.extend([self.made[c] for c in package.classifiers])
        for cls in classes:
            self._fill(cls)
        for feature, made in self.features.items():
            opposite = self.features[feature.opposite] if feature.opposite is not None else None
            if isinstance(opposite, EReference) and made.eOpposite is None:
                made.eOpposite = opposite
        Details(packages, self._made_for).add()

    def _made_for(self, one: DescribedElement) -> EModelElement | None:
        if isinstance(one, Classifier):
            return self._classifier(one)
        return self.features.get(one) if isinstance(one, Feature) else self.packages[one] if isinstance(one, Package) else None

    def _class(self, cls: Class) -> EClass:
        supertypes = [self._eclass(base) for base in cls.supertypes]
        bases: list[type[EObject]] = [base.python_class for base in supertypes if base.python_class is not ecore.EObject]
        bases = [b for b in bases if not any(b is not other and issubclass(other, b) for other in bases)]
        if not any(issubclass(base, Element) for base in bases):
            bases.insert(0, Element)
        python: Any = DynamicClass(cls.name, tuple(bases), {"__doc__": cls.documentation or None, "__module__": cls.package.path})
        eclass = ecore.EClass(cls.name, abstract=cls.abstract, metainstance=python)
        eclass.interface = cls.interface
        eclass.eSuperTypes.extend(supertypes)
        python.eClass = eclass
        return eclass

    def _eclass(self, cls: Class) -> EClass:
        made = self._classifier(cls)
        assert isinstance(made, EClass)
        return made

    def _kind(self, classifier: Classifier | None) -> EClassifier | None:
        return None if classifier is None else self._classifier(classifier)

    def _classifier(self, classifier: Classifier) -> EClassifier:
        """The object made for a described classifier, or pyecore's own for one of Ecore's."""
        found = self.made.get(classifier)
        if found is None:
            found = self.made[classifier] = _known(classifier)
            if classifier.package is XML_TYPES and found.eContainer() is None:
                self.xml_types.eClassifiers.append(found)  # so that a metamodel that is written can name it
        return found

    def _fill(self, cls: Class) -> None:
        eclass = self._eclass(cls)
        python: Any = eclass.python_class
        for feature in cls.features:
            made = self.features[feature] = self._feature(feature)
            key = python_name(feature.name, MEMBER)
            setattr(python, key, made)
            if feature.name in MEMBER:  # every element needs that name for itself
                set_key(made, key)
                python._renamed = {**python._renamed, feature.name: key}
            else:
                setattr(python, feature.name, made)
            eclass.eStructuralFeatures.append(made)
        for operation in cls.operations:
            parameters = [ecore.EParameter(p.name, self._kind(p.classifier)) for p in operation.parameters]
            kind = self._kind(operation.classifier)
            eclass.eOperations.append(ecore.EOperation(operation.name, kind, parameters, upper=operation.upper))

    def _feature(self, feature: Feature) -> EStructuralFeature:
        common: dict[str, Argument] = {
            "lower": feature.lower, "upper": feature.upper, "ordered": feature.ordered, "unique": feature.unique,
            "changeable": feature.changeable, "volatile": feature.volatile, "transient": feature.transient,
            "derived": feature.derived, "unsettable": feature.unsettable, "derived_class": FeatureCollection,
        }  # fmt: skip
        kind = self._kind(feature.classifier)
        if feature.is_reference:
            if kind is None or isinstance(kind, ecore.EDataType):
                kind = ecore.EObject.eClass
            return ecore.EReference(feature.name, kind, containment=feature.containment, **common)
        kind = kind if isinstance(kind, ecore.EDataType) else ecore.EJavaObject
        made = ecore.EAttribute(feature.name, kind, iD=feature.is_id, defaultValueLiteral=feature.default, **common)
        if feature.default is not None:
            made.get_default_value = partial(default, made, kind)  # pyecore knows fewer texts of values ("1.5f")
        if feature.derived and feature.volatile and feature.upper == 1:
            computed(made)
        return made


def _supertypes_first(classes: list[Class]) -> Iterator[Class]:
    """The classes, each after its supertypes."""
    wanted = set(classes)

    def refuse(circle: list[Class]) -> None:
        cls = circle[0]
        raise ModelError(f"the class '{cls.path}' is its own supertype", location=cls.location, fix="remove the cycle")

    return post_order(classes, lambda cls: [base for base in reversed(cls.supertypes) if base in wanted], refuse)


def _datatype(described: Classifier) -> EDataType:
    if isinstance(described, Enumeration):
        return _enumeration(described)
    assert isinstance(described, DataType)
    return _plain(described.name, described.instance_class)


def _plain(name: str, java: str) -> EDataType:
    """A data type for a Java class; pyecore's own table would create an object for every default value."""
    made = ecore.EDataType(name, instanceClassName=java or "java.lang.Object")
    if java not in _PRIMITIVE:
        made.type_as_factory = False
        made.default_value = None
        made.eType = _PYTHON.get(java, made.eType)
    return made


def _enumeration(described: Enumeration) -> EEnum:
    made = ecore.EEnum(described.name)
    collection = made.eLiterals
    for literal in described.literals:
        one = ecore.EEnumLiteral(literal.name, literal.value)
        one.literal = literal.text
        if hasattr(ecore.EEnum, literal.name) or literal.name in made.__dict__:  # pyecore makes an attribute of each literal
            contain(one, made, pyecore_ecore.EEnum.eLiterals)
            add_silently(collection, one)
        else:
            collection.append(one)
    texts = {literal.name: literal for literal in collection} | {literal_text(literal): literal for literal in collection}
    made.from_string = texts.get
    made.to_string = literal_text
    return made


def _known(classifier: Classifier) -> EClassifier:
    """pyecore's classifier for one of Ecore's own or of XMLType."""
    if classifier.package.name == "ecore":
        found = dynamic_attribute(pyecore_ecore, classifier.name, None)
        if isinstance(classifier, Class):
            eclass = dynamic_attribute(found, "eClass", None) if isinstance(found, type) else None
            return eclass if eclass is not None else _map_entry() if "MapEntry" in classifier.name else ecore.EObject.eClass
        return found if isinstance(found, ecore.EDataType) else ecore.EJavaObject
    if isinstance(classifier, Class):
        return ecore.EObject.eClass
    return _plain(classifier.name, _XML_TYPES.get(classifier.name, "java.lang.String"))


def _map_entry() -> EClass:
    """Ecore's EStringToStringMapEntry, which pyecore has as a dict."""
    python: Any = DynamicClass("EStringToStringMapEntry", (Element,), {})
    eclass = python.eClass = ecore.EClass("EStringToStringMapEntry", metainstance=python)
    for name in ("key", "value"):
        feature = ecore.EAttribute(name, ecore.EString)
        setattr(python, name, feature)
        eclass.eStructuralFeatures.append(feature)
    return eclass
