"""Linked programs as files (ELF, System V ABI 4.1): what is taken out of one before somebody gets it.

The linker is asked to keep its relocations, by which the stack is told (`build`). Other tools take a file that has them for one
that is still to be linked: `addr2line` of binutils 2.26 then names wrong lines.
"""

from __future__ import annotations

import struct

_MAGIC = b"\x7fELF"
_LAYOUTS = {1: ("I", 0x20, 0x2E), 2: ("Q", 0x28, 0x3A)}
"""Class of the file -> how an offset is written, where that of the section headers stands, and their size and number."""
_RELOCATIONS = (4, 9)
_TYPE = 4
"""Where the type stands in a section header."""


def without_relocations(data: bytes) -> bytes:
    """A linked program whose sections with relocations are marked as unused; what is no such program stays as it is."""
    layout = _LAYOUTS.get(data[4]) if data[:4] == _MAGIC and len(data) > 0x40 else None
    if layout is None:
        return data
    order = "<" if data[5] == 1 else ">"
    offset, at, counts = layout
    (start,) = struct.unpack_from(order + offset, data, at)
    size, number = struct.unpack_from(order + "HH", data, counts)
    made = bytearray(data)
    if size < _TYPE + 4:
        return data
    for header in range(start, min(start + size * number, len(data) - size + 1), size):
        if struct.unpack_from(order + "I", data, header + _TYPE)[0] in _RELOCATIONS:
            struct.pack_into(order + "I", made, header + _TYPE, 0)
    return bytes(made)
