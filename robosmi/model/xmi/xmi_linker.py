"""References of files that were just read: URIs to elements, both sides of opposites, parts that lie in other files.

Works on documents of `xmi_parser` when all elements exist. Values go straight into pyecore's slots; where a file gives only
one side of an opposite, the other is completed, and where its two sides contradict each other that is a problem. Opening
files is `xmi_reader`'s part.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias
from urllib.parse import unquote

from robosmi.model.ecore.xmi_document import Document
from robosmi.model.elements import compact_slots, ecore
from robosmi.model.elements.compact_slots import ContainedValue, ReferenceValue, collection, new_slot
from robosmi.model.elements.ecore import DynamicEObject, ENamedElement, EObject, Package
from robosmi.model.elements.feature_values import FeatureOrderedSet
from robosmi.model.elements.features import as_package
from robosmi.model.elements.proxies import preserve_link
from robosmi.model.elements.pyecore_internals import (
    add_silently,
    contain,
    container_of,
    fill_ordered_set,
    fill_silently,
    is_value,
    key_of,
    target_in,
)
from robosmi.model.elements.xmi_plan import FeatureEntry
from robosmi.model.xmi.xmi_locations import shown

Problem = Callable[[Document, int, str], None]
Missing: TypeAlias = "Callable[[Document, str, int, EObject, FeatureEntry, str], DynamicEObject | None]"
"""Document, URI, line, owner and feature of a reference, what it does instead of leading to an element; empty if that was
reported already -> what stands for its target."""
Preserves: TypeAlias = "Callable[[Document, str, EObject, FeatureEntry, EObject], bool]"
"""Document, URI, owner and feature of a reference, what it leads to."""
Where: TypeAlias = "Document | Package"
Open: TypeAlias = "Callable[[Document, str, int], Where | None]"
"""Document, the file part of a URI, line -> the document or package there, or None with the problem noted."""

LEADS_NOWHERE = "leads to nothing"
_KEYS = re.compile(r"@([^\[]+)\[(.*)\]")
_KEY = re.compile(r"([^=,]+)='([^']*)'")
_TYPE = re.compile(r"[^\s:#/]+:[^\s:#/]+")


class XmiLinker:
    """Resolves what the documents of one load refer to.

    Args:
        open_file: finds the document or package that a URI's file part names.
        problem: receives document, line and text of every problem.
        missing: gives what stands for a target that is not there; None if that is a problem.
        preserves: says of a target that was found in another file whether the text of the link is kept.
    """

    def __init__(
        self, open_file: Open, problem: Problem, missing: Missing | None = None, preserves: Preserves | None = None
    ) -> None:
        self.open_file = open_file
        self.problem = problem
        self.missing = missing
        self.preserves = preserves
        self._found: dict[int, dict[str, DynamicEObject]] = {}
        self._kept: set[tuple[int, int]] = set()
        """Elements and targets of theirs whose links are kept."""
        self._two_sided: list[tuple[Document, int, EObject, FeatureEntry, list[EObject]]] = []

    def contain(self, document: Document) -> None:
        """Put the parts of a document that lie in other files into their containers, and open all files that it refers to.

        References may lead through such parts, so this comes first for all documents.
        """
        self._found.setdefault(id(document), {})
        for owner, entry, link, line, place in document.parts:
            self._contain(document, owner, entry, link, line, place)
        for _, _, text, line, whole in document.references:
            if "#" in text and text not in document.ids:
                for link in [text] if whole else self._several(document, text):
                    file = link.partition("#")[0] if "#" in link else ""
                    if file:
                        self.open_file(document, file, line)

    def link(self, document: Document) -> None:
        """Resolve the references of a document; `finish` must follow when all documents are linked."""
        found, ids, waiting = self._found[id(document)], document.ids, document.references
        waiting.reverse()
        while waiting:  # each is let go at once: those of a large model take as much memory as its elements
            owner, entry, text, line, whole = waiting.pop()
            if not entry.many:
                target = ids.get(text) or found.get(text)
                if target is None:
                    links = [text] if whole else self._one(document, text)
                    if len(links) > 1:
                        self._wrong(document, line, owner, entry, f"takes one element, not {len(links)}")
                    target = self.target(document, links[0], line, owner, entry) if links else None
                    if target is None:
                        continue
                if target.__class__ not in entry.accepted and not entry.takes(target.__class__):
                    self._wrong(document, line, owner, entry, _not_taken(entry, target))
                    continue
                self._set(document, line, owner, entry, target)
                continue
            targets: list[EObject] = []
            for link in [text] if whole else self._several(document, text):
                target = ids.get(link) or found.get(link)
                if target is None and (target := self.target(document, link, line, owner, entry)) is None:
                    continue
                if target.__class__ not in entry.accepted and not entry.takes(target.__class__):
                    self._wrong(document, line, owner, entry, _not_taken(entry, target))
                else:
                    targets.append(target)
            self._add(document, line, owner, entry, targets)

    def _wrong(self, document: Document, line: int, owner: EObject, entry: FeatureEntry, text: str) -> None:
        self.problem(document, line, f"{type(owner).__name__}.{entry.feature.name} {text}")

    def _one(self, document: Document, text: str) -> list[str]:
        """The URI of a single reference: an id may hold spaces, a type may stand before a URI of another file."""
        if text in document.ids:
            return [text]
        return self._without_types(document, text.split())

    def _several(self, document: Document, text: str) -> list[str]:
        parts = text.split()
        return parts if ":" not in text else self._without_types(document, parts)

    @staticmethod
    def _without_types(document: Document, parts: list[str]) -> list[str]:
        """The URIs; the type that may stand before one is noted."""
        found: list[str] = []
        named = ""
        for part in parts:
            if len(parts) > 1 and part not in document.ids and _TYPE.fullmatch(part):
                named = part
                continue
            if named:
                document.named.setdefault(part, named)
                named = ""
            found.append(part)
        return found

    # --- URIs

    def target(self, document: Document, link: str, line: int, owner: EObject, entry: FeatureEntry) -> DynamicEObject | None:
        """The element that a URI leads to, or None with the problem noted."""
        found: DynamicEObject | None = None
        if link in document.ids:
            found = document.ids[link]
        elif "#" in link and not link.startswith("#"):
            file, _, fragment = link.partition("#")
            where = self.open_file(document, file, line)
            if where is None:
                return self._missing(document, link, line, owner, entry, "")
            found = resolve(where, fragment)
            if found is not None and self.preserves is not None and self.preserves(document, link, owner, entry, found):
                self._kept.add((id(owner), id(found)))
        else:
            found = resolve(document, link.removeprefix("#"))
        if found is None and self.missing is not None:
            return self._missing(document, link, line, owner, entry, LEADS_NOWHERE)
        if found is None:
            self.problem(document, line, f"{type(owner).__name__}.{entry.feature.name}: '{link}' {LEADS_NOWHERE}")
        elif "#" not in link:
            self._found[id(document)][link] = found
        return found

    def _missing(
        self, document: Document, link: str, line: int, owner: EObject, entry: FeatureEntry, why: str
    ) -> DynamicEObject | None:
        found = None if self.missing is None else self.missing(document, link, line, owner, entry, why)
        if found is not None:
            self._kept.add((id(owner), id(found)))
        return found

    # --- values

    def _set(self, document: Document, line: int, owner: EObject, entry: FeatureEntry, target: EObject) -> None:
        slots = owner.__dict__
        slot = slots.get(entry.key)
        if slot is not None and target_in(slot) is not None and target_in(slot) is not target:
            self._wrong(document, line, owner, entry, "takes one element, not two")
            return
        slots[entry.key] = new_slot(ReferenceValue, owner, entry.feature, target)
        if entry.back is None:
            compact_slots.note_link(target, (owner, entry.feature))
        else:
            other = target.__dict__.get(key_of(entry.back))  # a file that EMF wrote has both sides; looked at without a call
            if not (other.__class__ is FeatureOrderedSet and owner in other.map):
                self._two_sided.append((document, line, owner, entry, [target]))

    def _add(self, document: Document, line: int, owner: EObject, entry: FeatureEntry, targets: list[EObject]) -> None:
        slots = owner.__dict__
        many = slots.get(entry.key)
        if many is None:
            many = slots[entry.key] = collection(owner, entry.feature)
        if entry.back is not None:
            if many.__class__ is FeatureOrderedSet and not many.items:
                fill_ordered_set(many, targets)
            else:
                for target in targets:
                    add_silently(many, target)
            self._two_sided.append((document, line, owner, entry, targets))
            return
        for target in targets:
            if add_silently(many, target):
                compact_slots.note_link(target, (owner, entry.feature))

    @staticmethod
    def has_target(owner: EObject, entry: FeatureEntry, target: EObject) -> bool:
        """Whether an element refers to another one by a feature."""
        slot = owner.__dict__.get(entry.key)
        if slot is None or not entry.many:
            return slot is not None and target_in(slot) is target
        return any(each is target for each in slot)

    def replace(self, document: Document, line: int, owner: EObject, entry: FeatureEntry, proxy: EObject, found: EObject) -> bool:
        """Put an element in the place of the proxy that stands for it, if it fits; `finish` must follow."""
        if not entry.takes(found.__class__):
            return False
        if entry.back is not None and not entry.back.many:
            slot = found.__dict__.get(key_of(entry.back))
            if slot is not None and target_in(slot) not in (None, owner):
                return False
        if entry.many:
            many = owner.__dict__[entry.key]
            items = [found if each is proxy else each for each in many]
            fill_silently(many, list(dict.fromkeys(items)) if many.__class__ is FeatureOrderedSet else items)
        else:
            owner.__dict__[entry.key] = new_slot(ReferenceValue, owner, entry.feature, found)
        self._kept.add((id(owner), id(found)))
        if entry.back is None:
            compact_slots.note_link(found, (owner, entry.feature))
        else:
            self._two_sided.append((document, line, owner, entry, [found]))
        return True

    def finish(self) -> None:
        """Make both sides of all opposites agree."""
        two_sided, self._two_sided = self._two_sided, []
        for document, line, owner, entry, targets in two_sided:
            back = entry.back
            if back is None:
                continue
            key, many = key_of(back), back.many
            for target in targets:
                slot = target.__dict__.get(key)
                if slot.__class__ is ReferenceValue:
                    if target_in(slot) is owner:  # a file that EMF wrote has both sides
                        continue
                elif slot.__class__ is FeatureOrderedSet and owner in slot.map:
                    continue
                if many:
                    if slot is None:
                        slot = target.__dict__[key] = collection(target, back)
                    if add_silently(slot, owner) and (id(owner), id(target)) in self._kept:
                        preserve_link(target, key, owner, None, True)  # the target's own file does not say it
                elif slot is None or target_in(slot) is None:
                    target.__dict__[key] = new_slot(ReferenceValue, target, back, owner)
                    if (id(owner), id(target)) in self._kept:
                        preserve_link(target, key, owner, None, True)
                elif target_in(slot) is not owner:
                    other = shown(target_in(slot))
                    self._wrong(
                        document, line, owner, entry, f"is {shown(target)}, whose opposite '{back.name}' is {other} already"
                    )

    def _contain(self, document: Document, owner: EObject, entry: FeatureEntry, link: str, line: int, place: int) -> None:
        """Put a root of another file, or an element of this one, into the feature that contains it by a reference."""
        part: EObject | None = self.target(document, link, line, owner, entry)
        if part is None:
            return
        if not entry.takes(part.__class__):
            self._wrong(document, line, owner, entry, _not_taken(entry, part))
            return
        if _is_inside(owner, part):
            why = f"would make {shown(part)} contain itself"
            if self.missing is None:
                self._wrong(document, line, owner, entry, why)
            if (part := self._missing(document, link, line, owner, entry, why)) is None:
                return
        if container_of(part) is not None:
            self._wrong(document, line, owner, entry, f"takes {shown(part)}, which is contained elsewhere already")
            return
        slots = owner.__dict__
        if not entry.many:
            if entry.key in slots:
                self._wrong(document, line, owner, entry, "takes one element, not two")
                return
            slots[entry.key] = new_slot(ContainedValue, owner, entry.feature, part)
        else:
            if entry.key not in slots:
                slots[entry.key] = collection(owner, entry.feature)
            add_silently(slots[entry.key], part)
            _move(slots[entry.key], place)
        contain(part, owner, entry.feature)
        if entry.back is None:
            compact_slots.note_link(part, (owner, entry.feature))
        else:
            part.__dict__[key_of(entry.back)] = new_slot(ReferenceValue, part, entry.back, owner)


def _is_inside(element: EObject, other: EObject) -> bool:
    """Whether an element is another one or is contained in it, however deep."""
    above: EObject | None = element
    while above is not None and above is not other:
        above = container_of(above)
    return above is not None


def _move(many: Any, place: int) -> None:
    """Move the last value of a collection to its index."""
    items = list(many)
    items.insert(place, items.pop())
    fill_silently(many, items)


# --- fragments


def resolve(where: Where | EObject, fragment: str) -> Any:
    """The element at an EMF fragment of a document, a package or a model with one root, or None.

    Fragments are ids (`_x1`), paths (`//@units.0/@body`, `/1/@units.0`) or, in metamodels, names (`//Class/feature`).
    """
    if isinstance(where, Document):
        if fragment in where.ids:
            return where.ids[fragment]
        if not fragment.startswith("/"):
            return where.ids.get(unquote(fragment))
        roots: Sequence[EObject] = where.roots
    else:
        roots = [where if isinstance(where, ecore.EObject) else as_package(where)]
    first, *steps = fragment[1:].split("/")
    if first.startswith("?") and isinstance(where, Document):
        element: EObject | None = where.ids.get(first[1:])
    elif first and not (first.isascii() and first.isdecimal()):
        return None
    else:
        index = int(first or 0)
        element = roots[index] if index < len(roots) else None
    for step in steps:
        if element is None:
            return None
        element = _step(element, step)
    return element


def _step(element: EObject, step: str) -> EObject | None:
    if step[:1] != "@":
        return _by_name(element, step) if isinstance(element, ecore.EModelElement) else None
    name, _, index = step[1:].partition(".")
    slot = element.__dict__.get(name)
    if slot is not None and not isinstance(slot, compact_slots.AttributeValue) and index.isascii() and index.isdecimal():
        try:
            items = slot if isinstance(slot, list) else slot.items
            found: DynamicEObject = items[int(index)]
            return found
        except (AttributeError, IndexError):
            return None
    if slot is None and (keys := _KEYS.fullmatch(step)):
        return _by_keys(element, keys[1], {key[1]: key[2] for key in _KEY.finditer(keys[2])})
    value = target_in(slot) if not index and is_value(slot) else None
    return value if isinstance(value, ecore.EObject) else None


def _by_keys(element: EObject, name: str, wanted: dict[str, str]) -> DynamicEObject | None:
    """The element of a collection whose key attributes have these texts (`@items[name='a']`)."""
    one: DynamicEObject
    for one in element.__dict__.get(name, ()):
        if wanted and all(str(getattr(one, key, None)) == unquote(text) for key, text in wanted.items()):
            return one
    return None


def _by_name(element: EObject, name: str) -> EObject | None:
    """The part of a metamodel element with that name."""
    parts: list[ENamedElement] = []
    for feature in ("eClassifiers", "eSubpackages", "eStructuralFeatures", "eOperations", "eLiterals", "eParameters"):
        parts.extend(getattr(element, feature, ()))
    texts = (name, unquote(name))
    return next((part for part in parts if part.name in texts), None)


def _not_taken(entry: FeatureEntry, target: EObject) -> str:
    """Why a target does not fit; classes of one name differ in their namespaces, as two versions of a metamodel do."""
    expected, given = entry.declared, target.eClass
    names = [str(expected.name), str(given.name)]
    if names[0] == names[1]:
        names = [f"{kind.name} of '{as_package(kind.ePackage).nsURI}'" for kind in (expected, given)]
    return f"does not take {shown(target)}: it takes {names[0]}, not {names[1]}"
