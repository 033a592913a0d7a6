"""Locals of `main` that have to become globals when its loop becomes a function of its own, and whether they can.

A declaration moves with all the names in it. What in the text changes for that is `m2m.partition.hoisting`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.queries.macros.tokens import names_in
from robosmi.transformations.queries.source_text import is_header

AUTOMATIC = ("staticStorage", "externStorage")
"""Storage classes of locals that live as long as the program, so that they are initialised only once."""


class MovedDeclaration(Struct, frozen=True):
    """A declaration of main that moves to file scope.

    Attributes:
        statement: the declaration.
        variables: all that it declares, in their order.
        assigned: those whose initial value stays in main, as an assignment at the place of the declaration.
        renamed: new names of those whose name stands for something else at file scope, by old name.
    """

    statement: ccode.DeclarationStatement
    variables: tuple[ccode.Variable, ...]
    assigned: tuple[ccode.Variable, ...]
    renamed: tuple[tuple[str, str], ...] = ()


class Surroundings(Struct, frozen=True):
    """The surroundings of a local that moves to file scope, which restrict its name and its initial value.

    Attributes:
        main: the function.
        unit: its unit.
        reserved: names that nothing of the program at file scope may have.
        words: all words of the program, which no new name may be.
        again: whether statements before the loop may run more than once, so that initial values have to stay among them.
    """

    main: ccode.Function
    unit: ccode.SourceUnit
    reserved: Collection[str]
    words: Collection[str]
    again: bool

    @property
    def taken(self) -> set[str]:
        """The names at file scope of the unit, of the program's headers, and those that other files share with it."""
        others = [u for u in self.unit.program.units if u is not self.unit] if self.unit.program is not None else []
        units = [self.unit, *(u for u in others if is_header(u))]
        own = {d.name for u in units for d in u.declarations} | {m.name for u in units for m in u.macros}
        return own | {d.name for u in others if u not in units for d in u.declarations if _linked(d)}


def _linked(declared: ccode.Declaration) -> bool:
    """Whether a declaration has external linkage."""
    return isinstance(declared, (ccode.Function, ccode.Variable)) and declared.storage.name != "staticStorage"


def locals_of(statements: Iterable[ccode.Statement]) -> list[ccode.Variable]:
    """The variables that these statements themselves declare."""
    declared = (d for s in statements if isinstance(s, ccode.DeclarationStatement) for d in s.declarations)
    return [d for d in declared if isinstance(d, ccode.Variable)]


def outlives(variable: ccode.Variable) -> bool:
    """Whether a pointer to the variable may outlive setup: its address is taken, or it is an array that is passed on."""
    if variable.storage.name == "staticStorage":
        return False
    array = variable.valueType is not None and bool(variable.valueType.arrayDims)
    for use in variable.references:
        container = use.eContainer()
        if isinstance(container, ccode.Unary) and container.operator == "&":
            return True
        if isinstance(container, (ccode.Index, ccode.Member)) and _address_taken(container):
            return True
        if array and not isinstance(container, (ccode.Index, ccode.SizeOf)):
            return True
    return False


def _address_taken(expression: object) -> bool:
    while isinstance(expression, (ccode.Index, ccode.Member)):
        expression = expression.eContainer()
    return isinstance(expression, ccode.Unary) and expression.operator == "&"


def moved_declarations(hoisted: Sequence[ccode.Variable], around: Surroundings) -> tuple[tuple[MovedDeclaration, ...], str]:
    """How the declarations of these locals move, or why one of them cannot.

    Args:
        hoisted: the locals.
        around: what they must agree with.
    """
    statements: dict[int, ccode.DeclarationStatement] = {}
    for variable in hoisted:
        statement = variable.eContainer()
        assert isinstance(statement, ccode.DeclarationStatement)
        statements.setdefault(int(statement.startOffset), statement)
    taken, made, new = around.taken, [], set[str]()
    for _, statement in sorted(statements.items()):
        variables = tuple(d for d in statement.declarations if isinstance(d, ccode.Variable))
        assigned = tuple(v for v in variables if _assigned(v, around))
        renamed: list[tuple[str, str]] = []
        for variable in variables:
            if reason := _stays(variable, variable in assigned) or _needs_macro(variable, variable in assigned, around):
                return (), reason
            if variable.name in taken or variable.name in around.reserved:
                if _in_macro(variable, around.unit):
                    return (), f"'{variable.name}' would hide a name at file scope, and a macro names it"
                fresh = free_name(f"{variable.name}_", {*around.words, *around.reserved, *taken, *new})
                new.add(fresh)
                renamed.append((str(variable.name), fresh))
        made.append(MovedDeclaration(statement, variables, assigned, tuple(renamed)))
    return tuple(made), ""


def free_name(wanted: str, taken: Collection[str]) -> str:
    """The name, with underscores appended until it is not taken."""
    while wanted in taken:
        wanted += "_"
    return wanted


def _assigned(variable: ccode.Variable, around: Surroundings) -> bool:
    """Whether the initial value has to stay in main as an assignment."""
    if variable.initializer is None or variable.storage.name in AUTOMATIC:
        return False
    return around.again or not is_constant(variable.initializer)


def _in_macro(variable: ccode.Variable, unit: ccode.SourceUnit) -> bool:
    """Whether a macro's expansion uses the variable, or a macro's body names it."""
    word = re.compile(rf"\b{re.escape(str(variable.name))}\b")
    if any(word.search(str(macro.body or "")) for macro in unit.macros):
        return True
    ranges = [(use.startOffset, use.endOffset) for use in unit.macroUses]
    return any(start <= use.startOffset < end for use in variable.references for start, end in ranges)


def _stays(variable: ccode.Variable, assigned: bool) -> str:
    """Why a local cannot become a global, or an empty text."""
    use = variable.valueType
    declared = use.declaration if use is not None else None
    if use is not None and use.arrayDims and not _constant_size(variable):
        return f"the size of '{variable.name}' is not constant"
    if use is not None and assigned and use.arrayDims:
        return f"the array '{variable.name}' has values that are not constant, or gets new ones"
    if assigned and use is not None and ("&" in use.spelling or "auto" in use.spelling.split()):
        return f"'{variable.name}' is declared with '{use.spelling}' and needs its value there"
    constructed = isinstance(variable.initializer, ccode.ConstructorCall) or (
        not _is_pointer(variable) and _needs_values(declared)
    )
    if assigned and constructed:
        return f"'{variable.name}' is an object that is constructed with values which are not constant"
    if declared is not None and ancestor_of_kind(declared, ccode.Function) is not None:
        return f"the type of '{variable.name}' is declared in main"
    return ""


def _is_pointer(variable: ccode.Variable) -> bool:
    return variable.valueType is not None and bool(variable.valueType.pointerDepth)


def _needs_values(declared: ccode.Declaration | None) -> bool:
    """Whether objects of a type cannot be constructed without values: no constructor of it may be called without any."""
    if not isinstance(declared, ccode.Record):
        return False
    constructors = [m for m in declared.methods if m.name == declared.name]
    return bool(constructors) and not any(_without_values(m) for m in constructors)


def _without_values(constructor: ccode.Function) -> bool:
    """Whether a constructor may be called without values, since each of its parameters has one by default."""
    written = str(constructor.signature).partition("(")[2]
    return not constructor.parameters or written.count("=") >= len(constructor.parameters)


def _needs_macro(variable: ccode.Variable, assigned: bool, around: Surroundings) -> str:
    """Why a local cannot move in front of main: a macro that is defined only in main is used in it."""
    end = variable.endOffset
    if variable.initializer is not None and assigned:
        end = variable.initializer.startOffset  # that stays where it is
    for use in around.unit.macroUses:
        defined = use.macro
        inside = defined is not None and around.main.startOffset <= defined.startOffset
        if inside and variable.startOffset <= use.startOffset < end:
            return f"line {variable.line} uses the macro '{use.name}', which is defined in main"
    return ""


def _constant_size(variable: ccode.Variable) -> bool:
    """Whether an array's size may be written at file scope: it is made of numbers and of names of no variable."""
    use, unit = variable.valueType, ancestor_of_kind(variable, ccode.SourceUnit)
    assert use is not None
    first, _, rest = use.arrayDims.partition("]")
    if not first.strip("[ ") and variable.initializer is None:
        return False
    names = names_in(str(use.arrayDims))
    if not names:
        return re.search(r"\[\s*\]", rest) is None
    variables = {
        d.name
        for d in (all_contents(unit) if unit is not None else ())
        if isinstance(d, (ccode.Variable, ccode.Parameter)) and not _constant_name(d)
    }
    return "sizeof" not in names and not names & variables


def is_constant(expression: ccode.Expression) -> bool:
    """Whether an expression may stand as the initial value of a global: literals, constants and operators on them."""
    if isinstance(expression, ccode.UnknownExpression) and expression.text.startswith("[]"):
        return True  # a lambda that captures nothing
    for inner in all_contents(expression):
        if isinstance(inner, (ccode.Call, ccode.Assignment, ccode.UnknownExpression, ccode.Member, ccode.Index)):
            return False
        if isinstance(inner, ccode.Unary) and inner.operator in ("++", "--", "*"):
            return False
        if isinstance(inner, ccode.NameReference) and not _constant_name(inner.target):
            return False
    return True


def _constant_name(target: ccode.Declaration | None) -> bool:
    """Whether a name stands for the same value everywhere in the file."""
    if isinstance(target, ccode.EnumerationLiteral):
        return True
    if isinstance(target, ccode.Variable) and isinstance(target.eContainer(), ccode.SourceUnit):
        return bool(
            target.valueType and target.valueType.constant and target.initializer is not None and is_constant(target.initializer)
        )
    return False
