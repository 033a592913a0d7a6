"""A stored trace to a metamodel refers to its elements by the metamodel's file; loaded, it refers to those of the session."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

from robosmi.chain import Chain
from robosmi.model import Session
from robosmi.query import ModelView
from robosmi.transform import ETL, Trace

OLDER = Path(__file__).parents[1] / "model" / "older"


def classes(t: ETL, house: ModelView, made: ModelView) -> None:
    """Make a package for the house, with a class for each door and a reference from each class to itself."""

    @t.rule(house.House, to=[made.EPackage])
    def House2Package(h: Any, p: Any) -> None:
        p.name, p.nsURI, p.nsPrefix = "made", "http://robosmi.org/test/made", "made"
        p.eClassifiers.extend(t.equivalent(door) for door in h.doors)

    @t.rule(house.Door, to=[made.EClass, made.EReference])
    def Door2Class(d: Any, c: Any, r: Any) -> None:
        c.name, r.name, r.eType = d.title, "itself", c
        c.eStructuralFeatures.append(r)


def test_a_trace_to_a_metamodel_has_one_notation_and_is_about_the_open_models(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(OLDER, tmp_path / "older"))
    chain = Chain(folder)
    chain.load("house", "house.xmi", metamodel="doors1.ecore")
    chain.transform(classes, models="house", makes="made", metamodel="ecore", file="made.ecore", trace="trace.xmi")
    chain.run()
    links = re.findall('<targets[^>]* href="([^"]*)"', (folder / "trace.xmi").read_text(encoding="utf-8"))
    assert links == [
        "made.ecore#/",
        "made.ecore#//front",
        "made.ecore#//front/itself",
        "made.ecore#//back",
        "made.ecore#//back/itself",
    ]

    session = Session()
    house = ModelView(session.open_model(folder / "house.xmi", metamodel=folder / "doors1.ecore"))
    made = ModelView(session.open_model(folder / "made.ecore"))
    trace = Trace.of_model(session.open_model(folder / "trace.xmi"))
    package, (front, back) = made.EPackage.all.first(), made.EClass.all
    assert trace.origins(package) == [house.House.all.first()]
    assert trace.origins(back.eStructuralFeatures[0]) == [house.Door.all[1]]
    assert trace.equivalents(house.Door.all[0])[0] is front
