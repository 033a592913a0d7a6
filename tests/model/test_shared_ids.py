"""Files in which several elements have one id: EMF reads them, and on save moves a book's author to the other book of that id."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import ModelError
from robosmi.model import Session, open_model
from robosmi.model.elements.driver import Model
from robosmi.model.emf import EmfModel

HERE = Path(__file__).parent
HALL, SHELF = HERE / "shared_ids" / "hall.xmi", HERE / "drivers" / "cases" / "emf" / "shelf.ecore"
OTHERWISE = pytest.mark.emf_writes_otherwise("EMF lets references by a shared id lead to the last element")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A copy of the model: two books have the id b1."""
    return Path(shutil.copy(HALL, tmp_path))


def facts(model: Model) -> list[tuple[str, object, object]]:
    """Each book with its author, and the newest one."""
    newest = model.Shelf.all[0].newest
    return [(book.name, book.author and book.author.name, book is newest) for book in model.Book.all]


@OTHERWISE
def test_they_are_read_with_a_finding_and_stay_as_they_are(file: Path) -> None:
    model = EmfModel.load(file, SHELF)
    assert facts(model) == [("Gears", "Ada", True), ("Zap", None, False), ("Last", None, False)]
    (finding,) = model.findings
    assert (finding.rule, finding.location and finding.location.line) == ("RS613", 5)
    assert finding.message == "the id 'b1' is used twice: references lead to the first element, in Eclipse EMF to the last"
    model.save()
    assert file.read_bytes() == HALL.read_bytes()
    with pytest.raises(ModelError, match=r"hall\.xmi:5: the id 'b1' is used twice"):
        open_model(file, metamodel=SHELF, strict=True)


@OTHERWISE
@pytest.mark.parametrize("name", ["hall.xmi", "new.xmi", "new.json", "new.yaml"])
def test_an_edit_leads_to_the_element_that_it_names_whatever_its_id(name: str, file: Path) -> None:
    model = Session().open_model(file, metamodel=SHELF)
    _, zap, last = model.Book.all
    model.Shelf.all[0].newest = zap
    last.name = "Levers"
    model.Author.all[0].books.append(last)
    model.save(file.with_name(name))
    again = EmfModel.load(file.with_name(name), SHELF)
    assert facts(again) == [("Gears", "Ada", False), ("Zap", None, True), ("Levers", "Ada", False)]
    assert [again.element("b1"), again.element("//@books.1")] == again.Book.all[:2]
    if name == "hall.xmi":
        lines = HALL.read_text(encoding="utf-8").splitlines()
        changed = set(file.read_text(encoding="utf-8").splitlines()) - set(lines)
        assert len(changed) == 3, "the two books of one id keep their lines"
    # another order: the id is the address of the book that is now the first
    again.delete(again.Book.all[0])
    again.save()
    assert facts(EmfModel.load(file.with_name(name), SHELF)) == [("Zap", None, True), ("Levers", "Ada", False)]


def test_an_id_that_a_program_gives_twice_is_refused(file: Path) -> None:
    model = EmfModel.load(file, SHELF)
    gears = model.Book.all[0]
    notes = [model.create("Note", key="n"), model.create("Note", key="n")]
    gears.notes.extend(notes)
    with pytest.raises(ModelError, match="has the id 'n', and so has"):
        model.save()
    assert file.read_bytes() == HALL.read_bytes()


@OTHERWISE
def test_models_are_matched_by_what_else_their_elements_have(file: Path) -> None:
    base, a, b = (Path(shutil.copy(file, file.with_name(f"{name}.xmi"))) for name in ("base", "a", "b"))
    a.write_text(a.read_text(encoding="utf-8").replace('name="Zap" pages="48"', 'name="Zap" pages="50"'), encoding="utf-8")
    b.write_text(b.read_text(encoding="utf-8").replace('pages="120"', 'pages="99"'), encoding="utf-8")
    changes = robosmi.compare(base, a, metamodel=SHELF).changes
    assert [(change.kind, change.feature, change.before, change.after) for change in changes] == [("changed", "pages", 48, 50)]
    merged = robosmi.merge(base, a, b, metamodel=SHELF)
    assert not merged.conflicts
    merged.model.save(file)
    assert [book.pages for book in EmfModel.load(file, SHELF).Book.all] == [99, 50, 48]
