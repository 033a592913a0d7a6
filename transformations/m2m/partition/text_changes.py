"""Applies the rules to texts when planning: each change of the carried-over text belongs to the decision that needs it.

What a rule does to the text is a table (`edit_rules`); what moves out of main is in `hoisting`. A generator applies the changes
in the plan and derives none. When the user changes a port's binding in a stored plan, its change is made anew
(`settle_bindings`), and so is the disposition of the element that contains it.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Sequence

from robosmi.errors import ModelError
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.designated_lists import positional
from robosmi.transformations.m2m.partition.edit_rules import EVERYWHERE, INCLUDED, POSITIONAL, RULES
from robosmi.transformations.m2m.ports.port_texts import MOVES, explicit_enumerators, replacement
from robosmi.transformations.queries.own_headers import included
from robosmi.transformations.queries.plans.binding_edits import writes
from robosmi.transformations.queries.plans.port_pins import port_text
from robosmi.transformations.queries.plans.retained_pins import AS_WRITTEN, retained_pins
from robosmi.transformations.queries.source_text import SourceText
from robosmi.transformations.queries.text_changes import CARRIED_OVER, all_changes, decision_of, effective


def change_texts(
    disposition: migration.Disposition,
    wanted: Iterable[tuple[str, str, str]],
    texts: Sequence[SourceText],
) -> None:
    """Set the text changes of a disposition from its rules.

    Args:
        disposition: the disposition; earlier changes are replaced.
        wanted: (rule, text to insert, reason); rules that change no text are skipped.
        texts: the text of each unit.
    """
    element, made = disposition.element, []
    for rule, word, reason in wanted if element is not None else ():
        assert element is not None
        if rule in RULES:
            for text in _texts(rule, element, texts):
                made += [_change(text, place, rule, reason) for place in RULES[rule](element, word, text)]
    if disposition.changes:
        disposition.changes.clear()
    disposition.changes.extend(made)


def _texts(rule: str, element: ccode.Located, texts: Sequence[SourceText]) -> Sequence[SourceText]:
    """The texts that a rule changes: that of the element, those of the units that include it, too, or all."""
    if rule in EVERYWHERE:
        return texts
    own = _text(element, texts)
    return [text for text in texts if text is own or own.unit in included(text.unit)] if rule in INCLUDED else [own]


def _text(element: ccode.Located, texts: Sequence[SourceText]) -> SourceText:
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    found = next((text for text in texts if text.unit is unit), None)
    if found is None:
        raise ModelError(f"{element!r} is in no source unit", fix="run migrate again")
    return found


def _change(text: SourceText, place: Replacement, rule: str, reason: str) -> migration.TextChange:
    start, end, new = place
    return migration.TextChange(
        unit=text.unit, startOffset=start, endOffset=end, replacement=new, rule=rule, reason=reason, step=migration.Step.code
    )


def settle_bindings(plan: migration.MigrationPlan, texts: Sequence[SourceText]) -> None:
    """Make the text changes of ports anew whose text differs from the bound pin, as in a plan edited by the user.

    Raises:
        ModelError: one port has two bindings, or a change of a port is in no source unit.
    """
    _decided_once(plan)
    kept = retained_pins(plan)
    for binding in plan.portBindings:
        for change in (c for c in binding.changes if c.rule in MOVES):
            text = _text_of(change, texts)
            rule, new = replacement(binding, text.data[change.startOffset : change.endOffset], kept)
            if kept is not None:
                change.rule, change.replacement = rule, new
            elif not writes(change, port_text(binding) or new):
                change.replacement, change.reason = new, f"{binding.name} is {binding.choice or 'not bound'} on the target"
    settle_lists(plan, texts)
    if kept is not None:
        explicit_enumerators(plan, {str(text.unit.path): text.data for text in texts})
    mark_rewritten(plan)


def settle_lists(plan: migration.MigrationPlan, texts: Sequence[SourceText]) -> None:
    """Write the values of lists that are written by position anew, with the changes of these values, such as a pin's number.

    Raises:
        ModelError: a list is in no source unit.
    """
    listed = [(each.element, [c for c in each.changes if c.rule == POSITIONAL]) for each in plan.dispositions]
    for element, own in listed:
        if not own or not isinstance(element, (ccode.Variable, ccode.Cast)):
            continue
        text = _text_of(own[0], texts)
        inside = [
            change
            for change in all_changes(plan)
            if change.unit is text.unit and change.rule != POSITIONAL
            and element.startOffset <= change.startOffset and change.endOffset <= element.endOffset
        ]  # fmt: skip
        within = [Replacement(int(c.startOffset), int(c.endOffset), str(c.replacement or "")) for c in effective(inside)]
        anew = {(each.start, each.end): each.text for each in positional(element, text.data, within) or ()}
        for change in own:
            change.replacement = anew.get((int(change.startOffset), int(change.endOffset)), change.replacement)


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
        raise ModelError("a change of a port is in no source unit", fix="run migrate again")
    return found


def mark_rewritten(plan: migration.MigrationPlan) -> None:
    """Mark elements whose text a port binding changes as rewritten, and as retained again if the binding is gone."""
    ports: dict[int, list[tuple[int, int]]] = {}
    for c in effective(all_changes(plan)):  # in text order, and none within another
        if isinstance(decision_of(c), (migration.PortBinding, migration.PortFlow)) and c.rule != AS_WRITTEN:
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
