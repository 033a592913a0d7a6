"""`robosmi migrate FILE... --hardware SKETCH -o OUT`: the whole way from a program and a drawing to a sketch."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.asking import Answers, may_ask
from robosmi.cli.common import add_source_options, output_folder, pairs
from robosmi.cli.progress import progress
from robosmi.model.recovery import recover
from robosmi.plugins import content
from robosmi.project import Accepted, project_of
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import MadeSketch
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    add_source_options(parser)
    parser.add_argument("--hardware", metavar="SKETCH", type=Path, help="drawing of the new hardware")
    parser.add_argument("--target", metavar="NAME", help="target board")
    parser.add_argument("-o", dest="output", metavar="OUT", type=output_folder, required=True, help="output folder")
    parser.add_argument(
        "--library",
        dest="libraries",
        action="append",
        default=[],
        metavar="COMPONENT=LIBRARY",
        help="library for a drawn component",
    )
    parser.add_argument("--bind", action="append", default=[], metavar="NAME=PIN", help="target pin for a port of the source")
    parser.add_argument("--adapters", choices=("filled", "placeholders"), help="bodies of adapters")
    parser.add_argument(
        "--widths", choices=("fix", "keep"), default="fix",
        help="fix: numbers keep the widths of the source; keep: the text stays, with a finding where it may matter",
    )  # fmt: skip
    parser.add_argument(
        "--history", metavar="PLACE", help="a file or an SQLAlchemy URL with earlier choices instead of the user's"
    )
    parser.add_argument("--bench", action="store_true", help="make a sketch that tries one component at a time, too: OUT/bench")
    parser.add_argument("--dry-run", action="store_true", help="say what would be made and write nothing")
    parser.add_argument("--yes", action="store_true", help="ask nothing")
    parser.add_argument("--strict", action="store_true", help="stop when a choice is open")
    parser.add_argument("--verify", action="store_true", help="compare the sketch with the original at the end")
    parser.add_argument(
        "--open", action="store_true", help="go on with the page of the plan in the browser, as robosmi open does"
    )


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    json: bool
    files: list[Path]
    source_platform: str | None
    include_dirs: list[Path]
    defines: list[str]
    hardware: Path | None
    target: str | None
    output: Path
    libraries: list[str]
    bind: list[str]
    adapters: str | None
    widths: str
    history: str | None
    bench: bool
    dry_run: bool
    yes: bool
    strict: bool
    verify: bool
    open: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("migrate")
    if not arguments.dry_run:
        recover(arguments.output)  # what a killed run has begun there may be a change of the project file, too
    first = arguments.files[0]
    project = project_of(first)
    answers = Answers() if may_ask(yes=arguments.yes, as_json=arguments.json) else None
    beside = first if first.is_dir() else first.parent
    with progress() as told:
        done: MadeSketch = content("chain", "migrate")(
            arguments.files, arguments.output, project=project, hardware=arguments.hardware, target=arguments.target,
            source_platform=arguments.source_platform, include_dirs=arguments.include_dirs, defines=arguments.defines,
            libraries=pairs(arguments.libraries, "--library"), bind=pairs(arguments.bind, "--bind"), adapters=arguments.adapters,
            dry_run=arguments.dry_run, strict=arguments.strict, history=arguments.history,
            widths=arguments.widths, bench=arguments.bench, verify=arguments.verify,
            ask=answers.libraries if answers else None, ask_ports=answers.ports if answers else None, progress=told,
            outside=(lambda: answers.offer(beside)) if answers and not arguments.dry_run else None,
        )  # fmt: skip
    if done.verification is not None and (code := done.verification[1]):
        report.ok, report.failure_code = False, code
    filled(report, done, project.severity, project.accept)
    if arguments.open and not arguments.dry_run:
        from robosmi.cli.open import serve  # a server is wanted only here

        serve(report, arguments.output, browser=not arguments.json)
    return report


def filled(report: Report, made: MadeSketch, severity: Mapping[str, str], accept: tuple[Accepted, ...]) -> Report:
    """The report of a generation, whether from sources or from a stored plan."""
    report.rest, report.findings, report.tasks = made.result, list(made.findings), list(made.tasks())
    report.artifacts = made.artifacts()
    report.lines = made.lines()
    report.judge(severity, accept)
    return report
