"""A worker process: it reads jobs from standard input, one JSON document a line, and answers with messages on standard output.

It is started by `worker_process`, which watches its time and memory, and lives for many programs, so that what they share is
loaded once. It ends when its input ends, in the middle of a program, too: then nobody wants the result. Messages:

    {"ready": VERSION}            once, after what the steps need is loaded
    {"files": {PATH: DIGEST}}     what the program depends on
    {"begin": STEP}               a step begins
    {"step": {...}}               a step has ended, a `ProgramStep`
    {"end": true}                 the program is at its end
    {"value": ..., "error": ...}  the answer to a question about a model
"""

from __future__ import annotations

import errno
import gc
import os
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from queue import SimpleQueue
from typing import Any, BinaryIO

import msgspec

from robosmi.corpus import memory
from robosmi.corpus.digests import digest_of, tool_version
from robosmi.corpus.jobs import OutsideError, ProgramJob, ProgramStep, Row, too_much
from robosmi.corpus.output_folders import begin_with
from robosmi.corpus.states import DONE, FAILED, SKIPPED, TOO_LARGE
from robosmi.errors import MissingToolError, RobosmiError, TooLargeError
from robosmi.files import run_lock
from robosmi.inputs import InputRejectedError
from robosmi.plugins import content

RECORDS = ".runs"
"""The folder in a program's output folder for locks and records, which are for one program at a time and go with it."""
Send = Callable[[dict[str, Any]], None]
_COLLECT = 100
"""Programs after which all garbage is looked for; to look after each takes as long as half an analysis."""
_OUTSIDE = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES)
"""Faults of files that are none of the program: a full disk, a place that may not be read or written."""


def main() -> None:
    """Answer jobs until the input ends."""
    answers: BinaryIO = os.fdopen(os.dup(1), "wb", buffering=0)
    os.dup2(2, 1)  # what a library prints is no message
    jobs: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_listen, args=(jobs,), daemon=True).start()
    encoder = msgspec.json.Encoder()

    def send(message: dict[str, Any]) -> None:
        answers.write(encoder.encode(message) + b"\n")

    for step in sys.argv[1:]:
        content("chain", f"corpus_{step}")
    gc.collect()
    gc.freeze()  # what is loaded by now stays
    gc.set_threshold(200_000, 20, 20)  # as a command does
    send({"ready": tool_version()})
    count = 0
    while line := jobs.get():
        answer(line, send)
        count += 1
        if count % _COLLECT == 0:
            gc.collect()


def _listen(jobs: SimpleQueue[bytes]) -> None:
    """Hand on each line of the input; at its end this process is no longer wanted."""
    for line in sys.stdin.buffer:
        jobs.put(line)
    memory.kill(memory.descendants(os.getpid()))
    os._exit(0)


def answer(line: bytes, send: Send) -> None:
    """Do one job.

    Args:
        line: the job, or a question about a model.
        send: sends a message.
    """
    found = msgspec.json.decode(line)
    if "query" in found:
        from robosmi.corpus.model_queries import answered

        send(answered(**found["query"]))
        return
    run_program(msgspec.convert(found, ProgramJob), send)


def run_program(job: ProgramJob, send: Send) -> None:
    """Run the steps of a program up to the first that is not done.

    Args:
        job: the program.
        send: sends a message.
    """
    work = job.work
    try:
        files = {path: digest_of(path) for path in content("chain", "corpus_files")(work)}
    except Exception:  # the steps will say what is wrong with the program
        files = {work.path: digest_of(work.path)}
    send({"files": files})
    if work.output:
        records = Path(work.output) / RECORDS
        with run_lock.records_in(records):
            _run_steps(job, send)
        shutil.rmtree(records, ignore_errors=True)
    else:
        _run_steps(job, send)
    work.results.clear()
    send({"end": True})


def _run_steps(job: ProgramJob, send: Send) -> None:
    work = job.work
    for step in job.steps:
        send({"begin": step})
        memory.reset_peak()
        before = memory.peak_mb()
        memory.limit_own(job.limits.of(step).megabytes)
        done = ProgramStep(step)
        started = time.perf_counter()
        try:
            if work.output and step == job.steps[0]:
                begin_with(work.output)
            done.rows = {table: list(rows) for table, rows in content("chain", f"corpus_{step}")(work).items()}
        except MemoryError:
            done.state, done.message = TOO_LARGE, too_much(job.limits.of(step).megabytes)
        except (Exception, SystemExit) as error:
            done.state, done.message = state_of(error), message_of(error)
        done.seconds, done.peak_mb = time.perf_counter() - started, memory.growth_mb(before)
        send({"step": msgspec.to_builtins(_storable(done))})
        if done.state != DONE:
            break


def _storable(done: ProgramStep) -> ProgramStep:
    """The result with texts that UTF-8 can hold: a name in a program may be none."""
    done.message = _text(done.message)
    done.rows = {table: [_row(row) for row in rows] for table, rows in done.rows.items()}
    return done


def _row(row: Row) -> Row:
    return {name: _text(value) if isinstance(value, str) else value for name, value in row.items()}


def _text(value: str | None) -> str | None:
    """A text without halves of characters and null characters, which databases refuse."""
    if value is None or (value.isascii() and "\0" not in value):
        return value
    return value.encode("utf-8", "backslashreplace").decode().replace("\0", "\\0")


def causes(error: BaseException) -> Iterator[BaseException]:
    """An exception and what it came of."""
    seen: BaseException | None = error
    while seen is not None:
        yield seen
        seen = seen.__cause__ or seen.__context__


def state_of(error: BaseException) -> str:
    """The state of a program whose step raised an exception.

    A missing tool or file and a full disk are no faults of the program: it counts as not run, and the next run tries it again.
    """
    for each in causes(error):
        if isinstance(each, (MissingToolError, OutsideError)) or (isinstance(each, OSError) and each.errno in _OUTSIDE):
            return SKIPPED
        if isinstance(each, (MemoryError, TooLargeError)) or (isinstance(each, InputRejectedError) and each.errno == errno.EFBIG):
            return TOO_LARGE
    return FAILED


def message_of(error: BaseException) -> str:
    """An exception in words: place, cause and advice."""
    if not isinstance(error, RobosmiError):
        return f"{type(error).__name__}: {error}"
    place = f"{error.location}: " if error.location else ""
    return f"{place}{error.message}{f' ({error.fix})' if error.fix else ''}"


if __name__ == "__main__":
    main()
