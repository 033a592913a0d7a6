"""Edits that turn declarations into definitions: variables without one, arrays without a size, functions without a body."""

from __future__ import annotations

import re

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.adapters.adapter_ranges import parameter_names
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.queries.signature_text import nothing
from robosmi.transformations.queries.source_text import SourceText, is_header


def name_place(variable: ccode.Variable | ccode.Parameter, data: bytes) -> int:
    """Offset of a variable's name in its declaration."""
    initial = variable.initializer if isinstance(variable, ccode.Variable) else None
    end = initial.startOffset if initial is not None else variable.endOffset
    found = [m.start() for m in re.finditer(rb"\b%s\b" % re.escape(variable.name.encode()), data[variable.startOffset : end])]
    return variable.startOffset + (found[-1] if found else 0)


def define_local(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Turn a local declaration of a variable that is defined nowhere into the definition of a static variable."""
    changes = define_extern(element, choice, text)
    start = text.data.rfind(b"extern", 0, element.startOffset + len(b"extern"))
    found = re.compile(rb"extern\b").match(text.data, start) if start >= 0 else None
    outside = found is not None and text.blank(found.end(), int(element.startOffset))
    if found is not None and (outside or start >= element.startOffset):
        return [
            Replacement(found.start(), found.end(), "static"),
            *(each for each in changes if each[2] and each[0] > found.start()),
        ]
    return changes


def define_extern(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Turn the declaration of a variable with external linkage into its definition."""
    return _defined("extern " * is_constant(element), element, choice, text)  # a constant of C++ is its file's own but for extern


def define_without_extern(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Turn the declaration of a variable into its definition by removing `extern`."""
    return _defined("", element, choice, text)


def _defined(before: str, element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Turn a declaration into a definition by replacing `extern` with another specifier."""
    found = re.compile(rb"\bextern\b\s*").search(text.data, element.startOffset, element.endOffset)
    kept = before + "__attribute__((weak)) " * is_header(text.unit)
    made = [Replacement(found.start(), found.end(), kept)] if found else []
    return made + sized(element, choice, text)


def is_constant(variable: ccode.Variable) -> bool:
    """Whether a variable is constant; C++ requires an initial value for it."""
    use = variable.valueType
    return use is not None and bool(use.constant) and not use.pointerDepth


def sized(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Give an array of unknown size a size, and a constant an initial value."""
    found = re.compile(rb"\[\s*\]").search(text.data, name_place(element, text.data), element.endOffset)
    value = [Replacement(int(element.endOffset), int(element.endOffset), " = {0}")] if is_constant(element) and choice else []
    return [*([Replacement(found.end() - 1, found.end() - 1, "16")] if found else []), *value]


def one_element(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Give an array without a size that no other declaration completes one element (C11 6.9.2)."""
    found = re.compile(rb"\[\s*\]").search(text.data, name_place(element, text.data), element.endOffset)
    return [Replacement(found.end() - 1, found.end() - 1, "1")] if found else []


def define_after(element: ccode.Variable, choice: str, text: SourceText) -> list[Replacement]:
    """Add definitions of some of the names after a declaration of several."""
    place = text.data.find(b";", element.endOffset) + 1
    weak = "__attribute__((weak)) " if is_header(text.unit) else ""
    value = " = {0}" * is_constant(element)
    made = "".join(f" {weak}__typeof__({name}) {name}{value};" for name in choice.split())
    return [*sized(element, "", text), *([Replacement(place, place, made)] if place else [])]


_ATTRIBUTES_BEHIND = re.compile(rb"(?:\s*__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\))+\s*\Z")


def body(element: ccode.Function, choice: str, text: SourceText) -> list[Replacement]:
    """Turn a prototype into an adapter: its semicolon is replaced by a body for the user to complete.

    If the prototype shares its declaration with other names, the function is defined after it, with the given signature.
    """
    returned = element.returnType.spelling if element.returnType is not None else "int"
    lines = ["  // TODO: complete method", *(f"  (void){p.name};" for p in element.parameters if p.name)]
    result = nothing(returned)
    lines += [f"  return {result};"] if result else []
    found = text.data.find(b";", element.endOffset - 1)
    end = found + 1 if found >= 0 else element.endOffset
    shared = is_header(text.unit)
    if "(" in choice:  # plans of 0.1.0 have the name here
        named = [f"  (void){name};" for name in parameter_names(choice) if name]
        lines = ["  // TODO: complete method", *named, *([f"  return {result};"] if result else [])]
        return [Replacement(end, end, "\n" + "inline " * shared + choice + " {\n" + "\n".join(lines) + "\n}")]
    made = [Replacement(element.startOffset, element.startOffset, "inline ")] if shared else []
    place = found if found >= 0 else end
    attributes = _ATTRIBUTES_BEHIND.search(text.data, element.startOffset, place)
    start = attributes.start() if attributes is not None else place  # a definition has none behind its list
    return [*made, Replacement(start, end, " {\n" + "\n".join(lines) + "\n}")]
