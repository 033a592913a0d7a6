"""`robosmi targets`: the boards that programs can be moved to, and what results for them are proven by on this machine."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import ListedTargets
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options: it has none of its own."""


def run(arguments: argparse.Namespace) -> Report:
    """Run the command."""
    report = Report("targets")
    found: ListedTargets = content("chain", "targets")()
    report.result, report.lines = found.result, found.lines()
    return report
