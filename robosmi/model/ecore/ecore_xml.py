"""Parses Ecore files into trees of plain nodes with line numbers: the XML part of reading a metamodel.

`ecore_loader` interprets the nodes. Comments and processing instructions are skipped, a DOCTYPE is refused (nothing is expanded
or downloaded). The parser uses a stack of its own instead of recursion.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from xml.parsers import expat

from robosmi.diagnostics import Location
from robosmi.errors import SourceError

_XSI = ("http://www.w3.org/2001/XMLSchema-instance", "http://www.omg.org/XMI", "http://schema.omg.org/spec/XMI/2.1")
_SEPARATOR = "\x1f"


def fault_of(error: expat.ExpatError, data: bytes, fix: str, encoding: str | None = None) -> tuple[str, str, int | None]:
    """What is wrong with a file that is not well-formed, in words, and what to do.

    Args:
        error: the parser's.
        data: the file.
        fix: what to do where nothing better is known.
        encoding: its encoding, if not the one that it declares.

    Returns:
        The text, the advice, and the line of the element that is not closed, if one is not.
    """
    cause = expat.errors.messages.get(error.code, str(error))
    if cause != expat.errors.XML_ERROR_TAG_MISMATCH:
        return f"not well-formed XML: {cause}", fix, None
    name, line = _unclosed(data, encoding)
    return f"not well-formed XML: <{name}> of line {line} is not closed", f"write </{name}> where it ends", line


def _unclosed(data: bytes, encoding: str | None) -> tuple[str, int]:
    """Name and line of the element that is open where another end tag stands."""
    open_elements: list[tuple[str, int]] = []
    parser = expat.ParserCreate(encoding)
    parser.StartElementHandler = lambda name, _: open_elements.append((name, parser.CurrentLineNumber))
    parser.EndElementHandler = lambda _: open_elements.pop()
    with suppress(expat.ExpatError):
        parser.Parse(data, True)
    return open_elements[-1]


class EcoreNode:
    """An XML element: local name, attributes without namespace, children, line.

    Attributes:
        tag: local name.
        namespace: its namespace, empty where there is none.
        kind: local name given by `xsi:type` or `xmi:type`, empty where there is none.
        ident: `xmi:id`, empty where there is none.
        attributes: the attributes that have no namespace.
        line: line of the start tag, from 1.
    """

    __slots__ = ("_named", "attributes", "children", "ident", "kind", "line", "namespace", "parent", "tag", "text")

    def __init__(self, tag: str, namespace: str, line: int, parent: EcoreNode | None) -> None:
        self.tag = tag
        self.namespace = namespace
        self.line = line
        self.parent = parent
        self.kind = ""
        self.ident = ""
        self.text = ""
        self.attributes: dict[str, str] = {}
        self.children: list[EcoreNode] = []
        self._named: dict[str, EcoreNode] | None = None

    def get(self, name: str, default: str = "") -> str:
        """The value of an attribute."""
        return self.attributes.get(name, default)

    def flag(self, name: str, default: bool = False) -> bool:
        """The value of a boolean attribute."""
        return {"true": True, "false": False}.get(self.attributes.get(name, "").strip(), default)

    def tagged(self, *tags: str) -> list[EcoreNode]:
        """The children with one of these tags."""
        return [child for child in self.children if child.tag in tags]

    def named(self, name: str) -> EcoreNode | None:
        """The first child of that name."""
        if self._named is None:
            self._named = {}
            for child in self.children:
                if "name" in child.attributes and child.tag != "eAnnotations":
                    self._named.setdefault(child.attributes["name"], child)
        return self._named.get(name)

    def walk(self) -> Iterator[EcoreNode]:
        """The node and all below it, in document order."""
        stack = [self]
        while stack:
            node = stack.pop()
            yield node
            stack.extend(reversed(node.children))


def read_nodes(data: bytes, path: Path) -> EcoreNode:
    """The root node of a file.

    Args:
        data: the file's bytes.
        path: its place, for messages.

    Raises:
        SourceError: it is no well-formed XML, or has a DOCTYPE.
    """
    parser = expat.ParserCreate(namespace_separator=_SEPARATOR)
    parser.ordered_attributes = True
    parser.buffer_text = True
    stack: list[EcoreNode] = []
    roots: list[EcoreNode] = []

    def start(name: str, values: list[str]) -> None:
        namespace, _, tag = name.rpartition(_SEPARATOR)
        node = EcoreNode(tag, namespace, parser.CurrentLineNumber, stack[-1] if stack else None)
        for key, value in zip(values[::2], values[1::2], strict=True):
            space, _, local = key.rpartition(_SEPARATOR)
            if not space:
                node.attributes[local] = value
            elif local == "type" and space in _XSI:
                node.kind = value.rpartition(":")[2].strip()
            elif local == "id":
                node.ident = value
        (stack[-1].children if stack else roots).append(node)
        stack.append(node)

    def end(_name: str) -> None:
        stack.pop()

    def characters(text: str) -> None:
        if stack and not stack[-1].children:
            stack[-1].text += text

    def doctype(*_: object) -> None:
        raise SourceError(
            "a metamodel with a DOCTYPE is refused",
            location=Location(str(path), parser.CurrentLineNumber),
            fix="remove the DOCTYPE",
        )

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = characters
    parser.StartDoctypeDeclHandler = doctype
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        text, fix, _ = fault_of(error, data, "give a metamodel in XMI")
        raise SourceError(text, location=Location(str(path), error.lineno, error.offset + 1), fix=fix) from error
    except (LookupError, ValueError) as error:  # an encoding that Python does not know or that has several bytes
        raise SourceError(
            f"the encoding cannot be read: {error}", location=Location(str(path), 1), fix="store the file as UTF-8"
        ) from error
    return roots[0]
