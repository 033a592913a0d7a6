"""The text of a sketch as plain records: instances, their properties, and in each view what is connected to what.

XML is read by `guarded_xml`, with any document type refused (Fritzing writes none). What the parts are, and which connectors
form one node, is decided elsewhere.
"""

from __future__ import annotations

import re

from lxml import etree
from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError
from robosmi.transformations.t2m.guarded_xml import line_of, parse_xml

VIEWS = ("breadboardView", "schematicView", "pcbView")
"""The views that contain connections, in the order of their precedence."""

MAX_INSTANCES = 10_000
"""Parts and wires in one sketch; the largest public one has under 3,000."""

_SLASH = re.compile(r"[\\/]")
_WIRE_FLAGS = re.compile("[0-9]{1,9}")
_OWN_ATTRIBUTES = frozenset({"moduleIdRef", "modelIndex", "path"})

Edge = tuple[str, str, str]
"""A connection: own connector, the other instance's model index, its connector."""


class View:
    """An instance in one view: its connections, the connectors mentioned, wire flags (None if not given) and colour."""

    def __init__(self) -> None:
        self.edges: list[Edge] = []
        self.connectors: list[str] = []
        self.flags: int | None = None
        self.color = ""


class Instance(Struct):
    """A placed part. `index` is its model index as written, `line` its line in the sketch; views are read when asked for."""

    index: str
    module_id: str
    title: str
    file_hint: str
    line: int
    properties: dict[str, str]
    local_names: dict[str, str]
    elements: dict[str, etree._Element]
    read: dict[str, View] = {}

    def view(self, name: str) -> View:
        """The record of the instance in a view; an empty one where it is not in that view."""
        if name not in self.read:
            element = self.elements.get(name)
            self.read[name] = View() if element is None else _view(element)
        return self.read[name]

    @property
    def is_wire(self) -> bool:
        """Whether it is a wire and no component."""
        return self.module_id == "WireModuleID"


class FritzingSketch(Struct):
    """A sketch: version of Fritzing as written, live instances in the file's order, and how many had no view."""

    version: str
    instances: list[Instance]
    without_views: int


def parse_sketch(data: bytes, path: str, name: str) -> FritzingSketch:
    """The records of a sketch.

    Args:
        data: the bytes of the `.fz`.
        path: the file, for messages.
        name: name of the `.fz` in it, for messages.

    Raises:
        SourceError: it is no Fritzing sketch.
    """
    root = parse_xml(data, path, name)
    instances = root.find("instances")
    if root.tag != "module" or instances is None:
        raise SourceError(
            _no_sketch(root, name), location=Location(path, line_of(root)), fix="give the .fz or .fzz file of a sketch"
        )
    if len(instances) > MAX_INSTANCES:
        raise TooLargeError(
            f"the sketch has {len(instances):,} parts and wires, but the limit is {MAX_INSTANCES:,}",
            location=Location(path, line_of(instances)),
            fix="check that it is a drawing, or draw its board alone",
        )
    live: list[Instance] = []
    empty = 0
    for element in instances.iterchildren("instance"):
        views = element.find("views")
        if views is None or len(views) == 0:
            empty += 1
        else:
            live.append(_instance(element, views))
    return FritzingSketch(root.get("fritzingVersion", ""), live, empty)


def _no_sketch(root: etree._Element, name: str) -> str:
    if root.tag == "module" and (root.get("moduleId") is not None or root.find("connectors") is not None):
        return f"'{name}' is the definition of a part (.fzp), not a sketch"
    if root.tag == "module":
        return f"'{name}' is not a Fritzing sketch: it has no <instances>"
    return f"'{name}' is not a Fritzing sketch: its root is <{root.tag}>, not <module>"


def _instance(element: etree._Element, views: etree._Element) -> Instance:
    attributes = element.attrib
    properties = {str(k): str(v) for k, v in attributes.items() if k not in _OWN_ATTRIBUTES}  # written so by old versions
    local_names: dict[str, str] = {}
    title = ""
    for child in element:
        if child.tag == "property":
            properties[child.get("name", "")] = child.get("value", "")
        elif child.tag == "title":
            title = (child.text or "").strip()
        elif child.tag == "localConnectors":
            local_names.update((c.get("id", ""), c.get("name", "")) for c in child)
    properties.pop("", None)
    return Instance(
        index=(element.get("modelIndex") or "").strip(),
        module_id=element.get("moduleIdRef", ""),
        title=title,
        file_hint=_SLASH.split(element.get("path", ""))[-1],
        line=line_of(element),
        properties=properties,
        local_names=local_names,
        elements={str(view.tag): view for view in views if view.tag in VIEWS},
    )


def _view(element: etree._Element) -> View:
    view = View()
    for child in element:
        if child.tag == "connectors":
            for connector in child:
                own = connector.get("connectorId", "")
                view.connectors.append(own)
                for connect in connector.iterfind("connects/connect"):
                    view.edges.append((own, connect.get("modelIndex", "").strip(), connect.get("connectorId", "")))
        elif child.tag == "geometry":
            flags = child.get("wireFlags", "")
            view.flags = int(flags) if _WIRE_FLAGS.fullmatch(flags) else None
        elif child.tag == "wireExtras":
            view.color = child.get("color", "")
    return view
