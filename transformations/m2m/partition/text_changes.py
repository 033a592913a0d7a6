"""Applies the rules to texts when planning: each change of the carried-over text belongs to the decision that needs it.

What a rule does to the text is a table (`_RULES`): from the rule to the bytes that change and their new text. An edit is as
small as it can be, so that edits for different reasons in one expression do not overlap. Which rule applies is decided in the
plan; edits that move declarations from main to file scope are in `hoisting`. A generator applies the changes in the plan and
derives none. When the user changes a port's binding in a stored plan, its change is made anew
(`settle_bindings`), and so is the disposition of the element that contains it.
"""

from __future__ import annotations

import itertools
import re
from bisect import bisect_left
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from robosmi.errors import ModelError
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language import compound_literals, early_functions, excess_initialisers, linker_sections
from robosmi.transformations.m2m.language.decided_conditions import as_decided
from robosmi.transformations.m2m.language.declared_lists import without
from robosmi.transformations.m2m.language.designated_lists import positional
from robosmi.transformations.m2m.language.edit_definitions import (
    body,
    define_after,
    define_extern,
    define_local,
    define_without_extern,
    name_place,
    one_element,
    sized,
)
from robosmi.transformations.m2m.language.nested_types import before_record, tag_places
from robosmi.transformations.m2m.language.old_c import word_places
from robosmi.transformations.m2m.language.read_only_registers import value_of_register
from robosmi.transformations.m2m.ports.port_texts import MOVES, explicit_enumerators, replacement
from robosmi.transformations.queries.block_braces import inside
from robosmi.transformations.queries.macros.tokens import name_tokens
from robosmi.transformations.queries.own_headers import included, own_header
from robosmi.transformations.queries.plans.binding_edits import writes
from robosmi.transformations.queries.plans.plan import RUN_IN_SETUP
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
        if rule in _RULES:
            for text in _texts(rule, element, texts):
                made += [_change(text, place, rule, reason) for place in _RULES[rule](element, word, text)]
    if disposition.changes:
        disposition.changes.clear()
    disposition.changes.extend(made)


def _texts(rule: str, element: ccode.Located, texts: Sequence[SourceText]) -> Sequence[SourceText]:
    """The texts that a rule changes: that of the element, those of the units that include it, too, or all."""
    if rule in _EVERYWHERE:
        return texts
    own = _text(element, texts)
    return [text for text in texts if text is own or own.unit in included(text.unit)] if rule in _INCLUDED else [own]


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
    listed = [(each.element, [c for c in each.changes if c.rule == _POSITIONAL]) for each in plan.dispositions]
    for element, own in listed:
        if not own or not isinstance(element, (ccode.Variable, ccode.Cast)):
            continue
        text = _text_of(own[0], texts)
        inside = [
            change
            for change in all_changes(plan)
            if change.unit is text.unit and change.rule != _POSITIONAL
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


def _line(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    """Delete the whole line of an element; a comment after the element stays as a line of its own."""
    start, end = text.line_start(element.startOffset), text.line_end(element.endOffset)
    comments = [c for c in text.unit.comments if element.endOffset <= c.startOffset < end]
    return [Replacement(start, comments[0].startOffset if comments else end, "")]


def _line_with_comment(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    """Delete the whole line of an include with its comment, which describes the header or moves with it to the file's head."""
    end = text.line_end(element.endOffset)
    longer = [c for c in text.unit.comments if element.endOffset <= c.startOffset < end < c.endOffset]
    return [Replacement(text.line_start(element.startOffset), longer[0].startOffset if longer else end, "")]


def _keyword(word: str) -> Callable[[ccode.Located, str, SourceText], list[Replacement]]:
    def replaced(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
        return [Replacement(element.startOffset, _end(element, text), word)]

    return replaced


def _end(element: ccode.Located, text: SourceText) -> int:
    """The byte after a statement, not counting its semicolon."""
    end = element.endOffset
    while end > element.startOffset and text.data[end - 1 : end] in (b";", b" ", b"\t", b"\n", b"\r"):
        end -= 1
    return end


def _void_value(element: ccode.Return, choice: str, text: SourceText) -> list[Replacement]:
    value = element.value
    assert value is not None  # else the rule does not hold
    return [Replacement(value.startOffset, value.startOffset, "(void)("), Replacement(value.endOffset, value.endOffset, ")")]


def _go_on(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    """Replace a statement that leaves main's loop by a return that calls the function with the statements after the loop."""
    return [Replacement(element.startOffset, _end(element, text), f"return {choice}()")]


def _value_and_go_on(element: ccode.Return, choice: str, text: SourceText) -> list[Replacement]:
    assert element.value is not None  # else the rule does not hold
    return [*_void_value(element, choice, text), Replacement(element.value.endOffset, element.value.endOffset, f", {choice}()")]


def _out(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    """Delete a declaration with its semicolon, and its line if nothing else is on it."""
    found = text.data.find(b";", element.endOffset - 1)
    end = found + 1 if found >= 0 else element.endOffset
    start = text.line_start(element.startOffset)
    if text.blank(start, element.startOffset) and text.blank(end, text.line_end(end)):
        return [Replacement(start, text.line_end(end), "")]
    return [Replacement(element.startOffset, end, "")]


def _out_of_list(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Delete some declarators of a declaration, given by their indices."""
    return without(text.data, int(element.startOffset), [int(number) for number in choice.split()])


def _rename(element: ccode.Declaration | ccode.Macro, choice: str, text: SourceText) -> list[Replacement]:
    return [Replacement(start, end, choice) for start, end, name in name_tokens(text.data) if name == element.name]


def _rename_tag(element: ccode.Declaration, choice: str, text: SourceText) -> list[Replacement]:
    """Rename the tag after `struct`, `union` or `enum` only; a typedef of the same name keeps it."""
    names = list(name_tokens(text.data))
    pairs = itertools.pairwise(names)
    return [
        Replacement(start, end, choice)
        for (_, _, before), (start, end, name) in pairs
        if name == element.name and before in _TAGGED
    ]


def _qualify_type(element: ccode.Declaration, choice: str, text: SourceText) -> list[Replacement]:
    """Qualify the type of a member that has its type's name with `::`, so that it means the type at file scope."""
    found = re.compile(rb"\b%s\b" % re.escape(element.name.encode())).search(text.data, element.startOffset, element.endOffset)
    return [Replacement(found.start(), found.start(), "::")] if found else []


def _open_size(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Delete the first size of an array parameter, which has no effect on its type."""
    found = re.compile(rb"\[([^\]]*)\]").search(text.data, name_place(element, text.data), element.endOffset)
    return [Replacement(found.start(1), found.end(1), "")] if found else []


def _branch_out(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    """Delete what a preprocessor condition encloses, up to the next directive of the same condition."""
    depth, start = 0, text.line_end(element.endOffset)
    for directive in text.unit.conditionals:
        if directive.startOffset <= element.startOffset:
            continue
        if depth == 0 and directive.directive not in ("if", "ifdef", "ifndef"):
            return [Replacement(start, text.line_start(directive.startOffset), "")]
        depth += directive.directive in ("if", "ifdef", "ifndef")
        depth -= directive.directive == "endif"
    return []


_TAGGED = frozenset({"struct", "union", "enum"})


def _convert(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    return [Replacement(element.startOffset, element.startOffset, f"({choice})")]


def _convert_compound(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    return [
        Replacement(element.startOffset, element.startOffset, f"({choice})("),
        Replacement(element.endOffset, element.endOffset, ")"),
    ]


def _parentheses(element: ccode.Declaration, choice: str, text: SourceText) -> list[Replacement]:
    found = re.compile(rb"\b%s(?:\s*\[[^\]]*\])*\s*+\)?\s*+\(\s*\)" % re.escape(element.name.encode())).search(
        text.data, element.startOffset, element.endOffset
    )
    return [Replacement(found.end() - 1, found.end() - 1, choice)] if found else []


def _parameters_behind(element: ccode.Function, choice: str, text: SourceText) -> list[Replacement]:
    """Move K&R parameter declarations into the parameter list; comments among them stay after it."""
    assert element.body is not None  # only a definition has parameters there
    start = text.data.find(b"(", text.data.find(element.name.encode(), element.startOffset)) + 1
    end = element.startOffset + len(text.data[element.startOffset : element.body.startOffset].rstrip())
    comments = [c for c in text.unit.comments if start <= c.startOffset < end]
    end = comments[0].startOffset if comments and comments[0].startOffset > text.data.rfind(b";", start, end) else end
    shown = [text.slice(c.startOffset, c.endOffset)[0].strip() for c in comments if c.startOffset < end]
    return [Replacement(start, end, f"{choice})" + "".join(f"\n{line}" for line in shown))]


def _return_at_end(element: ccode.Function, choice: str, text: SourceText) -> list[Replacement]:
    assert element.body is not None  # only a definition can lack a return
    brace = inside(text.data, element.body)[1]
    start = text.line_start(brace)
    if text.blank(start, brace):
        indent = text.data[start:brace].decode("latin-1")
        return [Replacement(start, start, f"{indent}  return {choice};\n")]
    return [Replacement(brace, brace, f"return {choice}; ")]


def _replace(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    return [Replacement(element.startOffset, element.endOffset, choice)]


def _comment(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    """Turn an element's text into a comment followed by an empty statement; comments inside do not end the new one."""
    start, end = element.startOffset, element.endOffset
    marks = re.compile(rb"/\*|\*/").finditer(text.data, start, end)
    inner = [Replacement(m.start(), m.end(), " ".join(m[0].decode())) for m in marks]
    return [Replacement(start, start, "/* "), *inner, Replacement(end, end, " */;")]


def _compound(element: ccode.Assignment, choice: str, text: SourceText) -> list[Replacement]:
    assert element.right is not None
    return [
        Replacement(element.startOffset, element.right.startOffset, choice),
        Replacement(element.endOffset, element.endOffset, "))"),
    ]


def _insert(words: str) -> Callable[[ccode.Located, str, SourceText], list[Replacement]]:
    return lambda element, choice, text: [Replacement(element.startOffset, element.startOffset, words)]


def _static(words: str) -> Callable[[ccode.Located, str, SourceText], list[Replacement]]:
    """Make the edit that replaces the word static, which may be before the declaration or within it."""

    def changed(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
        found = re.compile(rb"static\b\s*").search(text.data, text.line_start(element.startOffset), element.endOffset)
        return [Replacement(found.start(), found.end(), words)] if found else []

    return changed


def _share_one(variable: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Make one of several declared variables a weak symbol, so that several files can define it."""
    place = variable.endOffset
    return [Replacement(place, place, " __attribute__((weak))")]


def _behind_return(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    place = element.startOffset + len("return")
    return [Replacement(place, place, f" {choice}")]


def _inner_block(element: ccode.Block, choice: str, text: SourceText) -> list[Replacement]:
    start, end = inside(text.data, element)
    return [Replacement(start, start, " {"), Replacement(end, end, "} ")]


def _assign_behind(variable: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    place = name_place(variable, text.data) + len(variable.name.encode())
    return [Replacement(place, place, f"; {choice}")]


def _words_of_c(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    first, end = int(element.startOffset), int(element.endOffset)
    return [place for place in word_places(text.data) if first <= place[0] < end]


def _words_between(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    wanted = {int(start) for start in choice.split()}
    return [place for place in word_places(text.data) if place[0] in wanted]


def _implicit_int(element: ccode.Located, choice: str, text: SourceText) -> list[Replacement]:
    place = element.startOffset + int(choice)
    return [Replacement(place, place, "int ")]


def _more_arguments(element: ccode.Call, choice: str, text: SourceText) -> list[Replacement]:
    return [Replacement(element.endOffset - 1, element.endOffset - 1, choice)]


def _fewer_arguments(element: ccode.Call, choice: str, text: SourceText) -> list[Replacement]:
    """Delete the arguments of a call after the given number of them."""
    kept, given = int(choice), list(element.arguments)
    mark, before = (b",", given[kept - 1]) if kept else (b"(", element.calleeExpression)
    assert before is not None  # it is called through a pointer
    place = text.data.index(mark, before.endOffset) + (not kept)
    return [Replacement(place, element.endOffset - 1, "")]


def _own_header(element: ccode.Include, choice: str, text: SourceText) -> list[Replacement]:
    """Let the include of a header that is carried over name the file in the sketch folder."""
    written = re.compile(rb'[<"][^>"\n]*[>"]').search(text.data, element.startOffset, text.line_end(element.startOffset))
    wanted = f'"{own_header(element)}"'
    if written is None or written[0] == wanted.encode():
        return []
    return [Replacement(written.start(), written.end(), wanted)]


_POSITIONAL = "positional"
"""The rule of lists with designators that are written by position."""

_EditRule = Callable[[Any, str, SourceText], list[Replacement]]
"""A function from an element, the rule's text and the text of the element's unit to the replacements."""

_RULES: dict[str, _EditRule] = {
    "platform-include": _line,
    "standard-include": _line_with_comment,
    "posix-include": _line,
    "unknown-include": _line,
    "own-header": _own_header,
    "return-from-setup": _keyword("return"),
    "return-value-from-setup": _void_value,
    "continue-main-loop": _keyword("return"),
    "leave-main-loop": _go_on,
    "end-of-main": _go_on,
    "value-and-end-of-main": _value_and_go_on,
    "main-prototype": _out,
    "rename": _rename,
    "rename-here": _rename,
    "rename-tag": _rename_tag,
    "qualify-type": _qualify_type,
    "linkage-of-c": _branch_out,
    "decided-condition": lambda element, choice, text: as_decided(element, text),
    "open-size": _open_size,
    _POSITIONAL: lambda element, choice, text: positional(element, text.data) or [],
    excess_initialisers.RULE: lambda element, choice, text: excess_initialisers.places(element, text.data),
    compound_literals.RULE: lambda element, choice, text: compound_literals.replacements(element, choice, text.data),
    "convert": _convert,
    "convert-compound": _convert_compound,
    "empty-parentheses": _parentheses,
    "missing-arguments": _more_arguments,
    "surplus-arguments": _fewer_arguments,
    "parameters-behind": _parameters_behind,
    "return-at-end": _return_at_end,
    "implicit-int": _implicit_int,
    "words-of-c": _words_of_c,
    "words-between": _words_between,
    "enumeration-before": lambda element, choice, text: before_record(element, choice),
    "tag-of-member": lambda element, choice, text: tag_places(element, choice, text.unit, text.data),
    "one-element": one_element,
    "declare-only": _insert("extern "),
    "declare-static": _static("extern "),
    "no-static": _static(""),
    "share": _insert("__attribute__((weak)) "),
    "share-one": _share_one,
    "replace": _replace,
    "value-of-register": lambda element, choice, text: value_of_register(element, choice, text.data),
    "compound-of-enumeration": _compound,
    "compound-of-bytes": _compound,
    "source-assembler": _comment,
    linker_sections.RULE: lambda element, choice, text: linker_sections.without_section(element, text.data),
    "return-with-value": _behind_return,
    "return-without-value": _void_value,
    "zero-value": lambda element, choice, text: [Replacement(element.endOffset, element.endOffset, f" = {choice}")],
    RUN_IN_SETUP: lambda element, choice, text: early_functions.without_attribute(element, text.data),
    "inner-block": _inner_block,
    "assign-behind": _assign_behind,
    "take-out": _out,
    "out-of-list": _out_of_list,
    "define-extern": define_extern,
    "define-without-extern": define_without_extern,
    "define-local": define_local,
    "define-in-list": sized,
    "define-behind": define_after,
    "shared-behind": define_after,
    "left-undefined": lambda element, choice, text: [],
    "adapter-in-place": body,
    "adapter-declared": _out,
}
"""The edit of each rule of a disposition."""

_EVERYWHERE = frozenset({"rename", "rename-tag", "tag-of-member"})
"""Rules that change every unit of the program, not only the one with their element."""
_INCLUDED = frozenset({"rename-here"})
"""Rules that change the unit with their element and those that include it."""
