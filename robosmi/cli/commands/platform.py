"""`robosmi platform import DIR --name NAME`: headers into a source platform of the user's own."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import ImportedPlatform
    from robosmi.cli.options import ActionOptions


def configure(parser: ActionOptions) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    taking = actions.add_parser("import", help="read the headers of a folder")
    taking.add_argument("folder", metavar="DIR", type=Path, help="folder with the platform's headers")
    taking.add_argument("--name", metavar="NAME", required=True, help="name for --source-platform")
    taking.add_argument("--like", metavar="NAME", help="known platform with the same compiler settings and semantics")
    taking.add_argument(
        "-I",
        dest="include_dirs",
        action="append",
        default=[],
        metavar="DIR",
        type=Path,
        help="folder that the headers include from",
    )
    taking.add_argument("-D", dest="defines", action="append", default=[], metavar="NAME", help="define a macro")
    taking.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    folder: Path
    name: str
    like: str | None
    include_dirs: list[Path]
    defines: list[str]


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("platform")
    done: ImportedPlatform = content("chain", "platform_import")(
        arguments.folder, arguments.name, arguments.like, arguments.include_dirs, arguments.defines
    )
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    report.artifacts = [{"path": path, "kind": "platform"} for path in done.written]
    return report
