"""Locals of main that its loop needs, as changes of text: their declarations leave main for file scope.

Which locals these are is decided in `dispositions`. A declaration moves with its line where nothing but a comment stands there
beside it. Where the initial value is not constant, the declaration is copied without it and the assignment stays.
"""

from __future__ import annotations

import re

from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2m.edit_rules import Replacement, name_place
from robosmi.transformations.queries.source_text import SourceText

HOIST, SPLIT = "hoist-local", "hoist-local-split"
"""Rules of dispositions: the declaration moves as it is; it moves without its initial value."""


def hoisted(variable: ccode.Variable, rule: str, text: SourceText) -> tuple[Replacement, migration.TextCopy]:
    """What a hoisted local takes out of main, and what of it stands at file scope.

    Args:
        variable: the local.
        rule: `HOIST` or `SPLIT`.
        text: the text of its unit.
    """
    statement = variable.eContainer()
    assert isinstance(statement, ccode.Located)
    if rule == SPLIT:
        end = name_place(variable, text.data)
        behind = end + len(variable.name.encode())
        copy = migration.TextCopy(unit=text.unit, startOffset=variable.startOffset, endOffset=behind)
        copy.changes.extend(_change(text, place, rule) for place in _without_const(text.data, variable.startOffset, end))
        copy.changes.append(_change(text, (behind, behind, ";"), rule))
        return (statement.startOffset, end, ""), copy
    start, end = _moved(statement, text)
    first = max(start, variable.startOffset)
    last = first + len(text.data[first:end].rstrip())
    return (start, end, ""), migration.TextCopy(unit=text.unit, startOffset=first, endOffset=last)


def _change(text: SourceText, place: Replacement, rule: str) -> migration.TextChange:
    start, end, new = place
    return migration.TextChange(
        unit=text.unit, startOffset=start, endOffset=end, replacement=new, rule=rule, step=migration.Step.code,
        reason="the variable is given its value later",
    )  # fmt: skip


def _without_const(data: bytes, start: int, end: int) -> list[Replacement]:
    """What makes the variable itself constant goes, so that it may be given its value later; what it points to stays constant."""
    head = data.rfind(b"*", start, end) + 1 or start
    return [(m.start(), m.end(), "") for m in re.compile(rb"\bconst\b\s*").finditer(data, head, end)]


def _moved(statement: ccode.Located, source: SourceText) -> tuple[int, int]:
    """The range that moves with a hoisted declaration: its whole lines where nothing but a comment stands there beside it."""
    start, end = statement.startOffset, source.statement_end(statement)
    first, last = source.line_start(start), source.line_end(end)
    comments = source.comments_in(end, last)
    behind = comments[-1].endOffset if comments else end
    alone = (
        source.blank(first, start)
        and source.blank(behind, last)
        and source.blank(end, comments[0].startOffset if comments else end)
    )
    return (first, last) if alone and behind < last else (start, end)
