"""Derives the tasks and findings of a plan from its decisions: what is left for the user, and what is worth knowing.

A table of functions, each of which makes the tasks of one kind. Findings of the readers are added as they are. The severity of
a task is that of the work, not of a fault: a task never makes a run fail.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding
from robosmi.metamodels import ccode, hardware, migration
from robosmi.model.elements.strict import enum_literal
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts
from robosmi.transformations.m2m.adapters.adapter_choice import NO_ADAPTER, settle_libraries, settle_use
from robosmi.transformations.m2m.choices.library_choice import NO_LIBRARY
from robosmi.transformations.m2m.choices.plan_checks import plan_checks
from robosmi.transformations.m2m.language.source_assembler import LEFT_OUT
from robosmi.transformations.m2m.moved_choices import update_move
from robosmi.transformations.m2m.partition.text_changes import settle_bindings
from robosmi.transformations.queries.adapter_signature import target_signature
from robosmi.transformations.queries.names import name_of
from robosmi.transformations.queries.plans.binding_edits import binding_links, referred, trace_binding
from robosmi.transformations.queries.plans.motors import pins_for_motors
from robosmi.transformations.queries.plans.plan import called, is_at_declaration, needs_own_types
from robosmi.transformations.queries.plans.port_pins import NOT_WIRED, PIN_RULE, WITHOUT_PIN, bound_pin, source_name
from robosmi.transformations.queries.plans.retained_pins import UNWIRED, ignores_unwired, lost_pin_calls, proposed
from robosmi.transformations.queries.plans.verdicts import UNDEFINED, body_effort, unserved_headers
from robosmi.transformations.queries.portability.analysed_program import DIFFERS
from robosmi.transformations.queries.ports.idle_ports import is_idle
from robosmi.transformations.queries.ports.macro_calls import MacroCalls
from robosmi.transformations.queries.source_text import SourceText

_BARE_KEY = re.compile(r"[\w-]+")
"""A TOML key that needs no quotation marks."""
_PORT = re.compile(r"plan!PortBinding //@portBindings\.(\d+)")
"""The address of a port's decision in findings of constraints."""
WIRING = "RS347"
"""The rule of the task to approve a proposed wiring."""
Task = migration.PlanTask
Level = migration.SeverityLevel


def plan_tasks(plan: migration.MigrationPlan) -> list[migration.PlanTask]:
    """All tasks of a plan, in the order of the table and then of the plan."""
    return [task for maker in _MAKERS for task in maker(plan)]


def plan_findings(plan: migration.MigrationPlan, read: list[Finding], paths: Mapping[str, str]) -> list[migration.PlanFinding]:
    """The findings of readers and checks as part of the plan, without those about other cores that adapters resolve.

    Args:
        plan: the plan, complete but for its findings and tasks.
        read: findings of readers, mappings and constraints.
        paths: path as the user gave it -> path in the plan's folder.
    """
    components = {c.elementId: c for c in plan.circuit.components} if plan.circuit is not None else {}
    kept = {*paths.values()}
    return [
        migration.PlanFinding(
            rule=f.rule, severity=enum_literal(Level, f.severity.name), message=f.message, fix=f.fix or "",
            path=_stored(f.location.path, paths, kept) if f.location else "",
            line=(f.location.line or 0) if f.location else 0, column=(f.location.column or 0) if f.location else 0,
            elements=[e for e in (components.get(str(f.evidence.get("model_index", ""))), _port(plan, f)) if e is not None],
        )
        for f in read
        if not _adapted(f, plan)
    ]  # fmt: skip


def _port(plan: migration.MigrationPlan, finding: Finding) -> migration.PortBinding | None:
    """The port that a constraint's finding is about."""
    about = _PORT.fullmatch(finding.element or "")
    return list(plan.portBindings)[int(about[1])] if about is not None else None


def _adapted(finding: Finding, plan: migration.MigrationPlan) -> bool:
    """Whether a finding is about functions that run on other cores of the source, all of which now have adapters with bodies."""
    if finding.rule != "RS108":
        return False
    left = {str(use.name) for use in plan.adapterUses if use.status is migration.AdapterStatus.todo and not use.written}
    return left.isdisjoint(finding.listed("functions") if "functions" in finding.evidence else left)


def _stored(path: str, paths: Mapping[str, str], kept: set[str]) -> str:
    """The path of a file inside the plan's folder, given the user's path or the stored one."""
    return path if path in kept else paths.get(path, path.rpartition("/")[2])


def settle(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> None:
    """Make a plan that the user may have edited consistent: references decide, and recorded choices, texts and tasks follow
    them.

    Args:
        plan: the plan; decisions whose reference differs from their recorded choice become the person's.
        sources: path of a unit -> its bytes.

    Raises:
        ModelError: a port cannot be written as the pin that it is bound to.
    """
    links = binding_links(plan)
    for binding in plan.portBindings:
        choice = referred(binding)
        if binding.connection is not None and binding.connection.pin is not binding.pin:
            binding.pin = binding.connection.pin
        if binding.choice not in WITHOUT_PIN or choice:
            _settle(binding, choice)
            trace_binding(binding, links)
    for library in plan.libraryChoices:
        if library.choice != NO_LIBRARY or library.chosen is not None:
            _settle(library, library.chosen.name if library.chosen is not None else "")
    settle_libraries(plan)
    settle_bindings(plan, [SourceText(u, sources[u.path], ()) for u in plan.program.units] if plan.program else [])
    settle_tasks(plan)
    update_move(plan)


def settle_tasks(plan: migration.MigrationPlan) -> None:
    """Derive a plan's tasks and checks anew, after bringing the uses of functions in line with their adapters and bodies."""
    unserved = [header.reason for header in plan.target.unsupportedHeaders] if plan.target is not None else []
    for use in plan.adapterUses:
        settle_use(use, unserved)
    kept = [t for t in plan.tasks if t.rule not in DERIVED]
    plan.tasks.clear()
    plan.tasks.extend([*plan_tasks(plan), *kept])
    plan.checks.clear()
    plan.checks.extend(plan_checks(plan))


def _settle(decision: migration.Decision, choice: str) -> None:
    if decision.choice != choice:
        decision.choice, decision.confidence = choice, 1.0
        decision.chosenBy = migration.ChosenBy.person if choice else migration.ChosenBy.nobody
        decision.evidence.clear()
        if choice:
            decision.evidence.append("in the stored plan")
        decision.open = not choice


DERIVED = frozenset({"RS330", "RS331", "RS401", "RS501", "RS502", "RS503", "RS504", PIN_RULE, DIFFERS, WIRING})
"""Rules whose tasks follow from decisions and are derived anew when a decision changes."""


def _place(element: ccode.Located | None) -> dict[str, object]:
    unit = ancestor_of_kind(element, ccode.SourceUnit) if element is not None else None
    if element is None or unit is None:
        return {}
    return {"path": unit.path, "line": element.line, "column": element.column}


def _where(plan: migration.MigrationPlan, adapter: migration.AdapterUse) -> str:
    """The name of the file that contains the adapter."""
    beside = is_at_declaration(adapter) or needs_own_types(adapter)
    return f"in the {called(plan)}" if beside else "in adapters.h"


_OPEN = (migration.AdapterStatus.todo, migration.AdapterStatus.unsupported)


def _adapters(plan: migration.MigrationPlan) -> Iterator[Task]:
    of_macros = MacroCalls(plan)
    for adapter in plan.adapterUses:
        if adapter.adapter is not None or adapter.status not in _OPEN:
            continue
        calls = [*adapter.calls, *of_macros.of(adapter)]
        count = len(calls)
        reason = adapter.reason if adapter.function is not None else "none of the given files defines it"
        why = f"; {reason}" if reason not in ("", NO_ADAPTER) else ""
        yield Task(
            rule="RS501",
            severity=Level.warning,
            message=f"write the body of '{target_signature(adapter)}', called {quantity(count, 'time')}{why}",
            effort=body_effort(adapter),
            fix=f"{_where(plan, adapter)}: implement '{adapter.signature}' for the target"
            + ("; or also give the file that defines it" if adapter.function is None else ""),
            elements=[adapter, *calls],
            **_place(_declared(plan, adapter) or (calls[0] if calls else None)),  # type: ignore[arg-type]
        )


def _declared(plan: migration.MigrationPlan, adapter: migration.AdapterUse) -> ccode.Function | None:
    """Where the program declares a function whose body the user has to write there."""
    units = plan.program.units if plan.program is not None and is_at_declaration(adapter) else ()
    own = (d for unit in units for d in unit.declarations if isinstance(d, ccode.Function) and d.name == adapter.name)
    return next(own, None)


def _symbols(plan: migration.MigrationPlan) -> Iterator[Task]:
    unserved = unserved_headers(plan)
    for symbol in plan.symbolUses:
        if symbol.status is not migration.AdapterStatus.todo:
            continue
        header = symbol.symbol.header if symbol.symbol is not None else None
        meaning = symbol.symbol.meaning if symbol.symbol is not None else ""
        yield Task(
            rule="RS502",
            severity=Level.warning,
            message=f"implement the placeholder of '{symbol.name}'{f': {meaning}' if meaning else ''}",
            effort="large" if header is not None and header.name in unserved else "small",
            fix="in adapters.h",
            elements=[symbol, *symbol.uses],
            **_place(symbol.uses[0] if symbol.uses else None),  # type: ignore[arg-type]
        )


def _undefined(plan: migration.MigrationPlan) -> Iterator[Task]:
    """Tasks for variables that the program declares and none of the given files defines."""
    for disposition in plan.dispositions:
        variable = disposition.element
        if isinstance(variable, ccode.Variable) and not UNDEFINED.isdisjoint(disposition.rules):
            yield Task(
                rule="RS502",
                severity=Level.warning,
                message=f"give '{variable.name}' a value: none of the given files defines it",
                effort="small",
                fix="where it is declared; or also give the file that defines it",
                elements=[disposition],
                **_place(variable),  # type: ignore[arg-type]
            )


def _bindings(plan: migration.MigrationPlan) -> Iterator[Task]:
    waits = "do nothing" if ignores_unwired(plan) else "change any register: do not run the sketch"
    for binding in plan.portBindings:
        if not binding.open:
            continue
        others = [*binding.names, *([source_name(binding)] if binding.sourcePin >= 0 and not binding.names else [])]
        others = [name for name in others if name != binding.name]
        pin = f" ({', '.join(others)})" if others and binding.origin != "convention" else ""
        what = f", {binding.what}," if binding.what else ""
        key = binding.name if _BARE_KEY.fullmatch(binding.name) else f"'{binding.name}'"
        options = [o.label for o in binding.options]
        yield Task(
            rule="RS330",
            severity=Level.warning if options else Level.info,
            message=f"choose the target pin of port '{binding.name}'{pin}{what}"
            + (f"; candidates: {', '.join(options)}" if options else "; no part in the drawing fits")
            + (f"; until then its calls {waits}" if plan.portFlows else ""),
            effort="small",
            fix=f'--bind {key}=PIN, or [bind] {key} = "PIN" in robosmi.toml'
            + (f" ({NOT_WIRED}: not wired)" if plan.portFlows else ""),
            elements=[binding],
            **_place(binding.element),  # type: ignore[arg-type]
        )


def _proposed(plan: migration.MigrationPlan) -> Iterator[Task]:
    """The task to approve the pins that are proposed without a drawing."""
    found = proposed(plan)
    if found:
        shown = ", ".join(f"{b.name}{f' ({source_name(b)})' * (b.name != source_name(b))} on {b.choice}" for b in found)
        yield Task(
            rule=WIRING, severity=Level.warning, effort="small", message=f"check the proposed wiring, and wire it so: {shown}",
            fix='other pins with --bind NAME=PIN, or [bind] NAME = "PIN" in robosmi.toml; tick this when it is right',
            elements=[*found], **_place(found[0].element),  # type: ignore[arg-type]
        )  # fmt: skip


def _libraries(plan: migration.MigrationPlan) -> Iterator[Task]:
    for choice in plan.libraryChoices:
        if choice.open and choice.component is not None:
            title = choice.component.title
            best = [o.label for o in list(choice.options)[:3]]
            yield Task(
                rule="RS401",
                severity=Level.info,
                message=f"choose a library for '{title}', or none; best ranked: {', '.join(best) or 'none'}",
                effort="small",
                fix=f'--library "{title}=LIBRARY" (or {NO_LIBRARY}), or [libraries] in robosmi.toml',
                elements=[choice],
            )


def _assembler(plan: migration.MigrationPlan) -> Iterator[Task]:
    """Tasks for the source's inline assembler: one for each function, and one for each file with some outside of functions."""
    left: dict[ccode.Function | ccode.SourceUnit, list[migration.Disposition]] = {}
    for disposition in plan.dispositions:
        element = disposition.element
        if element is None or LEFT_OUT not in disposition.rules:
            continue
        function, unit = ancestor_of_kind(element, ccode.Function), ancestor_of_kind(element, ccode.SourceUnit)
        around = function if function is not None else unit
        if around is not None:
            left.setdefault(around, []).append(disposition)
    for around, found in left.items():
        where = f" in '{around.name}'" if isinstance(around, ccode.Function) else ""
        pieces = f" ({len(found)} pieces, the first here)" if len(found) > 1 else ""
        yield Task(
            rule="RS503", severity=Level.warning, effort="medium",
            message=f"assembler{where} was left out{pieces}: {'; '.join(found[0].reasons)}",
            fix=f"write it in C in the {called(plan)}, which has its text as a comment",
            elements=found,
            **_place(found[0].element),  # type: ignore[arg-type]
        )  # fmt: skip


def _unsupported(plan: migration.MigrationPlan) -> Iterator[Task]:
    for disposition in plan.dispositions:
        if LEFT_OUT in disposition.rules:
            continue
        if disposition.action is migration.Action.unsupported and disposition.element is not None:
            element = disposition.element
            name = element.header if isinstance(element, ccode.Include) else name_of(element)
            yield Task(
                rule="RS503", severity=Level.warning, effort="small" if "unknown-include" in disposition.rules else "medium",
                message=f"'{name}' was left out: {'; '.join(disposition.reasons)}",
                fix=("give its folder with -I, or " if "unknown-include" in disposition.rules else "")
                + f"add the parts that the program needs to the {called(plan)}",
                elements=[disposition],
                **_place(disposition.element),  # type: ignore[arg-type]
            )  # fmt: skip


def _unparsed(plan: migration.MigrationPlan) -> Iterator[Task]:
    """Tasks for text that is not valid C (or C++, if the target needs it): it is carried over for the user to mend."""
    unlost = lost_pin_calls(plan)
    for finding in plan.findings:
        if finding.rule == "RS101":
            yield Task(
                rule="RS504",
                severity=Level.error,
                message=f"correct the source, which is not valid C here and was copied unchanged ({finding.message})",
                effort="small",
                fix=f"correct the source and migrate it again, or correct the {called(plan)}",
                path=finding.path,
                line=finding.line,
                column=finding.column,
            )
        elif finding.rule == "RS102" and (unlost is None or (str(finding.path), int(finding.line)) in unlost):
            yield Task(
                rule="RS504", severity=Level.warning, effort="small", message=f"write what could not be read: {finding.message}",
                fix=finding.fix, path=finding.path, line=finding.line, column=finding.column,
            )  # fmt: skip
        elif finding.rule in ("RS312", "RS337", "RS342", "RS350", "RS351"):
            yield Task(
                rule="RS504",
                severity=Level.warning,
                message=f"rewrite this for the target's compiler: {finding.message}",
                effort="small",
                fix=finding.fix,
                path=finding.path,
                line=finding.line,
                column=finding.column,
            )


def _pins(plan: migration.MigrationPlan) -> Iterator[Task]:
    """Tasks for the places of the finished program whose pin is not the plan's, or cannot be followed."""
    for finding in plan.findings:
        if finding.rule == PIN_RULE:
            yield Task(
                rule=PIN_RULE, severity=Level.warning, effort="small", message=f"write the right pin: {finding.message}",
                fix=finding.fix, path=finding.path, line=finding.line, column=finding.column, elements=[*finding.elements],
            )  # fmt: skip


def _different(plan: migration.MigrationPlan) -> Iterator[Task]:
    """Tasks for places that behave differently on the target board, and that no rule changes."""
    for finding in plan.findings:
        if finding.rule == DIFFERS:
            yield Task(
                rule=DIFFERS, severity=Level.warning, effort="small", message=f"adapt it to the board: {finding.message}",
                fix=finding.fix, path=finding.path, line=finding.line, column=finding.column, elements=[*finding.elements],
            )  # fmt: skip


def _unwired(plan: migration.MigrationPlan) -> Iterator[Task]:
    """Tasks for the calls that give the number of a port without a pin to a core that does not check it."""
    if ignores_unwired(plan):
        return
    assert plan.source is not None
    facts = portability_facts(str(plan.source.name))
    assert facts is not None
    title, done = str(plan.board.title) if plan.board is not None else "", set[tuple[str, int]]()
    for binding in plan.portBindings:
        if bound_pin(binding) is not None:
            continue
        calls: list[ccode.Located] = [call for flow in plan.portFlows if binding in flow.bindings for call in flow.calls]
        for place in calls or [e for e in (binding.element,) if e is not None]:
            where = _place(place)
            at = (str(where.get("path", "")), int(place.line))
            if at in done:
                continue
            done.add(at)
            what = facts.kinds[UNWIRED].what.format(name=f"'{binding.name}'", target=title)
            yield Task(
                rule=DIFFERS, severity=Level.warning, effort="small", message=f"adapt it to the board: {UNWIRED}: {what}",
                fix="bind the port to a pin, or remove the call", elements=[binding], **where,  # type: ignore[arg-type]
            )  # fmt: skip


def _unused(plan: migration.MigrationPlan) -> Iterator[Task]:
    """Tasks for drawn components that no port is bound to, and for bound ports that no called function uses."""
    for binding in plan.portBindings:
        if is_idle(plan, binding) and binding.pin is not None:
            yield Task(
                rule="RS331",
                severity=Level.info,
                message=f"port '{binding.name}' is bound to {binding.pin.label}, but no called function uses it here",
                effort="small",
                fix="remove the wire, or keep it unused",
                elements=[binding],
            )
    bound = {id(pin) for b in plan.portBindings if (pin := bound_pin(b)) is not None}
    bound |= {id(b.answer.pin) for b in plan.portBindings if b.answer is not None}
    bound |= {id(pin) for pin in pins_for_motors(plan)}
    for connection in plan.connections:
        component = connection.component
        if id(connection.pin) not in bound and component is not None and component.role is not hardware.Role.Unknown:
            yield Task(
                rule="RS331",
                severity=Level.info,
                message=f"'{component.title}' ({connection.name}) is drawn, but no port of the program is bound to it",
                effort="small",
                fix="bind a port to it, or leave it unused",
                path=str(component.circuit.path) if component.circuit is not None else "",
                elements=[connection],
            )


_MAKERS: tuple[Callable[[migration.MigrationPlan], Iterator[Task]], ...] = (
    _unparsed, _adapters, _symbols, _undefined, _bindings, _proposed, _libraries, _unsupported, _assembler, _pins, _different,
    _unwired, _unused,
)  # fmt: skip
