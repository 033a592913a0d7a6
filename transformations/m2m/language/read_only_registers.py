"""Removes writes to registers that are read-only on the source (`waitcnt(CNT += 80000)`): only the value remains.

The source's compiler accepts such an assignment, but the register does not change: the next read gives what it counts or
senses. On the target the register is not a variable, so the expression is replaced by its value.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType

RULE = "value-of-register"


def read_only_registers(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find assignments, increments and decrements of registers that the platform declares read-only."""
    names = set(view.api.settings.get("registers", {}).get("read_only", []))
    if not any(name.encode() in data for name in names):
        return
    reason = "the register is only read: what is written there changes nothing"
    for assignment in view.of_kind(ccode.Assignment):
        if _register(assignment.left, names, data):
            yield Change(assignment, RULE, "", reason)
    for step in view.of_kind(ccode.Unary):
        if step.operator in ("++", "--") and _register(step.operand, names, data):
            yield Change(step, RULE, "", reason)


def _register(expression: ccode.Expression | None, names: set[str], data: bytes) -> bool:
    if not isinstance(expression, ccode.NameReference) or expression.name not in names:
        return False
    known = isinstance(expression.target, (ccode.Variable, ccode.Parameter))
    return not known and data[expression.startOffset : expression.endOffset] == expression.name.encode()


def value_of_register(element: ccode.Assignment | ccode.Unary, choice: str, data: bytes) -> list[Replacement]:
    """The changes, as (first byte, byte after the last, new text), that replace a write by its value; a statement discards it."""
    start, end = int(element.startOffset), int(element.endOffset)
    made: list[Replacement] = []
    before, behind = ("(void)(", ")") if isinstance(element.eContainer(), ccode.ExpressionStatement) else ("", "")
    if isinstance(element, ccode.Unary):
        operand = element.operand
        assert operand is not None  # else the rule does not hold
        step = "" if element.postfix else f" {element.operator[0]} 1"
        made = [
            Replacement(start, int(operand.startOffset), before + "(" * bool(step)),
            Replacement(int(operand.endOffset), end, ""),
        ]
        return [*made, Replacement(end, end, f"{step}{')' * bool(step)}{behind}")]
    assert element.left is not None
    assert element.right is not None  # else the rule does not hold
    if element.operator == "=":
        return [Replacement(start, int(element.right.startOffset), before), Replacement(end, end, behind)]
    made = [Replacement(start, start, before)] if before else []
    operator = f" {element.operator[:-1]} ("
    return [
        *made,
        Replacement(int(element.left.endOffset), int(element.right.startOffset), operator),
        Replacement(end, end, f"){behind}"),
    ]
