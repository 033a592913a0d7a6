"""What runs the jobs of a run: worker processes of this machine, or a cluster."""

from __future__ import annotations

import threading
from collections.abc import Generator, Iterator, Sequence
from functools import partial

from robosmi.corpus.jobs import ProgramJob, ProgramResult
from robosmi.corpus.pool import run_in_pool
from robosmi.corpus.running import Backend, RunOptions


def backend_of(options: RunOptions, stop: threading.Event | None = None) -> Backend:
    """What runs the jobs.

    Args:
        options: names the scheduler of a cluster, or the number of worker processes.
        stop: once it is set, results end at once, and programs under way have none.
    """
    if options.scheduler is not None:
        from robosmi.corpus.cluster import run_on_cluster  # an extra

        return partial(run_on_cluster, options.scheduler, stop=stop)

    def pool(jobs: Iterator[ProgramJob], steps: Sequence[str]) -> Generator[ProgramResult, None, None]:
        return run_in_pool(jobs, options.jobs, steps, stop)

    return pool
