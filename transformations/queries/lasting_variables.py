"""The variables of a plan's program that take data memory as long as it runs, and what is done with them where they are named.

A compiler keeps what changes and is read; numbers that never change it puts into the code, what nothing reads it leaves out.
How many bytes a type takes is `type_sizes`' business.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from typing import Any, NamedTuple

from robosmi.metamodels import ccode, migration
from robosmi.model.strict import Element
from robosmi.query import all_of_kind
from robosmi.transformations.queries.live_code import identity, in_macros, is_global
from robosmi.transformations.queries.type_sizes import TypeSizes

_COUNTS = ("++", "--")


class Share(NamedTuple):
    """What takes part of the memory: its name, its bytes, and the line of the source where it is declared, 0 for none."""

    name: str
    bytes: int
    line: int = 0


def lasting_variables(
    plan: migration.MigrationPlan, live: Sequence[Element], sizes: TypeSizes, ignored: Set[int]
) -> tuple[list[Share], list[str]]:
    """The variables that take memory, and the names of those whose size the models do not tell.

    Args:
        plan: the plan.
        live: what may be carried out (`live_code`).
        sizes: of types on the target.
        ignored: identities of arguments of which nothing is made.
    """
    uses: dict[int | str, list[ccode.NameReference]] = {}
    for element in live:
        if (
            isinstance(element, ccode.NameReference)
            and isinstance(element.target, ccode.Variable)
            and not is_ignored(element, ignored)
        ):
            uses.setdefault(identity(element.target), []).append(element)
    shares, unknown, seen = [], [], set[str]()
    named = in_macros(plan.program.units if plan.program is not None else ())
    for variable in lasting(plan, live):
        name = str(variable.name)
        if is_global(variable) and variable.storage.name != "staticStorage":
            if name in seen or variable.storage.name == "externStorage":
                continue  # declared in several files
            seen.add(name)
        references = uses.get(identity(variable), [])
        if not _kept(variable, references) and name not in named:
            continue
        size = sizes.of(variable.valueType)
        if size is None:
            unknown.append(name)
        else:
            shares.append(Share(name, size, int(variable.line)))
    return shares, unknown


def lasting(plan: migration.MigrationPlan, live: Sequence[Element]) -> Iterator[ccode.Variable]:
    """The variables that last: of files, static ones, and those that are moved out of main."""
    moved = {id(v) for d in plan.dispositions if d.hoisted is not None for v in _declared(d.element)}
    for element in live:
        if not isinstance(element, ccode.Variable):
            continue
        if is_global(element) or id(element) in moved or element.storage.name == "staticStorage":
            yield element


def _declared(element: Element | None) -> Iterable[ccode.Variable]:
    return [element] if isinstance(element, ccode.Variable) else all_of_kind(element, ccode.Variable)


def _kept(variable: ccode.Variable, references: Sequence[ccode.NameReference]) -> bool:
    """Whether a compiler has to keep a variable: it changes and is read, or it is an array of which any element may be asked."""
    use = variable.valueType
    if "volatile" in str(use.spelling if use is not None else ""):
        return bool(references)
    ways = {way(each) for each in references}
    if "address" in ways:
        return True
    if "read" not in ways and "any" not in ways:
        return False
    return "written" in ways or "any" in ways or "both" in ways


def is_ignored(reference: Any, ignored: Set[int]) -> bool:
    """Whether an expression stands in an argument of which nothing is made."""
    element: Element | None = reference
    while isinstance(element, ccode.Expression):
        if id(element) in ignored:
            return True
        if isinstance(element, ccode.Assignment):
            return element.operator == "=" and id(element.right) in ignored
        if isinstance(element, ccode.Call):
            return False
        element = element.eContainer()
    return False


def way(reference: ccode.NameReference) -> str:
    """What is done at a reference: read, written, both, its address taken, or any element read."""
    element: ccode.Located = reference
    indexed = False
    container: Any = element.eContainer()
    while (isinstance(container, ccode.Index) and container.array is element) or isinstance(container, ccode.Member):
        indexed = indexed or (isinstance(container, ccode.Index) and not isinstance(container.index, ccode.IntegerLiteral))
        element, container = container, container.eContainer()
    if isinstance(container, ccode.SizeOf):
        return "size"
    if isinstance(container, ccode.Unary) and container.operator == "&":
        return "address"
    if isinstance(container, ccode.Unary) and container.operator in _COUNTS:
        return "written" if isinstance(container.eContainer(), (ccode.ExpressionStatement, ccode.For)) else "both"
    if isinstance(container, ccode.Assignment) and container.left is element:
        return "written" if isinstance(container.eContainer(), (ccode.ExpressionStatement, ccode.For)) else "both"
    target: Any = reference.target
    if target.valueType is not None and target.valueType.arrayDims and element is reference:
        return "address"
    return "any" if indexed else "read"
