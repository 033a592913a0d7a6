"""The variables of a plan's program that occupy data memory as long as it runs.

A compiler keeps variables that change and are read; it puts numbers that never change into the code and leaves out what nothing
reads (`compiled_code`). Sizes of types are computed by `type_sizes`.
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
    """A part of the data memory: the name of what takes it, its bytes, and its line in the source, 0 if it has none."""

    name: str
    bytes: int
    line: int = 0


def lasting_variables(plan: migration.MigrationPlan, code: CompiledCode, sizes: TypeSizes) -> tuple[list[Share], list[str]]:
    """The variables that occupy memory, with their sizes, and the names of those whose size the models do not tell.

    Args:
        plan: the plan.
        code: what a compiler keeps of its program.
        sizes: the sizes of types on the target.
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
    """The variables with static storage duration: globals, `static` locals, and locals that are moved out of main."""
    moved = {id(v) for d in plan.dispositions if d.hoisted is not None for v in declared_in(d.element)}
    for element in live:
        if not isinstance(element, ccode.Variable):
            continue
        if is_global(element) or id(element) in moved or element.storage.name == "staticStorage":
            yield element


def _volatile(units: Sequence[ccode.SourceUnit]) -> Iterator[ccode.Variable]:
    """The volatile variables, which a compiler keeps even if no reachable code names them."""
    for unit in units:
        for variable in all_of_kind(unit, ccode.Variable):
            lasts = is_global(variable) or variable.storage.name == "staticStorage"
            if lasts and is_volatile(variable) and (variable.storage.name == "unspecified" or variable.references):
                yield variable


def _kept(variable: ccode.Variable, references: Sequence[ccode.NameReference], code: CompiledCode) -> bool:
    """Whether a compiler keeps a variable: it changes and is read, or is an array that is read at an index not known before."""
    ways = {way(each) for each in references} - {"size"}
    if identity(variable) in code.unread and "address" not in ways:
        return False
    if identity(variable) in code.fixed:
        return "any" in ways or "address" in ways
    return bool(ways)
