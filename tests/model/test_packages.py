"""The generated packages and the README are what the .ecore files say, and Eclipse EMF accepts the files."""

from __future__ import annotations

import importlib
import shutil
import subprocess
from pathlib import Path

import pytest
from pyecore.resources import URI, ResourceSet

from robosmi.errors import ModelError
from robosmi.model.codegen import documentation, generate
from robosmi.model.diagram import readme
from robosmi.model.metamodels import BUILT_IN, built_in
from tests.tools import require_tools

FOLDER = Path(__file__).parents[2] / "metamodels"
JARS = [Path(f"/usr/share/java/{name}.jar") for name in ("eclipse-emf-common", "eclipse-emf-ecore", "eclipse-emf-ecore-xmi")]
HEAD = (
    '<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
    'xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="farm" nsURI="http://example.org/farm" nsPrefix="farm">'
)


def test_the_built_in_metamodels_are_the_ecore_files() -> None:
    assert {path.stem for path in FOLDER.glob("*.ecore")} == set(BUILT_IN)


@pytest.mark.parametrize("name", BUILT_IN)
def test_a_generated_package_is_what_the_ecore_file_gives(name: str, tmp_path: Path) -> None:
    for source in FOLDER.glob("*.ecore"):
        shutil.copy(source, tmp_path)
    (made,) = generate(tmp_path / f"{name}.ecore", tmp_path / "made")
    assert made.read_bytes() == (FOLDER / name / "__init__.py").read_bytes(), "run: make metamodels"


def test_the_readme_of_the_metamodels_is_up_to_date() -> None:
    assert (FOLDER / "README.md").read_text(encoding="utf-8") == readme(), "run: make metamodels"


@pytest.mark.parametrize("name", BUILT_IN)
def test_every_class_and_feature_is_documented(name: str) -> None:
    package = importlib.import_module(f"robosmi.metamodels.{name}")
    root = ResourceSet().get_resource(URI(str(FOLDER / f"{name}.ecore"))).contents[0]
    assert root.nsURI == package.nsURI
    features = [f for c in root.eClassifiers for f in getattr(c, "eStructuralFeatures", ())]
    silent = [element.name for element in (root, *root.eClassifiers, *features) if not documentation(element)]
    assert silent == []


@pytest.mark.parametrize("name", BUILT_IN)
def test_features_avoid_the_names_that_break_in_python_or_java(name: str) -> None:
    package = built_in().get(f"http://robosmi.org/{name}/1")
    used = {f.name for c in package.eClassifiers.values() for f in getattr(getattr(c, "eClass", c), "eStructuralFeatures", ())}
    assert used
    assert used & {"file", "type", "from", "class", "import", "in", "eClass"} == set()


def test_emf_accepts_the_five_metamodels(shared: Path) -> None:
    require_tools("java", "javac")
    if missing := [jar.name for jar in JARS if not jar.exists()]:
        pytest.skip(f"not installed: {', '.join(missing)} (Debian: libeclipse-emf-*-java)")
    command: list[str | Path] = ["sh", shared / "emf" / "check.sh", *(FOLDER / f"{name}.ecore" for name in BUILT_IN)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "OK metamodel\n"


@pytest.mark.parametrize(
    ("classifiers", "said"),
    [
        ('<eClassifiers xsi:type="ecore:EClass" name="class"/>', "'class' cannot be a Python name"),
        ('<eClassifiers xsi:type="ecore:EClass" name="Old Cow"/>', "'Old Cow' cannot be a Python name"),
        (
            '<eClassifiers xsi:type="ecore:EClass" name="Cow"/><eClassifiers xsi:type="ecore:EClass" name="Cow"/>',
            "two classifiers 'Cow'",
        ),
    ],
)
def test_a_metamodel_that_python_cannot_say_is_refused(classifiers: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "farm.ecore").write_text(f"{HEAD}{classifiers}</ecore:EPackage>")
    with pytest.raises(ModelError, match=said):
        generate(tmp_path / "farm.ecore", tmp_path / "made")
    assert not (tmp_path / "made").exists()


def test_a_package_keeps_the_values_of_literals_and_bounds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (
        f'{HEAD}<eClassifiers xsi:type="ecore:EEnum" name="Sound"><eLiterals name="moo" value="3"/>'
        '<eLiterals name="baa" value="7"/></eClassifiers>'
        '<eClassifiers xsi:type="ecore:EClass" name="Cow">'
        '<eStructuralFeatures xsi:type="ecore:EAttribute" name="names" lowerBound="2" upperBound="4" eType="ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EString"/></eClassifiers></ecore:EPackage>'
    )
    (tmp_path / "farm.ecore").write_text(text)
    generate(tmp_path / "farm.ecore", tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    farm = importlib.import_module("farm")
    assert {literal.name: literal.value for literal in farm.Sound.eLiterals} == {"moo": 3, "baa": 7}
    assert (farm.Cow.names.lowerBound, farm.Cow.names.upperBound) == (2, 4)
