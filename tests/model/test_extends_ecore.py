"""Metamodels whose classes inherit from Ecore's own, as those of UML, OCL and Sirius do.

That the metamodel comes out as EMF writes it is judged in `test_ecore_again`. EMF itself makes elements of such classes only with
the Java code that is generated for them, so that our own reading judges the models.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from pyecore.ecore import EAnnotation, EModelElement, ENamedElement

from robosmi.errors import ModelError
from robosmi.model import EmfModel, Metamodel
from robosmi.model.session import Session
from tests.running import run

CASES = Path(__file__).parent / "extends_ecore"
LAB = CASES / "lab.ecore"
GENERATED = "EMF makes elements of such classes only with their generated Java code"


def test_the_file_is_a_model_of_ecore() -> None:
    done = run("query", LAB, "EClass.all.eSuperTypes.name", "--json")
    assert done.code == 0
    assert done.result["value"][:3] == [["EModelElement"], ["ENamedElement"], ["Part", "Plan"]]


def test_annotated_and_named_elements_have_ecores_features() -> None:
    lab = Metamodel.load(LAB)
    part = lab.Part(name="wheel", size=3)
    plan = lab.Plan(items=[part], eAnnotations=[EAnnotation("note")])
    assert isinstance(part, ENamedElement)
    assert (part.name, plan.getEAnnotation("note").eContainer()) == ("wheel", plan)
    assert not isinstance(lab, lab.Plan)
    with pytest.raises(ModelError, match="did you mean 'size'"):
        lab.Part(sice=3)


@pytest.mark.emf_objects(GENERATED)
def test_a_model_comes_out_as_it_was(tmp_path: Path) -> None:
    model = EmfModel.load(CASES / "plan.xmi", LAB)
    assert [part.name for part in model.all_of_kind("Part")] == ["wheel", "axle", "wheel"]
    inner = model.roots[0].first
    assert model.id_of(inner) == "//@items.1/@items.0"
    assert model.element("//@items.1/@items.0") is inner
    assert model.roots[0].eAnnotations[0].details == {"by": "A & B", "empty": "", "nothing": None}
    model.save(tmp_path / "plan.xmi")
    assert (tmp_path / "plan.xmi").read_bytes() == (CASES / "plan.xmi").read_bytes()


@pytest.mark.emf_objects(GENERATED)
def test_references_between_files_of_such_models(tmp_path: Path) -> None:
    session = Session()
    lab = Metamodel.load(LAB)
    part = lab.Part(name="wheel")
    models = {"parts.xmi": lab.Group(name="parts", items=[part]), "plan.xmi": lab.Plan(first=part)}
    for name, root in models.items():
        EmfModel([root], lab).save(tmp_path / name, {other: models[other] for other in models if other != name})
    assert '<first href="parts.xmi#//@items.0"/>' in (tmp_path / "plan.xmi").read_text(encoding="utf-8")
    again = session.open_model(tmp_path / "plan.xmi", metamodel=LAB)
    assert isinstance(again, EmfModel)
    assert again.roots[0].first.name == "wheel"


@pytest.mark.parametrize(
    ("name", "base"),
    [
        ("Variable", "ETypedElement"),
        ("TupleType", "EClass"),
        ("ListType", "EDataType"),
        ("Library", "EPackage"),
        ("Link", "EReference"),
    ],
)
def test_an_element_that_would_be_part_of_a_metamodel_is_refused(name: str, base: str) -> None:
    with pytest.raises(ModelError, match=f"{name} inherits from Ecore's {base}"):
        Metamodel.load(LAB).find(name).python_class()  # type: ignore[union-attr]


def test_a_model_with_such_an_element_is_refused_with_its_line() -> None:
    with pytest.raises(ModelError) as caught:
        EmfModel.load(CASES / "tuple.xmi", LAB)
    assert caught.value.location is not None
    assert (caught.value.location.line, "TupleType" in caught.value.message) == (3, True)
    assert "repair the file" not in (caught.value.fix or "")


def test_a_class_may_inherit_from_a_class_of_ecore_and_one_of_its_own() -> None:
    lab = Metamodel.load(LAB)
    group = lab.Group(name="axle", items=[lab.Part(name="wheel")])
    assert isinstance(group, EModelElement)
    assert [part.name for part in group.eContents] == ["wheel"]
