"""The sizes in bytes of declared types on the source and on the target, and the contents of string literals.

Sizes follow from the platforms' models: widths of int, long, double and pointers, types that keep the width of the source. On a
processor that reads bytes, members of structures have no gaps between them. Sizes of expressions are not computed here.

Adapters and placeholders declare types, too: structures of numbers, pointers and arrays, read from their texts. A text that has
more in it (base classes, members of a class that is not in the texts) gives no size. Methods take no room.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from robosmi.metamodels import ccode, migration, platform
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.initialisers import record_of
from robosmi.transformations.queries.plans.plan import platform_of
from robosmi.transformations.queries.plans.plan_adapters import emitted

_DIMENSION = re.compile(r"\[([^\[\]]*)\]")
_QUALIFIERS = re.compile(r"\b(?:const|volatile|register|restrict|extern|static|struct|union|enum|_Bool)\b")
_ESCAPE = re.compile(r"\\(?:x[0-9A-Fa-f]+|[0-7]{1,3}|.)", re.DOTALL)
_TEXT = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_OCTET = 8
_READS_WORDS = 32
"""Width of int from which on a processor reads words and aligns values to multiples of their size."""
_LONG_DOUBLE = 8
"""Least size of GCC's long double on a word processor, even if double has 4 bytes; elsewhere it equals double."""
_FIXED = {
    "char": 1, "signed char": 1, "unsigned char": 1, "bool": 1, "short": 2, "unsigned short": 2, "short int": 2, "float": 4,
    "long long": 8, "unsigned long long": 8, "long long int": 8,
}  # fmt: skip
"""Bytes of the types that have one size on all supported platforms."""


class TypeSizes:
    """Sizes of types on a platform.

    Args:
        model: the platform.
        integer: bytes of types written `int` if they are replaced by another width, 0 for the platform's own.
        aligned: greatest alignment in bytes (the word that the processor reads); 1 for no gaps between members.

    Attributes:
        plain: name of a type of the language -> its bytes.
        pointer: bytes of a pointer.
        declared: name of a type that the program does not declare itself -> its bytes.
    """

    def __init__(self, model: platform.Platform, integer: int = 0, aligned: int = 1) -> None:
        self.pointer = int(model.pointerBits) // _OCTET
        self.aligned = aligned
        self._integer = int(model.intBits) // _OCTET
        whole, long, double = integer or self._integer, int(model.longBits) // _OCTET, int(model.doubleBits) // _OCTET
        self.plain = {
            **_FIXED, "int": whole, "unsigned int": whole, "long": long, "unsigned long": long, "long int": long,
            "double": double, "long double": double if self._integer * _OCTET < _READS_WORDS else max(double, _LONG_DOUBLE),
        }  # fmt: skip
        self.declared: dict[str, int] = {}

    def of(self, use: ccode.TypeUse | None) -> int | None:
        """The bytes of a variable of a type; None where the model does not tell."""
        if use is None:
            return None
        count = 1
        canonical = str(use.canonical or use.spelling or "")
        for size in _DIMENSION.findall(canonical):
            if not size.strip().isdecimal():
                return None
            count *= int(size)
        one = self.element(use)
        return None if one is None else count * one

    def element(self, use: ccode.TypeUse) -> int | None:
        """The bytes of one element of an array type, of any other type itself; None where the model does not tell."""
        if use.pointerDepth or "(*" in str(use.spelling or ""):
            return self.pointer
        record = record_of(use)
        if record is not None:
            return self.record(record)
        if isinstance(use.declaration, ccode.Enumeration):
            return self._integer
        base = " ".join(_QUALIFIERS.sub(" ", _DIMENSION.sub("", str(use.canonical or ""))).split())
        if base.endswith("*"):
            return self.pointer
        known = self.plain.get(base)
        if known is None and isinstance(use.declaration, ccode.ExternalSymbol):
            known = self.declared.get(base)
        if known is not None:
            return known
        return int(use.bits) // _OCTET or None

    def record(self, record: ccode.Record) -> int | None:
        """The bytes of a structure or union with its bit-fields packed; None if the size of a member is unknown."""
        bits, most, widest = 0, 0, 1
        for each in record.fields:
            whole = self.of(each.valueType)
            if whole is None:
                return None
            step = self.alignment(each.valueType)
            widest = max(widest, step)
            if each.bitWidth:
                size, unit = int(each.bitWidth), step * _OCTET
                bits = bits if step == 1 or bits % unit + size <= unit else _up(bits, unit)
            else:
                bits, size = _up(bits, step * _OCTET), whole * _OCTET
            bits += size
            most = max(most, size)
        union = record.recordKind is ccode.RecordKind.unionType
        return _up(most if union else bits, widest * _OCTET) // _OCTET

    def alignment(self, use: ccode.TypeUse | None) -> int:
        """The alignment of a type in bytes."""
        if use is None or self.aligned == 1:
            return 1
        record = record_of(use) if not use.pointerDepth else None
        if record is not None:
            return max((self.alignment(each.valueType) for each in record.fields), default=1)
        return min(self.element(use) or 1, self.aligned)


def on_target(plan: migration.MigrationPlan) -> TypeSizes:
    """The sizes on the target of a plan; members have gaps only if its processor reads words."""
    whole = int(plan.source.intBits) // _OCTET if plan.widths is migration.Widths.fix and plan.source is not None else 0
    target = platform_of(plan)
    sizes = TypeSizes(target, whole, _alignment(target))
    sizes.declared = declared_types(plan, sizes.plain, sizes.pointer)
    return sizes


def on_source(plan: migration.MigrationPlan) -> TypeSizes | None:
    """The sizes on the source of a plan; None where the source is not known."""
    return TypeSizes(plan.source, 0, _alignment(plan.source)) if plan.source is not None else None


def _alignment(model: platform.Platform) -> int:
    """The greatest alignment on a platform in bytes: members have gaps only if its processor reads words."""
    return 1 if model.intBits < _READS_WORDS else int(model.intBits) // _OCTET


def _up(bits: int, unit: int) -> int:
    return -(-bits // unit) * unit


def text_of(literal: ccode.StringLiteral) -> str:
    """The contents of a string literal, adjacent ones joined, each escape sequence as one character."""
    return unescaped(str(literal.text or ""))


def unescaped(text: str) -> str:
    """The contents of the quoted strings in a text, joined, each escape sequence as one character."""
    return "".join(_ESCAPE.sub(lambda found: _character(found[0]), part) for part in _TEXT.findall(text))


def _character(escape: str) -> str:
    code = escape[1:]
    if code[:1] == "x":
        return chr(int(code[1:], 16) & 255)
    return chr(int(code, 8) & 255) if code.isdecimal() else code


# ---- types that texts declare

_RECORD = re.compile(r"struct (?P<name>\w+) \{(?P<members>.*?)\} ?;", re.DOTALL)
_OTHER_NAME = re.compile(r"typedef (?:struct )?(?P<type>\w+) (?P<name>\w+) ?;")
_METHOD = re.compile(r"[^;{}(]*\((?>[^;{}]*\))[^;{}]*(?:\{[^{}]*\}|;)")
_MEMBER = re.compile(r"(?:(?:volatile|const|struct) )*(?P<type>(?:(?:unsigned|signed|long|short) )*\w+) (?P<rest>(?s:.+))")
_FIXED_WIDTH = re.compile(r"u?int(8|16|32|64)_t")
_DECLARED_DIMENSION = re.compile(r"\[ ?(\d+) ?\]")
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
            for count in _DECLARED_DIMENSION.findall(declarator):
                one *= int(count)
            if declarator.count("[") != len(_DECLARED_DIMENSION.findall(declarator)):
                return None
            total += one
    return total or _NOTHING


def _plain(name: str, known: Mapping[str, int]) -> int | None:
    """The bytes of a type by its name alone, None if it is not known."""
    fixed = _FIXED_WIDTH.fullmatch(name)
    return int(fixed[1]) // _OCTET if fixed is not None else known.get(name)
