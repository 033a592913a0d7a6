"""The text of adapters in a program: the pieces that it needs as one readable file."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from robosmi.metamodels import platform

WIDTH = 125
INTERRUPTS = "ADAPTERS_INTERRUPTS"
"""The macro that is defined in the one file of several in which the adapters' interrupt handlers are compiled."""
_STATE = re.compile(r"static (?!inline\b|const\b|constexpr\b)(?!(?:[\w*]+ )+\*?\w+\([^;]*\)(?: \{|;))")
_VECTOR = re.compile(r"^ISR\((?:.*\}|(?>.*\{)(?:.*\n)*?\})$", re.MULTILINE)


def adapter_text(
    pieces: Sequence[platform.Adapter],
    pins: Mapping[str, str],
    unbound: str,
    numbers: Mapping[int, str] = MappingProxyType({}),
) -> str:
    """The text of adapter pieces in their order: includes, constants of the pins used by convention, each piece with comments.

    Args:
        pieces: sorted so that each piece comes after the pieces it depends on.
        pins: name of a conventional port -> the target's literal for its pin.
        unbound: the literal for no pin.
        numbers: number of a port of the source -> the target's literal for its pin, for tables in which ports are looked up.
    """
    lines = [f"#include {header}" for header in includes(pieces)]
    lines += declarations(pieces, pins, unbound, numbers)
    for piece, above in zip(pieces, (None, *pieces), strict=False):
        lines += [""] * is_separated(piece, above) + [f"// {line}" for line in comment(piece)] + [str(piece.text)]
    return "\n".join(lines) + "\n"


def is_separated(piece: platform.Adapter, above: platform.Adapter | None) -> bool:
    """Whether a blank line separates a piece from the one above it; constants without comments stand together."""
    return above is None or not all(
        each.pieceKind is platform.PieceKind.constant and not comment(each) for each in (piece, above)
    )


def includes(pieces: Iterable[platform.Adapter]) -> list[str]:
    """The headers of the target that pieces need, each once."""
    return list(dict.fromkeys(str(header) for piece in pieces for header in piece.includes))


def declarations(
    pieces: Sequence[platform.Adapter], pins: Mapping[str, str], unbound: str, numbers: Mapping[int, str], storage: str = ""
) -> list[str]:
    """The constants of the pins that pieces use by convention, and the tables of ports; see `adapter_text`.

    `storage` is put before each constant: `static ` in C, where each file has its own.
    """
    ports = {str(port.constant): port for piece in pieces for port in piece.ports}
    lines = [""] * bool(ports)
    for port in ports.values():
        pin = pins.get(str(port.name), unbound)
        lines.append(
            f"{storage}const uint8_t {port.constant} = {pin};  // {port.name}{', which is not wired' if pin == unbound else ''}"
        )
    for table in {str(table.name): table for piece in pieces for table in piece.tables}.values():
        literals = ", ".join(numbers.get(number, unbound) for number in range(table.count))
        wrapped = textwrap.wrap(literals, WIDTH - 4)
        lines += ["", f"// The pin of each port of the source, {unbound} where it is not wired"]
        lines += [f"{storage}const uint8_t {table.name}[{table.count}] = {{", *(f"  {line}" for line in wrapped), "};"]
    return lines


def shared(text: str) -> str:
    """The text of a piece for a file that several units include: its variables become weak, so that they exist once, and its
    interrupt handlers are compiled only where `INTERRUPTS` is defined.
    """
    lines = [f"__attribute__((weak)) {line[7:]}" if _STATE.match(line) else line for line in text.split("\n")]
    return _VECTOR.sub(rf"#ifdef {INTERRUPTS}\n\g<0>\n#endif", "\n".join(lines))


def comment(piece: platform.Adapter) -> list[str]:
    """The comment on a piece, line by line: the functions that it implements, its fidelity and its limits."""
    lines = [str(signature) for signature in piece.signatures]
    silent = not lines and piece.fidelity == "exact"
    said = [f"{piece.fidelity[:1].upper()}{piece.fidelity[1:]}"] if piece.fidelity and not silent else []
    for text in (*said, *(f"Limit: {limit}" for limit in piece.limits)):
        lines += textwrap.wrap(text, WIDTH)
    return lines
