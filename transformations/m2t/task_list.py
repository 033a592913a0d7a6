"""The values for `MIGRATION.md`: what is left to do, what became of each construct, how the new hardware is wired.

The report covers all of the plan; the counts per file add up to the number of its constructs. `first_screen` makes the first
screen, `queries.plans.verdicts` the verdicts.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

from robosmi.base.data_text import Json
from robosmi.base.quantities import quantity
from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2t.first_screen import Counted, FirstScreen, first_screen, result_in_words, task_place
from robosmi.transformations.m2t.move_text import move_text
from robosmi.transformations.queries.circuits.connector_names import displayed_names
from robosmi.transformations.queries.plans.choices import reason
from robosmi.transformations.queries.plans.moved_wires import moved_wiring
from robosmi.transformations.queries.plans.plan import called, header_name
from robosmi.transformations.queries.plans.plan_adapters import limits
from robosmi.transformations.queries.plans.port_pins import bound_pin, source_name
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.plans.verdicts import CARE, Construct, verdict_counts
from robosmi.transformations.queries.ports.macro_calls import MacroCalls

RELATIONS = {"oneToOne": "1:1", "oneToMany": "1:n", "manyToOne": "n:1", "semantic": "semantic"}
"""Kind of an adapter -> a notation for the words of the paper (5.3, RQ2)."""
WHO = {"nobody": "open", "rule": "rule", "history": "history", "person": "you", "defaultValue": "default"}


def report(plan: migration.MigrationPlan, sources: Mapping[str, bytes], known: Counted) -> dict[str, Any]:
    """The values of the report's template.

    Args:
        plan: a complete plan.
        sources: path of a unit -> its bytes.
        known: the results computed for the plan.
    """
    judged = known.judged
    verdicts = [f for f in plan.findings if f.rule in VERDICT_RULES]
    of_macros = MacroCalls(plan)
    differences = known_differences(plan)
    taken = 1 + sum(4 if f.rule in DRAWN_RULES else 2 for f in verdicts)
    taken += 3 + min(len(differences), _DIFFERENCES) if differences else 0
    screen = first_screen(plan, sources, taken, known)
    errors = [f for f in plan.findings if f.severity is migration.SeverityLevel.error and f.rule not in VERDICT_RULES]
    tasks = {(task.rule, task.path, task.line) for task in plan.tasks}
    return {
        "name": plan.name,
        "called": called(plan),
        "source": _source(plan),
        "board": plan.board.title if plan.board else "the target",
        "verdicts": [_said(f, plan) for f in verdicts],
        "drawn": DRAWN_RULES,
        "screen": screen,
        "result": result_in_words(plan, screen, len(errors))[1],
        "lists": [screen.decide, screen.write, screen.check],
        "sections": _sections(screen),
        "moved": move_text(plan),
        "conflicts": [_conflict(task) for task in plan.tasks if task.texts],
        "findings": [
            _said(f, plan) for f in by_severity(plan.findings) if f.rule not in VERDICT_RULES and not _is_task(f, tasks)
        ],
        "in_tasks": any(_is_task(finding, tasks) for finding in plan.findings),
        "wiring": [_wire(c, plan) for c in plan.connections],
        "both": moved_wiring(plan),
        "ports": [_port(b) for b in plan.portBindings],
        "flows": bool(plan.portFlows),
        "kept": _kept_numbers(plan),
        "libraries": [_library(c) for c in plan.libraryChoices],
        "counts": _counts(judged),
        "groups": [*(_group(u, judged) for u in (plan.program.units if plan.program else [])), *_outside(judged)],
        "adapters": [_adapter(a, of_macros) for a in plan.adapterUses],
        "differences": differences[:_DIFFERENCES],
        "more_differences": differences[_DIFFERENCES:],
        "filled": any(a.adapter is not None or a.reason for a in plan.adapterUses),
    }


def _source(plan: migration.MigrationPlan) -> str:
    """Where a program comes from: its board, if its platform stays, else its platform."""
    boards = [each.board for each in plan.source.boardMappings if each.board is not None] if plan.source is not None else []
    if retains_platform(plan) and boards:
        return str(boards[0].title)
    return str(plan.source.name) if plan.source is not None else "its platform"


def _kept_numbers(plan: migration.MigrationPlan) -> list[dict[str, str]]:
    """The flows of port numbers that stay unchanged in the text, each once."""
    flows = [flow for flow in plan.portFlows if flow.choice == "source"]
    rows = [(str(f.name), ", ".join(b.name for b in f.bindings) or "any", "; ".join(f.evidence)) for f in flows]
    return [{"name": name, "ports": ports, "why": why} for name, ports, why in dict.fromkeys(rows)]


def _sections(screen: FirstScreen) -> list[dict[str, Any]]:
    """The lists of the first screen, followed by their lines that did not fit."""
    lists = [each for each in (screen.decide, screen.write, screen.check) if each.first or each.rest]
    begun = [
        {"title": each.title, "hint": each.hint, "lines": each.first, "more": sum(bool(item.rule) for item in each.rest)}
        for each in lists
    ]
    rest = [{"title": f"{each.title}, continued", "hint": "", "lines": each.rest, "more": 0} for each in lists if each.rest]
    return begun + rest


VERDICT_RULES = frozenset({"RS850", "RS851", "RS852", "RS853"})
"""Rules of findings that are the verdict of comparing the generated program with the original."""
DRAWN_RULES = frozenset({"RS850", "RS851"})
"""Those rules whose finding comes with a picture of what both programs do."""
_DIFFERENCES = 3
"""Number of known differences on the first screen."""
PICTURE = "verification.svg"
"""Name of that picture's file, in the folder of the models."""


def by_severity(findings: Iterable[migration.PlanFinding]) -> list[migration.PlanFinding]:
    """Findings by severity, the worst first; those of one severity keep their order."""
    level = migration.SeverityLevel
    order = {each: -int(each.value) for each in (level.info, level.warning, level.error)}
    return sorted(findings, key=lambda f: order[f.severity])


_TASKS = {
    "RS101": "RS504", "RS312": "RS504", "RS337": "RS504", "RS342": "RS504", "RS350": "RS504", "RS351": "RS504",
    "RS103": "RS503", "RS107": "RS503", "RS109": "RS501",
}  # fmt: skip
"""Rule of a finding -> rule of the task that says the same and what to do about it."""


def _is_task(finding: migration.PlanFinding, tasks: Collection[tuple[str, str | None, int]]) -> bool:
    """Whether a task says the same as a finding, so that the report omits the finding."""
    rule = _TASKS.get(str(finding.rule))
    return rule is not None and (rule, finding.path, finding.line) in tasks


def _said(task: migration.PlanTask, plan: migration.MigrationPlan) -> dict[str, Json]:
    severity = task.severity
    return {
        "message": task.message,
        "rule": task.rule,
        "place": task_place(plan, task),
        "fix": task.fix if severity is not migration.SeverityLevel.info else "",
        "severity": severity.name,
    }


def _conflict(task: migration.PlanTask) -> dict[str, Json]:
    """The place of a merge conflict, and its two sides as lines."""
    yours, _, made = ([*text.split("\n")] for text in task.texts)
    return {"path": task.path, "line": task.line, "yours": [*yours], "made": [*made]}


def _wire(connection: migration.Connection, plan: migration.MigrationPlan) -> dict[str, str]:
    ports = [b.name for b in plan.portBindings if b.connection is connection or b.answer is connection]
    return {
        "pin": connection.pin.label if connection.pin else "",
        "component": connection.component.title if connection.component else "",
        "connectors": ", ".join(displayed_names(connection.connectors)),
        "via": ", ".join(c.title for c in connection.via),
        "name": connection.name,
        "ports": ", ".join(ports) or "none",
    }


def _port(binding: migration.PortBinding) -> dict[str, str]:
    return {
        "name": binding.name,
        "pin": source_name(binding),
        "names": ", ".join(n for n in dict.fromkeys([binding.name, *binding.names]) if n != source_name(binding)),
        "component": binding.connection.component.title if binding.connection and binding.connection.component else "",
        "target": _target(binding),
        "what": binding.what,
        "choice": binding.choice,
        "by": WHO[binding.chosenBy.name],
        "why": reason(binding),
    }


def _target(binding: migration.PortBinding) -> str:
    pin = bound_pin(binding)
    if pin is None:
        return "not connected" if not binding.open else "open: its calls do nothing"
    answer = binding.answer.pin if binding.answer is not None and binding.answer is not binding.connection else None
    return f"{pin.label} (echo on {answer.label})" if answer is not None else str(pin.label)


def _library(choice: migration.LibraryChoice) -> dict[str, str]:
    unused = choice.chosen is not None and not choice.included
    return {
        "component": choice.component.title if choice.component else "",
        "choice": (choice.choice or "open") + ", not used by the program" * unused,
        "by": WHO[choice.chosenBy.name],
        "candidates": ", ".join(o.label for o in list(choice.options)[:5]),
    }


def _group(unit: ccode.SourceUnit, judged: Sequence[Construct]) -> dict[str, Json]:
    return _table(unit.path.rpartition("/")[2], [c for c in judged if c.unit is unit])


def _outside(judged: Sequence[Construct]) -> list[dict[str, Json]]:
    """What the program uses and does not declare, with the line of its first use."""
    mine = [c for c in judged if c.unit is None]
    return [_table("declared elsewhere (line of the first use)", mine)] if mine else []


def _table(title: str, mine: Sequence[Construct]) -> dict[str, Json]:
    rows = [
        {"line": c.line or "", "element": c.title, "code": not c.title.startswith("#"), "verdict": VERDICT_WORDS[c.verdict],
         "reason": _BELOW if c.unit is None and c.verdict == CARE else c.reason, "effort": c.effort}
        for c in mine
    ]  # fmt: skip
    return {"title": title, "counts": _counts(mine), "rows": rows}


_BELOW = "its adapter behaves slightly differently, see Known differences"
VERDICT_WORDS = {
    "retained": "retained", "adapted": "adapted", "adapted_with_care": "adapted with care", "needs_you": "needs you",
    "not_supported": "not supported",
}  # fmt: skip
"""Verdict -> its words in the report."""


def _counts(judged: Sequence[Construct]) -> str:
    """How many constructs have each verdict, in words; the first number is their sum."""
    counts = verdict_counts(judged)
    summed = ", ".join(f"{counts[verdict]} {word}" for verdict, word in VERDICT_WORDS.items() if counts[verdict])
    return f"{quantity(counts['total'], 'element')}: {summed or 'none'}."


def _adapter(adapter: migration.AdapterUse, of_macros: MacroCalls) -> dict[str, Json]:
    piece = adapter.adapter
    return {
        "signature": adapter.signature, "header": header_name(adapter),
        "calls": len(adapter.calls) + len(of_macros.of(adapter)),
        "state": adapter.status.name, "kind": RELATIONS[piece.adapterKind.name] if piece is not None else "",
        "fidelity": piece.fidelity if piece is not None else "written by you" if adapter.written else adapter.reason,
    }  # fmt: skip


def known_differences(plan: migration.MigrationPlan) -> list[dict[str, str]]:
    """The limits of adapters, each once with the functions that have it."""
    found: dict[str, list[str]] = {}
    for use in plan.adapterUses:
        for limit in limits(use):
            found.setdefault(limit, []).append(str(use.name))
    return [{"limit": limit, "functions": ", ".join(names)} for limit, names in found.items()]
