"""A corpus on a cluster of Dask: scheduler and workers are processes of their own, and one is killed on the way."""

from __future__ import annotations

import socket
import subprocess
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from types import SimpleNamespace

import msgspec
import pytest

from robosmi.corpus import cluster as clusters_of_dask, memory
from robosmi.corpus.cluster import run_on_cluster
from robosmi.corpus.jobs import Limits, ProgramJob, ProgramResult, ProgramWork
from robosmi.corpus.states import DONE, SKIPPED
from robosmi.corpus.store import TABLES, VERDICTS
from robosmi.errors import SourceError
from tests.corpus_runs.clusters import Process, cluster, finished, other_worker, run_with_a_lost_worker, until_lines
from tests.corpus_runs.running_corpora import command, copied, environment, faulty, rows, run_faulty, stopped
from tests.tools import require_tools

pytest.importorskip("distributed", reason="distributed is not installed (extra cluster)")
pytestmark = pytest.mark.processes


def test_a_worker_that_dies_loses_nothing(tmp_path: Path) -> None:
    out, code, document = run_with_a_lost_worker(tmp_path)
    assert (code, document["result"]["done"], document["result"]["failed"]) == (1, 20, 1)
    names = {f"programs/p{number:02}.c" for number in range(20)}
    assert {row[0] for row in rows(out, "SELECT id FROM programs WHERE state = 'done'")} == names
    assert len(rows(out, "SELECT id FROM programs")) == 21


@pytest.fixture(scope="module")
def one_worker(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Process]]:
    """The address of a scheduler, and its worker."""
    with cluster(tmp_path_factory.mktemp("cluster"), workers=1) as (place, workers, _):
        yield place, workers[0]


def test_workers_with_other_plug_ins_run_nothing(one_worker: tuple[str, Process], tmp_path: Path) -> None:
    words = command("run", copied(tmp_path), "-o", tmp_path / "out", "--scheduler", one_worker[0])
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 3, "its workers have the plug-in, and the run has not"
    assert "no worker has" in done.stderr
    assert rows(tmp_path / "out", "SELECT count(*) FROM programs") == [(0,)]
    with other_worker(tmp_path, one_worker[0]):
        assert subprocess.run(words, stdout=subprocess.DEVNULL, check=False).returncode == 0
    assert rows(tmp_path / "out", "SELECT state, count(*) FROM programs GROUP BY state") == [("done", 4)]


MEASURED = ("seconds", "peak_mb", "finished")
"""Columns that differ from run to run."""


def test_the_rows_of_all_steps_are_those_of_the_pool(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    spec, out = copied(tmp_path), tmp_path / "out"  # findings have whole paths, so both runs use one folder
    words = command("run", spec, "-o", out, "--steps", "analyse,migrate,compile", "--models")
    with cluster(tmp_path, workers=1, PYTHONPATH="") as (place, _, _):
        done = subprocess.run([*words, "--scheduler", place], check=False, stdout=subprocess.DEVNULL)
    assert done.returncode == 1  # no_main.c fails
    out.rename(tmp_path / "cluster")
    assert subprocess.run(words, check=False, stdout=subprocess.DEVNULL).returncode == 1
    out.rename(tmp_path / "pool")
    for table in TABLES.sorted_tables:
        columns = ", ".join(f'"{column.name}"' for column in table.columns if column.name not in MEASURED)
        sql = f"SELECT {columns} FROM {table.name} ORDER BY {columns}"
        found = rows(tmp_path / "cluster", sql)
        assert found == rows(tmp_path / "pool", sql), table.name
        assert found or table is VERDICTS, table.name


def test_a_run_that_is_stopped_ends_its_programs_on_the_workers(one_worker: tuple[str, Process], tmp_path: Path) -> None:
    place, worker = one_worker
    assert stopped(tmp_path, place) == "2 1 1 False"
    assert not list(memory.descendants(worker.pid))


def test_no_scheduler(tmp_path: Path) -> None:
    spec = faulty(tmp_path / "all", a="good")
    code, document = run_faulty("run", spec, "-o", tmp_path / "out", "--scheduler", "nonsense")
    assert code == 3
    assert "no scheduler" in document["findings"][0]["message"]


@pytest.fixture
def without_client(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("distributed.Client", lambda *_, **__: pytest.fail("its end would have to be waited for"))
    monkeypatch.setattr(clusters_of_dask, "_REACH_S", 0.5)


@pytest.mark.parametrize("place", ["nonsense", "tcp://host", "tpc://host:8786", "tcp://host:port", "tcp://127.0.0.1:9"])
def test_an_address_of_no_scheduler_makes_no_client(place: str, without_client: None) -> None:
    with pytest.raises(SourceError, match="no scheduler"):
        next(run_on_cluster(place, iter(()), ("analyse",)))


@pytest.mark.parametrize("said", [b"", b"HTTP/1.1 400 Bad Request\r\n\r\n"], ids=["nothing", "something else"])
def test_what_listens_and_is_no_scheduler(said: bytes, without_client: None) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        held = []

        def answer() -> None:
            held.append(server.accept()[0])
            held[0].sendall(said)

        thread = threading.Thread(target=answer)
        thread.start()
        with pytest.raises(SourceError, match="no scheduler"):
            next(run_on_cluster(f"tcp://127.0.0.1:{server.getsockname()[1]}", iter(()), ("analyse",)))
        thread.join()
        held[0].close()


class _Future:
    """A future of a batch that has one state after the other; who adds it again waits for the next."""

    def __init__(self, data: bytes, states: list[str]) -> None:
        self.jobs = [job.work.id for job in msgspec.json.decode(data, type=list[ProgramJob])]
        self.key, self.states, self.released = ",".join(self.jobs), states, False

    @property
    def status(self) -> str:
        return self.states[0]

    def result(self) -> bytes:
        assert self.status == "finished", "who asks for a result that is pending waits for ever"
        return msgspec.json.encode([ProgramResult(job, DONE) for job in self.jobs])

    def exception(self) -> str:
        return "it kills workers"

    def release(self) -> None:
        self.released = True


class _Completed:
    """What `as_completed` does with such futures: it gives out each that was added."""

    def __init__(self, futures: Iterable[_Future], **_: object) -> None:
        self.ready = list(futures)

    def __next__(self) -> _Future:
        return self.ready.pop(0)

    def add(self, future: _Future) -> None:
        future.states.pop(0)
        self.ready.append(future)

    def update(self, futures: Iterable[_Future]) -> None:
        self.ready += futures

    def has_ready(self) -> bool:
        return bool(self.ready)

    def is_empty(self) -> bool:
        return not self.ready


def _cluster_of_futures(monkeypatch: pytest.MonkeyPatch, states: Callable[[bytes], list[str]]) -> list[_Future]:
    """Have no cluster but such futures; those that were made."""
    made: list[_Future] = []

    def submit(_: object, data: bytes, *__: object, **___: object) -> _Future:
        made.append(_Future(data, states(data)))
        return made[-1]

    async def greeted(*_: object) -> None:
        pass

    client = SimpleNamespace(status="running", loop=None, submit=submit, run=lambda *_, **__: None, close=lambda *_, **__: None)
    monkeypatch.setattr("distributed.Client", lambda *_, **__: client)
    monkeypatch.setattr("distributed.as_completed", _Completed)
    monkeypatch.setattr(clusters_of_dask, "_greet", greeted)
    workers = SimpleNamespace(threads=1, right=None, replaced=lambda: False)
    monkeypatch.setattr(clusters_of_dask, "_Workers", lambda *_: workers)
    return made


def _job(name: str) -> ProgramJob:
    return ProgramJob(ProgramWork(name, name), ("analyse",), Limits())


def test_a_result_that_dies_with_its_worker_is_waited_for_again(monkeypatch: pytest.MonkeyPatch) -> None:
    made = _cluster_of_futures(monkeypatch, lambda _: ["pending", "finished"])
    (result,) = run_on_cluster("tcp://host:1", iter([_job("a.c")]), ("analyse",))
    assert (result.id, result.state) == ("a.c", DONE)
    assert [future.released for future in made] == [True]


def test_short_programs_share_a_task_and_one_that_ends_workers_takes_none_with_it(monkeypatch: pytest.MonkeyPatch) -> None:
    made = _cluster_of_futures(monkeypatch, lambda data: ["error" if b"killer" in data else "finished"])
    names = [f"{number}.c" for number in range(40)]
    names[30] = "killer.c"
    results = list(run_on_cluster("tcp://host:1", iter(map(_job, names)), ("analyse",)))
    assert {result.id for result in results if result.state == DONE} == {*names} - {"killer.c"}
    assert [(result.id, result.state) for result in results if result.state != DONE] == [("killer.c", SKIPPED)]
    assert len(results) == len(names)
    sizes = [len(future.jobs) for future in made]
    assert sizes[:4] == [1, 1, 1, 1], "nothing is known yet"
    assert max(sizes) > 4


def test_what_a_slow_program_keeps_waiting_comes_back(monkeypatch: pytest.MonkeyPatch) -> None:
    class Slow:
        def __init__(self, _: object) -> None:
            pass

        def run(self, job: ProgramJob) -> ProgramResult:
            time.sleep(0.02 if job.work.id == "slow.c" else 0)
            return ProgramResult(job.work.id)

        def stop(self) -> None:
            pass

    monkeypatch.setattr(clusters_of_dask, "WorkerProcess", Slow)
    monkeypatch.setattr(clusters_of_dask, "_BATCH_S", 0.01)
    data = msgspec.json.encode([_job("a.c"), _job("slow.c"), _job("b.c")])
    results = msgspec.json.decode(clusters_of_dask.run_batch(data, ("analyse",), "slow"), type=list[ProgramResult])
    assert [result.id for result in results] == ["a.c", "slow.c"]
    waiting = clusters_of_dask._Waiting([_job("c.c")])
    waiting.again([_job("b.c")])
    assert [job.work.id for batch in iter(waiting.batch, []) for job in batch] == ["b.c", "c.c"]


def test_a_scheduler_that_dies_ends_the_run_which_goes_on_later(tmp_path: Path) -> None:
    spec = faulty(tmp_path / "all", **{f"p{number:02}": "slow" for number in range(16)})
    out, log = tmp_path / "out", tmp_path / "all" / "programs" / "log"
    with cluster(tmp_path, workers=1) as (place, _, scheduler):
        words = command("run", spec, "-o", out, "--scheduler", place, "--json")
        begun = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
        until_lines(log, 3)
        scheduler.kill()
        code, document = finished(begun)
        assert code == 3
        assert "does not answer" in document["findings"][0]["message"]
    stored = rows(out, "SELECT count(*) FROM programs")[0][0]
    assert 1 <= stored < 16
    code, document = run_faulty("run", spec, "-o", out)
    assert (code, document["result"]["done"], document["result"]["run"]) == (0, 16, 16 - stored)
