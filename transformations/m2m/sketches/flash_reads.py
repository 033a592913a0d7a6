"""Reads of words from flash, where the board has one address space: a pointer has more bits there, and a word has no sign.

`pgm_read_word` of a place with a pointer reads the whole pointer; of a place with an int it keeps the sign where an int takes the
result. Other reads of words give the same number. Source: the manual of avr-libc 2.0, avr/pgmspace.h.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import of_use, type_of

KIND = "progmem"
_WORD, _POINTER = ("pgm_read_word", "pgm_read_word_near"), "pgm_read_ptr"


def flash_reads(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits."""
    here, there = sketch.move.source, sketch.move.target
    if here.int_bits >= there.int_bits:
        return
    for view in sketch.views:
        lines = sketch.lines(KIND, view)
        for call in view.of_kind(ccode.Call):
            name, start = str(call.calleeName), int(call.startOffset)
            if name not in _WORD or len(call.arguments) != 1 or int(call.line) not in lines:
                continue
            if not sketch.sources[str(view.unit.path)].startswith(name.encode(), start):
                continue
            kind = type_of(call.arguments[0], {})
            if kind is None:
                continue
            if kind.depth > 1:
                changed, reason = Replacement(start, start + len(name), _POINTER), "a pointer has more than 16 bits there"
            elif kind.base == "int" and _is_taken_as_int(call):
                changed, reason = inserted(start, f"(int{here.int_bits}_t)"), "the number keeps its sign"
            else:
                continue
            yield SketchEdit(call, "flash-read", reason, (changed,), KIND, (int(call.line),))
        if lines and (plain := _plain(view, lines)):
            yield SketchEdit(view.unit, "flash-read", "the same number is read there", (), KIND, plain)


def _plain(view: CodeView, lines: frozenset[int]) -> tuple[int, ...]:
    """The lines all of whose reads of words are of numbers without a sign."""
    reads: dict[int, list[bool]] = {}
    for call in view.of_kind(ccode.Call):
        if call.calleeName in _WORD and int(call.line) in lines and len(call.arguments) == 1:
            kind = type_of(call.arguments[0], {})
            same = kind is not None and kind.depth == 1 and kind.base in ("unsigned int", "uint16_t", "unsigned", "word")
            reads.setdefault(int(call.line), []).append(same)
    return tuple(sorted(line for line, same in reads.items() if all(same)))


def _is_taken_as_int(call: ccode.Call) -> bool:
    """Whether an int, and nothing wider, takes the result of a call."""
    outer = call.eContainer()
    if isinstance(outer, ccode.Cast):
        kind = of_use(outer.target)
    elif isinstance(outer, ccode.Variable):
        kind = of_use(outer.valueType)
    elif isinstance(outer, ccode.Assignment) and outer.right is call and outer.operator == "=":
        kind = type_of(outer.left, {})
    else:
        return False
    return kind is not None and kind.depth == 0 and kind.base in ("int", "short", "int16_t")
