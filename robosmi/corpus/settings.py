"""How a corpus is run, from what the specification and the caller say."""

from __future__ import annotations

import os
from collections.abc import Sequence

from robosmi.corpus.running import RunOptions
from robosmi.corpus.spec import Spec, checked_steps
from robosmi.errors import UsageError

DEFAULT_STEPS = ("analyse",)


def options_of(
    spec: Spec,
    *,
    steps: Sequence[str] | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    store: str | None = None,
    retry: frozenset[str] = frozenset(),
    models: bool = False,
) -> RunOptions:
    """The options of a run.

    Args:
        spec: the specification.
        steps: names of the steps; if None those of the specification, or `analyse`.
        jobs: number of worker processes; as many as this process may use cores if None.
        scheduler, store, retry: see `RunOptions`.
        models: whether models are kept; the specification may say so, too.

    Raises:
        UsageError: there is no such step, or jobs is below 1.
    """
    if jobs is not None and jobs < 1:
        raise UsageError(f"jobs = {jobs} is no number of worker processes", fix="give at least 1")
    chosen = checked_steps(list(steps)) if steps is not None else spec.steps or DEFAULT_STEPS
    return RunOptions(chosen, jobs or cores(), scheduler, store, retry, models or spec.keep_models)


def cores() -> int:
    """The cores of the processor that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
