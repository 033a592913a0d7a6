"""An .ecore file with several EPackages is a metamodel and a model, as in EMF; other roots beside them are refused by name."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from robosmi.cli.main import main
from robosmi.errors import SourceError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.model.session import Session
from robosmi.query import ModelView

TWO = Path(__file__).parent / "several" / "two.ecore"
"""It is compared with what EMF writes by `test_ecore_again`."""
REFUSED = Path(__file__).parent / "several_refused"


def test_it_is_a_metamodel_of_all_its_packages(tmp_path: Path) -> None:
    metamodel = Metamodel.load(TWO)
    model = ModelView(EmfModel((), metamodel, "M"))
    house = model.House(name="h", people=[model.Person(name="p")])
    house.people[0].owns = house
    EmfModel(house).save(tmp_path / "h.xmi")
    read = EmfModel.load(tmp_path / "h.xmi", metamodel).roots[0]
    assert read.people[0].owns is read


def test_it_is_a_model_with_several_roots_that_is_written_as_it_was(tmp_path: Path) -> None:
    model = EmfModel.load(TWO)
    assert [root.name for root in model.roots] == ["house", "people"]
    assert [one.name for one in model.EClass.all] == ["House", "Person"]
    shutil.copy(TWO, tmp_path)
    model.save(tmp_path / "two.ecore")
    assert (tmp_path / "two.ecore").read_text() == TWO.read_text()
    with_session = Session().open_model(TWO)
    assert len(with_session.EPackage.all) == 2


def test_commands_take_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["query", str(TWO), "EPackage.all.name", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["result"]["value"] == ["house", "people"]
    assert main(["check", str(TWO)]) == 0


@pytest.mark.parametrize(
    ("name", "line", "root"), [("class_first", 4, "EClass"), ("class_second", 7, "EClass"), ("model_beside", 7, "A")]
)
def test_another_root_beside_packages_is_told(name: str, line: int, root: str) -> None:
    path = REFUSED / f"{name}.ecore"
    for read in (Metamodel.load, EmfModel.load):
        with pytest.raises(SourceError, match=f"the root '{root}' is no EPackage") as told:
            read(path)
        assert told.value.location is not None
        assert told.value.location.line == line
        assert told.value.fix == "keep EPackages alone in an .ecore file, and other elements in files of their own"


def test_a_package_behind_elements_of_a_model_is_told() -> None:
    with pytest.raises(SourceError, match="the root 'EPackage' is Ecore's, beside roots of another metamodel") as told:
        EmfModel.load(REFUSED / "model_first.xmi", Metamodel.load(TWO))
    assert "model_first.xmi:4" in str(told.value)
