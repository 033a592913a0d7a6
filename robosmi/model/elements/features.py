"""What EMF knows of a metamodel, asked of pyecore: all features in order, declared types, ID attributes, packages.

Smooths over what pyecore leaves open: generic supertypes and types, proxies in the place of classifiers, Python classes
in the place of EClasses, modules in the place of packages. Facts of metamodels only; no model element is touched.
"""

from __future__ import annotations

from typing import Any

from robosmi.model.elements import ecore
from robosmi.model.elements.datatypes import is_data_type, real
from robosmi.model.elements.ecore import (
    EClass,
    EClassifier,
    ECollection,
    EGenericType,
    EObject,
    EPackage,
    EReference,
    EStructuralFeature,
    Package,
)
from robosmi.model.elements.ordering import post_order
from robosmi.model.elements.pyecore_internals import declared_type_of, set_features_of


def eclass_of(kind: EClassifier | type | None) -> Any:
    """The EClass of a class, be it given as EClass, as generated Python class or as proxy."""
    kind = real(kind)
    if isinstance(kind, ecore.EClass) or kind is None:
        return kind
    if kind is ecore.EObject:
        return ecore.EObject.eClass
    return getattr(kind, "eClass", kind) if isinstance(kind, type) else kind


def supertypes(eclass: EClass) -> list[EClass]:
    """The direct supertypes of an EClass, those given by generic types included, each once."""
    generic = [g.eClassifier for g in eclass.eGenericSuperTypes if g.eClassifier is not None]
    return list(dict.fromkeys(eclass_of(base) for base in [*eclass.eSuperTypes, *generic]))


def all_features(eclass: EClass) -> list[EStructuralFeature]:
    """All structural features in Ecore's order: those of supertypes first, each once."""
    found: dict[EStructuralFeature, None] = {}
    for one in post_order([eclass], supertypes):
        found.update(dict.fromkeys(one.eStructuralFeatures))
    return list(found)


def is_computed(feature: EStructuralFeature) -> bool:
    """Whether code computes a feature's values: it is derived and volatile. One that is derived only is stored, as EMF does.

    Collections that Ecore itself derives, such as `EClass.eAttributes`, are not volatile in pyecore, which computes them.
    """
    return bool(feature.derived and (feature.volatile or (feature.many and feature.derived_class is ECollection)))


def declared_type(feature: EStructuralFeature) -> Any:
    """The EClass or EDataType of a feature; for a type parameter its bound, or EObject (EJavaObject for attributes)."""
    kind = real(declared_type_of(feature) if declared_type_of(feature) is not None else feature.eType)
    if kind is None:
        kind = _erased(feature.eGenericType)
    if kind is None:
        kind = ecore.EJavaObject if feature.is_attribute else ecore.EObject.eClass
    return kind if is_data_type(kind) else eclass_of(kind)


def _erased(generic: EGenericType | None) -> EClassifier | None:
    seen = 0
    while generic is not None and seen < 100:  # a bound may be a type parameter again
        seen += 1
        if generic.eClassifier is not None:
            return real(generic.eClassifier)
        bounds = list(generic.eTypeParameter.eBounds) if generic.eTypeParameter is not None else []
        generic = bounds[0] if bounds else None
    return None


def has_type_parameter(feature: EStructuralFeature) -> bool:
    """Whether the feature's type is a type parameter."""
    generic = feature.eGenericType
    return generic is not None and generic.eTypeParameter is not None


def opposite(feature: EStructuralFeature) -> EReference | None:
    """The opposite of a reference, or None."""
    return real(feature.eOpposite) if feature.is_reference else None


def id_attribute(eclass: EClass) -> EStructuralFeature | None:
    """The attribute whose value identifies an element in its file, or None."""
    return next((f for f in all_features(eclass) if f.is_attribute and f.iD), None)


def is_abstract(eclass: EClass) -> bool:
    """Whether the class has no elements of its own; Ecore's EObject is not abstract, whatever pyecore says."""
    return bool(eclass.abstract or eclass.interface) and eclass is not ecore.EObject.eClass


_EXTENDED = frozenset({"EObject", "EModelElement", "ENamedElement"})


def without_elements(eclass: EClass) -> str | None:
    """Why a class that inherits from one of Ecore's own cannot have elements here, or None if it can.

    Annotations and a name are features like others. An element that also is a class, a package or a feature would be a part of
    a metamodel, which pyecore keeps as Python's classes and attributes.
    """
    for base in reversed(list(post_order([eclass], supertypes))):
        if is_of_ecore(base) and base is not eclass and base.name not in _EXTENDED:
            return f"{eclass.name} inherits from Ecore's {base.name}: elements of such classes are not supported"
    return None


def is_off(element: EObject, name: str) -> bool:
    """Whether a flag that is on by default was switched off; pyecore returns False also for one that was never set."""
    feature = type(element).__dict__.get(name) or getattr(type(element), name)
    return feature in set_features_of(element) and not getattr(element, name)


def root_package(package: Package) -> EPackage:
    """The outermost package, as EPackage (generated packages are modules)."""
    package = as_package(package)
    while package.eSuperPackage is not None:
        package = as_package(package.eSuperPackage)
    return package


def as_package(package: Package) -> EPackage:
    """The EPackage of a generated module, or the package itself."""
    given: Any = package
    found: EPackage = given if isinstance(type(given), type(ecore.EPackage)) else given.eClass
    return found


def subpackages(package: Package) -> list[EPackage]:
    """All packages below a package, given as EPackage or generated module."""
    found: list[EPackage] = []
    pending = list(as_package(package).eSubpackages)
    while pending:
        one = pending.pop(0)
        found.append(one)
        pending.extend(as_package(one).eSubpackages)
    return found


def class_in(package: Package | None, name: str) -> EClass | None:
    """The EClass of that name in a package (None, an EPackage or a generated module), or None."""
    found = package.getEClassifier(name) if package is not None else None
    return None if found is None or is_data_type(found) else eclass_of(found)


def class_names(package: Package) -> list[str]:
    """The names of a package's classes."""
    return [str(c.name) for c in as_package(package).eClassifiers if not is_data_type(c)]


def is_of_ecore(classifier: EClassifier) -> bool:
    """Whether the classifier is one of Ecore's own."""
    package = classifier.ePackage
    return package is None or package.nsURI == ecore.nsURI
