"""The history of choices: missing, empty, damaged and foreign files; counting, ties, forgetting, export and import."""

from __future__ import annotations

import json
import os
import sqlite3
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from contextlib import closing
from datetime import date
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st
from msgspec.structs import replace

from robosmi.errors import MissingToolError, SourceError, UsageError
from robosmi.model import load_model, save_model
from robosmi.recommend.history import ForgivingHistory, History, HistoryEntry, Targets, chosen_from_history, default_place
from robosmi.transformations.chains.history import (
    SCHEMA,
    export_history,
    from_csv,
    from_json,
    history_to_model,
    import_history,
    model_to_history,
    to_csv,
    to_json,
)
from tests.fuzz.history import write_at_once

DAY = date(2026, 11, 21)
DATA = Path(__file__).parent / "data"
ROOT = Path(__file__).resolve().parents[2]


def test_a_missing_file_is_an_empty_history_and_stays_missing(history: History) -> None:
    assert history.choices("p", "t") == {}
    assert history.entries() == []
    assert history.forget(everything=True) == 0
    assert chosen_from_history("p", "t", history) is None
    assert not Path(history.place).parent.exists()


def test_choices_are_counted_for_the_very_part(history: History) -> None:
    history.record("p", "t", "B", day=DAY)
    history.record("p", "t", "A", day=DAY)
    history.record("p", "t", "A", day=date(2026, 1, 1))
    history.record("p", "other title", "C", day=DAY)
    history.record("other part", "t", "C", day=DAY)
    assert list(history.choices("p", "t").items()) == [("A", 2), ("B", 1)]
    assert HistoryEntry("p", "t", "A", 2, "2026-11-21") in history.entries(), "the later day is kept"
    assert len(history.entries()) == 4


def test_several_choices_are_counted_all_or_nothing(history: History) -> None:
    entry = HistoryEntry("p", "t", "A", 7, "2026-11-21", component="Servo1")
    with pytest.raises(UsageError, match="a choice needs a part and a library"):
        history.record_all([entry, replace(entry, library="")])
    assert history.entries() == []
    history.record_all([entry, replace(entry, component="Servo2"), replace(entry, library="B")])
    assert {(each.library, each.count, each.component) for each in history.entries()} == {("A", 2, "Servo2"), ("B", 1, "Servo1")}


def test_choices_for_a_target_count_those_for_its_like_only_where_it_has_none(history: History) -> None:
    for library, target in [("A", "uno"), ("A", "nano"), ("B", "nano"), ("B", "nano"), ("C", "other"), ("D", "")]:
        history.record("p", "DHT22", library, target=target)
    arduino = ("uno", "nano", "mega").__contains__
    assert history.choices("p", "DHT22", Targets("uno", arduino)) == {"A": 1}
    assert history.choices("p", "DHT22", Targets("mega", arduino)) == {"A": 2, "B": 2, "D": 1}
    assert history.choices_for_model("dht22", Targets("mega", arduino)) == {"A": 2, "B": 2, "D": 1}
    assert history.choices("p", "DHT22") == {"A": 2, "B": 2, "C": 1, "D": 1}
    assert ForgivingHistory(history.place, Targets("other", arduino)).choices("p", "DHT22") == {"C": 1}


def test_a_tie_is_no_choice(history: History) -> None:
    history.record("p", "t", "A")
    assert chosen_from_history("p", "t", history) == "A"
    history.record("p", "t", "B")
    assert chosen_from_history("p", "t", history) is None
    history.record("p", "t", "B")
    assert chosen_from_history("p", "t", history) == "B"


def test_names_are_never_read_as_sql(history: History) -> None:
    name = "x'); DROP TABLE choice; --"
    history.record(name, name, name)
    assert history.choices(name, name) == {name: 1}


def test_a_choice_needs_part_and_library(history: History) -> None:
    for part_id, title, library in [("p", "t", ""), ("", "", "A")]:
        with pytest.raises(UsageError):
            history.record(part_id, title, library)
    assert not Path(history.place).exists()


def test_forget(history: History) -> None:
    for part_id, library in [("p", "A"), ("p", "B"), ("q", "A")]:
        history.record(part_id, "t", library)
    with pytest.raises(UsageError, match="to forget"):
        history.forget()
    assert history.forget("p", library="A") == 1
    assert history.forget("nobody") == 0
    assert [(entry.part_id, entry.library) for entry in history.entries()] == [("p", "B"), ("q", "A")]
    assert history.forget(everything=True) == 2


def test_version_target_and_component_are_kept_beside(history: History) -> None:
    history.record("p", "t", "A", version="1.0", target="uno", component="T1", day=DAY)
    history.record("p", "t", "A", version="1.1", target="uno", component="T1", day=DAY)
    history.record("p", "t", "A", version="1.1", target="uno", component="T2", day=DAY)
    assert history.choices("p", "t") == {"A": 3}
    assert [(e.version, e.count, e.component) for e in history.entries()] == [("1.0", 1, "T1"), ("1.1", 2, "T2")]


def test_choices_for_a_model_number(history: History) -> None:
    history.record("p", "DHT22 Temperature Sensor", "A")
    history.record("q", "DHT 22 breakout", "A")
    history.record("q", "Sensor DHT11", "B")
    assert history.choices_for_model("dht22") == {"A": 2}
    assert history.choices_for_model("dht") == {}


ENTRIES = [
    HistoryEntry("p", "t, with a comma", "A", 2, "2026-11-21", "1.0", "uno", "T1"),
    HistoryEntry("q", 'a "quoted"\ntitle', "Bü", 1, "2026-01-01"),
]


@pytest.mark.parametrize(("write", "read"), [(to_json, from_json), (to_csv, from_csv)])
def test_what_is_exported_is_imported(
    write: Callable[..., str], read: Callable[..., list[HistoryEntry]], history: History
) -> None:
    text = write(ENTRIES)
    assert read(text) == ENTRIES
    assert history.take_over(read(text)) == 2
    assert history.entries() == ENTRIES
    assert history.take_over(read(text)) == 0, "a second time changes nothing"


ODD = [
    HistoryEntry("\0\x01", "\f\v\x1b[1m\r\n\t\r", "\x7f\x85\u2028", 1, "2026-01-01", "=1+1", "\u241b000C", "\ufeff\ufffe\uffff"),
    HistoryEntry('"', "x" * 300_000, ",;\"'", 2**31 - 1, "2026-01-01", "\n", " a ", "\N{GRINNING FACE}"),
]


@pytest.mark.parametrize("form", ["xmi", "csv", "json"])
def test_control_characters_and_long_fields_survive_the_exchange(form: str, history: History, tmp_path: Path) -> None:
    history.take_over(ODD)
    assert export_history(history, tmp_path / f"a.{form}") == ODD
    other = History(tmp_path / "other.sqlite")
    assert import_history(other, tmp_path / f"a.{form}") == (2, 2)
    assert other.entries() == ODD


_TEXT = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=20)


@settings(max_examples=60)
@given(
    st.lists(
        st.builds(HistoryEntry, _TEXT, _TEXT, _TEXT, st.integers(1, 9), st.just("2026-01-01"), _TEXT, _TEXT, _TEXT), max_size=3
    )
)
def test_any_text_survives_the_exchange(entries: list[HistoryEntry]) -> None:
    assert from_json(to_json(entries)) == entries
    assert from_csv(to_csv(entries).encode().decode()) == entries
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.xmi"
        save_model(history_to_model(entries), path)
        assert model_to_history(load_model(path)) == entries


def test_taking_over_keeps_the_higher_count_and_the_later_day(history: History) -> None:
    history.record("p", "t", "A", day=date(2027, 1, 1))
    assert history.take_over([HistoryEntry("p", "t", "A", 2, "2026-11-21")]) == 1
    assert history.entries() == [HistoryEntry("p", "t", "A", 2, "2027-01-01")]
    assert history.take_over([HistoryEntry("p", "t", "A", 1, "2026-11-21")]) == 0


GOOD = {"part_id": "p", "title": "t", "library": "A", "count": 1, "last_used": "2026-11-21"}


@pytest.mark.parametrize(
    "document",
    [
        None,
        {"schema": "other", "entries": []},
        {"schema": SCHEMA, "entries": [{"part_id": "p"}]},
        {"schema": SCHEMA, "entries": [5]},
        *(
            {"schema": SCHEMA, "entries": [GOOD | wrong]}
            for wrong in (
                {"count": 0}, {"count": True}, {"last_used": "yesterday"}, {"last_used": "20261121"}, {"library": ""},
                {"title": "\ud800"}, {"part_id": "", "title": ""}, {"version": 2},
            )
        ),
    ],
)  # fmt: skip
def test_a_damaged_document_is_refused(document: object) -> None:
    with pytest.raises(SourceError):
        from_json(json.dumps(document))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the column 'part_id' is missing"),
        ("part_id,title,library,count,last_used\np,t,A,x,2026-11-21\n", "line 2 of the history is damaged: its count"),
        ("part_id,title,library,count,last_used\np,t,,1,2026-11-21\n", "it names no part or no library"),
        ('part_id,title,library,count,last_used\n"p,t,A,1,2026-11-21\n', "this is not CSV"),
    ],
)
def test_a_damaged_table_is_refused(text: str, message: str) -> None:
    with pytest.raises(SourceError, match=message):
        from_csv(text)


@pytest.mark.parametrize("use", [lambda h: h.choices("p", "t"), lambda h: h.record("p", "t", "A"), lambda h: h.entries()])
def test_damaged_and_foreign_files(tmp_path: Path, use: Callable[[History], object]) -> None:
    damaged, foreign, folder, newer = (tmp_path / name for name in ("damaged", "foreign", "folder", "newer"))
    damaged.write_bytes(b"this is no database, and long enough to be taken for one" * 20)
    with closing(sqlite3.connect(foreign)) as db, db:
        db.execute("CREATE TABLE choice(a)")
    folder.mkdir()
    History(newer).record("p", "t", "A")
    with closing(sqlite3.connect(newer)) as db, db:
        db.execute("PRAGMA user_version=3")
    for path in (damaged, foreign, folder, newer):
        before = path.read_bytes() if path.is_file() else b""
        with pytest.raises(SourceError) as caught:
            use(History(path))
        assert caught.value.location is not None
        assert caught.value.location.path == str(path)
        assert "ROBOSMI_HISTORY" in str(caught.value.fix)
        assert before == (path.read_bytes() if path.is_file() else b""), "and nothing is overwritten"


@pytest.mark.parametrize("column", ["part_id", "title", "library", "version", "target", "component", "last_used", "count"])
@pytest.mark.parametrize("value", [b"\xff\x00", 1e308 * 10, 1.5])
def test_a_value_of_another_kind_is_refused(column: str, value: object, history: History) -> None:
    """SQLite keeps any value in any column; only a number becomes a text by itself where a text belongs."""
    history.record("p", "DHT22", "A", version="1", target="uno", component="C")
    with closing(sqlite3.connect(history.place)) as db:
        db.execute(f"UPDATE choice SET {column} = ?", (value,))
        db.commit()
    if isinstance(value, float) and column != "count":
        assert [getattr(entry, column) for entry in history.entries()] == [str(value).capitalize()]
        return
    with pytest.raises(SourceError, match=r"a row of it has .* where a (text|count) belongs") as caught:
        history.entries()
    assert caught.value.fix
    if column in ("title", "library", "target", "count"):
        with pytest.raises(SourceError):
            history.choices_for_model("dht22")
    if column in ("library", "target", "count"):
        with pytest.raises(SourceError):
            history.choices("p", "DHT22")


def test_an_empty_file_is_an_empty_history(tmp_path: Path) -> None:
    (tmp_path / "empty").touch()
    empty = History(tmp_path / "empty")
    assert empty.choices("p", "t") == {}
    empty.record("p", "t", "A")
    assert empty.choices("p", "t") == {"A": 1}


def test_a_file_of_format_1_is_read_and_brought_up_to_date(tmp_path: Path) -> None:
    old = tmp_path / "old.sqlite"
    with closing(sqlite3.connect(old)) as db:
        db.executescript((DATA / "history_1.sql").read_text())
    history = History(old)
    assert history.entries() == [HistoryEntry("p", "t", "A", 3, "2026-11-20")]
    history.record("p", "t", "A", day=DAY)
    assert history.entries() == [HistoryEntry("p", "t", "A", 4, "2026-11-21")]


def test_a_history_that_cannot_be_used_has_no_choices_and_says_why(tmp_path: Path) -> None:
    damaged = tmp_path / "damaged"
    damaged.write_bytes(b"this is no database, and long enough to be taken for one" * 20)
    history = ForgivingHistory(damaged)
    assert history.choices("p", "t") == history.choices_for_model("m1") == {}
    assert history.trouble is not None
    assert "cannot be used" in history.trouble.message
    assert ForgivingHistory(tmp_path / "absent").trouble is None


def test_sixteen_runs_make_a_history_and_write_into_it_and_nothing_is_lost(tmp_path: Path) -> None:
    outcome = write_at_once(tmp_path / "new" / "shared.sqlite", writers=16, each=6)
    assert outcome.refused == []
    assert outcome.kept == 96


def test_a_lock_under_which_nobody_writes_is_said(history: History, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robosmi.recommend.history._WAIT_S", 0.1)
    history.record("p", "t", "A")
    with closing(sqlite3.connect(history.place)) as other:
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(SourceError, match="locked"):
            history.record("p", "t", "A")
        assert history.choices("p", "t") == {"A": 1}
    history.record("p", "t", "A")
    assert history.choices("p", "t") == {"A": 2}


def test_what_a_killed_writer_began_is_undone_by_the_next_reader(history: History, tmp_path: Path) -> None:
    history.record("p", "t", "A")
    code = "import os, sqlite3, sys; db = sqlite3.connect(sys.argv[1], isolation_level=None)\n"
    code += "db.execute('PRAGMA cache_size=1'); db.execute('BEGIN IMMEDIATE')\n"
    code += "db.executemany('INSERT INTO choice VALUES(?,?,?,?,?,?,1,?)', [(str(n), *['x' * 900] * 6) for n in range(500)])\n"
    code += "os.kill(os.getpid(), 9)"
    subprocess.run([sys.executable, "-c", code, history.place], check=False)
    assert Path(f"{history.place}-journal").stat().st_size > 0, "it died in the middle"
    assert [entry.count for entry in history.entries()] == [1]


@pytest.fixture(params=["sqlite", "server"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """An SQLAlchemy URL: of a file, and of a server where ROBOSMI_TEST_DATABASE names one."""
    pytest.importorskip("sqlalchemy")
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'team.sqlite'}"
    server = os.environ.get("ROBOSMI_TEST_DATABASE")
    if not server:
        pytest.skip("ROBOSMI_TEST_DATABASE names no database server")
    History(server).forget(everything=True)
    return server


def test_a_shared_database(url: str) -> None:
    history = History(url)
    assert history.choices("p", "t") == {}
    history.record("p", "x'); DROP TABLE robosmi_choice; --", "A", day=DAY)
    for library in ("A", "B", "A"):
        history.record("p", "t", library, version="1", day=DAY)
    assert list(history.choices("p", "t").items()) == [("A", 2), ("B", 1)]
    assert History(url).choices("p", "t") == {"A": 2, "B": 1}
    assert history.take_over([HistoryEntry("p", "t", "B", 5, "2027-01-01", "1")]) == 1
    assert history.choices("p", "t") == {"B": 5, "A": 2}
    assert history.forget("p", library="A") == 2
    assert [(e.library, e.count, e.last_used) for e in history.entries()] == [("B", 5, "2027-01-01")]


def test_many_write_into_a_shared_database(url: str) -> None:
    History(url).record("p", "t", "A")

    def five() -> None:
        for _ in range(5):
            History(url).record("p", "t", "A")

    threads = [threading.Thread(target=five) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert History(url).choices("p", "t") == {"A": 21}


def test_a_wrong_url_and_a_place_that_is_not_there() -> None:
    pytest.importorskip("sqlalchemy")
    with pytest.raises((SourceError, MissingToolError)) as wrong:
        History("nosuchkind://user:secret@host/name").entries()
    assert "secret" not in str(wrong.value)
    with pytest.raises(SourceError) as caught:
        History("sqlite:////no/such/folder/x.sqlite").record("p", "t", "A")
    assert "cannot be used" in str(caught.value)


def test_a_failed_write_leaves_nothing_half_done(history: History) -> None:
    history.record("p", "t", "A", day=DAY)

    def stop_halfway() -> None:
        with history._database.writing() as statements:
            statements.run("DELETE FROM {table}", {})
            raise RuntimeError

    with pytest.raises(RuntimeError):
        stop_halfway()
    assert history.choices("p", "t") == {"A": 1}


def test_where_the_history_is(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path))
    monkeypatch.delenv("ROBOSMI_HISTORY", raising=False)
    assert default_place() == tmp_path / "history.sqlite"
    monkeypatch.setenv("ROBOSMI_HISTORY", str(tmp_path / "mine"))
    assert History().place == str(tmp_path / "mine")
    assert History(tmp_path / "given").place == str(tmp_path / "given")
    monkeypatch.setenv("ROBOSMI_HISTORY", "sqlite:///team.sqlite")
    assert default_place() == "sqlite:///team.sqlite"
