"""`robosmi lsp`: a server of the Language Server Protocol on standard input and output, for editors."""

from __future__ import annotations

import argparse
import os
import sys
from typing import TYPE_CHECKING

from robosmi.errors import MissingToolError, UsageError
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("--stdio", action="store_true", help="use standard input and output; always on, some editors add it")


class _Arguments(argparse.Namespace):
    """The options of the command."""

    json: bool


def run(arguments: _Arguments) -> Report:
    """Serve until the editor ends the conversation."""
    if arguments.json:
        raise UsageError("the protocol uses standard output", fix="omit --json")
    try:
        import pygls.lsp.server  # noqa: F401
    except ImportError as error:
        raise MissingToolError("the package 'pygls' is not installed", fix="pip install 'robosmi[lsp]'") from error
    from robosmi.cli.language_server import make_server

    server = make_server()
    server.start_io(stdout=os.fdopen(os.dup(sys.stdout.fileno()), "wb"))  # which it closes
    return Report("lsp")
