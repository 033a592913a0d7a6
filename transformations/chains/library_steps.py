"""The steps of `migrate` about libraries: the ranker, earlier choices, and the decisions."""

from __future__ import annotations

from robosmi.metamodels import migration, platform
from robosmi.plugins import content
from robosmi.project import Project, default_text
from robosmi.recommend.history import ForgivingHistory
from robosmi.recommend.ranking import Ranker
from robosmi.transformations.chains.stages.choice_history import choice_history
from robosmi.transformations.chains.stages.hardware_stage import StoredDrawing
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts
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
    """The earlier choices for the target, or for others with the same libraries."""
    return choice_history(history, target)


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
