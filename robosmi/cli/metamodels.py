"""`robosmi metamodels export DIR` and `robosmi metamodels generate X.ecore -o DIR`."""

from __future__ import annotations

import argparse
from pathlib import Path

from robosmi.report import Report


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    export = actions.add_parser("export", help="write the .ecore files for Eclipse users")
    export.add_argument("folder", metavar="DIR", type=Path)
    generate = actions.add_parser("generate", help="generate Python packages from an .ecore file")
    generate.add_argument("metamodel", metavar="X.ecore", type=Path)
    generate.add_argument("-o", dest="output", metavar="DIR", type=Path, required=True)
    for sub in (export, generate):
        sub.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


def run(arguments: argparse.Namespace) -> Report:
    """Run the command."""
    report = Report("metamodels")
    written = _export(arguments.folder) if arguments.action == "export" else _generate(arguments.metamodel, arguments.output)
    report.artifacts = [{"path": str(path), "kind": "metamodel" if path.suffix == ".ecore" else "python"} for path in written]
    report.result = {"written": [str(path) for path in written], "skipped": [], "missing": []}
    report.lines = [f"wrote {path}" for path in written]
    return report


def _export(folder: Path) -> list[Path]:
    from robosmi.model.files import write_atomic
    from robosmi.resources import built_in

    written = []
    for source in sorted(built_in("metamodels").glob("*.ecore")):
        write_atomic(folder / source.name, source.read_bytes())
        written.append(folder / source.name)
    return written


def _generate(metamodel: Path, folder: Path) -> list[Path]:
    from robosmi.model.codegen import generate

    return generate(metamodel, folder)
