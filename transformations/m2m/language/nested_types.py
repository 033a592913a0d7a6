"""Types defined among the members of a record: C++ scopes their names to the record, C does not.

An enumeration is moved before the record, with a new name if it has none. A nested record is named through the enclosing one
(`outer::inner`) where it is used. Other C constructs that C++ refuses are in `language_gap`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.innermost import Innermost
from robosmi.transformations.queries.macros.tokens import name_tokens


def nested_enumerations(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find enumerations defined inside records, each with the text of its definition under a name."""
    taken: set[str] = set()
    records = cache(_records)
    for enumeration in view.of_kind(ccode.Enumeration):
        record = records(enumeration.eContainer()).at(int(enumeration.startOffset))
        text = data[enumeration.startOffset : enumeration.endOffset]
        if record is None or not text.startswith(b"enum") or not text.endswith(b"}"):  # a macro wrote it
            continue
        shown = text.decode("utf-8", "replace")
        if not enumeration.name:
            taken = taken or {name for _, _, name in name_tokens(data)}
            named = _fresh(
                next((f"{f.name}_values" for f in record.fields if f.startOffset == enumeration.startOffset), ""), taken
            )
            shown = f"enum {named} {shown.removeprefix('enum').lstrip()}"
        yield Change(enumeration, "enumeration-before", shown, "C++ keeps the names of an enumeration to the record it is in")


def _fresh(wanted: str, taken: set[str]) -> str:
    name, number = wanted or "values", 1
    while name in taken:
        number += 1
        name = f"{wanted or 'values'}{number}"
    taken.add(name)
    return name


def _within(around: Element | None) -> Sequence[ccode.Declaration]:
    return around.declarations if isinstance(around, (ccode.SourceUnit, ccode.DeclarationStatement)) else ()


def _records(around: Element | None) -> Innermost[int, ccode.Record]:
    """The records of a unit or statement by their places; the first one counts where one is in another."""
    return Innermost(
        (int(record.startOffset) + 1, int(record.endOffset), number, record)
        for number, record in enumerate(_within(around))
        if isinstance(record, ccode.Record)
    )


def before_record(enumeration: ccode.Enumeration, text: str) -> list[Replacement]:
    """The changes that move an enumeration's definition before the record's declaration and leave its name in its place.

    Args:
        enumeration: the enumeration.
        text: its definition with a name.
    """
    start, end = int(enumeration.startOffset), int(enumeration.endOffset)
    around = enumeration.eContainer()
    places = [int(d.startOffset) for d in _within(around) if d.startOffset < start and end <= d.endOffset]
    if isinstance(around, ccode.DeclarationStatement):
        places.append(int(around.startOffset))
    name = " ".join(text.partition("{")[0].split())
    return [Replacement(min(places), min(places), f"{text};\n"), Replacement(start, end, f"{name} ")]


RECORDS = frozenset({"struct", "union"})


def tags_within(data: bytes, record: ccode.Located, owner: str) -> dict[str, str]:
    """The tags of records defined inside another record, each with its qualified name in C++.

    Args:
        data: the bytes of its unit.
        record: the enclosing record.
        owner: the enclosing record's name.
    """
    words = [word for word in tokens(data[record.startOffset : record.endOffset]) if word[0] not in ("comment", "directive")]
    found: dict[str, str] = {}
    around: list[str] = []  # the name of each brace that is open, empty for a record without one
    for number, (_, _, _, text) in enumerate(words):
        if text == "{":
            tag = _tag_before(words, number) if around else owner
            if around and tag and all(around):
                found[tag] = "::".join([*around, tag])
            around.append(tag)
        elif text == "}" and around:
            around.pop()
    return found


def _tag_before(words: Sequence[Token], brace: int) -> str:
    named = brace > 1 and words[brace - 1][0] == "name" and words[brace - 2][3] in RECORDS
    return words[brace - 1][3] if named else ""


def nested_tags(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find records whose nested records may be named by their tags elsewhere."""
    for record in view.of_kind(ccode.Record):
        owner = str(record.name or "") or _typedef_of(record)
        for tag, name in tags_within(data, record, owner).items() if owner else ():
            yield Change(record, "tag-of-member", f"{tag} {name}", "C++ knows the record by the one that it is defined in")


def _typedef_of(record: ccode.Record) -> str:
    """The typedef name that an unnamed record is defined for; empty if there is none."""
    around = record.eContainer()
    beside = around.declarations if isinstance(around, (ccode.SourceUnit, ccode.DeclarationStatement)) else ()
    types = (d for d in beside if isinstance(d, ccode.Typedef) and d.startOffset <= record.startOffset < d.endOffset)
    return next((str(d.name) for d in types if d.aliased is not None and not d.aliased.pointerDepth), "")


def tag_places(record: ccode.Record, choice: str, unit: ccode.SourceUnit, data: bytes) -> list[Replacement]:
    """The replacements of a nested record's tag in a unit, outside of the enclosing record, by its qualified name.

    Args:
        record: the enclosing record.
        choice: the nested record's tag and its qualified name in C++, separated by a blank.
        unit: the unit.
        data: its bytes.
    """
    tag, _, name = choice.partition(" ")
    own = (int(record.startOffset), int(record.endOffset)) if ancestor_of_kind(record, ccode.SourceUnit) is unit else (0, 0)
    found, before = [], ""
    for start, end, text in name_tokens(data):
        if text == tag and before in RECORDS and not own[0] <= start < own[1]:
            found.append(Replacement(start, end, name))
        before = text
    return found
