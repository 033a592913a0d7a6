"""Changes of plain XML: lists of children, the root, names with colons, new documents; what cannot take effect is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.chain import Chain, read_chain
from robosmi.errors import ModelError, SourceError
from robosmi.model.plain_xml import XmlModel
from robosmi.query import ModelView

FEED = b'<rss xmlns:dc="u:dc"><item dc:id="1"><dc:creator>Ann</dc:creator><creator>Ben</creator></item></rss>'


def saved(model: XmlModel) -> str:
    return model.to_bytes().decode().removeprefix('<?xml version="1.0" encoding="UTF-8"?>\n').rstrip("\n")


def test_changes_of_lists_of_children_are_changes_of_the_document() -> None:
    model = XmlModel.parse(b"<r><a/></r>")
    root = model.t_r.all[0]
    root.children.append(model.t_b())
    root.c_a.append(model.t_a(a_n="2"))
    root.c_a.insert(0, model.t_a(a_n="0"))
    root.children += [model.t_c()]
    assert saved(model) == '<r><a n="0"/><a/><b/><a n="2"/><c/></r>'
    root.children.reverse()
    assert saved(model) == '<r><c/><a n="2"/><b/><a/><a n="0"/></r>'
    for child in root.children:
        if child.tagName == "a":
            root.children.remove(child)
    assert saved(model) == "<r><c/><b/></r>"
    root.children[0] = model.t_d()
    assert [x.tagName for x in model.all_contents()] == ["r", "d", "b"]
    root.children.clear()
    assert saved(model) == "<r/>"
    assert list(model.all_contents()) == [root]


def test_what_is_taken_out_may_be_put_somewhere_else() -> None:
    model = XmlModel.parse(b"<r><a>1</a>text<b/></r>")
    a = model.t_a.all[0]
    model.t_r.all[0].children.remove(a)
    assert not model.owns(a)
    assert saved(model) == "<r>text<b/></r>"
    model.t_b.all[0].appendChild(a)
    assert saved(model) == "<r>text<b><a>1</a></b></r>"


@pytest.mark.parametrize(
    "change",
    [
        lambda m, r: r.c_a.append(m.t_b()),
        lambda m, r: r.children.append("a"),
        lambda m, r: r.children.append(XmlModel.parse(b"<a/>").t_a.all[0]),
        lambda m, r: r.children.append(r.children[0]),
        lambda m, r: r.children.extend([x := m.t_b(), x]),
        lambda m, r: setattr(r, "children", []),
        lambda m, r: setattr(m, "roots", [r]),
        lambda m, r: setattr(m, "Root", r),
        lambda m, r: setattr(m, "root", None),
        lambda m, r: setattr(r, "x_a", r),
        lambda m, r: setattr(r, "a_q:a", "1"),
        lambda m, r: setattr(r, "a_x", [1]),
        lambda m, r: setattr(r, "a_x", r),
        lambda m, r: setattr(r, "text", ["a"]),
        lambda m, r: setattr(r, "name", "s"),
        lambda m, r: setattr(r, "a_xmlns:", "1"),
    ],
)
def test_a_change_that_cannot_take_effect_is_refused(change: Any) -> None:
    model = XmlModel.parse(b"<r><a/></r>")
    with pytest.raises(ModelError):
        change(model, model.t_r.all[0])
    assert [x.tagName for x in model.all_contents() if x.parentNode is not None or x is model.root] == ["r", "a"]


def test_the_root_may_be_another_element(tmp_path: Path) -> None:
    (tmp_path / "x.xml").write_bytes(b"<!-- first -->\n<r><a/></r>\n<!-- last -->\n")
    model: Any = ModelView(XmlModel.load(tmp_path / "x.xml"))
    old = model.root
    model.root = model.t_feed(a_x="1")
    assert [x.tagName for x in model.all_contents()] == ["feed"]
    model.root.appendChild(old)
    model.save()
    assert (tmp_path / "x.xml").read_bytes() == b'<!-- first -->\n<feed x="1"><r><a/></r></feed>\n<!-- last -->\n'
    model.root = model.t_a.all.first()
    assert [x.tagName for x in model.all_contents()] == ["a"]


def test_elements_that_were_put_nowhere_stop_the_save(tmp_path: Path) -> None:
    (tmp_path / "x.xml").write_bytes(b"<r/>")
    model = XmlModel.load(tmp_path / "x.xml")
    lost = model.t_feed()
    with pytest.raises(ModelError, match="t_feed"):
        model.save()
    assert (tmp_path / "x.xml").read_bytes() == b"<r/>"
    model.delete(lost)
    model.save()


def test_names_with_colons_are_found_made_and_set() -> None:
    model: Any = XmlModel.parse(FEED)
    (creator,) = model["t_dc:creator"].all
    assert (creator.text, creator.tagName, creator.namespaceURI) == ("Ann", "dc:creator", "u:dc")
    assert [x.text for x in model.t_creator.all] == ["Ann", "Ben"]
    assert [x.text for x in model.all_of_type("t_creator")] == ["Ann", "Ben"]
    (item,) = model.t_item.all
    assert [x.text for x in getattr(item, "c_dc:creator")] == ["Ann"]
    assert getattr(item, "e_dc:creator") is creator
    assert getattr(item, "a_dc:id") == item.a_id == "1"
    setattr(item, "a_dc:id", "2")
    setattr(item, "a_dc:new", "3")
    made = model["t_dc:date"](text="today")
    item.appendChild(made)
    assert saved(model).startswith('<rss xmlns:dc="u:dc"><item dc:id="2" dc:new="3"><dc:creator>')
    assert saved(model).endswith("<dc:date>today</dc:date></item></rss>")
    assert {"t_dc:creator", "t_creator", "t_dc:date"} <= set(model.type_names())
    with pytest.raises(ModelError, match="'q'"):
        model["t_q:x"]()


def test_namespaces_are_declared_by_attributes_as_in_dom() -> None:
    model: Any = XmlModel.new()
    model.root = model.t_feed()
    model.root.a_xmlns = "u:atom"
    setattr(model.root, "a_xmlns:dc", "u:dc")
    entry = model.t_entry()
    model.root.appendChild(entry)
    entry.appendChild(model["t_dc:date"]())
    again: Any = XmlModel.parse(model.to_bytes())
    assert [(x.tagName, x.namespaceURI) for x in again.all_contents()] == [
        ("feed", "u:atom"), ("entry", "u:atom"), ("dc:date", "u:dc"),
    ]  # fmt: skip
    with pytest.raises(ModelError, match="cannot be changed"):
        again.root.a_xmlns = "u:other"


def test_a_change_of_the_list_of_a_reference_is_one_of_the_attribute() -> None:
    model: Any = XmlModel.parse(b'<r><p id="1"/><p id="2"/><p/><q to="2"/></r>')
    model.bind("q", "to", "p", "id", many=True)
    (q,) = model.t_q.all
    q.x_to.append(model.t_p.all[0])
    assert q.a_to == "2, 1"
    q.x_to.remove(model.t_p.all[1])
    assert q.a_to == "1"
    with pytest.raises(ModelError, match="with an identity"):
        q.x_to.append(model.t_p.all[2])
    assert q.a_to == "1"


def test_epsilons_names_of_what_is_around_an_element() -> None:
    model: Any = XmlModel.parse(FEED)
    (creator,) = model["t_dc:creator"].all
    assert (creator.name, creator.parent.name, model.root.parent) == ("creator", "item", None)
    assert [each.name for each in model.root.descendants] == ["item", "creator", "creator"]


def test_references_are_set() -> None:
    model = XmlModel.parse(b'<r><p id="1"/><p id="2"/><p/><q/></r>')
    model.bind("q", "to", "p", "id")
    model.bind("q", "all", "p", "id", many=True)
    (q,) = model.t_q.all
    first, second, nameless = model.t_p.all
    q.x_to, q.x_all = second, [first, second]
    assert (q.a_to, q.a_all, q.x_to, q.x_all) == ("2", "1, 2", second, [first, second])
    for wrong in (nameless, q, "1"):
        with pytest.raises(ModelError, match="does not take"):
            q.x_to = wrong
    q.x_to = None
    assert q.a_to == ""


def test_a_new_document_is_made(tmp_path: Path) -> None:
    model: Any = XmlModel.new(tmp_path / "atom.xml", namespaces={"": "u:atom", "dc": "u:dc"})
    with pytest.raises(ModelError, match="no root"):
        model.save()
    model.root = model.t_feed()
    model.root.children.append(model.t_entry(a_id="ä"))
    model.root.children.append(model["t_dc:creator"](text="Ann"))
    model.save()
    assert (tmp_path / "atom.xml").read_text(encoding="utf-8") == (
        '<?xml version="1.0" encoding="UTF-8"?>\n<feed xmlns="u:atom" xmlns:dc="u:dc">\n'
        '  <entry id="ä"/>\n  <dc:creator>Ann</dc:creator>\n</feed>\n'
    )


RULES = """
def to_atom(t, rss, atom):
    @t.rule
    def feed(source: rss.t_rss, target: atom.t_feed):
        atom.root = target
        target.children.extend(t.equivalent(source.c_item))

    @t.rule
    def entry(source: rss.t_item, target: atom.t_entry):
        target.a_title = source.a_title

def count(v, atom):
    @v.context(atom.t_entry).constraint
    def titled(entry):
        return entry.a_title != ""
"""


def test_a_chain_makes_a_document_and_reads_it_again(tmp_path: Path) -> None:
    (tmp_path / "rules.py").write_text(RULES, encoding="utf-8")
    (tmp_path / "rss.xml").write_text('<rss><item title="a"/><item title="b"/></rss>', encoding="utf-8")
    (tmp_path / "chain.toml").write_text(
        '[[step]]\nload = "rss"\nfile = "rss.xml"\n\n'
        '[[step]]\ntransform = "rules.py:to_atom"\nmodels = "rss"\nmakes = "atom"\ndriver = "xml"\nfile = "atom.xml"\n\n'
        '[[step]]\nvalidate = "rules.py:count"\nmodels = "atom"\n',
        encoding="utf-8",
    )
    assert [step.state for step in read_chain(tmp_path / "chain.toml").run().steps] == ["done"] * 3
    text = '<feed>\n  <entry title="a"/>\n  <entry title="b"/>\n</feed>\n'
    assert (tmp_path / "atom.xml").read_text(encoding="utf-8").endswith(text)
    (tmp_path / "rules.py").write_text(RULES.replace('!= ""', '!= "c"'), encoding="utf-8")
    assert [step.state for step in read_chain(tmp_path / "chain.toml").run().steps].count("failed") == 0


@pytest.mark.parametrize("options", [{}, {"driver": "xml", "metamodel": "m.ecore"}, {"driver": "rows"}])
def test_a_step_says_of_what_its_model_is(options: Any, tmp_path: Path) -> None:
    with pytest.raises(SourceError):
        Chain(tmp_path).transform(lambda t, a, b: None, models="a", makes="b", **options)
