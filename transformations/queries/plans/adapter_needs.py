"""Which pieces of adapter files a program needs, sorted so that each piece comes after the pieces it depends on.

The result is the transitive closure of the `needs` that pieces declare. A name is looked up in the piece's own header first,
then in all headers; `servo.h/servo_set` names a piece of another header, `hal/Io` one of the hardware layer. A variant for a
microcontroller takes precedence over one for an architecture, and that one over one for all of them; a variant for records or
functions that the program uses, or for parts in its drawing, takes precedence over all three.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Protocol

from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.transformations.knowledge.adapters.adapter_files import HAL
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece


class Needed:
    """The pieces that a program needs on a microcontroller, and what cannot be served there.

    Attributes:
        pieces: sorted topologically: each piece comes after the pieces it depends on.
        unserved: (header, name) of each requested function that has no adapter on this microcontroller -> why not.
    """

    def __init__(self) -> None:
        self.pieces: list[AdapterPiece] = []
        self.unserved: dict[tuple[str, str], str] = {}


class PieceSource(Protocol):
    """Where pieces come from; `knowledge.adapters.adapter_index.AdapterIndex` is one."""

    @property
    def headers(self) -> Sequence[str]:
        """The headers that there are pieces for."""

    def of(self, header: str) -> Sequence[Sequence[AdapterPiece]]:
        """The pieces of a header, in groups of descending precedence: a piece hides those of its name in later groups."""


class AdapterPieces:
    """All pieces for a source platform on a target platform, read header by header as they are asked for.

    Args:
        source: the source of the pieces, or the pieces themselves.
        members: names of the members that the program uses of records that it does not declare.
        calls: names of the functions that the program calls and does not define.
        architecture: of the target's processor; without one, variants for architectures do not fit.
        drawn: the kinds of the parts on the board's pins, as the marker `drawn` has them.
    """

    def __init__(
        self,
        source: PieceSource | Iterable[AdapterPiece],
        members: Collection[str] = (),
        calls: Collection[str] = (),
        architecture: str = "",
        drawn: Collection[str] = (),
    ) -> None:
        self.members, self.calls, self.architecture = frozenset(members), frozenset(calls), architecture
        self.drawn = frozenset(drawn)
        self._source: PieceSource = _Listed(source) if isinstance(source, Iterable) else source
        self._known: dict[str, dict[str, list[list[AdapterPiece]]]] = {}

    def __iter__(self) -> Iterator[AdapterPiece]:
        return (p for header in self._source.headers for groups in self._of(header).values() for group in groups for p in group)

    def _of(self, header: str) -> dict[str, list[list[AdapterPiece]]]:
        """The pieces of a header by name; the variants of each name in the groups of `PieceSource.of`."""
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
        """The (header, name) of the piece that a name denotes when used in that header; None if there is no such piece."""
        if "/" in name:
            header, _, name = name.rpartition("/")
            # files of the user may name a piece of the hardware layer by the header that it once stood in
            return next(((place, name) for place in (header, HAL) if name in self._of(place)), None)
        if header and name in self._of(header):
            return header, name
        return next(((other, name) for other in self._source.headers if name in self._of(other)), None)

    def variant(self, key: tuple[str, str], mcu: str) -> AdapterPiece | None:
        """The variant of a piece that takes precedence on a microcontroller, None if no variant fits it and the program."""
        for group in self._of(key[0]).get(key[1], ()):
            if fitting := [piece for piece in group if self._fits(piece, mcu)]:
                return max(fitting, key=_precedence)
        return None

    def _fits(self, piece: AdapterPiece, mcu: str) -> bool:
        """Whether a variant's conditions (processor, members, calls, parts; empty ones always hold) fit the program."""
        return (
            (not piece.mcus or mcu in piece.mcus)
            and (not piece.architectures or self.architecture in piece.architectures)
            and (not piece.members or not self.members.isdisjoint(piece.members))
            and (not piece.beside or not self.calls.isdisjoint(piece.beside))
            and self.drawn.issuperset(piece.drawn)
        )

    def variants(self, key: tuple[str, str]) -> list[AdapterPiece]:
        """All variants of a piece in order of precedence."""
        return [piece for group in self._of(key[0]).get(key[1], ()) for piece in group]

    def needed(self, wanted: Iterable[tuple[str, str]], mcu: str) -> Needed:
        """The closure of the pieces that a program needs on a microcontroller, given the (header, name) pairs that it uses.

        Raises:
            PlatformDataError: a piece needs what is not there, or itself.
        """
        found = Needed()
        placed: set[tuple[str, str]] = set()
        for header, name in wanted:
            key = self.key(name, header)
            if key is None:
                found.unserved[header, name] = "no adapter exists"
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
        """Append a piece, after the pieces it depends on, to `chain`.

        Returns:
            Why the microcontroller cannot have it, an empty text if it can.
        """
        if key in chain:
            return ""
        piece = self.variant(key, mcu)
        if piece is None:
            return f"the {mcu} has no '{key[1]}'"
        if key in above:
            names = " -> ".join(name for _, name in [*above[above.index(key) :], key])
            raise PlatformDataError(
                f"adapters need each other: {names}", location=piece.location, fix="remove one of these needs"
            )
        for name in piece.needs:
            inner = self.key(name, piece.header)
            if inner is None:
                hint = did_you_mean(name, [*self._of(piece.header)])
                raise PlatformDataError(
                    f"'{piece.name}' needs '{name}', which does not exist{hint}", location=piece.location,
                    fix="correct its `needs`, or add the piece",
                )  # fmt: skip
            why = self._unserved(inner, mcu, chain, [*above, key])
            if why:
                return why
        chain[key] = piece
        return ""


def _precedence(piece: AdapterPiece) -> tuple[bool, int, bool, bool]:
    return bool(piece.members or piece.beside), len(piece.drawn), bool(piece.mcus), bool(piece.architectures)


class _Listed:
    """A `PieceSource` over a given collection of pieces, which all have the same precedence."""

    def __init__(self, pieces: Iterable[AdapterPiece]) -> None:
        self._pieces: dict[str, list[AdapterPiece]] = {}
        for piece in pieces:
            self._pieces.setdefault(piece.header, []).append(piece)

    @property
    def headers(self) -> Sequence[str]:
        return list(self._pieces)

    def of(self, header: str) -> Sequence[Sequence[AdapterPiece]]:
        return [self._pieces.get(header, [])]
