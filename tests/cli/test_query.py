"""`robosmi query`: any driver's model, the value as JSON and as lines, further models, and mistakes."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import pytest

from tests.running import run

CASES = Path(__file__).parents[1] / "model" / "drivers" / "cases"
EMF = (CASES / "emf" / "shelf.xmi", "--metamodel", CASES / "emf" / "shelf.ecore")


@pytest.mark.parametrize(
    ("model", "expression", "value"),
    [
        (EMF, "Book.all.select(lambda b: b.pages > 50).name", ["Gears", "Levers"]),
        ((CASES / "xml" / "shelf.xml",), "t_book.all.i_pages.sum()", 258),
        ((CASES / "rows",), "books.all.select(lambda b: b.author == 'ada').title", ["Gears", "Zap"]),
        ((CASES / "rows" / "authors.csv",), "authors.all.Full_Name", ["Ada", 'Ben "B" Bolt, Jr.']),
        ((CASES / "program" / "robot.c",), "Call.all.select(lambda c: c.callee.definition).calleeName", ["clamp"]),
        ((CASES / "program" / "robot.c", "--driver", "c"), "If.all.size()", 2),
        ((CASES / "emf" / "shelf.ecore",), "EClass.all.select(lambda c: c.abstract).name", ["Named"]),
        ((CASES / "archive" / "shelf.fzz",), "t_book.all.i_pages.sum()", 258),
    ],
)
def test_the_value_of_an_expression_on_any_technology(model: tuple[object, ...], expression: str, value: object) -> None:
    path, *options = map(str, model)
    outcome = run("query", path, expression, *options, "--json")
    assert outcome.code == 0
    assert outcome.result == {"value": value}


def test_elements_are_given_by_type_id_and_name() -> None:
    outcome = run("query", EMF[0], "Comic.all", *EMF[1:], "--json")
    assert outcome.result["value"] == [{"type": "Comic", "id": "//@books.1", "name": "Zap"}]
    assert run("query", EMF[0], "Comic.all", *EMF[1:]).out == "Comic //@books.1 Zap\n"
    assert run("query", CASES / "program" / "robot.c", "While.all", "--json").result["value"] == [
        {"type": "While", "id": "//@units.0/@declarations.2/@body/@statements.1"}
    ]


def test_a_model_of_several_metamodels_is_told_all_of_them(tmp_path: Path) -> None:
    other = tmp_path / "other.ecore"
    other.write_text(
        '<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
        ' xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="other" nsURI="http://example.org/other" nsPrefix="o">'
        '<eClassifiers xsi:type="ecore:EClass" name="Lamp"/></ecore:EPackage>\n'
    )
    words = ["--metamodel", str(other), "--json"]
    assert run("query", EMF[0], "Book.all.size()", *EMF[1:], *words).result == {"value": 3}
    assert run("query", EMF[0], "Lamp.all.size()", *EMF[1:], *words).result == {"value": 0}


def test_further_models_are_called_by_their_names(tmp_path: Path) -> None:
    expression = "T.books.all.select(lambda row: row.title.is_in(Book.all.name))"
    assert run("query", EMF[0], expression, *EMF[1:], "--model", f"T={CASES / 'rows'}").code in (2, 3)
    expression = "T.books.all.select(lambda row: Book.all.name.includes(row.title)).title"
    outcome = run("query", EMF[0], expression, *EMF[1:], "--model", f"T={CASES / 'rows'}", "--json")
    assert outcome.result["value"] == ["Gears", "Levers", "Zap"]


def test_an_ecore_file_that_is_none_is_told_so(tmp_path: Path) -> None:
    (tmp_path / "half.ecore").write_text("<half", encoding="utf-8")
    outcome = run("query", tmp_path / "half.ecore", "EClass.all")
    assert outcome.code == 3
    assert "half.ecore:1" in outcome.err


def test_a_drawing_is_a_model_of_plain_xml(examples: Path, tmp_path: Path) -> None:
    packed = next((examples / "line_follower").glob("*.fzz"))
    outcome = run("query", packed, "t_instance.all.collect(lambda i: i.e_title).excluding(None).text", "--json")
    assert "Basic Servo1" in outcome.result["value"]
    with zipfile.ZipFile(next((examples / "line_follower").glob("*.fzz"))) as archive:
        archive.extractall(tmp_path)
    outcome = run(
        "query", next(tmp_path.glob("*.fz")), "t_instance.all.collect(lambda i: i.e_title).excluding(None).text", "--json"
    )
    assert "Basic Servo1" in outcome.result["value"]


def test_what_a_query_prints_does_not_disturb_the_document() -> None:
    outcome = run("query", EMF[0], "Book.all.collect(lambda b: println(b.name)).size()", *EMF[1:], "--json")
    assert outcome.result["value"] == 3
    assert outcome.err == "Gears\nZap\nLevers\n"
    assert json.loads(outcome.out)["ok"] is True


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        ((EMF[0], "__import__('os')", *EMF[1:]), 2, "may not use '__import__'"),
        ((EMF[0], "M.save('x')", *EMF[1:]), 3, "there is no type 'save'"),
        ((EMF[0], "Boook.all", *EMF[1:]), 2, "did you mean 'Book'"),
        ((EMF[0], "Book.all.nmae", *EMF[1:]), 3, "did you mean 'name'"),
        ((EMF[0], "Book.all"), 3, "no metamodel known here"),
        (("missing.xmi", "1"), 3, "missing.xmi"),
        ((EMF[0], "1", "--driver", "emff"), 2, "did you mean 'emf'"),
        ((CASES / "rows", "1", "--driver", "xml", "--metamodel", "x.ecore"), 2, "takes no metamodel"),
        ((EMF[0], "1", *EMF[1:], "--model", "rows"), 2, "not of the form NAME=VALUE"),
        ((EMF[0], "1", *EMF[1:], "--model", "Q=x.xml"), 2, "is not allowed"),
        ((Path(__file__), "1"), 3, "no driver takes a '.py' file"),
        ((EMF[0],), 2, "EXPRESSION"),
    ],
)
def test_a_mistake_is_said_with_what_to_do(words: tuple[object, ...], code: int, said: str) -> None:
    outcome = run("query", *map(str, words), "--json")
    assert outcome.code == code
    assert outcome.result is None
    assert said in outcome.err
    assert outcome.document["findings"][0]["fix"]
