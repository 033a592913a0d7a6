"""How findings on circuits name what they are about, the drawing as place, the component in the evidence; and their order.

A component in the evidence (`component`, `model_index`) is what a person names under `[[accept]]` in robosmi.toml.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from robosmi.diagnostics import Finding, Location
from robosmi.metamodels import hardware
from robosmi.validate import Fail

if TYPE_CHECKING:
    from robosmi.model.driver import Held


def drawing(element: hardware.Component | hardware.Net) -> Location | None:
    """The drawing that a component or net is in."""
    return Location(element.circuit.path) if element.circuit is not None and element.circuit.path else None


def fault(component: hardware.Component, message: str, **evidence: Held) -> Fail:
    """What a check says about a component."""
    return Fail(message, component=component.title, model_index=component.elementId, **evidence)


def worst_first(found: list[Finding]) -> list[Finding]:
    """Findings by severity, then by rule; what is said twice in the same words stands there once."""
    once: dict[tuple[str, str], Finding] = {}
    for finding in found:
        once.setdefault((finding.rule, finding.message), finding)
    return sorted(once.values(), key=lambda f: (-f.severity, f.rule))
