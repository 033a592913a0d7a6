"""The program's own files in the sketch: retained code with the plan's edits, `main` as `setup` and `loop`, includes, ports.

The unit that holds `main` becomes the .ino; any other unit becomes a .cpp beside it. Retained text is copied from the
stored source (see `queries.source_text`), in the order of the source, so comments and layout survive.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from robosmi.generate.environment import render
from robosmi.generate.text import GeneratedFile
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2t.adapters import FILE as ADAPTERS
from robosmi.transformations.m2t.adapters import adapter_text
from robosmi.transformations.m2t.main_text import heading, hoisted_parts, main_parts
from robosmi.transformations.queries.plan import needs_own_types
from robosmi.transformations.queries.source_text import HEADERS, Piece, SourceText, comments_in, is_header


def program_files(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> Iterator[GeneratedFile]:
    """The .ino, and a .cpp for each further unit."""
    assert plan.program is not None
    for unit in plan.program.units:
        main = next((d for d in unit.declarations if isinstance(d, ccode.Function) and d.name == "main" and d.definition), None)
        own = unit.path.rpartition("/")[2]
        text = SourceText(unit, sources[unit.path], plan.edits)
        if is_header(unit):
            file = GeneratedFile(f"{plan.name}/{own}")
            elements = [*unit.includes, *unit.macros, *unit.declarations]
            for piece in text.pieces(0, len(text.data), elements):
                file.add(piece.text, "code", "retained header", piece.elements or [unit])
        else:
            file = GeneratedFile(f"{plan.name}/{plan.name}.ino" if main is not None else f"{plan.name}/{_stem(own, plan)}.cpp")
            _head(file, plan, text)
            _body(file, plan, text, main)
        yield file


def _stem(own: str, plan: migration.MigrationPlan) -> str:
    """Name of a unit's .cpp file: its own, or its whole name where another unit has that one too."""
    stem = own.rpartition(".")[0]
    names = [u.path.rpartition("/")[2] for u in plan.program.units] if plan.program is not None else []
    same = [n for n in names if n.rpartition(".")[0] == stem and not n.lower().endswith(HEADERS)]
    return stem if len(same) == 1 and stem != plan.name else own.replace(".", "_")


def _comment_beside(include: ccode.Include, source: SourceText) -> str:
    """The comment on the line of an include, if it ends there."""
    end = source.line_end(include.endOffset)
    found = [c for c in comments_in(source.unit, include.endOffset, end) if c.endOffset <= end]
    return source.slice(found[0].startOffset, found[-1].endOffset)[0].strip() if found else ""


def _head(file: GeneratedFile, plan: migration.MigrationPlan, source_text: SourceText) -> None:
    """Title, includes, ports: the first two parts of the paper's template."""
    unit = source_text.unit
    assert plan.board is not None
    assert plan.target is not None
    source = plan.source.name if plan.source else "its platform"
    origins = [unit.path.rpartition("/")[2]]
    file.add(
        render(
            "arduino/header.j2", name=plan.name, origins=origins, source=source, board=plan.board.title, version=plan.toolVersion
        ),
        "generation",
        "header",
        [plan],
    )
    file.add(render("arduino/include.j2", header=plan.target.mainHeader, comment=""), "generation", "main header", [plan.target])
    for disposition in plan.dispositions:
        element = disposition.element
        if (
            disposition.rule == "standard-include"
            and isinstance(element, ccode.Include)
            and ancestor_of_kind(element, ccode.SourceUnit) is unit
        ):
            comment = _comment_beside(element, source_text)
            line = render("arduino/include.j2", header=element.header, comment=comment)
            file.add(line, "code", "platform-agnostic library", [element, disposition])
    included: set[str] = set()
    for choice in plan.libraryChoices:
        for header in list(choice.chosen.headers)[:1] if choice.chosen else []:
            if header not in included:
                included.add(header)
                users = [c for c in plan.libraryChoices if c.chosen is choice.chosen]
                file.add(render("arduino/include.j2", header=header, comment=""), "libraries", "library include", users)
    for number, connection in enumerate(plan.connections):
        text = render(
            "arduino/ports.j2",
            name=connection.name,
            literal=connection.pin.literal if connection.pin else "",
            component=connection.component.title if connection.component else "",
            label=connection.pin.label if connection.pin else "",
            connectors=[c.name for c in connection.connectors],
        )
        file.add(text if number else "\n" + text, "hardware", "port interface", [connection])
    file.add(f'\n#include "{ADAPTERS}"\n\n', "generation", "adapter include", [plan])


def _body(file: GeneratedFile, plan: migration.MigrationPlan, source: SourceText, main: ccode.Function | None) -> None:
    unit = source.unit
    elements: list[ccode.Located] = [*unit.includes, *unit.macros, *unit.declarations]
    functions = [d for d in unit.declarations if isinstance(d, ccode.Function) and d.definition]
    ahead = [f for f in functions if f is not main and _used_before(f, unit)]
    first = min((f.startOffset for f in functions), default=len(source.data))
    first = source.line_start(first) if source.blank(source.line_start(first), first) else first
    start = 0
    behind_types = [a for a in plan.adapterUses if needs_own_types(plan, a) and _called_in(a, unit)]
    if ahead or behind_types:
        _retain(file, unit, source.pieces(0, first, elements))
        start = first
    for adapter in behind_types:
        file.add(adapter_text(plan, adapter).lstrip("\n") + "\n", "code", "adapter", [adapter, *adapter.calls])
    if ahead:
        text = "\n".join(["// Functions that are used before they are defined", *(f"{_head_of(f, source)};" for f in ahead), ""])
        file.add(text + "\n", "generation", "prototypes", ahead)
    if main is None:
        _retain(file, unit, source.pieces(start, len(source.data), elements))
        return
    hoisted = list(hoisted_parts(plan, source, main))
    above = heading(source, main) if hoisted else main.startOffset
    _retain(file, unit, source.pieces(start, above, elements))
    file.parts += hoisted
    _retain(file, unit, source.pieces(above, main.startOffset, elements))
    file.parts += main_parts(plan, source, main)
    behind = main.endOffset
    if source.blank(behind, source.line_end(behind)):
        behind = source.line_end(behind)
    _retain(file, unit, _stripped(source.pieces(behind, len(source.data), elements)))


def _called_in(adapter: migration.AdapterUse, unit: ccode.SourceUnit) -> bool:
    return any(ancestor_of_kind(call, ccode.SourceUnit) is unit for call in adapter.calls)


def _stripped(pieces: Iterator[Piece]) -> Iterator[Piece]:
    """The pieces without the blanks with which the first one begins."""
    for number, piece in enumerate(pieces):
        yield piece if number else replace(piece, text=piece.text.lstrip(" \t"))


def _used_before(function: ccode.Function, unit: ccode.SourceUnit) -> bool:
    """Whether the function is used before its definition and no earlier prototype declares it."""
    uses = [use.startOffset for use in (*function.calls, *function.references) if ancestor_of_kind(use, ccode.SourceUnit) is unit]
    first = min(uses, default=function.startOffset)
    prototypes = [d for d in unit.declarations if isinstance(d, ccode.Function) and not d.definition and d.name == function.name]
    uses += [use.startOffset for p in prototypes for use in (*p.calls, *p.references)]
    first = min(uses, default=function.startOffset)
    return first < function.startOffset and all(p.startOffset > first for p in prototypes)


def _head_of(function: ccode.Function, source: SourceText) -> str:
    """A function's declaration as the sketch has it, without its body and comments."""
    assert function.body is not None
    parts, position = [], function.startOffset
    for comment in comments_in(source.unit, function.startOffset, function.body.startOffset):
        parts.append(source.slice(position, comment.startOffset)[0])
        position = comment.endOffset
    return " ".join("".join([*parts, source.slice(position, function.body.startOffset)[0]]).split())


def _retain(file: GeneratedFile, unit: ccode.SourceUnit, pieces: Iterator[Piece]) -> None:
    for piece in pieces:
        bindings = [e.decision for e in piece.edits if isinstance(e.decision, migration.PortBinding)]
        decisions: Sequence[object] = [*bindings, *(b.connection for b in bindings if b.connection is not None)]
        text = piece.text
        if not file.parts[-1].text.endswith("\n\n") or text.strip("\n"):
            file.add(
                _squeezed(file, text),
                "hardware" if bindings else "code",
                "retained code",
                [*(piece.elements or [unit]), *decisions],
            )


def _squeezed(file: GeneratedFile, text: str) -> str:
    """The text without the blank lines that a removed include leaves at a border."""
    before = file.parts[-1].text if file.parts else "\n\n"
    blank_before = before.endswith("\n\n") or before == "\n"
    return text.lstrip("\n") if blank_before else text
