"""Both sides of an opposite agree after each change, as in EMF, and an element is never put into what it contains."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError
from robosmi.model import EmfModel, Metamodel, Session
from robosmi.query import ModelView

ECORE = """<?xml version="1.0" encoding="UTF-8"?>
<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
    xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="o" nsURI="http://example.org/o" nsPrefix="o">
  <eClassifiers xsi:type="ecore:EClass" name="N">
    <eStructuralFeatures xsi:type="ecore:EAttribute" name="name"
        eType="ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EString"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="owner" FORM eType="#//N" eOpposite="#//N/owned"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="owned" FORM upperBound="-1" eType="#//N" eOpposite="#//N/owner"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="left" eType="#//N" eOpposite="#//N/right"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="right" eType="#//N" eOpposite="#//N/left"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="parent" eType="#//N" eOpposite="#//N/kids"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="kids" containment="true" upperBound="-1" eType="#//N"
        eOpposite="#//N/parent"/>
    <eStructuralFeatures xsi:type="ecore:EReference" name="part" containment="true" eType="#//N"/>
  </eClassifiers>
</ecore:EPackage>
"""
XMI = """<?xml version="1.0" encoding="UTF-8"?>
<o:N xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:o="http://example.org/o" name="r">
  <kids name="a" owned="//@kids.2 //@kids.3" right="//@kids.1"/>
  <kids name="b" left="//@kids.0"/>
  <kids name="c" owner="//@kids.0"/>
  <kids name="d" owner="//@kids.0"/>
</o:N>
"""
FORMS = ["", 'ordered="false"', 'unique="false"', 'ordered="false" unique="false"']


def nodes(folder: Path, form: str, loaded: bool) -> tuple[EmfModel, dict[str, Any]]:
    """The model of `XMI`, read from a file or made anew, and its nodes by name."""
    (folder / "o.ecore").write_text(ECORE.replace("FORM", form))
    if loaded:
        (folder / "o.xmi").write_text(XMI)
        model = Session().open_model(folder / "o.xmi", metamodel=folder / "o.ecore")
        assert isinstance(model, EmfModel)
    else:
        model = EmfModel((), Metamodel.load(folder / "o.ecore"), "M")
    view = ModelView(model)
    if not loaded:
        root = view.N(name="r")
        root.kids.extend(view.N(name=name) for name in "abcd")
        a, b, c, d = root.kids
        c.owner = a
        a.owned.append(d)
        a.right = b
    return model, {node.name: node for node in view.N.all}


@pytest.fixture(params=[True, False], ids=["loaded", "new"])
def loaded(request: pytest.FixtureRequest) -> bool:
    return bool(request.param)


@pytest.mark.parametrize("form", FORMS)
def test_a_former_owner_lets_go(form: str, loaded: bool, tmp_path: Path) -> None:
    _, n = nodes(tmp_path, form, loaded)
    a, b, c, d = (n[name] for name in "abcd")
    c.owner = b
    assert (list(a.owned), list(b.owned)) == ([d], [c])
    c.owner = b
    assert list(b.owned) == [c]
    a.owned.append(c)
    assert (c.owner, list(a.owned), list(b.owned)) == (a, [d, c], [])
    b.owned.extend([c, d])
    assert (c.owner, d.owner, list(a.owned), list(b.owned)) == (b, b, [], [c, d])
    a.owned = [d]
    assert (c.owner, d.owner, list(a.owned), list(b.owned)) == (b, a, [d], [c])
    c.owner = None
    assert (c.owner, list(b.owned)) == (None, [])


def test_one_to_one_references_have_one_partner(loaded: bool, tmp_path: Path) -> None:
    _, n = nodes(tmp_path, "", loaded)
    a, b, c = (n[name] for name in "abc")
    c.right = b
    assert (a.right, b.left, c.right) == (None, c, b)
    a.left = b
    assert (b.right, b.left, a.left) == (a, c, b)
    d = n["d"]
    c.right = d
    assert (b.left, d.left) == (None, c)


def test_an_element_moves_by_its_container(loaded: bool, tmp_path: Path) -> None:
    model, n = nodes(tmp_path, "", loaded)
    r, a, b = n["r"], n["a"], n["b"]
    b.parent = a
    assert (b.parent, b.eContainer(), list(a.kids)) == (a, a, [b])
    assert [kid.name for kid in r.kids] == ["a", "c", "d"]
    a.part = b
    assert (b.parent, b.eContainer(), list(a.kids)) == (None, a, [])
    if loaded:
        model.save(tmp_path / "again.xmi")
        again = Session().open_model(tmp_path / "again.xmi", metamodel=tmp_path / "o.ecore")
        assert again.findings == []


@pytest.mark.parametrize("change", [
    lambda n: n["r"].kids.append(n["r"]), lambda n: n["a"].kids.append(n["r"]), lambda n: n["a"].kids.extend([n["r"]]),
    lambda n: n["a"].kids.insert(0, n["r"]), lambda n: setattr(n["r"], "parent", n["a"]),
    lambda n: setattr(n["r"], "part", n["r"]), lambda n: setattr(n["a"], "part", n["r"]),
])  # fmt: skip
def test_an_element_is_not_put_into_what_it_contains(change: Any, loaded: bool, tmp_path: Path) -> None:
    _, n = nodes(tmp_path, "", loaded)
    with pytest.raises(ModelError, match="cannot be put into"):
        change(n)
    assert [kid.name for kid in n["r"].kids] == ["a", "b", "c", "d"]
    assert (n["r"].eContainer(), list(n["a"].kids), n["a"].part, n["r"].parent) == (None, [], None, None)
