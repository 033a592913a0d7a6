"""Which expressions give the variables, parameters, results and members of a program their values.

Read from the code model alone, without regard to order: a thing may have any value that it is given anywhere in the program. A
pointer and what it points to count as one thing, as do the elements of an array. The values themselves are computed elsewhere.
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
    """Maps each thing of a program (variable, parameter, result, member, register) to the expressions that give it a value.

    Args:
        views: a view of each of its units.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._views = views
        self._given: dict[Hashable, list[ccode.Located]] = {}
        self._members: dict[str, dict[Hashable | None, list[ccode.Located]]] = {}
        """Name of a member -> key of its record, None where the text does not tell it -> the expressions that it is given."""
        self._casts: dict[Hashable, set[Hashable]] = {}
        """Key of a record -> keys of the records that a cast converts to or from it."""
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
        """The expressions that give a thing its values; a compound assignment, `++` and `--` are listed themselves."""
        if not isinstance(key, MemberKey):
            return self._given.get(key, [])
        records = self._members.get(key.name, {})
        alike = {None, *self._alike(key.record)} if key.record is not None else set(records)
        return [one for record, given in records.items() if record in alike for one in given]

    def _alike(self, record: Hashable) -> set[Hashable]:
        """A record with all records that casts connect it with, directly or through others."""
        found, pending = {record}, [record]
        while pending:
            new = self._casts.get(pending.pop(), set()) - found
            found |= new
            pending += new
        return found

    def key(self, expression: Element | None) -> Hashable | None:
        """The key of the thing whose value an expression is; None for a literal or a computation."""
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
        """The key of a declaration: the name of what all files share, else the identity of the element."""
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
