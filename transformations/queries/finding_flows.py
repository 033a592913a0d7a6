"""The steps by which a program arrives at the situation of a finding, and the edit of its text that corrects it.

Both are derived from the elements of the finding, since a plan stores no more, and only for rules where these suffice. The
constraints decide what is found.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from robosmi.diagnostics import FlowStep, Location, TextEdit
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind

_HEADERS = re.compile(r"\(<([^>]+)>\)")


def has_flow(entry: migration.PlanTask) -> bool:
    """Whether the elements of an entry are the steps of a flow, and not several places of one kind: RS323 of one loop."""
    kinds = [isinstance(element, ccode.Loop) for element in entry.elements]
    return entry.rule == "RS323" and len(kinds) > 1 and kinds.count(True) == 1 and kinds[0]


def steps_of(entry: migration.PlanTask, places: Mapping[str, str]) -> tuple[FlowStep, ...]:
    """The steps by which the program arrives at what a finding reports; empty if they are not known.

    Args:
        entry: a finding of the plan.
        places: stored path -> path as the user knows it.
    """
    if not has_flow(entry):
        return ()
    loop, *before = entry.elements
    found = []
    for element in [*before, loop]:
        if isinstance(element, ccode.Loop):
            said = "the loop waits for a change that nothing makes on one core"
        elif isinstance(element, ccode.Call):
            said = f"'{element.calleeName}' starts code on another core"
        else:
            said = "that code changes what the loop waits for"
        if isinstance(element, ccode.Located):
            found.append(FlowStep(_place(element, places), said))
    return tuple(found)


def edits_of(entry: migration.PlanTask, places: Mapping[str, str]) -> tuple[TextEdit, ...]:
    """The edits of the source that correct a finding; empty if no single edit does.

    Args:
        entry: a finding of the plan.
        places: stored path -> path as the user knows it.
    """
    element = next(iter(entry.elements), None)
    if entry.rule == "RS313" and isinstance(element, ccode.Binary) and len(entry.elements) == 1:
        return _wider(element, places)
    if entry.rule == "RS324" and isinstance(element, ccode.Located):
        return _included(element, entry.message, places)
    return ()


def _wider(operation: ccode.Binary, places: Mapping[str, str]) -> tuple[TextEdit, ...]:
    """An L behind a decimal number in an operation, which is then computed in 32 bits; of a shift only its left side counts."""
    sides = [operation.left] if operation.operator in ("<<", ">>") else [operation.left, operation.right]
    number = next((s for s in sides if isinstance(s, ccode.IntegerLiteral) and re.fullmatch(r"\d+", s.text or "")), None)
    if number is None or number.endLine != number.line:
        return ()
    path = _place(number, places).path
    end = Location(path, number.endLine, number.endColumn, number.endLine, number.endColumn)
    return (TextEdit(end, "L"),)


def _included(use: ccode.Located, message: str, places: Mapping[str, str]) -> tuple[TextEdit, ...]:
    """The directives that include the headers of a message, before the first one of the file."""
    unit = ancestor_of_kind(use, ccode.SourceUnit)
    if unit is None or not unit.includes:
        return ()
    first = min(unit.includes, key=lambda include: int(include.startOffset))
    start = Location(places.get(str(unit.path), str(unit.path)), first.line, 1, first.line, 1)
    return (TextEdit(start, "".join(f"#include <{header}>\n" for header in _HEADERS.findall(message))),)


def _place(element: ccode.Located, places: Mapping[str, str]) -> Location:
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    path = str(unit.path) if unit is not None else ""
    ends = (element.endLine or None, element.endColumn or None)
    return Location(places.get(path, path), element.line or None, element.column or None, *ends)
