"""The commands that build a program, from the flags of a `toolchain.toml`; others are content.

Nothing is run here. A command is the program's path and its arguments.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, Protocol

from robosmi.base.data_tables import DataTable
from robosmi.verify.toolchains.boards import Board
from robosmi.verify.toolchains.toolchain_data import Toolchain, fill
from robosmi.verify.toolchains.tools import Installed

Command = list[str]


class Recipes(Protocol):
    """How a program is built for one board.

    Attributes:
        title: compiler and core with their versions.
        core, core_title: the core's folder; its name with its version.
        environment: of the commands.
        core_folders: the folders with the core's sources, which every library depends on; none if there is nothing to compile.
        board_folders: further folders that the archive of the core depends on.
        unconverted: why `convert` makes no file for the board; None where it does.
    """

    title: str
    core: Path
    core_title: str
    environment: Mapping[str, str]
    core_folders: Sequence[Path]
    board_folders: Sequence[Path]
    unconverted: str | None

    def prepare(self, folder: Path, name: str) -> Iterable[Command]:
        """What goes before the first compile.

        Args:
            folder: the empty folder of the build.
            name: the program's name.
        """

    def compile(self, source: Path, target: Path, use: str, includes: Sequence[Path]) -> Command:
        """Compile a file to an object.

        Args:
            source: the file.
            target: the object.
            use: whose file it is: `sketch`, `library` or `core`.
            includes: folders with headers.
        """

    def scan(self, source: Path, use: str, includes: Sequence[Path]) -> Command:
        """Print the headers that a file reads, as a rule of make; missing ones as they are written."""

    def database(self, suffix: str, includes: Sequence[Path]) -> Command:
        """The compiler and its arguments for the sketch's files of a suffix, without the file."""

    def archive(self, archive: Path, objects: Sequence[Path]) -> Iterable[Command]:
        """Make an archive of objects."""

    def before_link(self, elf: Path, objects: Sequence[Path], libraries: Sequence[Path], core: Path | None) -> Iterable[Command]:
        """What goes before the link of these; see `link`."""

    def link(self, elf: Path, objects: Sequence[Path], libraries: Sequence[Path], core: Path | None) -> Command:
        """Link objects and archives to a program."""

    def size(self, elf: Path) -> Command:
        """Print the sizes of a program's sections."""

    def sizes(self, printed: str) -> tuple[int, int | None]:
        """Flash and RAM in bytes, from what `size` prints; None for a RAM that nothing tells."""

    def disassemble(self, elf: Path) -> Command | None:
        """Print the program's code for the stack bound, or None if there is no analysis for it."""

    def convert(self, elf: Path) -> Iterable[Command]:
        """Make the file that a board takes."""

    def program(self, elf: Path) -> Path:
        """The file that `convert` makes; the linked program where it makes none."""


class InstalledBoard(NamedTuple):
    """A board as its core describes it.

    Attributes:
        board: the board.
        recipes: how the core builds programs for it.
        architecture: what a library must list that serves it.
        stand_in: the name of the core that is not installed, if this one takes its place for checks; else empty.
        install: how that core is installed; else empty.
        lacking: what folders lack that were to be of that core; else empty.
        version: of the core that builds.
    """

    board: Board
    recipes: Recipes
    architecture: str
    stand_in: str = ""
    install: str = ""
    lacking: str = ""
    version: str = ""


class DataRecipes:
    """The commands of a `toolchain.toml`.

    Args:
        toolchain: the data.
        installed: its programs on this machine.
        board: the board.
    """

    def __init__(self, toolchain: Toolchain, installed: Installed, board: Board) -> None:
        self._toolchain = toolchain
        self._installed = installed
        self._board = board
        self.unconverted: str | None = None
        linker = toolchain.tool(toolchain.link)
        self.core = installed.core
        self.core_title = f"{toolchain.core.text('name')} {installed.core_version}"
        self.title = f"{linker.command} {installed.version}, {self.core_title}"
        self.environment: Mapping[str, str] = installed.environment
        self.core_folders: Sequence[Path] = (
            [installed.core / toolchain.core.text("sources")] if "sources" in toolchain.core.values else []
        )
        self.board_folders: Sequence[Path] = [
            installed.core / text for text in fill(toolchain.core.texts("board_files"), board.fill())
        ]

    def prepare(self, folder: Path, name: str) -> Iterable[Command]:
        """See `Recipes`."""
        return ()

    def compile(self, source: Path, target: Path, use: str, includes: Sequence[Path]) -> Command:
        """See `Recipes`."""
        return [*self._compiler(source.suffix, use, "compile", includes), str(source), "-o", str(target)]

    def scan(self, source: Path, use: str, includes: Sequence[Path]) -> Command:
        """See `Recipes`."""
        return [*self._compiler(source.suffix, use, "scan", includes), str(source)]

    def database(self, suffix: str, includes: Sequence[Path]) -> Command:
        """See `Recipes`."""
        return self._compiler(suffix, "sketch", "compile", includes)

    def _compiler(self, suffix: str, use: str, mode: str, includes: Sequence[Path]) -> Command:
        language = self._toolchain.language(suffix)
        values = self._board.fill() | {"core": str(self._installed.core)}
        texts = [*language.flags, *language.by_use[use], *self._toolchain.flags.texts("common")]
        texts += self._toolchain.flags.texts(mode)
        flags = fill(texts, values, {"extra_flags": self._board.extra_flags})
        return [self._installed.commands[language.tool], *flags, *(f"-I{path}" for path in includes)]

    def _tool(self, data: DataTable, values: Mapping[str, str], lists: Mapping[str, list[str]] | None = None) -> Command:
        """The tool that a table names, with the table's arguments."""
        return [self._installed.commands[self._toolchain.tool(data).key], *fill(data.texts("arguments"), values, lists)]

    def _values(self, elf: Path) -> dict[str, str]:
        return self._board.fill() | {"elf": str(elf), "hex": str(self.program(elf))}

    def archive(self, archive: Path, objects: Sequence[Path]) -> Iterable[Command]:
        """See `Recipes`."""
        files = {"objects": [str(path) for path in objects]}
        return [self._tool(self._toolchain.archive, {"archive": str(archive)}, files)]

    def before_link(self, elf: Path, objects: Sequence[Path], libraries: Sequence[Path], core: Path | None) -> Iterable[Command]:
        """See `Recipes`."""
        return ()

    def link(self, elf: Path, objects: Sequence[Path], libraries: Sequence[Path], core: Path | None) -> Command:
        """See `Recipes`."""
        values = self._values(elf) | ({"core_archive": str(core)} if core is not None else {})
        files = {"objects": [str(path) for path in objects], "libraries": [str(path) for path in libraries]}
        return self._tool(self._toolchain.link, values, files)

    def size(self, elf: Path) -> Command:
        """See `Recipes`."""
        return self._tool(self._toolchain.size, self._values(elf))

    def sizes(self, printed: str) -> tuple[int, int]:
        """See `Recipes`: the sums of the sections that the data names."""
        data = self._toolchain.size
        sections = {match["section"]: int(match["bytes"]) for match in data.pattern("pattern").finditer(printed)}
        flash, ram = (sum(sections.get(name, 0) for name in data.texts(kind)) for kind in ("flash", "ram"))
        return flash, ram

    def disassemble(self, elf: Path) -> Command | None:
        """See `Recipes`."""
        data = self._toolchain.stack
        return self._tool(data, self._values(elf)) if data.values else None

    def convert(self, elf: Path) -> Iterable[Command]:
        """See `Recipes`."""
        return [self._tool(self._toolchain.hex, self._values(elf))]

    def program(self, elf: Path) -> Path:
        """See `Recipes`."""
        return elf.with_suffix(".hex")
