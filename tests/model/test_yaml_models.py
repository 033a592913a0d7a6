"""Models in YAML: the shape of JSON, read again as written, read by PyYAML as JSON is; faults have their lines."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
import yaml

from robosmi.base.located_json import MOST_LEVELS, located_json
from robosmi.errors import MissingToolError, ModelError, RobosmiError
from robosmi.model import Session
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.json_parser import YamlError, located_yaml
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.model.kitchen import FOLDER as XMI, kitchen
from tests.running import run

FOLDER = Path(__file__).parent / "yaml_models"
JSON = Path(__file__).parent / "json_models"
LIBRARY = Path(__file__).parents[1] / "epsilon" / "eol" / "library.ecore"
SPLIT = Path(__file__).parent / "split"


def graph(path: Path) -> Any:
    return EmfModel.load(path, SPLIT / "g.ecore")


def as_xmi(model: EmfModel) -> bytes:
    return to_xmi({"m.xmi": model.roots})["m.xmi"]


FORGETS = pytest.mark.emf_writes_otherwise("EMF forgets the nil when it saves")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(path.name, marks=[FORGETS] if path.stem == "nil_single" else [])
        for path in sorted((XMI / "good").glob("*.xmi"))
    ],
)
def test_what_xmi_says_is_the_same_after_yaml(name: str, tmp_path: Path) -> None:
    model = EmfModel.load(XMI / "good" / name, kitchen())
    model.save(tmp_path / "m.json")
    model.save(tmp_path / "m.yaml")
    before = (tmp_path / "m.yaml").read_bytes()
    assert located_yaml(before) == located_json((tmp_path / "m.json").read_bytes())
    again = EmfModel.load(tmp_path / "m.yaml", kitchen())
    assert as_xmi(again) == as_xmi(model)
    again.save()
    assert (tmp_path / "m.yaml").read_bytes() == before


def test_pyyaml_reads_what_it_reads_of_json(tmp_path: Path) -> None:
    model = graph(JSON / "graph_of_emfjson.json")
    model.Node.all[0].name = 'a "b" \\ \n\t\x07\x85\u2028\ufeff é 😀 # no: [comment]'
    model.save(tmp_path / "m.json")
    model.save(tmp_path / "m.yml")
    assert yaml.safe_load((tmp_path / "m.yml").read_bytes()) == json.loads((tmp_path / "m.json").read_bytes())
    assert graph(tmp_path / "m.yml").Node.all[0].name == model.Node.all[0].name


def test_what_a_person_writes_is_read_and_stays_until_it_is_edited(tmp_path: Path) -> None:
    path = Path(shutil.copy(FOLDER / "graph.yaml", tmp_path))
    model = graph(path)
    assert (model.Graph.all[0].name, model.Group.all[0].name, model.Node.all[1].name) == ("yes", "12:30", "2001-01-01")
    edge = model.Edge.all[0]
    assert (edge.name, edge.source.weight, edge.target.weight) == ("two\nlines\n", 3, -4)
    model.save()
    assert path.read_bytes() == (FOLDER / "graph.yaml").read_bytes()
    assert not path.with_name("graph.yaml.orig").exists()
    model.Node.all[0].weight = 7
    model.save()
    assert path.with_name("graph.yaml.orig").read_bytes() == (FOLDER / "graph.yaml").read_bytes()
    assert [node.weight for node in graph(path).Node.all] == [7, -4]


def test_forms_refer_to_each_other_and_are_compared_and_converted(tmp_path: Path) -> None:
    shutil.copy(SPLIT / "ok.xmi", tmp_path / "nodes.xmi")
    graph(tmp_path / "nodes.xmi").save(tmp_path / "nodes.yaml")
    s = Session()
    nodes: Any = s.open_model(tmp_path / "nodes.yaml", metamodel=SPLIT / "g.ecore")
    edges = EmfModel((), s.metamodel(SPLIT / "g.ecore"), path=tmp_path / "edges.yml")
    edges.create("Edge", name="far", target=nodes.Node.all[1])
    edges.save()
    assert graph(tmp_path / "edges.yml").Edge.all[0].target.name == "n2"
    done = run("diff", tmp_path / "nodes.xmi", tmp_path / "nodes.yaml", "--metamodel", SPLIT / "g.ecore")
    assert done.code == 0


def test_half_a_character_and_a_metamodel_are_refused(tmp_path: Path) -> None:
    model = graph(SPLIT / "ok.xmi")
    model.Node.all[0].name = "\ud83d"
    for each in (model, EmfModel.load(SPLIT / "g.ecore")):
        with pytest.raises(ModelError) as caught:
            each.save(tmp_path / "m.yaml")
        assert caught.value.fix
        assert not (tmp_path / "m.yaml").exists()


# --- faults

BAD = {
    "duplicate_key": 3, "duplicate_key_inside": 5, "anchor": 3, "alias": 3, "bomb": 1, "tag": 2, "two_documents": 2, "cut_off": 3,
    "tab": 2, "list_as_key": 2, "no_class": 1, "unknown_feature": 2, "empty": 1, "no_whole_number": 3, "control_character": 2,
}  # fmt: skip
"""Files that a strict read refuses -> the line of the fault."""


def test_every_bad_file_is_listed() -> None:
    assert {path.stem for path in (FOLDER / "bad").glob("*.yaml")} == set(BAD)


@pytest.mark.parametrize("name", BAD)
def test_a_fault_has_its_place_and_what_to_do(name: str) -> None:
    with pytest.raises(RobosmiError) as caught:
        EmfModel.load(FOLDER / "bad" / f"{name}.yaml", SPLIT / "g.ecore", strict=True)
    assert caught.value.location is not None
    assert (caught.value.location.line, Path(caught.value.location.path).stem) == (BAD[name], name)
    assert caught.value.fix


@pytest.mark.parametrize("text", ["- " * 10_000 + "x", "[" * 10_000 + "]" * 10_000, "{a: " * 10_000 + "1" + "}" * 10_000])
def test_a_deep_text_is_refused(text: str) -> None:
    with pytest.raises(YamlError) as refused:
        located_yaml(text.encode())
    assert "XMI" in refused.value.fix


def test_a_deep_model_is_written_as_deep_as_it_is_read(tmp_path: Path) -> None:
    mm = Metamodel.load(LIBRARY)
    root = inner = mm.Section(name="0")
    fits = MOST_LEVELS // 2 - 1  # each a list and an object
    for number in range(fits):
        inner.sections.append(mm.Section(name=str(number)))
        inner = inner.sections[0]
    model = EmfModel(root)
    model.save(tmp_path / "m.yaml")
    assert len(EmfModel.load(tmp_path / "m.yaml", model.metamodel).Section.all) == fits + 1
    inner.sections.append(mm.Section(name="one more"))
    with pytest.raises(ModelError):
        model.save(tmp_path / "m.yaml")


def test_without_pyyaml_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "yaml", None)
    with pytest.raises(MissingToolError, match="PyYAML"):
        located_yaml(b"a: 1")
