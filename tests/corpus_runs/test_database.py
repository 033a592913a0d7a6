"""The store in a database server, where `ROBOSMI_TEST_DATABASE` has the SQLAlchemy URL of one that may be filled and emptied."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from sqlalchemy import create_engine

from robosmi.corpus.schema import TABLES
from tests.corpus_runs.running_corpora import copied
from tests.running import run

pytestmark = pytest.mark.processes
URL = os.environ.get("ROBOSMI_TEST_DATABASE", "")


@pytest.fixture
def url() -> Iterator[str]:
    if not URL:
        pytest.skip("ROBOSMI_TEST_DATABASE names no server")
    engine = create_engine(URL)
    TABLES.drop_all(engine)
    yield URL
    TABLES.drop_all(engine)
    engine.dispose()


def test_run_query_report_and_compare_over_a_server(url: str, tmp_path: Path) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    assert run("corpus", "run", spec, "-o", out, "--store", url, "--json").result["run"] == 4
    again = run("corpus", "run", spec, "-o", out, "--store", url, "--json").result
    assert again | {"run": 0, "unchanged": 4, "done": 4} == again
    assert not (out / "corpus.sqlite").exists()
    sql = "SELECT function, count(*) AS calls FROM calls WHERE function LIKE 'pau%' GROUP BY function"
    assert run("corpus", "query", out, sql, "--store", url, "--json").result["rows"] == [{"function": "pause", "calls": 3}]
    for wrong in ("DELETE FROM programs", "UPDATE programs SET state = 'x' RETURNING id", "DROP TABLE programs"):
        assert run("corpus", "query", out, wrong, "--store", url, "--json").code == 2
    assert run("corpus", "query", out, "SELECT count(*) FROM programs", "--store", url, "--csv").out == "count\n4\n"
    assert run("corpus", "report", out, "-o", tmp_path / "page", "--store", url).code == 0
    assert run("corpus", "export", out, "-o", tmp_path / "csv", "--as", "csv", "--store", url).code == 0
    assert run("corpus", "compare", out, out, "--store", url, "--store-before", url).code == 0


def test_a_server_that_is_not_there(tmp_path: Path) -> None:
    pytest.importorskip("psycopg", reason="psycopg is not installed")
    refused = run(
        "corpus", "run", copied(tmp_path), "-o", tmp_path / "out", "--json", "--store", "postgresql+psycopg://a@127.0.0.1:9/b"
    )
    assert refused.code == 3
