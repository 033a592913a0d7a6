"""Laziness: an item is looked at when it is asked for, and not before; typed iterators; `q.name`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import Bag, Lazy, ModelView, OrderedSet, Q, Run, Set, UndefinedError

FOLDER = Path(__file__).parents[1] / "epsilon" / "eol"


class Watched:
    """Items that note when they are given."""

    def __init__(self, *items: Any) -> None:
        self.items = items
        self.given: list[Any] = []

    def __iter__(self) -> Iterator[Any]:
        for item in self.items:
            self.given.append(item)
            yield item


@pytest.fixture
def library() -> Iterator[Any]:
    """The library model, in a run."""
    view = ModelView(EmfModel.load(FOLDER / "library.xmi", Metamodel.load(FOLDER / "library.ecore"), "L"))
    with Run(view):
        yield view


@pytest.mark.parametrize(
    ("ask", "answer", "looked_at"),
    [
        (lambda q: q.select(lambda x: x > 1).first(), 2, [1, 2]),
        (lambda q: q.select_one(lambda x: x > 2), 3, [1, 2, 3]),
        (lambda q: q.exists(lambda x: x == 1), True, [1]),
        (lambda q: q.for_all(lambda x: x > 1), False, [1]),
        (lambda q: q.reject(lambda x: x < 3).collect(lambda x: -x).first(), -3, [1, 2, 3]),
        (lambda q: q.of_kind("Integer").first(), 1, [1]),
        (lambda q: q.of_type(str).first(), "a", [1, 2, 3, 4, "a"]),
        (lambda q: q.is_empty(), False, [1]),
        (lambda q: q.not_empty(), True, [1]),
    ],
)
def test_only_what_is_needed_is_looked_at(ask: Any, answer: Any, looked_at: list[Any]) -> None:
    watched = Watched(1, 2, 3, 4, "a", "b")
    assert ask(Lazy(watched)) == answer
    assert watched.given == looked_at


def test_nothing_is_looked_at_before_the_end_of_the_chain() -> None:
    watched = Watched(1, 2)
    chain = Lazy(watched).select(lambda x: x > 1).collect(lambda x: x * 2)
    assert watched.given == []
    assert chain.list() == [4]
    assert list(chain) == [4]
    assert watched.given == [1, 2, 1, 2], "every loop asks anew"


@pytest.mark.parametrize("made", [Q, Bag, Set, OrderedSet])
def test_a_lazy_chain_ends_in_the_kind_of_the_eager_one(made: Any) -> None:
    source = made([1, 2, 3])
    chains: list[Callable[[Any], Any]] = [
        lambda q: q.select(lambda x: x > 1),
        lambda q: q.reject(lambda x: x > 1),
        lambda q: q.collect(lambda x: x % 2),
        lambda q: q.of_kind("Integer"),
    ]
    for chain in chains:
        eager, lazy = chain(source), chain(source.lazy()).eager()
        assert type(lazy) is type(eager)
        assert lazy == eager


def test_eager_operations_look_at_everything_once_and_do_not_change_their_source() -> None:
    watched = Watched(1, 2, 3)
    source = Q(watched)
    assert watched.given == [1, 2, 3]
    source.select(lambda x: x > 1).first()
    assert source == [1, 2, 3]
    assert watched.given == [1, 2, 3]


def test_a_name_collects_and_does_not_flatten(library: Any) -> None:
    books = library.all("Book")
    assert books.name == books.collect(lambda b: b.name) == ["Propellers", "Boards", "Ants", "Zap", "Mills"]
    assert books.authors.name == [["Ada", "Ben"], ["Ben"], ["Cy"], ["Cy", "Ada"], []]
    assert books.authors.flatten().name == ["Ada", "Ben", "Ben", "Cy", "Cy", "Ada"]
    assert type(books.as_set().year) is Bag
    assert type(books.as_ordered_set().year) is Q
    with pytest.raises(UndefinedError):
        _ = library.all("Author").mentor.name
    assert library.all("Author").mentor.get("name", None) == ["Ben", "Cy", None]
    with pytest.raises(ModelError, match="nosuch"):
        _ = books.nosuch


def test_a_typed_iterator_leaves_other_kinds_out_first(library: Any) -> None:
    items = library.all("Item")
    assert items.select(lambda b: len(b.authors) > 1, kind="Book").name == ["Propellers", "Zap"]
    assert items.collect(lambda c: c.name, kind=library.type_named("Comic")) == ["Zap"]
    assert items.for_all(lambda b: b.tags is not None, kind="Book")
    assert items.count(lambda j: True, kind="Journal") == 1
    assert items.sort_by(lambda b: b.price, kind="Book").first().name == "Zap"
    assert items.map_by(lambda b: b.genre.name, kind="Book").key_set() == Set(["science", "fiction", "history"])
    assert items.closure(lambda j: j.eContainer(), kind="Journal").name == ["Robots"], "what is no Journal is not followed"
