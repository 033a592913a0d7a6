"""The results of the chains behind the commands, as far as a command reads them.

For type checkers only; import it under `TYPE_CHECKING`. A command knows a chain by its name alone. The results of `robosmi`'s
own functions are declared in `robosmi.api`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from robosmi.api import Analysed, MigratedSketch, VerifiedMigration
from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding
from robosmi.errors import RobosmiError
from robosmi.project import Project
from robosmi.verify.simulation import PinTrace


class ImportedLibraries(Protocol):
    """Libraries that were read into the user's own index."""

    @property
    def index(self) -> Path:
        """The index."""

    @property
    def added(self) -> Sequence[tuple[str, str]]:
        """Name and version of each library."""

    @property
    def skipped(self) -> Mapping[str, str]:
        """Folder that was left out -> the reason."""

    @property
    def known(self) -> int:
        """How many libraries the index has now."""


class HandedWiring(Protocol):
    """A wiring that was written for another tool."""

    @property
    def result(self) -> Mapping[str, Json]:
        """What its form adds to the JSON document."""

    @property
    def findings(self) -> Sequence[Finding]:
        """What is worth knowing."""

    @property
    def project(self) -> Project:
        """The project file that judges the findings."""

    def artifacts(self) -> list[dict[str, str]]:
        """Files written, {path, kind}."""


class CheckedModel(Analysed, Protocol):
    """A model that was checked."""

    @property
    def project(self) -> Project:
        """The project file that judges the findings."""


class ComparedOutputs(Protocol):
    """What differs between two migrations."""

    @property
    def equal(self) -> bool:
        """Whether nothing differs."""

    @property
    def board(self) -> tuple[str, str] | None:
        """The boards, if they differ."""

    @property
    def choices(self) -> dict[str, tuple[str, str]]:
        """Name of each choice with another answer -> both answers."""

    @property
    def text(self) -> str:
        """The unified diff of the programs."""

    def lines(self) -> list[str]:
        """Text for a terminal."""


class ListedTargets(Protocol):
    """What a command lists, without findings."""

    @property
    def result(self) -> dict[str, Any]:
        """The contract's part of the document."""

    def lines(self) -> list[str]:
        """The text for the user."""


class ImportedParts(Analysed, Protocol):
    """Parts that were read into the catalogue."""

    @property
    def path(self) -> Path:
        """The file of the catalogue."""


class ImportedPlatform(Analysed, Protocol):
    """A source platform that was made of headers."""

    @property
    def written(self) -> Sequence[str]:
        """The files written."""


class AdapterAnswer(Analysed, Protocol):
    """Adapters that were listed, shown or saved."""

    @property
    def written(self) -> Sequence[str]:
        """The files written; empty unless they were saved."""


class ComparedPrograms(VerifiedMigration, Protocol):
    """The original and the migrated program, run under the same scenarios."""

    @property
    def notes(self) -> Sequence[str]:
        """Further notes to the user."""


class SimulatedSketch(Analysed, Protocol):
    """A sketch that was run in a simulator."""

    @property
    def trace(self) -> PinTrace | None:
        """What the pins did; None where it did not run."""

    @property
    def written(self) -> Path | None:
        """The trace's file; None where nobody asked for one."""


class ChosenSketch(MigratedSketch, Protocol):
    """A sketch that was made again after a choice."""

    def lines(self, *, every_file: bool = False) -> list[str]:
        """What the user reads, with the changes of the main file or of every file."""

    @property
    def settings(self) -> Project:
        """The settings of its project."""


class ExaminedText(Protocol):
    """What the commands say of a text."""

    @property
    def findings(self) -> Sequence[Finding]:
        """Findings and tasks."""

    @property
    def errors(self) -> Sequence[RobosmiError]:
        """What would stop a command."""


class SuggestedText(Protocol):
    """A word that may stand at a place, and what it means."""

    @property
    def text(self) -> str:
        """As it is inserted."""

    @property
    def detail(self) -> str:
        """What it means."""


class AnsweredChoice(Protocol):
    """An answer to a choice."""

    @property
    def title(self) -> str:
        """What it does."""

    @property
    def best(self) -> bool:
        """Whether nothing fits better."""

    @property
    def text(self) -> str:
        """The project file with the answer."""


class EditedTexts(Protocol):
    """The texts that the user edits."""

    @property
    def texts(self) -> dict[Path, str]:
        """The texts by the paths of their files."""

    def examine(self, path: Path) -> ExaminedText:
        """What the commands say of a text."""

    def suggestions(self, path: Path, line: int, column: int) -> tuple[int, Sequence[SuggestedText]]:
        """The column from which a line is replaced, and what may stand there."""

    def answers(self, path: Path, line: int) -> Sequence[AnsweredChoice]:
        """The answers to the choice in a line of a project file, or to all open ones."""
