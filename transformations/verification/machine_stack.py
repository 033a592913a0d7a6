"""How much stack a linked AVR program can take: a bound, read off its machine code.

Main, each interrupt's handler and what runs before main take turns on one stack. How much each takes with what it calls is
`machine_depths`'; here is how they come upon each other: a handler comes where interrupts may come, those that let others in
are interrupted themselves, and a function that shuts itself while it runs is gone into by one of them only. Nothing is run here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

from robosmi.transformations.queries.interrupt_stack import HandlerBytes, upon_each_other
from robosmi.transformations.verification.machine_code import MachineCode
from robosmi.transformations.verification.machine_depths import OFF, Depths
from robosmi.typed import paired
from robosmi.verify.compile_report import StackBound

_ARCHITECTURE = "avr"
_VECTOR = re.compile(r"^__vector_\d+$")
_GUARD = re.compile(r"^_ZZ(\w+)E9under_way\b")
"""The name of a static variable `under_way` of a function, which shuts that function while it runs."""
_MOST_GUARDS = 3
"""More functions that run once at a time are taken as others are."""


def stack_bound(disassembly: str, architecture: str) -> StackBound | None:
    """The most stack that a program takes; None where it has no `main`, or is for another processor.

    Args:
        disassembly: of the linked program (see `MachineCode`).
        architecture: of its processor.
    """
    if architecture != _ARCHITECTURE:
        return None
    machine = MachineCode(disassembly)
    return _Contexts(machine).bound() if "main" in machine.symbols else None


class StackParts(NamedTuple):
    """What a program's bound is made of.

    Attributes:
        main: the bytes that main takes with what it calls.
        main_open: the same where interrupts may come; below 0 where they never may.
        interrupts: name of a handler -> what it takes.
    """

    main: int
    main_open: int
    interrupts: dict[str, HandlerBytes]


def stack_parts(disassembly: str) -> StackParts:
    """What the bound of an AVR program is made of: of what runs once at a time each part has as much as it has in the bound.

    Args:
        disassembly: of the linked program, which has a `main`.
    """
    return _Contexts(MachineCode(disassembly)).parts()


class _Contexts:
    """What may take turns on a program's stack: main, with what runs before it, and the interrupts upon it.

    A function that runs once at a time is gone into by one of them only; which one is what takes most.

    Args:
        machine: the program's code.
    """

    def __init__(self, machine: MachineCode) -> None:
        self._machine = machine
        begins = {f"_Z{found[1]}" for name in machine.objects if (found := _GUARD.match(name))}
        guarded = sorted(address for name, address in machine.symbols.items() if name in begins)
        self._guarded = guarded if len(guarded) <= _MOST_GUARDS else []
        vectors = {name: address for name, address in machine.symbols.items() if _VECTOR.match(name)}
        self._names = {vectors[name]: name for name in sorted(vectors, key=lambda each: int(each.rpartition("_")[2]))}
        self._depths: dict[frozenset[int], Depths] = {}

    def bound(self) -> StackBound:
        """The bound of the program."""
        return self._most()[0]

    def parts(self) -> StackParts:
        """What the bound is made of."""
        _, holders = self._most()
        main = self._machine.symbols["main"]
        taken = self._without(main, holders).of(main, OFF)
        return StackParts(taken.most, taken.open, self._interrupts(holders))

    def _most(self) -> tuple[StackBound, dict[int, int]]:
        """The bound, and who holds what runs once at a time there."""
        main = self._machine.symbols["main"]
        held = product((main, *self._names), repeat=len(self._guarded))
        ways = (dict(paired(self._guarded, each)) for each in held)
        return max(((self._with(main, way), way) for way in ways), key=lambda found: found[0].bytes)

    def _without(self, context: int, holders: Mapping[int, int]) -> Depths:
        """How much functions take in a context that goes only into those that it holds of what runs once at a time."""
        shut = frozenset(function for function, holder in holders.items() if holder != context)
        if shut not in self._depths:
            self._depths[shut] = Depths(self._machine, shut)
        return self._depths[shut]

    def _with(self, main: int, holders: Mapping[int, int]) -> StackBound:
        """The bound where each function that runs once at a time is held by one context."""
        depths = self._without(main, holders)
        begins = [depths.of(address, OFF) for address in depths.beginnings()]
        taken = depths.of(main, OFF)
        before = 4 + max((each.most for each in begins), default=0)  # returns to what calls them in turn
        interrupts = upon_each_other(self._interrupts(holders).values())
        closed = max(2 + taken.most, before)
        opened = max([2 + taken.open, *(4 + each.open for each in begins if each.open >= 0)]) + interrupts
        opens = taken.open >= 0 and opened >= closed
        recursive, unknown = set[int](), set[int]()
        for each in self._depths.values():
            recursive |= each.recursive
            unknown |= each.unknown
        said = [tuple(sorted(set(self._machine.names(found)))) for found in (recursive, unknown)]
        names = tuple(self._machine.names(depths.chain(main, opens=opens)))
        return StackBound(max(opened, closed), interrupts * opens, said[0], said[1], names)

    def _interrupts(self, holders: Mapping[int, int]) -> dict[str, HandlerBytes]:
        """What the interrupts take, by the names of their handlers."""
        taken = {name: self._without(address, holders).of(address, OFF) for address, name in self._names.items()}
        return {n: HandlerBytes(2 + own.most, 2 + own.open if own.open >= 0 else -1) for n, own in taken.items()}
