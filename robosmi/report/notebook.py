"""How findings, rankings and pictures look in a notebook: HTML without scripts, every text of a file or model quoted.

Elements and models are `robosmi.model.show`'s; what a plan or a circuit shows is the content's (registry kind `view`).
"""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from typing import Any

from robosmi.diagnostics import Finding, Severity
from robosmi.quoting import html_attribute

SHOWN = 200
"""Rows of a table; more are counted."""
_COLOURS = {Severity.error: "#b3261e", Severity.warning: "#8a5a00", Severity.info: "#31588a"}
_LEFT = "text-align:left;vertical-align:top"


class Findings(list[Finding]):
    """Findings or tasks in their order, which a notebook shows as a table, the worst first."""

    def _repr_html_(self) -> str:
        return findings_html(self)


def findings_html(findings: Sequence[Finding]) -> str:
    """A table of findings, the worst first: level, rule, place, message and what to do."""
    counts = [(level, sum(f.severity is level for f in findings)) for level in sorted(Severity, reverse=True)]
    head = ", ".join(f"{count} {level.name}" for level, count in counts if count) or "no findings"
    rows = []
    for finding in sorted(findings, key=lambda f: -f.severity):
        level = f'<b style="color:{_COLOURS[finding.severity]}">{finding.severity.name}</b>'
        place = str(finding.location) if finding.location is not None else ""
        rows.append([level, *(quoted(text) for text in (finding.rule, place, finding.message, finding.fix or ""))])
    return f"<p>{quoted(head)}</p>{table(('level', 'rule', 'place', 'message', 'what to do'), rows) if rows else ''}"


def table(head: Iterable[str], rows: Sequence[Sequence[str]]) -> str:
    """A table whose cells are HTML; rows beyond a number are counted.

    Args:
        head: the texts of its head.
        rows: the cells, made of quoted texts.
    """
    first = "".join(f'<th style="{_LEFT}">{quoted(text)}</th>' for text in head)
    lines = ("<tr>" + "".join(f'<td style="{_LEFT}">{cell}</td>' for cell in row) + "</tr>" for row in rows[:SHOWN])
    left = f"<p>... and {len(rows) - SHOWN} more</p>" if len(rows) > SHOWN else ""
    return f"<table><thead><tr>{first}</tr></thead><tbody>{''.join(lines)}</tbody></table>{left}"


def bar(share: float) -> str:
    """A bar of a width between 0 and 1, with its percentage."""
    width = round(100 * max(0.0, min(1.0, share)))
    inner = f'<div style="background:#31588a;height:0.7em;width:{width}%"></div>'
    return f'<div style="width:8em;background:#dde4ee" title="{width} %">{inner}</div>'


def picture(svg: str, about: str) -> str:
    """An SVG as a self-contained picture that cannot affect the rest of the notebook.

    Args:
        svg: the text of an SVG document.
        about: the alternative text.
    """
    data = base64.b64encode(svg.encode()).decode()
    return f'<img alt="{quoted(about)}" style="max-width:100%;background:white" src="data:image/svg+xml;base64,{data}"/>'


def quoted(value: Any) -> str:
    """A value's text, quoted for HTML."""
    return str(html_attribute(str(value)))
