"""Which pieces of adapter files a program needs, and in which order they stand: the closure of what the adapters declare.

Names are looked up in the piece's own header first, then among all; `servo.h/servo_set` names a piece of another header. A
variant for a microcontroller counts before one for all, one for what the program uses or calls before that.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Protocol

from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.transformations.knowledge.adapter_files import AdapterPiece


class Needed:
    """What a program needs.

    Attributes:
        pieces: in an order in which each stands behind what it needs.
        unserved: (header, name) of what was asked for and cannot be served on this microcontroller -> why not.
    """

    def __init__(self) -> None:
        self.pieces: list[AdapterPiece] = []
        self.unserved: dict[tuple[str, str], str] = {}


class PieceSource(Protocol):
    """Where pieces come from; `knowledge.adapter_index.AdapterIndex` is one."""

    @property
    def headers(self) -> Sequence[str]:
        """The headers that there are pieces for."""

    def of(self, header: str) -> Sequence[Sequence[AdapterPiece]]:
        """The pieces for a header, in groups: one of an earlier group counts before those of later ones."""


class AdapterPieces:
    """All pieces for a source platform on a target platform, read header by header.

    Args:
        source: where they come from, or the pieces themselves.
        members: of records that the program does not declare, which it uses by name.
        calls: the functions that the program calls and does not define.
    """

    def __init__(
        self, source: PieceSource | Iterable[AdapterPiece], members: Collection[str] = (), calls: Collection[str] = ()
    ) -> None:
        self.members, self.calls = frozenset(members), frozenset(calls)
        self._source: PieceSource = _Listed(source) if isinstance(source, Iterable) else source
        self._known: dict[str, dict[str, list[list[AdapterPiece]]]] = {}

    def __iter__(self) -> Iterator[AdapterPiece]:
        return (p for header in self._source.headers for groups in self._of(header).values() for group in groups for p in group)

    def _of(self, header: str) -> dict[str, list[list[AdapterPiece]]]:
        """The pieces of a header by name, group by group."""
        known = self._known.get(header)
        if known is None:
            known = self._known[header] = {}
            for number, group in enumerate(self._source.of(header)):
                for piece in group:
                    groups = known.setdefault(piece.name, [])
                    groups += [[] for _ in range(number + 1 - len(groups))]
                    groups[number].append(piece)
        return known

    def key(self, name: str, header: str = "") -> tuple[str, str] | None:
        """Header and name of the piece that a name means for a piece or a program of that header; None if there is none."""
        if "/" in name:
            header, _, name = name.rpartition("/")
            return (header, name) if name in self._of(header) else None
        if header and name in self._of(header):
            return header, name
        return next(((other, name) for other in self._source.headers if name in self._of(other)), None)

    def variant(self, key: tuple[str, str], mcu: str) -> AdapterPiece | None:
        """The variant of a piece for a microcontroller."""
        for group in self._of(key[0]).get(key[1], ()):
            if fitting := [piece for piece in group if self._fits(piece, mcu)]:
                return max(fitting, key=lambda piece: (bool(piece.members or piece.beside), bool(piece.mcus)))
        return None

    def _fits(self, piece: AdapterPiece, mcu: str) -> bool:
        """Whether a variant is for a microcontroller and for the program."""
        wanted = ((piece.members, self.members), (piece.beside, self.calls), (piece.mcus, {mcu}))
        return all(not names or not there.isdisjoint(names) for names, there in wanted)

    def variants(self, key: tuple[str, str]) -> list[AdapterPiece]:
        """All variants of a piece, those that count first in front."""
        return [piece for group in self._of(key[0]).get(key[1], ()) for piece in group]

    def needed(self, wanted: Iterable[tuple[str, str]], mcu: str) -> Needed:
        """What a program that uses these (header, name) needs on a microcontroller.

        Raises:
            PlatformDataError: a piece needs what is not there, or itself.
        """
        found = Needed()
        placed: set[tuple[str, str]] = set()
        for header, name in wanted:
            key = self.key(name, header)
            if key is None:
                found.unserved[header, name] = "there is no adapter for it"
                continue
            chain: dict[tuple[str, str], AdapterPiece] = {}
            why = self._unserved(key, mcu, chain, [])
            if why:
                found.unserved[header, name] = why
                continue
            for each, piece in chain.items():
                if each not in placed:
                    placed.add(each)
                    found.pieces.append(piece)
        return found

    def _unserved(
        self, key: tuple[str, str], mcu: str, chain: dict[tuple[str, str], AdapterPiece], above: list[tuple[str, str]]
    ) -> str:
        """Put a piece, behind what it needs, into the chain; what is not there for the microcontroller, else an empty text."""
        if key in chain:
            return ""
        piece = self.variant(key, mcu)
        if piece is None:
            return f"'{key[1]}' is not there for the {mcu}"
        if key in above:
            names = " -> ".join(name for _, name in [*above[above.index(key) :], key])
            raise PlatformDataError(f"adapters need each other: {names}", location=piece.location, fix="cut the circle")
        for name in piece.needs:
            inner = self.key(name, piece.header)
            if inner is None:
                hint = did_you_mean(name, [*self._of(piece.header)])
                raise PlatformDataError(
                    f"'{piece.name}' needs '{name}', which is not there{hint}", location=piece.location,
                    fix="correct its `needs`, or add the piece",
                )  # fmt: skip
            why = self._unserved(inner, mcu, chain, [*above, key])
            if why:
                return why
        chain[key] = piece
        return ""


class _Listed:
    """Pieces as they are given."""

    def __init__(self, pieces: Iterable[AdapterPiece]) -> None:
        self._pieces: dict[str, list[AdapterPiece]] = {}
        for piece in pieces:
            self._pieces.setdefault(piece.header, []).append(piece)

    @property
    def headers(self) -> Sequence[str]:
        return list(self._pieces)

    def of(self, header: str) -> Sequence[Sequence[AdapterPiece]]:
        return [self._pieces.get(header, [])]
