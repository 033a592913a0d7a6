"""Renames the program's functions and variables that the C library or the core of the other board declares, too.

What merely hides such a name, a local variable, a parameter or a member, stays: each place is one that the model links.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.partition.renaming import RENAME
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.macros.tokens import name_tokens

Named = ccode.Function | ccode.Variable


def clashing_names(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of each unit: at the declarations, the uses, and in the bodies of macros."""
    clashes = frozenset(sketch.facts.clashes)
    of_variables = clashes | frozenset(sketch.facts.variable_clashes)
    found: dict[str, list[Named]] = {}
    for view in sketch.views:
        for declared in view.unit.declarations:
            if (
                isinstance(declared, (ccode.Function, ccode.Variable))
                and declared.name in (of_variables if isinstance(declared, ccode.Variable) else clashes)
                and "::" not in _head(declared)
            ):
                found.setdefault(str(declared.name), []).append(declared)
    words = {word for data in sketch.sources.values() for _, _, word in name_tokens(data)} if found else set()
    for name, declarations in found.items():
        new = f"{name}_"
        while new in words:
            new += "_"
        reason = f"the core of the board declares '{name}', too"
        places: dict[int, tuple[ccode.Located | ccode.SourceUnit, set[Replacement]]] = {}
        for element in (e for declared in declarations for e in (declared, *_uses(declared))):
            unit = ancestor_of_kind(element, ccode.SourceUnit)
            if unit is None:
                continue
            data = sketch.sources[str(unit.path)]
            start, end = int(element.startOffset), int(element.endOffset)
            at = next((start + first for first, _, word in name_tokens(data[start:end]) if word == name), None)
            if at is not None:
                places.setdefault(id(unit), (element, set()))[1].add(Replacement(at, at + len(name), new))
        for view in sketch.views:
            holder, edits = places.get(id(view.unit), (None, set()))
            edits |= set(_in_macros(name, new, sketch.sources[str(view.unit.path)]))
            holder = holder or next(iter([*view.unit.macros, *view.unit.declarations, *view.unit.includes]), None)
            if edits and holder is not None:
                yield SketchEdit(holder, RENAME, reason, tuple(sorted(edits)))


def _head(declared: Named) -> str:
    return str(declared.signature or "").partition("(")[0] if isinstance(declared, ccode.Function) else ""


def _uses(declared: Named) -> list[ccode.Located]:
    calls = list(declared.calls) if isinstance(declared, ccode.Function) else []
    return [*declared.references, *calls]


def _in_macros(name: str, new: str, data: bytes) -> Iterator[Replacement]:
    for kind, start, _, text in tokens(data):
        if kind == "directive" and text.lstrip("# \t").startswith("define"):
            inner = [
                (first, last)
                for first, last, word in name_tokens(data[start : start + len(text.encode("latin-1"))])
                if word == name
            ]
            yield from (Replacement(start + first, start + last, new) for first, last in inner)
