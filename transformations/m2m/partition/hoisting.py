"""Text changes that move locals of main to file scope because main's loop needs them.

Which locals these are is decided in `queries.programs.main_locals`. A declaration moves with its line if nothing but a comment
is on it besides. If an initial value is not constant, the declaration is copied without it and an assignment stays in main.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode, migration
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.edit_definitions import name_place
from robosmi.transformations.queries.programs.main_locals import MovedDeclaration
from robosmi.transformations.queries.source_text import SourceText

HOIST, SPLIT, BESIDE = "hoist-local", "hoist-local-split", "hoist-local-beside"
"""Rules of dispositions: the declaration moves as it is, it moves without initial values, or it moves with another variable's."""
_AUTOMATIC = re.compile(rb"\b(?:register\b\s*|auto\s+(?!\w+\s*[=({]))")
"""Matches storage classes of locals; `auto` with nothing but a name behind it is the type of C++."""
_CONST = re.compile(rb"\bconst\b\s*")
_CLOSING = re.compile(rb"\s*\)")


def hoist(moved: MovedDeclaration, verdicts: Mapping[ccode.Variable, migration.Disposition], text: SourceText) -> None:
    """Set the text changes of a declaration's variables, and on the first of them the copy that is written at file scope.

    Args:
        moved: the declaration.
        verdicts: the disposition of each of its variables.
        text: the text of its unit.
    """
    first = verdicts[moved.variables[0]]
    start, end, whole = _moved(moved, text)
    places = list(_assignments(moved, text)) if moved.assigned else [Replacement(start, end, "")]
    first.changes.extend(_change(text, place, first.rules[0], first.reasons[0]) for place in places)
    copy = migration.TextCopy(unit=text.unit, startOffset=whole[0], endOffset=whole[1])
    late = "the variable is given its value later"
    copy.changes.extend(_change(text, place, SPLIT, late) for place in _without_values(moved, text.data))
    name = _name(moved.variables[0], text)
    found = _AUTOMATIC.finditer(text.data, moved.statement.startOffset, int(moved.statement.endOffset))
    storage = (m.span() for m in found if m.end() <= name)
    copy.changes.extend(_change(text, Replacement(*place, ""), HOIST, "nothing at file scope is automatic") for place in storage)
    names = dict(moved.renamed)
    for variable in moved.variables:
        if variable.name not in names:
            continue
        new, reason = names[variable.name], f"'{variable.name}' stands for something else at file scope"
        place, length = _name(variable, text), len(variable.name.encode())
        copy.changes.append(_change(text, Replacement(place, place + length, new), HOIST, reason))
        verdict = verdicts[variable]
        for begin in sorted({place, *(int(use.startOffset) for use in variable.references)}):
            verdict.changes.append(_change(text, Replacement(begin, begin + length, new), HOIST, reason))
    first.hoisted = copy


def _name(variable: ccode.Variable, text: SourceText) -> int:
    return name_place(variable, text.data)


def _change(text: SourceText, place: Replacement, rule: str, reason: str) -> migration.TextChange:
    start, end, new = place
    return migration.TextChange(
        unit=text.unit, startOffset=start, endOffset=end, replacement=new, rule=rule, step=migration.Step.code, reason=reason
    )


def _assignments(moved: MovedDeclaration, text: SourceText) -> Iterator[Replacement]:
    """The deletions that turn a declaration into assignments of its non-constant initial values."""
    position = int(moved.statement.startOffset)
    for number, variable in enumerate(moved.assigned):
        assert variable.initializer is not None
        name = _name(variable, text)
        behind = name + len(variable.name.encode())
        value = text.data.rfind(b"=", behind, int(variable.initializer.startOffset))
        yield Replacement(position, name, "; " if number else "")
        if not text.blank(behind, value):  # the rest of a declarator, as of a pointer to a function
            yield Replacement(behind, value, " ")
        position = _value_end(variable.initializer, value, text.data)
    rest = text.data.find(b";", position)
    if rest > position and not text.blank(position, rest):
        yield Replacement(position, rest, "")


def _without_values(moved: MovedDeclaration, data: bytes) -> Iterator[Replacement]:
    """The deletions in the copy at file scope: initial values that stay in main, and `const` of the variables assigned later."""
    begin = int(moved.statement.startOffset)
    specifiers = name_place(moved.variables[0], data)
    before = begin  # the end of the previous declarator
    plain = False  # whether a variable that is no pointer is assigned later: `const` among the specifiers is its own
    for variable in moved.variables:
        name = name_place(variable, data)
        if variable in moved.assigned and variable.initializer is not None:
            value = data.rfind(b"=", name, int(variable.initializer.startOffset))
            end = _value_end(variable.initializer, value, data)
            # with the byte behind, so that a `)` that a cast inserts at the end goes, too
            yield Replacement(len(data[:value].rstrip()), end + 1, data[end : end + 1].decode())
            star = data.rfind(b"*", before, name)
            if star >= 0:
                yield from (Replacement(*m.span(), "") for m in _CONST.finditer(data, star, name))
            else:
                plain = True
        before = int(variable.endOffset)
    if plain:
        yield from (Replacement(*m.span(), "") for m in _CONST.finditer(data, begin, specifiers))


def _value_end(initializer: ccode.Expression, equals: int, data: bytes) -> int:
    """Where an initial value ends: behind the parentheses around it, which are no part of the expression."""
    start, end = int(initializer.startOffset), int(initializer.endOffset)
    for _ in range(data.count(b"(", equals, start)):
        closing = _CLOSING.match(data, end)
        end = closing.end() if closing else end
    return end


def _moved(moved: MovedDeclaration, source: SourceText) -> tuple[int, int, tuple[int, int]]:
    """The byte range that is deleted from main if the whole declaration moves, and the range that is copied.

    Whole lines are moved if nothing but a comment is on them besides the declaration.
    """
    start = int(moved.statement.startOffset)
    end = source.statement_end(moved.statement)
    if moved.assigned:
        return start, end, (start, end)
    first, last = source.line_start(start), source.line_end(end)
    comments = source.comments_in(end, last)
    behind = comments[-1].endOffset if comments else end
    alone = (
        source.blank(first, start)
        and source.blank(behind, last)
        and source.blank(end, comments[0].startOffset if comments else end)
    )
    if not (alone and behind < last):
        return start, end, (start, end)
    return first, last, (start, start + len(source.data[start:last].rstrip()))
