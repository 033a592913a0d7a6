"""`robosmi hardware SKETCH`: which pin of the drawn board drives which component."""

from __future__ import annotations

import argparse
from pathlib import Path

from robosmi.cli.common import project_of, write_model
from robosmi.plugins import content
from robosmi.report import Report


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's options."""
    parser.add_argument("sketch", metavar="SKETCH", type=Path, help="the drawing")
    parser.add_argument("-o", dest="output", metavar="hardware.xmi", type=Path, help="store the hardware model as XMI")


def run(arguments: argparse.Namespace) -> Report:
    """Run the command."""
    report = Report("hardware")
    project = project_of(arguments.sketch)
    done = content("chain", "hardware")(arguments.sketch, roles=project.roles)
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    report.judge(project.severity, project.accept)
    if arguments.output:
        report.artifacts.append(write_model(done.circuit, arguments.output))
    return report
