"""Timers of an AVR that drive pins by themselves: a servo at 50 Hz, a dimmed lamp, another frequency for analogWrite.

A timer is understood if one function sets its control registers to constants, or bits of them, in statements that always run, if
its compare registers are only assigned, and if it has no interrupts. What the core writes into the control registers before a
sketch begins counts, too. Source: ATmega328P data sheet DS40002061, sections 15.9, 16.11 and 18.11; wiring.c of ArduinoCore-avr.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import partial

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.avr_bits import PwmTimer, avr_bits
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.ports.bit_values import ONE, SAME, ZERO, assigned_bits
from robosmi.transformations.queries.ports.port_statements import MODE, PinStep, PortStatement, is_statement, register_of
from robosmi.transformations.queries.ports.register_values import register_value

PWM, PULSE, ATTACH = "pwm", "pulse", "attach"
STEPS = 255
"""The full scale of analogWrite."""
_DISCONNECTED, _HIGH_FIRST = 0, 2
_SERVO_PERIOD_US = range(18_000, 22_001)

_At = tuple[CodeView, ccode.Assignment]


class TimerOutputs(Struct, frozen=True):
    """A timer that drives pins.

    Attributes:
        timer: its name.
        clocks: clocks of its period.
        settings: the statements that set it up, each with its unit; the last one starts it.
        writes: the statements that change a duty or a pulse.
        servos: its servos: the name of the object that takes the place of a compare register, in the order of the text.
        attaches: the statement in whose place the servos are attached; None without servos.
        begun: the statements that give servos their first pulses beside the settings; the attached servos begin with these.
    """

    timer: str
    clocks: int
    settings: tuple[_At, ...]
    writes: tuple[PortStatement, ...]
    servos: tuple[str, ...] = ()
    attaches: PortStatement | None = None
    begun: tuple[_At, ...] = ()


def timer_outputs(views: Sequence[CodeView]) -> list[TimerOutputs]:
    """The timers of a program that drive pins and are understood."""
    board = views[0].api.board if views else None
    if board is None or not board.ports or not board.clock_hz:
        return []
    found = (_outputs(name, timer, views, board.ports, board.clock_hz) for name, timer in avr_bits().pwm.items())
    return [each for each in found if each is not None]


def _outputs(
    name: str, timer: PwmTimer, views: Sequence[CodeView], pins: Mapping[str, int], clock_hz: int
) -> TimerOutputs | None:
    roles = {register: role for role, register in timer.registers.items()}
    uses = [
        (v, r, str(r.name)) for v in views for r in v.of_kind(ccode.NameReference) if r.name in roles or r.name in timer.outputs
    ]
    assigned = [(view, outer, register) for view, r, register in uses if (outer := _assignment(r)) is not None]
    own = [(view, outer, register) for view, outer, register in assigned if outer.left.name == register]  # type: ignore[union-attr]
    if (
        not own
        or len(assigned) != len(uses)
        or any(str(function.name).startswith(timer.interrupts) for view in views for function in view.of_kind(ccode.Function))
    ):
        return None  # fmt: skip
    settings = [(view, outer, roles[register]) for view, outer, register in own if register in roles]
    state = _settings(settings, timer)
    top = None if state is None else _top(state, timer)
    if state is None or top is None or (name == "Timer0" and state["control_b"] & 0b111 != timer.begin[1] & 0b111):
        return None
    highest, passes = top
    divisor = timer.prescalers[state["control_b"] & 0b111]
    clocks = (highest + 1 if passes == 1 else 2 * highest) * divisor
    if not clocks:
        return None
    writes = [(view, outer, register) for view, outer, register in own if register in timer.outputs]
    connected = {register: state["control_a"] >> low & 0b11 for register, (_, low) in timer.outputs.items()}
    if any(mode not in (_DISCONNECTED, _HIGH_FIRST) for mode in connected.values()):
        return None
    if any(connected[register] == _DISCONNECTED or outer.operator != "=" for _, outer, register in writes):
        return None
    driven = [register for register, mode in connected.items() if mode == _HIGH_FIRST]
    if any(timer.outputs[register][0] not in pins for register in driven) or not (settings or writes):
        return None
    number = {register: pins[timer.outputs[register][0]] for register in driven}
    plain = tuple((view, outer) for view, outer, _ in settings)
    if driven and round(clocks * 1e6 / clock_hz) in _SERVO_PERIOD_US:
        scale = Fraction(divisor * passes * 1_000_000, clock_hz)
        servos = {register: f"servo{register.removeprefix('OCR')}" for register in driven}
        last_view, last = plain[-1]
        if any(view is not last_view for view, _, _ in (*settings, *writes)) or _changes_mode_later(last_view, last):
            return None
        beside = _beside([outer for _, outer in plain], [outer for _, outer, _ in writes])
        begun = [w for w in writes if id(w[1]) in beside]
        if any(register_value(w[1].right, w[0].values) is None for w in begun):
            return None
        first = {register: outer.right for _, outer, register in begun}
        steps = tuple(PinStep(0, number[register], ATTACH, first.get(register)) for register in driven)
        attaches = PortStatement(last_view, last, steps, timer.registers["control_b"], ",".join(servos.values()), scale)
        pulses = tuple(_write(w, PULSE, number, scale, servos[w[2]]) for w in writes if id(w[1]) not in beside)
        taken = tuple((view, outer) for view, outer, _ in begun)
        return TimerOutputs(name, clocks, plain, pulses, tuple(servos.values()), attaches, taken)
    scale = Fraction(STEPS, highest)
    return TimerOutputs(name, clocks, plain, tuple(_write(w, PWM, number, scale, "") for w in writes))


def _write(
    write: tuple[CodeView, ccode.Assignment, str], what: str, number: dict[str, int], scale: Fraction, handler: str
) -> PortStatement:
    view, outer, register = write
    return PortStatement(view, outer, (PinStep(0, number[register], what, outer.right),), register, handler, scale)


def _beside(settings: Sequence[ccode.Assignment], writes: Sequence[ccode.Assignment]) -> set[int]:
    """The identities of the writes among the settings, or right before or behind them: nothing runs between these."""
    last = settings[-1].eContainer()
    block = last.eContainer() if last is not None else None
    statements = list(block.statements) if isinstance(block, ccode.Block) else []
    of = {id(each.eContainer()): each for each in (*settings, *writes)}
    places = [number for number, each in enumerate(statements) if of.get(id(each)) in settings]
    if not places:
        return set()
    low, high = places[0], places[-1]
    while low and id(statements[low - 1]) in of:
        low -= 1
    while high + 1 < len(statements) and id(statements[high + 1]) in of:
        high += 1
    around = {id(of[id(each)]) for each in statements[low : high + 1] if id(each) in of}
    return around.intersection(map(id, writes))


def _changes_mode_later(view: CodeView, last: ccode.Assignment) -> bool:
    """Whether the function that starts a timer sets modes of pins behind it, which would disconnect a servo of the target."""
    function = ancestor_of_kind(last, ccode.Function)
    modes: list[ccode.Located] = [call for call in view.of_kind(ccode.Call) if call.calleeName == MODE]
    modes += [each for each in view.of_kind(ccode.NameReference) if register_of(each, view).startswith("DDR")]
    return any(
        int(each.startOffset) > int(last.startOffset) and ancestor_of_kind(each, ccode.Function) is function for each in modes
    )


def _assignment(reference: ccode.NameReference) -> ccode.Assignment | None:
    """The statement that assigns a register, or the value of which the register is a part; None for any other use."""
    outer = ancestor_of_kind(reference, ccode.Assignment)
    if outer is None or not is_statement(outer) or not isinstance(outer.left, ccode.NameReference):
        return None
    return outer if outer.left.name == reference.name else None


def _settings(settings: Sequence[tuple[CodeView, ccode.Assignment, str]], timer: PwmTimer) -> dict[str, int] | None:
    """What the registers of a timer have when all of its settings have run; None if nothing tells."""
    found = {"control_a": timer.begin[0], "control_b": timer.begin[1]}
    functions = set()
    for view, outer, role in settings:
        statement = outer.eContainer()
        block = statement.eContainer() if statement is not None else None
        if not isinstance(block, ccode.Block) or not isinstance(block.eContainer(), ccode.Function):
            return None
        functions.add(id(block))
        if role not in ("control_a", "control_b"):
            value = register_value(outer.right, view.values)
            if value is None or outer.operator != "=":
                return None
            found[role] = value
            continue
        bits = assigned_bits(outer, partial(_is_called, timer.registers[role]), view.values)
        if bits is None or any(bit.what not in (ONE, ZERO, SAME) for bit in bits):
            return None
        ones = sum(1 << n for n, bit in enumerate(bits) if bit.what == ONE)
        zeros = sum(1 << n for n, bit in enumerate(bits) if bit.what == ZERO)
        found[role] = (found[role] | ones) & ~zeros
    return found if len(functions) <= 1 else None


def _is_called(name: str, reference: ccode.NameReference) -> bool:
    return bool(reference.name == name)


def _top(state: dict[str, int], timer: PwmTimer) -> tuple[int, int] | None:
    """The highest number of the counter, and how often it passes it in a period."""
    mode = (state["control_a"] & 0b11) | (state["control_b"] >> 3 & timer.mode_mask) << 2
    found = timer.modes.get(mode)
    if found is None:
        return None
    top, passes = found
    return (top or state.get("top", 0), passes) if top or state.get("top", 0) > 1 else None
