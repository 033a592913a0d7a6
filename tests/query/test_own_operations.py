"""Operations of one's own (`@operation`, cached ones too), extended properties, and the two ways to call."""

from __future__ import annotations

import gc
import importlib
import sys
import weakref
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from robosmi.generate import Gen
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import (
    ModelView,
    OperandError,
    Q,
    Run,
    UnknownOperationError,
    cached,
    call,
    call_built_in,
    ext,
    get,
    operation,
)
from robosmi.query.own_operations import DECLARED
from tests.library import library as new_library
from tests.new_objects import only_new_objects

FOLDER = Path(__file__).parents[1] / "epsilon" / "eol"


@pytest.fixture(autouse=True)
def _own_registrations(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a test registers is forgotten after it."""
    monkeypatch.setitem(globals(), DECLARED, {})


@pytest.fixture
def library() -> Iterator[Any]:
    """The library model, in a run."""
    view = ModelView(EmfModel.load(FOLDER / "library.xmi", Metamodel.load(FOLDER / "library.ecore"), "L"))
    with Run(view):
        yield view


def test_an_operation_is_called_by_name_on_every_element_of_its_type(library: Any) -> None:
    @operation(library.type_named("Item"))
    def age(self: Any, now: int = 2020) -> int:
        return now - int(self.year)

    first = library.all("Book").first()
    assert call(first, "age") == 4
    assert call(first, "age", 2026) == age(first, 2026) == 10
    assert call(library.all("Book"), "collect", lambda b: call(b, "age")) == [4, 4, 21, 19, 170]
    with pytest.raises(UnknownOperationError, match="age"):
        call(library.all("Author").first(), "age")
    with pytest.raises(UnknownOperationError):
        age(library.all("Author").first())


def test_the_exact_type_counts_else_the_first_that_fits_in_the_order_of_the_module(library: Any) -> None:
    """As in EOL: Item stands first, so that a Comic, which has none of its own, has that of Item and not that of Book."""
    for kind in ("Item", "Book"):
        operation(library.type_named(kind), name="label")(lambda self, kind=kind: kind)
    assert library.all("Item").collect(lambda i: (type(i).__name__, call(i, "label"))).select(
        lambda pair: pair[0] in ("Book", "Comic")
    ).as_set() == {("Book", "Book"), ("Comic", "Item")}
    operation(library.type_named("Comic"), name="label")(lambda self: "Comic")
    assert call(library.all("Comic").first(), "label") == "Comic"


def _module(name: str, text: str, monkeypatch: pytest.MonkeyPatch, folder: Path) -> Any:
    (folder / f"{name}.py").write_text(f"from robosmi.query import call, get, operation\n{text}\n")
    monkeypatch.syspath_prepend(folder)
    monkeypatch.delitem(sys.modules, name, raising=False)
    return importlib.import_module(name)


def test_an_operation_belongs_to_the_module_that_declares_it(
    library: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = """
@operation("Book")
def label(self):
    return "{0}"
def ask(book):
    return call(book, "label"), [get(b, "label") for b in [book]], label(book)
"""
    one = _module("one_of_two", text.format("one"), monkeypatch, tmp_path)
    two = _module("two_of_two", text.format("two"), monkeypatch, tmp_path)
    book = library.all("Book").first()
    assert one.ask(book) == ("one", ["one"], "one")
    assert two.ask(book) == ("two", ["two"], "two")
    with pytest.raises(UnknownOperationError):
        call(book, "label")


def test_a_module_sees_the_operations_that_it_imports(library: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    base = """
@operation("Item")
def label(self): return "base"
@operation("Item")
def weight(self): return 1
"""
    ask = "def ask(book, name): return call(book, name)\n"
    _module("base_operations", base, monkeypatch, tmp_path)
    book = library.all("Book").first()
    whole = _module(
        "whole_import", f"import base_operations\n{ask}@operation('Item')\ndef third(self): return 3", monkeypatch, tmp_path
    )
    assert [whole.ask(book, name) for name in ("label", "weight", "third")] == ["base", 1, 3]
    single = _module("single_import", f"from base_operations import label\n{ask}", monkeypatch, tmp_path)
    assert single.ask(book, "label") == "base"
    with pytest.raises(UnknownOperationError, match="weight"):
        single.ask(book, "weight")
    twice = _module("import_of_import", f"import whole_import\n{ask}", monkeypatch, tmp_path)
    assert [twice.ask(book, name) for name in ("label", "weight", "third")] == ["base", 1, 3]


def test_the_own_module_comes_before_its_imports(library: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _module("imported_first", '@operation("Item")\ndef label(self): return "imported"', monkeypatch, tmp_path)
    own = _module(
        "own_second",
        """
import imported_first
@operation("Item")
def label(self): return "own"
def ask(book): return call(book, "label")
""",
        monkeypatch,
        tmp_path,
    )
    assert own.ask(library.all("Book").first()) == "own"


def test_a_template_sees_what_the_module_of_its_rule_sees(library: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pages = _module(
        "pages_with_operations",
        """
@operation("Book")
def loud(self): return self.name.upper()
def rules(g, L):
    g.rule(L.Library, template="b.txt", target="b.txt", name="B")(lambda x: {"books": L.Book.all})
""",
        monkeypatch,
        tmp_path,
    )
    (tmp_path / "t").mkdir()
    (tmp_path / "t" / "b.txt").write_text("{{ books.loud | join(',') }}")
    g = Gen(tmp_path / "out", tmp_path / "t", [library])
    pages.rules(g, library)
    g.run()
    assert (tmp_path / "out" / "b.txt").read_text().startswith("PROPELLERS,")


def test_a_second_registration_for_a_type_replaces_the_first(library: Any) -> None:
    for answer in (1, 2):
        operation(library.type_named("Book"), name="answer")(lambda self, answer=answer: answer)
    assert call(library.all("Book").first(), "answer") == 2


def test_an_own_operation_hides_a_built_in_one_but_for_the_arrow(library: Any) -> None:
    operation("String", name="length")(lambda self: -1)
    assert call("robot", "length") == -1
    assert call_built_in("robot", "length") == 5
    assert call([1], "size") == 1


def test_an_operation_on_any_is_the_last_resort(library: Any) -> None:
    operation("Any", name="what")(lambda self: "any")
    operation(int, name="what")(lambda self: "Integer")
    assert [call(x, "what") for x in (1, "a", None, library.all("Book").first())] == ["Integer", "any", "any", "any"]


def test_an_operation_without_arguments_can_be_read_as_a_property(library: Any) -> None:
    operation(library.type_named("Book"), name="shortName")(lambda self: self.name[:2])
    assert get(library.all("Book"), "shortName") == ["Pr", "Bo", "An", "Za", "Mi"]


def test_a_cached_operation_runs_once_for_each_element_and_arguments_in_a_run(library: Any) -> None:
    seen: list[tuple[str, int]] = []

    @operation(library.type_named("Book"))
    @cached
    def scored(self: Any, factor: int = 1) -> int:
        seen.append((self.name, factor))
        return len(self.name) * factor

    first, second = library.all("Book")[:2]
    assert [call(first, "scored"), call(first, "scored"), call(first, "scored", 2), call(second, "scored")] == [10, 10, 20, 6]
    assert seen == [("Propellers", 1), ("Propellers", 2), ("Boards", 1)]
    with Run(library):
        assert call(first, "scored") == 10
    assert len(seen) == 4, "another run remembers nothing of this one"
    call(first, "scored")
    assert len(seen) == 4


def test_a_cached_result_of_none_is_kept_too(library: Any) -> None:
    seen = []

    @operation(library.type_named("Book"))
    @cached
    def nothing(self: Any) -> None:
        seen.append(self)

    first = library.all("Book").first()
    assert call(first, "nothing") is call(first, "nothing") is None
    assert len(seen) == 1


def test_a_wrong_number_of_arguments_is_said(library: Any) -> None:
    with pytest.raises(OperandError, match="pad"):
        call("a", "pad", 3)
    with pytest.raises(UnknownOperationError, match="substring"):
        call("a", "subsrting", 1)


def test_extended_properties_last_for_the_run_and_never_reach_the_file(library: Any, tmp_path: Path) -> None:
    before = tmp_path / "before.xmi"
    library.save(before)
    first = library.all("Book").first()
    assert ext(first).mark is None
    ext(first).mark = 3
    ext(first).seen = Q([1])
    assert get(first, "~mark") == 3
    assert library.all("Book").collect(lambda b: get(b, "~mark")) == [3, None, None, None, None]
    library.save(tmp_path / "after.xmi")
    assert (tmp_path / "after.xmi").read_bytes() == before.read_bytes()
    with Run(library):
        assert ext(first).mark is None
    assert ext(first).mark == 3
    assert not first.eClass.findEStructuralFeature("mark")


def test_extended_properties_of_equal_elements_are_apart(library: Any) -> None:
    one, other = library.all("Author")[:2]
    ext(one).mark = 1
    assert ext(other).mark is None
    ext("text").mark = 2
    assert ext("text").mark == 2


def test_what_is_noted_of_an_element_goes_with_it_also_where_it_refers_back() -> None:
    """A table of the default run would hold both for ever, and a long program would grow with each model."""
    with only_new_objects():
        shelf = new_library()
        book = shelf.Book.all[0]
        element = getattr(book, "element", book)
        ext(element).index = {"of": element}
        assert ext(element).index["of"] is element
        gone = weakref.ref(element)
        del shelf, book, element
        gc.collect()
        assert gone() is None


def test_what_is_noted_in_a_run_is_of_that_run_alone() -> None:
    book = new_library().Book.all[0]
    ext(book).mark = 1
    with Run():
        assert ext(book).mark is None
        ext(book).mark = 2
    assert ext(book).mark == 1
