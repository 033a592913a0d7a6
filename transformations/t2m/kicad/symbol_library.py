"""Symbol libraries of KiCad 5 and before (`-cache.lib`, `.lib`), read from the folder of a schematic without symbols."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from robosmi.transformations.t2m.companions import DrawingFolder
from robosmi.transformations.t2m.kicad.sheet import LibraryPin, LibrarySymbol, Point

_HEAD = "EESchema-LIBRARY"
_KINDS = {"W": "power_in", "w": "power_out"}


def library_of(folder: DrawingFolder, identities: Iterable[str]) -> dict[str, LibrarySymbol]:
    """The library symbols that a schematic uses, by the names that it uses for them.

    KiCad's own cache (`NAME-cache.lib`) is read first, then what was rescued (`NAME-rescue.lib`), then libraries of the names
    that stand before the symbols' (`LIBRARY.lib`), each where it lies beside the schematic.

    Args:
        folder: the folder of the schematic.
        identities: what the schematic calls its symbols.
    """
    wanted = list(dict.fromkeys(identities))
    stem = folder.path.stem
    others = list(dict.fromkeys(f"{identity.partition(':')[0]}.lib" for identity in wanted if ":" in identity))
    caches = list(dict.fromkeys((f"{stem}-cache.lib", *_caches(folder.path.parent), f"{stem}-rescue.lib", f"{stem}.lib")))
    found: dict[str, LibrarySymbol] = {}
    for name in (*caches, *others):
        missing = [identity for identity in wanted if identity not in found]
        data = folder.read(name) if missing else None
        if data is not None:
            listed = parsed(data.decode("utf-8", "replace"))
            found.update({i: symbol for i in missing if (symbol := _named(listed, i)) is not None})
    return found


def _caches(folder: Path) -> list[str]:
    """Caches of other schematics in the folder: the symbols of a sub-sheet are in the cache of the top schematic."""
    try:
        return sorted(path.name for path in folder.glob("*-cache.lib"))
    except OSError:
        return []


def parsed(text: str) -> dict[str, LibrarySymbol]:
    """The symbols of a library, by name and by alias; other entries are skipped."""
    found: dict[str, LibrarySymbol] = {}
    if not text.startswith(_HEAD):
        return found
    name, power = "", False
    aliases: list[str] = []
    pins: list[LibraryPin] = []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["DEF"] and len(words) > 1:
            name, power, aliases, pins = words[1].lstrip("~"), len(words) > 9 and words[9] == "P", [], []
        elif words[:1] == ["ALIAS"]:
            aliases = words[1:]
        elif words[:1] == ["X"] and (pin := _pin(words)) is not None:
            pins.append(pin)
        elif words[:1] == ["ENDDEF"] and name:
            for one in (name, *aliases):
                found[one] = LibrarySymbol(one, power, pins=tuple(pins))
            name = ""
    return found


def _pin(words: list[str]) -> LibraryPin | None:
    """X name number x y length orientation size size unit style kind [shape]."""
    if len(words) < 12:
        return None
    try:
        x, y, unit, style = (int(words[index]) for index in (3, 4, 9, 10))
    except ValueError:
        return None
    hidden = len(words) > 12 and words[12].startswith("N")
    name = "" if words[1] == "~" else words[1]
    return LibraryPin(words[2], name, _KINDS.get(words[11], "other"), Point(x, -y), unit, style, hidden)


def _named(listed: Mapping[str, LibrarySymbol], identity: str) -> LibrarySymbol | None:
    short = identity.partition(":")[2] or identity
    return next((listed[name] for name in (identity.replace(":", "_"), identity, short) if name in listed), None)
