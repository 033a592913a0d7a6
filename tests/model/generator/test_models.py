"""Models of generated classes as files: names, texts and values are the metamodel's, and Eclipse EMF and pyecore read them.

Each builder makes a model of one case; what is written is read again with the generated package and with the dynamic one.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest
from pyecore.resources import URI, ResourceSet

from robosmi.generate.packages import generate_packages
from robosmi.model import save_model
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.datatypes import default
from robosmi.model.emf import EmfModel
from robosmi.model.strict_package import EStringToStringMapEntry
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.emf_judge import judge

CASES = Path(__file__).parent / "cases"


def doors(made: Any) -> Any:
    """An element whose features have names that every element needs for itself."""
    inner = [made.Door(delete_=True), made.Door()]
    return made.Door(delete_=True, notify_="n", self_="s", cls_="c", listeners_=3, eContents_=inner)


def paints(made: Any) -> Any:
    """Elements with literals whose texts differ from their names."""
    colours = made.Colour
    return made.Paint(colour=colours.value_, other=colours.mro_, all=[colours.red, colours.value_, colours.name_])


def shadows(made: Any) -> Any:
    """An element whose features are named like types."""
    return made.Node(str="a", int=1, second="b", third=2, bool=True, EAttribute="c", Kind=made.Kind.ClassVar)


def packages(made: Any) -> Any:
    """An element of a class that inherits from other packages."""
    return made.Top(state=made.right.State.on, top=made.Top())


def leaves(made: Any) -> Any:
    """An element of a sub-package."""
    return made.left.Leaf()


def accounts(made: Any) -> Any:
    """Data types of Java classes."""
    return made.Account(money=Decimal("2.50"), truth=True, id="x", needed="n", three=[1, 1], maybe=False, real=2.5)


def pairs(made: Any) -> Any:
    """Ecore's own pairs of texts, and types of XML Schema."""
    model = made.Any(uri="u", count=7, details=[EStringToStringMapEntry(key="k", value="v")])
    model.element = model
    return model


BUILDERS = [
    ("reserved/reserved.ecore", "reserved", doors),
    ("enumerations/enumerations.ecore", "enumerations", paints),
    ("shadows/shadows.ecore", "shadows", shadows),
    ("circles/root.ecore", "root", packages),
    ("circles/root.ecore", "root", leaves),
    ("data_types/data.ecore", "data", accounts),
    ("known_types/known.ecore", "known", pairs),
]


@pytest.fixture(params=BUILDERS, ids=[build.__name__ for _, _, build in BUILDERS])
def case(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[Path, Any, Path]]:
    """A metamodel, its generated package, and a file with a model."""
    source, name, build = request.param
    generate_packages([CASES / source], tmp_path / "written")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    made = importlib.import_module(f"written.{name}")
    builder: Callable[[Any], Any] = build
    model = builder(made)
    if name == "root":
        model.top = None  # a reference to an element in no file
    save_model(model, tmp_path / "model.xmi")
    yield CASES / source, made, tmp_path / "model.xmi"
    for loaded in [n for n in sys.modules if n.split(".")[0] == "written"]:
        del sys.modules[loaded]


def test_a_model_of_generated_classes_is_read_again_by_both_kinds_of_classes(case: tuple[Path, Any, Path]) -> None:
    metamodel, made, file = case
    for known in (Metamodel([made]), Metamodel.load(metamodel)):
        model = EmfModel.load(file, known)
        again = file.with_name("again.xmi")
        model.save(again)
        assert again.read_bytes() == file.read_bytes()
        generated = type(model.roots[0]).__module__.startswith("written.")
        assert generated == (known.packages[0] is made)


def test_a_generated_package_is_written_as_a_metamodel(case: tuple[Path, Any, Path]) -> None:
    metamodel, made, file = case
    path = file.with_name(metamodel.name)
    path.write_bytes(to_xmi({path.name: made})[path.name])
    before, after = (Metamodel.load(source) for source in (metamodel, path))
    assert described(after) == described(before)


def described(metamodel: Metamodel) -> list[tuple[Any, ...]]:
    """The features of a metamodel with the properties that a model depends on."""
    features = [(path, f) for path, c in metamodel.classifiers() for f in getattr(c, "eStructuralFeatures", ())]
    return [
        (path, f.name, f.eType.name, f.lowerBound, f.upperBound, f.is_attribute and str(default(f, f.eType)))
        for path, f in features
    ]


def test_emf_takes_a_model_of_generated_classes(case: tuple[Path, Any, Path]) -> None:
    metamodel, _, file = case
    assert judge([metamodel], file).saved == file.read_bytes()


def test_pyecore_reads_a_model_of_generated_classes(case: tuple[Path, Any, Path]) -> None:
    _, made, file = case
    if made.name in ("enumerations", "known"):
        pytest.skip("pyecore's resource knows no texts of literals, and has pairs of texts as dicts")
    resources = ResourceSet()
    resources.metamodel_registry |= {made.nsURI: made} | {inner.nsURI: inner for inner in made.eSubpackages}
    resource = resources.get_resource(URI(str(file)))
    root = resource.contents[0]
    assert type(root).__module__.startswith(made.__name__)
    assert {f.name for f in root._isset} == {f.name for f in EmfModel.load(file, Metamodel([made])).roots[0]._isset}
