"""`Recording`: whatever is done to a model while it is open is undone, order, containers, opposites and back links included."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pyecore.ecore import EObject
from pyecore.valuecontainer import EAbstractSet, ECollection, EList, EOrderedSet, EValue

from robosmi.model.changes import Recording
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.features import all_features
from robosmi.model.elements.structure import walk
from robosmi.model.emf import EmfModel

LIBRARY = Path(__file__).parents[1] / "epsilon" / "eol"


@pytest.fixture
def model(tmp_path: Path) -> EmfModel:
    """The library, whose books also have lines, a list that is neither unique nor empty."""
    text = (LIBRARY / "library.ecore").read_text(encoding="utf-8")
    lines = '<eStructuralFeatures xsi:type="ecore:EAttribute" name="lines" unique="false" upperBound="-1" '
    lines += 'eType="ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EString"/>'
    first = '<eStructuralFeatures xsi:type="ecore:EAttribute" name="genre"'
    assert text.count(first) == 1
    (tmp_path / "library.ecore").write_text(text.replace(first, lines + first), encoding="utf-8")
    made: Any = EmfModel.load(LIBRARY / "library.xmi", Metamodel.load(tmp_path / "library.ecore"), "M")
    for book in made.Book.all:
        book.lines.extend(["b", "a", "b"])
    return made  # type: ignore[no-any-return]


def state(model: EmfModel) -> list[tuple[Any, ...]]:
    """Everything there is to know of a model's elements: values in order, containers, back links."""
    return [
        (
            id(x),
            [_shown(getattr(x, f.name)) for f in all_features(x.eClass)],
            id(x.eContainer()),
            x.eContainmentFeature(),
            sorted(f"{id(o)}{f.name}" for o, f in x._inverse_rels),
        )
        for root in model.roots
        for x in walk(root)
    ]


def _shown(value: Any) -> Any:
    if isinstance(value, ECollection):
        return [_shown(v) for v in value]
    return id(value) if isinstance(value, EObject) else value


def set_values(m: Any) -> None:
    book = m.Book.all[0]
    book.name, book.year, book.genre = "X", 1, m.Genre.history
    book.name = None


def move(m: Any) -> None:
    m.Section.all[-1].items.append(m.Section.all[1].items[0])
    first, last = m.Section.all[0], m.Section.all[-1]
    if last not in list(walk(first)):  # pyecore makes circles without a word
        first.parent = last


def empty(m: Any) -> None:
    for author in m.Author.all:
        author.books.clear()
    m.Library.all[0].sections.clear()


def opposites(m: Any) -> None:
    m.Book.all[0].authors.remove(m.Author.all[0])
    m.Author.all[2].books.insert(0, m.Book.all[0])
    m.Author.all[1].mentor = m.Author.all[0]


def delete(m: Any) -> None:
    m.delete(m.Book.all[0])
    m.delete(m.Section.all[-1])
    m.delete(m.Author.all[0])


def create(m: Any) -> None:
    book = m.Comic(name="new", authors=[m.Author.all[0], m.Author.all[1]], tags=["a"])
    m.Section.all[0].items.append(book)
    m.Author(name="lonely", books=[book, m.Book.all[0]], mentor=m.Author.all[0])
    m.Member(name="reader", borrowed=m.Book.all)


def whole_slices(m: Any) -> None:
    book = m.Book.all[0]
    book.tags.extend(x for x in ("p", "q"))
    book.tags.remove("cogs")
    book.authors.discard(m.Author.all[0])
    book.tags += ["r"]


def lists(m: Any) -> None:
    lines = m.Book.all[0].lines
    lines.sort()
    lines.reverse()
    lines[0] = "first"
    lines[1:] = ["z", "y", "y"]
    del lines[0]
    lines *= 2
    lines.pop(0)
    lines += ["end"]


def roots(m: Any) -> None:
    library = m.Library(name="second")
    library.sections.append(m.Section.all[0])
    m.Section(name="third root")


CHANGES = [set_values, move, empty, opposites, delete, create, whole_slices, lists, roots]


@pytest.mark.parametrize("change", CHANGES, ids=lambda f: f.__name__)
def test_a_change_is_undone(model: EmfModel, change: Callable[[Any], None]) -> None:
    before, all_before = state(model), list(model.all_contents())
    with Recording([model]) as recording:
        change(model)
        assert state(model) != before
        recording.undo()
    assert state(model) == before
    assert list(model.all_contents()) == all_before
    assert all(model.owns(x) for x in all_before)


@pytest.mark.parametrize("seed", range(30))
def test_any_sequence_of_changes_is_undone_and_can_be_done_again(model: EmfModel, seed: int) -> None:
    chosen = random.Random(seed).choices(CHANGES, k=4)
    before = state(model)
    outcomes: list[Any] = []
    for _ in range(2):
        with Recording([model]) as recording:
            for change in chosen:
                try:
                    change(model)
                except Exception as error:  # an earlier change may have taken what this one needs
                    outcomes.append(type(error))
            outcomes.append(len(state(model)))
            recording.undo()
        assert state(model) == before
    assert outcomes[: len(outcomes) // 2] == outcomes[len(outcomes) // 2 :]


def test_without_undo_everything_stays(model: EmfModel) -> None:
    before = state(model)
    with Recording([model]):
        create(model)
    assert state(model) != before
    assert len(model.all_of_kind("Author")) == 4


def test_pyecore_is_as_it_was_afterwards(model: EmfModel) -> None:
    methods = {cls: dict(cls.__dict__) for cls in (EValue, ECollection, EList, EAbstractSet, EOrderedSet)}
    with Recording([model]) as recording:
        create(model)
        recording.undo()
    assert methods == {cls: dict(cls.__dict__) for cls in methods}
