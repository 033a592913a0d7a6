"""Applies the rules to texts when planning: each change of the carried-over text belongs to the decision that needs it.

What a rule does to the text is a table (`edit_rules`); what moves out of main is in `hoisting`. A generator applies the changes
in the plan and derives none. When a person changes a port's binding in a stored plan, its change is made anew
(`settle_bindings`), and so is the disposition of the element that contains it.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from robosmi.errors import ModelError
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2m.edit_definitions import Replacement
from robosmi.transformations.m2m.edit_rules import EVERYWHERE, RULES, EditRule
from robosmi.transformations.m2m.port_texts import RULE as PORT
from robosmi.transformations.m2m.port_texts import replacement
from robosmi.transformations.queries.binding_edits import writes
from robosmi.transformations.queries.port_pins import port_text
from robosmi.transformations.queries.source_text import SourceText
from robosmi.transformations.queries.text_changes import CARRIED_OVER, all_changes, decision_of, effective


def change_texts(
    disposition: migration.Disposition,
    wanted: Iterable[tuple[str, str, str]],
    texts: Sequence[SourceText],
    table: Mapping[str, EditRule] = RULES,
) -> None:
    """Set the text changes of a disposition from its rules.

    Args:
        disposition: the disposition; earlier changes are replaced.
        wanted: (rule, text to insert, reason); rules that change no text are skipped.
        texts: the text of each unit.
        table: the edit of each rule.
    """
    element, made = disposition.element, []
    for rule, word, reason in wanted if element is not None else ():
        assert element is not None
        if rule in table:
            for text in texts if rule in EVERYWHERE else (_text(element, texts),):
                made += [_change(text, place, rule, reason) for place in table[rule](element, word, text)]
    if disposition.changes:
        disposition.changes.clear()
    disposition.changes.extend(made)


def _text(element: ccode.Located, texts: Sequence[SourceText]) -> SourceText:
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    found = next((text for text in texts if text.unit is unit), None)
    if found is None:
        raise ModelError(f"{element!r} is in no source unit", fix="make the models again with migrate")
    return found


def _change(
    text: SourceText, place: Replacement, rule: str, reason: str, step: migration.Step = migration.Step.code
) -> migration.TextChange:
    start, end, new = place
    return migration.TextChange(
        unit=text.unit, startOffset=start, endOffset=end, replacement=new, rule=rule, reason=reason, step=step
    )


def bind_texts(plan: migration.MigrationPlan, texts: Sequence[SourceText]) -> None:
    """Set the text change of each port binding in a plan of an earlier version, which has no flows.

    Raises:
        ModelError: a binding's element cannot be rewritten as the binding says.
    """
    for binding in plan.portBindings:
        binding.changes.clear()
        binding.changes.extend(_binding_changes(binding, texts))
    mark_rewritten(plan)


def settle_bindings(plan: migration.MigrationPlan, texts: Sequence[SourceText]) -> None:
    """Make the text changes of ports anew whose text differs from the bound pin, as in a plan edited by a person.

    Raises:
        ModelError: a binding's element cannot be rewritten as the binding says, or one port has two bindings.
    """
    if plan.portFlows:
        _decided_once(plan)
    for binding in plan.portBindings:
        if plan.portFlows:
            for change in (c for c in binding.changes if c.rule == PORT):
                text = _text_of(change, texts)
                new = replacement(binding, text.data[change.startOffset : change.endOffset])
                if not writes(change, port_text(binding) or new):
                    change.replacement, change.reason = new, f"{binding.name} is {binding.choice or 'not bound'} on the target"
            continue
        value = port_text(binding)  # a plan of an earlier version, which had no flows
        if binding.changes and value is not None and all(writes(change, value) for change in binding.changes):
            continue
        binding.changes.clear()
        binding.changes.extend(_binding_changes(binding, texts))
    mark_rewritten(plan)


def _decided_once(plan: migration.MigrationPlan) -> None:
    """Raise `ModelError` if a port or a name has two bindings: it would be undefined which one counts."""
    seen: dict[object, migration.PortBinding] = {}
    for binding in plan.portBindings:
        numbered = binding.sourcePin >= 0 and binding.origin != "convention"
        for key in (binding.name, binding.sourcePin if numbered else binding.name):
            if seen.setdefault(key, binding) is not binding:
                raise ModelError(
                    f"the port '{binding.name}' has two bindings in the plan: to {seen[key].choice or 'nothing'} and to "
                    f"{binding.choice or 'nothing'}",
                    fix="remove one of them from plan.xmi, or migrate again",
                )


def _text_of(change: migration.TextChange, texts: Sequence[SourceText]) -> SourceText:
    found = next((text for text in texts if text.unit is change.unit), None)
    if found is None:
        raise ModelError("a change of a port is in no source unit", fix="make the plan again with migrate")
    return found


def mark_rewritten(plan: migration.MigrationPlan) -> None:
    """Mark elements whose text a port binding changes as rewritten, and as retained again if the binding is gone."""
    ports: dict[int, list[tuple[int, int]]] = {}
    for c in effective(all_changes(plan)):  # in text order, and none within another
        if isinstance(decision_of(c), (migration.PortBinding, migration.PortFlow)):
            ports.setdefault(id(c.unit), []).append((int(c.startOffset), int(c.endOffset)))
    for disposition in plan.dispositions:
        element = disposition.element
        if element is None or not CARRIED_OVER.issuperset(disposition.rules):
            continue
        unit = ancestor_of_kind(element, ccode.SourceUnit)
        here = ports.get(id(unit), [])
        first = bisect_left(here, (int(element.startOffset), 0))
        changed = first < len(here) and here[first][1] <= element.endOffset
        action = migration.Action.rewrite if changed else migration.Action.retain
        if disposition.action is not action:
            disposition.action, disposition.choice = action, action.name


def _binding_changes(binding: migration.PortBinding, texts: Sequence[SourceText]) -> list[migration.TextChange]:
    """The change that replaces a port's number by its pin; none if the text has no number (conventional ports, masks)."""
    value = port_text(binding)
    if value is None or binding.element is None or binding.origin not in ("declaration", "literal"):
        return []
    text, place = _text(binding.element, texts), port_place(binding.element)
    if place is None or not _whole(binding.element, place, text):
        raise ModelError(
            f"the port '{binding.name}' cannot be given another pin: its value is not written as one expression",
            fix="remove the binding, or write the port as a constant of its own in the source",
        )
    if isinstance(binding.element, ccode.EnumerationLiteral):
        value = f"{binding.element.name} = {value}"
    reason = f"the port is {binding.choice} on the target"
    return [_change(text, (*place, value), "port", reason, migration.Step.hardware)]


def _whole(element: ccode.Located, place: tuple[int, int], text: SourceText) -> bool:
    """Whether a place contains exactly the text in the model; a macro body with comments or several lines may not."""
    if not isinstance(element, ccode.Macro):
        return True
    return text.data[place[0] : place[1]] == element.body.encode(text.unit.encoding or "utf-8", errors="replace")


def port_place(element: ccode.Located) -> tuple[int, int] | None:
    """The byte range of a port's number: an initial value, a macro's body, an enumerator's value, a literal."""
    finder = _PLACES.get(element.__class__)
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
