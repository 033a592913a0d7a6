"""The history of choices: missing, empty, damaged and foreign files; counting, ties, forgetting, export and import."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from datetime import date
from pathlib import Path

import pytest

from robosmi.errors import SourceError, UsageError
from robosmi.recommend.history import SCHEMA, Entry, History, chosen_from_history, default_path

DAY = date(2026, 11, 21)


def test_a_missing_file_is_an_empty_history_and_stays_missing(history: History) -> None:
    assert history.choices("p", "t") == {}
    assert history.entries() == []
    assert history.forget(everything=True) == 0
    assert history.export_json() == {"schema": SCHEMA, "entries": []}
    assert chosen_from_history("p", "t", history) is None
    assert not history.path.parent.exists()


def test_choices_are_counted_for_the_very_part(history: History) -> None:
    history.record("p", "t", "B", day=DAY)
    history.record("p", "t", "A", day=DAY)
    history.record("p", "t", "A", day=date(2026, 1, 1))
    history.record("p", "other title", "C", day=DAY)
    history.record("other part", "t", "C", day=DAY)
    assert list(history.choices("p", "t").items()) == [("A", 2), ("B", 1)]
    assert Entry("p", "t", "A", 2, "2026-11-21") in history.entries(), "the later day is kept"
    assert len(history.entries()) == 4


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
    assert not history.path.exists()


def test_forget(history: History) -> None:
    for part_id, library in [("p", "A"), ("p", "B"), ("q", "A")]:
        history.record(part_id, "t", library)
    with pytest.raises(UsageError, match="what to forget"):
        history.forget()
    assert history.forget("p", library="A") == 1
    assert history.forget("nobody") == 0
    assert [(entry.part_id, entry.library) for entry in history.entries()] == [("p", "B"), ("q", "A")]
    assert history.forget(everything=True) == 2


def test_export_and_import(history: History, tmp_path: Path) -> None:
    history.record("p", "t", "A", day=DAY)
    history.record("p", "t", "A", day=DAY)
    document = history.export_json()
    assert document["entries"] == [{"part_id": "p", "title": "t", "library": "A", "count": 2, "last_used": "2026-11-21"}]
    other = History(tmp_path / "other.sqlite")
    other.record("p", "t", "A", day=date(2027, 1, 1))
    assert other.import_json(document) == 1
    assert other.entries() == [Entry("p", "t", "A", 2, "2027-01-01")]
    assert other.import_json(document) == 0, "a second time changes nothing"


@pytest.mark.parametrize(
    "document",
    [
        None,
        {"schema": "other", "entries": []},
        {"schema": SCHEMA, "entries": [{"part_id": "p"}]},
        *(
            {
                "schema": SCHEMA,
                "entries": [{"part_id": "p", "title": "t", "library": "A", "count": 1, "last_used": "2026-11-21"} | wrong],
            }
            for wrong in ({"count": 0}, {"count": True}, {"last_used": "yesterday"}, {"last_used": "20261121"}, {"library": ""})
        ),
    ],
)
def test_a_damaged_document_is_not_taken_over(history: History, document: object) -> None:
    with pytest.raises(SourceError):
        history.import_json(document)
    assert not history.path.exists()


@pytest.mark.parametrize("use", [lambda h: h.choices("p", "t"), lambda h: h.record("p", "t", "A"), lambda h: h.entries()])
def test_damaged_and_foreign_files(tmp_path: Path, use: Callable[[History], object]) -> None:
    damaged, foreign, folder, newer = (tmp_path / name for name in ("damaged", "foreign", "folder", "newer"))
    damaged.write_bytes(b"this is no database, and long enough to be taken for one" * 20)
    with sqlite3.connect(foreign) as db:
        db.execute("CREATE TABLE choice(a)")
    folder.mkdir()
    History(newer).record("p", "t", "A")
    with sqlite3.connect(newer) as db:
        db.execute("PRAGMA user_version=2")
    for path in (damaged, foreign, folder, newer):
        before = path.read_bytes() if path.is_file() else b""
        with pytest.raises(SourceError) as caught:
            use(History(path))
        assert caught.value.location is not None
        assert caught.value.location.path == str(path)
        assert "ROBOSMI_HISTORY" in str(caught.value.fix)
        assert before == (path.read_bytes() if path.is_file() else b""), "and nothing is overwritten"


def test_an_empty_file_is_an_empty_history(tmp_path: Path) -> None:
    empty = History(tmp_path / "empty")
    empty.path.touch()
    assert empty.choices("p", "t") == {}
    empty.record("p", "t", "A")
    assert empty.choices("p", "t") == {"A": 1}


def test_a_failed_write_leaves_nothing_half_done(history: History) -> None:
    history.record("p", "t", "A", day=DAY)

    def stop_halfway() -> None:
        with history._writing() as db:
            db.execute("DELETE FROM choice")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        stop_halfway()
    assert history.choices("p", "t") == {"A": 1}


def test_where_the_history_is(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path))
    monkeypatch.delenv("ROBOSMI_HISTORY", raising=False)
    assert default_path() == tmp_path / "history.sqlite"
    monkeypatch.setenv("ROBOSMI_HISTORY", str(tmp_path / "mine"))
    assert History().path == tmp_path / "mine"
    assert History(tmp_path / "given").path == tmp_path / "given"
