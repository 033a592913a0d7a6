"""Numbers wrap around as on a board whose int is narrower: the types of variables and casts keep the width that they had there.

Only what may leave that width is changed (`WrappedValues`): a variable gets a type of its width on the source, and a result that
is looked at is cut to it. A variable whose address is taken as that of an int keeps its type, and stays a task.

Also: variables of type char that take negative values, where char has no sign on the target.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.returned_values import returned_values
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constants.negative_chars import negative_chars
from robosmi.transformations.queries.constants.wrapped_values import Holder, WrappedValues
from robosmi.transformations.queries.numbers import Machine
from robosmi.transformations.queries.own_headers import unit_of
from robosmi.transformations.queries.width_types import retyped_words

TIME = "int_time"
_TYPE = re.compile(
    rb"(?:\s*\b(?:static|const|volatile|register|extern|inline|constexpr|unsigned|signed|int|char|double|PROGMEM)\b)+"
)
"""The words in front of a declared name, as far as a type is written with them."""


def wrapped_values(sketch: MovedSketch) -> WrappedValues | None:
    """Where the numbers of a program leave its int; None if the int of the target is not wider."""
    here, there = sketch.move.source, sketch.move.target
    if here.int_bits >= there.int_bits:
        return None
    own, other = (Machine(each.int_bits, 32, each.int_bits, each.char_signed) for each in (here, there))
    return WrappedValues(sketch.views, own, other, returned_values(sketch.views[0].api.name))


def int_widths(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of types of variables, and the casts of results."""
    values = wrapped_values(sketch)
    if values is None:
        return
    bits, done = sketch.move.source.int_bits, set[tuple[str, int]]()
    for holder in values.variables:
        group = declarations(sketch.views, holder)
        if not all(is_free(each) for each in group):
            continue
        for each in group:
            words = retyped_here(sketch, each, bits)
            unit = unit_of(each)
            place = (str(unit.path), words[0].start) if words and unit is not None else None
            if place is None or place in done:
                continue
            done.add(place)
            reason = f"'{each.name}' may leave the {bits} bits that an int has on its own board, and wraps there"
            yield SketchEdit(each, "int-wraps", reason, words)
        yield from _cured_times(sketch, holder)
    for view in sketch.views:
        for expression, number in values.exceeding(view):
            if not is_written(view, expression):
                continue
            cut = f"{'' if number.signed else 'u'}int{bits}_t"
            start, end = int(expression.startOffset), int(expression.endOffset)
            reason = f"the result is cut to the {bits} bits that it has on its own board"
            yield SketchEdit(expression, "int-cut", reason, (inserted(start, f"({cut})("), inserted(end, ")")))


def _cured_times(sketch: MovedSketch, holder: Holder) -> Iterator[SketchEdit]:
    """Edits without changes that cure the places where a variable with its own width takes a time."""
    for view in sketch.views:
        at = {int(each.line) for each in (holder, *holder.references) if unit_of(each) is view.unit}
        if lines := tuple(sorted(at & sketch.lines(TIME, view))):
            yield SketchEdit(view.unit, "int-wraps", "the variable wraps as on its own board", (), TIME, lines)


def char_signs(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of variables, parameters and functions of type char that have negative values, where char has no sign."""
    if not sketch.move.source.char_signed or sketch.move.target.char_signed:
        return
    done = set[tuple[str, int]]()
    for holder in negative_chars(sketch.views, returned_values(sketch.views[0].api.name)):
        group = declarations(sketch.views, holder)
        if not all(is_free(each) for each in group):
            continue
        for each in group:
            data, start = _source(sketch, each)
            found = _TYPE.match(data, start)
            word = re.search(rb"\bchar\b", found[0]) if found else None
            unit = unit_of(each)
            if found is None or word is None or unit is None or (str(unit.path), start + word.start()) in done:
                continue
            done.add((str(unit.path), start + word.start()))
            at = start + word.start()
            yield SketchEdit(
                each, "char-sign", f"'{each.name}' takes negative values, and char has no sign there", (inserted(at, "signed "),)
            )


def retyped_here(sketch: MovedSketch, each: ccode.Declaration, bits: int) -> tuple[Replacement, ...]:
    """The replacements in front of a declared name that give its int a width; none where its type is written otherwise."""
    data, start = _source(sketch, each)
    found = _TYPE.match(data, start)
    return tuple(
        Replacement(word.start + start, word.end + start, word.text) for word in retyped_words(found[0], bits)
    ) if found else ()  # fmt: skip


def _source(sketch: MovedSketch, each: ccode.Declaration) -> tuple[bytes, int]:
    unit = unit_of(each)
    return (sketch.sources[str(unit.path)], int(each.startOffset)) if unit is not None else (b"", 0)


def declarations(views: Iterable[CodeView], holder: ccode.Declaration) -> list[ccode.Declaration]:
    """All declarations of a variable, parameter or function: a type is changed in all of them or in none."""
    owner = holder.eContainer()
    seen = list(views)
    if isinstance(holder, ccode.Parameter) and isinstance(owner, ccode.Function):
        at = list(owner.parameters).index(holder)
        same = (f for view in seen for f in view.of_kind(ccode.Function) if f.name == owner.name)
        return [f.parameters[at] for f in same if len(f.parameters) == len(owner.parameters)]
    if isinstance(holder, ccode.Function):
        return [f for view in seen for f in view.of_kind(ccode.Function) if f.name == holder.name]
    shared = isinstance(owner, ccode.SourceUnit) and holder.storage is not ccode.Storage.staticStorage  # type: ignore[attr-defined]
    if not shared:
        return [holder]
    every = (v for view in seen for v in view.of_kind(ccode.Variable) if v.name == holder.name)
    return [v for v in every if isinstance(v.eContainer(), ccode.SourceUnit)]


def is_free(holder: ccode.Declaration) -> bool:
    """Whether a type may change: nothing points or refers to the variable as to one of its type."""
    use = holder.valueType if isinstance(holder, (ccode.Variable, ccode.Parameter)) else None
    array = use is not None and bool(use.arrayDims)
    for reference in holder.references:
        outer = reference.eContainer()
        if isinstance(outer, ccode.Unary) and outer.operator == "&" and not isinstance(outer.eContainer(), ccode.Cast):
            return False
        if array and not (isinstance(outer, ccode.Index) and outer.array is reference) and not isinstance(outer, ccode.SizeOf):
            return False
        if isinstance(outer, ccode.Call) and outer.callee is not None and reference in list(outer.arguments):
            at, parameters = list(outer.arguments).index(reference), list(outer.callee.parameters)
            kind = parameters[at].valueType if at < len(parameters) else None
            if outer.callee.definition and kind is not None and "&" in str(kind.spelling):
                return False
    return True


def is_written(view: CodeView, expression: ccode.Expression) -> bool:
    """Whether an expression stands in the text as it is, and not in the body or an argument of a macro."""
    start, end = int(expression.startOffset), int(expression.endOffset)
    around = (use for use in view.unit.macroUses if int(use.startOffset) <= start and end <= int(use.endOffset))
    return start < end and not any(True for _ in around)
