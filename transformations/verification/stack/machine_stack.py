"""An upper bound of the stack that a linked AVR program takes, computed from its disassembly without running it.

main, the functions that run before it, and the interrupt handlers share one stack. `Depths` computes how much each takes with all
that it calls; `stack_parts` adds them up. A handler may start wherever interrupts are enabled, a handler that enables them may be
interrupted itself, and a function that a variable `under_way` guards is entered by only one of them at a time.

All paths of a function are followed, instruction by instruction, with the depth of the stack (pushes, frames, and calls with
what they take) and with whether interrupts may be enabled. `machine_code` says which functions indirect calls reach. What cannot
be computed is reported: recursive functions, and frames whose size is computed at run time.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import NamedTuple

from robosmi.transformations.queries.resources.interrupt_stack import HandlerBytes, upon_each_other
from robosmi.transformations.verification.stack.machine_code import Instruction, MachineCode, low_of, number
from robosmi.verify.toolchains.compile_report import StackBound

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


_SP_LOW, _SP_HIGH, _STATUS = 0x3D, 0x3E, 0x3F
# ---- the stack of each function

_PAIRS = tuple(f"r{low}" for low in range(0, 32, 2))
"""The lower registers of all pairs: the stack pointer may be computed in any of them."""
_CALL_KEPT = (*range(2, 18), 28, 29)
"""The numbers of the call-saved registers."""
_KEPT = (*range(2, 18, 2), 28)
"""The lower registers of the call-saved pairs."""
_SAVES, _RESTORES = "__prologue_saves__", "__epilogue_restores__"
_TABLES = ("__tablejump2__", "__tablejump__", "__tablejump_elpm__")
_THROUGH_POINTERS = {"icall": 2, "eicall": 2, "ijmp": 0, "eijmp": 0}
"""Instructions that go to the address in r31:r30, with the bytes of the return address that each pushes."""
_SKIPS = frozenset(["cpse", "sbrc", "sbrs", "sbic", "sbis"])
_BRANCHES = re.compile(r"^br\w\w$")
_COMPUTED = -1
"""Stands for a depth from which an amount was subtracted that is only known at run time."""
_ARITHMETIC = frozenset(["add", "adc", "sub", "sbc", "subi", "sbci", "and", "andi", "or", "ori", "neg", "com", "inc", "dec"])
_LEAVES = ("call", "rcall", "icall", "eicall")
"""Instructions that a function does not reach if its guard makes it return at once."""
_LEAVING = frozenset(["out", "st", "std", "sts", "cp", "cpc", "cpi", "tst", "cpse", "sbrc", "sbrs", "sbic", "sbis", "sbi", "cbi"])
"""Instructions that do not change the register in their first operand."""
_LARGEST = 0x4000
"""More bytes than any stack has: a path on which it grows without end is given up there."""
ON, OFF = 1, 2
"""Whether interrupts may be enabled; both bits if paths differ."""
_ENABLES = 7
"""The bit of the status register that enables interrupts."""


class FunctionStack(NamedTuple):
    """The stack that a function takes.

    Attributes:
        most: bytes with all that it calls, without its own return address.
        open: the same at the deepest point at which interrupts may be enabled; negative if they never are.
        leaves: whether interrupts may be enabled when it returns (`ON`, `OFF`, or both).
    """

    most: int
    open: int
    leaves: int


class _State(NamedTuple):
    """What is known before an instruction.

    Attributes:
        depth: the depth of the stack in bytes.
        interrupts: whether they may be enabled (`ON`, `OFF`, or both).
        read: the same, over all places where the status register was read.
        kept: registers that hold a copy of the status register, each with the value of `interrupts` at that time.
        pairs: for each pair of registers the stack's depth that it holds as a pointer; None if it holds something else.
    """

    depth: int
    interrupts: int
    read: int = 0
    kept: tuple[tuple[str, int], ...] = ()
    pairs: tuple[int | None, ...] = (None,) * len(_PAIRS)

    def holding(self, low: str, depth: int | None) -> _State:
        """The state with another depth in a pair."""
        if low not in _PAIRS:
            return self
        at = _PAIRS.index(low)
        return self._replace(pairs=(*self.pairs[:at], depth, *self.pairs[at + 1 :]))

    def held(self, low: str) -> int | None:
        """The depth that a pair holds; None if it holds something else."""
        return self.pairs[_PAIRS.index(low)] if low in _PAIRS else None

    def deeper(self, other: _State) -> _State:
        """Join of two states: the greater depth; a pair that differs is only known at run time."""
        pairs = (a if a == b else _COMPUTED for a, b in zip(self.pairs, other.pairs, strict=True))
        kept = tuple(each for each in self.kept if each in other.kept)
        interrupts, read = self.interrupts | other.interrupts, self.read | other.read
        return _State(max(self.depth, other.depth), interrupts, read, kept, tuple(pairs))

    def called(self, taken: FunctionStack) -> _State:
        """The state after a call, which only call-saved registers survive."""
        pairs = tuple(held if 2 * at in _KEPT else None for at, held in enumerate(self.pairs))
        kept = tuple(each for each in self.kept if int(each[0][1:]) in _CALL_KEPT)
        return self._replace(interrupts=taken.leaves, kept=kept, pairs=pairs)

    def without(self, register: str) -> _State:
        """The state after a register that may have held a copy of the status register is overwritten."""
        return self._replace(kept=tuple(each for each in self.kept if each[0] != register)) if self.kept else self

    @property
    def open(self) -> int:
        """The depth of the stack if interrupts may be enabled here; otherwise negative."""
        return self.depth if self.interrupts & ON else -1


_Key = tuple[int, int]
"""A function's address, and whether interrupts may be enabled when it is called."""
_NOTHING = FunctionStack(0, -1, 0)


class Depths:
    """How much stack each function of a program takes.

    Args:
        machine: the program's code.
        shut: functions that return at once, since their guard says that they are running already.
    """

    def __init__(self, machine: MachineCode, shut: frozenset[int] = frozenset()) -> None:
        self._machine, self._shut = machine, shut
        self._code, self._symbols, self._next = machine.code, machine.symbols, machine.next
        self._saves, self._restores = machine.part(_SAVES), machine.part(_RESTORES)
        self._tables = {machine.symbols[name] for name in _TABLES if name in machine.symbols}
        self._known: dict[_Key, FunctionStack] = {}
        self._ways: dict[_Key, tuple[_Key | None, _Key | None]] = {}
        self._on_way: dict[_Key, bool] = {}
        self._missing: dict[_Key, bool] = {}
        self.recursive: set[int] = set()
        self.unknown: set[int] = set()

    def chain(self, begin: int, *, opens: bool) -> list[int]:
        """The chain of calls that takes most stack, or with `opens` most stack while interrupts may be enabled."""
        chain = [(begin, OFF)]
        following = self._ways[chain[0]][opens]
        while following is not None and following not in chain:
            chain.append(following)
            following = self._ways[following][opens] if following in self._ways else None
        return [address for address, _ in chain]

    def of(self, entry: int, interrupts: int) -> FunctionStack:
        """The stack that a function takes.

        Args:
            entry: its address.
            interrupts: whether they may be enabled when it is called.
        """
        waiting = [((entry, interrupts), False)]
        while waiting:  # a loop, since chains of calls may be longer than Python's recursion limit
            at, pointed = waiting[-1]
            if at in self._known:
                waiting.pop()
                continue
            self._on_way[at] = pointed
            self._missing = {}
            taken = self._measured(at)
            if self._missing:
                waiting += self._missing.items()
                continue
            self._known[at] = taken
            del self._on_way[at]
        return self._known[entry, interrupts]

    def _measured(self, key: _Key) -> FunctionStack:
        """What `of` returns; functions it calls that are not known yet are noted in `_missing`, except those under way."""
        entry, interrupts = key
        shut = entry in self._shut
        states = {entry: _State(0, interrupts)}
        waiting = [entry]
        most, way, opened, open_way, leaves = 0, None, states[entry].open, None, 0
        table: _State | None = None
        while waiting:
            at = waiting.pop()
            instruction = self._code.get(at)
            if instruction is None:
                continue
            if shut and instruction.name in _LEAVES:
                continue
            after, called, own = self._step(instruction, states[at], entry)
            into, taken = self._deepest(called)
            if (deep := own + taken.most) > most:
                most, way = deep, into
            if called:
                into, taken = self._deepest(called, opens=True)
            deep = own + taken.open if into is not None and taken.open >= 0 else max(states[at].open, after.open)
            if deep > opened:
                opened, open_way = deep, into
            following = list(self._follow(instruction, after))
            if instruction.name in ("ret", "reti", "ijmp", "eijmp"):
                leaves |= after.interrupts
            target = instruction.target if instruction.name in ("jmp", "rjmp") else None
            if target in self._shut and target != entry:  # a tail call of a function that returns at once
                leaves |= after.interrupts
                continue
            if target is not None and target in self._tables:
                table = after if table is None else table.deeper(after)
                following = []
            elif target in self._saves:
                following = [self._next[at]]
            elif target in self._restores:
                leaves |= after.interrupts
                following = []
            if after.depth > _LARGEST:
                self.unknown.add(entry)
                break
            for address in following:
                waiting += self._reach(states, address, after)
            if not waiting and table is not None:
                waiting += [a for place in self._rows(entry) for a in self._reach(states, place, table)]
        self._ways[key] = way, open_way
        return FunctionStack(most, opened, leaves or interrupts)

    def _deepest(self, called: Sequence[_Key], *, opens: bool = False) -> tuple[_Key | None, FunctionStack]:
        """Of the functions that an instruction may call, the one that takes most stack, and what it takes."""
        if not called:
            return None, _NOTHING
        known = {key: self._known[key] for key in called if key in self._known}
        deepest = max(known, key=lambda key: known[key].open if opens else known[key].most, default=None)
        return deepest, known[deepest] if deepest is not None else _NOTHING

    @staticmethod
    def _reach(states: dict[int, _State], address: int, state: _State) -> list[int]:
        """Join a state into the one known at an address; returns the address if that has changed anything."""
        old = states.get(address)
        new = state if old is None else old.deeper(state)
        if new == old:
            return []
        states[address] = new
        return [address]

    def _rows(self, entry: int) -> list[int]:
        """The addresses to which the jump tables of a function's `switch`es may lead."""
        return [address for address in self._machine.labels if entry <= address < self._machine.end_of(entry)]

    def _step(self, instruction: Instruction, state: _State, entry: int) -> tuple[_State, list[_Key], int]:
        """The state after an instruction, the functions that it may call, and the depth at which these start."""
        name, operands = instruction.name, instruction.operands
        depth, low = state.depth, operands[0] if operands else ""
        if name == "push":
            return state._replace(depth=depth + 1), [], depth + 1
        if name == "pop":
            return state._replace(depth=max(0, depth - 1)).without(low).holding(low_of(low), None), [], depth
        if name in ("rcall", "call"):
            target = instruction.target
            if not target:  # a weak symbol without definition
                return state.called(FunctionStack(0, 0, state.interrupts)), [], depth + 2
            if target == self._next.get(instruction.address):
                return state._replace(depth=depth + 2), [], depth + 2  # which reserves a frame of two bytes
            return self._behind(state, [target], pointed=False), [(target, state.interrupts)], depth + 2
        if name in _THROUGH_POINTERS:
            targets = self._machine.reached_from(instruction.address)
            behind = self._behind(state, targets, pointed=True)
            return behind, [(target, state.interrupts) for target in targets], depth + _THROUGH_POINTERS[name]
        if name in ("jmp", "rjmp") and (target := instruction.target) is not None:
            if target in self._saves:
                frame = self._frame_for_saves(instruction.address)
                depth += len([a for a in self._saves if a >= target and self._code[a].name == "push"]) + frame
                return _State(depth, state.interrupts, state.read).holding("r28", depth), [], depth
            return state, [], depth
        return self._computed(instruction, state, entry), [], depth

    def _behind(self, state: _State, targets: Sequence[int], *, pointed: bool) -> _State:
        """The state after a call; called functions that are not known yet are noted, and so are recursive ones.

        Args:
            state: the state before it.
            targets: the functions that may be called.
            pointed: whether the call is indirect, so that it is not certain which of the functions it reaches.
        """
        leaves = 0
        for key in ((target, state.interrupts) for target in targets):
            if key in self._known:
                leaves |= self._known[key].leaves
            elif key not in self._on_way:
                self._missing[key] = pointed and self._missing.get(key, True)
            elif not pointed and not self._through_pointers(key):
                self.recursive.add(key[0])
        return state.called(FunctionStack(0, 0, leaves or state.interrupts))

    def _through_pointers(self, key: _Key) -> bool:
        """Whether a cycle of calls back to a function under way includes indirect ones, so that recursion is not certain."""
        way = iter(self._on_way)
        for each in way:
            if each == key:
                break
        return any(self._on_way[each] for each in way)

    def _computed(self, instruction: Instruction, state: _State, entry: int) -> _State:
        """The state after an instruction that neither calls nor jumps."""
        name, operands = instruction.name, instruction.operands
        low = operands[0] if operands else ""
        if name in ("sei", "cli"):
            return state._replace(interrupts=ON if name == "sei" else OFF)
        if name == "in" and number(operands[1]) == _STATUS:
            read = state.without(low)
            kept = (*read.kept, (low, state.interrupts))
            return read._replace(read=state.read | state.interrupts, kept=kept).holding(low_of(low), None)
        if name == "out" and number(low) == _STATUS:
            return state._replace(interrupts=dict(state.kept).get(operands[1], state.read or ON | OFF))
        if name == "mov" and operands[1] in dict(state.kept):
            kept = (*state.without(low).kept, (low, dict(state.kept)[operands[1]]))
            return self._plain(instruction, state)._replace(kept=kept)
        if name not in _LEAVING:
            state = state.without(low)
        if name == "in" and low in _PAIRS and number(operands[1]) == _SP_LOW:
            return state.holding(low, state.depth)
        if name == "in" and number(operands[1]) == _SP_HIGH:
            return state
        if name == "out" and number(low) == _SP_LOW:
            held = state.held(operands[1])
            if held == _COMPUTED:
                self.unknown.add(entry)
            return state._replace(depth=held) if held is not None and held >= 0 else state  # else it switches stacks
        held = state.held(low_of(low))
        if held is None or held == _COMPUTED:
            return self._plain(instruction, state)
        if name in ("dec", "inc") and low_of(low) != low:
            return state.holding(low_of(low), held + (0x100 if name == "dec" else -0x100))
        if name in ("sbiw", "adiw"):
            change = number(operands[1]) or 0
            return state.holding(low, held + (change if name == "sbiw" else -change))
        if name == "subi" and low_of(low) == low:
            following = self._code.get(self._next.get(instruction.address, -1))
            if following is not None and following.name in ("sbci", "sbc") and following.operands[0] == _high(low):
                # sbc subtracts r1, which holds 0
                change = (number(operands[1]) or 0) | (number(following.operands[1]) or 0) << 8
                return state.holding(low, held + (change - 0x10000 if change >= 0x8000 else change))
            return state.holding(low, _COMPUTED)
        before = self._code.get(instruction.address - 2)
        if name in ("sbci", "sbc") and before is not None and before.name == "subi":
            return state  # handled with the subi before it
        return self._plain(instruction, state)

    @staticmethod
    def _plain(instruction: Instruction, state: _State) -> _State:
        """The state after an instruction that does not compute a known depth."""
        name, low = instruction.name, instruction.operands[0] if instruction.operands else ""
        if name == "movw":
            return state.holding(low, state.held(instruction.operands[1]))
        if name in _LEAVING:
            return state
        kept = name in _ARITHMETIC and state.held(low_of(low)) is not None
        return state.holding(low_of(low), _COMPUTED if kept else None)

    def _frame_for_saves(self, address: int) -> int:
        """The size of the frame that a function passes to `__prologue_saves__` in r27:r26 before it jumps there."""
        values = {"r26": 0, "r27": 0}
        for before in range(address - 10, address, 2):
            instruction = self._code.get(before)
            if instruction is not None and instruction.name == "ldi" and instruction.operands[0] in values:
                values[instruction.operands[0]] = number(instruction.operands[1]) or 0
        return values["r26"] | values["r27"] << 8

    # ---- control flow

    def _follow(self, instruction: Instruction, state: _State) -> Iterator[int]:
        """The addresses that may be executed next, in the same function or in one that it jumps to.

        Where a program tests whether interrupts are enabled, only the known outcome is followed.
        """
        name = instruction.name
        on = self._asked(instruction, state)
        following = self._next.get(instruction.address)
        if name in ("ret", "reti", "ijmp", "eijmp"):
            return
        target = instruction.target
        if name in ("jmp", "rjmp"):
            if target:  # at 0 are the vectors: a weak symbol without definition
                yield target
            return
        if _BRANCHES.match(name) and target is not None and on in (None, name == "brie"):
            yield target
        if following is not None:
            if on is None or on == (name in ("sbrc", "brid")):
                yield following
            if name in _SKIPS and following in self._next and on in (None, name == "sbrs"):
                yield self._next[following]

    def _asked(self, instruction: Instruction, state: _State) -> bool | None:
        """The outcome of an instruction that tests whether interrupts are enabled; None for others, and if it is not known."""
        name = instruction.name
        asks = name in ("brie", "brid")
        if name in ("sbrc", "sbrs") and number(instruction.operands[1]) == _ENABLES:
            before = self._code.get(instruction.address - 2)
            asks = before is not None and before.name == "in" and before.operands[0] == instruction.operands[0]
            asks = asks and before is not None and number(before.operands[1]) == _STATUS
        return state.interrupts == ON if asks and state.interrupts in (ON, OFF) else None

    def beginnings(self) -> list[int]:
        """The functions that run before main: constructors of static objects."""
        return [address for name, address in self._symbols.items() if name.startswith("_GLOBAL__")]


def _high(register: str) -> str:
    return f"r{int(register[1:]) + 1}"
