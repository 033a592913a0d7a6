"""Reads XML into lxml's tree, protected from files that expand entities without limit.

Entities can expand to any size, even inside attributes, where lxml expands them regardless of its options; so the beginning of
a file is examined first. Nothing here interprets elements.
"""

from __future__ import annotations

import re
from typing import Any
from xml.parsers import expat

from robosmi.diagnostics import Location
from robosmi.errors import SourceError

_TOO_DEEP = re.compile(r"Excessive depth in document: (\d+)")
"""libxml2's message about a file that is nested deeper than it reads."""


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
        deep: whether it is known to declare no entity, so that it may be of any size, and 2,048 levels deep instead of 256.

    Raises:
        SourceError: it is not well-formed, or nested too deeply.
    """
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=deep, strip_cdata=False)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        where = Location(place, error.lineno or None)
        if match := _TOO_DEEP.search(error.msg or ""):
            raise SourceError(
                f"elements are nested more than {match[1]} levels deep",
                location=where,
                fix="nest the elements of the file less deeply",
            ) from error
        raise SourceError(f"not well-formed XML: {error.msg}", location=where, fix="repair the file") from error
