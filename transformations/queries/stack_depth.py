"""How deep the stack of a plan's program may grow, estimated from the models: the deepest chain of calls, and interrupts upon it.

Locals and calls of the program are counted by `cooperation.stack_bytes`, adapters by what is measured of their pieces. Stacks
of what ran on other cores are memory of their own (`memory`).
"""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import migration, platform
from robosmi.transformations.queries.cooperation import stack_bytes
from robosmi.transformations.queries.main_function import main_of
from robosmi.transformations.queries.plan_adapters import closure

START = 4
"""Bytes of stack that the start of the program takes, until main is called."""
ARGUMENT = 6
"""Bytes of each argument of a function that takes any number of them: its value and its kind."""
IDLE = 80
"""Bytes of stack that a coroutine needs that does nothing: interrupts of the core, and what it leaves while others get on."""
CORE_INTERRUPT = 17
"""Bytes that the core's own clock interrupt takes upon all else: what it returns to, and the registers that it keeps."""


def depth(plan: migration.MigrationPlan) -> int:
    """Bytes of stack that the program takes at most, as far as the models tell.

    Args:
        plan: the plan, complete.
    """
    filled = {str(use.name): closure([use.adapter]) for use in plan.adapterUses if use.adapter is not None}
    mains = [main for unit in (plan.program.units if plan.program is not None else ()) if (main := main_of(unit)) is not None]
    stacks = measured_stacks(filled.items())
    deepest = max((stack_bytes(main, stacks) for main in mains), default=0)
    passed = max((len(call.arguments) for use in plan.adapterUses if use.variadic for call in use.calls), default=0) * ARGUMENT
    least = IDLE if plan.concurrency is not None else START + CORE_INTERRUPT  # beside others, main is a coroutine, too
    return least + deepest + passed + interrupt_bytes(piece for pieces in filled.values() for piece in pieces)


def measured_stacks(filled: Iterable[tuple[str, list[platform.Adapter]]]) -> dict[str, int]:
    """Name of a platform's function -> bytes of stack that a call of its adapter takes, where these are many."""
    most = {name: max((int(p.stackBytes) for p in pieces if not handles_interrupts(p)), default=0) for name, pieces in filled}
    return {name: size for name, size in most.items() if size}


def interrupt_bytes(pieces: Iterable[platform.Adapter]) -> int:
    """Bytes that interrupts which the pieces handle take on the stack in use: all at once, as one may come within another.

    Args:
        pieces: pieces of adapter files, each as often as you like.
    """
    return sum({(str(p.sourceHeader), str(p.name)): int(p.stackBytes) for p in pieces if handles_interrupts(p)}.values())


def handles_interrupts(piece: platform.Adapter) -> bool:
    """Whether a piece, or a library that it includes, handles interrupts."""
    return bool(piece.vectors or piece.takenVectors)
