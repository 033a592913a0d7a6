"""`robosmi verify OUT`: run the original and the migrated program under the same scenarios, and compare what the pins show."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import check_replaced, command_line
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.answers import ComparedPrograms
    from robosmi.cli.options import Options


MOST_S = 3600.0
"""The most seconds that the user may ask for."""


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=Path, help="output folder of migrate")
    parser.add_argument(
        "--scenario", dest="scenarios", action="append", default=[], metavar="FILE", type=Path,
        help="a scenario (TOML); repeatable (default: the stored and the generated scenarios)",
    )  # fmt: skip
    parser.add_argument("--engine", metavar="NAME", help="simulator (default: the first that is installed)")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="seed of the scenario search (default: 1)")
    parser.add_argument(
        "--budget", metavar="SECONDS", type=_seconds,
        help="longest search for scenarios (default: 240 s of work, at most 720 s by the clock)",
    )  # fmt: skip
    parser.add_argument(
        "--horizon", metavar="SECONDS", type=_horizon,
        help="longest scenario; the one without inputs lasts exactly so long (default: as needed, up to 48 s)",
    )  # fmt: skip
    parser.add_argument("--trust-original", action="store_true", help="run the original even without a sandbox")
    parser.add_argument(
        "--require-coverage", metavar="PERCENT", type=_percent,
        help="exit with 1 if an output was not compared, or the scenarios reached fewer lines of the original",
    )  # fmt: skip
    parser.add_argument("-o", dest="vcd", metavar="FILE.vcd", type=Path, help="write both traces of the first difference")


def _percent(text: str) -> float:
    """A number from 0 to 100."""
    value = float(text)
    if not 0 <= value <= 100:
        raise argparse.ArgumentTypeError(f"'{text}' is not from 0 to 100")
    return value


def _seconds(text: str) -> float:
    """A number of seconds that is not negative."""
    value = float(text)
    if not 0 <= value <= MOST_S:
        raise argparse.ArgumentTypeError(f"'{text}' is not from 0 to {MOST_S:g}")
    return value


def _horizon(text: str) -> float:
    """A number of seconds that a scenario may last."""
    value = float(text)
    if not 1 <= value <= MOST_S:
        raise argparse.ArgumentTypeError(f"'{text}' is not from 1 to {MOST_S:g}")
    return value


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    scenarios: list[Path]
    engine: str | None
    seed: int
    budget: float | None
    horizon: float | None
    trust_original: bool
    require_coverage: float | None
    vcd: Path | None
    verbose: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("verify")
    check_replaced(arguments.vcd, b"$timescale", "trace")
    done: ComparedPrograms = content("chain", "verify")(
        arguments.output, scenarios=arguments.scenarios, engine=arguments.engine, seed=arguments.seed, vcd=arguments.vcd,
        trust_original=arguments.trust_original,
        horizon_ms=None if arguments.horizon is None else 1000 * arguments.horizon,
        **({} if arguments.budget is None else {"budget_s": arguments.budget, "clock_s": arguments.budget}),
    )  # fmt: skip
    report.ok, report.failure_code = done.exit_code == 0, done.exit_code
    report.result, report.findings = done.result, list(done.findings)
    report.lines = done.verdict.lines(arguments.verbose)
    if report.ok and arguments.require_coverage is not None and not done.verdict.covers(arguments.require_coverage):
        report.ok, report.failure_code = False, 1
        report.lines.append(
            f"too little was compared: --require-coverage asks for every output and {arguments.require_coverage:g} % of the lines"
        )
    report.lines += [f"picture of both programs: {path}" for path, kind in done.written if kind == "picture"]
    report.lines += done.notes
    report.next = command_line(*(("upload", arguments.output, "--port", "PORT") if report.ok else ("open", arguments.output)))
    report.artifacts = [{"path": str(path), "kind": kind} for path, kind in done.written]
    return report
