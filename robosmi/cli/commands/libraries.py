"""`robosmi libraries import DIR`, `install NAME`, `show NAME`: libraries on this machine, in the user's index, and their API."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.base.quantities import quantity
from robosmi.base.trust import acting
from robosmi.cli.common import command_line, output_folder
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import UsageError
from robosmi.plugins import content
from robosmi.report import Report
from robosmi.verify.toolchains.toolchain_data import load_toolchains

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
    installing = actions.add_parser("install", help="install a library, so that a sketch can be compiled with it and uploaded")
    installing.add_argument("name", metavar="NAME", help="name of the library, or NAME@VERSION")
    installing.add_argument(
        "--from",
        dest="source",
        metavar="FILE",
        type=Path,
        help="zip file or folder of the library (default: the library manager gets it)",
    )
    installing.add_argument(
        "--pin", dest="output", metavar="OUT", type=output_folder, help="output folder of a migration that gets the version, too"
    )
    installing.add_argument("--replace", action="store_true", help="replace an installed library with other content")
    for action in (taking, installing, showing):
        action.add_argument("--platform", metavar="NAME", help="platform of the libraries")
        action.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print one JSON document to stdout")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    action: str
    folder: Path
    platform: str | None
    name: str
    source: Path | None
    output: Path | None
    replace: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    platform: str = arguments.platform or content("query", "default_library_platform")()
    if arguments.action == "install":
        return _install(arguments, platform)
    return _show(arguments.name, platform) if arguments.action == "show" else _import(arguments.folder, platform)


def _show(name: str, platform: str) -> Report:
    shown: Analysed = content("chain", "libraries_show")(name, platform)
    return Report("libraries", result=shown.result, lines=shown.lines())


def _install(arguments: _Arguments, platform: str) -> Report:
    from robosmi.verify.toolchains.library_install import install_library

    report = Report("libraries")
    with acting():
        toolchain = next((each for each in load_toolchains() if each.platform == platform), None)
        if toolchain is None:
            raise UsageError(f"no toolchain is known for the platform '{platform}'", fix="give another --platform")
        done = install_library(arguments.name, toolchain, arguments.source, replace=arguments.replace)
    library = done.library
    for each in done.added:
        content("chain", "libraries_import")(each.folder, platform)
    report.result = {
        "name": library.name, "version": library.version, "folder": str(library.folder), "tool": done.tool or None,
        "installed": [{"name": each.name, "version": each.version, "folder": str(each.folder)} for each in done.added],
    }  # fmt: skip
    report.artifacts = [{"path": str(each.folder), "kind": "library"} for each in done.added]
    report.lines = [f"installed {each.name} {each.version}".rstrip() + f": {each.folder}" for each in done.added]
    report.lines = report.lines or [f"already installed: {library.name} {library.version}".rstrip() + f": {library.folder}"]
    if arguments.output is not None:
        made = content("chain", "libraries_pin")(arguments.output, library.name, library.version)
        report.result["pinned"] = made is not None
        said = f"{arguments.output} uses it in this version" if made is not None else f"{arguments.output} does not use it"
        report.lines.append(said)
        if made is not None:
            report.next = command_line("compile", arguments.output)
    return report


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
