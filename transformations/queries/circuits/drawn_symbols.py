"""What components are drawn as in the picture of a circuit: the symbol, its paint, and the outline of a board.

The words, colours and outlines are data (`platform_repo/parts/drawn_symbols.toml`), the symbols are in `symbols.svg.j2`. A board
without an outline, and a bare microcontroller, have their pins in two rows as they come.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

from msgspec import Struct

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.metamodels import hardware
from robosmi.project import read_data
from robosmi.transformations.queries.circuits.component_kinds import connector_words, significant_words

_FILE = "parts/drawn_symbols.toml"
UNKNOWN = "part"
"""The symbol of a part whose kind no word tells."""
_LED_PAINT, _PAINT, _BOARD_PAINT = "#e53935", "#5f6b76", "#37474f"
_LEAST_PINS_KNOWN = 0.5
_NUMBER = re.compile(r"\.\d+$")


class Outline(Struct, frozen=True):
    """A board: its paint and its pins at the left and at the right edge from top to bottom; an empty one is a gap."""

    paint: str
    left: tuple[str, ...]
    right: tuple[str, ...]


class _Data(Struct, frozen=True):
    symbols: tuple[tuple[str, frozenset[str]], ...]
    colours: Mapping[str, str]
    outlines: Mapping[str, Outline]
    aliases: Mapping[str, tuple[str, ...]]


def symbol_names() -> list[str]:
    """All symbols that a part may be drawn as."""
    return sorted({name for name, _ in _data().symbols} | {UNKNOWN})


def symbol_of(component: hardware.Component) -> tuple[str, str]:
    """Symbol and paint of a component."""
    if component.role is hardware.Role.Board:
        outline = outline_of(component)
        return "board", outline.paint if outline is not None else _BOARD_PAINT
    known = _data()
    part = [component.device.kind if component.device is not None else "", component.partTitle, component.family]
    for texts in (part, [component.title]):
        words = significant_words(texts) | connector_words(texts)
        for name, said in known.symbols:
            if words & said:
                return name, _paint(component) if name == "led" else _PAINT
    return UNKNOWN, _PAINT


def _paint(component: hardware.Component) -> str:
    told = [*(p.value for p in component.properties if p.name == "color"), component.title, component.partTitle, component.family]
    words = (word.lower() for text in told for word in str(text).replace("(", " ").split())
    colours = _data().colours
    return next((colours[word] for word in words if word in colours), _LED_PAINT)


def outline_of(component: hardware.Component) -> Outline | None:
    """The outline of a board, if it is known, and if it is the board and not its microcontroller alone."""
    outline = _data().outlines.get(component.boardName)
    if outline is None or any(texts in component.partTitle.upper() for texts in ("ATMEGA", "ATTINY")):
        return None
    pins = {c.pin for c in component.connectors if c.pin}
    known = pins & {*outline.left, *outline.right}
    return outline if len(known) >= _LEAST_PINS_KNOWN * len(pins) else None


def places_at(outline: Outline, names: Sequence[str]) -> list[tuple[int, int] | None]:
    """The place of each pin at an outline: the edge (-1 left, 1 right) and the number from the top; none if it has none.

    Args:
        outline: of the board.
        names: labels of pins; each place is given out once, first to those that name it with its number (GND.2).
    """
    places = [(pin, (side, n)) for side, pins in ((-1, outline.left), (1, outline.right)) for n, pin in enumerate(pins) if pin]
    aliases = _data().aliases
    found: dict[int, tuple[int, int]] = {}
    ways: tuple[Callable[[str, str], bool], ...] = (
        lambda pin, name: pin == name,
        lambda pin, name: plain_name(pin) == plain_name(name),
        lambda pin, name: plain_name(pin) in aliases.get(plain_name(name), ()),
    )
    for is_called in ways:
        for number, name in enumerate(names):
            free = (place for pin, place in places if place not in found.values() and is_called(pin, name))
            if number not in found and (place := next(free, None)) is not None:
                found[number] = place
    return [found.get(number) for number in range(len(names))]


def plain_name(name: str) -> str:
    """The name of a pin as it is printed on the board: without the number that tells pins of one name apart."""
    return _NUMBER.sub("", name.upper().replace(" ", ""))


def _data() -> _Data:
    path = resources.find("platform_repo", _FILE)
    return _read(path, path.stat().st_mtime_ns)


@lru_cache(maxsize=2)
def _read(path: Path, _: int) -> _Data:
    data = DataTable(path, read_data(path))
    outlines: dict[str, Outline] = {}
    for entry in data.tables("outlines"):
        made = Outline(entry.text("paint"), tuple(entry.texts("left")), tuple(entry.texts("right")))
        outlines.update(dict.fromkeys(entry.texts("boards"), made))
    colours, aliases = data.table("colours"), data.table("aliases")
    others = {other for name in aliases.values for other in aliases.texts(name)}
    return _Data(
        tuple((entry.text("name"), frozenset(entry.texts("words"))) for entry in data.tables("symbols")),
        {word: colours.text(word) for word in colours.values},
        outlines,
        {other: tuple(name for name in aliases.values if other in aliases.texts(name)) for other in others},
    )
