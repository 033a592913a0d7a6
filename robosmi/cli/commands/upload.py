"""`robosmi upload OUT --port PORT`: put the compiled program of a sketch on its board."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import output_folder
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=Path, help="output folder of migrate, or the sketch's own folder")
    parser.add_argument(
        "--port", metavar="PORT", help="serial port of the board, such as /dev/ttyACM0, or the folder of its drive; not needed "
        "for a board that is a drive, or that its tool finds by itself",
    )  # fmt: skip
    parser.add_argument("--build", metavar="DIR", type=output_folder, help="folder given to compile -o")
    parser.add_argument("--baud", metavar="N", type=int, help="baud rate of the boot loader (default: the board's)")
    parser.add_argument("--unfinished", action="store_true", help="upload even if bodies are still to be written")
    parser.add_argument("--dry-run", action="store_true", help="show the upload command; send nothing")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    port: str | None
    build: Path | None
    baud: int | None
    unfinished: bool
    dry_run: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.verify.uploads.upload import upload_sketch

    done = upload_sketch(
        arguments.output, arguments.port, kept_in=arguments.build, baud=arguments.baud, unfinished=arguments.unfinished,
        dry_run=arguments.dry_run,
    )  # fmt: skip
    report = Report("upload")
    report.result = done.to_json()
    what = "uploaded" if done.sent else "would upload"
    report.lines = [
        f"{what} {done.bytes} bytes to '{done.board}'{f' at {done.port}' if done.port else ''} with {done.tool}",
        f"  {report.result['command']}",
        *([f"  {done.note}"] if done.note else []),
    ]
    return report
