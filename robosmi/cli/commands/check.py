"""`robosmi check MODEL|DRAWING|PLAN`: findings of all constraints that are registered for the model's metamodel."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import command_line
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import CheckedModel
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("model", metavar="MODEL|DRAWING|PLAN", type=Path, help="a drawing, a stored plan.xmi or another model")
    parser.add_argument("--target", metavar="NAME", help="target whose board the drawing shows (default: as in migrate)")
    parser.add_argument(
        "--metamodel", dest="metamodels", action="append", default=[], metavar="X.ecore", type=Path,
        help="metamodel of an XMI model; repeatable",
    )  # fmt: skip


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    model: Path
    target: str | None
    metamodels: list[Path]


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("check")
    done: CheckedModel = content("chain", "check")(arguments.model, arguments.metamodels, arguments.target)
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    report.judge(done.project.severity, done.project.accept)
    if arguments.model.is_dir() and not report.exit_code("error"):
        report.next = command_line("compile", arguments.model)
    return report
