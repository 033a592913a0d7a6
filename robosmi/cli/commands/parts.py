"""`robosmi parts import DIR...`: the parts of a drawing tool's library, or of one's own, into the catalogue."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.plugins import content
from robosmi.report import Report
from robosmi.resources import user_data

if TYPE_CHECKING:
    from robosmi.cli.answers import ImportedParts
    from robosmi.cli.options import ActionOptions


def configure(parser: ActionOptions) -> None:
    """Add the command's options."""
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    add = actions.add_parser("import", help="read part definitions and assign each a role")
    add.add_argument("folders", metavar="DIR", nargs="+", type=Path, help="folder with part definitions")
    add.add_argument(
        "-o", dest="output", metavar="FILE.sqlite", type=Path, help="file to write (default: in the user's data folder)"
    )
    add.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    folders: list[Path]
    output: Path | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("parts")
    target = arguments.output or _own_file(arguments.folders[0])
    done: ImportedParts = content("chain", "parts_import")(arguments.folders, target)
    report.result, report.findings, report.lines = done.result, list(done.findings), done.lines()
    report.artifacts.append({"path": str(done.path), "kind": "parts"})
    return report


def _own_file(folder: Path) -> Path:
    name = re.sub(r"[^\w.-]+", "_", folder.resolve().name) or "parts"
    return user_data() / "platform_repo" / "parts" / f"{name}.sqlite"
