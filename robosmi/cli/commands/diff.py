"""`robosmi diff A B`: what is different about two models or two migrations.

With `-o FILE.html`, also as a page of one file, to read and to print.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.base.data_text import Json, json_written
from robosmi.base.quantities import quantity
from robosmi.cli.common import check_replaced
from robosmi.errors import UsageError
from robosmi.plugins import content
from robosmi.quoting import html, html_attribute
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import ComparedOutputs
    from robosmi.cli.options import Options
    from robosmi.model.comparison.comparison import Difference

_HEAD = ("kind", "element", "place", "feature", "before", "after")
_STYLE = """body { font: 1rem/1.4 sans-serif; margin: 2rem }
table { border-collapse: collapse }
th, td { border: 1px solid #bbb; padding: .25rem .5rem; text-align: left; vertical-align: top; overflow-wrap: anywhere }"""


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("before", metavar="A", type=Path, help="a model in XMI, JSON (.json) or .ecore, or an output folder")
    parser.add_argument("after", metavar="B", type=Path, help="a second model of the same metamodel, or another output folder")
    parser.add_argument(
        "--metamodel", dest="metamodels", action="append", default=[], metavar="X.ecore", type=Path,
        help="metamodel of both models; repeatable",
    )  # fmt: skip
    parser.add_argument("-o", dest="page", metavar="FILE.html", type=Path, help="also write the differences as a page")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    before: Path
    after: Path
    metamodels: list[Path]
    page: Path | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.api import compare
    from robosmi.files.files import write_atomic

    report = Report("diff")
    others = [path for path in (arguments.before, arguments.after) if not (path / "models" / "plan.xmi").is_file()]
    if not others:
        return _outputs(report, arguments)
    if len(others) == 1:
        raise UsageError(f"{others[0]} is no output folder, and the other one is", fix="give two output folders, or two models")
    found = compare(arguments.before, arguments.after, metamodel=arguments.metamodels)
    report.findings = found.findings
    report.result = {"equal": found.equal, "changes": [change.to_json() for change in found.changes]}
    report.lines = found.lines() or ["no difference"]
    if arguments.page is not None:
        check_replaced(arguments.page, b"<!DOCTYPE html>", "page")
        page = _comparison_page(str(arguments.before), str(arguments.after), found.changes)
        write_atomic(arguments.page, page.encode("utf-8", "replace"))
        report.artifacts = [{"path": str(arguments.page), "kind": "page"}]
        report.lines.append(f"wrote {arguments.page}")
    report.failure_code, report.ok = 1, found.equal
    return report


def _outputs(report: Report, arguments: _Arguments) -> Report:
    """Compare two output folders."""
    if arguments.page is not None:
        raise UsageError("-o needs two models", fix="name both plans: A/models/plan.xmi B/models/plan.xmi")
    done: ComparedOutputs = content("chain", "output_diff")(arguments.before, arguments.after)
    report.result = {"equal": done.equal, "board": done.board, "choices": done.choices, "diff": done.text}
    report.lines = done.lines() or ["no difference"]
    report.failure_code, report.ok = 1, done.equal
    return report


def _comparison_page(before: str, after: str, changes: Iterable[Difference]) -> str:
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
