"""`open_model(..., lazy=True)`: what the skeleton answers is what the loaded model answers, and the elements stay the same."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, RobosmiError
from robosmi.model import Session, lazy_model, open_model
from robosmi.model.elements.fragments import own_id
from robosmi.model.emf import EmfModel
from robosmi.model.lazy_model import LazyModel
from robosmi.query import ModelView

HERE = Path(__file__).parent
SHOP, METAMODEL = HERE / "lazy" / "shop.xmi", HERE / "lazy" / "shop.ecore"
SPLIT = HERE / "split"


def lazily(path: Path = SHOP, metamodel: Path = METAMODEL, **options: Any) -> Any:
    """A model that is opened lazily."""
    return open_model(path, metamodel=metamodel, lazy=True, **options)


def fully() -> Any:
    """The same model, read whole."""
    return open_model(SHOP, metamodel=METAMODEL)


def is_unread(model: Any) -> bool:
    """Whether only the skeleton is there."""
    return type(model) is LazyModel


@pytest.mark.parametrize("kind", ["Shop", "Item", "Book", "Box"])
def test_the_skeleton_knows_the_elements_of_each_type(kind: str) -> None:
    lazy, full = lazily(), fully()
    for found, wanted in (
        (lazy.all_of_kind(kind), full.all_of_kind(kind)),
        (lazy.all_of_type(kind), full.all_of_type(kind)),
        (list(lazy.all_contents()), list(full.all_contents())),
    ):
        assert [type(x).__name__ for x in found] == [type(x).__name__ for x in wanted]
        assert [own_id(x) for x in found] == [own_id(x) for x in wanted]
    assert is_unread(lazy)


def test_a_view_counts_without_loading() -> None:
    lazy = lazily()
    view = ModelView(lazy)
    assert (view.Item.all.size(), view.Book.all_of_type.size(), view.Item.all_of_type.size()) == (5, 3, 0)
    assert is_unread(lazy)
    assert view.Book.has(view.Book.all.first()), "whose element it is only the loaded model tells"


@pytest.mark.parametrize("identity", ["_s", "b1", "b2", "b3", "x1", "x2"])
def test_an_element_is_found_by_its_id(identity: str) -> None:
    lazy, full = lazily(), fully()
    found, wanted = lazy.element(identity), full.element(identity)
    assert found.__class__.__name__ == type(wanted).__name__
    assert isinstance(found, lazy.type_named(type(wanted).__name__).python_class)
    for name in ("code", "price", "size") if identity != "_s" else ():
        assert str(getattr(found, name)) == str(getattr(wanted, name))
    assert is_unread(lazy)
    assert lazy.element(identity) is found
    assert lazy.element("nobody") is None
    if identity != "_s":
        assert (found.text, list(found.tags)) == (wanted.text, list(wanted.tags))


def test_given_elements_are_those_of_the_loaded_model() -> None:
    lazy = lazily()
    book, (box, inner) = lazy.element("b2"), lazy.Box.all
    assert book.code == "b2"
    assert is_unread(lazy)
    assert book.previous is lazy.element("b1"), "the opposite, which the file does not have"
    assert type(book) is lazy.Book.kind.python_class
    assert type(lazy) is EmfModel
    assert book.eContainer() is box
    assert inner.text == "in the\nbox"
    assert lazy.Box.all == [box, inner]
    assert lazy.Book.all[1] is book


@pytest.mark.parametrize(
    "change",
    [
        lambda model: setattr(model.element("b2"), "price", 3),
        lambda model: model.delete(model.element("x2")),
        lambda model: model.create("Book", code="b4"),
        lambda model: model.element("x1").inside.pop(),
    ],
)
def test_a_change_is_saved_as_that_of_a_loaded_model(tmp_path: Path, change: Any) -> None:
    models = lazily(), fully()
    for place, model in zip(("lazy.xmi", "full.xmi"), models, strict=True):
        change(model)
        model.save(tmp_path / place)
    assert (tmp_path / "lazy.xmi").read_bytes() == (tmp_path / "full.xmi").read_bytes()


def test_what_was_not_changed_is_saved_as_it_was(tmp_path: Path) -> None:
    file = tmp_path / "shop.xmi"
    file.write_bytes(SHOP.read_bytes())
    lazily(file).save()
    assert file.read_bytes() == SHOP.read_bytes()


def test_many_reads_load_the_file(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lazy_model, "_READ_ALONE", 2)
    lazy = lazily()
    books = lazy.Book.all
    assert [(book.code, book.price) for book in books[:2]] == [("b1", 12), ("b2", 7)]
    assert is_unread(lazy)
    assert books[2].price == 1
    assert not is_unread(lazy)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('code="b3"', 'code="b2"'),
        ('size="large"', 'size="huge"'),
        ("<tags>one</tags>", "<lost/>"),
        ('"shop:Book" code="b2"', '"shop:Boock" code="b2"'),
        ("&#xe9;", "&#x241b;0001"),
        ("<xmi:XMI", "<!DOCTYPE x><xmi:XMI"),
        ("</xmi:XMI>", ""),
    ],
)
def test_a_file_that_is_not_plain_is_as_if_loaded(tmp_path: Path, old: str, new: str) -> None:
    file = tmp_path / "odd.xmi"
    file.write_text(SHOP.read_text().replace(old, new), encoding="utf-8")
    said = []
    for lazy in (False, True):
        try:
            model: Any = open_model(file, metamodel=METAMODEL, lazy=lazy)
            said.append([each.text for each in [model.element("b1"), model.element("b2")]] + [model.roots[0].items[0].size.name])
        except RobosmiError as error:
            said.append([str(error)])
    assert said[0] == said[1]


def test_a_load_that_fails_fails_each_time(tmp_path: Path) -> None:
    file = tmp_path / "odd.xmi"
    file.write_text(SHOP.read_text().replace('size="large"', 'size="huge"'), encoding="utf-8")
    lazy = lazily(file, strict=True)
    book = lazy.element("b1")
    for _ in range(2):
        with pytest.raises(ModelError, match=r"odd\.xmi:5: Book\.size: 'huge'"):
            _ = book.size
        assert book.price == 12
    file.write_text(SHOP.read_text(), encoding="utf-8")
    with pytest.raises(ModelError, match="has changed since it was opened"):
        _ = book.next


def test_a_lazy_model_of_a_session_is_what_others_refer_to(tmp_path: Path) -> None:
    for name in ("ok.xmi", "w.xmi", "g.ecore"):
        (tmp_path / name).write_bytes((SPLIT / name).read_bytes())
    session = Session()
    ok: Any = session.open_model(tmp_path / "ok.xmi", metamodel=tmp_path / "g.ecore", lazy=True)
    first, second = ok.Node.all
    assert is_unread(ok)
    assert first.name == "n1"
    other: Any = session.open_model(tmp_path / "w.xmi")
    assert other.Edge.all[0].source is second
    second.name = "renamed"
    assert session.save_all() == [tmp_path / "ok.xmi"]
    assert 'name="renamed"' in (tmp_path / "ok.xmi").read_text()


def test_other_forms_are_loaded_at_once() -> None:
    assert type(open_model(METAMODEL, lazy=True)) is EmfModel
    assert type(lazily(SPLIT / "p.xmi", SPLIT / "g.ecore")) is EmfModel, "it contains elements of another file"
