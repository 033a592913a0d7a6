"""Constraints on arguments: values that the target's adapter cannot handle.

The values that it can handle are data of the adapter (its `ranges`); the values of an argument are determined statically.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode, migration, platform
from robosmi.transformations.constraints.code_move import Move, move, moved, place, the_move
from robosmi.transformations.queries.plans.port_pins import CONSOLE
from robosmi.transformations.queries.resources.loop_time import clock_rates, of_rate
from robosmi.validate import Fail

calls = moved.context(ccode.Call, guard=lambda c: move() is not None and bool(_ranges(c)))


@calls.constraint(
    id="RS334", severity=Severity.warning, location=place,
    advice="pass another value, or write your own adapter that supports it",
)  # fmt: skip
def AdapterServesTheValue(c: ccode.Call) -> bool | Fail:
    """The value of an argument is one that the adapter can handle."""
    m, arguments = the_move(), list(c.arguments)
    for one in sorted(_ranges(c), key=lambda each: int(each.most) - int(each.least)):  # the limit that holds, not the widest one
        if one.position >= len(arguments) or (one.awayFrom and _reaches(c, one.awayFrom, m)) or _is_alone(c, one, m):
            continue
        outside = sorted(n for n in _numbers(arguments[one.position], one, m) if not _serves(one, n))
        if outside:
            said = ", ".join(str(each) for each in outside)
            return Fail(f"{c.calleeName} gets {said} for '{one.name}', {_said(one)}: {one.effect}", values=outside)
    return True


def _ranges(call: ccode.Call) -> list[platform.ArgumentRange]:
    """The value ranges of a call's adapter, without those that apply only beside adapters that the program does not use."""
    return the_move().argument_ranges.get(str(call.calleeName), [])


def _numbers(argument: ccode.Expression, one: platform.ArgumentRange, m: Move) -> set[int]:
    """The statically known values of an argument; it may have others, unless no constant is supported."""
    if _empty(one):
        known = {of_rate(argument, clock_rates(m.plan), m.masks.values)}
    else:
        known = {value.number for value in m.masks.values(argument)}
    return {number for number in known | (m.masks.numbers(argument) or frozenset()) if number is not None}


def _is_alone(call: ccode.Call, one: platform.ArgumentRange, m: Move) -> bool:
    """Whether a range applies only beside a further call of the same function, and there is none that it applies to."""
    if not one.beside:
        return False
    use = next(use for use in m.plan.adapterUses if use.name == call.calleeName and use.adapter is not None)
    if use.adapter is None or one.beside != f"{use.adapter.sourceHeader}/{use.adapter.name}":
        return False
    return all(other is call or (one.awayFrom and _reaches(other, one.awayFrom, m)) for other in use.calls)


def _serves(one: platform.ArgumentRange, number: int) -> bool:
    return bool(one.least <= number <= one.most or number in one.others)


def _empty(one: platform.ArgumentRange) -> bool:
    """Whether the adapter supports no constant."""
    return int(one.least) > int(one.most)


def _said(one: platform.ArgumentRange) -> str:
    """A value range in words."""
    if _empty(one):
        return "but the target supports no constant"
    if one.most == _MOST:
        return f"but the target supports {one.least:,} and more"
    return f"but the target supports {one.least:,} to {one.most:,}"


_MOST = (1 << 31) - 1


def _reaches(call: ccode.Call, pin: str, m: Move) -> bool:
    """Whether a port of a call is bound to the target pin with this name, or is the console, which needs no pin."""
    bound = list(_bindings(call, m))
    if any(b.choice == CONSOLE for b in bound):
        return True
    return any(pin in (b.pin.label, *b.pin.aliases) for b in bound if b.pin is not None)


def _bindings(call: ccode.Call, m: Move) -> Iterator[migration.PortBinding]:
    for flow in m.plan.portFlows:
        if call in flow.calls:
            yield from flow.bindings
