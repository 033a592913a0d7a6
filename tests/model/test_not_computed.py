"""A derived feature and an operation without code that computes them are errors that say so: not zero, empty or unknown."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import RobosmiError
from robosmi.model.elements.show import element_html, items_html, rows
from robosmi.model.emf import EmfModel
from robosmi.model.plantuml import to_plantuml
from robosmi.query import ModelView
from robosmi.query.any_operations import e_cross_references
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


@pytest.mark.parametrize("name", ["lid", "neighbours", "parts", "tags"])
def test_a_derived_reference_and_many_values_are_told_to_have_no_code(name: str) -> None:
    model = boxes()
    box = model.Box.all.first()
    reads: list[Callable[[], Any]] = [
        lambda: getattr(box, name), lambda: box.eGet(name), lambda: evaluate(f"Box.all.collect(lambda b: b.{name})", [model]),
    ]  # fmt: skip
    for read in reads:
        with pytest.raises(RobosmiError, match=rf"Box\.{name} is derived, and no code is there that computes it"):
            read()


def test_a_derived_reference_that_was_set_is_given() -> None:
    model = boxes()
    lid = model.Box(name="lid")
    box = model.Box(name="two", lid=lid)
    assert box.lid is lid
    assert [each.name for each in model.Box.all if each.name != "one" and each.eIsSet("lid")] == ["two"]


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
    assert "width" in items_html(list(model.Box.all))
    assert "width = 2.0" in to_plantuml(model)
    assert [one.eGet("name") for one in model.model.all_contents()] == ["one"]
    assert len(e_cross_references(model.Box.all.first())) == 0
    model.delete(model.Box(name="two"))
    shutil.copy(ECORE, tmp_path)
    model.save(tmp_path / "box.xmi")
    assert EmfModel.load(tmp_path / "box.xmi", ECORE).roots[0].width == 2.0


def test_features_that_are_derived_and_not_volatile_are_stored_as_emf_stores_them(tmp_path: Path) -> None:
    """What EMF's dynamic elements do: `derived` counts for copies only, `transient` for files only."""
    ecore = Path(shutil.copy(ECORE.with_name("shelf.ecore"), tmp_path))
    model = ModelView(EmfModel((), ecore, "S"))
    low, high = model.Shelf(name="low"), model.Shelf(name="high")
    top = model.Shelf(name="top", boards=[low, high], tags=["a", "b"])
    low.beside, low.above, low.lost = [high], high, [high]
    assert [len(each) for each in (top.boards, top.tags, low.beside, low.lost, top.beside)] == [2, 2, 1, 1, 0]
    assert [one.eGet("name") for one in model.model.all_contents()] == ["top", "low", "high"]
    assert list(e_cross_references(low)) == [high, high, high]
    model.save(tmp_path / "shelf.xmi")
    again = ModelView(EmfModel.load(tmp_path / "shelf.xmi", ecore)).Shelf.all
    assert [(one.name, list(one.tags), [each.name for each in one.beside], len(one.lost)) for one in again] == [
        ("top", ["a", "b"], [], 0), ("low", [], ["high"], 0), ("high", [], [], 0),
    ]  # fmt: skip
    assert again[1].above is again[2]
    model.delete(high)
    assert (len(low.beside), low.above, len(top.boards)) == (0, None, 1)
