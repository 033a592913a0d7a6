"""A table as HTML, as notebooks show models, metamodels and elements. What stands in the cells is the caller's business."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from robosmi.quoting import html_attribute


def html_table(head: Iterable[str], lines: Iterable[Iterable[Any]]) -> str:
    """A table with a head; every cell is the text of its value, quoted for HTML."""

    def cells(tag: str, values: Iterable[Any]) -> str:
        return "<tr>" + "".join(f"<{tag}>{html_attribute(str(value))}</{tag}>" for value in values) + "</tr>"

    return f"<table><thead>{cells('th', head)}</thead><tbody>{''.join(cells('td', line) for line in lines)}</tbody></table>"
