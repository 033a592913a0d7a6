"""What an adapter file contains, as records: its pieces with their pins, ports, tables, ranges and interrupts.

`adapter_files` parses them from text, `adapter_checks` checks them, `adapter_data` stores and loads them.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from robosmi.diagnostics import Location


class ArgumentRange(Struct, frozen=True):
    """The values of a parameter that an adapter can handle.

    Attributes:
        name: the parameter, as the source's signature calls it.
        position: its index among the parameters, from 0.
        least, most: the least and the greatest value; None where there is no limit; 1 and 0 where no constant is one.
        others: further values that it handles, such as 0 for off.
        beside: the piece in whose presence alone the range applies; empty for always.
        away_from: a pin of the target whose calls have no such range; empty for none.
        effect: what happens with other values, as half a sentence.
    """

    name: str
    position: int
    least: int | None
    most: int | None
    others: Sequence[int]
    beside: str
    away_from: str
    effect: str


class AdapterPin(Struct, frozen=True):
    """A parameter of an adapter that is a pin of the target.

    Attributes:
        name: the parameter.
        capability: what the pin must be able to do, one of `CAPABILITIES`.
        direction: one of `DIRECTIONS`, seen from the microcontroller.
        signed: whether a negative value has a meaning of its own, as in `square_wave(-26, ...)`.
        role: kind of component that is expected there, empty for any.
        split: whether the component may have separate wires for the two directions, so that the pin is either of them.
    """

    name: str
    capability: str
    direction: str
    signed: bool
    role: str
    split: bool = False


class ConventionalPort(Struct, frozen=True):
    """A pin that an adapter uses by convention: a generated constant has the pin to which the port is bound.

    Attributes:
        constant: the constant's name in the text.
        name: the port's name for persons, `abdrive.left_servo`.
        number: the port on the source platform.
        capability, direction, role: as for a pin parameter.
    """

    constant: str
    name: str
    number: int
    capability: str
    direction: str
    role: str


class PortTable(Struct, frozen=True):
    """A table in which an adapter looks up ports of the source: an array with the pin of each port, from 0 on.

    Attributes:
        name: its name in the text.
        size: the number of ports in it.
    """

    name: str
    size: int


class InterruptStack(Struct, frozen=True):
    """The stack of an interrupt that occurs once an adapter has been called.

    Attributes:
        vector: the interrupt.
        stack: its stack in bytes, including the return address.
        others: the same if it enables other interrupts; -1 if it does not.
    """

    vector: str
    stack: int
    others: int


class AdapterPiece(Struct):
    """A piece of an adapter file.

    Attributes:
        kind: one of `KINDS`.
        name: its name on the source platform; for a helper, the name that its text defines.
        header: header of the source platform.
        location: where it begins.
        text: its C or C++ text.
        signatures: signatures of the source functions that it replaces.
        relation: one of `RELATIONS`; empty for a helper.
        needs: names of other pieces.
        includes: headers of the target, as `<Servo.h>`.
        libraries: libraries of the target.
        role: kind of component that the hardware has to have, empty for none.
        setup: statements for the start of the program.
        timers: timers that it occupies.
        vectors: interrupts that it handles.
        taken: interrupts that a library which it includes handles.
        mcus: microcontrollers that this variant is for; empty for all.
        architectures: processor architectures that this variant is for; empty for all others.
        members: this variant is for programs that use one of these members of a record; empty for all programs.
        beside: this variant is for programs that call one of these functions; empty for all programs.
        drawn: this variant is for drawings with parts of all these kinds on the board's pins; empty for all drawings.
        pins: its parameters that are pins.
        ports: pins that it uses by convention.
        tables: tables in which it looks up ports.
        ranges: the values of its parameters that it can handle.
        fidelity: how faithfully it reproduces the original.
        limits: what it does not do.
        symmetric: parameters that can be swapped without effect.
        target_name: its name on the target, if the target already uses the original one.
        stack: measured stack of a call in bytes; -1 if it was not measured.
        stack_once: the same if the program calls it at a single place, so that the compiler inlines it.
        interrupts: measured stack of the interrupts that occur once it has been called.
        ram: bytes of data memory of its own variables.
        servos: most servos that get pulses at a time; 0 where the source's library has no more.
    """

    kind: str
    name: str
    header: str
    location: Location
    text: str = ""
    signatures: list[str] = []
    relation: str = ""
    needs: list[str] = []
    includes: list[str] = []
    libraries: list[str] = []
    role: str = ""
    setup: list[str] = []
    timers: list[str] = []
    vectors: list[str] = []
    taken: list[str] = []
    mcus: list[str] = []
    architectures: list[str] = []
    members: list[str] = []
    beside: list[str] = []
    drawn: list[str] = []
    pins: list[AdapterPin] = []
    ports: list[ConventionalPort] = []
    tables: list[PortTable] = []
    ranges: list[ArgumentRange] = []
    fidelity: str = ""
    limits: list[str] = []
    symmetric: list[str] = []
    target_name: str = ""
    stack: int = -1
    stack_once: int = -1
    interrupts: list[InterruptStack] = []
    ram: int = 0
    servos: int = 0


class AdapterFile(Struct):
    """The content of an adapter file.

    Attributes:
        header: header of the source platform.
        pieces: its pieces, in order.
        unsupported: the reason, as a sentence, why the target cannot support the header; empty if it can.
        tasks: name of a function for which no adapter is possible -> the reason, as a sentence.
        architectures: processor architectures that all of its pieces are for; empty for all.
    """

    header: str = ""
    architectures: list[str] = []
    pieces: list[AdapterPiece] = []
    unsupported: str = ""
    tasks: dict[str, str] = {}
