"""Targets: the content of `[targets.NAME]` and of the platforms' `[target]` as elements of `platform.ecore`, and a view of
them.

A target is a board of a platform with the generator that writes for it. With `by_board`, every board that a platform maps is a
target, by its short name and by its full name in the platform's tools. Boards themselves are read in `board_models`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import cached_property
from pathlib import Path

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.base.data_text import Json
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.metamodels import platform
from robosmi.plugins import content, registry
from robosmi.project import defaults, defaults_place, read_data
from robosmi.transformations.knowledge.board_models import (
    KIND,
    board_file,
    board_names,
    check_keys,
    load_board,
    load_mapping,
    mapped_boards,
    mapping_file,
    table_of,
    text_of,
)
from robosmi.transformations.knowledge.data_keys import OF_ARCHITECTURES, OF_SOURCES, OF_TARGETS, TARGET
from robosmi.transformations.knowledge.platforms.target_names import KINDS, TargetNames, add_names_of, reserved_names

STRUCTURES = {"setup/loop": platform.EntryStructure.setupLoop, "main": platform.EntryStructure.mainFunction}
"""How data calls the functions in which programs begin."""
PLAIN_C, CPLUSPLUS = "C", "C++"
LANGUAGES = (PLAIN_C, CPLUSPLUS)
_KEYS = (
    "platform", "board", "generator", "toolchain", "structure", "language", "suffix", "module_suffix", "project_file",
    "libraries", "any_board", "by_board",
)  # fmt: skip


_OF_BOARD = ("build.mcu", "build.board", "build.variant")
"""What a core says of a board that is otherwise on another one: options of a menu that change it choose another board."""
_CLOCK = "build.f_cpu"

_Board = platform.Board  # the class below has a property of the module's name


class TargetFacts:
    """A view of a target with the properties that rules use.

    Args:
        model: the target, loaded from the repository or from stored models.
        any_board: whether a drawing may have another board than the target's.
        full_name: the board's full name with the options of menus that were given; empty for the board as its data has it.
        options_checked: whether the board's core is there, so that it has these options.
    """

    def __init__(
        self, model: platform.Target, any_board: bool = False, full_name: str = "", options_checked: bool = True
    ) -> None:
        if model.platform is None:
            raise PlatformDataError(f"the target '{model.name}' has no platform", fix="run migrate again")
        self.model = model
        self.any_board = any_board
        self.full_name = full_name
        self.options_checked = options_checked
        self.own_platform: platform.Platform = model.platform
        """The platform with its names, which a plan refers to."""
        self.shared = model.platform.names
        """All names that the platform shares with programs, also once a plan has kept some of them only."""

    def reserve_names_of(self, board: _Board, project: Path | None = None) -> None:
        """Add the names that the core declares for a board with another microcontroller.

        Args:
            board: the board of the plan, which may differ from the target's because of the drawing.
            project: the project folder; the current folder if None.
        """
        mcu = str(board.microcontroller.name) if board.microcontroller is not None else ""
        if mcu and self.shared is not None:
            add_names_of(mcu, self.platform, self.shared, project)

    @property
    def target(self) -> str:
        """The name that the user gave, or the board's."""
        return str(self.model.name)

    @property
    def platform(self) -> str:
        """Name of the platform."""
        return str(self.own_platform.name)

    @property
    def board_model(self) -> _Board:
        """The board.

        Raises:
            PlatformDataError: the target has none.
        """
        if self.model.board is None:
            raise PlatformDataError(f"the target '{self.model.name}' has no board", fix="run migrate again")
        return self.model.board

    @property
    def board(self) -> str:
        """Short name of the board."""
        return str(self.board_model.name)

    @property
    def called(self) -> frozenset[str]:
        """All names of the target: the given one, the board's, and the board's full name in the platform's tools."""
        mapped = [name for each in self.own_platform.boardMappings for name in (each.boardId, *each.otherIds) if name]
        return frozenset({self.target, self.board, *mapped})

    @property
    def generator(self) -> str:
        """Name of the registered generator."""
        return str(self.model.generator)

    @property
    def architecture(self) -> str:
        """Architecture of the board's processor, as libraries declare it."""
        chip = self.model.board.microcontroller if self.model.board is not None else None
        return str(chip.architecture if chip is not None else self.own_platform.architecture)

    @property
    def include(self) -> str:
        """Header that every program includes, or empty."""
        return str(self.own_platform.mainHeader)

    @property
    def libraries(self) -> str:
        """Platform whose index of libraries the target uses, empty for none."""
        return str(self.model.libraryIndex)

    @property
    def preserves_main(self) -> bool:
        """Whether programs of the target begin with main, so that the program's main is kept."""
        return self.model.structure is platform.EntryStructure.mainFunction

    @property
    def language(self) -> str:
        """C or C++."""
        return str(self.model.language)

    @cached_property
    def standard_headers(self) -> frozenset[str]:
        """C headers that the platform has."""
        return frozenset(self.own_platform.standardHeaders)

    @cached_property
    def own_headers(self) -> frozenset[str]:
        """The platform's own headers, in lower case: a program's header of the same name would replace it."""
        return frozenset(name.lower() for name in (self.own_platform.mainHeader, *self.own_platform.ownHeaders))

    @cached_property
    def widths(self) -> Mapping[str, str]:
        """Type of the source by value -> type that holds the same values."""
        return {w.sourceType: w.targetType for w in self.own_platform.widths}

    @cached_property
    def wider_names(self) -> Mapping[str, str]:
        """Function, type or macro of the standard library with an int in it -> its counterpart with the source's width."""
        return {w.sourceType: w.targetType for w in self.own_platform.widerNames}

    @cached_property
    def names(self) -> TargetNames:
        """The names that the platform's core declares."""
        return TargetNames(self.shared)


def target_names(project: Path | None = None) -> list[str]:
    """The names of all targets, sorted; each can also be given by its board's full name."""
    listed = set(defaults(project).get("targets", {}))
    for name, _ in _platforms_by_board(project):
        listed |= set(mapped_boards(name, project))
    return sorted(listed)


def target_facts(target: str, project: Path | None = None) -> TargetFacts:
    """A target, as new elements.

    Args:
        target: name of a target, or a board's full name in a platform's tools, perhaps with options of menus.
        project: the project folder; the current folder if None.

    Raises:
        UsageError: there is no such target, or its core, which is installed, has no such menu or option.
        PlatformDataError: its data is damaged, or names a generator or toolchain that does not exist.
    """
    table, name = _entry(target, project)
    own = platform_table(table.text("platform"), table, project)
    board_name = table.text("board")
    if board_file(board_name, project) is None:
        raise table.error("board", f"is '{board_name}', an unknown board{did_you_mean(board_name, board_names(project))}")
    board = load_board(board_name, project)
    chip = board.microcontroller
    made = _platform(_on(own, str(chip.architecture) if chip is not None else ""), table.text("platform"), project)
    made.boardMappings.append(load_mapping(table.text("platform"), board, project))
    full_name = target if _parts(target)[1] and target != made.boardMappings[0].boardId else ""
    checked = _choose_options(full_name, made.boardMappings[0], board) if full_name else True
    toolchain = table.text("toolchain", "")
    model = platform.Target(
        name=name,
        platform=made,
        board=board,
        generator=_known(table, "generator", registry().names("generator")),
        toolchain=_toolchain(toolchain, table, project) if toolchain else None,
        structure=STRUCTURES[_known(table, "structure", STRUCTURES)],
        language=_known(table, "language", LANGUAGES),
        fileSuffix=_ending(table, "suffix"),
        moduleSuffix=_ending(table, "module_suffix"),
        projectFile=table.text("project_file", ""),
        libraryIndex=table.text("libraries", ""),
    )
    return TargetFacts(model, table.flag("any_board", False), full_name, checked)


def _ending(table: DataTable, key: str) -> str:
    if not (ending := table.text(key)).startswith("."):
        raise table.error(key, f"is '{ending}', but an ending begins with a dot: '.{ending}'")
    return ending


def takes_libraries_of(target: str, index: str, project: Path | None = None) -> bool:
    """Whether a target uses the libraries of an index; false for a target that no longer exists.

    Args:
        target: name of a target, or a board's full name.
        index: the platform whose index it is.
        project: the project folder; the current folder if None.
    """
    try:
        return _entry(target, project)[0].text("libraries", "") == index
    except (UsageError, PlatformDataError):
        return False


def _known(table: DataTable, key: str, known: Collection[str]) -> str:
    value = table.text(key)
    if value not in known:
        raise table.error(key, f"is '{value}', which is none of: {', '.join(sorted(known))}{did_you_mean(value, known)}")
    return value


def _entry(target: str, project: Path | None) -> tuple[DataTable, str]:
    """The settings of a target, merged with the platform's, and its name."""
    listed = defaults(project).get("targets", {})
    if target in listed:
        place = defaults_place("targets", target, project)
        said = listed[target]
        if not isinstance(said, dict):
            raise DataTable(place, listed, "targets.").error(target, "must be a table")
        return _whole(said, place, f"targets.{target}.", project), target
    for name, path in _platforms_by_board(project):
        boards = mapped_boards(name, project)
        board = target if target in boards else _called(target, name, boards, project) if ":" in target else None
        if board is not None:
            return _whole({"platform": name, "board": board}, path, "target.", project), board
    known = target_names(project)
    raise UsageError(f"unknown target '{target}'{did_you_mean(target, known)}", fix=f"use one of: {', '.join(known)}")


def _called(full_name: str, platform_name: str, boards: Collection[str], project: Path | None) -> str | None:
    """The board that a platform's tools know by that full name; if it has options of menus, also by one with fewer of them."""
    plain, given = _parts(full_name)
    found: list[tuple[int, str]] = []
    for board in boards:
        file = mapping_file(platform_name, board, project)
        if file is not None and f'"{plain}' in text_of(file):  # parsing is a hundred times as long
            table = table_of(file)
            names = (_parts(name) for name in (table.text("fqbn", ""), *table.texts("fqbn_also", ())))
            found += [(len(options), board) for name, options in names if name == plain and options <= given]
    return max(found)[1] if found else None


def _parts(full_name: str) -> tuple[str, frozenset[str]]:
    """The board in a full name, and its options of menus."""
    *board, options = [*full_name.split(":", 3), ""][:4] if full_name.count(":") > 2 else [full_name, ""]
    return ":".join(board), frozenset(filter(None, options.split(",")))


def _choose_options(full_name: str, mapping: platform.BoardMapping, board: _Board) -> bool:
    """Keep options of menus in the mapping, and what they change of the board as far as its core, if installed, says so.

    Returns:
        Whether the core is installed, so that it has these options.

    Raises:
        UsageError: the core has no such menu or option, or the options choose another board.
    """
    own = str(mapping.boardId)
    before, after = (content("query", "core_properties")(name) for name in (own, full_name))
    if other := [f"{key}={after[key]}" for key in _OF_BOARD if after.get(key) != before.get(key)]:
        what = f"the options of '{full_name}' choose another board than '{board.name}': {', '.join(other)}"
        raise UsageError(what, fix=f"use --target {own}, or add the board's data: docs/how-to/add-a-target.md")
    mapping.boardId, mapping.otherIds = full_name, [own, *(name for name in mapping.otherIds if name != full_name)]
    mapping.platformioSettings.append(f"; {full_name}: PlatformIO has names of its own for options of menus")
    if after.get(_CLOCK) != before.get(_CLOCK):
        board.clockHertz = int(after[_CLOCK].rstrip("ULul"))
        mapping.platformioSettings.append(f"board_build.f_cpu = {board.clockHertz}L")
    return bool(after)


def _whole(own: dict[str, Json], place: Path, prefix: str, project: Path | None) -> DataTable:
    table = DataTable(place, own, prefix)
    for key in own:
        if key not in _KEYS:
            raise table.error(key, f"is not a key of a target{did_you_mean(key, _KEYS)}")
    base = platform_table(table.text("platform"), table, project).table("target", needed=False)
    return DataTable(place, {**base.values, **own}, prefix)


def platform_table(name: str, named_in: DataTable, project: Path | None) -> DataTable:
    """The settings of a platform that a target names.

    Raises:
        PlatformDataError: there is no platform of that name, or its settings cannot be read.
    """
    for folder in resources.folders(KIND, project):
        if (path := folder / name / "platform.toml").is_file():
            return table_of(path)
    known = {path.parent.name for folder in resources.folders(KIND, project) for path in folder.glob("*/platform.toml")}
    raise named_in.error("platform", f"is '{name}', an unknown platform{did_you_mean(name, known)}")


def _platforms_by_board(project: Path | None) -> Iterator[tuple[str, Path]]:
    """Name and settings of the platforms whose boards are targets."""
    seen: set[str] = set()
    for folder in resources.folders(KIND, project):
        for path in sorted(folder.glob("*/platform.toml")):
            if path.parent.name not in seen:
                seen.add(path.parent.name)
                if table_of(path).table("target", needed=False).flag("by_board", False):
                    yield path.parent.name, path


def target_platform(name: str, project: Path | None = None) -> platform.Platform:
    """A platform that programs are moved to, as a new element without its boards.

    Raises:
        PlatformDataError: its data is missing or damaged.
    """
    return _platform(table_of(resources.find(KIND, f"{name}/platform.toml", project)), name, project)


def _on(table: DataTable, architecture: str) -> DataTable:
    """The settings of a platform on a processor, whose own widths replace those of the platform."""
    said = table.table("architectures", needed=False)
    if architecture not in said.values:
        return table
    own = said.table(architecture)
    for key in own.values:
        if key not in OF_ARCHITECTURES:
            raise own.error(key, f"is not a key of an architecture{did_you_mean(key, OF_ARCHITECTURES)}")
    return DataTable(table.path, {**table.values, **own.values, "architecture": architecture}, table.prefix)


def _platform(table: DataTable, folder: str, project: Path | None) -> platform.Platform:
    check_keys(table, (*OF_TARGETS, *OF_SOURCES))
    check_keys(table.table("target", needed=False), TARGET)
    return platform.Platform(
        name=table.text("name"),
        title=table.text("title", table.text("name")),
        language=table.text("language"),
        charSigned=table.flag("charSigned"),
        losesLevel=table.flag("losesLevel", False),
        hasCogs=table.flag("hasCogs"),
        architecture=table.text("architecture"),
        coreVersion=table.text("core"),
        coreName=table.text("core_name", ""),
        mainHeader=table.text("include"),
        pinFunctions=table.texts("pin_functions", ()),
        standardHeaders=table.texts("standard_headers"),
        ownHeaders=table.texts("own_headers", ()),
        intBits=table.number("intBits"),
        longBits=table.number("longBits"),
        pointerBits=table.number("pointerBits"),
        doubleBits=table.number("doubleBits"),
        widths=_widths(table.table("widths")),
        widerNames=_widths(table.table("wider_names", needed=False)),
        names=reserved_names(folder, project),
    )


def _widths(table: DataTable) -> list[platform.TypeWidth]:
    return [platform.TypeWidth(sourceType=name, targetType=table.text(name)) for name in table.values]


def _toolchain(name: str, named_in: DataTable, project: Path | None) -> platform.Toolchain:
    known: list[str] = []
    for folder in resources.folders(KIND, project):
        for path in sorted(folder.glob("*/toolchain.toml")):
            data = read_data(path)
            known.append(str(data.get("name", "")))
            if known[-1] == name:
                table = DataTable(path, data)
                tools = table.table("tools")
                return platform.Toolchain(
                    name=name,
                    title=table.text("title"),
                    architecture=table.text("architecture"),
                    tools=[
                        platform.Tool(name=key, command=tool.text("command"), package=tool.text("package", ""))
                        for key, value in tools.values.items()
                        if isinstance(value, dict) and (tool := tools.table(key))
                    ],
                )
    raise named_in.error("toolchain", f"is '{name}', which is none of: {', '.join(sorted(known))}{did_you_mean(name, known)}")


def chip_macros(chip: platform.Microcontroller) -> list[str]:
    """The macros by which programs ask for a microcontroller: those that avr-gcc defines for `-mmcu`; of others, none."""
    return [f"__AVR_{chip.title}__"] if str(chip.architecture) == "avr" else []


def target_repository(
    facts: TargetFacts,
    source: platform.Platform,
    board: platform.Board,
    libraries: list[platform.Library],
    words: Collection[str],
) -> platform.PlatformRepository:
    """The part of the platform models that a plan refers to.

    Args:
        facts: the target.
        source: the part of the source platform.
        board: the plan's board.
        libraries: the libraries that the plan names.
        words: the names in the program; names of the target's core are kept as far as they are among them.
    """
    target, made = facts.model, facts.model.platform
    assert made is not None
    if target.board is not board:
        as_given = bool(facts.full_name) and board.name == facts.board
        target.board = board
        made.boardMappings.clear()
        made.boardMappings.append(load_mapping(facts.platform, board))
        if as_given:
            _choose_options(facts.full_name, made.boardMappings[0], board)
    made.libraries.clear()
    made.libraries.extend(libraries)
    if facts.shared is not None:
        made.names = platform.ReservedNames(**{kind: [n for n in getattr(facts.shared, kind) if n in words] for kind in KINDS})
    sources = [mapping.board for mapping in source.boardMappings if mapping.board is not None]
    return platform.PlatformRepository(
        platforms=[source, made],
        boards=[board, *sources],
        microcontrollers=list(dict.fromkeys(c for b in (board, *sources) if (c := b.microcontroller) is not None)),
        toolchains=[target.toolchain] if target.toolchain is not None else [],
        targets=[target],
    )
