"""The contents of a plan's web page, section by section: what works, wiring, decide, write, check, verdict, history.

These are values for templates, from the same queries as the report and the terminal, with the lines of the source that they are
about. `chains.page` composes the page and answers its requests.

`side_by_side` has the source program beside the generated one: each line refers to the lines that it came from or became. The
links are those of the plan: texts generated from elements, and decisions about elements with their rules.
"""

from __future__ import annotations

import base64
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import groupby
from typing import Any

from msgspec import Struct

from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding, Severity
from robosmi.metamodels import ccode, migration, platform, trace
from robosmi.query import Q, ancestor_of_kind
from robosmi.report.document import place_of
from robosmi.transformations.m2t.circuits.circuit_picture import plan_svg
from robosmi.transformations.m2t.first_screen import Counted, counted, first_screen, result_in_words, task_place
from robosmi.transformations.m2t.move_text import move_text
from robosmi.transformations.m2t.task_list import VERDICT_RULES, WHO, known_differences
from robosmi.transformations.queries.circuits.circuit_walk import natural_key
from robosmi.transformations.queries.circuits.connector_names import displayed_names
from robosmi.transformations.queries.plans.answers import answer
from robosmi.transformations.queries.plans.choices import (
    AvailableChoice,
    Choice,
    Option,
    available_choices,
    choices,
    reason,
    used_by,
)
from robosmi.transformations.queries.plans.moved_wires import moved_wiring
from robosmi.transformations.queries.plans.plan import as_findings, ports_by_pin
from robosmi.transformations.queries.plans.port_pins import NOT_WIRED, bound_pin
from robosmi.transformations.queries.plans.verdicts import verdict_counts
from robosmi.transformations.queries.reports.work import Work
from robosmi.transformations.queries.reports.written_bodies import task_key

_SHOWN = 5
"""Number of errors on the first screen."""
_EXPLAINED = 8
"""Answers to a question that are shown with their reasons; the further ones are buttons alone."""
_WEAK = 0.1
"""Score of an answer of which only the direction fits; it is shown without its reason where others have a better one."""
_AT_ONCE = 8
"""Findings of a severity that are shown at once; the further ones are folded."""
_NAMED = 3
"""Parts of a pin that are listed by name."""
CHUNK = 25
"""Rows that a browser lays out together; chunks out of sight are laid out later."""
SEVERITIES = {"error": "Errors", "warning": "Warnings", "info": "Notes"}

_MOST = 40
"""Number of lines above which only the first line is linked: links of a whole file's heading tell nothing."""


def works(
    plan: migration.MigrationPlan, sources: Mapping[str, bytes], known: Counted | None = None, findings: Sequence[Finding] = ()
) -> dict[str, Any]:
    """The result in one line, the errors, how much works, the known differences, and how many constructs have each verdict.

    Args:
        plan: the plan.
        sources: path of a unit -> its bytes.
        known: results for the plan that are known already.
        findings: those of the plan, as the project file judges them.
    """
    known = known if known is not None else counted(plan, sources)
    screen = first_screen(plan, sources, known=known)
    counts = verdict_counts(known.judged)
    errors = [finding_row(finding) for finding in findings if finding.severity is Severity.error]
    state, result = result_in_words(plan, screen, len(errors))
    return {
        "state": state, "result": result, "errors": errors[:_SHOWN], "more_errors": len(errors[_SHOWN:]),
        "differences": [(row["functions"], row["limit"]) for row in known_differences(plan)],
        "works": screen.works, "needs": screen.needs, "shortages": list(screen.shortages),
        "totals": [(each.title, each.total) for each in (screen.decide, screen.write, screen.check)],
        "moved": move_text(plan),
        "verdicts": [(name.replace("_", " "), count) for name, count in counts.items() if name != "total" and count],
    }  # fmt: skip


def decide(plan: migration.MigrationPlan, sources: Mapping[str, bytes], output: str) -> dict[str, Any]:
    """Each choice with its possible answers, the open ones first; the roles of parts, which are never open, do not count."""
    told = {each.id: each for each in available_choices(plan)}
    shown = [_choice(plan, one, told[one.id], sources, output) for one in choices(plan)]
    roles = [_role(told[identity], output) for identity in told if identity.startswith("role:")]
    open_ = [one for one in shown if one["open"]]
    made = [one for one in shown if not one["open"]]
    return {"open": open_, "made": made, "roles": roles, "total": len(shown)}


def _role(told: AvailableChoice, output: str) -> dict[str, Any]:
    """The choice of a component's role; it is never open, since an unknown component counts as an input."""
    return {
        "id": told.id, "kind": "role", "subject": told.subject, "open": False, "chosen": told.chosen,
        "by": WHO[told.by], "at": "", "why": told.why, "title": f"What is '{told.subject}' for?", "context": [],
        "answer": told.chosen, "pins": "", "ranked": [], "weaker": [], "command": f"robosmi choose {output} {told.id}=ROLE",
        "drawn": [], "taken": [],
        "others": [
            {"value": o.value, "label": o.value, "chosen": o.value == told.chosen, "pin": "", "hint": ""}
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
        wire = pins.get(option.value)
        on = _on(wire) if wire is not None else option.why
        used = used_by(plan, decision, option.value) if isinstance(decision, migration.PortBinding) else ""
        return {
            "value": option.value, "why": option.why,
            "facts": _facts(libraries[option.value]) if option.value in libraries else "",
            "chosen": option.value == told.chosen, "label": label_of(option.value), "pin": _pin(wire, option.value),
            "used": used, "hint": "; ".join(filter(None, [f"used by {used}" if used else "", on])),
        }  # fmt: skip

    def label_of(value: str) -> str:
        return _part(pins[value], plan) if value in pins else _NONE[one.kind] if value == NOT_WIRED else value

    first = [option for option in told.options[:1] if option.value == NOT_WIRED or option.score]
    best = [*first, *(option for option in told.options[1:] if option.score)]
    ranked = [answer_row(option) for option in best]
    strong = [row for option, row in zip(best, ranked, strict=True) if not port or option.score > _WEAK] or ranked
    weaker = [*strong[_EXPLAINED:], *(row for row in ranked if row not in strong)]
    plain = [option for option in told.options if option not in best]
    drawn = [answer_row(option) for option in plain if option.value in pins]
    return {
        "id": one.id, "kind": one.kind, "subject": how.subject, "open": bool(decision.open), "chosen": told.chosen or "",
        "by": WHO[told.by], "at": told.at or "", "why": told.why, "table": how.table,
        "title": f"Which pin is port {said} on?" if port else f"Which library drives '{one.subject}'?",
        "answer": label_of(told.chosen or ""),
        "context": context_of(decision.element, sources) if isinstance(decision, migration.PortBinding) else [],
        "pins": " ".join(_pins_of(decision) if told.chosen else [str(row["pin"]) for row in ranked if row["pin"]]),
        "ranked": _rows(strong[:_EXPLAINED]), "weaker": weaker,
        "drawn": [row for row in drawn if not row["used"]], "taken": [row for row in drawn if row["used"]],
        "others": [answer_row(option) for option in plain if option.value not in pins],
        "command": f"robosmi choose {output} {one.id}={'PIN' if port else 'LIBRARY'}",
    }  # fmt: skip


def _rows(options: Sequence[Mapping[str, Json]]) -> list[Mapping[str, Json]]:
    """The options in rows, those that follow each other for the same reason in one."""
    rows = [
        (why, list(same)) for why, same in groupby(options, key=lambda o: "; ".join(str(o[n]) for n in ("why", "facts") if o[n]))
    ]
    return [{"why": why, "options": same, "chosen": any(option["chosen"] for option in same)} for why, same in rows]


_NONE = {"port": "Not connected", "library": "No library"}
"""Kind of a choice -> the words for its answer `none`."""


def _pins_of(decision: migration.Decision) -> list[str]:
    """The pins that a made decision is about, the one at which the part answers too."""
    if not isinstance(decision, migration.PortBinding):
        return []
    answers = [decision.answer.pin] if decision.answer is not None else []
    return list(dict.fromkeys(str(pin.label) for pin in (bound_pin(decision), *answers) if pin is not None))


def _pin(wire: migration.Connection | None, value: str) -> str:
    """The board's pin that an answer means; a free pin is called by its label."""
    if wire is None:
        return "" if value == NOT_WIRED else value
    return str(wire.pin.label) if wire.pin is not None else ""


def _on(connection: migration.Connection) -> str:
    """The connectors of a connection and the kind of part."""
    component = connection.component
    wires = _cut_list(displayed_names(connection.connectors), ", ")
    return f"{wires} of {component.partTitle or component.title}" if component is not None else ""


def _part(connection: migration.Connection, plan: migration.MigrationPlan) -> str:
    """A connection as the user names it: the part, its connector where it has several, and the pin."""
    pin = str(connection.pin.label) if connection.pin is not None else str(connection.name)
    component = connection.component
    if component is None:
        return pin
    several = sum(other.component is component for other in plan.connections) > 1
    wires = f" {_cut_list(displayed_names(connection.connectors), ', ')}" if several else ""
    return f"{component.title}{wires} ({pin})"


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


def check(plan: migration.MigrationPlan, findings: Sequence[Finding]) -> dict[str, Any]:
    """The findings by severity, the worst first, and what is to be checked on the bench, component by component.

    Args:
        plan: the plan.
        findings: of the plan and its inputs, as the project file judges them.
    """
    names = _accepted_names(plan, findings)
    about = Counter((finding.rule, names(finding)) for finding in findings if finding.severity >= Severity.warning)
    rows: dict[str, list[tuple[str, ...]]] = {level: [] for level in (*SEVERITIES, _ON_PURPOSE)}
    for finding in findings:
        if "accepted" in finding.evidence:
            rows[_ON_PURPOSE].append((*finding_row(finding), names(finding), "", str(finding.evidence["accepted"])))
        elif finding.severity >= Severity.warning:
            count = about[finding.rule, names(finding)]
            rows[finding.severity.name].append(
                (*finding_row(finding), names(finding), _all(finding.rule, names(finding), count), "")
            )
        else:
            rows[finding.severity.name].append((*finding_row(finding), "", "", ""))
    titles = {**SEVERITIES, _ON_PURPOSE: "On purpose"}
    groups = [
        {"title": title, "level": level, "total": len(rows[level]), "chunks": _first_few(rows[level])}
        for level, title in titles.items()
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


_ON_PURPOSE = "accepted"


def _all(rule: str, name: str, count: int) -> str:
    """Which findings the user accepts together, where one entry of the project file stands for several, now or later."""
    return f"all {count} of {rule}" if count > 1 else f"every {rule}" if name == "*" else ""


def _accepted_names(plan: migration.MigrationPlan, findings: Sequence[Finding]) -> Callable[[Finding], str]:
    """What `[[accept]]` calls the element of a finding: its component's title, `#model_index` if that is ambiguous,
    its port, its place, or `*`.
    """
    titles = Counter(str(component.title) for component in (plan.circuit.components if plan.circuit is not None else ()))

    def name(finding: Finding) -> str:
        title, index = finding.evidence.get("component"), finding.evidence.get("model_index")
        own = str(finding.evidence.get("port") or finding.element or place_of(finding) or "*")
        return str(title) if titles[str(title)] == 1 else f"#{index}" if index else own

    return name


def tick_of(task: migration.PlanTask) -> str:
    """The identifier of a task to check on the bench in the page, the same as for the ticks of the report."""
    return " ".join(task_key(str(task.rule), str(task.message)))


def finding_row(finding: Finding) -> tuple[str, str, str, str]:
    """A finding as a row: rule, message, place, what to do."""
    place = finding.location
    where = f"{place.path.rpartition('/')[2]}{f':{place.line}' if place.line else ''}" if place is not None else ""
    return finding.rule, finding.message, where, finding.fix or ""


def chunked(rows: Sequence[Any]) -> list[Sequence[Any]]:
    """The rows in chunks of `CHUNK`."""
    return [rows[at : at + CHUNK] for at in range(0, len(rows), CHUNK)]


def _first_few(rows: Sequence[Any]) -> list[Sequence[Any]]:
    """The first rows, which are shown at once, and the others in chunks."""
    return [rows[:_AT_ONCE], *chunked(rows[_AT_ONCE:])]


def wiring(plan: migration.MigrationPlan, sources: Mapping[str, bytes], findings: Sequence[Finding]) -> dict[str, Any]:
    """The circuit as a picture with its findings marked, the facts about each wire, and the wiring as a table.

    Args:
        plan: the plan.
        sources: path of a unit -> its bytes.
        findings: of the plan, as the project file judges them.
    """
    ports = ports_by_pin(plan)
    wrong = [finding for finding in findings if finding.rule.startswith("RS2") and "accepted" not in finding.evidence]
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
    picture = plan_svg(plan, wrong).partition("?>")[2].lstrip()
    both = moved_wiring(plan)
    if both is not None and not plan.connections:
        rows = []
    wires = _wires(plan, sources, wrong) if picture else []
    return {"rows": rows, "picture": picture, "presumed": plan.circuit is None, "wires": wires, "both": both}


def _wires(plan: migration.MigrationPlan, sources: Mapping[str, bytes], findings: Sequence[Finding]) -> list[dict[str, Json]]:
    """For each pin of the board with a wire or a port: its parts, ports, source lines and findings."""
    parts: dict[str, list[str]] = {}
    elements: dict[str, set[str]] = {}
    for wire in plan.connections:
        if wire.pin is not None and wire.component is not None:
            parts.setdefault(str(wire.pin.label), []).append(
                f"{wire.component.title} {_cut_list(displayed_names(wire.connectors), ', ')}"
            )
            elements.setdefault(str(wire.pin.label), set()).update(str(each.elementId) for each in (wire.component, *wire.via))
    used: dict[str, list[migration.PortBinding]] = {}
    for binding in plan.portBindings:
        for pin in _pins_of(binding):
            used.setdefault(pin, []).append(binding)
            if plan.circuit is None:
                parts.setdefault(pin, []).append(str(binding.what or binding.name))
    calls: dict[int, list[ccode.Located]] = {}
    for flow in plan.portFlows:
        for binding in flow.bindings:
            calls.setdefault(id(binding), []).extend(flow.calls)
    return [
        {
            "pin": pin, "label": f"{pin}: {_cut_list(titles)}", "ports": ", ".join(_port_name(b) for b in used.get(pin, ())),
            "lines": _lines(
                [each for b in used.get(pin, ()) for each in (b.element, *calls.get(id(b), ()))], sources
            ),
            "findings": [
                finding_row(f)
                for f in findings
                if f.evidence.get("model_index") in elements.get(pin, ()) or re.search(rf"\b{re.escape(pin)}\b", f.message)
            ],
        }
        for pin, titles in sorted(parts.items(), key=lambda item: natural_key(item[0]))
    ]  # fmt: skip


def _cut_list(titles: Sequence[str], between: str = "; ") -> str:
    more = len(titles) - _NAMED
    return between.join(titles) if more <= 0 else f"{between.join(titles[:_NAMED])} and {more} more"


def _port_name(binding: migration.PortBinding) -> str:
    return f"{binding.name} ({binding.what})" if binding.what else str(binding.name)


def _lines(elements: Sequence[ccode.Located | None], sources: Mapping[str, bytes]) -> list[str]:
    """The source lines of some elements, each once."""
    return [line for line in dict.fromkeys(line_of(element, sources) for element in elements) if line]


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


# ---- lines of the source

_LONGEST = 120


def context_of(element: ccode.Located | None, sources: Mapping[str, bytes]) -> list[tuple[int, str, bool]]:
    """The source line of an element with the ones before and after it: number, text, and whether it is the line itself.

    Args:
        element: an element of the code model.
        sources: path of a unit -> its bytes.
    """
    lines = _lines_with(element, sources)
    if element is None or not lines:
        return []
    at = element.line - 1
    shown = range(max(at - 1, 0), min(at + 2, len(lines)))
    return [(number + 1, _cut(lines[number].expandtabs(4).rstrip()), number == at) for number in shown]


def line_of(element: ccode.Located | None, sources: Mapping[str, bytes]) -> str:
    """The source line of an element with its number in front; empty if the source is not stored.

    Args:
        element: an element of the code model.
        sources: path of a unit -> its bytes.
    """
    lines = _lines_with(element, sources)
    return f"{element.line}: {_cut(' '.join(lines[element.line - 1].split()))}" if element is not None and lines else ""


def _lines_with(element: ccode.Located | None, sources: Mapping[str, bytes]) -> list[str]:
    """The lines of the file that an element is in; none if the file is not stored or has no such line."""
    unit = ancestor_of_kind(element, ccode.SourceUnit) if element is not None else None
    if element is None or unit is None or unit.path not in sources:
        return []
    lines = sources[unit.path].decode("utf-8", "replace").splitlines()
    return lines if 0 < element.line <= len(lines) else []


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."


class _Line(Struct):
    identity: str
    text: str
    links: list[str] = []
    why: str = ""

    def row(self) -> tuple[str, str, str, str]:
        return self.identity, self.text, " ".join(self.links), self.why


def side_by_side(plan: migration.MigrationPlan, sources: Mapping[str, bytes], texts: Mapping[str, str]) -> dict[str, Json]:
    """Both sides: `source` and `target`, each a list of files with their lines in runs.

    Args:
        plan: the plan.
        sources: path of a unit -> its bytes.
        texts: path of a generated file, relative to the output folder -> its text.
    """
    units = list(plan.program.units) if plan.program is not None else []
    old = {
        u.path: _numbered(f"s{n}", sources[u.path].decode("utf-8", "replace")) for n, u in enumerate(units) if u.path in sources
    }
    new = {path: _numbered(f"t{n}", text) for n, (path, text) in enumerate(texts.items())}
    for disposition in plan.dispositions:
        for line in _of(disposition.element, old):
            line.why = line.why or _why(disposition)
    for link in plan.trace.texts if plan.trace is not None else ():
        made = new.get(str(link.path), [])[link.line - 1 : link.endLine]
        origins = [line for element in _origins(link) for line in _of(element, old)]
        if len(made) > _MOST or len(origins) > _MOST:
            made, origins = made[:1], origins[:1]
        for line in made:
            line.why = line.why or f"{link.rule} ({link.step})"
            line.links += [o.identity for o in origins if o.identity not in line.links]
        for origin in origins:
            origin.links += [m.identity for m in made if m.identity not in origin.links]
    return {"source": _files(old), "target": _files(new)}


def _numbered(prefix: str, text: str) -> list[_Line]:
    return [_Line(f"{prefix}-{number}", line) for number, line in enumerate(text.splitlines(), 1)]


def _of(element: Any, old: Mapping[str, list[_Line]]) -> list[_Line]:
    """The lines of a program element; empty for a whole file."""
    unit = ancestor_of_kind(element, ccode.SourceUnit) if isinstance(element, ccode.Located) else None
    lines = old.get(unit.path) if unit is not None else None
    if lines is None:
        return []
    first = element.line
    return lines[first - 1 : max(element.endLine, first)]


def _origins(link: trace.TextTrace) -> Iterable[Any]:
    """The program elements that a generated text comes from, directly or through a decision about them."""
    for element in link.elements:
        if isinstance(element, migration.AdapterUse):
            yield from element.calls
        elif isinstance(element, (migration.Disposition, migration.PortBinding)):
            yield element.element
        else:
            yield element


def _why(disposition: migration.Disposition) -> str:
    return f"{disposition.action.name} ({', '.join(disposition.rules)}): {'; '.join(disposition.reasons)}"


def _files(files: Mapping[str, list[_Line]]) -> list[dict[str, Json]]:
    return [{"name": path.rpartition("/")[2], "chunks": chunked([line.row() for line in lines])} for path, lines in files.items()]
