"""A corpus run for Python: it works in the background, gives results while it runs, and displays as a table in a notebook."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.corpus.backends import backend_of
from robosmi.corpus.jobs import ProgramResult
from robosmi.corpus.running import CorpusRun, RunProgress, Summary, checked_states, store_place
from robosmi.corpus.settings import options_of
from robosmi.corpus.spec import read_spec
from robosmi.corpus.store import Store
from robosmi.diagnostics import Finding
from robosmi.errors import MissingToolError
from robosmi.quoting import html

if TYPE_CHECKING:
    from pandas import DataFrame

_SHOWN = 20
_COLUMNS = ("id", "state", "step", "seconds", "peak_mb", "message")


class BackgroundRun:
    """A corpus run that has begun. Each iterator gives all results, those that are still to come, too, as they come.

    Args:
        run: the run.
    """

    def __init__(self, run: CorpusRun) -> None:
        self._run = run
        self._ended: list[ProgramResult] = []
        self._changed = threading.Condition()
        self._over = False
        self._error: BaseException | None = None
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def _work(self) -> None:
        results = self._run.results(backend_of(self._run.options, self._stop))
        try:
            for result in results:
                for step in result.steps:
                    step.rows = {}  # they are in the store
                with self._changed:
                    self._ended.append(result)
                    self._changed.notify_all()
        except BaseException as error:
            self._error = error
        finally:
            results.close()
            with self._changed:
                self._over = True
                self._changed.notify_all()

    def __iter__(self) -> Iterator[ProgramResult]:
        """The results of the programs that are run now, as they come; their rows are in the store.

        Raises:
            RobosmiError: what ended the run.
        """
        number = 0
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._over or len(self._ended) > number)  # noqa: B023
                if number >= len(self._ended):
                    break
                result = self._ended[number]
            number += 1
            yield result
        if self._error is not None:
            raise self._error

    def __len__(self) -> int:
        """The number of programs that have been run so far."""
        return len(self._ended)

    def wait(self) -> Summary:
        """Wait for the end; what was counted.

        Raises:
            RobosmiError: what ended the run.
        """
        self._thread.join()
        if self._error is not None:
            raise self._error
        return self._run.summary

    def stop(self) -> None:
        """Stop now; programs under way have no result, and another run begins with them."""
        self._stop.set()
        self._thread.join()

    @property
    def running(self) -> bool:
        """Whether it is still at work."""
        return not self._over

    @property
    def summary(self) -> Summary:
        """What is counted so far; programs that are still to run have no state yet."""
        return self._run.summary

    @property
    def findings(self) -> Sequence[Finding]:
        """What is worth knowing; complete at the end."""
        return self._run.findings

    def store(self) -> Store:
        """The store with all results, for questions."""
        return Store(store_place(self._run.out, self._run.options.store))

    def to_pandas(self) -> DataFrame:
        """The table of programs, with a row for each program that has a result.

        Raises:
            MissingToolError: pandas is not installed.
        """
        try:
            from pandas import DataFrame
        except ImportError as error:
            raise MissingToolError("pandas is not installed", fix="install it: pip install pandas") from error
        with self.store() as store:
            answer = store.query("SELECT * FROM programs WHERE listed ORDER BY id")
        return DataFrame(answer.rows, columns=list(answer.columns))

    def _repr_html_(self) -> str:
        progress: RunProgress = self._run.progress
        head = f"running: {progress.ended} of {progress.total} programs" if self.running else f"{progress.ended} programs run"
        with self._changed:
            shown = [(r.id, r.state, r.step, f"{r.seconds:.2f}", r.peak_mb, r.message) for r in self._ended[-_SHOWN:]]
        titles = "".join(f"<th>{html(name)}</th>" for name in _COLUMNS)
        lines = "".join(
            f"<tr>{''.join(f'<td>{html(str(value) if value is not None else str())}</td>' for value in row)}</tr>"
            for row in shown
        )
        more = f"<p>the last {_SHOWN} of {len(self._ended)}</p>" if len(self._ended) > _SHOWN else ""
        return f"<p>{html(head)}</p>{more}<table><thead><tr>{titles}</tr></thead><tbody>{lines}</tbody></table>"


def begin(
    spec: str | Path,
    output: str | Path,
    *,
    steps: Sequence[str] | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    store: str | None = None,
    retry: Sequence[str] = (),
    models: bool = False,
) -> BackgroundRun:
    """Begin a corpus run; see `robosmi.corpus.run`."""
    read = read_spec(Path(spec))
    options = options_of(
        read, steps=steps, jobs=jobs, scheduler=scheduler, store=store, retry=checked_states(list(retry)), models=models
    )
    return BackgroundRun(CorpusRun(read, Path(output), options))
