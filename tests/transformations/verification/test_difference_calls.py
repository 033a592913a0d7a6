"""Which call of the source is told beside a difference: one for that channel, or none."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.judgement.evidence import last_call_for
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.verify.original import LibraryCall

CALLS = [
    LibraryCall(100.0, "ee_putInt", "a.c", 3),
    LibraryCall(900_000.0, "high", "a.c", 5),
    LibraryCall(950_000.0, "print", "a.c", 6, prints=True),
    LibraryCall(1_500_000.0, "high", "a.c", 8),
    LibraryCall(1_600_000.0, "drive_speed", "a.c", 9),
    LibraryCall(1_700_000.0, "high", "src/a.c", 10),
]
PORTS = [
    BoundPort("P9", "P9", "D7", functions=("high", "low"), called_at=frozenset({("a.c", 5), ("a.c", 8)})),
    BoundPort("P8", "P8", "D8", functions=("high", "low"), called_at=frozenset({("a.c", 10), ("a.c", 12)})),
    BoundPort("P4", "P4", "D4", functions=("freqout",)),
    BoundPort("abdrive.left_servo", "P12", "D5", functions=("drive_speed",)),
]


@pytest.mark.parametrize(
    ("channel", "at_us", "line"),
    [
        ("P9", 1_000_000.0, 5),
        ("P9", 2_000_000.0, 8),
        ("P8", 2_000_000.0, 10),
        ("P9", 500.0, 5),  # it comes too early: the call that would make it is later
        ("P9, as it is driven", 1_000_000.0, 5),
        ("console", 1_000_000.0, 6),
        ("abdrive.left_servo motion", 2_000_000.0, 9),
        ("P4", 2_000_000.0, None),
        ("I2C 0x69", 2_000_000.0, None),
        ("program", 2_000_000.0, None),
        (EEPROM_CHANNEL, 2_000_000.0, 3),
    ],
)
def test_a_call_for_the_channel_or_none_is_told(channel: str, at_us: float, line: int | None) -> None:
    found = last_call_for(channel, CALLS, PORTS, at_us, {"ee_putInt"})
    assert (found.line if found else None) == line
