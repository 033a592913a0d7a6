"""What a run says when the history of choices cannot be used: it goes on without, as if nothing had been chosen before."""

from __future__ import annotations

from robosmi.diagnostics import Finding, Severity
from robosmi.recommend.history import ForgivingHistory


def history_findings(history: ForgivingHistory) -> list[Finding]:
    """A finding for a history that cannot be used; none for one that can."""
    trouble = history.trouble
    if trouble is None:
        return []
    message = f"went on without earlier choices: {trouble.message}"
    return [Finding("RS411", Severity.warning, message, trouble.location, fix=trouble.fix)]
