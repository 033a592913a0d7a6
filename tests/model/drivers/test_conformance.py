"""What every driver must do, so that a query reads the same on every technology. A new driver adds an entry to conftest.py."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, RobosmiError, SourceError
from robosmi.model.elements.driver import (
    Model,
    ReadOnlyError,
    UnknownTypeError,
    contents_of,
    features_of,
    is_element,
    type_of,
    walk,
)
from robosmi.model.elements.show import rows, tree
from robosmi.model.plantuml import to_plantuml
from robosmi.query import ModelView, Q, Run, all_instances, all_of_kind, call, get, id_of, is_kind_of, is_type_of, type_named
from robosmi.query.expression import evaluate
from tests.model.drivers.conftest import Driver

# Types


def test_types_are_found_by_name_as_attributes_and_by_index(driver: Driver, model: Model) -> None:
    kind = model.find_type(driver.kind)
    assert driver.kind in model.type_names()
    assert model.type_named(driver.kind) is kind
    assert model.type_named(f"M!{driver.kind}") is kind
    assert getattr(model, driver.kind).kind is kind
    assert model[driver.kind] == getattr(model, driver.kind)
    assert model[driver.kind].name == driver.kind


def test_a_misspelt_type_fails_and_names_the_nearest(driver: Driver, model: Model) -> None:
    wrong, nearest = driver.misspelt[0]
    for attempt in (lambda: model.all_of_kind(wrong), lambda: getattr(model, wrong), lambda: model.type_named(wrong)):
        with pytest.raises(UnknownTypeError, match=f"did you mean '{nearest}'"):
            attempt()


def test_elements_are_of_their_type(driver: Driver, model: Model) -> None:
    element = model.all_of_type(driver.kind)[0]
    assert is_element(element)
    assert isinstance(element, getattr(model, driver.kind))
    assert is_kind_of(element, model.type_named(driver.kind))
    assert is_type_of(element, getattr(model, driver.kind))
    assert model.type_of(element) is type_of(element)


# Extents


def test_an_extent_is_in_the_order_of_all_contents(driver: Driver, model: Model) -> None:
    everything = list(model.all_contents())
    found = model.all_of_kind(driver.kind)
    assert [getattr(x, driver.feature) for x in found] == list(driver.values)
    assert len(set(map(id, everything))) == len(everything)
    places = {id(x): i for i, x in enumerate(everything)}
    assert [places[id(x)] for x in found] == sorted(places[id(x)] for x in found)


def test_a_container_comes_before_what_it_contains(driver: Driver, model: Model) -> None:
    everything = list(model.all_contents())
    places = {id(x): i for i, x in enumerate(everything)}
    assert [x for x in everything if x.eContainer() is not None and places[id(x.eContainer())] >= places[id(x)]] == []
    roots = [x for x in everything if x.eContainer() is None]
    assert [id(x) for root in roots for x in walk(root)] == list(places)
    assert all(part.eContainer() is x for x in everything for part in contents_of(x))


def test_asking_again_gives_the_same_elements_in_a_list_of_ones_own(driver: Driver, model: Model) -> None:
    first, second = list(model.all_of_kind(driver.kind)), list(model.all_of_kind(driver.kind))
    assert [id(x) for x in first] == [id(x) for x in second]
    given = model.all_of_kind(driver.kind)
    assert isinstance(given, list)
    given.clear()
    assert len(model.all_of_kind(driver.kind)) == len(first)


def test_exact_types_are_exact(driver: Driver, model: Model) -> None:
    kind = model.type_named(driver.kind)
    exact = model.all_of_type(kind)
    assert [id(x) for x in exact] == [id(x) for x in model.all_of_kind(kind) if type_of(x) is kind]


# Features


def test_features_are_attributes(driver: Driver, model: Model) -> None:
    for element in model.all_contents():
        for name in features_of(element):
            getattr(element, name)
    assert driver.feature in features_of(model.all_of_kind(driver.kind)[0])


def test_a_misspelt_feature_fails_and_names_the_nearest(driver: Driver, model: Model) -> None:
    wrong, nearest = driver.misspelt[1]
    element = model.all_of_kind(driver.kind)[0]
    with pytest.raises(ModelError, match=f"did you mean '{nearest}'") as caught:
        getattr(element, wrong)
    assert isinstance(caught.value, AttributeError)
    assert caught.value.fix
    with pytest.raises(ModelError):
        Q([element]).get(wrong)
    with pytest.raises((ModelError, AttributeError), match=r"did you mean|read-only"):
        setattr(element, wrong, "x")


# Identity


def test_an_id_leads_back_and_is_the_same_in_another_load(driver: Driver, model: Model, path: Path) -> None:
    ids = [model.id_of(x) for x in model.all_contents()]
    assert len(set(ids)) == len(ids)
    assert all(model.element(i) is x for i, x in zip(ids, model.all_contents(), strict=True))
    other = driver.opened(path)
    assert [other.id_of(x) for x in other.all_contents()] == ids


def test_an_unknown_id_is_nothing(driver: Driver, model: Model) -> None:
    for identity in ("no such id", "books/99", "", "books/0"):
        assert model.element(identity) is None


def test_a_model_owns_its_own_elements_only(driver: Driver, model: Model, path: Path) -> None:
    other = driver.opened(path)
    assert all(model.owns(x) for x in model.all_contents())
    assert not any(model.owns(x) for x in other.all_contents())
    assert not model.owns("text")
    assert not model.owns(None)


# Queries


def test_one_query_reads_alike_on_all(driver: Driver, model: Model) -> None:
    view = ModelView(model)
    found = getattr(view, driver.kind).all
    assert isinstance(found, Q)
    assert getattr(found, driver.feature) == list(driver.values)
    assert found.select(lambda x: getattr(x, driver.feature) == driver.values[0]).size() == 1
    assert all_of_kind(model, driver.kind) == found
    assert [get(x, driver.feature) for x in found] == list(driver.values)
    assert found.of_kind(getattr(view, driver.kind)) == found
    with Run(model):
        assert all_instances(f"M!{driver.kind}") == found
        assert type_named(driver.kind) is model.find_type(driver.kind)
        assert id_of(found[0]) == model.id_of(found[0])
        assert call(found[0], "isTypeOf", driver.kind)
        assert call(found[0], "hasProperty", driver.feature)
        owner: object = call(found[0], "owningModel")
        assert owner is model


def test_an_expression_reads_alike_on_all(driver: Driver, model: Model) -> None:
    assert evaluate(driver.only, [model]) == [model.all_of_kind(driver.kind)[0]]
    assert evaluate(f"M.{driver.kind}.all.{driver.feature}", [model]) == list(driver.values)


# Change


def test_what_is_created_is_in_the_extents_at_once(changing: Driver, model: Model) -> None:
    before = list(model.all_of_kind(changing.kind))
    made = model.create(changing.kind, **changing.new)
    assert model.owns(made)
    assert list(model.all_of_kind(changing.kind)) == [*before, made]
    assert made in list(model.all_contents())
    assert getattr(made, changing.feature) == changing.new[changing.feature]
    assert model.element(model.id_of(made)) is made
    again = getattr(model, changing.kind)(**changing.new)
    assert list(model.all_of_type(changing.kind))[-2:] == [made, again]


def test_what_is_deleted_is_gone_at_once(changing: Driver, model: Model) -> None:
    first, *others = model.all_of_kind(changing.kind)
    inner = list(walk(first))
    model.delete(first)
    assert list(model.all_of_kind(changing.kind)) == others
    assert not any(model.owns(x) for x in inner)
    assert not {id(x) for x in inner} & {id(x) for x in model.all_contents()}
    with pytest.raises(ModelError, match="is not in the model M"):
        model.delete(first)


def test_what_was_changed_is_saved(changing: Driver, model: Model, path: Path) -> None:
    first, second, *_ = model.all_of_kind(changing.kind)
    setattr(first, changing.feature, changing.changed)
    model.delete(second)
    model.save()
    again = changing.opened(path)
    expected = [changing.changed, *changing.values[2:]]
    assert [getattr(x, changing.feature) for x in again.all_of_kind(changing.kind)] == expected


def test_saving_what_was_not_changed_changes_nothing(changing: Driver, model: Model, path: Path) -> None:
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    before = [file.read_bytes() for file in files]
    model.save()
    assert [file.read_bytes() for file in files] == before


def test_saving_elsewhere_leaves_the_file(changing: Driver, model: Model, path: Path, tmp_path: Path) -> None:
    target = tmp_path / "new" / ("tables" if path.is_dir() else path.name)
    setattr(model.all_of_kind(changing.kind)[0], changing.feature, changing.changed)
    if path.is_dir():
        target.mkdir(parents=True)
    model.save(target)
    assert getattr(changing.opened(target).all_of_kind(changing.kind)[0], changing.feature) == changing.changed
    assert getattr(changing.opened(path).all_of_kind(changing.kind)[0], changing.feature) == changing.values[0]


def test_a_misspelt_feature_of_a_new_element_fails_and_nothing_is_made(changing: Driver, model: Model) -> None:
    wrong, nearest = changing.misspelt[1]
    before = len(list(model.all_contents()))
    with pytest.raises(ModelError, match=f"did you mean '{nearest}'|has no feature '{wrong}'"):
        model.create(changing.kind, **{wrong: "x"})
    assert len(list(model.all_contents())) == before


def test_an_element_of_another_model_is_not_deleted(changing: Driver, model: Model, path: Path) -> None:
    other = changing.opened(path)
    with pytest.raises(ModelError, match="is not in the model M"):
        model.delete(other.all_of_kind(changing.kind)[0])
    assert len(other.all_of_kind(changing.kind)) == len(changing.values)


REFUSED: list[Callable[[Driver, Model, Any], Any]] = [
    lambda driver, model, element: model.create(driver.kind, **driver.new),
    lambda driver, model, element: getattr(model, driver.kind)(**driver.new),
    lambda driver, model, element: model.delete(element),
    lambda driver, model, element: model.save(),
    lambda driver, model, element: setattr(element, driver.feature, driver.changed),
]


@pytest.mark.parametrize("attempt", REFUSED)
def test_a_read_only_model_refuses_every_change(fixed: Driver, model: Model, path: Path, attempt: Any) -> None:
    assert model.read_only
    before = path.read_bytes()
    element = model.all_of_kind(fixed.kind)[0]
    with pytest.raises(ReadOnlyError, match="read-only") as caught:
        attempt(fixed, model, element)
    assert caught.value.fix
    assert [getattr(x, fixed.feature) for x in model.all_of_kind(fixed.kind)] == list(fixed.values)
    assert path.read_bytes() == before


# Looking at it


def test_it_can_be_shown(driver: Driver, model: Model) -> None:
    assert "M" in repr(model)
    assert driver.kind in model._repr_html_()
    assert driver.kind in tree(model)
    assert len(tree(model, limit=2).splitlines()) == 3
    found = rows(model, driver.kind)
    assert [row[driver.feature] for row in found] == list(driver.values)
    assert {row["type"] for row in found} <= {*model.type_names()}
    assert all(model.element(str(row["id"])) is not None for row in found)
    assert driver.kind in to_plantuml(model)
    assert "<table>" in ModelView(model)[driver.kind].all._repr_html_()


# Bad input


def test_a_missing_file_is_said_with_its_path(driver: Driver, path: Path) -> None:
    with pytest.raises(SourceError) as caught:
        driver.opened(path.with_name(f"missing{path.suffix or '.csv'}"))
    assert "missing" in str(caught.value)


def test_a_damaged_file_is_refused_with_its_path(driver: Driver, path: Path) -> None:
    file = path / "books.csv" if path.is_dir() else path
    empty = () if driver.name == "program" else (b"",)  # C that compilers take
    for content in (*empty, b"\0\1\2\xff\xfe", b"PK\3\4zip", *driver.damaged):
        file.write_bytes(content)
        with pytest.raises(RobosmiError) as caught:
            list(driver.opened(path).all_contents())
        assert caught.value.location is not None, content
        assert caught.value.location.path.endswith(file.name)
        assert caught.value.fix
