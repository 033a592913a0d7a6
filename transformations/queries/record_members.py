"""Which members a program uses of a record type that it does not declare, found in the tokens of its text.

The parser drops members of incomplete types, so the tokens are searched for `.` and `->` after a variable, parameter or field
of the type. Members of members become nested records.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import TypeAlias

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import type_of

Tree: TypeAlias = "dict[str, Tree]"
"""A member's name -> the members of it that are used, in the same form."""


def outside_members(views: Iterable[CodeView]) -> set[str]:
    """Names of members that the program uses of records that it does not declare."""
    views = list(views)
    own = {str(field.name) for view in views for field in view.of_kind(ccode.Field)}
    found = set()
    for member in (each for view in views for each in view.of_kind(ccode.Member)):
        kind = type_of(member.object, {})
        if kind.declaration is None or isinstance(kind.declaration, ccode.ExternalSymbol) if kind else member.name not in own:
            found.add(str(member.name))
    return found


def record_values(views: Iterable[CodeView], sources: Mapping[str, bytes]) -> dict[str, str]:
    """Member that is assigned a whole record -> the type of that record, if the program does not declare it either."""
    found: dict[str, str] = {}
    for view in views:
        for given in view.of_kind(ccode.Assignment):
            kind = type_of(given.right, {}) if isinstance(given.left, ccode.Member) and given.operator == "=" else None
            if kind is not None and not kind.depth and isinstance(kind.declaration, ccode.ExternalSymbol) and not kind.arithmetic:
                left = sources[view.unit.path][given.startOffset : given.right.startOffset]  # type: ignore[union-attr]
                names = [text for kind_, _, _, text in tokens(left) if kind_ == "name"]
                found.setdefault(names[-1], kind.base)
    return found


def members(type_names: Collection[str], views: Iterable[CodeView], sources: Mapping[str, bytes]) -> list[str]:
    """Declarators (`int32_t x`) of the members that a program uses of undeclared record types, sorted by name."""
    views = list(views)
    tree: Tree = {}
    for view in views:
        named: tuple[ccode.Variable | ccode.Parameter | ccode.Field, ...] = (
            *view.of_kind(ccode.Variable),
            *view.of_kind(ccode.Parameter),
            *view.of_kind(ccode.Field),
        )
        mine = [
            v
            for v in named
            if v.valueType is not None and v.valueType.declaration is not None and v.valueType.declaration.name in type_names
        ]
        holders = {v.name for v in mine if not isinstance(v, ccode.Field)}
        fields = {v.name for v in mine if isinstance(v, ccode.Field)}
        if mine:
            words = [t[3] for t in tokens(sources[view.unit.path]) if t[0] not in ("comment", "directive")]
            for i, word in enumerate(words):
                if (word in holders and words[i - 1] not in (".", "->", "struct")) or (
                    word in fields and words[i - 1] in (".", "->")
                ):
                    _chain(words, i + 1, tree)
                elif word in holders and words[i + 1 : i + 3] == ["=", "{"] and words[i + 3 : i + 4] == ["."]:
                    tree.setdefault(words[i + 4], {})
    return _declarators(tree, record_values(views, sources))


def _chain(words: list[str], i: int, tree: Tree) -> None:
    """Add the members that `[..].a[..].b` uses, from the token after a variable's name on, to the tree."""
    i = _behind_brackets(words, i)
    if words[i : i + 2] == ["=", "{"]:
        depth = 0
        for j in range(i + 1, len(words)):
            depth += (words[j] in "{[(") - (words[j] in "}])")
            if words[j] == "." and depth == 1 and words[j - 1] in ("{", ","):
                tree.setdefault(words[j + 1], {})
            if depth == 0:
                return
    if i + 1 < len(words) and words[i] in (".", "->") and words[i + 1].isidentifier():
        inner = tree.setdefault(words[i + 1], {})
        after = i + 2
        if words[after : after + 1] == ["["]:
            inner["[]"] = {}
        elif words[after : after + 1] == ["("]:
            inner["()"] = {}
            return
        _chain(words, after, inner)


def _behind_brackets(words: list[str], i: int) -> int:
    while i < len(words) and words[i] == "[":
        depth = 0
        while i < len(words):
            depth += (words[i] == "[") - (words[i] == "]")
            i += 1
            if depth == 0:
                break
    return i


def _declarators(tree: Tree, records: Mapping[str, str]) -> list[str]:
    made = []
    for name, inner in sorted(tree.items()):
        within = {k: v for k, v in inner.items() if k not in ("[]", "()")}
        kind = f"struct {{ {'; '.join(_declarators(within, records))}; }}" if within else records.get(name, "int32_t")
        if "()" in inner:
            made.append(f"int32_t (*{name})(...)")
        else:
            made.append(f"{kind} {name}{'[16]' if '[]' in inner else ''}")
    return made
