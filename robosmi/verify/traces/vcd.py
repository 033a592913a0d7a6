"""Traces as a value change dump (VCD, IEEE 1364), which GTKWave and other viewers of waveforms open.

Each trace is a scope; each pin is a wire, an input of high impedance is `z`, a pull-up alone is a weak high and shown as 1. A
wave that a timer makes is two numbers beside the pin, its frequency in Hz and its duty; the console is its bytes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.verify.simulation import PinTrace

_LEVELS = {0: "0", 1: "1", "z": "z", "p": "1"}


def vcd_text(traces: Mapping[str, PinTrace], comment: str = "") -> str:
    """The text of a VCD file, in steps of a nanosecond.

    Args:
        traces: name of the scope -> the trace that is in it.
        comment: one line about where it comes from.
    """
    names = _identifiers()
    head, changes = ["$timescale 1ns $end"], []  # type: list[str], list[tuple[int, str]]
    if comment:
        head.insert(0, f"$comment {' '.join(comment.replace('$', ' ').split())} $end")
    last = 0
    for scope, trace in traces.items():
        head.append(f"$scope module {_name(scope)} $end")
        last = max(last, round(trace.simulated_us * 1000))
        for pin in dict.fromkeys(change.pin for change in trace.changes):
            wire = next(names)
            head.append(f"$var wire 1 {wire} {_name(pin)} $end")
            changes.append((0, f"z{wire}"))
            changes += [(round(at * 1000), f"{_LEVELS[level]}{wire}") for at, level in trace.levels(pin)]
        for pin in dict.fromkeys(wave.pin for wave in trace.waves):
            hz, duty = next(names), next(names)
            head += [f"$var real 64 {hz} {_name(pin)}_hz $end", f"$var real 64 {duty} {_name(pin)}_duty $end"]
            for wave in (w for w in trace.waves if w.pin == pin):
                changes += [
                    (round(wave.at_us * 1000), f"r{wave.hz:.10g} {hz}"),
                    (round(wave.at_us * 1000), f"r{wave.duty:.6g} {duty}"),
                ]
        if trace.console:
            byte = next(names)
            head.append(f"$var reg 8 {byte} console $end")
            changes += [(round(each.at_us * 1000), f"b{each.byte:b} {byte}") for each in trace.console]
        head.append("$upscope $end")
    changes.sort(key=lambda change: change[0])
    lines, now = [*head, "$enddefinitions $end"], -1
    for at, change in changes:
        if at != now:
            lines.append(f"#{at}")
            now = at
        lines.append(change)
    return "\n".join([*lines, f"#{max(last, now)}"]) + "\n"


def _identifiers() -> Iterator[str]:
    """Short names of printable characters, as the format wants them."""
    number = 0
    while True:
        name, rest = "", number
        while True:
            name += chr(33 + rest % 94)
            rest = rest // 94 - 1
            if rest < 0:
                break
        yield name
        number += 1


def _name(text: str) -> str:
    return re.sub(r"\W", "_", text) or "_"
