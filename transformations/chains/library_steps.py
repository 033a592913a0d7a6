"""The steps of `migrate` about libraries: the ranker, earlier choices, and the decisions.

If the history of choices cannot be used, the run continues as if it were empty, and reports that.
"""

from __future__ import annotations

from robosmi.diagnostics import Finding, Severity
from robosmi.metamodels import migration, platform
from robosmi.plugins import content
from robosmi.project import Project, default_text
from robosmi.recommend.history import ForgivingHistory, Targets
from robosmi.recommend.ranking import Ranker
from robosmi.transformations.chains.stages.hardware_stage import StoredDrawing
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, takes_libraries_of
from robosmi.transformations.m2m.choices.library_choice import LibraryModels
from robosmi.transformations.m2m.migration_plan import UserLibraries, decide_libraries


def make_ranker(target: TargetFacts, ranker_name: str | None, settings: Project) -> Ranker | None:
    """The ranker of libraries: the one that is named, the project file's, or the default; None for a target without libraries.

    Raises:
        UsageError: there is no ranker of that name.
    """
    if not target.libraries:
        return None
    name = ranker_name or settings.ranker or default_text("rank", "ranker")
    made: Ranker = content("ranker", name)(target.libraries, architecture=target.architecture)
    return made


def previous_choices(history: str | None, target: TargetFacts) -> ForgivingHistory:
    """The earlier choices for the target, or, if there are none, for targets that use the same libraries.

    Args:
        history: a file or a URL; the user's own history if None.
        target: the target.
    """
    return ForgivingHistory(history, Targets(target.target, lambda name: takes_libraries_of(name, target.libraries)))


def library_decisions(
    drawing: StoredDrawing | None,
    board: platform.Board,
    target: TargetFacts,
    choices: UserLibraries,
    ranker: Ranker | None,
    earlier: ForgivingHistory,
) -> tuple[list[migration.LibraryChoice], LibraryModels]:
    """A decision about libraries for each component that a board pin reaches (paper 3.3).

    Raises:
        UsageError: a component or library does not exist.
    """
    return decide_libraries(drawing.hardware if drawing is not None else None, board, target, choices, ranker, earlier)


def history_findings(history: ForgivingHistory) -> list[Finding]:
    """A finding for a history that cannot be used; none for one that can."""
    trouble = history.trouble
    if trouble is None:
        return []
    message = f"continued without earlier choices: {trouble.message}"
    return [Finding("RS411", Severity.warning, message, trouble.location, fix=trouble.fix)]
