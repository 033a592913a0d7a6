"""Signatures for the target: a source function's signature with the widths its types have on the source platform.

Adapters are called by code written for the source's widths; with the signatures copied as they are (paper 3.4), a 32-bit
argument would be truncated to 16 bits on some targets. Types by value keep their width; pointer types stay, since they must fit
what they point to. The table of types is data of the target platform.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence

from msgspec import Struct

from robosmi.transformations.queries.signature_text import declare

_QUALIFIERS = re.compile(r"\b(const|volatile|register|restrict|extern|static|inline)\b")


_CONST = re.compile(r"\bconst\b")
_WORDS = re.compile(r"[A-Za-z_]\w*")


class Signature(Struct, frozen=True):
    """A function's signature in parts.

    Attributes:
        name: the function's name.
        returns: the return type as written.
        parameters: (type as written, name) in order; the name may be empty.
        variadic: whether it takes further arguments.
    """

    name: str
    returns: str
    parameters: Sequence[tuple[str, str]] = ()
    variadic: bool = False

    def named(self, reserved: Collection[str] = ()) -> Signature:
        """The signature with a unique name for every parameter, and without the parameter list `(void)`.

        Args:
            reserved: names that no parameter may have.
        """
        taken: set[str] = {word for spelling, _ in self.parameters for word in _WORDS.findall(spelling)}
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
        """The function's declarator as C text: return type, name, parameters."""
        shown = [declare(spelling, name) for spelling, name in self.parameters] + (["..."] if self.variadic else [])
        return declare(self.returns, f"{self.name}({', '.join(shown)})")


def widened(spelling: str, widths: Mapping[str, str]) -> str:
    """The type of the target that holds the values which a type has on the source.

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
    return f"const {mapped}" if _CONST.search(spelling) else mapped


def for_target(signature: Signature, widths: Mapping[str, str], reserved: Collection[str] = ()) -> Signature:
    """The signature for the target: all parameters named, types by value with the source's widths.

    Args:
        signature: the signature on the source.
        widths: type of the source -> type of the target, for types by value.
        reserved: names that no parameter may have.
    """
    named = signature.named(reserved)
    parameters = tuple((widened(spelling, widths), name) for spelling, name in named.parameters)
    return Signature(named.name, widened(named.returns, widths), parameters, named.variadic)
