"""How many steps a program distinguishes, such as the modes that a button cycles through, or the entries of a list.

A variable counts if the program itself advances it: by increments, by computing it from its previous value, or from one
constant to another like the state of a state machine. The numbers it is compared with, its modulus, the cases that it selects
and the sizes of arrays it indexes tell how far it goes. Counters of for loops are left out, since they run through at once.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents
from robosmi.transformations.queries.numbers import COMPARISONS
from robosmi.transformations.queries.place_names import named, names_within
from robosmi.transformations.queries.values import Values

_STEPS = frozenset(["+=", "-="])
_SIZE = re.compile(r"\[\s*(\d+)\s*\]")
_STATES = 3
"""Number of different constants from which on a variable counts as the state of a state machine."""
_MOST = 16
"""Greatest number of steps that counts: a short scenario cannot take more."""


def most_steps(program: ccode.Program) -> int:
    """The greatest number of steps after which the program treats a variable differently; 0 if there is none up to `_MOST`.

    Args:
        program: the program.
    """
    found = [0]
    for unit in program.units:
        values = Values(program, unit)
        elements = list(all_contents(unit))
        moved = _moved(elements, values)
        for element in elements:
            found += [number for number in _told_apart(element, moved, values) if 1 < number <= _MOST]
    return max(found)


def _moved(elements: list[Element], values: Values) -> set[str]:
    """The names of the variables and members that a program advances; a member's name begins with a point."""
    moved: set[str] = set()
    constants: dict[str, set[int]] = {}
    for element in elements:
        if isinstance(element, ccode.Unary) and str(element.operator) in ("++", "--") and not _counts_a_loop(element):
            moved.update(named(element.operand))
        elif isinstance(element, ccode.Assignment) and not _counts_a_loop(element):
            name = next(named(element.left), None)
            if name is None:
                continue
            if str(element.operator) in _STEPS or name in names_within(element.right):
                moved.add(name)
            constants.setdefault(name, set()).update(v.number for v in values.of(element.right) if v.number is not None)
    return moved | {name for name, numbers in constants.items() if len(numbers) >= _STATES}


def _told_apart(element: Element, moved: set[str], values: Values) -> Iterator[int]:
    """The numbers of steps after which an element distinguishes values of an advanced variable."""
    if isinstance(element, ccode.Binary):
        for side, other in ((element.left, element.right), (element.right, element.left)):
            if moved.isdisjoint(names_within(side)):
                continue
            numbers = [v.number for v in values.of(other) if v.number is not None]
            if str(element.operator) in COMPARISONS:
                yield from (number + 1 for number in numbers)
            elif str(element.operator) == "%" and side is element.left:
                yield from numbers
    elif isinstance(element, ccode.Switch) and not moved.isdisjoint(names_within(element.selector)):
        for case in all_contents(element):
            if isinstance(case, ccode.Case):
                yield from (v.number + 1 for v in values.of(case.constant) if v.number is not None)
    elif isinstance(element, ccode.Index) and not moved.isdisjoint(names_within(element.index)):
        target = element.array.target if isinstance(element.array, ccode.NameReference) else None
        if isinstance(target, ccode.Variable) and target.valueType is not None:
            size = _SIZE.match(str(target.valueType.arrayDims))
            yield from (int(size[1]),) if size is not None else ()


def _counts_a_loop(element: Element) -> bool:
    """Whether an element is part of the first clause or the step of a for loop."""
    within: Element | None = element
    while within is not None and not isinstance(within, ccode.Statement):
        holder = within.eContainer()
        if isinstance(holder, ccode.For) and within in (holder.initial, holder.step):
            return True
        within = holder
    return False
