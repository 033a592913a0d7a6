"""Fritzing files: a plain `.fz`, or the ZIP of a `.fzz` with its sketch and its embedded part definitions; and the sketch as
records.

Everything is read in memory and within limits, names inside an archive are never used as paths, nothing is extracted. Any file
that is no sketch is refused with a `SourceError`. `part_file` interprets the part definitions.

The records are instances, their properties, and in each view what is connected to what. XML is read by `guarded_xml`, with any
document type refused (Fritzing writes none). What the parts are, and which connectors form one node, is decided elsewhere.
"""

from __future__ import annotations

import hashlib
import re
import stat
import zipfile
from collections.abc import Iterable
from pathlib import Path

from lxml import etree
from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, TooLargeError
from robosmi.files import zip_archive
from robosmi.transformations.t2m.guarded_xml import line_of, parse_xml

MAX_ENTRIES = 2_000
"""Entries in an archive; the largest public sketch has under a hundred."""
MAX_BYTES = inputs.DRAWING.most
"""Bytes of a sketch in an archive, and of all embedded definitions together; the largest public `.fz` has 1.7 MB."""

_FIX = "open it in Fritzing and save it again"

VIEWS = ("breadboardView", "schematicView", "pcbView")
"""The views that contain connections, in the order of their precedence."""

MAX_INSTANCES = 10_000
"""Parts and wires in one sketch; the largest public one has under 3,000."""

_SLASH = re.compile(r"[\\/]")
_WIRE_FLAGS = re.compile("[0-9]{1,9}")
_OWN_ATTRIBUTES = frozenset({"moduleIdRef", "modelIndex", "path"})

_Edge = tuple[str, str, str]
"""A connection: own connector, the other instance's model index, its connector."""


class Container(Struct):
    """What a file held.

    Attributes:
        path: as given.
        digest: SHA-256 of the file's bytes, hexadecimal.
        sketch_name: name of the `.fz`, for messages.
        sketch: its bytes.
        parts: name and bytes of each embedded part definition, in the archive's order.
        findings: what was left out.
    """

    path: str
    digest: str
    sketch_name: str
    sketch: bytes
    parts: list[tuple[str, bytes]] = []
    findings: list[Finding] = []


def recognises(head: bytes) -> bool:
    """Whether a file that begins so is a Fritzing sketch: an archive with a `.fz`, or XML whose root is Fritzing's.

    Args:
        head: the first bytes of the file.
    """
    if head[:2] == b"PK":
        return b".fz" in head
    return b"<module" in head and b"fritzingVersion" in head


def read_container(path: Path) -> Container:
    """The content of a `.fz` or `.fzz` file; the format is recognised by its bytes.

    Raises:
        SourceError: the file is missing, not readable, empty, too big, a damaged or encrypted archive, or has no sketch in it.
    """
    data = _bytes_of(path)
    digest = hashlib.sha256(data).hexdigest()
    if data[:2] == b"PK":
        return _archive(str(path), digest, data)
    if path.suffix.lower() == ".fzz" and not data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        raise _error(path, "it is not a ZIP archive, as a .fzz must be", _FIX)
    return Container(str(path), digest, path.name, data)


def _error(path: Path | str, cause: str, fix: str, line: int | None = None) -> SourceError:
    return SourceError(cause, location=Location(str(path), line), fix=fix)


def _bytes_of(path: Path) -> bytes:
    try:
        data = inputs.read_bytes(path, inputs.DRAWING)
    except FileNotFoundError as error:
        raise _error(path, "no such file", "check the name of the sketch") from error
    except IsADirectoryError as error:
        raise _error(path, "it is a folder, not a Fritzing sketch", "give the .fz or .fzz file in it") from error
    except OSError as error:
        fix = inputs.fix_of(error, "check the name and the permissions of the file")
        raise _error(path, f"it cannot be read: {error.strerror or error}", fix) from error
    if not data.strip():
        raise _error(path, "the file is empty", _FIX)
    return data


def _archive(path: str, digest: str, data: bytes) -> Container:
    entries = zip_archive.entries(data, path, MAX_ENTRIES)
    odd = [e.filename for e in entries if "/" in e.filename or "\\" in e.filename or ".." in e.filename]
    links = [e.filename for e in entries if stat.S_ISLNK(e.external_attr >> 16)]
    flat = [e for e in entries if e.filename not in {*odd, *links}]
    sketches = [e for e in flat if _is_sketch(e)]
    if not sketches and (folder := _packed_folder(entry for entry in entries if entry.filename not in links)) is not None:
        flat = [e for e in entries if _folder_of(e) == folder and e.filename not in links]
        odd = [name for name in odd if name not in {e.filename for e in flat} and not name.endswith("/")]
        sketches = [e for e in flat if _is_sketch(e)]
    if not sketches:
        raise _error(path, "the archive has no .fz sketch", _FIX)
    try:
        sketch = zip_archive.unpacked(data, sketches[0], path, MAX_BYTES)
    except zipfile.BadZipFile as error:
        raise _error(path, f"the archive is damaged: {error}", _FIX) from error
    result = Container(path, digest, sketches[0].filename, sketch)
    room = MAX_BYTES
    for entry in flat:
        if not entry.filename.lower().endswith(".fzp"):
            continue
        try:
            content = zip_archive.unpacked(data, entry, path, room)
        except zipfile.BadZipFile as error:  # the sketch itself is sound
            result.findings.append(_left_out(path, [entry.filename], f"is damaged: {error}"))
            continue
        room -= len(content)
        result.parts.append((entry.filename, content))
    if len(sketches) > 1:
        result.findings.append(
            _left_out(
                path,
                [e.filename for e in sketches[1:]],
                f"is another sketch; RoboSMi reads '{result.sketch_name}', as Fritzing does",
            )
        )
    if links:
        result.findings.append(_left_out(path, links, "is a link, which Fritzing does not write"))
    if odd:
        result.findings.append(_left_out(path, odd, "has a folder in its name, which Fritzing does not write"))
    return result


def _is_sketch(entry: zipfile.ZipInfo) -> bool:
    return entry.filename.lower().endswith(".fz")


def _folder_of(entry: zipfile.ZipInfo) -> str:
    return entry.filename.replace("\\", "/").rpartition("/")[0]


def _packed_folder(entries: Iterable[zipfile.ZipInfo]) -> str | None:
    """The folder with the sketch in an archive that was unpacked and packed again, or None; Fritzing writes no folder."""
    folders = [_folder_of(entry) for entry in entries if _is_sketch(entry)]
    inner = [folder for folder in folders if not {"..", "__MACOSX"} & {*folder.split("/")}]
    return min(inner, key=lambda folder: folder.count("/"), default=None)


def _left_out(path: str, names: list[str], why: str) -> Finding:
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return Finding(
        "RS209",
        Severity.warning,
        f"'{names[0]}'{more} in the archive was left out: it {why}",
        Location(path),
        evidence={"entries": names[:20]},
    )


class View:
    """An instance in one view: its connections, the connectors mentioned, wire flags (None if not given) and colour."""

    def __init__(self) -> None:
        self.edges: list[_Edge] = []
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
