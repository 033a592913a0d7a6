"""The bench on which a program runs: pins, a clock, a console, a two-wire bus, and the devices connected to them.

An engine makes a `Bench` over its simulator: it tells the bench what the program does at the pins, and does what the bench asks.
A `Device` reads and drives pins through the bench only, so that one description of it serves every engine. Times are
microseconds from reset. Which devices there are is content (registered as `device`).
"""

from __future__ import annotations

import heapq
import itertools
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from operator import itemgetter
from typing import Any, ClassVar, TypeVar

from robosmi.errors import UsageError, VerificationError
from robosmi.plugin_contracts import wrong_result
from robosmi.plugins import content, registry
from robosmi.verify.simulation import ConsoleByte, DeviceEvent, DeviceUse, PinChange, PinTrace, StoredByte, Wave

Event = TypeVar("Event", PinChange, Wave, ConsoleByte, DeviceEvent, StoredByte)

Level = int | str
"""How the program drives a pin: 0, 1, `z` (an input) or `p` (an input with its pull-up on)."""
AIMS = FOR_A_TIME, BY_A_WAY, TO_A_PLACE = ("time", "way", "place")
"""How a program drives a device that moves: until it says otherwise, so far from its last goal, or to a fixed place."""
ADDRESSES = 1 << 16
"""Bytes of the largest memory that a board keeps without power."""
WRITTEN = "written"
"""What a memory notes for each byte that it takes: its address and the byte."""
_ERASED = 0xFF
MOST_CHANGES = 2_000_000
"""Limit on the pin changes of a run; each takes about 130 bytes, and as many again while it is transferred."""


class Bench(ABC):
    """What devices see of a simulated board.

    Args:
        pins: the labels of the board's pins.
        clock_hz: the clock of the microcontroller: actions happen at its cycles.

    Attributes:
        driven: label -> how the program drives that pin now; kept by every engine only for pins that a device heeds.
        brief: the pins of which only the first change to each level is recorded.
        changes: how it drove the pins, by time.
        events: what devices noticed, by time.
        store_bytes: the size of the memory that the board keeps without power; 0 if it has none or the engine does not show it.
        stored: how the program changed that memory, by time.
    """

    store_bytes = 0

    def __init__(self, pins: Sequence[str], clock_hz: int) -> None:
        self.clock_hz = clock_hz
        self.driven: dict[str, Level] = dict.fromkeys(pins, "z")
        self.changes: list[PinChange] = []
        self.events: list[DeviceEvent] = []
        self.stored: list[StoredByte] = []
        self._store: dict[int, int] = {}  # address -> byte; others are erased
        self.brief: frozenset[str] = frozenset()
        self._recorded: set[tuple[str, Level]] = set()  # what was recorded of brief pins
        self._contacts: dict[str, str] = {}
        self._devices: list[Device] = []
        self._at_pin: dict[str, list[Device]] = {}
        self._on_bus: dict[int, Device] = {}
        self._actions: list[tuple[int, int, Callable[[], None]]] = []
        self._numbers = itertools.count()

    # ---- time

    @property
    @abstractmethod
    def cycle(self) -> int:
        """The cycles since reset."""

    @property
    def now(self) -> float:
        """The simulated time in microseconds."""
        return self.cycle * 1e6 / self.clock_hz

    def at(self, at_us: float, action: Callable[[], None]) -> None:
        """Schedule an action for a time; it happens at once if that has passed."""
        cycle = round(at_us * self.clock_hz / 1e6)
        if cycle <= self.cycle:
            action()
            return
        heapq.heappush(self._actions, (cycle, next(self._numbers), action))
        if self._actions[0][0] == cycle:
            self.wake_at(cycle)

    @abstractmethod
    def wake_at(self, cycle: int) -> None:
        """Request a call of `wake` at a cycle earlier than any requested before."""

    def wake(self) -> int | None:
        """Perform the actions that are due, and return the cycle of the next one, if any."""
        while self._actions and self._actions[0][0] <= self.cycle:
            heapq.heappop(self._actions)[2]()
        return self._actions[0][0] if self._actions else None

    # ---- what an engine offers

    @abstractmethod
    def set_level(self, pin: str, level: int | None) -> None:
        """Drive a pin from outside, low or high; None releases it.

        It has an effect only while the program does not drive the pin.
        """

    def set_level_at(self, at_us: float, pin: str, level: int | None, holds: Callable[[], bool] = lambda: True) -> None:
        """Drive a pin from outside, as `set_level`, at a time to come.

        Args:
            at_us: the time in microseconds.
            pin, level: as of `set_level`.
            holds: tells at that time whether it is still to be done. It may be false only if the pin's level was set meanwhile,
                because an engine that plans it ahead forgets it then.
        """
        self.at(at_us, lambda: self.set_level(pin, level) if holds() else None)

    def emulates_capacitor(self, pin: str, decays: Sequence[tuple[float, float]]) -> bool:
        """Whether the engine itself plays a capacitor at a pin from now on; if not, the device does.

        An engine that does saves a message for each charge: the pin then keeps the level that the program drives, and falls when
        it has been let go for the time of the decay.

        Args:
            pin: the pin.
            decays: times in microseconds by time, each with how long a charge lasts that begins to decay from then on; the first
                one counts before its time, too.
        """
        return False

    def join(self, pin: str, other: str) -> None:
        """Close a contact between two pins: what the program drives on one is read on the other.

        A pin has one contact at a time.
        """
        self._contacts |= {pin: other, other: pin}
        self._pass_on(pin)

    def part(self, pin: str, other: str) -> None:
        """Open the contact between two pins."""
        for end in (pin, other):
            del self._contacts[end]
            self.set_level(end, None)

    def _pass_on(self, pin: str) -> None:
        """Put on both ends of a contact what the program drives on the other one."""
        far = self._contacts[pin]
        for end, other in ((pin, far), (far, pin)):
            driven = self.driven[other]
            if self.driven[end] in ("z", "p"):
                self.set_level(end, int(driven) if driven in (0, 1) else 1 if driven == "p" else None)

    @abstractmethod
    def set_voltage(self, pin: str, millivolts: float) -> None:
        """Set the voltage at a pin of the analog-to-digital converter."""

    @abstractmethod
    def send(self, data: bytes) -> None:
        """Let bytes arrive on the program's console."""

    def store(self, address: int, content: bytes) -> None:
        """Put bytes into the memory that the board keeps without power, before the program starts.

        Args:
            address: of the first one; beyond the end of the memory its addresses repeat.
            content: the bytes.

        Raises:
            VerificationError: there is no such memory.
        """
        if not self.store_bytes:
            raise VerificationError(
                "nothing can be put into the EEPROM of this board", fix="use a board and an engine that have one"
            )
        for number, byte in enumerate(content):
            self._store[(address + number) % self.store_bytes] = byte

    # ---- what an engine tells

    def byte_stored(self, at_us: float, address: int, byte: int) -> None:
        """Record that the program writes a byte into that memory, unless it is there already."""
        place = address % self.store_bytes
        if self._store.get(place, _ERASED) != byte:
            self._store[place] = byte
            self.stored.append(StoredByte(at_us, address, byte))

    def pin_changed(self, pin: str, level: Level) -> None:
        """Record that the program changed how it drives a pin, and notify the devices connected to it."""
        if self.driven[pin] == level:
            return
        if pin in self.brief:
            self.driven[pin] = level
            if pin in self._contacts:
                self._pass_on(pin)
            if (pin, level) in self._recorded:
                return
            self._recorded.add((pin, level))
            self.changes.append(PinChange(self.now, pin, level))
            return
        self.driven[pin] = level
        self.changes.append(PinChange(self.now, pin, level))
        self.refuse_too_many()
        for device in self._at_pin.get(pin, ()):
            if not device.is_played:
                device.pin_changed(pin, level)
        if pin in self._contacts:
            self._pass_on(pin)

    def wave_changed(self, pin: str, hz: float, duty: float) -> None:
        """Notify the devices at a pin that a timer makes another wave there; 0 Hz ends it."""
        for device in self._at_pin.get(pin, ()):
            device.wave_changed(pin, hz, duty)

    def refuse_too_many(self) -> None:
        """Refuse a program that changes its pins more often than can be kept.

        Raises:
            VerificationError: it does.
        """
        if len(self.changes) > MOST_CHANGES:
            raise VerificationError(f"the program changes its pins more than {MOST_CHANGES:,} times", fix="simulate less time")

    def aimed(self, pin: str, aim: str) -> None:
        """Tell the devices at a pin how the program drives them from now on: one of `AIMS`."""
        for device in self._at_pin.get(pin, ()):
            device.aimed(aim)

    @property
    def has_bus(self) -> bool:
        """Whether a device is on a two-wire bus."""
        return bool(self._on_bus)

    def bus_start(self, address: int, read: bool) -> bool:
        """The program addresses a device on the bus; returns whether one acknowledges."""
        device = self._on_bus.get(address)
        return device is not None and device.bus_start(read)

    def bus_write(self, address: int, byte: int) -> bool:
        """Pass a byte to the addressed device; returns whether it acknowledges."""
        device = self._on_bus.get(address)
        return device is not None and device.bus_write(byte)

    def bus_read(self, address: int) -> int:
        """The next byte from the addressed device; 255, the value of an idle bus, if there is none."""
        device = self._on_bus.get(address)
        return device.bus_read() if device is not None else 0xFF

    def bus_stop(self, address: int) -> None:
        """The program ends the transfer with the addressed device."""
        device = self._on_bus.get(address)
        if device is not None:
            device.bus_stop()

    def trace(
        self, engine: str, state: str, horizon_us: float, waves: Iterable[Wave], console: Iterable[ConsoleByte]
    ) -> PinTrace:
        """The trace of the run until the horizon, in order of time."""

        def by_time(found: Iterable[Event]) -> tuple[Event, ...]:
            return tuple(sorted((each for each in found if each.at_us <= horizon_us), key=itemgetter(0)))

        return PinTrace(
            engine, state, min(self.now, horizon_us),
            by_time(self.changes), by_time(waves), by_time(console), by_time(self.events),
            rests_until_us=horizon_us if state == "done" else 0.0, stored=by_time(self.stored), store_bytes=self.store_bytes,
        )  # fmt: skip

    # ---- connecting

    def connect(self, uses: Sequence[DeviceUse], brief: Iterable[str] = ()) -> None:
        """Connect devices, in this order, before the program starts.

        Args:
            uses: the devices.
            brief: the pins of which only the first change to each level is wanted. Where a device heeds what is driven, all
                changes are recorded nevertheless.

        Raises:
            UsageError: no device is called that, it lacks a pin or setting, the board has no such pin, or two devices on the bus
                have one address.
        """
        for number, use in enumerate(uses):
            if use.kind not in registry().entries.get("device", {}):
                raise UsageError(f"unknown device '{use.kind}'", fix=f"use one of: {', '.join(registry().names('device'))}")
            unknown = sorted({*use.pins.values()} - {*self.driven})
            if unknown:
                raise UsageError(f"the board has no pin '{unknown[0]}'", fix=f"use one of: {', '.join(self.driven)}")
            kind = device_class(use.kind)
            device = kind(self, number, use.pins, use.settings)
            self._devices.append(device)
            for pin in dict.fromkeys(use.pins.values()):
                self._at_pin.setdefault(pin, []).append(device)
            if device.address is not None:
                place = self.place_on_bus(device, device.address)
                if place in self._on_bus:
                    raise UsageError(f"two devices have the address {device.address:#x} on the bus", fix="change one of them")
                self._on_bus[place] = device
        self.brief = frozenset(brief) - self.heeded
        for device in self._devices:
            device.start()

    def place_on_bus(self, device: Device, address: int) -> int:
        """What the bus calls a device: its address, unless the bench has several buses."""
        return address

    @property
    def heeded(self) -> frozenset[str]:
        """The pins at which a device looks at how the program drives them."""
        return frozenset(pin for pin, devices in self._at_pin.items() if any(device.heeds_levels for device in devices))

    def ended(self) -> None:
        """Notify the devices that the run is over."""
        for device in self._devices:
            device.ended()


def device_class(kind: str) -> type[Device]:
    """The class of the devices that are registered under a name.

    Raises:
        RuleError: a plug-in registers no subclass of `Device`.
    """
    found: object = registry().get("device", kind)
    if isinstance(found, type) and issubclass(found, Device):
        return found
    raise wrong_result(content("device", kind), found, "a subclass of Device")


class Device:
    """A device at the pins: it plays the physical side, and notes what the user would see of it.

    Attributes:
        pin_names: what the device calls its pins; all of them have to be connected.
        optional_pin_names: further pins, which need not be connected.
        setting_names: name of each further setting -> its value where none is given; a setting with the value `...` is required.
        address: on the two-wire bus, 7 bits; None when it is not on the bus.
        heeds_levels: whether it looks at how the program drives its pins. Those of one that does not may be brief (see `Bench`).
        reacts_to: the levels of its pins on which it acts, or asks to act, before anything else happens. Of others it may be told
            a little later, though in order and with their time, as long as nothing of it was due in between.

    Raises:
        UsageError: a pin or a setting is missing, or unknown.
    """

    pin_names: tuple[str, ...] = ()
    optional_pin_names: tuple[str, ...] = ()
    setting_names: ClassVar[Mapping[str, Any]] = {}
    address: int | None = None
    heeds_levels: bool = True
    reacts_to: tuple[Level, ...] = (0, 1, "z", "p")
    is_played: bool = False

    def __init__(self, bench: Bench, number: int, pins: Mapping[str, str], settings: Mapping[str, Any]) -> None:
        self.bench = bench
        self.number = number
        self.pins = pins
        kind = type(self).__name__
        known_pins = (*self.pin_names, *self.optional_pin_names)
        for what, given, known in (("pin", pins, known_pins), ("setting", settings, tuple(self.setting_names))):
            if unknown := sorted({*given} - {*known}):
                raise UsageError(f"{kind} has no {what} '{unknown[0]}'", fix=f"use: {', '.join(known) or 'none'}")
        missing = [pin for pin in self.pin_names if pin not in pins]
        missing += [name for name, usual in self.setting_names.items() if usual is ... and name not in settings]
        if missing:
            raise UsageError(f"{kind} needs '{missing[0]}'", fix="give it")
        self.settings = {**self.setting_names, **settings}

    def start(self) -> None:
        """Set the device's state at power-up."""

    def pin_changed(self, pin: str, level: Level) -> None:
        """React to a change of how the program drives one of the device's pins."""

    def wave_changed(self, pin: str, hz: float, duty: float) -> None:
        """React to another wave of a timer at one of the device's pins: frequency and duty cycle (0 to 1); 0 Hz ends it."""

    def aimed(self, aim: str) -> None:
        """React to how the program drives the device from now on, one of `AIMS`; only models of libraries tell that."""

    def ended(self) -> None:
        """Record what is unfinished when the run is over."""

    def bus_start(self, read: bool) -> bool:
        """React to being addressed on the bus, for reading or writing; returns whether to acknowledge."""
        return False

    def bus_write(self, byte: int) -> bool:
        """Receive a byte from the bus; returns whether to acknowledge."""
        return False

    def bus_read(self) -> int:
        """Send a byte on the bus."""
        return 0xFF

    def bus_stop(self) -> None:
        """React to the end of a transfer."""

    def restore(self, address: int, content: bytes) -> None:
        """Have bytes from an earlier run, if it is a memory that keeps them without power."""

    def note(self, what: str, value: Any) -> None:
        """Record an event of the device at the current time."""
        self.bench.events.append(DeviceEvent(self.bench.now, self.number, what, value))
