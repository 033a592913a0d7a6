"""The wiring of a sketch on its own board beside the one on the new board: each signal with its old and its new pin."""

from __future__ import annotations

from msgspec import Struct

from robosmi.metamodels import migration, platform
from robosmi.transformations.queries.plans.bus_pins import bus_pins
from robosmi.transformations.queries.plans.port_pins import bound_pin, source_name
from robosmi.transformations.queries.plans.retained_pins import retains_platform


class MovedWire(Struct, frozen=True):
    """A signal.

    Attributes:
        signal: what the program calls it, or the bus with its signal.
        part: the component at its new pin; empty if no drawing has one.
        old: label of its pin on the board of the sketch.
        new: label of its pin on the new board; empty without one.
    """

    signal: str
    part: str
    old: str
    new: str

    @property
    def stays(self) -> bool:
        """Whether the pin has the same label on both boards."""
        return self.old == self.new


class MovedWiring(Struct, frozen=True):
    """The wiring of both boards.

    Attributes:
        old, new: the boards, as people call them, with their logic level.
        wires: the signals, in the order of the old board's pins; those of buses last.
    """

    old: str
    new: str
    wires: tuple[MovedWire, ...]


def moved_wiring(plan: migration.MigrationPlan) -> MovedWiring | None:
    """The wiring of both boards of a plan; None for a program that changes its platform."""
    own = plan.source.boardMappings if plan.source is not None else ()
    old = next((each.board for each in own if each.board is not None), None)
    if not retains_platform(plan) or old is None or plan.board is None:
        return None
    order = {str(pin.label): number for number, pin in enumerate(old.pins)}
    wires = []
    for binding in plan.portBindings:
        pin, label = bound_pin(binding), source_name(binding)
        if label:
            names = [str(name) for name in dict.fromkeys((binding.name, *binding.names)) if name != label]
            part = binding.connection.component if binding.connection is not None else None
            title = str(part.title or part.partTitle) if part is not None else ""
            wires.append(MovedWire(", ".join(names) or label, title, label, str(pin.label) if pin is not None else ""))
    wires.sort(key=lambda wire: order.get(wire.old, len(order)))
    known = {wire.old for wire in wires}
    buses = [MovedWire(f"{each.bus} {each.signal}", "", each.old, each.new) for each in bus_pins(plan) if each.old not in known]
    return MovedWiring(_title(old), _title(plan.board), (*wires, *buses))


def _title(board: platform.Board) -> str:
    return f"{board.title} ({board.volts:g} V)" if board.volts else str(board.title)
