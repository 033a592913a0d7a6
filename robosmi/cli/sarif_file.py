"""The option `--sarif FILE` of every command: its findings and tasks, or the error that stopped it, as a file in SARIF 2.1.0."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import check_replaced
from robosmi.diagnostics import Finding, Location
from robosmi.errors import RobosmiError, StoppedError
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options

OPTION = "--sarif"


def add_option(parser: Options) -> None:
    """Add the option to a command."""
    parser.add_argument(
        OPTION, metavar="FILE", type=Path, help="also write findings and tasks as SARIF 2.1.0, for code scanning and editors"
    )


def requested_path(words: Sequence[str]) -> Path | None:
    """The file that the words of a command line name, also where they are wrong otherwise."""
    for word, following in pairwise([*words, ""]):
        if word == "--":
            return None
        if word == OPTION and following:
            return Path(following)
        if word.startswith(f"{OPTION}="):
            return Path(word.partition("=")[2])
    return None


def check_file(path: Path | None) -> None:
    """Make sure, before the command runs, that its findings are not written over a file of another kind.

    Raises:
        StoppedError: there is such a file.
    """
    if path is not None:
        from robosmi.report.sarif import MARK

        check_replaced(path, MARK, "file in SARIF")


def subject(parsed: argparse.Namespace) -> Path | None:
    """The first file or folder that a command was given to read, the place of what it says without one."""
    given = [value for name, value in vars(parsed).items() if name not in (OPTION[2:], "include_dirs")]
    paths = (path for value in given for path in (value if isinstance(value, list) else [value]) if isinstance(path, Path))
    return next((path for path in paths if path.exists()), None)


def write_file(report: Report, path: Path, exit_code: int, about: Path | None = None) -> None:
    """Write the file, and list it among the report's artifacts.

    Args:
        report: what the command found.
        path: the file.
        exit_code: with which the command ends.
        about: the file that the command is about.

    Raises:
        SourceError: it cannot be written.
        StoppedError: the command has just made that file.
    """
    from robosmi.files.files import write_atomic
    from robosmi.report.sarif import sarif_text

    if os.path.realpath(path) in {os.path.realpath(str(artifact["path"])) for artifact in report.artifacts}:
        message, fix = "this command writes this file itself, so the findings cannot replace it", "give --sarif another name"
        raise StoppedError(message, location=Location(str(path)), fix=fix)
    write_atomic(path, sarif_text(report, exit_code, about=about).encode())
    report.artifacts.append({"path": str(path), "kind": "sarif"})


def write_failure(command: str, findings: list[Finding], path: Path, exit_code: int) -> None:
    """Write the error that stopped a command, and warnings; where that cannot be written, the terminal has to do."""
    report = Report(command, findings=findings, ok=False)
    try:
        check_file(path)
        write_file(report, path, exit_code, Path.cwd())
    except RobosmiError:
        return
