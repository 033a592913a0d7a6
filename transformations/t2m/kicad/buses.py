"""Buses of a KiCad sheet: the names of their members, and which members are joined where a bus enters a sheet.

A bus is named by the labels on its lines: a vector (`D[0..7]`), a group (`{SCL SDA}`, `USB{DP DM}` with the member `USB.DP`),
or one of these with an alias for several members (`bus_alias`). Nets join a bus by the names of its members. Where a bus has
two names, members of equal names are joined, and members of different names by position, as in KiCad's own netlist.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

_VECTOR = re.compile(r"(.*)\[([0-9]{1,4})\.\.([0-9]{1,4})\](.*)")
_GROUP = re.compile(r"([^{}]*)\{(.*)\}")
_ESCAPES = frozenset(("slash", "backslash", "space", "tab", "return", "colon", "brace", "lt", "gt", "quote", "dblquote", "bar"))
_MOST_MEMBERS = 1_000
_DEEPEST = 5

Aliases = Mapping[str, Sequence[str]]
"""Alias of several members of a bus -> their names."""


def members(text: str, aliases: Aliases | None = None) -> list[str]:
    """The names of a bus's members, a thousand at most; none for a name that is no bus.

    >>> members("D[0..2]"), members("USB{DP DM}"), members("{OE A[0..1]}"), members("I{slash}O")
    (['D0', 'D1', 'D2'], ['USB.DP', 'USB.DM'], ['OE', 'A0', 'A1'], [])
    """
    return [name for name, _ in zip(_members(text, aliases or {}, _DEEPEST), range(_MOST_MEMBERS), strict=False)]


def _members(text: str, aliases: Aliases, depth: int) -> Iterator[str]:
    group = _GROUP.fullmatch(text)
    if group is not None and group[2] not in _ESCAPES and depth:
        prefix = f"{group[1]}." if group[1] else ""
        for member in (listed for word in group[2].split() for listed in aliases.get(word, (word,))):
            inner = [*_members(member, aliases, depth - 1)]
            yield from (f"{prefix}{name}" for name in inner or [member])
        return
    found = _VECTOR.fullmatch(text)
    if found is not None:
        first, last = sorted((int(found[2]), int(found[3])))  # as KiCad counts, whichever way it is written
        for number in range(first, last + 1):
            yield f"{found[1]}{number}{found[4]}"


def pairs(one: Sequence[str], other: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The pairs of members that two names of one bus join: those of equal name, else those at equal positions."""
    shared = {*one} & {*other}
    if shared:
        yield from ((name, name) for name in one if name in shared)
    else:
        yield from zip(one, other, strict=False)
