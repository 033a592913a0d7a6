"""The source program and the generated program side by side: each line refers to the lines that it came from or became.

The links are those of the plan: texts generated from elements, and decisions about elements with their rules.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from msgspec import Struct

from robosmi.base.data_text import Json
from robosmi.metamodels import ccode, migration, trace
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2t.page_sections import chunked

_MOST = 40
"""Number of lines above which only the first line is linked: links of a whole file's heading tell nothing."""


class _Line(Struct):
    identity: str
    text: str
    links: list[str] = []
    why: str = ""

    def row(self) -> tuple[str, str, str, str]:
        return self.identity, self.text, " ".join(self.links), self.why


def side_by_side(plan: migration.MigrationPlan, sources: Mapping[str, bytes], texts: Mapping[str, str]) -> dict[str, Json]:
    """Both sides: `source` and `target`, each a list of files with their lines in runs.

    Args:
        plan: the plan.
        sources: path of a unit -> its bytes.
        texts: path of a generated file, relative to the output folder -> its text.
    """
    units = list(plan.program.units) if plan.program is not None else []
    old = {u.path: _lines(f"s{n}", sources[u.path].decode("utf-8", "replace")) for n, u in enumerate(units) if u.path in sources}
    new = {path: _lines(f"t{n}", text) for n, (path, text) in enumerate(texts.items())}
    for disposition in plan.dispositions:
        for line in _of(disposition.element, old):
            line.why = line.why or _why(disposition)
    for link in plan.trace.texts if plan.trace is not None else ():
        made = new.get(str(link.path), [])[link.line - 1 : link.endLine]
        origins = [line for element in _origins(link) for line in _of(element, old)]
        if len(made) > _MOST or len(origins) > _MOST:
            made, origins = made[:1], origins[:1]
        for line in made:
            line.why = line.why or f"{link.rule} ({link.step})"
            line.links += [o.identity for o in origins if o.identity not in line.links]
        for origin in origins:
            origin.links += [m.identity for m in made if m.identity not in origin.links]
    return {"source": _files(old), "target": _files(new)}


def _lines(prefix: str, text: str) -> list[_Line]:
    return [_Line(f"{prefix}-{number}", line) for number, line in enumerate(text.splitlines(), 1)]


def _of(element: Any, old: Mapping[str, list[_Line]]) -> list[_Line]:
    """The lines of a program element; empty for a whole file."""
    unit = ancestor_of_kind(element, ccode.SourceUnit) if isinstance(element, ccode.Located) else None
    lines = old.get(unit.path) if unit is not None else None
    if lines is None:
        return []
    first = element.line
    return lines[first - 1 : max(element.endLine, first)]


def _origins(link: trace.TextTrace) -> Iterable[Any]:
    """The program elements that a generated text comes from, directly or through a decision about them."""
    for element in link.elements:
        if isinstance(element, migration.AdapterUse):
            yield from element.calls
        elif isinstance(element, (migration.Disposition, migration.PortBinding)):
            yield element.element
        else:
            yield element


def _why(disposition: migration.Disposition) -> str:
    return f"{disposition.action.name} ({', '.join(disposition.rules)}): {'; '.join(disposition.reasons)}"


def _files(files: Mapping[str, list[_Line]]) -> list[dict[str, Json]]:
    return [{"name": path.rpartition("/")[2], "chunks": chunked([line.row() for line in lines])} for path, lines in files.items()]
