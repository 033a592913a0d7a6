"""Runs jobs on a cluster of Dask (extra `cluster`): its scheduler hands out the jobs, and hands those of a lost worker out again.

On each Dask worker a job runs in a worker process of ours, as in the pool, so that limits, crashes and results are the same.
"""

from __future__ import annotations

import asyncio
import atexit
import logging
import threading
import time
from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import suppress
from importlib import import_module
from itertools import islice
from typing import Any
from uuid import uuid4

import msgspec

from robosmi.corpus.digests import tool_version
from robosmi.corpus.jobs import ProgramJob, ProgramResult
from robosmi.corpus.states import SKIPPED
from robosmi.corpus.worker_process import Stopped, WorkerProcess
from robosmi.errors import MissingToolError, SourceError

_CONNECT_S = 30.0
_REACH_S = 5.0
"""Seconds after which an address that does not answer has no scheduler."""
_AHEAD = 4
"""Batches in the cluster for each of its threads, so that none idles and nothing piles up."""
_BATCH_S, _BATCH = 0.25, 16
"""About the seconds that a batch takes, and the most jobs in it: Dask spends 10 ms on a task, half an analysis."""
_LOOK_S = 0.01
"""Seconds between two looks for a result."""
_WORKERS_S = 5.0
"""Seconds without a result after which the workers of the cluster are looked at again."""
_local = threading.local()
_processes: dict[str, list[WorkerProcess]] = {}
"""Run -> its worker processes on this Dask worker."""
_over: set[str] = set()
"""Runs that have ended."""


def run_batch(data: bytes, steps: tuple[str, ...], run: str) -> bytes:
    """Run jobs on a Dask worker, in a worker process that its thread keeps for the run.

    Args:
        data: the jobs as JSON.
        steps: names of the steps.
        run: names the run.

    Returns:
        The results as JSON; those of the first jobs, if these take long.

    Raises:
        Stopped: the run is over.
    """
    if run in _over:
        raise Stopped
    kept: dict[str, WorkerProcess] = _local.__dict__.setdefault("kept", {})
    if (process := kept.get(run)) is None:
        process = kept[run] = WorkerProcess(steps)
        _processes.setdefault(run, []).append(process)
    results = []
    until = time.monotonic() + _BATCH_S
    for job in msgspec.json.decode(data, type=list[ProgramJob]):
        results.append(process.run(job))
        if time.monotonic() > until:
            break
    return msgspec.json.encode(results)


def end_run(run: str) -> None:
    """End what a run has started on a Dask worker, in the middle of a program, too."""
    _over.add(run)
    for process in _processes.pop(run, []):
        process.stop()


@atexit.register
def _end() -> None:
    for run in list(_processes):
        end_run(run)


def run_on_cluster(
    scheduler: str, jobs: Iterator[ProgramJob], steps: Sequence[str], stop: threading.Event | None = None
) -> Generator[ProgramResult, None, None]:
    """The results of jobs, as they come.

    Args:
        scheduler: its address.
        jobs: taken from as the cluster has room.
        steps: names of the steps.
        stop: once it is set, results end at once, and programs under way have none.

    Raises:
        MissingToolError: Dask is not installed.
        SourceError: the scheduler is not there, or dies; it has no workers, or none with this version of RoboSMi.
    """
    try:
        distributed: Any = import_module("distributed")  # its types are incomplete
    except ImportError as error:
        raise MissingToolError(
            "a cluster needs the package distributed", fix="install it: pip install 'robosmi[cluster]'"
        ) from error
    for name in ("client", "batched"):  # a lost connection is our own message
        logging.getLogger(f"distributed.{name}").setLevel(logging.CRITICAL)
    lost = SourceError(
        f"the scheduler {scheduler} does not answer any more",
        fix="start it and run the same command again: what is stored stays",
    )  # fmt: skip
    try:
        asyncio.run(_greet(distributed, scheduler))  # a client that fails in it takes a minute to end
        client = distributed.Client(scheduler, timeout=_CONNECT_S, set_as_default=False)
    except Exception as error:  # what else answers there says anything, and lets Dask ask for any amount of memory
        raise SourceError(
            f"there is no scheduler at {scheduler} that answers",
            fix="start it: dask scheduler; give its address: tcp://HOST:PORT",
        ) from error
    run = uuid4().hex
    try:
        workers = _Workers(client, scheduler)
        waiting = _Waiting(jobs)
        under_way: dict[str, tuple[Any, list[ProgramJob]]] = {}

        def submit(batch: list[ProgramJob]) -> Any:
            future = client.submit(
                run_batch, msgspec.json.encode(batch), tuple(steps), run, pure=False, retries=1, workers=workers.right
            )  # fmt: skip
            under_way[future.key] = (future, batch)
            return future

        def fill() -> Iterator[Any]:
            while len(under_way) < workers.threads * _AHEAD and (batch := waiting.batch()):
                yield submit(batch)

        results = distributed.as_completed(list(fill()), loop=client.loop, raise_errors=False)
        looked = time.monotonic()
        while under_way and not (stop is not None and stop.is_set()):
            if not results.has_ready() and not results.is_empty():
                time.sleep(_LOOK_S)
                if time.monotonic() - looked > _WORKERS_S:
                    if workers.replaced():  # the jobs wait for workers that will not come back
                        waiting.again(job for _, batch in under_way.values() for job in batch)
                        client.cancel([future for future, _ in under_way.values()])
                        under_way.clear()
                        results.update(list(fill()))
                    looked = time.monotonic()
                continue
            try:
                future = next(results)
            except StopIteration:
                break
            if (known := under_way.pop(future.key, None)) is None:
                continue  # it was cancelled and its jobs are submitted again
            batch = known[1]
            if future.status == "finished":
                done = msgspec.json.decode(future.result(), type=list[ProgramResult])
                waiting.again(batch[len(done) :])
                waiting.learn(done)
                yield from done
            elif future.status == "cancelled" or client.status != "running":
                raise lost
            elif future.status in ("pending", "lost"):  # its result died with its worker, and another one computes it again
                under_way[future.key] = known
                results.add(future)
                continue
            elif len(batch) > 1:  # one of them ends the workers
                results.update([submit([job]) for job in batch])
            else:
                yield ProgramResult(batch[0].work.id, SKIPPED, message=f"the cluster gave it up: {future.exception()}")
            future.release()
            results.update(list(fill()))
            looked = time.monotonic()
        else:
            under_way.clear()  # all have ended, or are not wanted
        if under_way:
            raise lost
    except (OSError, TimeoutError) as error:
        raise lost from error
    finally:
        if client.status == "running":
            with suppress(Exception):  # what cannot be ended ends with its program
                client.run(end_run, run, on_error="ignore")
        client.close(timeout=2)


class _Waiting:
    """Jobs that wait, taken in batches: several where they are short.

    Args:
        jobs: taken from as batches are.
    """

    def __init__(self, jobs: Iterable[ProgramJob]) -> None:
        self._again: list[ProgramJob] = []
        self._jobs = iter(jobs)
        self._seconds = _BATCH_S
        """What a program takes, the last ones above all."""

    def batch(self) -> list[ProgramJob]:
        """The next jobs; none at the end."""
        size = min(max(int(_BATCH_S / max(self._seconds, 1e-3)), 1), _BATCH)
        taken, self._again = self._again[:size], self._again[size:]
        return [*taken, *islice(self._jobs, size - len(taken))]

    def again(self, jobs: Iterable[ProgramJob]) -> None:
        """Put back jobs that were not run."""
        self._again += jobs

    def learn(self, results: Iterable[ProgramResult]) -> None:
        """Look at what programs took."""
        for result in results:
            self._seconds += (result.seconds - self._seconds) / 8


async def _greet(distributed: Any, scheduler: str) -> None:
    """Connect to a scheduler and leave again.

    Raises:
        Exception: nothing answers there, or not as a scheduler.
    """
    settings = distributed.Security().get_connection_args("client")
    connected = distributed.comm.connect(scheduler, timeout=_REACH_S, **settings)
    answered = await asyncio.wait_for(connected, _REACH_S)  # it waits for ever for who listens and says nothing
    await answered.close()


class _Workers:
    """The workers of a cluster that have this version of RoboSMi and its plug-ins; only they get jobs.

    Args:
        client: connected to the scheduler.
        scheduler: its address.

    Raises:
        SourceError: there is no worker, or none with this version.
    """

    def __init__(self, client: Any, scheduler: str) -> None:
        self._client = client
        try:
            client.wait_for_workers(1, timeout=_CONNECT_S)
        except TimeoutError as error:
            raise SourceError(f"the scheduler {scheduler} has no workers", fix=f"start some: dask worker {scheduler}") from error
        here = tool_version()
        self._versions: dict[str, str] = client.run(tool_version, on_error="return")
        self.right = [worker for worker, said in self._versions.items() if said == here]
        if not self.right:
            worker, said = next(iter(self._versions.items()))
            raise SourceError(
                f"no worker has RoboSMi {here}; {worker} has {said}", fix="install the same version on all machines"
            )
        threads = client.nthreads()
        self.threads: int = sum(threads.get(worker, 1) for worker in self.right)

    def replaced(self) -> bool:
        """Look at the workers again; whether all that had this version are gone, and there are others with it."""
        there = set(self._client.nthreads())
        if new := [worker for worker in there if worker not in self._versions]:
            self._versions.update(self._client.run(tool_version, workers=new, on_error="return"))
        here, before = tool_version(), set(self.right)
        self.right = [worker for worker in there if self._versions.get(worker) == here] or self.right
        return before.isdisjoint(self.right)
