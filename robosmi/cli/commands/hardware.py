"""`robosmi hardware SKETCH`: which pin of the drawn board drives which component; as a table, a model, a picture."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import check_replaced, command_line, write_model
from robosmi.cli.progress import progress
from robosmi.files.files import write_atomic
from robosmi.plugins import content
from robosmi.project import project_of
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import AnalysedDrawing
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("sketch", metavar="SKETCH", type=Path, help="the drawing, or a pin table (.csv, .toml)")
    parser.add_argument("--target", metavar="NAME", help="target whose board the drawing shows (default: as in migrate)")
    parser.add_argument("-o", dest="output", metavar="hardware.xmi", type=Path, help="store the hardware model as XMI")
    parser.add_argument("--svg", metavar="FILE", type=Path, help="draw board, nets and components, with errors marked")
    parser.add_argument("--write-table", metavar="FILE", type=Path, help="write the wiring as a pin table (.csv or .toml)")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    sketch: Path
    target: str | None
    output: Path | None
    svg: Path | None
    write_table: Path | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("hardware")
    project = project_of(arguments.sketch)
    with progress() as told:
        given, target = arguments.sketch, arguments.target
        done: AnalysedDrawing = content("chain", "hardware")(given, roles=project.roles, target=target, progress=told)
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    report.judge(project.severity, project.accept)
    if report.ok:
        report.next = command_line("migrate", "PROGRAM.c", "--hardware", arguments.sketch, "-o", "OUT")
    if arguments.output:
        report.artifacts.append(write_model(done.circuit, arguments.output))
    if arguments.svg:
        check_replaced(arguments.svg, b"<svg", "picture")
        _write(report, arguments.svg, done.picture(), "picture")
    if arguments.write_table:
        _write(report, arguments.write_table, done.pin_table(arguments.write_table), "pin table")
    return report


def _write(report: Report, path: Path, text: str, kind: str) -> None:
    write_atomic(path, text.encode())
    report.artifacts.append({"path": str(path), "kind": kind})
