"""`robosmi simulate OUT`: run a generated program alone on a simulator, and print its console and what it does at its pins.

With `--watch` it serves the live part of the page instead: the program beside its original, with inputs to move.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.commands.open import serve
from robosmi.cli.common import check_replaced, command_line
from robosmi.errors import UsageError
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import SimulatedSketch
    from robosmi.cli.options import Options
    from robosmi.report.page_server import Content


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=Path, help="output folder of migrate, or the program's own folder")
    parser.add_argument("--scenario", metavar="FILE", type=Path, help="inputs over time (TOML)")
    parser.add_argument("--seconds", metavar="N", type=float, help="simulated seconds (default: the scenario's, else 5)")
    parser.add_argument("--engine", metavar="NAME", help="simulator (default: the first that is installed)")
    parser.add_argument("--watch", action="store_true", help="run it beside the original in a browser, with inputs to move")
    parser.add_argument("--port", type=int, default=0, metavar="N", help="TCP port for --watch (default: any free port)")
    parser.add_argument("--no-browser", action="store_true", help="with --watch: print the address; do not open a browser")
    parser.add_argument("-o", dest="vcd", metavar="FILE.vcd", type=Path, help="write the trace for a waveform viewer")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    scenario: Path | None
    seconds: float | None
    engine: str | None
    vcd: Path | None
    watch: bool
    port: int
    no_browser: bool
    json: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("simulate")
    if arguments.watch:
        if arguments.scenario or arguments.seconds or arguments.vcd:
            raise UsageError("--watch takes no --scenario, --seconds and -o", fix="choose the test case on the page")
        page: Content = content("chain", "page")(arguments.output, engine=arguments.engine, shown=["watch"])
        browser = not (arguments.no_browser or arguments.json)
        serve(report, arguments.output, arguments.port, browser=browser, page=page)
        return report
    check_replaced(arguments.vcd, b"$timescale", "trace")
    done: SimulatedSketch = content("chain", "simulate")(
        arguments.output, scenario=arguments.scenario, seconds=arguments.seconds, engine=arguments.engine, vcd=arguments.vcd
    )
    report.ok, report.failure_code = done.trace is not None, 6
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    if done.written is not None:
        report.artifacts.append({"path": str(done.written), "kind": "vcd"})
    if report.ok and (arguments.output / "models").is_dir():  # a sketch of one's own has no original to compare with
        report.next = command_line("verify", arguments.output)
    return report
