"""`robosmi open OUT`: the plan of a migration as a page in the browser, to decide and to check on."""

from __future__ import annotations

import argparse
import os
import sys
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import output_folder
from robosmi.plugins import content
from robosmi.report import Report
from robosmi.report.page_server import PageServer

if TYPE_CHECKING:
    from robosmi.cli.options import Options
    from robosmi.report.page_server import Content


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=output_folder, help="output folder of migrate or generate")
    parser.add_argument("--port", type=int, default=0, metavar="N", help="TCP port of the page (default: any free port)")
    parser.add_argument("--no-browser", action="store_true", help="print the address; do not open a browser")
    parser.add_argument("--source", metavar="FILE", type=Path, help="a source file of the program, next to robosmi.toml")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    json: bool
    output: Path
    port: int
    no_browser: bool
    source: Path | None


def run(arguments: _Arguments) -> Report:
    """Make the page ready; it is served once the report is printed."""
    report = Report("open")
    serve(report, arguments.output, arguments.port, browser=not (arguments.no_browser or arguments.json), source=arguments.source)
    return report


def serve(
    report: Report,
    output: Path,
    port: int = 0,
    *,
    browser: bool = True,
    source: Path | None = None,
    page: Content | None = None,
) -> None:
    """Extend a report so that it continues with a page that is served until Ctrl-C.

    Args:
        report: gets the address, and goes on with serving.
        output: the output folder.
        port: the port, 0 for any that is free.
        browser: whether to open a browser.
        source: a source of the program, where its place is not known.
        page: what is served; the page of the output folder if None.

    Raises:
        SourceError, ModelError: the folder has no plan that can be read.
        UsageError: the port cannot be used.
    """
    page = page or content("chain", "page")(output, source)
    assert page is not None
    page.document(live=True, nonce="")  # whatever is wrong with the plan is said before anything is served
    server = PageServer(page, port)
    report.result = {**report.result, "url": server.url, "pid": os.getpid()}
    report.lines += [f"{output} is open at {server.url}", "Press Ctrl-C to stop; the plan has all saved changes"]

    def go_on() -> None:
        sys.stdout.flush()
        if browser and not webbrowser.open_new_tab(server.url):
            print(f"no browser can be started here: open {server.url} in one", file=sys.stderr, flush=True)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            pass
        finally:
            server.server_close()

    report.then = go_on
