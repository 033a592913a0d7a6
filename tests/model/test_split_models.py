"""Models in several files: references and containment across files are kept, wherever a file is saved; EMF reads the result."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.chain import read_chain
from robosmi.errors import ModelError, SourceError
from robosmi.model import EmfModel, Session, open_model
from robosmi.model.ecore.metamodel import Metamodel
from tests.emf_judge import judge

CASES = Path(__file__).parent / "split"
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
WEAVING = '  <edges name="x">\n    <source href="ok.xmi#//@groups.0/@nodes.1"/>\n  </edges>\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A graph, a group whose edge leads into it, and a graph with a group in a file of its own."""
    shutil.copytree(CASES, tmp_path, dirs_exist_ok=True)
    return tmp_path


def emf(folder: Path, name: str) -> None:
    judge([folder / "g.ecore"], folder / name)


def test_a_model_that_refers_to_another_file_is_saved_in_place_and_elsewhere(folder: Path) -> None:
    for opened in (open_model, Session().open_model):
        model = opened(folder / "w.xmi", metamodel=folder / "g.ecore")
        before = (folder / "w.xmi").read_bytes()
        model.save()
        assert (folder / "w.xmi").read_bytes() == before
        (folder / "a b").mkdir(exist_ok=True)
        model.save(folder / "a b" / "w.xmi")
        assert 'href="../ok.xmi#//@groups.0/@nodes.1"' in (folder / "a b" / "w.xmi").read_text()
        again = open_model(folder / "a b" / "w.xmi", metamodel=folder / "g.ecore")
        assert again.Edge.all[0].source.name == "n2"


def test_a_reference_to_a_model_with_a_path_is_written_and_other_ones_are_refused(folder: Path) -> None:
    graph = EmfModel.load(folder / "ok.xmi", folder / "g.ecore")
    made, other = EmfModel((), graph.metamodel, "made"), EmfModel((), graph.metamodel, "other")
    edge = made.Edge(name="e", source=graph.Node.all[0])
    made.save(folder / "made.xmi")
    assert '<source href="ok.xmi#//@groups.0/@nodes.0"/>' in (folder / "made.xmi").read_text()
    edge.target = other.Node(name="z")
    with pytest.raises(ModelError, match="none of the models that have a file"):
        made.save()
    (folder / "sub").mkdir()
    other.save(folder / "sub" / "other.xmi")
    made.save()
    assert '<target href="sub/other.xmi#/"/>' in (folder / "made.xmi").read_text()
    assert made.path == folder / "made.xmi"


def test_a_chain_writes_references_to_its_other_models(folder: Path) -> None:
    (folder / "rules.py").write_text(
        "def edges(t, a, b):\n"
        "    @t.rule\n"
        "    def copied(s: a.Edge, x: b.Edge):\n"
        "        x.name, x.source, x.target = s.name, s.source, s.target\n"
        "def named(v, w):\n"
        "    from robosmi.validate import Fail, Fix\n"
        "    @v.context(w.Edge).constraint\n"
        "    def long(e):\n"
        '        return len(e.name) > 1 or Fail("short", Fix("longer", lambda: setattr(e, "name", e.name * 2)))\n'
    )
    (folder / "c.toml").write_text(
        '[[step]]\nload = "a"\nfile = "ok.xmi"\nmetamodel = "g.ecore"\n'
        '[[step]]\nload = "w"\nfile = "w.xmi"\nmetamodel = "g.ecore"\n'
        '[[step]]\ntransform = "rules.py:edges"\nmodels = "a"\nmakes = "b"\nmetamodel = "g.ecore"\nfile = "out/b.xmi"\n'
        '[[step]]\nvalidate = "rules.py:named"\nmodels = "w"\n'
    )
    read_chain(folder / "c.toml").run(fix="first")
    assert 'href="../ok.xmi#//@groups.0/@nodes.0"' in (folder / "out" / "b.xmi").read_text()
    assert WEAVING.replace('"x"', '"xx"') in (folder / "w.xmi").read_text()


@pytest.mark.parametrize("order", [("p", "q"), ("q", "p")])
def test_containment_across_files_is_one_model_and_two_files(folder: Path, order: tuple[str, str]) -> None:
    before = {name: (folder / f"{name}.xmi").read_bytes() for name in order}
    s = Session()
    opened: dict[str, Any] = {name: s.open_model(folder / f"{name}.xmi", metamodel=folder / "g.ecore") for name in order}
    whole, part = opened["p"], opened["q"]
    assert whole.Node.all == part.Node.all
    assert part.roots[0].eContainer() is whole.roots[0]
    assert s.save_all() == []
    whole.Node.all[0].name = "changed"
    part.Group.all[0].nodes.append(whole.Node(name="new"))
    assert [x.name for x in part.Node.all] == ["changed", "new"]
    assert [x.name for x in whole.Node.all] == ["changed", "new"]
    whole.roots[0].name = "R"
    assert sorted(path.name for path in s.save_all()) == ["p.xmi", "q.xmi"]
    assert (folder / "p.xmi").read_bytes() == before["p"].replace(b'name="root"', b'name="R"')
    text = before["q"].replace(b'<nodes name="n1"/>', b'<nodes name="changed"/>\n  <nodes name="new"/>')
    assert (folder / "q.xmi").read_bytes() == text
    emf(folder, "p.xmi")
    emf(folder, "q.xmi")


def test_a_file_that_was_read_with_a_model_is_saved_with_it(folder: Path) -> None:
    s = Session()
    whole: Any = s.open_model(folder / "p.xmi", metamodel=folder / "g.ecore")
    whole.Node.all[0].name = "changed"
    assert [path.name for path in s.save_all()] == ["q.xmi"]
    assert b'<nodes name="changed"/>' in (folder / "q.xmi").read_bytes()


def test_a_part_that_is_opened_after_its_whole_keeps_its_layout(folder: Path) -> None:
    text = (folder / "q.xmi").read_text().replace("g:", "own:").replace("xmlns:g", "xmlns:own")
    (folder / "q.xmi").write_text(text := text.replace("  <nodes", "  <!-- kept -->\n  <nodes"))
    s = Session()
    for name in ("p.xmi", "q.xmi"):
        model: Any = s.open_model(folder / name, metamodel=folder / "g.ecore")
    assert s.save_all() == []
    model.Node.all[0].name = "changed"
    model.save()
    assert (folder / "q.xmi").read_text() == text.replace('"n1"', '"changed"')


def test_a_part_that_is_moved_belongs_to_its_new_file(folder: Path) -> None:
    s = Session()
    whole: Any = s.open_model(folder / "p.xmi", metamodel=folder / "g.ecore")
    other: Any = s.open_model(folder / "ok.xmi", metamodel=folder / "g.ecore")
    part = whole.roots[0].groups[0]
    whole.roots[0].groups.remove(part)
    other.roots[0].groups.append(part)
    assert sorted(path.name for path in s.save_all()) == ["ok.xmi", "p.xmi", "q.xmi"]
    assert b'<groups name="sub">' in (folder / "ok.xmi").read_bytes()
    assert b"href" not in (folder / "p.xmi").read_bytes()
    assert len(open_model(folder / "ok.xmi", metamodel=folder / "g.ecore").Group.all) == 2


def test_nothing_is_written_when_one_model_cannot_be(folder: Path) -> None:
    s = Session()
    whole: Any = s.open_model(folder / "p.xmi", metamodel=folder / "g.ecore")
    other: Any = s.open_model(folder / "ok.xmi", metamodel=folder / "g.ecore")
    whole.roots[0].name = "changed"
    other.Edge.all[0].source = EmfModel((), whole.metamodel, "lost").Node(name="lost")
    before = {path.name: path.read_bytes() for path in folder.glob("*.xmi")}
    with pytest.raises(ModelError, match="lost"):
        s.save_all()
    assert {path.name: path.read_bytes() for path in folder.glob("*.xmi")} == before
    assert os.listdir(folder).count("p.xmi") == 1


@pytest.mark.parametrize("first", ["part.xmi", "whole.xmi"])
def test_a_part_that_refers_to_itself_through_the_whole_is_opened_from_both_sides(folder: Path, first: str) -> None:
    session = Session()
    opened = session.open_model(folder / "circle" / first, metamodel=folder / "g.ecore")
    assert opened.findings == []
    part = session.open_model(folder / "circle" / "part.xmi", metamodel=folder / "g.ecore")
    assert part.Edge.all[0].target is part.Node.all[0]
    assert isinstance(part, EmfModel)
    assert part.roots[0].eContainer().name == "whole"
    assert [path.name for path in session.save_all()] == ["part.xmi"]
    assert '<edges name="e" target="//@nodes.0"/>' in (folder / "circle" / "part.xmi").read_text(), "as EMF writes it"
    part.touched()
    part.Node.all[0].name = "m"
    assert part.touched()
    assert [path.name for path in session.save_all()] == ["part.xmi"]


def test_of_many_namespaces_a_message_names_the_nearest(folder: Path) -> None:
    text = (folder / "g.ecore").read_text()
    for number in range(21):
        (folder / f"m{number}.ecore").write_text(text.replace('"http://example.org/g"', f'"http://example.org/{number}/g"'))
    (folder / "g.ecore").unlink()
    with pytest.raises(SourceError) as error:
        open_model(folder / "ok.xmi", metamodel=Metamodel.load(folder))
    fix = str(error.value.fix)
    assert fix.endswith(", and 16 more")
    assert fix.count("http://example.org/") == 5


@pytest.mark.parametrize(
    "form", ['one="s:B o.xmi#o"', 'many="s:B o.xmi#o s:B o.xmi#o2"', 'one="s:C o.xmi#c"', 'part="s:C o.xmi#c"']
)
def test_the_type_that_stands_before_a_reference_is_no_change(form: str, tmp_path: Path) -> None:
    shutil.copytree(CASES.parent / "subtypes", tmp_path, dirs_exist_ok=True)
    file = tmp_path / "t.xmi"
    file.write_text(before := file.read_text().replace('id="r"', f'id="r" {form}'))
    session = Session()
    model: Any = session.open_model(file, metamodel=tmp_path / "s.ecore")
    assert (model.findings, session.save_all()) == ([], [])
    model.save()
    assert file.read_text() == before
    model.A.all[1].id = "r3"
    model.save()
    assert file.read_text() == (edited := before.replace('"r2"', '"r3"'))
    root = model.roots[0]
    root.one = root.part = None
    root.many.clear()
    model.save()
    assert file.read_text() == edited.replace(f" {form}", "")
    root.one = model.A.all[1]
    model.save()
    assert file.read_text() == edited.replace(form, 'one="r3"')


def test_a_part_is_an_input_of_a_chain_and_its_trace_names_the_parts_file(folder: Path) -> None:
    (folder / "build").mkdir()
    (folder / "c.toml").write_text(
        '[[step]]\nload = "P"\nfile = "p.xmi"\nmetamodel = "g.ecore"\n'
        '[[step]]\ntransform = "rules.py:to_copy"\nmodels = "P"\nmakes = "C"\nmetamodel = "g.ecore"\n'
        'file = "build/c.xmi"\ntrace = "build/trace.xmi"\n'
    )

    def states() -> list[str]:
        return [step.state for step in read_chain(folder / "c.toml").run().steps]

    assert states() == ["done", "done"]
    assert 'href="../q.xmi#/"' in (folder / "build" / "trace.xmi").read_text()
    assert states() == ["up to date", "up to date"]
    (folder / "q.xmi").write_text((folder / "q.xmi").read_text().replace("sub", "other"))
    assert states() == ["done", "done"]
    assert "other" in (folder / "build" / "c.xmi").read_text()
    assert states() == ["up to date", "up to date"]


def test_a_save_that_does_not_write_what_was_edited_says_so(folder: Path) -> None:
    session = Session()
    model: Any = session.open_model(folder / "p.xmi", metamodel=folder / "g.ecore")
    model.save()
    assert model.findings == []
    model.Node.all[0].name = "changed"
    model.save()
    (finding,) = model.findings
    assert (finding.rule, "q.xmi" in finding.message, "save_all" in str(finding.fix)) == ("RS611", True, True)
    assert [path.name for path in session.save_all()] == ["q.xmi"]
    model.roots[0].name = "changed"
    model.save()
    assert model.findings == []
    model.Node.all[0].name, model.roots[0].name = "again", "again"
    for saved in (folder / "p.xmi", folder / "elsewhere.xmi", folder / "p.xmi"):
        model.save(saved)
        assert [(each.rule, "q.xmi" in each.message) for each in model.findings] == [("RS611", True)]
    session.save_all()
    model.save()
    assert model.findings == []
