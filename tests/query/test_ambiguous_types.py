"""A type name that several packages have: the first counts, as in Epsilon, and what is left out is told."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import UsageError
from robosmi.model import open_model
from robosmi.model.elements.driver import AmbiguousTypeWarning
from robosmi.query import ModelView, Run, all_instances
from robosmi.query.expression import evaluate
from tests.running import run

FOLDER = Path(__file__).parent / "ambiguous"


def opened(name: str, **options: Any) -> Any:
    return ModelView(open_model(FOLDER / name, name="M", metamodel=FOLDER, **options))


@pytest.mark.parametrize("lazy", [False, True])
def test_elements_of_another_package_are_told(lazy: bool) -> None:
    view = opened("two.xmi", lazy=lazy)
    for name in ("Item", "M!Item"):
        with pytest.warns(AmbiguousTypeWarning, match="stock::Item, parts::Item; the first is used"):
            assert view.all(name).size() == 1
    with Run(view), pytest.warns(AmbiguousTypeWarning):
        assert all_instances("Item").pieces == [10]
    with pytest.warns(AmbiguousTypeWarning):
        assert view.Item.all.pieces == [10]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert view["parts::Item"].all.weight == [1, 2]
        assert view["stock::Item"].all.pieces == [10]


def test_a_name_that_only_the_metamodels_share_is_not_told() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert opened("one.xmi").Item.all.weight == [1]


def test_the_command_line_tells_it_as_a_finding() -> None:
    done = run("query", FOLDER / "two.xmi", "Item.all.size()", "--metamodel", FOLDER, "--json").document
    assert done["result"]["value"] == 1
    assert [finding["rule"] for finding in done["findings"]] == ["RS614"]
    assert "parts::Item" in done["findings"][0]["message"]


def test_a_package_in_the_place_of_a_type_is_explained() -> None:
    with pytest.raises(UsageError) as told:
        evaluate("parts.Item.all", [open_model(FOLDER / "one.xmi", name="M", metamodel=FOLDER)])
    assert 'all_instances("parts::' in (told.value.fix or "")
