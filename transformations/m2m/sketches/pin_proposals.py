"""Proposes a pin of the other board for each port of a program whose platform stays, where no drawing and no person says one.

On a board of the same processor a pin of the same label and abilities is that pin: shields and wires fit, and nothing is asked.
On any other board the pin is a proposal: by its abilities, the one that the text means already if it is free. The user has to
approve it, since nobody has drawn the new wires.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from msgspec import Struct

from robosmi.metamodels import migration, platform
from robosmi.transformations.knowledge.platforms.board_pins import BoardPins
from robosmi.transformations.queries.plans.retained_pins import PROPOSED
from robosmi.transformations.queries.ports.ports import Port

SAME = "the same pin on both boards"


class NewBoard(Struct, frozen=True):
    """The board that pins are proposed on.

    Attributes:
        board: the board.
        pins: how programs number its pins.
        source: the same of the source board.
        old: the source board.
        abilities: function -> the ability that it needs of a pin.
        buses: labels of pins that buses of the program take on it.
    """

    board: platform.Board
    pins: BoardPins
    source: BoardPins
    old: platform.Board
    abilities: Mapping[str, str]
    buses: Collection[str] = ()

    @property
    def alike(self) -> bool:
        """Whether both boards have processors of one architecture."""
        chips = [each.microcontroller for each in (self.board, self.old)]
        return all(chip is not None for chip in chips) and len({str(chip.architecture) for chip in chips if chip}) == 1


def bind_same_pins(
    ports: Sequence[Port],
    bindings: Sequence[migration.PortBinding],
    new: NewBoard,
    connections: Sequence[migration.Connection],
) -> None:
    """Bind the ports that a drawing of a board with the same pins leaves open, where a part is drawn at the port's pin.

    Args:
        ports: the program's ports.
        bindings: the decision for each port, in the same order; those of ports that only the user has named follow.
        new: the board.
        connections: what is drawn on it.
    """
    taken = {id(binding.pin) for binding in bindings if binding.pin is not None}
    for port, binding in zip(ports, bindings, strict=False):
        pin = _same(port, new) if binding.open and new.alike else None
        drawn = [c for c in connections if c.pin is pin] if pin is not None and id(pin) not in taken else []
        if pin is not None and len(drawn) == 1:
            _bind(binding, pin, 1.0, f"{SAME}, and a part is drawn there")
            binding.connection, binding.choice = drawn[0], str(drawn[0].name)
            taken.add(id(pin))


def propose_pins(ports: Sequence[Port], bindings: Sequence[migration.PortBinding], new: NewBoard) -> None:
    """Bind the open ports of a program to pins.

    Args:
        ports: the program's ports.
        bindings: the decision for each port, in the same order; those of ports that only the user has named follow.
        new: the board.
    """
    taken = {str(b.pin.label) for b in bindings if b.pin is not None}
    waiting = [(port, binding) for port, binding in zip(ports, bindings, strict=False) if binding.open and port.pin is not None]
    if new.alike:
        for port, binding in list(waiting):
            pin = _same(port, new)
            if pin is not None and str(pin.label) not in taken:
                _bind(binding, pin, 1.0, SAME)
                taken.add(str(pin.label))
                waiting.remove((port, binding))
    waiting.sort(key=lambda each: _means(each[0], new) is None)  # others leave these pins free
    wanted = [(binding, _candidates(port, new, taken)) for port, binding in waiting]
    for binding, pin in _matched(wanted):
        port = next(port for port, each in waiting if each is binding)
        able = ", ".join(sorted(_needs(port, new)))
        _bind(binding, pin, PROPOSED, f"proposed: a free pin with {able}")


def _bind(binding: migration.PortBinding, pin: platform.Pin, confidence: float, why: str) -> None:
    binding.pin, binding.choice, binding.open = pin, str(pin.label), False
    binding.confidence, binding.chosenBy = confidence, migration.ChosenBy.rule
    binding.evidence.append(why)


def _needs(port: Port, new: NewBoard) -> set[str]:
    """The abilities that a port's pin must have."""
    found = {new.abilities[use.function] for use in port.uses if use.function in new.abilities}
    only_measured = bool(port.uses) and all(new.abilities.get(use.function) == "analog_in" for use in port.uses)
    return found if only_measured else found | {"digital"}


def _same_processor(new: NewBoard) -> bool:
    here, there = new.old.microcontroller, new.board.microcontroller
    return here is not None and there is not None and here.name == there.name


def _same(port: Port, new: NewBoard) -> platform.Pin | None:
    """The pin of the same label, if it can what the port's pin can on the source board as far as the program uses it."""
    label = new.source.labels.get(port.pin if port.pin is not None else -1)
    pin = next((pin for pin in new.board.pins if pin.label == label), None)
    old = next((pin for pin in new.old.pins if pin.label == label), None)
    if pin is None or old is None or (str(pin.label) in new.buses and not _same_processor(new)):
        return None  # with the same processor the program shares the pin with its bus on both boards, or on none
    lacking = _needs(port, new).intersection(old.abilities).difference(pin.abilities)
    return None if lacking else pin


def _candidates(port: Port, new: NewBoard, taken: Collection[str]) -> list[platform.Pin]:
    """The pins that a port may have, the best first."""
    needs = _needs(port, new)
    lamp = _is_lamp(port, new)
    able = [
        pin
        for pin in new.board.pins
        if needs.issubset(pin.abilities)
        and str(pin.label) not in taken
        and ((not pin.reserved and str(pin.label) not in new.buses) or (lamp and pin.label == new.board.led))
    ]
    meant = _means(port, new)
    label = new.source.labels.get(port.pin if port.pin is not None else -1, "")

    def rank(pin: platform.Pin) -> tuple[bool, bool, int]:
        means = meant == pin.label if not label.startswith("A") else label in (pin.label, *pin.aliases)
        return not (lamp and pin.label == new.board.led), not means, len(pin.abilities)

    return sorted(able, key=rank)


def _means(port: Port, new: NewBoard) -> str | None:
    """The label of the pin that a port's number means on the new board; None for analogue pins, which go by their names."""
    number = port.pin if port.pin is not None else -1
    return None if new.source.labels.get(number, "A").startswith("A") else new.pins.labels.get(number)


def _is_lamp(port: Port, new: NewBoard) -> bool:
    """Whether a port is the source board's own LED, as far as the program tells: it is only written, and called so."""
    if not new.old.led or new.source.labels.get(port.pin if port.pin is not None else -1) != new.old.led:
        return False
    names = (port.name, *port.names)
    return port.directions <= {"out"} and any("led" in str(name).lower() for name in names)


def _matched(
    wanted: Sequence[tuple[migration.PortBinding, Sequence[platform.Pin]]],
) -> list[tuple[migration.PortBinding, platform.Pin]]:
    """A pin for as many ports as possible (Kuhn's algorithm), each the best that is left to it."""
    holder: dict[int, int] = {}
    pins = {id(pin): pin for _, candidates in wanted for pin in candidates}

    def seat(number: int, seen: set[int]) -> bool:
        candidates = wanted[number][1]
        for pin in candidates:
            if id(pin) not in holder and id(pin) not in seen:
                holder[id(pin)] = number
                return True
        for pin in candidates:
            if id(pin) not in seen:
                seen.add(id(pin))
                if seat(holder[id(pin)], seen):
                    holder[id(pin)] = number
                    return True
        return False

    for number in sorted(range(len(wanted)), key=lambda each: len(wanted[each][1])):
        seat(number, set())
    return [(wanted[number][0], pins[pin]) for pin, number in sorted(holder.items(), key=lambda item: item[1])]
