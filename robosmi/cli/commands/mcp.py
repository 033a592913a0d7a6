"""`robosmi mcp --root DIR`: a server of the Model Context Protocol on standard input and output, for assistants."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli import landlock
from robosmi.cli.root_folder import RootFolder
from robosmi.cli.streams import complain
from robosmi.errors import MissingToolError, UsageError
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument(
        "--root", metavar="DIR", type=Path, required=True, help="folder that the tools may read and write; nothing outside it"
    )
    parser.add_argument(
        "--limit", metavar="SECONDS", type=float, default=600.0, help="longest time of a tool call (default: 600)"
    )
    parser.add_argument(
        "--unconfined", action="store_true",
        help="start without Landlock: paths are checked, but compilers and programs are not confined",
    )  # fmt: skip


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    json: bool
    root: Path
    limit: float
    unconfined: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    if arguments.json:
        raise UsageError("the protocol uses standard output", fix="omit --json")
    if not 0 < arguments.limit < float("inf"):
        raise UsageError("--limit must be a number of seconds above 0", fix="for example --limit 600")
    root = RootFolder(arguments.root)
    try:
        import mcp.server  # noqa: F401
    except ImportError as error:
        raise MissingToolError("the package 'mcp' is not installed", fix="pip install 'robosmi[mcp]'") from error
    confined = bool(landlock.version()) and not arguments.unconfined
    if not confined and not arguments.unconfined:
        raise MissingToolError(
            "this system has no Landlock to confine compilers and programs to the root folder",
            fix="use Linux 5.13 or newer; or add --unconfined if you trust the folder's contents",
        )
    from robosmi.cli.mcp_commands import Commands
    from robosmi.cli.mcp_tools import make_server

    if not confined:
        complain("robosmi mcp: not confined: compilers and programs can read all your files")
    with Commands(root, arguments.limit, confined=confined) as commands:
        make_server(commands).run("stdio")
    return Report("mcp")
