"""Runs jobs on a cluster of Dask (extra `cluster`): its scheduler hands out the jobs, and hands those of a lost worker out again.

On each Dask worker a job runs in a worker process of ours, as in the pool, so that limits, crashes and results are the same.
"""

from __future__ import annotations

import atexit
import logging
import threading
import time
from collections.abc import Generator, Iterable, Iterator, Sequence
from importlib import import_module
from itertools import islice
from typing import Any

import msgspec

from robosmi.corpus.digests import tool_version
from robosmi.corpus.jobs import ProgramJob, ProgramResult
from robosmi.corpus.states import SKIPPED
from robosmi.corpus.worker_process import WorkerProcess
from robosmi.errors import MissingToolError, SourceError

_CONNECT_S = 30.0
_AHEAD = 3
"""Jobs in the cluster for each of its threads, so that none idles and nothing piles up."""
_LOOK_S = 0.05
"""Seconds between two looks for a result."""
_WORKERS_S = 5.0
"""Seconds without a result after which the workers of the cluster are looked at again."""
_local = threading.local()
_processes: list[WorkerProcess] = []


def run_one(data: bytes, steps: tuple[str, ...]) -> bytes:
    """Run one job on a Dask worker, in a worker process that its thread keeps.

    Args:
        data: the job as JSON.
        steps: names of the steps.
    """
    process: WorkerProcess | None = getattr(_local, "process", None)
    if process is None:
        process = _local.process = WorkerProcess(steps)
        _processes.append(process)
    return msgspec.json.encode(process.run(msgspec.json.decode(data, type=ProgramJob)))


@atexit.register
def _end() -> None:
    for process in _processes:
        process.stop()


def run_on_cluster(scheduler: str, jobs: Iterator[ProgramJob], steps: Sequence[str]) -> Generator[ProgramResult, None, None]:
    """The results of jobs, as they come.

    Args:
        scheduler: its address.
        jobs: taken from as the cluster has room.
        steps: names of the steps.

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
        distributed.comm.get_address_host_port(scheduler, strict=False)  # a client that fails in it waits a minute for its end
        client = distributed.Client(scheduler, timeout=_CONNECT_S, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise SourceError(
            f"there is no scheduler at {scheduler}", fix="start it: dask scheduler; give its address: tcp://HOST:PORT"
        ) from error
    try:
        workers = _Workers(client, scheduler)
        waiting = iter(jobs)
        under_way: dict[str, tuple[Any, ProgramJob]] = {}

        def submit(some: Iterable[ProgramJob]) -> list[Any]:
            made = []
            for job in some:
                future = client.submit(
                    run_one, msgspec.json.encode(job), tuple(steps), pure=False, retries=1, workers=workers.right
                )  # fmt: skip
                under_way[future.key] = (future, job)
                made.append(future)
            return made

        results = distributed.as_completed(
            submit(islice(waiting, workers.threads * _AHEAD)), loop=client.loop, raise_errors=False
        )  # fmt: skip
        looked = time.monotonic()
        while under_way:
            if not results.has_ready() and not results.is_empty():
                time.sleep(_LOOK_S)
                if time.monotonic() - looked > _WORKERS_S:
                    if workers.replaced():  # the jobs wait for workers that will not come back
                        jobs_again = [job for _, job in under_way.values()]
                        client.cancel([future for future, _ in under_way.values()])
                        under_way.clear()
                        results.update(submit(jobs_again))
                    looked = time.monotonic()
                continue
            try:
                future = next(results)
            except StopIteration:
                break
            if (known := under_way.pop(future.key, None)) is None:
                continue  # it was cancelled and its job is submitted again
            if future.status == "finished":
                yield msgspec.json.decode(future.result(), type=ProgramResult)
            elif future.status == "cancelled" or client.status != "running":
                raise lost
            else:
                yield ProgramResult(known[1].work.id, SKIPPED, message=f"the cluster gave it up: {future.exception()}")
            future.release()
            results.update(submit(islice(waiting, 1)))
            looked = time.monotonic()
        if under_way:
            raise lost
    except (OSError, TimeoutError) as error:
        raise lost from error
    finally:
        client.close(timeout=2)


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
