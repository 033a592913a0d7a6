"""`robosmi undo OUT`: the files of an output folder as they were before the last run, or before several."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from robosmi.cli.common import command_line, output_folder
from robosmi.errors import UsageError
from robosmi.generate.undo import UndoStep, steps, undo
from robosmi.report import Report

if TYPE_CHECKING:
    from pathlib import Path

    from robosmi.cli.options import Options


_SHOWN = 3
"""Files that are named of a step."""


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=output_folder, help="output folder of migrate or generate")
    parser.add_argument("--list", action="store_true", help="list the runs that can be undone; change nothing")
    parser.add_argument("--steps", metavar="N", type=int, help="undo the last N runs (default: the last run or undo)")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    list: bool
    steps: int | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("undo")
    if arguments.steps is not None and (arguments.list or arguments.steps < 1):
        raise UsageError("--steps takes a number from 1, and no --list", fix="see the numbers with --list first")
    if arguments.list:
        found = steps(arguments.output)
        report.result = {
            "steps": [
                {"number": step.number, "at": step.at or None, "run": step.run or None, "files": list(step.files)}
                for step in found
            ]
        }
        report.lines = [_line(step) for step in found]
        report.next = command_line("undo", arguments.output)
        return report
    done = undo(arguments.output, arguments.steps)
    report.result = {"restored": done.restored, "removed": done.removed}
    report.lines = [f"undone: {'; '.join(done.runs)}"] * bool(done.runs)
    report.lines += [f"restored in {arguments.output}:", *(f"  {name}" for name in done.restored)]
    report.lines += [f"  {name} (removed)" for name in done.removed]
    if (arguments.output / "models").is_dir():
        report.next = command_line("open", arguments.output)
    return report


def _line(step: UndoStep) -> str:
    """A step as the user reads it: its number, when it ran, its command or choice, and what it changed."""
    named = [*step.files[:_SHOWN], *[f"and {len(step.files) - _SHOWN} more"] * (len(step.files) > _SHOWN)]
    what = "undone; undo again to redo it" if step.number == 0 else f"--steps {step.number}"
    run = f"{step.run}: " if step.run else ""
    return f"{what:16} {step.at.replace('T', ' ').removesuffix('Z') or 'earlier':20} {run}{', '.join(named)}"
