"""Reads XML of drawings with lxml: no network access, no external or internal entities, bounded size.

A document type is refused, except the one that a tool writes into each file (EAGLE's names its grammar): it must contain no
declarations, and the file it names is not opened. What the elements mean is left to each tool's reader.
"""

from __future__ import annotations

import re
from typing import Any

from lxml import etree

from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError

MAX_TAGS = 2_000_000
"""Tags in one XML text: the largest public sketch has under 60,000."""

_DOCTYPE = re.compile(rb"\A(?:\xef\xbb\xbf)?(?:\s++|(?><\?.*?\?>)|(?><!--.*?-->))*+<!DOCTYPE", re.DOTALL)
_PLAIN = re.compile(rb"\s+([A-Za-z]+)(?:\s+SYSTEM\s+(?:\"[^\"<>\[]*\"|'[^'<>\[]*'))?\s*>")


def parse_xml(
    data: bytes, path: str, what: str, tool: str = "Fritzing", doctype: str = "", *, blanks: bool = True
) -> etree._Element:
    """The root of an XML text.

    Args:
        data: the text.
        path: file to name in an error.
        what: name of the text in that file, for the message.
        tool: the drawing tool that writes such files, for the message.
        doctype: name of the document type that the tool writes; empty where it writes none.
        blanks: whether texts of nothing but blanks between elements are kept; some stay in any case.

    Raises:
        SourceError: it is not well-formed, has too many tags, or has another document type or one with declarations.
    """
    allowed = False
    if found := _DOCTYPE.match(data):
        plain = _PLAIN.match(data, found.end())
        allowed = plain is not None and bool(doctype) and plain[1] == doctype.encode()
        if not allowed:
            raise _refused_doctype(path, what, tool, data.count(b"\n", 0, found.end()) + 1, doctype)
    if data.count(b"<") > MAX_TAGS:
        raise TooLargeError(
            f"'{what}' has more than {MAX_TAGS:_} tags".replace("_", ","),
            location=Location(path),
            fix=f"check that it is a drawing of {tool}",
        )
    parser = etree.XMLParser(
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        dtd_validation=False,
        huge_tree=False,
        remove_comments=True,
        remove_pis=True,
        remove_blank_text=not blanks,
    )
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        line, column = error.position
        place = Location(path, line or None, column or None)
        cause = (error.msg or "not XML").partition(", line")[0].partition(", use XML_PARSE")[0]
        raise SourceError(
            f"'{what}' is not well-formed XML: {cause}", location=place, fix=f"open it in {tool} and save it again"
        ) from error
    docinfo: Any = root.getroottree().docinfo
    if docinfo.doctype and not allowed:  # written in an encoding that the test above does not see through
        raise _refused_doctype(path, what, tool, 1, doctype)
    return root


def line_of(element: etree._Element) -> int:
    """The line that contains an element."""
    line = element.sourceline
    return line if isinstance(line, int) else 1


def _refused_doctype(path: str, what: str, tool: str, line: int, doctype: str) -> SourceError:
    if doctype:
        odd = f"a DOCTYPE with declarations, or another one than {tool} writes, and it"
    else:
        odd = f"a DOCTYPE, which {tool} never writes and which"
    return SourceError(
        f"'{what}' has {odd} is refused",
        location=Location(path, line),
        fix=f"remove the DOCTYPE, or open it in {tool} and save it again",
    )
