"""The search terms of a part: its words and model numbers with weights, those the lexicon adds, and its interface.

The title counts most, tags and properties less, the description least, since it also mentions other things.

Devices of the lexicon that the part names add the words that libraries use if the part has a trade name only. How sure this is
depends on the text: a model number or trade name is stronger than a kind of device, a title stronger than a tag, several words
stronger than one. The part's interface (two pins SDA and SCL, "IIC" in its name) selects the variant of a device with that
interface. `evidence` scores libraries with these terms.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.lexicon import KnownDevice, Lexicon
from robosmi.recommend.tokens import StopWords, chunks, is_model, models, plain, runs, words

WORD_WEIGHTS = {"title": 1.0, "family": 0.5, "tag": 0.7, "property": 0.5, "description": 0.1}
"""Weight of a word by the text that contains it."""

MODEL_WEIGHTS = {"title": 1.0, "family": 0.7, "tag": 0.85, "property": 0.95, "description": 0.45}
"""Weight of a model number by the text that contains it."""

_OWN_NAME, _NAME_ABOVE = 0.4, 0.15
_STANDS_FOR = 0.9
_NAMES = 6  # the first names of an entry are the usual ones
_SECOND = 0.35  # what another device that a part also names counts
_CLOSE = 0.6
_USUAL_ABOVE, _USUAL_LATER = 0.55, 0.12

Usual = Mapping[str, Sequence[int]]
"""Name of a device (as `words.plain` writes it) -> numbers of the libraries that are usual for it, the most usual first."""


class PartWords:
    """The search terms of a part.

    Attributes:
        words: stem -> weight, 0..1.
        models: model number -> weight, 0..1.
        origin: word or model number -> the text of the part that contains it.
        devices: the recognised devices, the surest first.
        usual: number of a library -> (how usual it is for such a device, 0..1; the device's name).
        bus: the part's bus, or empty.
        interface: the interface according to the lexicon, or empty.
    """

    def __init__(self, bus: str = "") -> None:
        self.words: dict[str, float] = {}
        self.models: dict[str, float] = {}
        self.origin: dict[str, str] = {}
        self.devices: list[Recognised] = []
        self.usual: dict[int, tuple[float, str]] = {}
        self.bus = bus
        self.interface = ""


def part_words(
    query: ComponentQuery,
    stop: StopWords,
    lexicon: Lexicon | None,
    usual: Usual,
    *,
    exact: bool = True,
) -> PartWords:
    """Collect the search terms of a part.

    Args:
        query: the part.
        stop: insignificant words.
        lexicon: devices; None to use only the part's own words.
        usual: usual libraries of devices.
        exact: see `recognition.recognise`.
    """
    part = PartWords(bus=bus(query))
    for where, text in texts(query):
        _add(part.words, part.origin, words(text), WORD_WEIGHTS[where], where, stop)
        _add(part.models, part.origin, models(text), MODEL_WEIGHTS[where], where, stop)
    if lexicon is not None:
        part.devices = recognise(lexicon, query, exact=exact)
        _add_devices(part, lexicon, usual, stop)
    return part


def _add_devices(part: PartWords, lexicon: Lexicon, usual: Usual, stop: StopWords) -> None:
    if not part.devices:
        return
    surest = part.devices[0]
    part.interface = lexicon.devices[surest.device].interface
    for rank, found in enumerate(part.devices[:3]):
        if found.strength < _CLOSE * surest.strength:
            break
        weight = found.strength if rank == 0 else _SECOND * found.strength
        for number, distance in lexicon.lineage(found.device):
            device, where = lexicon.devices[number], f"as {lexicon.devices[number].name}"
            for name in device.names[:_NAMES]:
                _add(part.words, part.origin, words(name), weight * (_NAME_ABOVE if distance else _OWN_NAME), where, stop)
            if not rank:  # a trade name stands for its chip, a kit for its chips
                _add(
                    part.models,
                    part.origin,
                    models(" + ".join(device.stands_for)),
                    weight * _STANDS_FOR ** (distance + 1),
                    where,
                    stop,
                )
            _add_usual(part, usual, found, device, weight, distance)


def _add_usual(part: PartWords, usual: Usual, found: Recognised, device: KnownDevice, weight: float, distance: int) -> None:
    """Add the usual libraries of a device; those listed for the name that the part uses precede those for its other names."""
    keys = {plain(name): name.removesuffix("*") for name in (*device.names, *device.stands_for)}
    listed = [found.name] if not distance and found.name in usual else [key for key in keys if key in usual]
    for key in listed:
        for place, library in enumerate(usual[key]):
            value = weight * _USUAL_ABOVE**distance * max(1 - _USUAL_LATER * place, 0.4)
            if value > part.usual.get(library, (0.0, ""))[0]:
                part.usual[library] = (value, keys.get(key, key))


def _add(
    weights: dict[str, float], origin: dict[str, str], found: Iterable[str], weight: float, where: str, stop: StopWords
) -> None:
    for word in found:
        if word not in stop and weight > weights.get(word, 0.0):
            weights[word] = weight
            origin[word] = where


# ---- devices that a part names

_WEIGHTS = {"title": 1.0, "property": 0.9, "family": 0.8, "tag": 0.75, "description": 0.35}
_SILENT = frozenset(
    {"family", "package", "layer", "color", "colour", "size", "voltage", "pin spacing", "hole size", "editable pin labels"}
)
_SURE = 0.4
_DESCRIBED = 400  # what a thing is, its description says first; later it tells of others
_NUMBERED = re.compile(r"([^\W\d_]{2,})\d{1,2}")  # LED1, Servo2: what a drawing calls the instances of a part

BUSES = {"i2c": ("i2c", "iic", "twi", "qwiic", "stemma"), "spi": ("spi",), "serial": ("uart", "serial")}
"""The words that indicate each bus."""


class Recognised(Struct, frozen=True):
    """A device that a part names.

    Attributes:
        device: number of the entry.
        name: what names it, as `words.plain` writes it.
        said: the same as the part has it.
        where: title, family, tag, property or description.
        exact: it is a model number or trade name, not just a kind of device.
        strength: how surely, 0..1.
    """

    device: int
    name: str
    said: str
    where: str
    exact: bool
    strength: float


def texts(query: ComponentQuery) -> Iterator[tuple[str, str]]:
    """The texts of a part with their origin; properties about housing and colour are left out."""
    yield "title", query.title
    yield "family", query.family
    yield from (("tag", tag) for tag in query.tags)
    yield from (("property", value) for name, value in query.properties.items() if name.lower() not in _SILENT)
    yield "description", query.description[:_DESCRIBED]


def bus(query: ComponentQuery) -> str:
    """The bus of a part, by the names of its connectors, else by its words; empty if neither indicates one."""
    pins = {name for connector in query.connectors for name in chunks(connector.lower())}
    if {"sda", "scl"} <= pins:
        return "i2c"
    if pins & {"mosi", "miso"}:
        return "spi"
    said = {word for where, text in texts(query) if where != "description" for word in chunks(text.lower())}
    found = [name for name, words in BUSES.items() if said & set(words)]
    return found[0] if len(found) == 1 else ""


def recognise(lexicon: Lexicon, query: ComponentQuery, *, exact: bool = True) -> list[Recognised]:
    """The devices that a part names, the surest first, without duplicates and without kinds of a more certain one.

    Args:
        lexicon: the devices.
        query: the part.
        exact: also by model numbers and trade names; False for kinds of devices alone (to measure what these add).
    """
    best: dict[int, Recognised] = {}
    support: dict[int, float] = {}
    for where, text in texts(query):
        for found in _in_text(lexicon, where, text):
            if found.exact and not exact:
                continue
            old = best.get(found.device)
            if old is None or found.strength > old.strength:
                best[found.device] = found
            support[found.device] = support.get(found.device, 0.0) + found.strength
    _add_variants(lexicon, bus(query), best)
    result: list[Recognised] = []
    covered: set[int] = set()
    for found in sorted(best.values(), key=lambda f: (-_rank(lexicon, f, support, best), f.device)):
        if found.device not in covered:
            result.append(found)
            covered |= {number for number, _ in lexicon.lineage(found.device)}
    return result


def _add_variants(lexicon: Lexicon, spoken: str, best: dict[int, Recognised]) -> None:
    """Add the variants for a bus: for a character LCD on an I2C bus the entry "I2C LCD", if there is one."""
    if not spoken:
        return
    for found in list(best.values()):
        for name in lexicon.devices[found.device].names:
            other = lexicon.exactly(plain(f"{spoken} {name}"))
            if other is not None and other not in best:
                best[other] = Recognised(other, found.name, found.said, found.where, found.exact, found.strength)


def _rank(lexicon: Lexicon, found: Recognised, support: Mapping[int, float], best: Mapping[int, Recognised]) -> float:
    """The rank of a recognised device: its strength, and a bonus if it or a more general device is named repeatedly.

    If a more general device is named, too, a strongly recognised one is at least as strong as that.
    """
    above = [best[number].strength for number, distance in lexicon.lineage(found.device) if distance and number in best]
    strength = max([found.strength, *above]) if found.strength >= _SURE else found.strength
    repeated = min(max(support.get(found.device, 0.0) - found.strength, 0.0), 1.0)
    return strength + 0.15 * sum(above) + 0.1 * repeated


def _in_text(lexicon: Lexicon, where: str, text: str) -> Iterator[Recognised]:
    weight, written = _WEIGHTS[where], chunks(text)
    found = sorted(runs(text), key=lambda run: run[0] - run[1])
    total = max((end for _, end, _ in found), default=1)
    taken: list[tuple[int, int]] = []
    for start, end, key in found:
        if any(start >= first and end <= last for first, last in taken):
            continue
        number = lexicon.by_model(key) if end - start == 1 and is_model(key) else lexicon.exactly(key)
        named = number is not None and any(letter.isdigit() for letter in key)
        if number is None and (numbered := _NUMBERED.fullmatch(key)):
            number = lexicon.exactly(plain(numbered[1]))
        if number is None or (where == "description" and not named and end - start == 1):
            continue
        taken.append((start, end))
        depth = lexicon.devices[number].depth
        kind = min(0.5 + 0.1 * (end - start) + 0.25 * (end - start) / total + 0.03 * depth, 0.92)
        said = " ".join(written[start:end])
        yield Recognised(number, key, said, where, named, weight * (1.0 if named else kind))
    for key in models(text):
        number = lexicon.by_model(key)
        if number is not None:
            yield Recognised(number, key, key.upper(), where, True, weight)
