"""The types of expressions, as far as the model tells them: what a context requires and what an expression yields.

No arithmetic is computed; an expression whose type cannot be read off its elements has none. The types of a platform's
functions are passed in, since its adapter decides them and not the model.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from weakref import WeakKeyDictionary

from msgspec import Struct
from msgspec.structs import replace

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.values import PIN_BITS, left_in

_QUALIFIERS = re.compile(
    r"\b(const|volatile|register|restrict|extern|static|struct|union|enum|__(?:const|volatile|restrict)(?:__)?)\b"
)
_ROWS = re.compile(r"\[[^\]]*\]\s*(\[.*)", re.DOTALL)
ARITHMETIC = frozenset(
    [
        "bool",
        "char",
        "double",
        "float",
        "int",
        "long",
        "short",
        "signed",
        "unsigned",
        "size_t",
        "int8_t",
        "int16_t",
        "int32_t",
        "int64_t",
        "uint8_t",
        "uint16_t",
        "uint32_t",
        "uint64_t",
    ]
)
_NARROW = re.compile(rb"\b(?:_Bool|bool|boolean|char|short|byte|u?int\w*(?:8|16)_t)\b")
"""Matches in a text that names a type narrower than int."""
_NAMELESS = frozenset({"struct", "union", "enum", "const", "volatile", "static", "extern", "*"})
"""Words of the type of a variable whose record has no name."""


class ValueType(Struct, frozen=True):
    """A type in parts.

    Attributes:
        spelling: as it may be written in a cast.
        base: without qualifiers, stars and dimensions; typedefs of the program resolved.
        depth: levels of pointers and arrays.
        constant: the pointed-to type is `const`.
        changing: the pointed-to type is `volatile`.
        dimensions: how many of the levels are arrays.
        declaration: the declaration of the base, if the program declares it.
        rows: the sizes of the arrays that it points to, as written: `[8]` of `int (*)[8]` and of `int a[2][8]`.
        use: where the program writes the type; None for a type that is given as text.
        width: of a bit field, in bits; 0 for any other.
    """

    spelling: str
    base: str
    depth: int
    constant: bool = False
    dimensions: int = 0
    changing: bool = False
    declaration: ccode.Declaration | None = None
    rows: str = ""
    use: ccode.TypeUse | None = None
    width: int = 0

    @property
    def array(self) -> bool:
        """True for an array type; False for a pointer."""
        return self.dimensions > 0

    @property
    def function(self) -> bool:
        """True for a pointer to a function."""
        return "(*" in self.spelling

    @property
    def arithmetic(self) -> bool:
        """True for an arithmetic type of C."""
        words = self.base.split()
        return self.depth == 0 and bool(words) and set(words) <= ARITHMETIC

    @property
    def bits(self) -> int:
        """The width of an object of the type on the source platform; 0 where no number is in it, or it is not known."""
        return 0 if self.use is None or self.depth or self.function else self.width or int(self.use.bits)

    @property
    def is_narrow(self) -> bool:
        """Whether it is narrower than int, so that a number of a pin may be cut when it is stored."""
        return 0 < self.bits < PIN_BITS and (self.width > 0 or self.base not in ("int", "unsigned int", "unsigned"))

    def left(self, number: int) -> int:
        """What is left of a number that is stored in an object of the type, whose width is known."""
        assert self.use is not None
        declared = self.declaration
        if not isinstance(declared, ccode.Enumeration):
            return left_in(self.use, number, self.bits, bool(self.use.signed))
        return left_in(self.use, number, self.bits, any(literal.value < 0 for literal in declared.literals))


class FunctionType(Struct, frozen=True):
    """The return type and the parameter types of a function, as text."""

    returns: str
    parameters: tuple[str, ...]


def parse(spelling: str, dimensions: str = "") -> ValueType:
    """Parse the spelling of a type; `dimensions` are array sizes that are declared after the name."""
    if "(*" in spelling:
        return ValueType(spelling, spelling, 1)
    head, _, inner = spelling.partition("[")
    sizes = ("[" + inner).count("[") * bool(inner) + dimensions.count("[")
    levels = head.count("*") + sizes
    base = " ".join(_QUALIFIERS.sub(" ", head.replace("*", " ")).split())
    shown = head.strip() + "*" * (levels - head.count("*"))
    first = head.partition("*")[0].split()
    return ValueType(shown, base, levels, "const" in first, sizes, "volatile" in first)


def of_use(use: ccode.TypeUse | None) -> ValueType | None:
    """The type of a declaration with typedefs of the program resolved; None where it has none."""
    if use is None or not use.spelling:
        return None
    made = parse(use.spelling, "" if "[" in use.spelling else use.arrayDims or "")  # a cast spells its sizes itself
    if use.arrayDims and (found := _ROWS.fullmatch(f"{made.spelling.endswith('(*)') * '[]'}{use.arrayDims}")):
        made = replace(made, rows=found[1])
    declaration = use.declaration
    if isinstance(declaration, ccode.Typedef):
        inner = of_use(declaration.aliased)
        if inner is not None:
            meant = inner.declaration or _unnamed(declaration)
            sizes = made.dimensions + (inner.dimensions if made.depth == made.dimensions else 0)
            if inner.array:  # an element of a named array has no name of its own
                made = replace(made, spelling=inner.spelling + "*" * made.depth, constant=made.constant or inner.constant)
            return replace(made, base=inner.base, depth=made.depth + inner.depth, dimensions=sizes, declaration=meant, use=use)
    return replace(made, declaration=declaration or nameless(use), use=use)


def _of_field(field: ccode.Field) -> ValueType | None:
    found = of_use(field.valueType)
    return replace(found, width=int(field.bitWidth)) if found is not None and field.bitWidth else found


def nameless(use: ccode.TypeUse) -> ccode.Record | ccode.Enumeration | None:
    """The anonymous record or enumeration that a variable's declaration defines (`struct { int pin; } lamp`).

    It precedes the variable's name; an enumeration may also precede the name of a record's member.
    """
    words = set(str(use.spelling or "").split())
    holder = use.eContainer()
    kind = ccode.Enumeration if "enum" in words else None if words.isdisjoint({"struct", "union"}) else ccode.Record
    if use.declaration is not None or kind is None or not words <= _NAMELESS:
        return None
    if isinstance(holder, ccode.Field) and kind is ccode.Enumeration:
        return _enumeration_at(holder.eContainer(), int(holder.startOffset))
    if not isinstance(holder, ccode.Variable):
        return None
    beside = _declared_beside(holder)
    found = [d for d in beside if isinstance(d, kind) and not d.name and d.startOffset < holder.endOffset]
    return max(found, key=lambda declared: int(declared.startOffset), default=None)


_enumerations: WeakKeyDictionary[Element, tuple[int, dict[int, ccode.Enumeration]]] = WeakKeyDictionary()
"""What contains declarations -> their number, and the offset of each enumeration among them."""


def _enumeration_at(record: Element | None, offset: int) -> ccode.Enumeration | None:
    around = record.eContainer() if record is not None else None
    beside = _declared_beside(record)
    if around is None or not beside:
        return None
    known = _enumerations.get(around)
    if known is None or known[0] != len(beside):
        found: dict[int, ccode.Enumeration] = {}
        for declared in beside:
            if isinstance(declared, ccode.Enumeration):
                found.setdefault(int(declared.startOffset), declared)
        known = _enumerations[around] = len(beside), found
    return known[1].get(offset)


def _declared_beside(element: object) -> Sequence[ccode.Declaration]:
    around = element.eContainer() if isinstance(element, ccode.Declaration) else None
    return around.declarations if isinstance(around, (ccode.SourceUnit, ccode.Namespace, ccode.DeclarationStatement)) else []


def _unnamed(typedef: ccode.Typedef) -> ccode.Declaration | None:
    """The anonymous record or enumeration that a typedef defines."""
    unit = typedef.eContainer()
    beside = unit.declarations if isinstance(unit, (ccode.SourceUnit, ccode.Namespace, ccode.DeclarationStatement)) else ()
    inside = (d for d in beside if isinstance(d, (ccode.Record, ccode.Enumeration)) and not d.name)
    return next((d for d in inside if typedef.startOffset <= d.startOffset < typedef.endOffset), None)


def element_type(kind: ValueType | None) -> ValueType | None:
    """The element type of an array, or the type that a pointer points to."""
    if kind is None or kind.depth == 0 or kind.function:
        return None
    spelling, sizes = kind.spelling.removesuffix("*").strip(), max(kind.dimensions - 1, 0)
    return replace(kind, spelling=spelling, depth=kind.depth - 1, dimensions=sizes, rows="")


def type_of(expression: ccode.Expression | None, functions: Mapping[str, FunctionType]) -> ValueType | None:
    """The type of an expression's value, None where the model does not say it."""
    if isinstance(expression, ccode.NameReference):
        target = expression.target
        if isinstance(target, ccode.Field):
            return _of_field(target)
        return of_use(target.valueType) if isinstance(target, (ccode.Variable, ccode.Parameter)) else None
    if isinstance(expression, ccode.Call):
        if expression.calleeName in functions:
            return parse(functions[expression.calleeName].returns)
        return of_use(expression.callee.returnType) if expression.callee is not None else None
    if isinstance(expression, ccode.Cast):
        return of_use(expression.target)
    if isinstance(expression, ccode.Index):
        return element_type(type_of(expression.array, functions))
    if isinstance(expression, ccode.Member):
        return _member(expression, functions)
    if isinstance(expression, ccode.IntegerLiteral):
        return parse("int")
    if isinstance(expression, ccode.Unary):
        inner = type_of(expression.operand, functions)
        if expression.operator == "*":
            return element_type(inner)
        if expression.operator == "&" and inner is not None and not inner.array:
            return replace(inner, spelling=inner.spelling + (" *" if inner.depth == 0 else "*"), depth=inner.depth + 1)
    if isinstance(expression, ccode.Binary) and expression.operator in ("+", "-"):
        sides = [
            t for t in (type_of(expression.left, functions), type_of(expression.right, functions)) if t is not None and t.depth
        ]
        return sides[0] if len(sides) == 1 else None
    return None


def field_of(expression: ccode.Member, functions: Mapping[str, FunctionType]) -> ccode.Field | None:
    """The member of a record that an expression names; None where the model does not say the type of its object."""
    owner = type_of(expression.object, functions)
    record = owner.declaration if owner is not None else None
    if not isinstance(record, ccode.Record):
        return None
    return next((field for field in record.fields if field.name == expression.name), None)


def _member(expression: ccode.Member, functions: Mapping[str, FunctionType]) -> ValueType | None:
    field, owner = field_of(expression, functions), type_of(expression.object, functions)
    found = _of_field(field) if field is not None else None
    if found is None or owner is None or not found.array:  # an array is as constant and as changing as what it is in
        return found
    return replace(found, constant=found.constant or owner.constant, changing=found.changing or owner.changing)


def declared_with_others(variable: ccode.Variable) -> bool:
    """Whether the variable's declaration declares other names too."""
    statement = variable.eContainer()
    return bool(variable.shared) or (isinstance(statement, ccode.DeclarationStatement) and len(statement.declarations) > 1)


def expectations(view: CodeView, functions: Mapping[str, FunctionType]) -> Iterator[tuple[ccode.Expression, ValueType]]:
    """Each expression whose context requires a type (initialiser, assigned value, returned value, argument), with that type."""
    for variable in view.of_kind(ccode.Variable):
        if variable.initializer is not None:
            yield from _initial(variable.initializer, of_use(variable.valueType))
    for assignment in view.of_kind(ccode.Assignment):
        if assignment.operator == "=" and assignment.right is not None:
            yield from _value(assignment.right, type_of(assignment.left, functions))
    for leave in view.of_kind(ccode.Return):
        function = ancestor_of_kind(leave, ccode.Function)
        if leave.value is not None and function is not None and function.name != "main":
            yield from _value(leave.value, of_use(function.returnType))
    for call in view.of_kind(ccode.Call):
        if call.calleeName in functions:
            wanted = [parse(p) for p in functions[call.calleeName].parameters]
        elif call.callee is not None and call.callee.definition:
            wanted = [t for t in (of_use(p.valueType) for p in call.callee.parameters) if t is not None]
        else:
            continue
        for argument, kind in zip(call.arguments, wanted, strict=False):
            yield from _value(argument, kind)


def cut_values(views: Sequence[CodeView], sources: Mapping[str, bytes]) -> Mapping[int, ValueType]:
    """`id` of each expression of a program whose value a type narrower than a pin takes -> that type.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
    """
    fields = (field for view in views for field in view.of_kind(ccode.Field))
    if not any(_NARROW.search(data) for data in sources.values()) and not any(field.bitWidth for field in fields):
        return {}
    casts = [(cast.operand, cast.target) for view in views for cast in view.of_kind(ccode.Cast)]
    given = chain(
        *(expectations(view, {}) for view in views), *(_initial(one, of_use(use)) for one, use in casts if one is not None)
    )
    return {id(one): kind for one, kind in given if kind.is_narrow}


def _value(expression: ccode.Expression, kind: ValueType | None) -> Iterator[tuple[ccode.Expression, ValueType]]:
    if kind is None:
        return
    if isinstance(expression, ccode.ConditionalExpression):
        for branch in (expression.whenTrue, expression.whenFalse):
            if branch is not None:
                yield from _value(branch, kind)
    else:
        yield expression, kind


def _initial(expression: ccode.Expression, kind: ValueType | None) -> Iterator[tuple[ccode.Expression, ValueType]]:
    if not isinstance(expression, ccode.InitializerList):
        if kind is not None and not kind.array:
            yield from _value(expression, kind)
        return
    if kind is not None and kind.array:
        for element in expression.elements:
            value = _designated(element)[1]
            if value is not None:
                yield from _initial(value, element_type(kind))
    elif kind is not None and isinstance(kind.declaration, ccode.Record):
        members = [field for field in kind.declaration.fields if field.name or not is_padding(field)]
        places = {str(member.name): place for place, member in enumerate(members)}
        place = 0
        for element in expression.elements:
            name, value = _designated(element)
            place = places.get(name, len(members)) if name else place
            if value is None or place >= len(members):
                return
            wanted = _of_field(members[place])
            if _without_braces(value, wanted):
                return
            yield from _initial(value, wanted)
            place += 1


def is_padding(field: ccode.Field) -> bool:
    """Whether a member without a name is a gap of bits, which takes no initial value, and no anonymous record."""
    kind = of_use(field.valueType)
    return kind is not None and kind.arithmetic


def _designated(element: ccode.Expression) -> tuple[str, ccode.Expression | None]:
    """The member that an element of an initialiser list designates, empty for none, and the element's value.

    A nested designator such as `.at.x = 1` gives an empty text and None.
    """
    if not isinstance(element, ccode.Assignment) or element.left is None:
        return "", element
    if isinstance(element.left, ccode.Member) and element.left.object is not None:
        return "", element  # an assignment, whose value is the element's
    if element.left.startOffset > element.startOffset + 1:
        return "", None  # `.at.x = 1`
    return (str(element.left.name) if isinstance(element.left, ccode.Member) else ""), element.right


def _without_braces(element: ccode.Expression, wanted: ValueType | None) -> bool:
    """Whether the inner braces of an array member are left out, so that values and fields no longer correspond."""
    text = isinstance(element, (ccode.InitializerList, ccode.StringLiteral))
    return wanted is not None and wanted.array and not text
