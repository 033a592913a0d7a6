"""What is odd in .ecore files that can be read all the same: bounds, opposites and names that contradict, misspelt features.

EMF's validation reports the same of bounds, opposites and names, and its loader refuses unknown attributes and elements; here
they would be read over, and the model would be blamed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import did_you_mean
from robosmi.model.ecore.ecore_description import Class, Classifier, Feature, Package
from robosmi.model.ecore.ecore_files import EcoreFiles
from robosmi.model.ecore.ecore_xml import EcoreNode

RULE, UNRESOLVED = "RS607", "RS609"
_NAMED = ("name",)
_CLASSIFIER = (*_NAMED, "instanceClassName", "instanceTypeName", "defaultValue")
_TYPED = (*_NAMED, "ordered", "unique", "lowerBound", "upperBound", "many", "required", "eType")
_FEATURE = (
    *_TYPED, "changeable", "volatile", "transient", "defaultValueLiteral", "defaultValue", "unsettable", "derived",
)  # fmt: skip
_ATTRIBUTES = {
    "EPackage": (*_NAMED, "nsURI", "nsPrefix"),
    "EClass": (*_CLASSIFIER, "abstract", "interface", "eSuperTypes"),
    "EDataType": (*_CLASSIFIER, "serializable"),
    "EEnum": (*_CLASSIFIER, "serializable"),
    "EEnumLiteral": (*_NAMED, "value", "literal", "instance"),
    "EAttribute": (*_FEATURE, "iD"),
    "EReference": (*_FEATURE, "containment", "container", "resolveProxies", "eOpposite", "eKeys"),
    "EOperation": (*_TYPED, "eExceptions"),
    "EParameter": _TYPED,
    "EAnnotation": ("source", "references"),
    "EGenericType": ("eTypeParameter", "eClassifier"),
    "ETypeParameter": _NAMED,
    "EStringToStringMapEntry": ("key", "value"),
}
"""Class of Ecore -> the features that an .ecore file may write as attributes."""
_PARTS = {
    "EPackage": ("eClassifiers", "eSubpackages"),
    "EClass": ("eStructuralFeatures", "eOperations", "eTypeParameters", "eGenericSuperTypes"),
    "EDataType": ("eTypeParameters",),
    "EEnum": ("eTypeParameters", "eLiterals"),
    "EEnumLiteral": (),
    "EAttribute": ("eGenericType",),
    "EReference": ("eGenericType",),
    "EOperation": ("eGenericType", "eTypeParameters", "eParameters", "eGenericExceptions"),
    "EParameter": ("eGenericType",),
    "EAnnotation": ("details", "contents", "references"),
    "EGenericType": ("eUpperBound", "eLowerBound", "eTypeArguments", "eTypeParameter", "eClassifier"),
    "ETypeParameter": ("eBounds",),
    "EStringToStringMapEntry": ("key", "value"),
}
"""Class of Ecore -> the features, beside annotations and attributes, that an .ecore file may write as elements."""
_KINDS = {
    "EPackage": "EPackage", "eSubpackages": "EPackage", "eLiterals": "EEnumLiteral", "eOperations": "EOperation",
    "eParameters": "EParameter", "eAnnotations": "EAnnotation", "eGenericType": "EGenericType",
    "eGenericSuperTypes": "EGenericType", "eGenericExceptions": "EGenericType", "eTypeArguments": "EGenericType",
    "eUpperBound": "EGenericType", "eLowerBound": "EGenericType", "eBounds": "EGenericType", "eTypeParameters": "ETypeParameter",
    "details": "EStringToStringMapEntry",
}  # fmt: skip
"""Tag of an element without `xsi:type` -> its class."""


def lint(path: Path, packages: Sequence[Package]) -> list[Finding]:
    """What is odd in a metamodel.

    Args:
        path: an .ecore file.
        packages: the outermost packages of it and of those that it refers to.

    Raises:
        SourceError: the file cannot be read.
    """
    return [*_unknown_names(path, EcoreFiles().load(path).roots), *contradictions(packages)]


def contradictions(packages: Sequence[Package]) -> list[Finding]:
    """What no model can fulfil, or two elements of one name between which none can choose; the same, whatever file says it."""
    described = [package for root in packages for package in root.walk()]
    found = [finding for package in described for finding in _twice(package.classifiers, f"the package '{package.path}'")]
    classes = [each for package in described for each in package.classifiers if isinstance(each, Class)]
    clashes: set[tuple[int, int]] = set()  # a subclass says nothing of what its supertypes have twice
    for cls in sorted(classes, key=lambda each: len(each.ancestors())):
        features = [feature for owner in (*cls.ancestors(), cls) for feature in owner.features]
        found += _twice(features, f"the class '{cls.path}'", clashes)
        found += [finding for feature in cls.features for finding in _of_feature(feature)]
    return sorted([*found, *_missing(classes)], key=_place)


def _missing(classes: Sequence[Class]) -> list[Finding]:
    """What lies in files that are not there: one finding for each file, with the place of the first reference."""
    referred: list[Classifier | Feature | None] = []
    for cls in classes:
        typed = (*cls.features, *cls.operations, *(one for operation in cls.operations for one in operation.parameters))
        referred += [*cls.supertypes, *(one.classifier for one in typed), *(feature.opposite for feature in cls.features)]
    packages: dict[tuple[Path, str], list[Package]] = {}
    for one in dict.fromkeys(referred):
        package = None if one is None else one.owner.package if isinstance(one, Feature) else one.package
        if package is not None and package.missing:
            packages.setdefault((package.source.parent, package.name), []).append(package)
    fix = "put the .ecore file beside this one, or give it as a further file"
    found = []
    for (_, uri), some in packages.items():
        more = f" (and {len(some) - 1} more that are referred to there)" if len(some) > 1 else ""
        message = f"the metamodel '{uri}' is not there{more}"
        found.append(Finding(UNRESOLVED, Severity.warning, message, some[0].location, None, fix))
    return found


def _place(finding: Finding) -> tuple[str, int]:
    place = finding.location
    return (place.path, place.line or 0) if place is not None else ("", 0)


def _twice(elements: Sequence[Classifier | Feature], owner: str, clashes: set[tuple[int, int]] | None = None) -> list[Finding]:
    """Elements with the name of one before them."""
    found = []
    first: dict[str, Classifier | Feature] = {}
    for element in elements:
        other = first.setdefault(element.name, element)
        clash = (id(other), id(element))
        if other is element or (clashes is not None and clash in clashes):
            continue
        if clashes is not None:
            clashes.add(clash)
        what = f"'{other.path}' and '{element.path}'" if other.path != element.path else f"two '{element.path}'"
        message = f"{owner} has two elements of one name: {what}"
        found.append(_finding(message, element.location, "rename one of them", element))
    return found


def _unknown_names(path: Path, nodes: Iterable[EcoreNode]) -> Iterator[Finding]:
    for node in nodes:
        kind = node.kind or _KINDS.get(node.tag, "")
        if kind not in _ATTRIBUTES:
            if node.kind:
                message = f"'{kind}' is no class of Ecore{did_you_mean(kind, _ATTRIBUTES)}"
                yield _finding(message, Location(str(path), node.line), "correct its xsi:type")
            continue
        known = _ATTRIBUTES[kind]
        for name in node.attributes:
            if name not in known and name != "href":
                message = f"'{name}' is no attribute of an {kind}{did_you_mean(name, known)}: it is read over"
                yield _finding(message, Location(str(path), node.line), "correct its name, or take it out")
        parts = ("eAnnotations", *_PARTS[kind], *known)
        for child in node.children:
            if child.tag not in parts and child.tag != "Extension":
                message = (
                    f"'{child.tag}' is no feature of an {kind}{did_you_mean(child.tag, parts)}: it is lost with all it contains"
                )
                yield _finding(message, Location(str(path), child.line), "correct its name, or take it out")
        if kind != "EAnnotation":  # what an annotation contains may be of any metamodel
            yield from _unknown_names(path, [child for child in node.children if child.tag in parts])


def _of_feature(feature: Feature) -> Iterator[Finding]:
    if 0 <= feature.upper < feature.lower:
        message = f"'{feature.path}' has at least {feature.lower} values and at most {feature.upper}: no model has both"
        yield _finding(message, feature.location, "correct lowerBound or upperBound", feature)
    opposite = feature.opposite
    if opposite is None or opposite.owner.package.missing:
        return
    if opposite.opposite is not feature:
        names = f"names '{opposite.opposite.path}'" if opposite.opposite is not None else "names none"
        message = f"'{feature.path}' names '{opposite.path}' as its opposite, which {names}"
        yield _finding(message, feature.location, "let each name the other as its eOpposite", feature)
    elif opposite.owner is not feature.classifier:
        kind = feature.classifier.path if feature.classifier is not None else "nothing"
        message = f"'{feature.path}' has the type '{kind}', and its opposite '{opposite.path}' is a feature of another class"
        yield _finding(message, feature.location, "let the type be the class that has the opposite", feature)


def _finding(message: str, location: Location, fix: str, element: Classifier | Feature | None = None) -> Finding:
    return Finding(RULE, Severity.warning, message, location, element.path if element is not None else None, fix)
