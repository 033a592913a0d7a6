"""What of a platform's programs may behave otherwise on another board: the facts of `portability.toml` and `registers.json`.

A kind is data: the names, headers and types whose use is a place, and where it behaves the same. The rules are in
`queries.portability`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path

from msgspec import Struct, ValidationError, convert

from robosmi import inputs
from robosmi.base.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.project import read_data
from robosmi.transformations.knowledge.platforms.platform_folder import platform_folder

_NUMBER = re.compile(r"\d+")


class PlaceKind(Struct, frozen=True, forbid_unknown_fields=True):
    """A kind of place; the file explains the attributes.

    `functions`, `stores`, `conditions`, `words` and `registers` are read by the one rule that needs them.
    """

    what: str
    names: tuple[str, ...] = ()
    headers: tuple[str, ...] = ()
    not_headers: tuple[str, ...] = ()
    types: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()
    stores: tuple[str, ...] = ()
    conditions: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    registers: str = ""
    alike: str = ""
    cure: str = "none"
    when: str = "analyse"


class Chip(Struct, frozen=True):
    """The registers and interrupt vectors of a microcontroller."""

    registers: frozenset[str] = frozenset()
    vectors: frozenset[str] = frozenset()


class MoveFacts(Struct, frozen=True, forbid_unknown_fields=True):
    """What is different for programs of this platform on boards of an architecture, or with a microcontroller.

    Attributes:
        same: kind of places -> why they behave the same there all the same, but for names that `same_but` lists.
        same_but: names whose uses are places there although their kind is among `same`.
        servo_limits: the pulse widths of servos on the source boards, where the default is another one.
        eeprom_bytes: size of the EEPROM of the source boards, where flash takes its place.
        console_wait_ms: how long a sketch may wait for its console, where that is USB.
        clashes: names that a program may not declare at file scope.
        variable_clashes: names that no variable at file scope may have there; a function of that name is an overload.
        absent: names of the platform, with * for any letters, that the board's core does not declare.
        methods: class of the platform -> the declarations of methods that it has there, and not on the source boards.
        interrupt_modes: the modes of attachInterrupt on the source boards by their numbers, where the numbers differ.
        real_results: functions that give a real number there, and a whole one on the source boards.
        writes_bytes: objects whose write() takes a byte or a text there, and an int, too, on the source boards.
        needs_return: whether the board's tools refuse a function that may end without its value.
        calls: function or macro of avr-libc -> the one that does the same there with the same arguments.
        includes: header of avr-libc -> the one that takes its place there; empty if all that it has is replaced.
        watchdog: the functions that start the watchdog, by milliseconds, and that feed it.
        tick: the statement by which a function is called again and again from an interrupt; {function}, {us} and {timer} are
            filled in.
        tick_header: the header that declares what it takes.
        read_bits: the call by which analogRead gets the full scale of the source boards.
        pwm_frequency: the call by which analogWrite gets a frequency; {hz} is filled in.
        pwm_clocks: timer of a source board -> clocks of a period of its PWM; `*` stands for all others.
        modes_clear_levels: whether pinMode starts a pin anew, so that a level that was written before is lost.
        supply_volts: the full scale of the converter, where it is not that of the source boards.
    """

    same: Mapping[str, str] = {}
    same_but: tuple[str, ...] = ()
    servo_limits: tuple[int, int] | None = None
    eeprom_bytes: int = 0
    console_wait_ms: int = 0
    clashes: tuple[str, ...] = ()
    variable_clashes: tuple[str, ...] = ()
    absent: tuple[str, ...] = ()
    methods: Mapping[str, str] = {}
    interrupt_modes: tuple[str, ...] = ()
    real_results: tuple[str, ...] = ()
    writes_bytes: tuple[str, ...] = ()
    needs_return: bool = False
    calls: Mapping[str, str] = {}
    includes: Mapping[str, str] = {}
    watchdog: tuple[str, str] | None = None
    tick: str = ""
    tick_header: str = ""
    read_bits: str = ""
    pwm_frequency: str = ""
    pwm_clocks: Mapping[str, int] = {}
    modes_clear_levels: bool = False
    supply_volts: float = 0


class PortabilityFacts(Struct, frozen=True):
    """The facts of one platform.

    Attributes:
        kinds: name of a kind -> its facts, in the order of the file.
        registers: what registers belong to -> their names.
        microcontrollers: name -> what it has; one that is not listed has nothing of it.
        meanings: name of a register, with # for each number and * for any letters -> what it is for.
        moves: architecture or microcontroller of the target board -> what is different there.
    """

    kinds: Mapping[str, PlaceKind]
    registers: Mapping[str, Sequence[str]] = {}
    microcontrollers: Mapping[str, Chip] = {}
    meanings: Mapping[str, str] = {}
    moves: Mapping[str, MoveFacts] = {}

    def meaning(self, register: str) -> str:
        """What a register is for, with its number; empty if that is not known. An exact name counts first."""
        plain, numbers = _NUMBER.sub("#", register), _NUMBER.findall(register)
        found = self.meanings.get(plain) or next((text for name, text in self.meanings.items() if fnmatchcase(plain, name)), "")
        return found.replace("#", numbers[0]) if numbers else found

    def move_to(self, chip: str, architecture: str) -> MoveFacts:
        """What differs from the boards that the platform began with: the microcontroller's facts, else its architecture's."""
        return self.moves.get(chip) or self.moves.get(architecture) or MoveFacts()

    def move_between(self, source: tuple[str, str], target: tuple[str, str]) -> MoveFacts:
        """What is different on one board from another; both are microcontroller and architecture."""
        there = self.move_to(*target)
        return there if there != self.move_to(*source) else MoveFacts(same=there.same, same_but=there.same_but)


def portability_facts(platform: str) -> PortabilityFacts | None:
    """The facts about programs of a source platform; None if there are none.

    Raises:
        PlatformDataError: there is no such platform, or its data is damaged.
    """
    path = platform_folder(platform) / "portability.toml"
    return _facts(path) if path.is_file() else None


@cache
def _facts(path: Path) -> PortabilityFacts:
    registers = path.with_name("registers.json")
    try:
        told = json_of(inputs.read_bytes(registers, inputs.DATA)) if registers.is_file() else {}
        data = read_data(path)
        own = {name: data.get(name, {}) for name in ("kinds", "meanings", "moves")}
        return convert({**(told if isinstance(told, dict) else {}), **own}, PortabilityFacts)
    except (OSError, ValueError, ValidationError) as error:
        fix = f"correct it, or {registers.name} beside it"
        raise PlatformDataError(f"the kinds of places cannot be read: {error}", location=Location(str(path)), fix=fix) from error
