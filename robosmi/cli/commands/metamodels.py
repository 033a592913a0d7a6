"""`robosmi metamodels export DIR` and `robosmi metamodels generate X.ecore... -o DIR`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi import inputs
from robosmi.cli.common import output_folder
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import ActionOptions


def configure(parser: ActionOptions) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    export = actions.add_parser("export", help="write the .ecore files, for Eclipse")
    export.add_argument("folder", metavar="DIR", type=Path)
    generate = actions.add_parser("generate", help="generate typed Python packages from .ecore files and those they refer to")
    generate.add_argument("metamodels", metavar="X.ecore", type=Path, nargs="+")
    generate.add_argument("-o", dest="output", metavar="DIR", type=output_folder, required=True)
    for sub in (export, generate):
        sub.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    action: str
    folder: Path
    metamodels: list[Path]
    output: Path


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("metamodels")
    if arguments.action == "export":
        _export(report, arguments.folder)
    else:
        _generate(report, arguments.metamodels, arguments.output)
    return report


def _export(report: Report, folder: Path) -> None:
    from robosmi.files.files import write_atomic
    from robosmi.resources import built_in

    written = []
    for source in sorted(built_in("metamodels").glob("*.ecore")):
        write_atomic(folder / source.name, inputs.read_bytes(source, inputs.MODEL))
        written.append(folder / source.name)
    report.artifacts = [{"path": str(path), "kind": "metamodel"} for path in written]
    report.result = {"written": [str(path) for path in written], "skipped": [], "missing": []}
    report.lines = [f"wrote {path}" for path in written]


def _generate(report: Report, metamodels: list[Path], folder: Path) -> None:
    from robosmi.generate.packages import generate_packages

    made = generate_packages(metamodels, folder)
    report.artifacts = [{"path": str(path), "kind": "python"} for path in sorted(made.sources)]
    report.result = {
        "written": [str(path) for path in made.written],
        "skipped": [{"path": str(path), "why": "unchanged"} for path in made.unchanged],
        "missing": [],
        "removed": [str(path) for path in made.removed],
        "sources": {str(path): str(source) for path, source in sorted(made.sources.items())},
        "classes": made.classes,
    }
    report.findings = made.findings
    report.lines = [f"wrote {path}" for path in made.written]
    report.lines += [f"removed {path}" for path in made.removed]
    if made.unchanged:
        report.lines.append(f"{len(made.unchanged)} file(s) are up to date")
