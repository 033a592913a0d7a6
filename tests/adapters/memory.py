"""Measures the data memory of the variables in adapter pieces, with avr-g++, avr-gcc and avr-objdump.

`python -m tests.adapters.memory [HEADER...]` prints the files whose marker `ram` differs from the measurement; with `--write` the
markers are corrected. A variable belongs to the piece whose text declares it. The pieces of the hardware layer are measured in
the programs of the headers that need them: some exclude each other, and those of other architectures do not compile here.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

from robosmi.transformations.knowledge.adapters.adapter_files import HAL, MARK
from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.m2t.adapter_text import adapter_text
from robosmi.transformations.m2t.adapters import MOTORS
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from tests.adapters import bench, bench_c, test_files

_SYMBOL = re.compile(
    r"^[0-9a-f]+ .{7} (?P<section>\.(?:data|bss|rodata|noinit)\S*|\*COM\*)\s+(?P<bytes>[0-9a-f]+) (?:\.hidden )?(?P<name>.+)$"
)
MCU = "atmega328p"
_SCALAR = 4
"""Constants of up to this many bytes are put into the code, not into data memory."""
_NO_NAME = re.compile(r"\([^()]*\)|\.\d+|vtable for|guard variable for|anonymous namespace")
_COGS = "#define COG_SLOTS 1\n#define COG_STACK 0\n"
"""Macros for one coroutine without stack; a plan counts the stacks itself."""
_KEEP = ["-O1", "-fno-toplevel-reorder", "-fkeep-inline-functions", "-fkeep-static-consts", "-fno-merge-constants", "-w"]


def symbols(text: str, mcu: str, folder: Path, language: str) -> Iterator[tuple[str, int]]:
    """The variables that a text declares, with their bytes; a static local is prefixed with its function and `::`."""
    name = f"adapters.{'c' if language == 'C' else 'cpp'}"
    (folder / name).write_text(text)
    tool, more = ("avr-gcc", ["-std=gnu11"]) if language == "C" else ("avr-g++", [*test_files.DEFINES])
    command = [tool, f"-mmcu={mcu}", "-DF_CPU=16000000L", *more, *_KEEP, *test_files.folders(mcu), "-c", name, "-o", "adapters.o"]
    subprocess.run(command, check=True, cwd=folder)
    listed = subprocess.run(["avr-objdump", "-t", "-C", "adapters.o"], check=True, capture_output=True, text=True, cwd=folder)
    for line in listed.stdout.splitlines():
        if (found := _SYMBOL.match(line)) and not found["name"].startswith("."):
            size = int(found["bytes"], 16)
            if size > _SCALAR or not found["section"].startswith(".rodata"):
                yield found["name"], size


def measured(
    pieces: Sequence[AdapterPiece], wanted: Sequence[tuple[str, str]], mcu: str, language: str, drawn: Collection[str] = ()
) -> Counter[tuple[str, str]]:
    """Bytes of data memory of each piece that the wanted pieces need, beside these drawn parts: of motors, for two."""
    needed = AdapterPieces(pieces, architecture="avr", drawn=drawn).needed(wanted, mcu)
    start = bench_c.HEAD if language == "C" else "#include <Arduino.h>\n"
    start += bench.MOTORS if MOTORS in {piece.name for piece in needed.pieces} else ""
    text = start + _COGS + adapter_text([adapter_element(piece) for piece in needed.pieces], {}, bench.NO_PIN)
    found: Counter[tuple[str, str]] = Counter()
    words = {id(piece): _words(piece) for piece in needed.pieces}
    with tempfile.TemporaryDirectory() as folder:
        for name, size in symbols(text, mcu, Path(folder), language):
            if name.startswith("vtable for ") and not any(
                re.search(rf"\b(?:struct|class) {name[11:]}\b", p.text) for p in needed.pieces
            ):
                continue  # of a class of the core
            asked = re.findall(r"\w+", _NO_NAME.sub("", name))
            holder = next((p for p in needed.pieces if asked and all(each in words[id(p)] for each in asked)), None)
            if holder is not None:
                found[holder.header, holder.name] += size
    return found


def _words(piece: AdapterPiece) -> set[str]:
    return {text for kind, *_, text in tokens(piece.text.encode()) if kind == "name"}


def measurements(language: str, pieces: Sequence[AdapterPiece], headers: Collection[str] = ()) -> Counter[tuple[str, str]]:
    """Bytes of data memory of each piece of a language, on the microcontroller that most boards have.

    Only programs of these headers are compiled; those of all if there are none, or the hardware layer is among them.
    """
    most: Counter[tuple[str, str]] = Counter()
    for header in sorted({piece.header for piece in pieces} - {HAL}):
        if headers and HAL not in headers and header not in headers:
            continue
        keys = [(piece.header, piece.name) for piece in pieces if piece.header == header]
        for key, size in measured(pieces, keys, MCU, language).items():
            most[key] = max(most[key], size)
    return most


def written(text: str, sizes: Counter[tuple[str, str]]) -> str:
    """The text of an adapter file with the measured `ram` markers, where they were or behind the head; variants for some
    programs keep theirs.
    """
    lines: list[str] = []
    header, head, key = "", list[str](), ("", "")
    for line in [*text.split("\n"), None]:
        if line is not None and line.startswith(f"{MARK}   "):
            head.append(line)
            continue
        lines += _marked(head, sizes[key]) if key[1] else head
        head, key = [], ("", "")
        if line is None:
            break
        lines.append(line)
        words = line[len(MARK) :].split() if line.startswith(MARK) else []
        if words[:1] == ["header"]:
            header = words[1]
        elif len(words) == 2:
            key = (header, words[1])
    return "\n".join(lines)


def _marked(head: Sequence[str], size: int) -> list[str]:
    """The lines of a piece's head with the marker for its measured bytes."""
    if any(line.startswith((f"{MARK}   members:", f"{MARK}   beside:", f"{MARK}   drawn:")) for line in head):
        return list(head)
    marker = f"{MARK}   ram:"
    new = [f"{marker} {size}"] if size else []
    at = next((number for number, line in enumerate(head) if line.startswith(marker)), len(head))
    return [*head[:at], *new, *(line for line in head[at:] if not line.startswith(marker))]


def main(*arguments: str) -> int:
    """Print the files with wrong markers, or with `--write` correct them; 1 if there are any."""
    wrong = 0
    headers = [argument for argument in arguments if argument != "--write"]
    for language, pieces, folder in (("C++", bench.pieces(), bench.ADAPTERS), ("C", bench_c.pieces(), bench_c.ADAPTERS)):
        sizes = measurements(language, pieces, headers)
        mine = [piece for piece in pieces if piece.header != HAL or "avr" in piece.architectures]
        for path in sorted({Path(piece.location.path) for piece in mine if not headers or piece.header in headers}):
            text = path.read_text()
            if (new := written(text, sizes)) == text:
                continue
            wrong += 1
            if "--write" in arguments:
                path.write_text(new)
            else:
                print(f"{path.relative_to(folder)}: the markers `ram` are not what is measured")
    return int(bool(wrong and "--write" not in arguments))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
