"""A small model for tests of the generator: a library of books, some with ids, made anew for each test."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView

LIBRARY = Path(__file__).parents[1] / "epsilon" / "eol"


def library(name: str = "L") -> ModelView:
    """The library of the Epsilon cases: five books, one of them a comic, and a journal."""
    metamodel = Metamodel.load(LIBRARY / "library.ecore")
    return ModelView(EmfModel.load(LIBRARY / "library.xmi", metamodel, name))


def book(model: Any, name: str) -> Any:
    """The book of that name."""
    return next(b for b in model.Book.all if b.name == name)
