"""The adapter files as texts: each adapter compiles without a warning with just what it declares, and declares what it uses.

avr-g++ compiles; what a piece uses is asked of libclang, which parses all adapters of a header with what they need as one text.
"""

from __future__ import annotations

import glob
import subprocess
from collections.abc import Iterator
from functools import cache
from itertools import product
from pathlib import Path

import clang.cindex
import pytest

from robosmi.transformations.knowledge.adapters.adapter_files import HAL, read_adapter_file
from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.m2t.adapter_text import adapter_text
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from tests.adapters.bench import ADAPTERS, MOTORS, NO_PIN, pieces
from tests.tiers import one_of_each
from tests.tools import require_tools

CORE = Path("/usr/share/arduino/hardware/arduino/avr")
STAND_INS = Path(__file__).parents[2] / "platform_repo" / "arduino" / "stand_ins"
VARIANTS = {"atmega328p": "standard", "atmega2560": "mega", "atmega32u4": "leonardo"}
HEADERS = sorted({piece.header for piece in pieces()})
FILES = {str(path.relative_to(ADAPTERS)): read_adapter_file(path) for path in sorted(ADAPTERS.rglob("*.cpp"))}
"""Adapter file -> its pieces; a file that only says why a header has no adapters has none."""
KEYS = [(piece.header, piece.name) for piece in pieces() if piece.kind != "helper"]
DEFINES = ["-DF_CPU=16000000L", "-DARDUINO=10819", "-DARDUINO_ARCH_AVR", "-DUSB_VID=0x2341", "-DUSB_PID=0x8036", "-std=gnu++11"]
OF_OTHER_CORES = """
namespace std {
template <class T> class initializer_list {
  const T *first;
  size_t count;

public:
  const T *begin() const { return first; }
  const T *end() const { return first + count; }
};
}
void analogReadResolution(int bits);
FILE *funopen(
    const void *about, int (*read)(void *, char *, int), int (*write)(void *, const char *, int), long (*seek)(void *, long, int),
    int (*close)(void *)
);
"""
"""What pieces for all architectures use of other cores and their compilers' library, and the core of AVR lacks."""
KIND = clang.cindex.CursorKind
USING = (
    KIND.DECL_REF_EXPR, KIND.OVERLOADED_DECL_REF, KIND.MACRO_INSTANTIATION, KIND.TYPE_REF, KIND.TEMPLATE_REF,
    KIND.MEMBER_REF_EXPR,
)  # fmt: skip


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("avr-g++", "arduino-core-avr")


def folders(mcu: str) -> list[str]:
    """Where headers of the target are found."""
    found = [CORE / "cores" / "arduino", CORE / "variants" / VARIANTS[mcu], *(CORE / "libraries").glob("*/src")]
    return [f"-I{path}" for path in (*found, *STAND_INS.glob("*"), *STAND_INS.glob("*/src"))]


def warnings(text: str, mcu: str, folder: Path) -> str:
    """The warnings of avr-g++ about a text itself, with all warnings enabled."""
    (folder / "adapters.cpp").write_text(text)
    command = ["avr-g++", f"-mmcu={mcu}", *DEFINES, "-Os", "-Wall", "-Wextra", *folders(mcu), "-c", "adapters.cpp"]
    done = subprocess.run([*command, "-o", "adapters.o"], capture_output=True, text=True, check=False, cwd=folder)
    return "\n".join(line for line in done.stderr.splitlines() if line.startswith("adapters.cpp:") or "error" in line)


def program(needed: list[AdapterPiece], wanted: set[tuple[str, str]]) -> str:
    """The pieces as a program that uses the wanted ones."""
    functions = [piece for piece in needed if piece.kind in ("adapter", "variable") and (piece.header, piece.name) in wanted]
    names = [piece.target_name or piece.name for piece in functions if "template" not in piece.text]
    taken = "".join(f"  (void)&{name};\n" for name in names)
    text = adapter_text([adapter_element(piece) for piece in needed], {}, NO_PIN)
    return f"#include <Arduino.h>\n{text}\nvoid use() {{\n{taken}}}\n"


@pytest.mark.parametrize(
    ("header", "mcu"), one_of_each(product(HEADERS, VARIANTS), lambda place: place[1] if place[0] == HAL else place[0])
)
def test_all_of_a_header_compile_together(header: str, mcu: str, tmp_path: Path) -> None:
    """Each header for one microcontroller, the hardware layer for each; the tier `all` has the others."""
    wanted = {key for key in KEYS if key[0] == header}
    known = AdapterPieces(pieces(), architecture="avr")
    needed = known.needed(sorted(wanted), mcu)
    assert warnings(program(needed.pieces, wanted - needed.unserved.keys()), mcu, tmp_path) == ""


def alone(key: tuple[str, str], mcu: str, folder: Path) -> str:
    """The compiler's messages about one adapter with just what it needs; empty if the microcontroller cannot serve it."""
    needed = AdapterPieces(pieces(), architecture="avr").needed([key], mcu)
    return warnings(program(needed.pieces, {key}), mcu, folder) if not needed.unserved else ""


@pytest.mark.parametrize("header", sorted({header for header, _ in KEYS[::8]}))
def test_some_compile_alone(header: str, tmp_path: Path) -> None:
    """A sample; `make adapters` compiles each."""
    faults = {key: alone(key, "atmega328p", tmp_path) for key in KEYS[::8] if key[0] == header}
    assert {key: text for key, text in faults.items() if text} == {}


@cache
def uses(
    header: str,
    members: tuple[str, ...] = (),
    calls: tuple[str, ...] = (),
    drawn: tuple[str, ...] = (),
    only: str = "",
    architecture: str = "avr",
) -> tuple[dict[tuple[str, str], set[tuple[str, str]]], dict[tuple[str, str], set[tuple[str, str]]]]:
    """Piece of a header -> the other pieces that it names, and piece -> those its classes inherit from, according to libclang.

    The program has these members, calls and drawn parts; the pieces are those for an architecture, compiled with the core of AVR.
    """
    wanted = [(piece.header, piece.name) for piece in pieces() if piece.header == header and only in ("", piece.name)]
    needed = AdapterPieces(pieces(), members, calls, architecture, drawn).needed(wanted, "atmega328p").pieces
    before = MOTORS if architecture else OF_OTHER_CORES + MOTORS
    text = f"#include <Arduino.h>\n{before}{adapter_text([adapter_element(piece) for piece in needed], {}, NO_PIN)}"
    arguments = ["-target", "avr", "-mmcu=atmega328p", *DEFINES, "-nostdinc", "-isystem/usr/lib/avr/include"]
    arguments += [*folders("atmega328p"), *(f"-isystem{path}" for path in glob.glob("/usr/lib/gcc/avr/*/include"))]
    unit = clang.cindex.Index.create().parse("adapters.cpp", arguments, [("adapters.cpp", text)], options=1)
    wrong = [str(each) for each in unit.diagnostics if each.severity >= 3 and "adapters.cpp" in str(each.location)]
    assert wrong == []
    lines = text.split("\n")
    places: list[tuple[int, int, tuple[str, str]]] = []
    at = 0
    for piece in needed:
        own = piece.text.split("\n")
        at = next(line for line in range(at, len(lines)) if lines[line : line + len(own)] == own)
        places.append((at + 1, at + len(own), (piece.header, piece.name)))
        at += len(own)

    def piece_at(place: clang.cindex.SourceLocation) -> tuple[str, str] | None:
        if place.file is None or place.file.name != "adapters.cpp":
            return None
        return next((key for first, last, key in places if first <= place.line <= last), None)

    def meant(cursor: clang.cindex.Cursor) -> Iterator[clang.cindex.Cursor]:
        if cursor.kind == KIND.OVERLOADED_DECL_REF:
            library = clang.cindex.conf.lib
            for number in range(library.clang_getNumOverloadedDecls(cursor)):
                yield library.clang_getOverloadedDecl(cursor, number)
        elif cursor.referenced is not None:
            yield cursor.referenced

    found: dict[tuple[str, str], set[tuple[str, str]]] = {key: set() for _, _, key in places}
    bases: dict[tuple[str, str], set[tuple[str, str]]] = {key: set() for _, _, key in places}
    for cursor in unit.cursor.walk_preorder():
        here = piece_at(cursor.location) if cursor.kind in (*USING, KIND.CXX_BASE_SPECIFIER) else None
        for other in meant(cursor) if here is not None else ():
            if other.kind == KIND.FUNCTION_DECL and other.get_definition() is None:
                continue  # one of the compiler's own, which "stands" where it is first used
            there = piece_at(other.location)
            if here is not None and there is not None and there != here:
                (bases if cursor.kind == KIND.CXX_BASE_SPECIFIER else found)[here].add(there)
    return found, bases


def faults(piece: AdapterPiece) -> list[str]:
    """Where what a piece declares differs from what its text uses; nothing for another microcontroller's piece."""
    if (piece.mcus and "atmega328p" not in piece.mcus) or (piece.architectures and "avr" not in piece.architectures):
        return []
    alone = piece.name if piece.header == HAL else ""  # pieces of the hardware layer may exclude each other
    architecture = "" if alone and not piece.architectures else "avr"  # one for all processors stands on others for all
    known = AdapterPieces(pieces(), architecture=architecture)
    declared = {key for name in piece.needs if (key := known.key(name, piece.header))}
    named, bases = uses(piece.header, tuple(piece.members), tuple(piece.beside), tuple(piece.drawn), alone, architecture)
    used = named[piece.header, piece.name]
    inherited = {base for key in used & declared for base in bases[key]}  # not every variant of a class may have them
    found = [f"uses {'/'.join(key)}, which it does not declare" for key in sorted(used - declared - inherited)]
    found += [f"declares {'/'.join(key)}, which it does not use" for key in sorted(declared - used)]
    declared_names = [
        *(port.constant for port in piece.ports),
        *(pin.name for pin in piece.pins),
        *piece.vectors,
        *(table.name for table in piece.tables),
    ]
    found += [f"declares {name}, which is not in its text" for name in declared_names if name not in piece.text]
    if (handlers := piece.text.count("ISR(")) != len(piece.vectors):
        found.append(f"has {handlers} interrupt handlers, and declares {len(piece.vectors)}")
    return [f"{piece.header}/{piece.name} {fault}" for fault in found]


@pytest.mark.parametrize("file", [file for file, checked in FILES.items() if checked])
def test_each_piece_declares_what_its_text_uses(file: str) -> None:
    assert [fault for piece in FILES[file] for fault in faults(piece)] == []


def test_every_piece_is_in_a_file_that_is_checked() -> None:
    assert sum(map(len, FILES.values())) == len(pieces()) > 1_500


def test_the_pins_of_adapters_are_pins_of_the_functions_of_the_source() -> None:
    """A number given to one that is not would reach the adapter as it stood in the source."""
    facts = ApiIndex.load("propeller")._facts
    known = {name for (name, _), pins in facts.pins.items() if pins.parameters}
    assert {piece.name for piece in pieces() if piece.kind == "adapter" and piece.pins} - known == set()
