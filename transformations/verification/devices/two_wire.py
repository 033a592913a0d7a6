"""Devices on the two-wire bus (I2C): an EEPROM, and a sensor that consists of registers."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, ClassVar

from robosmi.base.data_text import Json
from robosmi.verify.bench import ADDRESSES, WRITTEN, Bench, Device


class _Memory(Device):
    """Memory cells with an address pointer: the first bytes written set it, the others are stored; reading advances it.

    Settings: `address` (7 bits); `content`: the bytes from cell 0 on.
    """

    pointer_bytes = 1
    cells: int

    def __init__(self, bench: Bench, number: int, pins: Mapping[str, str], settings: Mapping[str, Json]) -> None:
        super().__init__(bench, number, pins, settings)
        self.address = int(self.settings["address"])
        content = bytes(self.settings["content"])
        self.memory = bytearray(content + b"\xff" * (self.cells - len(content)))
        self.pointer = self._taken = self._written = 0

    def bus_start(self, read: bool) -> bool:
        """Acknowledge the address."""
        self._taken = 0 if not read else self.pointer_bytes
        self._written = 0
        return True

    def bus_write(self, byte: int) -> bool:
        """Receive the bytes of the pointer, highest first, then bytes to store."""
        if self._taken < self.pointer_bytes:
            self.pointer = ((self.pointer << 8 if self._taken else 0) | byte) % self.cells
            self._taken += 1
        else:
            self.note(WRITTEN, [self.pointer, byte])
            self.memory[self.pointer] = byte
            self.pointer = self._next()
            self._written += 1
        return True

    def restore(self, address: int, content: bytes) -> None:
        """Have bytes from an earlier run."""
        for number, byte in enumerate(content):
            self.memory[(address + number) % self.cells] = byte

    def _next(self) -> int:
        return (self.pointer + 1) % self.cells

    def bus_read(self) -> int:
        """The cell at the pointer, which then advances."""
        byte = self.memory[self.pointer]
        self.pointer = (self.pointer + 1) % self.cells
        return byte


class Eeprom(_Memory):
    """A serial EEPROM of 64 KB such as the 24LC512: two address bytes, pages of 128 bytes, busy while it writes.

    Further setting: `busy_ms`, for how long after a write it does not acknowledge.
    """

    pointer_bytes = 2
    cells = ADDRESSES
    page = 128
    setting_names: ClassVar[Mapping[str, Json]] = {"address": 0x50, "content": (), "busy_ms": 5.0}

    def start(self) -> None:
        """Start without a write in progress."""
        self._ready_us = 0.0

    def bus_start(self, read: bool) -> bool:
        """Acknowledge the address, unless a write is in progress."""
        return self.bench.now >= self._ready_us and super().bus_start(read)

    def _next(self) -> int:
        return self.pointer - self.page + 1 if self.pointer % self.page == self.page - 1 else self.pointer + 1

    def bus_stop(self) -> None:
        """Start the write cycle for the bytes received."""
        if self._written:
            self._ready_us = self.bench.now + self.settings["busy_ms"] * 1000
            self._written = 0


class StoredBytes(Device):
    """What the board's own memory keeps from an earlier run.

    Setting: `bytes`, address -> the bytes from there on.
    """

    setting_names: ClassVar[Mapping[str, Any]] = {"bytes": ...}

    def start(self) -> None:
        """Put them there."""
        for address, content in self.settings["bytes"].items():
            self.bench.store(int(address), bytes(content))


class Registers(_Memory):
    """A device of 256 registers of a byte each, such as a sensor.

    Settings: `content`, the bytes from register 0 on; `points`, [milliseconds, what it measures from then on]: bytes from
    register 0 on, or a number that gives each register a byte of its own. A byte written is noted as `written`, with its
    register.
    """

    cells = 256
    setting_names: ClassVar[Mapping[str, Any]] = {"address": ..., "content": (), "points": ()}

    def start(self) -> None:
        """Begin to measure."""
        for at_ms, measured in self.settings["points"]:
            self.bench.at(at_ms * 1000, partial(self._measure, measured))

    def _measure(self, measured: int | list[int]) -> None:
        bytes_of = measured if isinstance(measured, list) else [(37 * n + measured) & 0xFF for n in range(self.cells)]
        content = bytes(bytes_of)
        self.memory[: len(content)] = content
