"""The generated packages and the README are what the .ecore files say, and Eclipse EMF accepts the files."""

from __future__ import annotations

import importlib
import subprocess
from pathlib import Path

import pytest
from pyecore.resources import URI, ResourceSet

from robosmi.model.diagram import documentation, readme
from robosmi.model.ecore.metamodels import BUILT_IN
from robosmi.model.generator.codegen import render
from tests.tools import require_tools

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "metamodels"
JARS = [Path(f"/usr/share/java/{name}.jar") for name in ("eclipse-emf-common", "eclipse-emf-ecore", "eclipse-emf-ecore-xmi")]


def test_the_built_in_metamodels_are_the_ecore_files() -> None:
    assert {path.stem for path in FOLDER.glob("*.ecore")} == set(BUILT_IN)


@pytest.mark.parametrize("name", BUILT_IN)
def test_a_generated_package_is_what_the_ecore_file_gives(name: str) -> None:
    made = render([FOLDER / f"{name}.ecore"]).files[f"{name}/__init__.py"]
    assert made == (FOLDER / name / "__init__.py").read_bytes(), "run: make metamodels"


def test_no_name_of_ours_is_escaped_and_nothing_is_left_out() -> None:
    assert render(sorted(FOLDER.glob("*.ecore"))).findings == []


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
    package = importlib.import_module(f"robosmi.metamodels.{name}")
    used = {f.name for c in package.eClassifiers.values() for f in getattr(getattr(c, "eClass", c), "eStructuralFeatures", ())}
    assert used
    assert used & {"file", "type", "from", "class", "import", "in", "eClass"} == set()


def test_emf_accepts_the_five_metamodels() -> None:
    require_tools("java", "javac")
    if missing := [jar.name for jar in JARS if not jar.exists()]:
        pytest.skip(f"not installed: {', '.join(missing)} (Debian: libeclipse-emf-*-java)")
    command: list[str | Path] = ["sh", ROOT / "tests" / "emf" / "check.sh", *(FOLDER / f"{name}.ecore" for name in BUILT_IN)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "OK metamodel\n"
