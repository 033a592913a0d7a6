"""How much data memory a plan's program takes, estimated from the models before it is compiled.

Counted are variables that last as long as the program, texts, the buffers that adapters, the core and libraries declare, and
the stacks of what ran on other cores. What a compiler takes out is left out as far as the model tells: what nothing that runs
refers to, numbers that never change, variables that nothing reads. What is on the stack is `stack_depth`'s.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence, Set
from functools import lru_cache
from typing import Any

from msgspec import Struct

from robosmi.metamodels import ccode, migration, platform
from robosmi.model.strict import Element
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.compiled_code import CompiledCode, compiled_code
from robosmi.transformations.queries.folded_values import ReadProgram
from robosmi.transformations.queries.lasting_variables import Share, lasting_variables
from robosmi.transformations.queries.memory_texts import bytes_of_initial_values, bytes_of_texts
from robosmi.transformations.queries.plan import platform_of
from robosmi.transformations.queries.plan_adapters import closure, emitted, setup_statements
from robosmi.transformations.queries.stack_depth import depth, unfollowed
from robosmi.transformations.queries.type_sizes import on_target

_SERIAL = "Serial"
"""Name of the core library's part that drives the serial line."""
_LISTED = 5
"""How many of the largest variables a report names."""
_COUNTS = ("++", "--")
_GIVES = frozenset(["=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>=", "["])
_DEFINED = re.compile(r"^inline [\w ]*?[ *](\w+)\([^;{]*\) \{", re.MULTILINE)
"""The functions that the text of a piece defines."""
_LOOK_UPS = frozenset(["port", "ports"])
"""Names of the pieces that look up a port's pin at run time."""
_NUMBER = re.compile(r"static (?:struct \{[^{}]*\}|[^;{(]*?[\w\]]*?) ?(\w+)(?:\[\w*\])*(?: = [^;]*)?;(?:\s*//.*)?")
"""Matches the text of a piece that declares one variable and nothing else."""


class Memory(Struct, frozen=True):
    """The estimated data memory (RAM) of a program.

    Attributes:
        variables: shares of the program's own variables, the largest first.
        texts: bytes of the program's texts.
        adapters: shares of its adapter pieces and of the core and libraries that these use, the largest first.
        stacks: bytes of the coroutines' stacks, for code that ran on other cores of the source.
        depth: bytes of main's stack at most, in addition to all these.
        unknown: names of variables whose size the models do not tell.
        limit: bytes that the board has, 0 where that is not known.
        unfollowed: lines of calls through pointers that `depth` does not contain, since nothing tells what they reach.
    """

    variables: tuple[Share, ...]
    texts: int
    adapters: tuple[Share, ...]
    stacks: int
    depth: int
    unknown: tuple[str, ...]
    limit: int
    unfollowed: tuple[int, ...] = ()

    @property
    def of_variables(self) -> int:
        """Bytes of the program's variables."""
        return sum(each.bytes for each in self.variables)

    @property
    def of_adapters(self) -> int:
        """Bytes of adapters, core and libraries."""
        return sum(each.bytes for each in self.adapters)

    @property
    def total(self) -> int:
        """The estimated RAM of the program in bytes: variables, texts, adapters and stacks of coroutines."""
        return self.of_variables + self.texts + self.of_adapters + self.stacks

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        return {
            "estimated_bytes": self.total, "variables": self.of_variables, "texts": self.texts, "adapters": self.of_adapters,
            "stacks": self.stacks, "stack_depth": self.depth, "ram_bytes": self.limit, "unknown": list(self.unknown),
            "unfollowed_calls": list(self.unfollowed),
            "largest": [{"name": s.name, "bytes": s.bytes, "line": s.line or None} for s in self.variables[:_LISTED]],
        }  # fmt: skip


def memory(plan: migration.MigrationPlan) -> Memory:
    """Estimate the data memory of a plan's program.

    Args:
        plan: the plan, complete.
    """
    program = ReadProgram(list(plan.program.units) if plan.program is not None else [])
    code = compiled_code(plan, program)
    sizes = on_target(plan)
    chip = plan.board.microcontroller if plan.board is not None else None
    pieces = _pieces(plan, code)
    if _shared_access(plan, code, pieces):
        code = compiled_code(plan, program, pins=False)
        pieces = _pieces(plan, code)
    variables, unknown = lasting_variables(plan, code, sizes)
    shared = plan.concurrency
    adapters = tuple(sorted(_adapters(plan, code.elements, pieces), key=lambda each: -each.bytes))
    serial = any(share.name == _SERIAL for share in adapters)
    return Memory(
        tuple(sorted(variables, key=lambda each: -each.bytes)),
        bytes_of_texts(code, pieces) + bytes_of_initial_values(plan, code, sizes),
        adapters,
        int(shared.slots * shared.stackBytes) if shared is not None else 0,
        depth(plan, code, pieces, serial=serial),
        tuple(unknown),
        int(chip.ramBytes) if chip is not None else 0,
        unfollowed(code),
    )


def _pieces(plan: migration.MigrationPlan, code: CompiledCode) -> list[platform.Adapter]:
    """The adapter pieces that reachable code or an interrupt uses, with the pieces they depend on."""
    calls = {id(each) for each in code.elements if isinstance(each, ccode.Call)}
    working = calls - code.answers.keys()
    named = {str(each.name) for each in code.elements if isinstance(each, ccode.NameReference)}
    uses = [use.adapter for use in plan.adapterUses if use.name in named or any(id(call) in working for call in use.calls)]
    symbols = [use.adapter for use in plan.symbolUses]
    asked = {name for flow in plan.portFlows for name in _looked_up(flow, calls, code)}
    helpers = [piece for piece in plan.helpers if piece.name not in _LOOK_UPS or piece.name in asked]
    found = closure(piece for piece in (*symbols, *uses, *helpers) if piece is not None)
    return closure((*found, *_always_there(emitted(plan))))


def _shared_access(plan: migration.MigrationPlan, code: CompiledCode, pieces: Sequence[platform.Adapter]) -> bool:
    """Whether pieces that check a port at each call are needed both by calls without a pin and by others.

    A compiler then keeps one function for both, which asks at run time, so it cannot drop the calls without a pin.
    """
    there = {id(piece) for piece in pieces}
    silent = [u.adapter for u in plan.adapterUses if u.adapter is not None and any(id(c) in code.answers for c in u.calls)]
    needed = [each for piece in silent for each in closure([piece]) if each is not piece and "wired()" in str(each.text)]
    return any(id(each) in there for each in needed)


def _looked_up(flow: migration.PortFlow, calls: Set[int], code: CompiledCode) -> Iterator[str]:
    """Names of the pieces that look up a flow's ports at run time; empty where the text gives all its port numbers."""
    unknown = any(None in code.arguments.get(id(call), [None]) for call in flow.calls if id(call) in calls)
    for change in flow.changes if unknown else ():
        yield change.replacement.partition("(")[0]


def _always_there(pieces: Sequence[platform.Adapter]) -> list[platform.Adapter]:
    """The pieces that are linked in any case: interrupt handlers with what they call, and global objects of libraries."""
    found = {id(piece): piece for piece in pieces if piece.vectors or (piece.libraries and piece.ramBytes)}
    waiting = list(found.values())
    defined = [(piece, frozenset(_DEFINED.findall(str(piece.text)))) for piece in pieces] if waiting else []
    while waiting:
        words = set(_words(str(waiting.pop().text)))
        for piece, names in defined:
            if id(piece) not in found and words & names:
                found[id(piece)] = piece
                waiting.append(piece)
    return list(found.values())


def _adapters(plan: migration.MigrationPlan, live: Sequence[Element], pieces: Sequence[platform.Adapter]) -> Iterator[Share]:
    words = [_words(str(piece.text)) for piece in pieces]
    alone = [_NUMBER.fullmatch(str(piece.text).strip()) for piece in pieces]
    own = [number[1] if number is not None else "" for number in alone]
    changed = {name for each, declared in zip(words, own, strict=True) for name in _changed(each) if name != declared}
    for piece, declared in zip(pieces, own, strict=True):
        if piece.ramBytes and (not declared or declared in changed):
            yield Share(str(piece.name), int(piece.ramBytes))
    names = {word for each in words for word in each}
    for piece in emitted(plan):
        if piece.libraries:  # a library is linked whole, and its objects begin before main
            names |= {*piece.libraries, *_words(str(piece.text))}
    names |= {word for text in setup_statements(plan) for _, _, _, word in tokens(text.encode())}
    names |= {str(each.calleeName) for each in live if isinstance(each, ccode.Call)}
    names.add(str(platform_of(plan).mainHeader).removesuffix(".h"))
    chip = plan.board.microcontroller if plan.board is not None else None
    taken = dict[int, Share]()
    for use in chip.uses if chip is not None else ():
        if use.userKind is platform.UserKind.part and use.name in names:
            taken.setdefault(int(use.ramBytes), Share(str(use.name), int(use.ramBytes)))
    yield from taken.values()


@lru_cache(maxsize=512)  # each report asks it of the same pieces
def _words(text: str) -> tuple[str, ...]:
    """The tokens of a piece, comments left out."""
    return tuple(word for kind, *_, word in tokens(text.encode()) if kind != "comment")


def _changed(words: Sequence[str]) -> Iterator[str]:
    """The names that a text assigns, increments, or takes the address of."""
    for number, word in enumerate(words):
        behind, before = words[number + 1 : number + 2], words[number - 1 : number]
        if (behind and (behind[0] in _GIVES or behind[0] in _COUNTS)) or (before and before[0] in (*_COUNTS, "&")):
            yield words[number - 2] if before == ["."] and number > 1 else word
