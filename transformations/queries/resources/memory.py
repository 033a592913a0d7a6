"""How much data memory a plan's program takes, estimated from the models before it is compiled.

Counted are variables that last as long as the program, texts, the buffers that adapters, the core and libraries declare, and
the stacks of what ran on other cores. What is on the stack is `stack_depth`'s; sizes of types are `type_sizes`'.

What a compiler takes out is left out as far as the model tells (`compiled_code`): what nothing that runs refers to, numbers that
never change, which it puts into the code, and variables that nothing reads. On a processor with separate memories, a string that
is read like a variable, and the initial values of local arrays, are copied into data memory before main begins.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence, Set
from functools import lru_cache
from typing import Any

from msgspec import Struct

from robosmi.metamodels import ccode, migration, platform
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.queries.constants.compiled_code import (
    CompiledCode,
    compiled_code,
    declared_in,
    is_ignored,
    is_volatile,
    uses_of,
    way,
)
from robosmi.transformations.queries.constants.folded_values import ReadProgram
from robosmi.transformations.queries.plans.plan import platform_of
from robosmi.transformations.queries.plans.plan_adapters import closure, emitted, setup_statements
from robosmi.transformations.queries.programs.live_code import identity, in_macros, is_global
from robosmi.transformations.queries.resources.stack_depth import depth, unfollowed
from robosmi.transformations.queries.resources.type_sizes import TypeSizes, on_target, text_of, unescaped

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
_NUMBER = re.compile(r"static (?:struct \{[^{}]*\} ?|(?:[^;{(=\[]*[^\w;{(=\[])?)(\w+)(?:\[\w*\])*(?: = [^;]*)?;(?:\s*//.*)?")
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


# ---- texts and initial values

_COPIED = 3
"""Initial values of a local array with more bytes than this are copied from data memory; fewer are in the code."""
_IN_FLASH = (["PSTR"], ["F"])
_COMPILER = frozenset(["asm", "__asm__", "volatile", "__attribute__", "alignas", "static_assert", "section"])


def bytes_of_texts(code: CompiledCode, pieces: Sequence[platform.Adapter]) -> int:
    """Bytes of the strings in data memory; equal strings, and one that another ends with, are stored once."""
    said = {text for piece in pieces for text in data_memory_texts(str(piece.text))}
    for element in code.elements:
        if isinstance(element, ccode.StringLiteral) and not _elsewhere(element, code.ignored):
            said.add(text_of(element))
    ends = sorted(each[::-1] for each in said)
    pairs = zip(ends, [*ends[1:], None], strict=False)
    kept = [each for each, following in pairs if following is None or not following.startswith(each)]
    return sum(len(each) + 1 for each in kept)


def _elsewhere(literal: ccode.StringLiteral, ignored: set[int]) -> bool:
    """Whether a string literal is not stored as a string: it initialises an array, is in a sizeof, or is ignored."""
    container = literal.eContainer()
    if isinstance(container, ccode.InitializerList) and len(container.elements) == 1:
        container = container.eContainer()
    if isinstance(container, ccode.Variable):
        return bool(container.valueType is not None and container.valueType.arrayDims and not container.valueType.pointerDepth)
    return isinstance(container, ccode.SizeOf) or is_ignored(literal, ignored)


def bytes_of_initial_values(plan: migration.MigrationPlan, code: CompiledCode, sizes: TypeSizes) -> int:
    """Bytes of the initial values of local arrays, which are copied out of data memory whenever their block is entered."""
    others = {id(each) for each in lasting(plan, code.elements)}
    total = 0
    for element in code.elements:
        if not isinstance(element, ccode.Variable) or id(element) in others or element.initializer is None:
            continue
        if isinstance(element.initializer, (ccode.InitializerList, ccode.StringLiteral)) and _copied(element, code.ignored):
            size = sizes.of(element.valueType) if element.valueType is not None and element.valueType.arrayDims else 0
            total += size if size and size > _COPIED and _constant(element.initializer) else 0
    return total


def _copied(variable: ccode.Variable, ignored: set[int]) -> bool:
    """Whether a local array is used otherwise than by elements with literal indices, so that a compiler has to store it."""
    return any(way(each) not in ("read", "written", "size") and not is_ignored(each, ignored) for each in variable.references)


def _constant(initializer: ccode.Expression) -> bool:
    return not any(isinstance(each, (ccode.NameReference, ccode.Call)) for each in all_contents(initializer))


@lru_cache(maxsize=512)  # each report asks it of the same pieces
def data_memory_texts(text: str) -> tuple[str, ...]:
    """The string literals of a piece that occupy data memory: not those placed in flash or read only by the compiler."""
    return tuple(_kept_texts(text)) if '"' in text else ()


def _kept_texts(text: str) -> Iterator[str]:
    found = [each for each in tokens(text.encode()) if each[0] not in ("comment", "directive")]
    for number, (kind, _, _, said) in enumerate(found):
        before = [each[3] for each in found[max(0, number - 2) : number]]
        if kind == "string" and before[-1:] != ["extern"] and before[:1] not in _IN_FLASH and not _for_compiler(found[:number]):
            yield unescaped(said)


def _for_compiler(before: Sequence[Token]) -> bool:
    """Whether the next token is inside an `asm` statement or an attribute, or is a constant of compile time."""
    depth = 0
    for *_, word in reversed(before):
        depth += (word == ")") - (word == "(")
        if word in (";", "{", "}"):
            return False
        if word == "constexpr" or (depth < 0 and word in _COMPILER):
            return True
    return False


# ---- variables


class Share(Struct, frozen=True):
    """A part of the data memory: the name of what takes it, its bytes, and its line in the source, 0 if it has none."""

    name: str
    bytes: int
    line: int = 0


def lasting_variables(plan: migration.MigrationPlan, code: CompiledCode, sizes: TypeSizes) -> tuple[list[Share], list[str]]:
    """The variables that occupy memory, with their sizes, and the names of those whose size the models do not tell.

    Args:
        plan: the plan.
        code: what a compiler keeps of its program.
        sizes: the sizes of types on the target.
    """
    uses = uses_of(code.elements, code.ignored)
    shares, unknown, seen = [], [], set[int | str]()
    units = list(plan.program.units) if plan.program is not None else []
    named = in_macros(units)
    for variable in (*lasting(plan, code.elements), *_volatile(units)):
        name, key = str(variable.name), identity(variable)
        if key in seen or variable.storage.name == "externStorage":
            continue  # declared in several files
        seen.add(key)
        if not is_volatile(variable) and name not in named and not _kept(variable, uses.get(key, []), code):
            continue
        size = sizes.of(variable.valueType)
        if size is None:
            unknown.append(name)
        else:
            shares.append(Share(name, size, int(variable.line)))
    return shares, unknown


def lasting(plan: migration.MigrationPlan, live: Sequence[Element]) -> Iterator[ccode.Variable]:
    """The variables with static storage duration: globals, `static` locals, and locals that are moved out of main."""
    moved = {id(v) for d in plan.dispositions if d.hoisted is not None for v in declared_in(d.element)}
    for element in live:
        if not isinstance(element, ccode.Variable):
            continue
        if is_global(element) or id(element) in moved or element.storage.name == "staticStorage":
            yield element


def _volatile(units: Sequence[ccode.SourceUnit]) -> Iterator[ccode.Variable]:
    """The volatile variables, which a compiler keeps even if no reachable code names them."""
    for unit in units:
        for variable in all_of_kind(unit, ccode.Variable):
            lasts = is_global(variable) or variable.storage.name == "staticStorage"
            if lasts and is_volatile(variable) and (variable.storage.name == "unspecified" or variable.references):
                yield variable


def _kept(variable: ccode.Variable, references: Sequence[ccode.NameReference], code: CompiledCode) -> bool:
    """Whether a compiler keeps a variable: it changes and is read, or is an array that is read at an index not known before."""
    ways = {way(each) for each in references} - {"size"}
    if identity(variable) in code.unread and "address" not in ways:
        return False
    if identity(variable) in code.fixed:
        return "any" in ways or "address" in ways
    return bool(ways)
