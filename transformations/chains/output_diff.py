"""The chain `output_diff`: what differs between two migrations, for the user: the board, the choices, and the program's text."""

from __future__ import annotations

from difflib import unified_diff
from pathlib import Path

from msgspec import Struct

from robosmi.generate.manifest import Manifest
from robosmi.generate.output_paths import Places
from robosmi.metamodels import migration
from robosmi.transformations.chains.stages.models import stored_models
from robosmi.transformations.queries.plans.choices import available_choices

_OPEN, _ABSENT = "open", "not asked"
_CODE = (".ino", ".c", ".cpp", ".h", ".hpp")


class OutputDiff(Struct):
    """What differs between two output folders.

    Attributes:
        board: the boards, if they differ.
        choices: name of each choice with another answer -> both answers.
        text: the unified diff of the generated programs as they are now.
    """

    board: tuple[str, str] | None
    choices: dict[str, tuple[str, str]]
    text: str

    @property
    def equal(self) -> bool:
        """Whether nothing differs."""
        return self.board is None and not self.choices and not self.text

    def lines(self) -> list[str]:
        """Text for a terminal."""
        board = [f"board: {self.board[0]} -> {self.board[1]}"] if self.board is not None else []
        choices = [f"{name}: {before} -> {after}" for name, (before, after) in self.choices.items()]
        return [*board, *choices, *self.text.splitlines()]


def output_diff(before: Path, after: Path) -> OutputDiff:
    """Compare two output folders of `migrate`.

    Args:
        before: the first.
        after: the second.

    Raises:
        SourceError, ModelError: a folder has no plan, or one that cannot be read.
    """
    plans = [stored_models(folder).plan for folder in (before, after)]
    boards = tuple(plan.board.title if plan.board is not None else "none" for plan in plans)
    old, new = map(_answers, plans)
    named = {name: (old.get(name, _ABSENT), new.get(name, _ABSENT)) for name in {**old, **new}}
    texts = [_texts(folder, str(plan.name)) for folder, plan in zip((before, after), plans, strict=True)]
    changes = [
        line
        for name in sorted({*texts[0], *texts[1]})
        for line in unified_diff(
            texts[0].get(name, []), texts[1].get(name, []), str(before / name), str(after / name), lineterm=""
        )
    ]
    return OutputDiff(
        (boards[0], boards[1]) if boards[0] != boards[1] else None,
        {name: both for name, both in named.items() if both[0] != both[1]},
        "\n".join(changes),
    )


def _answers(plan: migration.MigrationPlan) -> dict[str, str]:
    """Name of a choice -> its answer."""
    return {each.id: _OPEN if each.chosen is None else each.chosen for each in available_choices(plan)}


def _texts(folder: Path, program: str) -> dict[str, list[str]]:
    """The files of a generated program as they are now: path below the folder -> its lines."""
    places = Places(folder)
    names = [name for name in Manifest.load(folder).files if name.startswith(f"{program}/") and name.endswith(_CODE)]
    return {name: data.decode("utf-8", "replace").splitlines() for name in names if (data := places.read(name)) is not None}
