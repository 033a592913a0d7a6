"""`EmfModel`: extents in EMF's order that are never out of date, roots, ids, several models at once, pyecore's view of it."""

from __future__ import annotations

import gc
import time
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pyecore.ecore import EObject
from pyecore.resources import URI, ResourceSet
from pyecore.resources.xmi import XMIResource

from robosmi.errors import ModelError
from robosmi.metamodels import ccode
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.show import rows, tree
from robosmi.model.elements.structure import walk
from robosmi.model.emf import EmfModel
from robosmi.model.repository import Repository
from tests.new_objects import only_new_objects

CASE = Path(__file__).parent / "drivers" / "cases" / "emf"


@pytest.fixture
def shelf() -> EmfModel:
    """The model of the case."""
    return EmfModel.load(CASE / "shelf.xmi", CASE / "shelf.ecore", "S")


def test_a_model_is_not_saved_over_a_metamodel(shelf: EmfModel, tmp_path: Path) -> None:
    path = tmp_path / "shelf.ecore"
    path.write_bytes((CASE / "shelf.ecore").read_bytes())
    with pytest.raises(ModelError, match="is no element of a metamodel"):
        shelf.save(path)
    assert path.read_bytes() == (CASE / "shelf.ecore").read_bytes()
    EmfModel.load(path).save()


def names(elements: Any) -> list[str]:
    """What they are called."""
    return [x.name for x in elements]


def test_elements_are_pyecores_own_objects(shelf: EmfModel) -> None:
    assert all(isinstance(x, EObject) for x in shelf.all_contents())
    assert {x.eClass.name for x in shelf.all_contents()} == {"Shelf", "Author", "Book", "Comic", "Note"}


def test_extents_are_in_emfs_pre_order_with_supertypes_features_first(shelf: EmfModel) -> None:
    assert names(shelf.all_contents()) == ["hall", "Ada", "Ben", "Gears", "torn", "Zap", "niche", "Levers"]
    assert names(shelf.Book.all) == ["Gears", "Zap", "Levers"]
    assert names(shelf.Book.all_of_type) == ["Gears", "Levers"]
    assert names(shelf.Named.all) == names(shelf.all_contents())
    assert shelf.Named.all_of_type == []


def test_types_are_qualified_by_packages_and_model(shelf: EmfModel) -> None:
    assert shelf["shelf::Book"] == shelf["S!Book"] == shelf["S!shelf::Book"] == shelf.Book
    assert shelf.Genre.fiction.literal == "novel"
    assert shelf.literal("Genre#novel") is shelf.literal("shelf::Genre#fiction")
    assert shelf.Book.has(shelf.Comic.all[0])
    assert not shelf.Comic.has(shelf.Book.all[0])
    with pytest.raises(ModelError, match="the type Book has no 'al'"):
        _ = shelf.Book.al


Change = Callable[[EmfModel], Any]
CHANGES: dict[str, Change] = {
    "append": lambda m: m.Shelf.all[1].books.append(m.metamodel.Book(name="x")),
    "extend": lambda m: m.Shelf.all[1].books.extend([m.metamodel.Book(name="x"), m.metamodel.Comic(name="y")]),
    "insert": lambda m: m.Shelf.all[0].books.insert(0, m.metamodel.Book(name="x")),
    "remove": lambda m: m.Shelf.all[0].books.remove(m.Book.all[0]),
    "pop": lambda m: m.Shelf.all[0].books.pop(),
    "clear": lambda m: m.Shelf.all[0].books.clear(),
    "assign a list": lambda m: setattr(m.Shelf.all[0], "books", [m.metamodel.Book(name="x")]),
    "by the opposite": lambda m: setattr(m.metamodel.Book(name="x"), "shelf", m.Shelf.all[0]),
    "away by the opposite": lambda m: setattr(m.Book.all[0], "shelf", None),
    "move": lambda m: m.Shelf.all[1].books.append(m.Book.all[0]),
    "move out of the model": lambda m: m.metamodel.Shelf(books=[m.Book.all[0]]),
    "a whole tree": lambda m: m.Shelf.all[0].shelves.append(m.metamodel.Shelf(books=[m.metamodel.Book(name="x")])),
    "create": lambda m: m.Book(name="x"),
    "create and put": lambda m: m.Shelf.all[0].books.append(m.Book(name="x")),
    "create with parts": lambda m: m.Shelf(name="x", books=[m.metamodel.Book(name="y")]),
    "create with parts of the model": lambda m: m.Shelf(name="x", books=[m.Book.all[0]]),
    "delete": lambda m: m.delete(m.Book.all[0]),
    "delete a tree": lambda m: m.delete(m.Shelf.all[1]),
    "delete the root": lambda m: m.delete(m.Shelf.all[0]),
    "pyecore's delete": lambda m: m.Book.all[1].delete(),
    "a note": lambda m: m.Book.all[2].notes.append(m.metamodel.Note(name="x")),
    "del": lambda m: m.Shelf.all[0].books.__delitem__(0),
    "add a root": lambda m: m.add(m.metamodel.Shelf(name="x")),
    "into another model": lambda m: EmfModel(m.metamodel.Shelf(name="other")).roots[0].books.append(m.Book.all[0]),
    "into pyecore's resource": lambda m: XMIResource(URI("x.xmi")).append(m.Book.all[0]),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_extents_are_never_out_of_date(shelf: EmfModel, change: Change) -> None:
    kinds = ("Shelf", "Book", "Comic", "Note", "Named", "Author")

    def asked() -> dict[str, list[int]]:
        return {k: [id(x) for x in shelf.all_of_kind(k)] for k in kinds} | {
            f"{k}!": [id(x) for x in shelf.all_of_type(k)] for k in kinds
        }

    def walked() -> dict[str, list[int]]:
        everything = [x for root in shelf.roots for x in walk(root)]
        classes = {k: getattr(shelf.metamodel, k) for k in kinds}
        by_kind = {k: [id(x) for x in everything if isinstance(x, c)] for k, c in classes.items()}
        return by_kind | {f"{k}!": [id(x) for x in everything if type(x) is c] for k, c in classes.items()}

    before = asked()
    assert before == walked()
    change(shelf)
    assert asked() == walked()
    assert asked() != before
    change_again = shelf.create("Book", name="later")
    assert asked() == walked()
    shelf.delete(change_again)
    assert asked() == walked()


def test_what_is_created_and_put_outside_is_not_in_the_model(shelf: EmfModel) -> None:
    made = shelf.Book(name="x")
    assert made in shelf.Book.all
    shelf.metamodel.Shelf().books.append(made)
    assert names(shelf.Book.all) == ["Gears", "Zap", "Levers"]
    assert not shelf.owns(made)


def test_a_change_of_no_containment_keeps_the_extents(shelf: EmfModel) -> None:
    first = shelf._extent(shelf.metamodel.Book, False)
    shelf.Book.all[0].pages = 7
    shelf.Author.all[0].books.remove(shelf.Book.all[1])
    assert shelf._extent(shelf.metamodel.Book, False) is first


def test_roots_that_are_put_somewhere_are_no_roots_any_more(shelf: EmfModel) -> None:
    made = shelf.Book(name="new")
    assert shelf.roots == [shelf.Shelf.all[0], made]
    assert shelf.id_of(made) == "/1"
    shelf.Shelf.all[0].books.append(made)
    assert shelf.roots == [shelf.Shelf.all[0]]
    assert shelf.id_of(made) == "//@books.2"
    assert shelf.element("//@books.2") is made


def test_a_deleted_element_is_referred_to_by_nothing(shelf: EmfModel) -> None:
    book = shelf.Book.all[1]
    author, newest = book.author, shelf.roots[0]
    assert newest.newest is book
    shelf.delete(book)
    assert newest.newest is None
    assert book not in author.books
    assert not shelf.owns(book)


def test_ids_are_attributes_or_ways_from_the_root(shelf: EmfModel) -> None:
    note = shelf.Note.all[0]
    assert shelf.id_of(note) == "n1"
    assert id(shelf.element("n1")) == id(note)
    note.key = "n2"
    assert shelf.element("n1") is None
    assert shelf.element("n2") is note
    assert shelf.id_of(shelf.Book.all[2]) == "//@shelves.0/@books.0"
    with pytest.raises(ModelError, match="did you mean 'books'"):
        shelf.element("//@boks.0")


def test_two_loads_never_mix(shelf: EmfModel) -> None:
    other = EmfModel.load(CASE / "shelf.xmi", CASE / "shelf.ecore", "S")
    assert other.find_type("Book") is not shelf.find_type("Book")
    assert not shelf.Book.has(other.Book.all[0])
    assert shelf.all_of_kind(other.type_named("Book")) == []
    same = EmfModel.load(CASE / "shelf.xmi", shelf.metamodel)
    same.delete(same.Book.all[0])
    assert len(same.Book.all) == 2
    assert len(shelf.Book.all) == 3


def test_one_root_may_be_looked_at_by_two_models(shelf: EmfModel) -> None:
    other = EmfModel(shelf.roots, shelf.metamodel)
    assert len(other.Book.all) == len(shelf.Book.all) == 3
    shelf.delete(shelf.Book.all[0])
    assert len(other.Book.all) == 2
    other.roots[0].books.append(other.metamodel.Book(name="new"))
    assert len(shelf.Book.all) == 3


def test_models_of_pyecores_own_are_taken_as_they_are() -> None:
    resources = ResourceSet()
    package = resources.get_resource(URI(str(CASE / "shelf.ecore"))).contents[0]
    resources.metamodel_registry[package.nsURI] = package
    package.getEClassifier("Genre").from_string = lambda text: package.getEClassifier("Genre").eLiterals[0]
    resource = resources.get_resource(URI(str(CASE / "shelf.xmi")))
    model = EmfModel(resource.contents)
    assert names(model.Book.all) == ["Gears", "Zap", "Levers"]
    assert resource.contents[0].eResource is resource
    model.Shelf.all[0].books.append(model.Book(name="new"))
    assert len(model.Book.all) == 4
    with pytest.raises(ModelError, match="did you mean 'name'"):
        model.Book(nmae="x")
    with pytest.raises(ModelError, match="is abstract"):
        model.create("Named")


def test_pyecores_own_resource_reads_what_is_saved(shelf: EmfModel, tmp_path: Path) -> None:
    shelf.Shelf.all[1].books.append(shelf.Comic(name="New & <old>", pages=3))
    shelf.save(tmp_path / "out.xmi")
    resources = ResourceSet()
    package = Metamodel.load(CASE / "shelf.ecore").epackages[0]
    resources.metamodel_registry[package.nsURI] = package
    root = resources.get_resource(URI(str(tmp_path / "out.xmi"))).contents[0]
    assert names(root.shelves[0].books) == ["Levers", "New & <old>"]
    assert tree(root) == tree(shelf.roots[0])


def test_a_model_is_freed_with_its_last_user() -> None:
    with only_new_objects():
        model = EmfModel.load(CASE / "shelf.xmi", CASE / "shelf.ecore")
        root = weakref.ref(model.roots[0])
        gone = weakref.ref(model)
        kept = model.roots[0]
        del model
        gc.collect()
        assert gone() is None
        assert root() is kept
        del kept
        gc.collect()
        assert root() is None


def test_several_models_are_told_apart_by_name(shelf: EmfModel) -> None:
    other = EmfModel([], shelf.metamodel, "T")
    both = Repository([shelf, other])
    made = both.T.Book(name="new")
    assert names(both["T!Book"].all) == ["new"]
    assert names(both["Book"].all) == ["Gears", "Zap", "Levers"]
    assert both["T!shelf::Book"].all == [made]
    assert both.owning(made) is other
    assert both.literal("T!Genre#science").name == "science"
    with pytest.raises(ModelError, match="there is no model 't'"):
        both.model("t")
    with pytest.raises(ModelError, match="there is no type 'Boook'"):
        _ = both["Boook"]


def test_a_model_without_a_file_is_not_saved_anywhere() -> None:
    with pytest.raises(ModelError, match="has no file"):
        EmfModel(ccode.Program()).save()


def test_rows_give_references_as_ids(shelf: EmfModel) -> None:
    found = rows(shelf, "Comic")
    assert found == [
        {
            "id": "//@books.1", "type": "Comic", "name": "Zap", "shelf": "/", "author": "//@authors.0", "pages": 48,
            "genre": "science", "notes": [],
        }
    ]  # fmt: skip


def test_an_element_shows_itself_in_a_notebook(shelf: EmfModel) -> None:
    html = shelf.Book.all[0]._repr_html_()
    assert "Gears" in html
    assert "120" in html
    shelf.Book.all[0].name = "<script>"
    assert "<script>" not in shelf.Book.all[0]._repr_html_()


def test_depth_is_no_limit(tmp_path: Path) -> None:
    metamodel = Metamodel.load(CASE / "shelf.ecore")
    shelf: Any = metamodel.Shelf(name="s")
    for _ in range(3000):
        shelf = metamodel.Shelf(name="s", shelves=[shelf])
    model = EmfModel(shelf, metamodel)
    deepest = model.Shelf.all[-1]
    assert len(model.Shelf.all) == 3001
    assert model.element(model.id_of(deepest)) is deepest
    assert model.owns(deepest)
    assert len(tree(model, limit=4000).splitlines()) == 3001
    assert len(rows(model.Shelf.all[2990:])) == 11
    model.save(tmp_path / "deep.xmi")
    assert len(EmfModel.load(tmp_path / "deep.xmi", metamodel).Shelf.all) == 3001
    model.delete(model.Shelf.all[1])
    assert len(model.Shelf.all) == 1


def test_asking_again_costs_little() -> None:
    statements = [ccode.ExpressionStatement(expression=ccode.Call(calleeName=f"f{i}")) for i in range(20_000)]
    model = EmfModel(ccode.Block(statements=statements))

    def seconds() -> float:
        start = time.perf_counter()
        assert len(model.Call.all) == 20_000
        return time.perf_counter() - start

    first = seconds()
    assert min(seconds() for _ in range(5)) < first / 5
