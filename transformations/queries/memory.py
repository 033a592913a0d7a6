"""How much data memory a plan's program takes, estimated from the models before it is compiled.

Counted are variables that last as long as the program, texts, the buffers that adapters, the core and libraries declare, and
the stacks of what ran on other cores. What a compiler takes out is left out as far as the model tells: what nothing that runs
refers to, numbers that never change, variables that nothing reads. What is on the stack is `stack_depth`'s.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from robosmi.metamodels import ccode, migration, platform
from robosmi.model.strict import Element
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.lasting_variables import Share, lasting_variables
from robosmi.transformations.queries.live_code import live_elements
from robosmi.transformations.queries.memory_texts import bytes_of_initial_values, bytes_of_texts
from robosmi.transformations.queries.plan import platform_of
from robosmi.transformations.queries.plan_adapters import closure, setup_statements
from robosmi.transformations.queries.stack_depth import depth
from robosmi.transformations.queries.type_sizes import on_target

_LISTED = 5
"""So many of the largest variables are named."""
_UNUSED = re.compile(r"\(void\)\s*\w+\s*;")
_COUNTS = ("++", "--")
_GIVES = frozenset(["=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>=", "["])
_NUMBER = re.compile(r"static [^;{(]*?[\w\]]*?(\w+)(?:\[\w*\])*(?: = [^;]*)?;(?:\s*//.*)?")
"""The text of a piece that is one variable."""


class Memory(NamedTuple):
    """The memory that a program takes for as long as it runs.

    Attributes:
        variables: of the program, the largest first.
        texts: bytes of the program's texts.
        adapters: of the pieces that it gets, and of the core and the libraries that these use, the largest first.
        stacks: bytes of the stacks of what ran on other cores.
        depth: bytes of stack that main takes at most, beside all these.
        unknown: names of variables whose size the models do not tell.
        limit: bytes that the board has, 0 where that is not known.
    """

    variables: tuple[Share, ...]
    texts: int
    adapters: tuple[Share, ...]
    stacks: int
    depth: int
    unknown: tuple[str, ...]
    limit: int

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
        """All bytes."""
        return self.of_variables + self.texts + self.of_adapters + self.stacks

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        return {
            "estimated_bytes": self.total, "variables": self.of_variables, "texts": self.texts, "adapters": self.of_adapters,
            "stacks": self.stacks, "stack_depth": self.depth, "ram_bytes": self.limit, "unknown": list(self.unknown),
            "largest": [{"name": s.name, "bytes": s.bytes, "line": s.line or None} for s in self.variables[:_LISTED]],
        }  # fmt: skip


def memory(plan: migration.MigrationPlan) -> Memory:
    """The memory that a plan's program takes.

    Args:
        plan: the plan, complete.
    """
    live = live_elements(plan)
    sizes = on_target(plan)
    ignored = {id(each) for use in plan.adapterUses for each in _ignored_arguments(use)}
    ignored |= {id(call) for use in plan.adapterUses if use.adapter is None for call in use.calls}
    chip = plan.board.microcontroller if plan.board is not None else None
    pieces = _pieces(plan, live)
    variables, unknown = lasting_variables(plan, live, sizes, ignored)
    shared = plan.concurrency
    return Memory(
        tuple(sorted(variables, key=lambda each: -each.bytes)),
        bytes_of_texts(live, ignored, pieces) + bytes_of_initial_values(plan, live, sizes),
        tuple(sorted(_adapters(plan, live, pieces), key=lambda each: -each.bytes)),
        int(shared.slots * shared.stackBytes) if shared is not None else 0,
        depth(plan),
        tuple(unknown),
        int(chip.ramBytes) if chip is not None else 0,
    )


def _pieces(plan: migration.MigrationPlan, live: Sequence[Element]) -> list[platform.Adapter]:
    """The pieces that what runs makes use of, with those that they need."""
    calls = {id(each) for each in live if isinstance(each, ccode.Call)}
    named = {str(each.name) for each in live if isinstance(each, ccode.NameReference)}
    uses = [use.adapter for use in plan.adapterUses if use.name in named or any(id(call) in calls for call in use.calls)]
    symbols = [use.adapter for use in plan.symbolUses]
    return closure(piece for piece in (*symbols, *uses, *plan.helpers) if piece is not None)


def _adapters(plan: migration.MigrationPlan, live: Sequence[Element], pieces: Sequence[platform.Adapter]) -> Iterator[Share]:
    words = [_words(str(piece.text)) for piece in pieces]
    alone = [_NUMBER.fullmatch(str(piece.text).strip()) for piece in pieces]
    own = [number[1] if number is not None else "" for number in alone]
    changed = {name for each, declared in zip(words, own, strict=True) for name in _changed(each) if name != declared}
    for piece, declared in zip(pieces, own, strict=True):
        if piece.ramBytes and (not declared or declared in changed):
            yield Share(str(piece.name), int(piece.ramBytes))
    names = {word for each in words for word in each}
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
    """The names that a text gives values, counts, or takes the address of."""
    for number, word in enumerate(words):
        behind, before = words[number + 1 : number + 2], words[number - 1 : number]
        if (behind and (behind[0] in _GIVES or behind[0] in _COUNTS)) or (before and before[0] in (*_COUNTS, "&")):
            yield word


def _ignored_arguments(use: migration.AdapterUse) -> Iterator[Element]:
    """The arguments of which an adapter makes nothing: all where it has no body, else those whose parameters it never names."""
    names = None if use.adapter is None else _parameters(str(use.adapter.text), str(use.adapter.targetName or use.adapter.name))
    for call in use.calls:
        for number, argument in enumerate(call.arguments):
            if names is None or (number < len(names) and not names[number]):
                yield argument


def _parameters(text: str, name: str) -> list[bool]:
    """Whether the text of an adapter names each parameter that it has."""
    found = re.search(rf"\b{re.escape(name)}\((?P<parameters>[^{{;]*)\)[^{{;]*\{{(?P<body>.*)", text, re.DOTALL)
    if found is None:
        return []
    body = set(re.findall(r"\w+", _UNUSED.sub("", found["body"])))
    depth, parts = 0, [""]
    for character in found["parameters"]:
        depth += (character == "(") - (character == ")")
        if character == "," and not depth:
            parts.append("")
        else:
            parts[-1] += character
    return [bool(body & set(re.findall(r"\w+", part))) for part in parts]
