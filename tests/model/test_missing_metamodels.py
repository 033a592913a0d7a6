"""Metamodels that refer to files that are not there: they and their models are read, as in EMF, and nothing of them is lost."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.model import Session
from robosmi.model.ecore.ecore_loader import MetamodelError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.model.generator.codegen import render
from robosmi.model.xmi.xmi_writer import to_xmi

FOLDER = Path(__file__).parent / "missing"


@pytest.mark.emf_objects("neighbours that are not there")
def test_a_metamodel_with_missing_neighbours_is_read_with_a_finding_and_written_with_its_references(tmp_path: Path) -> None:
    text = (FOLDER / "m.ecore").read_text()
    opposite = text.replace('containment="true"/>', 'containment="true" eOpposite="gone/base.ecore#//Part/owner"/>', 1)
    (tmp_path / "opposite.ecore").write_text(opposite)
    for path in (FOLDER / "m.ecore", tmp_path / "opposite.ecore"):
        mm = Metamodel.load(path)
        (finding,) = mm.findings
        assert (finding.rule, finding.location and finding.location.line) == ("RS609", 4)
        assert "'gone/base.ecore'" in finding.message
        assert to_xmi({"m.ecore": mm.epackages})["m.ecore"].decode() == path.read_text()
        model = EmfModel.load(path)
        assert [each.name for each in model.all_of_kind("EClass")] == ["M"]
        with pytest.raises(MetamodelError, match="not there"):
            render([path])
    model.save(tmp_path / "copy.ecore")
    model.save(tmp_path.parent / "moved.ecore")
    assert f'eSuperTypes="{tmp_path.name}/gone/base.ecore#//Named"' in (tmp_path.parent / "moved.ecore").read_text()


@pytest.mark.emf_objects("its metamodel has neighbours that are not there")
@pytest.mark.parametrize("name", ["m.xmi", "m.json"])
def test_what_may_belong_to_a_missing_supertype_stays_in_the_file(name: str, tmp_path: Path) -> None:
    for each in ("m.ecore", name):
        shutil.copy(FOLDER / each, tmp_path)
    model = Session().open_model(tmp_path / name, metamodel=tmp_path / "m.ecore")
    assert isinstance(model, EmfModel)
    assert {finding.rule for finding in model.findings} <= {"RS609", "RS610"}
    before = (tmp_path / name).read_text()
    assert model.to_bytes().decode() == before
    (root,) = model.roots
    assert (root.size, len(root.ms)) == (3, 1)
    root.size = 77
    model.save()
    after = (tmp_path / name).read_text()
    assert all(word in after for word in ("red", "77", "tags", "label", "name"))
    if name.endswith(".xmi"):
        assert after == before.replace('size="3"', 'size="77"')


def test_a_neighbour_elsewhere_in_the_given_folder_is_found_by_its_name(tmp_path: Path) -> None:
    text = (FOLDER / "m.ecore").read_text()
    for place, name in (("y/one/model", "m"), ("x/two/model", "base"), ("x/old/model", "base")):
        (tmp_path / place).mkdir(parents=True)
        new = (FOLDER / "elsewhere" / "base.ecore").read_text().replace("example.org/base", f"example.org/{place}")
        new = text.replace("gone/base.ecore", "platform:/plugin/two/model/base.ecore") if name == "m" else new
        (tmp_path / place / f"{name}.ecore").write_text(new)
    (tmp_path / "x" / "a_project_called.ecore").mkdir()
    mm = Metamodel.load(tmp_path)
    assert mm.findings == []
    assert [each.ePackage.nsURI for each in mm.M.eClass.eSuperTypes] == ["http://example.org/x/two/model"]


def test_a_root_that_its_metamodel_does_not_have_is_told_apart_from_an_unknown_namespace(tmp_path: Path) -> None:
    """Archi's files have `<archimate:model>`, a name that an annotation of the class says; EMF refuses it, too."""
    (tmp_path / "m.xmi").write_text('<m:model xmlns:m="http://example.org/m"/>')
    with pytest.raises(SourceError, match=r"'model' of the namespace .* is of no class of its metamodel") as caught:
        EmfModel.load(tmp_path / "m.xmi", FOLDER / "m.ecore")
    assert "version" in str(caught.value.fix)
