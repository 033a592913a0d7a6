"""A session: one .ecore file is one metamodel, whoever asks for it; outside of one nothing is shared."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, RobosmiError
from robosmi.model import Session, save_model
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView
from robosmi.transform import ETL, Flock, Trace

EPSILON = Path(__file__).parents[1] / "epsilon"
LIBRARY = EPSILON / "eol" / "library.ecore"
GRAPH = EPSILON / "cases" / "models" / "graph.ecore"
GARDEN = Path(__file__).parent / "metamodels" / "garden.ecore"
COMMON = Path(__file__).parent / "metamodels" / "common.ecore"


def test_two_models_of_one_metamodel_have_the_same_types() -> None:
    s = Session()
    one, other = (s.open_model(EPSILON / "eol" / "library.xmi", name=name, metamodel=LIBRARY) for name in ("A", "B"))
    assert one.Book.kind is other.Book.kind is s.metamodel(LIBRARY).find("Book")
    one.Library.all[0].sections[0].items.append(other.Book.all[0])
    assert Metamodel.load(LIBRARY).find("Book") is not one.Book.kind, "nothing is shared by the process"
    assert Session().metamodel(LIBRARY).find("Book") is not one.Book.kind


def test_a_session_says_which_metamodels_it_has() -> None:
    s = Session()
    assert repr(s) == "<Session of no metamodels yet>"
    s.metamodel(LIBRARY)
    assert repr(s) == "<Session of library.ecore>"


def test_a_file_read_on_its_own_is_the_one_that_others_refer_to() -> None:
    s = Session()
    common = s.metamodel(COMMON)
    garden = s.metamodel(GARDEN)
    shared = {name for _, c in common.classifiers() if (name := str(c.name))} & {str(c.name) for _, c in garden.classifiers()}
    assert shared
    assert all(common.find(name) is garden.find(name) for name in shared)
    turned = Session()
    garden = turned.metamodel(GARDEN)
    assert all(turned.metamodel(COMMON).find(name) is garden.find(name) for name in shared)


@pytest.mark.parametrize("together", [[GARDEN, LIBRARY], [LIBRARY, GARDEN], [COMMON, GARDEN]])
def test_a_session_gives_the_packages_that_loading_alone_gives(together: list[Path]) -> None:
    s = Session()
    s.metamodel(together[0])
    found, alone = s.metamodel(*together), Metamodel.load(*together)
    assert [p for p, _ in found.classifiers()] == [p for p, _ in alone.classifiers()]
    for (_, one), (_, other) in zip(found.classifiers(), alone.classifiers(), strict=True):
        for part in ("eStructuralFeatures", "eOperations", "eLiterals", "eSuperTypes"):
            assert [str(x.name) for x in getattr(one, part, ())] == [str(x.name) for x in getattr(other, part, ())]


def test_two_versions_of_a_namespace_stay_apart(tmp_path: Path) -> None:
    (tmp_path / "new").mkdir()
    newer = tmp_path / "new" / "library.ecore"
    newer.write_text(LIBRARY.read_text().replace('name="Comic"', 'name="Booklet"').replace("#//Comic", "#//Booklet"))
    s = Session()
    old, new = s.metamodel(LIBRARY), s.metamodel(newer)
    assert old.find("Book") is not new.find("Book")
    assert new.Booklet.eClass.eSuperTypes[0] is new.find("Book")
    f = Flock(s.open_model(EPSILON / "eol" / "library.xmi", name="Old", metamodel=LIBRARY), ModelView(EmfModel((), new, "New")))
    f.retype("Comic", "Booklet")
    assert len(list(f.run().all_contents())) > 3


def test_a_namespace_that_a_file_names_for_itself_is_its_own(tmp_path: Path) -> None:
    """A reference by namespace leads into the file itself, not into another version that was read before."""
    text = LIBRARY.read_text()
    uri = text.partition('nsURI="')[2].partition('"')[0]
    for name in ("one", "two"):
        (tmp_path / f"{name}.ecore").write_text(text.replace('"#//', f'"{uri}#//').replace(" #//", f" {uri}#//"))
    s = Session()
    one, two = s.metamodel(tmp_path / "one.ecore"), s.metamodel(tmp_path / "two.ecore")
    assert one.Book.eClass.eSuperTypes[0] is one.find("Item")
    assert two.Book.eClass.eSuperTypes[0] is two.find("Item")
    assert one.find("Item") is not two.find("Item")


def test_models_are_merged_and_moved() -> None:
    s = Session()
    one, other = (ModelView(s.open_model(EPSILON / "eol" / "library.xmi", name=n, metamodel=LIBRARY)) for n in ("A", "B"))
    both = ModelView(EmfModel((), s.metamodel(LIBRARY), "Both"))
    t = ETL(one, other, both)

    @t.rule(one.Library, to=both.Library)
    def Whole(a, whole):  # type: ignore[no-untyped-def]
        whole.name = a.name
        whole.sections.extend([*one.Library.all[0].sections, *other.Library.all[0].sections])

    books = len(one.Book.all) + len(other.Book.all)
    t.run()
    assert len(both.Book.all) == books


def test_a_metamodel_that_has_changed_is_refused(tmp_path: Path) -> None:
    copy = tmp_path / "library.ecore"
    shutil.copy(LIBRARY, copy)
    s = Session()
    s.metamodel(copy)
    copy.write_text(copy.read_text() + " ")
    with pytest.raises(ModelError, match="has changed since this session read it") as raised:
        s.metamodel(copy)
    assert raised.value.fix
    assert str(raised.value.location) == str(copy)


def test_after_a_wrong_file_the_session_is_as_before(tmp_path: Path) -> None:
    s = Session()
    book = s.metamodel(LIBRARY).find("Book")
    wrong = tmp_path / "wrong.ecore"
    text = COMMON.read_text()
    for bad in (
        text.replace("eType=", 'eType="#//Nothing" was='),
        text[:200],
        text.replace("<eClassifiers", '<eClassifiers name=""', 1),
    ):
        wrong.write_text(bad)
        with pytest.raises(RobosmiError):
            s.metamodel(wrong)
    wrong.write_text(text)
    assert s.metamodel(wrong).names() == Metamodel.load(COMMON).names()
    assert s.metamodel(LIBRARY).find("Book") is book


def stored_trace(folder: Path) -> None:
    """A library, a graph made of it and the trace of that, in files."""
    s = Session()
    shutil.copy(EPSILON / "eol" / "library.xmi", folder)
    library = s.open_model(folder / "library.xmi", metamodel=LIBRARY)
    graph = EmfModel((), s.metamodel(GRAPH), "G")
    t = ETL(library, graph)

    @t.rule(library.Author, to=graph.Node)
    def Author2Node(a: Any, n: Any) -> None:
        n.label = a.name

    t.run()
    graph.save(folder / "graph.xmi")
    files = {"library.xmi": list(ModelView(library).Library.all), "graph.xmi": list(graph.roots)}
    save_model(t.trace.to_model(), folder / "trace.xmi", files)


@pytest.mark.parametrize("order", [("library", "graph", "trace"), ("trace", "graph", "library"), ("library", "trace", "graph")])
def test_a_stored_trace_is_about_the_models_that_are_open(order: tuple[str, ...], tmp_path: Path) -> None:
    stored_trace(tmp_path)
    s = Session()
    opened = {name: ModelView(s.open_model(tmp_path / f"{name}.xmi", metamodel=[LIBRARY, GRAPH])) for name in order}
    found = Trace.of_model(opened["trace"])
    ada, node = opened["library"].Author.all.first(), opened["graph"].Node.all.first()
    assert found.origins(node) == [ada]
    assert found.equivalents(ada) == [node]
    assert found.equivalents(opened["library"].Book.all.first()) == []


def test_the_metamodels_of_open_models_need_not_be_given_again(tmp_path: Path) -> None:
    stored_trace(tmp_path)
    s = Session()
    library = s.open_model(tmp_path / "library.xmi", metamodel=LIBRARY)
    graph = s.open_model(tmp_path / "graph.xmi", metamodel=GRAPH)
    found = Trace.of_model(s.open_model(tmp_path / "trace.xmi"))
    assert [found.origins(n)[0].name for n in graph.Node.all] == [a.name for a in library.Author.all]


def test_a_trace_of_other_copies_says_so(tmp_path: Path) -> None:
    stored_trace(tmp_path)
    graph = Session().open_model(tmp_path / "graph.xmi", metamodel=GRAPH)
    found = Trace.of_model(EmfModel.load(tmp_path / "trace.xmi", Metamodel.load(LIBRARY, GRAPH)))
    with pytest.raises(ModelError, match=r"other copy.*\n.*in one Session"):
        found.origins(graph.Node.all[0])
    with pytest.raises(ModelError, match="0 traces"):
        Trace.of_model(graph)


def test_a_file_that_is_opened_twice_or_has_changed_is_read_anew(tmp_path: Path) -> None:
    stored_trace(tmp_path)
    s = Session()
    s.open_model(tmp_path / "trace.xmi", metamodel=[LIBRARY, GRAPH])
    text = (tmp_path / "graph.xmi").read_text()
    (tmp_path / "graph.xmi").write_text(text.replace("Ada", "Eve"))
    first, second = (s.open_model(tmp_path / "graph.xmi", metamodel=GRAPH) for _ in range(2))
    assert [m.Node.all[0].label for m in (first, second)] == ["Eve", "Eve"]
    assert first.Node.all[0] is not second.Node.all[0]
