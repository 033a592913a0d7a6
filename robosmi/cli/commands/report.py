"""`robosmi report OUT -o FILE.html`: the page of a migration as one file, to read, to print and to take to the bench."""

from __future__ import annotations

import argparse
import secrets
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import check_replaced, output_folder
from robosmi.files.files import write_atomic
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=output_folder, help="output folder of migrate or generate")
    parser.add_argument("-o", dest="path", required=True, metavar="FILE.html", type=Path, help="file to write")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    path: Path


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("report")
    text: str = content("chain", "report_page")(arguments.output, secrets.token_urlsafe(16))
    check_replaced(arguments.path, b"<!DOCTYPE html>", "page")
    write_atomic(arguments.path, text.encode("utf-8", "replace"))
    report.result = {"path": str(arguments.path)}
    report.artifacts = [{"path": str(arguments.path), "kind": "report"}]
    report.lines = [f"wrote {arguments.path}"]
    return report
