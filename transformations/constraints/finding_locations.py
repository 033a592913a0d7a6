"""How findings on circuits refer to their subject (the drawing as location, the component as evidence), and how they are
sorted.

The component in the evidence (`component`, `model_index`) is what `[[accept]]` in robosmi.toml refers to.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from robosmi.diagnostics import Finding, Location
from robosmi.metamodels import hardware
from robosmi.validate import Fail

if TYPE_CHECKING:
    from robosmi.model.elements.driver import ItemOrItems


def drawing(element: hardware.Component | hardware.Net) -> Location | None:
    """The location of a finding: the drawing that contains a component or net."""
    return Location(element.circuit.path) if element.circuit is not None and element.circuit.path else None


def fault(component: hardware.Component, message: str, **evidence: ItemOrItems) -> Fail:
    """A failed check of a component, with the component as evidence."""
    return Fail(message, component=component.title, model_index=component.elementId, **evidence)


def in_file(found: list[Finding], path: str) -> list[Finding]:
    """Findings, those whose constraint gives no place with the file that their element is drawn or written in."""
    here = Location(path) if path else None
    return [finding if finding.location is not None else replace(finding, location=here) for finding in found]


def worst_first(found: list[Finding]) -> list[Finding]:
    """Findings sorted by severity, then by rule, without duplicates."""
    once: dict[tuple[str, str], Finding] = {}
    for finding in found:
        once.setdefault((finding.rule, finding.message), finding)
    return sorted(once.values(), key=lambda f: (-f.severity, f.rule))
