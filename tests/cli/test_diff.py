"""`robosmi diff`: exit code, document and text."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.running import run

SPLIT = Path(__file__).parents[1] / "model" / "split"


@pytest.fixture
def edited(tmp_path: Path) -> Path:
    path = tmp_path / "edited.xmi"
    path.write_text((SPLIT / "ok.xmi").read_text().replace('name="n1" weight="1"', 'name="n1" weight="5"'))
    return path


def test_equal_models_end_with_0(edited: Path) -> None:
    done = run("diff", SPLIT / "ok.xmi", SPLIT / "ok.xmi", "--metamodel", SPLIT / "g.ecore", "--json")
    assert (done.code, done.document["ok"], done.result) == (0, True, {"equal": True, "changes": []})
    assert run("diff", SPLIT / "ok.xmi", SPLIT / "ok.xmi", "--metamodel", SPLIT / "g.ecore").out == "no difference\n"


def test_a_difference_ends_with_1(edited: Path) -> None:
    done = run("diff", SPLIT / "ok.xmi", edited, "--metamodel", SPLIT / "g.ecore", "--json")
    assert (done.code, done.document["ok"]) == (1, False)
    (change,) = done.result["changes"]
    assert set(change) >= {"kind", "element", "type", "feature", "before", "after"}
    assert (change["kind"], change["element"], change["feature"], change["before"], change["after"]) == (
        "changed", "//@groups.0/@nodes.0", "weight", 1, 5,
    )  # fmt: skip
    text = run("diff", SPLIT / "ok.xmi", edited, "--metamodel", SPLIT / "g.ecore")
    assert (text.code, text.err) == (1, "")
    assert "weight 1 -> 5" in text.out


def test_contents_of_what_was_added_are_counted(tmp_path: Path) -> None:
    text = (SPLIT / "ok.xmi").read_text()
    (tmp_path / "b.xmi").write_text(
        text.replace("</g:Graph>", '<groups name="b"><nodes name="x"/><nodes name="y"/></groups></g:Graph>')
    )
    done = run("diff", SPLIT / "ok.xmi", tmp_path / "b.xmi", "--metamodel", SPLIT / "g.ecore")
    assert done.out == "added Group b //@groups.1: / groups[1] (with 2 elements)\n"


def test_models_that_cannot_be_compared_are_an_error(tmp_path: Path) -> None:
    (tmp_path / "rows.csv").write_text("a,b\n1,2\n")
    for words in ((tmp_path / "rows.csv", tmp_path / "rows.csv"), (SPLIT / "g.ecore", tmp_path / "gone.ecore")):
        done = run("diff", *words, "--json")
        assert done.code == 3
        (finding,) = done.document["findings"]
        assert finding["fix"]
        assert finding["location"]


def test_the_page_has_a_row_for_each_difference_and_its_texts_stay_texts(edited: Path, tmp_path: Path) -> None:
    edited.write_text(edited.read_text().replace('name="n2"', 'name="&lt;script&gt;"'))
    page = tmp_path / "diff.html"
    done = run("diff", SPLIT / "ok.xmi", edited, "--metamodel", SPLIT / "g.ecore", "-o", page, "--json")
    assert (done.code, done.document["artifacts"]) == (1, [{"path": str(page), "kind": "page"}])
    text = page.read_text()
    assert text.count("<tr data-kind=") == len(done.result["changes"]) == 2
    assert "<script>" not in text
    assert "<td>&lt;script&gt;</td>" in text
    page.write_text("mine")
    done = run("diff", SPLIT / "ok.xmi", edited, "--metamodel", SPLIT / "g.ecore", "-o", page, "--json")
    assert done.code not in (0, 1)
    assert page.read_text() == "mine"


def test_two_migrations_differ_in_board_choices_and_program(tmp_path: Path) -> None:
    (tmp_path / "lamp.c").write_text('#include "simpletools.h"\nint main() { high(3); }\n')
    for name, target, pin in (("a", "uno", "D4"), ("b", "mega", "D5")):
        done = run("migrate", tmp_path / "lamp.c", "--target", target, "--bind", f"P3={pin}", "-o", tmp_path / name)
        assert done.code == 0
    same = run("diff", tmp_path / "a", tmp_path / "a")
    assert (same.code, same.out) == (0, "no difference\n")
    done = run("diff", tmp_path / "a", tmp_path / "b", "--json")
    assert done.code == 1
    assert done.result["board"] == ["Arduino Uno", "Arduino Mega 2560"]
    assert done.result["choices"] == {"port:P3": ["D4", "D5"]}
    assert "-  high(4);" in done.result["diff"]
    assert "+  high(5);" in done.result["diff"]
    assert run("diff", tmp_path / "a", tmp_path / "b", "-o", tmp_path / "x.html").code == 2
    for folders, other in ((("a", "."), "."), (("gone", "a"), "gone")):
        refused = run("diff", *(tmp_path / name for name in folders))
        assert refused.code == 2
        assert f"{tmp_path / other} is no output folder" in refused.err
