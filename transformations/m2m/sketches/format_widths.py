"""Formats of printf and scanf print and read what they do on a board with a narrower int.

`%u` of a negative int, and `%d` of an unsigned one, show other digits where int is wider, so the argument is cut. `%d` of scanf
writes as many bytes as an int has, so a variable of 16 bits is read by `%hd`. A conversion of another width than its argument,
and one of a float, which avr-libc prints as `?`, are places. Source: ISO/IEC 9899:1999, 7.19.6; avr-libc, vfprintf().
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.knowledge.replacements import inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.m2m.widths.width_formats import conversions
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constants.wrapped_values import WrappedValues
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace

KIND = "format_width"
_RULE = "format-width"
_FORMATS: Mapping[str, int] = {"printf": 0, "sprintf": 1, "fprintf": 1, "snprintf": 2, "sscanf": 1, "scanf": 0}
"""Function -> the position of its format; their relatives for formats in program memory end with `_P`."""
_INTEGERS = frozenset("diuxXo")
_REALS = frozenset("aAeEfFgG")
_BITS = {"hh": 8, "h": 16, "": 16, "l": 32, "ll": 64}
"""Length of a conversion -> the bits that it takes where int has 16."""


def format_widths(sketch: MovedSketch, values: WrappedValues) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of arguments and formats, and the conversions that no edit mends."""
    for view in sketch.views:
        for call in view.of_kind(ccode.Call):
            name = str(call.calleeName).removesuffix("_P")
            at, arguments = _FORMATS.get(name), list(call.arguments)
            if at is None or at >= len(arguments) or call.viaMacro:
                continue
            literals = [each for each in all_contents(arguments[at]) if isinstance(each, ccode.StringLiteral)]
            if len(literals) == 1:
                yield from _of_call(sketch, values, view, literals[0], arguments[at + 1 :], reads=name.endswith("scanf"))


def _of_call(
    sketch: MovedSketch, values: WrappedValues, view: CodeView, literal: ccode.StringLiteral,
    arguments: list[ccode.Expression], *, reads: bool,
) -> Iterator[SketchEdit | PortabilityPlace]:  # fmt: skip
    start, end = int(literal.startOffset), int(literal.endOffset)
    text = sketch.sources[str(view.unit.path)][start:end].decode("latin-1")
    bits = sketch.move.source.int_bits
    for (length, letter, offset), argument in zip(conversions(text, reads), arguments, strict=False):
        shown = f"%{length}{letter}"
        if letter in _REALS and not reads:
            yield sketch.place(KIND, argument, f"{shown} prints '?'")
        number = values.number(_pointed(argument) if reads else argument)
        if letter not in _INTEGERS or number is None or number.real:
            continue
        wanted, has = _BITS.get(length), number.bits if reads else max(number.bits, bits)
        if wanted is None:
            continue
        if max(wanted, bits) != has and (reads or length not in ("h", "hh")):
            yield sketch.place(KIND, argument, f"{shown} takes {wanted} bits, and its argument has {has}")
        elif reads and not length and number.fixed and text.startswith('"'):
            why = f"{shown} writes an int, which is wider there than the variable"
            yield SketchEdit(literal, _RULE, why, (inserted(start + offset, "h"),))
        elif not reads and not length and number.bits == bits and number.signed != (letter in "di"):
            found = values.range_of(argument)
            if found is None or not found.within(0, (1 << (bits - 1)) - 1):
                cut = f"{'' if letter in 'di' else 'u'}int{bits}_t"
                first, last = int(argument.startOffset), int(argument.endOffset)
                why = f"{shown} shows the {bits} bits that the value has on its own board"
                yield SketchEdit(argument, _RULE, why, (inserted(first, f"({cut})("), inserted(last, ")")))


def _pointed(argument: ccode.Expression) -> ccode.Expression | None:
    return argument.operand if isinstance(argument, ccode.Unary) and argument.operator == "&" else None
