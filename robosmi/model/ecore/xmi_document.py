"""The data that the parts of the XMI reader share: documents, what is odd in them, and the reasons why a file is no document.

A document contains the elements of one file and the list of what is still unresolved. Nothing is read or resolved here.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Set
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from msgspec import Struct

from robosmi.diagnostics import MORE, Finding, Location, Severity
from robosmi.errors import ModelError
from robosmi.model.elements.ecore import DynamicEObject, EObject, Package
from robosmi.model.elements.fragments import own_id
from robosmi.model.elements.xmi_plan import ClassPlan, FeatureEntry

if TYPE_CHECKING:
    from robosmi.base.data_text import Json

NO_MODEL = "give a model in XMI"
"""The advice for a file that is no model."""
Problem = Callable[[int, str], None]
Foreign = Callable[[int, str, str], None]
PackageOf: TypeAlias = "Callable[[str], Package | None]"
"""Namespace URI -> EPackage or generated module, or None."""

XMI_NAMESPACES = re.compile(r"http://(www\.omg\.org/XMI|(schema|www)\.omg\.org/(spec/)?XMI(/[0-9.]+)?)")
"""The namespaces that XMI itself has had."""


class Unreadable(Exception):
    """The file cannot be read as a model at all.

    Args:
        text: why.
        line: where.
        fix: what to do.
        namespace: that of its root if no metamodel has it.
        sure_to: the last line up to which other problems of the file are none of this one's; None for all.
    """

    def __init__(self, text: str, line: int, fix: str = NO_MODEL, namespace: str = "", sure_to: int | None = None) -> None:
        super().__init__(text)
        self.text = text
        self.line = line
        self.fix = fix
        self.namespace = namespace
        self.sure_to = sure_to


class UnknownEncoding(Unreadable):
    """The file says an encoding that the XML parser does not know."""


class ForeignRoot(Exception):
    """The file's root is no model element of the user's: it is an Ecore metamodel."""


class Document(Struct):
    """One file as it was read.

    Attributes:
        path: absolute.
        roots: the root elements.
        ids: xmi:id or value of the ID attribute -> element, the first one of several.
        shared_ids: ids of several elements -> the line of the second.
        references: element, entry, URIs, line, whether the text is one URI: what is still to be linked.
        parts: container, entry, URI, line, place among its siblings of contained elements that lie in other files.
        counted: elements whose class bounds the number of values, with their lines.
        schema_locations: namespaces and the places of their metamodels (xsi:schemaLocation), as the file has them.
        prefixes: namespace prefixes -> the first namespace of each.
        named: the URIs of elements that lie elsewhere -> the qualified names of their types that stand before them.
        types: the URIs of elements that lie elsewhere -> the Python classes that the file names for them.
        findings: what is odd in the files that were read together; of the first one only.
        digest: that of its bytes.
        has_more: whether the file has parts that are not in the model.
        unsupported: whether it has elements of a class that is right, and that cannot be read.
    """

    path: Path
    roots: list[DynamicEObject] = []
    ids: dict[str, DynamicEObject] = {}
    shared_ids: dict[str, int] = {}
    references: list[tuple[EObject, FeatureEntry, str, int, bool]] = []
    parts: list[tuple[EObject, FeatureEntry, str, int, int]] = []
    counted: list[tuple[EObject, ClassPlan, int]] = []
    schema_locations: list[tuple[str, str]] = []
    prefixes: dict[str, str] = {}
    named: dict[str, str] = {}
    types: dict[str, type] = {}
    findings: list[Finding] = []
    digest: str = ""
    has_more: bool = False
    unsupported: bool = False


Oddity = tuple[Location, str, "str | None"]
"""Its place, its text, the id of its element."""


class Oddities:
    """What is odd in files that were read all the same: one finding of each kind, whose evidence lists all places."""

    def __init__(self) -> None:
        self._kinds: dict[tuple[str, tuple[str, ...]], tuple[str, Severity, list[Oddity]]] = {}

    def add(
        self,
        rule: str,
        kind: tuple[str, ...],
        place: Location,
        text: str,
        fix: str,
        severity: Severity = Severity.warning,
        element: EObject | None = None,
    ) -> None:
        """Note one; the element is that which has it."""
        known = self._kinds.setdefault((rule, kind), (fix, severity, []))
        identity = None
        if element is not None:
            with suppress(ModelError):  # the attribute is derived, and no code computes it
                identity = own_id(element)
        known[2].append((place, text, identity))

    def drop(self, rule: str, kinds: Set[tuple[str, ...]], gone: Set[tuple[Location, str]]) -> None:
        """Forget those of these kinds, places and texts, which are no longer so."""
        for kind in kinds:
            _, _, same = self._kinds.get((rule, kind), ("", Severity.warning, []))
            same[:] = [each for each in same if each[:2] not in gone]
            if not same:
                self._kinds.pop((rule, kind), None)

    def kinds(self) -> list[tuple[str, tuple[str, ...]]]:
        """The rules and kinds of which there is one."""
        return list(self._kinds)

    def drop_kind(self, rule: str, kind: tuple[str, ...]) -> None:
        """Forget all of a kind."""
        self._kinds.pop((rule, kind), None)

    def findings(self) -> list[Finding]:
        """One of each kind, in the order in which they were met."""
        made = []
        for (rule, _), (fix, severity, same) in self._kinds.items():
            place, text, element = same[0]
            more: dict[str, Json] = {}
            if len(same) > 1:
                text = f"{text} (and {len(same) - 1} more of this kind)"
                more[MORE] = [{"location": at.to_json(), "element": one, "message": said} for at, said, one in same[1:]]
            made.append(Finding(rule, severity, text, place, element, fix, more))
        return made
