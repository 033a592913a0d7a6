"""How deep the stack of a plan's program may grow, estimated from the models: the deepest chain of calls, and interrupts upon it.

What a compiler leaves out does not count; of adapters what is measured of their pieces does. Once the program is compiled, its
stack is read off its code (`verification.machine_stack`). Stacks of what ran on other cores are memory of their own (`memory`).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_of_kind
from robosmi.transformations.queries.call_chains import FRAME, Taken, deepest_chain
from robosmi.transformations.queries.compiled_code import CompiledCode
from robosmi.transformations.queries.cooperation import local_bytes
from robosmi.transformations.queries.main_function import main_of

_WORKS = re.compile(r"\)[\w ]*\{")
"""In the text of a piece that defines a function."""
START = 2
"""Bytes of stack that lead to main: the address that it would return to."""
ARGUMENT = 6
"""Bytes of each argument of a function that takes any number of them: its value and its kind."""
VARIADIC = 44
"""Bytes that a function with any number of arguments takes beside what does its work: its own frame, and the list of them."""
IDLE = 80
"""Bytes of stack that a coroutine needs that does nothing: interrupts of the core, and what it leaves while others get on."""
CORE_INTERRUPT, SERIAL_INTERRUPT = 11, 19
"""Bytes that the largest of the core's own interrupts takes upon all else: of its clock, and of its serial line."""
CALL = 12
"""Bytes of a call of a piece of an adapter of which nothing is measured: few keep registers."""


def depth(plan: migration.MigrationPlan, code: CompiledCode, pieces: Iterable[platform.Adapter], *, serial: bool) -> int:
    """Bytes of stack that the program takes at most, as far as the models tell.

    Args:
        plan: the plan, complete.
        code: what a compiler keeps of its program.
        pieces: the pieces of adapters that are there.
        serial: whether the serial line of the core is used.
    """
    measured = {str(use.name): _piece_bytes(use.adapter, {}) for use in plan.adapterUses if use.adapter is not None}
    measured |= {str(use.name): _piece_bytes(use.adapter, {}) for use in plan.symbolUses if use.adapter is not None}
    mains = [main for unit in (plan.program.units if plan.program is not None else ()) if (main := main_of(unit)) is not None]
    variadic = {str(use.name) for use in plan.adapterUses if use.variadic}
    deepest = max((_deepest(main, code, measured, variadic) for main in mains), default=0)
    core = SERIAL_INTERRUPT if serial else CORE_INTERRUPT
    least = IDLE if plan.concurrency is not None else START + core  # beside others, main is a coroutine, too
    return least + deepest + interrupt_bytes(pieces)


def _deepest(main: ccode.Function, code: CompiledCode, measured: Mapping[str, int], variadic: Collection[str]) -> int:
    """Bytes of the deepest chain of calls from a function on that a compiler keeps."""
    live = {id(element) for element in code.elements} - code.answers.keys()

    def taken_by(function: ccode.Function) -> Taken:
        assert function.body is not None  # only functions with one are followed
        calls = [call for call in all_of_kind(function.body, ccode.Call) if id(call) in live]
        names = [each for each in all_of_kind(function.body, ccode.NameReference) if id(each) in live]
        variables = [each for each in all_of_kind(function.body, ccode.Variable) if id(each) in live]
        own = [call.callee for call in calls if call.callee is not None and call.callee.body is not None]
        others = [_call(c, measured, variadic) for c in calls if c.callee is None or c.callee.body is None]
        others += [measured.get(str(each.name), 0) for each in names]
        return Taken(local_bytes(variables), own, max(others, default=0))

    return deepest_chain(main, taken_by, FRAME)


def _piece_bytes(piece: platform.Adapter, known: dict[int, int]) -> int:
    """Bytes of stack that a piece of an adapter takes with those that it needs: measured, or a call for each on the way."""
    if id(piece) not in known:
        known[id(piece)] = 0  # pieces may need each other
        below = max((_piece_bytes(each, known) for each in piece.needs), default=0)
        works = not handles_interrupts(piece) and _WORKS.search(str(piece.text)) is not None
        own = int(piece.stackBytes) if not handles_interrupts(piece) else 0
        known[id(piece)] = max(own, below + CALL * works)
    return known[id(piece)]


def _call(call: ccode.Call, measured: Mapping[str, int], variadic: Collection[str]) -> int:
    """Bytes of a call of the platform."""
    name = str(call.calleeName)
    more = VARIADIC + ARGUMENT * len(call.arguments) if name in variadic else 0
    return measured.get(name, CALL) + more


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
