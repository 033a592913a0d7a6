"""The variables of a plan's program that take data memory as long as it runs.

A compiler keeps what changes and is read; numbers that never change it puts into the code, what nothing reads it leaves out
(`compiled_code`). How many bytes a type takes is `type_sizes`' business.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.model.strict import Element
from robosmi.query import all_of_kind
from robosmi.transformations.queries.compiled_code import CompiledCode, declared_in, is_volatile, uses_of, way
from robosmi.transformations.queries.live_code import identity, in_macros, is_global
from robosmi.transformations.queries.type_sizes import TypeSizes


class Share(Struct, frozen=True):
    """What takes part of the memory: its name, its bytes, and the line of the source where it is declared, 0 for none."""

    name: str
    bytes: int
    line: int = 0


def lasting_variables(plan: migration.MigrationPlan, code: CompiledCode, sizes: TypeSizes) -> tuple[list[Share], list[str]]:
    """The variables that take memory, and the names of those whose size the models do not tell.

    Args:
        plan: the plan.
        code: what is left of its program.
        sizes: of types on the target.
    """
    uses = uses_of(code.elements, code.ignored)
    shares, unknown, seen = [], [], set[int | str]()
    units = list(plan.program.units) if plan.program is not None else []
    named = in_macros(units)
    for variable in (*lasting(plan, code.elements), *_volatile(units)):
        name, key = str(variable.name), identity(variable)
        if key in seen or variable.storage.name == "externStorage":
            continue  # declared in several files
        seen.add(key)
        if not is_volatile(variable) and name not in named and not _kept(variable, uses.get(key, []), code):
            continue
        size = sizes.of(variable.valueType)
        if size is None:
            unknown.append(name)
        else:
            shares.append(Share(name, size, int(variable.line)))
    return shares, unknown


def lasting(plan: migration.MigrationPlan, live: Sequence[Element]) -> Iterator[ccode.Variable]:
    """The variables that last: of files, static ones, and those that are moved out of main."""
    moved = {id(v) for d in plan.dispositions if d.hoisted is not None for v in declared_in(d.element)}
    for element in live:
        if not isinstance(element, ccode.Variable):
            continue
        if is_global(element) or id(element) in moved or element.storage.name == "staticStorage":
            yield element


def _volatile(units: Sequence[ccode.SourceUnit]) -> Iterator[ccode.Variable]:
    """The variables that are kept even where nothing that runs names them: each access to them counts."""
    for unit in units:
        for variable in all_of_kind(unit, ccode.Variable):
            lasts = is_global(variable) or variable.storage.name == "staticStorage"
            if lasts and is_volatile(variable) and (variable.storage.name == "unspecified" or variable.references):
                yield variable


def _kept(variable: ccode.Variable, references: Sequence[ccode.NameReference], code: CompiledCode) -> bool:
    """Whether a compiler has to keep a variable: it changes and is read, or it is an array of which any element may be asked."""
    ways = {way(each) for each in references} - {"size"}
    if identity(variable) in code.unread and "address" not in ways:
        return False
    if identity(variable) in code.fixed:
        return "any" in ways or "address" in ways
    return bool(ways)
