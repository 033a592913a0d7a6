"""Constraints on memory that is scarcer or laid out differently on the target: the heap, and members of structures.

The amount of memory that a program needs is not a constraint: it is reported against the board's (`queries.resources.memory`).
"""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.constraints.code_move import move, moved, place, the_move, together
from robosmi.transformations.queries.expression_type import ARITHMETIC
from robosmi.transformations.queries.flows.cores import reached
from robosmi.transformations.queries.initialisers import record_of
from robosmi.transformations.queries.names import named_type
from robosmi.transformations.queries.resources.type_sizes import on_source, on_target
from robosmi.validate import Fail

SMALL = 65536
"""RAM in bytes below which a heap that only grows is soon exhausted."""
TAKING = frozenset(["malloc", "calloc", "realloc", "strdup"])
_GIVING = frozenset(["free", "realloc"])
_COPYING = frozenset(["memcpy", "memmove", "memcmp", "fread", "fwrite", "read", "write"])
"""Standard library functions that treat memory as bytes, in addition to those of the platform."""


def _small() -> int:
    """The target's RAM in bytes if it is small; 0 if it is not, or unknown."""
    board = the_move().plan.board if move() is not None else None
    chip = board.microcontroller if board is not None else None
    return int(chip.ramBytes) if chip is not None and chip.ramBytes < SMALL else 0


taking = moved.context(ccode.Call, guard=lambda call: call.calleeName in TAKING and move() is not None and bool(_small()))
units = moved.context(ccode.SourceUnit, guard=lambda _: move() is not None and the_move().plan.source is not None)


@taking.constraint(
    id="RS332", severity=Severity.warning, location=place,
    advice="allocate the memory once before the loop, declare an array, or free it with free() in each pass",
)  # fmt: skip
def IsTakenOnce(call: ccode.Call) -> bool | Fail:
    """Heap memory that is allocated in each iteration of a loop is freed there."""
    loop = _grows(call, ())
    if loop is None:
        return True
    return Fail(
        f"{call.calleeName} allocates heap memory in each pass of the loop in line {loop.line}, which frees none; "
        f"the target has {_small()} bytes of RAM"
    )


def _grows(element: Element, above: tuple[int, ...]) -> ccode.Loop | None:
    """The loop that executes an element repeatedly without freeing memory; it may be in a caller. None if there is none."""
    function = ancestor_of_kind(element, ccode.Function)
    loop = ancestor_of_kind(element, ccode.Loop)
    if loop is not None:
        return None if _gives_back([loop.body]) else loop
    if function is None or id(function) in above or _gives_back([function.body]):
        return None
    return next((found for each in function.calls if (found := _grows(each, (*above, id(function)))) is not None), None)


def _gives_back(bodies: Iterable[ccode.Statement | None]) -> bool:
    return any(isinstance(each, ccode.Call) and each.calleeName in _GIVING for each in reached(bodies))


@units.constraint(
    id="RS333", severity=Severity.warning, location=place,
    advice="write and read the members one by one, or add members that fill the gaps",
)  # fmt: skip
def KeepsItsLayout(unit: ccode.SourceUnit) -> bool | Fail:
    """No structure with another layout on the target is treated as bytes, by its size or through a pointer."""
    m = the_move()
    found = {
        id(each): (each, record) for each in m.view(unit).of_kind(ccode.Expression) if (record := _as_bytes(each)) is not None
    }
    sizes = {id(record): said for _, record in found.values() if (said := _sizes(record))}
    some = [each for each, record in found.values() if id(record) in sizes]
    if not some:
        return True
    told = list(dict.fromkeys(sizes[id(record)] for _, record in found.values() if id(record) in sizes))
    return together(f"structures that the program treats as bytes have another layout on the target: {'; '.join(told)}", some)


@units.constraint(
    id="RS349", severity=Severity.warning, location=place,
    advice="check what the program does with the number; write it out where the source's size is meant",
)  # fmt: skip
def KeepsItsSizes(unit: ccode.SourceUnit) -> bool | Fail:
    """No number that the program computes is a size that differs on the target."""
    found = {id(each): (each, said) for each in the_move().view(unit).of_kind(ccode.SizeOf) if (said := _differs(each))}
    if not found:
        return True
    told = list(dict.fromkeys(said for _, said in found.values()))
    return together(f"sizeof has another value on the target: {'; '.join(told)}", [each for each, _ in found.values()])


def _differs(size: ccode.SizeOf) -> str:
    """The message that a size differs between the platforms and is a number of the program; else empty."""
    plan = the_move().plan
    here, there = on_source(plan), on_target(plan)
    use = size.measured if size.operand is None else named_type(size.operand)
    if here is None or use is None or _is_amount(size):
        return ""
    if isinstance(size.operand, ccode.NameReference) and isinstance(size.operand.target, ccode.Parameter) and use.arrayDims:
        return ""  # the type that is declared is not the one that is measured
    before, after = here.of(use), there.of(use)
    if before is None or after is None or before == after or _keeps_bytes(record_of(use) or use.declaration):
        return ""
    return f"{str(use.spelling).strip()} has {after} bytes, not {before}"


def _is_amount(size: ccode.SizeOf) -> bool:
    """Whether a size is an amount of memory or a divisor, which are right on each platform by themselves."""
    parent = size.eContainer()
    while isinstance(parent, ccode.Cast) or (isinstance(parent, ccode.Binary) and parent.operator in ("*", "+")):
        parent = parent.eContainer()
    if isinstance(parent, ccode.Binary) and parent.operator in ("/", "%"):
        return True
    return isinstance(parent, ccode.Call) and (parent.calleeName in TAKING or parent.calleeName in _COPYING | {"memset"})


def _sizes(record: ccode.Record) -> str:
    """The message that a structure's size differs between the platforms; empty if it does not or is unknown."""
    plan = the_move().plan
    here, there = on_source(plan), on_target(plan)
    before, after = here.record(record) if here is not None else None, there.record(record)
    if before is None or after is None or before == after or _keeps_bytes(record):
        return ""
    return f"{_name(record)} has {after} bytes, not {before}"


def _keeps_bytes(declared: ccode.Declaration | None) -> bool:
    """Whether the plan gives a type the bytes that it has on the source; pointers in it have another size all the same."""
    kept = the_move().with_same_bytes
    if not isinstance(declared, ccode.Record):
        return id(declared) in kept
    inner = [record_of(each.valueType) for each in declared.fields]
    changed = any(id(each) in kept for each in (declared, *declared.fields)) or any(map(_keeps_bytes, inner))
    return changed and not any(each.valueType is not None and each.valueType.pointerDepth for each in declared.fields)


def _name(record: ccode.Record) -> str:
    if record.name:
        return f"'{record.name}'"
    unit = ancestor_of_kind(record, ccode.SourceUnit)
    declared = unit.declarations if unit is not None else ()
    named = (d for d in declared if isinstance(d, ccode.Typedef) and d.startOffset <= record.startOffset < d.endOffset)
    return next((f"'{d.name}'" for d in named), f"the structure of line {record.line}")


def _as_bytes(expression: ccode.Expression) -> ccode.Record | None:
    """The structure that an expression treats as bytes: its size in a copying function, or a cast of its address; else None."""
    if isinstance(expression, ccode.SizeOf):
        return _measured(expression) if _copies(expression) else None
    if isinstance(expression, ccode.Cast) and expression.target is not None and expression.target.pointerDepth == 1:
        base = str(expression.target.canonical or "").replace("*", "").split()
        if base and set(base) - {"const", "volatile"} <= ARITHMETIC:
            return _pointed_at(expression.operand)
    return None


def _measured(size: ccode.SizeOf) -> ccode.Record | None:
    if size.measured is None:
        return _record_of_value(size.operand)
    return record_of(size.measured) or record_of(ccode.TypeUse(declaration=_declared(str(size.measured.spelling or ""))))


def _declared(spelling: str) -> ccode.Declaration | None:
    """The structure or typedef with the name that a type is spelled with."""
    name = spelling.removeprefix("struct ").removeprefix("union ").strip()
    declared = (d for unit in the_move().program.units for d in unit.declarations)
    return next((d for d in declared if isinstance(d, (ccode.Record, ccode.Typedef)) and d.name == name), None)


def _record_of_value(expression: ccode.Expression | None) -> ccode.Record | None:
    if isinstance(expression, ccode.NameReference):
        declared = named_type(expression)
        return record_of(declared) if declared is not None and not declared.pointerDepth else None
    if isinstance(expression, ccode.Unary) and expression.operator == "*":
        return _pointed_at(expression.operand)
    return None


def _pointed_at(expression: ccode.Expression | None) -> ccode.Record | None:
    """The structure that a pointer points to according to its declaration."""
    if isinstance(expression, ccode.Unary) and expression.operator == "&":
        inner = expression.operand
        return _record_of_value(inner.array if isinstance(inner, ccode.Index) else inner)
    declared = named_type(expression)
    if declared is None:
        return None
    if declared.pointerDepth == 1:
        return record_of(ccode.TypeUse(declaration=declared.declaration))
    return record_of(declared) if declared.arrayDims and not declared.pointerDepth else None


def _copies(size: ccode.SizeOf) -> bool:
    """Whether a size, possibly multiplied, is an argument of a function that treats memory as bytes."""
    element = size
    parent = element.eContainer()
    while isinstance(parent, ccode.Cast) or (isinstance(parent, ccode.Binary) and parent.operator == "*"):
        parent = parent.eContainer()
    if not isinstance(parent, ccode.Call):
        return False
    served = {id(call) for use in the_move().plan.adapterUses for call in use.calls}
    return parent.calleeName in _COPYING or id(parent) in served
