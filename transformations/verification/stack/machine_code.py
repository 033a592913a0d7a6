"""The disassembly of a linked AVR program: its instructions, its symbols, and which functions indirect calls may reach.

The linker's relocations show of which functions the program takes the address, and where it stores it. `machine_stack`
computes the depth of the stack.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from itertools import pairwise
from typing import NamedTuple

_HEAD = re.compile(r"^([0-9a-f]+) <(.+)>:$")
_CODE = re.compile(r"^ +([0-9a-f]+):\t(\w+)(?:\t((?:[^;\n]*[^;\s])?)\s*(?:;.*)?)?$")
_RELOCATION = re.compile(r"^\s+([0-9a-f]+): R_AVR_(\w+)\t([^\s+]+)(?:\+0x([0-9a-f]+))?$")
_SYMBOL = re.compile(r"^([0-9a-f]{8}) .{6}(.) (\.\w+)\t[0-9a-f]+ (?:\.hidden )?(\S+)$")
_HERE = re.compile(r"^\.([+-]\d+)$")
_NUMBER = re.compile(r"^(?:0x[0-9a-fA-F]+|-?\d+)$")

DATA = 0x800000
"""Address at which the disassembler shows the data memory."""
_FUNCTION, _WORD = "LO8_LDI_GS", "16_PM"
_ADDRESSES = ("LO8_LDI", "LO8_LDI_NEG")
_OBJECT = "O"
"""Mark of a variable in the symbol table."""
_VIRTUAL = "_ZTV"
"""Prefix of the names of virtual tables."""
_FIRST_ROW = 4
"""Bytes of a virtual table before its first function, to which objects point."""
_CONSTRUCTORS = ("__ctors_start", "__ctors_end")
_POINTERS = {"X": "r26", "Y": "r28", "Z": "r30"}
_COMPILED, _LENGTH = re.compile(r"_ZN?K?(?=\d)"), re.compile(r"\d+")
"""Prefix of names that a C++ compiler has mangled, and the length in front of each word in them."""
_NEAR = 24
"""Number of instructions searched before a call for its pointer's origin, and after an address for its destination."""
_JUMPS = ("jmp", "call", "rjmp", "rcall")
_THROUGH = ("icall", "eicall", "ijmp", "eijmp")
_CALLS = (*_JUMPS, *_THROUGH)
_LASTING = frozenset([*(f"r{low}" for low in range(2, 18)), "r28", "r29"])
"""The call-saved registers."""
_COMPARES = ("cp", "cpc", "cpi", "tst")
_BRANCH = re.compile(r"^br\w\w$")


class Instruction(NamedTuple):
    """One instruction: its address, its mnemonic and its operands."""

    address: int
    name: str
    operands: tuple[str, ...]

    @property
    def target(self) -> int | None:
        """The address that it jumps to or calls; None for other instructions, and if its operand is no number."""
        if self.name not in _JUMPS and not _BRANCH.match(self.name):
            return None
        text = self.operands[-1] if self.operands else ""
        here = _HERE.match(text)
        return self.address + 2 + int(here[1]) if here else number(text)


class _Held(NamedTuple):
    """An address of code that the program contains: the place where it is stored, the address, and the symbol of that place."""

    place: int
    target: int
    within: str


class _Pointer(NamedTuple):
    """The place from which the pointer of an indirect call was loaded.

    Attributes:
        variable: name of the variable; empty if it is not known.
        row: offset in bytes in a virtual table, if it may have been loaded from one; otherwise None.
    """

    variable: str
    row: int | None = None


class MachineCode:
    """The code of a program.

    Attributes:
        code: its instructions by address.
        symbols: the addresses of its functions by name.
        labels: addresses within functions that the jump tables of `switch` contain.

    Args:
        text: the output of `objdump -t -D -r --no-show-raw-insn -j .text -j .data -j .bss` for the linked program, which keeps
            its relocations.
    """

    def __init__(self, text: str) -> None:
        self.code: dict[int, Instruction] = {}
        self.symbols: dict[str, int] = {}
        self._objects: list[tuple[int, str]] = []
        self._addresses: dict[int, int] = {}
        known = {".text": 0}  # the symbol table adds its names
        raw, within = list[tuple[int, str, str, int, str]](), ""
        for line in text.splitlines():
            if found := _HEAD.match(line):
                within = found[2]
                if (address := int(found[1], 16)) < DATA:
                    self.symbols[within] = address
            elif found := _CODE.match(line):
                if (address := int(found[1], 16)) < DATA:
                    operands = tuple(part.strip() for part in (found[3] or "").split(",") if part.strip())
                    self.code[address] = Instruction(address, found[2], operands)
            elif found := _RELOCATION.match(line):
                raw.append((int(found[1], 16), found[2], found[3], int(found[4] or "0", 16), within))
            elif found := _SYMBOL.match(line):
                known.setdefault(found[4], int(found[1], 16))
                if found[2] == _OBJECT:
                    self._objects.append((int(found[1], 16), found[4]))
        self._objects.sort()
        addresses = sorted(self.code)
        self.next = dict(pairwise(addresses))
        self._before = {after: before for before, after in pairwise(addresses)}
        self._sort(self.symbols | known, raw)

    def _sort(self, known: Mapping[str, int], raw: list[tuple[int, str, str, int, str]]) -> None:
        """Sort the addresses that the program contains into labels, virtual functions, and functions stored in variables."""
        begins = self._starts = set(self.symbols.values())
        first, last = (self.symbols.get(name, 0) for name in _CONSTRUCTORS)
        labels, virtual = set[int](), dict[int, set[int]]()
        held = list[_Held]()
        for place, kind, name, more, within in raw:
            if name not in known:
                continue
            target = known[name] + more
            if kind in _ADDRESSES:
                self._addresses[place] = target
            elif kind in (_FUNCTION, _WORD) and target and not first <= place < last:
                if target not in begins:
                    labels.add(target)
                elif within.startswith(_VIRTUAL):
                    virtual.setdefault(place - known.get(within, place) - _FIRST_ROW, set()).add(target)
                else:
                    held.append(_Held(place, target, within))
        self.labels = tuple(sorted(labels))
        self._virtual = {row: frozenset(targets) for row, targets in virtual.items()}
        self._read = {self._called_from(address).variable for address, each in self.code.items() if each.name in _THROUGH} - {""}
        kept = dict[int, set[str]]()
        for each in held:
            kept.setdefault(each.target, set()).update(self._kept_in(each))
        self._kept = kept

    # ---- indirect calls

    def reached_from(self, call: int) -> tuple[int, ...]:
        """The functions that an indirect call may reach.

        A function that is stored only in variables which other calls read by name is left out. All others may be reached.

        Args:
            call: address of the call.
        """
        pointer = self._called_from(call)
        others = self._read - {pointer.variable}
        found = [target for target, kept in self._kept.items() if not kept <= others]
        return tuple(sorted({*found, *(self._virtual.get(pointer.row, ()) if pointer.row is not None else ())}))

    def _kept_in(self, held: _Held) -> set[str]:
        """The variables in which a function's address is stored: an empty name if unknown, none if it is discarded."""
        if held.place >= DATA:
            return {held.within}
        instruction = self.code.get(held.place)
        if instruction is None or instruction.name != "ldi":
            return set() if instruction is not None and instruction.name in _COMPARES else {""}
        register = instruction.operands[0]
        at, branched = held.place, False
        for _ in range(_NEAR):
            at = self.next.get(at, -1)
            following = self.code.get(at)
            if following is None or following.name in _THROUGH:
                return {""}
            operands = following.operands
            if following.name in _JUMPS:
                called = following.target if following.name in ("call", "rcall") else None
                return (self._named_by(called) & self._read if called is not None else set()) or {""}
            branched = branched or bool(_BRANCH.match(following.name))
            if following.name == "sts" and operands[1] == register:
                return {self._object((number(operands[0]) or 0) | DATA)}
            if following.name in ("st", "std") and operands[1] == register:
                return {self._address_in(_POINTERS[operands[0].strip("-")[0]], at)}
            if following.name not in (*_COMPARES, "out", "push") and operands and operands[0] == register:
                return {""} if branched or following.name == "mov" else set()
            if following.name in ("mov", "movw", "push") and operands[-1] in (register, _pair(register)):
                return {""}
        return {""}

    def _named_by(self, function: int) -> set[str]:
        """The variables that a function, or one that it calls, accesses by name."""
        found, seen, waiting = set[str](), set[int](), [function]
        while waiting:
            start = waiting.pop()
            if start in seen:
                continue
            seen.add(start)
            at: int | None = start
            end = self.end_of(start)
            while at is not None and (at < end or at == start):
                instruction = self.code.get(at)
                if instruction is None:
                    break
                if instruction.name in ("lds", "sts"):
                    found.add(self._object((number(instruction.operands[instruction.name == "lds"]) or 0) | DATA))
                elif at in self._addresses:
                    found.add(self._object(self._addresses[at]))
                elif instruction.name in _JUMPS and instruction.target in self._starts:
                    waiting.append(instruction.target)
                at = self.next.get(at)
        return found

    def _address_in(self, register: str, at: int) -> str:
        """The variable that a pair of registers points into before an instruction; empty if it is not known."""
        for instruction in self._backwards(at):
            operands = instruction.operands
            if instruction.name in _CALLS and not instruction.name.endswith("jmp") and register not in _LASTING:
                return ""
            if not operands or operands[0] not in (register, _pair(register)):
                continue
            if instruction.address in self._addresses:
                return self._object(self._addresses[instruction.address])
            if instruction.name == "movw":
                register = operands[1]
            elif instruction.name not in ("adiw", "sbiw", "subi", *_COMPARES):  # these stay within the variable
                return ""
        return ""

    def _called_from(self, call: int) -> _Pointer:
        """The place from which the pointer of an indirect call was loaded."""
        register, loads, row = "r30", 0, 0
        for instruction in self._backwards(call):
            operands = instruction.operands
            if instruction.name in _CALLS:
                break
            if not operands or operands[0] not in (register, _pair(register)):
                continue
            if instruction.name == "lds" and operands[0] == register:
                variable = self._object((number(operands[1]) or 0) | DATA)
                return _Pointer(variable) if not loads else _Pointer("", row)
            if instruction.address in self._addresses:
                return _Pointer(self._object(self._addresses[instruction.address]))
            if instruction.name in ("mov", "movw"):
                register = operands[1]
            elif instruction.name in ("adiw", "sbiw") and loads == 1:
                row += (number(operands[1]) or 0) * (1 if instruction.name == "adiw" else -1)
            elif instruction.name in ("ld", "ldd") and operands[0] == register:
                if loads:
                    return _Pointer("", row)
                pointer, _, more = operands[1].strip("-").partition("+")
                loads, register, row = 1, _POINTERS[pointer], number(more) or 0
        return _Pointer("", row if not loads else None)

    def _backwards(self, address: int) -> Iterator[Instruction]:
        for _ in range(_NEAR):
            address = self._before.get(address, -1)
            if address not in self.code:
                return
            yield self.code[address]

    def _object(self, address: int) -> str:
        """The name of the variable that contains an address of the data memory."""
        at = bisect_right(self._objects, (address, "\x7f"))
        return self._objects[at - 1][1] if at else ""

    # ---- names and extents

    def names(self, addresses: Iterable[int]) -> list[str]:
        """The names of functions as in the source, without the types of parameters."""
        known = {address: name for name, address in self.symbols.items()}
        return [_spoken(known.get(address, hex(address)).partition(".")[0]) for address in addresses]

    @property
    def objects(self) -> tuple[str, ...]:
        """The names of the program's variables with static storage duration."""
        return tuple(name for _, name in self._objects)

    def part(self, name: str) -> set[int]:
        """The addresses of the instructions of a function."""
        start = self.symbols.get(name)
        return set() if start is None else {address for address in self.code if start <= address < self.end_of(start)}

    def end_of(self, start: int) -> int:
        """Where the function that begins at an address ends."""
        return min((address for address in self.symbols.values() if address > start), default=start)


def _spoken(name: str) -> str:
    begin = _COMPILED.match(name)
    if begin is None:
        return name
    words, at = list[str](), begin.end()
    while length := _LENGTH.match(name, at):
        at = length.end() + int(length[0])
        words.append(name[length.end() : at])
    return "::".join(words)


def number(text: str) -> int | None:
    """The value of a numeric operand; None for other operands."""
    return int(text, 16 if text.startswith("0x") else 10) if _NUMBER.match(text) else None


@cache
def low_of(register: str) -> str:
    """The lower register of the pair to which a register belongs."""
    which = int(register[1:]) if register[:1] == "r" and register[1:].isdecimal() else -1
    return f"r{which - which % 2}" if which >= 0 else register


def _pair(register: str) -> str:
    """The name by which `movw`, which copies pairs, refers to a register."""
    return low_of(register)
