"""Which element of an array or member of a structure each value of an initialiser list belongs to, by order or designator."""

from __future__ import annotations

import re
from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.queries.expression_type import is_padding, nameless

_DIMENSION = re.compile(r"\[[^\]]*\]")
_NAMES = 20
"""Number of nested typedefs that are followed at most."""


def record_of(use: ccode.TypeUse | None) -> ccode.Record | None:
    """The structure that a type, or the element type of an array, denotes, through typedefs; None for any other type."""
    for _ in range(_NAMES):
        declaration = use.declaration if use is not None and not use.pointerDepth else None
        if not isinstance(declaration, ccode.Typedef):
            declaration = declaration or (nameless(use) if use is not None and not use.pointerDepth else None)
            return declaration if isinstance(declaration, ccode.Record) else None
        use = declaration.aliased
        if use is not None and use.declaration is None and not use.pointerDepth:
            return _without_name(declaration)
    return None


def _without_name(definition: ccode.Typedef) -> ccode.Record | None:
    """The anonymous structure that a `typedef struct { ... } Name` defines, found by its place within that typedef."""
    unit = definition.eContainer()
    start, end = definition.startOffset, definition.endOffset
    declared = unit.declarations if isinstance(unit, ccode.SourceUnit) else ()
    records = (d for d in declared if isinstance(d, ccode.Record) and not d.name)
    return next((record for record in records if start <= record.startOffset < end), None)


def is_designated(element: ccode.Located) -> bool:
    """Whether an element of an initialiser list is designated: `.name = value`, `[index] = value`."""
    left = element.left if isinstance(element, ccode.Assignment) else None
    return isinstance(left, ccode.Member) or (isinstance(left, ccode.Index) and left.array is None)


def value_in(element: ccode.Expression | None) -> ccode.Expression | None:
    """The value of an element of an initialiser list, without its designator."""
    return element.right if isinstance(element, ccode.Assignment) and is_designated(element) else element


def leaves(expression: ccode.Expression | None) -> Iterator[ccode.Expression]:
    """The values in an initialiser, those of nested lists too."""
    if isinstance(expression, ccode.InitializerList):
        for inner in expression.elements:
            yield from leaves(value_in(inner))
    elif expression is not None:
        yield expression


def members_given(
    use: ccode.TypeUse | None, initialiser: ccode.InitializerList
) -> Iterator[tuple[ccode.Field, ccode.Expression]]:
    """Each value in the initialiser of a structure, or of an array of them, with the member that it goes to.

    Where inner braces are left out, any value may go to any member.

    Args:
        use: the type of what is initialised.
        initialiser: the list.
    """
    record = record_of(use)
    if record is None or use is None:
        return
    members = [field for field in record.fields if field.name or not is_padding(field)]
    inside = [value for element in initialiser.elements if (value := value_in(element)) is not None]
    if use.arrayDims:
        inner = ccode.TypeUse(arrayDims=_DIMENSION.sub("", use.arrayDims, count=1) or None, declaration=record)
        for one in inside:
            if isinstance(one, ccode.InitializerList):
                yield from members_given(inner, one)
            else:
                yield from ((member, one) for member in members)
        return
    places = {str(member.name): place for place, member in enumerate(members)}
    place = 0
    for element, value in zip(initialiser.elements, inside, strict=True):
        left = element.left if isinstance(element, ccode.Assignment) and is_designated(element) else None
        place = places.get(str(left.name), place) if isinstance(left, ccode.Member) else place
        member = members[place] if place < len(members) else None
        place += 1
        if member is None:
            continue
        if record_of(member.valueType) is None:
            yield from ((member, leaf) for leaf in leaves(value))
        elif isinstance(value, ccode.InitializerList):
            yield from members_given(member.valueType, value)
