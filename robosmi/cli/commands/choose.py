"""`robosmi choose OUT ID=VALUE...`: make a choice of a migration's plan, and the sketch again."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.commands.migrate import filled
from robosmi.cli.common import output_folder, pairs
from robosmi.errors import UsageError
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import ChosenSketch
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=output_folder, help="output folder of migrate or generate")
    parser.add_argument(
        "answers", metavar="ID=VALUE", nargs="*",
        help="a choice (port:NAME, library:ID, or the name of a port or component) and a pin, a connection, a library or none",
    )  # fmt: skip
    parser.add_argument("--reopen", action="append", default=[], metavar="ID", help="open a choice again")
    parser.add_argument("--why", default="", metavar="TEXT", help="reason, stored in the plan")
    parser.add_argument("--source", metavar="FILE", type=Path, help="a source file of the program, next to robosmi.toml")
    parser.add_argument(
        "--history", metavar="PLACE", help="file or SQLAlchemy URL of the library history (default: the user's own)"
    )
    parser.add_argument("--dry-run", action="store_true", help="show what would be generated; write nothing")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    answers: list[str]
    reopen: list[str]
    why: str
    source: Path | None
    history: str | None
    dry_run: bool
    verbose: bool


def run(arguments: _Arguments) -> Report:
    """Run the command.

    Raises:
        UsageError: nothing is chosen, or a choice comes twice.
    """
    report = Report("choose")
    answers = pairs(arguments.answers, "choose")
    if twice := set(answers) & set(arguments.reopen):
        raise UsageError(f"'{min(twice)}' is both chosen and opened", fix="give only one of them")
    if not answers and not arguments.reopen:
        raise UsageError("no choice is given", fix="give ID=VALUE; robosmi open shows the choices")
    done: ChosenSketch = content("chain", "choose")(
        arguments.output, answers | dict.fromkeys(arguments.reopen, ""), why=arguments.why, source=arguments.source,
        dry_run=arguments.dry_run, history=arguments.history,
    )  # fmt: skip
    filled(report, done, done.settings.severity, done.settings.accept)
    if arguments.verbose:
        report.lines = done.lines(every_file=True)
    return report
