"""Many programs at once: a run that restarts, its results in tables, and what to do next.

`run` runs a specification and `open_store` opens the results of a run. The command is `robosmi corpus`.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robosmi.corpus.notebook import BackgroundRun
    from robosmi.corpus.store import Store

__all__ = ["open_store", "run"]


def run(
    spec: str | Path,
    output: str | Path,
    *,
    steps: Sequence[str] | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    store: str | None = None,
    retry: Sequence[str] = (),
    models: bool = False,
) -> BackgroundRun:
    """Run the programs of a specification that are new or changed, in the background.

    Args:
        spec: the specification, a TOML file.
        output: the output folder.
        steps: names of the steps; those of the specification, or `analyse`, if None.
        jobs: number of worker processes; as many as there are cores if None.
        scheduler: address of a scheduler of Dask, instead of worker processes here.
        store: SQLAlchemy URL of the store; `corpus.sqlite` in the output folder if None.
        retry: states (`failed`, `timeout` ...) whose programs are run again although nothing has changed.
        models: whether the models of the programs are kept.

    Returns:
        The run: iterate over it for results as they come, `wait` for its end, show it in a notebook, or call `to_pandas`.

    Raises:
        SourceError: the specification cannot be read, or has a key or value that means nothing.
        UsageError: there is no such step or state, or jobs is below 1.
    """
    from robosmi.corpus.notebook import begin  # a program that only opens stores needs none of it

    return begin(
        spec, output, steps=steps, jobs=jobs, scheduler=scheduler, store=store, retry=retry, models=models
    )  # fmt: skip


def open_store(output: str | Path, store: str | None = None) -> Store:
    """The tables of a run, for questions in SQL (`query`).

    Args:
        output: the output folder of the run.
        store: SQLAlchemy URL of the store, if it is not in the output folder.

    Raises:
        SourceError: there is none, or it is of another version.
    """
    from robosmi.corpus.running import store_place
    from robosmi.corpus.store import Store

    return Store(store_place(Path(output), store))
