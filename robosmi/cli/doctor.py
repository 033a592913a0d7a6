"""`robosmi doctor`: what is installed, what is missing and does not work without it, and own boards that a core contradicts."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """The command has no options of its own."""


def run(arguments: argparse.Namespace) -> Report:
    """Run the command."""
    from robosmi.verify.doctor import own_boards, tools

    report = Report("doctor")
    found = tools()
    report.result = {"tools": [tool.to_json() for tool in found]}
    width = max(len(tool.name) for tool in found)
    for tool in found:
        state = f"{tool.version or 'found'}" if tool.found else "missing"
        report.lines.append(f"{tool.name:{width}}  {state:12}  {tool.needed_for}")
        if not tool.found and tool.gives:
            report.lines.append(f"{'':{width}}  gives: {tool.gives}")
        if not tool.found and tool.fix:
            report.lines.append(f"{'':{width}}  do: {tool.fix}")
    report.findings = own_boards()
    return report
