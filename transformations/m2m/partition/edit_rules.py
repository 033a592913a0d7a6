"""The edit that each rule of a disposition makes: a table from the rule to the bytes that change and their new text.

An edit is as small as it can be, so that edits for different reasons in one expression do not overlap. Which rule applies is
decided in the plan; edits that move declarations from main to file scope are in `hoisting`.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable
from typing import Any

from robosmi.metamodels import ccode
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
from robosmi.transformations.queries.block_braces import inside
from robosmi.transformations.queries.macros.tokens import name_tokens
from robosmi.transformations.queries.own_headers import own_header
from robosmi.transformations.queries.plans.plan import RUN_IN_SETUP
from robosmi.transformations.queries.source_text import SourceText


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


POSITIONAL = "positional"
"""The rule of lists with designators that are written by position."""

EditRule = Callable[[Any, str, SourceText], list[Replacement]]
"""A function from an element, the rule's text and the text of the element's unit to the replacements."""

RULES: dict[str, EditRule] = {
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
    POSITIONAL: lambda element, choice, text: positional(element, text.data) or [],
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

EVERYWHERE = frozenset({"rename", "rename-tag", "tag-of-member"})
"""Rules that change every unit of the program, not only the one with their element."""
INCLUDED = frozenset({"rename-here"})
"""Rules that change the unit with their element and those that include it."""
