"""What type checkers know of pyecore's packages, classes and data types, which have no annotations.

These protocols say what generated modules promise of a metamodel as a whole; they are imported under `TYPE_CHECKING`, and no
object here is ever made. What an element says of its own class (`element.eClass`) is reflection, as in pyecore itself.
"""

from __future__ import annotations

from collections.abc import MutableSequence
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from robosmi.model.strict import Element


class EDataType(Protocol):
    """A data type or an enumeration of a metamodel."""

    name: str
    instanceClassName: str | None


class EClass(Protocol):
    """A class of a metamodel."""

    name: str
    abstract: bool
    eSuperTypes: MutableSequence[EClass]
    python_class: type[Element]


class EPackage(Protocol):
    """A package of a metamodel."""

    name: str
    nsURI: str
    nsPrefix: str
    eSuperPackage: EPackage | None
    eSubpackages: MutableSequence[EPackage]
    eClassifiers: MutableSequence[EClass | EDataType]

    def getEClassifier(self, name: str) -> EClass | EDataType | None:
        """The classifier of that name, or None."""
