"""`robosmi adapters list`, `show NAME` and `save OUT`: what fills calls of the source platform, and bodies of the user's own."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import AdapterAnswer
    from robosmi.cli.options import ActionOptions


def configure(parser: ActionOptions) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    listing = actions.add_parser("list", help="list the functions with an adapter, and its origin")
    showing = actions.add_parser("show", help="show an adapter with its text")
    showing.add_argument("name", metavar="NAME", help="a function of the source platform, or HEADER/NAME")
    saving = actions.add_parser("save", help="save bodies written in a generated program as adapter files")
    saving.add_argument("output", metavar="OUT", type=Path, help="output folder of migrate")
    saving.add_argument(
        "--as", dest="whose", choices=("user", "project"), default="user",
        help="user: for all your programs (default); project: next to robosmi.toml, for this project",
    )  # fmt: skip
    for action in (listing, showing):
        action.add_argument("--target", metavar="NAME", help="target (default: as in migrate)")
        action.add_argument("--source-platform", metavar="NAME", help="source platform (default: as in migrate)")
    for action in (listing, showing, saving):
        action.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    action: str
    target: str | None
    source_platform: str | None
    name: str
    output: Path
    whose: str


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("adapters")
    if arguments.action == "list":
        done: AdapterAnswer = content("chain", "adapters_list")(arguments.target, arguments.source_platform)
    elif arguments.action == "show":
        done = content("chain", "adapters_show")(arguments.name, arguments.target, arguments.source_platform)
    else:
        done = content("chain", "adapters_save")(arguments.output, arguments.whose)
        report.artifacts = [{"path": path, "kind": "adapters"} for path in done.written]
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    return report
