"""The engine `simavr`: the library libsimavr (GPL-3, Debian's libsimavr2), reached through ctypes, in the worker's process only.

Nothing of it is shipped or linked. No layout of its structures is relied on, except for the head of `elf_firmware_t`, which
versions 1.4 to 1.8 have in common. The clock is read from a timer that never fires. `avr_run` runs one instruction, or a few
where that can be asked for: the C library's `lfind` calls it in a loop, which is eleven times faster than a loop in Python.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import re
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from msgspec.structs import replace

from robosmi import inputs
from robosmi.errors import MissingToolError, VerificationError
from robosmi.transformations.verification.engines.avr_steps import Steps
from robosmi.transformations.verification.engines.avr_timers import Timers
from robosmi.verify.bench import Bench
from robosmi.verify.simulation import ConsoleByte, Job, PinTrace

_SERVED = ("atmega328p", "atmega168", "atmega2560", "atmega32u4")
_STATES = {5: "done", 6: "done", 7: "crashed"}
_FAR = 1 << 62
_FILTERED = 2
"""Flag of an IRQ that is raised only with another value than before."""
_AT_ONCE = 20000
"""Instructions between two looks at the clock."""
_LONGEST = 5
"""Cycles of the longest instruction, an interrupt's call."""
_ALL_PINS, _DIRECTIONS, _PORT = 8, 9, 10
_EVERY_WRITE = 8
_PAINT = 0xA5
_EEPROM_CONTROL = 0x3F
"""The EEPROM's control register, which is there in all microcontrollers that are served."""
_EEPROM_WRITES = 0b110
"""The two bits that a program sets to write a byte; the lower one stays set until the byte is written."""
_EEPROM_DATA, _EEPROM_PLACE = 0x40, 0x41
"""Its data register, and the lower of the two with the address."""
_EEPROM_BUSY, _EEPROM_MODE = 0b10, 4
_EEPROM_WRITE_US = (3400.0, 1800.0, 1800.0, 3400.0)
"""Time of a write in microseconds, by the two mode bits: erase and write, erase, write, reserved (data sheets)."""
_UART_INPUT, _UART_OUTPUT = 0, 1
_UART_SLEEPS, _UART_ECHOES = 1, 2
_UART_STATUS = {"uar0": 0xC0, "uar1": 0xC8}
"""Address of each UART's status register, equal in all supported microcontrollers; the baud rate's is 4 bytes further."""
_UART_DOUBLED, _UART_RATE = 0b10, 4
_BUS_IN, _BUS_OUT = 0, 1
_START, _STOP, _ADDRESSED, _ACKNOWLEDGE, _WRITE, _READ = 1, 2, 4, 8, 16, 32
"""Bits of a message on the two-wire bus."""


@cache
def _code(text: str) -> int:
    """Four characters as simavr's number of a peripheral."""
    return int.from_bytes(text.encode(), "big")


class Simavr:
    """The engine (see `Engine`)."""

    name = "simavr"
    steps_cost = 10.0

    def missing(self) -> str | None:
        """What is not installed here; None if it can run."""
        return None if installed_library() is not None else "install libsimavr (Debian: apt-get install libsimavr2)"

    def version(self) -> str | None:
        """The version of the library's interface, all that it tells of itself; None if it is not installed."""
        return None if installed_library() is None else _version()

    def serves(self, mcu: str) -> bool:
        """Whether it knows the microcontroller."""
        return mcu in _SERVED

    def run(self, job: Job) -> PinTrace:
        """Run a program in this process."""
        library = installed_library()
        if library is None:
            raise MissingToolError("libsimavr is not installed", fix=self.missing())
        return _Run(library, job).run()


class _Run(Bench):
    """One program on one simulated microcontroller."""

    def __init__(self, library: ctypes.CDLL, job: Job) -> None:
        super().__init__(tuple(job.pins), job.clock_hz)
        self._library, self._job = library, job
        self._kept: list[Any] = []  # what C holds a pointer to
        self._failed: list[BaseException] = []
        self._console: list[ConsoleByte] = []
        self._outside: dict[str, tuple[int, int]] = {}  # port -> bits driven from outside, their levels
        self._irqs: dict[tuple[str, int], int | None] = {}
        library.avr_global_logger_set(ctypes.cast(SILENT, ctypes.c_void_p))
        self._avr = self._made()
        self._clock = TIMER(lambda avr, when, data: 0)  # never fires: it tells the time
        library.avr_cycle_timer_register(self._avr, _FAR, self._clock, None)
        self._waking = False
        self._ended_at: int | None = None
        self._called, self._instant = False, 0  # whether C calls now, and at which cycle if that was asked, else 0
        self._alarm = TIMER(self._woken)
        self._fast_external_interrupts()
        self._painted(job.stack_room)
        self._watch_ports()
        self._watch_console()
        self._watch_bus()
        self.timers = Timers(job.timers, job.pins, job.clock_hz, self.wave_changed)
        for address in self.timers.registers:
            self._watch_register(address)
        self._writing_until = 0.0
        self.store_bytes = job.store_bytes
        self._notify(library.avr_iomem_getirq(self._avr, _EEPROM_CONTROL, None, _EVERY_WRITE), self._eeprom_told)

    def _made(self) -> int:
        job, library = self._job, self._library
        firmware = Firmware()
        if library.elf_read_firmware(job.elf.encode("utf-8", "surrogateescape"), ctypes.byref(firmware)):
            raise VerificationError(f"simavr cannot read '{job.elf}'", fix="compile the program again")
        firmware.frequency, firmware.vcc, firmware.avcc, firmware.aref = job.clock_hz, *([job.supply_mv] * 3)
        avr: int | None = library.avr_make_mcu_by_name(job.mcu.encode())
        if not avr:
            raise VerificationError(f"this simavr does not know the microcontroller '{job.mcu}'", fix="try another engine")
        library.avr_init(avr)
        library.avr_load_firmware(avr, ctypes.byref(firmware))
        for address, data in self._flash():  # of an ELF file simavr loads no other sections than .text and .data
            library.avr_loadcode(avr, data, len(data), address)
        return avr

    def _flash(self) -> list[tuple[int, bytes]]:
        """The runs of bytes that are written to the flash of a board, with their addresses."""
        try:
            return runs_of_hex(inputs.read_text(self._job.hex, inputs.OUTPUT, "ascii"))
        except (OSError, ValueError) as error:
            raise VerificationError(f"'{self._job.hex}' cannot be read: {error}", fix="compile the program again") from error

    # ---- the stack

    def _painted(self, room: Sequence[int] | None) -> None:
        """Fill the memory for heap and stack with a pattern that programs hardly ever write."""
        for address in range(room[0], room[1] + 1) if room is not None else ():
            self._library.avr_core_watch_write(self._avr, address, _PAINT)

    def _stack_bytes(self) -> int | None:
        """Greatest depth of the stack in bytes: down to the end of the longest stretch in which the pattern is still intact."""
        if self._job.stack_room is None:
            return None
        first, last = self._job.stack_room
        behind = start = first
        length = 0
        for address in range(first, last + 2):
            if address <= last and self._library.avr_core_watch_read(self._avr, address) == _PAINT:
                continue
            if address - start > length:
                length, behind = address - start, address
            start = address + 1
        return last + 1 - behind

    # ---- callbacks from C, in which exceptions would be lost

    def _notify(self, irq: int | None, call: Callable[[int], None]) -> None:
        """Call with the value whenever an IRQ is raised."""
        if not irq:
            return

        def notified(irq: int, value: int, data: Any) -> None:
            outermost, self._called = not self._called, True
            try:
                call(value)
            except BaseException as error:
                self._failed.append(error)
            finally:
                if outermost:
                    self._called, self._instant = False, 0

        function = NOTIFY(notified)
        self._kept.append(function)
        self._library.avr_irq_register_notify(irq, function, None)

    def _notify_of_changes(self, irq: int | None, call: Callable[[int], None]) -> None:
        """Call with the value whenever an IRQ is raised with another one; in an old library, whenever it is raised.

        `digitalWrite` writes a timer's register each time, nearly always with what is there.
        """
        setter = getattr(self._library, "avr_irq_set_flags", None)
        if irq and setter is not None:
            setter(ctypes.c_void_p(irq), ctypes.c_uint8(self._library.avr_irq_get_flags(ctypes.c_void_p(irq)) & 0xFF | _FILTERED))
        self._notify(irq, call)

    def _woken(self, avr: int, when: int, data: Any) -> int:
        """The timer's callback, which wakes the devices; returns the cycle of the next time, or 0 for never."""
        self._waking = self._called = True
        try:
            return self.wake() or 0
        except BaseException as error:
            self._failed.append(error)
            return 0
        finally:
            self._waking = self._called = False
            self._instant = 0

    # ---- time

    @property
    def cycle(self) -> int:
        """The cycles since reset."""
        if self._instant:
            return self._instant
        if self._ended_at is not None:
            return self._ended_at
        now = _FAR + 1 - int(self._library.avr_cycle_timer_status(self._avr, self._clock, None))
        if self._called:
            self._instant = now  # no time passes while C waits
        return now

    def wake_at(self, cycle: int) -> None:
        """Have `wake` called at that cycle. One timer does for all actions: the library has room for 64, and drops the others."""
        if not self._waking:  # else the alarm's answer says when to wake next
            self._library.avr_cycle_timer_register(self._avr, max(1, cycle - self.cycle), self._alarm, None)

    # ---- pins

    def _irq(self, peripheral: str, number: int) -> int | None:
        key = peripheral, number
        if key not in self._irqs:
            self._irqs[key] = self._library.avr_io_getirq(self._avr, _code(peripheral), number)
        return self._irqs[key]

    def _fast_external_interrupts(self) -> None:
        """Let a low level at an external interrupt's pin be no reason to look again at every few cycles (five times slower)."""
        setter = getattr(self._library, "avr_extint_set_strict_lvl_trig", None)
        for number in (0, 1):
            if setter is None:
                return
            setter(ctypes.c_void_p(self._avr), ctypes.c_uint8(number), ctypes.c_uint8(0))

    def _watch_ports(self) -> None:
        ports: dict[str, dict[int, str]] = {}
        for label, place in self._job.pins.items():
            ports.setdefault(place[0], {})[int(place[1:])] = label
        for port, labels in ports.items():
            state = {_PORT: 0, _DIRECTIONS: 0}
            for which in (_PORT, _DIRECTIONS):
                self._notify(self._irq(f"iog{port}", which), self._port_listener(labels, state, which))

    def _port_listener(self, labels: dict[int, str], state: dict[int, int], which: int) -> Callable[[int], None]:
        places = {1 << bit: label for bit, label in labels.items()}

        def written(value: int) -> None:
            changed = state[which] ^ value
            state[which] = value
            while changed:
                bit = changed & -changed
                changed ^= bit
                if (label := places.get(bit)) is not None:
                    high = 1 if state[_PORT] & bit else 0
                    self.pin_changed(label, high if state[_DIRECTIONS] & bit else "p" if high else "z")

        return written

    def set_level(self, pin: str, level: int | None) -> None:
        """Drive a pin from outside, low or high; None lets go of it."""
        port, bit = self._job.pins[pin][0], int(self._job.pins[pin][1:])
        before = mask, values = self._outside.get(port, (0, 0))
        mask = mask & ~(1 << bit) if level is None else mask | 1 << bit
        values = values | 1 << bit if level else values & ~(1 << bit)
        if (mask, values) != before:
            self._outside[port] = mask, values
            # struct avr_ioport_external_t: bit fields name (7), mask (8), value (8) of one unsigned long
            told = ctypes.c_ulong(ord(port) & 0x7F | mask << 7 | values << 15)
            self._library.avr_ioctl(self._avr, _code(f"iop{port}"), ctypes.byref(told))
        if level is None and self.driven[pin] == "p":
            level = 1  # the pull-up
        if level is not None and self.driven[pin] in ("z", "p"):
            self._library.avr_raise_irq(self._irq(f"iog{port}", bit), level)

    def set_voltage(self, pin: str, millivolts: float) -> None:
        """Put a voltage on a pin of the converter."""
        self._library.avr_raise_irq(self._irq("adc ", self._job.analog[pin]), round(millivolts))

    # ---- console

    def _watch_console(self) -> None:
        for code in ("uar0", "uar1"):  # an ATmega32U4 has only the second
            irq = self._irq(code, _UART_OUTPUT)
            if irq:
                break
        else:
            return
        self._console_input = self._irq(code, _UART_INPUT)
        flags = ctypes.c_uint32(0)
        self._library.avr_ioctl(self._avr, _code(f"uag{code[-1]}"), ctypes.byref(flags))
        flags.value &= ~(_UART_ECHOES | _UART_SLEEPS)
        self._library.avr_ioctl(self._avr, _code(f"uas{code[-1]}"), ctypes.byref(flags))
        self._status = _UART_STATUS[code]
        self._notify(irq, lambda value: self._console.append(ConsoleByte(self.now, value & 0xFF)))

    def _console_baud(self) -> float:
        """The bits a second to which the console's line is set; 0 where nothing was sent."""
        if not self._console:
            return 0.0
        status, low, high = (
            int(self._library.avr_core_watch_read(self._avr, self._status + at)) for at in (0, _UART_RATE, _UART_RATE + 1)
        )
        return self._job.clock_hz / ((8 if status & _UART_DOUBLED else 16) * ((high & 0x0F) * 256 + low + 1))

    def send(self, data: bytes) -> None:
        """Let bytes arrive on the program's console."""
        for byte in data:
            self._library.avr_raise_irq(self._console_input, byte)

    # ---- two-wire bus

    def _watch_bus(self) -> None:
        self._bus_in = self._irq("twi\0", _BUS_IN)
        self._address, self._reading = -1, False
        self._notify(self._irq("twi\0", _BUS_OUT), self._bus_message)

    def _bus_message(self, value: int) -> None:
        """Answer a message of the program:

        one byte of bits, one with address and direction, one of data, each eight bits wide.
        """
        message, address, data = value >> 8 & 0xFF, value >> 16 & 0xFF, value >> 24 & 0xFF
        if message & _STOP:
            if self._address >= 0:
                self.bus_stop(self._address)
            self._address = -1
        if message & _START:
            self._address, self._reading = address >> 1, bool(address & 1)
            if self.bus_start(self._address, self._reading):
                self._reply(_ACKNOWLEDGE, address, 1)
            else:
                self._address = -1
        if self._address < 0:
            return
        if message & _WRITE and self.bus_write(self._address, data):
            self._reply(_ACKNOWLEDGE, address, 1)
        if message & _READ:
            self._reply(_READ, address, self.bus_read(self._address))

    def _reply(self, message: int, address: int, data: int) -> None:
        self._library.avr_raise_irq(self._bus_in, self._library.avr_twi_irq_msg(message, address, data))

    # ---- timers

    def _watch_register(self, address: int) -> None:
        irq = self._library.avr_iomem_getirq(self._avr, address, None, _EVERY_WRITE)
        self._notify_of_changes(irq, lambda value: self.timers.written(self.now, address, value & 0xFF))

    # ---- the microcontroller's own EEPROM, in which simavr writes at once

    def _eeprom_told(self, value: int) -> None:
        """Stay busy for as long as writing a byte takes."""
        if value & _EEPROM_WRITES == _EEPROM_WRITES and self.now >= self._writing_until:
            self._writing_until = self.now + _EEPROM_WRITE_US[value >> _EEPROM_MODE & 3]
            if self.store_bytes:
                byte, low, high = (self._register(each) for each in (_EEPROM_DATA, _EEPROM_PLACE, _EEPROM_PLACE + 1))
                self.byte_stored(self.now, high << 8 | low, byte)
            self.at(self._writing_until, lambda: self._eeprom_busy(0))
        if self.now < self._writing_until:
            self._eeprom_busy(_EEPROM_BUSY)

    def store(self, address: int, content: bytes) -> None:
        """Put bytes into the microcontroller's own EEPROM."""
        super().store(address, content)
        for number, byte in enumerate(content):
            at, there = (address + number) % self.store_bytes, ctypes.create_string_buffer(1)
            for code, buffer in (("eesp", ctypes.create_string_buffer(bytes([byte]), 1)), ("eegp", there)):
                asked = _StoredBytes(ctypes.cast(buffer, ctypes.c_void_p), at, 1)
                self._library.avr_ioctl(self._avr, _code(code), ctypes.byref(asked))  # answers -1 even if it has done it
            if there.raw != bytes([byte]):
                raise VerificationError("this simavr does not let its EEPROM be filled", fix="try another engine")

    def _register(self, address: int) -> int:
        found: int = self._library.avr_core_watch_read(self._avr, address)
        return found

    def _eeprom_busy(self, busy: int) -> None:
        now = self._register(_EEPROM_CONTROL)
        self._library.avr_core_watch_write(self._avr, _EEPROM_CONTROL, now & ~_EEPROM_BUSY | busy)

    # ---- the run

    def run(self) -> PinTrace:
        """Run until the horizon."""
        self.connect(self._job.devices, self._job.brief)
        end = round(self._job.horizon_us * self._job.clock_hz / 1e6)
        run = ctypes.cast(self._library.avr_run, ctypes.c_void_p)
        steps = Steps(self._library, self._avr, self._flash(), frozenset(_STATES)) if self._job.reached else None
        c_library = ctypes.CDLL(None)
        c_library.lfind.restype = ctypes.c_void_p
        c_library.lfind.argtypes = [ctypes.c_void_p] * 3 + [ctypes.c_size_t, ctypes.c_void_p]
        longest = (run_in_a_row(self._library, self._avr, lambda: self.cycle) if steps is None else 0) + _LONGEST
        count, base = ctypes.c_size_t(), ctypes.c_char_p(b"\0")
        state = "running"
        while steps is not None and (left := end - self.cycle) > 0 and state == "running":
            state = _STATES.get(steps.run(max(1, min(_AT_ONCE, left // _LONGEST))), "running")
            if self._failed:
                raise self._failed[0]
        while (left := end - self.cycle) > 0 and state == "running":
            count.value = max(1, min(_AT_ONCE, left // longest))
            if c_library.lfind(self._avr, base, ctypes.byref(count), 0, run):
                state = "done"  # avr_run answered 0: the processor left its loop
            else:
                state = _STATES.get(self._library.avr_run(self._avr), "running")
            if self._failed:
                raise self._failed[0]
        self._ended_at = min(self.cycle, end)
        self.ended()
        trace = self.trace(f"simavr ({_version()})", state, self._job.horizon_us, self.timers.waves, self._console)
        trace = replace(trace, stack_bytes=self._stack_bytes(), console_baud=self._console_baud())
        return steps.noted_in(trace) if steps is not None else trace


def _version() -> str:
    """The version of the library's interface as its file name has it, or `unknown`."""
    found = re.search(r"so\.([\d.]+)$", ctypes.util.find_library("simavr") or "")
    return f"libsimavr.so.{found[1]}" if found else "unknown"


# ---- the library

_IN_A_ROW = 64
"""Cycles that the library may run before it checks its timers, earlier if one is due: a third faster."""
_LOOKS = 16
_HEAD_WORDS = 64
"""Number of 8-byte words of the library's `avr_t` that are searched; it has more than 16 kB."""

NOTIFY = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_uint32, ctypes.c_void_p)
TIMER = ctypes.CFUNCTYPE(ctypes.c_uint64, ctypes.c_void_p, ctypes.c_uint64, ctypes.c_void_p)
LOGGER = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p)


def runs_of_hex(text: str) -> list[tuple[int, bytes]]:
    """The bytes of a text in Intel HEX (Intel 1988), adjacent records joined, with their addresses.

    Raises:
        ValueError: it is none.
    """
    found: list[tuple[int, bytes]] = []
    base = 0
    for line in text.split():
        record = bytes.fromhex(line[1:])
        if line[:1] != ":" or len(record) != record[0] + 5 or sum(record) & 0xFF:
            raise ValueError(f"'{line}' is no record of Intel HEX")
        address, kind, data = int.from_bytes(record[1:3], "big"), record[3], record[4:-1]
        if kind in (2, 4):
            base = int.from_bytes(data, "big") << (4 if kind == 2 else 16)
        elif kind == 0:
            last = found[-1] if found else None
            if last is not None and last[0] + len(last[1]) == base + address:
                found[-1] = (last[0], last[1] + data)
            else:
                found.append((base + address, data))
    return found


class Firmware(ctypes.Structure):
    """The head of `elf_firmware_t`; the last field is room for the rest of it."""

    _fields_ = (
        ("mmcu", ctypes.c_char * 64), ("frequency", ctypes.c_uint32), ("vcc", ctypes.c_uint32), ("avcc", ctypes.c_uint32),
        ("aref", ctypes.c_uint32), ("rest", ctypes.c_char * 16384),
    )  # fmt: skip


class _StoredBytes(ctypes.Structure):
    """`avr_eeprom_desc_t`: bytes, where they lie in the EEPROM, and how many they are."""

    _fields_ = (("content", ctypes.c_void_p), ("offset", ctypes.c_uint16), ("size", ctypes.c_uint32))


@cache
def installed_library() -> ctypes.CDLL | None:
    """The library with its functions declared, or None where it is not installed."""
    for name in ("libsimavr.so.2", ctypes.util.find_library("simavr"), "libsimavr.so"):
        try:
            library = ctypes.CDLL(name) if name else None
        except OSError:
            continue
        if library is not None:
            return _declared(library)
    return None


def _declared(library: ctypes.CDLL) -> ctypes.CDLL:
    pointer, number, wide = ctypes.c_void_p, ctypes.c_uint32, ctypes.c_uint64
    for name, result, arguments in (
        ("avr_make_mcu_by_name", pointer, [ctypes.c_char_p]),
        ("avr_init", ctypes.c_int, [pointer]),
        ("elf_read_firmware", ctypes.c_int, [ctypes.c_char_p, pointer]),
        ("avr_load_firmware", None, [pointer, pointer]),
        ("avr_loadcode", None, [pointer, ctypes.c_char_p, number, number]),
        ("avr_run", ctypes.c_int, [pointer]),
        ("avr_terminate", None, [pointer]),
        ("avr_io_getirq", pointer, [pointer, number, ctypes.c_int]),
        ("avr_iomem_getirq", pointer, [pointer, ctypes.c_uint16, ctypes.c_char_p, ctypes.c_int]),
        ("avr_irq_register_notify", None, [pointer, NOTIFY, pointer]),
        ("avr_raise_irq", None, [pointer, number]),
        ("avr_ioctl", ctypes.c_int, [pointer, number, pointer]),
        ("avr_cycle_timer_register", None, [pointer, wide, TIMER, pointer]),
        ("avr_cycle_timer_status", wide, [pointer, TIMER, pointer]),
        ("avr_global_logger_set", None, [pointer]),
        ("avr_core_watch_write", None, [pointer, ctypes.c_uint16, ctypes.c_uint8]),
        ("avr_core_watch_read", ctypes.c_uint8, [pointer, ctypes.c_uint16]),
        ("avr_twi_irq_msg", number, [ctypes.c_uint8, ctypes.c_uint8, ctypes.c_uint8]),
    ):
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library


SILENT = LOGGER(lambda avr, level, text: None)  # kept for ever: the library keeps the pointer


def run_in_a_row(found_library: ctypes.CDLL, avr: int, cycle: Callable[[], int]) -> int:
    """Let the library run several instructions per call; returns how many cycles these may take.

    The field of `avr_t` that limits the cycles (run_cycle_limit) follows those of the remaining cycles (run_cycle_count) and of
    the clock (cycle). Versions have them at different offsets: they are searched while the first instructions run, and nothing
    is changed unless exactly one place fits.

    Args:
        found_library: the library.
        avr: the microcontroller, whose program may have started.
        cycle: returns its clock.
    """
    head = (ctypes.c_uint64 * _HEAD_WORDS).from_address(avr)
    found = set(range(_HEAD_WORDS - 2))
    for _ in range(_LOOKS):
        found_library.avr_run(avr)
        now = cycle()
        found = {at for at in found if head[at] == now and head[at + 1] <= 1 and head[at + 2] == 1}
    if len(found) != 1:
        return 1
    head[found.pop() + 2] = _IN_A_ROW
    return _IN_A_ROW
