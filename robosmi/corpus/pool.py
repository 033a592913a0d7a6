"""Runs jobs in worker processes of this machine, a thread for each worker, and gives results as they come."""

from __future__ import annotations

import threading
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from queue import Empty, Queue
from typing import TypeVar

from robosmi.corpus.jobs import ProgramJob, ProgramResult
from robosmi.corpus.worker_process import Stopped, WorkerProcess

_LOOK_S = 0.2
"""Seconds between two looks whether the run is to stop."""
_Job = TypeVar("_Job")
_Result = TypeVar("_Result")


def run_in_pool(
    jobs: Iterable[ProgramJob], workers: int, steps: Sequence[str], stop: threading.Event | None = None
) -> Generator[ProgramResult, None, None]:
    """The results of jobs, as they come.

    Args:
        jobs: taken from as workers are free.
        workers: number of worker processes.
        steps: names of the steps.
        stop: once it is set, results end at once, and programs under way have none.

    Raises:
        InternalError: no worker can be started.
    """
    return in_workers(lambda worker, job: worker.run(job), jobs, workers, steps, stop)


def in_workers(
    work: Callable[[WorkerProcess, _Job], _Result],
    jobs: Iterable[_Job],
    workers: int,
    steps: Sequence[str],
    stop: threading.Event | None = None,
) -> Generator[_Result, None, None]:
    """The results of jobs that workers do, as they come; closing the generator ends the workers.

    Args:
        work: does a job with a worker.
        jobs: taken from as workers are free.
        workers: number of worker processes.
        steps: names of the steps that they load.
        stop: once it is set, results end at once, and jobs under way have none.
    """
    waiting, lock = iter(jobs), threading.Lock()
    results: Queue[tuple[_Result | None, BaseException | None]] = Queue(maxsize=workers)  # so that nothing piles up
    processes = [WorkerProcess(steps) for _ in range(workers)]
    over = threading.Event()

    def serve(process: WorkerProcess) -> None:
        try:
            while not over.is_set():
                with lock:
                    job = next(waiting, None)
                if job is None:
                    break
                results.put((work(process, job), None))
        except Stopped:
            pass
        except BaseException as error:
            results.put((None, error))
            return
        finally:
            process.stop()
        results.put((None, None))

    threads = [threading.Thread(target=serve, args=(process,), daemon=True) for process in processes]
    for thread in threads:
        thread.start()
    try:
        yield from _until_all_have_ended(results, workers, stop)
    finally:
        over.set()
        for process in processes:
            process.stop()
        while any(thread.is_alive() for thread in threads):
            while not results.empty():
                results.get_nowait()  # a thread may wait for room
            for thread in threads:
                thread.join(timeout=0.05)


def _until_all_have_ended(
    results: Queue[tuple[_Result | None, BaseException | None]], threads: int, stop: threading.Event | None
) -> Iterator[_Result]:
    while threads and not (stop is not None and stop.is_set()):
        try:
            result, error = results.get(timeout=_LOOK_S)
        except Empty:
            continue
        if error is not None:
            raise error
        if result is None:
            threads -= 1
        else:
            yield result
