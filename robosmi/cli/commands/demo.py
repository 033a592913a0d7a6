"""`robosmi demo`: the shipped example, copied into a folder of the user's and migrated there; its page in the browser.

The example's files are copied, so that decisions in the page change the user's copy and not the installation. Files that exist
stay as they are: a second run shows what the user made of the example. The history does not count its library choices.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi import inputs, resources
from robosmi.cli.commands.migrate import filled
from robosmi.cli.common import output_folder
from robosmi.cli.progress import progress
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.files.files import write_atomic
from robosmi.plugins import content
from robosmi.project import project_of
from robosmi.quoting import terminal
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import MigratedSketch
    from robosmi.cli.options import Options

FOLDER = Path("robosmi-demo")
EXAMPLE = "line_follower"
COPIED = "program"
"""The folder in the output folder with the example's program, drawing and settings."""


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument(
        "-o", dest="output", metavar="DIR", type=output_folder, default=FOLDER, help=f"output folder (default: {FOLDER})"
    )
    parser.add_argument("--port", type=int, default=0, metavar="N", help="TCP port of the page (default: any free port)")
    parser.add_argument("--no-browser", action="store_true", help="write the sketch and end; do not serve the page")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    json: bool
    output: Path
    port: int
    no_browser: bool


def run(arguments: _Arguments) -> Report:
    """Copy the example, migrate it, and make its page ready."""
    output = arguments.output
    program = _copied(resources.example(EXAMPLE), output / COPIED)
    project = project_of(program)
    with progress() as told:
        done: MigratedSketch = content("chain", "migrate")(
            [program], output, project=project, history=str(output / COPIED / "history.sqlite"), progress=told
        )
    report = filled(Report("demo"), done, project.severity, project.accept)
    report.lines += ["", f"program, drawing and settings: {terminal(str(output / COPIED))}"]
    if arguments.no_browser:
        report.lines.append(f"see the page: robosmi open {terminal(str(output))}")
    else:
        from robosmi.cli.commands.open import serve  # a server is wanted only here

        serve(report, output, arguments.port, browser=not arguments.json)
    return report


def _copied(example: Path, folder: Path) -> Path:
    """The example's program in a folder of the user's, after copying the files that are not there yet.

    Raises:
        SourceError: the folder cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for path in sorted(each for each in example.iterdir() if each.suffix in (".c", ".fzz", ".toml")):
            if not (folder / path.name).exists():
                write_atomic(folder / path.name, inputs.read_bytes(path, inputs.DRAWING))
    except OSError as error:
        raise SourceError(
            f"the example cannot be copied: {error.strerror}", location=Location(str(folder)), fix="give another folder: -o DIR"
        ) from error
    return folder / f"{EXAMPLE}.c"
