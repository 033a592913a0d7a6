"""`robosmi diff A B`: what is different about two models or two migrations."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import check_replaced
from robosmi.errors import UsageError
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import ComparedOutputs
    from robosmi.cli.options import Options


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
    from robosmi.report.comparison_page import comparison_page

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
        page = comparison_page(str(arguments.before), str(arguments.after), found.changes)
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
