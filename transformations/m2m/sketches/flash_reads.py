"""Reads of the program memory: `pgm_read_word` of a pointer becomes `pgm_read_ptr`, since a pointer has another width there.

The element of an array of numbers is read as on AVR: its low bytes come first on the target, too. What takes the word keeps its
width by the rules for numbers.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.expression_type import ValueType, element_type, type_of

KIND = "progmem"
_RULE = "flash-read"
_WORDS = frozenset(["pgm_read_word", "pgm_read_word_near"])
_NUMBERS = frozenset(["int", "unsigned", "unsigned int", "word", "int16_t", "uint16_t"])
_SIGNED = frozenset(["int", "int16_t"])
_POINTER = "pgm_read_ptr"


def flash_reads(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of reads of pointers, and those without changes for reads of numbers."""
    if sketch.move.source.architecture == sketch.move.target.architecture:
        return
    for view in sketch.views:
        lines, data = sketch.lines(KIND, view), sketch.sources[str(view.unit.path)]
        reads = [call for call in view.of_kind(ccode.Call) if call.calleeName in _WORDS and int(call.line) in lines]
        done: dict[int, bool] = {}
        for call in reads:
            kind, start, name = _read(call), int(call.startOffset), str(call.calleeName)
            line = int(call.line)
            done[line] = done.get(line, True)
            cast = call.eContainer()
            if kind is not None and not kind.depth and kind.base in _NUMBERS:
                if (
                    kind.base in _SIGNED
                    and isinstance(cast, ccode.Cast)
                    and cast.target is not None
                    and cast.target.spelling == "int"
                ):
                    sign = inserted(start, f"(int{sketch.move.source.int_bits}_t)")
                    yield SketchEdit(call, _RULE, "the number keeps its sign", (sign,))
                continue
            written = data[start : start + len(name)].decode("utf-8", "replace") == name
            to_pointer = isinstance(cast, ccode.Cast) and cast.target is not None and "*" in str(cast.target.spelling)
            if kind is None or kind.depth != 1 or kind.dimensions or not to_pointer or not written:
                done[line] = False
                continue
            change = Replacement(start, start + len(name), _POINTER)
            yield SketchEdit(call, _RULE, "a pointer is wider there than the word that is read", (change,))
        if cured := tuple(line for line, whole in done.items() if whole):
            yield SketchEdit(view.unit, _RULE, "what is read has the same value there", (), KIND, cured)


def _read(call: ccode.Call) -> ValueType | None:
    """The type of what a call reads; None where the model does not say it."""
    given = call.arguments[0] if call.arguments else None
    while isinstance(given, ccode.Cast):
        given = given.operand
    if isinstance(given, ccode.Unary) and given.operator == "&":
        return type_of(given.operand, {})
    if isinstance(given, ccode.Binary):  # an element of an array: its name, and how far behind its begin
        given = given.left
    return element_type(type_of(given, {}))
