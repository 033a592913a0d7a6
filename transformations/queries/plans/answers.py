"""How the user answers an open choice: what to type at the command line, and what to write into the project file."""

from __future__ import annotations

import re

from msgspec import Struct

from robosmi.metamodels import migration

_BARE_KEY = re.compile(r"[\w-]+", re.ASCII)
"""A key that TOML takes without quotation marks."""


class Answer(Struct, frozen=True):
    """How a choice is answered.

    Attributes:
        subject: what is chosen for: a port, or a component (its title, `#model_index` where two have it).
        flag: the option of the command line, with a word in capitals for the answer.
        table: of robosmi.toml.
        line: in that table.
        candidates: what may be answered, best first, each as it is typed with what it means in brackets.
    """

    subject: str
    flag: str
    table: str
    line: str
    candidates: tuple[str, ...]


def answer(plan: migration.MigrationPlan, decision: migration.Decision) -> Answer:
    """How a choice of a plan is answered.

    Args:
        plan: the plan.
        decision: a port binding or a library choice of it.
    """
    if isinstance(decision, migration.PortBinding):
        key = str(decision.name) if _BARE_KEY.fullmatch(str(decision.name)) else f"'{decision.name}'"
        pins = {c.name: c for c in plan.connections}
        told = tuple(_pin(str(o.label), pins.get(o.label)) for o in decision.options)
        return Answer(str(decision.name), f"--bind {key}=PIN", "bind", f'{key} = "PIN"', told)
    assert isinstance(decision, migration.LibraryChoice)
    component = decision.component
    title = component.title if component is not None else ""
    same = [c for c in plan.libraryChoices if c.component is not None and c.component.title == title]
    subject = f"#{component.elementId}" if component is not None and len(same) > 1 else title
    flag, line = f'--library "{subject}=LIBRARY"', f'{_quoted(subject)} = "LIBRARY"'
    return Answer(subject, flag, "libraries", line, tuple(str(o.label) for o in decision.options))


def _pin(label: str, connection: migration.Connection | None) -> str:
    """An option of a port as it is typed: the pin, with the component that is on it."""
    if connection is None or connection.pin is None:
        return label
    title = connection.component.title if connection.component is not None else ""
    return f"{connection.pin.label} ({title})" if title else str(connection.pin.label)


def _quoted(text: str) -> str:
    """A text as TOML has it in quotation marks."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
