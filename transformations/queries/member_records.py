"""Which record the member in an expression belongs to, so that equally named members of two records are told apart.

A record is identified by a key that is the same in every file: its name and the names of its members, or its place if it has no
name. Records that only foreign headers declare, and expressions of unknown type, have no key: such a member may belong to any
record. `record_members` handles record types that the program does not declare.
"""

from __future__ import annotations

from collections.abc import Hashable

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.expression_type import ValueType, of_use, type_of


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
