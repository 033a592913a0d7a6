"""`robosmi wiring OUT --as FORM -o PATH`: the wiring of a migration for another tool, as a table, or as a picture."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Final

from robosmi.cli.common import output_folder
from robosmi.errors import UsageError
from robosmi.plugins import content, registry
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import HandedWiring
    from robosmi.cli.options import Options

FORM: Final = "wiring form"
"""The registry's kind of forms."""


def configure(parser: Options) -> None:
    """Add the command's options."""
    forms = registry().names(FORM)
    parser.add_argument("output", metavar="OUT", type=output_folder, help="output folder of migrate or generate")
    parser.add_argument("--as", dest="form", required=True, choices=forms, help=f"output form: {', '.join(forms)}")
    parser.add_argument("-o", dest="path", required=True, metavar="PATH", type=Path, help="file, or folder of the project")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    form: str
    path: Path


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("wiring")
    if not str(arguments.path).strip("\0 "):
        raise UsageError("the path for the wiring is empty", fix="give a file or a folder: -o PATH")
    done: HandedWiring = content("chain", "wiring")(arguments.output, arguments.form, arguments.path)
    report.result = {"form": arguments.form, "path": str(arguments.path), **done.result}
    report.findings, report.artifacts = list(done.findings), done.artifacts()
    report.lines = [f"wrote {artifact['path']}" for artifact in report.artifacts]
    report.judge(done.project.severity, done.project.accept)
    return report
