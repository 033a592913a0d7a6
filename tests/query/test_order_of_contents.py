"""What an element contains and a class inherits comes in EMF's order in each run, in Python, queries and templates."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from robosmi.generate import Gen
from robosmi.metamodels import trace
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements import ecore
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView, get
from robosmi.query.expression import evaluate

HERE = Path(__file__).parent / "contents"
CONTENTS = ["a1", "a2", "b1", "c1", "c2", "d1", "e1"]
EVERYTHING = ["a1", "a11", "a2", "b1", "c1", "c2", "c21", "d1", "e1"]
REFERENCES = ["a", "b", "c", "d", "e", "favourite", "newest"]
_ASKED = """
import sys
from robosmi.model.emf import EmfModel
from robosmi.query.expression import evaluate
models = [EmfModel.load(sys.argv[1] + "/shelf.xmi", sys.argv[1] + "/shelf.ecore", name="S")]
junk = [object() for _ in range(int(sys.argv[2]))]
print(list(evaluate(sys.argv[3], models)))
"""


def model() -> EmfModel:
    return EmfModel.load(HERE / "shelf.xmi", HERE / "shelf.ecore", name="S")


def names(elements: object) -> list[str]:
    assert isinstance(elements, list)
    return [str(element.name) for element in elements]


def test_in_python_an_element_gives_its_contents_in_the_order_of_its_class() -> None:
    shelf = ModelView(model()).Shelf.all.first()
    assert names(shelf.eContents) == CONTENTS
    assert names(shelf.eAllContents()) == EVERYTHING
    assert shelf.eContents.first().name == "a1"
    assert shelf.eContents.select(lambda x: x.name[0] == "c").name == ["c1", "c2"]
    assert shelf.eAllContents().size() == len(EVERYTHING)


def test_what_is_done_to_the_list_does_nothing_to_the_element() -> None:
    shelf = ModelView(model()).Shelf.all.first()
    shelf.eContents.clear()
    assert names(shelf.eContents) == CONTENTS


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        ("Shelf.all.first().eContents.collect(lambda x: x.name)", CONTENTS),
        ("Shelf.all.first().eAllContents().collect(lambda x: x.name)", EVERYTHING),
        ("Shelf.all.first().eContents.first().name", "a1"),
        ("Shelf.all.first().eClass.eAllReferences().collect(lambda r: r.name)", REFERENCES),
        ("Shelf.all.first().eClass.eAllStructuralFeatures().collect(lambda r: r.name)", ["name", *REFERENCES]),
        ("Shelf.all.first().eClass.eAllSuperTypes().collect(lambda r: r.name)", ["Named"]),
        ("Shelf.all.first().eClass.eContents.collect(lambda r: r.name)", REFERENCES),
        ("call(Shelf.all.first(), 'eCrossReferences').collect(lambda x: x.name)", ["a2", "b1"]),
    ],
)
def test_a_query_gives_one_order(asked: str, expected: object) -> None:
    assert evaluate(asked, [model()]) == expected


@pytest.mark.parametrize("asked", ["Shelf.all.first().eContents.name", "Shelf.all.first().eClass.eAllReferences().name"])
def test_each_process_gives_the_same(asked: str) -> None:
    given = {
        subprocess.run(
            [sys.executable, "-c", _ASKED, str(HERE), str(junk), asked],
            check=True, capture_output=True, text=True, env={**os.environ, "PYTHONHASHSEED": str(junk)},
        ).stdout
        for junk in (1, 77, 4001)
    }  # fmt: skip
    assert len(given) == 1


def test_a_template_gives_one_order(tmp_path: Path) -> None:
    text = "{% for x in s.eContents %}{{ x.name }} {% endfor %}{% for r in s.eClass.eAllReferences() %}{{ r.name }} {% endfor %}"
    made = model()
    generator = Gen(tmp_path, {"t": text + "{{ s.eContents.first().name }}"}, [made])
    generator.rule("Shelf", name="one", template="t", target="one.txt")(lambda s: None)
    generator.run()
    assert (tmp_path / "one.txt").read_text(encoding="utf-8").split() == [*CONTENTS, *REFERENCES, "a1"]


def test_classes_of_a_metamodel_answer_by_name_in_python() -> None:
    shelf = Metamodel.load(HERE / "shelf.ecore").find("Shelf")
    assert get(shelf, "eAllReferences").name == REFERENCES
    assert get(shelf, "eAllAttributes").name == ["name"]


def test_elements_of_classes_that_a_program_made_give_their_contents_in_order() -> None:
    box = ecore.EClass("Box")
    kinds = [ecore.EReference(name, box, upper=-1, containment=True) for name in ("first", "second", "third", "fourth")]
    box.eStructuralFeatures.extend(kinds)
    package = ecore.EPackage("boxes", "http://robosmi.org/test/boxes", "boxes")
    package.eClassifiers.append(box)
    B = ModelView(EmfModel((), Metamodel([package]), "B"))
    outer, held = B.Box(), [B.Box() for _ in kinds]
    for kind, one in reversed(list(zip(kinds, held, strict=True))):
        getattr(outer, kind.name).append(one)
    assert [id(x) for x in outer.eContents] == [id(x) for x in held]
    assert [id(x) for x in outer.eAllContents()] == [id(x) for x in held]


def test_generated_packages_give_the_order_too() -> None:
    link = trace.Trace(links=[trace.TraceLink(rule="r")])
    contents: Any = link.eContents  # a collection with EOL's operations
    assert contents.first() is link.links[0]
