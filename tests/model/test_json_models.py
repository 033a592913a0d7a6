"""Models in JSON, in EMF-JSON's form: what XMI says is read again, pyecore reads and writes the same, faults have their lines."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from pyecore.resources import URI, ResourceSet
from pyecore.resources.json import JsonResource

from robosmi.base.located_json import MOST_LEVELS, JsonError, LocatedObject, NumberText, located_json
from robosmi.errors import ModelError, RobosmiError
from robosmi.model import Session, load_model, open_model, save_model
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.model.kitchen import FOLDER as XMI, kitchen
from tests.running import run

FOLDER = Path(__file__).parent / "json_models"
SPLIT = Path(__file__).parent / "split"
LIBRARY = Path(__file__).parents[1] / "epsilon" / "eol"


def graph(path: Path) -> EmfModel:
    return EmfModel.load(path, SPLIT / "g.ecore")


def as_xmi(model: EmfModel) -> bytes:
    return to_xmi({"m.xmi": model.roots})["m.xmi"]


# --- round trips


FORGETS = pytest.mark.emf_writes_otherwise("EMF forgets the nil when it saves")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(path.name, marks=[FORGETS] if path.stem == "nil_single" else [])
        for path in sorted((XMI / "good").glob("*.xmi"))
    ],
)
def test_what_xmi_says_is_the_same_after_json(name: str, tmp_path: Path) -> None:
    model = EmfModel.load(XMI / "good" / name, kitchen())
    model.save(tmp_path / "m.json")
    text = (tmp_path / "m.json").read_text()
    assert text == json.dumps(json.loads(text), indent=2, ensure_ascii=False) + "\n"
    again = EmfModel.load(tmp_path / "m.json", kitchen())
    assert as_xmi(again) == as_xmi(model)
    before = (tmp_path / "m.json").read_bytes()
    again.save()
    assert (tmp_path / "m.json").read_bytes() == before


def test_pyecore_reads_what_is_written_and_writes_what_is_read(tmp_path: Path) -> None:
    model = EmfModel.load(LIBRARY / "library.xmi", LIBRARY / "library.ecore")
    model.save(tmp_path / "ours.json")
    resources = ResourceSet()
    package: Any = resources.get_resource(URI(str(LIBRARY / "library.ecore"))).contents[0]
    resources.metamodel_registry[package.nsURI] = package
    resources.resource_factory["json"] = JsonResource
    read = resources.get_resource(URI(str(tmp_path / "ours.json")))
    found = sorted((each.eClass.name, each.name) for each in read.contents[0].eAllContents())
    assert found == sorted((each.eClass.name, each.name) for each in list(model.all_contents())[1:])
    written = JsonResource(URI(str(tmp_path / "theirs.json")))
    written.append(read.contents[0])
    written.save()
    theirs = EmfModel.load(tmp_path / "theirs.json", LIBRARY / "library.ecore")
    assert as_xmi(theirs) == as_xmi(model)


def test_the_form_is_that_of_emf_json(tmp_path: Path) -> None:
    model = graph(SPLIT / "ok.xmi")
    model.save(tmp_path / "m.json")
    uri = "http://example.org/g#//"
    n1, n2, e = (f"//@groups.0/@{place}" for place in ("nodes.0", "nodes.1", "edges.0"))
    assert json.loads((tmp_path / "m.json").read_text()) == {
        "eClass": f"{uri}Graph",
        "name": "root",
        "groups": [
            {
                "name": "a",
                "nodes": [
                    {"name": "n1", "weight": 1, "out": [{"eClass": f"{uri}Edge", "$ref": e}]},
                    {"name": "n2", "weight": 2, "into": [{"eClass": f"{uri}Edge", "$ref": e}]},
                ],
                "edges": [
                    {
                        "name": "e",
                        "source": {"eClass": f"{uri}Node", "$ref": n1},
                        "target": {"eClass": f"{uri}Node", "$ref": n2},
                    }
                ],
            }
        ],
    }


def test_a_file_keeps_its_bytes_until_it_is_edited_and_its_indentation_then(tmp_path: Path) -> None:
    path = Path(shutil.copy(FOLDER / "graph_of_emfjson.json", tmp_path))
    model = graph(path)
    assert [edge.target.name for edge in model.Edge.all] == ["n2"]
    assert model.id_of(model.Node.all[0]) == "_n1"
    model.save()
    assert path.read_bytes() == (FOLDER / "graph_of_emfjson.json").read_bytes()
    model.Node.all[0].weight = 7
    model.save()
    assert '\n    "name": "root"' in path.read_text()
    assert (graph(path).Node.all[0].weight, graph(path).id_of(model.Edge.all[0])) == (7, "_e")


def test_files_of_both_forms_refer_to_each_other(tmp_path: Path) -> None:
    shutil.copy(SPLIT / "ok.xmi", tmp_path / "nodes.xmi")
    graph(tmp_path / "nodes.xmi").save(tmp_path / "nodes.json")
    for name in ("edges.json", "more.xmi"):
        s = Session()
        nodes = s.open_model(tmp_path / "nodes.xmi", metamodel=SPLIT / "g.ecore")
        edges = EmfModel((), s.metamodel(SPLIT / "g.ecore"), path=tmp_path / name)
        edges.create("Edge", name="far", target=nodes.Node.all[1])
        edges.save()
    assert json.loads((tmp_path / "edges.json").read_text())["target"]["$ref"] == "nodes.xmi#//@groups.0/@nodes.1"
    (tmp_path / "more.xmi").write_text((tmp_path / "more.xmi").read_text().replace("nodes.xmi#", "nodes.json#"))
    for name in ("edges.json", "more.xmi"):
        assert graph(tmp_path / name).Edge.all[0].target.name == "n2"


def test_a_reference_to_what_is_not_there_stays(tmp_path: Path) -> None:
    text = {"eClass": "http://example.org/g#//Edge", "target": {"$ref": "gone.json#//@groups.0"}}
    (tmp_path / "m.json").write_text(json.dumps(text))
    model = graph(tmp_path / "m.json")
    assert [finding.rule for finding in model.findings] == ["RS609"]
    model.Edge.all[0].name = "e"
    model.save()
    assert json.loads((tmp_path / "m.json").read_text())["target"]["$ref"] == "gone.json#//@groups.0"


def test_simple_functions_and_commands_take_json(tmp_path: Path) -> None:
    migration = pytest.importorskip("robosmi.metamodels.migration")
    save_model(migration.Option(label='half \ud83d "x"', score=float("inf")), tmp_path / "option.json")
    assert (load_model(tmp_path / "option.json").label, open_model(tmp_path / "option.json").Option.all[0].score) == (
        'half \ud83d "x"',
        float("inf"),
    )
    done = run("query", FOLDER / "graph_of_emfjson.json", "Node.all.name", "--metamodel", SPLIT / "g.ecore", "--json")
    assert done.result == {"value": ["n1", "n2"]}


# --- faults


@pytest.mark.parametrize(
    "path", [FOLDER / "illegal.json", FOLDER.parent / "yaml_models" / "illegal.yaml"], ids=lambda p: p.suffix
)
def test_a_value_that_its_type_does_not_take_is_a_finding_and_stays_in_the_file(path: Path, tmp_path: Path) -> None:
    """As in XMI; the lines are those of the keys."""
    copy = Path(shutil.copy(path, tmp_path))
    model = EmfModel.load(copy, kitchen())
    lines = [7, 8, 9] if path.suffix == ".json" else [5, 6, 7]
    assert [(each.rule, each.location and each.location.line) for each in model.findings] == [("RS610", line) for line in lines]
    first, second = model.all_of_kind("Item")
    assert ([*first.nums], [*first.three], second.d) == ([1, 3], [], 1.5)
    model.save()
    assert copy.read_bytes() == path.read_bytes()
    first.i = 2
    model.save()
    text = copy.read_text()
    assert ("heavy" in text, "two" in text, text.count("12345678901")) == (False, True, 2)
    first.nums.append(9)
    model.save(tmp_path / "other.json")
    assert json.loads((tmp_path / "other.json").read_text())["items"] == [
        {"name": "a", "i": 2, "nums": [1, 3, 9], "three": [12345678901, True]},
        {"name": "b", "kind": "gamma", "d": 1.5, "i": 12345678901},
    ]
    model.save(tmp_path / "other.xmi")
    assert [each.rule for each in model.findings] == ["RS610", "RS610", "RS610", "RS612"]
    with pytest.raises(ModelError, match="no whole number"):
        EmfModel.load(copy, kitchen(), strict=True)


BAD = {
    "duplicate_key": 4, "duplicate_key_inside": 7, "cut_off": 4, "comma_at_the_end": 3, "comment": 2, "not_a_number": 3,
    "no_class": 1, "list_of_numbers": 1, "unknown_class": 2, "unknown_namespace": 2, "metamodel": 2, "abstract_root": 2,
    "unknown_feature": 3, "unknown_class_inside": 5, "wrong_class_inside": 5, "no_whole_number": 3, "too_big": 3,
    "list_for_one": 3, "one_for_many": 3, "object_for_value": 3, "text_for_element": 3, "reference_without_ref": 3,
    "more_beside_ref": 10,
}  # fmt: skip
"""Files that a strict read refuses -> the line of the fault."""


def test_every_bad_file_is_listed() -> None:
    assert {path.stem for path in (FOLDER / "bad").glob("*.json")} == set(BAD)


@pytest.mark.parametrize("name", BAD)
def test_a_fault_has_its_place_and_what_to_do(name: str) -> None:
    with pytest.raises(RobosmiError) as caught:
        EmfModel.load(FOLDER / "bad" / f"{name}.json", SPLIT / "g.ecore", strict=True)
    assert caught.value.location is not None
    assert (caught.value.location.line, Path(caught.value.location.path).stem) == (BAD[name], name)
    assert caught.value.fix


@pytest.mark.parametrize("levels", [MOST_LEVELS + 1, 10_000])
def test_a_deep_text_is_refused_where_it_is_too_deep(levels: int, tmp_path: Path) -> None:
    (tmp_path / "deep.json").write_text("[\n" * levels + "]" * levels)
    done = run("query", tmp_path / "deep.json", "1", "--metamodel", SPLIT / "g.ecore", "--json")
    (finding,) = done.document["findings"]
    assert (done.code, finding["location"]["line"]) == (3, MOST_LEVELS + 1)
    assert str(MOST_LEVELS) in finding["message"]
    assert "XMI" in finding["fix"]


def test_a_deep_model_is_not_written_as_json_that_nobody_reads(tmp_path: Path) -> None:
    sections = Metamodel.load(LIBRARY / "library.ecore").Section
    root = inner = sections(name="0")
    fits = MOST_LEVELS // 2 - 1  # each a list and an object
    for number in range(fits):
        inner.sections.append(sections(name=str(number)))
        inner = inner.sections[0]
    model = EmfModel(root)
    model.save(tmp_path / "m.json")
    assert len(EmfModel.load(tmp_path / "m.json", model.metamodel).Section.all) == fits + 1
    before = (tmp_path / "m.json").read_bytes()
    inner.sections.append(sections(name="one more"))
    with pytest.raises(ModelError) as caught:
        model.save(tmp_path / "m.json")
    assert caught.value.fix
    assert (tmp_path / "m.json").read_bytes() == before


def test_a_metamodel_is_not_written_as_json(tmp_path: Path) -> None:
    model = EmfModel.load(SPLIT / "g.ecore")
    with pytest.raises(ModelError, match="metamodel"):
        model.save(tmp_path / "g.json")
    assert not (tmp_path / "g.json").exists()


# --- JSON itself


@pytest.mark.parametrize(
    "text", ["{}", "[]", "[[],{}]", ' {"a": [1, -2.5e3, true, null, "x\\n\\u00e9"], "b": {"c": {}}} ', '"x"']
)
def test_what_json_says_is_what_pythons_reader_says(text: str) -> None:
    def plain(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: plain(each) for key, each in value.items()}
        if isinstance(value, list):
            return [plain(each) for each in value]
        return json.loads(value) if isinstance(value, NumberText) else value

    assert plain(located_json(text.encode())) == json.loads(text)


def test_values_have_their_lines() -> None:
    value = located_json(b'\xef\xbb\xbf{\r\n"a": 1,\r\n"b":\r\n{}}')
    assert isinstance(value, LocatedObject)
    inner = value["b"]
    assert isinstance(inner, LocatedObject)
    assert (value.lines, inner.line) == ({"a": 2, "b": 3}, 4)


NO_JSON = ["", "{", "[1,]", '{"a"}', '{"a":}', "[1 2]", "[01]", "[1.]", "nul", "[}", "{]", "1 2", '"\n"', '"\\x"', "[,1]", "{,}"]


@pytest.mark.parametrize("text", [*NO_JSON, "{'a': 1}", '{"a": 1]', "[1}", "[NaN]", '{"a": 1, "a": 1}'])
def test_what_is_no_json_is_refused(text: str) -> None:
    with pytest.raises(JsonError):
        located_json(text.encode())
    with pytest.raises(JsonError):
        located_json(b"\xff" + text.encode())
