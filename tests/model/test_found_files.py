"""Metamodels by folder and pattern, types by completion, and messages for files that are no models."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.chain import read_chain
from robosmi.errors import ModelError, SourceError, UsageError
from robosmi.model import Metamodel, Session, open_model
from robosmi.query import ModelView
from tests.running import run

SPLIT = Path(__file__).parent / "split"
TWO = '<e:EPackage xmlns:e="http://www.eclipse.org/emf/2002/Ecore" name="two" nsURI="http://example.org/two" nsPrefix="two"/>'

XSI = "http://www.w3.org/2001/XMLSchema-instance"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder of two metamodels, one of which was copied by a build."""
    for name in ("models", "models/target"):
        (tmp_path / name).mkdir()
        shutil.copy(SPLIT / "g.ecore", tmp_path / name)
    (tmp_path / "models" / "two.ecore").write_text(TWO)
    shutil.copy(SPLIT / "ok.xmi", tmp_path)
    return tmp_path


def test_metamodels_are_given_as_folders_and_patterns(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for given in (folder / "models", folder / "models" / "*.ecore", folder / "**" / "*.ecore"):
        assert [str(p.name) for p in Metamodel.load(given).epackages] == ["g", "two"]
        assert len(Session().open_model(folder / "ok.xmi", metamodel=given).Node.all) == 2
        done = run("query", folder / "ok.xmi", "Node.all.size()", "--metamodel", given, "--json")
        assert done.result == {"value": 2}
    with pytest.raises(SourceError, match=r"no \.ecore file"):
        Metamodel.load(folder / "*.xyz")


def test_two_metamodels_of_one_namespace_in_a_folder_hinder_only_models_that_need_it(folder: Path) -> None:
    models = folder / "models"
    (models / "other.ecore").write_text((SPLIT / "g.ecore").read_text().replace("weight", "cost"))
    for name, above in (("two", ""), ("uses", ' eSuperTypes="http://example.org/g#//Node"')):
        inside = f' xmlns:xsi="{XSI}"><eClassifiers xsi:type="e:EClass" name="A"{above}/></e:EPackage>'
        text = TWO.replace("two", name).replace("/>", inside)
        (models / f"{name}.ecore").write_text(text)
        (folder / f"{name}.xmi").write_text(f'<x:A xmlns:x="http://example.org/{name}"/>')
    for read in (open_model, lambda path, **given: Session().open_model(path, **given)):
        assert len(read(folder / "two.xmi", metamodel=models).A.all) == 1
        for model in ("ok.xmi", "uses.xmi"):
            with pytest.raises(ModelError, match=r"is that of '.*g\.ecore', '.*other\.ecore'"):
                read(folder / model, metamodel=[models])
        assert len(read(folder / "ok.xmi", metamodel=[models, models / "g.ecore"]).Node.all) == 2
        assert len(read(folder / "uses.xmi", metamodel=[models, models / "other.ecore"]).A.all) == 1


def test_a_chain_takes_a_pattern(folder: Path) -> None:
    (folder / "c.toml").write_text('[[step]]\nload = "a"\nfile = "ok.xmi"\nmetamodel = "models/*.ecore"\n')
    assert [step.state for step in read_chain(folder / "c.toml").run().steps] == ["done"]


def test_types_are_listed_for_completion() -> None:
    model = open_model(SPLIT / "ok.xmi", metamodel=SPLIT / "g.ecore")
    for one in (model, ModelView(model), Metamodel.load(SPLIT / "g.ecore")):
        assert {"Node", "Edge", "Group"} <= set(dir(one))


@pytest.mark.parametrize("name", ["a.etl", "a.evl", "a.emf", "a.flexmi", "a.json"])
def test_files_that_are_no_models_are_called_what_they_are(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text("{}")
    said = {"etl": "Epsilon script", "evl": "Epsilon script", "emf": "Emfatic", "flexmi": "Flexmi", "json": "JSON"}[name[2:]]
    with pytest.raises(SourceError, match=said):
        open_model(tmp_path / name)
    if name == "a.etl":
        with pytest.raises(SourceError, match="Epsilon script"):
            read_chain(tmp_path / name)
    if name == "a.emf":
        with pytest.raises(SourceError, match="Emfatic"):
            Metamodel.load(tmp_path / name)


def test_a_metamodel_makes_xml_of_an_unknown_ending_a_model(folder: Path) -> None:
    metamodel = folder / "models" / "g.ecore"
    text = (folder / "ok.xmi").read_text().replace("http://www.omg.org/XMI", "http://www.omg.org/spec/XMI/20131001")
    for name, head in (
        ("a.uml", text),
        ("b.amxmi", text.replace(" xmi:version", " version").replace("http://www.omg", "urn:")),
        ("c.xml", text),
    ):
        (folder / name).write_text(head.replace(' version="2.0"', "") if name[0] == "b" else head)
        assert len(Session().open_model(folder / name, metamodel=metamodel).Node.all) == 2
        assert len(open_model(folder / name, metamodel=metamodel).Node.all) == 2
        assert run("diff", folder / name, folder / "ok.xmi", "--metamodel", metamodel, "--json").result["equal"]


def test_an_option_that_the_driver_does_not_take_is_refused(folder: Path) -> None:
    (folder / "t.csv").write_text("a,b\n1,2\n")
    for open_it in (open_model, Session().open_model):
        with pytest.raises(UsageError, match="takes no option 'metamodel'"):
            open_it(folder / "t.csv", metamodel=folder / "models" / "g.ecore")
        with pytest.raises(UsageError, match="did you mean 'strict'"):
            open_it(folder / "ok.xmi", metamodel=folder / "models" / "g.ecore", strikt=True)
