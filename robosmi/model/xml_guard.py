"""Protects lxml from XML files that expand entities without limit, and supports documents that are nested too deeply for it.

Entities can expand to any size, even inside attributes, where lxml expands them regardless of its options; so the beginning of
a file is examined first. Nothing here interprets elements.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any
from xml.parsers import expat

from robosmi.diagnostics import Location
from robosmi.errors import SourceError


class _Found(Exception):
    """Raised when the root element has been reached."""


def root_offset(data: bytes, place: str) -> int:
    """Where the root element begins in a file that declares no entities, so that a parser may go without its limits.

    Args:
        data: the file.
        place: its path, for the message.

    Returns:
        The offset; -1 if the head cannot be read here, because of its encoding or an error: let a parser with limits look at it.

    Raises:
        SourceError: it has a DOCTYPE with declarations of its own.
    """
    parser = expat.ParserCreate()

    def doctype(name: str, system: str | None, public: str | None, declares: bool) -> None:
        if declares:
            where = Location(place, parser.CurrentLineNumber)
            raise SourceError("a file that declares entities is refused", location=where, fix="remove the DOCTYPE")

    def start(name: str, attributes: Any) -> None:
        raise _Found(parser.CurrentByteIndex)

    parser.StartDoctypeDeclHandler = doctype
    parser.StartElementHandler = start
    try:
        parser.Parse(data, True)
    except _Found as found:
        return int(found.args[0])
    except (expat.ExpatError, LookupError, ValueError):  # the real parser says what is wrong, or knows the encoding
        pass
    return -1


def read_tree(data: bytes, place: str, deep: bool) -> Any:
    """The root of lxml's tree for a file.

    Args:
        data: the file.
        place: its path, for the message.
        deep: whether it is known to declare no entity and may be of any size and depth.

    Raises:
        SourceError: it is not well-formed.
    """
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=deep, strip_cdata=False)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        if deep and "xcessive depth" in (error.msg or ""):
            with suppress(expat.ExpatError):
                return _deep_tree(data)
        where = Location(place, error.lineno or None)
        raise SourceError(f"not well-formed XML: {error.msg}", location=where, fix="repair the file") from error


def _deep_tree(data: bytes) -> Any:
    """The root of lxml's tree for a document that is nested deeper than lxml's own parser goes (2,048 levels).

    Args:
        data: a file without entities, in an encoding that expat knows.

    Raises:
        ExpatError: it is not well-formed.
    """
    from lxml import etree

    parser = expat.ParserCreate(namespace_separator=" ")
    parser.buffer_text = True
    declared: dict[Any, str] = {}
    open_nodes: list[Any] = []
    roots: list[Any] = []

    def name(text: str) -> str:
        uri, _, local = text.rpartition(" ")
        return f"{{{uri}}}{local}" if uri else local

    def start(tag: str, attributes: dict[str, str]) -> None:
        nsmap: Any = dict(declared)
        declared.clear()
        named = {name(key): value for key, value in attributes.items()}
        node: Any
        if open_nodes:
            node = etree.SubElement(open_nodes[-1], name(tag), named, nsmap)
        else:
            node = etree.Element(name(tag), named, nsmap)
            roots.append(node)
        node.sourceline = parser.CurrentLineNumber
        open_nodes.append(node)

    def characters(text: str) -> None:
        above = open_nodes[-1]
        if len(above):
            above[-1].tail = (above[-1].tail or "") + text
        else:
            above.text = (above.text or "") + text

    def other(node: Any) -> None:
        if open_nodes:
            open_nodes[-1].append(node)

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: open_nodes.pop()
    parser.CharacterDataHandler = characters
    parser.CommentHandler = lambda text: other(etree.Comment(text))
    parser.ProcessingInstructionHandler = lambda target, text: other(etree.ProcessingInstruction(target, text))
    parser.StartNamespaceDeclHandler = lambda prefix, uri: declared.update({prefix: uri})
    parser.Parse(data, True)
    return roots[0]
