"""A folder that only has the name of the one where files wait is a person's, and an output folder may be the root."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi import resources
from robosmi.errors import StoppedError
from robosmi.files.commit import commit
from robosmi.files.recovery import STAGE, recover
from robosmi.files.run_lock import own_stage
from tests.running import tree


@pytest.mark.parametrize("beside", [True, False], ids=["beside a new folder", "in the folder"])
def test_a_folder_with_the_name_of_waiting_files_is_not_removed(beside: bool, tmp_path: Path) -> None:
    folder = tmp_path / "zz"
    stage = tmp_path / f"{STAGE}-zz" if beside else folder / STAGE
    (stage / "deep").mkdir(parents=True)
    (stage / "deep" / "thesis.txt").write_text("precious")
    before = tree(tmp_path)
    for writing in (True, False):
        with pytest.raises(StoppedError, match="no run of yours has made it") as raised:
            commit(folder, {"a": b"1"}) if writing else recover(folder)
        assert raised.value.fix
        assert raised.value.location is not None
        assert raised.value.location.path == str(stage)
        assert tree(tmp_path) == before


@pytest.mark.parametrize("beside", [True, False], ids=["beside a new folder", "in the folder"])
def test_what_a_killed_run_has_left_is_removed(beside: bool, tmp_path: Path) -> None:
    folder = tmp_path / "zz"
    stage = tmp_path / f"{STAGE}-zz" if beside else folder / STAGE
    stage.mkdir(parents=True)
    commit(folder, {"a": b"1"})  # an empty one holds nothing
    assert [p.name for p in tmp_path.iterdir()] == ["zz"]
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == {"a": b"1"}
    stage.mkdir()
    own_stage(stage)
    (stage / "half").write_text("half")
    commit(folder, {"a": b"2"})
    assert [p.name for p in tmp_path.iterdir()] == ["zz"]
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == {"a": b"2"}


def test_a_folder_that_took_the_place_of_a_killed_runs_is_not_its(tmp_path: Path) -> None:
    stage = tmp_path / "zz" / STAGE
    stage.mkdir(parents=True)
    own_stage(stage)
    stage.rename(tmp_path / "elsewhere")
    stage.mkdir()
    (stage / "thesis.txt").write_text("precious")
    with pytest.raises(StoppedError):
        recover(tmp_path / "zz")
    assert (stage / "thesis.txt").read_text() == "precious"


def test_a_record_that_another_user_could_have_written_removes_nothing(tmp_path: Path) -> None:
    stage = tmp_path / "zz" / STAGE
    stage.mkdir(parents=True)
    own_stage(stage)
    (stage / "thesis.txt").write_text("precious")
    for record in (resources.user_data() / "runs").glob("*.made"):
        assert record.stat().st_mode & 0o77 == 0
        record.chmod(0o666)
    with pytest.raises(StoppedError):
        recover(tmp_path / "zz")
    assert (stage / "thesis.txt").read_text() == "precious"
