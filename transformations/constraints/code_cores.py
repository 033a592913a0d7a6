"""Constraints on what a single-core target with other registers lacks: the source's registers, code on other cores, busy
waiting.

Platform libraries that use other cores are reported when the program is read (RS108); this is about the program's own code.
"""

from __future__ import annotations

from collections import Counter

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.constraints.code_move import FLOW, move, moved, place, the_move, together
from robosmi.transformations.queries.flows.cores import reached, written
from robosmi.transformations.queries.own_headers import own_macro
from robosmi.transformations.queries.plans.plan import called
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.programs.main_program import main_function
from robosmi.validate import Fail


def has_fewer_cores() -> bool:
    """Whether the program moves from a platform with several cores to one with a single core."""
    m = move()
    return m is not None and m.source.hasCogs and not m.target.hasCogs


def is_register(use: ccode.NameReference | ccode.MacroUse) -> bool:
    """Whether a name that the program does not declare is a register of the source platform."""
    m = move()
    if m is None or m.register(use.name) is None or own_macro(ancestor_of_kind(use, ccode.SourceUnit), use.name) is not None:
        return False
    if isinstance(use, ccode.MacroUse):
        return use.macro is None
    return use.target is None or isinstance(use.target, ccode.ExternalSymbol)


def is_lost_register(use: ccode.NameReference | ccode.MacroUse) -> bool:
    """Whether a name is a register of the source platform that a placeholder stands for; where the platform stays none does."""
    return is_register(use) and use.name not in the_move().served and not retains_platform(the_move().plan)


def starts_code(call: ccode.Call) -> bool:
    """Whether a call starts code on another core that the target lacks, and the plan does not run it as a coroutine."""
    if not has_fewer_cores() or id(call) not in the_move().cores.starts:
        return False
    shared = the_move().plan.concurrency
    return shared is None or all(call is not start for start in shared.starts)


def may_wait(loop: ccode.Loop) -> bool:
    """Whether a loop's condition may depend on code on other cores, which will not run meanwhile on the target."""
    alone = has_fewer_cores() and the_move().plan.concurrency is None
    return alone and loop.condition is not None and not loop.endless and bool(the_move().cores.elsewhere)


references = moved.context(ccode.NameReference, guard=is_lost_register)
expanded = moved.context(ccode.MacroUse, guard=is_lost_register)
starts = moved.context(ccode.Call, guard=starts_code)
loops = moved.context(ccode.Loop, guard=may_wait)
units = moved.context(ccode.SourceUnit, guard=lambda _: move() is not None)


def _register(use: ccode.NameReference | ccode.MacroUse) -> Fail:
    m = the_move()
    meaning = m.register(use.name)
    said = f" ({meaning})" if meaning else ""
    return Fail(f"{use.name} is a register of {m.source.name}{said}; its placeholder on the target has no effect")


def _own_functions() -> str:
    """The advice for a register: use functions of the target, some of which are named."""
    some = ", ".join(the_move().target.pinFunctions)
    return f"replace it with functions of the target{f' ({some} ...)' if some else ''}"


@references.constraint(
    id="RS320", severity=Severity.warning, location=place,
    advice=_own_functions,
    guard=lambda r: int(r.startOffset) not in the_move().expansions,
)  # fmt: skip
def IsNoRegister(reference: ccode.NameReference) -> bool | Fail:
    """No register of the source platform is used without an adapter."""
    return _register(reference)


@expanded.constraint(
    id="RS320", severity=Severity.warning, location=place,
    advice=_own_functions,
)  # fmt: skip
def StandsForNoRegister(use: ccode.MacroUse) -> bool | Fail:
    """No macro for a register of the source platform is used without an adapter."""
    return _register(use)


@starts.constraint(
    id="RS321", severity=Severity.warning, location=place,
    advice=lambda: f"call it from {the_move().loop}, in steps that do not wait",
)  # fmt: skip
def RunsOnItsOwn(call: ccode.Call) -> bool | Fail:
    """The program starts no code on another core."""
    start = the_move().cores.starts[id(call)]
    what = f"'{start.function}'" if start.function else "code"
    return Fail(f"{start.via} starts {what} on its own core; the target has one core")


@units.critique(
    id="RS325", info=True, location=place,
    advice="measure the stacks on the board if memory is tight; COG_STACK in adapters.h sets their size",
)  # fmt: skip
def TakesNoTurns(unit: ccode.SourceUnit) -> bool | Fail:
    """The program starts no code that runs as a coroutine beside main."""
    shared = the_move().plan.concurrency if move() is not None else None
    starts = [call for call in shared.starts if ancestor_of_kind(call, ccode.SourceUnit) is unit] if shared is not None else []
    if shared is None or not starts:
        return True
    names = ", ".join(f"'{function.name}'" for function in shared.functions) or "code"
    taken = shared.slots * shared.stackBytes
    board = the_move().plan.board
    chip = board.microcontroller if board is not None else None
    of = f" of {chip.ramBytes}" if chip is not None and chip.ramBytes else ""
    places = len({(change.unit, change.startOffset) for change in shared.changes if "yield" in change.replacement})
    gives = f"; yield() is inserted in {quantity(places, 'place')} where the program waits without a call" if places else ""
    turns = "take" if len(shared.functions) > 1 else "takes"
    return together(
        f"{names} {turns} turns with main: at most {shared.slots} at once, each with a stack of {shared.stackBytes} bytes "
        f"({taken}{of} bytes of RAM); while one is busy, the others stop{gives}",
        starts,
    )


@units.critique(id="RS322", info=True, location=place, advice="split the wait into steps that do not block")
def DoesNotWait(unit: ccode.SourceUnit) -> bool | Fail:
    """The main loop does not wait where other work has to go on meanwhile."""
    cores = the_move().cores
    main = main_function(unit)
    repeated = [s.body for s in main.body.statements if isinstance(s, ccode.Loop) and s.endless] if main and main.body else []
    done = {id(e): e for e in reached(repeated)}.values()
    blocking = cores.blocking - the_move().giving_way
    calls = [e for e in done if isinstance(e, ccode.Call) and e.calleeName in blocking and not e.viaMacro]
    busy = filter(_is_busy, done) if the_move().plan.concurrency is None else ()  # else these were given a yield
    waits = sorted((*calls, *busy), key=lambda e: int(e.startOffset))
    elsewhere = cores.starts or any(name in the_move().to_write for name in cores.by_libraries)
    if not waits or not elsewhere:
        return True
    counted = Counter(str(w.calleeName) if isinstance(w, ccode.Call) else "a loop without a body" for w in waits)
    names = ", ".join(f"{name} ({count})" if count > 1 else name for name, count in counted.most_common())
    return together(f"the endless loop waits in {names} and stops the code of other cores meanwhile", waits)


def _is_busy(element: Element) -> bool:
    """Whether an element is a busy-waiting loop: an empty body, and a condition on a register or a function outside the
    program.
    """
    if not isinstance(element, ccode.Loop) or element.condition is None or element.endless:
        return False
    body = element.body
    if not isinstance(body, ccode.EmptyStatement) and not (isinstance(body, ccode.Block) and not body.statements):
        return False
    condition = (element.condition, *all_contents(element.condition))
    outside = (e for e in condition if isinstance(e, ccode.Call) and e.callee is not None and not e.callee.definition)
    return any(outside) or any(isinstance(e, ccode.NameReference) and is_register(e) for e in condition)


@loops.constraint(
    id="RS323", severity=Severity.warning, location=place,
    advice=lambda: f"test the condition in each pass of {the_move().loop}, which also does the other work",
)  # fmt: skip
def EndsByItself(loop: ccode.Loop) -> bool | Fail:
    """No loop waits for a change that only code on another core can make."""
    elsewhere = the_move().cores.elsewhere
    assert loop.condition is not None  # says the guard
    condition = [loop.condition, *all_contents(loop.condition)]
    if any(isinstance(e, (ccode.Call, ccode.Assignment)) for e in condition):
        return True
    names = [e.target for e in condition if isinstance(e, ccode.NameReference)]
    variables = [v for v in names if isinstance(v, ccode.Variable)]
    if len(variables) < len([n for n in names if not isinstance(n, ccode.EnumerationLiteral)]):
        return True
    inside = reached([*condition, loop.body, loop.step if isinstance(loop, ccode.For) else None])
    leaves = any(isinstance(e, (ccode.Break, ccode.Return, ccode.Goto)) for e in inside)
    changed = written(inside)
    waited = [v for v in variables if id(v) in elsewhere]
    ends = leaves or not waited or any(id(v) in changed for v in variables)
    said = f"this loop ends when code on another core changes '{waited[0].name}'; the target has one core" if waited else ""
    return ends or Fail(said, **{FLOW: (loop, *the_move().cores.way_to(waited[0]))})


@units.critique(id="RS324", info=True, location=place, advice="nothing, or include it in the source")
def IncludesWhatItUses(unit: ccode.SourceUnit) -> bool | Fail:
    """The program includes the standard headers that it uses, instead of getting them through a header of the platform."""
    m = the_move()
    view = m.view(unit)
    added = [h for h in m.added_headers if h not in view.includes]
    first: dict[str, ccode.Located] = {}
    names: dict[str, list[str]] = {h: [] for h in added}
    for function in view.called().values() if added else ():
        if function.header in names and function.calls:
            names[function.header].append(function.name)
            first.setdefault(function.header, function.calls[0])
    said = [f"{', '.join(names[h])} (<{h}>)" for h in added if names[h]]
    return not said or together(
        f"the program does not include the headers of {'; '.join(said)}; the {called(m.plan)} includes them",
        sorted(first.values(), key=lambda e: int(e.startOffset)),
    )
