"""Edits of the carried-over text, derived from the plan's decisions.

They are derived anew whenever text is generated, so that a person who changes a decision in a stored plan need not know
about offsets. Edits that a person added (they belong to no decision) are kept. What a disposition's rule does to the
text is a table (`edit_rules`); what is changed for `main` as a whole is the generator's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from robosmi.errors import ModelError
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2m.edit_rules import EVERYWHERE, RULES, Replacement, rules_of
from robosmi.transformations.queries.circuit import pin_literal
from robosmi.transformations.queries.source_text import SourceText

RETAINED = frozenset({"own-macro", "own-function", "own-declaration", "main-once", "main-repeated"})
"""Rules whose elements are carried over as they are, but for the ports in them."""


def derive_edits(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> None:
    """Replace the plan's derived edits by those that its decisions ask for.

    Args:
        plan: the plan; its `edits` are changed.
        sources: path of a unit -> its bytes.

    Raises:
        ModelError: a binding's element cannot be rewritten as the binding says.
    """
    own = [e for e in plan.edits if e.decision is None]
    texts = [SourceText(u, sources[u.path], ()) for u in plan.program.units] if plan.program else []
    derived: list[migration.Edit] = []
    for binding in plan.portBindings:
        derived += _binding_edits(binding, texts)
    for disposition in plan.dispositions:
        derived += _disposition_edits(disposition, texts)
    plan.edits.clear()
    plan.edits.extend(_apart([*own, *derived]))
    _mark_rewritten(plan)


def _mark_rewritten(plan: migration.MigrationPlan) -> None:
    """What a port binding changes the text of is rewritten, and retained again when the binding is gone."""
    ports = [(id(e.unit), e.startOffset, e.endOffset) for e in plan.edits if isinstance(e.decision, migration.PortBinding)]
    for disposition in plan.dispositions:
        element = disposition.element
        if element is None or disposition.rule not in RETAINED:
            continue
        unit = id(ancestor_of_kind(element, ccode.SourceUnit))
        changed = any(u == unit and element.startOffset <= start and end <= element.endOffset for u, start, end in ports)
        disposition.action = migration.Action.rewrite if changed else migration.Action.retain


def _apart(edits: Sequence[migration.Edit]) -> list[migration.Edit]:
    """The edits in text order without those that lie in what another one takes away; of equal ones the first counts."""
    kept: list[migration.Edit] = []
    order = sorted(enumerate(edits), key=lambda p: (p[1].unit.path if p[1].unit else "", p[1].startOffset, -p[1].endOffset, p[0]))
    reach, unit = -1, None
    inserted: list[migration.Edit] = []
    for _, edit in order:
        if edit.unit is not unit:
            reach, unit = -1, edit.unit
        if edit.startOffset == edit.endOffset:
            inserted.append(edit)
        elif edit.startOffset >= reach:
            kept.append(edit)
            reach = edit.endOffset
    ranges = [(id(e.unit), e.startOffset, e.endOffset) for e in kept]
    for edit in inserted:
        if not any(unit_id == id(edit.unit) and start < edit.startOffset < end for unit_id, start, end in ranges):
            kept.append(edit)
    return sorted(kept, key=lambda e: (e.unit.path if e.unit else "", e.startOffset, e.endOffset))


def _unit(element: ccode.Located) -> ccode.SourceUnit:
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    if unit is None:
        raise ModelError(f"{element!r} is in no source unit", fix="make the models again with migrate")
    return unit


def _disposition_edits(disposition: migration.Disposition, texts: Sequence[SourceText]) -> list[migration.Edit]:
    element = disposition.element
    rules = rules_of(disposition)
    if element is None or not rules:
        return []
    unit = _unit(element)
    made: list[migration.Edit] = []
    for rule, choice in rules:
        for text in texts:
            if text.unit is unit or rule in EVERYWHERE:
                found = RULES[rule](element, choice, text)
                made += [_edit(text.unit, replacement, disposition, disposition.reason) for replacement in found]
    return made


def _edit(unit: ccode.SourceUnit, replacement: Replacement, decision: migration.Decision, reason: str) -> migration.Edit:
    start, end, text = replacement
    step = migration.Step.hardware if isinstance(decision, migration.PortBinding) else migration.Step.code
    return migration.Edit(
        unit=unit, startOffset=start, endOffset=end, replacement=text, reason=reason, step=step, decision=decision
    )


def _binding_edits(binding: migration.PortBinding, texts: Sequence[SourceText]) -> list[migration.Edit]:
    """The edit that gives a port of the source its new pin; none for a convention, whose pin stands in no text."""
    value = port_value(binding)
    if value is None or binding.element is None or binding.origin == "convention":
        return []
    place = port_place(binding.element)
    if place is None or not _whole(binding.element, place, texts):
        raise ModelError(
            f"the port '{binding.name}' cannot be given another pin: its value is not written as one expression",
            fix="remove the binding, or write the port as a constant of its own in the source",
        )
    start, end = place
    if isinstance(binding.element, ccode.EnumerationLiteral):
        value = f"{binding.element.name} = {value}"
    return [_edit(_unit(binding.element), (start, end, value), binding, f"the port is {binding.choice} on the target")]


def _whole(element: ccode.Located, place: tuple[int, int], texts: Sequence[SourceText]) -> bool:
    """Whether the place holds what the model says: a macro's body with comments or over several lines has no one place."""
    if not isinstance(element, ccode.Macro):
        return True
    text = next(t for t in texts if t.unit is _unit(element))
    return text.data[place[0] : place[1]] == element.body.encode(text.unit.encoding or "utf-8", errors="replace")


def port_value(binding: migration.PortBinding) -> str | None:
    """What the port is called on the target: a connection's name, a pin's literal, or None when nothing is bound."""
    if binding.connection is not None:
        return binding.connection.name
    return pin_literal(binding.pin) if binding.pin is not None else None


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
    ccode.Variable: _initial_value,
    ccode.Macro: _macro_body,
    ccode.EnumerationLiteral: _enumerator,
}
