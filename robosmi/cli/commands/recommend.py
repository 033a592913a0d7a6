"""`robosmi recommend SKETCH` or `--components FILE.json`: which library drives which component."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import command_line
from robosmi.errors import UsageError
from robosmi.plugins import content
from robosmi.project import project_of
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import RankedLibraries
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("sketch", metavar="SKETCH", nargs="?", type=Path, help="the drawing")
    parser.add_argument("--components", metavar="FILE.json", type=Path, help="components as JSON instead of a drawing")
    parser.add_argument("--ranker", metavar="NAME", help="ranker to use")
    parser.add_argument(
        "--history", metavar="PLACE", help="file or SQLAlchemy URL of the library history (default: the user's own)"
    )


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    sketch: Path | None
    components: Path | None
    ranker: str | None
    history: str | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    given = arguments.sketch or arguments.components
    if given is None or (arguments.sketch is not None and arguments.components is not None):
        raise UsageError("give either a drawing or --components", fix="see: robosmi recommend --help")
    report = Report("recommend")
    project = project_of(given)
    done: RankedLibraries = content("chain", "recommend")(
        arguments.sketch,
        components=arguments.components,
        ranker=arguments.ranker or project.ranker,
        roles=project.roles,
        history=arguments.history,
    )
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    report.judge(project.severity, project.accept)
    if arguments.sketch is not None:
        report.next = command_line("migrate", "PROGRAM.c", "--hardware", arguments.sketch, "-o", "OUT")
    return report
