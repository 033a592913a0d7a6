"""The user's work in a previously generated program, taken over by the run that generates it anew.

A body written into a placeholder counts as filled, a ticked task as done. Text written for a function that is no longer called
stays in its file, disabled and with a comment, so that neither it nor a tick causes a merge conflict.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.generate.output_paths import Places
from robosmi.generate.record import Record
from robosmi.generate.text_form import read as read_text
from robosmi.metamodels import migration
from robosmi.transformations.chains.stages.user_includes import libraries_for, needed_still, own_includes, without_includes
from robosmi.transformations.m2t.program_files import REPORT
from robosmi.transformations.queries.reports.written_bodies import (
    AS_BYTES,
    VALUE_TODO,
    Body,
    bodies,
    ticks,
    with_ticks,
    written,
)
from robosmi.transformations.queries.source_text import HEADERS

_CODE = (*HEADERS, ".ino", ".cpp", ".c")
_AWAY = "#if 0  // what you wrote for '{}', which nothing calls any more"


class UserEdits:
    """The user's work in an output folder.

    Attributes:
        names: the functions whose bodies they have written.
        values: the names whose placeholders they have defined.
        done: the tasks that they have ticked, by their subjects.
        includes: headers that are no longer generated and that their code uses, with the names used from each.
        own_includes: all headers that their code needs and that no decision of the plan brings.
        findings: messages about bodies that are no longer called, and about such headers.
    """

    def __init__(self) -> None:
        self.names: set[str] = set()
        self.values: set[str] = set()
        self.done: set[tuple[str, ...]] = set()
        self.includes: dict[str, list[str]] = {}
        self.own_includes: list[str] = []
        self.findings: list[Finding] = []

    def base(self, name: str, last: str, there: str, made: str, path: Path) -> tuple[str, str]:
        """The previously generated text and the existing one, adapted so that the merge sees no change in the person's work.

        Args:
            name: of the file, relative to the output folder.
            last: the text that was made last.
            there: the text that is there.
            made: the text that is made anew.
            path: of the file, for findings.
        """
        if PurePosixPath(name).name == REPORT:
            return with_ticks(last, {tick.key for tick in ticks(there) if tick.done}), there
        if PurePosixPath(name).suffix not in _CODE or there == last:
            return last, there
        last, kept_headers = without_includes(last, self.includes, made)
        for header in kept_headers:
            used = ", ".join(f"'{each}'" for each in self.includes[header][:3])
            message = f"the include of {header} stays because your code uses {used}; no generated code needs it"
            fix = "install its library where you compile, or remove the include and the code that uses it"
            self.findings.append(Finding("RS512", Severity.info, message, Location(str(path)), fix=fix))
        new, before = bodies(made), bodies(last)
        gone = [body for body in written(there, last).values() if body.name not in new or not new[body.name].open]
        for body in sorted(gone, key=lambda each: each.first, reverse=True):
            last, there = _without(last, before[body.name]), _without(there, body)
            before = bodies(last)
        kept = [body for body in gone if body.name not in new or _plain(new[body.name]) != _plain(body)]
        for body in kept:
            message = f"'{body.name}' is no longer called or has another body; your body is disabled at the end of the file"
            fix = "remove it, or save it for other programs (robosmi adapters save) before you change the program"
            self.findings.append(Finding("RS527", Severity.warning, message, Location(str(path)), fix=fix))
        away = [f"{_AWAY.format(body.name)}\n{body.text}\n#endif" for body in kept]
        return last, "\n\n".join([there.rstrip("\n"), *away]) + "\n" if away else there


def _plain(body: Body) -> list[str]:
    """A body in normal form, equal for a program in one file and in several."""
    return [word for word in body.code if word not in ("static", "inline")]


def _without(text: str, body: Body) -> str:
    """A text without a function and the blank line after it."""
    lines = text.split("\n")
    last = body.last + (body.last < len(lines) - 1 and not lines[body.last].strip())
    return "\n".join([*lines[: body.first], *lines[last:]])


def find_user_edits(plan: migration.MigrationPlan, places: Places, made: Mapping[str, str], record: Record) -> UserEdits:
    """Find what the user has done in an output folder.

    Args:
        plan: the plan, which stays as it is.
        places: the output folder.
        made: relative path -> text of the program, as it is made without regard to what is there.
        record: the texts that were made last.
    """
    found, code = UserEdits(), dict[str, tuple[str, str, str]]()
    report = places.look(f"{plan.name}/{REPORT}")
    found.done = {tick.key for tick in ticks(read_text(report or b"", errors=AS_BYTES).text) if tick.done}
    for name, text in made.items():
        raw = places.look(name)
        there, last = (read_text(each or b"", errors=AS_BYTES).text for each in (raw, record.last(name, raw)[0]))
        if PurePosixPath(name).suffix in _CODE and there:
            found.names |= written(there, text, last).keys()
            found.values |= {str(symbol.name) for symbol in plan.symbolUses if _given(symbol, there, text)}
            code[name] = last, there, text
    found.includes = needed_still(code, libraries_for(plan))
    found.own_includes = list(dict.fromkeys([*own_includes(code), *found.includes]))
    return found


def _given(symbol: migration.SymbolUse, there: str, made: str) -> bool:
    """Whether the user has replaced a generated placeholder by a definition of the same name."""
    if symbol.status is not migration.AdapterStatus.todo:
        return False
    shown = str(symbol.placeholder).rpartition("\n")[2]
    lines = {line for line in made.split("\n") if line.startswith(shown) and VALUE_TODO in line}
    return bool(lines) and lines.isdisjoint(there.split("\n")) and re.search(rf"\b{re.escape(symbol.name)}\b", there) is not None
