"""Which declarations must have one type: what points or refers to a variable has the type of it, and so has all in one statement.

`int x` that is given as `&x` to `void add(int *p)` can get another type only together with `p`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constants.declared_uses import Declared, DeclaredUses
from robosmi.transformations.queries.expression_type import of_use

Place = tuple[str, int]
"""The path of a unit and the offset where a type is written."""
_STEPS = ("+", "-")


class LinkedTypes(Struct, frozen=True):
    """Declarations that must have one type.

    Attributes:
        declarations: the declarations.
        obstacle: a use that needs them to keep their type, such as the argument of a function of a library; None without one.
    """

    declarations: tuple[ccode.Declaration, ...]
    obstacle: ccode.Located | None


class TypeLinks:
    """Finds them.

    Args:
        views: a view of each unit of the program.
        uses: the uses of its variables.
        written: a declaration -> where its type is written; None where it is written otherwise.
        of_bytes: the functions that take the bytes of an object of any type.
    """

    def __init__(
        self, views: Sequence[CodeView], uses: DeclaredUses, written: Callable[[ccode.Declaration], Place | None],
        of_bytes: Collection[str] = (),
    ) -> None:  # fmt: skip
        self._views, self._uses, self._of_bytes = views, uses, of_bytes
        self._by_place: dict[Place, list[Declared]] = {}
        for view in views:
            every: list[Declared] = [*view.of_kind(ccode.Variable), *view.of_kind(ccode.Parameter), *view.of_kind(ccode.Field)]
            for each in every:
                if (place := written(each)) is not None:
                    self._by_place.setdefault(place, []).append(each)
        self._written = written

    def of(self, holder: ccode.Declaration) -> LinkedTypes:
        """The declarations that have the type of a variable, itself included."""
        found: dict[int, ccode.Declaration] = {id(holder): holder}
        waiting: list[ccode.Declaration] = [holder]
        obstacle: ccode.Located | None = None
        for each in waiting:
            place = self._written(each)
            others = [*declarations(self._views, each), *(self._by_place.get(place, ()) if place is not None else ())]
            if place is None:
                obstacle = obstacle or each
            for linked in (*others, *self._partners(each)):
                if not isinstance(linked, (ccode.Variable, ccode.Parameter, ccode.Field, ccode.Function)):
                    obstacle = obstacle or linked
                elif id(linked) not in found:
                    found[id(linked)] = linked
                    waiting.append(linked)
        return LinkedTypes(tuple(found.values()), obstacle)

    def _partners(self, each: ccode.Declaration) -> Iterator[ccode.Located]:
        """What points or refers to a variable or to what a pointer points to; a use that is neither, where it is an obstacle."""
        for use in self._uses.of(each):
            yield from self._of_use(use, each)
        if not isinstance(each, (ccode.Variable, ccode.Parameter, ccode.Field)) or not (_points(each) or _refers(each)):
            return
        if isinstance(each, ccode.Parameter):
            function = each.eContainer()
            assert isinstance(function, ccode.Function)
            at = list(function.parameters).index(each)
            yield from function.references  # it is called through pointers
            for call in function.calls:
                if at < len(call.arguments):
                    yield from self._origins(call.arguments[at])
        else:
            yield from self._origins(each.initializer)

    def _of_use(self, use: ccode.Expression, each: ccode.Declaration) -> Iterator[ccode.Located]:
        at: ccode.Expression = use
        pointer = isinstance(each, (ccode.Variable, ccode.Parameter, ccode.Field)) and _points(each)
        outer = at.eContainer()
        while (isinstance(outer, ccode.Index) and outer.array is at) or (
            isinstance(outer, ccode.Unary) and outer.operator in "*&"
        ):
            pointer = outer.operator == "&" if isinstance(outer, ccode.Unary) else False
            at, outer = outer, outer.eContainer()
        while pointer and isinstance(outer, ccode.Binary) and outer.operator in _STEPS:
            at, outer = outer, outer.eContainer()
        if isinstance(outer, ccode.Variable):
            if pointer or _refers(outer):
                yield outer
        elif isinstance(outer, ccode.Call) and any(argument is at for argument in outer.arguments):
            place = next(number for number, argument in enumerate(outer.arguments) if argument is at)
            yield from self._of_argument(outer, place, at, pointer=pointer)
        elif isinstance(outer, ccode.Assignment) and pointer and outer.operator == "=":
            yield from self._origins(outer.right if outer.left is at else outer.left)
        elif pointer and isinstance(
            outer, (ccode.Return, ccode.InitializerList, ccode.ConstructorCall, ccode.ConditionalExpression)
        ):
            yield at

    def _of_argument(self, call: ccode.Call, place: int, at: ccode.Expression, *, pointer: bool) -> Iterator[ccode.Located]:
        callee = call.callee
        parameter = callee.parameters[place] if callee is not None and place < len(callee.parameters) else None
        own = callee is not None and ancestor_of_kind(callee, ccode.SourceUnit) is not None
        if parameter is not None and own:
            if pointer or _refers(parameter):
                yield parameter
            return
        kind = of_use(parameter.valueType) if parameter is not None else None
        if pointer and (kind is None or kind.base != "void") and str(call.calleeName) not in self._of_bytes:
            yield at

    def _origins(self, value: Element | None) -> Iterator[ccode.Located]:
        """What a pointer or reference is given: the variables that it then points to; nothing for null and casts."""
        while value is not None and not isinstance(value, (ccode.NameReference, ccode.Member)):
            if isinstance(value, ccode.Index):
                value = value.array
            elif isinstance(value, ccode.Unary) and value.operator in ("&", "*"):
                value = value.operand
            elif isinstance(value, ccode.Binary) and value.operator in _STEPS:
                value = value.left
            elif isinstance(value, (ccode.Cast, ccode.IntegerLiteral, ccode.InitializerList)):
                return
            elif isinstance(value, ccode.Located):
                yield value
                return
        if isinstance(value, (ccode.NameReference, ccode.Member)) and value.name not in ("NULL", "nullptr"):
            yield from self._uses.holders(value) or (value,)


def _points(holder: Declared) -> bool:
    return (kind := of_use(holder.valueType)) is not None and kind.depth > 0


def _refers(holder: Declared) -> bool:
    return holder.valueType is not None and "&" in str(holder.valueType.spelling)


def declarations(views: Iterable[CodeView], holder: ccode.Declaration) -> list[ccode.Declaration]:
    """All declarations of a variable, parameter or function: a type is changed in all of them or in none."""
    owner = holder.eContainer()
    seen = list(views)
    if isinstance(holder, ccode.Parameter) and isinstance(owner, ccode.Function):
        at = list(owner.parameters).index(holder)
        same = (f for view in seen for f in view.of_kind(ccode.Function) if f.name == owner.name)
        return [f.parameters[at] for f in same if len(f.parameters) == len(owner.parameters)]
    if isinstance(holder, ccode.Function):
        return [f for view in seen for f in view.of_kind(ccode.Function) if f.name == holder.name]
    shared = isinstance(holder, ccode.Variable) and holder.storage is not ccode.Storage.staticStorage
    if not shared or not isinstance(owner, ccode.SourceUnit):
        return [holder]
    every = (v for view in seen for v in view.of_kind(ccode.Variable) if v.name == holder.name)
    return [v for v in every if isinstance(v.eContainer(), ccode.SourceUnit)]
