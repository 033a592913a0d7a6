"""`robosmi generate plan.xmi -o OUT`: the sketch again, from a stored plan and the models beside it alone."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.commands.migrate import filled
from robosmi.cli.common import output_folder
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import MigratedSketch
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("plan", metavar="plan.xmi", type=Path, help="a stored plan, edited or not")
    parser.add_argument("-o", dest="output", metavar="OUT", type=output_folder, required=True, help="output folder")
    parser.add_argument(
        "--bench", action="store_true", help="also generate OUT/bench, a sketch that tests one component at a time"
    )
    parser.add_argument("--dry-run", action="store_true", help="show what would be generated; write nothing")
    parser.add_argument("--strict", action="store_true", help="stop if a choice is open")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    plan: Path
    output: Path
    bench: bool
    dry_run: bool
    strict: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("generate")
    done: MigratedSketch = content("chain", "generate")(
        arguments.plan, arguments.output, dry_run=arguments.dry_run, strict=arguments.strict, bench=arguments.bench
    )
    return filled(report, done, {}, ())
