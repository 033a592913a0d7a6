"""A required text that is empty is a value: what is written is read again, and what Eclipse calls valid is not refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import RobosmiError
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView

ECORE = Path(__file__).parent / "required" / "door.ecore"


def test_an_empty_text_is_there(tmp_path: Path) -> None:
    model = ModelView(EmfModel((), ECORE, "D"))
    model.Door(name="", label="oak")
    model.save(tmp_path / "door.xmi")
    again = ModelView(EmfModel.load(tmp_path / "door.xmi", ECORE))
    assert [(door.name, door.label) for door in again.Door.all] == [("", "oak")]


def test_a_text_that_is_missing_is_told() -> None:
    with pytest.raises(RobosmiError, match="Door has no 'name', which it needs"):
        EmfModel.load(ECORE.with_name("without_name.xmi"), ECORE, strict=True)
