"""What a migrated program does besides its channels and the original never does: another baud rate, foreign pins, pull-ups.

None of these is an event of a channel. With another baud rate the person's terminal shows garbage; a pin that the program
should leave alone may switch something on, or be driven against another output. With a pull-up an open contact reads high that
floats on the source's board, and a level that a resistor sets is shifted.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from types import MappingProxyType

from robosmi.transformations.verification.bound_devices.port_devices import ANY_LEVEL, BoundPort
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.comparison import FirstDifference

_BYTE_BITS = 10
_FEWEST = 3
"""At least this many distances between bytes are needed to know how long one takes."""
_BAUD_PART = 0.3
"""Two baud rates whose relative difference is smaller count as the same: usual ones are further apart."""
_FASTEST_US = 100.0
"""The target's line is only called too fast if the source's bytes take less than this: slower ones may be computed."""
_LATE_US = 500_000.0
"""What begins within this time before the end, in microseconds, may come later in the source."""
_READ = "levels"
"""Kind of the device at ports that a program only reads; at others it triggers, charges or drives something."""
DRIVEN = (0, 1)
NO_LEVELS: Mapping[str, int] = MappingProxyType({})
_PULLED = "p"
_PASSING_US = 1_000.0
"""A pull-up that is on for less, in microseconds, belongs to a change to another state of the pin."""


def console_speed(source: PinTrace, target: PinTrace, channel: str) -> FirstDifference | None:
    """The difference of the console's baud rates; None if they are the same, or cannot be told.

    Args:
        source: the trace of the original.
        target: the trace of the migrated program.
        channel: the name of the console's channel.
    """
    sent = source.console
    distances = [sent[number + 1].at_us - sent[number].at_us for number in range(len(sent) - 1)]
    if len(distances) < _FEWEST or not target.console_baud or not target.console:
        return None
    byte_us = min(distances)
    theirs_us = _BYTE_BITS * 1e6 / target.console_baud
    if theirs_us <= (1 + _BAUD_PART) * byte_us and (byte_us >= _FASTEST_US or theirs_us >= (1 - _BAUD_PART) * byte_us):
        return None
    message = (
        f"it sends at {target.console_baud:.0f} baud, {theirs_us:.0f} us per byte; the original sends a byte in {byte_us:.0f} us"
    )
    return FirstDifference(0.0, channel, message, None, None)  # before the differences that follow from it


def foreign_pin(
    source: PinTrace, target: PinTrace, ports: Sequence[BoundPort], at_rest: Mapping[str, int]
) -> FirstDifference | None:
    """The first pin of the target that the program drives although the original never drives the pin that it stands for.

    Args:
        source: the trace of the original.
        target: the trace of the migrated program.
        ports: the ports.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels. At these
            levels they are not foreign.
    """
    driven = _driven(source)
    its_own = {port.target for port in ports if not _only_read(port) or port.source in driven}
    its_own |= {pin for port in ports for pin in (*port.split, *port.motor.values())}
    named = {port.target: port.title for port in ports}
    begins = sorted((at_us, pin) for pin, at_us in _driven(target, at_rest).items())
    for at_us, pin in begins:
        if pin not in its_own and at_us < target.simulated_us - _LATE_US:
            what = f"{pin} ({named[pin]})" if pin in named else pin
            why = "the original only reads it" if pin in named else "the program has no port there"
            return FirstDifference(at_us / 1000, what, f"the migrated program drives {pin}; {why}", None, None)
    return None


def pulled_up(source: PinTrace, target: PinTrace, ports: Sequence[BoundPort]) -> FirstDifference | None:
    """The first port at which the program leaves a pull-up on and the original lets the pin float; None if there is none.

    ... %source the trace of the original. %target the trace of the migrated program.
    """
    found = []
    for port in ports:
        if port.line or not port.target or port.device not in ("", _READ) or _pulled(source, port.source) is not None:
            continue
        if (since_us := _pulled(target, port.target)) is not None:
            message = f"the migrated program enables the pull-up of {port.target}; the original leaves {port.source} floating"
            found.append(FirstDifference(since_us / 1000, port.title, message, None, None))
    return min(found, key=lambda each: each.at_ms, default=None)


def _pulled(trace: PinTrace, pin: str) -> float | None:
    """Since when a pin's pull-up is on for longer than a change of its state takes, in microseconds; None if never."""
    levels = pairwise([*trace.levels(pin), (trace.simulated_us, "")])
    return next((at_us for (at_us, level), (end_us, _) in levels if level == _PULLED and end_us - at_us > _PASSING_US), None)


def _only_read(port: BoundPort) -> bool:
    """Whether the program only reads a port; if it drives it as an output, that is seen elsewhere."""
    return port.device == _READ and not port.line


def _driven(trace: PinTrace, at_rest: Mapping[str, int] = NO_LEVELS) -> dict[str, float]:
    """Each pin that is driven to another level than at rest, by edges or by a timer -> since when, in microseconds."""
    found: dict[str, float] = {}
    for change in trace.changes:
        if change.level in DRIVEN and at_rest.get(change.pin) not in (change.level, ANY_LEVEL):
            found.setdefault(change.pin, change.at_us)
    for wave in trace.waves:
        if wave.hz > 0 and at_rest.get(wave.pin) != ANY_LEVEL:
            found.setdefault(wave.pin, wave.at_us)
    return found
