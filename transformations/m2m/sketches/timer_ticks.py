"""A timer that calls an interrupt function again and again becomes a repeating timer of the target.

The idiom: one function writes constants into the registers of a timer that starts again at its compare register (CTC), and the
interrupt of that register is enabled. Any other use of these registers leaves all of them as they are. Source: ATmega328P data
sheet DS40002061, sections 16.9.2 and 18.7.2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.avr_bits import TickingTimer, avr_bits
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.register_idioms import without
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.ports.register_values import register_value

_RULE = "timer-tick"
_REGISTERS, _VECTOR = "timer_register", "isr_vector"
_COMPARE_A = 0b10
"""The bit of the interrupt mask register for compare register A, equal for all timers."""
_OUTPUTS = 0xF0
"""The bits of the first control register by which compare registers drive pins."""


def timer_ticks(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of timers that tick."""
    if not sketch.facts.tick or not sketch.clock_hz:
        return
    found: list[SketchEdit] = []
    for view in sketch.views:
        for handler in view.of_kind(ccode.Function):
            tick = avr_bits().ticks.get(str(handler.name))
            if tick is not None and handler.body is not None:
                found += _of_timer(sketch, view, handler, tick)
    yield from found
    first = {id(ancestor_of_kind(e.element, ccode.SourceUnit)): e.element for e in reversed(found)}
    for element in first.values():
        header = inserted(0, f"#include <{sketch.facts.tick_header}>\n")
        yield SketchEdit(element, _RULE, "the header declares the target's timers", (header,))


def _of_timer(sketch: MovedSketch, view: CodeView, handler: ccode.Function, tick: TickingTimer) -> Iterator[SketchEdit]:
    names = {name: role for role, name in tick.registers.items()}
    uses = [(each, seen) for seen in sketch.views for each in seen.of_kind(ccode.NameReference) if each.name in names]
    writes = [(each, seen) for each, seen in uses if _is_plain_write(each)]
    use = next((each for each in view.unit.macroUses if int(each.startOffset) == int(handler.startOffset)), None)
    if len(writes) != len(uses) or not writes or use is None or len({id(seen) for _, seen in writes}) != 1:
        return
    statements = [outer for each, _ in writes if isinstance(outer := each.eContainer(), ccode.Assignment)]
    of = writes[0][1]
    us = _period_us(statements, names, tick, of, sketch.clock_hz)
    if us is None or len({id(_function(each)) for each in statements}) != 1:
        return
    number = re.sub(r"\D", "", str(handler.name))
    called = f"onTimer{number}"
    reason = f"timer {number} calls it every {us} us"
    changed = (Replacement(int(use.startOffset), int(use.endOffset), f"void {called}()"),)
    yield SketchEdit(handler, _RULE, reason, changed, _VECTOR, (int(use.line),))
    filled = {"function": called, "us": str(us), "timer": f"timer{number}"}
    text = re.sub(r"\{(function|us|timer)\}", lambda found: filled[found[1]], sketch.facts.tick)
    last = max(statements, key=lambda each: int(each.startOffset))
    for each in statements:
        yield without(sketch, of, each, _RULE, reason, _REGISTERS, text if each is last else "")


def _is_plain_write(reference: ccode.NameReference) -> bool:
    """Whether a register is written by a statement that always runs, of a function that runs straight on."""
    outer = reference.eContainer()
    if not isinstance(outer, ccode.Assignment) or outer.left is not reference or outer.operator not in ("=", "|=", "&="):
        return False
    statement = outer.eContainer()
    block = statement.eContainer() if isinstance(statement, ccode.ExpressionStatement) else None
    return isinstance(block, ccode.Block) and isinstance(block.eContainer(), ccode.Function)


def _function(each: ccode.Assignment) -> ccode.Function | None:
    return ancestor_of_kind(each, ccode.Function)


def _period_us(
    statements: Sequence[ccode.Assignment], names: dict[str, str], tick: TickingTimer, view: CodeView, clock_hz: int
) -> int | None:
    """The period in microseconds; None if the registers are set for anything else, or to what is not constant."""
    found: dict[str, int] = {"control_a": 0, "control_b": 0, "enable": 0}
    for each in sorted(statements, key=lambda each: int(each.startOffset)):
        value = register_value(each.right, view.values)
        role = names[str(each.left.name)]  # type: ignore[union-attr]
        if value is None:
            return None
        before = found.get(role, 0)
        found[role] = {"=": value, "|=": before | value, "&=": before & value}[str(each.operator)] & 0xFFFF
    control_a, control_b = found["control_a"], found["control_b"]
    mode = control_a & 0b11 == tick.mode_a and control_b & tick.mask_b == tick.mode_b
    divisor = tick.prescalers[control_b & 0b111]
    if not mode or control_a & _OUTPUTS or found["enable"] != _COMPARE_A or not divisor or "compare" not in found:
        return None
    return round((found["compare"] + 1) * divisor * 1e6 / clock_hz)
