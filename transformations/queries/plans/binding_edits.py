"""What the user edited in the binding of a port in a stored plan: what it refers to, or only the recorded choice.

A plan keeps what the binding referred to when it was made: in the texts of its changes, else in its trace.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from robosmi.metamodels import migration, platform, trace
from robosmi.query import root_of
from robosmi.transformations.queries.plans.port_pins import WITHOUT_PIN, port_text

PORT_RULE = "port"
"""The rule of the changes of text that write a pin in the place of a port's number."""
TRACED = "port binding"
"""The rule of the trace's link from what a binding refers to."""


def referred(binding: migration.PortBinding) -> str:
    """What a binding refers to: the name of its connection, else the label of its pin, else an empty text."""
    if binding.connection is not None:
        return str(binding.connection.name)
    return str(binding.pin.label) if binding.pin is not None else ""


def only_the_choice_was_edited(binding: migration.PortBinding) -> bool:
    """Whether the user changed only the recorded choice: it contradicts the connection or pin that the binding refers to, and
    that reference is unchanged since the plan was made.
    """
    pin = binding.connection.pin if binding.connection is not None else None
    alike = ["", referred(binding), *([pin.label, *pin.aliases] if pin is not None else [])]
    if binding.choice in alike or (binding.choice in WITHOUT_PIN and not referred(binding)):
        return False
    changes = [change for change in binding.changes if change.rule == PORT_RULE]
    text = port_text(binding)
    if changes:
        return all(writes(change, text) if text is not None else "/*" in change.replacement for change in changes)
    before = _referred_before(binding)
    return before is (binding.connection or binding.pin)


def writes(change: migration.TextChange, value: str) -> bool:
    """Whether the replacement text of a change contains a name or number as a whole word."""
    return re.search(rf"(?<!\w){re.escape(value)}(?!\w)", change.replacement) is not None


def binding_links(plan: object) -> dict[int, trace.TraceLink]:
    """The trace links whose targets are port bindings, by the `id` of the binding."""
    links = plan.trace.links if isinstance(plan, migration.MigrationPlan) and plan.trace is not None else ()
    return {id(target): link for link in links if link.rule == TRACED for target in link.targets}


def _referred_before(binding: migration.PortBinding) -> migration.Connection | platform.Pin | None:
    """The connection or pin that a binding had when its plan was made."""
    return _source(binding_links(root_of(binding)).get(id(binding)))


def _source(link: trace.TraceLink | None) -> migration.Connection | platform.Pin | None:
    sources = link.sources if link is not None else ()
    return next((s for s in sources if isinstance(s, migration.Connection | platform.Pin)), None)


def trace_binding(binding: migration.PortBinding, links: Mapping[int, trace.TraceLink] | None = None) -> None:
    """Update the sources of a binding's trace link to its present connection or pin; `links` are `binding_links`, if known."""
    link = (binding_links(root_of(binding)) if links is None else links).get(id(binding))
    now, before = binding.connection or binding.pin, _source(link)
    if link is None or before is now:
        return
    if before is not None:
        link.sources.remove(before)
    if now is not None:
        link.sources.append(now)
