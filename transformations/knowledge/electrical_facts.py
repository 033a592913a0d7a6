"""The electrical properties of devices, from `parts/electrical.toml` of the platform repository, the user's files first.

An entry is found by a part's id, title or family, or by the drawing's name of a chip. `constraints/` evaluates the facts for a
drawing.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.data_text import Json, as_list, as_number, as_table, as_text, as_texts, as_whole, line_of_key, line_of_value
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.metamodels import hardware
from robosmi.resources import folders
from robosmi.transformations.knowledge.board_models import ABILITIES
from robosmi.transformations.knowledge.part_names import Phrases, read_toml
from robosmi.transformations.knowledge.wildcards import Wildcards, fits

FILE = "parts/electrical.toml"
"""Path of the table in a data folder; the head of the file explains the keys."""

_FINDERS = ("ids", "words", "families", "not")
_CHIP_NAMES = ("chip label", "part number", "mpn", "label")


class DeviceFacts(Struct, frozen=True):
    """The electrical properties of one kind of device; all are optional.

    Attributes:
        kind: its name in messages.
        volts: least and greatest supply voltage, or None.
        signal_volts: the greatest voltage at its inputs, or None.
        peak_ma: the greatest current in operation, in mA.
        needs_driver: whether a pin cannot drive it directly.
        inductive: whether it needs a flyback diode if a bare transistor switches it.
        terminals: the connectors that these two are about; all if empty.
        switch: whether it is a transistor.
        series_resistor: whether it needs a series resistor.
        limits_current: whether the current through its outputs is limited, or its outputs are contacts.
        analog: connectors with a voltage to be measured, `*` for all.
        wants: abilities of a pin that it benefits from.
        output: push-pull if its output cannot share a wire, contact if it only opens and closes a circuit (a switch); else empty.
        i2c: its possible I2C addresses, the default first.
        pull_ups: whether it has pull-up resistors for the bus, None if unknown.
        isolated: whether it needs no common ground.
        tone: whether it is driven by the core's function for tones.
        rest: the level of its inputs, low or high, at which it is inactive; empty for none.
        rest_when: (property, value, `rest` of a part whose property has this value); empty for none.
        bench: how it is tested alone on the bench; empty if its role implies it.
    """

    kind: str
    volts: tuple[float, float] | None = None
    signal_volts: float | None = None
    peak_ma: int = 0
    needs_driver: bool = False
    inductive: bool = False
    terminals: tuple[str, ...] = ()
    switch: bool = False
    series_resistor: bool = False
    limits_current: bool = False
    analog: tuple[str, ...] = ()
    wants: tuple[str, ...] = ()
    output: str = ""
    i2c: tuple[int, ...] = ()
    pull_ups: bool | None = None
    isolated: bool = False
    tone: bool = False
    rest: str = ""
    rest_when: tuple[str, ...] = ()
    bench: str = ""


_REMEMBERED = 1024  # components; drawings have the same few again and again


REST = "rest"
"""The part property by which a drawing states the level at which a component is inactive."""


class _Entry(NamedTuple):
    facts: DeviceFacts
    ids: frozenset[str]
    families: tuple[str, ...]
    forbidden: Phrases


class ElectricalFacts:
    """The content of one file: its entries, and the meanings of connector names."""

    def __init__(self, table: Mapping[str, Json], path: str) -> None:
        _check_tables(table, path)
        devices = [as_table(device) for device in as_list(table.get("device", ()))]
        self._entries = [_entry(device, path) for device in devices]
        self._words = Phrases((word, number) for number, device in enumerate(devices) for word in _texts(device, "words"))
        self.names = {
            key: Wildcards.of(name.lower() for name in as_texts(n)) for key, n in as_table(table.get("names", {})).items()
        }
        self._known: dict[tuple[object, ...], DeviceFacts | None] = {}
        limits = [as_list(limit) for limit in as_list(as_table(table.get("board", {})).get("supply_ma", ()))]
        self.supply_ma = [(as_number(volts), int(as_number(most))) for volts, most in limits]

    def find(self, component: hardware.Component) -> DeviceFacts | None:
        """The facts about a component, or None."""
        chip = tuple(p.value for p in component.properties if p.name.lower() in _CHIP_NAMES)
        key = (component.partId, component.partTitle, component.family, component.title, chip)
        if key not in self._known:
            if len(self._known) >= _REMEMBERED:
                self._known.clear()
            self._known[key] = self._find(component, chip)
        return self._known[key]

    def _find(self, component: hardware.Component, chip: Iterable[str]) -> DeviceFacts | None:
        for entry in self._entries:
            if component.partId in entry.ids:
                return entry.facts
        about = f"{component.partTitle} / {component.family}"
        family = component.family.strip().lower()
        found = self._by_words(component.partTitle, about) or self._by_family(family, about)
        for text in () if found else (component.family, *chip, component.title):
            found = found or self._by_words(text, f"{about} / {text}")
        return found

    def _by_words(self, text: str, about: str) -> DeviceFacts | None:
        return self._allowed(sorted({number for number, _ in self._words.found(text)}), about)

    def _by_family(self, family: str, about: str) -> DeviceFacts | None:
        numbers = [n for n, e in enumerate(self._entries) if any(fits(family, pattern) for pattern in e.families)]
        return self._allowed(numbers, about)

    def _allowed(self, numbers: Iterable[int], about: str) -> DeviceFacts | None:
        return next((self._entries[n].facts for n in numbers if about not in self._entries[n].forbidden), None)


class Electrical:
    """All files of facts, the user's before the built-in one."""

    def __init__(self, files: tuple[ElectricalFacts, ...]) -> None:
        self._files = files

    def facts(self, component: hardware.Component) -> DeviceFacts | None:
        """The facts about a component from the first file with an entry, or None. A drawing may override its inactive level."""
        found = next((found for file in self._files if (found := file.find(component)) is not None), None)
        if found is None:
            return None
        told = next((p.value for p in component.properties if p.name == REST), "")
        if told in _WORDS["rest"]:
            return replace(found, rest=told)
        if not found.rest_when:
            return found
        name, value, rest = found.rest_when
        has_it = any(p.name == name and p.value.strip().lower() == value for p in component.properties)
        return replace(found, rest=rest) if has_it else found

    def meanings(self, name: str) -> tuple[str, ...]:
        """The meanings of a connector's name (`sda`, `output`; the keys of `[names]`), without duplicates."""
        word = " ".join(name.lower().split())
        found = (key for file in self._files for key, names in file.names.items() if word in names)
        return tuple(dict.fromkeys(found))

    @property
    def supply_limits(self) -> list[tuple[float, int]]:
        """Supply voltage of a board -> the most current it supplies there, in mA; the first voltage that is close applies."""
        return [limit for file in self._files for limit in file.supply_ma]


def electrical(project: Path | None = None) -> Electrical:
    """The facts, read once for each state of the files.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a file is damaged.
    """
    paths = [path for folder in folders("platform_repo", project) if (path := folder / FILE).is_file()]
    return _read(tuple((str(path), path.stat().st_mtime_ns) for path in paths))


def rests_beyond_names(components: Iterable[hardware.Component]) -> dict[str, str]:
    """The inactive level (`low`, `high`) of components, by identity, where it differs from what their names alone imply."""
    facts, found = electrical(), {}
    for component in components:
        own = facts.facts(component)
        named = facts.facts(hardware.Component(partTitle=component.partTitle or component.title))
        if own is not None and own.rest and named is not None and own.rest != named.rest:
            found[component.elementId] = own.rest
    return found


@cache
def _read(files: tuple[tuple[str, int], ...]) -> Electrical:
    return Electrical(tuple(ElectricalFacts(read_toml(path), path) for path, _ in files))


_KEYS = {*DeviceFacts.__struct_fields__}
_FLAGS = ("needs_driver", "inductive", "switch", "series_resistor", "limits_current", "pull_ups", "isolated", "tone")
_TYPES: dict[str, tuple[type, ...]] = {"kind": (str,), "peak_ma": (int,), "signal_volts": (int, float)} | dict.fromkeys(
    _FLAGS, (bool,)
)


_WORDS = {
    "rest": ("low", "high"),
    "output": ("push-pull", "contact"),
    "wants": ABILITIES,
    "bench": ("servo", "motor", "stepper", "switch", "sound", "ranger", "humidity", "count", "none"),
}
"""The allowed values of a key, or of the elements of its list."""


def _entry(device: Mapping[str, Json], path: str) -> _Entry:
    odd = next((key for key in device if key not in _KEYS and key not in _FINDERS), None)
    if odd is not None:
        raise _damaged(path, device, f"'{odd}' is not a key of a device{did_you_mean(odd, [*_KEYS, *_FINDERS])}")
    wrong = next((key for key, value in device.items() if not _is_right(key, value)), None)
    if wrong is not None or "kind" not in device or not any(device.get(key) for key in _FINDERS[:3]):
        what = (
            f"'{wrong}' has the value {device[wrong]!r}{_known_words(wrong, device[wrong])}"
            if wrong
            else "its kind or the keys that find it are missing"
        )
        raise _damaged(path, device, what)
    forbidden = Phrases((word, 0) for word in _texts(device, "not"))
    families = tuple(family.lower() for family in _texts(device, "families"))
    return _Entry(_facts(device), frozenset(_texts(device, "ids")), families, forbidden)


def _facts(device: Mapping[str, Json]) -> DeviceFacts:
    volts = [as_number(each) for each in as_list(device.get("volts", ()))]
    flags = {key: device[key] is True for key in _FLAGS if key in device}
    return DeviceFacts(
        kind=as_text(device["kind"]),
        volts=(volts[0], volts[1]) if volts else None,
        signal_volts=as_number(device["signal_volts"]) if "signal_volts" in device else None,
        peak_ma=as_whole(device.get("peak_ma", 0)),
        terminals=_texts(device, "terminals"),
        analog=_texts(device, "analog"),
        wants=_texts(device, "wants"),
        output=as_text(device.get("output", "")),
        i2c=tuple(as_whole(address) for address in as_list(device.get("i2c", ()))),
        rest=as_text(device.get("rest", "")),
        rest_when=_texts(device, "rest_when"),
        bench=as_text(device.get("bench", "")),
        **flags,
    )


"""Characters that stand for themselves in patterns of file names."""


def _texts(device: Mapping[str, Json], key: str) -> tuple[str, ...]:
    return tuple(as_texts(device.get(key, ())))


def _is_right(key: str, value: Json) -> bool:
    if key == "volts":
        numbers = [v for v in value if isinstance(v, (int, float))] if isinstance(value, list) else []
        return isinstance(value, list) and len(numbers) == len(value) == 2 and numbers[0] <= numbers[1]
    if key in _WORDS:
        listed = value if key == "wants" else [value]
        return isinstance(listed, list) and all(one in _WORDS[key] for one in listed)
    if key in _TYPES:
        return isinstance(value, _TYPES[key])
    if key == "rest_when" and (not isinstance(value, list) or len(value) != 3 or value[2] not in _WORDS["rest"]):
        return False
    kind = int if key == "i2c" else str
    return isinstance(value, list) and all(isinstance(v, kind) for v in value)


def _known_words(key: str, value: Json) -> str:
    """The message about a wrong value: the allowed ones, and the one that was probably meant."""
    if key not in _WORDS:
        return "; write two numbers, the lower one first" if key == "volts" else ""
    odd = next((str(one) for one in (value if isinstance(value, list) else [value]) if one not in _WORDS[key]), "")
    return f"{did_you_mean(odd.lower(), _WORDS[key])}; use one of: {', '.join(_WORDS[key])}"


_TABLES = {"device": list, "names": dict, "board": dict}
"""The tables that a file may contain."""
_BOARD = ("supply_ma",)


def _check_tables(table: Mapping[str, Json], path: str) -> None:
    """Refuse unknown tables and keys, which would be ignored silently."""
    fix = "the head of the built-in parts/electrical.toml explains the keys"
    for key, value in table.items():
        if key not in _TABLES:
            what = f"is not a table of this file{did_you_mean(key.lower(), _TABLES) or '; each device is a [[device]]'}"
        elif not isinstance(value, _TABLES[key]) or (
            isinstance(value, list) and not all(isinstance(entry, dict) for entry in value)
        ):
            what = f"must be [[{key}]]" if key == "device" else f"must be [{key}]"
        else:
            continue
        raise PlatformDataError(f"'{key}' {what}", location=Location(path, line_of_key(_text(path), key)), fix=fix)
    for key, names in as_table(table.get("names", {})).items():
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            raise PlatformDataError(f"'names.{key}' is not a list of texts", location=Location(path), fix=fix)
    for key in as_table(table.get("board", {})):
        if key not in _BOARD:
            raise PlatformDataError(f"'board.{key}' is not a key{did_you_mean(key, _BOARD)}", location=Location(path), fix=fix)


def _damaged(path: str, device: Mapping[str, Json], why: str) -> PlatformDataError:
    return PlatformDataError(
        f"an entry for '{device.get('kind', '')}' cannot be used: {why}",
        location=Location(path, line_of_value(_text(path), str(device.get("kind", "")))),
        fix="the head of the built-in parts/electrical.toml explains the keys",
    )


def _text(path: str) -> str:
    """The text of a file, to find a line in it; nothing where there is none."""
    try:
        return inputs.read_text(path, inputs.DATA)
    except (OSError, UnicodeDecodeError):
        return ""
