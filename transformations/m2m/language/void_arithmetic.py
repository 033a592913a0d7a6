"""Arithmetic on `void *`, which GNU C does in bytes and C++ refuses: increments, differences, sums, and `sizeof(void)`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.m2m.language.text_change import Change, Rule
from robosmi.transformations.m2m.language.written_conversions import is_primary
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType, of_use, type_of
from robosmi.transformations.queries.flows.value_uses import changes_nothing

_NO_BYTES = "C++ does not calculate with void *"


def sums(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Operands of sums and differences that need a cast to a byte pointer."""
    for binary in view.of_kind(ccode.Binary):
        for value in (binary.left, binary.right) if binary.operator in ("+", "-") else ():
            kind = _bytes(value, functions)
            if value is not None and kind and not _of_macro(binary):
                yield Change(value, "convert" if is_primary(value) else "convert-compound", kind, _NO_BYTES)


def steps(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Increments and decrements."""
    for step in view.of_kind(ccode.Unary):
        kind = _bytes(step.operand, functions) if step.operator in ("++", "--") else ""
        if kind and step.operand is not None and changes_nothing(step.operand) and _is_written(step, data):
            text, sign = _text(step.operand, data), step.operator[0]
            made = f"({text} = ({kind}){text} {sign} 1)"
            if isinstance(step.eContainer(), (ccode.ExpressionStatement, ccode.For)):
                made = made[1:-1]
            elif step.postfix:
                made = f"(({kind}){made} {'-' if sign == '+' else '+'} 1)"
            yield Change(step, "replace", made, _NO_BYTES)


def additions(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Compound assignments `p += n` and `p -= n`."""
    for assignment in view.of_kind(ccode.Assignment):
        kind = _bytes(assignment.left, functions) if assignment.operator in ("+=", "-=") else ""
        if kind and assignment.left is not None and changes_nothing(assignment.left) and not _of_macro(assignment):
            text = _text(assignment.left, data)
            made = f"{text} = ({kind})(({kind}){text} {assignment.operator[0]} ("
            yield Change(assignment, "compound-of-bytes", made, _NO_BYTES)


def sizes(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """`sizeof(void)` and `sizeof *p`: 1 in GNU C."""
    for size in view.of_kind(ccode.SizeOf):
        kind = of_use(size.measured) if size.measured is not None else type_of(size.operand, functions)
        if kind is not None and kind.base == "void" and not kind.depth and data.startswith(b"sizeof", size.startOffset):
            yield Change(size, "replace", "sizeof(char)", "C++ has no size of void")


def in_macros(view: CodeView) -> Iterator[tuple[int, str]]:
    """Differences of `void *` in macro bodies, where no cast is inserted, as (offset, message)."""
    for binary in view.of_kind(ccode.Binary):
        sides = [kind for kind in (_bytes(binary.left, {}), _bytes(binary.right, {})) if kind]
        if binary.operator == "-" and sides and _of_macro(binary):
            yield int(binary.startOffset), "a macro calculates with void *, which C++ does not"


def _bytes(value: ccode.Expression | None, functions: Mapping[str, FunctionType]) -> str:
    """The byte pointer type that replaces a `void *`; empty for a value of any other type."""
    given = type_of(value, functions)
    if given is None or given.base != "void" or given.depth != 1 or given.function:
        return ""
    return "const char *" if given.constant else "char *"


def _of_macro(whole: ccode.Binary | ccode.Assignment) -> bool:
    """Whether an operation comes from a macro, so that its operands have no places in the text."""
    sides = (whole.left, whole.right)
    return all(e is None or (e.startOffset, e.endOffset) == (whole.startOffset, whole.endOffset) for e in sides)


def _is_written(step: ccode.Unary, data: bytes) -> bool:
    """Whether an increment is in the text itself and not in a macro."""
    text, sign = _text(step, data), str(step.operator)
    return text.endswith(sign) if step.postfix else text.startswith(sign)


def _text(expression: ccode.Expression, data: bytes) -> str:
    return data[expression.startOffset : expression.endOffset].decode("utf-8", errors="replace")


RULES: tuple[Rule, ...] = (sums, steps, additions, sizes)
