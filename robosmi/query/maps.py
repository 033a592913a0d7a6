"""The entries of EOL's maps, which keep their order and take any value as a key, 1, 1.0 and true side by side.

`Entries` is a Python mapping (so `m[k]`, `in`, `for`), with EOL's operations added; an absent key gives None only through
`get`. What gives the keys and the values as collections, `Map` and `Tuple` themselves, is in `collections`.
Source: EolMap and EolTuple of Epsilon.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, MutableMapping
from typing import Any, TypeVar

from robosmi.query.problems import unknown_property
from robosmi.query.values import equal, key

K = TypeVar("K")
V = TypeVar("V")


class Entries(MutableMapping[K, V]):
    """The entries of a `Map`, in the order of insertion, and the operations that give no collection.

    Args:
        entries: a mapping or pairs; of a key given twice the last value counts, at the place of the first.
    """

    __slots__ = ("_entries",)

    def __init__(self, entries: Mapping[K, V] | Iterable[tuple[K, V]] = ()) -> None:
        self._entries: dict[Any, tuple[K, V]] = {}
        for k, v in entries.items() if isinstance(entries, Mapping) else entries:
            self[k] = v

    def _repr_html_(self) -> str:
        from robosmi.model.elements.show import pairs_html  # for notebooks only

        return pairs_html(self)

    def __getitem__(self, k: K) -> V:
        place = self._entries.get(key(k))
        if place is None:
            raise KeyError(k)
        return place[1]

    def __setitem__(self, k: K, v: V) -> None:
        place = key(k)
        known = self._entries.get(place)
        self._entries[place] = (k if known is None else known[0], v)

    def __delitem__(self, k: K) -> None:
        if key(k) not in self._entries:
            raise KeyError(k)
        del self._entries[key(k)]

    def __contains__(self, k: object) -> bool:
        return key(k) in self._entries

    def __iter__(self) -> Iterator[K]:
        return (k for k, _ in self._entries.values())

    def __len__(self) -> int:
        return len(self._entries)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Entries):
            return equal(self, other)
        if isinstance(other, dict):
            return dict(self.items()) == other
        return NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({{{', '.join(f'{k!r}: {v!r}' for k, v in self._entries.values())}}})"

    def put(self, k: K, v: V) -> V | None:
        """Set the value of a key, and give the one it had or None."""
        former = self.get(k)
        self[k] = v
        return former

    def put_all(self, other: Mapping[K, V]) -> None:
        """Set all entries of another map."""
        self.update(other)

    def remove(self, k: K) -> V | None:
        """Remove a key, and give the value it had or None."""
        return self.pop(k, None)

    def contains_key(self, k: object) -> bool:
        """Whether there is an entry for the key; 1, 1.0 and true are three keys."""
        return k in self

    def contains_value(self, value: object) -> bool:
        """Whether an entry has the value."""
        return key(value) in {key(v) for _, v in self._entries.values()}

    def size(self) -> int:
        """How many entries there are."""
        return len(self._entries)

    def is_empty(self) -> bool:
        """Whether there is no entry."""
        return not self._entries


class Fields(Entries[str, Any]):
    """The entries of a `Tuple`, which are its attributes."""

    __slots__ = ()

    def __init__(self, fields: Mapping[str, Any] | Iterable[tuple[str, Any]] = (), **more: Any) -> None:
        super().__init__(fields)
        self.update(more)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self.field(name)

    def field(self, name: str) -> Any:
        """A field by name, also one whose name is an operation of maps.

        Raises:
            UnknownPropertyError: there is none of that name.
        """
        if name not in self:
            raise unknown_property("the Tuple", name, self)
        return self[name]

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "_entries":
            object.__setattr__(self, name, value)
        else:
            self[name] = value
