"""Which pieces of adapter files a program needs, and in which order they stand: the closure of what the adapters declare.

Names are looked up in the piece's own header first, then among all; `servo.h/servo_set` names a piece of another header. A
variant for a microcontroller counts before one for all.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.adapter_files import AdapterPiece


@dataclass
class Needed:
    """What a program needs.

    Attributes:
        pieces: in an order in which each stands behind what it needs.
        unserved: (header, name) of what was asked for and cannot be served on this microcontroller -> why not.
    """

    pieces: list[AdapterPiece] = field(default_factory=list)
    unserved: dict[tuple[str, str], str] = field(default_factory=dict)


class AdapterPieces:
    """All pieces for a source platform on a target platform.

    Args:
        pieces: of all adapter files, those that count first in front.
    """

    def __init__(self, pieces: Iterable[AdapterPiece]) -> None:
        self._variants: dict[tuple[str, str], list[AdapterPiece]] = {}
        self._headers: dict[str, list[str]] = {}
        for piece in pieces:
            key = piece.header, piece.name
            self._variants.setdefault(key, []).append(piece)
            if piece.header not in self._headers.setdefault(piece.name, []):
                self._headers[piece.name].append(piece.header)

    def __iter__(self) -> Iterator[AdapterPiece]:
        return (piece for variants in self._variants.values() for piece in variants)

    def key(self, name: str, header: str = "") -> tuple[str, str] | None:
        """Header and name of the piece that a name means for a piece or a program of that header; None if there is none."""
        if "/" in name:
            header, name = name.split("/", 1)
            return (header, name) if (header, name) in self._variants else None
        headers = self._headers.get(name, [])
        if header in headers:
            return header, name
        return (headers[0], name) if headers else None

    def variant(self, key: tuple[str, str], mcu: str) -> AdapterPiece | None:
        """The variant of a piece for a microcontroller."""
        variants = self._variants.get(key, [])
        own = (piece for piece in variants if mcu in piece.mcus)
        return next(own, None) or next((piece for piece in variants if not piece.mcus), None)

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
                raise PlatformDataError(
                    f"'{piece.name}' needs '{name}', which is not there", location=piece.location, fix="correct its `needs`"
                )
            why = self._unserved(inner, mcu, chain, [*above, key])
            if why:
                return why
        chain[key] = piece
        return ""
