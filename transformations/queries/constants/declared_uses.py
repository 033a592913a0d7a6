"""Where a program uses its variables, parameters and members: names, and members of objects, which the model does not link."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import type_of

Declared = ccode.Variable | ccode.Parameter | ccode.Field


class DeclaredUses:
    """The uses of what holds values.

    Args:
        views: a view of each unit of the program.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._views = views

    @cached_property
    def _fields(self) -> dict[str, list[ccode.Field]]:
        found: dict[str, list[ccode.Field]] = {}
        for view in self._views:
            for field in view.of_kind(ccode.Field):
                found.setdefault(str(field.name), []).append(field)
        return found

    @cached_property
    def _members(self) -> dict[int, list[ccode.Member]]:
        """Field by `id` -> its uses through objects."""
        found: dict[int, list[ccode.Member]] = {}
        for view in self._views:
            for member in view.of_kind(ccode.Member):
                for field in self._fields_of(member):
                    found.setdefault(id(field), []).append(member)
        return found

    def _fields_of(self, member: ccode.Member) -> list[ccode.Field]:
        """The fields that a member may be: the one of its object's type, else all of its name."""
        named = self._fields.get(str(member.name), [])
        if len(named) < 2:
            return named
        kind = type_of(member.object, {}) if member.object is not None else None
        record = kind.declaration if kind is not None else ancestor_of_kind(member, ccode.Record)
        return [field for field in named if field.eContainer() is record] or named

    def of(self, holder: ccode.Declaration) -> list[ccode.NameReference | ccode.Member]:
        """The expressions that name a variable, parameter or member."""
        return [*holder.references, *self._members.get(id(holder), ())]

    def holders(self, expression: Element | None) -> list[Declared]:
        """What an expression names: one variable or parameter, or the members that it may be."""
        if isinstance(expression, ccode.Member):
            return list(self._fields_of(expression))
        target = expression.target if isinstance(expression, ccode.NameReference) else None
        return [target] if isinstance(target, (ccode.Variable, ccode.Parameter, ccode.Field)) else []
