"""Fuzz precompiled headers: whatever headers and programs say, the model is the one that is read without.

Usage: python -m tests.fuzz.precompiled [--inputs N] [--seed N] [--seconds N]. By hand (`make fuzz`), not in CI. Programs and
their headers are damaged; each is read once without and twice with a precompiled header. Inputs with different models are kept.
"""

from __future__ import annotations

import argparse
import random
import shutil
import sys
import tempfile
import time
from pathlib import Path

from robosmi.errors import RobosmiError
from robosmi.model.xmi.xmi_writer import to_xmi
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.parsing import precompiled
from tests.fuzz.c_source import mutated

SOURCES = Path(__file__).resolve().parents[1] / "transformations" / "t2m" / "c_source"
PROGRAMS = SOURCES / "precompiled"
_ODD = (
    *(
        b"#endif\n",
        b"#if 1\n",
        b"#define LED 3\n",
        b"#undef LED\n",
        b'#include "board.h"\n',
        b'#include "pins.def"\n',
        b"#error no\n",
    ),
    *(
        b"#pragma once\n",
        b'_Pragma("once")\n',
        b'#line 7 "other.c"\n',
        b"static int number = __COUNTER__;\n",
        b"#pragma pack(1)\n",
    ),
    *(b"typedef int output_t;\n", b"int own_function(int pin);\n", b"struct s { int a; };\n", b"const char *f = __FILE__;\n"),
)


def others() -> list[tuple[str, bytes]]:
    """The names and texts of the other programs of the tests, with a header."""
    found = [path for path in sorted(SOURCES.rglob("*")) if path.suffix in (".c", ".cpp", ".ino") and path.parent != PROGRAMS]
    return [(path.name, b'#include "board.h"\n' + path.read_bytes()) for path in found if path.stat().st_size < 20_000]


def damaged(folder: Path, chance: random.Random) -> Path:
    """Damage headers and a program of a folder; the program."""
    sources = sorted(path for path in folder.iterdir() if path.suffix in (".c", ".cpp", ".ino"))
    program = chance.choice(sources)
    headers = [*sorted((folder / "include").iterdir()), folder / "beside.h"]
    for path in (*(header for header in headers if chance.random() < 0.5), program):
        data = path.read_bytes()
        if chance.random() < 0.6:
            place = data.find(b"\n", chance.randrange(len(data) + 1)) + 1
            data = data[:place] + chance.choice(_ODD) + data[place:]
        if chance.random() < 0.5:
            data = mutated(data, chance.choice(sources).read_bytes(), chance)
        path.write_bytes(data)
    return program


def read(program: Path, enough: int) -> object:
    """The model and the findings, or the reader's error; with precompiled headers after so many readings."""
    precompiled.ENOUGH = enough
    try:
        model, findings = read_program(program, include_dirs=[program.parent / "include"])
        return to_xmi({"code.xmi": model})["code.xmi"], findings
    except RobosmiError as error:
        return str(error)


def main() -> int:
    """The command line; the exit code is 1 when two models of one program differ."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=5_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=0, help="stop after this time (default: never)")
    parser.add_argument("--keep", type=Path, default=Path("out") / "fuzz", help="where inputs that fail are kept")
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    precompiled.LEAST = 0
    done = different = 0
    programs = others()
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        while done < arguments.inputs and not (arguments.seconds and time.monotonic() - begun > arguments.seconds):
            folder = Path(shutil.copytree(PROGRAMS, Path(scratch) / str(done)))
            for name, text in chance.sample(programs, 10):
                (folder / name).write_bytes(text)
            program = damaged(folder, chance)
            plain = read(program, sys.maxsize)
            if any(read(program, 1) != plain for _ in range(2)):
                different += 1
                kept = shutil.copytree(folder, arguments.keep / f"precompiled-{arguments.seed}-{done}", dirs_exist_ok=True)
                print(f"{kept}: {program.name} is read in two ways", file=sys.stderr)
            shutil.rmtree(folder)
            done += 1
    print(f"precompiled headers: {done} programs, {different} read in two ways")
    return int(different > 0)


if __name__ == "__main__":
    sys.exit(main())
