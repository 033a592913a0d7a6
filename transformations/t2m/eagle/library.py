"""The libraries that an EAGLE schematic contains: device sets with their gates, symbols and pins, as records.

EAGLE copies into each schematic what it uses of its libraries. A pin is identified by gate and name; if several gates have a
pin of one name, the gate is part of the connector's identity (`connectors_of`). What the parts are for is not decided here.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from html import unescape

from lxml import etree
from msgspec import Struct

from robosmi.transformations.t2m.drawing import free_identity

_TAG = re.compile(r"<[^<>]*>")
_COUNTER = re.compile(r"@[^@]*$")
_OVERLINE = "!"
_LONGEST = 200


class EaglePin(Struct, frozen=True):
    """A pin of a device set: its connector's identity, gate, name as written, name as read, direction (`pwr`, `sup`, `io`)."""

    connector: str
    gate: str
    written: str
    name: str
    direction: str


class EagleDevice(Struct, frozen=True):
    """A device of a device set.

    Attributes:
        title: name of the device set, followed by the device's if it has one.
        description: the library's sentence about it.
        pins: by gate and name as written.
        pads: how many pads its package has wired.
        addlevels: EAGLE's add level of each gate (`request` gates of supplies need not be drawn).
    """

    title: str
    description: str
    pins: dict[tuple[str, str], EaglePin] = {}
    pads: int = 0
    addlevels: dict[str, str] = {}


class EagleLibraries:
    """The libraries of one schematic."""

    def __init__(self, schematic: etree._Element) -> None:
        self._libraries: dict[str, etree._Element] = {}
        for library in schematic.iterfind("libraries/library"):
            name, urn = library.get("name", ""), library.get("urn", "")
            self._libraries.setdefault(urn or name, library)
            self._libraries.setdefault(name, library)
        self._found: dict[tuple[str, str, str, str], EagleDevice | None] = {}

    def device(self, library: str, urn: str, deviceset: str, device: str) -> EagleDevice | None:
        """The device of a part, or None where the schematic does not carry it."""
        key = (library, urn, deviceset, device)
        if key not in self._found:
            self._found[key] = self._read(*key)
        return self._found[key]

    def _read(self, library: str, urn: str, deviceset: str, device: str) -> EagleDevice | None:
        found = self._libraries.get(urn) if urn else None
        found = found if found is not None else self._libraries.get(library)
        if found is None:
            return None
        chosen = next((entry for entry in found.iterfind("devicesets/deviceset") if entry.get("name") == deviceset), None)
        if chosen is None:
            return None
        symbols = {symbol.get("name", ""): symbol for symbol in found.iterfind("symbols/symbol")}
        gates = [(gate.get("name", ""), symbols.get(gate.get("symbol", "")), gate) for gate in chosen.iterfind("gates/gate")]
        listed = [
            (name, pin.get("name", ""), pin.get("direction", "io"))
            for name, symbol, _ in gates
            if symbol is not None
            for pin in symbol.iterfind("pin")
        ]
        connectors = connectors_of([(gate, written) for gate, written, _ in listed])
        pins = {
            (gate, written): EaglePin(connectors[gate, written], gate, written, spoken(written), direction)
            for gate, written, direction in listed
        }
        shape = next((entry for entry in chosen.iterfind("devices/device") if entry.get("name", "") == device), None)
        pads = 0 if shape is None else sum(len(c.get("pad", "").split()) for c in shape.iterfind("connects/connect"))
        levels = {name: gate.get("addlevel", "next") for name, _, gate in gates}
        return EagleDevice(_title(deviceset, device), _described(chosen.findtext("description") or ""), pins, pads, levels)


def connectors_of(pins: Iterable[tuple[str, str]]) -> dict[tuple[str, str], str]:
    """The identity of the connector that each pin is, by gate and name as written: no two pins have the same one.

    A pin is called by its name where no other gate has that name, else by gate and name (`A.OUT`). Names may have dots in them,
    so that this may be the text of another pin: it is then called `OUT of A`.

    >>> connectors_of([("A", "OUT"), ("B", "OUT"), ("B", "EN"), ("C", "B.OUT")])
    {('A', 'OUT'): 'A.OUT', ('B', 'OUT'): 'OUT of B', ('B', 'EN'): 'EN', ('C', 'B.OUT'): 'B.OUT'}
    """
    listed = list(dict.fromkeys(pins))
    counts = Counter(written for _, written in listed)
    wanted = {pin: pin[1] if counts[pin[1]] == 1 else ".".join(pin) for pin in listed}
    clashes = Counter(wanted.values())
    found: dict[tuple[str, str], str] = {}
    taken = {text for (_, written), text in wanted.items() if text == written}
    for (gate, written), text in wanted.items():
        if text != written:
            plain = text if clashes[text] == 1 else f"{written} of {gate}"
            text = free_identity(plain, 0, taken)
            taken.add(text)
        found[gate, written] = text
    return found


def spoken(written: str) -> str:
    """The name of a pin without its counter (`GND@1`) and without overline marks (`!RESET!`)."""
    return _COUNTER.sub("", written).replace(_OVERLINE, "") or written


def _title(deviceset: str, device: str) -> str:
    if "?" in deviceset:
        return deviceset.replace("?", device)
    return deviceset + device


def _described(text: str) -> str:
    """The first sentence of a description, which is HTML."""
    said = unescape(_TAG.sub(" ", unescape(text.split("<p>", 1)[0].split("<br", 1)[0])))
    return " ".join(said.split())[:_LONGEST]
