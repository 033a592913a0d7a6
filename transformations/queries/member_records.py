"""Which record the member in an expression belongs to, so that equally named members of two records are told apart.

A record is identified by a key that is the same in every file: its name and the names of its members, or its place if it has no
name. Records that only foreign headers declare, and expressions of unknown type, have no key: such a member may belong to any
record. `record_members` handles record types that the program does not declare.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from typing import TypeAlias

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import ARITHMETIC, ValueType, field_of, of_use, parse, type_of
from robosmi.transformations.queries.initialisers import record_of

_BYTES = ARITHMETIC | {"void"}
"""Words of the types by which a record's memory is accessed without its members."""
Handed: TypeAlias = Callable[[ccode.Call], "ccode.Expression | None"]
"""What a call hands to code that it starts on another core."""
_COPIES = frozenset({"memcpy", "memmove"})
_ADDRESSES = (
    ccode.NameReference, ccode.Member, ccode.Unary, ccode.Binary, ccode.Index, ccode.Call, ccode.UnknownExpression,
)  # fmt: skip


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


def records_as_bytes(
    view: CodeView,
    around: Callable[[Element], ccode.Record | None],
    handed_over: Callable[[ccode.Call, ApiIndex], tuple[ccode.Expression | None, ccode.Function | None]],
) -> Iterator[tuple[ccode.Record, ccode.Expression]]:
    """The records of a unit whose memory may be written without their members, each with the expression that hands it on.

    A pointer to such a record becomes one to numbers or to nothing known (`memset(&lamp, 0, 4)`, `char *p = &lamp`) or the other
    way round, or one to a member goes on to others (`int *p = &lamp.pin; p[1] = 5`) or to that of any object (`&Lamp::pin`).

    Args:
        view: the unit.
        around: the class whose member function contains an element.
        handed_over: what a call hands to code that it starts on another core.
    """
    for element in view.elements:
        if isinstance(element, _ADDRESSES):
            taker, given = _taker(element)
            if isinstance(element, ccode.Unary) and element.operator == "&":
                field = _pointed_member(element.operand, taker, given)
                if field is not None and isinstance(record := field.eContainer(), ccode.Record):
                    yield record, element
                    continue
            kind = type_of(element, {}) if taker is not None else None
            if isinstance(element, ccode.UnknownExpression):
                one: Element | None = around(element) if taker is not None and element.text == "this" else None
            else:
                one = kind.declaration if kind is not None and kind.depth else None
            if isinstance(one, ccode.Record):
                if _is_bytes(taker, given, one, lambda call: handed_over(call, view.api)[0]):
                    yield one, element
            elif kind is not None and kind.depth and set(kind.base.split()) <= ARITHMETIC:
                made = of_use(_type_of_taker(taker, given))
                if made is not None and isinstance(made.declaration, ccode.Record) and made.depth:
                    yield made.declaration, element


def all_fields(record: ccode.Record) -> Iterator[ccode.Field]:
    """The members of a record, of the records in it and of its base classes."""
    for base in map(record_of, record.bases):
        yield from all_fields(base) if base is not None and base is not record else ()
    for field in record.fields:
        yield field
        inner = record_of(field.valueType)
        if inner is not None and inner is not record:
            yield from all_fields(inner)


def has_several_types(union: ccode.Record) -> bool:
    """Whether the members of a union do not all have one type, so that one may be a part of another."""
    return len({(f.valueType and str(f.valueType.canonical or f.valueType.spelling), f.bitWidth) for f in union.fields}) > 1


def _pointed_member(operand: ccode.Expression | None, taker: Element | None, given: Element) -> ccode.Field | None:
    """The member whose address leads to others: that of no object, or one that a pointer is moved from."""
    if isinstance(operand, ccode.NameReference):
        return operand.target if isinstance(operand.target, ccode.Field) else None
    if not isinstance(operand, ccode.Member):
        return None
    if isinstance(taker, ccode.NameReference):
        taker = taker.target
    elif isinstance(taker, ccode.Call):
        taker = _parameter(taker, given)
    moved = isinstance(taker, (ccode.Variable, ccode.Parameter)) and any(map(_is_moved, taker.references))
    return field_of(operand, {}) if moved else None


def _parameter(call: ccode.Call, argument: Element) -> ccode.Parameter | None:
    """The parameter of a declared function that takes an argument."""
    parameters = list(call.callee.parameters) if isinstance(call.callee, ccode.Function) else []
    place = next(number for number, each in enumerate(call.arguments) if each is argument)
    return parameters[place] if place < len(parameters) else None


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
    if isinstance(given, ccode.Cast) and given.target is None and isinstance(taker, (ccode.Unary, ccode.Index)):
        return given, expression  # *reinterpret_cast<char *>(&lamp)
    if isinstance(taker, ccode.Assignment):
        return (taker.left, given) if taker.right is given and taker.operator == "=" else (None, given)
    if isinstance(taker, ccode.Call):
        return (taker, given) if any(each is given for each in taker.arguments) else (None, given)
    return (taker, given) if isinstance(taker, (ccode.Variable, ccode.Return)) else (None, given)


def _type_of_taker(taker: Element | None, given: Element) -> ccode.TypeUse | None:
    if isinstance(taker, ccode.Call):
        taker = _parameter(taker, given)
    if isinstance(taker, ccode.Cast):
        return taker.target
    if isinstance(taker, ccode.Return):
        function = ancestor_of_kind(taker, ccode.Function)
        return function.returnType if function is not None else None
    if isinstance(taker, (ccode.Variable, ccode.Parameter)):
        return taker.valueType
    kind = type_of(taker, {}) if isinstance(taker, ccode.Expression) else None
    return kind.use if kind is not None else None


def _is_bytes(taker: Element | None, given: Element, record: ccode.Record, handed: Handed) -> bool:
    """Whether what takes a pointer to a record may write its memory without its members."""
    use = _type_of_taker(taker, given)
    if isinstance(taker, ccode.Call):
        parameter = _parameter(taker, given)
        if not (isinstance(taker.callee, ccode.Function) and taker.callee.definition and parameter is not None):
            kind = of_use(use)
            return not (kind is not None and kind.constant) and _may_write(taker, given, record, handed)
        taker = parameter
    if isinstance(taker, ccode.Cast) and use is None:
        return True
    kind = of_use(use)
    base = parse(str(use.canonical or use.spelling)).base if use is not None else ""
    of_enumeration = kind is not None and isinstance(kind.declaration, ccode.Enumeration)
    if not base or not (of_enumeration or set(base.split()) <= _BYTES):
        return False
    return base != "void" or not isinstance(taker, (ccode.Variable, ccode.Parameter)) or not _only_as_record(taker)


def _may_write(call: ccode.Call, argument: Element, record: ccode.Record, handed: Handed) -> bool:
    """Whether a function that the program does not define may write other values into a record than such a record has."""
    if str(call.calleeName) in _COPIES:
        arguments = list(call.arguments)[:2]
        others = [_object_type(each) for each in arguments if each is not argument]
        return arguments[0] is argument and any(other is None or other.declaration is not record for other in others)
    return handed(call) is not argument


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
