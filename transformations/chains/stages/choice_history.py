"""Earlier choices for a target; if the history cannot be used, the run continues as if it were empty, and reports that."""

from __future__ import annotations

from robosmi.diagnostics import Finding, Severity
from robosmi.recommend.history import ForgivingHistory, Targets
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, takes_libraries_of


def choice_history(place: str | None, target: TargetFacts) -> ForgivingHistory:
    """The earlier choices for a target, or, if there are none, for targets that use the same libraries.

    Args:
        place: a file or a URL; the user's own history if None.
        target: the target.
    """
    return ForgivingHistory(place, Targets(target.target, lambda name: takes_libraries_of(name, target.libraries)))


def history_findings(history: ForgivingHistory) -> list[Finding]:
    """A finding for a history that cannot be used; none for one that can."""
    trouble = history.trouble
    if trouble is None:
        return []
    message = f"continued without earlier choices: {trouble.message}"
    return [Finding("RS411", Severity.warning, message, trouble.location, fix=trouble.fix)]
