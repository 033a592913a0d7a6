"""A generated program, parsed once by libclang with the declarations of its adapters.

The target's own headers may be missing: a text with the types of the language replaces them. Bodies of adapters are not the
program's own code, so they are left out.
"""

from __future__ import annotations

import re
import weakref
from collections.abc import Collection, Iterator, Mapping, Sequence

from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.source_text import ADAPTERS_FILE, HEADERS
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.bounds import cuts, shallow
from robosmi.transformations.t2m.c_source.parsing.error_recovery import Scratch
from robosmi.transformations.t2m.c_source.parsing.joined_tabs import prototypes

_TYPES = b"""
typedef __INT8_TYPE__ int8_t; typedef __INT16_TYPE__ int16_t; typedef __INT32_TYPE__ int32_t; typedef __INT64_TYPE__ int64_t;
typedef __UINT8_TYPE__ uint8_t; typedef __UINT16_TYPE__ uint16_t; typedef __UINT32_TYPE__ uint32_t;
typedef __UINT64_TYPE__ uint64_t; typedef __INTPTR_TYPE__ intptr_t; typedef __UINTPTR_TYPE__ uintptr_t;
typedef __SIZE_TYPE__ size_t; typedef __PTRDIFF_TYPE__ ptrdiff_t; typedef %s boolean; typedef uint8_t byte;
typedef unsigned int word; typedef __builtin_va_list va_list; typedef struct __file FILE;
"""
_OF_CPP = b"#define NULL __null\n#define _Bool bool\n"
_OF_C = b"#define NULL ((void *)0)\n#define bool _Bool\n#define true 1\n#define false 0\n"
_STUB = "/none/types"
"""A folder that exists on no machine: the program and the replaced headers are passed to libclang as texts."""
SKETCH = "/none/sketch"
"""The folder of the program's own files, which exists on no machine either."""
_MACHINES: Mapping[int, str] = {16: "avr", 32: "arm-none-eabi"}
"""Bits of an int -> a processor that libclang knows, whose types have the widths of the targets with such an int."""
_FLAGS = (
    "-nostdinc", "-nostdinc++", "-Wno-everything", "-ferror-limit=0", "-fno-spell-checking",
    f"-I{SKETCH}", f"-I{_STUB}",
)  # fmt: skip
_NEWER = ("-Werror=c++17-extensions", "-Wno-error=c++17-attribute-extensions", "-Werror=c++14-extensions")
"""What the compilers of the targets refuse in the standard that is given to them, and libclang only warns of."""
_LANGUAGE = {"C": ("-xc", "-std=gnu11"), "C++": ("-xc++", "-std=gnu++11", "-nostdinc++", "-fpermissive", *_NEWER)}
_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"]', re.MULTILINE)
_BODIES = re.compile(
    rb"^((?:static )?inline (?>[^\n]*?\)(?= \{))) \{(?:[^\n]*\n(?:[ \t#][^\n]*\n|\n)*\}|[^\n]*\})$", re.MULTILINE
)
"""Matches inline functions of the adapters."""
_CONSTANT = re.compile(r"use of undeclared identifier '([A-Z][A-Z0-9_]+)'")
_ON_AFTER_MISSING = 0x200
"""Option of a parse: go on after a header that is not there."""


class GeneratedProgram:
    """The files of a generated program and what libclang makes of them; the parser's memory is freed with the object.

    Args:
        files: the name of each file in the program's folder -> its bytes.
        main_header: the target's header that each file includes.
        language: `C` or `C++`.
        adapters: name of the file that contains the adapters.
        pins: names that the target's headers give to pins.
        vast: whether its types are too large for libclang, which takes memory for each member; then nothing is parsed.
        int_bits: width of an int of the target.
        char_signed: whether plain char has a sign there.
        api: the headers of the target's API by their names, instead of `main_header` with types alone.
        tabs: the files that the target's tools join to one text, in their order; each is parsed with the first one.
        defines: macros of the target's board.

    Attributes:
        files: the files, as given.
        adapters: the file that contains the adapters.
        texts: absolute name -> the text that was parsed.
        units: each parsed file that is no header, with its handle in libclang.
        unread: the files that libclang gave up.
        old_standard: whether the target's compiler is surely given C++11, as those of AVR are.
        complete: whether the API's headers and the prototypes of the target's tools are there, so that what is not declared
            is a library's.
    """

    def __init__(
        self,
        files: Mapping[str, bytes],
        main_header: str,
        language: str = "C++",
        adapters: str = ADAPTERS_FILE,
        pins: Collection[str] = (),
        vast: bool = False,
        *,
        int_bits: int = 16,
        char_signed: bool = True,
        api: Mapping[str, bytes] | None = None,
        tabs: Sequence[str] = (),
        defines: Sequence[str] = (),
    ) -> None:
        self.files, self.adapters, self._vast = files, adapters, vast
        self.texts = {f"{SKETCH}/{name}": data for name, data in files.items()}
        self.texts[f"{SKETCH}/{adapters}"] = _BODIES.sub(rb"\1;", files.get(adapters, b""))
        self.old_standard = int_bits == 16
        self._continued, self.complete = frozenset(tabs[1:]), api is not None
        if tabs:
            self.texts |= {f"{SKETCH}/{name}": data for name, data in _joined(files, tabs).items()}
        for data in files.values():
            for found in _INCLUDE.finditer(data):
                name = found[1].decode("utf-8", "replace")
                if name not in files:
                    self.texts[f"{_STUB}/{name}"] = b""
        own = _OF_CPP if language == "C++" else _OF_C
        named = "".join(f"extern const uint8_t {pin};\n" for pin in sorted(pins)).encode()
        if api is not None:
            self.texts |= {f"{_STUB}/{name}": data for name, data in api.items()}
        else:
            self.texts[f"{_STUB}/{main_header}"] = _TYPES % (b"bool" if language == "C++" else b"_Bool") + own + named
        before = ("-include", f"{_STUB}/{main_header}") if tabs else ()
        machine = ("-target", _MACHINES.get(int_bits, _MACHINES[32]), "-fsigned-char" if char_signed else "-funsigned-char")
        self._flags, self._header = (
            (*machine, *_FLAGS, *_LANGUAGE[language], *(f"-D{each}" for each in defines), *before),
            f"{_STUB}/{main_header}",
        )
        self.unread: list[str] = []
        self.units = self._parsed(self._flags)
        self._handles = [unit for _, unit in self.units]
        weakref.finalize(self, _dispose, self._handles)

    def declare_constants(self) -> bool:
        """Parse again with the constants that the program uses and that only the target's headers have.

        libclang leaves out calls with a name that is not declared. The answer is whether there are such constants.
        """
        constants = {name for _, unit in self.units for name in _undeclared(unit)}
        if constants:
            self.texts[self._header] += "".join(f"extern const int {name};\n" for name in sorted(constants)).encode()
            _dispose(self._handles)
            self.units = self._parsed(self._flags)
            self._handles[:] = [unit for _, unit in self.units]
        return bool(constants)

    def _parsed(self, flags: Sequence[str]) -> list[tuple[str, int]]:
        virtual = clang.unsaved(self.texts)
        names = [name for name in self.files if not name.lower().endswith(HEADERS) and name not in self._continued]
        if self._vast or any(_nests_too_deep(path, text) for path, text in self.texts.items()):
            self.unread = names  # libclang would overrun its stack or memory
            return []
        read = [(name, clang.parse(f"{SKETCH}/{name}", flags, virtual, _ON_AFTER_MISSING)) for name in names]
        self.unread = [name for name, unit in read if unit is None]
        return [(name, unit) for name, unit in read if unit is not None]


def _joined(files: Mapping[str, bytes], tabs: Sequence[str]) -> dict[str, bytes]:
    """The files of a sketch's text so that the first one is the whole: with prototypes, and the others included at its end.

    Lines stay where they are.
    """
    read = [tokens(files[name]) for name in tabs]
    made = {name: Scratch(files[name], prototypes(read[at], read[at + 1 :])).data for at, name in enumerate(tabs)}
    made[tabs[0]] += "".join(f'\n#include "{name}"' for name in tabs[1:]).encode()
    return made


def _nests_too_deep(path: str, text: bytes) -> bool:
    return not (shallow(text) and b"define" not in text) and bool(cuts(path, text, tokens(text)))


def _undeclared(unit: int) -> Iterator[str]:
    """The names of constants that a unit uses and does not declare."""
    library = clang.library()
    for number in range(library.getNumDiagnostics(unit)):
        handle = library.getDiagnostic(unit, number)
        found = _CONSTANT.match(library.text(library.getDiagnosticSpelling(handle)))
        library.disposeDiagnostic(handle)
        if found is not None:
            yield found[1]


def _dispose(units: Sequence[int]) -> None:
    for unit in units:
        clang.library().disposeTranslationUnit(unit)
