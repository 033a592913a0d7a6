"""Function pointers declared without parameter types (`void (*go)();`): what is stored in them, and how they are called.

In C such a pointer takes any function; in C++ only one without parameters. Pointers that are assigned to each other form one
group, over all files of the program. Named types (`typedef void go();`) are handled in `m2m.language.empty_types`.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterator, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import ARITHMETIC, of_use, type_of
from robosmi.transformations.queries.initialisers import leaves, members_given, record_of
from robosmi.transformations.queries.own_headers import included, unit_of
from robosmi.transformations.queries.programs.live_code import identity
from robosmi.transformations.queries.signature_text import split

Pointer = ccode.Variable | ccode.Parameter | ccode.Field
_UNSAID = re.compile(r"\(\*[^()]*\)\s*\(\s*\)\s*$")
_SAID = re.compile(r"\(\*[^()]*\)\s*\((.*)\)\s*$")
_ARRAY = re.compile(r"\s*\[[^\]]*\]$")
_WORD = re.compile(r"[A-Za-z_]\w*")
_PLAIN = ARITHMETIC | {"void", "const", "volatile", "struct", "union", "enum"}


class UnprototypedPointers(Struct):
    """A group of function pointers without parameter types that are assigned to each other.

    Attributes:
        pointers: their declarations in all files.
        functions: the functions that are stored in them.
        lists: parameter list of these functions with typedefs resolved -> as it is written; both empty for no parameters.
        unknown: whether anything else is stored in them, whose parameters are not known.
        calls: the calls through them.
        values: the expressions that are assigned to them.
    """

    pointers: list[Pointer] = []
    functions: list[ccode.Function] = []
    lists: dict[str, str] = {}
    unknown: bool = False
    calls: list[ccode.Call] = []
    values: list[ccode.Expression] = []

    @property
    def taken(self) -> str | None:
        """The parameter list that all functions of the group share; None if they differ or not all are known."""
        return next(iter(self.lists.values())) if len(self.lists) == 1 and not self.unknown else None

    @property
    def parameter_text(self) -> str:
        """The parameter list to write into the declarations; empty if it is unknown or its types are declared later."""
        taken = self.taken or ""
        return taken if all(_is_declared(taken, pointer) for pointer in self.pointers) else ""

    @property
    def count(self) -> int | None:
        """The number of parameters of every function in the group; None if it is not known or varies."""
        return len(split(self.taken)) if self.taken is not None and "..." not in self.taken else None


def is_unprototyped(use: ccode.TypeUse | None) -> bool:
    """Whether a type is a pointer to a function without parameter types."""
    return use is not None and bool(_UNSAID.search(str(use.spelling or "")))


def concerns(view: CodeView) -> bool:
    """Whether a unit, or an own header that it includes, declares such a pointer."""
    headers = (use for header in included(view.unit) for use in all_of_kind(header, ccode.TypeUse))
    return any(is_unprototyped(use) for use in (*view.of_kind(ccode.TypeUse), *headers))


def parameters_of(function: ccode.Function) -> tuple[str, str]:
    """A function's parameter types as two lists in text: with typedefs resolved, and as they are written."""
    uses = [p.valueType for p in function.parameters if p.valueType is not None]
    shown = [" ".join(f"{use.spelling} {use.arrayDims or ''}".split()) for use in uses]
    resolved = [_ARRAY.sub(" *", str(use.canonical or use.spelling)) for use in uses]
    rest = ["..."] if function.variadic else []
    return ", ".join([*resolved, *rest]), ", ".join([*shown, *rest])


def unprototyped_pointers(program: ccode.Program) -> list[UnprototypedPointers]:
    """The function pointers of a program without parameter types, in groups that are assigned to each other."""
    groups = _Groups(program.units)
    for unit in program.units if groups.found() else ():
        for element in all_contents(unit):
            for pointer, value in _given(element):
                groups.put(pointer, value)
            if isinstance(element, ccode.Call) and (called := _pointer(element.calleeExpression)) is not None:
                groups.called(called, element)
    return groups.found()


class _Groups:
    """Groups of pointers, merged when one pointer is assigned to another."""

    def __init__(self, units: Sequence[ccode.SourceUnit]) -> None:
        self._of: dict[Hashable, UnprototypedPointers] = {}
        declared = [d for unit in units for d in unit.declarations]
        self._defined = {str(d.name): d for d in declared if isinstance(d, ccode.Function) and d.definition}
        for unit in units:
            for use in all_of_kind(unit, ccode.TypeUse):
                owner = use.eContainer()
                if is_unprototyped(use) and isinstance(owner, (ccode.Variable, ccode.Parameter, ccode.Field)):
                    self._of.setdefault(_key(owner), UnprototypedPointers()).pointers.append(owner)

    def found(self) -> list[UnprototypedPointers]:
        """The groups, each once."""
        return list({id(kept): kept for kept in self._of.values()}.values())

    def called(self, pointer: Pointer, call: ccode.Call) -> None:
        """Record a call through a pointer."""
        if (kept := self._of.get(_key(pointer))) is not None:
            kept.calls.append(call)

    def put(self, pointer: Pointer, value: ccode.Expression) -> None:
        """Record that a pointer is assigned a value."""
        kept = self._of.get(_key(pointer))
        other = _pointer(value)
        from_other = self._of.get(_key(other)) if other is not None else None
        if kept is None:
            if from_other is not None and other is not None:
                _say(from_other, pointer)
            return
        kept.values.append(value)
        function = _function(value)
        if function is not None:
            defined = self._defined.get(str(function.name), function)
            kept.functions.append(defined)
            resolved, shown = parameters_of(defined)
            kept.lists[resolved] = shown
            kept.unknown = kept.unknown or not (defined.definition or re.search(r"\([^\n\w]*\w.*\)$", function.signature))
        elif from_other is not None:
            self._join(kept, from_other)
        elif not _is_null(value) and (other is None or not _say(kept, other)):
            kept.unknown = True

    def _join(self, one: UnprototypedPointers, two: UnprototypedPointers) -> None:
        if one is two:
            return
        for key, kept in self._of.items():
            self._of[key] = one if kept is two else kept
        one.pointers += two.pointers
        one.functions += two.functions
        one.lists = {**one.lists, **two.lists}
        one.unknown = one.unknown or two.unknown
        one.calls += two.calls
        one.values += two.values


def _say(kept: UnprototypedPointers, other: Pointer) -> bool:
    """Add the parameter list of another pointer's type to a group; False if that type has none either."""
    kind = of_use(other.valueType)
    shown = _SAID.search(kind.spelling) if kind is not None else None
    resolved = _SAID.search(str(other.valueType.canonical or "")) if other.valueType is not None else None
    if shown is None or resolved is None:
        return False
    nothing = resolved[1].strip() in ("", "void")
    kept.lists["" if nothing else resolved[1].strip()] = "" if nothing else shown[1].strip()
    return True


def _key(pointer: Pointer) -> Hashable:
    """The key of a pointer, the same in all files: of a variable its identity, of a parameter its function and position."""
    if isinstance(pointer, ccode.Variable):
        return identity(pointer)
    function = pointer.eContainer() if isinstance(pointer, ccode.Parameter) else None
    if isinstance(function, ccode.Function):
        own = id(unit_of(function)) if function.storage.name == "staticStorage" else 0
        places = [number for number, each in enumerate(function.parameters) if each is pointer]
        return ("parameter", own, str(function.name), *places)
    return id(pointer)


def _pointer(value: ccode.Expression | None) -> Pointer | None:
    """The variable, parameter or member that an expression denotes, itself or by an element, address or dereference."""
    while isinstance(value, ccode.Index) or (isinstance(value, ccode.Unary) and value.operator in ("*", "&")):
        value = value.array if isinstance(value, ccode.Index) else value.operand
    if isinstance(value, ccode.NameReference):
        return value.target if isinstance(value.target, (ccode.Variable, ccode.Parameter, ccode.Field)) else None
    if isinstance(value, ccode.Member):
        owner = type_of(value.object, {})
        record = owner.declaration if owner is not None else None
        members = record.fields if isinstance(record, ccode.Record) else ()
        return next((member for member in members if member.name == value.name), None)
    return None


def _function(value: ccode.Expression) -> ccode.Function | None:
    inner = value.operand if isinstance(value, ccode.Unary) and value.operator in ("*", "&") else value
    target = inner.target if isinstance(inner, ccode.NameReference) else None
    return target if isinstance(target, ccode.Function) else None


def _is_null(value: ccode.Expression | None) -> bool:
    if isinstance(value, ccode.Cast):
        return _is_null(value.operand)
    if isinstance(value, ccode.NameReference):
        return value.name == "NULL"
    return isinstance(value, ccode.IntegerLiteral) and not value.value


def _given(element: object) -> Iterator[tuple[Pointer, ccode.Expression]]:
    """The pairs of variable, parameter or member and the value that an element of the model assigns to it."""
    if isinstance(element, ccode.Variable) and element.initializer is not None:
        given = _listed(element.valueType, element.initializer)
        yield from given if record_of(element.valueType) is not None else ((element, one) for one in leaves(element.initializer))
    elif isinstance(element, ccode.Cast) and isinstance(element.operand, ccode.InitializerList):
        yield from _listed(element.target, element.operand)
    elif isinstance(element, ccode.Assignment) and element.operator == "=":
        target = _pointer(element.left)
        if target is not None and element.right is not None:
            yield from ((target, value) for value in _branches(element.right))
    elif isinstance(element, ccode.Call) and element.callee is not None:
        for parameter, argument in zip(element.callee.parameters, element.arguments, strict=False):
            yield from ((parameter, value) for value in _branches(argument))


def _listed(use: ccode.TypeUse | None, given: ccode.Expression) -> Iterator[tuple[Pointer, ccode.Expression]]:
    if isinstance(given, ccode.InitializerList):
        for member, value in members_given(use, given):
            yield from ((member, one) for one in _branches(value))


def _branches(value: ccode.Expression) -> Iterator[ccode.Expression]:
    if isinstance(value, ccode.ConditionalExpression):
        for one in (value.whenTrue, value.whenFalse):
            if one is not None:
                yield from _branches(one)
    else:
        yield value


def _is_declared(taken: str, pointer: Pointer) -> bool:
    """Whether all types that a parameter list names are declared before a pointer's declaration."""
    words = set(_WORD.findall(taken)) - _PLAIN
    if not words:
        return True
    unit = unit_of(pointer)
    before = {str(d.name) for d in unit.declarations if d.endOffset <= pointer.startOffset}
    before |= {str(d.name) for each in included(unit) for d in each.declarations}
    return words <= before
