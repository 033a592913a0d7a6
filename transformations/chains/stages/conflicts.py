"""Turns edits of the program that could not be merged into tasks for the plan, so that the report shows them.

The merge marks a conflict in the file (`generate.merge_edits`). Here the marks are read back, including those of earlier runs,
which remain until the user resolves them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robosmi.generate.merge_edits import BASE, CONFLICT, GENERATED, MIDDLE, YOURS
from robosmi.metamodels import migration

_MARKS = tuple(mark.strip().encode() for mark in (YOURS, BASE, GENERATED))
_ORDER = (BASE, MIDDLE, GENERATED)


def conflicts(files: Mapping[str, bytes], made: Mapping[str, str]) -> list[migration.PlanTask]:
    """The conflicts that are marked in files.

    Args:
        files: relative path -> bytes of the files as they are to be written.
        made: relative path -> text, as it was made without regard to what is there.
    """
    return [
        task
        for name, data in files.items()
        if any(mark in data for mark in _MARKS)
        for task in _tasks(name, data.decode("utf-8", "replace"), made.get(name, ""))
    ]


def _tasks(name: str, text: str, made: str) -> Iterator[migration.PlanTask]:
    """The conflicts marked in a text, without marks that are part of the program itself."""
    if any(mark in made for mark in (YOURS, *_ORDER)):
        return
    lines = text.replace("\r\n", "\n").splitlines(keepends=True)
    marked = [number for number, line in enumerate(lines) if line.strip().encode() in _MARKS]
    if marked and YOURS not in lines:  # somebody has damaged the marks
        message = "a conflict's markers are damaged: decide which lines stay"
        fix = "remove its remaining markers from the file, then migrate again"
        error, line = migration.SeverityLevel.error, marked[0] + 1
        yield migration.PlanTask(rule=CONFLICT, severity=error, message=message, path=name, line=line, effort="small", fix=fix)
    at = 0
    while at < len(lines):
        if lines[at] != YOURS:
            at += 1
            continue
        first, parts = at, list[str]()
        for mark in _ORDER:
            begin = at + 1
            at = next(
                (number for number in range(begin, len(lines)) if lines[number].rstrip("\n") == mark.rstrip("\n")), len(lines)
            )
            parts.append("".join(lines[begin:at]).rstrip("\n"))
        yield migration.PlanTask(
            rule=CONFLICT,
            severity=migration.SeverityLevel.error,
            message="your edit and the newly generated text change the same lines: decide which stay",
            path=name,
            line=first + 1,
            effort="small",
            fix="both texts are listed under Conflicts; remove the markers from the file, then migrate again",
            texts=parts,
        )
