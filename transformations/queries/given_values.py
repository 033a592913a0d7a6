"""Which expressions give a thing of a program its values: what is assigned, passed, returned, stored in arrays and members.

Read from the code model alone, in any order and for all of the program at once: a thing may have any value that it is given
anywhere. A pointer and what it points to are one thing, as are the elements of an array. What the values are, others tell.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.cores import handed_over
from robosmi.transformations.queries.initialisers import leaves, members_given, record_of
from robosmi.transformations.queries.member_records import record_key, record_of_member, records_of_cast, whole_of_member
from robosmi.transformations.queries.pointers import gives_access, moved_pointer


class MemberKey(Struct, frozen=True):
    """The key of a member.

    Attributes:
        name: of the member.
        record: the key of its record (`member_records`), None where the text does not say which it is.
    """

    name: str
    record: Hashable | None


class GivenValues:
    """What the things of a program are given.

    Args:
        views: a view of each of its units.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._views = views
        self._given: dict[Hashable, list[ccode.Located]] = {}
        self._members: dict[str, dict[Hashable | None, list[ccode.Located]]] = {}
        """Name of a member -> record, None where the text does not say it -> what it is given."""
        self._casts: dict[Hashable, set[Hashable]] = {}
        """A record -> the records that a cast makes of it, and those that it is made of."""
        self._registers = {name for v in views for name in v.api.settings.get("ports", {}).get("registers", {})}
        self._functions = {
            str(d.name): d for v in views for d in v.unit.declarations if isinstance(d, ccode.Function) and d.definition
        }
        self._shared = {
            str(d.name): d
            for v in views
            for d in v.unit.declarations
            if isinstance(d, ccode.Variable) and d.storage is not ccode.Storage.staticStorage
        }
        for view in views:
            for element in view.elements:
                self._read(element, view)

    def of(self, key: Hashable) -> list[ccode.Located]:
        """The expressions that give a thing its values; an assignment that calculates stands for itself."""
        if not isinstance(key, MemberKey):
            return self._given.get(key, [])
        records = self._members.get(key.name, {})
        alike = {None, *self._alike(key.record)} if key.record is not None else set(records)
        return [one for record, given in records.items() if record in alike for one in given]

    def _alike(self, record: Hashable) -> set[Hashable]:
        """A record with all that casts make of it or it of them."""
        found, pending = {record}, [record]
        while pending:
            new = self._casts.get(pending.pop(), set()) - found
            found |= new
            pending += new
        return found

    def key(self, expression: Element | None) -> Hashable | None:
        """The thing that an expression is the value of, None of an expression that calculates or stands for itself."""
        if isinstance(expression, ccode.Cast):
            return self.key(expression.operand)
        if isinstance(expression, ccode.Index):
            return self.key(expression.array)
        if isinstance(expression, ccode.Unary) and str(expression.operator) in ("*", "&"):
            return self.key(expression.operand)
        if isinstance(expression, ccode.Unary) and str(expression.operator) in ("++", "--"):
            return self.key(expression.operand) if gives_access(expression.operand) else None
        if isinstance(expression, ccode.Binary) and (array := moved_pointer(expression)) is not None:
            return self.key(array)
        if isinstance(expression, ccode.Member):
            whole = whole_of_member(expression)
            return self.key(whole) if whole is not None else MemberKey(str(expression.name), record_of_member(expression))
        if isinstance(expression, ccode.Call):
            own = self._own(expression)
            return ("result", str(own.name)) if own is not None else None
        if not isinstance(expression, ccode.NameReference):
            return None
        target = expression.target if expression.target is not None else self._shared.get(str(expression.name))
        if isinstance(target, (ccode.Variable, ccode.Parameter)):
            return self._declared(target)
        return ("register", str(expression.name)) if expression.name in self._registers else None

    def _declared(self, thing: ccode.Variable | ccode.Parameter) -> Hashable:
        """The key of a declaration: of what all files share, its name."""
        if isinstance(thing, ccode.Parameter):
            function = thing.eContainer()
            if isinstance(function, ccode.Function):
                return ("parameter", str(function.name), list(function.parameters).index(thing))
        elif isinstance(thing.eContainer(), ccode.SourceUnit) and thing.storage is not ccode.Storage.staticStorage:
            return ("variable", str(thing.name))
        return ("element", id(thing))

    def _own(self, call: ccode.Call) -> ccode.Function | None:
        return self._functions.get(str(call.calleeName or "")) if call.callee is not None else None

    def _give(self, key: Hashable | None, expression: ccode.Located | None) -> None:
        if isinstance(key, MemberKey) and expression is not None:
            self._members.setdefault(key.name, {}).setdefault(key.record, []).append(expression)
        elif key is not None and expression is not None:
            self._given.setdefault(key, []).append(expression)

    def _read(self, element: Element, view: CodeView) -> None:
        if isinstance(element, ccode.Variable):
            self._initialised(element)
        elif isinstance(element, ccode.Assignment):
            if not isinstance(element.eContainer(), ccode.InitializerList):
                self._give(self.key(element.left), element.right if str(element.operator) == "=" else element)
        elif isinstance(element, ccode.Unary) and str(element.operator) in ("++", "--"):
            if not gives_access(element.operand):
                self._give(self.key(element.operand), element)
        elif isinstance(element, ccode.Cast) and (records := records_of_cast(element)) is not None:
            one, other = (record_key(record) for record in records)
            self._casts.setdefault(one, set()).add(other)
            self._casts.setdefault(other, set()).add(one)
        elif isinstance(element, ccode.Return):
            function = ancestor_of_kind(element, ccode.Function)
            if function is not None:
                self._give(("result", str(function.name)), element.value)
        elif isinstance(element, ccode.Call):
            self._called(element, view)

    def _initialised(self, variable: ccode.Variable) -> None:
        first = variable.initializer
        if first is None:
            return
        if record_of(variable.valueType) is None:
            for one in leaves(first):
                self._give(self._declared(variable), one)
        elif isinstance(first, ccode.InitializerList):
            for member, one in members_given(variable.valueType, first):
                self._give(MemberKey(str(member.name), record_key(member.eContainer())), one)

    def _called(self, call: ccode.Call, view: CodeView) -> None:
        own, arguments = self._own(call), list(call.arguments)
        if own is not None:
            for position, argument in enumerate(arguments[: len(own.parameters)]):
                self._give(("parameter", str(own.name), position), argument)
            return
        handed, code = handed_over(call, view.api)
        if code is not None and str(code.name) in self._functions:
            self._give(("parameter", str(code.name), 0), handed)
