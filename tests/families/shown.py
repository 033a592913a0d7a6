"""Reads what a run of a whole program shows against what `expected.toml` says.

    library = "which source says so"
    console = ["lines that are printed; <10~1> is a number at most 1 off, a last line ... lets more follow"]
    [[pulses]]    pin; widths = [us, us ...] in their order, or each = us; from_ms, until_ms, count = [least, most], period_ms
    [[levels]]    pin; levels = [[level, ms], ...]: how long each is driven; [level] is for any time
    [[tones]]     pin; tones = [[Hz, ms], ...] in their order
    [[duties]]    pin; duties = [[Hz, part of the time that it is high, ms], ...] in their order; 0 Hz: no matter how often
    [[told]]      device; what, values: what a device noted, in its order; all = false lets more follow

Widths, times and frequencies may be 1 % off, or 8 us, 0.2 ms and 1 Hz; `within_us` and `within_ms` give others.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from robosmi.verify.simulation import PinTrace

_NUMBER = r"[-+]?\d+(?:\.\d+)?"
_ABOUT = re.compile(rf"<({_NUMBER})~({_NUMBER})>")
_NO_TONE_US = 3_000.0
"""Edges of a tone are less than this many microseconds apart."""


def faults(expected: Any, trace: PinTrace) -> list[str]:
    """The differences between a run and the expected behaviour; empty if there are none."""
    found = [*_console(expected["console"], trace.text)] if "console" in expected else []
    for kind, read in (("pulses", _pulses), ("levels", _levels), ("tones", _tones), ("duties", _duties), ("told", _told)):
        for each in expected.get(kind, ()):
            found += read(each, trace)
    return found


def _told(each: Any, trace: PinTrace) -> Iterator[str]:
    events = [event for event in trace.device_events if event.device == each["device"]]
    values, wanted = [event.value for event in events if event.what == each["what"]], each["values"]
    if values[: len(wanted)] != wanted or (each.get("all", True) and len(values) > len(wanted)):
        yield f"device {each['device']} is told {each['what']}: {values[:20]}, expected {wanted}"


def _console(lines: Sequence[str], text: str) -> Iterator[str]:
    """The differences between the console output and the expected lines."""
    found = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if found and not found[-1]:
        found.pop()
    more = bool(lines) and lines[-1] == "..."
    for number, line in enumerate(lines[:-1] if more else lines):
        if number >= len(found) or not _same(line, found[number]):
            yield f"line {number + 1} of the console is {found[number] if number < len(found) else None!r}, expected {line!r}"
            return
    if not more and len(found) > len(lines):
        yield f"the console says more: {found[len(lines) :][:3]}"


def _same(expected: str, found: str) -> bool:
    numbers = list(_ABOUT.finditer(expected))
    parts = re.split(_ABOUT.pattern, expected)[::3]
    matched = re.fullmatch(f"({_NUMBER})".join(map(re.escape, parts)), found)
    if matched is None:
        return False
    said = matched.groups()
    return all(abs(float(each) - float(about[1])) <= float(about[2]) for each, about in zip(said, numbers, strict=True))


def near(found: float, expected: float, least: float) -> bool:
    """Whether a time is as expected, within 1 % or within `least`, whichever is greater."""
    return abs(found - expected) <= max(0.01 * abs(expected), least)


def _pulses(each: Any, trace: PinTrace) -> Iterator[str]:
    begin, end = 1e3 * each.get("from_ms", 0), 1e3 * each.get("until_ms", 1e9)
    seen = [(at, width) for at, width in trace.pulses(each["pin"]) if begin <= at < end]
    widths = [width for _, width in seen]
    told = f"pulses on {each['pin']}: {[round(width) for width in widths[:12]]} ({len(widths)})"
    if "widths" in each and not (
        len(widths) == len(each["widths"])
        and all(near(one, two, each.get("within_us", 8)) for one, two in zip(widths, each["widths"], strict=True))
    ):
        yield f"{told}, expected {each['widths']}"
    if "each" in each and not (widths and all(near(width, each["each"], each.get("within_us", 8)) for width in widths)):
        yield f"{told}, expected {each['each']} each"
    if "count" in each and not each["count"][0] <= len(widths) <= each["count"][1]:
        yield f"{told}, expected {each['count']} of them"
    if "period_ms" in each:
        gaps = [late[0] - early[0] for early, late in pairwise(seen)]
        if not gaps or not all(near(gap, 1e3 * each["period_ms"], 30) for gap in gaps):
            yield f"{told}, {[round(gap) for gap in gaps[:6]]} us apart, expected {each['period_ms']} ms"


def _levels(each: Any, trace: PinTrace) -> Iterator[str]:
    begin = 1e3 * each.get("from_ms", 0)
    driven = [(at, level) for at, level in trace.levels(each["pin"]) if at >= begin and level in each.get("of", (0, 1))]
    joined = [one for number, one in enumerate(driven) if number == 0 or driven[number - 1][1] != one[1]]
    ends = [*(at for at, _ in joined), trace.simulated_us][1:]
    found = [(level, (end - at) / 1e3) for (at, level), end in zip(joined, ends, strict=True)]
    wanted = each["levels"]
    right = len(found) >= len(wanted) if each.get("more") else len(found) == len(wanted)
    for (level, lasts), want in zip(found, wanted, strict=False):
        right &= level == want[0] and (len(want) == 1 or near(lasts, want[1], each.get("within_ms", 0.2)))
    if not right:
        told = [(level, round(lasts, 2)) for level, lasts in found[:12]]
        yield f"{each['pin']} is driven {told} ({len(found)}), expected {wanted}"


def tones(trace: PinTrace, pin: str) -> list[tuple[float, float]]:
    """The tones at a pin, produced by software or by a timer, as (Hz, milliseconds)."""
    bursts: list[list[float]] = []
    for at, _ in trace.pulses(pin):
        last = bursts[-1] if bursts else []
        gap = at - last[-1] if last else 0.0
        if last and gap < _NO_TONE_US and (len(last) < 2 or 0.75 < gap / (last[1] - last[0]) < 1.33):
            last.append(at)
        else:
            bursts.append([at])
    found = [(each[0], (len(each) - 1) / (each[-1] - each[0]) * 1e6, len(each) / (len(each) - 1) * (each[-1] - each[0]) / 1e3)
             for each in bursts if len(each) > 2]  # fmt: skip
    waves = [wave for wave in trace.waves if wave.pin == pin]
    ends = [*(wave.at_us for wave in waves), trace.simulated_us][1:]
    found += [(wave.at_us, wave.hz, (end - wave.at_us) / 1e3) for wave, end in zip(waves, ends, strict=True) if wave.hz]
    return [(hz, lasts) for _, hz, lasts in sorted(found)]


def _tones(each: Any, trace: PinTrace) -> Iterator[str]:
    found = tones(trace, each["pin"])
    wanted = each["tones"]
    right = len(found) == len(wanted)
    for (hz, lasts), want in zip(found, wanted, strict=False):
        right &= near(hz, want[0], 1) and near(lasts, want[1], max(2e3 / want[0], 0.2))
    if not right:
        yield f"tones on {each['pin']}: {[(round(hz, 1), round(lasts, 2)) for hz, lasts in found[:12]]}, expected {wanted}"


def _duties(each: Any, trace: PinTrace) -> Iterator[str]:
    """The differences of duty cycles, measured in each stretch of time without its first and last cycle."""
    pin, wanted = each["pin"], each["duties"]
    driven = [(at, level) for at, level in trace.levels(pin) if level in (0, 1)]
    high = [at for at, level in driven if level == 1] + [wave.at_us for wave in trace.waves if wave.pin == pin and wave.hz]
    if not high:
        yield f"{pin} is never high, expected {wanted}"
        return
    begin, told, right = min(high), [], True
    for hz, part, lasts in wanted:
        first, last = begin + 3e3, begin + 1e3 * lasts - 3e3
        seen_hz, seen = _shown(trace, pin, first, last)
        told.append((round(seen_hz), round(seen, 3)))
        right &= abs(seen - part) <= 0.015 and (not hz or near(seen_hz, hz, 1))
        begin += 1e3 * lasts
    if not right:
        yield f"{pin} shows {told} (Hz, duty), expected {wanted}"


def _shown(trace: PinTrace, pin: str, begin: float, end: float) -> tuple[float, float]:
    """Frequency and duty cycle at a pin in a stretch of time, produced by software or by a timer."""
    waves = [wave for wave in trace.waves if wave.pin == pin and wave.at_us <= begin]
    if waves and waves[-1].hz:
        return waves[-1].hz, waves[-1].duty
    rises = [at for at, _ in trace.pulses(pin) if begin <= at < end]
    if len(rises) < 2:
        return 0.0, float(any(at < begin < at + width for at, width in trace.pulses(pin)))
    whole = [(at, width) for at, width in trace.pulses(pin) if rises[0] <= at < rises[-1]]
    return (len(rises) - 1) / (rises[-1] - rises[0]) * 1e6, sum(width for _, width in whole) / (rises[-1] - rises[0])
