"""Which lines of a sketch's files are executed, found by the instruction addresses that an engine reports (avr8js).

The program as users get it does not tell. It is optimised while linking, and the compiler then keeps for each instruction the
line where it was written, but not the lines of the calls that were inlined: a line that only calls inlined functions would have
no instruction at all. So the sketch is built once more without link-time optimisation and with all debug information on calls.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Collection, Sequence
from pathlib import Path

from msgspec.structs import replace

from robosmi.metamodels import platform
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, simulate
from robosmi.verify.toolchains.boards import load_boards
from robosmi.verify.toolchains.build import Build
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.libraries import LibraryFolders
from robosmi.verify.toolchains.recipes import DataRecipes
from robosmi.verify.toolchains.sketch import choose_board, find_sketch
from robosmi.verify.toolchains.tools import find_installed

_FLAGS = ("-fno-lto", "-gdwarf-4")
_LIMIT_S = 300.0


def built_for_lines(out: Path, place: Path) -> CompileReport:
    """Build a sketch so that its instructions are traced to all lines that they stand for.

    Args:
        out: the output folder of a migration.
        place: an empty folder for the program.
    """
    sketch, toolchain = find_sketch(out)
    board = choose_board(sketch, load_boards(toolchain.platform), toolchain)
    board = board._replace(extra_flags=(*board.extra_flags, *_FLAGS))
    installed = find_installed(toolchain)
    folder = place / "objects"
    folder.mkdir()
    return Build(
        sketch,
        board,
        toolchain,
        DataRecipes(toolchain, installed, board),
        LibraryFolders(toolchain, installed.core, None),
        folder,
    ).report(place)


def run_addresses(report: CompileReport, board: platform.Board, horizon_ms: float, devices: Sequence[DeviceUse]) -> set[int]:
    """The addresses of the instructions that are executed in a scenario.

    Args:
        report: the result of `built_for_lines`.
        board: the board.
        horizon_ms: duration of the scenario in milliseconds.
        devices: the devices that the scenario connects to the board.
    """
    assert report.elf is not None
    assert report.hex is not None
    asked = job(report.elf, report.hex, board, horizon_ms * 1000, devices)
    return set(simulate(replace(asked, reached=True), "avr8js", _LIMIT_S).reached)


def lines_of(report: CompileReport, addresses: Collection[int], names: Collection[str]) -> dict[str, set[int]]:
    """The lines that some instructions stand for, by the name of the file.

    Args:
        report: the result of `built_for_lines`.
        addresses: the addresses of the instructions.
        names: the names of the files.
    """
    assert report.elf is not None
    told = subprocess.run(
        ["avr-addr2line", "-i", "-e", report.elf],
        input="\n".join(f"{address:#x}" for address in sorted(addresses)), capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    lines: dict[str, set[int]] = {name: set() for name in names}
    for path, line in re.findall(r"^(.*):(\d+)", told, re.MULTILINE):
        if Path(path).name in lines:
            lines[Path(path).name].add(int(line))
    return lines
