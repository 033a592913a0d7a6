"""Constraints on migration plans: inconsistencies that editing a stored plan by hand can cause.

Open decisions are critiques, not errors. Whether files match their digests is checked when the plan is loaded.
"""

from __future__ import annotations

from robosmi.diagnostics import Severity
from robosmi.metamodels import migration
from robosmi.transformations.constraints.code_rules import moved
from robosmi.transformations.constraints.electrical_plan import by_index, together
from robosmi.transformations.constraints.plan_edits import edits
from robosmi.transformations.constraints.plan_ports import by_words, named, ports
from robosmi.transformations.queries.text_changes import all_changes, decision_of
from robosmi.validate import EVL, Fail, Fix

plan = EVL()
"""The constraints on a plan; evaluate them on its model."""

plan.include(edits)
plan.include(together)
plan.include(by_index)
plan.include(moved)
plan.include(ports)
plan.include(by_words)

bindings = plan.context(migration.PortBinding)
decisions = plan.context(migration.Decision)
plans = plan.context(migration.MigrationPlan)


@bindings.constraint(id="RS704", guard=lambda b: b.connection is not None)
def PinIsOfItsConnection(b: migration.PortBinding) -> bool | Fail:
    """A port that is bound to a connection has that connection's pin."""
    connection = b.connection
    assert connection is not None

    def follow() -> None:
        b.pin = connection.pin

    wrong = f"the {named(b)} is bound to the connection {connection.name}, but not to its pin"
    return b.pin is connection.pin or Fail(wrong, Fix("use the pin of the connection", follow))


@decisions.constraint(id="RS705", severity=Severity.warning)
def ConfidenceIsAShare(d: migration.Decision) -> bool | Fail:
    """A confidence lies between 0 and 1."""

    def limit() -> None:
        d.confidence = min(max(d.confidence, 0.0), 1.0)

    wrong = f"the confidence of the {named(d)} is {d.confidence}"
    return 0 <= d.confidence <= 1 or Fail(wrong, Fix("set it to the nearest of 0 and 1", limit))


@decisions.critique(id="RS706", info=True, advice="choose with --bind or --library, in robosmi.toml, or in the plan")
def IsDecided(d: migration.Decision) -> bool | Fail:
    """A choice has been made."""
    return not d.open or Fail(f"no choice yet for the {named(d)}", options=", ".join(o.label for o in d.options))


@plans.constraint(id="RS708", advice="correct the offsets, or run migrate again")
def ChangesDoNotCross(p: migration.MigrationPlan) -> bool | Fail:
    """Text changes do not overlap, and a change that the user added takes effect."""
    wrong: list[str] = []
    widest: migration.TextChange | None = None
    placed = [(c.unit, c) for c in all_changes(p) if c.unit is not None and 0 <= c.startOffset <= c.endOffset <= c.unit.size]
    for unit, change in sorted(placed, key=lambda pair: (pair[0].path, pair[1].startOffset, -pair[1].endOffset)):
        start, end, path = change.startOffset, change.endOffset, unit.path
        if widest is None or widest.unit is not unit or widest.endOffset <= start:
            widest = change if start < end else widest
        elif widest.startOffset < end and (widest.endOffset < end or decision_of(change) is None):
            wrong.append(f"two changes of {path} overlap: bytes {widest.startOffset} to {widest.endOffset} and {start} to {end}")
    return not wrong or Fail("; ".join(wrong))
