"""What a Flock migration is made of: retypings, deletions, and rules for the elements of a type."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

if TYPE_CHECKING:
    from robosmi.base.functions import Function as AnyFunction


class Mapping(Struct, eq=False):
    """A retyping or deletion, of a type or of a package.

    Attributes:
        what: as a message names it, "retype Book to Novel".
        original: the type, or the package.
        package: whether it is a package.
        evolved: the new type or package, None for a deletion.
        when: for which elements, or None for all.
        strict: whether subtypes are left alone.
        cascade: whether what deleted elements contain is deleted too.
    """

    what: str
    original: str
    package: bool = False
    evolved: str | None = None
    when: AnyFunction | None = None
    strict: bool = False
    cascade: bool = False


class MigrateRule(Struct, eq=False):
    """A rule for the elements of a type.

    Attributes:
        original: the type.
        ignoring: features that are not copied.
        when: for which elements, or None for all.
        strict: whether subtypes are left alone.
        body: what to do with (original, migrated), or None for nothing.
    """

    original: str
    ignoring: tuple[str, ...] = ()
    when: AnyFunction | None = None
    strict: bool = False
    body: AnyFunction | None = None


def left_out_text(left_out: dict[str, int]) -> str:
    """A sentence about elements that a migration left out.

    >>> left_out_text({"p::Gone": 2, "p::Old": 1})
    'elements are left out since the new metamodel has no such type that can have elements: 2 of p::Gone, 1 of p::Old'
    """
    listed = ", ".join(f"{number} of {name}" for name, number in left_out.items())
    return f"elements are left out since the new metamodel has no such type that can have elements: {listed}"


def left_out_fix(left_out: dict[str, int]) -> str:
    """What the author of the migration does about them."""
    name = next(iter(left_out))
    return f'write what becomes of them: retype("{name}", NEW), delete("{name}") or a rule'
