"""Which record the member in an expression belongs to, so that equally named members of two records are told apart.

A record is identified by a key that is the same in every file: its name and the names of its members, or its place if it has no
name. Records that only foreign headers declare, and expressions of unknown type, have no key: such a member may belong to any
record. `record_members` handles record types that the program does not declare.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import ARITHMETIC, ValueType, field_of, of_use, parse, type_of
from robosmi.transformations.queries.flows.cores import handed_over
from robosmi.transformations.queries.initialisers import record_of

_BYTES = ARITHMETIC | {"void"}
"""Words of the types by which a record's memory is accessed without its members."""
_COPIES = frozenset({"memcpy", "memmove"})


def record_of_member(member: ccode.Member) -> Hashable | None:
    """The key of the record whose member an expression names, None where the model does not say it."""
    kind = _object_type(member.object)
    record = kind.declaration if kind is not None else None
    if not isinstance(record, ccode.Record) or all(field.name != member.name for field in record.fields):
        return None  # a member of a base class or of a record without a name within, too
    return record_key(record)


def record_key(record: Element | None) -> Hashable | None:
    """What a record is known by in every file, None for anything else and for a record whose members are not known."""
    if not isinstance(record, ccode.Record) or not record.fields:
        return None
    if not record.name:
        unit = ancestor_of_kind(record, ccode.SourceUnit)
        return (str(unit.path) if unit is not None else "", int(record.startOffset))
    return (str(record.name), *(str(field.name) for field in record.fields))


def whole_of_member(member: ccode.Member) -> ccode.Expression | None:
    """The object that a member of an anonymous nested record belongs to; None for any other member.

    The code model does not have the members of an anonymous nested record, so the whole nested record stands for them.
    """
    held = member.object.array if isinstance(member.object, ccode.Index) else member.object
    kind = type_of(held, {}) if isinstance(held, ccode.Member) else None
    nameless = kind is not None and kind.declaration is None and not kind.base and not kind.function
    return held if nameless else None


def records_of_cast(cast: ccode.Cast) -> tuple[ccode.Record, ccode.Record] | None:
    """The two records of which a cast makes one from the other, both by pointers; None for any other cast."""
    made, given = of_use(cast.target), _object_type(cast.operand)
    one, other = (kind.declaration if kind is not None and kind.depth else None for kind in (made, given))
    return (one, other) if isinstance(one, ccode.Record) and isinstance(other, ccode.Record) and one is not other else None


def _object_type(expression: ccode.Expression | None) -> ValueType | None:
    """The type of the object or pointer that a member is accessed through."""
    if isinstance(expression, ccode.ConditionalExpression):
        return _object_type(expression.whenTrue) or _object_type(expression.whenFalse)
    if isinstance(expression, ccode.Assignment):
        return _object_type(expression.left)
    if isinstance(expression, ccode.Unary) and str(expression.operator) in ("++", "--"):
        return _object_type(expression.operand)
    if isinstance(expression, ccode.Binary) and str(expression.operator) == ",":
        return _object_type(expression.right)
    return type_of(expression, {})


def records_as_bytes(view: CodeView) -> Iterator[tuple[ccode.Record, ccode.Expression]]:
    """The records of a unit whose memory may be written without their members, each with the expression that hands it on.

    A pointer to such a record becomes one to numbers or to nothing known (`memset(&lamp, 0, 4)`, `char *p = &lamp`), or one to a
    member goes on to others (`int *p = &lamp.pin; p[1] = 5`) or to that of any object (`&Lamp::pin`).
    """
    for element in view.elements:
        if isinstance(element, ccode.Unary) and element.operator == "&" and (field := _pointed_member(element)) is not None:
            if isinstance(record := field.eContainer(), ccode.Record):
                yield record, element
            continue
        if isinstance(element, (ccode.NameReference, ccode.Member, ccode.Unary, ccode.Index, ccode.Call)):
            taker, given = _taker(element)
            kind = type_of(element, {}) if taker is not None else None
            if kind is not None and kind.depth and isinstance(kind.declaration, ccode.Record):
                if _is_bytes(taker, given, kind.declaration, view):
                    yield kind.declaration, element


def deep_fields(record: ccode.Record) -> Iterator[ccode.Field]:
    """The members of a record and of the records in it."""
    for field in record.fields:
        yield field
        inner = record_of(field.valueType)
        if inner is not None and inner is not record:
            yield from deep_fields(inner)


def has_several_types(union: ccode.Record) -> bool:
    """Whether the members of a union do not all have one type, so that one may be a part of another."""
    return len({(f.valueType and str(f.valueType.canonical or f.valueType.spelling), f.bitWidth) for f in union.fields}) > 1


def _pointed_member(address: ccode.Unary) -> ccode.Field | None:
    """The member whose address leads to others: that of no object, or one that a pointer is moved from."""
    operand = address.operand
    if isinstance(operand, ccode.NameReference):
        return operand.target if isinstance(operand.target, ccode.Field) else None
    if not isinstance(operand, ccode.Member):
        return None
    taker, given = _taker(address)
    if isinstance(taker, ccode.NameReference):
        taker = taker.target
    elif isinstance(taker, ccode.Call):
        place = list(taker.arguments).index(given)  # type: ignore[arg-type]
        parameters = list(taker.callee.parameters) if isinstance(taker.callee, ccode.Function) else []
        taker = parameters[place] if place < len(parameters) else None
    moved = isinstance(taker, (ccode.Variable, ccode.Parameter)) and any(map(_is_moved, taker.references))
    return field_of(operand, {}) if moved else None


def _is_moved(pointer: ccode.NameReference) -> bool:
    """Whether a use of a pointer leads to what is beside the thing that it points to."""
    around = pointer.eContainer()
    if isinstance(around, ccode.Index):
        index = around.index
        return around.array is pointer and not (isinstance(index, ccode.IntegerLiteral) and index.value == 0)
    operators = ("++", "--", "+", "-", "+=", "-=")
    return isinstance(around, (ccode.Unary, ccode.Binary, ccode.Assignment)) and str(around.operator) in operators


def _taker(expression: ccode.Expression) -> tuple[Element | None, Element]:
    """What is given an expression's value, through conversions to `void *`, and the expression that it is given; else None."""
    given: Element = expression
    taker = given.eContainer()
    while isinstance(taker, (ccode.Cast, ccode.ConditionalExpression)):
        if isinstance(taker, ccode.Cast) and taker.target is not None and parse(str(taker.target.canonical)).base != "void":
            return taker, given
        given, taker = taker, taker.eContainer()
    if isinstance(taker, ccode.Assignment):
        return (taker.left, given) if taker.right is given and taker.operator == "=" else (None, given)
    if isinstance(taker, ccode.Call):
        return (taker, given) if given in list(taker.arguments) else (None, given)
    return (taker, given) if isinstance(taker, (ccode.Variable, ccode.Return)) else (None, given)


def _is_bytes(taker: Element | None, given: Element, record: ccode.Record, view: CodeView) -> bool:
    """Whether what takes a pointer to a record may write its memory without its members."""
    if isinstance(taker, ccode.Call):
        place = list(taker.arguments).index(given)  # type: ignore[arg-type]
        callee = taker.callee
        parameters = list(callee.parameters) if isinstance(callee, ccode.Function) else []
        if isinstance(callee, ccode.Function) and callee.definition and place < len(parameters):
            return _is_bytes(parameters[place], given, record, view)
        if place < len(parameters) and (kind := of_use(parameters[place].valueType)) is not None and kind.constant:
            return False
        if str(taker.calleeName) in _COPIES:
            others = [_object_type(each) for number, each in enumerate(taker.arguments) if number < 2 and number != place]
            return not place and any(other is None or other.declaration is not record for other in others)
        return handed_over(taker, view.api)[0] is not given
    use = taker.target if isinstance(taker, ccode.Cast) else None
    if isinstance(taker, ccode.Return):
        function = ancestor_of_kind(taker, ccode.Function)
        use = function.returnType if function is not None else None
    elif isinstance(taker, (ccode.Variable, ccode.Parameter)):
        use = taker.valueType
    elif isinstance(taker, ccode.Expression) and not isinstance(taker, ccode.Cast):
        kind = type_of(taker, {})
        use = kind.use if kind is not None else None
    base = parse(str(use.canonical or use.spelling)).base if use is not None else ""
    if not base or not set(base.split()) <= _BYTES:
        return False
    return base != "void" or not isinstance(taker, (ccode.Variable, ccode.Parameter)) or not _only_as_record(taker)


def _only_as_record(pointer: ccode.Variable | ccode.Parameter) -> bool:
    """Whether every use of a pointer to `void` makes it one to a record."""
    for reference in pointer.references:
        taker: Element | None = reference.eContainer()
        use = taker.target if isinstance(taker, ccode.Cast) else taker.valueType if isinstance(taker, ccode.Variable) else None
        kind = of_use(use)
        if isinstance(taker, ccode.Assignment):
            kind = type_of(taker.left, {})
        if kind is None or not isinstance(kind.declaration, ccode.Record):
            return False
    return True
