"""The project files of other tools around a sketch.

`sketch.yaml` (Arduino CLI) and `platformio.ini` (PlatformIO) have the board and the libraries that something in the sketch
uses, with their versions (`project`). Libraries that the board's core brings are left out: one of the index would go before
the core's own, and may not compile there.

A project of the Wokwi simulator (`project_files`) has `diagram.json`, the sketch under the name that Wokwi expects, and
`libraries.txt`. `m2m/circuits/wokwi_wiring` decides what is drawn and wired. The formats are those of https://docs.wokwi.com:
diagram-format, guides/libraries. Positions are in pixels: parts are in columns at the right of the board, and Wokwi routes the
wires.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from robosmi.base.data_text import Json, json_written
from robosmi.metamodels import migration, platform
from robosmi.transformations.queries.plans.plan_adapters import emitted

if TYPE_CHECKING:
    from robosmi.transformations.knowledge.wokwi_diagram import DrawnPart, WokwiWiring

_DIAGRAM, _SKETCH, _LIBRARIES, _LISTED = "diagram.json", "sketch.ino", "libraries.txt", "not-drawn.txt"
_SOURCES = (".ino", ".h", ".hpp", ".c", ".cpp", ".s")
_LEFT, _COLUMN, _ROW, _ROWS = 420, 220, 150, 6
_COLOURS = ("green", "blue", "orange", "purple", "gold", "cyan", "magenta", "limegreen", "brown", "gray")
_CARRIED = {"GND": "black", "": ""}


def project(plan: migration.MigrationPlan) -> dict[str, Any]:
    """The board's core, the libraries that are used, and these with all that they depend on as the file lists them."""
    assert plan.board is not None
    assert plan.target is not None
    mapping = next((m for m in plan.target.boardMappings if m.board is plan.board), None)
    full_name = str(mapping.boardId) if mapping is not None else ""
    core = ":".join(full_name.split(":")[:2])  # arduino:avr of arduino:avr:uno
    own = str(mapping.coreVersion) if mapping is not None else ""
    version = own or (str(plan.target.coreVersion) if plan.target.coreName in ("", core) else "")
    versions = {library.name: library.version for library in plan.target.libraries}
    used = {str(name) for piece in emitted(plan) for name in piece.libraries}
    included = [c.chosen for c in plan.libraryChoices if c.chosen is not None and c.included]
    adapted = [library for library in plan.target.libraries if library.name in used]
    chosen = list({id(library): library for library in (*included, *adapted, *plan.ownLibraries)}.values())
    needed = dict.fromkeys(name for library in chosen for name in (library.name, *library.depends))
    names = [name for name in needed if name not in plan.target.coreLibraries]
    return {
        "board": full_name,
        "platform": core,
        "core": f"{core} ({version})" if version else core,
        "chosen": chosen,
        "libraries": [f"{name} ({versions[name]})" if versions.get(name) else name for name in names],
        "platformio": str(mapping.platformioId) if mapping is not None else "",
        "platformio_platform": (str(mapping.platformioPlatform) if mapping is not None else "") or _usual_platform(plan.board),
        "platformio_settings": [str(line) for line in mapping.platformioSettings] if mapping is not None else [],
        "index_url": str(mapping.coreIndex) if mapping is not None else "",
        "dependencies": [_dependency(str(name), str(versions.get(name) or "")) for name in names],
    }


def _usual_platform(board: platform.Board) -> str:
    """PlatformIO's platform for AVR boards of any core; empty for others."""
    chip = board.microcontroller
    return "atmelavr" if chip is not None and chip.architecture == "avr" else ""


def _dependency(name: str, version: str) -> str:
    """A library as an entry of PlatformIO's `lib_deps`: one line, in which ` ;` would begin a comment."""
    plain = " ".join(name.replace(" ;", ";").split())
    return f"{plain} @ {version}" if version else plain


def diagram_text(wiring: WokwiWiring, author: str) -> str:
    """The text of `diagram.json`, with one part or connection per line.

    Args:
        wiring: what is drawn.
        author: the author that the file names.
    """
    parts = [json_written(_part(part, number), ensure_ascii=False) for number, part in enumerate(wiring.parts)]
    wires = [
        json_written([one, other, _CARRIED.get(carried, "red") or _COLOURS[number % len(_COLOURS)], []], ensure_ascii=False)
        for number, (one, other, carried) in enumerate(wiring.wires)
    ]
    head = [f'  "version": 1,\n  "author": {json_written(author)},\n  "editor": "wokwi"']
    lists = [f'  "{name}": [{_lines(entries)}]' for name, entries in (("parts", parts), ("connections", wires))]
    return "{\n" + ",\n".join([*head, *lists, '  "dependencies": {}']) + "\n}\n"


def project_files(
    wiring: WokwiWiring, sketch: Mapping[str, bytes], libraries: Sequence[str], listed: Sequence[str], author: str
) -> dict[str, bytes]:
    """The files of the project, relative path -> bytes.

    Args:
        wiring: what is drawn.
        sketch: the files of the sketch's folder, name -> bytes.
        libraries: name of each library, with its version in brackets where it is known.
        listed: a line about each part that is not drawn; no file is made where there is none.
        author: who the diagram says has made it.
    """
    files = {_DIAGRAM: diagram_text(wiring, author).encode()}
    for name, data in sketch.items():
        if name.lower().endswith(_SOURCES):
            files[_SKETCH if name.lower().endswith(".ino") else name] = data
    lines = [
        "# Libraries of this project, as Wokwi installs them (docs.wokwi.com/guides/libraries)",
        *(_library(each) for each in libraries),
    ]
    files[_LIBRARIES] = ("\n".join(lines) + "\n").encode()
    if listed:
        head = "Parts that Wokwi does not have; they are not in the diagram:"
        files[_LISTED] = ("\n".join([head, *listed]) + "\n").encode()
    return files


def _part(part: DrawnPart, number: int) -> dict[str, Json]:
    place = number - 1
    left = 0 if number == 0 else _LEFT + _COLUMN * (place // _ROWS)
    top = 0 if number == 0 else _ROW * (place % _ROWS)
    return {"type": part.kind, "id": part.identity, "top": top, "left": left, "attrs": part.attributes}


def _lines(entries: Sequence[str]) -> str:
    return "\n" + ",\n".join(f"    {entry}" for entry in entries) + "\n  " if entries else ""


def _library(text: str) -> str:
    """`Servo (1.2.2)` converted to `Servo@1.2.2`."""
    name, _, version = text.removesuffix(")").partition(" (")
    return f"{name}@{version}" if version else name
