"""Edits of the carried-over text, derived from the plan's decisions.

They are derived anew whenever text is generated, so that a person who changes a decision in a stored plan need not know
about offsets. Edits that a person added (they belong to no decision) are kept. The rules of dispositions that change
text are a table; what is changed for `main` as a whole is the generator's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from robosmi.errors import ModelError
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.source_text import SourceText

RULE_TEXTS: dict[str, str] = {
    "return-from-setup": "return",
    "continue-main-loop": "return",
}
"""Rule of a `rewrite` disposition -> the text that takes the element's place."""


def derive_edits(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> None:
    """Replace the plan's derived edits by those that its decisions ask for.

    Args:
        plan: the plan; its `edits` are changed.
        sources: path of a unit -> its bytes.

    Raises:
        ModelError: a binding's element cannot be rewritten as the binding says.
    """
    own = [e for e in plan.edits if e.decision is None]
    texts = {id(u): SourceText(u, sources[u.path], ()) for u in plan.program.units} if plan.program else {}
    edits = list(own)
    for disposition in plan.dispositions:
        edits += _disposition_edits(disposition, texts)
    for binding in plan.portBindings:
        edits += _binding_edits(binding)
    plan.edits.clear()
    plan.edits.extend(sorted(edits, key=lambda e: (e.unit.path if e.unit else "", e.startOffset)))


def _unit(element: ccode.Located) -> ccode.SourceUnit:
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    if unit is None:
        raise ModelError(f"{element!r} is in no source unit", fix="make the models again with migrate")
    return unit


def _disposition_edits(disposition: migration.Disposition, texts: Mapping[int, SourceText]) -> list[migration.Edit]:
    element = disposition.element
    if isinstance(element, ccode.Include) and disposition.rule in _INCLUDE_RULES:
        unit = _unit(element)
        text = texts[id(unit)]
        end = text.line_end(element.endOffset)
        return [_edit(unit, text.line_start(element.startOffset), end, "", disposition, _INCLUDE_RULES[disposition.rule])]
    if isinstance(element, ccode.Variable) and disposition.action is migration.Action.hoist:
        return [_hoist_edit(element, disposition, texts[id(_unit(element))])]
    if isinstance(element, ccode.Return) and disposition.rule == "return-value-from-setup" and element.value is not None:
        value = texts[id(_unit(element))].slice(element.value.startOffset, element.value.endOffset)[0]
        return [_edit(_unit(element), element.startOffset, element.endOffset, f"return (void)({value})", disposition, disposition.reason)]
    if disposition.action is migration.Action.rewrite and element is not None and disposition.rule in RULE_TEXTS:
        replacement = RULE_TEXTS[disposition.rule]
        return [_edit(_unit(element), element.startOffset, element.endOffset, replacement, disposition, disposition.reason)]
    if disposition.action is migration.Action.drop and isinstance(element, ccode.Function) and not element.definition:
        unit = _unit(element)
        end = texts[id(unit)].line_end(element.endOffset)
        return [_edit(unit, element.startOffset, max(element.endOffset, end - 1), "", disposition, disposition.reason)]
    return []


def _hoist_edit(variable: ccode.Variable, disposition: migration.Disposition, text: SourceText) -> migration.Edit:
    """Takes the declaration of a hoisted local out; a value that is not constant is assigned where the declaration stood."""
    statement = variable.eContainer()
    assert isinstance(statement, ccode.Located)
    start, end = statement.startOffset, statement.endOffset
    if disposition.rule == "hoist-local-split" and variable.initializer is not None:
        value = text.slice(variable.initializer.startOffset, variable.initializer.endOffset)[0]
        return _edit(text.unit, start, end, f"{variable.name} = {value};", disposition, disposition.reason)
    if text.blank(text.line_start(start), start):  # a line of its own goes with its comment, which moves along
        start, end = text.line_start(start), text.line_end(end - 1)
    return _edit(text.unit, start, end, "", disposition, disposition.reason)


_INCLUDE_RULES = {
    "platform-include": "the header belongs to the source platform",
    "standard-include": "stands at the top of the sketch",
    "posix-include": "the target has no such header",
    "unknown-include": "nothing is known of this header",
}


def _edit(
    unit: ccode.SourceUnit, start: int, end: int, replacement: str, decision: migration.Decision, reason: str
) -> migration.Edit:
    step = migration.Step.hardware if isinstance(decision, migration.PortBinding) else migration.Step.code
    return migration.Edit(unit=unit, startOffset=start, endOffset=end, replacement=replacement, reason=reason, step=step, decision=decision)


def _binding_edits(binding: migration.PortBinding) -> list[migration.Edit]:
    """The edit that gives a port of the source its new pin; none for a convention, whose pin stands in no text."""
    value = port_value(binding)
    if value is None or binding.element is None or binding.origin == "convention":
        return []
    place = port_place(binding.element)
    if place is None:
        raise ModelError(
            f"the port '{binding.name}' cannot be given another pin: its value is not written as one expression",
            fix="remove the binding, or write the port as a constant of its own in the source",
        )
    start, end = place
    unit = _unit(binding.element)
    if isinstance(binding.element, ccode.EnumerationLiteral):
        value = f"{binding.element.name} = {value}"
    return [_edit(unit, start, end, value, binding, f"the port is {binding.choice} on the target")]


def port_value(binding: migration.PortBinding) -> str | None:
    """What the port is called on the target: a connection's name, a pin's literal, or None when nothing is bound."""
    if binding.connection is not None:
        return binding.connection.name
    return binding.pin.literal if binding.pin is not None else None


def port_place(element: ccode.Located) -> tuple[int, int] | None:
    """The bytes that hold a port's value: an initial value, a macro's body, an enumerator's value, a literal."""
    finder = _PLACES.get(type(element))
    if finder is not None:
        return finder(element)
    return (element.startOffset, element.endOffset) if isinstance(element, ccode.Expression) else None


def _initial_value(variable: ccode.Variable) -> tuple[int, int] | None:
    value = variable.initializer
    return (value.startOffset, value.endOffset) if value is not None else None


def _macro_body(macro: ccode.Macro) -> tuple[int, int] | None:
    return (macro.endOffset - len(macro.body.encode()), macro.endOffset) if macro.body and not macro.functionLike else None


def _enumerator(literal: ccode.EnumerationLiteral) -> tuple[int, int] | None:
    return literal.startOffset, literal.endOffset


_PLACES: dict[type, Callable[[Any], tuple[int, int] | None]] = {
    ccode.Variable: _initial_value, ccode.Macro: _macro_body, ccode.EnumerationLiteral: _enumerator,
}  # fmt: skip
