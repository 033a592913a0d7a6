"""How deep the stack of a plan's program may grow, estimated before it is compiled: the deepest calls, interrupts upon them.

What calls of adapters take, and the interrupts that come with them, is measured and stands in their files; the program's own
functions are estimated. What a compiler leaves out does not count. Once the program is compiled, its stack is read off its code
(`verification.machine_stack`). Stacks of what ran on other cores are memory of their own (`memory`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_of_kind
from robosmi.transformations.queries.call_chains import FRAME, Taken, deepest_chain
from robosmi.transformations.queries.compiled_code import CompiledCode, way
from robosmi.transformations.queries.cooperation import local_bytes, waits
from robosmi.transformations.queries.interrupt_stack import HandlerBytes, upon_each_other
from robosmi.transformations.queries.main_function import main_of
from robosmi.transformations.queries.plan_adapters import closure, emitted
from robosmi.typed import distinct

START = 2
"""Bytes of stack that lead to main: the address that it would return to."""
ARGUMENT = 6
"""Bytes of each argument of a function that takes any number of them: its value and its kind."""
MEASURED_ARGUMENTS = 3
"""So many arguments such a function was given where it was measured, a format and two values."""
IDLE = 80
"""Bytes of stack that a coroutine needs that does nothing: interrupts of the core, and what it leaves while others get on."""
CORE_INTERRUPT, SERIAL_INTERRUPT = 11, 19
"""Bytes that interrupts of the core take: of its clock, which each program has, and the larger one of its serial line."""
REGISTERS = 16
"""Bytes of a function's variables that are in registers, which the bytes of its call count."""
CALL = 12
"""Bytes of a call of an adapter that nobody has measured."""
_NO_CODE = (platform.PieceKind.constant, platform.PieceKind.dataType)
"""Kinds of pieces that are no code, so that naming one takes nothing."""
YIELD = "yield"
"""The piece with which a coroutine lets others get on."""


class _Program:
    """What calls of the platform take in one program.

    Args:
        plan: the plan, complete.
        code: what a compiler keeps of its program.
    """

    def __init__(self, plan: migration.MigrationPlan, code: CompiledCode) -> None:
        self._pieces = {str(use.name): use.adapter for use in plan.adapterUses if use.adapter is not None}
        self._pieces |= {str(use.name): use.adapter for use in plan.symbolUses if use.adapter is not None}
        self._variadic = {str(use.name) for use in plan.adapterUses if use.variadic}
        self._live = {id(element) for element in code.elements} - code.answers.keys()
        self._pointed = code.pointed
        self._places = Counter(str(e.calleeName) for e in code.elements if isinstance(e, ccode.Call) and id(e) in self._live)
        giving = [piece for piece in emitted(plan) if piece.name == YIELD] if plan.concurrency is not None else []
        self.turns = max((_bytes(piece, 1) for piece in giving), default=0)

    def taken_by(self, function: ccode.Function) -> Taken:
        """What a function takes."""
        assert function.body is not None  # only functions with one are followed
        calls = [call for call in all_of_kind(function.body, ccode.Call) if id(call) in self._live]
        names = [each for each in all_of_kind(function.body, ccode.NameReference) if id(each) in self._live]
        variables = [each for each in all_of_kind(function.body, ccode.Variable) if id(each) in self._live]
        own = [call.callee for call in calls if call.callee is not None and call.callee.body is not None]
        own += [function for call in calls for function in self._pointed.get(id(call), ())]
        others = [self._call(call) for call in calls if call.callee is None or call.callee.body is None]
        others += [self._use(str(each.name), 2) for each in names]
        return Taken(_frame(variables), own, max(others, default=0))

    def _call(self, call: ccode.Call) -> int:
        """Bytes of a call of the platform."""
        name = str(call.calleeName)
        more = ARGUMENT * (len(call.arguments) - MEASURED_ARGUMENTS) if name in self._variadic else 0
        return max(0, self._use(name, self._places[name]) + more)

    def _use(self, name: str, places: int) -> int:
        piece = self._pieces.get(name)
        if piece is None or piece.pieceKind in _NO_CODE:
            return 0
        more = self.turns and waits(piece) and all(each.name != YIELD for each in closure([piece]))
        return _bytes(piece, places) + (self.turns if more else 0)


def _frame(variables: Iterable[ccode.Variable]) -> int:
    """Bytes of local variables on the stack: arrays, records and what has an address; others beyond the registers."""
    lying, others = list[ccode.Variable](), list[ccode.Variable]()
    for variable in variables:
        use = variable.valueType
        large = use is not None and (bool(use.arrayDims) or (isinstance(use.declaration, ccode.Record) and not use.pointerDepth))
        (lying if large or any(way(each) == "address" for each in variable.references) else others).append(variable)
    return local_bytes(lying) + max(0, local_bytes(others) - REGISTERS)


def depth(plan: migration.MigrationPlan, code: CompiledCode, pieces: Iterable[platform.Adapter], *, serial: bool) -> int:
    """Bytes of stack that the program takes at most, as far as the models tell.

    Args:
        plan: the plan, complete.
        code: what a compiler keeps of its program.
        pieces: the pieces of adapters that are there.
        serial: whether the serial line of the core is there.
    """
    program = _Program(plan, code)
    mains = [main for unit in (plan.program.units if plan.program is not None else ()) if (main := main_of(unit)) is not None]
    deepest = max((deepest_chain(main, program.taken_by, FRAME) for main in mains), default=0)
    return START + max(deepest, program.turns) + interrupt_bytes(pieces, serial=serial)


def unfollowed(code: CompiledCode) -> tuple[int, ...]:
    """The lines of calls through pointers of which the models do not tell what they reach, so that `depth` has none of it."""
    calls = [each for each in code.elements if isinstance(each, ccode.Call) and not code.pointed.get(id(each), [each])]
    return tuple(distinct(int(call.line) for call in calls))


def _bytes(piece: platform.Adapter, places: int) -> int:
    """Bytes of stack that a piece takes which the program uses at so many places: measured, or a call for each on the way."""
    if piece.stackBytes < 0:
        return CALL * (1 + max((len(closure([each])) for each in piece.needs), default=0))
    return int(piece.inlinedStackBytes if places == 1 else piece.stackBytes)


def measured_stacks(filled: Iterable[tuple[str, list[platform.Adapter]]]) -> dict[str, int]:
    """Name of a platform's function -> bytes of stack that a call of its adapter takes, where that is measured.

    Args:
        filled: names with the pieces that each needs, its own last.
    """
    return {name: int(pieces[-1].stackBytes) for name, pieces in filled if pieces and pieces[-1].stackBytes >= 0}


def interrupt_bytes(pieces: Iterable[platform.Adapter], *, serial: bool = False) -> int:
    """Bytes that interrupts take on the stack in use: the core's, and those that come with the pieces.

    Args:
        pieces: pieces of adapter files, each as often as you like.
        serial: whether the serial line of the core is there, whoever uses it.
    """
    found: dict[str, HandlerBytes] = {"": HandlerBytes(SERIAL_INTERRUPT if serial else CORE_INTERRUPT, -1)}
    for each in (interrupt for piece in pieces for interrupt in piece.interrupts):
        known = found.get(str(each.vector), HandlerBytes(0, -1))
        found[str(each.vector)] = HandlerBytes(max(known.most, each.stackBytes), max(known.open, each.openBytes))
    return upon_each_other(found.values())
