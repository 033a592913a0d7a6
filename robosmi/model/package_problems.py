"""The reasons why no Python package can be made of a valid metamodel, each with place and remedy.

What can be made differently (an escaped name, a feature left out) is no reason but a note of the generator.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robosmi.model.datatypes import ECORE_URI
from robosmi.model.ecore_description import ECORE, Class, DataType, DescribedElement, Enumeration, Package, is_known
from robosmi.model.ecore_loader import Problem
from robosmi.model.linearise import topological
from robosmi.model.package_types import MAP_ENTRY
from robosmi.model.python_names import python_name

_REPAIR = "correct it in the .ecore file"
_LONGEST = 200
"""Bytes of a package's name, which is that of a folder; file systems take 255."""


def problems_of(packages: Sequence[Package]) -> list[Problem]:
    """All reasons against generating these packages.

    Args:
        packages: the outermost packages.
    """
    found = [*_packages(packages)]
    classes = []
    for root in packages:
        for package in root.walk():
            if len(python_name(package.name or "_").encode("utf-8", "replace")) > _LONGEST:
                found.append(
                    Problem(
                        "a name is too long", package.location, f"a package has a name of more than {_LONGEST} bytes: "
                        f"'{package.name[:40]}...'", f"shorten it: {_REPAIR}",
                    )
                )  # fmt: skip
            found += _twice("package", "sub-package", package.subpackages)
            found += _twice("package", "classifier", package.classifiers)
            for classifier in package.classifiers:
                if isinstance(classifier, Enumeration):
                    found += _twice(f"enumeration '{classifier.path}'", "literal", classifier.literals)
                if isinstance(classifier, Class):
                    classes.append(classifier)
                    found += _class(classifier)
    found += [
        Problem(
            "a class inherits from itself", c.location, f"'{c.path}' inherits from itself", "remove the circle in the .ecore file"
        )
        for c in topological(classes)[1]
    ]
    return found


def _packages(packages: Sequence[Package]) -> Iterator[Problem]:
    seen: dict[str, Package] = {}
    for package in packages:
        if package.uri == ECORE_URI:
            yield Problem(
                "the metamodel is Ecore itself", package.location, f"'{package.name}' is Ecore itself, which pyecore has already",
                "use pyecore.ecore",
            )  # fmt: skip
        other = seen.setdefault(package.name, package)
        if other is not package:
            yield Problem(
                "two packages have one name", package.location,
                f"'{package.source}' and '{other.source}' both have an outermost package '{package.name}'",
                "generate them into different folders, or rename one",
            )  # fmt: skip


def _twice(owner: str, what: str, elements: Sequence[DescribedElement]) -> Iterator[Problem]:
    seen: set[str] = set()
    for element in elements:
        if element.name in seen:
            yield Problem(
                f"a {owner.split()[0]} has two {what}s of one name",
                element.location,
                f"the {owner} has two {what}s '{element.name}'",
                f"rename one of them: {_REPAIR}",
            )
        seen.add(element.name)


def _class(cls: Class) -> Iterator[Problem]:
    yield from _twice(f"class '{cls.path}'", "feature", cls.features)
    for base in cls.supertypes:
        if is_known(base) and base.name != "EObject":
            yield Problem(
                "a class inherits from one of Ecore's own", cls.location,
                f"'{cls.path}' inherits from {base.package.name}.{base.name}, which pyecore keeps for metamodels",
                "inherit from EObject, or from a class of your own",
            )  # fmt: skip
    for feature in cls.features:
        kind = feature.classifier
        if kind is None:
            yield Problem(
                "a feature has no type", feature.location, f"'{feature.path}' has no type", f"give it an eType: {_REPAIR}"
            )
        elif feature.is_reference and isinstance(kind, DataType):
            yield Problem(
                "a feature has the wrong kind of type", feature.location,
                f"the reference '{feature.path}' has the data type '{kind.name}'", f"make it an EAttribute: {_REPAIR}",
            )  # fmt: skip
        elif (
            not feature.is_reference and not isinstance(kind, DataType) and not (kind.package is ECORE and kind.name == MAP_ENTRY)
        ):
            yield Problem(
                "a feature has the wrong kind of type", feature.location,
                f"the attribute '{feature.path}' has the class '{kind.name}'", f"make it an EReference: {_REPAIR}",
            )  # fmt: skip
