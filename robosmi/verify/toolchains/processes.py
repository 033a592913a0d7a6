"""Processes that end with the run that started them, however that ends: by an error, an interruption, or a result that suffices.

Each is the leader of a session of its own and is killed together with everything that it has started. An interruption raises
`KeyboardInterrupt` in the main thread at any instruction, also while a process is being started, or while other threads wait for
theirs; both are taken care of here.
"""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from time import sleep
from types import FrameType
from typing import AnyStr, TypeAlias, TypeVar

from robosmi.base.ending_signals import ending_signals

_Job = TypeVar("_Job")
_Result = TypeVar("_Result")

_AGAIN_S = 0.05
"""How long to wait for threads before the processes that they have started meanwhile are killed, too."""
_Process: TypeAlias = "subprocess.Popen[str] | subprocess.Popen[bytes]"


class _OfThread(threading.local):
    """What belongs to one thread.

    Attributes:
        running: the processes that it has started; threads of one pool share the set.
    """

    def __init__(self) -> None:
        self.running: set[_Process] = set()


_THREAD = _OfThread()


@contextmanager
def ending_with_us(start: Callable[[], subprocess.Popen[AnyStr]]) -> Iterator[subprocess.Popen[AnyStr]]:
    """Context manager: a process that is killed at the end of the block, with its session.

    Args:
        start: starts it, as the leader of a new session (`start_new_session=True`).

    Raises:
        OSError: it cannot be started.
    """
    with ExitStack() as stack:
        with _interruptions_delayed():  # else one may come when the process runs and nobody has its handle
            process = stack.enter_context(start())
            stack.callback(_end, process)
            _THREAD.running.add(process)
        yield process


def _end(process: _Process) -> None:
    _kill(process)
    _THREAD.running.discard(process)


def _kill(process: _Process) -> None:
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)


@contextmanager
def _interruptions_delayed() -> Iterator[None]:
    """Context manager: handle signals that ask this process to end only after the block.

    They are not blocked in the operating system, because a process that is started in the block would inherit that.
    """
    if threading.current_thread() is not threading.main_thread():  # interruptions are raised in the main thread only
        yield
        return
    handlers = {number: handler for number in ending_signals() if callable(handler := signal.getsignal(number))}
    received: list[int] = []

    def note(number: int, _: FrameType | None) -> None:
        received.append(number)

    try:
        for one in handlers:
            signal.signal(one, note)
        yield
    finally:
        for one, handler in handlers.items():
            signal.signal(one, handler)
        for each in received:
            signal.raise_signal(each)


def in_parallel(work: Callable[[_Job], _Result], jobs: Iterable[_Job]) -> Generator[_Result, None, None]:
    """The results of jobs in their order, as many computed at once as there are cores.

    Jobs are taken from the iterable only as results are asked for, one more than there are cores, so that no core idles while a
    result is used. If a job fails, or the caller is interrupted or wants no further result (`close`), the processes that the
    jobs have started are killed, and the other jobs are given up.

    Args:
        work: does one job; it may start processes with `ending_with_us`.
        jobs: the jobs.
    """
    cores = os.cpu_count() or 1
    running: set[_Process] = set()

    def share() -> None:
        _THREAD.running = running

    pool = ThreadPoolExecutor(cores, initializer=share)
    waiting: deque[Future[_Result]] = deque()
    try:
        for job in jobs:
            waiting.append(pool.submit(work, job))
            if len(waiting) > cores:
                yield _taken(waiting)
        while waiting:
            yield _taken(waiting)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        while not all(job.done() for job in waiting):
            for process in tuple(running):
                _kill(process)
            sleep(_AGAIN_S)


def _taken(waiting: deque[Future[_Result]]) -> _Result:
    """The result of the first job; it stays among those that are waited for until it is there."""
    result = waiting[0].result()
    waiting.popleft()
    return result
