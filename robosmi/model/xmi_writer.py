"""Models to XMI text, byte for byte as Eclipse EMF writes them (OMG XMI 2.0 as in EMF's XMIResourceImpl).

pyecore's own writer truncates a file when it fails, drops references that have no place and decorates every child with
a type. Here all models of a set are checked first and only then turned into bytes; nothing is written to disk: that is
`files`' job. References between the models of a set become relative URIs; a reference to anything else is an error.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any
from urllib.parse import quote

from robosmi.errors import ModelError

_ESCAPES = {"&": "&amp;", "<": "&lt;", '"': "&quot;", "\n": "&#xA;", "\t": "&#x9;", "\r": "&#xD;"}
_SPECIAL = re.compile('[&<"\n\t\r]')
_SPECIAL_TEXT = re.compile("[&<\r]|]]>")
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def to_xmi(models: Mapping[str, Any], wanted: Iterable[str] | None = None) -> dict[str, bytes]:
    """The bytes of a set of models that refer to each other.

    Args:
        models: relative file name -> root element; the names are those that references use.
        wanted: the names whose bytes are wanted; all if None.

    Returns:
        The wanted names -> UTF-8 text of an XMI file.

    Raises:
        ModelError: a reference leads to an element in none of the models, or a text holds a character XML cannot.
    """
    places: dict[int, tuple[str, str]] = {}
    for name, root in models.items():
        _number(root, "/", name, places)
    return {name: _Writer(name, models[name], places).write() for name in (models if wanted is None else wanted)}


class _Plan:
    """What of an EClass is written, worked out once."""

    __slots__ = ("attributes", "children", "elements")

    def __init__(self, eclass: Any) -> None:
        self.attributes: list[tuple[str, bool, Any, Any]] = []  # name, is reference, default, to text
        self.elements: list[tuple[str, str, Any]] = []  # name, form, declared type
        self.children: list[tuple[str, bool]] = []
        for feature in _ordered(eclass):
            if feature.transient or feature.derived:
                continue
            if feature.is_attribute:
                if feature.many:
                    self.elements.append((feature.name, "texts", feature.eType.to_string))
                else:
                    self.attributes.append((feature.name, False, feature.get_default_value(), feature.eType.to_string))
            elif feature.containment:
                self.elements.append((feature.name, "children", feature.eType))
                self.children.append((feature.name, feature.many))
            elif not (feature.eOpposite and feature.eOpposite.containment):
                self.attributes.append((feature.name, True, None, feature.many))
                self.elements.append((feature.name, "references", feature.eType))


_PLANS: dict[Any, _Plan] = {}


def _plan(element: Any) -> _Plan:
    eclass = element.eClass
    plan = _PLANS.get(eclass)
    if plan is None:
        plan = _PLANS[eclass] = _Plan(eclass)
    return plan


def _ordered(eclass: Any) -> list[Any]:
    result: list[Any] = []
    for base in eclass.eSuperTypes:
        result.extend(f for f in _ordered(base) if f not in result)
    return result + list(eclass.eStructuralFeatures)


def _values(element: Any, name: str) -> list[Any]:
    """The values of a feature without touching a slot that was never used."""
    slot = element.__dict__.get(name)
    if slot is None:
        return []
    value = slot._get()
    return list(value) if value is slot else [] if value is None else [value]


def _number(element: Any, fragment: str, name: str, places: dict[int, tuple[str, str]]) -> None:
    places[id(element)] = (name, fragment)
    for feature, many in _plan(element).children:
        for index, child in enumerate(_values(element, feature)):
            step = f"/@{feature}.{index}" if many else f"/@{feature}"
            _number(child, fragment + step, name, places)


class _Writer:
    """One file."""

    def __init__(self, name: str, root: Any, places: dict[int, tuple[str, str]]) -> None:
        self.name = name
        self.root = root
        self.places = places
        self.out: list[str] = []
        self.namespaces: dict[str, str] = {}
        self.typed = False

    def write(self) -> bytes:
        package = self.root.eClass.ePackage
        tag = self._qualified(self.root.eClass)
        self._element(self.root, tag, None, "")
        body = "".join(self.out)
        head = ' xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI"'
        if self.typed:
            head += ' xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
        first = self.namespaces.pop(package.nsPrefix)
        rest = "".join(f' xmlns:{prefix}="{uri}"' for prefix, uri in sorted({**self.namespaces, package.nsPrefix: first}.items()))
        head += rest
        return f'<?xml version="1.0" encoding="UTF-8"?>\n<{tag}{head}{body[len(tag) + 1 :]}'.encode()

    def _qualified(self, eclass: Any) -> str:
        package = eclass.ePackage
        self.namespaces[package.nsPrefix] = package.nsURI
        return f"{package.nsPrefix}:{eclass.name}"

    def _element(self, element: Any, tag: str, declared: Any, indent: str) -> None:
        out = self.out
        plan = _plan(element)
        slots = element.__dict__
        out.append(f"{indent}<{tag}")
        if declared is not None and element.eClass is not getattr(declared, "eClass", declared):
            self.typed = True
            out.append(f' xsi:type="{self._qualified(element.eClass)}"')
        remote: set[str] = set()
        for name, is_reference, default, convert in plan.attributes:
            if name not in slots:
                continue
            if is_reference:
                targets = _values(element, name)
                found = [self._place(element, name, target) for target in targets]
                if any(file != self.name for file, _ in found):
                    remote.add(name)
                elif found:
                    out.append(f' {name}="{" ".join(fragment for _, fragment in found)}"')
            else:
                value = slots[name]._get()
                if value is not None and value != default:
                    out.append(f' {name}="{self._escaped(element, name, _text(value, convert))}"')
        opened = False
        for name, form, kind in plan.elements:
            if name not in slots or (form == "references" and name not in remote):
                continue
            for value in _values(element, name):
                if not opened:
                    out.append(">\n")
                    opened = True
                if form == "children":
                    self._element(value, name, kind, indent + "  ")
                elif form == "texts":
                    out.append(f"{indent}  <{name}>{self._content(element, name, _text(value, kind))}</{name}>\n")
                else:
                    self._reference(element, name, value, kind, indent + "  ")
        out.append(f"{indent}</{tag}>\n" if opened else "/>\n")

    def _reference(self, element: Any, name: str, target: Any, declared: Any, indent: str) -> None:
        file, fragment = self._place(element, name, target)
        kind = ""
        expected = getattr(declared, "eClass", declared)
        # EMF's own rule for references across files; pyecore calls EObject abstract, Ecore does not.
        if expected.abstract and target.eClass is not expected and expected.name != "EObject":
            self.typed = True
            kind = f' xsi:type="{self._qualified(target.eClass)}"'
        link = f"#{fragment}" if file == self.name else f"{quote(file)}#{fragment}"
        self.out.append(f'{indent}<{name}{kind} href="{link}"/>\n')

    def _place(self, element: Any, name: str, target: Any) -> tuple[str, str]:
        try:
            return self.places[id(target)]
        except KeyError:
            raise ModelError(
                f"{self.name}: {element!r}.{name} refers to {target!r}, which is in none of the models that are written",
                fix="add the target to a model that is saved with this one, or remove the reference",
            ) from None

    def _checked(self, element: Any, name: str, text: str) -> str:
        if bad := _FORBIDDEN.search(text):
            raise ModelError(
                f"{self.name}: {element!r}.{name} holds U+{ord(bad.group()):04X} at {bad.start()}, which XML cannot hold",
                fix="remove the character from the source",
            )
        return text

    def _escaped(self, element: Any, name: str, text: str) -> str:
        text = self._checked(element, name, text)
        return _SPECIAL.sub(lambda m: _ESCAPES[m.group()], text) if _SPECIAL.search(text) else text

    def _content(self, element: Any, name: str, text: str) -> str:
        text = self._checked(element, name, text)
        return _SPECIAL_TEXT.sub(lambda m: _ESCAPES.get(m.group(), "]]&gt;"), text) if _SPECIAL_TEXT.search(text) else text


def _text(value: Any, convert: Any) -> str:
    if value.__class__ is str:
        return str(value)
    if value.__class__ is bool:
        return "true" if value else "false"
    if value.__class__ is float:
        return _double(value)
    return str(convert(value))


def _double(value: float) -> str:
    """As Java's Double.toString prints it."""
    if value != value:
        return "NaN"
    if value in (float("inf"), float("-inf")):
        return "Infinity" if value > 0 else "-Infinity"
    if value == 0 or 1e-3 <= abs(value) < 1e7:
        plain = repr(value)
        return plain if "e" not in plain else f"{value:.20f}".rstrip("0")
    mantissa, _, exponent = f"{value!r}".partition("e")
    digits = repr(value) if exponent == "" else mantissa
    sign, digits = ("-", digits[1:]) if digits[0] == "-" else ("", digits)
    whole, _, fraction = digits.partition(".")
    power = int(exponent or 0) + len(whole) - 1
    figures = (whole + fraction).rstrip("0") or "0"
    stripped = figures.lstrip("0")
    power -= len(figures) - len(stripped)
    return f"{sign}{stripped[0]}.{stripped[1:] or '0'}E{power}"
