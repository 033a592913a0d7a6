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
        "--root", metavar="DIR", type=Path, required=True, help="the folder outside of which nothing is read or written"
    )
    parser.add_argument(
        "--limit", metavar="SECONDS", type=float, default=600.0, help="after which a tool's call is ended (default: 600)"
    )
    parser.add_argument(
        "--unconfined", action="store_true",
        help="start where the kernel has no Landlock: paths are looked at, compilers and programs are not held to the folder",
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
        raise UsageError("standard output is the protocol's", fix="leave --json out")
    if not 0 < arguments.limit < float("inf"):
        raise UsageError("--limit is a number of seconds above 0", fix="give one, as --limit 600")
    root = RootFolder(arguments.root)
    try:
        import mcp.server  # noqa: F401
    except ImportError as error:
        raise MissingToolError("the package mcp is not installed", fix="pip install 'robosmi[mcp]'") from error
    confined = bool(landlock.version()) and not arguments.unconfined
    if not confined and not arguments.unconfined:
        raise MissingToolError(
            "this system has no Landlock, which holds compilers and programs to the root folder",
            fix="use Linux 5.13 or newer, or say --unconfined if you trust what is in the folder",
        )
    from robosmi.cli.mcp_commands import Commands
    from robosmi.cli.mcp_tools import make_server

    if not confined:
        complain("robosmi mcp: not confined: compilers and programs may read what you may read")
    with Commands(root, arguments.limit, confined=confined) as commands:
        make_server(commands).run("stdio")
    return Report("mcp")
