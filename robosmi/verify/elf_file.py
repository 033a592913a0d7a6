"""Linked programs as files (ELF, System V ABI 4.1): what is taken out of one before somebody gets it.

The linker is asked to keep its relocations, by which the stack is told (`build`). Other tools take a file that has them for one
that is still to be linked: `addr2line` of binutils 2.26 then names wrong lines.
"""

from __future__ import annotations

_MAGIC = b"\x7fELF"
_LAYOUTS = {1: (4, 0x20, 0x2E), 2: (8, 0x28, 0x3A)}
"""Class of the file -> the bytes of an offset, where that of the section headers stands, and their size and number."""
_LEAST = 0x40
"""Bytes that the header of any such file has at most."""
_RELOCATIONS = (4, 9)
_TYPE = 4
"""Where the type stands in a section header, and its bytes."""


def without_relocations(data: bytes) -> bytes:
    """A linked program whose sections with relocations are marked as unused; what is no such program stays as it is."""
    layout = _LAYOUTS.get(data[4]) if data.startswith(_MAGIC) and len(data) > _LEAST else None
    if layout is None:
        return data
    little = data[5] == 1
    width, at, counts = layout
    start = _number(data, at, width, little)
    size, number = _number(data, counts, 2, little), _number(data, counts + 2, 2, little)
    if size < 2 * _TYPE:
        return data
    made = bytearray(data)
    for header in range(start, min(start + size * number, len(data) - size + 1), size):
        if _number(data, header + _TYPE, _TYPE, little) in _RELOCATIONS:
            for place in range(header + _TYPE, header + 2 * _TYPE):
                made[place] = 0
    return bytes(made)


def _number(data: bytes, at: int, width: int, little: bool) -> int:
    value = 0
    for place in range(at, at + width):
        value = value + (data[place] << 8 * (place - at)) if little else value * 256 + data[place]
    return value
