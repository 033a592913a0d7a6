"""The rarer cases of reading an XMI file: named types, ids, values in elements, and errors in these.

`xmi_parser` calls `Builder` for everything off its fast path; it uses plans and documents, and of the parser only the current
line.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from robosmi.errors import did_you_mean
from robosmi.model.ecore import DynamicEObject
from robosmi.model.features import class_in, class_names
from robosmi.model.lean import BARE, AttributeValue, ContainedValue, ReferenceValue, collection, holder
from robosmi.model.pyecore_internals import CONTAINER, CONTAINING_FEATURE, IDENTITY, add_silently, key_of
from robosmi.model.xmi_document import XMI_NAMESPACES, Document, PackageOf, Problem
from robosmi.model.xmi_plan import (
    CHILD,
    CHILDREN,
    IGNORED,
    REFUSED,
    VALUE,
    VALUES,
    XMI,
    XMI_ID,
    XSI,
    ClassPlan,
    FeatureEntry,
    Plans,
)

if TYPE_CHECKING:
    from robosmi.model.ecore import Slots


class Builder:
    """The state of reading one file, and the handling of rare cases.

    Args:
        path: the file.
        plans: the plans of this load.
        package_of: finds a package by its namespace.
        problem: is told line and text of every problem.
    """

    def __init__(self, path: Path, plans: Plans, package_of: PackageOf, problem: Problem) -> None:
        self.document = Document(path)
        self.plans = plans
        self.package_of = package_of
        self.problem = problem
        self.expat: Any = None
        self.prefixes: dict[str, list[str]] = {}
        self.types: dict[str, ClassPlan | None] = {}
        self.xmi = XMI

    def skip(self) -> None:
        """Pass over everything up to the end of the current element."""
        raise NotImplementedError

    def contain(
        self, element: DynamicEObject, slots: Slots, entry: FeatureEntry, child: DynamicEObject, child_slots: Slots
    ) -> None:
        """Put a child into a feature that takes one."""
        feature = entry.feature
        if entry.many:
            if entry.key not in slots:
                slots[entry.key] = collection(element, feature)
            add_silently(slots[entry.key], child)
        elif entry.key in slots:
            self.here(f"{type(element).__name__}.{feature.name} takes one element, not two")
            return
        else:
            slots[entry.key] = holder(ContainedValue, element, feature, child)
        child_slots[CONTAINER] = element
        child_slots[CONTAINING_FEATURE] = feature
        if entry.back is None:
            child_slots["_birth"] = (element, feature)
        else:
            child_slots[key_of(entry.back)] = holder(ReferenceValue, child, entry.back, element)

    def here(self, text: str) -> None:
        """Note a problem at the current line."""
        self.problem(self.expat.CurrentLineNumber, text)

    def child_plan(self, entry: FeatureEntry, attributes: dict[str, str]) -> ClassPlan | None:
        """The plan of a contained element: of the type that the file names, else of the declared one."""
        named = attributes.pop(f"{XSI}}}type", None) or attributes.pop(f"{self.xmi}}}type", None)
        if named is None:
            plan = self.plans.of(entry.declared)
        else:
            found = self.type_named(named)
            if found is None:
                self.skip()
                return None
            plan = found
            if not entry.takes(plan.cls):
                self.here(f"{named} is no {entry.declared.name}, which '{entry.feature.name}' takes")
                self.skip()
                return None
        if not self.usable(plan):
            return None
        if named is None:
            entry.plan = plan
        return plan

    def usable(self, plan: ClassPlan) -> bool:
        """Whether elements of the class can be made; if not the problem is noted and the element skipped."""
        if plan.abstract:
            self.here(f"{plan.name} is abstract: the element needs an xsi:type")
        elif plan.refused:
            self.here(plan.refused)
        else:
            return True
        self.skip()
        return False

    def type_named(self, qualified: str) -> ClassPlan | None:
        """The plan of the class with a qualified name, or None with the problem noted."""
        if qualified in self.types:
            return self.types[qualified]
        prefix, _, name = qualified.strip().rpartition(":")
        uris = self.prefixes.get(prefix)
        package = self.package_of(uris[-1]) if uris else None
        eclass = class_in(package, name)
        if eclass is None:
            near = did_you_mean(name, class_names(package)) if package is not None else ""
            self.here(f"'{qualified}' is no class of a metamodel known here{near}")
            return None
        plan = self.types[qualified] = self.plans.of(eclass)
        return plan

    def other_attribute(self, plan: ClassPlan, entries: dict[str, FeatureEntry], name: str, text: str) -> str | None:
        """An attribute that is no feature under its full name. Gives the URI of an element that lies elsewhere."""
        if name == "href":
            return text
        namespace, _, local = name.rpartition("}")
        if namespace == XSI or XMI_NAMESPACES.fullmatch(namespace):
            if local == "id" and namespace != XSI:
                self.here(f"the id '{text}' is in the namespace {namespace}, which is not supported: use {XMI}")
            elif local == "idref":
                return f"#{text}"
            return None
        near = did_you_mean(local, [n for n in entries if "}" not in n])
        self.here(f"{plan.name} has no feature '{local}'{near}")
        return None

    def rare_attribute(
        self, child: DynamicEObject, slots: Slots, plan: ClassPlan, entry: FeatureEntry, name: str, text: str
    ) -> None:
        """Read an XML attribute that is no reference and no single value: an xmi:id, a list of values, one that is refused."""
        if entry.kind == XMI_ID:
            slots[IDENTITY] = text
            self.identify(text, child)
        elif entry.kind == VALUES:
            for part in text.split():
                self.add_value(child, slots, plan.name, entry, part)
        elif entry.kind == REFUSED:
            self.here(entry.message)
        elif entry.kind != IGNORED:
            self.here(f"{plan.name}.{name} contains elements: it cannot be an attribute")

    def identify(self, text: str, child: DynamicEObject) -> None:
        """Note an element's id."""
        if self.document.ids.setdefault(text, child) is not child:
            self.here(f"the id '{text}' is used twice")

    def add_value(self, element: DynamicEObject, slots: Slots, owner: str, entry: FeatureEntry, text: str | None) -> None:
        """Set a value, or add one to many; None is xsi:nil."""
        try:
            value = text if text is None or entry.convert is None else entry.convert(text)
        except ValueError as error:
            self.here(f"{owner}.{entry.feature.name}: {error}")
            return
        if entry.kind == VALUE:
            if entry.key in slots:
                self.here(f"{owner}.{entry.feature.name} takes one value, not two")
            lies_bare = entry.bare and value.__class__ in BARE
            slots[entry.key] = value if lies_bare else holder(AttributeValue, element, entry.feature, value)
            if entry.is_id and text:
                self.identify(text, element)
            return
        many = slots.get(entry.key)
        if many is None:
            many = slots[entry.key] = collection(element, entry.feature)
        if not add_silently(many, value):
            self.here(f"{owner}.{entry.feature.name} takes each value once: '{text}' is there already")

    def part_elsewhere(self, element: DynamicEObject, entry: FeatureEntry, link: str) -> None:
        """Note a contained element that lies in another file."""
        if element is None or entry.kind not in (CHILD, CHILDREN):
            self.here("a root cannot lie in another file")
            return
        held = element.__dict__.get(entry.key)
        place = len(held) if held is not None and entry.many else 0
        place += sum(1 for owner, other, *_ in self.document.parts if owner is element and other is entry)
        self.document.parts.append((element, entry, link, self.expat.CurrentLineNumber, place))
