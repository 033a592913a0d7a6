"""Estimates how deep the stack of a plan's program may grow before it is compiled: deepest call chain plus interrupts.

The stack of adapter calls and of their interrupts is measured and stored in the adapter files; that of the program's own
functions is estimated. Code that a compiler leaves out does not count. Once the program is compiled, its stack is read off its
code (`verification.stack.machine_stack`). Stacks of code that ran on other cores are memory of their own (`memory`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_contents
from robosmi.transformations.queries.constants.compiled_code import CompiledCode, way
from robosmi.transformations.queries.flows.call_chains import FRAME, Taken, deepest_chain
from robosmi.transformations.queries.plans.plan_adapters import closure, emitted
from robosmi.transformations.queries.programs.main_function import main_of
from robosmi.transformations.queries.resources.cooperation import local_bytes, waits
from robosmi.transformations.queries.resources.interrupt_stack import HandlerBytes, upon_each_other

START = 2
"""Bytes of stack at the start of main: its return address."""
ARGUMENT = 6
"""Bytes that each variable argument takes on the stack: its value and its kind."""
MEASURED_ARGUMENTS = 3
"""Number of arguments that variadic functions were measured with: a format and two values."""
IDLE = 80
"""Bytes of stack of a coroutine that does nothing: interrupts of the core, and what it saves while others run."""
CORE_INTERRUPT, SERIAL_INTERRUPT = 11, 19
"""Bytes that the core's interrupts take: of its clock, which each program has; of its serial line, which takes more."""
REGISTERS = 16
"""Bytes of a function's local variables that fit into registers, whose saving `FRAME` includes."""
CALL = 12
"""Assumed bytes of a call of an adapter that was not measured."""
_NO_CODE = (platform.PieceKind.constant, platform.PieceKind.dataType)
"""Kinds of pieces that contain no code."""
YIELD = "yield"
"""The piece by which a coroutine lets others run."""


class _Program:
    """The stack that functions of one program take.

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
        """The stack that one of the program's functions takes."""
        assert function.body is not None  # only functions with one are followed
        live = [each for each in all_contents(function.body) if id(each) in self._live]
        calls = [each for each in live if isinstance(each, ccode.Call)]
        names = [each for each in live if isinstance(each, ccode.NameReference)]
        variables = [each for each in live if isinstance(each, ccode.Variable)]
        own = [call.callee for call in calls if call.callee is not None and call.callee.body is not None]
        own += [function for call in calls for function in self._pointed.get(id(call), ())]
        others = [self._call(call) for call in calls if call.callee is None or call.callee.body is None]
        others += [self._use(str(each.name), 2) for each in names]
        return Taken(_frame(variables), own, max(others, default=0))

    def _call(self, call: ccode.Call) -> int:
        """Bytes of stack of a call of a platform function."""
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
    """Bytes of local variables on the stack: arrays, records, addressed ones, and others that exceed the registers."""
    lying, others = list[ccode.Variable](), list[ccode.Variable]()
    for variable in variables:
        use = variable.valueType
        large = use is not None and (bool(use.arrayDims) or (isinstance(use.declaration, ccode.Record) and not use.pointerDepth))
        (lying if large or any(way(each) == "address" for each in variable.references) else others).append(variable)
    return local_bytes(lying) + max(0, local_bytes(others) - REGISTERS)


def depth(plan: migration.MigrationPlan, code: CompiledCode, pieces: Iterable[platform.Adapter], *, serial: bool) -> int:
    """Bytes of stack that the program takes at most, as far as the models tell: deepest call chain plus interrupts.

    Args:
        plan: the plan, complete.
        code: what a compiler keeps of its program.
        pieces: the adapter pieces of the program.
        serial: whether the program uses the core's serial line.
    """
    program = _Program(plan, code)
    mains = [main for unit in (plan.program.units if plan.program is not None else ()) if (main := main_of(unit)) is not None]
    deepest = max((deepest_chain(main, program.taken_by, FRAME) for main in mains), default=0)
    return START + max(deepest, program.turns) + interrupt_bytes(pieces, serial=serial)


def unfollowed(code: CompiledCode) -> tuple[int, ...]:
    """Lines of the calls through pointers whose functions are not known, which `depth` therefore does not contain."""
    calls = [each for each in code.elements if isinstance(each, ccode.Call) and not code.pointed.get(id(each), [each])]
    return tuple(dict.fromkeys(int(call.line) for call in calls))


def _bytes(piece: platform.Adapter, places: int) -> int:
    """Bytes of stack of a piece that is called at so many places (inlined at one): measured, else per nested call."""
    if piece.stackBytes < 0:
        return CALL * (1 + max((len(closure([each])) for each in piece.needs), default=0))
    return int(piece.inlinedStackBytes if places == 1 else piece.stackBytes)


def measured_stacks(filled: Iterable[tuple[str, list[platform.Adapter]]]) -> dict[str, int]:
    """Name of a platform's function -> measured bytes of stack of a call of its adapter; functions not measured are left out.

    Args:
        filled: names with the pieces that each needs, its own last.
    """
    return {name: int(pieces[-1].stackBytes) for name, pieces in filled if pieces and pieces[-1].stackBytes >= 0}


def interrupt_bytes(pieces: Iterable[platform.Adapter], *, serial: bool = False) -> int:
    """Bytes that nested interrupts take on the current stack: the core's, and those of the pieces.

    Args:
        pieces: pieces of adapter files, each as often as you like.
        serial: whether the program contains the driver of the core's serial line.
    """
    found: dict[str, HandlerBytes] = {"": HandlerBytes(SERIAL_INTERRUPT if serial else CORE_INTERRUPT, -1)}
    for each in (interrupt for piece in pieces for interrupt in piece.interrupts):
        known = found.get(str(each.vector), HandlerBytes(0, -1))
        found[str(each.vector)] = HandlerBytes(max(known.most, each.stackBytes), max(known.open, each.openBytes))
    return upon_each_other(found.values())
