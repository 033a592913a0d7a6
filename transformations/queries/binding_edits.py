"""What a person edited in the binding of a port in a stored plan: what it refers to, or only the recorded choice.

A plan keeps what the binding referred to when it was made: in the texts of its changes, else in its trace.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from robosmi.metamodels import migration, platform, trace
from robosmi.query import root_of
from robosmi.transformations.queries.port_pins import NOT_WIRED, port_text

PORT_RULE = "port"
"""The rule of the changes of text that write a pin in the place of a port's number."""
TRACED = "port binding"
"""The rule of the trace's link from what a binding refers to."""


def referred(binding: migration.PortBinding) -> str:
    """What a binding is on by its references: the name of a connection, the label of a pin, empty for nothing."""
    if binding.connection is not None:
        return str(binding.connection.name)
    return str(binding.pin.label) if binding.pin is not None else ""


def only_the_choice_was_edited(binding: migration.PortBinding) -> bool:
    """Whether the recorded choice says something else than what the binding refers to, and the latter is as it was made."""
    pin = binding.connection.pin if binding.connection is not None else None
    alike = ["", referred(binding), *([pin.label, *pin.aliases] if pin is not None else [])]
    if binding.choice in alike or (binding.choice == NOT_WIRED and not referred(binding)):
        return False
    changes = [change for change in binding.changes if change.rule == PORT_RULE]
    text = port_text(binding)
    if changes:
        return all(writes(change, text) if text is not None else "/*" in change.replacement for change in changes)
    before = _referred_before(binding)
    return before is (binding.connection or binding.pin)


def writes(change: migration.TextChange, value: str) -> bool:
    """Whether a change of text has a name or number in it."""
    return re.search(rf"(?<!\w){re.escape(value)}(?!\w)", change.replacement) is not None


def binding_links(plan: object) -> dict[int, trace.TraceLink]:
    """The trace's links from what ports are bound to, by the `id` of the binding."""
    links = plan.trace.links if isinstance(plan, migration.MigrationPlan) and plan.trace is not None else ()
    return {id(target): link for link in links if link.rule == TRACED for target in link.targets}


def _referred_before(binding: migration.PortBinding) -> migration.Connection | platform.Pin | None:
    """The connection or pin that a binding had when its plan was made."""
    return _source(binding_links(root_of(binding)).get(id(binding)))


def _source(link: trace.TraceLink | None) -> migration.Connection | platform.Pin | None:
    sources = link.sources if link is not None else ()
    return next((s for s in sources if isinstance(s, migration.Connection | platform.Pin)), None)


def trace_binding(binding: migration.PortBinding, links: Mapping[int, trace.TraceLink] | None = None) -> None:
    """Bring the trace of a binding in line with what it refers to now; `links` are the plan's `binding_links`, if known."""
    link = (binding_links(root_of(binding)) if links is None else links).get(id(binding))
    now, before = binding.connection or binding.pin, _source(link)
    if link is None or before is now:
        return
    if before is not None:
        link.sources.remove(before)
    if now is not None:
        link.sources.append(now)
