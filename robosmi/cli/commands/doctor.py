"""`robosmi doctor`: what is installed, what is missing, the registered content, and own boards that a core contradicts.

The programs and cores are those of the toolchains' data; the Python packages are those that RoboSMi imports. Nothing is installed
here. A missing part is a result, not an error.
"""

from __future__ import annotations

import argparse
import importlib
import os
import re
import shutil
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from importlib import metadata
from operator import attrgetter
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_tables import KIND
from robosmi.base.data_text import Json
from robosmi.base.trust import acting
from robosmi.diagnostics import Finding
from robosmi.errors import MissingToolError, RuleError
from robosmi.inputs import read_once
from robosmi.plugin_contracts import KINDS, Contribution
from robosmi.plugins import content, registry
from robosmi.report import Report
from robosmi.resources import built_in
from robosmi.verify.host_model import HostModel, host_models, load_host_model
from robosmi.verify.original_build import compiler_version, missing_tools
from robosmi.verify.simulation import Engine, engine_names
from robosmi.verify.toolchains.board_check import board_findings
from robosmi.verify.toolchains.boards import Board, load_boards
from robosmi.verify.toolchains.toolchain_data import Toolchain, load_toolchains
from robosmi.verify.toolchains.tools import (
    core_version,
    environment,
    find_core,
    find_installed,
    find_tool,
    install_fix,
    tool_version,
)
from robosmi.verify.uploads import serial_ports
from robosmi.verify.uploads.uploader import COPY, find_program, uploader_data

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """The command has no options of its own."""


def run(arguments: argparse.Namespace) -> Report:
    """Run the command."""

    report = Report("doctor")
    found = tools()
    kinds = registered_content()
    report.result = {"tools": [tool.to_json() for tool in found], "content": [each.to_json() for each in kinds]}
    report.lines = list(lines_of(found))
    report.lines += ["", "registered content:"]
    width = max(len(each.kind.kind) for each in kinds) + 2
    for each in kinds:
        report.lines += wrap(f"{each.kind.kind:{width}}{each.line() or 'none'}", 110, subsequent_indent=" " * width)
    report.findings = own_boards()
    return report


PACKAGES = {
    "pyecore": ("pyecore.ecore", "models"),
    "libclang": ("clang.cindex:conf.lib", "reading C sources"),
    "lxml": ("lxml.etree", "reading drawings, XMI"),
    "jinja2": ("jinja2.sandbox", "generating text"),
    "networkx": ("networkx", "running chains, comparing graphs"),
    "filelock": ("filelock:FileLock", "writing into output folders"),
    "sexpdata": ("sexpdata", "reading drawings"),
    "tomlkit": ("tomlkit", "saving choices in robosmi.toml"),
}
"""Required Python packages: distribution name -> (what is imported to test it, what it is needed for)."""


OPTIONAL = {
    "pygls": ("pygls.lsp.server", "editors", "lsp", "robosmi lsp: findings, completions and choices in an editor"),
    "mcp": ("mcp.server", "assistants", "mcp", "robosmi mcp: serve the commands as tools for assistants, confined to one folder"),
    "SQLAlchemy": (
        "sqlalchemy",
        "corpus, a shared history",
        "database",
        "running a corpus; sharing a library history in a database",
    ),
    "distributed": ("distributed", "corpus --scheduler", "cluster", "running a corpus on more than one machine"),
    "pyarrow": ("pyarrow", "corpus export", "parquet", "exporting the tables of a corpus as Parquet files"),
}
"""Optional Python packages: distribution name -> (what is imported to test it, its purpose, the extra, what it enables)."""
_SHOWN = 4
"""Boards of an upload tool that are listed."""
_SIMULATION = "simulating the migrated program (simulate, verify); one simulator is enough"
_ORIGINALS = "running the original (verify)"
_UPLOAD = "uploading a compiled sketch"
READ, COMPILE, UPLOAD, ORIGINALS, SIMULATE, MORE, PLUGINS = (
    "read and migrate", "compile", "upload", "run the original", "simulate", "more", "plug-ins"
)  # fmt: skip
"""What tools are needed for, in the order of the user's work."""


class ToolStatus(Struct, frozen=True):
    """A program, core or package that some command needs, and whether it is installed.

    Attributes:
        name: a program, a core or a Python package.
        needed_for: the commands or work that need it.
        found: its path, or None if it is missing.
        version: its version; None if it is missing, `unknown` if it does not tell.
        fix: how to get it, or None if it is there.
        gives: what can be done with it that cannot be done without it.
        purpose: the group in which it is listed.
    """

    name: str
    needed_for: str
    found: str | None
    version: str | None
    fix: str | None
    gives: str = ""
    purpose: str = ""

    def to_json(self) -> dict[str, str | None]:
        """The contract's form."""
        return {
            "name": self.name,
            "needed_for": self.needed_for,
            "found": self.found,
            "version": self.version,
            "fix": self.fix,
            "gives": self.gives,
            "purpose": self.purpose,
        }


@read_once()
def tools(project: Path | None = None) -> list[ToolStatus]:
    """Everything that is needed: Python packages, each toolchain's programs and core, the compiler for originals, simulators
    (one of them is enough).

    Args:
        project: the project folder (see `robosmi.resources`); the current folder if None.

    Raises:
        PlatformDataError: a toolchain's data is damaged.
        SourceError: found data that names programs is not trusted.
    """
    packages = [_package(name, *facts) for name, facts in PACKAGES.items()]
    with acting(project):
        toolchains = load_toolchains(project)
        uploaders = _uploaders(toolchains, project) if all(each.found for each in packages) else ()  # boards are models
        groups = {
            READ: packages,
            COMPILE: [each for toolchain in toolchains for each in (*_programs(toolchain), _core(toolchain))],
            UPLOAD: [*uploaders, *_managers(toolchains)],
            ORIGINALS: [_host_compiler(load_host_model(platform, project)) for platform in host_models(project)],
        }
    groups[SIMULATE] = [_engine(name) for name in engine_names()]
    groups[MORE] = [_optional(name, *facts) for name, facts in OPTIONAL.items()]
    groups[PLUGINS] = list(_plugins())
    return [replace(tool, purpose=purpose) for purpose, found in groups.items() for tool in found]


def lines_of(found: Sequence[ToolStatus]) -> Iterator[str]:
    """The tools as the user reads them: by purpose, with what is missing in the headline of each."""
    width = max(len(tool.name) for tool in found)
    for purpose in dict.fromkeys(tool.purpose for tool in found):
        group = {(tool.name, tool.found): tool for tool in found if tool.purpose == purpose}  # some need the same programs
        missing = list(dict.fromkeys(tool.name for tool in group.values() if not tool.found))
        yield f"{purpose}: {'missing ' + ', '.join(missing) if missing else 'ready'}"
        for tool in group.values():
            yield f"  {tool.name:{width}}  {(tool.version or 'found') if tool.found else 'missing':14}  {tool.needed_for}"
            if not tool.found and tool.gives:
                yield f"  {'':{width}}  gives: {tool.gives}"
            if not tool.found and tool.fix:
                yield f"  {'':{width}}  do: {tool.fix}"


class KindStatus(Struct, frozen=True):
    """A kind of content and what is registered of it.

    Attributes:
        kind: its class, with the contract.
        registered: name -> the distributions that register it, in the order in which they do; empty for what is built in.
    """

    kind: type[Contribution]
    registered: dict[str, list[str]]

    def to_json(self) -> dict[str, Json]:
        """The contract's form."""
        return {
            "kind": self.kind.kind,
            "description": self.kind.description,
            "called": self.kind.called,
            "returns": self.kind.returns,
            "names": self.kind.names,
            "registered": [
                {"name": name, "owner": owner or None} for name, owners in self.registered.items() for owner in owners
            ],
        }

    def line(self) -> str:
        """The registered names; behind those of plug-ins their distribution."""
        return ", ".join(f"{name} ({owner})" if owner else name for name, owners in self.registered.items() for owner in owners)


def registered_content() -> list[KindStatus]:
    """Every kind of content with what is registered of it, sorted by name; `tools` lists what a plug-in misspells."""
    known = registry()
    return [KindStatus(each, {name: known.owners(each.kind, name) for name in known.names(each.kind)}) for each in KINDS.values()]


@read_once()
def own_boards(project: Path | None = None) -> list[Finding]:
    """The contradictions between an installed core and boards that are not built in (RS810).

    If a package that robosmi needs cannot be loaded, which `tools` reports, no board is checked.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a board's data is damaged.
        SourceError: found data that names programs is not trusted.
    """
    found: list[Finding] = []
    if not all(_package(name, *facts).found for name, facts in PACKAGES.items()):
        return found
    with acting(project):
        for toolchain in load_toolchains(project):
            of_core = (each for each in load_boards(toolchain.platform, project) if each.architecture == toolchain.architecture)
            boards = [each for each in of_core if each.file and not _built_in(each)]
            if boards and find_core(toolchain) is not None:
                with suppress(MissingToolError):  # said of the tool
                    installed = find_installed(toolchain)
                    found += [finding for board in boards for finding in board_findings(board, toolchain, installed)]
    return found


def _built_in(board: Board) -> bool:
    files = {board.file, *(claim.file for claim in board.claims())}
    return all(file is None or file.is_relative_to(built_in(KIND)) for file in files)


def _plugins() -> Iterator[ToolStatus]:
    """Those that cannot be loaded are missing, others are there."""
    known = registry()
    known.check()
    for name in sorted(known.plugins):
        distribution, _, version = name.partition(" ")
        yield ToolStatus(distribution, "plug-in", distribution, version or "unknown", None)
    for plugin in known.broken:
        yield ToolStatus(plugin.distribution, f"plug-in '{plugin.entry_point}': {plugin.cause}", None, None, plugin.fix)


def _engine(name: str) -> ToolStatus:
    try:
        engine: Engine = content("engine", name)()
    except (MissingToolError, RuleError) as error:  # a plug-in's
        return ToolStatus(name, f"simulation: {error.message}", None, None, error.fix)
    advice = engine.missing()
    return ToolStatus(name, "simulation", name if advice is None else None, engine.version(), advice, _SIMULATION)


def _host_compiler(model: HostModel) -> ToolStatus:
    advice = missing_tools(model)
    path = shutil.which(model.compiler.text("command"))
    version = None if advice or path is None else compiler_version(path)
    name = f"{model.compiler.text('command')} {model.compiler.texts('machine')[0]}"
    return ToolStatus(name, f"running originals ({model.title})", None if advice else path, version, advice, _ORIGINALS)


def _package(name: str, module: str, needed_for: str) -> ToolStatus:
    """A package is there if it can be loaded, and has the version that this package asks for."""
    wanted = _requirement(name)
    try:
        found = metadata.distribution(name)
    except metadata.PackageNotFoundError:
        return ToolStatus(name, needed_for, None, None, f"pip install '{wanted}'")
    fix = f"pip install --force-reinstall '{wanted}'"
    if not _fits(found.version, wanted):
        return ToolStatus(name, f"{needed_for}; {wanted} is needed", None, found.version, fix)
    path, _, attributes = module.partition(":")
    try:
        loaded = importlib.import_module(path)
        if attributes:
            attrgetter(attributes)(loaded)
    except (Exception, SystemExit) as error:
        return ToolStatus(name, f"{needed_for}; it cannot be loaded: {error}", None, found.version, fix)
    return ToolStatus(name, needed_for, str(found.locate_file("")), found.version, None)


def _optional(name: str, module: str, needed_for: str, extra: str, gives: str) -> ToolStatus:
    """The status of an extra's package; one that is installed but cannot be loaded is missing."""
    fix = f"pip install 'robosmi[{extra}]'"
    try:
        found = metadata.distribution(name)
        importlib.import_module(module)
    except (Exception, SystemExit):
        return ToolStatus(name, needed_for, None, None, fix, gives)
    return ToolStatus(name, needed_for, str(found.locate_file("")), found.version, None, gives)


def _requirement(name: str) -> str:
    """The requirement on a package, such as `lxml>=5`; its name alone if robosmi itself is not installed."""
    try:
        listed = metadata.requires("robosmi") or []
    except metadata.PackageNotFoundError:
        listed = []
    own = (entry for entry in listed if re.match(rf"{name}\b", entry, re.IGNORECASE) and ";" not in entry)
    return next(own, name).replace(" ", "")


def _fits(version: str, requirement: str) -> bool:
    """Whether a version is within the bounds of a requirement; they are numbers between dots."""

    def numbers(text: str) -> list[int]:
        return [int(number) for number in re.findall(r"\d+", text)[:3]]

    bounds = re.finditer(r"(>=|<)([\d.]+)", requirement)
    return all((numbers(version) >= numbers(bound[2])) is (bound[1] == ">=") for bound in bounds)


def _programs(toolchain: Toolchain) -> Iterator[ToolStatus]:
    env = environment(toolchain)
    for entry in toolchain.tools.values():
        path = find_tool(entry, toolchain)
        version = tool_version(path, entry.version, env) if path else None
        fix = None if path else install_fix(toolchain, [entry.package])
        yield ToolStatus(entry.command, toolchain.needed_for, path, version, fix, toolchain.gives)


def _uploaders(toolchains: Iterable[Toolchain], project: Path | None) -> Iterator[ToolStatus]:
    """The tools that put programs on boards, each once and with its boards, and the ports at which a board may be.

    A tool that copies to the board's drive is no program.
    """
    boards: dict[str, list[str]] = {}
    of: dict[str, Toolchain] = {}
    for toolchain in toolchains:
        for board in load_boards(toolchain.platform, project):
            name = (board.boot_loader.tool if board.boot_loader is not None else "") or toolchain.uploader
            if name and board.boot_loader is not None:
                boards.setdefault(name, []).append(board.name)
                of.setdefault(name, toolchain)
    patterns: list[str] = []
    for name, toolchain in of.items():
        data = uploader_data(toolchain, project, name)
        patterns += data.texts("ports", ())
        if data.text("kind", "") == COPY:
            continue
        program = find_program(data)
        version = tool_version(program[0], data.texts("version"), environment(toolchain)) if program else None
        fix = None if program else install_fix(toolchain, [data.text("package")])
        named = sorted({*boards[name]})  # a board may be on several platforms
        listed = ", ".join(named[:_SHOWN]) + (" ..." if len(named) > _SHOWN else "")
        yield ToolStatus(
            data.text("command"), f"upload to {listed}", program[0] if program else None, version, fix, f"{_UPLOAD} to {listed}"
        )
    if of:
        yield port_status(serial_ports.ports(dict.fromkeys(patterns)))


def _managers(toolchains: Iterable[Toolchain]) -> Iterator[ToolStatus]:
    """The library managers of the toolchains."""
    for toolchain in toolchains:
        if (data := toolchain.libraries.table("manager", needed=False)).values:
            path, gives = shutil.which(data.text("command")), "installing libraries by name; without it, from their zip files"
            version = tool_version(path, ("version",)) if path else None
            yield ToolStatus(
                data.text("command"), "libraries install", path, version, None if path else data.text("missing"), gives
            )


def port_status(ports: Sequence[str]) -> ToolStatus:
    """Whether there is a serial port that this user may open."""
    usable = [port for port in ports if os.access(port, os.R_OK | os.W_OK)]
    fix = "connect the board by a USB cable that carries data"
    if ports:
        fix = f"join the group that owns {ports[0]} (sudo usermod -aG dialout $USER), and log in again"
    found = ", ".join(usable)
    return ToolStatus("serial port", "upload", found or None, found or None, None if usable else fix, _UPLOAD)


def _core(toolchain: Toolchain) -> ToolStatus:
    name = toolchain.core.text("name")
    try:
        core = find_core(toolchain)
    except MissingToolError as error:
        return ToolStatus(name, toolchain.needed_for, None, None, error.fix, toolchain.gives)
    if core is None:
        fix = install_fix(toolchain, toolchain.core.texts("packages"))
        return ToolStatus(name, toolchain.needed_for, None, None, fix, toolchain.gives)
    return ToolStatus(name, toolchain.needed_for, str(core), core_version(toolchain, core), None, toolchain.gives)
