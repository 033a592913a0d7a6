"""Traces: both directions, order, the trace model and back."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.metamodels import trace
from robosmi.model import load_model, save_model
from robosmi.transform import ETL, Trace
from tests.library import empty, library


def transformed() -> tuple[Any, Any, ETL]:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)

    @t.rule(L.Author, to=[G.Node, G.Note])
    def Author2Node(a: Any, n: Any, note: Any) -> None:
        n.label = a.name

    @t.rule(L.Author, to=G.Group)
    def Author2Group(a: Any, g: Any) -> None:
        g.label = a.name

    t.run()
    return L, G, t


def test_links_are_found_from_either_end() -> None:
    L, G, t = transformed()
    ada = L.Author.all[0]
    assert [x.eClass.name for x in t.trace.equivalents(ada)] == ["Node", "Note", "Group"]
    assert t.trace.origins(G.Note.all[0]) == [ada]
    assert [link.rule for link in t.trace.links_from(ada)] == ["Author2Node", "Author2Group"]
    assert [link.rule for link in t.trace.links_to(G.Group.all[2])] == ["Author2Group"]
    assert t.trace.equivalents(L.Book.all[0]) == []
    assert t.trace.origins(ada) == []
    assert len(t.trace) == 6


def test_what_is_of_a_class_is_given_alone_where_the_class_is_asked_for() -> None:
    L, G, t = transformed()
    ada = L.Author.all[0]
    group = type(G.Group.all[0])
    assert t.trace.equivalents(ada, group) == [G.Group.all[0]]
    assert t.trace.equivalents(L.Book.all[0], group) == []
    assert t.equivalent(ada, kind=group) is G.Group.all[0]
    assert t.equivalent(ada) is G.Node.all[0]
    assert t.equivalent(L.Book.all[0], kind=group) is None


def test_links_are_grouped_by_source_when_iterated_and_kept_in_order_made() -> None:
    t = transformed()[2]
    assert [(x.rule, x.source.name) for x in t.trace][:3] == [
        ("Author2Node", "Ada"),
        ("Author2Group", "Ada"),
        ("Author2Node", "Ben"),
    ]
    assert [x.rule for x in t.trace.links] == ["Author2Node"] * 3 + ["Author2Group"] * 3
    assert {id(x) for x in t.trace} == {id(x) for x in t.trace.links}


def test_links_that_are_added_later_are_found_too() -> None:
    made = Trace()
    source, target = library().Author.all[0], library().Author.all[1]
    assert made.origins(target) == []
    made.link("r", "step", [source, None, source], [target])
    assert made.origins(target) == [source, source]
    assert [link.step for link in made] == ["step"]


def test_values_are_sources_like_elements() -> None:
    made = Trace()
    one, true = trace.TextTrace(path="one"), trace.TextTrace(path="true")
    made.add("r", 1, [one])
    made.add("r", True, [true])
    assert made.equivalents(1) == [one]
    assert made.equivalents(True) == [true]
    assert made.equivalents(1.0) == []


def test_a_trace_is_a_model_that_is_stored_and_read_again(tmp_path: Path) -> None:
    whole, part = trace.TextTrace(path="a"), trace.TextTrace(path="b")
    made = Trace()
    made.link("rule", "step", [whole], [part])
    model = made.to_model()
    texts = trace.Trace(texts=[whole, part])
    save_model(texts, tmp_path / "texts.xmi")
    save_model(model, tmp_path / "trace.xmi", {"texts.xmi": texts})
    read = Trace.of_model(load_model(tmp_path / "trace.xmi"))
    (link,) = read.links
    assert (link.rule, link.step, link.source.path) == ("rule", "step", "a")
    assert [x.path for x in read.equivalents(link.source)] == ["b"]
    assert read.origins(link.targets[0]) == [link.source]


def test_what_is_no_element_of_emf_is_left_out_of_the_model() -> None:
    made = Trace()
    made.add("r", "a text", [trace.TextTrace(path="p")])
    (link,) = made.to_model().links
    assert list(link.sources) == []
    assert [x.path for x in link.targets] == ["p"]  # type: ignore[attr-defined]


def test_traces_of_steps_become_one() -> None:
    whole = Trace()
    one, two = trace.TextTrace(path="one"), trace.TextTrace(path="two")
    whole.link("first", "a", [one], [two])
    part = Trace("b")
    part.add("second", two, [one])
    whole.take(part)
    assert [(k.rule, k.step) for k in whole.links] == [("first", "a"), ("second", "b")]
    assert whole.equivalents(two) == whole.origins(two) == [one]
    assert whole.origins(one) == [two]
