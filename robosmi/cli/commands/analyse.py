"""`robosmi analyse FILE...`: what a program uses of its platform."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import add_source_board, add_source_options, command_line, write_model
from robosmi.cli.progress import progress
from robosmi.plugins import content
from robosmi.project import project_of
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import AnalysedCode
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    add_source_options(parser)
    parser.add_argument("--target", metavar="NAME", help="also list the places that may behave differently on this board")
    add_source_board(parser)
    parser.add_argument("-o", dest="output", metavar="code.xmi", type=Path, help="store the code model as XMI")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    files: list[Path]
    source_platform: str | None
    include_dirs: list[Path]
    defines: list[str]
    target: str | None
    source_board: str | None
    output: Path | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("analyse")
    project = project_of(arguments.files[0])
    with progress() as told:
        done: AnalysedCode = content("chain", "analyse")(
            arguments.files,
            source_platform=arguments.source_platform or project.source_platform,
            include_dirs=arguments.include_dirs,
            defines=arguments.defines,
            source_board=arguments.source_board or project.source_board,
            target=arguments.target,
            progress=told,
        )
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    report.judge(project.severity, project.accept)
    if report.ok:
        report.next = command_line("migrate", *arguments.files, "--hardware", "DRAWING", "-o", "OUT")
    if arguments.output:
        report.artifacts.append(write_model(done.program, arguments.output))
    return report
