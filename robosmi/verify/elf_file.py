"""Removes the relocations from linked ELF programs (System V ABI 4.1) before they are handed out.

The linker is asked to keep relocations, because the stack depth is computed from them (`build`). But other tools then take the
file for one that is still to be linked: `addr2line` of binutils 2.26 reports wrong lines.
"""

from __future__ import annotations

_MAGIC = b"\x7fELF"
_LAYOUTS = {1: (4, 0x20, 0x2E), 2: (8, 0x28, 0x3A)}
"""For each ELF class: the size of an offset in bytes, and where the offset of the section headers, their size and number are."""
_LEAST = 0x40
"""An upper bound on the size of an ELF header in bytes."""
_RELOCATIONS = (4, 9)
_TYPE = 4
"""The place of the type in a section header, and its size in bytes."""


def without_relocations(data: bytes) -> bytes:
    """A linked program with its relocation sections marked as unused; data that is not ELF is returned unchanged."""
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
