"""What `MIGRATION.md` says: what is left to do, what became of each element, how the new hardware is wired.

The report says what the plan says, all of it; the counts per unit add up to the number of its elements.
"""

from __future__ import annotations

from collections import Counter
from typing import Any

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import Q, ancestor_of_kind
from robosmi.transformations.queries.plan import call_sites, called, element_title, open_choices
from robosmi.transformations.queries.plan_adapters import limits
from robosmi.transformations.queries.text_changes import CARRIED_OVER

RELATIONS = {"oneToOne": "1:1", "oneToMany": "1:n", "manyToOne": "n:1", "semantic": "semantic"}
"""How calls correspond -> how the paper writes it (3.4)."""
WHO = {"nobody": "open", "rule": "rule", "history": "history", "person": "you", "defaultValue": "default"}


def report(plan: migration.MigrationPlan) -> dict[str, Any]:
    """The report of a plan."""
    sites = call_sites(plan)
    return {
        "name": plan.name,
        "called": called(plan),
        "source": plan.source.name if plan.source else "its platform",
        "board": plan.board.title if plan.board else "the target",
        "summary": (
            f"{len(plan.dispositions)} elements were judged. "
            f"{sites['total']} calls go to {len(plan.adapterUses)} platform functions; "
            f"{sites['with_body']} of them reach an adapter with a body, {sites['todo']} one that is still to be written. "
            f"{len(open_choices(plan))} choices are open."
        ),
        "tasks": [_said(t) for t in plan.tasks],
        "findings": [_said(f) for f in plan.findings],
        "wiring": [_wire(c, plan) for c in plan.connections],
        "ports": [_port(b) for b in plan.portBindings],
        "flows": bool(plan.portFlows),
        "kept": [
            {"name": f.name, "ports": ", ".join(b.name for b in f.bindings) or "any", "why": "; ".join(f.evidence)}
            for f in plan.portFlows
            if f.choice == "source"
        ],
        "libraries": [_library(c) for c in plan.libraryChoices],
        "groups": [_group(u, plan) for u in (plan.program.units if plan.program else [])] + _outside(plan),
        "adapters": [_adapter(a) for a in plan.adapterUses],
        "filled": any(a.adapter is not None or a.reason for a in plan.adapterUses),
    }


def _said(task: migration.PlanTask) -> dict[str, Any]:
    place = f"{task.path.rpartition('/')[2]}{f':{task.line}' if task.line else ''}" if task.path else ""
    return {
        "tick": "x" if task.done else " ",
        "message": task.message,
        "rule": task.rule,
        "place": place,
        "effort": task.effort,
        "fix": task.fix,
        "severity": task.severity.name,
    }


def _wire(connection: migration.Connection, plan: migration.MigrationPlan) -> dict[str, str]:
    ports = [b.name for b in plan.portBindings if b.connection is connection]
    return {
        "pin": connection.pin.label if connection.pin else "",
        "component": connection.component.title if connection.component else "",
        "connectors": ", ".join(c.name for c in connection.connectors),
        "via": ", ".join(c.title for c in connection.via),
        "name": connection.name,
        "ports": ", ".join(ports) or "none",
    }


def _port(binding: migration.PortBinding) -> dict[str, str]:
    return {
        "name": binding.name,
        "pin": f"P{binding.sourcePin}" if binding.sourcePin >= 0 else "",
        "names": ", ".join(n for n in dict.fromkeys([binding.name, *binding.names]) if n != f"P{binding.sourcePin}"),
        "component": binding.connection.component.title if binding.connection and binding.connection.component else "",
        "target": _target(binding),
        "what": binding.what,
        "choice": binding.choice,
        "by": WHO[binding.chosenBy.name],
        "why": "; ".join(binding.evidence),
    }


def _target(binding: migration.PortBinding) -> str:
    pin = binding.connection.pin if binding.connection is not None else binding.pin
    return pin.label if pin is not None else "not wired" if not binding.open else "open: its calls do nothing"


def _library(choice: migration.LibraryChoice) -> dict[str, str]:
    unused = choice.chosen is not None and not choice.included
    return {
        "component": choice.component.title if choice.component else "",
        "choice": (choice.choice or "open") + ", which nothing in the program uses" * unused,
        "by": WHO[choice.chosenBy.name],
        "candidates": ", ".join(o.label for o in list(choice.options)[:5]),
    }


def _group(unit: ccode.SourceUnit, plan: migration.MigrationPlan) -> dict[str, Any]:
    mine = Q(plan.dispositions).select(lambda d: d.element is not None and ancestor_of_kind(d.element, ccode.SourceUnit) is unit)
    rows = [
        {"line": d.element.line, "element": element_title(d.element), "action": d.action.name, "reason": _why(d)}
        for d in sorted(mine, key=lambda d: d.element.startOffset if d.element else 0)
        if d.element is not None
    ]
    return _with_counts(unit.path.rpartition("/")[2], mine, rows)


def _why(disposition: migration.Disposition) -> str:
    """The reason of a verdict; what was judged to stay is rewritten all the same where a port in it has another pin now."""
    moved = disposition.action is migration.Action.rewrite and CARRIED_OVER.issuperset(disposition.rules)
    return "; ".join([*disposition.reasons, *(["a port in it is another one on the target"] if moved else [])])


def _outside(plan: migration.MigrationPlan) -> list[dict[str, Any]]:
    """What the program uses and does not declare, at the line of its first use."""
    externals = {id(e): e for e in (plan.program.externals if plan.program else [])}
    mine = Q(plan.dispositions).select(lambda d: id(d.element) in externals)
    rows = []
    for disposition in mine:
        external = externals[id(disposition.element)]
        uses = [*(external.calls if isinstance(external, ccode.Function) else []), *external.references]
        line = min((use.line for use in uses), default=0)
        rows.append(
            {
                "line": line,
                "element": element_title(external),
                "action": disposition.action.name,
                "reason": "; ".join(disposition.reasons),
            }
        )
    return [_with_counts("used and declared elsewhere (line of the first use)", mine, rows)] if rows else []


def _with_counts(title: str, mine: Q[migration.Disposition], rows: list[dict[str, Any]]) -> dict[str, Any]:
    counts = Counter(d.action.name for d in mine)
    summed = ", ".join(f"{count} {action}" for action, count in sorted(counts.items()))
    return {"title": title, "counts": f"{len(mine)} elements: {summed}.", "rows": rows}


def _adapter(adapter: migration.AdapterUse) -> dict[str, Any]:
    header = ancestor_of_kind(adapter.function, platform.Header) if adapter.function else None
    piece = adapter.adapter
    return {
        "signature": adapter.signature, "header": header.name if header else "unknown", "calls": len(adapter.calls),
        "state": adapter.status.name, "kind": RELATIONS[piece.adapterKind.name] if piece is not None else "",
        "fidelity": piece.fidelity if piece is not None else "written by you" if adapter.written else adapter.reason,
        "limits": "; ".join(limits(adapter)),
    }  # fmt: skip
