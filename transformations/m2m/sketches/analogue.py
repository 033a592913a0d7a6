"""Analogue inputs and outputs: the same full scale and frequency as on the source board, as far as a call in setup gives them.

What it does not give is a place: a second frequency, another reference, and voltages that a sketch computes with 5 V.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.knowledge.replacements import inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit, setup_start
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
from robosmi.transformations.queries.ports.timer_outputs import timer_outputs

READ, WRITE, REFERENCE = "analogRead", "analogWrite", "analogReference"
_ANY = "*"
_STEPS = frozenset([1023, 1024])
_VOLTS = frozenset([5, 50, 500, 5000])


def analogue(sketch: MovedSketch) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits, and the places."""
    source, target = sketch.move.source, sketch.move.target
    called = [(view, call) for view in sketch.views for call in view.of_kind(ccode.Call)]
    if source.chip != target.chip and source.timers:
        yield from dict.fromkeys(_levels(sketch, [each for each in called if each[1].calleeName == WRITE and each[1].arguments]))
    if source.architecture == target.architecture:
        if source.chip != target.chip:  # the internal reference has another name, or other volts
            for _, call in called:
                chosen = next(iter(call.arguments), None) if call.calleeName == REFERENCE else None
                if isinstance(chosen, ccode.NameReference) and str(chosen.name).startswith("INTERNAL"):
                    yield sketch.place("analog_reference", call, REFERENCE)
        return
    named = {name: [(v, c) for v, c in called if c.calleeName == name] for name in (READ, WRITE, REFERENCE)}
    added: list[tuple[str, str]] = []
    if named[READ] and sketch.facts.read_bits:
        added.append((sketch.facts.read_bits, "analogRead has the full scale of its own board"))
    if sketch.facts.pwm_frequency and (frequencies := _frequencies(sketch, named[WRITE])):
        wanted = min(hz for _, hz in frequencies)
        text = sketch.facts.pwm_frequency.replace("{hz}", str(wanted))
        added.append((text, f"analogWrite has {wanted} Hz on its own board"))
        for written, hz in frequencies:
            if hz != wanted:
                yield sketch.place("pwm_frequency", written, f"{hz} Hz")
    start = setup_start(sketch.views, sketch.sources) if added else None
    if start is not None:
        _, setup, offset = start
        text, reasons = "".join(f" {each};" for each, _ in added), "; ".join(reason for _, reason in added)
        yield SketchEdit(setup, "analogue", reasons, (inserted(offset, text),))
    for _, call in named[REFERENCE]:
        yield sketch.place("analog_reference", call, REFERENCE)
    if named[READ] and sketch.facts.supply_volts:
        yield from _volts(sketch)


def _levels(sketch: MovedSketch, calls: Sequence[tuple[CodeView, ccode.Call]]) -> Iterator[PortabilityPlace]:
    """The calls for pins that make no pulses on the source board, where analogWrite sets their level."""
    source = sketch.move.source
    for view, call in calls:
        numbers = {value.number for value in view.values.of(call.arguments[0])}
        pins = {source.numbers.get(number) for number in numbers if number is not None}
        if without := sorted(pin for pin in pins if pin is not None and pin not in source.timers):
            yield sketch.place("no_pwm", call, ", ".join(without))


def _frequencies(sketch: MovedSketch, calls: Sequence[tuple[CodeView, ccode.Call]]) -> list[tuple[ccode.Expression, int]]:
    """The places that make pulses on the source board, with their frequencies in Hz."""
    timers = timer_outputs(sketch.views)
    clocks = {**sketch.facts.pwm_clocks, **{timer.timer: timer.clocks for timer in timers}}
    found: list[tuple[ccode.Expression, int]] = [(call, _frequency(sketch, view, call, clocks)) for view, call in calls]
    for timer in timers:
        hz = round(sketch.clock_hz / timer.clocks)
        found += [(write.element, hz) for write in timer.writes if not timer.servos]
    return found


def _frequency(sketch: MovedSketch, view: CodeView, call: ccode.Call, clocks: Mapping[str, int]) -> int:
    """The frequency of a pin on the source board, in Hz; that of most pins if the text does not say which it is."""
    source = sketch.move.source
    numbers = [value.number for value in view.values.of(call.arguments[0])] if call.arguments else []
    labels = {source.numbers.get(number, "") for number in numbers if number is not None}
    timers = {source.timers.get(label, "") for label in labels}
    found = {clocks.get(timer, clocks[_ANY]) for timer in timers}
    return round(sketch.clock_hz / (found.pop() if len(found) == 1 else clocks[_ANY]))


def _volts(sketch: MovedSketch) -> Iterator[PortabilityPlace]:
    """The expressions that make volts of a reading, with 5 V and the number of steps."""
    for view in sketch.views:
        for each in view.of_kind(ccode.Binary):
            if isinstance(each.eContainer(), (ccode.Binary, ccode.Cast)) or each.operator not in ("*", "/"):
                continue
            numbers = {value for inner in all_contents(each) if (value := _number(inner, view)) is not None}
            if _STEPS & numbers and _VOLTS & numbers:
                yield sketch.place("analog_volts", each, f"{sketch.facts.supply_volts} V")


def _number(element: object, view: CodeView) -> float | None:
    if isinstance(element, ccode.FloatingLiteral):
        return float(element.value)
    target = element.target if isinstance(element, ccode.NameReference) else None
    if isinstance(target, ccode.Variable) and isinstance(target.initializer, ccode.FloatingLiteral):
        return float(target.initializer.value)
    if isinstance(element, (ccode.IntegerLiteral, ccode.NameReference)):
        found = view.values.of(element)
        return found[0].number if len(found) == 1 else None
    return None
