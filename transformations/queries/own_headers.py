"""Headers of the program's own that are carried over with it, and what of other files a file uses without them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.source_text import FilesByName, header_file, is_header, meant_unit

_QUALIFIED = re.compile(r"::\s*~?\w+\s*$")
"""The name of a function that is defined outside of its class or namespace."""


def file_of(include: ccode.Include) -> ccode.SourceUnit:
    """The unit that contains an include."""
    unit = include.eContainer()
    assert isinstance(unit, ccode.SourceUnit)
    return unit


def own_header(include: ccode.Include) -> str:
    """File name in the sketch of the program's own header that an include means, empty where it was not carried over."""
    header = _meant_header(include)
    return in_sketch(header) if header is not None else ""


def _meant_header(include: ccode.Include, files: FilesByName | None = None) -> ccode.SourceUnit | None:
    """The program's own header that an include means, None where it was not carried over."""
    unit = meant_unit(include) if files is None else files.meant(include)
    return unit if unit is not None and is_header(unit) else None


def unit_of(element: ccode.Located) -> ccode.SourceUnit:
    """The unit that contains an element."""
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    assert unit is not None
    return unit


def included(unit: ccode.SourceUnit) -> list[ccode.SourceUnit]:
    """The program's own headers that a unit includes, those that they include too, in the order of the text."""
    return [header for _, header in _met([unit]) if header is not None]


def all_includes(unit: ccode.SourceUnit) -> tuple[str, ...]:
    """The headers that a unit includes, those within the program's own headers at their place; for such a header, also those of
    the files that include it."""
    program = unit.program
    if program is None or not any(is_header(u) for u in program.units):
        return tuple(str(include.header) for include in unit.includes)
    around = [u for u in program.units if unit in included(u)] if is_header(unit) else []
    return tuple(dict.fromkeys(str(include.header) for include, _ in _met([unit, *around])))


def includes_of_units(program: ccode.Program) -> dict[int, tuple[str, ...]]:
    """What `all_includes` gives for each unit of a program, by the unit's `id`; each include is looked up once."""
    files = FilesByName(program)
    meant = {id(include): _meant_header(include, files) for unit in program.units for include in unit.includes}
    including: dict[int, list[ccode.SourceUnit]] = {}
    for unit in program.units:
        for _, header in _met([unit], meant):
            if header is not None:
                including.setdefault(id(header), []).append(unit)
    found: dict[int, tuple[str, ...]] = {}
    for unit in program.units:
        around = including.get(id(unit), []) if is_header(unit) else []
        found[id(unit)] = tuple(dict.fromkeys(str(include.header) for include, _ in _met([unit, *around], meant)))
    return found


def _met(
    units: Iterable[ccode.SourceUnit], meant: Mapping[int, ccode.SourceUnit | None] | None = None
) -> Iterator[tuple[ccode.Include, ccode.SourceUnit | None]]:
    """The includes of units in preprocessing order, each with the own header that it includes first, or None."""
    seen: set[int] = set()
    files: FilesByName | None = None
    for unit in units:
        files = files or FilesByName(unit.program)
        pending = list(reversed(unit.includes))
        while pending:
            include = pending.pop()
            header = _meant_header(include, files) if meant is None else meant[id(include)]
            first = header if header is not None and id(header) not in seen else None
            if first is not None:
                seen.add(id(first))
                pending += reversed(first.includes)
            yield include, first


def in_sketch(header: ccode.SourceUnit) -> str:
    """What a header of the program's own is called in the sketch."""
    return header_file(header.path.rpartition("/")[2])


def is_member(function: ccode.Function) -> bool:
    """Whether a function belongs to a class or a namespace, which declares it."""
    named = _QUALIFIED.search(str(function.signature or "").partition("(")[0]) is not None
    return named or isinstance(function.eContainer(), (ccode.Record, ccode.Namespace))


def undeclared(unit: ccode.SourceUnit) -> list[ccode.Function]:
    """The functions of other files that a unit calls and declares nowhere, as old C allows; by their first calls."""
    declared = {d.name for u in (unit, *included(unit)) for d in u.declarations if isinstance(d, ccode.Function)}
    found: dict[str, ccode.Function] = {}
    for call in sorted(all_of_kind(unit, ccode.Call), key=_start):
        callee = call.callee
        if callee is None or not callee.definition or callee.name in declared or is_member(callee):
            continue
        if ancestor_of_kind(callee, ccode.SourceUnit) in (None, unit):  # None: a header defines it that was not carried over
            continue
        found.setdefault(str(callee.name), callee)
    return list(found.values())


def undeclared_variables(unit: ccode.SourceUnit) -> list[ccode.Variable]:
    """The variables of other files that a unit uses and that only a header of the platform declares to it; by first uses."""
    seen = (unit, *included(unit))
    declared = {d.name for u in seen for d in u.declarations} | {m.name for u in seen for m in u.macros}
    units = [u for u in (unit.program.units if unit.program is not None else ()) if u is not unit and not is_header(u)]
    shared = {
        str(d.name): d
        for u in units
        for d in u.declarations
        if isinstance(d, ccode.Variable) and d.storage.name == "unspecified" and d.name not in declared
    }
    found: dict[str, ccode.Variable] = {}
    for use in sorted(all_of_kind(unit, ccode.NameReference), key=_start) if shared else ():
        outside = isinstance(use.target, ccode.ExternalSymbol) or use.target is shared.get(str(use.name))
        if outside and use.name in shared:
            found.setdefault(str(use.name), shared[str(use.name)])
    return list(found.values())


def headers_of_types(functions: Iterable[ccode.Function], unit: ccode.SourceUnit) -> list[str]:
    """File names of the program's own headers that declare types of these functions and that a unit does not include."""
    seen = {id(header) for header in included(unit)}
    uses = (use for f in functions for use in (f.returnType, *(p.valueType for p in f.parameters)) if use is not None)
    units = (unit_of(use.declaration) for use in uses if use.declaration is not None and use.declaration.startOffset)
    return sorted({in_sketch(u) for u in units if is_header(u) and id(u) not in seen})


def own_macro(unit: ccode.SourceUnit | None, name: str) -> ccode.Macro | None:
    """The macro of that name that a unit or one of the program's own headers in it defines, whatever the platform calls so."""
    seen = (unit, *included(unit)) if unit is not None else ()
    return next((m for u in seen for m in u.macros if m.name == name), None)


def _start(element: ccode.Located) -> int:
    return int(element.startOffset)
