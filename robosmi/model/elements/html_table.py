"""Tables and trees as HTML, for showing models, metamodels and elements in notebooks."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar

from robosmi.quoting import html_attribute

T = TypeVar("T")


def html_table(head: Iterable[str], lines: Iterable[Iterable[Any]]) -> str:
    """A table with a head; every cell is the text of its value, quoted for HTML."""

    def cells(tag: str, values: Iterable[Any]) -> str:
        return "<tr>" + "".join(f"<{tag}>{html_attribute(str(value))}</{tag}>" for value in values) + "</tr>"

    return f"<table><thead>{cells('th', head)}</thead><tbody>{''.join(cells('td', line) for line in lines)}</tbody></table>"


def tree_html(tops: Iterable[T], label: Callable[[T], str], contents: Callable[[T], Sequence[T]], limit: int = 200) -> str:
    """Elements with all that they contain, as a tree whose branches open and close; cut after a number of elements.

    Args:
        tops: the elements.
        label: what is shown of an element.
        contents: what an element contains.
        limit: the number of elements that are shown; behind the tree stands how many are left out.
    """
    lines: list[str] = []
    shown = left = 0
    pending: list[tuple[T, bool]] = [(top, False) for top in reversed(list(tops))]
    while pending:
        element, ends = pending.pop()
        if ends:
            lines.append("</ul></details></li>")
            continue
        inner = contents(element)
        if shown >= limit:
            left += 1
        elif inner:
            lines.append(f"<li><details><summary>{html_attribute(label(element))} ({len(inner)})</summary><ul>")
            pending.append((element, True))
        else:
            lines.append(f"<li>{html_attribute(label(element))}</li>")
        shown += 1
        pending.extend((child, False) for child in reversed(inner))
    more = f"<p>... and {left} more</p>" if left else ""
    return f"<ul>{''.join(lines)}</ul>{more}" if lines else ""
