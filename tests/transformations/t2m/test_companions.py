"""Companions of drawings: read below the drawing's folder only, each once, and copied with the drawing."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robosmi import inputs
from robosmi.errors import SourceError
from robosmi.transformations.t2m import companions
from robosmi.transformations.t2m.companions import DrawingFolder


@pytest.fixture
def robot(tmp_path: Path) -> DrawingFolder:
    """A drawing with two sheets, one in a folder, and a file outside of its folder."""
    (tmp_path / "robot" / "sheets").mkdir(parents=True)
    (tmp_path / "robot" / "robot.sch").write_text("root")
    (tmp_path / "robot" / "motors.sch").write_text("motors")
    (tmp_path / "robot" / "sheets" / "legs.sch").write_text("legs")
    (tmp_path / "secret.sch").write_text("secret")
    return DrawingFolder(tmp_path / "robot" / "robot.sch")


def test_what_is_read_is_noted_once_in_the_order_of_its_reading(robot: DrawingFolder) -> None:
    assert robot.read("sheets/legs.sch") == b"legs"
    assert robot.read("motors.sch") == b"motors"
    assert robot.read(r"sheets\legs.sch") == b"legs"
    assert robot.read("../motors.sch", beside="sheets/legs.sch") == b"motors"
    assert robot.read("./sheets/../motors.sch") == b"motors"
    assert robot.companions == ["sheets/legs.sch", "motors.sch"]


@pytest.mark.parametrize(
    "named", ["", "../secret.sch", "sheets/../../secret.sch", "/etc/hostname", "C:/x.sch", "..", "a\0b", "sheets"]
)
def test_nothing_is_read_outside_of_the_folder(robot: DrawingFolder, named: str) -> None:
    assert robot.read(named) is None
    assert robot.companions == []


def test_a_link_that_leads_out_is_not_followed_and_one_within_is(robot: DrawingFolder) -> None:
    os.symlink(robot.path.parent.parent / "secret.sch", robot.path.parent / "out.sch")
    os.symlink(robot.path.parent / "motors.sch", robot.path.parent / "same.sch")
    assert robot.read("out.sch") is None
    assert robot.read("same.sch") == b"motors"


def test_what_cannot_be_read_is_refused_with_its_place(robot: DrawingFolder, monkeypatch: pytest.MonkeyPatch) -> None:
    os.mkfifo(robot.path.parent / "pipe.sch")
    with pytest.raises(SourceError, match="a named pipe") as refused:
        robot.read("pipe.sch")
    assert refused.value.location is not None
    assert refused.value.location.path == str(robot.path.parent / "pipe.sch")
    assert refused.value.fix
    monkeypatch.setattr(companions, "MOST_FILES", 1)
    robot.read("motors.sch")
    with pytest.raises(SourceError, match="more than 1 files"):
        robot.read("sheets/legs.sch")


def test_companions_have_a_limit_together(robot: DrawingFolder, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inputs, "DRAWING", inputs.Kind("drawing", 8))
    again = DrawingFolder(robot.path)
    again.read("motors.sch")
    with pytest.raises(SourceError, match="the drawing has more than"):
        again.read("sheets/legs.sch")
