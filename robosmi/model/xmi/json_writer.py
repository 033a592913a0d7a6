"""Models to JSON text in the form of EMF-JSON (emfjson-jackson), which `json_parser` reads.

What is written of an element, and where references lead, is what `xmi_writer` writes: the same features in the same order, no
defaults, the same fragments. Numbers and truth values are JSON's own; all other values are the texts that XMI has for them.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from robosmi.base.data_text import Json
from robosmi.base.located_json import MOST_LEVELS, NumberText
from robosmi.errors import ModelError
from robosmi.model.elements import ecore
from robosmi.model.elements.datatypes import real
from robosmi.model.elements.ecore import EClass, EObject, EOrderedSet
from robosmi.model.elements.features import is_of_ecore
from robosmi.model.elements.proxies import as_read, proxy_uri
from robosmi.model.elements.pyecore_internals import set_features_of, target_in, value_in, xmi_id_of
from robosmi.model.xmi.json_parser import CLASS, ID, ILLEGAL, LINK
from robosmi.model.xmi.written_file import WrittenFile
from robosmi.model.xmi.xmi_layout import CHILDREN, DETAILS, LINKS, VALUE, VALUES, Column
from robosmi.model.xmi.xmi_locations import Unplaced, XmiLocations, metamodel_uri, relative

if TYPE_CHECKING:
    from robosmi.model.elements.ecore import Slots, Value

_SURROGATE = re.compile("[\ud800-\udfff]")
_ELEMENT_OF_ECORE = "save it as an .ecore file"


def to_json(name: str, roots: Sequence[EObject], places: XmiLocations, indent: str = "  ") -> bytes:
    """The text of one file: one root, or a list of none or several.

    Args:
        name: the file's name as `places` has it.
        roots: its root elements.
        places: where the elements of this model, and of those that it refers to, are.
        indent: what stands before the lines of an object or list, for each level.

    Raises:
        ModelError: a reference leads to an element in none of the models, a value is not of its feature's type or too many, an
            id is used twice, the roots are a metamodel, or elements are nested deeper than JSON's readers take.
    """
    return f"{''.join(_pieces(tree_of(name, roots, places), indent))}\n".encode()


def tree_of(name: str, roots: Sequence[EObject], places: XmiLocations) -> Json:
    """What the text of one file says, in the forms that share it; see `to_json`."""
    writer = _Writer(name, places)
    trees: list[Json] = [writer.tree(root) for root in roots]
    return trees[0] if len(trees) == 1 else trees


def number_text(value: Json) -> str:
    """A number, truth value or empty value, with the digits that its data type writes."""
    return str(value) if isinstance(value, NumberText) else json.dumps(value)


class _Writer(WrittenFile):
    """One file."""

    def __init__(self, name: str, places: XmiLocations) -> None:
        super().__init__(name, places)
        self.classes: dict[EClass, str] = {}

    def tree(self, root: EObject) -> dict[str, Json]:
        """An element with all that it contains, as JSON has it."""
        if is_of_ecore(root.eClass):
            raise self.problem(root, None, "is of a metamodel, which is not written as JSON or YAML", _ELEMENT_OF_ECORE)
        whole: dict[str, Json] = {CLASS: self.class_uri(root.eClass)}
        stack: list[tuple[EObject, dict[str, Json], int]] = [(root, whole, 2)]
        while stack:
            element, made, level = stack.pop()
            if level > MOST_LEVELS:
                said = f"is nested deeper than the {MOST_LEVELS} levels that readers of JSON and YAML take"
                raise self.problem(element, None, said, "save the model as XMI")
            stack += reversed(self.fill(element, made, level))
        self.layouts.close()
        return whole

    def fill(self, element: EObject, made: dict[str, Json], level: int) -> list[tuple[EObject, dict[str, Json], int]]:
        """Add an element's features; gives the elements that it contains, which are to be filled."""
        inside: list[tuple[EObject, dict[str, Json], int]] = []
        layout = self.layouts.known.get(element.__class__) or self.layouts.of(element)
        if layout.has_id or xmi_id_of(element) is not None:
            self.identify(element, made)
        slots = element.__dict__
        for *_, column in layout.shapes.get(tuple(slots)) or layout.columns_in(slots):
            slot = slots[column.key]
            if column.kind == CHILDREN:
                self.children(element, column, slot, made, level, inside)
            elif column.kind == LINKS:
                target = None if column.many else target_in(slot)
                targets: Sequence[EObject] = list(slot) if column.many else [] if target is None else [target]
                links = [
                    self.link(element, column, target) for each in targets if as_read(element, column.key, target := real(each))
                ]
                self.add(element, column, made, links)
            elif column.kind == VALUES:
                self.add(element, column, made, [self.value(element, column, each) for each in slot])
            elif column.kind == VALUE:
                self.single(element, column, value_in(slot) if isinstance(slot, ecore.EValue) else slot, made)
            elif column.kind == DETAILS:
                held: Any = slot if isinstance(slot, dict) else value_in(slot)
                if held:
                    made[column.name] = {str(key): value for key, value in held.items()}
            elif len(slot) if column.many else value_in(slot) is not None:
                raise self.problem(element, column, "is a feature map, which is not supported", "leave it empty")
        if ILLEGAL in slots:
            self.illegal(slots, made)
        return inside

    # --- features

    def illegal(self, slots: Slots, made: dict[str, Json]) -> None:
        """Write values of the file that their types do not take, where the features have no others since, in their places."""
        noted: dict[str, tuple[str, Json, list[Value]]] = slots[ILLEGAL]
        for name, (key, value, legal) in noted.items():
            if key not in slots or (isinstance(value, list) and list(slots[key]) == legal):
                made[name] = value

    def add(self, element: EObject, column: Column, made: dict[str, Json], values: list[Json]) -> None:
        """Set what a feature has, none, one or many."""
        if 1 < column.upper < len(values):
            raise self.problem(element, column, f"takes {column.upper} values, not {len(values)}", "remove what is too much")
        if values:
            made[column.name] = values if column.many else values[0]
        elif column.is_unsettable and column.feature in set_features_of(element):
            made[column.name] = [] if column.many else None

    def single(self, element: EObject, column: Column, value: Value, made: dict[str, Json]) -> None:
        """Set a value that is not the default."""
        if column.is_unsettable:
            if column.feature in set_features_of(element):
                made[column.name] = self.value(element, column, value)
        elif value is None:
            if column.default is not None and not column.is_primitive:
                made[column.name] = None
        elif value != column.default:
            made[column.name] = self.value(element, column, value)

    def value(self, element: EObject, column: Column, value: Value) -> Json:
        """A value as JSON has it."""
        if value is None:
            return None
        try:
            text = str(column.convert(value))
        except ValueError as error:
            raise self.problem(element, column, str(error), "set a value of the feature's type") from None
        if isinstance(value, bool) and text in ("true", "false"):
            return value
        if isinstance(value, int) and text == str(int(value)):
            return int(value)
        return NumberText(text) if isinstance(value, float) and math.isfinite(value) else text

    def children(
        self,
        element: EObject,
        column: Column,
        slot: Any,
        made: dict[str, Json],
        level: int,
        inside: list[tuple[EObject, dict[str, Json], int]],
    ) -> None:
        """Set what a feature contains."""
        single = None if column.many else target_in(slot)
        held: Sequence[EObject] = [] if single is None else [single]
        if column.many:
            held = slot.items if isinstance(slot, EOrderedSet) else list(slot)
        found: list[Json] = []
        for given in held:
            child = real(given)
            if proxy_uri(child) is None:
                self.check_container(element, column, child)
            if proxy_uri(child) is not None or id(child) in self.places.nested:
                self.check_no_root(element, column, child)
                found.append(self.link(element, column, child))
                continue
            part: dict[str, Json] = {} if child.eClass is column.declared else {CLASS: self.class_uri(child.eClass)}
            found.append(part)
            inside.append((child, part, level + 1 + column.many))
        self.add(element, column, made, found)

    # --- places

    def identify(self, element: EObject, made: dict[str, Json]) -> None:
        """Write the xmi:id."""
        if (identity := self.identity(element)) is not None:
            made[ID] = identity

    def link(self, element: EObject, column: Column, target: EObject) -> Json:
        """A reference, with the class of its target."""
        file, fragment = self.place(element, column, as_read(element, column.key, target) or target)
        if file and file != self.name:
            fragment = f"{relative(self.name, file)}#{fragment}"
        eclass = target.eClass if isinstance(target, ecore.EObject) else target.__class__.eClass
        return {CLASS: self.class_uri(eclass), LINK: fragment}

    def class_uri(self, eclass: EClass) -> str:
        """The URI of a class, by the namespace of its package."""
        found = self.classes.get(eclass)
        if found is None:
            try:
                found = self.classes[eclass] = metamodel_uri(eclass)
            except Unplaced:
                raise ModelError(
                    f"{self.name}: the class {eclass.name} is in no package with a namespace",
                    fix="give its package a namespace in the .ecore file",
                ) from None
        return found


# --- text


def _pieces(value: Json, indent: str) -> Iterator[str]:
    """The text of a value in pieces, as `json.dumps` lays it out; that of Python descends recursively."""
    stack: list[tuple[Iterator[tuple[str, Json]], str]] = [(iter([("", value)]), "")]
    fresh = True
    while stack:
        items, closing = stack[-1]
        item = next(items, None)
        if item is None:
            stack.pop()
            if stack:
                yield f"{_line(indent, len(stack) - 1)}{closing}"
            fresh = False
            continue
        if len(stack) > 1:
            yield f"{'' if fresh else ','}{_line(indent, len(stack) - 1)}{item[0]}"
        fresh = False
        one = item[1]
        if isinstance(one, dict) and one:
            yield "{"
            stack.append((iter([(f"{_quoted(str(key))}: ", each) for key, each in one.items()]), "}"))
            fresh = True
        elif isinstance(one, list) and one:
            yield "["
            stack.append((iter([("", each) for each in one]), "]"))
            fresh = True
        elif isinstance(one, str) and not isinstance(one, NumberText):
            yield _quoted(one)
        else:
            yield number_text(one)


def _line(indent: str, level: int) -> str:
    return f"\n{indent * level}"


def _quoted(text: str) -> str:
    """A text in quotation marks; half a character outside of Unicode's first plane cannot stand in UTF-8, and is escaped."""
    return json.dumps(text, ensure_ascii=_SURROGATE.search(text) is not None)
