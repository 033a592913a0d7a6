"""Parses one JSON or YAML file into elements, in the form that EMF-JSON gives to models (emfjson-jackson).

A root and an element of another class than the declared one name theirs (`"eClass": "http://lab/m#//Node"`); contained elements
are nested; a reference is an object with `$ref`, a fragment or URI; `_id` is an xmi:id. Values are taken as XMI's texts are.
Elements are built as `xmi_parser` builds them, and references are left to `xmi_linker`.

YAML is read as JSON with the line of every value: block and flow collections, quoted and plain scalars, comments. What is no
JSON in another dress is refused: anchors and aliases, whose expansion may be of any size, tags, several documents, keys that
are no texts or come twice. Plain scalars are those of YAML's JSON schema: `true`, `false`, `null`, `~` and numbers; all others
are texts, so that `no`, `12:30` and dates stay what they are.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from robosmi.base.located_json import (
    FEWER_LEVELS,
    MOST_LEVELS,
    JsonError,
    LocatedJson,
    LocatedList,
    LocatedObject,
    NumberText,
    located_json,
)
from robosmi.errors import MissingToolError, did_you_mean
from robosmi.model.ecore.xmi_document import Document, Foreign, PackageOf, Problem, Unreadable
from robosmi.model.elements import ecore
from robosmi.model.elements.compact_slots import AttributeValue, ReferenceValue, new_slot
from robosmi.model.elements.datatypes import ECORE_URI
from robosmi.model.elements.ecore import DynamicEObject
from robosmi.model.elements.features import class_names
from robosmi.model.elements.pyecore_internals import IDENTITY
from robosmi.model.elements.xmi_plan import CHILD, CHILDREN, IGNORED, REFERENCE, REFUSED, VALUE, ClassPlan, FeatureEntry, Plans
from robosmi.model.xmi.text_forms import is_yaml
from robosmi.model.xmi.xmi_linker import resolve
from robosmi.model.xmi.xmi_parser import Builder

if TYPE_CHECKING:
    from yaml.events import Event, ScalarEvent

CLASS, LINK, ID = "eClass", "$ref", "_id"
"""The keys that are no features."""
UUID = "uuid"
"""What pyecore's JSON calls an id."""
ILLEGAL = "_illegal"
"""Field of an element: feature that the file gives an illegal value -> key of its slot, that value, the legal ones of several."""
_SHAPE = "give a model in the form of EMF-JSON, whose roots name their class: " + '{"eClass": "NAMESPACE#//CLASS"}'

_WORDS = {"true": True, "false": False, "null": None, "~": None, "": None}
_NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?")


def parse_json(
    path: Path,
    data: bytes,
    plans: Plans,
    package_of: PackageOf,
    problem: Problem,
    foreign: Foreign | None = None,
    illegal: Foreign | None = None,
) -> Document:
    """Build the elements of one file, in JSON or YAML by its name.

    Args:
        path: the file, for the document.
        data: its bytes.
        plans: the plans of this load.
        package_of: finds a package by its namespace.
        problem: receives line and text of every problem.
        foreign, illegal: as for `xmi_parser.parse`; an illegal value is written again unless its feature gets another.

    Raises:
        Unreadable: it is no JSON, or a root is no element of a known metamodel.
    """
    try:
        value = located_yaml(data) if is_yaml(path) else located_json(data)
    except JsonError as error:
        raise Unreadable(f"not well-formed JSON: {error}", error.line, error.fix) from None
    except YamlError as error:
        raise Unreadable(f"not YAML of the kind that models have: {error}", error.line, error.fix) from None
    return _Parser(path, plans, package_of, problem, foreign, illegal).run(value)


class _Parser(Builder):
    """The state of one pass."""

    line = 1

    def at(self) -> int:
        """The current line."""
        return self.line

    def skip(self) -> None:
        """What is not read is not looked at."""

    def run(self, value: LocatedJson) -> Document:
        """Build the roots and all they contain; with a stack, outer elements before inner ones."""
        roots = value if isinstance(value, list) else [value]
        for root in roots:
            if not isinstance(root, LocatedObject) or not isinstance(root.get(CLASS), str):
                line = root.line if isinstance(root, (LocatedObject, LocatedList)) else 1
                raise Unreadable("the file is no model: a root has no 'eClass'", line, _SHAPE)
            plan = self.root(str(root[CLASS]), root.lines[CLASS])
            if plan is None:
                continue
            element = self.made(plan, root)
            self.document.roots.append(element)
            stack = [(element, plan, root)]
            while stack:
                stack += reversed(self.fill(*stack.pop()))
        return self.document

    def root(self, uri: str, line: int) -> ClassPlan | None:
        """The plan of a root's class; None with the problem noted if it has no elements."""
        self.line = line
        namespace = uri.partition("#")[0]
        if namespace == ECORE_URI:
            raise Unreadable(
                f"the root is a '{uri}': metamodels are not read from JSON or YAML", line, "save it as an .ecore file"
            )
        plan = self.class_of(uri)
        if plan is None:
            fix = "" if self.package_of(namespace) is None else _SHAPE
            raise Unreadable(f"the class '{uri}' of a root is in no metamodel known here{self.near(uri)}", line, fix, namespace)
        if plan.abstract:
            self.here(f"{plan.name} is abstract: it has no elements of its own")
            return None
        return plan if self.usable(plan) else None

    def class_of(self, uri: str) -> ClassPlan | None:
        """The plan of the class that a URI leads to, or None."""
        if uri not in self.types:
            namespace, _, fragment = uri.partition("#")
            package = self.package_of(namespace)
            found = resolve(package, fragment) if package is not None and fragment.startswith("/") else None
            found = getattr(found, "eClass", found) if isinstance(found, type) else found
            self.types[uri] = self.plans.of(found) if isinstance(found, ecore.EClass) else None
        return self.types[uri]

    def near(self, uri: str) -> str:
        """The class that a URI may mean."""
        package = self.package_of(uri.partition("#")[0])
        return did_you_mean(uri.rpartition("/")[2], class_names(package)) if package is not None else ""

    def made(self, plan: ClassPlan, given: LocatedObject) -> DynamicEObject:
        """A new element of a class, with its id."""
        element: DynamicEObject = object.__new__(plan.cls)
        identity = given.get(ID) if ID not in plan.entries else None
        if UUID not in plan.entries:
            identity = identity or given.get(UUID)
        self.line = given.lines.get(ID) or given.lines.get(UUID) or given.line
        if isinstance(identity, str):
            element.__dict__[IDENTITY] = identity
            self.identify(identity, element)
        if plan.bounds:
            self.document.counted.append((element, plan, given.line))
        return element

    def fill(
        self, element: DynamicEObject, plan: ClassPlan, given: LocatedObject
    ) -> list[tuple[DynamicEObject, ClassPlan, LocatedObject]]:
        """Set the features of an element.

        Returns:
            The elements that it contains, with their plans, which are to be filled.
        """
        inside: list[tuple[DynamicEObject, ClassPlan, LocatedObject]] = []
        for name, value in given.items():
            self.line = given.lines[name]
            entry = plan.entries.get(name)
            if entry is None or "}" in name:
                if name not in (CLASS, ID, UUID) and self.no_feature(plan.eclass, name, plan.entries):
                    element.__dict__.setdefault(ILLEGAL, {})[name] = ("", value, [])
            elif entry.kind == REFUSED:
                self.apart(entry.message)
                element.__dict__.setdefault(ILLEGAL, {})[name] = (entry.key, value, [])
            elif entry.kind != IGNORED:
                self.feature(element, plan, entry, value, inside)
        return inside

    def feature(
        self,
        element: DynamicEObject,
        plan: ClassPlan,
        entry: FeatureEntry,
        value: LocatedJson,
        inside: list[tuple[DynamicEObject, ClassPlan, LocatedObject]],
    ) -> None:
        """Set one feature, to one value or to several."""
        slots: Any = element.__dict__
        if entry.kind == VALUE and entry.feature.eType is ecore.EStringToStringMapEntry:
            self.pairs(element, slots, plan, entry, value)
            return
        if entry.many != isinstance(value, list):
            if value is not None or not entry.many:
                self.here(f"{plan.name}.{entry.feature.name} takes {'a list' if entry.many else 'one value, not a list'}")
            return
        if entry.kind not in (CHILD, CHILDREN, REFERENCE):
            values = value if isinstance(value, list) else [value]
            taken = [self.plain_value(element, slots, plan, entry, one) for one in values]
            if not all(taken):
                legal = list(slots.get(entry.key, ())) if entry.many else []
                slots.setdefault(ILLEGAL, {})[entry.feature.name] = (entry.key, value, legal)
            return
        for one in value if isinstance(value, list) else [value]:
            if isinstance(one, (LocatedObject, LocatedList)):
                self.line = one.line
            if one is None:
                if not entry.many and entry.kind == REFERENCE:
                    slots[entry.key] = new_slot(ReferenceValue, element, entry.feature, None)
            elif not isinstance(one, LocatedObject):
                self.here(f"{plan.name}.{entry.feature.name} takes elements, each an object")
            elif LINK in one or entry.kind == REFERENCE:
                self.link(element, plan, entry, one)
            elif (child_plan := self.plan_in(entry, one)) is not None:
                child = self.made(child_plan, one)
                self.contain(element, slots, entry, child, child.__dict__)
                inside.append((child, child_plan, one))

    def plain_value(self, element: DynamicEObject, slots: Any, plan: ClassPlan, entry: FeatureEntry, value: LocatedJson) -> bool:
        """Set a value, or add one to many; gives whether its type takes it."""
        if isinstance(value, (LocatedObject, LocatedList)):
            self.line = value.line
            self.here(f"{plan.name}.{entry.feature.name} takes a value, not an object or a list")
            return True
        text = ("true" if value else "false") if isinstance(value, bool) else value if value is None else str(value)
        return self.add_value(element, slots, plan.name, entry, text)

    def pairs(self, element: DynamicEObject, slots: Any, plan: ClassPlan, entry: FeatureEntry, value: LocatedJson) -> None:
        """Set the details of an annotation, which are an object."""
        if not isinstance(value, LocatedObject) or not all(each is None or isinstance(each, str) for each in value.values()):
            self.here(f"{plan.name}.{entry.feature.name} takes an object whose values are texts")
            return
        held: Any = dict(value)
        slots[entry.key] = new_slot(AttributeValue, element, entry.feature, held)

    def link(self, element: DynamicEObject, plan: ClassPlan, entry: FeatureEntry, given: LocatedObject) -> None:
        """Note a reference, or a contained element of another file, to be resolved when all elements are there."""
        link = given.get(LINK)
        if link is None and LINK in given:  # what EMF-JSON writes for an element that is nowhere
            return
        if not isinstance(link, str) or not link:
            self.here(f"{plan.name}.{entry.feature.name} takes an object with '$ref'")
            return
        for name in given.keys() - {CLASS, LINK}:
            self.problem(given.lines[name], f"'{name}' stands beside '$ref', in a reference")
        kind = self.class_of(str(given[CLASS])) if CLASS in given else None
        if entry.kind == REFERENCE:
            if kind is not None:
                self.document.types[link] = kind.cls
            self.document.references.append((element, entry, link, self.line, True))
        else:
            self.external_part(element, entry, link, kind.cls if kind is not None else entry.declared.python_class)

    def plan_in(self, entry: FeatureEntry, given: LocatedObject) -> ClassPlan | None:
        """The plan of a contained element; None with the problem noted."""
        if CLASS not in given:
            plan = self.plans.of(entry.declared)
            if plan.abstract:
                self.here(f"{plan.name} is abstract: the element needs an 'eClass'")
                return None
            return plan if self.usable(plan) else None
        self.line, uri = given.lines[CLASS], given[CLASS]
        found = self.class_of(uri) if isinstance(uri, str) else None
        if found is None:
            namespace = str(uri).partition("#")[0]
            said = f"'{uri}' is no class of a metamodel known here"
            unknown = f": nobody has the namespace '{namespace}'" if self.package_of(namespace) is None else self.near(str(uri))
            self.here(f"{said}{unknown}")
            return None
        if not entry.takes(found.cls):
            self.here(f"{found.name} is no {entry.declared.name}, which '{entry.feature.name}' takes")
            return None
        return found if self.usable(found) else None


class YamlError(ValueError):
    """A text that is no YAML, or not of this part of it; `line` is where, `fix` what to do."""

    def __init__(self, text: str, line: int, fix: str = "correct the file") -> None:
        super().__init__(text)
        self.line = line
        self.fix = fix


def located_yaml(data: bytes) -> LocatedJson:
    """The value of a text in YAML.

    Raises:
        YamlError: it is no UTF-8, no YAML, has what is refused, or is nested more than `MOST_LEVELS` deep.
        MissingToolError: PyYAML is not installed.
    """
    try:
        import yaml
    except ModuleNotFoundError as error:
        raise MissingToolError("YAML needs the package PyYAML", fix="install it: pip install 'robosmi[yaml]'") from error
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise YamlError("the text is no UTF-8", data.count(b"\n", 0, error.start) + 1) from None
    builder = _YamlBuilder()
    try:
        for event in yaml.parse(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line, text = mark.line + 1 if mark is not None else 1, error.problem or "it cannot be read"
        if "nesting" in text:  # libyaml has a limit of its own
            raise YamlError(f"the text is nested too deep ({text})", line, FEWER_LEVELS) from None
        raise YamlError(text, line) from None
    except yaml.reader.ReaderError as error:
        place = error.position if isinstance(error.position, int) else 0
        code = error.character if isinstance(error.character, int) else ord(error.character)
        raise YamlError(f"the character U+{code:04X} is not allowed", text.count("\n", 0, place) + 1) from None
    return builder.value()


class _YamlBuilder:
    """Builds the value of the events of one text, with a stack of its own."""

    def __init__(self) -> None:
        self.whole = LocatedList(1)
        self.around: list[LocatedObject | LocatedList] = [self.whole]
        self.keys: list[str | None] = [None]
        self.documents = 0

    def value(self) -> LocatedJson:
        """The one value of the text."""
        if not self.documents:
            raise YamlError("the text is empty", 1)
        return self.whole[0]

    def take(self, event: Event) -> None:
        """Add what an event says."""
        from yaml import events

        line = event.start_mark.line + 1 if event.start_mark is not None else 1
        if isinstance(event, events.DocumentStartEvent):
            self.documents += 1
            if self.documents > 1:
                raise YamlError("a second document begins, and a file has one", line)
        elif isinstance(event, events.AliasEvent):
            raise YamlError(f"'*{event.anchor}' is an alias, which is not supported", line)
        elif isinstance(event, events.NodeEvent):
            if event.anchor is not None:
                raise YamlError(f"'&{event.anchor}' is an anchor, which is not supported", line)
            if (tag := getattr(event, "tag", None)) is not None:
                raise YamlError(f"'{tag}' is a tag, which is not supported", line)
            self.node(event, line)
        elif isinstance(event, events.CollectionEndEvent):
            self.around.pop()
            self.keys.pop()

    def node(self, event: Event, line: int) -> None:
        """Add a value, or note a key."""
        from yaml import events

        inside = self.around[-1]
        if isinstance(inside, LocatedObject) and self.keys[-1] is None:
            if not isinstance(event, events.ScalarEvent):
                raise YamlError("a key is a list or an object, and keys are texts", line)
            if event.value in inside:
                raise YamlError(f"the key '{event.value}' stands twice, first in line {inside.lines[event.value]}", line)
            inside.lines[event.value] = line
            self.keys[-1] = event.value
            return
        value = _scalar(event) if isinstance(event, events.ScalarEvent) else None
        if not isinstance(event, events.ScalarEvent):
            value = LocatedObject(line) if isinstance(event, events.MappingStartEvent) else LocatedList(line)
        key = self.keys[-1]
        if isinstance(inside, LocatedObject) and key is not None:
            inside[key], self.keys[-1] = value, None
        elif isinstance(inside, LocatedList):
            inside.append(value)
        if isinstance(value, (LocatedObject, LocatedList)):
            self.around.append(value)
            self.keys.append(None)
            if len(self.around) > MOST_LEVELS + 1:
                raise YamlError(f"the text is nested more than {MOST_LEVELS} levels deep", line, FEWER_LEVELS)


def _scalar(event: ScalarEvent) -> LocatedJson:
    """The value of a scalar."""
    text: str = event.value
    if event.style or not event.implicit[0]:
        return text
    if text in _WORDS:
        return _WORDS[text]
    return NumberText(text) if _NUMBER.fullmatch(text) else text
