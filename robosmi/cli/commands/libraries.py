"""`robosmi libraries import DIR` and `show NAME`: installed libraries into the user's own index, and what a library offers."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.plugins import content
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import Analysed
    from robosmi.cli.answers import ImportedLibraries
    from robosmi.cli.options import ActionOptions

_SHOWN = 10


def configure(parser: ActionOptions) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    taking = actions.add_parser("import", help="add a folder's libraries to the index")
    taking.add_argument("folder", metavar="DIR", type=Path, help="folder of libraries, one library, or a PlatformIO project")
    showing = actions.add_parser("show", help="list a library's classes, methods, functions and constants")
    showing.add_argument("name", metavar="NAME", help="name of the library in the index")
    for action in (taking, showing):
        action.add_argument("--platform", metavar="NAME", help="platform of the libraries")
        action.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    action: str
    folder: Path
    platform: str | None
    name: str


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    platform: str = arguments.platform or content("query", "default_library_platform")()
    return _show(arguments.name, platform) if arguments.action == "show" else _import(arguments.folder, platform)


def _show(name: str, platform: str) -> Report:
    shown: Analysed = content("chain", "libraries_show")(name, platform)
    return Report("libraries", result=shown.result, lines=shown.lines())


def _import(folder: Path, platform: str) -> Report:
    report = Report("libraries")
    done: ImportedLibraries = content("chain", "libraries_import")(folder, platform)
    report.result = {
        "added": [{"name": name, "version": version} for name, version in done.added],
        "skipped": [{"path": path, "reason": reason} for path, reason in done.skipped.items()],
        "index": str(done.index), "known": done.known,
    }  # fmt: skip
    report.findings = [
        Finding("RS420", Severity.info, f"skipped: {reason}", Location(path)) for path, reason in done.skipped.items()
    ]
    names = [f"{name} {version}".rstrip() for name, version in done.added]
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    report.lines = [f"read {quantity(len(names), 'library', 'libraries')}: {', '.join(names[:_SHOWN])}{more}"]
    report.lines.append(f"your index {done.index} has {done.known}")
    if done.added:
        report.artifacts = [{"path": str(done.index), "kind": "index"}]
    return report
