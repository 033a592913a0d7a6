"""Features may be called as the parameters of the functions that make elements are: `kind`, `model`, `name`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.model.changes import Recording
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView, create

METAMODEL = Path(__file__).parent / "metamodels" / "parameters.ecore"
NAMES = ("kind", "name", "model", "element", "features", "target")
VALUES = {name: f"the {name}" for name in NAMES}


def _recorded(model: Any, kind: Any) -> Any:
    with Recording():
        return model.create(kind, **VALUES)


@pytest.mark.parametrize(
    "make",
    [
        lambda model, kind: kind(**VALUES),
        lambda model, kind: model.create(kind, **VALUES),
        lambda model, kind: model.create("Transition", **VALUES),
        lambda model, kind: model.model.create(kind, **VALUES),
        lambda model, kind: create(kind, **VALUES),
        lambda model, kind: model.model.metamodel.Transition(**VALUES),
        _recorded,
    ],
)
def test_a_feature_may_have_the_name_of_a_parameter(make: Callable[[Any, Any], Any]) -> None:
    model = ModelView(EmfModel((), Metamodel.load(METAMODEL), "M"))
    made = make(model, model.Transition)
    assert {name: made.eGet(name) for name in NAMES} == VALUES
