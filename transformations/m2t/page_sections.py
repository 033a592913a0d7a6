"""The contents of a plan's web page, section by section: what works, decide, write, check, wiring, history.

These are values for templates, from the same queries as the report and the terminal. `page_code` makes the program beside its
sketch; `chains.page` composes the page and answers its requests.

Also: lines of the source that elements of the code model are in.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from typing import Any

from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding
from robosmi.metamodels import ccode, migration, platform
from robosmi.query import Q, ancestor_of_kind
from robosmi.transformations.m2t.circuits.circuit_picture import svg
from robosmi.transformations.m2t.first_screen import Counted, counted, first_screen, task_place
from robosmi.transformations.m2t.move_text import move_text
from robosmi.transformations.m2t.task_list import VERDICT_RULES, WHO
from robosmi.transformations.queries.circuits.connector_names import displayed_names
from robosmi.transformations.queries.plans.answers import answer
from robosmi.transformations.queries.plans.choices import AvailableChoice, Choice, Option, available_choices, choices, reason
from robosmi.transformations.queries.plans.moved_wires import moved_wiring
from robosmi.transformations.queries.plans.plan import as_findings
from robosmi.transformations.queries.plans.verdicts import verdict_counts
from robosmi.transformations.queries.reports.work import Work
from robosmi.transformations.queries.reports.written_bodies import task_key

CHUNK = 25
"""Rows that a browser lays out together; chunks out of sight are laid out later."""
SEVERITIES = {"error": "Errors", "warning": "Warnings", "info": "Notes"}


def works(plan: migration.MigrationPlan, sources: Mapping[str, bytes], known: Counted | None = None) -> dict[str, Any]:
    """How much works, and how many constructs have each verdict; `known` are results for the plan that are known already."""
    known = known if known is not None else counted(plan, sources)
    screen = first_screen(plan, sources, known=known)
    counts = verdict_counts(known.judged)
    return {
        "works": screen.works, "needs": screen.needs, "shortages": list(screen.shortages),
        "totals": [(each.title, each.total) for each in (screen.decide, screen.write, screen.check)],
        "moved": move_text(plan),
        "verdicts": [(name.replace("_", " "), count) for name, count in counts.items() if name != "total" and count],
    }  # fmt: skip


def decide(plan: migration.MigrationPlan, sources: Mapping[str, bytes], output: str) -> dict[str, Any]:
    """Each choice with its possible answers, the open ones first."""
    told = {each.id: each for each in available_choices(plan)}
    shown = [_choice(plan, one, told[one.id], sources, output) for one in choices(plan)]
    shown += [_role(told[identity], output) for identity in told if identity.startswith("role:")]
    open_ = [one for one in shown if one["open"]]
    drawing = plan.circuit is None and any(one["kind"] == "port" for one in open_)
    return {"open": open_, "made": [one for one in shown if not one["open"]], "wants_drawing": drawing}


def _role(told: AvailableChoice, output: str) -> dict[str, Any]:
    """The choice of a component's role; it is never open, since an unknown component counts as an input."""
    return {
        "id": told.id, "kind": "role", "subject": told.subject, "open": False, "chosen": told.chosen,
        "by": WHO[told.by], "at": "", "why": told.why, "title": f"What is '{told.subject}' for?", "line": "",
        "ranked": [], "command": f"robosmi choose {output} {told.id}=ROLE",
        "drawn": [],
        "others": [
            {"value": o.value, "label": o.value, "why": o.value, "chosen": o.value == told.chosen}
            for o in told.options
        ],
    }  # fmt: skip


def _choice(
    plan: migration.MigrationPlan, one: Choice, told: AvailableChoice, sources: Mapping[str, bytes], output: str
) -> Mapping[str, Json]:
    decision, how = one.decision, answer(plan, one.decision)
    pins = {c.name: c for c in plan.connections}
    port = isinstance(decision, migration.PortBinding)
    what = str(decision.what) if isinstance(decision, migration.PortBinding) else ""
    said = f"'{one.subject}' ({what})" if what else f"'{one.subject}'"
    libraries = {} if port else {c.name: c for c in decision.candidates}  # type: ignore[attr-defined]

    def answer_row(option: Option) -> dict[str, Json]:
        known = option.value in pins
        return {
            "value": option.value, "score": f"{option.score:.2f}" if option.score else "", "why": option.why,
            "chosen": option.value == told.chosen, "plain": not option.score,
            "label": _short(pins[option.value]) if known else option.value, "title": _on(pins[option.value]) if known else "",
            "facts": _facts(libraries[option.value]) if option.value in libraries else "",
        }  # fmt: skip

    plain = [option for option in told.options if not option.score]
    return {
        "id": one.id, "kind": one.kind, "subject": how.subject, "open": bool(decision.open), "chosen": told.chosen or "",
        "by": WHO[told.by], "at": told.at or "", "why": told.why, "table": how.table,
        "title": f"Which pin is port {said} on?" if port else f"Which library drives '{one.subject}'?",
        "line": line_of(decision.element, sources) if isinstance(decision, migration.PortBinding) else "",
        "ranked": [answer_row(option) for option in told.options if option.score],
        "drawn": [answer_row(option) for option in plain if option.value in pins],
        "others": [answer_row(option) for option in plain if option.value not in pins],
        "command": f"robosmi choose {output} {one.id}={'PIN' if port else 'LIBRARY'}",
    }  # fmt: skip


def _on(connection: migration.Connection) -> str:
    """A connection in full: the pin, the connectors, the component and its part."""
    pin = connection.pin.label if connection.pin is not None else "no pin"
    component = connection.component
    if component is None:
        return str(pin)
    wires = ", ".join(displayed_names(connection.connectors))
    return f"{pin}: {wires} of {component.title}{f' ({component.partTitle})' if component.partTitle else ''}"


def _short(connection: migration.Connection) -> str:
    """A connection in short: the pin, the connectors, the component."""
    pin = str(connection.pin.label) if connection.pin is not None else str(connection.name)
    component = connection.component
    wires = ", ".join(displayed_names(connection.connectors))
    return f"{pin}: {wires} of {component.title}" if component is not None else pin


def _facts(library: platform.Library) -> str:
    """The facts about a library: version, header, architectures, dependencies, resources."""
    facts = [
        f"version {library.version}" if library.version else "",
        f"<{next(iter(library.headers), '')}>" if library.headers else "",
        f"for {', '.join(library.architectures)}" if library.architectures else "",
        f"needs {', '.join(library.depends)}" if library.depends else "",
        f"takes {', '.join([*library.timers, *library.pins])}" if library.timers or library.pins else "",
        "installed" if library.installed else "",
    ]
    return "; ".join(fact for fact in facts if fact)


def write(plan: migration.MigrationPlan, texts: Mapping[str, str]) -> dict[str, Any]:
    """The tasks of writing, smallest first, each with what is known about the source's function and its placeholder."""
    return {"tasks": [_body(plan, task, texts) for task in Work(plan).write]}


def _body(plan: migration.MigrationPlan, task: migration.PlanTask, texts: Mapping[str, str]) -> dict[str, Json]:
    use = next((e for e in task.elements if isinstance(e, migration.AdapterUse)), None)
    known = []
    if use is not None:
        known.append(f"{use.signature};")
        if use.function is not None:
            known += [f"declared in {use.function.header.name}"] if use.function.header is not None else []
            known += ["it blocks until it is done"] if use.function.blocking else []
            known += ["it starts code on another core"] if use.function.startsCog else []
        known += [str(note) for note in use.notes]
    stubs = (_stub(text, str(use.name)) for text in texts.values()) if use is not None else ()
    return {
        "message": str(task.message), "place": task_place(plan, task), "effort": str(task.effort), "fix": str(task.fix),
        "rule": str(task.rule), "done": bool(task.done), "known": known, "stub": next(filter(None, stubs), []),
    }  # fmt: skip


def _stub(text: str, name: str) -> list[str]:
    """The lines of a function's placeholder in a generated text with the comments above it; empty if there is none."""
    lines = text.split("\n")
    at = next((n for n, line in enumerate(lines) if f"{name}(" in line and line.rstrip().endswith("{")), None)
    if at is None:
        return []
    end = next((n for n in range(at, len(lines)) if lines[n].startswith("}")), at)
    while at and lines[at - 1].startswith("//"):
        at -= 1
    return lines[at : end + 1] if any("TODO" in line for line in lines[at : end + 1]) else []


def check(plan: migration.MigrationPlan, notes: Sequence[Finding], places: dict[str, str]) -> dict[str, Any]:
    """The findings by severity, the worst first, and what is to be checked on the bench, component by component."""
    rows: dict[str, list[tuple[str, str, str, str]]] = {level: [] for level in SEVERITIES}
    for note in notes:
        rows[note.severity.name].append(finding_row(note))
    for finding in plan.findings:
        row = _row(finding, places)
        if row[0] not in VERDICT_RULES:
            rows[str(finding.severity.name)].append(row)
    groups = [
        {"title": title, "level": level, "total": len(rows[level]), "chunks": chunked(rows[level])}
        for level, title in SEVERITIES.items()
        if rows[level]
    ]
    bench = [
        {
            "message": str(t.message),
            "rule": str(t.rule),
            "key": tick_of(t),
            "done": bool(t.done),
        }
        for t in Work(plan).check
    ]
    return {"groups": groups, "bench": bench}


def tick_of(task: migration.PlanTask) -> str:
    """The identifier of a task to check on the bench in the page, the same as for the ticks of the report."""
    return " ".join(task_key(str(task.rule), str(task.message)))


def finding_row(finding: Finding) -> tuple[str, str, str, str]:
    """A finding as a row: rule, message, place, what to do."""
    place = finding.location
    where = f"{place.path.rpartition('/')[2]}{f':{place.line}' if place.line else ''}" if place is not None else ""
    return finding.rule, finding.message, where, finding.fix or ""


def _row(finding: migration.PlanFinding, places: Mapping[str, str]) -> tuple[str, str, str, str]:
    """A finding of a plan as a row, without looking up its elements: there may be thousands."""
    path, where = str(finding.path), ""
    if path:
        line = finding.line
        where = f"{places.get(path, path).rpartition('/')[2]}{f':{line}' if line else ''}"
    return str(finding.rule), str(finding.message), where, str(finding.fix or "")


def chunked(rows: Sequence[Any]) -> list[Sequence[Any]]:
    """The rows in chunks of `CHUNK`."""
    return [rows[at : at + CHUNK] for at in range(0, len(rows), CHUNK)]


def wiring(plan: migration.MigrationPlan, places: dict[str, str]) -> dict[str, Any]:
    """The wiring as a picture with its findings marked, and as a table."""
    ports: dict[str, list[str]] = {}
    for binding in plan.portBindings:
        if binding.pin is not None:
            ports.setdefault(binding.pin.label, []).append(str(binding.name))
    wrong = as_findings(Q(f for f in plan.findings if str(f.rule).startswith("RS2")), places)
    rows = [
        (
            c.pin.label if c.pin is not None else "", str(c.component.title) if c.component is not None else "",
            ", ".join(displayed_names(c.connectors)), str(c.name),
            ", ".join(ports.get(c.pin.label, [])) if c.pin is not None else "",
        )
        for c in plan.connections
    ]  # fmt: skip
    drawn = {c.pin.label for c in plan.connections if c.pin is not None}
    rows += [(label, "", "", "", ", ".join(names)) for label, names in ports.items() if label not in drawn]
    picture = svg(plan.circuit, wrong, ports).partition("?>")[2] if plan.circuit is not None else ""
    both = moved_wiring(plan)
    if both is not None and not plan.connections:
        rows = []
    return {"rows": rows, "picture": _image(picture) if picture else "", "both": both}


def _image(picture: str) -> str:
    return f"data:image/svg+xml;base64,{base64.b64encode(picture.encode()).decode()}"


def verdict(plan: migration.MigrationPlan, picture: str, places: dict[str, str]) -> dict[str, Json]:
    """The result of comparing the sketch with the original, empty if that was not done."""
    told = [finding_row(f) for f in as_findings(Q(f for f in plan.findings if f.rule in VERDICT_RULES), places)]
    return {"told": told, "picture": _image(picture) if picture and told else ""}


def history(plan: migration.MigrationPlan) -> dict[str, Any]:
    """Who chose what, when and why: those of persons in the order of time, then the others."""
    made = [(c, c.decision) for c in choices(plan) if not c.decision.open]
    rows = [
        (
            str(d.chosenAt).replace("T", " ").replace("Z", " UTC"),
            WHO[d.chosenBy.name],
            c.subject,
            str(d.choice),
            reason(d),
        )
        for c, d in made
    ]
    return {"rows": sorted(rows, key=lambda row: (row[0] == "", row[0])), "moved": move_text(plan), "tool": str(plan.toolVersion),
            "inputs": [(str(i.kind), str(i.origin), str(i.digest)[:12]) for i in plan.inputs]}  # fmt: skip


_LONGEST = 120


def line_of(element: ccode.Located | None, sources: Mapping[str, bytes]) -> str:
    """The source line of an element with its number in front; empty if the source is not stored.

    Args:
        element: an element of the code model.
        sources: path of a unit -> its bytes.
    """
    unit = ancestor_of_kind(element, ccode.SourceUnit) if element is not None else None
    if element is None or unit is None or unit.path not in sources:
        return ""
    lines = sources[unit.path].decode("utf-8", "replace").splitlines()
    if not 0 < element.line <= len(lines):
        return ""
    text = " ".join(lines[element.line - 1].split())
    return f"{element.line}: {text if len(text) <= _LONGEST else f'{text[:_LONGEST]} ...'}"
