"""Levels that are written to pins before these are outputs: an AVR keeps them, and switches the pull-up of an input by them.

Where `pinMode` starts a pin anew, such a level is lost: a relay that is off at HIGH goes on for a moment, and a button has no
pull-up. A level of an input becomes its mode, and one that is written before `pinMode(PIN, OUTPUT)` is written behind it again.

Calls are followed from `setup` and `loop` in the order of the text. Where registers may set the mode of pins nothing is changed.
"""

from __future__ import annotations

from collections.abc import Iterator

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace

_KIND = "input_level"
_RULE = "pin-level"
_ROOTS = ("setup", "loop")
_MODES = frozenset(["INPUT", "OUTPUT", "INPUT_PULLUP"])
_DRIVES = frozenset(["analogWrite", "tone", "shiftOut"])
"""Functions that make their pins outputs, or need them to be."""


class _Event(Struct, frozen=True):
    """A call about the mode or level of a pin.

    Attributes:
        view: its unit.
        call: the call.
        told: what the call sets: a mode, `HIGH`, `LOW`, or nothing where only the running program knows.
        pin: the text of the pin, and of local names the function.
        numbers: the numbers that it may be; None where only the running program knows.
    """

    view: CodeView
    call: ccode.Call
    told: str
    pin: tuple[str, int]
    numbers: frozenset[int] | None

    @property
    def writes(self) -> bool:
        return self.call.calleeName == "digitalWrite"

    @property
    def drives(self) -> bool:
        """Whether the pin may be an output from here on."""
        return not self.writes and self.told not in ("INPUT", "INPUT_PULLUP")

    def may_be(self, other: _Event) -> bool:
        """Whether both may be about one pin."""
        apart = self.numbers is not None and other.numbers is not None and not self.numbers & other.numbers
        return self.pin == other.pin or not apart

    def is_of(self, other: _Event) -> bool:
        """Whether both are about one pin for certain."""
        one = self.numbers is not None and len(self.numbers) == 1 and self.numbers == other.numbers
        return self.pin == other.pin or one


def pin_levels(sketch: MovedSketch) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of levels of inputs, and of `pinMode` behind a level; levels of inputs that only the running program knows."""
    if not sketch.facts.modes_clear_levels or _by_registers(sketch):
        return
    events = _events(sketch)
    taken = _given_elsewhere(sketch)
    for at, one in enumerate(events):
        before = events[:at]
        if one.writes:
            if any(each.drives and each.may_be(one) for each in before) and not _follows_input(one, before):
                continue
            driven = any(each.drives and each.may_be(one) for each in events)
            if driven and not _follows_input(one, before):
                continue  # the level of an output to be
            if not driven and (one.numbers is None or one.numbers & taken):
                continue  # a library may make an output of it
            if one.told == "HIGH" or (one.told == "LOW" and any(e.writes and e.is_of(one) and e.told == "HIGH" for e in before)):
                yield _as_mode(one)
            elif not one.told:
                yield sketch.place(_KIND, one.call, one.pin[0])
        elif one.told == "OUTPUT" and not any(each.drives and each.may_be(one) for each in before):
            level = next((each for each in reversed(before) if each.writes and each.is_of(one)), None)
            if level is not None and level.told == "HIGH":
                yield _with_level(one)


def _as_mode(write: _Event) -> SketchEdit:
    """The edit of a level of an input: the mode that means the same."""
    call, second = write.call, write.call.arguments[1]
    mode = "INPUT_PULLUP" if write.told == "HIGH" else "INPUT"
    start = int(call.startOffset)
    changes = (
        Replacement(start, start + len("digitalWrite"), "pinMode"),
        Replacement(int(second.startOffset), int(second.endOffset), mode),
    )
    return SketchEdit(call, _RULE, "the level of an input switches its pull-up on its own board", changes)


def _with_level(mode: _Event) -> SketchEdit:
    """The edit of a call that makes an output of a pin, which gets its level again."""
    call, first = mode.call, mode.call.arguments[0]
    start = int(call.startOffset)
    changes = (
        Replacement(start, start + len("pinMode"), "[](int pin) { pinMode(pin, OUTPUT); digitalWrite(pin, HIGH); }"),
        Replacement(int(first.endOffset), int(call.endOffset) - 1, ""),
    )
    return SketchEdit(call, _RULE, "an output begins with the level that was written before, on its own board", changes)


def _follows_input(write: _Event, before: list[_Event]) -> bool:
    """Whether the last call about a pin, in the same block, made an input of it."""
    last = before[-1] if before else None
    if last is None or last.writes or last.told != "INPUT" or not last.is_of(write):
        return False
    return last.call.eContainer().eContainer() is write.call.eContainer().eContainer()  # type: ignore[union-attr]


def _events(sketch: MovedSketch) -> list[_Event]:
    """The calls about modes and levels in the order in which the program reaches them, each once."""
    bodies = {
        id(function): function for view in sketch.views for function in view.of_kind(ccode.Function) if function.body is not None
    }
    view_of = {id(element): view for view in sketch.views for element in view.of_kind(ccode.Call)}
    found: list[_Event] = []
    seen = set[int]()

    def walk(function: ccode.Function) -> None:
        if id(function) in seen:
            return
        seen.add(id(function))
        for call in (each for each in all_contents(function) if isinstance(each, ccode.Call)):
            if call.callee is not None and id(call.callee) in bodies:
                walk(call.callee)
            elif id(call) in view_of and (event := _event(view_of[id(call)], call)) is not None:
                found.append(event)

    roots = [each for name in _ROOTS for each in bodies.values() if each.name == name]
    for function in [*roots, *bodies.values()]:
        walk(function)
    return found


def _event(view: CodeView, call: ccode.Call) -> _Event | None:
    name = str(call.calleeName)
    if name not in ("pinMode", "digitalWrite", *_DRIVES) or isinstance(call.calleeExpression, ccode.Member):
        return None
    if not call.arguments:
        return None
    given = call.arguments[0]
    numbers = {value.number for value in view.values.of(given)}
    known = frozenset(number for number in numbers if number is not None)
    told = ""
    if name in ("pinMode", "digitalWrite") and len(call.arguments) == 2 and not call.viaMacro:
        text = expression_text(call.arguments[1])
        levels = {"1": "HIGH", "true": "HIGH", "0": "LOW", "false": "LOW"} if name == "digitalWrite" else {}
        told = levels.get(text, text)
        told = told if told in (_MODES if name == "pinMode" else ("HIGH", "LOW")) else ""
    return _Event(view, call, told, _named(given), known if known and None not in numbers else None)


def _named(given: ccode.Expression) -> tuple[str, int]:
    """The text of a pin; with its function where it has local names, which mean something else in another one."""
    names = [each.target for each in (given, *all_contents(given)) if isinstance(each, ccode.NameReference)]
    local = any(
        isinstance(target, ccode.Parameter)
        or (isinstance(target, ccode.Variable) and not isinstance(target.eContainer(), ccode.SourceUnit))
        for target in names
    )
    holder = given.eContainer()
    while holder is not None and not isinstance(holder, (ccode.Function, ccode.Lambda)):
        holder = holder.eContainer()
    return expression_text(given), id(holder) if local else 0


def _given_elsewhere(sketch: MovedSketch) -> frozenset[int]:
    """The numbers that methods and constructors take, such as the pins of a library's objects."""
    found = set[int]()
    for view in sketch.views:
        taken = [made.arguments for made in view.of_kind(ccode.ConstructorCall)]
        taken += [call.arguments for call in view.of_kind(ccode.Call) if isinstance(call.calleeExpression, ccode.Member)]
        found.update(
            v.number for arguments in taken for given in arguments for v in view.values.of(given) if v.number is not None
        )
    return frozenset(found)


def _by_registers(sketch: MovedSketch) -> bool:
    """Whether the program sets modes of pins by registers."""
    return any(place.kind == "port_register" and place.name.startswith("DDR") for place in sketch.places)
