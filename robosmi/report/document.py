"""One command's report: schema `robosmi/1` of the contract. Its text for a terminal is made in `terminal_text`."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from robosmi.diagnostics import Finding, Severity
from robosmi.project import Accepted

if TYPE_CHECKING:
    from robosmi.base.data_text import Json

SCHEMA = "robosmi/1"


class Report(Struct):
    """What one command found and made.

    Attributes:
        command: its name.
        result: the command's own part of the document.
        rest: makes what else belongs to `result`, where that takes work which only a reader of the document wants.
        findings: what is worth knowing.
        tasks: what is left for the user.
        artifacts: files written, {path, kind}.
        ok: whether the command did what it was asked to.
        failure_code: the exit code when it did not.
        lines: text for a terminal.
        next: the command that the user usually runs next, for a terminal; empty for none.
        then: what goes on once the report is printed, such as a page that is served; None for nothing.
    """

    command: str
    result: Mapping[str, Json] = {}
    rest: Callable[[], Mapping[str, Json]] | None = None
    findings: list[Finding] = []
    tasks: list[Finding] = []
    artifacts: list[dict[str, str]] = []
    ok: bool = True
    failure_code: int = 1
    lines: list[str] = []
    next: str = ""
    then: Callable[[], None] | None = None
    timings: dict[str, float] = {}
    started: float = field(default_factory=time.perf_counter)

    def judge(self, severity: Mapping[str, str], accept: tuple[Accepted, ...]) -> None:
        """Apply the project's severities and accepted findings. An accepted finding stays listed, as info with its reason.

        Args:
            severity: rule -> level.
            accept: what is accepted; an element is a finding's URI, the title of its component, `#model_index`,
                its port, its place `FILE:LINE`, or `*`.
        """
        judged: list[Finding] = []
        for finding in self.findings:
            level = severity.get(finding.rule)
            reason = next((a.reason for a in accept if a.rule == finding.rule and a.element in _names(finding)), None)
            if level == "off":
                continue
            if level or reason is not None:
                evidence = dict(finding.evidence) | ({"accepted": reason} if reason is not None else {})
                severity_now = Severity.info if reason is not None else Severity[level or "info"]
                finding = replace(finding, severity=severity_now, evidence=evidence)
            judged.append(finding)
        self.findings = judged + [_accepts_nothing(one, found) for one in accept if (found := self._of_others(one))]

    def _of_others(self, accepted: Accepted) -> list[Finding]:
        """The findings of an accepted rule, if none of them is about the accepted element."""
        found = [finding for finding in self.findings if finding.rule == accepted.rule]
        return [] if any(accepted.element in _names(finding) for finding in found) else found

    def exit_code(self, fail_on: str) -> int:
        """0, or 1 when a finding is at or above the level ("never" for no such level)."""
        if fail_on == "never":
            return 0
        return int(any(finding.severity >= Severity[fail_on] for finding in self.findings))

    def to_json(self) -> dict[str, Json]:
        """The contract's document."""
        return {
            "schema": SCHEMA,
            "command": self.command,
            "ok": self.ok,
            "result": self.result if self.rest is None else {**self.rest(), **self.result},
            "findings": [f.to_json() for f in self.findings],
            "tasks": [t.to_json() for t in self.tasks],
            "artifacts": self.artifacts,
            "timings": {**self.timings, "total_s": round(time.perf_counter() - self.started, 6)},
        }


def _names(finding: Finding) -> tuple[object, ...]:
    """The names by which `[[accept]]` may refer to a finding's element."""
    about = finding.evidence
    number = f"#{about['model_index']}" if "model_index" in about else None
    return (finding.element, "*", place_of(finding) or None, about.get("component") or None, about.get("port") or None, number)


def place_of(finding: Finding) -> str:
    """The line that a finding is about, as `FILE:LINE`, without folders; "" if it is about none."""
    place = finding.location
    return f"{PurePath(place.path).name}:{place.line}" if place is not None and place.line else ""


def _accepts_nothing(accepted: Accepted, found: Sequence[Finding]) -> Finding:
    names = [str(name) for finding in found for name in reversed(_names(finding)) if name not in (None, "*")]
    return Finding(
        "RS911",
        Severity.warning,
        f"[[accept]] of {accepted.rule} names '{accepted.element}', but none of its findings is about that",
        fix=f"name one of: {', '.join([*dict.fromkeys(names), '*'])}",
    )
