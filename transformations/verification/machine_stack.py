"""How much stack a linked AVR program can take: a bound, read off its machine code.

The code is what the disassembler prints. From `main`, from each interrupt's handler and from what runs before main the paths
are followed, instruction by instruction, with how far the stack has come down: pushes, frames, calls with what they take.
What calls through pointers reach is told by `machine_code`. What nobody can tell is said: functions that call themselves, and
frames whose size is computed while the program runs. Nothing is run here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from robosmi.transformations.verification.machine_code import Instruction, MachineCode, low_of, number
from robosmi.verify.compile_report import StackBound

_ARCHITECTURE = "avr"
_SP_LOW, _SP_HIGH, _STATUS = 0x3D, 0x3E, 0x3F
_PAIRS = tuple(f"r{low}" for low in range(0, 32, 2))
"""The low registers of all pairs: in each a stack pointer may be computed."""
_KEPT = (*range(2, 18, 2), 28)
"""The low registers of the pairs that functions leave as they were."""
_SAVES, _RESTORES = "__prologue_saves__", "__epilogue_restores__"
_TABLES = ("__tablejump2__", "__tablejump__", "__tablejump_elpm__")
_THROUGH_POINTERS = {"icall": 2, "eicall": 2, "ijmp": 0, "eijmp": 0}
"""Instructions that go to where r31:r30 points, and the bytes of the address that each returns to."""
_COMPILED, _LENGTH = re.compile(r"_ZN?K?(?=\d)"), re.compile(r"\d+")
"""How the names that a compiler of C++ makes begin, and the length of each word in them."""
_VECTOR = re.compile(r"^__vector_\d+$")
_SKIPS = frozenset(["cpse", "sbrc", "sbrs", "sbic", "sbis"])
_BRANCHES = re.compile(r"^br\w\w$")
_COMPUTED = -1
"""What stands for a depth from which something was taken that is known only while the program runs."""
_ARITHMETIC = frozenset(["add", "adc", "sub", "sbc", "subi", "sbci", "and", "andi", "or", "ori", "neg", "com", "inc", "dec"])
_LARGEST = 0x4000
"""Bytes that no stack has: a path on which it grows without end is given up there."""


class _State(NamedTuple):
    """What is known before an instruction: how deep the stack is, and the depth that each pair of registers stands for."""

    depth: int
    pairs: tuple[int | None, ...] = (None,) * len(_PAIRS)

    def holding(self, low: str, depth: int | None) -> _State:
        """With another depth in a pair."""
        if low not in _PAIRS:
            return self
        at = _PAIRS.index(low)
        return _State(self.depth, (*self.pairs[:at], depth, *self.pairs[at + 1 :]))

    def held(self, low: str) -> int | None:
        """The depth that a pair stands for; None where it is something else."""
        return self.pairs[_PAIRS.index(low)] if low in _PAIRS else None

    def deeper(self, other: _State) -> _State:
        """The worse of two states; a pair that is not the same in both is known only while the program runs."""
        pairs = (a if a == b else _COMPUTED for a, b in zip(self.pairs, other.pairs, strict=True))
        return _State(max(self.depth, other.depth), tuple(pairs))


def stack_bound(disassembly: str, architecture: str) -> StackBound | None:
    """The most stack that a program takes; None where it has no `main`, or is for another processor.

    Args:
        disassembly: of the linked program (see `MachineCode`).
        architecture: of its processor.
    """
    if architecture != _ARCHITECTURE:
        return None
    machine = MachineCode(disassembly)
    return _Depths(machine).bound(machine.symbols["main"]) if "main" in machine.symbols else None


class _Depths:
    """How much stack each function of a program takes.

    Args:
        machine: the program's code.
    """

    def __init__(self, machine: MachineCode) -> None:
        self._machine = machine
        self._code, self._symbols, self._next = machine.code, machine.symbols, machine.next
        self._names = {address: name for name, address in machine.symbols.items()}
        self._saves, self._restores = machine.part(_SAVES), machine.part(_RESTORES)
        self._tables = {machine.symbols[name] for name in _TABLES if name in machine.symbols}
        self._known: dict[int, int] = {}
        self._way: dict[int, int] = {}
        self._on_way: set[int] = set()
        self.recursive: set[int] = set()
        self.unknown: set[int] = set()

    def bound(self, main: int) -> StackBound:
        """The bound of the program that begins at an address."""
        before = 2 + max((self.of(address) for address in self._beginnings()), default=0)  # returns to what calls them in turn
        handlers = [address for name, address in self._symbols.items() if _VECTOR.match(name)]
        interrupts = self._interrupts(handlers)
        deepest = max(2 + self.of(main), 2 + before)
        said = [sorted(self._name(address) for address in found) for found in (self.recursive, self.unknown)]
        chain = [main]
        while (following := self._way.get(chain[-1])) is not None and following not in chain:
            chain.append(following)
        names = tuple(self._name(address) for address in chain)
        return StackBound(deepest + interrupts, interrupts, tuple(said[0]), tuple(said[1]), names)

    def _interrupts(self, handlers: Iterable[int]) -> int:
        """Bytes of interrupts: those that let others in add up, and the largest of the others comes upon them."""
        sizes = {address: 2 + self.of(address) for address in handlers}
        open_ones = {address for address in sizes if self._lets_others_in(address)}
        closed = max((size for address, size in sizes.items() if address not in open_ones), default=0)
        return closed + sum(sizes[address] for address in open_ones)

    def _lets_others_in(self, handler: int) -> bool:
        seen, waiting = set[int](), [handler]
        while waiting:
            at = waiting.pop()
            if at in seen or at not in self._code:
                continue
            seen.add(at)
            instruction = self._code[at]
            if instruction.name == "sei":
                return True
            waiting += self._follow(instruction)
            if instruction.name in ("call", "rcall") and (target := instruction.target) is not None:
                waiting.append(target)
        return False

    def of(self, entry: int) -> int:
        """Bytes that a function takes with what it calls, without the address that it returns to."""
        waiting = [entry]
        while waiting:  # no recursion: functions may call the next for as long as they like
            at = waiting[-1]
            if at in self._known:
                waiting.pop()
            elif at in self._on_way:
                self._known[at] = self._measured(at)
                self._on_way.discard(at)
            else:
                self._on_way.add(at)
                waiting += [target for target in self._called(at) if target not in self._known and target not in self._on_way]
        return self._known[entry]

    def _called(self, entry: int) -> set[int]:
        """The functions that a function may call, directly and through pointers."""
        found, seen, waiting = set[int](), set[int](), [entry]
        while waiting:
            at = waiting.pop()
            instruction = self._code.get(at)
            if at in seen or instruction is None:
                continue
            seen.add(at)
            target = instruction.target
            if instruction.name in ("call", "rcall") and target and target != self._next.get(at):
                found.add(target)
            elif instruction.name in _THROUGH_POINTERS:
                found |= set(self._machine.reached_from(at))
            if target in self._tables:
                waiting += self._rows(entry)
            elif target in self._saves:
                waiting.append(self._next[at])
            elif target not in self._restores:
                waiting += self._follow(instruction)
        return found

    def _measured(self, entry: int) -> int:
        """What `of` says, where that is known of all that the function calls but for what is under way itself."""
        states = {entry: _State(0)}
        waiting, most, way = [entry], 0, None
        table: _State | None = None
        while waiting:
            at = waiting.pop()
            instruction = self._code.get(at)
            if instruction is None:
                continue
            after, deepest, into = self._step(instruction, states[at], entry)
            if deepest > most:
                most, way = deepest, into
            following = list(self._follow(instruction))
            target = instruction.target if instruction.name in ("jmp", "rjmp") else None
            if target is not None and target in self._tables:
                table = after if table is None else table.deeper(after)
                following = []
            elif target in self._saves:
                following = [self._next[at]]
            elif target in self._restores:
                following = []
            if after.depth > _LARGEST:
                self.unknown.add(entry)
                break
            for address in following:
                waiting += self._reach(states, address, after)
            if not waiting and table is not None:
                waiting += [a for place in self._rows(entry) for a in self._reach(states, place, table)]
        if way is not None:
            self._way[entry] = way
        return most

    @staticmethod
    def _reach(states: dict[int, _State], address: int, state: _State) -> list[int]:
        """The address, where a state is news there."""
        old = states.get(address)
        new = state if old is None else old.deeper(state)
        if new == old:
            return []
        states[address] = new
        return [address]

    def _rows(self, entry: int) -> list[int]:
        """Where the tables of a function's `switch`es may lead."""
        return [address for address in self._machine.labels if entry <= address < self._machine.end_of(entry)]

    def _step(self, instruction: Instruction, state: _State, entry: int) -> tuple[_State, int, int | None]:
        """The state behind an instruction, the deepest within it, and what it calls then."""
        name, operands = instruction.name, instruction.operands
        depth, low = state.depth, operands[0] if operands else ""
        if name == "push":
            return _State(depth + 1, state.pairs), depth + 1, None
        if name == "pop":
            return _State(max(0, depth - 1), state.pairs).holding(low_of(low), None), depth, None
        if name in ("rcall", "call"):
            target = instruction.target
            if target == 0:  # what is nowhere defined
                return self._left(state), depth + 2, None
            if target == self._next.get(instruction.address):
                return _State(depth + 2, state.pairs), depth + 2, None  # a frame of two bytes
            return self._left(state), depth + 2 + (self._of_called(target) if target is not None else 0), target
        if name in _THROUGH_POINTERS:
            sizes = {target: self._of_pointed(target) for target in self._machine.reached_from(instruction.address)}
            target = max(sizes, key=lambda each: sizes[each], default=None)
            own = _THROUGH_POINTERS[name]
            return self._left(state), depth + own + (sizes[target] if target is not None else 0), target
        if name in ("jmp", "rjmp") and (target := instruction.target) is not None:
            if target in self._saves:
                frame = self._frame_for_saves(instruction.address)
                depth += len([a for a in self._saves if a >= target and self._code[a].name == "push"]) + frame
                return _State(depth).holding("r28", depth), depth, None
            return state, depth, None
        return self._computed(instruction, state, entry), depth, None

    def _of_called(self, target: int) -> int:
        """What a call adds; what is under way already calls itself."""
        if target not in self._known:
            self.recursive.add(target)
        return self._known.get(target, 0)

    def _of_pointed(self, target: int) -> int:
        """As for a call; what is under way already is not called through a pointer once more, as far as anybody can tell."""
        return self._known.get(target, 0)

    @staticmethod
    def _left(state: _State) -> _State:
        """What a call leaves: registers that functions keep."""
        return _State(state.depth, tuple(held if 2 * at in _KEPT else None for at, held in enumerate(state.pairs)))

    def _computed(self, instruction: Instruction, state: _State, entry: int) -> _State:
        """The state behind an instruction that neither calls nor jumps."""
        name, operands = instruction.name, instruction.operands
        low = operands[0] if operands else ""
        if name == "in" and low in _PAIRS and number(operands[1]) == _SP_LOW:
            return state.holding(low, state.depth)
        if name == "in" and number(operands[1]) == _SP_HIGH:
            return state
        if name == "out" and number(low) == _SP_LOW:
            held = state.held(operands[1])
            if held == _COMPUTED:
                self.unknown.add(entry)
            return _State(held, state.pairs) if held is not None and held >= 0 else state  # without one it is another stack
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
                # sbc takes r1, which holds 0
                change = (number(operands[1]) or 0) | (number(following.operands[1]) or 0) << 8
                return state.holding(low, held + (change - 0x10000 if change >= 0x8000 else change))
            return state.holding(low, _COMPUTED)
        before = self._code.get(instruction.address - 2)
        if name in ("sbci", "sbc") and before is not None and before.name == "subi":
            return state  # taken with the subi before it
        return self._plain(instruction, state)

    @staticmethod
    def _plain(instruction: Instruction, state: _State) -> _State:
        """The state behind an instruction that computes no depth that is known."""
        name, low = instruction.name, instruction.operands[0] if instruction.operands else ""
        if name == "movw":
            return state.holding(low, state.held(instruction.operands[1]))
        if name in ("out", "st", "std", "sts", "cp", "cpc", "cpi", "tst", "cpse", "sbrc", "sbrs", "sbic", "sbis", "sbi", "cbi"):
            return state
        kept = name in _ARITHMETIC and state.held(low_of(low)) is not None
        return state.holding(low_of(low), _COMPUTED if kept else None)

    def _frame_for_saves(self, address: int) -> int:
        """The frame that a function asks `__prologue_saves__` for, in r27:r26 before the jump there."""
        values = {"r26": 0, "r27": 0}
        for before in range(address - 10, address, 2):
            instruction = self._code.get(before)
            if instruction is not None and instruction.name == "ldi" and instruction.operands[0] in values:
                values[instruction.operands[0]] = number(instruction.operands[1]) or 0
        return values["r26"] | values["r27"] << 8

    # ---- what leads where

    def _follow(self, instruction: Instruction) -> Iterator[int]:
        """The addresses that may come next, in the same function or in one that it ends in."""
        name = instruction.name
        following = self._next.get(instruction.address)
        if name in ("ret", "reti", "ijmp", "eijmp"):
            return
        target = instruction.target
        if name in ("jmp", "rjmp"):
            if target:  # at 0 are the vectors: what is nowhere defined
                yield target
            return
        if _BRANCHES.match(name) and target is not None:
            yield target
        if following is not None:
            yield following
            if name in _SKIPS and following in self._next:
                yield self._next[following]

    def _beginnings(self) -> list[int]:
        """What runs before main: constructors of objects that last."""
        return [address for name, address in self._symbols.items() if name.startswith("_GLOBAL__")]

    def _name(self, address: int) -> str:
        """A function's name as its text has it, as far as the compiler's name tells: without the kinds of its arguments."""
        name = self._names.get(address, hex(address)).partition(".")[0]
        begin = _COMPILED.match(name)
        if begin is None:
            return name
        words, at = list[str](), begin.end()
        while length := _LENGTH.match(name, at):
            at = length.end() + int(length[0])
            words.append(name[length.end() : at])
        return "::".join(words)


def _high(register: str) -> str:
    return f"r{int(register[1:]) + 1}"
