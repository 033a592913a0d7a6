"""`robosmi history list|forget|export|import`: earlier choices of libraries, and what is done with them."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import asdict

from robosmi.base.quantities import quantity
from robosmi.plugins import content
from robosmi.recommend.history import History, HistoryEntry
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import ActionOptions


def configure(parser: ActionOptions) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    listing = actions.add_parser("list", help="list the choices")
    forget = actions.add_parser("forget", help="remove choices")
    export = actions.add_parser("export", help="write the choices to FILE.xmi, FILE.csv or FILE.json")
    taking = actions.add_parser("import", help="add the choices of FILE.xmi, FILE.csv or FILE.json")
    forget.add_argument("--part", metavar="TITLE", help="title of the part")
    forget.add_argument("--part-id", metavar="ID", help="identifier of the part in its catalogue")
    forget.add_argument("--library", metavar="NAME", help="name of the library")
    forget.add_argument("--all", dest="everything", action="store_true", help="everything")
    for sub in (export, taking):
        sub.add_argument("file", metavar="FILE", type=Path)
    for sub in (listing, forget, export, taking):
        sub.add_argument(
            "--history", metavar="PLACE", help="file or SQLAlchemy URL of the library history (default: the user's own)"
        )
        sub.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    action: str
    history: str | None
    part: str | None
    part_id: str | None
    library: str | None
    everything: bool
    file: Path


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("history")
    history = History(arguments.history)
    if arguments.action == "list":
        entries = history.entries()
        report.result = {"place": history.place, "entries": [asdict(entry) for entry in entries]}
        report.lines = [_line(entry) for entry in entries] or [f"no choices in {history.place}"]
    elif arguments.action == "forget":
        count = history.forget(arguments.part_id, arguments.part, arguments.library, everything=arguments.everything)
        report.result = {"place": history.place, "forgotten": count}
        report.lines = [f"removed {quantity(count, 'choice')}"]
    elif arguments.action == "export":
        written: list[HistoryEntry] = content("chain", "history_export")(history, arguments.file)
        report.artifacts = [{"path": str(arguments.file), "kind": "history"}]
        report.result = {"place": history.place, "written": [str(arguments.file)], "count": len(written)}
        report.lines = [f"wrote {quantity(len(written), 'choice')} to {arguments.file}"]
    else:
        found, changed = content("chain", "history_import")(history, arguments.file)
        report.result = {"place": history.place, "found": found, "added": changed, "skipped": found - changed}
        report.lines = [f"{changed} of {found} choices are new or changed"]
    return report


def _line(entry: HistoryEntry) -> str:
    library = f"{entry.library} {entry.version}".rstrip()
    target = f" for {entry.target}" if entry.target else ""
    return f"{entry.count:4} x  {entry.title or entry.part_id}: {library}{target}  (last {entry.last_used})"
