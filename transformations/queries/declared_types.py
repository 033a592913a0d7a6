"""How many bytes the types take that pieces of adapters and placeholders declare: structures of numbers, pointers and arrays.

A text that has more in it (base classes, members of a class that is not in the texts) gives no size. Methods take no room.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from robosmi.metamodels import migration
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.plan_adapters import emitted

_RECORD = re.compile(r"struct (?P<name>\w+) \{(?P<members>.*?)\} ?;", re.DOTALL)
_OTHER_NAME = re.compile(r"typedef (?:struct )?(?P<type>\w+) (?P<name>\w+) ?;")
_METHOD = re.compile(r"[^;{}]*\([^;{}]*\)[^;{}]*(?:\{[^{}]*\}|;)")
_MEMBER = re.compile(r"(?:(?:volatile|const|struct) )*(?P<type>(?:(?:unsigned|signed|long|short) )*\w+) (?P<rest>.+)")
_FIXED = re.compile(r"u?int(8|16|32|64)_t")
_DIMENSION = re.compile(r"\[ ?(\d+) ?\]")
_NOTHING = 1
"""Bytes of a structure without members."""


def declared_types(plan: migration.MigrationPlan, plain: Mapping[str, int], pointer: int) -> dict[str, int]:
    """The types that the texts of a plan's pieces and placeholders declare, with their bytes where the texts tell.

    Args:
        plan: the plan.
        plain: bytes of the types of the language.
        pointer: bytes of a pointer.
    """
    texts = [str(piece.text) for piece in emitted(plan)] + [str(use.placeholder or "") for use in plan.symbolUses]
    return sizes_in(texts, plain, pointer)


def sizes_in(texts: Iterable[str], plain: Mapping[str, int], pointer: int) -> dict[str, int]:
    """The structures and other names of types that texts declare, each text after those that it needs, with their bytes."""
    found: dict[str, int] = {}
    for text in texts:
        if "struct" not in text and "typedef" not in text:
            continue
        bare = " ".join(word for kind, *_, word in tokens(text.encode()) if kind != "comment")
        for record in _RECORD.finditer(bare):
            size = _record(_METHOD.sub("", record["members"]), {**plain, **found}, pointer)
            if size is not None:
                found[record["name"]] = size
        for other in _OTHER_NAME.finditer(bare):
            size = _plain(other["type"], {**plain, **found})
            if size is not None:
                found[other["name"]] = size
    return found


def _record(members: str, known: Mapping[str, int], pointer: int) -> int | None:
    total = 0
    for text in (each.strip() for each in members.split(";")):
        if not text:
            continue
        member = _MEMBER.fullmatch(text)
        if member is None or ":" in text:
            return None
        for declarator in member["rest"].split(","):
            one = pointer if "*" in declarator else _plain(member["type"], known)
            if one is None:
                return None
            for count in _DIMENSION.findall(declarator):
                one *= int(count)
            if declarator.count("[") != len(_DIMENSION.findall(declarator)):
                return None
            total += one
    return total or _NOTHING


def _plain(name: str, known: Mapping[str, int]) -> int | None:
    fixed = _FIXED.fullmatch(name)
    return int(fixed[1]) // 8 if fixed is not None else known.get(name)
