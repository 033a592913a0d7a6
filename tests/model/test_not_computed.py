"""A derived attribute and an operation that only a metamodel tells of are no zero and no unknown feature."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.errors import RobosmiError
from robosmi.model.emf import EmfModel
from robosmi.model.show import element_html, rows
from robosmi.query import ModelView
from robosmi.query.expression import evaluate

ECORE = Path(__file__).parent / "derived" / "box.ecore"


def boxes() -> ModelView:
    model = ModelView(EmfModel((), ECORE, "B"))
    model.Box(name="one", width=2.0)
    return model


def test_a_derived_attribute_is_told_to_have_no_code() -> None:
    with pytest.raises(RobosmiError, match=r"Box\.area is derived, and no code is there that computes it") as refused:
        _ = boxes().Box.all.first().area
    assert "mixins.py" in str(refused.value.fix)
    with pytest.raises(RobosmiError, match=r"Box\.area is derived"):
        evaluate("Box.all.area", [boxes()])


def test_a_default_and_a_value_that_was_given_are_given() -> None:
    box = boxes().Box.all.first()
    assert box.sides == 4
    box.area = 3.0
    assert box.area == 3.0


def test_an_operation_is_told_to_have_no_body() -> None:
    with pytest.raises(RobosmiError, match=r"the operation Box\.open has no body"):
        boxes().Box.all.first().open()
    with pytest.raises(RobosmiError, match=r"Box has no feature 'opem'"):
        boxes().Box.all.first().opem()


def test_elements_are_shown_stored_and_read_without_them(tmp_path: Path) -> None:
    model = boxes()
    assert [(row["name"], row["width"], "area" in row) for row in rows(model)] == [("one", 2.0, False)]
    assert "width" in element_html(model.Box.all.first())
    shutil.copy(ECORE, tmp_path)
    model.save(tmp_path / "box.xmi")
    assert EmfModel.load(tmp_path / "box.xmi", ECORE).roots[0].width == 2.0
