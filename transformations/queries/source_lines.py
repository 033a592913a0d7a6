"""Lines of the source that elements of the code model are in."""

from __future__ import annotations

from collections.abc import Mapping

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind

_LONGEST = 120


def line_of(element: ccode.Located | None, sources: Mapping[str, bytes]) -> str:
    """The source line of an element with its number in front; empty if the source is not stored.

    Args:
        element: an element of the code model.
        sources: path of a unit -> its bytes.
    """
    unit = ancestor_of_kind(element, ccode.SourceUnit) if element is not None else None
    if element is None or unit is None or unit.path not in sources:
        return ""
    lines = sources[unit.path].decode("utf-8", "replace").splitlines()
    if not 0 < element.line <= len(lines):
        return ""
    text = " ".join(lines[element.line - 1].split())
    return f"{element.line}: {text if len(text) <= _LONGEST else f'{text[:_LONGEST]} ...'}"
