"""An upper bound of the stack that a linked AVR program takes, computed from its disassembly without running it.

main, the functions that run before it, and the interrupt handlers share one stack. `machine_depths` computes how much each
takes with all that it calls; this module adds them up. A handler may start wherever interrupts are enabled, a handler that
enables them may be interrupted itself, and a function that a variable `under_way` guards is entered by only one of them at a
time.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

from robosmi.transformations.queries.interrupt_stack import HandlerBytes, upon_each_other
from robosmi.transformations.verification.machine_code import MachineCode
from robosmi.transformations.verification.machine_depths import OFF, Depths
from robosmi.verify.compile_report import StackBound

_ARCHITECTURE = "avr"
_VECTOR = re.compile(r"^__vector_\d+$")
_GUARD = re.compile(r"^_ZZ(\w+)E9under_way\b")
"""Mangled name of a static variable `under_way` of a function, which guards that function while it runs."""
_MOST_GUARDS = 3
"""If a program has more guarded functions, their guards are ignored."""


def stack_bound(disassembly: str, architecture: str) -> StackBound | None:
    """An upper bound of the stack that a program takes; None if it has no `main`, or is not for an AVR.

    Args:
        disassembly: the linked program's disassembly (see `MachineCode`).
        architecture: the architecture of its processor.
    """
    if architecture != _ARCHITECTURE:
        return None
    machine = MachineCode(disassembly)
    return _Contexts(machine).bound() if "main" in machine.symbols else None


class StackParts(NamedTuple):
    """The parts of a program's bound.

    Attributes:
        main: the bytes that main takes with all that it calls.
        main_open: the same at the deepest point at which interrupts may be enabled; negative if they never are.
        interrupts: name of a handler -> the bytes that it takes.
    """

    main: int
    main_open: int
    interrupts: dict[str, HandlerBytes]


def stack_parts(disassembly: str) -> StackParts:
    """The parts of an AVR program's bound; the stack of a guarded function is in the part that holds it in the bound.

    Args:
        disassembly: the disassembly of the linked program, which has a `main`.
    """
    return _Contexts(MachineCode(disassembly)).parts()


class _Contexts:
    """The contexts that share a program's stack: main with what runs before it, and each interrupt handler.

    A guarded function is held by one context at a time; the bound is the greatest over all assignments.

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
        """The parts of the bound."""
        _, holders = self._most()
        main = self._machine.symbols["main"]
        taken = self._without(main, holders).of(main, OFF)
        return StackParts(taken.most, taken.open, self._interrupts(holders))

    def _most(self) -> tuple[StackBound, dict[int, int]]:
        """The greatest bound over all assignments of guarded functions to contexts, and that assignment."""
        main = self._machine.symbols["main"]
        held = product((main, *self._names), repeat=len(self._guarded))
        ways = (dict(zip(self._guarded, each, strict=True)) for each in held)
        return max(((self._with(main, way), way) for way in ways), key=lambda found: found[0].bytes)

    def _without(self, context: int, holders: Mapping[int, int]) -> Depths:
        """The depths of functions in a context, where guarded functions that another context holds return at once."""
        shut = frozenset(function for function, holder in holders.items() if holder != context)
        if shut not in self._depths:
            self._depths[shut] = Depths(self._machine, shut)
        return self._depths[shut]

    def _with(self, main: int, holders: Mapping[int, int]) -> StackBound:
        """The bound for one assignment of guarded functions to contexts."""
        depths = self._without(main, holders)
        begins = [depths.of(address, OFF) for address in depths.beginnings()]
        taken = depths.of(main, OFF)
        before = 4 + max((each.most for each in begins), default=0)  # two return addresses
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
        """Name of each interrupt handler -> the bytes that it takes."""
        taken = {name: self._without(address, holders).of(address, OFF) for address, name in self._names.items()}
        return {n: HandlerBytes(2 + own.most, 2 + own.open if own.open >= 0 else -1) for n, own in taken.items()}
