"""Gives a named object to each compound literal whose address is kept (C11 6.5.2.5).

In C such a literal lives as long as its block; in C++ it ends with its expression. In a function the object is declared before
the statement, in the same block. In main, which runs once and whose statements move, and at file scope it becomes static.
Literals of which only the value is used stay as they are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.designated_lists import positional
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.macros.tokens import name_tokens

RULE = "named-literal"
"""The rule of `text_changes` that gives a literal a named object."""
_REASON = "what a compound literal makes ends with its expression in C++"


def compound_literals(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find literals whose address is taken with `&`, and array literals that decay to a pointer."""
    number, taken = 0, None
    for cast in view.of_kind(ccode.Cast):
        whole = _kept(cast, data) if isinstance(cast.operand, ccode.InitializerList) else None
        if whole is None:
            continue
        taken = {name for _, _, name in name_tokens(data)} if taken is None else taken
        number += 1
        while f"made{number}" in taken:
            number += 1
        yield Change(whole, RULE, f"made{number}", _REASON)


def _kept(cast: ccode.Cast, data: bytes) -> ccode.Expression | None:
    """The expression that yields the literal's address; None if its address is not taken or it stands in a macro."""
    around = cast.eContainer()
    if cast.target is None:
        return None
    if isinstance(around, ccode.Unary) and around.operator == "&":
        return around if data[around.startOffset : around.startOffset + 1] == b"&" and not cast.target.arrayDims else None
    plain = not isinstance(around, (ccode.Index, ccode.SizeOf)) and data[cast.startOffset : cast.startOffset + 1] == b"("
    return cast if plain and size_of(cast) else None


def size_of(cast: ccode.Cast) -> str:
    """The number of elements, as text, of a literal that is a one-dimensional array; empty for any other literal."""
    sizes = re.findall(r"\[(\d+)\]", (cast.target.canonical or "") if cast.target is not None and cast.target.arrayDims else "")
    return sizes[0] if len(sizes) == 1 else ""


def place_before(whole: ccode.Expression) -> ccode.Statement | None:
    """The statement before which the object is declared; None if the object has to be static."""
    function = ancestor_of_kind(whole, ccode.Function)
    if function is None or function.name == "main":
        return None
    element = whole.eContainer()
    while element is not None and not (isinstance(element, ccode.Statement) and isinstance(element.eContainer(), ccode.Block)):
        element = element.eContainer()
    return element if isinstance(element, ccode.Statement) else None


def _local(declared: object) -> bool:
    """Whether a declaration is a local variable or a parameter, which a C++ lambda has to capture."""
    return isinstance(declared, (ccode.Variable, ccode.Parameter)) and ancestor_of_kind(declared, ccode.Function) is not None


def replacements(whole: ccode.Unary | ccode.Cast, name: str, data: bytes) -> list[Replacement]:
    """The changes that declare the object and assign the literal to it, as (first byte, byte after the last, new text).

    Args:
        whole: the expression that yields the address.
        name: the name of the object.
        data: the bytes of its unit.
    """
    cast = whole.operand if isinstance(whole, ccode.Unary) else whole
    assert isinstance(cast, ccode.Cast)  # what `_kept` gives
    use = cast.target
    assert use is not None
    pointed, star, own = re.sub(r"\s*\[[^\]]*\]", "", use.spelling).strip().rpartition("*")
    kind = f"{pointed}{star}" + re.sub(r"\bconst\b\s*", "", own).strip()
    typed = kind if kind.endswith("*") else f"{kind} "
    length = size_of(cast)
    given, before, behind = f"{typed}*", "", ""
    declared = f"{typed}{name};"
    if length:
        declared = f"struct {name}_type {{ {typed}list[{length}]; }} {name};"
    start, end = int(whole.startOffset), int(whole.endOffset)
    first = start + (0 if length else 1)
    taken = f"{name}.list" if length else f"&{name}"
    inner = cast.operand
    assert inner is not None
    if length:  # the type of the array becomes that of what holds it
        before, behind = f"({name}_type){{", "}"
        first = int(inner.startOffset)
    anew = any(each[0] == inner.startOffset for each in positional(cast, data) or ())
    last, ends = (end, "") if anew else (end - 1, data[end - 1 : end].decode("latin-1"))  # it moves with what it ends
    statement = place_before(whole)
    if statement is not None:
        at = int(statement.startOffset)
        return [
            Replacement(at, at, f"{declared} "),
            Replacement(start, first, f"({name} = {before}"),
            Replacement(last, end, f"{ends}{behind}, {taken})"),
        ]
    captured = "&" if any(_local(name.target) for name in all_of_kind(inner, ccode.NameReference)) else ""
    lasting = declared.replace(f"}} {name};", f"}}; static {name}_type {name};") if length else f"static {declared}"
    return [
        Replacement(start, first, f"[{captured}]() -> {given} {{ {lasting} {name} = {before}"),
        Replacement(last, end, f"{ends}{behind}; return {taken}; }}()"),
    ]
