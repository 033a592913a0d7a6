"""The comments and processing instructions of an XML file, which a model does not contain; needed when a file is overwritten."""

from __future__ import annotations

from contextlib import suppress
from xml.parsers import expat

XSI = "http://www.w3.org/2001/XMLSchema-instance"


def comments(data: bytes) -> list[tuple[int, str]]:
    """The comments and processing instructions of an XML file.

    Args:
        data: the file; what stands behind an error is not looked at.

    Returns:
        Line (from 1) and text of each, in their order.
    """
    found: list[tuple[int, str]] = []
    if b"<!--" not in data and data.count(b"<?") <= data.startswith(b"<?xml ") and data.find(b"\0", 0, 4) < 0:
        return found  # one byte a character, and none begins
    parser = expat.ParserCreate()
    parser.CommentHandler = lambda text: found.append((parser.CurrentLineNumber, text))
    parser.ProcessingInstructionHandler = lambda target, text: found.append((parser.CurrentLineNumber, f"{target} {text}"))
    with suppress(expat.ExpatError, LookupError, ValueError):
        parser.Parse(data, True)
    return found


def qualified_names(data: bytes) -> set[str]:
    """The names of elements and attributes that have a namespace other than xsi's, as `NAMESPACE NAME`."""
    found: set[str] = set()
    parser = expat.ParserCreate(namespace_separator=" ")
    parser.StartElementHandler = lambda name, attributes: found.update((name, *attributes))
    with suppress(expat.ExpatError, LookupError, ValueError):
        parser.Parse(data, True)
    return {name for name in found if " " in name and not name.startswith(f"{XSI} ")}


def comments_lost(old: bytes, new: bytes) -> list[int]:
    """The lines of a file with comments and processing instructions that the new file lacks."""
    staying = {text for _, text in comments(new)}
    return [line for line, text in comments(old) if text not in staying]


def lost_comments(lost: list[int], kept: str) -> str:
    """The message of a finding about comments that were lost.

    Args:
        lost: their lines.
        kept: the name of the file that holds what the old one held.
    """
    number = f"{len(lost)} comments are" if len(lost) > 1 else "a comment is"
    return f"{number} not in the file any more: a model holds none; the old file is kept as {kept}"
