"""What a move of a program to its target may change: the common base of these constraints, and how a plan is checked.

`moved` contains them all (`code_widths`, `code_characters`, `code_formats`, `code_cores`); `move_findings` evaluates them on a
plan whose program has views, `robosmi check` on a stored plan with its code model. Without a plan they find nothing, since what
changes depends on the target.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from contextvars import ContextVar
from functools import cached_property
from typing import TYPE_CHECKING, Any

from robosmi.diagnostics import Location
from robosmi.metamodels import ccode, migration, platform
from robosmi.model import EmfModel
from robosmi.model.elements.strict import Element, enum_literal
from robosmi.query import ancestor_of_kind
from robosmi.query.run import current_run
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_model import split_parameters
from robosmi.transformations.queries.adapter_signature import target_types
from robosmi.transformations.queries.code import CodeView, views
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.flows.cores import Cores
from robosmi.transformations.queries.numbers import Machine, Numbers
from robosmi.transformations.queries.plans.plan import preserves_main
from robosmi.transformations.queries.plans.plan_adapters import emitted
from robosmi.transformations.queries.plans.waiting_calls import ports_of_runs_bound
from robosmi.transformations.queries.ports.port_masks import PortMasks
from robosmi.transformations.queries.programs.unprototyped_functions import UnprototypedPointers, unprototyped_pointers
from robosmi.transformations.queries.resources.cooperation import giving_way
from robosmi.transformations.queries.signature_text import function_type
from robosmi.transformations.queries.values import Values
from robosmi.validate import EVL, Fail, Unsatisfied

if TYPE_CHECKING:
    from robosmi.model.elements.driver import ItemOrItems
    from robosmi.transformations.queries.constants.ranges import Ranges

moved = EVL()
"""The constraints on a program that is moved; evaluate them on its plan and its model."""

PORTS_OF_RUNS = "RS327"
"""The rule of ports that only the running program knows."""
MANY = 5
"""Up to this number the findings of a rule in a file are listed one by one; more are merged into one."""
PLACES = "places"
FLOW = "flow"
"""Key of a finding's evidence: the element and the steps that lead to it; kept only for findings about a single element."""
SAME_BYTES = "object-bytes"
"""The rule of dispositions by which a type keeps its bytes."""
_running: ContextVar[Move | None] = ContextVar("robosmi_move", default=None)
_FIXED = re.compile(r"\bu?int(?:8|16|32|64)_t\b|\bfloat\b")


class Move:
    """A plan together with the meaning of its program on both platforms: views of the units, widths of types, names.

    Args:
        plan: the plan, with a program and both platforms.
        seen: a view of each unit of the program.
    """

    def __init__(self, plan: migration.MigrationPlan, seen: Sequence[CodeView]) -> None:
        assert plan.program is not None
        assert plan.source is not None
        assert plan.target is not None
        self.plan, self.views = plan, seen
        self.told: set[int] = set()
        self.program: ccode.Program = plan.program
        self.source: platform.Platform = plan.source
        self.target: platform.Platform = plan.target
        self.here, self.there = Machine.of(plan.source), Machine.of(plan.target)

    @property
    def narrower(self) -> bool:
        """Whether int has fewer bits on the target."""
        return self.there.int_bits < self.here.int_bits

    @property
    def fixed(self) -> bool:
        """Whether the text is changed so that numbers keep the source's widths."""
        return self.plan.widths is migration.Widths.fix

    @cached_property
    def numbers(self) -> Numbers:
        """The types of the program's numeric expressions on the target."""
        functions = _functions(self.views)
        functions.update({a.name: target_types(a) for a in self.plan.adapterUses})
        sure = (s for s in self.plan.symbolUses if s.symbol is not None and s.symbol.typeName)  # the user gives the others theirs
        wide = {str(w.sourceType): str(w.targetType) for w in self.target.widths}
        declared = ((s.name, s.placeholder or wide.get(str(s.symbol.typeName), "") if s.symbol else "") for s in sure)
        symbols = {name: found[0] for name, text in declared if (found := _FIXED.search(text))}
        return Numbers(self.there, functions, symbols, self._macros)

    @cached_property
    def ranges(self) -> Ranges:
        """The value ranges of the program's expressions on the source."""
        from robosmi.transformations.queries.constants.ranges import Ranges  # few rules ask, and few programs give them cause

        functions = _functions(self.views)
        functions.update({a.name: function_type(a.signature) for a in self.plan.adapterUses})
        return Ranges(Numbers(self.here, functions, {}, self._macros), Values(self.program, self.views[0].unit), self.program)

    @cached_property
    def unprototyped(self) -> list[UnprototypedPointers]:
        """The program's pointers to functions without parameter types."""
        return unprototyped_pointers(self.program)

    @cached_property
    def with_same_bytes(self) -> frozenset[int]:
        """The identities of declarations that the plan gives the bytes that they have on the source."""
        return frozenset(id(each.element) for each in self.plan.dispositions if SAME_BYTES in each.rules)

    @cached_property
    def _macros(self) -> dict[str, str]:
        return {m.name: m.body or "" for view in self.views for m in view.unit.macros if not m.functionLike}

    @cached_property
    def signatures(self) -> dict[str, list[str]]:
        """The parameters, as in the header, of each function that the program calls and does not define, by name."""
        return {
            f.name: split_parameters(f.entry.parameters)
            for view in self.views
            for f in view.called().values()
            if f.entry is not None and f.entry.parameters
        }

    def register(self, name: str) -> str | None:
        """The description of a source platform register, empty if there is none; None if the name is not a register."""
        api = self.views[0].api
        return api.symbol_meaning(name).get("meaning", "") if api.is_register(name) else None

    @cached_property
    def expansions(self) -> set[int]:
        """Offsets where macros for registers are used; the names in their expansions are not counted as further uses."""
        uses = (u for view in self.views for u in view.of_kind(ccode.MacroUse) if u.macro is None)
        return {int(u.startOffset) for u in uses if self.register(u.name) is not None}

    @cached_property
    def served(self) -> set[str]:
        """Functions and other names of the source platform that adapters provide on the target."""
        functions = {str(use.name) for use in self.plan.adapterUses if use.adapter is not None}
        return functions | {str(use.name) for use in self.plan.symbolUses if use.adapter is not None}

    @cached_property
    def adapted(self) -> set[str]:
        """Functions of the source platform that the program calls, with an adapter or without."""
        return {str(use.name) for use in self.plan.adapterUses}

    @cached_property
    def argument_ranges(self) -> dict[str, list[platform.ArgumentRange]]:
        """Function -> the value ranges of its adapter, without those that apply only beside adapters that are not used."""
        there = {f"{piece.sourceHeader}/{piece.name}" for piece in emitted(self.plan)}
        found: dict[str, list[platform.ArgumentRange]] = {}
        for use in self.plan.adapterUses:
            if use.adapter is not None:
                found.setdefault(str(use.name), [one for one in use.adapter.ranges if not one.beside or one.beside in there])
        return found

    @cached_property
    def to_write(self) -> set[str]:
        """Functions of the source platform whose adapters the user still has to write."""
        return {str(use.name) for use in self.plan.adapterUses if use.status is migration.AdapterStatus.todo}

    @cached_property
    def giving_way(self) -> set[str]:
        """Functions that let other coroutines run while they wait; empty if the plan has no coroutines."""
        return giving_way(self.views, self.plan.adapterUses) if self.plan.concurrency is not None else set()

    @cached_property
    def cores(self) -> Cores:
        """What the program does on other cores."""
        return Cores(self.views)

    @cached_property
    def added_headers(self) -> list[str]:
        """Standard headers that the sketch includes in addition to the program's own includes."""
        marks = ((s.placeholder or "", s) for s in self.plan.symbolUses)
        return [text.removeprefix("#include <").rstrip(">") for text, _ in marks if text.startswith("#include <")]

    @cached_property
    def masks(self) -> PortMasks:
        """The bit masks of ports that the program computes."""
        return PortMasks(self.views)

    @property
    def loop(self) -> str:
        """The name of the function in which programs of the target repeat their work: `loop` or `main`."""
        return "main" if preserves_main(self.plan) else "loop"

    def view(self, unit: ccode.SourceUnit) -> CodeView:
        """The view of a unit."""
        return next(v for v in self.views if v.unit is unit)


def _functions(seen: Iterable[CodeView]) -> dict[str, FunctionType]:
    return {
        f.name: FunctionType(f.entry.detail, ())
        for view in seen
        for f in view.called().values()
        if f.entry is not None and f.entry.kind == "function"
    }


def move() -> Move | None:
    """The move that is being checked; None if the models have no plan with two platforms."""
    return _running.get()


def the_move() -> Move:
    """The move that is being checked, for constraints whose guard ensures that there is one."""
    found = move()
    assert found is not None
    return found


def is_narrower() -> bool:
    """Whether int is narrower on the target and the text is not changed to keep its width."""
    found = move()
    return found is not None and found.narrower and not found.fixed


@moved.pre
def find_the_move() -> None:
    """Prepare the move from the plan among the models, or from the views that were passed with it."""
    _running.set(None)
    for model in current_run().models:
        if isinstance(model, Given):
            _running.set(model.move)
            return
        roots = model.roots if isinstance(model, EmfModel) else ()
        for plan in roots:
            if isinstance(plan, migration.MigrationPlan) and plan.program is not None and plan.source is not None and plan.target:
                _running.set(Move(plan, views(plan.program, ApiIndex.of(plan.source))))


@moved.post
def forget_the_move() -> None:
    """Release the models after the run."""
    _running.set(None)


class Given(EmfModel):
    """A program whose units have views already; its instances are looked up there.

    Args:
        of: the move.
    """

    def __init__(self, of: Move) -> None:
        super().__init__(of.program, name="code")
        self.move = of

    def all_of_kind(self, kind: Any) -> list[Any]:
        """The instances of a class of the program's metamodel, in pre-order."""
        if kind is ccode.SourceUnit:
            return [view.unit for view in self.move.views]
        return [x for view in self.move.views for x in view.of_kind(kind)]


def place(element: ccode.Located | ccode.SourceUnit) -> Location | None:
    """The source range of an element; for a unit its file."""
    if isinstance(element, ccode.SourceUnit):
        return Location(element.path)
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    if unit is None:
        return None
    return Location(unit.path, element.line or None, element.column or None, element.endLine or None, element.endColumn or None)


def together(message: str, elements: Sequence[ccode.Located]) -> Fail:
    """A failure about several places of a unit at once; the places are kept as evidence."""
    return Fail(f"{message} ({in_lines(elements)})", **{PLACES: tuple(elements)})


def in_lines(elements: Iterable[ccode.Located]) -> str:
    """The line numbers of elements as text, without duplicates and at most eight of them."""
    lines = list(dict.fromkeys(int(e.line) for e in elements))
    shown = ", ".join(str(each) for each in lines[:8]) + (" ..." if len(lines) > 8 else "")
    return f"line{'s' * (len(lines) > 1)} {shown}"


def move_findings(plan: migration.MigrationPlan, seen: Sequence[CodeView]) -> list[migration.PlanFinding]:
    """Check the constraints on the move; findings are ordered by file and line, and many of one rule in a file are merged.

    Args:
        plan: the plan; complete but for its findings.
        seen: a view of each unit of its program.
    """
    if plan.program is None or plan.source is None or plan.target is None:
        return []
    files: dict[tuple[str, str], list[Unsatisfied]] = {}
    for one in moved.run(Given(Move(plan, seen))).unsatisfied:
        where = place(one.element) if isinstance(one.element, (ccode.Located, ccode.SourceUnit)) else None
        files.setdefault((where.path if where else "", one.constraint.id), []).append(one)
    found = []
    for (path, _), same in files.items():
        same.sort(key=lambda u: int(u.element.startOffset) if isinstance(u.element, ccode.Located) else 0)
        for some in [same] if len(same) > MANY else [[u] for u in same]:
            found.append(_finding(path, some, plan))
    return sorted(found, key=lambda f: (f.path, f.line, f.column, f.rule))


def _elements(kept: ItemOrItems) -> list[Element]:
    return [e for e in (kept if isinstance(kept, Sequence) else (kept,)) if isinstance(e, Element)]


def severity_by(plan: migration.MigrationPlan, rule: str) -> migration.SeverityLevel | None:
    """The severity that what the user decided gives a rule; None for a rule that has its own.

    Which ports a running program uses only the user knows: once one is bound, RS327 is no question any more, but the calls with
    all other numbers still do nothing.
    """
    if rule != PORTS_OF_RUNS:
        return None
    return migration.SeverityLevel.info if ports_of_runs_bound(plan) else migration.SeverityLevel.warning


def _finding(path: str, same: Sequence[Unsatisfied], plan: migration.MigrationPlan) -> migration.PlanFinding:
    first = same[0]
    rule = str(first.constraint.id)
    elements = [e for u in same for e in _elements(u.extras.get(PLACES, u.element))]
    if len(same) == 1 and FLOW in first.extras:
        elements = _elements(first.extras[FLOW])
    located = next((e for e in elements if isinstance(e, ccode.Located)), None)
    message = first.message
    if len(same) > 1:
        places = in_lines(u.element for u in same if isinstance(u.element, ccode.Located))
        message += f"; and {len(same) - 1} more of this kind in the file ({places})"
    return migration.PlanFinding(
        rule=rule, severity=severity_by(plan, rule) or enum_literal(migration.SeverityLevel, first.severity.name),
        message=message, path=path,
        fix=first.advice or "", line=located.line if located is not None else 0,
        column=located.column if located is not None else 0, elements=elements,
    )  # fmt: skip
