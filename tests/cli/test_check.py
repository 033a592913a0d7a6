"""`robosmi check`: plans, drawings and other models, severities, exit codes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.cli.main import main
from robosmi.metamodels import migration
from robosmi.model import load_model, save_model
from robosmi.plugins import registry
from robosmi.transformations.chains.stages.models import load_models
from robosmi.validate import EVL


def run(*arguments: str | Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, Any]]:
    code = main([*map(str, arguments), "--json"])
    return code, json.loads(capsys.readouterr().out)


@pytest.fixture(scope="module")
def sketch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A migrated line follower."""
    out = tmp_path_factory.mktemp("sketch") / "out"
    source = Path(__file__).parents[2] / "docs" / "examples" / "line_follower" / "line_follower.c"
    robosmi.migrate([source], out)
    return out


@pytest.mark.parametrize("place", ["models/plan.xmi", "."])
def test_a_plan_is_checked_with_its_models(place: str, sketch: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, document = run("check", sketch / place, capsys=capsys)
    assert code == 0
    assert document["ok"] is True
    assert [m["model"] for m in document["result"]["models"]] == ["plan", "code", "hardware", "platform"]
    assert all(m["elements"] for m in document["result"]["models"])
    assert [f["rule"] for f in document["findings"] if f["severity"] == "error"] == []


def test_a_plan_that_a_person_broke_fails(sketch: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = sketch / "models" / "plan.xmi"
    models = load_models(path)
    first, second = models.plan.portBindings[:2]
    second.connection, second.pin = None, first.pin
    models.plan.portBindings[0].confidence = 7.0
    models.plan.portBindings[2].name = second.name
    for name, data in models.to_files().items():
        (tmp_path / name).parent.mkdir(exist_ok=True, parents=True)
        (tmp_path / name).write_bytes(data)
    code, document = run("check", tmp_path / "plan.xmi", capsys=capsys)
    assert code == 1
    assert {"RS702", "RS705", "RS714"} <= {f["rule"] for f in document["findings"]}
    assert all(f["element"].startswith("plan!") for f in document["findings"] if f["rule"] in ("RS702", "RS705"))
    assert run("check", tmp_path / "plan.xmi", "--fail-on", "never", capsys=capsys)[0] == 0
    (tmp_path / "robosmi.toml").write_text('[severity]\nRS702 = "info"\nRS714 = "info"\n', encoding="utf-8")
    code, document = run("check", tmp_path / "plan.xmi", capsys=capsys)
    assert {f["severity"] for f in document["findings"] if f["rule"] == "RS702"} == {"info"}
    assert code == 0
    assert run("check", tmp_path / "plan.xmi", "--fail-on", "warning", capsys=capsys)[0] == 1


def test_a_drawing_is_checked(examples: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (drawing,) = (examples / "line_follower").glob("*.fz*")
    code, document = run("check", drawing, capsys=capsys)
    assert code == 0
    assert document["result"]["models"][0]["constraints"] > 0


def test_a_pin_table_is_checked_for_a_target(sketch: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = tmp_path / "pins.csv"
    table.write_text("pin,part,title,connector\nD5,XBee,radio,DIN\n")
    code, document = run("check", table, "--target", "uno", capsys=capsys)
    assert code == 0
    assert {f["rule"] for f in document["findings"]} == {"RS255"}, "5 V at a part that bears 3.6 V"
    code, document = run("check", table, "--target", "pico", capsys=capsys)
    assert code == 0
    assert document["findings"] == [], "D5 of a Pico is GP5, which has 3.3 V"
    assert run("check", table, "--target", "unno", capsys=capsys)[0] == 2
    assert run("check", sketch, "--target", "uno", capsys=capsys)[0] == 2


def test_a_model_without_constraints_says_so(sketch: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(sketch / "models" / "platform.xmi")]) == 0
    assert "no constraints for this model" in capsys.readouterr().out


def test_what_cannot_be_read_is_exit_code_3(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("check", tmp_path / "no.xmi", capsys=capsys)[0] == 3
    (tmp_path / "x.xmi").write_text("<a/>", encoding="utf-8")
    code, document = run("check", tmp_path / "x.xmi", capsys=capsys)
    assert code == 3
    assert document["ok"] is False


def test_the_python_function_gives_the_same(sketch: Path) -> None:
    done = robosmi.check_model(sketch / "models" / "plan.xmi")
    result: Any = done.result
    assert result["models"][0]["model"] == "plan"


def test_checking_writes_nothing(sketch: Path) -> None:
    before = {p: p.read_bytes() for p in sketch.rglob("*") if p.is_file()}
    robosmi.check_model(sketch / "models" / "plan.xmi")
    assert {p: p.read_bytes() for p in sketch.rglob("*") if p.is_file()} == before
    assert isinstance(load_model(sketch / "models" / "plan.xmi"), migration.MigrationPlan)
    assert callable(save_model)


ECORE = """<?xml version="1.0" encoding="UTF-8"?>
<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
    xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="shelf" nsURI="http://nowhere/shelf" nsPrefix="shelf">
  <eClassifiers xsi:type="ecore:EClass" name="Shelf"/>
</ecore:EPackage>
"""


def test_a_model_of_a_metamodel_of_ones_own_is_checked_with_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "shelf.ecore").write_text(ECORE)
    model = tmp_path / "x.xmi"
    model.write_text('<s:Shelf xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:s="http://nowhere/shelf"/>')
    for words in (["check", str(model)], ["query", str(model), "1"]):
        assert main(words) == 3
        assert (
            "give its metamodel (--metamodel X.ecore in a command, Metamodel.load('X.ecore') in Python)"
            in capsys.readouterr().err
        )
    shelves = EVL()

    @shelves.context("Shelf").critique(id="SH1")
    def HasBooks(shelf: Any) -> bool:
        return False

    monkeypatch.setitem(registry().entries["constraints"], "shelf", "tests.cli.test_check:shelves")
    monkeypatch.setattr("tests.cli.test_check.shelves", shelves, raising=False)
    code, document = run("check", model, "--metamodel", tmp_path / "shelf.ecore", capsys=capsys)
    assert code == 0
    assert document["result"]["models"] == [{"model": "x", "elements": 1, "constraints": 1}]
    assert [f["rule"] for f in document["findings"]] == ["SH1"]


def test_a_model_of_several_metamodels_is_checked_with_all_of_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    names = {"shelf": "Shelf", "book": "Book"}
    for name, kind in names.items():
        (tmp_path / f"{name}.ecore").write_text(ECORE.replace("shelf", name).replace('"Shelf"', f'"{kind}"'))
    model = tmp_path / "x.xmi"
    roots = "".join(f'<{name}:{kind} xmlns:{name}="http://nowhere/{name}"/>' for name, kind in names.items())
    model.write_text(f'<xmi:XMI xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI">{roots}</xmi:XMI>')
    both = [word for name in names for word in ("--metamodel", tmp_path / f"{name}.ecore")]
    code, document = run("check", model, *both, capsys=capsys)
    assert code == 0, document["findings"]
    assert document["result"]["models"] == [{"model": "x", "elements": 2, "constraints": 0}]
    code, document = run("check", model, *both[:2], capsys=capsys)
    said = [(finding["rule"], finding["severity"]) for finding in document["findings"]]
    assert (code, said) == (1, [("RS610", "error")])  # as in Eclipse EMF
    code, document = run("query", model, "Shelf.all.size()", *both[:2], capsys=capsys)
    said = [(finding["rule"], finding["severity"]) for finding in document["findings"]]
    assert (code, document["result"]["value"], said) == (0, 1, [("RS610", "warning")])


ODD = """<?xml version="1.0" encoding="UTF-8"?>
<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
    xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="odd" nsURI="http://nowhere/odd" nsPrefix="odd">
  <eClassifiers xsi:type="ecore:EClass" name="A">
    <eStructuralFeatures xsi:type="ecore:EReference" name="bs" upperBound="-1" eType="#//B" containmnt="true" eOpposite="#//B/a"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="cs" lowerBound="3" upperBound="2" eType="#//B" eOpposite="#//C/a"/>
  </eClassifiers>
  <eClassifiers xsi:type="ecore:EClass" name="B">
    <eStructuralFeatures xsi:type="ecore:EReference" name="a" eType="#//A"/>
  </eClassifiers>
  <eClassifiers xsi:type="ecore:EClass" name="C">
    <eStructuralFeatures xsi:type="ecore:EReference" name="a" eType="#//A" eOpposite="#//A/cs"/>
  </eClassifiers>
</ecore:EPackage>
"""


def test_what_is_odd_in_a_metamodel_is_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "odd.ecore").write_text(ODD)
    _, document = run("check", tmp_path / "odd.ecore", capsys=capsys)
    found = [(f["location"]["line"], f["message"]) for f in document["findings"] if f["rule"] == "RS607"]
    assert found == [
        (5, "'containmnt' is no attribute of an EReference (did you mean 'containment'?): it is read over"),
        (5, "'odd.A.bs' names 'odd.B.a' as its opposite, which names none"),
        (6, "'odd.A.cs' has at least 3 values and at most 2: no model has both"),
        (6, "'odd.A.cs' has the type 'odd.B', and its opposite 'odd.C.a' is a feature of another class"),
    ]


def test_a_sound_metamodel_is_said_to_be_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "shelf.ecore").write_text(ECORE)
    assert main(["check", str(tmp_path / "shelf.ecore")]) == 0
    assert "the metamodel is correct (1 classes)" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["ccode", "hardware", "platform", "migration"])
def test_nothing_is_odd_in_the_built_in_metamodels(name: str) -> None:
    (path,) = (Path(__file__).parents[2] / "metamodels").rglob(f"{name}.ecore")
    assert [f.message for f in robosmi.check_model(path).findings if f.rule == "RS607"] == []


def test_a_model_in_json_is_no_drawing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    models = Path(__file__).parents[1] / "model" / "json_models" / "graph_of_emfjson.json"
    code, document = run("check", models, capsys=capsys)
    assert code == 3
    (finding,) = document["findings"]
    assert "http://example.org/g" in finding["message"]
    option = tmp_path / "option.json"
    save_model(migration.Option(label="x"), option)
    code, document = run("check", option, capsys=capsys)
    assert code == 0
    assert [each["elements"] for each in document["result"]["models"]] == [1]
    option.write_text('{"version": 1, "editor": "wokwi"}')
    code, document = run("check", option, capsys=capsys)
    assert code == 3
    assert "Wokwi" in document["findings"][0]["message"]
