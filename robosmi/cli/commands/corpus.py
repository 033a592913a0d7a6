"""`robosmi corpus run|query|export|report|compare`: many programs at once, their results in tables."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING

from robosmi.base.progress_events import announce, remark
from robosmi.base.quantities import quantity
from robosmi.cli.common import output_folder
from robosmi.errors import SourceError, UsageError
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import ActionOptions
    from robosmi.corpus.running import RunProgress

_MOST_JOBS = 1024
_LOG_S = 60.0
"""Seconds between two lines in a log."""


_STEPS_HELP = (
    "analyse, migrate, compile, verify; separated by commas; compile and verify need migrate "
    "(default: steps of SPEC.toml, else analyse)"
)


def configure(parser: ActionOptions) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    run = actions.add_parser("run", help="run the programs of a specification that are new or changed")
    run.add_argument("spec", metavar="SPEC.toml", type=Path, help="specification: programs, settings, limits")
    run.add_argument("-o", dest="output", metavar="OUT", type=output_folder, required=True, help="output folder")
    run.add_argument("--jobs", metavar="N", type=_count, help="number of worker processes (default: the processor's cores)")
    run.add_argument("--scheduler", metavar="URL", help="scheduler of Dask (tcp://HOST:PORT), instead of worker processes here")
    run.add_argument("--steps", metavar="LIST", help=_STEPS_HELP)
    run.add_argument("--retry", metavar="STATES", help="run programs with these results again: failed, timeout, too-large")
    run.add_argument("--models", action="store_true", help="keep the models of each program as XMI files")
    query = actions.add_parser("query", help="answer a question in SQL")
    query.add_argument("output", metavar="OUT", type=Path, help="output folder of a run")
    query.add_argument("sql", metavar="SQL", help='for example "SELECT state, count(*) FROM programs GROUP BY state"')
    query.add_argument("--csv", action="store_true", help="print comma-separated values")
    export = actions.add_parser("export", help="write the tables as files")
    export.add_argument("output", metavar="OUT", type=Path, help="output folder of a run")
    export.add_argument("-o", dest="into", metavar="DIR", type=output_folder, required=True, help="folder for the files")
    export.add_argument("--as", dest="form", choices=("csv", "parquet"), required=True, help="format of the files")
    report = actions.add_parser("report", help="write a page about all programs: obstacles and next steps")
    report.add_argument("output", metavar="OUT", type=Path, help="output folder of a run")
    report.add_argument("-o", dest="into", metavar="DIR", type=output_folder, required=True, help="folder for index.html")
    compare = actions.add_parser("compare", help="compare the results of two runs")
    compare.add_argument("before", metavar="A", type=Path, help="output folder of the earlier run")
    compare.add_argument("after", metavar="B", type=Path, help="output folder of the later run")
    compare.add_argument("--store-before", metavar="URL", help="database of the earlier run")
    for sub in (run, query, export, report, compare):
        sub.add_argument("--store", metavar="URL", help="SQLAlchemy URL of the database (default: OUT/corpus.sqlite)")
        sub.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")
        sub.add_argument(
            "--fail-on", choices=("info", "warning", "error", "never"), default=argparse.SUPPRESS,
            help="exit with 1 on a finding of at least this severity (default: error)",
        )  # fmt: skip


def _count(text: str) -> int:
    """A number of processes.

    Raises:
        argparse.ArgumentTypeError: it is none.
    """
    if not text.isdecimal() or not 1 <= int(text) <= _MOST_JOBS:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from 1 to {_MOST_JOBS}")
    return int(text)


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    action: str
    json: bool
    spec: Path
    output: Path
    jobs: int | None
    scheduler: str | None
    steps: str | None
    retry: str | None
    models: bool
    store: str | None
    store_before: str | None
    sql: str
    csv: bool
    into: Path
    form: str
    before: Path
    after: Path


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("corpus")
    actions: dict[str, Callable[[_Arguments, Report], None]] = {
        "run": _run, "query": _query, "export": _export, "report": _report, "compare": _compare
    }  # fmt: skip
    actions[arguments.action](arguments, report)
    return report


def _listed(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


def _run(arguments: _Arguments, report: Report) -> None:
    from robosmi.corpus.backends import backend_of
    from robosmi.corpus.running import CorpusRun, checked_states, summary_json
    from robosmi.corpus.settings import options_of
    from robosmi.corpus.spec import read_spec

    spec = read_spec(arguments.spec)
    steps = _listed(arguments.steps) if arguments.steps is not None else None
    options = options_of(
        spec, steps=steps, jobs=arguments.jobs, scheduler=arguments.scheduler, store=arguments.store,
        retry=checked_states(_listed(arguments.retry or "")), models=arguments.models,
    )  # fmt: skip
    made = CorpusRun(spec, arguments.output, options, _Shown())
    for _ in made.results(backend_of(options)):
        pass
    done = made.summary
    report.result, report.findings = summary_json(done), made.findings
    if made.other_version or (done.programs and done.skipped == done.programs):
        report.ok, report.failure_code = False, SourceError.exit_code
    report.lines = [
        f"{quantity(done.programs, 'program')}: {done.done} done, {done.failed} failed, {done.timeout} timeout, "
        f"{done.too_large} too large, {done.skipped} skipped",
        f"  {done.run} run in {done.seconds:.1f} s, {done.unchanged} unchanged",
        f"  store: {done.store}",
    ]


class _Shown:
    """Progress: on a terminal one line that is written over, in a log a line each minute."""

    def __init__(self) -> None:
        self._terminal, self._last = sys.stderr.isatty(), monotonic()

    def __call__(self, progress: RunProgress) -> None:
        """Show how far the run is."""
        if not self._terminal and monotonic() - self._last < _LOG_S:
            return
        self._last = monotonic()
        left = f", {_time(progress.left_s)} left" if progress.left_s is not None else ""
        failed = f", {progress.failed} not done" if progress.failed else ""
        said = f"{progress.ended:,} of {progress.total:,} programs{failed}, {progress.rate:.1f} a second{left}"
        if self._terminal:
            announce(said)
        else:
            remark(said)


def _time(seconds: float) -> str:
    """A time in words."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def _query(arguments: _Arguments, report: Report) -> None:
    from robosmi.corpus.running import store_place
    from robosmi.corpus.store import Store, as_csv

    if arguments.csv and arguments.json:
        raise UsageError("--csv and --json are both given", fix="give one of them")
    with Store(store_place(arguments.output, arguments.store)) as store:
        answer = store.query(arguments.sql)
    columns = _distinct(answer.columns)
    report.result = {"columns": columns, "rows": [dict(zip(columns, row, strict=True)) for row in answer.rows]}
    report.lines = as_csv(answer) if arguments.csv else _table(answer.columns, answer.rows)


def _distinct(names: Sequence[str]) -> list[str]:
    """Names of columns as keys: a further column of one name has a number, as in a, a_2."""
    found: list[str] = []
    for name in names:
        number, key = 1, name
        while key in found or (number > 1 and key in names):
            number += 1
            key = f"{name}_{number}"
        found.append(key)
    return found


def _table(columns: tuple[str, ...], rows: list[tuple[object, ...]]) -> list[str]:
    """Rows as a text table."""
    cells = [[("" if value is None else str(value)).replace("\n", " ") for value in row] for row in (columns, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells]


def _export(arguments: _Arguments, report: Report) -> None:
    from robosmi.corpus.running import store_place
    from robosmi.corpus.store import Store, export

    with Store(store_place(arguments.output, arguments.store)) as store:
        written = export(store, arguments.into, arguments.form)
    report.artifacts = [{"path": str(path), "kind": arguments.form} for path in written]
    report.result = {"written": [str(path) for path in written]}
    report.lines = [f"wrote {len(written)} tables to {arguments.into}"]


def _report(arguments: _Arguments, report: Report) -> None:
    from robosmi.corpus.report import write_report
    from robosmi.corpus.running import store_place
    from robosmi.corpus.store import Store

    with Store(store_place(arguments.output, arguments.store)) as store:
        path = write_report(store, arguments.output, arguments.into)
    report.artifacts = [{"path": str(path), "kind": "page"}]
    report.result = {"path": str(path)}
    report.lines = [f"wrote {path}"]


def _compare(arguments: _Arguments, report: Report) -> None:
    from robosmi.corpus.compare import compare, comparison_lines
    from robosmi.corpus.running import store_place
    from robosmi.corpus.store import Store

    places = store_place(arguments.before, arguments.store_before), store_place(arguments.after, arguments.store)
    with Store(places[0]) as before, Store(places[1]) as after:
        found = compare(before, after)
    report.result, report.lines = found.to_json(), comparison_lines(found)
    report.ok = not found.worse and not found.new_failures
