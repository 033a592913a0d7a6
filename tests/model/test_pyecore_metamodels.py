"""Metamodels that a program made in pyecore: strict once they are given to a `Metamodel` or a model."""

from __future__ import annotations

from typing import Any

import pytest
from pyecore.ecore import EAttribute, EClass, EEnum, EInt, EPackage, EReference, EString

from robosmi.errors import ModelError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView


def shop() -> tuple[Any, Any]:
    """A package made in pyecore, and its class of goods."""
    kind = EEnum("Kind", literals=["motor", "sensor"])
    goods = EClass("Goods")
    for feature in (EAttribute("name", EString), EAttribute("price", EInt), EAttribute("kind", kind),
                    EReference("parts", goods, upper=-1, containment=True)):  # fmt: skip
        goods.eStructuralFeatures.append(feature)
    special = EClass("Special", superclass=(goods,))
    package = EPackage("shop", "http://example.org/shop", "shop")
    package.eClassifiers.extend([kind, goods, special])
    return package, goods


@pytest.mark.parametrize("give", [lambda p: Metamodel([p]), lambda p: Metamodel.of(p), lambda p: EmfModel((), [p])])
def test_a_misspelt_feature_is_refused(give: Any) -> None:
    package, goods = shop()
    give(package)
    special = package.getEClassifier("Special")
    for attempt, said in (
        (lambda: goods(nmae="x"), "Goods has no feature 'nmae' .did you mean 'name'"),
        (lambda: setattr(special(), "pirce", 3), "Special has no feature 'pirce' .did you mean 'price'"),
        (lambda: special(price="three"), "Special.price does not take 'three'"),
        (lambda: goods(kind="motor"), "Goods.kind takes a literal of Kind, not the text 'motor'"),
    ):
        with pytest.raises(ModelError, match=said):
            attempt()
    made = special(name="x", price=3, kind=package.getEClassifier("Kind").motor, parts=[goods(name="y")])
    assert (made.name, made.price, made.kind.name, [p.name for p in made.parts]) == ("x", 3, "motor", ["y"])


def test_a_feature_that_is_added_later_is_taken() -> None:
    package, goods = shop()
    M = ModelView(EmfModel((), [package], "M"))
    one = M.Goods(name="x")
    goods.eStructuralFeatures.append(EAttribute("weight", EInt))
    one.weight = 3
    assert M.Goods.all.weight == [3]


def test_a_model_of_such_elements_alone_makes_their_classes_strict() -> None:
    _, goods = shop()
    EmfModel(one := goods(name="x"))
    with pytest.raises(ModelError, match="no feature 'nam'"):
        one.nam = 3


def test_pyecore_goes_on_with_its_own_attributes() -> None:
    package, goods = shop()
    model = EmfModel((), [package])
    one = model.create(goods, name="x")
    one.listeners = []
    one.parts.append(goods(name="y"))
    assert one.parts[0].eContainer() is one
    model.delete(one.parts[0])
    assert list(one.parts) == []
