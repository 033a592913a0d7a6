"""The other end of a serial line (8 data bits, no parity, 1 stop bit): at two pins, or one that answers on a single line."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import ClassVar

from robosmi.base.data_text import Json
from robosmi.verify.bench import Device, Level


class SerialLine(Device):
    """The other end. Settings: `baud`; `mode`, whose bit 0 inverts the line where it sends, and bit 1 the one where it listens;
    `points`: [milliseconds, what it sends]: a text, or a list of bytes.

    Pins, seen from the program: `receive`, where it listens, and `transmit`, where it sends. Each byte read is noted as
    `byte`; one whose stop bit is low as `framing`.
    """

    optional_pin_names = ("receive", "transmit")
    setting_names: ClassVar[Mapping[str, Json]] = {"baud": 9600, "mode": 0, "points": ()}

    def start(self) -> None:
        """Hold the line at its idle level (high unless inverted), and send each point at its time."""
        self._bit_us = 1e6 / self.settings["baud"]
        self._reading = False
        self._one_sent, self._one_read = (0 if self.settings["mode"] & bit else 1 for bit in (1, 2))
        if "receive" in self.pins:
            self.bench.set_level(self.pins["receive"], self._one_sent)
        for at_ms, text in self.settings["points"]:
            for number, byte in enumerate(text.encode() if isinstance(text, str) else text):
                self._send(at_ms * 1000 + number * 10 * self._bit_us, byte)

    def _send(self, at_us: float, byte: int) -> None:
        for number, level in enumerate((0, *(byte >> bit & 1 for bit in range(8)), 1)):
            shown = self._one_sent if level else 1 - self._one_sent
            self.bench.at(at_us + number * self._bit_us, partial(self.bench.set_level, self.pins["receive"], shown))

    def pin_changed(self, pin: str, level: Level) -> None:
        """Begin to read a byte at its start bit."""
        if pin == self.pins.get("transmit") and level == 1 - self._one_read and not self._reading:
            self._reading, self._byte = True, 0
            for number in range(9):
                self.bench.at(self.bench.now + (1.5 + number) * self._bit_us, partial(self._sample, number))

    def _sample(self, number: int) -> None:
        high = self.bench.driven[self.pins["transmit"]] != 1 - self._one_read
        if number < 8:
            self._byte |= high << number
        else:
            self._reading = False
            self.note("byte" if high else "framing", self._byte)


class AnsweringLine(Device):
    """A device that takes commands and answers them on one line, such as a motor controller of the DHB-10's kind.

    Settings: `baud`; `answers`: command -> the answers to it, one after the other, the last one repeated; `delay_ms`: from
    the end of a command to its answer. A command and an answer end with a carriage return, which is not written in either; a
    command that is not known gets no answer. Pin: `line`. Each command is noted as `command`, a byte whose stop bit is low as
    `framing`.
    """

    pin_names = ("line",)
    setting_names: ClassVar[Mapping[str, Json]] = {"baud": 19200, "answers": {}, "delay_ms": 2.0}

    def start(self) -> None:
        """Hold the line high, as the device's pull-up does: a program without a pull-up of its own may release it."""
        self._bit_us = 1e6 / self.settings["baud"]
        self.bench.set_level(self.pins["line"], 1)
        self._reading, self._command = False, bytearray()
        self._asked: dict[str, int] = {}

    def pin_changed(self, pin: str, level: Level) -> None:
        """Begin to read a byte at its start bit."""
        if level == 0 and not self._reading:
            self._reading, self._byte = True, 0
            for number in range(9):
                self.bench.at(self.bench.now + (1.5 + number) * self._bit_us, partial(self._sample, number))

    def _sample(self, number: int) -> None:
        high = self.bench.driven[self.pins["line"]] != 0
        if number < 8:
            self._byte |= high << number
            return
        self._reading = False
        if not high:
            self.note("framing", self._byte)
        elif self._byte != 13:
            self._command.append(self._byte)
        else:
            self._answer(self._command.decode("latin-1"))
            self._command.clear()

    def _answer(self, command: str) -> None:
        self.note("command", command)
        answers = self.settings["answers"].get(command)
        if not answers:
            return
        number = self._asked[command] = self._asked.get(command, -1) + 1
        at_us = self.bench.now + self.settings["delay_ms"] * 1000
        for byte in f"{answers[min(number, len(answers) - 1)]}\r".encode("latin-1"):
            for level in (0, *(byte >> bit & 1 for bit in range(8)), 1):
                self.bench.at(at_us, partial(self.bench.set_level, self.pins["line"], level))
                at_us += self._bit_us
