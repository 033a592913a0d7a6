"""Metamodels written again: EMF takes them, `eOpposite` is kept, and where pyecore read everything the bytes are EMF's own.

The metamodels are our own ones and those that lie in Debian's EMF jars, which are read where they are installed.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from pyecore import ecore
from pyecore.resources import URI, ResourceSet

from robosmi import resources
from robosmi.errors import ModelError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.emf_judge import JARS, ask, require_emf
from tests.model.kitchen import BENCH, KITCHEN

OWN = [KITCHEN, BENCH, *sorted(resources.built_in("metamodels").glob("*.ecore"))]


def emf_says(path: Path, tmp_path: Path, *options: str) -> bytes:
    """What EMF writes for a metamodel, which must be without a diagnostic."""
    require_emf()
    target = tmp_path / "emf.ecore"
    text, ok = ask(path, "--resave", target, *options)
    assert ok, text
    return target.read_bytes()


@pytest.mark.parametrize("path", OWN, ids=lambda p: p.stem)
def test_our_metamodels_come_out_as_emf_writes_them(path: Path, tmp_path: Path) -> None:
    together = ResourceSet()
    packages = {p.name: together.get_resource(URI(str(p))).contents[0] for p in OWN if p.parent == path.parent}
    data = to_xmi(packages, [path.name])[path.name]
    target = tmp_path / path.name
    target.write_bytes(data)
    for other in OWN:  # they refer to each other by their files
        if other.parent == path.parent and other != path:
            (tmp_path / other.name).write_bytes(other.read_bytes())
    assert data.count(b"eOpposite=") == path.read_bytes().count(b"eOpposite=")
    emf_says(target, tmp_path)
    assert data.decode() == emf_says(path, tmp_path).decode()


@pytest.mark.parametrize("path", [KITCHEN, BENCH], ids=lambda p: p.stem)
def test_packages_of_our_own_loader_are_taken_by_emf(path: Path, tmp_path: Path) -> None:
    package = Metamodel.load(path).epackages[0]
    target = tmp_path / path.name
    target.write_bytes(to_xmi({path.name: package})[path.name])
    emf_says(target, tmp_path)
    assert target.read_bytes().count(b"eOpposite=") == path.read_bytes().count(b"eOpposite=")


@pytest.mark.parametrize("name", ["Ecore.ecore", "XMLNamespace.ecore", "XMLType.ecore"])
def test_public_metamodels_keep_their_opposites(name: str, tmp_path: Path) -> None:
    require_emf()
    with zipfile.ZipFile(JARS[1]) as jar:
        source = tmp_path / name
        source.write_bytes(jar.read(f"model/{name}"))
    package = ResourceSet().get_resource(URI(str(source))).contents[0]
    data = to_xmi({name: package})[name]
    before, after = (text.count(b"eOpposite=") for text in (source.read_bytes(), data))
    assert before == after
    assert name != "Ecore.ecore" or before > 10
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / name).write_bytes(data)
    emf_says(tmp_path / "out" / name, tmp_path, "--no-validate")


def test_packages_that_refer_to_each_other_say_so_by_their_files(tmp_path: Path) -> None:
    first = ecore.EPackage("first", "http://lab/first", "first")
    second = ecore.EPackage("second", "http://lab/second", "second")
    base, derived = ecore.EClass("Base"), ecore.EClass("Derived")
    first.eClassifiers.append(base)
    second.eClassifiers.append(derived)
    derived.eSuperTypes.append(base)
    there = ecore.EReference("there", derived)
    back = ecore.EReference("back", base, eOpposite=there)
    base.eStructuralFeatures.append(there)
    derived.eStructuralFeatures.append(back)
    texts = to_xmi({"first.ecore": first, "sub/second.ecore": second})
    assert b'eSuperTypes="../first.ecore#//Base"' in texts["sub/second.ecore"]
    assert b'eType="ecore:EClass sub/second.ecore#//Derived"' in texts["first.ecore"]
    for name, data in texts.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(data)
    for name in texts:
        assert emf_says(tmp_path / name, tmp_path) == texts[name]
    alone = to_xmi({"second.ecore": second})["second.ecore"]
    assert b'eSuperTypes="http://lab/first#//Base"' in alone


def test_a_class_of_no_package_cannot_be_referred_to() -> None:
    package = ecore.EPackage("p", "http://lab/p", "p")
    cls = ecore.EClass("A")
    package.eClassifiers.append(cls)
    cls.eSuperTypes.append(ecore.EClass("Lost"))
    with pytest.raises(ModelError, match=r"<EClass.* refers by 'eSuperTypes' to .*Lost.* in no package"):
        to_xmi({"p.ecore": package})
