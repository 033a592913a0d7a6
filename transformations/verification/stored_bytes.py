"""What a program stores in the memory that its board keeps without power (the EEPROM), as a channel of a comparison.

Each byte that changes is an event, in the order in which they change. The adapters write byte by byte and skip those that are
there already; the board of the source writes up to 128 bytes together. So only changes count, and each byte that follows
another one at once may come later by the time that the target's memory takes.

In one more scenario both programs begin with what the source has stored in an earlier run.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from msgspec.structs import replace

from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import LINE, ActivityEvent

EEPROM_CHANNEL = "what the program stores in the EEPROM"
"""Name of the channel."""
_BYTE_US = 3_500.0
"""The longest that an AVR takes for a byte, in microseconds, with a call of its function (data sheets: 3.4 ms)."""


def stored_events(trace: PinTrace) -> list[ActivityEvent]:
    """The changes of the memory in a trace."""
    found: list[ActivityEvent] = []
    done_us = 0.0
    for at_us, address, byte in trace.stored:
        done_us = max(at_us, done_us + _BYTE_US) if found else at_us
        place = address % trace.store_bytes if trace.store_bytes else address
        told = f"byte {byte} at address {place}"
        found.append(ActivityEvent(at_us, LINE, (told,), vague_us=done_us - at_us))
    return found


def after_a_restart(scenario: Scenario, source: PinTrace) -> Scenario:
    """The scenario with the bytes that the source has stored in it.

    Args:
        scenario: the scenario.
        source: the run of the original in it.
    """
    kept = {row[0] + number: byte for row in scenario.stored for number, byte in enumerate(row[1:])}
    kept |= {change.address: change.byte for change in source.stored}
    rows: list[list[int]] = []
    for before, address in pairwise([-2, *sorted(kept)]):
        if address != before + 1:
            rows.append([address])
        rows[-1].append(kept[address])
    name = f"{scenario.name}, started again with what it stores"
    return replace(scenario, name=name, stored=tuple(tuple(row) for row in rows))


def most_stored(traces: Sequence[PinTrace]) -> int | None:
    """The index of the trace in which most bytes change; None if none does in any."""
    busiest = max(range(len(traces)), key=lambda number: len(traces[number].stored), default=None)
    return busiest if busiest is not None and traces[busiest].stored else None
