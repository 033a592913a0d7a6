"""`robosmi run CHAIN.toml`: a chain of load, validate, transform, migrate and generate; only what has changed is done again."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("chain", metavar="CHAIN.toml", type=Path, help="the chain")
    parser.add_argument("--dry-run", action="store_true", help="show what would change; write nothing")
    parser.add_argument(
        "--force", action="store_true", help="run every step, changed or not; a model that you edited is saved as NAME.orig"
    )
    parser.add_argument(
        "--fix",
        nargs="?",
        const="first",
        choices=("first", "last"),
        help="apply the first (or last) fix of every validation finding, and save the changed models",
    )
    parser.add_argument(
        "--no-keep",
        dest="keep",
        action="store_false",
        help="overwrite generated files as EGL does: edits outside protected regions are lost",
    )


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    chain: Path
    dry_run: bool
    force: bool
    fix: str | None
    keep: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.chain import read_chain

    report = Report("run")
    chain = read_chain(arguments.chain)
    done = chain.run(dry_run=arguments.dry_run, keep=arguments.keep, force=arguments.force, fix=arguments.fix)
    report.result = {
        "steps": [step.to_json() for step in done.steps],
        "written": not arguments.dry_run,
        "diff": done.diff() if arguments.dry_run else "",
    }
    report.findings = done.findings
    if not arguments.dry_run:
        report.artifacts = [
            {"path": str(arguments.chain.parent / name), "kind": "model" if step.step.makes else "generated"}
            for step in done.steps
            for name in step.written
        ]
    report.timings = {f"{step.step.name}_s": round(step.seconds, 6) for step in done.steps}
    report.lines = [*done.text().splitlines(), *(done.diff().splitlines() if arguments.dry_run else ())]
    return report
