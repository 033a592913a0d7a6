"""Compiles a migrated program for what runs it: for its board, or for this computer with the model of the Arduino API.

The second is for boards whose microcontroller no simulator has (`api` in platform_repo/simulation/api.toml). Then the board's
own core compiles the program, too, if it is installed: it alone tells whether the program is one of the board.

The model's core is `platform_repo/arduino/api_model`; its comments say how a program is isolated from this computer. What
differs from board to board are properties of the build.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.errors import MissingToolError, SourceError, UsageError
from robosmi.resources import built_in
from robosmi.transformations.knowledge.board_models import load_board, load_mapping, mapping_file
from robosmi.transformations.knowledge.cores.core_folders import ArduinoCore, BoardName
from robosmi.transformations.knowledge.cores.core_recipes import CoreRecipes
from robosmi.transformations.verification.jobs import api_facts, pins_and_inputs
from robosmi.verify.simulation import engine_for, serving_engines
from robosmi.verify.toolchains.boards import Board, load_boards
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.recipes import InstalledBoard
from robosmi.verify.toolchains.sketch import choose_board, find_sketch
from robosmi.verify.toolchains.toolchain import compile_by, compile_sketch
from robosmi.verify.toolchains.toolchain_data import Toolchain
from robosmi.verify.traces.verdict import AT_THE_PINS, Judge

AT_THE_API = Judge(
    "api",
    "judged at the Arduino API",
    (
        "times below 10 us", "interrupts that come while others run", "registers and timers of the microcontroller",
        "heap and stack", "the frequency of analogWrite", "the quirks of the board's own core",
    ),
)  # fmt: skip
_MOST_PINS = 32
"""So many pins the simulated chip has."""
_BUS_LINES = ("SDA", "SCL", "SCK", "MOSI", "MISO")
_NO_NUMBER = -1
_INPUT = re.compile(r"A\d+")

_TEXTS = "stand_ins/hardware/rp2040/rp2040/cores/rp2040"
"""The folder with what its texts and streams consist of."""
_NAME = BoardName("robosmi", "api", "board")


class RunnableProgram(NamedTuple):
    """A program that is compiled for what runs it.

    Attributes:
        report: how it was compiled; with the program of this computer where it is judged at the Arduino API.
        judge: where it is judged.
        not_compiled: why the board's own core has not compiled it; empty if it has.
        lacking: that the model of the Arduino API cannot run it, and why; empty if it can.
    """

    report: CompileReport
    judge: Judge = AT_THE_PINS
    not_compiled: str = ""
    lacking: str = ""


def compile_to_run(output: Path, keep: Path) -> RunnableProgram:
    """Compile a program for what runs it.

    Args:
        output: the output folder of a migration, or the program's own folder.
        keep: an existing folder for the program.

    Raises:
        SourceError, UsageError, MissingToolError, PlatformDataError: see `compile_sketch` and `engine_for`.
    """
    found = _judged_at_api(output)
    if found is None:
        return RunnableProgram(compile_sketch(output, keep=keep))
    board, toolchain = found
    engine_for(board.values["mcu"])  # before its compiler fails
    not_compiled = ""
    try:
        report = compile_sketch(output)
        if not report.ok:
            return RunnableProgram(report, AT_THE_API)
    except MissingToolError as error:
        not_compiled = error.message
    own = compile_by(output, _api_board(board, _properties(board, toolchain), toolchain), keep=keep)
    lacking = "" if own.ok else f"the model of the Arduino API cannot run the program: {_first_error(own)}"
    return RunnableProgram(own, AT_THE_API, not_compiled, lacking)


def _first_error(report: CompileReport) -> str:
    """The first error, with its place; names of the program have a $ before them when they are linked."""
    first = next(iter(report.errors), None)
    if first is None:
        return "it does not compile"
    at = first.location
    return first.message.replace("$", "") + (f" ({Path(at.path).name}:{at.line})" if at is not None and at.line else "")


def _judged_at_api(output: Path) -> tuple[Board, Toolchain] | None:
    """The board of a program that is judged at the Arduino API, with its toolchain; None for all other programs.

    Raises:
        UsageError: no engine knows the board's microcontroller.
    """
    sketch, toolchain = find_sketch(output)
    try:
        board = choose_board(sketch, load_boards(toolchain.platform), toolchain)
    except (UsageError, SourceError):
        return None
    if mcu := board.values.get("mcu"):
        serving_engines(mcu)  # before a core is missed that would not help
    return (board, toolchain) if api_facts(board.values["mcu"]) is not None else None


def _properties(board: Board, toolchain: Toolchain) -> dict[str, str]:
    """What differs from board to board, as arguments of the compiler."""
    facts = api_facts(board.values["mcu"])
    assert facts is not None
    model = load_board(board.name)
    pins, inputs = pins_and_inputs(model)
    path = mapping_file(toolchain.platform, board.name)
    numbers = DataTable.read(path).numbers_by_name("numbers") if path is not None else {}
    pins = pins[:_MOST_PINS]
    own = {str(pin.label): numbers.get(str(pin.label), _NO_NUMBER) for pin in pins}
    called = {str(name): own[str(pin.label)] for pin in pins for name in (pin.label, *pin.aliases)}
    names = {name: number for name, number in called.items() if _INPUT.fullmatch(name) or name in _BUS_LINES}
    lines = {name: number for name, number in names.items() if name in _BUS_LINES}
    for written in load_mapping(toolchain.platform, model).pinNames:  # by which sketches of ours call pins
        if written.pin is not None and str(written.literal).isidentifier() and str(written.pin.label) in own:
            names[str(written.literal)] = own[str(written.pin.label)]
    channels = [inputs.index(pin) if pin in inputs else _NO_NUMBER for pin in pins]
    defines = {
        "API_NAMES": "".join(f"API_NAME({name},{number})" for name, number in names.items()),
        "API_PIN_COUNT": str(max(own.values(), default=-1) + 1),
        "API_PIN_NUMBERS": ",".join(str(number) for number in own.values()),
        "API_PIN_CHANNELS": ",".join(str(channel) for channel in channels),
        "API_MILLIVOLTS": str(round(model.volts * 1000)),
        "API_USB_CONSOLE": str(int(facts.flag("usb_console"))),
        "F_CPU": f"{model.clockHertz}L",
        f"ARDUINO_ARCH_{board.architecture.upper()}": "1",
        **{f"API_{name}": str(number) for name, number in lines.items()},
        **({"API_LED": str(own[str(model.led)])} if str(model.led) in own else {}),
    }
    signed = _architecture(board, toolchain).flag("charSigned")
    flags = [*facts.texts("flags"), "-fsigned-char" if signed else "-funsigned-char"]
    return {"api.flags": " ".join(flags), "api.defines": " ".join(f'"-D{name}={text}"' for name, text in defines.items())}


def _architecture(board: Board, toolchain: Toolchain) -> DataTable:
    """What the platform says of the processors of a board's architecture."""
    path = resources.find("platform_repo", f"{toolchain.platform}/platform.toml")
    return DataTable.read(path).table("architectures").table(board.architecture)


def _api_board(board: Board, properties: Mapping[str, str], toolchain: Toolchain) -> InstalledBoard:
    """A board as the model of the Arduino API builds its programs.

    Args:
        board: the board.
        properties: what its programs have to know of it: `api.flags` and `api.defines`, arguments of the compiler.
        toolchain: the toolchain of the sketch.

    Raises:
        MissingToolError: the compiler is not installed.
    """
    core = ArduinoCore(built_in("platform_repo") / "arduino" / "api_model", _NAME.vendor, _NAME.architecture, None)
    recipes = CoreRecipes(core, _NAME, toolchain, properties)
    recipes.board_folders = [core.folder / "chip", core.folder.parent / _TEXTS]
    own = Board(board.name, board.title, board.full_names, {}, (), None, None, architecture=board.architecture)
    return InstalledBoard(own, recipes, board.architecture)
