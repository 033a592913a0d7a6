"""What a notebook shows of circuits and plans: the wiring as a picture, decisions and what is left as tables.

Findings, tables and pictures as such are `robosmi.report.notebook`'s.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.base.quantities import quantity
from robosmi.metamodels import hardware, migration
from robosmi.report.notebook import bar, picture, quoted, table
from robosmi.transformations.m2t.circuits.circuit_picture import plan_svg, svg
from robosmi.transformations.queries.plans.choices import reason
from robosmi.transformations.queries.plans.plan import call_sites, open_choices, ports_by_pin
from robosmi.transformations.queries.ports.macro_calls import MacroCalls


def circuit_html(circuit: hardware.Circuit) -> str:
    """The wiring of a circuit as a picture, and its components as a table."""
    rows = [
        [quoted(c.title or f"#{c.elementId}"), quoted(c.partTitle or c.partId or ""), quoted(c.role.name)]
        for c in circuit.components
        if c.role is not hardware.Role.Decoration
    ]
    drawn = picture(svg(circuit), f"the wiring of {circuit.name}")
    listed = table(("component", "part", "role"), rows)
    components = f"<details><summary>{quantity(len(rows), 'component')}</summary>{listed}</details>"
    return f"<p><b>{quoted(circuit.name)}</b></p>{drawn}{components}"


def plan_html(plan: migration.MigrationPlan) -> str:
    """What a plan decides: calls with bodies, ports and libraries with who chose and why, what is left."""
    return "".join(_parts(plan))


def _parts(plan: migration.MigrationPlan) -> Iterator[str]:
    calls, left = call_sites(plan), len(open_choices(plan))
    board = plan.board.title or plan.board.name if plan.board is not None else "no board"
    share = calls["with_body"] / calls["total"] if calls["total"] else 1.0
    served = f"{calls['with_body']} of {quantity(calls['total'], 'call')} have a body"
    yield f"<p><b>{quoted(plan.name)}</b> for {quoted(board)}: {served}</p>"
    work = (quantity(left, "choice"), quantity(len(plan.tasks), "task"), quantity(len(plan.findings), "finding"))
    yield f"{bar(share)}<p>{work[0]} open, {work[1]}, {work[2]}</p>"
    if drawn := plan_svg(plan):
        yield picture(drawn, f"the wiring of {plan.name}")
    pins = {port: pin for pin, ports in ports_by_pin(plan).items() for port in ports}
    ports = [[quoted(b.name), quoted(pins.get(str(b.name), "")), *_decision(b), quoted(reason(b))] for b in plan.portBindings]
    if ports:
        yield table(("port", "pin", "bound to", "chosen by", "why"), ports)
    libraries = [
        [quoted(c.component.title if c.component is not None else ""), *_decision(c), quoted(reason(c))]
        for c in plan.libraryChoices
    ]
    if libraries:
        yield table(("component", "library", "chosen by", "why"), libraries)
    of_macros = MacroCalls(plan)
    counts = {id(u): len(u.calls) + len(of_macros.of(u)) for u in plan.adapterUses}
    uses = [[quoted(u.signature), quoted(counts[id(u)]), quoted(u.status.name)] for u in plan.adapterUses]
    if uses:
        functions = table(("function", "calls", "status"), uses)
        yield f"<details><summary>{quantity(len(uses), 'function')}</summary>{functions}</details>"


def _decision(decision: migration.Decision) -> list[str]:
    """What was chosen, and by whom."""
    chosen = "<i>open</i>" if decision.open else quoted(decision.choice or "none")
    return [chosen, "" if decision.open else quoted(decision.chosenBy.name)]
