"""`robosmi migrate FILE... --hardware SKETCH -o OUT`: the whole way from a program and a drawing to a sketch."""

from __future__ import annotations

import argparse
from pathlib import Path

from robosmi.cli.common import add_source_options, pairs, project_of
from robosmi.plugins import content
from robosmi.report import Report


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's options."""
    add_source_options(parser)
    parser.add_argument("--hardware", metavar="SKETCH", type=Path, help="drawing of the new hardware")
    parser.add_argument("--target", metavar="NAME", help="target board")
    parser.add_argument("-o", dest="output", metavar="OUT", type=Path, required=True, help="output folder")
    parser.add_argument(
        "--library", dest="libraries", action="append", default=[], metavar="COMPONENT=LIBRARY", help="library for a drawn component"
    )
    parser.add_argument("--bind", action="append", default=[], metavar="NAME=PIN", help="target pin for a port of the source")
    parser.add_argument("--adapters", choices=("filled", "placeholders"), help="bodies of adapters")
    parser.add_argument("--dry-run", action="store_true", help="say what would be made and write nothing")
    parser.add_argument("--yes", action="store_true", help="ask nothing")
    parser.add_argument("--strict", action="store_true", help="stop when a choice is open")


def run(arguments: argparse.Namespace) -> Report:
    """Run the command."""
    project = project_of(arguments.files[0])
    done = content("chain", "migrate")(
        arguments.files, arguments.output, project=project, hardware=arguments.hardware, target=arguments.target,
        source_platform=arguments.source_platform, include_dirs=arguments.include_dirs, defines=arguments.defines,
        libraries=pairs(arguments.libraries, "--library"), bind=pairs(arguments.bind, "--bind"), adapters=arguments.adapters,
        dry_run=arguments.dry_run, strict=arguments.strict,
    )  # fmt: skip
    return report_of(done, "migrate", project.severity, project.accept)


def report_of(done: object, command: str, severity: dict[str, str], accept: tuple[object, ...]) -> Report:
    """The report of a generation, whether from sources or from a stored plan."""
    from typing import Any, cast

    made = cast(Any, done)
    report = Report(command)
    report.result, report.findings, report.tasks = made.result(), list(made.findings), list(made.tasks())
    report.artifacts = made.artifacts()
    report.lines = made.lines()
    report.judge(severity, cast(Any, accept))
    return report
