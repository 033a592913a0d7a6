"""A worker process as seen from the run: started, given one job after the other, watched, killed and replaced.

A program that crashes, hangs or takes too much memory ends its worker and nothing else. Pool and cluster use this class alike.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import Any

import msgspec

from robosmi.corpus import memory
from robosmi.corpus.jobs import ProgramJob, ProgramResult, ProgramStep, too_long, too_much
from robosmi.corpus.states import FAILED, SKIPPED, TIMEOUT, TOO_LARGE
from robosmi.errors import InternalError

LOOK_S = 0.05
"""Seconds between two looks at the memory of a worker."""
START_S = 120.0
"""Seconds that a worker may take to start."""
_NO_MEMORY = ("out of memory", "bad_alloc", "Cannot allocate memory", "MemoryError")
_TAIL = 400


class Stopped(Exception):
    """The worker was stopped by the run itself, in the middle of a job."""


class WorkerProcess:
    """One process for one program after the other.

    Args:
        steps: names of the steps, which it loads at its start.
    """

    def __init__(self, steps: Sequence[str]) -> None:
        self._steps = tuple(steps)
        self._process: subprocess.Popen[bytes] | None = None
        self._messages: SimpleQueue[bytes] = SimpleQueue()
        self._complaints: deque[bytes] = deque(maxlen=2)
        self._stopped = False
        self._lock = threading.Lock()
        self.tool = ""

    def start(self) -> None:
        """Start the process, if it does not run, and wait until it is ready.

        Raises:
            InternalError: it does not start.
            Stopped: the run is over.
        """
        with self._lock:
            if self._stopped:
                raise Stopped
            if self._process is not None and self._process.poll() is None:
                return
            self._end()
            self._complaints.clear()
            environment = {**os.environ, "PYTHONPATH": os.pathsep.join(each or os.getcwd() for each in sys.path)}
            self._process = process = subprocess.Popen(
                [sys.executable, "-m", "robosmi.corpus.worker", *self._steps],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True, env=environment,
            )  # fmt: skip
        self._messages = SimpleQueue()
        threading.Thread(target=_hand_on, args=(process, self._messages), daemon=True).start()
        threading.Thread(target=_collect, args=(process, self._complaints), daemon=True).start()
        ready = self._next(time.monotonic() + START_S, None)
        if ready is None or "ready" not in ready:
            said = self._complained()
            self.kill()
            if self._stopped:
                raise Stopped
            raise InternalError(f"a worker process does not start: {said or 'it says nothing'}")
        self.tool = str(ready["ready"])

    def _next(self, deadline: float, megabytes: int | None) -> dict[str, Any] | None:
        """The next message; None at the deadline, or if the worker has ended.

        Raises:
            MemoryError: the worker takes more memory than that.
        """
        while (left := deadline - time.monotonic()) > 0:
            try:
                line = self._messages.get(timeout=min(left, LOOK_S))
            except Empty:
                if megabytes is not None and self._taken() > megabytes * memory.MB:
                    raise MemoryError from None
                continue
            if not line:
                return None
            found: dict[str, Any] = msgspec.json.decode(line)
            return found
        return None

    def _taken(self) -> int:
        """The bytes in memory of the worker and all that it has started."""
        process = self._process
        return memory.of_all(process.pid) if process is not None else 0

    def _send(self, message: object) -> bool:
        """Send a job; whether the worker took it."""
        assert self._process is not None
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(msgspec.json.encode(message) + b"\n")
            self._process.stdin.flush()
        except (OSError, ValueError):
            return False
        return True

    def run(self, job: ProgramJob) -> ProgramResult:
        """Run the steps of one program, whatever becomes of the worker.

        Raises:
            InternalError: no worker can be started.
            Stopped: the run is over.
        """
        self.start()
        if job.tool and self.tool != job.tool:
            said = f"the worker has RoboSMi {self.tool}, and the run {job.tool}: install the same version and data everywhere"
            return ProgramResult(job.work.id, SKIPPED, message=said, other_version=True)
        result = ProgramResult(job.work.id, worker=f"{os.uname().nodename if hasattr(os, 'uname') else ''}")
        if not self._send(job):
            self.kill()
            self.start()
            self._send(job)
        limits, begun, started = job.limits, "", time.monotonic()
        while True:
            try:
                message = self._next(started + limits.seconds, limits.megabytes)
            except MemoryError:
                return self._too_large(result, begun, started, limits.megabytes)
            if message is None:
                if self._stopped:
                    raise Stopped
                if self._process is not None and self._messages_ended():
                    return self._crashed(result, begun, started, limits.megabytes)
                return self._killed(result, begun, started, TIMEOUT, too_long(limits.seconds), None)
            if "files" in message:
                result.files = message["files"]
            elif "begin" in message:
                begun, started, limits = message["begin"], time.monotonic(), job.limits.of(message["begin"])
            elif "step" in message:
                done = msgspec.convert(message["step"], ProgramStep)
                result.steps.append(done)
                result.state, result.message = done.state, done.message
                begun, started = "", time.monotonic()
            else:
                if result.state == TOO_LARGE:
                    self.kill()  # what it has left of its memory may not be enough for the next one
                return result

    def ask(self, question: dict[str, Any], seconds: float) -> dict[str, Any]:
        """The answer to a question about a model: `value`, or `error` with the reason why there is none."""
        self.start()
        self._send({"query": question})
        try:
            found = self._next(time.monotonic() + seconds, None)
        finally:
            if self._stopped:
                raise Stopped
        if found is None:
            late = not self._messages_ended()
            said = f"it takes longer than {seconds:g} s" if late else f"the worker process ended: {self._complained()}"
            self.kill()
            return {"error": said}
        return found

    def _messages_ended(self) -> bool:
        """Whether the worker has ended."""
        if self._process is None:
            return True
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(timeout=0.2)
        return self._process.poll() is not None

    def _killed(
        self, result: ProgramResult, step: str, started: float, state: str, message: str, peak: float | None
    ) -> ProgramResult:
        self.kill()
        result.state, result.message = state, message
        result.steps.append(ProgramStep(step or "start", state, time.monotonic() - started, peak, message))
        return result

    def _crashed(self, result: ProgramResult, step: str, started: float, megabytes: int) -> ProgramResult:
        assert self._process is not None
        code, said = self._process.poll(), self._complained()
        if any(words in said for words in _NO_MEMORY):
            return self._too_large(result, step, started, megabytes)
        cause = signal.strsignal(-code) if code is not None and code < 0 else f"exit code {code}"
        return self._killed(result, step, started, FAILED, f"the worker crashed: {cause}{said and f': {said}'}", None)

    def _too_large(self, result: ProgramResult, step: str, started: float, megabytes: int) -> ProgramResult:
        return self._killed(result, step, started, TOO_LARGE, too_much(megabytes), megabytes)

    def _complained(self) -> str:
        """The last line that the worker wrote to standard error."""
        lines = b"".join(self._complaints).decode(errors="replace").strip().splitlines()
        return lines[-1][-_TAIL:] if lines else ""

    def kill(self) -> None:
        """End the process with all that it has started."""
        with self._lock:
            self._end()

    def stop(self) -> None:
        """As `kill`, and start none any more."""
        self._stopped = True
        self.kill()

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is None:
            return
        with suppress(ProcessLookupError, PermissionError):
            if process.poll() is None and hasattr(signal, "SIGSTOP"):
                os.kill(process.pid, signal.SIGSTOP)  # so that it starts nothing while it is looked at
        memory.kill([process.pid, *memory.descendants(process.pid)])
        process.wait()
        with suppress(OSError, ValueError):
            if process.stdin is not None:
                process.stdin.close()  # the threads that read close the others


def _hand_on(process: subprocess.Popen[bytes], messages: SimpleQueue[bytes]) -> None:
    """Put each line of a worker into the queue, and an empty one at its end."""
    assert process.stdout is not None
    with suppress(OSError, ValueError):
        for line in process.stdout:
            messages.put(line)
    messages.put(b"")
    with suppress(OSError):
        process.stdout.close()


def _collect(process: subprocess.Popen[bytes], complaints: deque[bytes]) -> None:
    """Keep the end of what a worker writes to standard error."""
    assert process.stderr is not None
    with suppress(OSError, ValueError), process.stderr as stream:
        while data := os.read(stream.fileno(), 4096):
            complaints.append(data)
