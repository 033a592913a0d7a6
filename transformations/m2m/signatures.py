"""Signatures for the target: a source function's signature with the widths it has on the source platform.

Adapters are called by code that was written for the source's widths (paper 3.4 copies signatures; copied as they are, a
32-bit argument would arrive cut to 16 bits on some targets). Values keep their width; pointers keep their type, since
they must fit what they point to. The table of types is data of the target platform.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence

from msgspec import Struct

from robosmi.transformations.queries.signature_text import declare
from robosmi.typed import matches

_QUALIFIERS = re.compile(r"\b(const|volatile|register|restrict|extern|static|inline)\b")


_WORDS = re.compile(r"[A-Za-z_]\w*")


class Signature(Struct, frozen=True):
    """A function's signature in parts.

    Attributes:
        name: its name.
        returns: type of its value as written.
        parameters: (type as written, name) in order; the name may be empty.
        variadic: whether it takes further arguments.
    """

    name: str
    returns: str
    parameters: Sequence[tuple[str, str]] = ()
    variadic: bool = False

    def named(self, reserved: Collection[str] = ()) -> Signature:
        """The same with a name for every parameter and no name twice; `void` as the only parameter is none.

        Args:
            reserved: names that no parameter may have.
        """
        taken: set[str] = {word for spelling, _ in self.parameters for word in matches(_WORDS, spelling)}
        named: list[tuple[str, str]] = []
        for number, (spelling, name) in enumerate(self.parameters, 1):
            if spelling.strip() == "void" and not name:
                continue
            own = name or f"argument{number}"
            while own in taken or own in reserved:
                own += "_"
            taken.add(own)
            named.append((spelling, own))
        return Signature(self.name, self.returns, tuple(named), self.variadic)

    def text(self) -> str:
        """The declarator: return type, name, parameters."""
        shown = [declare(spelling, name) for spelling, name in self.parameters] + (["..."] if self.variadic else [])
        return declare(self.returns, f"{self.name}({', '.join(shown)})")


def widened(spelling: str, widths: Mapping[str, str]) -> str:
    """The type that holds the same values on the target.

    Args:
        spelling: a type as written.
        widths: type of the source -> type of the target, for types by value.
    """
    if any(mark in spelling for mark in "*[(&"):
        return spelling
    plain = " ".join(_QUALIFIERS.sub(" ", spelling).split())
    mapped = widths.get(plain)
    if mapped is None:
        return spelling
    return f"const {mapped}" if re.search(r"\bconst\b", spelling) else mapped


def for_target(signature: Signature, widths: Mapping[str, str], reserved: Collection[str] = ()) -> Signature:
    """The signature with named parameters and the source's widths; no parameter is called by a reserved name."""
    named = signature.named(reserved)
    parameters = tuple((widened(spelling, widths), name) for spelling, name in named.parameters)
    return Signature(named.name, widened(named.returns, widths), parameters, named.variadic)
