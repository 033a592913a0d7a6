"""`robosmi doctor`: what is installed, what is missing, the registered content, and own boards that a core contradicts."""

from __future__ import annotations

import argparse
from textwrap import wrap
from typing import TYPE_CHECKING

from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """The command has no options of its own."""


def run(arguments: argparse.Namespace) -> Report:
    """Run the command."""
    from robosmi.verify.doctor import own_boards, registered_content, tools

    report = Report("doctor")
    found = tools()
    kinds = registered_content()
    report.result = {"tools": [tool.to_json() for tool in found], "content": [each.to_json() for each in kinds]}
    width = max(len(tool.name) for tool in found)
    for tool in found:
        state = f"{tool.version or 'found'}" if tool.found else "missing"
        report.lines.append(f"{tool.name:{width}}  {state:12}  {tool.needed_for}")
        if not tool.found and tool.gives:
            report.lines.append(f"{'':{width}}  gives: {tool.gives}")
        if not tool.found and tool.fix:
            report.lines.append(f"{'':{width}}  do: {tool.fix}")
    report.lines += ["", "registered content:"]
    width = max(len(each.kind.kind) for each in kinds) + 2
    for each in kinds:
        report.lines += wrap(f"{each.kind.kind:{width}}{each.line() or 'none'}", 110, subsequent_indent=" " * width)
    report.findings = own_boards()
    return report
