"""Reads the parts of an ELF file of 32 bits (System V ABI 4.1) by which a linked program is judged: sections, symbols, segments.

The file may be made from a stranger's program: what it says of itself is checked against its length.
"""

from __future__ import annotations

import struct

from msgspec import Struct

from robosmi.errors import VerificationError

_HEADER = struct.Struct("<16sHHIIIIIHHHHHH")
_SECTION = struct.Struct("<10I")
_SEGMENT = struct.Struct("<8I")
_SYMBOL = struct.Struct("<IIIBBH")
_MAGIC = b"\x7fELF\x01\x01\x01"
_SYMBOLS = 2
_NO_BITS = 8
_RESERVED = 0xFF00

LOCAL = 0
"""The binding of a symbol that no other object sees."""
WRITABLE, ALLOCATED, CODE = 1, 2, 4
"""Flags of a section."""
GROUP = 17
"""The type of a section that names others, of which a linker takes one group of each name."""
LOADED, DYNAMIC, INTERPRETER, STACK = 1, 2, 3, 0x6474E551
"""Types of segments."""
EXECUTE, WRITE = 1, 2
"""Flags of a segment."""
COMMON, ABSOLUTE = 0xFFF2, 0xFFF1
"""Numbers in the place of a symbol's section."""


class Section(Struct, frozen=True):
    """A section: name, type, flags, size in bytes."""

    name: str
    kind: int
    flags: int
    size: int


class Symbol(Struct, frozen=True):
    """A symbol.

    Attributes:
        name: the name.
        value: the address, in an object the offset in its section.
        size: bytes.
        binding: `LOCAL`, or one of those that other objects see.
        kind: 0 for none, 1 for data, 2 for a function, 3 for a section, 4 for a file, 5 for common data, 6 for data of a thread.
        section: number of the section; 0 if it is not defined here.
    """

    name: str
    value: int
    size: int
    binding: int
    kind: int
    section: int


class Segment(Struct, frozen=True):
    """A segment: type, flags, address and size in memory."""

    kind: int
    flags: int
    address: int
    size: int


class ElfFile(Struct, frozen=True):
    """An ELF file for the processor i386.

    Attributes:
        kind: 1 for an object, 2 for a program.
        entry: address at which a program starts.
        sections, symbols, segments: in the file's order.
    """

    kind: int
    entry: int
    sections: tuple[Section, ...]
    symbols: tuple[Symbol, ...]
    segments: tuple[Segment, ...]


def read_elf(data: bytes) -> ElfFile:
    """Read a file.

    Raises:
        VerificationError: it is no such file, or damaged.
    """
    try:
        return _read(data)
    except (struct.error, IndexError, ValueError):
        raise VerificationError("the compiled program cannot be read", fix="remove assembler text from the program") from None


def _read(data: bytes) -> ElfFile:
    identity, kind, machine, _, entry, segments_at, sections_at, _, _, segment_size, segment_count, section_size, count, names = (
        _HEADER.unpack_from(data)
    )
    if not identity.startswith(_MAGIC) or machine != 3:
        raise ValueError
    if (section_size, segment_size) not in ((_SECTION.size, 0), (_SECTION.size, _SEGMENT.size)):
        raise ValueError
    rows = [_SECTION.unpack_from(data, sections_at + number * section_size) for number in range(count)]

    def content(number: int) -> bytes:
        _, kind, _, _, offset, size, *_ = rows[number]
        if kind == _NO_BITS or offset + size > len(data):
            raise ValueError
        return data[offset : offset + size]

    texts = content(names)
    sections = tuple(Section(_text(texts, name), kind, flags, size) for name, kind, flags, _, _, size, *_ in rows)
    symbols: list[Symbol] = []
    for number, (_, row_kind, _, _, _, _, link, *_) in enumerate(rows):
        if row_kind == _SYMBOLS:
            strings = content(link)
            for name, value, size, info, _, section in _SYMBOL.iter_unpack(content(number)):
                if count <= section < _RESERVED:
                    raise ValueError
                symbols.append(Symbol(_text(strings, name), value, size, info >> 4, info & 15, section))
    segments = tuple(
        Segment(each[0], each[6], each[2], each[5])
        for each in (_SEGMENT.unpack_from(data, segments_at + number * _SEGMENT.size) for number in range(segment_count))
    )
    return ElfFile(kind, entry, sections, tuple(symbols), segments)


def _text(table: bytes, at: int) -> str:
    return table[at : table.index(b"\0", at)].decode("utf-8", "surrogateescape")
