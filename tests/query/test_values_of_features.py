"""What an element holds is queried as what a model gives: `book.authors.select(...)`, in Python, queries and templates."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import RobosmiError
from robosmi.generate import Gen
from robosmi.metamodels import trace
from robosmi.model import load_model
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import Q, call, collection, get
from robosmi.query.expression import evaluate
from tests.library import library

BAG = """<?xml version="1.0" encoding="UTF-8"?>
<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
    xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="bag" nsURI="http://robosmi.org/test/bag" nsPrefix="bag">
  <eClassifiers xsi:type="ecore:EClass" name="Thing">
    <eStructuralFeatures xsi:type="ecore:EAttribute" name="sequence" upperBound="-1" unique="false"
        eType="ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EString"/>
    <eStructuralFeatures xsi:type="ecore:EAttribute" name="bag" upperBound="-1" unique="false" ordered="false"
        eType="ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EString"/>
  </eClassifiers>
</ecore:EPackage>
"""


def test_the_values_of_a_feature_have_the_operations_of_what_a_model_gives() -> None:
    L = library()
    book = next(b for b in L.Book.all if len(b.authors) == 2)
    authors = book.authors
    assert authors.select(lambda a: a.name == "Ada") == [authors[0]]
    assert authors.reject(lambda a: a.name == "Ada").first() is authors[1]
    assert authors.collect(lambda a: a.name) == authors.name == ["Ada", "Ben"]
    assert (authors.size(), authors.count(lambda a: a.name == "Ben"), authors.count(authors[0])) == (2, 1, 1)
    assert authors.sort_by(lambda a: a.name).last().name == "Ben"
    assert authors.exists(lambda a: a.name == "Ben")
    assert book.authors.books.flatten().includes(book)
    assert L.Library.all[0].sections[0].items.of_kind(L.Book).not_empty()


def test_what_pyecore_gives_stays_what_it_was() -> None:
    L = library()
    book, author = L.Book.all[0], L.Author.all[2]
    book.authors.append(author)
    assert author in book.authors
    assert book in author.books
    assert book.authors.index(author) == len(book.authors) - 1
    book.authors.remove(author)
    assert author not in book.authors
    assert list(book.authors) == list(book.authors.copy())
    assert not hasattr(book.authors, "_anything")


@pytest.mark.parametrize("change", ["add", "addAll", "remove", "removeAll", "removeAt", "clear"])
def test_an_operation_that_changes_a_collection_changes_the_element(change: str) -> None:
    """In EOL `book.authors.add(a)` changes the model."""
    L = library()
    book = next(b for b in L.Book.all if len(b.authors) == 2)
    ada, ben, cy = L.Author.all
    arguments, expected, answer = {
        "add": ([cy], [ada, ben, cy], True),
        "addAll": ([[cy, ben]], [ada, ben, cy], True),
        "remove": ([ada], [ben], True),
        "removeAll": ([[ben, cy]], [ada], True),
        "removeAt": ([0], [ben], ada),
        "clear": ([], [], None),
    }[change]
    assert call(book.authors, change, *arguments) == answer
    assert list(book.authors) == expected
    assert [a for a in (ada, ben, cy) if book in a.books] == [a for a in (ada, ben, cy) if a in expected]


def test_what_is_made_of_the_values_is_a_collection_of_its_own() -> None:
    L = library()
    book = next(b for b in L.Book.all if len(b.authors) == 2)
    before = list(book.authors)
    for made in (
        book.authors.select(lambda a: True),
        collection(book.authors).clone(),
        book.authors.lazy().eager(),
        book.authors.as_bag(),
    ):
        call(made, "add", L.Author.all[2])
        call(made, "clear")
    assert list(book.authors) == before


def test_values_that_occur_several_times_are_removed_once(tmp_path: Path) -> None:
    (tmp_path / "bag.ecore").write_text(BAG)
    for name, kind in (("sequence", "Sequence"), ("bag", "Bag")):
        element = Metamodel.load(tmp_path / "bag.ecore").Thing(**{name: ["a", "b", "a"]})
        held = getattr(element, name)
        assert collection(held)._eol_kind == kind
        assert call(held, "remove", "a")
        assert list(held) == ["b", "a"]
        assert held.size() == 2


def test_elements_of_generated_classes_and_of_files_have_them_too(tmp_path: Path) -> None:
    made = trace.Trace(texts=[trace.TextTrace(path="a"), trace.TextTrace(path="b")])
    assert made.texts.collect(lambda t: t.path) == ["a", "b"]  # type: ignore[attr-defined]
    assert made.links.is_empty()  # type: ignore[attr-defined]
    EmfModel(made, [trace]).save(tmp_path / "t.xmi")
    assert load_model(tmp_path / "t.xmi").texts.path == ["a", "b"]


def test_a_query_reads_them_and_changes_nothing() -> None:
    L = library()
    book = next(b for b in L.Book.all if len(b.authors) == 2)
    assert evaluate("Book.all.collect(lambda b: b.authors.select(lambda a: a.name == 'Ben').size())", [L]).sum() >= 1
    before = list(book.authors)
    for text in (
        "Book.all.first().authors.add_all([None])",
        "Book.all.first().authors.clear()",
        "collection(Book.all.first().authors).clear()",
        "call(Book.all.first().authors, 'clear')",
        "call(collection(Book.all.first().authors), 'removeAt', 0)",
        "Book.all.first().authors.owner",
        "Book.all.first().authors.items",
    ):
        with pytest.raises(RobosmiError):
            evaluate(text, [L])
    assert list(book.authors) == before


def test_a_template_reads_them_and_changes_nothing(tmp_path: Path) -> None:
    L = library()
    (tmp_path / "t").mkdir()

    def made(text: str) -> str:
        (tmp_path / "t" / "b.txt").write_text(text)
        g = Gen(tmp_path / "out", tmp_path / "t", [L])
        g.rule(L.Library, template="b.txt", target="b.txt", name="B")(lambda x: {"b": L.Book.all[0]})
        g.run()
        return (tmp_path / "out" / "b.txt").read_text()

    assert made("{{ b.authors.name | join(',') }} {{ b.authors.size() }} {{ b.authors.first().name }}") == "Ada,Ben 2 Ada"
    for text in (
        "{{ b.authors.add_all([]) }}",
        "{{ b.authors.clear() }}",
        "{{ b.authors.owner.name }}",
        "{{ b.authors.feature }}",
    ):
        with pytest.raises(RobosmiError, match="may not use"):
            made(text)


def test_a_collection_of_a_feature_is_equal_to_a_sequence_as_before() -> None:
    L = library()
    book = next(b for b in L.Book.all if len(b.authors) == 2)
    assert call(book.authors, "equals", Q(list(book.authors)))
    assert get(book.authors, "name") == ["Ada", "Ben"]


@pytest.mark.parametrize("put", [lambda held: held.append(None), lambda held: held.extend([None])])
def test_nothing_is_no_element_of_a_feature(put: Callable[[Any], object]) -> None:
    book = library().Book.all[0]
    before = list(book.authors)
    with pytest.raises(RobosmiError, match=r"Book\.authors takes elements, not None"):
        put(book.authors)
    assert list(book.authors) == before
