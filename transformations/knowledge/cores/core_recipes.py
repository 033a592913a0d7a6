"""The commands that build a program for a board of an installed Arduino core: its own recipes and hooks.

Source: Arduino platform specification ("Recipes to compile source code", "Pre and post build hooks", "Recipes to compute binary
sketch size"). The folders of a build are those of Arduino CLI, because recipes name them: `core`, `sketch` and `libraries` in
`{build.path}`.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import time
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, PlatformDataError
from robosmi.transformations.knowledge.cores.core_folders import ArduinoCore, BoardName, build_properties, install_command
from robosmi.transformations.knowledge.cores.core_properties import SYSTEM, expand, split, unknown_names
from robosmi.verify.toolchains.recipes import Command
from robosmi.verify.toolchains.toolchain_data import Toolchain
from robosmi.verify.toolchains.tools import environment, tool_version

RUNTIME = {
    "runtime.ide.version": "10819",
    "ide_version": "10819",
    "software": "ARDUINO",
    "build.library_discovery_phase": "0",
    "build.compile_type": "Release",
    "runtime.os": SYSTEM,
}
"""What Arduino's tools say of themselves; sketches see the version as `ARDUINO`."""
_NOT_FOR_SCAN = {"-c", "-MMD", "-MD", "-MP", "-flto"}
_LANGUAGES = {".c": "c", ".S": "S"}
"""Suffixes of files whose recipe is not the one of C++."""


def _times() -> dict[str, str]:
    """The time of the build, which some cores give to the linker: in seconds since 1970."""
    now, zone = int(time.time()), -time.timezone
    summer = 3600 if time.localtime(now).tm_isdst > 0 else 0
    kinds = {"utc": now, "local": now + zone + summer, "zone": zone, "dst": summer}
    return {f"extra.time.{kind}": str(seconds) for kind, seconds in kinds.items()}


class CoreRecipes:
    """The commands of a core.

    Args:
        core: the installed core.
        name: the board with its menu options.
        toolchain: flags for the sketch's own files, and the environment of the commands.
        more: further properties.

    Raises:
        UsageError, MissingToolError, SourceError: see `build_properties`.
        PlatformDataError: the core has no recipes.
    """

    def __init__(self, core: ArduinoCore, name: BoardName, toolchain: Toolchain, more: Mapping[str, str] = {}) -> None:
        self._core = core
        self._toolchain = toolchain
        self.unconverted: str | None = None
        added = toolchain.core.table("properties", needed=False).table(core.architecture, needed=False)
        self._properties = build_properties(core, name) | RUNTIME | {key: added.text(key) for key in added.values} | dict(more)
        self._build_in(Path("."), "sketch")
        self.core = core.folder
        self.core_title = core.title
        self.environment: Mapping[str, str] = environment(toolchain)
        folders = [Path(self._properties["build.core.path"])]
        variant = self._properties["build.variant.path"]
        if variant and Path(variant).is_dir():
            folders.append(Path(variant))
        self.core_folders: Sequence[Path] = folders
        self.board_folders: Sequence[Path] = ()
        compiler = self._compiler(Path("x.cpp"), Path("x.o"), ())[0]
        self.title = f"{Path(compiler).stem} {tool_version(compiler, ['-dumpfullversion', '-dumpversion'])}, {core.title}"

    # ---- recipes

    def _text(self, key: str, more: Mapping[str, str] = {}) -> str:
        """A property of the core, expanded with some more properties."""
        text = self._properties.get(key)
        if text is None:
            raise self._damaged(f"the core {self.core_title} has no '{key}'")
        return expand(text, {**self._properties, **more})

    def _command(self, key: str, more: Mapping[str, str] = {}) -> Command:
        """A recipe's command, with its program found on this machine; empty if the recipe is."""
        program, *words = split(self._text(key, more)) or [""]
        own = unknown_names(program)[-1:] if program.endswith("}") else []  # other programs can be found by their name alone
        for name in (*own, *(name for word in words for name in unknown_names(word))):
            if name.startswith("runtime.tools."):
                raise self._missing(name.removeprefix("runtime.tools.").removesuffix(".path"))
            raise self._damaged(f"'{key}' of the core {self.core_title} names '{{{name}}}', which nothing defines")
        return [self._found(program), *words] if program else []

    def _needed(self, key: str, more: Mapping[str, str] = {}) -> Command:
        """The command of a recipe without which no program is built."""
        command = self._command(key, more)
        if not command:
            raise self._damaged(f"the core {self.core_title} has no command in '{key}'")
        return command

    def _damaged(self, what: str) -> PlatformDataError:
        place = Location(str(self.core / "platform.txt"))
        return PlatformDataError(what, location=place, fix="install the core again, or another version")

    def _missing(self, tool: str) -> MissingToolError:
        own = f"install the core's tools: {install_command(self._core.vendor or 'VENDOR', self._core.architecture)}"
        return MissingToolError(
            f"'{tool}', which the core {self.core_title} is built with, is not installed",
            fix=self._properties.get("stand_in.install", own),
        )

    def _found(self, program: str) -> str:
        """The path of a recipe's program: where the recipe says, else the program of that name on PATH."""
        if not unknown_names(program) and (found := shutil.which(program)):
            return found
        plain = re.split(r"[/\\}]", program)[-1]
        if plain.removesuffix(".exe") in ("python3", "python"):
            return sys.executable
        if found := shutil.which(plain):
            return found
        raise self._missing(plain)

    def _hooks(self, name: str, more: Mapping[str, str] = {}) -> Iterable[Command]:
        start, end = f"recipe.hooks.{name}.", "pattern"
        keys = [key for key in self._properties if key.startswith(start) and key.endswith(end)]
        numbers = {key: key[len(start) : -len(end)].rstrip(".") or "0" for key in keys}
        found = [(int(number), key) for key, number in numbers.items() if number.isdigit()]
        commands = (self._command(key, more) for _, key in sorted(found) if self._properties[key])
        return [command for command in commands if command]

    # ---- the steps of `Recipes`

    def prepare(self, folder: Path, name: str) -> Iterable[Command]:
        """See `Recipes`."""
        for part in ("core", "sketch", "libraries"):
            (folder / part).mkdir(exist_ok=True)
        self._build_in(folder, name)
        return [command for hook in ("prebuild", "sketch.prebuild", "core.prebuild") for command in self._hooks(hook)]

    def _build_in(self, folder: Path, name: str) -> None:
        self._properties |= {
            "build.path": str(folder), "build.project_name": name, "build.source.path": str(folder / "sketch"),
            "archive_file": "core.a", "archive_file_path": str(folder / "core.a"), **_times(),
        }  # fmt: skip

    def compile(self, source: Path, target: Path, use: str, includes: Sequence[Path]) -> Command:
        """See `Recipes`."""
        command = self._compiler(source, target, includes)
        return [command[0], *self._own(source.suffix, use), *command[1:]]

    def _own(self, suffix: str, use: str) -> tuple[str, ...]:
        return self._toolchain.language(suffix).by_use["sketch"] if use == "sketch" else ()

    def _compiler(self, source: Path, target: Path, includes: Sequence[Path]) -> Command:
        folders = " ".join(f'"-I{path}"' for path in (*self.core_folders, *includes))
        key = f"recipe.{_LANGUAGES.get(source.suffix, 'cpp')}.o.pattern"
        return self._needed(key, {"includes": folders, "source_file": str(source), "object_file": str(target)})

    def scan(self, source: Path, use: str, includes: Sequence[Path]) -> Command:
        """See `Recipes`."""
        command = self._compiler(source, Path(os.devnull), includes)
        at = command.index("-o") if "-o" in command else len(command)
        plain = [word for word in (*command[:at], *command[at + 2 :]) if word not in _NOT_FOR_SCAN]
        return [*plain, "-M", "-MG", "-w"]

    def database(self, suffix: str, includes: Sequence[Path]) -> Command:
        """See `Recipes`."""
        mark = "source-of-the-entry"
        command = self.compile(Path(f"{mark}{suffix}"), Path(os.devnull), "sketch", includes)
        at = command.index("-o") if "-o" in command else len(command)
        return [word for word in (*command[:at], *command[at + 2 :]) if word != f"{mark}{suffix}"]

    def archive(self, archive: Path, objects: Sequence[Path]) -> Iterable[Command]:
        """See `Recipes`: all objects by one command, where the recipe has the object as an argument of its own."""
        mark = "object-of-the-archive"
        places = {"build.path": str(archive.parent), "archive_file": archive.name, "archive_file_path": str(archive)}
        command = self._needed("recipe.ar.pattern", {**places, "object_file": mark})
        if mark in command:
            at = command.index(mark)
            return [[*command[:at], *(str(path) for path in objects), *command[at + 1 :]]]
        return [[word.replace(mark, str(path)) for word in command] for path in objects]

    def before_link(self, elf: Path, objects: Sequence[Path], libraries: Sequence[Path], core: Path | None) -> Iterable[Command]:
        """See `Recipes`."""
        return self._hooks("linking.prelink", self._linked(elf, objects, libraries, core))

    def link(self, elf: Path, objects: Sequence[Path], libraries: Sequence[Path], core: Path | None) -> Command:
        """See `Recipes`."""
        return self._needed("recipe.c.combine.pattern", self._linked(elf, objects, libraries, core))

    @staticmethod
    def _linked(elf: Path, objects: Sequence[Path], libraries: Sequence[Path], core: Path | None) -> Mapping[str, str]:
        """The properties that say what is linked."""
        files = " ".join(f'"{path}"' for path in (*objects, *libraries))
        beside = os.path.relpath(core, elf.parent) if core is not None else ""  # recipes name it within the build's folder
        return {"archive_file": beside, "archive_file_path": str(core or ""), "object_files": files}

    def size(self, elf: Path) -> Command:
        """See `Recipes`."""
        return self._needed("recipe.size.pattern")

    def sizes(self, printed: str) -> tuple[int, int | None]:
        """See `Recipes`: the sums of what the core's two regular expressions find."""
        data = "recipe.size.regex.data"
        flash = self._sum("recipe.size.regex", printed)
        if not flash:
            raise self._damaged(f"'recipe.size.regex' of the core {self.core_title} finds no sizes")
        return flash, self._sum(data, printed) if self._properties.get(data) else None

    def _sum(self, key: str, printed: str) -> int:
        """The sum of the numbers that a regular expression of the core finds."""
        try:
            return sum(int(number) for number in re.findall(self._text(key), printed, re.MULTILINE))
        except (re.error, TypeError, ValueError) as error:  # no pattern, or not one group with a number
            raise self._damaged(f"'{key}' of the core {self.core_title} finds no sizes: {error}") from error

    def disassemble(self, elf: Path) -> Command | None:
        """See `Recipes`: there is no analysis for these processors."""
        return None

    def convert(self, elf: Path) -> Iterable[Command]:
        """See `Recipes`."""
        pattern = re.compile(r"recipe\.objcopy\.[\w.]+\.pattern$")
        keys = [key for key in self._properties if pattern.match(key) and self._properties[key]]
        try:
            commands = [command for key in keys if (command := self._command(key))]
            return [*self._hooks("objcopy.preobjcopy"), *commands, *self._hooks("objcopy.postobjcopy")]
        except MissingToolError as error:
            self.unconverted = f"there is no {self.program(elf).name}: {error.message}"
            return ()

    def program(self, elf: Path) -> Path:
        """See `Recipes`."""
        return elf.parent / (self._text("recipe.output.tmp_file") if "recipe.output.tmp_file" in self._properties else elf.name)

    @property
    def limits(self) -> tuple[int | None, int | None]:
        """Flash and RAM of the board, in bytes, as the core has them; None where it does not say."""
        flash, ram = (
            expand(self._properties.get(f"upload.{key}", ""), self._properties) for key in ("maximum_size", "maximum_data_size")
        )
        return (int(flash) if flash.isdigit() else None), (int(ram) if ram.isdigit() else None)

    @property
    def board_title(self) -> str:
        """The board's full name."""
        return self._properties["name"]
