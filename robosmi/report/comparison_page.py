"""The differences of two models as a page of one file, to read and to print."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from robosmi.base.data_text import Json, json_written
from robosmi.base.quantities import quantity
from robosmi.quoting import html, html_attribute

if TYPE_CHECKING:
    from robosmi.model.comparison.comparison import Difference

_HEAD = ("kind", "element", "place", "feature", "before", "after")
_STYLE = """body { font: 1rem/1.4 sans-serif; margin: 2rem }
table { border-collapse: collapse }
th, td { border: 1px solid #bbb; padding: .25rem .5rem; text-align: left; vertical-align: top; overflow-wrap: anywhere }"""


def comparison_page(before: str, after: str, changes: Iterable[Difference]) -> str:
    """The text of the page, in HTML.

    Args:
        before: what the first model is called.
        after: what the second is called.
        changes: the differences, one row each.
    """
    rows = [(change.kind, change.name, change.element, change.feature, change.before, change.after) for change in changes]
    title = html(f"{before} and {after}")
    body = [f"<p>{quantity(len(rows), 'difference') if rows else 'No difference.'}</p>"]
    if rows:
        head = "".join(f'<th scope="col">{name}</th>' for name in _HEAD)
        body += ["<table>", f"<thead><tr>{head}</tr></thead>", "<tbody>"]
        for kind, *cells in rows:
            shown = "".join(f"<td>{html(_text(cell))}</td>" for cell in (kind, *cells))
            body.append(f'<tr data-kind="{html_attribute(kind)}">{shown}</tr>')
        body += ["</tbody>", "</table>"]
    lines = [
        "<!DOCTYPE html>", '<html lang="en">', '<head><meta charset="utf-8">', f"<title>{title}</title>",
        f"<style>{_STYLE}</style></head>", "<body>", f"<h1>{title}</h1>", *body, "</body>", "</html>",
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def _text(value: Json) -> str:
    return "" if value is None else value if isinstance(value, str) else json_written(value, ensure_ascii=False)
