"""A toolchain as data: the typed form of a platform's `toolchain.toml`, and the selection of a sketch's toolchain.

Comments in that file explain its entries. Nothing is run or searched on the machine here: `tools` finds tools and core,
`libraries` finds libraries.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from robosmi.base.data_tables import DataTable, find_files
from robosmi.errors import PlatformDataError

USES = ("sketch", "library", "core")
"""Whose source a file can be: flags differ."""


class ToolchainLanguage(NamedTuple):
    """How files of some suffixes are compiled: the tool's key, its flags, and further flags per use (see `USES`)."""

    suffixes: tuple[str, ...]
    tool: str
    flags: tuple[str, ...]
    by_use: Mapping[str, tuple[str, ...]]


class ToolEntry(NamedTuple):
    """A program: its command, the package that has it, and the arguments that make it tell its version."""

    key: str
    command: str
    package: str
    version: tuple[str, ...]


class Toolchain(NamedTuple):
    """What `toolchain.toml` says about tools and languages; rarely used parts stay in their tables.

    Attributes:
        platform: the folder of the repository it lies in.
        needed_for: the commands that need it.
        gives: what its tools make possible; a text for people.
        uploader: name of the file (see `uploader`) that says how programs get on boards; empty where none does.
        tools: by key.
        sketch, core, flags, link, size, messages, libraries, environment, database, stack, original,
            board_check: the tables of that name; the last four may be empty.
    """

    path: Path
    platform: str
    name: str
    title: str
    architecture: str
    default_board: str
    needed_for: str
    gives: str
    install: str
    uploader: str
    tools: Mapping[str, ToolEntry]
    tool_places: tuple[str, ...]
    languages: tuple[ToolchainLanguage, ...]
    sketch: DataTable
    core: DataTable
    flags: DataTable
    archive: DataTable
    link: DataTable
    hex: DataTable
    size: DataTable
    messages: DataTable
    libraries: DataTable
    environment: DataTable
    database: DataTable
    stack: DataTable
    original: DataTable
    board_check: DataTable

    @property
    def suffixes(self) -> tuple[str, ...]:
        """The suffixes of all files that can be compiled."""
        return tuple(suffix for language in self.languages for suffix in language.suffixes)

    def language(self, suffix: str) -> ToolchainLanguage:
        """The language of files of a suffix.

        Raises:
            PlatformDataError: the toolchain has none.
        """
        for language in self.languages:
            if suffix in language.suffixes:
                return language
        raise PlatformDataError(f"no language of the toolchain '{self.name}' has the suffix '{suffix}'")

    def tool(self, table: DataTable) -> ToolEntry:
        """The tool that a table names under `tool`.

        Raises:
            PlatformDataError: there is no such tool.
        """
        key = table.text("tool")
        if key not in self.tools:
            raise table.error("tool", f"names '{key}', which is not among the tools")
        return self.tools[key]


def load_toolchain(path: Path) -> Toolchain:
    """The toolchain that a file describes.

    Raises:
        PlatformDataError: an entry is missing or of the wrong kind.
    """
    return _toolchain(DataTable.read(path))


def _toolchain(table: DataTable) -> Toolchain:
    path, tools = table.path, table.table("tools")
    entries = {key: _tool(key, tools.table(key)) for key, value in tools.values.items() if isinstance(value, dict)}
    return Toolchain(
        path=path,
        platform=path.parent.name,
        name=table.text("name"),
        title=table.text("title"),
        architecture=table.text("architecture"),
        default_board=table.text("default_board"),
        needed_for=table.text("needed_for"),
        gives=table.text("gives", ""),
        install=table.text("install"),
        uploader=table.text("uploader", ""),
        tools=entries,
        tool_places=tools.texts("places", ()),
        languages=tuple(_language(entry, entries) for entry in table.tables("languages")),
        sketch=table.table("sketch"),
        core=table.table("core"),
        flags=table.table("flags"),
        archive=table.table("archive"),
        link=table.table("link"),
        hex=table.table("hex"),
        size=table.table("size"),
        messages=table.table("messages"),
        libraries=table.table("libraries"),
        environment=table.table("environment"),
        database=table.table("database") if "database" in table.values else DataTable(path, {}),
        stack=table.table("stack") if "stack" in table.values else DataTable(path, {}),
        original=table.table("original") if "original" in table.values else DataTable(path, {}),
        board_check=table.table("board_check") if "board_check" in table.values else DataTable(path, {}),
    )


def _tool(key: str, entry: DataTable) -> ToolEntry:
    return ToolEntry(key, entry.text("command"), entry.text("package"), entry.texts("version"))


def _language(entry: DataTable, tools: Mapping[str, ToolEntry]) -> ToolchainLanguage:
    if entry.text("tool") not in tools:
        raise entry.error("tool", f"names '{entry.text('tool')}', which is not among the tools")
    by_use = {use: entry.texts(use) for use in USES}
    return ToolchainLanguage(entry.texts("suffixes"), entry.text("tool"), entry.texts("flags"), by_use)


def load_toolchains(project: Path | None = None) -> list[Toolchain]:
    """All toolchains for sketches, by platform: the repository's files `<platform>/toolchain.toml` with a table `[sketch]`."""
    tables = [DataTable.read(path) for path in find_files("*/toolchain.toml", project)]
    return [_toolchain(table) for table in tables if "sketch" in table.values]


def fill(texts: Iterable[str], values: Mapping[str, str], lists: Mapping[str, Iterable[str]] | None = None) -> list[str]:
    """Arguments with their braces filled in.

    Args:
        texts: arguments as the data has them.
        values: what `{name}` inside an argument stands for.
        lists: what an argument that is only `{name}` becomes: as many arguments as there are.

    Raises:
        PlatformDataError: a name in braces stands for nothing.
    """
    result: list[str] = []
    for text in texts:
        if lists and text[:1] == "{" and text[1:-1] in lists:
            result += lists[text[1:-1]]
        else:
            unknown = [name for name in re.findall(r"\{(\w+)\}", text) if name not in values]
            if unknown:
                raise PlatformDataError(f"unknown placeholder '{{{unknown[0]}}}' in '{text}'", fix="correct the toolchain's data")
            result.append(re.sub(r"\{(\w+)\}", lambda name: values[name[1]], text))
    return result


def places(texts: Iterable[str], env: str | None = None) -> list[Path]:
    """The existing folders that texts with `~` and `*` name, in their order, newest version first within one.

    Args:
        texts: absolute paths, or paths that begin with `~`.
        env: an environment variable with folders (as in PATH) that go first.
    """
    named = [Path(text).expanduser() for text in os.environ.get(env, "").split(os.pathsep) if text] if env else []
    for text in texts:
        path = Path(text).expanduser()
        if "*" in text:
            rest = path.relative_to(path.anchor).as_posix()
            named += sorted(Path(path.anchor).glob(rest), key=lambda found: version_key(str(found)), reverse=True)
        else:
            named.append(path)
    return [folder for folder in named if folder.is_dir()]


def version_key(text: str) -> list[tuple[int, int, str]]:
    """A key that sorts `1.8.10` after `1.8.9`."""
    parts = re.split(r"(\d+)", text)
    return [(1, int(part), "") if part.isdigit() else (0, 0, part) for part in parts]
