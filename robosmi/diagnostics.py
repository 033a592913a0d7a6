"""Places, findings and tasks as plain values with the JSON form of the contract.

A finding is a fact about what was read or made; a task is work left for the user. Both have a stable `id` (same input, same
id), so that scripts can track them. Exceptions are in `errors`; texts for a terminal in `report`.
"""

from __future__ import annotations

import hashlib
from enum import IntEnum
from typing import TYPE_CHECKING

from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from robosmi.base.data_text import Json


class Severity(IntEnum):
    """The severity of a finding; comparable (`Severity.error > Severity.warning`)."""

    info = 0
    warning = 1
    error = 2


MORE = "more"
"""What a finding's evidence calls the other places of which it is true, each with `location`, `element` and `message`."""


class Location(Struct, frozen=True):
    """A place in a text file. Lines and columns count from 1; columns count bytes, as compilers do."""

    path: str
    line: int | None = None
    column: int | None = None
    end_line: int | None = None
    end_column: int | None = None

    def __str__(self) -> str:
        parts = [self.path]
        if self.line is not None:
            parts.append(str(self.line))
            if self.column is not None:
                parts.append(str(self.column))
        return ":".join(parts)

    def to_json(self) -> dict[str, Json]:
        """The contract's form of a place."""
        return {
            "path": self.path,
            "line": self.line,
            "column": self.column,
            "end_line": self.end_line,
            "end_column": self.end_column,
        }


class FlowStep(Struct, frozen=True):
    """One step of the path, through a program or a tool, that leads to a finding.

    Attributes:
        location: where it happens.
        message: what happens there.
    """

    location: Location
    message: str

    def to_json(self) -> dict[str, Json]:
        """The form that findings have in JSON."""
        return {"location": self.location.to_json(), "message": self.message}


class TextEdit(Struct, frozen=True):
    """A text change that fixes a finding, exactly as it would be typed.

    Attributes:
        location: the range to replace, its end exclusive; an empty range for an insertion.
        text: the replacement.
    """

    location: Location
    text: str

    def to_json(self) -> dict[str, Json]:
        """The form that findings have in JSON."""
        return {"location": self.location.to_json(), "text": self.text}


class Finding(Struct, frozen=True):
    """One fact worth knowing about an input or a result.

    Attributes:
        rule: stable id of the rule, e.g. `RS301` (docs/reference/rules.md lists them).
        severity: error, warning or info.
        message: one sentence with the cause.
        location: the place, or None.
        element: URI of the model element, or None.
        fix: what to do, or None.
        evidence: the facts that the finding is based on, JSON values only.
        steps: the path that leads to it, from the first step to the last, if known.
        edits: text changes that together fix it, if there are any.
    """

    rule: str
    severity: Severity
    message: str
    location: Location | None = None
    element: str | None = None
    fix: str | None = None
    evidence: Mapping[str, Json] = {}
    steps: tuple[FlowStep, ...] = ()
    edits: tuple[TextEdit, ...] = ()

    def listed(self, name: str) -> Sequence[Json]:
        """The values of a list of the evidence; empty where there is no list of that name."""
        value = self.evidence.get(name)
        return value if isinstance(value, (list, tuple)) else ()

    @property
    def id(self) -> str:
        """Stable over runs with the same input: made of rule, place, element and message."""
        place = str(self.location) if self.location else ""
        text = "\0".join([self.rule, place, self.element or "", self.message])
        data = text.encode(errors="surrogatepass")  # a path may hold bytes that are no UTF-8
        return f"{self.rule}-{hashlib.sha256(data).hexdigest()[:10]}"

    def to_json(self) -> dict[str, Json]:
        """The contract's form of a finding or task."""
        return {
            "id": self.id,
            "rule": self.rule,
            "severity": self.severity.name,
            "message": self.message,
            "location": self.location.to_json() if self.location else None,
            "element": self.element,
            "fix": self.fix,
            "evidence": self.evidence,
            "steps": [step.to_json() for step in self.steps],
            "edits": [edit.to_json() for edit in self.edits],
        }


class Task(Finding, frozen=True):
    """Work that is left for the user. Same form as a finding (contract: "finding / task")."""
