"""The metamodel with everything that can go wrong in XMI (`tests/emf/kitchen.ecore`), for the tests of reader and writer."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from pyecore.resources import URI, ResourceSet

from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.ecore.metamodels import Metamodels
from robosmi.model.xmi.xmi_reader import read_documents
from robosmi.model.xmi.xmi_writer import to_xmi

FOLDER = Path(__file__).parent / "xmi"
KITCHEN = Path(__file__).parents[1] / "emf" / "kitchen.ecore"
BENCH = KITCHEN.with_name("bench.ecore")


@cache
def kitchen(loader: str = "own", path: Path = KITCHEN) -> Metamodels:
    """The metamodel, with our own classes or with those that pyecore's own resource makes."""
    if loader == "own":
        return Metamodel.load(path)
    return Metamodels(ResourceSet().get_resource(URI(str(path))).contents)


def classes(metamodels: Metamodels) -> dict[str, Any]:
    """Class name -> the factory of its elements, sub-packages included."""
    found: dict[str, Any] = {}
    for uri in metamodels.uris():
        package: Any = metamodels.get(uri)
        found |= {c.name: getattr(c, "python_class", c) for c in package.eClassifiers}
    return found


def saved(roots: Any, path: Path) -> bytes:
    """Write a model to a file; returns the bytes."""
    data = to_xmi({path.name: roots})[path.name]
    path.write_bytes(data)
    return data


def again(path: Path, metamodels: Metamodels) -> bytes:
    """Read a file and write it again; returns the bytes."""
    document = next(iter(read_documents(path, metamodels).values()))
    return to_xmi({path.name: document.roots})[path.name]
