"""EOL-style operations on the migration plan: counts, open choices, findings, and the plan's part of the JSON contract.

A finding gets the steps by which the program arrives at its situation, and the edit of the text that corrects it. Both are
derived from the elements of the finding, since a plan stores no more, and only for rules where these suffice. The constraints
decide what is found.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from typing import Any

from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding, FlowStep, Location, Severity, Task, TextEdit
from robosmi.errors import SourceError
from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.query import Q, ancestor_of_kind
from robosmi.transformations.queries.plans.choices import choices_json
from robosmi.transformations.queries.plans.plan_adapters import limits
from robosmi.transformations.queries.plans.port_pins import NOT_WIRED, bound_pin
from robosmi.transformations.queries.ports.macro_calls import MacroCalls


def target_of(plan: migration.MigrationPlan) -> platform.Target:
    """The target of a plan, as it is stored with the plan's platforms.

    Raises:
        SourceError: the plan's models have none.
    """
    if plan.targetDescription is None:
        raise SourceError("the plan has no description of its target", fix="run migrate again")
    return plan.targetDescription


def platform_of(plan: migration.MigrationPlan) -> platform.Platform:
    """The platform that a plan's program is moved to.

    Raises:
        SourceError: the plan's models have none.
    """
    found = target_of(plan).platform
    if found is None:
        raise SourceError("the plan has no target platform", fix="run migrate again")
    return found


RUN_IN_SETUP = "run-in-setup"
"""The rule of functions that run before main on the source: the generated setup calls them first."""


def preserves_main(plan: migration.MigrationPlan) -> bool:
    """Whether programs of the plan's target begin with main, so that it stays as it is."""
    return target_of(plan).structure is platform.EntryStructure.mainFunction


def called(plan: migration.MigrationPlan) -> str:
    """What users call a program of the plan's target: a sketch if it consists of setup and loop, else a program."""
    made_for = plan.targetDescription
    return "program" if made_for is not None and made_for.structure is platform.EntryStructure.mainFunction else "sketch"


def disposition_counts(plan: migration.MigrationPlan) -> dict[str, int]:
    """How many elements each action has; every action is named."""
    counts = Counter(d.action.name for d in plan.dispositions)
    return {name: counts.get(name, 0) for name in ("retain", "adapt", "drop", "hoist", "rewrite", "unsupported")}


def header_name(adapter: migration.AdapterUse) -> str:
    """The header that declares an adapted function: the platform's, or the one that its adapter file names; `unknown` if none."""
    header = ancestor_of_kind(adapter.function, platform.Header) if adapter.function else None
    own = adapter.adapter.sourceHeader if adapter.adapter is not None else ""
    return header.name if header else own or "unknown"


def call_sites(plan: migration.MigrationPlan) -> dict[str, Any]:
    """How many calls of platform functions there are: in total, with a body, still to do; also by header.

    A call in a macro counts at each place where the macro is used.
    """
    by_header: dict[str, dict[str, int]] = {}
    of_macros = MacroCalls(plan)
    for adapter in plan.adapterUses:
        counts = by_header.setdefault(header_name(adapter), {"total": 0, "with_body": 0, "todo": 0})
        state = "with_body" if adapter.status in (migration.AdapterStatus.filled, migration.AdapterStatus.care) else "todo"
        count = len(adapter.calls) + len(of_macros.of(adapter))
        counts["total"] += count
        counts[state] += count
    total = {key: sum(c[key] for c in by_header.values()) for key in ("total", "with_body", "todo")}
    return {**total, "by_header": by_header}


def needs_own_types(adapter: migration.AdapterUse) -> bool:
    """Whether a placeholder's signature has types of the program, so that it must come after their declarations.

    False for a function that the program itself declares, which gets its body there.
    """
    types = (adapter.result, *(p.valueType for p in adapter.parameters))
    return (
        adapter.adapter is None
        and not is_at_declaration(adapter)
        and any(kind is not None and kind.declarations for kind in types)
    )


def is_at_declaration(adapter: migration.AdapterUse) -> bool:
    """Whether the placeholder of a function is put where the program itself declares that function."""
    return adapter.signatureSource is migration.SignatureSource.program and adapter.adapter is None


def decisions(plan: migration.MigrationPlan) -> Q[migration.Decision]:
    """The decisions the user may be asked for: port bindings and library choices."""
    return Q([*plan.portBindings, *plan.libraryChoices])


def open_choices(plan: migration.MigrationPlan) -> Q[migration.Decision]:
    """The decisions in which nothing is chosen."""
    return decisions(plan).select(lambda d: d.open)


def functions_carried_over(plan: migration.MigrationPlan) -> list[dict[str, Json]]:
    """The program's own functions that are in the sketch, with what became of them."""
    return [
        {"name": d.element.name, "line": d.element.line, "action": d.action.name}
        for d in plan.dispositions
        if isinstance(d.element, ccode.Function) and d.element.definition and d.action is not migration.Action.drop
    ]


def binding_json(binding: migration.PortBinding) -> dict[str, Json]:
    """A port binding in the contract's form."""
    return {
        "name": binding.name,
        "names": list(binding.names),
        "role": binding.role,
        "source_pin": binding.sourcePin if binding.sourcePin >= 0 else None,
        "signal": binding.signal.name,
        "origin": binding.origin,
        "what": binding.what,
        "connection": binding.connection.name if binding.connection else None,
        "pin": _pin(binding),
        "wired": None if binding.open else binding.choice != NOT_WIRED,
        "open": binding.open,
        "chosen_by": binding.chosenBy.name,
        "confidence": binding.confidence,
        "evidence": list(binding.evidence),
        "options": [{"label": o.label, "score": o.score, "reasons": list(o.reasons)} for o in binding.options],
    }


def _pin(binding: migration.PortBinding) -> str | None:
    pin = bound_pin(binding)
    return pin.label if pin is not None else None


def library_json(choice: migration.LibraryChoice) -> dict[str, Json]:
    """A library choice in the contract's form."""
    component = choice.component
    chosen = choice.chosen
    return {
        "component": component.title if component else "", "component_model_index": component.elementId if component else "",
        "library": chosen.name if chosen else None, "header": next(iter(chosen.headers), None) if chosen else None,
        "version": chosen.version if chosen else None, "decision": choice.recommendation, "open": choice.open,
        "chosen_by": choice.chosenBy.name, "confidence": choice.confidence,
        "candidates": [{"library": o.label, "score": o.score, "reasons": list(o.reasons)} for o in choice.options],
    }  # fmt: skip


def plan_json(plan: migration.MigrationPlan) -> dict[str, Json]:
    """The contract's `plan`."""
    of_macros = MacroCalls(plan)
    return {
        "name": plan.name,
        "target": plan.board.name if plan.board else None,
        "structure": plan.structure.name,
        "dispositions": disposition_counts(plan),
        "call_sites": call_sites(plan),
        "functions": functions_carried_over(plan),
        "adapters": [
            {
                "name": a.name,
                "signature": a.signature,
                "header": header_name(a),
                "calls": len(a.calls),
                "macro_calls": len(of_macros.of(a)),
                "status": a.status.name,
                "kind": a.adapter.adapterKind.name if a.adapter is not None else None,
                "fidelity": a.adapter.fidelity if a.adapter is not None else "",
                "limits": limits(a),
                "reason": a.reason,
            }
            for a in plan.adapterUses
        ],
        "symbols": [{"name": s.name, "status": s.status.name} for s in plan.symbolUses],
        "connections": [
            {"name": c.name, "pin": c.pin.label if c.pin else None, "component": c.component.title if c.component else None}
            for c in plan.connections
        ],
        "bindings": [binding_json(b) for b in plan.portBindings],
        "port_flows": [
            {"name": f.name, "moved": f.choice == "target", "ports": [b.name for b in f.bindings], "why": list(f.evidence)}
            for f in plan.portFlows
        ],
        "libraries": [library_json(c) for c in plan.libraryChoices],
        "choices": choices_json(plan),
        "tasks": len(plan.tasks),
        "open_choices": len(open_choices(plan)),
    }


def move_json(plan: migration.MigrationPlan) -> dict[str, Any] | None:
    """What changed since the plan for another board, as the contract's `moved`; None if there was none."""
    move = plan.move
    if move is None:
        return None
    counts = move_counts(move)
    return {
        "from": move.target, "to": plan.targetDescription.name if plan.targetDescription is not None else "",
        **{kind: counts[kind] for kind in ("kept", "proposed", "decided", "lost")}, "open": len(open_choices(plan)),
        "pins_proposed": bool(move.pinsProposed),
        "changes": [
            {"kind": c.kind.name, "subject": c.subject, "before": c.before, "after": c.after, "why": c.why} for c in move.changes
        ],
    }  # fmt: skip


def move_counts(move: migration.Move) -> Counter[str]:
    """How many choices became what when a program was moved to another board, by the names of `ChangeKind`."""
    return Counter(str(change.kind.name) for change in move.changes)


def ports_by_pin(plan: migration.MigrationPlan) -> dict[str, list[str]]:
    """The label of a pin of the target's board -> the names of the ports of the source that are bound to it."""
    found: dict[str, list[str]] = {}
    for binding in plan.portBindings:
        if (pin := bound_pin(binding)) is not None:
            found.setdefault(str(pin.label), []).append(str(binding.name))
    return found


def as_findings(entries: Q[migration.PlanTask], places: dict[str, str]) -> list[Finding]:
    """Plan tasks or plan findings as findings of a report.

    Args:
        entries: the plan's elements.
        places: stored path -> path as the user knows it.
    """
    result: list[Finding] = []
    for entry in entries:
        about = len(entry.elements) > 0
        location = _place(entry, places)
        kind = Finding if isinstance(entry, migration.PlanFinding) else Task
        evidence: dict[str, Any] = {"effort": entry.effort} if entry.effort else {}
        evidence |= {"done": True} if entry.done else {}
        if about and isinstance(entry, migration.PlanFinding):
            evidence |= next(({"component": e.title, "model_index": e.elementId} for e in _components(entry)), {})
            evidence |= next(({"port": str(e.name)} for e in entry.elements if isinstance(e, migration.PortBinding)), {})
            if len(located := _located(entry)) > 1 and not has_flow(entry):
                evidence["places"] = [[e.line, e.column, e.endLine, e.endColumn] for e in located]
        result.append(
            kind(
                entry.rule,
                Severity[entry.severity.name],
                entry.message,
                location,
                fix=entry.fix or None,
                evidence=evidence,
                steps=steps_of(entry, places) if about else (),
                edits=edits_of(entry, places) if about else (),
            )
        )
    return result


def _place(entry: migration.PlanTask, places: dict[str, str]) -> Location | None:
    """Where an entry is; the end of the range is that of the element that it is about."""
    if not entry.path:
        return None
    about = next((e for e in _located(entry) if (e.line, e.column) == (entry.line, entry.column)), None)
    end = (about.endLine or None, about.endColumn or None) if about is not None else (None, None)
    return Location(places.get(entry.path, entry.path), entry.line or None, entry.column or None, *end)


def _located(entry: migration.PlanTask) -> list[ccode.Located]:
    return [element for element in entry.elements if isinstance(element, ccode.Located)]


def _components(entry: migration.PlanTask) -> list[hardware.Component]:
    return [element for element in entry.elements if isinstance(element, hardware.Component)]


# ---- steps and edits of findings

_HEADERS = re.compile(r"\(<([^>]+)>\)")


def has_flow(entry: migration.PlanTask) -> bool:
    """Whether the elements of an entry are the steps of a flow, and not several places of one kind: RS323 of one loop."""
    kinds = [isinstance(element, ccode.Loop) for element in entry.elements]
    return entry.rule == "RS323" and len(kinds) > 1 and kinds.count(True) == 1 and kinds[0]


def steps_of(entry: migration.PlanTask, places: Mapping[str, str]) -> tuple[FlowStep, ...]:
    """The steps by which the program arrives at what a finding reports; empty if they are not known.

    Args:
        entry: a finding of the plan.
        places: stored path -> path as the user knows it.
    """
    if not has_flow(entry):
        return ()
    loop, *before = entry.elements
    found = []
    for element in [*before, loop]:
        if isinstance(element, ccode.Loop):
            said = "the loop waits for a change that never happens on one core"
        elif isinstance(element, ccode.Call):
            said = f"'{element.calleeName}' starts code on another core"
        else:
            said = "that code changes what the loop waits for"
        if isinstance(element, ccode.Located):
            found.append(FlowStep(_element_location(element, places), said))
    return tuple(found)


def edits_of(entry: migration.PlanTask, places: Mapping[str, str]) -> tuple[TextEdit, ...]:
    """The edits of the source that correct a finding; empty if no single edit does.

    Args:
        entry: a finding of the plan.
        places: stored path -> path as the user knows it.
    """
    element = next(iter(entry.elements), None)
    if entry.rule == "RS313" and isinstance(element, ccode.Binary) and len(entry.elements) == 1:
        return _wider(element, places)
    if entry.rule == "RS324" and isinstance(element, ccode.Located):
        return _included(element, entry.message, places)
    return ()


def _wider(operation: ccode.Binary, places: Mapping[str, str]) -> tuple[TextEdit, ...]:
    """An L behind a decimal number in an operation, which is then computed in 32 bits; of a shift only its left side counts."""
    sides = [operation.left] if operation.operator in ("<<", ">>") else [operation.left, operation.right]
    number = next((s for s in sides if isinstance(s, ccode.IntegerLiteral) and re.fullmatch(r"\d+", s.text or "")), None)
    if number is None or number.endLine != number.line:
        return ()
    path = _element_location(number, places).path
    end = Location(path, number.endLine, number.endColumn, number.endLine, number.endColumn)
    return (TextEdit(end, "L"),)


def _included(use: ccode.Located, message: str, places: Mapping[str, str]) -> tuple[TextEdit, ...]:
    """The directives that include the headers of a message, before the first one of the file."""
    unit = ancestor_of_kind(use, ccode.SourceUnit)
    if unit is None or not unit.includes:
        return ()
    first = min(unit.includes, key=lambda include: int(include.startOffset))
    start = Location(places.get(str(unit.path), str(unit.path)), first.line, 1, first.line, 1)
    return (TextEdit(start, "".join(f"#include <{header}>\n" for header in _HEADERS.findall(message))),)


def _element_location(element: ccode.Located, places: Mapping[str, str]) -> Location:
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    path = str(unit.path) if unit is not None else ""
    ends = (element.endLine or None, element.endColumn or None)
    return Location(places.get(path, path), element.line or None, element.column or None, *ends)
