"""Titles of components and names of connections as they were when the names of a schematic's sheets always were part of them.

A component is called by its reference (`J7`), with its sheets' names only where several have that reference. Settings and stored
plans may still have `sensors/J7`.
"""

from __future__ import annotations

from robosmi.metamodels import hardware, migration
from robosmi.quoting import identifier

SHEET = "sheet"
"""Property of a component: names of the sheets above it, joined by `/`."""


def title_on_sheet(sheet: str, reference: str) -> str:
    """The title of a part with the names of its sheets before it (`left/D1`)."""
    return f"{sheet}/{reference}"


def former_title(component: hardware.Component) -> str:
    """The title of a component with its sheets' names; the title itself where it has them, or there are none."""
    title = str(component.title)
    sheet = next((str(p.value) for p in component.properties if p.name == SHEET), "")
    return title if not sheet or title.startswith(f"{sheet}/") else title_on_sheet(sheet, title)


def former_name(connection: migration.Connection) -> str:
    """The name of a connection, made of its component's former title."""
    name, component = str(connection.name), connection.component
    begins = identifier(str(component.title), begins=True) if component is not None else ""
    if component is None or not begins or not name.startswith(begins):
        return name
    return identifier(former_title(component), begins=True) + name.removeprefix(begins)
