"""Metamodels to .ecore text, as Eclipse EMF writes them (EcoreResourceFactoryImpl: references as attributes, lines of 80).

pyecore's own writer loses every `eOpposite` and, where a flag is on by default in EMF, its being on. What of Ecore is written is
the table below; the order is that of Ecore's own metamodel. Models go through `xmi_writer`, which calls this for packages.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from robosmi.model.elements import ecore
from robosmi.model.elements.datatypes import is_data_type, real, to_text
from robosmi.model.elements.ecore import DynamicEObject, EObject
from robosmi.model.elements.features import as_package, eclass_of, is_off
from robosmi.model.elements.pyecore_internals import proxy_place, xmi_id_of

WIDTH = 80
_NAMED = (("eAnnotations", "parts", None), ("name", "text", None))
_TYPED = (
    *_NAMED, ("ordered", "flag", True), ("unique", "flag", True), ("lowerBound", "number", 0), ("upperBound", "number", 1),
    ("eType", "link", "EClassifier"), ("eGenericType", "part", None),
)  # fmt: skip
_FEATURE = (
    *_TYPED, ("changeable", "flag", True), ("volatile", "flag", False), ("transient", "flag", False),
    ("defaultValueLiteral", "text", None), ("unsettable", "flag", False), ("derived", "flag", False),
)  # fmt: skip
_CLASSIFIER = (
    *_NAMED, ("instanceClassName", "text", None), ("instanceTypeName", "text", None), ("eTypeParameters", "parts", None),
)  # fmt: skip
FEATURES: dict[str, tuple[tuple[str, str, Any], ...]] = {
    "EPackage": (*_NAMED, ("nsURI", "text", None), ("nsPrefix", "text", None), ("eClassifiers", "parts", "EClassifier"),
                 ("eSubpackages", "parts", None)),
    "EClass": (*_CLASSIFIER, ("abstract", "flag", False), ("interface", "flag", False), ("eSuperTypes", "links", "EClass"),
               ("eOperations", "parts", None), ("eStructuralFeatures", "parts", "EStructuralFeature"),
               ("eGenericSuperTypes", "parts", None)),
    "EDataType": (*_CLASSIFIER, ("serializable", "on", None)),
    "EEnum": (*_CLASSIFIER, ("serializable", "on", None), ("eLiterals", "parts", None)),
    "EEnumLiteral": (*_NAMED, ("value", "number", 0), ("literal", "literal", None)),
    "EAttribute": (*_FEATURE, ("iD", "flag", False)),
    "EReference": (*_FEATURE, ("containment", "flag", False), ("resolveProxies", "on", None), ("eOpposite", "link", "EReference"),
                   ("eKeys", "links", "EAttribute")),
    "EOperation": (*_TYPED, ("eTypeParameters", "parts", None), ("eParameters", "parts", None),
                   ("eExceptions", "links", "EClassifier"), ("eGenericExceptions", "parts", None)),
    "EParameter": _TYPED,
    "EAnnotation": (("eAnnotations", "parts", None), ("source", "text", None), ("details", "details", None),
                    ("contents", "parts", "EObject"), ("references", "links", "EObject")),
    "EGenericType": (("eUpperBound", "part", None), ("eTypeArguments", "parts", None), ("eLowerBound", "part", None),
                     ("eTypeParameter", "link", "ETypeParameter"), ("eClassifier", "link", "EClassifier")),
    "ETypeParameter": (*_NAMED, ("eBounds", "parts", None)),
}  # fmt: skip
"""Class of Ecore -> its features in order: name, form, and default or declared type. "on" is a flag that is on unless set off."""

_ABSTRACT = ("EClassifier", "EStructuralFeature")
Item = tuple[str, Any, list[tuple[str, str]]]
"""Tag, element (None for a detail), attributes given beforehand."""


class EcoreText:
    """The text of one .ecore file.

    Args:
        place: finds the URI of an element: `#//X` in this file, else with file or namespace before it.
        escape: makes a text fit between quotes.
    """

    def __init__(self, place: Callable[[Any, str, Any], str], escape: Callable[[str, Any, str], str]) -> None:
        self.place = place
        self.escape = escape
        self.lines: list[str] = []
        self.width = 0

    def write(self, packages: list[Any]) -> bytes:
        """The bytes for root packages."""
        self._write(packages, with_xsi=True)
        if not any(line.startswith("xsi:type=") for line in self.lines):  # EMF declares only what it uses, and wraps by that
            self.lines.clear()
            self._write(packages, with_xsi=False)
        return "".join(self.lines).encode()

    def _write(self, packages: list[Any], with_xsi: bool) -> None:
        head = [("xmi:version", "2.0"), ("xmlns:xmi", "http://www.omg.org/XMI")]
        head += [("xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance")] if with_xsi else []
        head.append(("xmlns:ecore", ecore.nsURI))
        self.add('<?xml version="1.0" encoding="UTF-8"?>\n')
        packages = [package if isinstance(package, ecore.EClassifier) else as_package(package) for package in packages]
        roots: list[Item] = [(f"ecore:{package.eClass.name}", package, []) for package in packages]
        if len(roots) == 1:
            self.elements([(roots[0][0], packages[0], head)])
        else:
            self.open("xmi:XMI", head, 0)
            self.add(">\n" if roots else "/>\n")
            self.elements(roots, 1)
            self.add("</xmi:XMI>\n" if roots else "")

    def add(self, text: str) -> None:
        """Add a text; a line's width is counted as EMF does."""
        self.lines.append(text)
        self.width = len(text) - text.rfind("\n") - 1 if "\n" in text else self.width + len(text)

    def open(self, tag: str, attributes: list[tuple[str, str]], depth: int) -> None:
        """A start tag, not yet closed; attributes wrap after the width, which EMF counts without the namespaces."""
        self.add(f"{'  ' * depth}<{tag}")
        width, after_namespaces, wide = self.width, False, False
        for name, value in attributes:
            wraps = self.width > WIDTH or (after_namespaces and wide)
            self.add(f"\n{'  ' * (depth + 2)}" if wraps else " ")
            if after_namespaces:
                self.width = width
            self.add(f'{name}="{value}"')
            after_namespaces, wide = name == "xmlns:ecore", self.width > WIDTH
            if after_namespaces:
                self.width = width

    def elements(self, roots: list[Item], depth: int = 0) -> None:
        """Elements and all they contain."""
        stack: list[tuple[Iterator[Item], str]] = []
        work = iter(roots)
        while True:
            for tag, element, given in work:
                attributes, parts = ([], []) if element is None else self.of(element)
                if element is not None and xmi_id_of(element) is not None:
                    attributes.insert(0, ("xmi:id", self.escape(str(xmi_id_of(element)), element, "xmi:id")))
                self.open(tag, [*given, *attributes], depth)
                if not parts:
                    self.add("/>\n")
                    continue
                self.add(">\n")
                stack.append((work, tag))
                work, depth = iter(parts), depth + 1
                break
            else:
                if not stack:
                    return
                work, tag = stack.pop()
                depth -= 1
                self.add(f"{'  ' * depth}</{tag}>\n")

    def of(self, element: DynamicEObject) -> tuple[list[tuple[str, str]], list[Item]]:
        """The attributes of an element, and its content."""
        attributes: list[tuple[str, str]] = []
        parts: list[Item] = []
        for name, form, extra in FEATURES[kind_of(element)]:
            value = _value(element, name)
            if form in ("part", "parts"):
                for part in [value] if form == "part" else value:
                    if part is not None:
                        kind = f"ecore:{kind_of(real(part))}"
                        parts.append((name, real(part), [("xsi:type", kind)] if extra is not None else []))
            elif form == "details":
                for key, text in value.items():
                    pairs = [("key", key), ("value", text)]
                    parts.append((name, None, [(n, self.escape(str(t), element, name)) for n, t in pairs if t is not None]))
            elif form in ("link", "links"):
                targets = [t for t in ([value] if form == "link" else value) if t is not None]
                if targets:
                    attributes.append((name, " ".join(self.link(element, name, real(t), extra) for t in targets)))
            elif (text := _text(element, name, form, value, extra)) is not None:
                attributes.append((name, self.escape(text, element, name)))
        return attributes, parts

    def link(self, element: EObject, name: str, target: Any, declared: str) -> str:
        """A reference, with the target's type before it if it lies elsewhere and the declared one is abstract."""
        if isinstance(target, ecore.EProxy):  # nothing here resolves it: it stays what it was
            kind = "EDataType" if isinstance(element, ecore.EAttribute) else "EClass"
            path = self.escape(proxy_place(target)[0], element, name)
            return path if path.startswith("#") or declared not in _ABSTRACT else f"ecore:{kind} {path}"
        target = target if is_data_type(target) or not isinstance(target, type) else eclass_of(target)
        uri = self.escape(self.place(element, name, target), element, name)
        return uri if uri.startswith("#") or declared not in _ABSTRACT else f"ecore:{kind_of(target)} {uri}"


def _value(element: DynamicEObject, name: str) -> Any:
    if name == "eSuperTypes" and len(element.eGenericSuperTypes):
        return ()  # they are given with their arguments
    if name == "eType" and element.eGenericType is not None:
        return None
    value = getattr(element, name, None)
    if name == "defaultValueLiteral" and value is None:
        return _default(element)
    if name in ("eTypeParameters", "eKeys", "eGenericExceptions", "eExceptions") and value is None:
        return ()
    return value


def _default(feature: DynamicEObject) -> str | None:
    """The text of a default that is given as a value, as generated packages do; None if it is that of the type."""
    value = getattr(feature, "default_value", None)
    kind = real(feature.eType)
    return None if value is None or value == kind.default_value else str(to_text(kind)(value))


def _text(element: DynamicEObject, name: str, form: str, value: Any, default: Any) -> str | None:
    """The text of an attribute, or None if it is not written."""
    if form == "on":
        return "false" if is_off(element, name) else None
    if form == "literal":
        return str(value) if value is not None and element.eIsSet(name) else None
    if value is None or value == default:
        return None
    if form == "flag":
        return "true" if value else "false"
    return str(value)


def kind_of(element: EObject) -> str:
    """The name of an Ecore element's class; pyecore has the map entry as a data type, and users may extend Ecore's classes."""
    if element is ecore.EStringToStringMapEntry:
        return "EClass"
    return next(cls.__name__ for cls in element.__class__.__mro__ if cls.__name__ in FEATURES)
