"""Parses one XMI file into elements in a single pass with expat, using a stack of its own and none of pyecore's setters.

Contained elements are built at once; references are recorded for `xmi_reader`. Problems are recorded with their lines, and the
rest of the file is read. A DOCTYPE, and with it every entity, is refused; comments and processing instructions are skipped. The
caller looks up packages.

`_Parser` has the fast path. `Builder` handles the rarer cases: named types, ids, values in elements, and errors in these; of the
parser it knows only the current line.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.parsers import expat

from robosmi.errors import did_you_mean
from robosmi.model.ecore.ecore_xml import fault_of
from robosmi.model.ecore.xmi_document import (
    NO_MODEL,
    XMI_NAMESPACES,
    Document,
    Foreign,
    ForeignRoot,
    PackageOf,
    Problem,
    UnknownEncoding,
    Unreadable,
)
from robosmi.model.elements import ecore
from robosmi.model.elements.compact_slots import (
    UNBOXED_TYPES,
    AttributeValue,
    ContainedValue,
    ReferenceValue,
    collection,
    new_slot,
)
from robosmi.model.elements.datatypes import ECORE_URI
from robosmi.model.elements.ecore import DynamicEObject
from robosmi.model.elements.features import class_in, class_names, is_of_ecore
from robosmi.model.elements.proxies import proxy_uri
from robosmi.model.elements.pyecore_internals import CONTAINER, CONTAINING_FEATURE, IDENTITY, add_silently, key_of, value_in
from robosmi.model.elements.xmi_plan import (
    CHILD,
    CHILDREN,
    IGNORED,
    REFERENCE,
    REFUSED,
    ROOT,
    VALUE,
    VALUES,
    XMI,
    XMI_ID,
    XSI,
    ClassPlan,
    FeatureEntry,
    Plans,
    renaming,
)
from robosmi.model.xmi.xml_characters import may_contain_escapes, restored, restoring

if TYPE_CHECKING:
    from robosmi.model.elements.ecore import EClass, Slots


class Builder:
    """The state of reading one file, and the handling of rare cases.

    Args:
        path: the file.
        plans: the plans of this load.
        package_of: finds a package by its namespace.
        problem: receives line and text of every problem.
        foreign, illegal: as for `parse`.
    """

    def __init__(
        self, path: Path, plans: Plans, package_of: PackageOf, problem: Problem, foreign: Foreign | None, illegal: Foreign | None
    ) -> None:
        self.tells_foreign = foreign is not None
        self.foreign: Foreign = foreign or (lambda line, text, _: problem(line, text))
        self.illegal: Foreign = illegal or (lambda line, feature, text: problem(line, f"{feature}: {text}"))
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
            slots[entry.key] = new_slot(ContainedValue, element, feature, child)
        child_slots[CONTAINER] = element
        child_slots[CONTAINING_FEATURE] = feature
        if entry.back is None:
            child_slots["_birth"] = (element, feature)
        else:
            child_slots[key_of(entry.back)] = new_slot(ReferenceValue, child, entry.back, element)

    def at(self) -> int:
        """The current line."""
        return int(self.expat.CurrentLineNumber)

    def here(self, text: str) -> None:
        """Note a problem at the current line."""
        self.problem(self.at(), text)

    def apart(self, text: str, namespace: str = "") -> None:
        """Note what is not in the model, at the current line."""
        self.foreign(self.at(), text, namespace)

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
        if plan.abstract and self.tells_foreign and (missing := proxy_uri(plan.eclass)) is not None:
            self.apart(f"an element is of '{missing}', which is not there", missing)
        elif plan.abstract:
            self.here(f"{plan.name} is abstract: the element needs an xsi:type")
        elif plan.refused and is_of_ecore(plan.eclass):  # in annotations of other models, as a profile's definition is
            self.apart(plan.refused)
        elif plan.refused:
            self.here(plan.refused)
            self.document.unsupported = True
        else:
            return True
        self.skip()
        return False

    def known_type(self, qualified: str) -> ClassPlan | None:
        """The plan of the class with a qualified name, or None."""
        if qualified not in self.types:
            prefix, _, name = qualified.strip().rpartition(":")
            uris = self.prefixes.get(prefix)
            eclass = class_in(self.package_of(uris[-1]) if uris else None, name)
            self.types[qualified] = None if eclass is None else self.plans.of(eclass)
        return self.types[qualified]

    def type_named(self, qualified: str) -> ClassPlan | None:
        """The plan of the class with a qualified name, or None with the problem noted."""
        plan = self.known_type(qualified)
        if plan is None:
            prefix, _, name = qualified.strip().rpartition(":")
            uris = self.prefixes.get(prefix)
            package = self.package_of(uris[-1]) if uris else None
            if package is None and uris:
                self.apart(
                    f"'{qualified}' is no class of a metamodel known here: nobody has the namespace '{uris[-1]}'", uris[-1]
                )
                return None
            near = did_you_mean(name, class_names(package)) if package is not None else ""
            self.here(f"'{qualified}' is no class of a metamodel known here{near}")
        return plan

    def other_attribute(self, plan: ClassPlan, entries: dict[str, FeatureEntry], name: str, text: str) -> str | None:
        """An attribute that is no feature under its full name. Gives the URI of an element that lies elsewhere."""
        if name == "href":
            return text
        namespace, _, local = name.rpartition("}")
        if namespace == XSI or XMI_NAMESPACES.fullmatch(namespace):
            return f"#{text}" if local == "idref" else None
        if namespace and self.package_of(namespace) is None:
            self.apart(f"the attribute '{local}' is of the namespace '{namespace}'", namespace)
            return None
        self.no_feature(plan.eclass, local, entries)
        return None

    def no_feature(self, eclass: EClass, name: str, entries: Collection[str]) -> bool:
        """Note a name that is no feature of a class; gives whether it may be one of a supertype whose file is not there."""
        missing = next((uri for one in eclass.eAllSuperTypes() if (uri := proxy_uri(one)) is not None), None)
        if missing is not None and self.tells_foreign:
            self.apart(f"'{name}' of a {eclass.name} may be a feature of '{missing}', which is not there", missing)
            return True
        self.here(f"{eclass.name} has no feature '{name}'{did_you_mean(name, [each for each in entries if '}' not in each])}")
        return False

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
            self.apart(entry.message)
        elif entry.kind != IGNORED:
            self.here(f"{plan.name}.{name} contains elements: it cannot be an attribute")

    def identify(self, text: str, child: DynamicEObject) -> None:
        """Note an element's id."""
        if self.document.ids.setdefault(text, child) is not child:
            self.document.shared_ids.setdefault(text, self.at())

    def add_value(self, element: DynamicEObject, slots: Slots, owner: str, entry: FeatureEntry, text: str | None) -> bool:
        """Set a value, or add one to many; None is xsi:nil. Gives whether its type takes it."""
        try:
            value = text if text is None or entry.convert is None else entry.convert(text)
        except ValueError as error:
            self.illegal(self.at(), f"{owner}.{entry.feature.name}", str(error))
            return False
        if entry.kind == VALUE:
            if entry.key in slots:
                self.here(f"{owner}.{entry.feature.name} takes one value, not two")
            lies_bare = entry.bare and value.__class__ in UNBOXED_TYPES
            slots[entry.key] = value if lies_bare else new_slot(AttributeValue, element, entry.feature, value)
            if entry.is_id and text:
                self.identify(text, element)
            return True
        many = slots.get(entry.key)
        if many is None:
            many = slots[entry.key] = collection(element, entry.feature)
        if not add_silently(many, value):
            self.here(f"{owner}.{entry.feature.name} takes each value once: '{text}' is there already")
        return True

    def add_pair(self, element: DynamicEObject, slots: Slots, entry: FeatureEntry, attributes: dict[str, str]) -> None:
        """Add a pair of texts to the details of an annotation."""
        pairs: Any = {}
        if entry.key in slots:
            pairs = value_in(slots[entry.key])
        else:
            slots[entry.key] = new_slot(AttributeValue, element, entry.feature, pairs)
        pairs[attributes.get("key")] = attributes.get("value")
        self.skip()

    def external_part(self, element: DynamicEObject, entry: FeatureEntry, link: str, cls: type) -> None:
        """Note a contained element that lies in another file."""
        self.document.types[link] = cls
        if element is None or entry.kind not in (CHILD, CHILDREN):
            self.here("a root cannot lie in another file")
            return
        held = element.__dict__.get(entry.key)
        place = len(held) if held is not None and entry.many else 0
        place += sum(1 for owner, other, *_ in self.document.parts if owner is element and other is entry)
        self.document.parts.append((element, entry, link, self.at(), place))


_DECLARED = re.compile(rb"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([A-Za-z][A-Za-z0-9._-]*)["']""")


def parse(
    path: Path,
    data: bytes,
    plans: Plans,
    package_of: PackageOf,
    locations: Callable[[str], None],
    problem: Problem,
    foreign: Foreign | None = None,
    illegal: Foreign | None = None,
) -> Document:
    """Build the elements of one file.

    Args:
        path: the file, for the document.
        data: its bytes.
        plans: the plans of this load.
        package_of: finds a package by its namespace.
        locations: receives the value of xsi:schemaLocation before any package is asked for.
        problem: receives line and text of every problem.
        foreign: receives line, text and namespace of what is of a namespace that no metamodel has, or is computed (no
            namespace); a problem if None.
        illegal: receives line, feature and what is wrong with a value that its type does not take; a problem if None.

    Raises:
        Unreadable: it is no XML, or no element of it is a model's.
        ForeignRoot: its first root is an element of Ecore.
    """
    try:
        return _Parser(path, plans, package_of, problem, foreign, illegal).run(data, None, locations)
    except UnknownEncoding as error:  # Python knows more of them
        declared = _DECLARED.match(data)
        try:
            text = data.decode(declared[1].decode("ascii")) if declared else ""
        except (LookupError, UnicodeDecodeError):
            raise error from None
        return _Parser(path, plans, package_of, problem, foreign, illegal).run(text.encode(), "utf-8", locations)


class _Parser(Builder):
    """The state of one pass; the two handlers that are called for every element are closures in `run`."""

    locations: Callable[[str], None]
    depth = 0  # inside an element that is skipped, or inside the text of a feature
    escapes = several = False

    def run(self, data: bytes, encoding: str | None, locations: Callable[[str], None]) -> Document:
        """Parse.

        Raises:
            Unreadable, ForeignRoot: as `parse`.
        """
        self.locations, self.texts = locations, list[str]()
        self.expat = parser = expat.ParserCreate(encoding, namespace_separator="}")
        parser.buffer_text = True
        parser.StartNamespaceDeclHandler = self.declare
        parser.EndNamespaceDeclHandler = self.undeclare
        parser.StartDoctypeDeclHandler = self.doctype
        self.escapes = may_contain_escapes(data)
        self.start, self.end = self.handlers()
        if self.escapes:
            self.start = restoring(self.start)
        parser.StartElementHandler, parser.EndElementHandler = self.start, self.end
        parser.CharacterDataHandler = self.stray
        try:
            parser.Parse(data, True)
        except expat.ExpatError as error:
            if not data.strip():
                raise Unreadable("the file is empty", 1) from None
            text, fix, sure_to = fault_of(error, data, NO_MODEL, encoding)
            raise Unreadable(text, error.lineno, fix, sure_to=sure_to) from None
        except (LookupError, ValueError) as error:  # pyexpat on encodings that Python does not know, or that have no table
            if parser.StartElementHandler is not self.start or self.document.roots:
                raise
            raise UnknownEncoding(f"not well-formed XML: {error}", parser.CurrentLineNumber) from None
        return self.document

    def handlers(self) -> tuple[Callable[[str, dict[str, str]], None], Callable[[str], None]]:
        """What is called at the start and the end of every element; made for speed, so all names are local."""
        parser, references, counted = self.expat, self.document.references, self.document.counted
        new = self.plans.made
        container_key, feature_key = CONTAINER, CONTAINING_FEATURE
        other_child, child_plan, other_attribute = self.other_child, self.child_plan, self.other_attribute
        xsi_type, xmi_type = f"{XSI}}}type", f"{XMI}}}type"
        roots = self.document.roots
        stack: list[tuple[Any, Any, Any]] = []
        push, pop = stack.append, stack.pop
        element: Any = None
        slots: Any = None
        entries: dict[str, FeatureEntry] = {}

        def start(tag: str, attributes: dict[str, str]) -> None:
            nonlocal element, slots, entries
            entry = entries.get(tag)
            if entry is None or ((kind := entry.kind) != CHILDREN and kind != CHILD):
                plan, entry = other_child(element, slots, entries, tag, attributes)
                if plan is None:
                    if entry is not None:  # the element around all roots
                        push((element, slots, entries))
                    return
                kind = entry.kind
            elif (plan := entry.plan) is None or xsi_type in attributes or xmi_type in attributes:
                plan = child_plan(entry, attributes)
                if plan is None:
                    return
            child = new(plan.cls)
            child_slots = child.__dict__
            child_entries = plan.entries
            elsewhere = None
            for name, text in attributes.items():
                attribute = child_entries.get(name)
                if attribute is None:
                    elsewhere = other_attribute(plan, child_entries, name, text) or elsewhere
                elif (what := attribute.kind) == VALUE:
                    convert = attribute.convert
                    try:
                        value = text if convert is None else convert(text)
                    except ValueError as error:
                        self.illegal(parser.CurrentLineNumber, f"{plan.name}.{name}", str(error))
                        continue
                    lies_bare = attribute.bare and value.__class__ in UNBOXED_TYPES
                    child_slots[attribute.key] = value if lies_bare else new_slot(AttributeValue, child, attribute.feature, value)
                    if attribute.is_id:
                        self.identify(text, child)
                elif what == REFERENCE:
                    references.append((child, attribute, text, parser.CurrentLineNumber, False))
                else:
                    self.rare_attribute(child, child_slots, plan, attribute, name, text)
            if kind == CHILDREN and elsewhere is None:
                feature = entry.feature
                many = slots.get(entry.key)
                if many is None:
                    many = slots[entry.key] = collection(element, feature)
                items = many.items
                many.map[child] = len(items)
                items.append(child)
                child_slots[container_key] = element
                child_slots[feature_key] = feature
                back = entry.back
                if back is None:
                    child_slots["_birth"] = many.birth
                else:
                    child_slots[key_of(back)] = new_slot(ReferenceValue, child, back, element)
            elif elsewhere is not None:
                self.external_part(element, entry, elsewhere, plan.cls)
            elif kind == CHILD:
                self.contain(element, slots, entry, child, child_slots)
            else:
                roots.append(child)
            if plan.bounds and elsewhere is None:
                counted.append((child, plan, parser.CurrentLineNumber))
            push((element, slots, entries))
            element, slots, entries = child, child_slots, child_entries

        def end(tag: str) -> None:
            nonlocal element, slots, entries
            element, slots, entries = pop()

        return start, end

    def other_child(
        self, element: DynamicEObject, slots: Slots, entries: dict[str, FeatureEntry], tag: str, attributes: dict[str, str]
    ) -> tuple[ClassPlan | None, Any]:
        """A root, a value or reference in an element of its own, or a name that is no feature.

        Returns:
            The plan of the element to be built with its entry, or no plan: then the element is being passed over; with an
            entry all the same for the element around all roots.
        """
        if element is None:
            return self.root(tag, attributes)
        namespace, _, local = tag.rpartition("}")
        entry = entries.get(local)
        owner = type(element).__name__
        if entry is None or entry.kind == XMI_ID:
            if local == "Extension" and XMI_NAMESPACES.fullmatch(namespace):
                self.extension()
                self.skip()
                return None, None
            if namespace and not XMI_NAMESPACES.fullmatch(namespace) and self.package_of(namespace) is None:
                self.apart(f"'{local}' is of the namespace '{namespace}'", namespace)
            else:
                self.no_feature(type(element).eClass, local, entries)
            self.skip()
        elif entry.kind in (CHILD, CHILDREN):
            plan = self.child_plan(entry, attributes)
            return plan, entry if plan is not None else None
        elif entry.kind in (IGNORED, REFUSED):
            if entry.message:
                self.apart(entry.message)
            self.skip()
        elif attributes.get(f"{XSI}}}nil") in ("true", "1"):
            if entry.kind == REFERENCE:
                if not entry.many:
                    slots[entry.key] = new_slot(ReferenceValue, element, entry.feature, None)
            else:
                self.add_value(element, slots, owner, entry, None)
            self.skip()
        else:
            self.text_of(element, slots, entry, attributes)
        return None, None

    def text_of(self, element: DynamicEObject, slots: Slots, entry: FeatureEntry, attributes: dict[str, str]) -> None:
        """Take the text up to the end of the current element as a value or a reference; a pair of an annotation has two."""
        if entry.kind == VALUE and entry.feature.eType is ecore.EStringToStringMapEntry:
            self.add_pair(element, slots, entry, attributes)
            return
        line = self.expat.CurrentLineNumber
        owner = type(element).__name__
        self.depth = 1
        self.texts.clear()

        def start(tag: str, _: dict[str, str]) -> None:
            self.here(f"{owner}.{entry.feature.name} takes text, not an element '{tag.rpartition('}')[2]}'")
            self.depth += 1

        def end(_: str) -> None:
            self.depth -= 1
            if self.depth:
                return
            self.expat.StartElementHandler, self.expat.EndElementHandler = self.start, self.end
            self.expat.CharacterDataHandler = self.stray
            text = "".join(self.texts)
            if self.escapes:
                text = restored(text)
            if entry.kind != REFERENCE:
                self.add_value(element, slots, owner, entry, text)
                return
            link = attributes.get("href") or attributes.get(f"{self.xmi}}}idref") or text.strip()
            if link:
                named = attributes.get(f"{XSI}}}type") or attributes.get(f"{self.xmi}}}type")
                if named is not None and (plan := self.known_type(named)) is not None:
                    self.document.types[link] = plan.cls
                self.document.references.append((element, entry, link, line, "href" in attributes))
            else:
                self.problem(line, f"{owner}.{entry.feature.name} has no href")

        self.expat.StartElementHandler, self.expat.EndElementHandler = start, end
        self.expat.CharacterDataHandler = self.texts.append

    def root(self, tag: str, attributes: dict[str, str]) -> tuple[ClassPlan | None, Any]:
        """The outermost element, or a root in the element around all."""
        uri, _, name = tag.rpartition("}")
        if self.document.roots and not self.several:
            raise Unreadable("there is a second root", self.expat.CurrentLineNumber)
        if not self.several:
            if text := attributes.pop(f"{XSI}}}schemaLocation", None):
                words = text.split()
                self.document.schema_locations = list(zip(words[::2], words[1::2], strict=False))
                self.locations(text)
            if name == "XMI" and XMI_NAMESPACES.fullmatch(uri):
                self.several = True
                return None, FeatureEntry(ROOT)
        if self.several and XMI_NAMESPACES.fullmatch(uri):  # documentation, extensions, differences
            if name == "Extension":
                self.extension()
            self.skip()
            return None, None
        if uri == ECORE_URI:
            if not self.document.roots:
                raise ForeignRoot
            text = f"the root '{name}' is Ecore's, beside roots of another metamodel"
            raise Unreadable(text, self.expat.CurrentLineNumber, "keep metamodels in .ecore files of their own")
        package = self.package_of(uri)
        eclass = class_in(package, name)
        if eclass is None and package is None and self.several and self.document.roots:
            self.apart(f"'{name}' is of the namespace '{uri}'", uri)
            self.skip()
            return None, None
        if eclass is None:
            said = "belongs to no metamodel known here" if package is None else "is of no class of its metamodel"
            raise Unreadable(f"the root element '{name}' of the namespace '{uri}' {said}", self.at(), "", uri)
        plan = self.plans.of(eclass)
        return (plan, FeatureEntry(ROOT)) if self.usable(plan) else (None, None)

    def skip(self) -> None:
        """Pass over everything up to the end of the current element."""
        self.depth = 1

        def start(_: str, __: dict[str, str]) -> None:
            self.depth += 1

        def end(_: str) -> None:
            self.depth -= 1
            if not self.depth:
                self.expat.StartElementHandler, self.expat.EndElementHandler = self.start, self.end
                self.expat.CharacterDataHandler = self.stray

        self.expat.StartElementHandler, self.expat.EndElementHandler = start, end
        self.expat.CharacterDataHandler = None

    def extension(self) -> None:
        """Say that an extension is not in the model; a strict read takes it as it always did."""
        if self.tells_foreign:
            self.apart("an extension of XMI, of the tool that wrote the file, is not in the model")

    # --- namespaces, and what a model has not

    def declare(self, prefix: str | None, uri: str | None) -> None:
        """A prefix gets a namespace."""
        self.prefixes.setdefault(prefix or "", []).append(uri or "")
        self.document.prefixes.setdefault(prefix or "", uri or "")
        self.types.clear()
        if uri and uri != XMI and XMI_NAMESPACES.fullmatch(uri):
            self.expat.StartElementHandler = self.start = renaming(self.start, uri)

    def undeclare(self, prefix: str | None) -> None:
        """A prefix loses its latest namespace."""
        self.prefixes[prefix or ""].pop()
        self.types.clear()

    def doctype(self, *_: Any) -> None:
        """A DOCTYPE could define entities that grow without end, or that read other files."""
        raise Unreadable("a model with a DOCTYPE is refused", self.expat.CurrentLineNumber, "remove the DOCTYPE")

    def stray(self, text: str) -> None:
        """Text where elements are."""
        if not text.isspace():
            self.here(f"the text '{text.strip()[:40]}' belongs to no feature")
