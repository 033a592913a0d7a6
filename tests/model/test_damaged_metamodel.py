"""What is wrong in a metamodel is told by `robosmi check`, and where it is used as the metamodel's fault."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi import check_model
from robosmi.errors import ModelError
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView

ECORE = Path(__file__).parent / "damaged" / "no_default.ecore"


def test_check_tells_a_default_that_is_no_value() -> None:
    (finding,) = check_model(ECORE).findings
    assert (finding.rule, finding.location and finding.location.line) == ("RS603", 5)


def test_check_tells_two_features_of_one_name_and_a_class_as_an_attributes_type(tmp_path: Path) -> None:
    damaged = tmp_path / "box.ecore"
    more = '<eStructuralFeatures xsi:type="ecore:EAttribute" name="width" eType="#//Box"/></eClassifiers>'
    damaged.write_text(ECORE.read_text(encoding="utf-8").replace("</eClassifiers>", more), encoding="utf-8")
    with pytest.raises(ModelError) as refused:
        check_model(damaged)
    assert "has two features 'width'" in str(refused.value)
    assert "the attribute 'damaged.Box.width' has the class 'Box'" in str(refused.value)


def test_a_default_that_is_no_value_is_the_metamodels_fault() -> None:
    box = ModelView(EmfModel((), ECORE, "D")).Box()
    with pytest.raises(ModelError, match="the default value 'none' of 'width' is no value of EDouble") as refused:
        _ = box.width
    assert "defaultValueLiteral" in str(refused.value.fix)
