"""The text of adapters in a program: the pieces that it needs as one readable file."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from robosmi.metamodels import platform
from robosmi.typed import distinct, paired

WIDTH = 125
INTERRUPTS = "ADAPTERS_INTERRUPTS"
"""The macro that the file of a program has whose adapters handle the interrupts, where there are several files."""
_STATE = re.compile(r"static (?!inline\b|const\b|constexpr\b)(?!(?:[\w*]+ )+\*?\w+\([^;]*\)(?: \{|;))")
_VECTOR = re.compile(r"^ISR\((?:.*\}|.*\{(?:.*\n)*?\})$", re.MULTILINE)


def adapter_text(
    pieces: Sequence[platform.Adapter],
    pins: Mapping[str, str],
    unbound: str,
    numbers: Mapping[int, str] = MappingProxyType({}),
) -> str:
    """The pieces as text, in their order: includes, the pins that they use by convention, and each with what is known of it.

    Args:
        pieces: in an order in which each stands behind what it needs.
        pins: name of a conventional port -> the target's literal for its pin.
        unbound: the literal for no pin.
        numbers: number of a port of the source -> the target's literal for its pin, for tables that ports are looked up in.
    """
    lines = [f"#include {header}" for header in includes(pieces)]
    lines += declarations(pieces, pins, unbound, numbers)
    for piece, above in paired(pieces, (None, *pieces), strict=False):
        lines += [""] * apart(piece, above) + [f"// {line}" for line in comment(piece)] + [str(piece.text)]
    return "\n".join(lines) + "\n"


def apart(piece: platform.Adapter, above: platform.Adapter | None) -> bool:
    """Whether a blank line stands between a piece and the one above it: constants about which nothing is said stand together."""
    return above is None or not all(
        each.pieceKind is platform.PieceKind.constant and not comment(each) for each in (piece, above)
    )


def includes(pieces: Iterable[platform.Adapter]) -> list[str]:
    """The headers of the target that pieces need, each once."""
    return distinct(str(header) for piece in pieces for header in piece.includes)


def declarations(
    pieces: Sequence[platform.Adapter], pins: Mapping[str, str], unbound: str, numbers: Mapping[int, str], storage: str = ""
) -> list[str]:
    """What stands in front of pieces: the pins that they use by convention, and tables of ports; see `adapter_text`.

    `storage` is the word with a blank that C wants before a constant of which each file has its own.
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
    """The text of a piece in a file that several units include: its state is there once, and one unit handles the interrupts."""
    lines = [f"__attribute__((weak)) {line[7:]}" if _STATE.match(line) else line for line in text.split("\n")]
    return _VECTOR.sub(rf"#ifdef {INTERRUPTS}\n\g<0>\n#endif", "\n".join(lines))


def comment(piece: platform.Adapter) -> list[str]:
    """What is known of a piece, line by line: for what it is, how faithful, what it does not do."""
    lines = [str(signature) for signature in piece.signatures]
    silent = not lines and piece.fidelity == "exact"
    said = [f"{piece.fidelity[:1].upper()}{piece.fidelity[1:]}"] if piece.fidelity and not silent else []
    for text in (*said, *(f"Limit: {limit}" for limit in piece.limits)):
        lines += textwrap.wrap(text, WIDTH)
    return lines
