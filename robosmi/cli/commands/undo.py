"""`robosmi undo OUT`: the files of an output folder as they were before the last run."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from robosmi.cli.common import output_folder
from robosmi.generate.undo import undo
from robosmi.report import Report

if TYPE_CHECKING:
    from pathlib import Path

    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=output_folder, help="output folder of migrate or generate")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("undo")
    done = undo(arguments.output)
    report.result = {"restored": done.restored, "removed": done.removed}
    report.lines = [f"restored in {arguments.output}:", *(f"  {name}" for name in done.restored)]
    report.lines += [f"  {name} (removed)" for name in done.removed]
    return report
