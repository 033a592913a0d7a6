"""The text of adapters in a sketch: the pieces that a program needs as one readable file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robosmi.transformations.knowledge.adapter_files import AdapterPiece


def adapter_text(
    pieces: Iterable[AdapterPiece], pins: Mapping[str, str], unbound: str, numbers: Mapping[int, str] = MappingProxyType({})
) -> str:
    """The pieces as text, in their order: includes, the pins that they use by convention, and each with what is known of it.

    Args:
        pieces: in an order in which each stands behind what it needs.
        pins: name of a conventional port -> the target's literal for its pin.
        unbound: the literal for no pin.
        numbers: number of a port of the source -> the target's literal for its pin, for tables that ports are looked up in.
    """
    pieces = list(pieces)
    lines = [f"#include {header}" for header in dict.fromkeys(header for piece in pieces for header in piece.includes)]
    ports = {port.constant: port for piece in pieces for port in piece.ports}
    if ports:
        lines.append("")
    lines += [f"const uint8_t {port.constant} = {pins.get(port.name, unbound)};  // {port.name}" for port in ports.values()]
    for table in dict.fromkeys(table for piece in pieces for table in piece.tables):
        literals = ", ".join(numbers.get(number, unbound) for number in range(table.count))
        lines += ["", f"const uint8_t {table.name}[{table.count}] = {{{literals}}};  // the pin of each port of the source"]
    for piece in pieces:
        lines.append("")
        lines += [f"// {signature}" for signature in piece.signatures]
        lines += [f"// Limit: {limit}" for limit in piece.limits]
        lines.append(piece.text)
    return "\n".join(lines) + "\n"
