"""Runs jobs on a cluster of Dask (extra `cluster`): its scheduler hands out the jobs, and hands those of a lost worker out again.

On each Dask worker a job runs in a worker process of ours, as in the pool, so that limits, crashes and results are the same.
"""

from __future__ import annotations

import atexit
import logging
import threading
from collections.abc import Generator, Iterator, Sequence
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
        threads = _checked(client, scheduler)
        waiting = iter(jobs)
        names: dict[str, str] = {}

        def submit(count: int) -> list[Any]:
            made = []
            for job in islice(waiting, count):
                future = client.submit(run_one, msgspec.json.encode(job), tuple(steps), pure=False, retries=1)
                names[future.key] = job.work.id
                made.append(future)
            return made

        results = distributed.as_completed(submit(threads * _AHEAD), loop=client.loop, raise_errors=False)
        while names:
            try:
                future = next(results)
            except StopIteration:
                break
            name = names.pop(future.key)
            if future.status == "finished":
                yield msgspec.json.decode(future.result(), type=ProgramResult)
            elif future.status == "cancelled" or client.status != "running":
                raise lost
            else:
                yield ProgramResult(name, SKIPPED, message=f"the cluster gave it up: {future.exception()}")
            future.release()
            results.update(submit(1))
        if names:
            raise lost
    except (OSError, TimeoutError) as error:
        raise lost from error
    finally:
        client.close(timeout=2)


def _checked(client: Any, scheduler: str) -> int:
    """The number of threads of the cluster's workers, whose version is checked.

    Raises:
        SourceError: there is no worker, or none with this version.
    """
    try:
        client.wait_for_workers(1, timeout=_CONNECT_S)
    except TimeoutError as error:
        raise SourceError(f"the scheduler {scheduler} has no workers", fix=f"start some: dask worker {scheduler}") from error
    here = tool_version()
    versions: dict[str, str] = client.run(tool_version, on_error="return")
    others = {worker: said for worker, said in versions.items() if said != here}
    if len(others) == len(versions):
        worker, said = next(iter(others.items()))
        raise SourceError(f"no worker has RoboSMi {here}; {worker} has {said}", fix="install the same version on all machines")
    return sum(client.nthreads().values())
