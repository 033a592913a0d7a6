"""Origins: links from sources to targets of a transformation, and from lines of generated text to model elements.

Generated from trace.ecore by robosmi metamodels generate. Do not edit.
"""

from __future__ import annotations

from collections.abc import Iterable, MutableSequence
from typing import TYPE_CHECKING

from robosmi.model.strict import Element
from robosmi.model.strict_package import (
    EAttribute,
    EInt,
    EReference,
    EString,
    MetaEClass,
    find_classifier,
    package,
)

if TYPE_CHECKING:
    from robosmi.model.strict_package import Classifier, GeneratedModule

name = "trace"
nsURI = "http://robosmi.org/trace/1"
nsPrefix = "trace"

eClass = package(name, nsURI, nsPrefix)
eClassifiers: dict[str, Classifier] = {}
eSubpackages: list[GeneratedModule] = []
eSuperPackage: GeneratedModule | None = None
getEClassifier = find_classifier(eClassifiers)


class Trace(Element, metaclass=MetaEClass):
    """All links of one run."""

    links: MutableSequence[TraceLink] = EReference(upper=-1, containment=True)
    """Links between model elements."""
    texts: MutableSequence[TextTrace] = EReference(upper=-1, containment=True)
    """Links from text."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            links: Iterable[TraceLink] | None = None,
            texts: Iterable[TextTrace] | None = None,
        ) -> None: ...


class TraceLink(Element, metaclass=MetaEClass):
    """A rule created targets from sources."""

    rule: str = EAttribute(eType=EString, lower=1)
    """Name of the rule."""
    step: str = EAttribute(eType=EString, default_value="")
    """Step of the method."""
    sources: MutableSequence[Element] = EReference(upper=-1)
    """Its sources."""
    targets: MutableSequence[Element] = EReference(upper=-1)
    """Its targets."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            rule: str | None = None,
            step: str | None = None,
            sources: Iterable[Element] | None = None,
            targets: Iterable[Element] | None = None,
        ) -> None: ...


class TextTrace(Element, metaclass=MetaEClass):
    """Lines of a generated file that are derived from elements."""

    path: str = EAttribute(eType=EString, lower=1)
    """The generated file, relative to the output folder."""
    line: int = EAttribute(eType=EInt)
    """First line, from 1."""
    endLine: int = EAttribute(eType=EInt)
    """Last line."""
    step: str = EAttribute(eType=EString, default_value="")
    """Step of the method that generated them."""
    rule: str = EAttribute(eType=EString, default_value="")
    """Block of the template that generated them."""
    elements: MutableSequence[Element] = EReference(upper=-1)
    """The elements they are derived from."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            path: str | None = None,
            line: int | None = None,
            endLine: int | None = None,
            step: str | None = None,
            rule: str | None = None,
            elements: Iterable[Element] | None = None,
        ) -> None: ...


if not TYPE_CHECKING:  # pyecore's descriptors, which the annotations above hide
    from robosmi.model.strict_package import EObject

    Trace.links.eType = TraceLink
    Trace.texts.eType = TextTrace
    TraceLink.sources.eType = EObject
    TraceLink.targets.eType = EObject
    TextTrace.elements.eType = EObject
