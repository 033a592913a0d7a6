"""Measures the stack that calls of adapters and their interrupts take, by reading machine code.

`python -m tests.adapters.stack [HEADER...]` prints the pieces whose markers `stack` and `interrupt` differ from what is
measured for an Uno; with `--write` the markers are corrected. A program that does nothing but call the adapter is compiled
twice: with one call, which the compiler inlines, and with two calls.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

from robosmi.transformations.knowledge.adapters.adapter_files import MARK
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.queries.resources.stack_depth import CORE_INTERRUPT
from robosmi.transformations.verification.stack.machine_stack import StackParts, stack_parts
from robosmi.verify.toolchains.toolchain import compile_sketch
from robosmi.verify.toolchains.toolchain_data import load_toolchain
from tests.adapters import bench
from tests.adapters.memory import MCU

_GIVEN = """
template <class T> inline T given() {
  static T value;
  asm volatile("" : "+m"(value));
  return value;
}
struct Any {
  template <class T> operator T() const { return given<T>(); }
};
"""
"""Functions whose results the compiler cannot predict, to be used as arguments."""
_CORE = "TIMER0_OVF_vect"
"""The interrupt that every program of the core contains."""
_KINDS = ("adapter", "register", "variable")
_LAST_NAME = re.compile(r"(\w+)\s*(?:\)\s*\(.*\))?(?:\[\w*\])*$")
_TEMPLATE = re.compile(r"\b(?:class|typename) (\w+)")
_TEXT = re.compile(r"const char ?\*")


class Measured(NamedTuple):
    """The measurements of an adapter.

    Attributes:
        stack: bytes of stack if it is called at several places, and if it is called at one (inlined).
        interrupts: name of each interrupt that the adapter handles -> bytes at its deepest point, and at its deepest point with
            interrupts enabled (negative for none).
    """

    stack: tuple[int, int]
    interrupts: Mapping[str, tuple[int, int]]


def parameters(piece: AdapterPiece) -> list[str]:
    """The parameters of the function that a piece defines.

    Raises:
        NotBuiltError: it defines none.
    """
    name = re.escape(piece.target_name or piece.name)
    found = re.search(rf"\b{name}\s*\(((?:[^()]|\([^()]*\))*)\)\s*(?:const\s*)?\{{", piece.text)
    if found is None:
        raise bench.NotBuiltError(f"{piece.name} is no function")
    parts, depth = [""], 0
    for character in found[1]:
        depth += (character in "(<[") - (character in ")>]")
        if character == "," and not depth:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts if part.strip() not in ("", "void")]


def statement(piece: AdapterPiece, turn: int, again: bool) -> str:
    """A statement that uses a piece with known pins and texts and unknown other arguments.

    Pins are unknown to a piece that is cheaper for those that the compiler knows: the others take more. With `again`,
    another one, for pieces whose first statement is no valid C++ (a register that cannot be written).
    """
    name = piece.target_name or piece.name
    if piece.kind in ("register", "variable"):  # not all may be written
        return f"given<uint32_t *>()[{turn}] = {name};" if again else f"{name} = given<uint32_t>() | {name};"
    known = "pin_is_known" not in piece.text
    pins = {pin.name: 2 + 2 * number + turn if known else "given<int32_t>()" for number, pin in enumerate(piece.pins)}
    declared = parameters(piece)
    scans = "scan" in piece.name
    given = []
    for each in declared:
        word = _LAST_NAME.search(each)
        if "..." in each:
            given += ["given<int32_t *>()" if scans else "given<int32_t>()"] * 2
        elif word is not None and word[1] in pins:
            given.append(str(pins[word[1]]))
        elif _TEXT.search(each) and any("..." in other for other in declared):
            given.append(f'"%d {turn} %d\\n"')
        else:  # a template does not take what may be anything
            open_type = any(re.search(rf"\b{name}\b", each) for name in _TEMPLATE.findall(piece.text))
            given.append(f"given<int32_t{' *' * ('*' in each)}>()" if open_type else "Any()")
    return f"{name}({', '.join(given)});"


def code_of(piece: AdapterPiece, places: int) -> StackParts:
    """The stack of a program that uses a piece at so many places.

    Raises:
        NotBuiltError: it does not compile, or there is nothing to use.
    """
    labels = dict.fromkeys((port.name for each in bench.pieces() for port in each.ports), "")
    ports = {label: str(2 + number % 10) for number, label in enumerate(labels)}
    said: list[str] = []
    for again in (False, True)[: 1 + (piece.kind in ("register", "variable"))]:
        lines = "\n  ".join(statement(piece, turn, again) for turn in range(places))
        program = f"{_GIVEN}void setup() {{}}\nvoid loop() {{\n  {lines}\n}}\n"
        text = bench.Uno(ports=ports).sketch(program, [f"{piece.header}/{piece.name}"])
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / "case"
            folder.mkdir()
            (folder / "case.ino").write_text(text)
            with patch("robosmi.verify.toolchains.build.without_relocations", bytes):  # they tell what pointers reach
                report = compile_sketch(folder, "uno", keep=Path(place))
            if report.ok and report.elf is not None:
                return stack_parts(listing(report.elf))
            said = [finding.message for finding in report.diagnostics]
    raise bench.NotBuiltError(said)


def listing(elf: Path) -> str:
    """The disassembly of a linked program."""
    command = [
        "avr-objdump",
        *load_toolchain(bench.ROOT / "platform_repo" / "arduino" / "toolchain.toml").stack.texts("arguments"),
    ]
    done = subprocess.run([part.format(elf=elf) for part in command], check=True, capture_output=True, text=True)
    return done.stdout


@cache
def vectors() -> dict[str, str]:
    """Name of an interrupt handler in machine code -> name of the interrupt."""
    command = ["avr-gcc", f"-mmcu={MCU}", "-dM", "-E", "-include", "avr/io.h", "-x", "c", "/dev/null"]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return {f"__vector_{found[2]}": found[1] for found in re.finditer(r"#define (\w+_vect)_num +(\d+)", said)}


def measured(piece: AdapterPiece) -> Measured:
    """Measure an adapter.

    Raises:
        NotBuiltError: no program can be made of it.
    """
    once, often = code_of(piece, 1), code_of(piece, 2)
    stack = tuple(max(0, each.main_open, each.main - CORE_INTERRUPT) for each in (often, once))
    names = vectors()
    handled = {names[name]: sizes for name, sizes in often.interrupts.items() if names[name] != _CORE}
    return Measured((stack[0], stack[1]), handled)


def written(text: str, found: Mapping[tuple[str, str], Measured]) -> str:
    """The text of an adapter file with the measured markers; variants, and what was not measured, keep theirs."""
    lines: list[str] = []
    header, key, kept = "", ("", ""), True
    for line in [*text.split("\n"), None]:
        head = line is not None and line.startswith(f"{MARK}   ")
        if not head and not kept and key in found:
            lines += marks(found[key])
            key = ("", "")
        if line is None:
            break
        if head and line.startswith((f"{MARK}   members:", f"{MARK}   beside:")):
            kept = True
        if head and not kept and key in found and line.startswith((f"{MARK}   stack:", f"{MARK}   interrupt:")):
            continue
        lines.append(line)
        words = line[len(MARK) :].split() if line.startswith(MARK) else []
        if words[:1] == ["header"]:
            header = words[1]
        elif not head and len(words) == 2:
            key, kept = (header, words[1]), False
    return "\n".join(lines)


def marks(found: Measured) -> list[str]:
    """The lines with measurements for the head of a piece."""
    often, once = found.stack
    lines = [f"{MARK}   stack: {often}{f' {once}' if once != often else ''}"]
    for name, (size, others) in sorted(found.interrupts.items()):
        lines.append(f"{MARK}   interrupt: {name} {size}{f' {others}' if others >= 0 else ''}")
    return lines


def main(*arguments: str) -> int:
    """Print the files with wrong markers, or with `--write` correct them; 1 if there are any."""
    asked = [each for each in arguments if not each.startswith("-")]
    wrong = 0
    for path in sorted({Path(piece.location.path) for piece in bench.pieces()}):
        here = [piece for piece in bench.pieces() if piece.location.path == str(path)]
        if asked and here[0].header not in asked:
            continue
        found: dict[tuple[str, str], Measured] = {}
        for piece in here:
            if (
                (piece.kind not in _KINDS and piece.stack < 0)
                or piece.members
                or piece.beside
                or (piece.mcus and MCU not in piece.mcus)
            ):
                continue
            try:
                found[piece.header, piece.name] = measured(piece)
            except bench.NotBuiltError as error:
                print(f"{piece.header}/{piece.name} is not measured: {str(error)[:120]}", flush=True)
        text = path.read_text()
        if (new := written(text, found)) == text:
            continue
        wrong += 1
        if "--write" in arguments:
            path.write_text(new)
        else:
            print(f"{path.relative_to(bench.ADAPTERS)}: the markers `stack` and `interrupt` are not what is measured", flush=True)
    return int(bool(wrong and "--write" not in arguments))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
