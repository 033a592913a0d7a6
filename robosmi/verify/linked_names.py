"""Which names and sections of a compiled program stay as they are when it is linked with the host model and the C library.

Everything that the program defines gets a prefix, whatever kind of symbol it is, so that nothing of it can replace a function
of the C library or of the model. Of what it only uses, the listed names stay; the rest gets the prefix, too. Each section that
is not listed gets a name that means nothing to linkers and start-up code.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from msgspec import Struct

from robosmi.errors import VerificationError
from robosmi.verify.elf_reader import (
    ALLOCATED,
    CODE,
    DYNAMIC,
    EXECUTE,
    GROUP,
    INTERPRETER,
    LOADED,
    LOCAL,
    STACK,
    WRITABLE,
    WRITE,
    ElfFile,
    Symbol,
)

PROGRAM_CODE, PROGRAM_DATA, PROGRAM_SETUP = "program_text", "program_data", "program_setup"
"""The sections with the program's functions, its data that begins as zero, and pointers to what runs before main."""
_OTHER = "program_other"
_OWN = (PROGRAM_CODE, PROGRAM_DATA, PROGRAM_SETUP, _OTHER)
JOINING = f"""SECTIONS {{
  {PROGRAM_SETUP} : {{
    KEEP(*(.preinit_array))
    KEEP(*(SORT_BY_INIT_PRIORITY(.init_array.*) SORT_BY_INIT_PRIORITY(.ctors.*)))
    KEEP(*(.init_array .ctors))
  }}
  {PROGRAM_CODE} : {{ *(.text .text.*) }}
  {PROGRAM_DATA} : {{ *(.bss .bss.*) }}
}}
"""
"""The linker script that joins the program's objects; sections that it does not name keep their names."""

_SECTIONS = re.compile(
    rf"{PROGRAM_CODE}|{PROGRAM_DATA}|{PROGRAM_SETUP}|\.data|\.rodata(?:\.[\w.]+)?|\.tdata|\.tbss|\.eh_frame|\.note\.gnu\.property"
    rf"|{_OTHER}(?:_constant)?"
)
_WITHOUT_CONTENT = re.compile(
    r"(?:\.debug_\w+|\.comment|\.note\.GNU-stack|\.symtab|\.strtab|\.shstrtab|\.symtab_shndx|\.rel\S+)?"
)
"""Sections that take no part in a run."""
_TABLES = (0, 2, 3, 9, 18)
"""Types of sections that belong to the object's form: none, symbols, texts, relocations, numbers of sections."""
_KINDS = (1, 7, 8, 14, 15, 16)
"""Types of sections with the program's own content: bits, notes, no bits, pointers to functions before main and after it."""
_SYMBOL_KINDS = range(7)

_NAME = re.compile(r"[\w.$]+")
_ARITHMETIC = re.compile(
    r"__(?:u?(?:div|mod|divmod|cmp)[sdt]i\d|(?:ash[lr]|lshr|mul|neg|ffs|clz|ctz|popcount|parity)[sd]i\d"
    r"|fix(?:uns)?[sdx]f[sd]i|float(?:un)?[sd]i[sdx]f)"
)
"""What gcc calls for arithmetic that the machine has no instruction for."""
_COMPARED = ("cmp1", "cmp2", "cmp4", "cmp8", "const_cmp1", "const_cmp2", "const_cmp4", "const_cmp8", "cmpf", "cmpd", "switch")
HOOKS = frozenset({
    "__gcov_init", "__gcov_exit", "__gcov_merge_add", "__sanitizer_cov_trace_pc",
    *(f"__sanitizer_cov_trace_{each}" for each in _COMPARED),
    "_GLOBAL_OFFSET_TABLE_",
})  # fmt: skip
"""What the compiler itself calls in an instrumented program."""
_MODEL = re.compile(r"host_\w+")
"""What headers of the model may call of the simulated chip."""


class Names(Struct, frozen=True):
    """The names of an object that others see.

    Attributes:
        defined: names that it defines.
        used: names that it uses and does not define.
    """

    defined: frozenset[str]
    used: frozenset[str]


class AllowedNames(Struct, frozen=True):
    """The names that an object may use as they are.

    Attributes:
        same: functions of the machine's C library.
        chip: names that the simulated chip defines.
    """

    same: frozenset[str]
    chip: frozenset[str]

    def __contains__(self, name: str) -> bool:
        model = _MODEL.fullmatch(name) is not None and name in self.chip
        return name in HOOKS or name in self.same or model or _ARITHMETIC.fullmatch(name) is not None


def names_of(elf: ElfFile) -> Names:
    """The names of an object that others see.

    Raises:
        VerificationError: it has a symbol that no compiler of C makes, as an indirect function.
    """
    seen = [symbol for symbol in elf.symbols if symbol.name and symbol.binding != LOCAL]
    for symbol in seen:
        _check(symbol)
    defined = frozenset(symbol.name for symbol in seen if symbol.section)
    return Names(defined, frozenset(symbol.name for symbol in seen) - defined)


def _check(symbol: Symbol) -> None:
    name = symbol.name
    if not _NAME.fullmatch(name):
        raise VerificationError(f"the program has a name that is not a C identifier: {name!a}", fix="rename it")
    if symbol.kind not in _SYMBOL_KINDS:
        raise VerificationError(
            f"the program has a kind of symbol that its platform does not have: {name}",
            fix="define it as a usual function or as data",
        )


def check_object(elf: ElfFile) -> None:
    """Check that an object has no section with a name of the model's.

    Raises:
        VerificationError: it has.
    """
    if taken := sorted(section.name for section in elf.sections if section.name.startswith(_OWN)):
        raise VerificationError(f"the program uses a section of the host model: {', '.join(taken)}", fix="rename it")


def renamed_sections(elf: ElfFile) -> tuple[dict[str, str], list[str]]:
    """The sections of a joined program that get another name (old -> new), and those that are removed.

    Raises:
        VerificationError: it has a section that no compiler makes.
    """
    renamed, removed = {}, []
    for section in elf.sections:
        if section.kind in _TABLES and _WITHOUT_CONTENT.fullmatch(section.name) and not section.flags & ALLOCATED:
            continue
        if section.kind not in _KINDS or not _NAME.fullmatch(section.name.replace("-", "_")):
            raise VerificationError(
                f"the program has a section that cannot be linked on this machine: {section.name!a}", fix="remove its attribute"
            )
        if not section.flags & ALLOCATED:
            if not _WITHOUT_CONTENT.fullmatch(section.name):
                removed.append(section.name)
        elif not _SECTIONS.fullmatch(section.name):
            code = section.flags & CODE
            renamed[section.name] = PROGRAM_CODE if code else _OTHER if section.flags & WRITABLE else f"{_OTHER}_constant"
    return renamed, removed


def check_named(elf: ElfFile, prefix: str, allowed: AllowedNames) -> None:
    """Check that the renaming of a joined program has left no other name or section than it may.

    Raises:
        VerificationError: it has.
    """
    names = names_of(elf)
    wrong = [name for name in names.defined if not name.startswith(prefix)]
    wrong += [name for name in names.used if not name.startswith(prefix) and name not in allowed]
    renamed, removed = renamed_sections(elf)
    wrong += [*renamed, *removed, *(section.name for section in elf.sections if section.kind == GROUP)]
    if wrong:
        raise VerificationError(
            f"the program has names that clash with this machine's: {', '.join(sorted(wrong))}",
            fix="remove assembler text and attributes of these names",
        )


def check_linked(elf: ElfFile) -> None:
    """Check that a linked program loads nothing else, starts with the C library's code, and has no code that it can write.

    Raises:
        VerificationError: it does not.
    """
    start = {symbol.value for symbol in elf.symbols if symbol.name == "_start" and symbol.binding != LOCAL}
    if (reason := next(_wrong_segments(elf), None)) is None and start == {elf.entry}:
        return
    raise VerificationError(
        f"the program {reason or 'does not start with the code of the C library'}", fix="remove its section attributes"
    )


def _wrong_segments(elf: ElfFile) -> Iterator[str]:
    for segment in elf.segments:
        if segment.kind in (DYNAMIC, INTERPRETER):
            yield "would load other files"
        if segment.kind == LOADED and segment.flags & WRITE and segment.flags & EXECUTE:
            yield "has writable code"
        if segment.kind == STACK and segment.flags & EXECUTE:
            yield "has an executable stack"


def library_names(printed: str) -> Iterable[str]:
    """The names that an archive of the model defines, from the output of `nm`."""
    for line in printed.splitlines():
        words = line.split()
        if len(words) >= 2 and (words[-2].isupper() or words[-2] in "vui") and words[-2] not in "Uw":
            yield words[-1]
