"""The program's own files: retained code with the plan's changes, `main` as the target has it, includes, ports.

The unit that holds `main` becomes the main file; any other unit becomes a module beside it, a header stays what it is. Retained
text is copied from the stored source (see `queries.source_text`), in the order of the source, so comments and layout survive.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2t.adapters import adapters, handles_interrupts
from robosmi.transformations.m2t.main_text import MainPart, heading, hoisted_parts, main_parts
from robosmi.transformations.m2t.retained_text import retained_name
from robosmi.transformations.queries.own_headers import headers_of_types, is_member, undeclared, undeclared_variables, unit_of
from robosmi.transformations.queries.plans.plan import preserves_main, target_of
from robosmi.transformations.queries.plans.plan_adapters import rest_levels
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.plans.verdicts import IN_PLACE
from robosmi.transformations.queries.programs.main_function import main_of
from robosmi.transformations.queries.signature_text import declare
from robosmi.transformations.queries.source_text import HEADERS, Piece, SourceText, header_file, is_header
from robosmi.transformations.queries.text_changes import decision_of
from robosmi.transformations.queries.width_types import retyped


def file_name(unit: ccode.SourceUnit, plan: migration.MigrationPlan) -> str:
    """The file name of a unit in the sketch."""
    if retains_platform(plan):
        return retained_name(unit, plan)
    own = str(unit.path.rpartition("/")[2])
    if is_header(unit):
        return header_file(own)
    target = target_of(plan)
    if main_of(unit) is not None:
        return f"{plan.name}{target.fileSuffix}"
    return f"{_stem(own, plan)}{target.moduleSuffix}"


def own_header(plan: migration.MigrationPlan, source: SourceText) -> dict[str, Any]:
    """The values for an own header's file: its text, with prototypes of functions that it uses before their definition.

    A header that gets bodies of functions it only declared also gets a guard if it has none: declarations may be repeated,
    definitions not.
    """
    unit = source.unit
    functions = [d for d in unit.declarations if isinstance(d, ccode.Function) and d.definition]
    early = [f for f in functions if _used_before(f, unit, ())]
    declared = _declared_names(plan) if early else set()
    ahead = [f for f in early if f.name not in declared]
    first = _place_of_prototypes(source, functions, ahead) if ahead else 0
    guarded = bool(unit.conditionals) or b"#pragma once" in source.data
    parts = [MainPart("#pragma once\n", "generation", "once", [unit])] if not guarded and _gets_bodies(unit, plan) else []
    parts += _header_parts(source, 0, first)
    parts += [MainPart(f"{_prototype(f, source, plan)};\n", "generation", "prototype", [f]) for f in ahead]
    return {"code": [*parts, *_header_parts(source, first, len(source.data))]}


def _declared_names(plan: migration.MigrationPlan) -> set[str]:
    """The functions of which any file of the program has a prototype."""
    units = plan.program.units if plan.program is not None else []
    return {str(d.name) for unit in units for d in unit.declarations if isinstance(d, ccode.Function) and not d.definition}


def _gets_bodies(unit: ccode.SourceUnit, plan: migration.MigrationPlan) -> bool:
    """Whether a header gets bodies of functions that it only declares."""
    bodies = (d.element for d in plan.dispositions if IN_PLACE in d.rules and d.element is not None)
    return any(ancestor_of_kind(element, ccode.SourceUnit) is unit for element in bodies)


def _place_of_prototypes(source: SourceText, functions: Sequence[ccode.Function], ahead: Sequence[ccode.Function]) -> int:
    """Where to put prototypes: before the first function, or before their first use if their types are declared after that."""
    unit = source.unit
    first = min((int(f.startOffset) for f in functions), default=len(source.data))
    uses = [use for f in ahead for use in (f.returnType, *(p.valueType for p in f.parameters)) if use is not None]
    declared = [use.declaration for use in uses if use.declaration is not None]  # of a header that is no file here: in none
    types = [int(d.endOffset) for d in declared if ancestor_of_kind(d, ccode.SourceUnit) is unit]
    if any(end > first for end in types):
        named = [
            int(use.startOffset)
            for f in ahead
            for use in (*f.calls, *f.references)
            if ancestor_of_kind(use, ccode.SourceUnit) is unit
        ]
        starts = [int(d.startOffset) for d in unit.declarations if any(d.startOffset <= at < d.endOffset for at in named)]
        first = next((start for start in starts if start >= first), first)
    return source.line_start(first) if source.blank(source.line_start(first), first) else first


def _header_parts(source: SourceText, start: int, end: int) -> list[MainPart]:
    pieces = source.pieces(start, end, _elements(source.unit))
    return [MainPart(_lines(p.text), "code", "retained header", p.elements or [source.unit]) for p in pieces if p.text]


def program_text(
    plan: migration.MigrationPlan,
    source: SourceText,
    with_own_types: Sequence[migration.AdapterUse],
    texts: Mapping[ccode.SourceUnit, SourceText],
) -> dict[str, Any]:
    """The values for the file of a unit that is no header.

    Args:
        plan: the plan.
        source: the unit's text.
        with_own_types: the placeholders that must come after the program's own types.
        texts: the text of each unit.

    Returns:
        `origin`, `includes`, `libraries`, `interrupts` for its head, and `rest`, the pins that get a level first; `types` (its
        code up to the first function, where something must stand behind that), `adapters`, `variables` of other files,
        `prototypes` and the headers of their types that must, `code` (all the rest).
    """
    unit = source.unit
    functions = [d for d in unit.declarations if isinstance(d, ccode.Function) and d.definition]
    main = None if preserves_main(plan) else main_of(unit)
    prototypes: dict[str, list[ccode.Function]] = {}
    for declared in unit.declarations:
        if isinstance(declared, ccode.Function) and not declared.definition:
            prototypes.setdefault(declared.name, []).append(declared)
    ahead = [f for f in functions if f is not main and _used_before(f, unit, prototypes.get(f.name, ()))]
    elsewhere = undeclared(unit)
    ahead += elsewhere
    late = [a for a in with_own_types if _called_in(a, unit)]
    first = _place_of_prototypes(source, functions, ahead)
    if main is not None and first > heading(source, main):
        first = heading(source, main)
    variables = undeclared_variables(unit)
    start = first if ahead or late or variables else 0
    return {
        "origin": unit.path.rpartition("/")[2],
        "interrupts": handles_interrupts(plan, unit),
        "includes": _includes(plan, source),
        "libraries": _libraries(plan),
        "rest": rest_levels(plan) if main_of(unit) is not None else [],
        "types": _retained([], source.unit, source.pieces(0, start, _elements(unit))),
        "adapters": adapters(plan, late),
        "prototype_headers": headers_of_types(elsewhere, unit),
        "variables": [{"variable": v, "head": _declared(v, plan)} for v in variables],
        "prototypes": [{"function": f, "head": _prototype(f, texts[unit_of(f)], plan)} for f in ahead],
        "code": _code(plan, source, start, main),
    }


def _elements(unit: ccode.SourceUnit) -> list[ccode.Located]:
    return [*unit.includes, *unit.macros, *unit.declarations]


def _includes(plan: migration.MigrationPlan, source: SourceText) -> list[dict[str, Any]]:
    """The standard headers to include at the head of the file, with the comments beside them."""
    return [
        {"decision": decision, "comment": _comment_beside(decision.element, source)}
        for decision in plan.dispositions
        if "standard-include" in decision.rules
        and isinstance(decision.element, ccode.Include)
        and ancestor_of_kind(decision.element, ccode.SourceUnit) is source.unit
    ]


def _libraries(plan: migration.MigrationPlan) -> list[tuple[str, list[migration.LibraryChoice]]]:
    """The headers of the chosen libraries that are used, each once, with the choices that selected it."""
    found: dict[str, list[migration.LibraryChoice]] = {}
    for choice in plan.libraryChoices:
        for header in list(choice.chosen.headers)[:1] if choice.chosen and choice.included else []:
            found.setdefault(header, [c for c in plan.libraryChoices if c.chosen is choice.chosen])
    return list(found.items())


def _code(plan: migration.MigrationPlan, source: SourceText, start: int, main: ccode.Function | None) -> list[MainPart]:
    """The code from an offset on, with main as setup and loop, and what moves out of it above."""
    unit, elements = source.unit, _elements(source.unit)
    parts: list[MainPart] = []
    if main is None:
        return _retained(parts, unit, source.pieces(start, len(source.data), elements))
    hoisted = list(hoisted_parts(plan, source, main))
    above = heading(source, main) if hoisted else main.startOffset
    _retained(parts, unit, source.pieces(start, above, elements))
    parts += hoisted
    _retained(parts, unit, source.pieces(above, main.startOffset, elements))
    parts += main_parts(plan, source, main)
    behind = main.endOffset
    if source.blank(behind, source.line_end(behind)):
        behind = source.line_end(behind)
    return _retained(parts, unit, _stripped(source.pieces(behind, len(source.data), elements)))


def _retained(parts: list[MainPart], unit: ccode.SourceUnit, pieces: Iterator[Piece]) -> list[MainPart]:
    """Append pieces to the parts, without blank lines that removed includes leave behind."""
    for piece in pieces:
        before = parts[-1].text if parts else "\n\n"
        text = piece.text.lstrip("\n") if before.endswith("\n\n") or before == "\n" else piece.text
        if not text:
            continue
        bindings = [b for change in piece.changes if isinstance(b := decision_of(change), migration.PortBinding)]
        connections = [b.connection for b in bindings if b.connection is not None]
        elements = [*(piece.elements or [unit]), *bindings, *connections]
        parts.append(MainPart(_lines(text), "hardware" if bindings else "code", "retained code", elements))
    return parts


def _lines(text: str) -> str:
    """The text with a line feed at its end."""
    return text if text.endswith("\n") else text + "\n"


def _stem(own: str, plan: migration.MigrationPlan) -> str:
    """The stem of a unit's .cpp file: its own, or its whole name with underscores if another unit has the same stem.

    An underscore comes before what a compiler would take for an option (`-x.c`) or for a file with options (`@x.c`).
    """
    stem = own.rpartition(".")[0]
    names = [u.path.rpartition("/")[2] for u in plan.program.units] if plan.program is not None else []
    same = [n for n in names if n.rpartition(".")[0] == stem and not n.lower().endswith(HEADERS)]
    alone = len(same) == 1 and stem != plan.name
    return f"{'_' if own.startswith(('-', '@')) else ''}{stem if alone else own.replace('.', '_')}"


def _comment_beside(include: ccode.Include, source: SourceText) -> str:
    """The comment on the line of an include, if it ends there."""
    end = source.line_end(include.endOffset)
    found = [c for c in source.comments_in(include.endOffset, end) if c.endOffset <= end]
    return source.slice(found[0].startOffset, found[-1].endOffset)[0].strip() if found else ""


def _called_in(adapter: migration.AdapterUse, unit: ccode.SourceUnit) -> bool:
    return any(ancestor_of_kind(call, ccode.SourceUnit) is unit for call in adapter.calls)


def _stripped(pieces: Iterator[Piece]) -> Iterator[Piece]:
    """The pieces, the first one without leading blanks."""
    for number, piece in enumerate(pieces):
        yield piece if number else replace(piece, text=piece.text.lstrip(" \t"))


def _used_before(function: ccode.Function, unit: ccode.SourceUnit, prototypes: Sequence[ccode.Function]) -> bool:
    """Whether a function is used before its definition and before all its prototypes."""
    if is_member(function):
        return False
    uses = [use.startOffset for use in (*function.calls, *function.references) if ancestor_of_kind(use, ccode.SourceUnit) is unit]
    uses += [use.startOffset for p in prototypes for use in (*p.calls, *p.references)]
    first = min(uses, default=function.startOffset)
    return first < function.startOffset and all(p.startOffset > first for p in prototypes)


def _declared(variable: ccode.Variable, plan: migration.MigrationPlan) -> str:
    """The declaration of a variable that another file defines."""
    use = variable.valueType
    spelled = f"{use.spelling} {use.arrayDims or ''}".strip() if use is not None else "int"
    wide = retyped(spelled) if plan.widths is migration.Widths.fix else spelled
    return f"extern {declare(wide, str(variable.name))}"


def _prototype(function: ccode.Function, source: SourceText, plan: migration.MigrationPlan) -> str:
    """The prototype of a function; of an old-style (K&R) definition that a C target keeps, one without parameters."""
    head = _head_of(function, source)
    if target_of(plan).language != "C" or ";" not in head:
        return head
    start = head.partition("(")[0].rstrip()
    return f"{'int ' if start == function.name else ''}{start}()"


def _head_of(function: ccode.Function, source: SourceText) -> str:
    """A function's head as it is in the sketch, without body and comments."""
    assert function.body is not None
    parts, position = [], function.startOffset
    for comment in source.comments_in(function.startOffset, function.body.startOffset):
        parts.append(source.slice(position, comment.startOffset)[0])
        position = comment.endOffset
    return " ".join("".join([*parts, source.slice(position, function.body.startOffset)[0]]).split())
