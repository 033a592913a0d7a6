"""Adds to dynamic packages the parts of an .ecore file that models do not need, so that writing them again loses nothing.

These are annotations, generic types and their parameters, keys, exceptions, bounds of operations, and flags that are on unless
switched off. pyecore can store all of it (except `eKeys`), but would modify its classes when notified of generic supertypes; so
these are stored without notification. What affects models is made by `ecore_classes`. Contents of annotations other than texts
and references (elements of other metamodels) are not kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeAlias

from pyecore import ecore as pyecore_ecore

from robosmi.model import ecore
from robosmi.model.ecore import EObject, EStructuralFeature
from robosmi.model.ecore_description import (
    Class,
    Classifier,
    DescribedElement,
    Enumeration,
    Feature,
    Operation,
    Package,
    Typed,
    TypeParameter,
)  # fmt: skip
from robosmi.model.ecore_xml import EcoreNode
from robosmi.model.pyecore_internals import add_silently, contain, key_of, set_features_of

Pair: TypeAlias = "tuple[DescribedElement, ecore.EModelElement]"
"""A description, and the object made for it."""


class Details:
    """Completes the objects made for the packages of one run.

    Args:
        packages: the outermost packages.
        made: a function from a description to the object made for it (pyecore's own for one of Ecore's), or None.
    """

    def __init__(self, packages: Iterable[Package], made: Callable[[DescribedElement], ecore.EModelElement | None]) -> None:
        self.packages = list(packages)
        self.made = made
        self.parameters: dict[TypeParameter, ecore.ETypeParameter] = {}

    def add(self) -> None:
        """Complete them all."""
        for root in self.packages:
            for package in root.walk():
                for classifier in package.classifiers:
                    self.declare(classifier)
        for root in self.packages:
            for package in root.walk():
                self.annotations(package, package, self._made(package))
                for classifier in package.classifiers:
                    for one, made in self.parts(classifier):
                        self.complete(package, one, made)

    def parts(self, classifier: Classifier) -> list[Pair]:
        """A classifier and all that it holds."""
        made = self._made(classifier)
        found: list[Pair] = [(classifier, made)]
        if isinstance(classifier, Class):
            assert isinstance(made, ecore.EClass)
            found += [(feature, self._made(feature)) for feature in classifier.features]
            for operation, its in zip(classifier.operations, made.eOperations, strict=True):
                found.append((operation, its))
                found += zip(operation.parameters, its.eParameters, strict=True)
        elif isinstance(classifier, Enumeration):
            assert isinstance(made, ecore.EEnum)
            found += zip(classifier.literals, made.eLiterals, strict=True)
        return found

    def _made(self, one: DescribedElement) -> ecore.EModelElement:
        """The object made for an element of the packages themselves, which always exists."""
        made = self.made(one)
        assert made is not None
        return made

    def declare(self, classifier: Classifier) -> None:
        """Make the type parameters, which generic types refer to."""
        for one, made in self.parts(classifier):
            for parameter in _parameters_of(one):
                declared = self.parameters[parameter] = ecore.ETypeParameter(parameter.name)
                assert isinstance(made, (ecore.EClassifier, ecore.EOperation))
                made.eTypeParameters.append(declared)

    def complete(self, package: Package, one: DescribedElement, made: ecore.EModelElement) -> None:
        """Add the remaining details of an element."""
        node = _node_of(one)
        self.annotations(package, one, made)
        for parameter in _parameters_of(one):
            declared = self.parameters[parameter]
            self.annotations(package, parameter, declared)
            declared.eBounds.extend(self.generic(package, bound) for bound in _node_of(parameter).tagged("eBounds"))
        if isinstance(made, ecore.ETypedElement):
            assert isinstance(one, Typed)
            self.typed(package, one, made)
        elif isinstance(made, ecore.EClassifier):
            self.names(node, made)
            if isinstance(made, ecore.EDataType) and not node.flag("serializable", True):
                made.serializable = False
        if isinstance(made, ecore.EClass):
            generic = [self.generic(package, child) for child in node.tagged("eGenericSuperTypes")]
            if any(_says_more(one) for one in generic):
                for supertype in generic:
                    _put(made, pyecore_ecore.EClass.eGenericSuperTypes, supertype)

    def typed(self, package: Package, one: Typed, made: ecore.ETypedElement) -> None:
        """Add generic type and bounds, and the details of references and operations."""
        node = _node_of(one)
        for child in node.tagged("eGenericType"):
            generic = self.generic(package, child)
            if _says_more(generic):
                made.eGenericType = generic
        if isinstance(one, Feature):
            if isinstance(made, ecore.EReference):
                if not node.flag("resolveProxies", True):
                    made.resolveProxies = False
                keys = [self.made(key) for key in package.find(node, "eKeys") if isinstance(key, Feature)]
                if keys:
                    made.eKeys = [key for key in keys if isinstance(key, ecore.EAttribute)]
            return
        made.lowerBound, made.upperBound, made.ordered, made.unique = one.lower, one.upper, one.ordered, one.unique
        if isinstance(made, ecore.EOperation):
            thrown = [self.generic(package, child) for child in node.tagged("eGenericExceptions")]
            if any(_says_more(one) for one in thrown):
                made.eGenericExceptions.extend(thrown)
            else:
                found = package.find(node, "eExceptions")
                kinds = [*(self.made(kind) for kind in found), *(kind.eClassifier for kind in thrown)]
                made.eExceptions.extend(kind for kind in kinds if isinstance(kind, ecore.EClassifier))

    @staticmethod
    def names(node: EcoreNode, made: ecore.EClassifier) -> None:
        """The Java class names in the file, as written."""
        if "<" in (text := node.get("instanceTypeName")):
            made.instanceTypeName, text = text, ""
        text = text or node.get("instanceClassName")
        if not isinstance(made, ecore.EDataType):
            made.instanceClassName = text or None
        else:
            made.instanceClassName_ = text or None  # pyecore would take its own table's type for it

    def generic(self, package: Package, node: EcoreNode) -> ecore.EGenericType:
        """The EGenericType that a node describes, with its arguments and bounds."""
        result = self._generic(package, node)
        pending = [(node, result)]
        while pending:
            outer, made = pending.pop()
            for child in outer.tagged("eTypeArguments", "eUpperBound", "eLowerBound"):
                inner = self._generic(package, child)
                if child.tag == "eTypeArguments":
                    made.eTypeArguments.append(inner)
                else:
                    setattr(made, child.tag, inner)
                pending.append((child, inner))
        return result

    def _generic(self, package: Package, node: EcoreNode) -> ecore.EGenericType:
        kind = next((self.made(c) for c in package.find(node, "eClassifier") if isinstance(c, Classifier)), None)
        parameter = next(
            (self.parameters.get(p) for p in package.find(node, "eTypeParameter") if isinstance(p, TypeParameter)), None
        )
        return ecore.EGenericType(eClassifier=kind, eTypeParameter=parameter)

    def annotations(self, package: Package, one: DescribedElement, made: ecore.EModelElement) -> None:
        """The annotations of an element, and theirs."""
        pending = [(_node_of(one), made)]
        while pending:
            node, owner = pending.pop()
            for child in node.tagged("eAnnotations"):
                annotation = ecore.EAnnotation(child.attributes.get("source"))
                for detail in child.tagged("details"):
                    text = "".join(value.text for value in detail.tagged("value"))
                    annotation.details[detail.get("key")] = detail.attributes.get("value", text or None)
                referred = (
                    self.parameters.get(to) if isinstance(to, TypeParameter) else self.made(to)
                    for to in package.find(child, "references")
                )
                annotation.references.extend(target for target in referred if target is not None)
                owner.eAnnotations.append(annotation)
                pending.append((child, annotation))


def _node_of(one: DescribedElement) -> EcoreNode:
    """The XML node of a description; never called for Ecore's own elements, which are in no file."""
    assert one.node is not None
    return one.node


def _parameters_of(one: DescribedElement) -> list[TypeParameter]:
    return one.type_parameters if isinstance(one, (Classifier, Operation)) else []


def _says_more(generic: ecore.EGenericType) -> bool:
    """Whether a generic type is more than the name of a classifier; EMF writes only those as such."""
    return generic.eTypeParameter is not None or len(generic.eTypeArguments) > 0 or generic.eClassifier is None


def _put(owner: EObject, feature: EStructuralFeature, part: EObject) -> None:
    """Add a value to a many-valued feature without notification."""
    contain(part, owner, feature)
    add_silently(getattr(owner, key_of(feature)), part)
    set_features_of(owner).add(feature)
