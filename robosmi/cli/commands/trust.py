"""`robosmi trust FOLDER`: what a folder's `.robosmi` holds may run from now on, as it is."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.base.trust import trust
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="a project, or its folder .robosmi")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    folder: Path


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.base.template_files import misnamed  # Jinja2

    report = Report("trust")
    folder, files = trust(arguments.folder)
    odd = misnamed(folder, files)
    report.result = {"folder": str(folder), "trusted": files, "misnamed": list(odd)}
    report.lines = [f"trusted in {folder}, until they change:", *(f"  {name}" for name in files)]
    report.lines += [f"{name} matches no template{meant}" for name, meant in odd.items()]
    return report
