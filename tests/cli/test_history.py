"""`robosmi history` and `robosmi libraries`, and what other commands do when the history cannot be used."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from robosmi.recommend.history import History
from tests.running import run

LIBRARIES = Path(__file__).resolve().parents[1] / "recommend" / "data" / "libraries"


@pytest.fixture
def remembered() -> History:
    """A history with three choices."""
    history = History()
    history.record("p", "Basic Servo", "Servo", version="1.3.0", target="uno", component="Servo1")
    history.record("p", "Basic Servo", "Servo", version="1.3.0", target="uno", component="Servo2")
    history.record("q", "DHT22", "DHT sensor library")
    return history


def test_list(remembered: History) -> None:
    outcome = run("history", "list", "--json")
    assert outcome.code == 0
    assert [(e["library"], e["count"], e["version"]) for e in outcome.result["entries"]] == [
        ("Servo", 2, "1.3.0"), ("DHT sensor library", 1, ""),
    ]  # fmt: skip
    assert "2 x  Basic Servo: Servo 1.3.0 for uno" in run("history", "list").out


def test_an_empty_history_is_said(tmp_path: Path) -> None:
    assert "no choices in" in run("history", "list", "--history", tmp_path / "absent.sqlite").out


@pytest.mark.parametrize("form", ["xmi", "csv", "json"])
def test_exported_forgotten_and_imported_again(remembered: History, form: str, tmp_path: Path) -> None:
    before = remembered.entries()
    file = tmp_path / f"choices.{form}"
    assert run("history", "export", file).code == 0
    assert run("history", "forget", "--all", "--json").result["forgotten"] == 2
    assert remembered.entries() == []
    assert run("history", "import", file, "--json").result == {
        "place": remembered.place, "found": 2, "added": 2, "skipped": 0,
    }  # fmt: skip
    assert remembered.entries() == before
    assert run("history", "import", file, "--json").result["added"] == 0


@pytest.mark.parametrize("form", ["xmi", "csv", "json"])
def test_an_export_replaces_no_link(remembered: History, form: str, tmp_path: Path) -> None:
    (tmp_path / "other").write_text("mine")
    file = tmp_path / f"choices.{form}"
    file.symlink_to(tmp_path / "other")
    assert run("history", "export", file).code == 5
    assert file.is_symlink()
    assert (tmp_path / "other").read_text() == "mine"


def test_forget_what_is_named(remembered: History) -> None:
    assert run("history", "forget").code == 2
    assert run("history", "forget", "--part", "Basic Servo", "--library", "Servo", "--json").result["forgotten"] == 1
    assert [entry.title for entry in remembered.entries()] == ["DHT22"]


@pytest.mark.parametrize(
    ("name", "content", "code"), [("a.txt", "", 2), ("a.csv", "x\n", 3), ("a.json", "{", 3), ("a.xmi", "<a/>", 3)]
)
def test_what_is_no_history_is_refused(name: str, content: str, code: int, tmp_path: Path) -> None:
    (tmp_path / name).write_text(content)
    outcome = run("history", "import", tmp_path / name)
    assert outcome.code == code
    assert "do:" in outcome.err
    assert run("history", "import", tmp_path / "absent.csv").code == 3


def _damaged(path: Path) -> None:
    path.write_bytes(b"no database, and long enough to be taken for one " * 20)


def _foreign(path: Path) -> None:
    with closing(sqlite3.connect(path)) as db:
        db.execute("CREATE TABLE choice(a)")


@pytest.mark.parametrize("spoil", [_damaged, _foreign])
def test_a_run_goes_on_without_a_history_and_says_so(
    spoil: object, line_follower: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = tmp_path / "spoilt"
    assert callable(spoil)
    spoil(place)
    before = place.read_bytes()
    monkeypatch.setenv("ROBOSMI_HISTORY", str(place))
    migrated = run("migrate", line_follower, "-o", tmp_path / "out", "--json")
    assert migrated.code == 0
    assert {"RS410", "RS411"} <= migrated.rules()
    recommended = run("recommend", line_follower.with_name("line_following_robot.fzz"), "--json")
    assert recommended.code == 0
    assert "RS411" in recommended.rules()
    assert place.read_bytes() == before
    assert run("history", "list").code == 3


def test_values_of_another_kind_are_refused(remembered: History, line_follower: Path, tmp_path: Path) -> None:
    with closing(sqlite3.connect(remembered.place)) as db:
        db.execute("UPDATE choice SET title = x'ff00', library = x'ff00', count = 1e999")
        db.commit()
    recommended = run("recommend", line_follower.with_name("line_following_robot.fzz"), "--json")
    assert recommended.code == 0
    assert "RS411" in recommended.rules()
    assert run("history", "list").code == 3
    for name in ("h.json", "h.csv", "h.xmi"):
        assert run("history", "export", tmp_path / name).code == 3
        assert not (tmp_path / name).exists()


def test_a_locked_history_is_read_as_it_was(remembered: History, line_follower: Path) -> None:
    with closing(sqlite3.connect(remembered.place, isolation_level=None)) as db:
        db.execute("BEGIN IMMEDIATE")
        outcome = run("recommend", line_follower.with_name("line_following_robot.fzz"), "--json")
    assert outcome.code == 0
    assert "RS411" not in outcome.rules()


def test_a_history_that_another_program_holds_is_done_without(
    remembered: History, line_follower: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robosmi.recommend.history._WAIT_S", 0.1)
    before = remembered.entries()
    with closing(sqlite3.connect(remembered.place, isolation_level=None)) as db:
        db.execute("BEGIN EXCLUSIVE")
        outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--json")
    assert outcome.code == 0
    assert {"RS410", "RS411"} <= outcome.rules()
    assert remembered.entries() == before


def test_a_history_that_can_only_be_read_is_read(remembered: History, line_follower: Path, tmp_path: Path) -> None:
    """A write version above 2 makes a file read-only for SQLite, whoever runs this (file format, section 1.3)."""
    place = Path(remembered.place)
    data = bytearray(place.read_bytes())
    data[18] = 3
    place.write_bytes(data)
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--json")
    assert outcome.code == 0
    assert "RS410" in outcome.rules()
    assert "RS411" not in outcome.rules()
    assert place.read_bytes() == data
    assert [e["library"] for e in run("history", "list", "--json").result["entries"]] == ["Servo", "DHT sensor library"]
    assert run("history", "forget", "--all").code == 3


def test_migrate_reads_and_writes_the_history_that_is_named(line_follower: Path, tmp_path: Path) -> None:
    place = tmp_path / "team.sqlite"
    assert run("migrate", line_follower, "-o", tmp_path / "out", "--history", place, "--json").code == 0
    assert {entry.library for entry in History(place).entries()} != set()
    assert History().entries() == [], "the user's own is left alone"


def test_libraries_import(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    folder = shutil.copytree(LIBRARIES, tmp_path / "libraries")
    outcome = run("libraries", "import", folder, "--json")
    assert outcome.code == 0
    assert {"name": "Described Sensor", "version": "1.2.3"} in outcome.result["added"]
    assert {Path(item["path"]).name for item in outcome.result["skipped"]} == {"no_headers", "twice", "library.properties"}
    assert outcome.rules() == {"RS420"}
    assert "read 5 libraries" in run("libraries", "import", folder).out
    assert run("libraries", "import", tmp_path / "absent").code == 3
