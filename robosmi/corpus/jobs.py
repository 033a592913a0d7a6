"""What goes between a run and its worker processes: the job of a program, and its result."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct, field

from robosmi.corpus.states import DONE
from robosmi.errors import SourceError

Row = dict[str, Any]
Rows = Mapping[str, Sequence[Mapping[str, Any]]]
"""Name of a table -> rows without their program."""


class OutsideError(SourceError):
    """A program cannot be run for a reason outside of it: a file that it needs is missing, its results cannot be written."""


class Limits(Struct, frozen=True):
    """What a step of one program may take.

    Attributes:
        seconds: time.
        megabytes: memory of the worker process and all that it starts, in 2^20 bytes.
        steps: name of a step -> limits of its own.
    """

    seconds: float = 300.0
    megabytes: int = 2000
    steps: dict[str, Limits] = {}

    def of(self, step: str) -> Limits:
        """The limits of a step."""
        return self.steps.get(step, self)


class ProgramWork(Struct):
    """A program in its worker, as the steps get it.

    Attributes:
        id: `programs.id`.
        path: the source file, or the folder with the program's source files.
        include_dirs: folders with headers.
        defines: macros defined from outside.
        migrate: settings that count before the project file beside the program.
        defaults: settings that count behind that file.
        output: folder for the results of this program.
        keep_models: whether models are to be stored.
        results: what a step leaves for the next ones.
    """

    id: str
    path: str
    include_dirs: list[str] = []
    defines: list[str] = []
    migrate: dict[str, str] = {}
    defaults: dict[str, str] = {}
    output: str = ""
    keep_models: bool = False
    results: dict[str, Any] = {}

    @property
    def folder(self) -> Path:
        """The folder of the program."""
        path = Path(self.path)
        return path if path.is_dir() else path.parent


class ProgramJob(Struct, frozen=True):
    """The steps that a worker runs for one program.

    Attributes:
        work: the program.
        steps: names of the steps, in order.
        limits: what they may take.
        tool: the version that the worker must have.
    """

    work: ProgramWork
    steps: tuple[str, ...]
    limits: Limits
    tool: str = ""


class ProgramStep(Struct):
    """A step of a program.

    Attributes:
        name: the step.
        state: see `states.STATES`.
        seconds: its time.
        peak_mb: the most memory that it added to the worker; None if the system does not tell.
        message: why it is not done.
        rows: what goes into the tables.
    """

    name: str
    state: str = DONE
    seconds: float = 0.0
    peak_mb: float | None = None
    message: str | None = None
    rows: dict[str, list[Row]] = {}


class ProgramResult(Struct):
    """All that was found out about a program.

    Attributes:
        id: `programs.id`.
        state: that of the step that ended it, else `done`.
        steps: those that were begun.
        files: path -> digest of the files that it depends on.
        message: why it is not done.
        worker: where it was run, for the user.
        other_version: whether it was not run because the worker has another version.
    """

    id: str
    state: str = DONE
    steps: list[ProgramStep] = field(default_factory=list)
    files: dict[str, str] = field(default_factory=dict)
    message: str | None = None
    worker: str = ""
    other_version: bool = False

    @property
    def step(self) -> str | None:
        """The step at which it ended without being done."""
        return self.steps[-1].name if self.steps and self.state != DONE else None

    @property
    def seconds(self) -> float:
        """The time of all steps."""
        return sum(step.seconds for step in self.steps)

    @property
    def peak_mb(self) -> float | None:
        """The most memory in a step."""
        return max((step.peak_mb for step in self.steps if step.peak_mb is not None), default=None)

    def rows(self) -> dict[str, list[Row]]:
        """The rows of all steps by table; findings add up, of another table the last step's count."""
        found: dict[str, list[Row]] = {}
        for step in self.steps:
            for table, rows in step.rows.items():
                found[table] = [*found.get(table, ()), *rows] if table == "findings" else list(rows)
        return found


def too_much(megabytes: int) -> str:
    """Why a program is too large that needs more memory than its limit, and what to do."""
    return f"it needs more than {megabytes} MB (raise megabytes in [limits])"


def too_long(seconds: float) -> str:
    """Why a program that is not done in time is not, and what to do."""
    return f"it takes longer than {seconds:g} s (raise seconds in [limits])"
