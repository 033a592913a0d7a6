"""How many bytes declared types take on the target, and what each text of the program takes there.

Sizes follow from the target's model: widths of int, long, double and pointers, types that keep the width of the source. Members
of structures lie behind each other without gaps, as on a processor that reads bytes. What expressions take is not asked here.
"""

from __future__ import annotations

import re

from robosmi.metamodels import ccode, migration
from robosmi.transformations.queries.initialisers import record_of
from robosmi.transformations.queries.plan import platform_of

_DIMENSION = re.compile(r"\[([^\[\]]*)\]")
_QUALIFIERS = re.compile(r"\b(?:const|volatile|register|restrict|extern|static|struct|union|enum|_Bool)\b")
_ESCAPE = re.compile(r"\\(?:x[0-9A-Fa-f]+|[0-7]{1,3}|.)", re.DOTALL)
_TEXT = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_OCTET = 8
_FIXED = {
    "char": 1, "signed char": 1, "unsigned char": 1, "bool": 1, "short": 2, "unsigned short": 2, "short int": 2, "float": 4,
    "long long": 8, "unsigned long long": 8, "long long int": 8,
}  # fmt: skip
"""Bytes of the types that are the same on all the platforms that there are."""


class TargetSizes:
    """Sizes on the target of a plan.

    Args:
        plan: the plan.
    """

    def __init__(self, plan: migration.MigrationPlan) -> None:
        target = platform_of(plan)
        fixed = plan.widths is migration.Widths.fix
        self.pointer = int(target.pointerBits) // _OCTET
        self._integer = int(target.intBits) // _OCTET
        whole = int(plan.source.intBits) // _OCTET if fixed and plan.source is not None else self._integer
        long = int(target.longBits) // _OCTET
        self._bytes = {
            **_FIXED, "int": whole, "unsigned int": whole, "long": long, "unsigned long": long, "long int": long,
            "double": int(target.doubleBits) // _OCTET, "long double": int(target.doubleBits) // _OCTET,
        }  # fmt: skip

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
        """The bytes of one element of an array, of anything else as it is."""
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
        known = self._bytes.get(base)
        if known is not None:
            return known
        return int(use.bits) // _OCTET or None

    def record(self, record: ccode.Record) -> int | None:
        """The bytes of a structure or a union; bit-fields share bytes."""
        bits, most = 0, 0
        for each in record.fields:
            if each.bitWidth:
                size = int(each.bitWidth)
            else:
                whole = self.of(each.valueType)
                if whole is None:
                    return None
                bits = -(-bits // _OCTET) * _OCTET
                size = whole * _OCTET
            bits += size
            most = max(most, size)
        union = record.recordKind is ccode.RecordKind.unionType
        return -(-(most if union else bits) // _OCTET)


def text_of(literal: ccode.StringLiteral) -> str:
    """What a text says, adjacent ones joined, each character as one; escapes become one character each."""
    return unescaped(str(literal.text or ""))


def unescaped(text: str) -> str:
    """What texts in quotes say, adjacent ones joined, each character as one."""
    return "".join(_ESCAPE.sub(lambda found: _character(found[0]), part) for part in _TEXT.findall(text))


def _character(escape: str) -> str:
    code = escape[1:]
    if code[:1] == "x":
        return chr(int(code[1:], 16) & 255)
    return chr(int(code, 8) & 255) if code.isdecimal() else code
