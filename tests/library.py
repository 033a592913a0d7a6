"""The library model of the Epsilon cases, for tests of the mirrors: a model of one's own, loaded anew for each test."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView

EPSILON = Path(__file__).parent / "epsilon"
LIBRARY = Path(__file__).parent / "epsilon" / "eol"
"""Folder of library.ecore and library.xmi, which the EOL cases are about."""


def library(name: str = "L") -> Any:
    """The library."""
    metamodel = Metamodel.load(LIBRARY / "library.ecore")
    return ModelView(EmfModel.load(LIBRARY / "library.xmi", metamodel, name))


def empty(metamodel: str, name: str) -> Any:
    """An empty model of a metamodel of the cases (graph, prices, report)."""
    return ModelView(EmfModel((), Metamodel.load(EPSILON / "cases" / "models" / f"{metamodel}.ecore"), name))
