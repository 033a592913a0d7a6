"""The search terms of a part: its words and model numbers with weights, those the lexicon adds, and its interface.

The title counts most, tags and properties less, the description least, since it also mentions other things. Recognised devices
add the words that libraries use if the part has a trade name only. `evidence` scores libraries with these terms.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.lexicon import KnownDevice, Lexicon
from robosmi.recommend.recognition import Recognised, bus, recognise, texts
from robosmi.recommend.words import StopWords, models, plain, words

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
