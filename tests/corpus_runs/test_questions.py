"""What is asked of a corpus that was run: SQL, models, exported tables, comparisons, the Python interface."""

from __future__ import annotations

import csv
import json
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

import robosmi
from robosmi.corpus.report import clusters, greedy_cover, histogram, kind_of_message
from robosmi.corpus.store import TABLES
from robosmi.errors import SourceError
from tests.corpus_runs.running_corpora import copied, rows
from tests.running import run
from tests.tools import require_tools

pytestmark = pytest.mark.processes


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The output folder of a run with migrations and models."""
    folder = tmp_path_factory.mktemp("corpus")
    spec = copied(folder)
    run("corpus", "run", spec, "-o", folder / "out", "--steps", "analyse,migrate", "--models")
    return folder / "out"


def test_sql_is_answered_as_text_json_and_csv(out: Path) -> None:
    sql = "SELECT id, state FROM programs WHERE id LIKE '%blink%'"
    assert run("corpus", "query", out, sql).out.split() == ["id", "state", "programs/blink.c", "done"]
    assert run("corpus", "query", out, sql, "--json").result == {
        "columns": ["id", "state"], "rows": [{"id": "programs/blink.c", "state": "done"}],
    }  # fmt: skip
    assert run("corpus", "query", out, sql, "--csv").out == "id,state\nprograms/blink.c,done\n"
    twice = run("corpus", "query", out, "SELECT 1 AS a, 2 AS a, 3 AS a_2, 4 AS a", "--json").result
    assert twice == {"columns": ["a", "a_3", "a_2", "a_4"], "rows": [{"a": 1, "a_3": 2, "a_2": 3, "a_4": 4}]}
    assert run("corpus", "query", out, "SELECT message, ':x' FROM programs WHERE state = 'failed'", "--json").code == 0


@pytest.mark.parametrize(
    "sql",
    ["DELETE FROM programs", "UPDATE programs SET state = 'done'", "DROP TABLE programs", "ATTACH 'x.sqlite' AS x", "VACUUM",
     "PRAGMA journal_mode=DELETE", "SELEC 1", "", "SELECT nothing FROM programs", "SELECT 1; DELETE FROM programs",
     "INSERT INTO corpus VALUES ('a', 'b') RETURNING key", "SELECT load_extension('x')"],
)  # fmt: skip
def test_a_question_changes_nothing(sql: str, out: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    before = (out / "corpus.sqlite").read_bytes()
    assert run("corpus", "query", out, sql, "--json").code == 2
    assert (out / "corpus.sqlite").read_bytes() == before
    assert list(tmp_path.iterdir()) == []


def test_tables_are_exported_as_csv(out: Path, tmp_path: Path) -> None:
    outcome = run("corpus", "export", out, "-o", tmp_path / "csv", "--as", "csv", "--json")
    assert outcome.code == 0
    assert {Path(each["path"]).stem for each in outcome.document["artifacts"]} == set(TABLES.tables)
    with (tmp_path / "csv" / "programs.csv").open(encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file))
    assert {row["id"] for row in found} == {row[0] for row in rows(out, "SELECT id FROM programs")}


def test_tables_are_exported_as_parquet(out: Path, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed (extra parquet)")
    assert run("corpus", "export", out, "-o", tmp_path / "parquet", "--as", "parquet").code == 0
    for name, table in TABLES.tables.items():
        read = parquet.read_table(tmp_path / "parquet" / f"{name}.parquet")
        assert read.column_names == [column.name for column in table.columns]
        assert read.num_rows == rows(out, f"SELECT count(*) FROM {name}")[0][0]


def test_models_of_all_programs_are_queried(out: Path) -> None:
    outcome = run("query", out, "Call.all.select(lambda c: c.calleeName == 'pause').size()", "--json")
    assert outcome.code == 0
    found = {each["program"]: each["value"] for each in outcome.result["value"]}
    assert found == {"programs/blink.c": 2, "programs/wheels.c": 1, "programs/sub/badge.c": 0, "programs/sub/no_main.c": 0}
    assert run("query", out, "Call.all.(", "--json").code == 2
    assert run("query", out, "PortBinding.all.size()", "--kind", "plan", "--json").code == 0
    assert run("query", out, "1", "--kind", "wheel", "--json").code == 3


def changed(out: Path, folder: Path, change: Callable[[Path], None]) -> Path:
    """A copy of a corpus whose store was changed."""
    shutil.copytree(out, folder)
    change(folder / "corpus.sqlite")
    return folder


def sql(*statements: str) -> Callable[[Path], None]:
    def change(path: Path) -> None:
        import sqlite3

        with sqlite3.connect(path) as db:
            for statement in statements:
                db.execute(statement)
        db.close()

    return change


def test_runs_are_compared(out: Path, tmp_path: Path) -> None:
    same = run("corpus", "compare", out, out, "--json")
    assert same.code == 0
    assert same.result | {"better": [], "worse": [], "new_failures": [], "same": 4} == same.result
    other = changed(
        out, tmp_path / "other",
        sql(
            "UPDATE programs SET state = 'timeout', message = 'slow' WHERE id = 'programs/blink.c'",
            "UPDATE programs SET state = 'done' WHERE id = 'programs/sub/no_main.c'",
            "UPDATE plans SET with_body = with_body - 1 WHERE program = 'programs/wheels.c'",
            "DELETE FROM programs WHERE id = 'programs/sub/badge.c'",
        ),
    )  # fmt: skip
    worse = run("corpus", "compare", out, other, "--json")
    assert worse.code == 1
    assert [each["program"] for each in worse.result["new_failures"]] == ["programs/blink.c"]
    assert [(each["program"], each["what"]) for each in worse.result["worse"]] == [("programs/wheels.c", "open_calls")]
    assert [each["program"] for each in worse.result["better"]] == ["programs/sub/no_main.c"]
    assert worse.result["only_before"] == ["programs/sub/badge.c"]
    back = run("corpus", "compare", other, out, "--json")
    assert back.code == 1  # no_main.c fails again
    assert [each["program"] for each in back.result["better"]] == ["programs/blink.c", "programs/wheels.c"]


def test_the_cover_takes_first_what_frees_most_programs() -> None:
    lacks = [
        ("a", "x", "h", 1), ("b", "x", "h", 1), ("b", "y", "h", 9), ("c", "y", "h", 9), ("c", "z", None, 9), ("d", "z", None, 1),
        ("e", "z", None, 1),
    ]  # fmt: skip
    chosen = greedy_cover(lacks, 10)
    assert [(each.function, each.programs, each.calls, each.frees, each.freed) for each in chosen] == [
        ("z", 3, 11, ["d", "e"], 2), ("y", 2, 18, ["c"], 3), ("x", 2, 2, ["a", "b"], 5),
    ]  # fmt: skip
    assert len(greedy_cover(lacks, 1)) == 1
    assert greedy_cover([], 5) == []


def test_the_cover_takes_two_functions_that_free_more_together_before_one_alone() -> None:
    pairs = [(program, function, "h", 1) for program in "pqrs" for function in ("left", "right")]
    chosen = greedy_cover([("alone", "often", "h", 50), *pairs], 3)
    assert [(each.function, each.frees, each.freed) for each in chosen] == [
        ("left", [], 0), ("right", ["p", "q", "r", "s"], 4), ("often", ["alone"], 5),
    ]  # fmt: skip


def test_the_page_names_the_programs_that_bodies_free_and_leaves_out_those_that_they_do_not(out: Path, tmp_path: Path) -> None:
    link = '<a href="#program=programs/sub/badge.c">'

    def advice(corpus: Path, folder: Path) -> str:
        run("corpus", "report", corpus, "-o", folder)
        return (folder / "index.html").read_text(encoding="utf-8").partition('id="next"')[2].partition('id="stops"')[0]

    assert link in advice(out, tmp_path / "page")
    stops = (
        "UPDATE programs SET state = 'failed' WHERE id = 'programs/sub/badge.c'",
        "INSERT INTO compiles (program, ok, fits) VALUES ('programs/sub/badge.c', 1, 0)",
        "INSERT INTO findings (program, severity, task) VALUES ('programs/sub/badge.c', 'error', 0)",
    )
    for number, stop in enumerate(stops):
        other = changed(out, tmp_path / f"other{number}", sql(stop))
        text = advice(other, tmp_path / f"page{number}")
        assert "without a body for the target: 1." in text
        assert "so that bodies do not free them: 1." in text
        assert link not in text


def test_ranges_of_a_chart_do_not_overlap() -> None:
    assert re.findall(r">(\d[^<]*) calls<title>", histogram([0, 3, 19], "calls", "")) == [
        "0 to 1", "2 to 3", "4 to 5", "6 to 7", "8 to 9", "10 to 11", "12 to 13", "14 to 15", "16 to 17", "18 to 19",
    ]  # fmt: skip
    assert re.findall(r">(\d[^<]*) calls<title>", histogram([0, 2], "calls", "")) == ["0", "1", "2"]
    assert "0 to below 0.02 s<" in histogram([0.05, 0.2], "s", "")


def test_messages_that_differ_in_names_and_numbers_are_one_cluster() -> None:
    assert kind_of_message("/a/b.c:3:4: 'x' is 17 bytes long") == kind_of_message("/c.c: 'yy' is 8 bytes long")
    found = clusters([("a", "failed", "migrate", "/a.c: no 'x'"), ("b", "failed", "migrate", "/b.c: no 'y'"),
                      ("c", "timeout", "verify", "long")])  # fmt: skip
    assert [(each.programs, each.state, each.examples) for each in found] == [(2, "failed", ["a", "b"]), (1, "timeout", ["c"])]


def test_the_page_has_a_section_for_each_program_and_hostile_names_stay_text(out: Path, tmp_path: Path) -> None:
    hostile = "</script><script>document.title='x'</script>"
    other = changed(
        out, tmp_path / "other",
        sql(
            f"UPDATE programs SET message = '{hostile.replace(chr(39), chr(39) * 2)}', state = 'failed' WHERE id LIKE '%blink%'",
        ),
    )  # fmt: skip
    outcome = run("corpus", "report", other, "-o", tmp_path / "page", "--json")
    assert outcome.code == 0
    text = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert text.count("<script") == 2
    assert "</script><script>document" not in text
    data = json.loads(text.partition('id="data">')[2].partition("</script>")[0])
    assert {row[0] for row in data["programs"]} == {row[0] for row in rows(out, "SELECT id FROM programs")}
    blink = next(row for row in data["programs"] if row[0] == "programs/blink.c")
    assert blink[7]["m"] == hostile
    assert (tmp_path / "page" / blink[7]["r"]).is_file()
    assert "badge_setup" in text


def test_the_page_sorts_filters_and_shows_a_program_in_a_browser(out: Path, tmp_path: Path) -> None:
    require_tools("chromium", "chromedriver")
    from selenium.webdriver.common.by import By

    from tests.page.browsers import chromium

    too_large = "INSERT INTO compiles (program, ok, fits, target) VALUES ('programs/sub/badge.c', 1, 0, 'uno')"
    run("corpus", "report", changed(out, tmp_path / "other", sql(too_large)), "-o", tmp_path / "page")
    with chromium() as driver:
        driver.get((tmp_path / "page" / "index.html").as_uri())

        def shown() -> list[str]:
            return [line.text for line in driver.find_elements(By.CSS_SELECTOR, "#table tbody tr td:first-child")]

        assert shown() == sorted(row[0] for row in rows(out, "SELECT id FROM programs"))
        driver.find_element(By.ID, "words").send_keys("badge_setup")
        assert shown() == ["programs/sub/badge.c"]
        driver.find_element(By.ID, "words").clear()
        driver.find_element(By.ID, "words").send_keys(" ")
        driver.find_element(By.CSS_SELECTOR, "#table th[data-key='4'] button").click()
        assert shown()[0] == "programs/sub/badge.c"
        for first in ("programs/sub/badge.c", "programs/blink.c"):  # most tasks, then fewest
            driver.find_element(By.CSS_SELECTOR, "#table th[data-key='5'] button").click()
            assert shown()[0] == first
            assert shown()[-1] == "programs/sub/no_main.c", "it has no number of tasks"
        driver.find_element(By.CSS_SELECTOR, "#table tbody a[href$='badge.c']").click()
        assert "launch_rocket" in driver.find_element(By.ID, "section").text
        assert "yes, does not fit" in driver.find_element(By.ID, "section").text
        assert driver.get_log("browser") == []


def test_a_run_from_python_gives_results_while_it_runs(tmp_path: Path) -> None:
    spec = copied(tmp_path)
    made = robosmi.corpus.run(spec, tmp_path / "out", jobs=1)
    first = next(iter(made))
    assert first.state == "done"
    results = {result.id: result.state for result in made}
    assert results == {name: "done" for (name,) in rows(tmp_path / "out", "SELECT id FROM programs")}
    assert made.wait().done == len(made) == 4
    assert made.summary.seconds > 0
    assert not made.running
    page = made._repr_html_()
    assert page.count("<tr>") == 5
    assert "4 programs run" in page
    again = robosmi.corpus.run(spec, tmp_path / "out")
    assert list(again) == []
    assert again.wait().unchanged == 4
    with pytest.raises(SourceError):
        robosmi.corpus.run(tmp_path / "none.toml", tmp_path / "out")
    (tmp_path / "out" / "corpus.sqlite").write_bytes(b"junk" * 100)
    with pytest.raises(SourceError):
        list(robosmi.corpus.run(spec, tmp_path / "out"))


def test_a_run_from_python_that_is_stopped_has_ended_and_its_summary_counts_what_was_run(tmp_path: Path) -> None:
    made = robosmi.corpus.run(copied(tmp_path), tmp_path / "out", jobs=1)
    next(iter(made))
    assert (made.summary.programs, made.summary.unchanged) == (4, 0)
    assert 1 <= made.summary.done == made.summary.run <= 4
    made.stop()
    assert not made.running
    assert made.summary.done == made.summary.run == len(made)
    assert rows(tmp_path / "out", "SELECT count(*) FROM programs") == [(len(made),)]
    again = robosmi.corpus.run(tmp_path / "corpus.toml", tmp_path / "out", jobs=1).wait()
    assert (again.done, again.unchanged) == (4, len(made))


def test_the_table_of_programs_as_a_data_frame(tmp_path: Path) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    frame = robosmi.corpus.run(copied(tmp_path), tmp_path / "out", jobs=1)
    frame.wait()
    table = frame.to_pandas()
    assert list(table.state) == ["done"] * 4
    assert "peak_mb" in table.columns
