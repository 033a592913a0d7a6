"""What a component is, by what it and its connectors are called: kinds such as servo, ranger or infrared receiver.

The words are data (`parts/port_roles.toml`). Which port goes to which component is decided in `m2m.ports.port_binding`.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence, Set
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

from msgspec import Struct

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.metamodels import migration
from robosmi.project import read_data

_WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_INITIAL = re.compile(r"(?<=[a-z\d])[A-Z]\Z|(?<=[ _-])[A-Za-z]\Z|\A[A-Z](?=[ _-])")
_LOOKALIKE = frozenset(["LATIN", "CYRILLIC", "GREEK", "ARMENIAN", "CHEROKEE", "FULLWIDTH", "MATHEMATICAL"])
"""Alphabets with letters that look alike, by the first words of their letters' names in Unicode."""
EMPTY_WORDS = frozenset(
    ["port", "pin", "basic", "on", "of", "the", "to", "in", "out", "pulse", "signal", "sig", "read", "write", "board"]
)
"""Words that say nothing of a device."""
SENDS, RECEIVES = frozenset(["tx", "txd", "txo", "dout", "sout"]), frozenset(["rx", "rxd", "rxi", "din", "sin"])
"""Connectors by which a component sends to the board, and those by which it receives from it."""
AUDIBLE_HZ = range(20, 20_001)
"""What people hear."""
SERIAL = "serial device"
"""The kind of what has the connectors of a serial line."""


class PortWords(Struct, frozen=True):
    """The data.

    Attributes:
        roles: kind of component -> its words.
        apart: groups of words of which one excludes the others.
        connectors: purpose of a connector -> words, and what the board does there.
        vocabulary: the words of more than two letters, which others may be put together of.
        kinds: purpose of a connector -> the kind that a component is of, too, at such a connector.
        negations: words by which a title says what a component is not.
        audible, inaudible: the kinds that a tone is for which people hear, and one above.
        initials: letter that stands for a side alone at an end of a name -> the side.
    """

    roles: dict[str, frozenset[str]]
    apart: tuple[frozenset[str], ...]
    connectors: dict[str, tuple[frozenset[str], str]]
    vocabulary: frozenset[str]
    kinds: dict[str, str]
    negations: frozenset[str]
    audible: frozenset[str]
    inaudible: frozenset[str]
    initials: dict[str, str]


def kinds_of(connection: migration.Connection) -> set[str]:
    """The kinds that a component may be of, judged by the words of its names and by the connectors that are wired here."""
    theirs = significant_words(component_texts(connection))
    known = known_roles()
    kinds = {role for role, words in known.roles.items() if theirs & words}
    own = connector_words(c.name for c in connection.connectors)
    kinds |= {kind for purpose, kind in known.kinds.items() if own & known.connectors[purpose][0]}
    return kinds | ({SERIAL} if is_serial(connection) else set())


def kinds_of_part(connection: migration.Connection) -> set[str]:
    """The kinds that a component's part names, whatever the user calls it; all its kinds if the part names none.

    A "Standard servo" with the title "ping turret servo" is a servo.
    """
    component = connection.component
    words = significant_words([component.partTitle, component.family]) if component is not None else set()
    return {role for role, said in known_roles().roles.items() if words & said} or kinds_of(connection)


def is_serial(connection: migration.Connection) -> bool:
    """Whether a connector is one of a component's serial line."""
    component = connection.component
    every = [connector_words([c.name]) for c in component.connectors] if component is not None else []
    own = connector_words(c.name for c in connection.connectors)
    return any(w & SENDS for w in every) and any(w & RECEIVES for w in every) and bool(own & (SENDS | RECEIVES))


def significant_words(texts: Iterable[str]) -> set[str]:
    """The words of several names in lower case, without words that say nothing about the device."""
    vocabulary = known_roles().vocabulary
    return {word for text in texts for word in _words_of(text, vocabulary)}


def side_of(name: str) -> str:
    """The side that a letter alone at either end of a name stands for (servoL: left); empty if none does."""
    found = _INITIAL.search(name)
    return known_roles().initials.get(found[0].upper(), "") if found is not None else ""


def connector_words(texts: Iterable[str]) -> set[str]:
    """The words of connector and parameter names in lower case, single letters too; also each word without `pin` around it."""
    words = {word.lower() for text in texts for word in _WORDS.findall(str(text))}
    return words | {inner for word in words if (inner := word.removeprefix("pin").removesuffix("pin"))}


def _words_of(name: str, vocabulary: Set[str]) -> set[str]:
    """The words of one name (see `significant_words`)."""
    pieces = [(w.start(), w.group().lower()) for w in _WORDS.finditer(name)]
    words = {word for _, word in pieces if not word.isdigit() and len(word) > 1}
    # a trade name may have a capital inside: NeoPixel, XBee
    whole = {one + two for (at, one), (next_at, two) in pairwise(pieces) if next_at == at + len(one)} & vocabulary
    return ({part for word in words for part in _apart(word, vocabulary)} | whole) - EMPTY_WORDS


def _apart(word: str, vocabulary: Set[str]) -> Sequence[str]:
    """The known words that make up a compound (`pinbutton`, `redled`), else the word itself."""
    if word in vocabulary:
        return (word,)
    parts: dict[int, tuple[str, ...]] = {0: ()}
    for end in range(1, len(word) + 1):
        for start in sorted(parts):
            if start < end and word[start:end] in vocabulary:
                parts.setdefault(end, (*parts[start], word[start:end]))
    return parts.get(len(word), (word,))


def component_texts(connection: migration.Connection) -> list[str]:
    """What a component is called: by its title, its part's title, its family."""
    component = connection.component
    if component is None:
        return []
    return [component.title, component.partTitle, component.family]


def misleading_title(connection: migration.Connection) -> str:
    """Why the title of a component is no evidence; empty if it is.

    A letter of another alphabet looks like one of the word that it stands in, and is another; a letter without width is not seen.
    """
    title = str(connection.component.title) if connection.component is not None else ""
    if any(unicodedata.category(letter) == "Cf" for letter in title):
        return "its title has letters that are not visible"
    for word in (each for each in title.split() if not each[0].isdigit()):  # as in 10kΩ
        alphabets = {unicodedata.name(letter, "?").partition(" ")[0] for letter in word} & _LOOKALIKE
        if len(alphabets) > 1:
            return f"its title mixes letters of {' and '.join(sorted(alphabets))}"
    negated = known_roles().negations & {word.lower() for word in _WORDS.findall(title)}
    return f"its title says what it is not ('{min(negated)}')" if negated else ""


def tone_kinds(frequencies: Set[int | None]) -> frozenset[str]:
    """The kinds of components that tones of these frequencies (Hz, None if unknown) are for; empty if they disagree."""
    if frequencies and all(number in AUDIBLE_HZ for number in frequencies):
        return known_roles().audible
    if frequencies and all(number is not None and number >= AUDIBLE_HZ.stop for number in frequencies):
        return known_roles().inaudible
    return frozenset()


def known_roles() -> PortWords:
    """The words of kinds, sides and connectors."""
    path = resources.find("platform_repo", "parts/port_roles.toml")
    return _known_roles(path, path.stat().st_mtime_ns)


@lru_cache(maxsize=2)
def _known_roles(path: Path, _: int) -> PortWords:
    data = DataTable(path, read_data(path))
    said, purposes = data.table("roles"), data.table("connectors")
    roles = {role: frozenset(said.texts(role)) for role in said.values}
    apart = tuple(frozenset(each) for each in data.lists_of_texts("apart"))
    words = {"pin", "port", "sensor"}.union(*roles.values(), *apart)
    entries = {purpose: purposes.table(purpose) for purpose in purposes.values}
    connectors = {purpose: (frozenset(entry.texts("words")), entry.text("board")) for purpose, entry in entries.items()}
    kinds = {purpose: entry.text("kind") for purpose, entry in entries.items() if "kind" in entry.values}
    tones, initials = data.table("tones"), data.table("initials")
    return PortWords(
        roles, apart, connectors, frozenset(word for word in words if len(word) > 2), kinds, frozenset(data.texts("negations")),
        frozenset(tones.texts("audible")), frozenset(tones.texts("inaudible")),
        {letter: initials.text(letter) for letter in initials.values},
    )  # fmt: skip
