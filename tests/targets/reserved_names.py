"""The names that boards with another microcontroller than the Uno's share with every sketch, beyond those of the Uno.

Usage: python -m tests.targets.reserved_names [--write]. Macros and what is declared at file scope are read from Arduino.h as
avr-g++ preprocesses it for the board, less what `names.json` has already. `test_reserved_names.py` holds the stored names to it.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from clang import cindex

from robosmi import resources

BOARDS = {"atmega2560": ("mega", "AVR_MEGA2560"), "atmega32u4": ("leonardo", "AVR_LEONARDO")}
"""Microcontroller -> a board with it: the folder of its variant, and the macro that names it."""
FOLDER = resources.built_in("platform_repo") / "arduino"
_CORE = Path("/usr/share/arduino/hardware/arduino/avr")
_ABOUT = "Names that sketches for boards with this microcontroller share with the core and avr-libc, beyond names.json."


def _preprocessed(mcu: str, *options: str) -> str:
    variant, name = BOARDS[mcu]
    defines = ["F_CPU=16000000L", "ARDUINO=10819", f"ARDUINO_{name}", "ARDUINO_ARCH_AVR", "USB_VID=1", "USB_PID=1"]
    folders = [_CORE / "cores/arduino", _CORE / "variants" / variant]
    call = [
        "avr-g++",
        f"-mmcu={mcu}",
        "-Os",
        "-std=gnu++11",
        *(f"-D{each}" for each in defines),
        *(f"-I{each}" for each in folders),
    ]
    done = subprocess.run(
        [*call, "-x", "c++", "-E", *options, "-"], input="#include <Arduino.h>\n", capture_output=True, text=True, check=True
    )
    return done.stdout


def names_of(mcu: str) -> dict[str, list[str]]:
    """The names by kind, sorted: `declared` and `macros`."""
    known = json.loads((FOLDER / "names.json").read_text())
    macros = {line.split()[1].partition("(")[0] for line in _preprocessed(mcu, "-dM").splitlines()}
    macros = {name for name in macros if not name.startswith("_")}
    text = _preprocessed(mcu, "-P")
    given = ["-target", "avr", "-x", "c++", "-std=gnu++11", "-w"]
    unit = cindex.Index.create().parse("names.cpp", given, unsaved_files=[("names.cpp", text)])
    declared = {str(cursor.spelling) for cursor in unit.cursor.get_children() if str(cursor.spelling).isidentifier()}
    there = {name for kind in ("declared", "macros", "same", "absent", "keywords") for name in known[kind]}
    declared = {name for name in declared - there if not name.startswith("_")}
    return {"declared": sorted(declared), "macros": sorted(macros - there)}


def text_of(mcu: str) -> str:
    """The file of a microcontroller."""
    return json.dumps({"about": _ABOUT, **names_of(mcu)}, indent=1) + "\n"


def main(*arguments: str) -> int:
    """Print the files that are not what is read; 1 if there are any. With `--write`, write them."""
    wrong = 0
    for mcu in BOARDS:
        path, text = FOLDER / "names" / f"{mcu}.json", text_of(mcu)
        if path.is_file() and path.read_text() == text:
            continue
        wrong += 1
        print(path.name)
        if "--write" in arguments:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
