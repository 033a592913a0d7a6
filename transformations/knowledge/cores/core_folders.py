"""Finds installed Arduino cores, their tools, and the properties of a board with its menu options.

Sources: Arduino platform specification ("Hardware folders structure", "Boards", "Custom board options", "Referencing another
core, variant or tool"); Arduino CLI's documentation (`directories.data`, `directories.user`).
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from robosmi.base.data_tables import DataTable, find_files
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, SourceError, UsageError, did_you_mean
from robosmi.resources import built_in
from robosmi.transformations.knowledge.cores.core_properties import below, expand, read_properties
from robosmi.verify.toolchains.toolchain_data import version_key

ENV = "ROBOSMI_CORE"
"""Environment variable with folders of cores, as in PATH; an entry serves boards of its own architecture only."""
DATA_FOLDERS = ("~/.arduino15", "~/Library/Arduino15", "~/AppData/Local/Arduino15")
"""Where Arduino CLI keeps installed packages: Linux, macOS, Windows."""
USER_FOLDERS = ("~/Arduino", "~/Documents/Arduino")
"""Sketchbooks, whose `hardware/VENDOR/ARCHITECTURE` are cores, too."""
SYSTEM_FOLDERS = ("/usr/share/arduino",)


_WORD = re.compile(r"[.-]*\w[\w.-]*", re.ASCII)


class BoardName(NamedTuple):
    """A fully qualified board name: `VENDOR:ARCHITECTURE:BOARD[:MENU=OPTION[,MENU=OPTION...]]`."""

    vendor: str
    architecture: str
    board: str
    options: tuple[tuple[str, str], ...] = ()

    @classmethod
    def parse(cls, text: str) -> BoardName:
        """The name that a text is.

        Raises:
            UsageError: it is none, or chooses two options of one menu.
        """
        parts = text.split(":")
        named = all(_WORD.fullmatch(part) for part in parts[:3])  # the names of folders are made of them
        options = [option.partition("=") for option in parts[3].split(",") if option] if len(parts) == 4 else []
        if len(parts) not in (3, 4) or not named or not all(menu and equals for menu, equals, _ in options):
            raise UsageError(
                f"'{text}' is not the full name of a board",
                fix="write VENDOR:ARCHITECTURE:BOARD, or with :MENU=OPTION,MENU=OPTION",
            )
        menus = [menu for menu, _, _ in options]
        if twice := next((menu for menu in menus if menus.count(menu) > 1), None):
            raise UsageError(f"'{text}' has the menu '{twice}' twice", fix="choose one option of each menu")
        return cls(parts[0], parts[1], parts[2], tuple((menu, option) for menu, _, option in options))

    def __str__(self) -> str:
        options = ",".join(f"{menu}={option}" for menu, option in self.options)
        return ":".join([self.vendor, self.architecture, self.board, *([options] if options else [])])


class ArduinoCore:
    """A core on this machine.

    Args:
        folder: the folder with its `boards.txt`.
        vendor: whose package it is; empty if its folder does not say.
        architecture: its architecture, as names of boards have it.
        packages: the folder of all packages, with their tools; None for a core that lies by itself.
        stand_in: whether it takes the place of a core that is not installed, for checks only.
    """

    def __init__(self, folder: Path, vendor: str, architecture: str, packages: Path | None, stand_in: bool = False) -> None:
        self.stand_in = stand_in
        self.folder = folder
        self.vendor = vendor
        self.architecture = architecture
        self.packages = packages

    @cached_property
    def platform(self) -> dict[str, str]:
        """The properties of the platform."""
        return read_properties(self.folder / "platform.txt") | read_properties(self.folder / "platform.local.txt")

    @cached_property
    def boards(self) -> dict[str, str]:
        """The properties of all boards."""
        return read_properties(self.folder / "boards.txt") | read_properties(self.folder / "boards.local.txt")

    @property
    def version(self) -> str:
        """Its version, or `unknown`."""
        return self.platform.get("version", "unknown")

    @property
    def title(self) -> str:
        """Its name with its version."""
        return f"{self.platform.get('name', self.architecture)} {self.version}"

    @cached_property
    def board_names(self) -> list[str]:
        """The names of its boards."""
        names = (key.partition(".") for key in self.boards)
        return list(dict.fromkeys(board for board, _, rest in names if rest == "name"))

    def board(self, name: BoardName) -> dict[str, str]:
        """The properties of a board with its options; of a menu that the name leaves out, the first option counts.

        Raises:
            UsageError: the core has no such board, menu or option.
        """
        found = below(self.boards, name.board)
        if name.board not in self.board_names:
            known = ", ".join(self.board_names[:8])
            raise UsageError(
                f"unknown board '{name}'{did_you_mean(name.board, self.board_names)} in the core {self.title}",
                location=Location(str(self.folder / "boards.txt")), fix=f"use one of its boards, e.g. {known}",
            )  # fmt: skip
        menus: dict[str, dict[str, str]] = {}
        for key, label in below(found, "menu").items():
            menu, _, option = key.partition(".")
            if option and "." not in option:
                menus.setdefault(menu, {})[option] = label
        chosen = dict(name.options)
        for menu, option in chosen.items():
            known_here = menus.get(menu, {})
            if option not in known_here:
                what = f"the menu '{menu}' of '{name.board}'" if known_here else f"'{name.board}'"
                wrong, among = (option, list(known_here)) if known_here else (menu, list(menus))
                kind = "option" if known_here else "menu"
                fix = f"use one of: {', '.join(among)}" if among else "leave the options out"
                fix += ", or install the core, which may have more than this stand-in" if self.stand_in else ""
                raise UsageError(
                    f"'{name}': {what} has no {kind} '{wrong}'{did_you_mean(wrong, among)}",
                    location=Location(str(self.folder / "boards.txt")), fix=fix,
                )  # fmt: skip
        result = {key: value for key, value in found.items() if not key.startswith("menu.")}
        for menu, options in menus.items():
            result |= below(found, f"menu.{menu}.{chosen.get(menu, next(iter(options)))}")
        return result

    def tools(self, others: Iterable[ArduinoCore] = ()) -> dict[str, str]:
        """`runtime.tools.NAME.path` and `runtime.tools.NAME-VERSION.path` of the installed tools; its own vendor's go first."""
        found: dict[str, str] = {}
        roots = dict.fromkeys(core.packages for core in (self, *others) if core.packages is not None)
        for root in roots:
            vendors = sorted(root.glob("*/tools"), key=lambda tools: tools.parent.name != self.vendor)
            for tool in (tool for tools in vendors for tool in sorted(tools.iterdir()) if tool.is_dir()):
                versions = sorted((path for path in tool.iterdir() if path.is_dir()), key=lambda path: version_key(path.name))
                for version in versions:
                    found.setdefault(f"runtime.tools.{tool.name}-{version.name}.path", str(version))
                if versions:
                    found.setdefault(f"runtime.tools.{tool.name}.path", str(versions[-1]))
        return found


def find_core(name: BoardName) -> ArduinoCore:
    """The core of a board: what `ROBOSMI_CORE` names, else the newest installed one.

    Args:
        name: the board.

    Raises:
        MissingToolError: no core of that vendor and architecture is installed.
    """
    cores = [core for core in installed_cores(name.architecture) if core.vendor in ("", name.vendor)]
    if not cores:
        raise MissingToolError(
            f"no core '{name.vendor}:{name.architecture}' is installed",
            fix=how_to_install(name),
        )
    return cores[0]


def how_to_install(name: BoardName) -> str:
    """What the user does who has not the core of a board."""
    given, installed = lacking(name)
    install = f"install it{f' again ({installed})' if installed else ''}: {install_command(name.vendor, name.architecture)}"
    return f"correct {ENV} ({given}), or {install}" if given else f"{install}, or let {ENV} name its folder"


def lacking(name: BoardName) -> tuple[str, str]:
    """What folders lack that are none of a core: those of `ROBOSMI_CORE`, and those where the core of a board is installed."""
    places = (Path(text).expanduser() / "packages" for text in DATA_FOLDERS)
    installed = (each for place in places for each in place.glob(f"{name.vendor}/hardware/{name.architecture}/*"))
    return _lacking(_given()), _lacking(installed)


def _lacking(folders: Iterable[Path]) -> str:
    texts = (f"{each} {'has no boards.txt' if each.is_dir() else 'is no folder'}" for each in folders if not is_core(each))
    return ", ".join(texts)


def _given() -> list[Path]:
    return [Path(text).expanduser() for text in os.environ.get(ENV, "").split(os.pathsep) if text]


def install_command(vendor: str, architecture: str) -> str:
    """The command of Arduino CLI that installs a core, with the index that lists it where that is not Arduino's own."""
    core = f"{vendor}:{architecture}"
    url = next((url for path in find_files("*/platform.toml") if (url := _index_url(path, core))), "")
    return f"arduino-cli core install {core}{f' --additional-urls {url}' if url else ''}"


def _index_url(path: Path, core: str) -> str:
    """The address of a core's index in a platform's data; empty if it has none."""
    return DataTable.read(path).table("cores", needed=False).table(core, needed=False).text("index_url", "")


def installed_cores(architecture: str) -> list[ArduinoCore]:
    """The cores for an architecture, in the order in which they are asked: by `ROBOSMI_CORE`, by place, the newest first.

    Those of the package, which stand in for the real ones, come last.
    """
    found = [core for folder in _given() if (core := _named(folder, architecture)) is not None]
    for text in DATA_FOLDERS:
        packages = Path(text).expanduser() / "packages"
        folders = sorted(packages.glob(f"*/hardware/{architecture}/*"), key=lambda path: version_key(path.name), reverse=True)
        found += [ArduinoCore(path, path.parents[2].name, architecture, packages) for path in folders if is_core(path)]
    for text in (*USER_FOLDERS, *SYSTEM_FOLDERS):
        folders = sorted((Path(text).expanduser() / "hardware").glob(f"*/{architecture}"))
        found += [ArduinoCore(path, path.parent.name, architecture, None) for path in folders if is_core(path)]
    folders = sorted(built_in("platform_repo").glob(f"*/stand_ins/hardware/*/{architecture}"))
    return found + [ArduinoCore(path, path.parent.name, architecture, None, stand_in=True) for path in folders]


def is_core(folder: Path) -> bool:
    """Whether a folder is that of an Arduino core."""
    return (folder / "boards.txt").is_file()


def _named(folder: Path, architecture: str) -> ArduinoCore | None:
    """The core in a folder that the user named, or None if it is one of another architecture."""
    if not is_core(folder) or architecture not in architectures(folder):
        return None
    vendor, _, packages = _layout(folder) or ("", architecture, None)
    return ArduinoCore(folder, vendor, architecture, packages)


def architectures(folder: Path) -> set[str]:
    """The architectures that the core in a folder may be of.

    In the folders of Arduino's tools a name tells it. Elsewhere the names of its `cores` and what its own libraries are for do.
    """
    if (layout := _layout(folder)) is not None:
        return {layout[1]}
    libraries = (read_properties(path) for path in (folder / "libraries").glob("*/library.properties"))
    told = {word.strip() for library in libraries for word in library.get("architectures", "").split(",")}
    return (told | {folder.name, *(path.name for path in (folder / "cores").glob("*"))}) - {"", "*", "arduino"}


def _layout(folder: Path) -> tuple[str, str, Path | None] | None:
    """Vendor, architecture and packages folder by the names of folders, or None if these are not those of Arduino's tools.

    These are `packages/VENDOR/hardware/ARCHITECTURE/VERSION` and, in a sketchbook, `hardware/VENDOR/ARCHITECTURE`.
    """
    if len(folder.parents) < 4 or folder.parents[1].name != "hardware":
        return None
    if folder.name[:1].isdigit():
        return folder.parents[2].name, folder.parent.name, folder.parents[3]
    return folder.parent.name, folder.name, None


def build_properties(core: ArduinoCore, name: BoardName) -> dict[str, str]:
    """All properties of a build for a board, not expanded: platform, board, menu options, and where everything lies.

    `build.core` and `build.variant` may name another vendor's package of the architecture, whose platform then counts below
    this one's.

    Raises:
        UsageError: see `ArduinoCore.board`.
        MissingToolError: another package that the board needs is not installed.
        SourceError: a file of the core is damaged, or the board names no folder that exists.
    """
    board = core.board(name)
    platform, merged = core.platform, core.platform | board
    core_name, variant = (expand(merged.get(key, ""), merged) for key in ("build.core", "build.variant"))
    core_owner, core_name = _owner(core, core_name, name)
    variant_owner, variant = _owner(core, variant, name)
    if core_owner is not core:
        platform = core_owner.platform | platform
    core_folder = core_owner.folder / "cores" / core_name
    if not core_name or not core_folder.is_dir():
        what = f"the board '{name}' is built on the core '{core_name}', which is not there"
        raise SourceError(
            what if core_name else f"the board '{name}' has no 'build.core': no program can be built for it",
            location=Location(str(core_folder)), fix="use another board, or install the core again",
        )  # fmt: skip
    runtime = {
        "runtime.platform.path": str(core.folder),
        "runtime.ide.path": str(core.folder),
        "runtime.hardware.path": str(core.folder.parent),
        "build.core.path": str(core_folder),
        "build.variant.path": str(variant_owner.folder / "variants" / variant) if variant else "",
        "build.system.path": str(core_owner.folder / "system"),
        "build.arch": core.architecture.upper(),
        "build.fqbn": str(name),
        "build.board": f"{core.architecture}_{name.board}".upper(),
        "_id": name.board,
    }
    tools = core.tools([core_owner, variant_owner])
    return {"build.board": runtime.pop("build.board")} | platform | board | runtime | tools


def _owner(core: ArduinoCore, value: str, name: BoardName) -> tuple[ArduinoCore, str]:
    vendor, colon, rest = value.partition(":")
    if not colon or vendor == core.vendor:
        return core, rest if colon else value
    return find_core(BoardName(vendor, name.architecture, rest)), rest
