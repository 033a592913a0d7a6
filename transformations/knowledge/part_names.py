"""What the names of parts imply: names of connectors, families that only connect, ids that a drawing tool generates.

Reads `parts/names.toml` of the platform repository, the user's folders first. It is read for every drawing and so is kept
small; the rules for roles, which only unknown parts need, are in `part_roles`. The search for phrases in a text is here, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.base.data_text import Json, data_toml
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.resources import folders
from robosmi.transformations.knowledge.wildcards import fits

_LISTS = ("supply", "ground", "idle", "polarity", "control", "bus", "write", "read", "read_chip", "write_chip")
_WORD = re.compile(r"[^\W_]+")
_LONGEST = 4
_SHORT_NAME = 2
_LONGEST_PHRASE = 40
_LONGEST_TEXT = 400  # letters: a title is short, whatever a damaged file says
_OHMS = re.compile(r"\d+(?:[.,]\d+)?\s*(?:[kKM]\d*\s*(?:[oO]hms?|[\u03a9\u2126R])?|[oO]hms?|[\u03a9\u2126R]\d*)")
_LETTERS = re.compile(r"[a-z]+")
_BETWEEN_NAMES = re.compile(r"[/_ ]")
_NUMBERED = re.compile(r"(?:pin|leg|connector|p\$|p|contact)?[ _-]?\d+", re.IGNORECASE)


class Phrases:
    """Words and phrases to look for in texts; a `*` at the end of one means "begins so".

    What stands between two words does not count, nor does letter case: `hc sr04` is found in `HC-SR04`. Each phrase bears
    the number it was given with; the smallest number found wins.
    """

    def __init__(self, phrases: Iterable[tuple[str, int]]) -> None:
        self._whole: dict[str, list[int]] = {}
        self._begin: dict[str, list[int]] = {}
        for phrase, number in phrases:
            words = " ".join(_WORD.findall(phrase.lower()))
            (self._begin if phrase.endswith("*") else self._whole).setdefault(words, []).append(number)

    def found(self, text: str) -> Iterator[tuple[int, str]]:
        """The numbers of all phrases in a text, each with the words that fit, in no order."""
        for words in _runs(text):
            for number in self._whole.get(words, ()):
                yield number, words
            for length in range(2, min(len(words), _LONGEST_PHRASE) + 1):
                for number in self._begin.get(words[:length], ()):
                    yield number, words

    def __contains__(self, text: str) -> bool:
        return next(self.found(text), None) is not None


def _runs(text: str) -> Iterator[str]:
    words = _WORD.findall(text[:_LONGEST_TEXT].lower())
    for first in range(len(words)):
        for last in range(first + 1, min(first + _LONGEST, len(words)) + 1):
            yield " ".join(words[first:last])


class JoinedPins(Struct, frozen=True):
    """The names of symbols whose parts connect pins inside, which pins (by number or name), and how many (0: any number)."""

    called: tuple[str, ...]
    groups: tuple[tuple[str, ...], ...]
    pins: int


class ConditionalSignal(Struct, frozen=True):
    """Connector names that are signals on a part that also has all names of one of these groups."""

    names: frozenset[str]
    beside: tuple[frozenset[str], ...]


class GeneratedShape(Struct, frozen=True):
    """Parts that a drawing tool generates: title and family, what their ids begin with or contain, and the tool if it is one."""

    title: str
    family: str
    prefixes: tuple[str, ...]
    contains: tuple[str, ...]
    tool: str


class PartNames(Struct, frozen=True):
    """The content of `names.toml`: sets of connector names in lower case, phrases for families, shapes of made-up ids."""

    names: Mapping[str, frozenset[str]]
    bus_only: Phrases
    either: Phrases
    read_on_analog: Phrases
    not_read_on_analog: Phrases
    numbered_labels: Phrases
    not_numbered_labels: Phrases
    positional: Phrases
    not_positional: Phrases
    device_properties: frozenset[str] = frozenset()
    number_properties: frozenset[str] = frozenset()
    transistors: tuple[str, ...] = ()
    transistor_numbers: tuple[str, ...] = ()
    headers: tuple[str, ...] = ()
    header_families: tuple[str, ...] = ()
    solder_jumpers: tuple[str, ...] = ()
    test_points: tuple[str, ...] = ()
    programmers: tuple[str, ...] = ()
    symbols: Mapping[str, tuple[str, ...]] = {}
    joined: tuple[JoinedPins, ...] = ()
    signals: tuple[ConditionalSignal, ...] = ()
    generated: tuple[GeneratedShape, ...] = ()


def names(project: Path | None = None) -> PartNames:
    """The lists for names; the first file in search order counts as a whole.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: the file is damaged or missing.
    """
    for folder in folders("platform_repo", project):
        path = folder / "parts" / "names.toml"
        if path.is_file():
            return _names(str(path), path.stat().st_mtime_ns)
    raise PlatformDataError("the platform repository has no parts/names.toml", fix="install robosmi again")


def connector_kind(name: str, known: PartNames) -> str:
    """What a connector carries by its name: supply, ground, unknown for a name that says nothing, else signal."""
    word = name.strip().lower()
    for kind in ("supply", "ground"):
        if word in known.names[kind]:
            return kind
    return "unknown" if word in known.names["idle"] or _NUMBERED.fullmatch(word) else "signal"


def rail_named(net: str, known: PartNames) -> str:
    """The kind of rail (supply, ground) that the name of a net says, or an empty text.

    Names of one or two letters say nothing: `G` may be a segment of a display, `VS` a signal.
    """
    kind, name = connector_kind(net, known), net.strip().strip("+-")
    telling = len(name) > _SHORT_NAME or any(letter.isdigit() for letter in name)
    return kind if kind in ("supply", "ground") and telling else ""


def conditional_signals(of_part: Iterable[str], known: PartNames) -> frozenset[str]:
    """The names, in lower case, that are signals on a part with these connectors, whatever they are elsewhere.

    The `G` of a transistor is its gate, that of a display a segment; `+` and `-` of an amplifier are its inputs.
    """
    words = {name.strip().lower() for name in of_part}
    return frozenset().union(
        *(entry.names & words for entry in known.signals if any(group <= words for group in entry.beside))
    )  # fmt: skip


def controls_supply(name: str, known: PartNames) -> bool:
    """Whether the name of a supply connector denotes a control or status signal (`EN`, `~{CHRG}`) instead of a terminal."""
    return name.strip().lower().strip("~{}!/") in known.names["control"]


def passive_named(text: str, known: PartNames) -> str:
    """The kind of a passive part identified only by a reference or a value (`R1`, `C_filter`, `220 ohm`), or an empty text."""
    if _OHMS.fullmatch(text.strip()):
        return "Resistor"
    letters = _LETTERS.match(text.strip().lower())
    word = letters[0] if letters is not None else ""
    return next((means for means, called in known.symbols.items() if any(fits(word, c) for c in called)), "") if word else ""


def name_direction(name: str, known: PartNames, chip: bool = False) -> str | None:
    """The direction that a connector's name implies (bus, write, read), or None.

    Args:
        name: the connector's name.
        known: the lists.
        chip: whether it is a connector of a driver or chip, whose inputs and outputs bear other names.
    """
    word = name.strip().lower()
    if not known.names["bus"].isdisjoint(_BETWEEN_NAMES.split(word)):  # SDI/SDA, RX_5V
        return "bus"
    for way in ("write", "read"):
        if word in known.names[way] or (chip and word in known.names[f"{way}_chip"]):
            return way
    return None


def conducts_by_bus_only(family: str, known: PartNames, title: str = "") -> bool:
    """Whether parts join connectors only where a bus says so (breadboards, headers, terminals).

    Args:
        family: their family.
        known: the lists.
        title: their title, which says it where the drawing tool has no families.
    """
    if not family.strip():
        return bool(title) and title in known.bus_only
    return any(f"{family}{end}" in known.bus_only for end in ("", "s")) or _singular(family) in known.bus_only


def _singular(text: str) -> str:
    return " ".join(word.removesuffix("s") for word in text.lower().split())


def read_toml(path: Path | str) -> dict[str, Json]:
    """A TOML file of the platform repository.

    Raises:
        PlatformDataError: it cannot be read, or is not TOML; with its place in the file.
    """
    try:
        text = inputs.read_text(path, inputs.DATA)
    except (OSError, UnicodeDecodeError) as error:
        raise PlatformDataError(
            f"cannot be read: {error}", location=Location(str(path)), fix="correct or remove the file"
        ) from error
    return parse_toml(text, str(path), 1)


def parse_toml(text: str, path: str, first_line: int) -> dict[str, Json]:
    """A piece of a TOML file that begins at that line.

    Raises:
        PlatformDataError: it is not TOML; with its place in the whole file.
    """
    try:
        return data_toml(text)
    except ValueError as error:
        at = re.search(r"at line (\d+), column (\d+)", str(error))
        line, column = (int(at[1]) + first_line - 1, int(at[2])) if at else (first_line, None)
        cause = str(error).partition(" (at ")[0]
        place = Location(path, line, column)
        raise PlatformDataError(f"not valid TOML: {cause}", location=place, fix="correct the entry") from error


@cache
def _names(path: str, changed: int) -> PartNames:  # `changed` keys the cache
    table = DataTable(Path(path), read_toml(path))
    either, boards, drawn, servos = (table.table(key, needed=False) for key in ("either", "boards", "drawn", "positional_servos"))
    symbols, lists = drawn.table("symbols", needed=False), table.table("names", needed=False)
    return PartNames(
        {key: frozenset(lists.texts(key, ())) for key in _LISTS},
        bus_only=_phrases(table.table("walk", needed=False).texts("bus_only", ())),
        either=_phrases(either.texts("words", ())),
        read_on_analog=_phrases(either.texts("read_on_analog", ())),
        not_read_on_analog=_phrases(either.texts("not_read_on_analog", ())),
        numbered_labels=_phrases(boards.texts("arduino_labels", ())),
        not_numbered_labels=_phrases(boards.texts("not_arduino_labels", ())),
        positional=_phrases(servos.texts("words", ())),
        not_positional=_phrases(servos.texts("not", ())),
        device_properties=frozenset(drawn.texts("device", ())),
        number_properties=frozenset(drawn.texts("number", ())),
        transistors=drawn.texts("transistors", ()),
        transistor_numbers=drawn.texts("transistor_numbers", ()),
        headers=drawn.texts("headers", ()),
        header_families=drawn.texts("header_families", ()),
        solder_jumpers=drawn.texts("solder_jumpers", ()),
        programmers=drawn.texts("programmers", ()),
        test_points=drawn.texts("test_points", ()),
        symbols={means: symbols.texts(means) for means in symbols.values},
        joined=tuple(
            JoinedPins(entry.texts("called"), entry.lists_of_texts("joined"), entry.optional_number("pins") or 0)
            for entry in drawn.tables("joined", needed=False)
        ),
        signals=tuple(
            ConditionalSignal(
                frozenset(entry.texts("names")), tuple(frozenset(group) for group in entry.lists_of_texts("beside"))
            )
            for entry in drawn.tables("signals", needed=False)
        ),
        generated=tuple(
            GeneratedShape(
                shape.text("title"),
                shape.text("family"),
                shape.texts("prefixes", ()),
                shape.texts("contains", ()),
                shape.text("tool", ""),
            )
            for shape in table.tables("generated", needed=False)
        ),
    )


def _phrases(words: Iterable[str]) -> Phrases:
    return Phrases((word, 0) for word in words)
