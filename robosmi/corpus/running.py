"""A corpus run: which programs are new or changed, their results stored as they come, and what is counted in the end."""

from __future__ import annotations

import hashlib
import os
import re
import time
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any, Protocol

import msgspec
from msgspec import Struct

from robosmi.base.data_text import json_written
from robosmi.base.file_locks import lock_now, unlock
from robosmi.base.quantities import quantity
from robosmi.corpus.digests import Digests, digest_of_files, digest_of_text, tool_version
from robosmi.corpus.jobs import ProgramJob, ProgramResult, ProgramWork
from robosmi.corpus.output_folders import end_with
from robosmi.corpus.programs import SOURCES, ProgramSource, program_sources
from robosmi.corpus.repositories import name_commit, remove_unused, repository_of
from robosmi.corpus.spec import Spec
from robosmi.corpus.states import DONE, FAILED, FAILURES, SKIPPED, STATES, TIMEOUT, TOO_LARGE
from robosmi.corpus.store import FILE, Store, StoredResult
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError, SourceError, StoppedError, UsageError, did_you_mean
from robosmi.plugins import content

LOCK = "corpus.lock"
RESULTS = "programs"
"""The folder in OUT with a folder for each program that has migrated files or models."""
SHOWN = 20
"""Programs that are reported one by one."""


class Backend(Protocol):
    """What runs jobs: the pool, or a cluster."""

    def __call__(self, jobs: Iterator[ProgramJob], steps: Sequence[str]) -> Generator[ProgramResult, None, None]:
        """The results of jobs, as they come."""


class RunOptions(Struct, frozen=True):
    """How a corpus is run.

    Attributes:
        steps: names of the steps.
        jobs: number of worker processes.
        scheduler: address of a scheduler of Dask; None for worker processes of this machine.
        store: SQLAlchemy URL of the store; None for `OUT/corpus.sqlite`.
        retry: states whose programs are run again although nothing has changed.
        keep_models: whether models are stored.
    """

    steps: tuple[str, ...]
    jobs: int = 1
    scheduler: str | None = None
    store: str | None = None
    retry: frozenset[str] = frozenset()
    keep_models: bool = False


class Summary(Struct):
    """What a run has counted.

    Attributes:
        programs: programs of the specification.
        done, failed, timeout, too_large, skipped: programs by their state now, whenever they were run.
        unchanged: programs that were not run again.
        run: programs that were run now.
        no_longer_listed: programs of the store that the specification no longer has.
        seconds: time of the run.
        store: the file or URL of the store.
    """

    programs: int = 0
    done: int = 0
    failed: int = 0
    timeout: int = 0
    too_large: int = 0
    skipped: int = 0
    unchanged: int = 0
    run: int = 0
    no_longer_listed: int = 0
    seconds: float = 0.0
    store: str = ""


class RunProgress(Struct):
    """How far a run is: programs that are to be run, those that were, those that are not done, and the time since it began."""

    total: int
    ended: int
    failed: int
    seconds: float

    @property
    def rate(self) -> float:
        """Programs in a second."""
        return self.ended / self.seconds if self.seconds > 0 else 0.0

    @property
    def left_s(self) -> float | None:
        """Seconds that are left if it goes on so; None at the beginning."""
        return (self.total - self.ended) / self.rate if self.ended else None


ProgressReport = Callable[[RunProgress], None]


def store_place(out: Path, url: str | None) -> str | Path:
    """Where the store of an output folder is."""
    return url if url is not None else out / FILE


class CorpusRun:
    """One run of a corpus. `results` does the work; `summary` and `findings` are complete when it has ended.

    Args:
        spec: the specification.
        out: the output folder.
        options: how it is run.
        told: told of each result.

    Raises:
        SourceError: the programs or the store cannot be read.
        MissingToolError: git or a driver is missing.
    """

    def __init__(self, spec: Spec, out: Path, options: RunOptions, told: ProgressReport | None = None) -> None:
        self.spec, self.out, self.options = spec, out.absolute(), options
        self._told = told or (lambda _: None)
        self.summary = Summary()
        self.findings: list[Finding] = []
        self._tool = tool_version()
        self._skipped_reported = 0
        self.other_version = False
        """Whether programs were not run because a worker has another version."""
        self.progress = RunProgress(0, 0, 0, 0.0)

    def results(self, backend: Backend) -> Generator[ProgramResult, None, None]:
        """Run what is new or changed, store each result as it comes, and give it.

        Args:
            backend: runs the jobs.

        Raises:
            SourceError: the programs or the store cannot be read, the store cannot be written, or a setting is unknown.
            StoppedError: another run is at work in the output folder.
        """
        started = time.monotonic()
        self._check_settings()
        with _alone(self.out):
            sources = program_sources(self.spec, self.out)
            store = Store(store_place(self.out, self.options.store), write=True)
            try:
                self.summary.store = store.place
                yield from self._run(sources, store, backend, started)
                self._close(store)
            finally:
                store.close()
                self.summary.seconds = round(time.monotonic() - started, 3)

    def _check_settings(self) -> None:
        """Refuse a target, board or platform that is unknown, once and before any program is run with it."""
        named = [("[migrate]", self.spec.migrate)]
        named += [(f"migrate of [[programs]] number {place.number}", place.migrate) for place in self.spec.places]
        for where, settings in named:
            try:
                content("chain", "corpus_settings")(settings)
            except RobosmiError as error:
                raise SourceError(f"{where}: {error.message}", location=Location(str(self.spec.path)), fix=error.fix) from error

    def _run(self, sources: Sequence[ProgramSource], store: Store, backend: Backend, started: float) -> Iterator[ProgramResult]:
        known = store.known()
        store.mark_listed({source.id: source.labels for source in sources})
        digests = Digests()
        waiting: dict[str, ProgramSource] = {}
        for source in sources:
            if source.missing is not None:
                self._missing(source, store)
            elif not self._unchanged(source, known.get(source.id), digests, store):
                waiting[source.id] = source
        self.summary.programs = len(sources)
        self.summary.unchanged = sum(source.missing is None for source in sources) - len(waiting)
        self.summary.no_longer_listed = len(known.keys() - {source.id for source in sources})
        for source in sources:
            if source.missing is not None:
                self._count(SKIPPED)
            elif source.id not in waiting:
                self._count(known[source.id].state)
        del known, digests
        progress = self.progress = RunProgress(len(waiting), 0, 0, 0.0)
        if not waiting:
            return
        jobs = (self._job(source) for source in list(waiting.values()))
        with closing(backend(jobs, self.options.steps)) as results:
            for result in results:
                source = waiting.pop(result.id)
                end_with(self._output(source), new=store.record(result, self._facts(source, result)))
                self._count(result.state)
                if result.state == SKIPPED:
                    self._report_skipped(result)
                    self.other_version |= result.other_version
                self.summary.run += bool(result.steps)
                progress.ended += 1
                progress.failed += result.state in FAILURES
                progress.seconds = time.monotonic() - started
                self.summary.seconds = round(progress.seconds, 3)
                self._told(progress)
                yield result

    def _count(self, state: str) -> None:
        """Count a program by its state, while the run goes on."""
        name = state.replace("-", "_")
        setattr(self.summary, name, getattr(self.summary, name) + 1)

    def _missing(self, source: ProgramSource, store: Store) -> None:
        """Count a program that is not there. What an earlier run has found out about it stays."""
        result = ProgramResult(source.id, SKIPPED, message=source.missing)
        store.record(result, self._facts(source, result))
        self._report_skipped(result)

    def _settings(self, source: ProgramSource) -> str:
        """What a program is run with, as a text."""
        place = source.place
        return json_written({
            "steps": list(self.options.steps), "include_dirs": list(place.include_dirs), "defines": list(place.defines),
            "migrate": place.migrate, "defaults": self.spec.migrate, "keep_models": self.options.keep_models,
            "path": source.path if source.root is None else os.path.relpath(source.path, source.root),
            "revision": source.revision if source.root is None else None,
        }, sort_keys=True)  # fmt: skip

    def _limits(self) -> str:
        return json_written(msgspec.to_builtins(self.spec.limits), sort_keys=True)

    def _unchanged(self, source: ProgramSource, known: StoredResult | None, digests: Digests, store: Store) -> bool:
        """Whether the stored result of a program is what another run would find out.

        That of an earlier commit whose files are the same becomes that of the commit.
        """
        if known is None or known.state == SKIPPED or known.state in self.options.retry:
            return False
        if known.tool != self._tool or known.settings != digest_of_text(self._settings(source)):
            return False
        if known.state != DONE and known.limits != self._limits():
            return False
        if not known.files:
            return False
        before = self._earlier_root(source, known)
        if before is None:
            return known.digest == digest_of_files({path: digests.of(path) for path in known.files})
        assert source.root is not None
        now = {source.root + path.removeprefix(before) if _lies_in(path, before) else path: path for path in known.files}
        if any(digests.of(path) != known.files[old] for path, old in now.items()):
            return False
        digest = digest_of_files({path: known.files[old] for path, old in now.items()})
        for model in Path(self._output(source)).glob("*/*.xmi"):
            name_commit(model, before, source.root)
        store.move_program(source.id, before, source.root, source.revision, digest)
        return True

    def _earlier_root(self, source: ProgramSource, known: StoredResult) -> str | None:
        """The folder of another commit of the program's repository that a stored result was made from; None for no such."""
        if source.root is None:
            return None
        mine, inside = repository_of(source.root), str(self.out / SOURCES) + os.sep
        names = {path.removeprefix(inside).partition(os.sep)[0] for path in known.files if path.startswith(inside)}
        roots = {inside + name for name in names if repository_of(name) == mine} - {source.root}
        return min(roots, default=None)

    def _job(self, source: ProgramSource) -> ProgramJob:
        place = source.place
        work = ProgramWork(
            source.id, source.path, list(place.include_dirs), list(place.defines), dict(place.migrate), dict(self.spec.migrate),
            self._output(source), self.options.keep_models,
        )  # fmt: skip
        return ProgramJob(work, self.options.steps, self.spec.limits, self._tool)

    def _output(self, source: ProgramSource) -> str:
        """The folder for the results of a program."""
        return str(self.out / RESULTS / folder_name(source.id))

    def _facts(self, source: ProgramSource, result: ProgramResult) -> dict[str, Any]:
        """The columns of `programs` that the worker does not know."""
        inside = str(self.out) + os.sep
        for step in result.steps:
            for table, column in (("models", "path"), ("plans", "report")):
                for row in step.rows.get(table, ()):
                    row[column] = str(row[column]).removeprefix(inside)
        migrated = any(step.name == "migrate" and step.state == DONE for step in result.steps)
        return {
            "path": _text(source.path), "repository": source.repository, "revision": source.revision, "labels": source.labels,
            "settings": digest_of_text(self._settings(source)), "limits": self._limits(), "tool": self._tool,
            "output": f"{RESULTS}/{folder_name(source.id)}/migration" if migrated else None,
        }  # fmt: skip

    def _report_skipped(self, result: ProgramResult) -> None:
        """Report a program that was not run, or not to its end, for a reason outside of it."""
        self._skipped_reported += 1
        if self._skipped_reported <= SHOWN:
            at = f" at the step {result.step}" if result.step else ""
            self.findings.append(Finding(
                "RS921", Severity.warning, f"'{result.id}' was not run{at}: {result.message}", element=result.id,
                fix="put what is missing in its place, and run the same command again",
            ))  # fmt: skip
        elif self._skipped_reported == SHOWN + 1:
            self.findings.append(_more("programs were not run", "skipped", Severity.warning, "RS921"))

    def _close(self, store: Store) -> None:
        """Count the programs by their state now, and report those that failed."""
        summary = self.summary
        counts = store.counts()
        summary.done, summary.failed, summary.timeout = counts.get(DONE, 0), counts.get(FAILED, 0), counts.get(TIMEOUT, 0)
        summary.too_large, summary.skipped = counts.get(TOO_LARGE, 0), counts.get(SKIPPED, 0)
        used = [row[0] for row in store.query("SELECT path FROM programs WHERE listed").rows]
        remove_unused(self.out / SOURCES, used)
        failures = ", ".join(f"'{state}'" for state in FAILURES)
        sql = f"SELECT id, path, state, step, message FROM programs WHERE listed AND state IN ({failures}) ORDER BY id"
        for name, path, state, step, message in store.query(f"{sql} LIMIT {SHOWN}").rows:
            todo = "correct the program" if state == FAILED else "follow the message's advice"
            self.findings.append(Finding(
                "RS920", Severity.error, f"'{name}': {state}{f' at the step {step}' if step else ''}: {message}",
                Location(path), element=name, fix=f"{todo}; --retry {state} runs it again as it is",
            ))  # fmt: skip
        if summary.failed + summary.timeout + summary.too_large > SHOWN:
            self.findings.append(_more("programs failed", "failed", Severity.error, "RS920"))
        if summary.no_longer_listed:
            count = quantity(summary.no_longer_listed, "program")
            self.findings.append(Finding(
                "RS922", Severity.info, f"the store has {count} that the specification no longer has",
                Location(str(self.spec.path)), fix="leave them out of your queries: WHERE listed",
            ))  # fmt: skip


def _more(what: str, state: str, severity: Severity, rule: str) -> Finding:
    """The finding that there are more of a kind than are reported one by one."""
    sql = f"SELECT id, message FROM programs WHERE state = '{state}'"
    return Finding(rule, severity, f"more {what} than the {SHOWN} above", fix=f'list them: robosmi corpus query OUT "{sql}"')


def folder_name(program: str) -> str:
    """The name of a program's folder: readable, and different for different programs."""
    plain = re.sub(r"[^A-Za-z0-9.-]+", "_", program).strip("._")[-60:]
    return f"{plain}-{hashlib.sha256(program.encode(errors='surrogateescape')).hexdigest()[:10]}"


def _lies_in(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder + os.sep)


def _text(path: str) -> str:
    return os.fsencode(path).decode("utf-8", "backslashreplace")


@contextmanager
def _alone(out: Path) -> Iterator[None]:
    """Context manager: no other run is at work in the output folder.

    Raises:
        SourceError: it cannot be made.
        StoppedError: another run is at work.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        (out / LOCK).touch()
    except OSError as error:
        raise SourceError(f"cannot write here: {error.strerror}", location=Location(str(out)), fix="check the folder") from error
    handle = lock_now(out / LOCK, os.O_RDWR)
    if handle is None:
        raise StoppedError("another run is at work here", location=Location(str(out)), fix="wait for its end, or stop it")
    try:
        yield
    finally:
        unlock(handle)


def checked_states(names: Sequence[str]) -> frozenset[str]:
    """The states of `--retry`.

    Raises:
        UsageError: there is no such state.
    """
    for name in names:
        if name not in STATES:
            raise UsageError(f"'{name}' is no state{did_you_mean(name, STATES)}", fix=f"use some of: {', '.join(STATES)}")
    return frozenset(names)


def summary_json(summary: Summary) -> Mapping[str, Any]:
    """The contract's result of `corpus run`."""
    found: Mapping[str, Any] = msgspec.to_builtins(summary)
    return found
