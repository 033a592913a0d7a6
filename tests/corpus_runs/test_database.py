"""The store in a database server, where `ROBOSMI_TEST_DATABASE` has the SQLAlchemy URL of one that may be filled and emptied."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from sqlalchemy import create_engine, text
from sqlalchemy.pool import NullPool

from robosmi.corpus.store import TABLES
from tests.corpus_runs.clusters import run_with_a_lost_worker, until_lines
from tests.corpus_runs.running_corpora import command, copied, environment, faulty, run_faulty
from tests.running import run

pytestmark = pytest.mark.processes
URL = os.environ.get("ROBOSMI_TEST_DATABASE", "")


@pytest.fixture
def url() -> Iterator[str]:
    if not URL:
        pytest.skip("ROBOSMI_TEST_DATABASE names no server")
    engine = create_engine(URL, poolclass=NullPool)
    TABLES.drop_all(engine)
    yield URL
    TABLES.drop_all(engine)
    engine.dispose()


def test_run_query_report_and_compare_over_a_server(url: str, tmp_path: Path) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    assert run("corpus", "run", spec, "-o", out, "--store", url, "--models", "--json").result["run"] == 4
    again = run("corpus", "run", spec, "-o", out, "--store", url, "--models", "--json").result
    assert again | {"run": 0, "unchanged": 4, "done": 4} == again
    assert not (out / "corpus.sqlite").exists()
    sql = "SELECT function, count(*) AS calls FROM calls WHERE function LIKE 'pau%' GROUP BY function"
    assert run("corpus", "query", out, sql, "--store", url, "--json").result["rows"] == [{"function": "pause", "calls": 3}]
    for wrong in ("DELETE FROM programs", "UPDATE programs SET state = 'x' RETURNING id", "DROP TABLE programs"):
        assert run("corpus", "query", out, wrong, "--store", url, "--json").code == 2
    assert run("corpus", "query", out, "SELECT count(*) FROM programs", "--store", url, "--csv").out == "count\n4\n"
    values = run("query", out, "Call.all.select(lambda c: c.calleeName == 'pause').size()", "--store", url, "--json").result
    assert sum(each["value"] for each in values["value"]) == 3
    assert run("query", out, "1", "--json").code == 3  # its tables are elsewhere
    assert run("corpus", "report", out, "-o", tmp_path / "page", "--store", url).code == 0
    assert run("corpus", "export", out, "-o", tmp_path / "csv", "--as", "csv", "--store", url).code == 0
    assert run("corpus", "compare", out, out, "--store", url, "--store-before", url).code == 0


def test_a_server_that_ends_its_connections_loses_nothing(url: str, tmp_path: Path) -> None:
    spec = faulty(tmp_path / "all", **{f"p{number:02}": "slow" for number in range(12)})
    out, log = tmp_path / "out", tmp_path / "all" / "programs" / "log"
    words = command("run", spec, "-o", out, "--store", url, "--jobs", "1", "--json")
    begun = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
    until_lines(log, 3)
    engine = create_engine(url, poolclass=NullPool)
    with engine.connect() as db:
        ended = db.execute(text(
            "SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
            "WHERE pid <> pg_backend_pid() AND datname = current_database()"
        )).all()  # fmt: skip
    printed, complaints = begun.communicate(timeout=90)
    assert ended
    assert "Traceback" not in complaints
    if begun.returncode == 3:  # it was in the middle of a transaction
        code, document = run_faulty("run", spec, "-o", out, "--store", url)
    else:
        code, document = begun.returncode, json.loads(printed)
    assert (code, document["result"]["done"]) == (0, 12)
    with engine.connect() as db:
        assert db.execute(text("SELECT count(*) FROM programs WHERE state = 'done'")).scalar() == 12


def test_a_worker_of_a_cluster_that_dies_loses_nothing(url: str, tmp_path: Path) -> None:
    pytest.importorskip("distributed", reason="distributed is not installed (extra cluster)")
    _, code, document = run_with_a_lost_worker(tmp_path, "--store", url)
    assert (code, document["result"]["done"], document["result"]["failed"]) == (1, 20, 1)
    with create_engine(url, poolclass=NullPool).connect() as db:
        states = db.execute(text("SELECT state, count(*) FROM programs GROUP BY state ORDER BY state")).all()
    assert [tuple(row) for row in states] == [("done", 20), ("failed", 1)]


def test_a_server_that_is_not_there(tmp_path: Path) -> None:
    pytest.importorskip("psycopg", reason="psycopg is not installed")
    refused = run(
        "corpus", "run", copied(tmp_path), "-o", tmp_path / "out", "--json", "--store", "postgresql+psycopg://a@127.0.0.1:9/b"
    )
    assert refused.code == 3
