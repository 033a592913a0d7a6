"""Boards that wait for a program, as a tool that uploads sees them: the protocols of three boot loaders behind a pseudo-terminal.

STK500 version 1 (Atmel AVR061), STK500 version 2 (AVR068) and AVR109, each as far as a tool asks that sends a program and
reads it back.
"""

from __future__ import annotations

import os
import pty
import select
import termios
import threading
import tty
from collections.abc import Iterator
from contextlib import contextmanager, suppress


class BootLoader:
    """One board.

    Attributes:
        port: path of the serial port.
        flash: what was written, address -> byte.
        speeds: the baud rates (constants of termios) that its port had, each once, in their order.
    """

    def __init__(self, signature: str, spoils: int | None = None) -> None:
        self.signature = bytes.fromhex(signature)
        self.flash: dict[int, int] = {}
        self.speeds: list[int] = []
        self.address = 0
        self.spoils = spoils
        self.master, slave = pty.openpty()
        tty.setraw(slave)
        self.port = os.ttyname(slave)
        self.slave = slave  # held open: a closed one would end the line
        self.over = threading.Event()
        self.thread = threading.Thread(target=self._serve, daemon=True)

    def _serve(self) -> None:
        with suppress(OSError, EOFError):
            while True:
                self.answer(self.take(1)[0])

    def take(self, count: int) -> bytes:
        """Read that many bytes from the line."""
        data = b""
        while len(data) < count:
            if self.over.is_set():
                raise EOFError
            speed = termios.tcgetattr(self.master)[4]
            if speed not in self.speeds:
                self.speeds.append(speed)
            if select.select([self.master], [], [], 0.02)[0]:
                data += os.read(self.master, count - len(data))
        return data

    def say(self, data: bytes) -> None:
        """Send an answer."""
        os.write(self.master, data)

    def write(self, data: bytes, step: int = 1) -> None:
        """Write bytes to the flash at the address, which advances by words of `step` bytes."""
        for offset, byte in enumerate(data):
            self.flash[self.address * step + offset] = byte ^ (
                self.spoils is not None and self.address * step + offset == self.spoils
            )
        self.address += len(data) // step

    def read(self, count: int, step: int = 1) -> bytes:
        """Read bytes at the address."""
        data = bytes(self.flash.get(self.address * step + offset, 0xFF) for offset in range(count))
        self.address += count // step
        return data

    def image(self) -> bytes:
        """The flash from 0 to the last byte that was written."""
        return bytes(self.flash.get(at, 0xFF) for at in range(max(self.flash, default=-1) + 1))

    def answer(self, command: int) -> None:
        """Execute a command."""
        raise NotImplementedError


class Stk500v1(BootLoader):
    """Optiboot and its like: the programmer `arduino`."""

    def answer(self, command: int) -> None:
        lengths = {0x41: 1, 0x42: 20, 0x45: 5, 0x55: 2, 0x56: 4, 0x64: 3, 0x74: 3}
        given = self.take(lengths.get(command, 0))
        if command == 0x64:
            data = self.take(int.from_bytes(given[:2], "big"))
        self.take(1)
        result = b""
        if command == 0x55:
            self.address = int.from_bytes(given, "little")
        elif command == 0x64:
            self.write(data, 2)
        elif command == 0x74:
            result = self.read(int.from_bytes(given[:2], "big"), 2)
        elif command == 0x75:
            result = self.signature
        elif command in (0x41, 0x56):
            result = b"\3"
        self.say(b"\x14" + result + b"\x10")


class Stk500v2(BootLoader):
    """The boot loader of the larger boards: the programmer `wiring`."""

    def answer(self, command: int) -> None:
        if command != 0x1B:
            return
        head = self.take(4)
        body = self.take(int.from_bytes(head[1:3], "big"))
        self.take(1)
        result = self.done(body)
        frame = bytes([0x1B, head[0], *len(result).to_bytes(2, "big"), 0x0E]) + result
        check = 0
        for byte in frame:
            check ^= byte
        self.say(frame + bytes([check]))

    def done(self, body: bytes) -> bytes:
        """Execute a message; returns the answer."""
        ok, count = bytes([body[0], 0]), int.from_bytes(body[1:3], "big")
        if body[0] == 0x01:
            return ok + b"\x08AVRISP_2"
        if body[0] == 0x06:
            self.address = int.from_bytes(body[1:5], "big") & 0x7FFFFFFF
        elif body[0] == 0x13:
            self.write(body[10 : 10 + count], 2)
        elif body[0] == 0x14:
            return ok + self.read(count, 2) + b"\0"
        elif body[0] == 0x1B:
            return ok + bytes([self.signature[body[4]], 0])
        elif body[0] == 0x1D:
            byte = self.signature[body[6]] if body[4] == 0x30 else 0
            return ok + bytes([0, 0, 0, byte])[-body[2] :] + b"\0"
        elif body[0] == 0x03:
            return ok + b"\x02"
        return ok


class Avr109(BootLoader):
    """The boot loader of boards with USB of their own: the programmer `avr109`."""

    def answer(self, command: int) -> None:
        letter = chr(command)
        if letter == "B":
            given = self.take(3)
            self.write(self.take(int.from_bytes(given[:2], "big")), 2)
            self.say(b"\r")
        elif letter == "g":
            self.say(self.read(int.from_bytes(self.take(3)[:2], "big"), 2))
        elif letter == "A":
            self.address = int.from_bytes(self.take(2), "big")
            self.say(b"\r")
        elif letter in "Txy":
            self.take(1)
            self.say(b"\r")
        else:
            plain = {"S": b"CATERIN", "V": b"10", "v": b"10", "p": b"S", "a": b"Y", "b": b"Y\0\x80", "t": b"\x44\0"}
            told = {**plain, "s": self.signature[::-1], **dict.fromkeys("PLEe", b"\r"), **dict.fromkeys("rFNQ", b"\0")}
            self.say(told.get(letter, b"?"))


PROTOCOLS = {"arduino": Stk500v1, "wiring": Stk500v2, "avr109": Avr109}
"""By the name that boards' data has."""


@contextmanager
def waiting(programmer: str, signature: str, spoils: int | None = None) -> Iterator[BootLoader]:
    """A board that waits for a program.

    Args:
        programmer: its protocol.
        signature: of its microcontroller, six hexadecimal digits.
        spoils: an address whose byte it stores wrongly.
    """
    board = PROTOCOLS[programmer](signature, spoils)
    board.thread.start()
    try:
        yield board
    finally:
        board.over.set()
        board.thread.join()
        os.close(board.master)
        os.close(board.slave)
