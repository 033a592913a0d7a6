"""Converts adapter pieces that a plan refers to into elements of the platform metamodel."""

from __future__ import annotations

from robosmi.metamodels import platform
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.api_facts import DIRECTIONS

KINDS = {
    "adapter": "adaptedFunction", "constant": "constant", "register": "register", "variable": "variable", "type": "dataType",
    "helper": "helper",
}  # fmt: skip
"""Kind of a piece in adapter files -> its kind in the metamodel."""
_SAME = (
    "signatures", "text", "fidelity", "limits", "includes", "setup", "libraries", "timers", "vectors", "mcus", "symmetric",
)  # fmt: skip


def adapter_element(piece: AdapterPiece) -> platform.Adapter:
    """Make a new element from a piece, without its references to the pieces it needs."""
    said = {name: value for name in _SAME if (value := getattr(piece, name))}
    return platform.Adapter(
        name=piece.name,
        pieceKind=enum_literal(platform.PieceKind, KINDS[piece.kind]),
        sourceHeader=piece.header,
        adapterKind=enum_literal(platform.AdapterKind, piece.relation or "oneToOne"),
        targetName=piece.target_name,
        componentRole=piece.role,
        takenVectors=list(piece.taken),
        stackBytes=piece.stack,
        inlinedStackBytes=piece.stack_once,
        ramBytes=piece.ram,
        mostServos=piece.servos,
        source="/".join(piece.location.path.replace("\\", "/").split("/")[-3:]),
        pins=[
            platform.AdapterPin(
                name=pin.name, capability=_capability(pin.capability), direction=_direction(pin.direction), signed=pin.signed,
                componentRole=pin.role, split=pin.split,
            )
            for pin in piece.pins
        ],
        ports=[
            platform.ConventionalPort(
                constant=port.constant, name=port.name, number=port.number, capability=_capability(port.capability),
                direction=_direction(port.direction), componentRole=port.role,
            )
            for port in piece.ports
        ],
        ranges=[
            platform.ArgumentRange(
                name=one.name, position=one.position, others=list(one.others), beside=one.beside, awayFrom=one.away_from,
                effect=one.effect, **{k: v for k, v in (("least", one.least), ("most", one.most)) if v is not None},
            )
            for one in piece.ranges
        ],
        interrupts=[
            platform.InterruptStack(vector=one.vector, stackBytes=one.stack, openBytes=one.others) for one in piece.interrupts
        ],
        tables=[platform.PortTable(name=table.name, count=table.size) for table in piece.tables],
        **said,
    )  # fmt: skip


def _capability(word: str) -> platform.PinCapability:
    found: platform.PinCapability = enum_literal(platform.PinCapability, word)
    return found


def _direction(word: str) -> platform.Direction:
    found: platform.Direction = enum_literal(platform.Direction, DIRECTIONS[word])
    return found
