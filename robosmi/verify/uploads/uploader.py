"""The tool that puts programs on boards: where it is on this machine, what it is asked, what its messages mean.

All of that is data (`platform_repo/uploaders/NAME.toml`; a toolchain names one). Which program is sent is decided in `upload`.
"""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from robosmi.base.data_tables import DataTable, find_files
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, PlatformDataError, UploadError
from robosmi.verify.toolchains.boards import Board, BootLoader
from robosmi.verify.toolchains.toolchain_data import Toolchain, fill, places
from robosmi.verify.toolchains.tools import environment, run, tool_version
from robosmi.verify.uploads import serial_ports


class Uploader(Struct, frozen=True):
    """The tool as found on this machine.

    Attributes:
        data: what is known of it.
        path: its program.
        version: what it says of itself, or `unknown`.
        first: arguments that come before all others.
        environment: that it runs in.
    """

    data: DataTable
    path: str
    version: str
    first: tuple[str, ...]
    environment: Mapping[str, str]

    @property
    def title(self) -> str:
        """Its name with its version."""
        return f"{self.data.text('command')} {self.version}" if self.path else self.data.text("title")

    def command(self, board: Board, loader: BootLoader, port: str, baud: int, hex_file: Path) -> list[str]:
        """Program and arguments that send a file of the folder that it runs in."""
        values = board.fill() | {
            "programmer": loader.programmer, "port": port, "port_name": Path(port).name, "baud": str(baud),
            "hex": hex_file.name, "file": hex_file.name,
        }  # fmt: skip
        return [self.path, *self.first, *fill(self.data.texts("arguments"), values)]

    def send(self, command: Sequence[str], folder: Path) -> str | None:
        """Run a command in a folder: what it said where it failed, else None.

        Raises:
            VerificationError: it did not end in time, and was ended.
        """
        advice = self.data.text(
            "stuck", "the board may have an incomplete program; check the cable and the port, then upload again"
        )
        said = run(command, folder, self.environment, self.data.decimal("limit_s"), reads_files=False, advice=advice)
        return said.stdout + said.stderr if said.returncode else None

    def ports(self) -> str:
        """Which ports there are, in words."""
        found = serial_ports.ports(self.data.texts("ports"))
        return f"available: {', '.join(found)}" if found else "none is connected"

    def upload_error(
        self, said: str, board: Board, port: str, boards: Sequence[Board], command: Sequence[str] = ()
    ) -> tuple[UploadError, bool]:
        """What to say of a board that did not take its program, and whether another baud rate may help.

        Args:
            said: what the tool, or the system, said.
            board: the board that was expected.
            port: its port.
            boards: that are known, by whose signatures another one is called by its name.
            command: what was run, if anything was.
        """
        read = re.search(r"[Ss]ignature = (?:0x)?([0-9a-fA-F ]{6,8})", said)
        found = read[1].replace(" ", "").lower() if read else ""
        others = [each for each in boards if each.signature == found != ""]
        values = {
            "title": board.title, "port": port, "ports": self.ports(), "found": found or "that is another",
            "found_title": f" ({others[0].values['mcu']}: {', '.join(each.name for each in others)})" if others else "",
            "wanted": f"{board.signature} ({board.values['mcu']})",
        }  # fmt: skip
        for entry in self.data.tables("messages"):
            if entry.pattern("pattern").search(said):
                message, fix = fill([entry.text("message"), entry.text("fix")], values)
                return UploadError(message, fix=fix), entry.flag("again", False)
        lines = [line.strip() for line in said.splitlines() if line.strip()]
        last = next((line for line in lines if "error" in line.lower()), lines[-1] if lines else "no message")
        if not command:
            return UploadError(last, fix=self.ports()), False
        fix = f"for its full output run: {shlex.join(command)}"
        return UploadError(f"{self.data.text('command')} failed: {last}", fix=fix), False


COPY = "copy"
"""The kind of an uploader that runs no program: files are copied to the board's drive."""


def uploader_data(toolchain: Toolchain, project: Path | None = None, tool: str = "") -> DataTable:
    """What is known of a tool.

    Args:
        toolchain: the toolchain.
        project: the project folder; the current folder if None.
        tool: the tool that the board names; empty for the one that the toolchain names.

    Raises:
        PlatformDataError: none is named, or its file is not there or damaged.
    """
    name = tool or toolchain.uploader
    found = next(find_files(f"uploaders/{name}.toml", project), None) if name else None
    if found is None:
        fix = "set 'uploader' to a file of uploaders/, or upload the .hex with another tool"
        message = f"no upload method is known for '{toolchain.title}'"
        raise PlatformDataError(message, location=Location(str(toolchain.path)), fix=fix)
    return DataTable.read(found)


def find_program(data: DataTable) -> tuple[str, tuple[str, ...]] | None:
    """The path of the upload program, and the arguments that it needs there; None if it is not installed."""
    commands = (data.text("command"), *data.texts("also", ()))
    for command in commands:
        if found := shutil.which(command):
            return found, ()
    for folder in places(data.texts("places", ())):
        for command in commands:
            if found := shutil.which(command, path=str(folder)):
                config = folder / data.text("config", "")
                return found, tuple(fill(data.texts("config_arguments", ()), {"config": str(config)})) if config.is_file() else ()
    return None


def find_uploader(toolchain: Toolchain, project: Path | None = None, tool: str = "") -> Uploader:
    """The tool that a board or else a toolchain names, on this machine; one that copies files is everywhere.

    Args:
        toolchain, project, tool: see `uploader_data`.

    Raises:
        MissingToolError: it is not installed.
        PlatformDataError: its data is damaged.
    """
    data = uploader_data(toolchain, project, tool)
    if data.text("kind", "") == COPY:
        return Uploader(data, "", "", (), {})
    found = find_program(data)
    if found is None:
        fix = toolchain.install.replace("{packages}", data.text("package"))
        raise MissingToolError(f"not installed: {data.text('command')}", fix=fix)
    env = environment(toolchain)
    return Uploader(data, found[0], tool_version(found[0], data.texts("version"), env), found[1], env)
