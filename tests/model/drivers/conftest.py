"""The drivers under test: for each a folder of files, and what is known of the model in it."""

from __future__ import annotations

import io
import shutil
import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from robosmi.model.elements.driver import Model
from robosmi.model.opening import open_model

CASES = Path(__file__).parent / "cases"


def zipped(name: str, content: bytes) -> bytes:
    """An archive with one entry."""
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as archive:
        archive.writestr(name, content)
    return held.getvalue()


NO_DRAWING, HALF_A_DRAWING = zipped("readme.txt", b"<a/>"), zipped("shelf.fz", b"<half")


@dataclass(frozen=True)
class Driver:
    """One driver.

    Attributes:
        name: of its folder in `cases`.
        file: to open in it, empty for the folder itself.
        options: for `open_model`.
        kind: a type that has elements.
        feature, values: a feature of that type, and its values in the order of the extent.
        misspelt: (type, nearest), (feature, nearest).
        new: features of an element that is created.
        changed: a value that the feature can be set to.
        damaged: what a file of the kind may hold after an accident.
        only: the expression that finds the elements with the first value.
    """

    name: str
    file: str
    kind: str
    feature: str
    values: tuple[Any, ...]
    misspelt: tuple[tuple[str, str], tuple[str, str]]
    only: str
    new: dict[str, Any] = field(default_factory=dict)
    changed: Any = None
    options: dict[str, Any] = field(default_factory=dict)
    damaged: tuple[bytes, ...] = ()

    def copied(self, folder: Path) -> Path:
        """A copy of its files, to be changed; the file to open."""
        target = folder / self.name
        shutil.copytree(CASES / self.name, target)
        return target / self.file if self.file else target

    def opened(self, path: Path) -> Model:
        """The model in a file."""
        return open_model(path, name="M", **self.options)


DRIVERS = [
    Driver(
        "emf", "shelf.xmi", "Book", "name", ("Gears", "Zap", "Levers"), (("Boook", "Book"), ("nmae", "name")),
        "Book.all.select(lambda b: b.name == 'Gears')", {"name": "Nuts"}, "Bolts", {"metamodel": CASES / "emf" / "shelf.ecore"},
        (b"<half", b"<a/>", b"<!DOCTYPE a [<!ENTITY b \"c\">]><a/>"),
    ),
    Driver(
        "xml", "shelf.xml", "t_book", "a_title", ("Gears", "Levers", "Zap"), (("Elemnt", "Element"), ("title", "a_title")),
        "t_book.all.select(lambda b: b.a_title == 'Gears')", {"a_title": "Nuts"}, "Bolts",
        damaged=(b"<half", b"<a>", b"<a b='1' b='2'/>", b"<!DOCTYPE a [<!ENTITY b \"c\">]><a/>"),
    ),
    Driver(
        "archive", "shelf.fzz", "t_book", "a_title", ("Gears", "Levers", "Zap"), (("Elemnt", "Element"), ("title", "a_title")),
        "t_book.all.select(lambda b: b.a_title == 'Gears')", {"a_title": "Nuts"}, "Bolts",
        damaged=(b"", b"PK", b"PK\3\4half", b"<half", b"no archive", NO_DRAWING, HALF_A_DRAWING),
    ),
    Driver(
        "rows", "", "books", "title", ("Gears", "Levers", "Zap"), (("boks", "books"), ("titel", "title")),
        "books.all.select(lambda b: b.title == 'Gears')", {"title": "Nuts"}, "Bolts",
        damaged=(b"a,b\n\xff,1\n", b'a,b\n"1,2\n', b"a,b\n1,2,3\n", b"a,a\n", b"a,\n"),
    ),
    Driver(
        "program", "robot.c", "Call", "calleeName", ("clamp", "input", "high", "low", "pause"),
        (("Cal", "Call"), ("calleName", "calleeName")), "Call.all.select(lambda c: c.calleeName == 'clamp')",
        {"calleeName": "f"}, "g",
        damaged=(b"<html><body>",),  # a source of comments alone is C that compilers take
    ),
]  # fmt: skip


@pytest.fixture(params=DRIVERS, ids=lambda driver: driver.name)
def driver(request: pytest.FixtureRequest) -> Driver:
    """Each driver."""
    found: Driver = request.param
    return found


@pytest.fixture(params=[d for d in DRIVERS if d.name != "program"], ids=lambda driver: driver.name)
def changing(request: pytest.FixtureRequest) -> Driver:
    """Each driver whose models can be changed."""
    found: Driver = request.param
    return found


@pytest.fixture(params=[d for d in DRIVERS if d.name == "program"], ids=lambda driver: driver.name)
def fixed(request: pytest.FixtureRequest) -> Driver:
    """Each driver whose models cannot be changed."""
    found: Driver = request.param
    return found


def under_test(request: pytest.FixtureRequest) -> Driver:
    """The driver that the test asked for."""
    name = next(name for name in ("changing", "fixed", "driver") if name in request.fixturenames)
    found: Driver = request.getfixturevalue(name)
    return found


@pytest.fixture
def path(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A copy of the file of the driver under test."""
    return under_test(request).copied(tmp_path)


@pytest.fixture
def model(request: pytest.FixtureRequest, path: Path) -> Model:
    """The model of the driver under test."""
    return under_test(request).opened(path)
