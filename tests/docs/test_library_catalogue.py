"""The example of a foreign metamodel, docs/examples/library_catalogue: its chain does what its README says, in under 150 lines.

What must come out is told from the input files by the standard library's XML and CSV readers, not by RoboSMi; some pages are
kept as files. Real EMF judges the models that the chain writes.
"""

from __future__ import annotations

import ast
import csv
import re
import shutil
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from robosmi.chain import ChainResult, read_chain
from robosmi.chain.reading import function
from robosmi.diagnostics import Location
from robosmi.errors import RobosmiError
from robosmi.metamodels import trace
from robosmi.model.emf import EmfModel
from robosmi.model.metamodel import Metamodel
from robosmi.model.opening import open_model
from robosmi.query import ModelView
from robosmi.transform import Trace
from robosmi.validate import EVL
from tests.emf_judge import judge, judge_same
from tests.running import run as command, tree

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "docs" / "examples" / "library_catalogue"
EXPECTED = Path(__file__).parent / "library_catalogue" / "expected"
STEPS = ["load old", "load opening", "to_version_2", "constraints", "to_website", "pages"]


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A copy of the example's folder."""
    shutil.copytree(EXAMPLE, tmp_path / "catalogue", ignore=shutil.ignore_patterns("__pycache__", "build", "out", ".robosmi"))
    return tmp_path / "catalogue"


def run(place: Path, **options: Any) -> ChainResult:
    return read_chain(place / "chain.toml").run(**options)


def replace(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def elements(path: Path, tag: str) -> list[ElementTree.Element]:
    return list(ElementTree.parse(path).getroot().iter(tag))


def at(references: str | None) -> list[int]:
    """The positions in `//@items.0 //@items.4`."""
    return [int(number) for number in re.findall(r"\.(\d+)(?: |$)", references or "")]


def test_it_is_short_and_stands_on_nothing_of_the_project() -> None:
    code = [*EXAMPLE.glob("*.py"), *EXAMPLE.glob("*.toml")]
    assert len(code) == 5
    assert sum(len(path.read_text(encoding="utf-8").splitlines()) for path in code) < 150
    imported = {
        name
        for path in EXAMPLE.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, (ast.Import, ast.ImportFrom))
        for name in ([a.name for a in node.names] if isinstance(node, ast.Import) else [node.module])
    }
    assert imported == {"robosmi.validate"}
    assert not re.search(r"robo(?!smi)|arduino|propeller|pin\b", "".join(p.read_text() for p in code), re.IGNORECASE)


def test_the_run_is_the_one_of_the_readme(place: Path) -> None:
    outcome = command("run", place / "chain.toml")
    assert outcome.code == 0
    shown = re.search(r"\$ robosmi run chain\.toml\n(.*?)```", (place / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    assert shown is not None
    told = re.sub(r" +[\d.]+ ms", "", outcome.out.replace(f"{place}/", ""))
    assert [line.split() for line in told.splitlines()] == [line.split() for line in shown[1].splitlines()]
    for name in re.findall(r"\]\(([^)]*)\)", (place / "README.md").read_text(encoding="utf-8")):
        assert (EXAMPLE / name).exists(), name


def test_the_migrated_catalogue_has_what_the_old_one_had(place: Path) -> None:
    run(place)
    old, new = place / "catalogue.xmi", place / "build" / "catalogue.xmi"
    for tag in ("title", "year", "isbn", "issue"):
        assert [x.get(tag) for x in elements(new, "items")] == [x.get(tag) for x in elements(old, "items")]
    assert [x.get("name") for x in elements(new, "authors")] == [x.get("name") for x in elements(old, "writers")]
    assert [at(x.get("authors")) for x in elements(new, "items")] == [at(x.get("writers")) for x in elements(old, "items")]
    kind = "{http://www.w3.org/2001/XMLSchema-instance}type"
    renamed = [str(x.get(kind)).replace("Journal", "Magazine") for x in elements(old, "items")]
    assert [x.get(kind) for x in elements(new, "items")] == renamed
    genres = [x.get("genre", "computing") if "Book" in str(x.get(kind)) else None for x in elements(old, "items")]
    assert [x.findtext("genre") for x in elements(new, "items")] == genres
    lent = [[at(loan.get("item"))[0] for loan in x.iter("loans")] for x in elements(new, "members")]
    assert lent == [at(x.get("borrowed")) for x in elements(old, "members")]
    assert "shelf" not in new.read_text(encoding="utf-8")


def test_emf_reads_all_models(place: Path) -> None:
    run(place)
    metamodels = place / "metamodels"
    judge([metamodels / "catalogue1.ecore"], place / "catalogue.xmi")
    judge_same([metamodels / "catalogue2.ecore"], place / "build" / "catalogue.xmi")
    judge_same([metamodels / "website.ecore"], place / "build" / "website.xmi")
    both = [metamodels / "catalogue2.ecore", metamodels / "website.ecore"]
    judge([ROOT / "metamodels" / "trace.ecore", *both], place / "build" / "trace.xmi")


def test_the_trace_says_which_page_is_whose(place: Path) -> None:
    run(place)
    metamodels = Metamodel.load(place / "metamodels" / "catalogue2.ecore", place / "metamodels" / "website.ecore")
    stored = EmfModel.load(place / "build" / "trace.xmi", [trace, *metamodels.packages])
    links = Trace.of_model(stored.roots[0])
    pages = {link.targets[0].title: link.rule for link in links if link.rule.endswith("2Page")}
    items = {
        x.get("title"): "Magazine2Page" if x.get("issue") else "Book2Page" for x in elements(place / "catalogue.xmi", "items")
    }
    asked = {n for x in elements(place / "catalogue.xmi", "items") for n in at(x.get("writers"))}
    authors = {x.get("name"): "Author2Page" for n, x in enumerate(elements(place / "catalogue.xmi", "writers")) if n in asked}
    assert pages == items | authors
    assert all(links.origins(t)[0].eClass.name in link.rule for link in links for t in link.targets)


def test_the_pages(place: Path) -> None:
    run(place)
    out = place / "out"
    for path in EXPECTED.rglob("*.html"):
        name = path.relative_to(EXPECTED)
        assert (out / name).read_text(encoding="utf-8") == path.read_text(encoding="utf-8"), name
    items = elements(place / "catalogue.xmi", "items")
    writers = [str(x.get("name")) for x in elements(place / "catalogue.xmi", "writers")]
    lent = {n for x in elements(place / "catalogue.xmi", "members") for n in at(x.get("borrowed"))}
    pages = {
        re.findall("<h1>(.*)</h1>", p.read_text(encoding="utf-8"))[0]: p for p in out.glob("*.html") if p.name != "index.html"
    }
    assert set(pages) == {x.get("title") for x in items}
    for number, item in enumerate(items):
        text = pages[str(item.get("title"))].read_text(encoding="utf-8")
        assert re.findall("by <a[^>]*>(.*)</a>", text) == [writers[n] for n in at(item.get("writers"))]
        assert ("on loan" in text) == (number in lent)
        assert ("on the shelf" in text) != (number in lent)
    for page in out.rglob("*.html"):
        for link in re.findall('href="([^"]*)"', page.read_text(encoding="utf-8")):
            assert (page.parent / link).is_file(), f"{page.name}: {link}"
    assert not (out / "authors" / "christopher-alexander.html").exists(), "no item asks for him"
    with (place / "hours.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            assert f"<p>{row['day']} {row['opens']}-{row['closes']}</p>" in (out / "index.html").read_text(encoding="utf-8")


def test_a_second_run_writes_nothing(place: Path) -> None:
    assert [(r.step.name, r.state) for r in run(place).steps] == [(name, "done") for name in STEPS]
    before, times = tree(place), {p: p.stat().st_mtime_ns for p in place.rglob("*")}
    assert [r.state for r in run(place).steps] == ["up to date"] * 6
    assert tree(place) == before
    assert {p: p.stat().st_mtime_ns for p in place.rglob("*")} == times
    assert run(place, force=True)["pages"].written == []
    assert tree(place) == before


def test_a_dry_run_shows_what_would_change_and_writes_nothing(place: Path) -> None:
    run(place)
    replace(place / "hours.csv", "18:00", "19:00")
    before = tree(place)
    diff = run(place, dry_run=True).diff()
    assert tree(place) == before
    assert [line for line in diff.splitlines() if line.startswith("+<")] == [
        "+<p>Monday 10:00-19:00</p>", "+<p>Tuesday 10:00-19:00</p>",
    ]  # fmt: skip


@pytest.mark.parametrize("keep", [True, False])
def test_a_review_survives_a_new_title(keep: bool, place: Path) -> None:
    """The region's id is the page's, which is the ISBN; without `keep` regions are all that survives."""
    run(place, keep=keep)
    page = place / "out" / "9780131103627.html"
    replace(page, "<p>No review yet.</p>", "<p>Read it twice – já!</p>")
    replace(place / "catalogue.xmi", "The C Programming Language", "C &amp; UNIX")
    run(place, keep=keep)
    text = page.read_text(encoding="utf-8")
    assert "<p>Read it twice – já!</p>" in text
    assert "No review yet" not in text
    assert "<h1>C &amp; UNIX</h1>" in text


@pytest.mark.parametrize(
    ("file", "old", "new", "line", "cause"),
    [
        ("catalogue.xmi", 'year="1994"', 'year="long ago"', 4, "Book.year: 'long ago' is no whole number"),
        ("catalogue.xmi", '<writers name="Erich', '<writer name="Erich', 9, "no feature 'writer' (did you mean 'writers'?)"),
        ("catalogue.xmi", "//@writers.3", "//@writers.33", 4, "Book.writers: '//@writers.33' leads to nothing"),
        ("catalogue.xmi", 'name="Reading Room">', 'name="Reading Room>', 4, "not well-formed XML"),
        ("catalogue.xmi", "catalogue/1", "catalogue/3", 2, "belongs to no metamodel known here"),
        ("metamodels/catalogue1.ecore", 'eType="#//Writer"', 'eType="#//Writers"', 7, "#//Writers"),
    ],
)  # fmt: skip
def test_an_input_that_cannot_be_read_stops_before_anything_is_written(
    file: str, old: str, new: str, line: int, cause: str, place: Path
) -> None:
    replace(place / file, old, new)
    before = tree(place)
    with pytest.raises(RobosmiError) as raised:
        run(place)
    assert cause in raised.value.message
    where = raised.value.location
    assert where is not None
    assert (where.path, where.line) == (str(place / file), line)
    assert raised.value.fix
    assert tree(place) == before


@pytest.mark.parametrize(
    ("old", "new", "rule", "message", "fix"),
    [
        ('title="Byte"', 'title=""', "HasTitle", "the item //@items.4 has no title", "call it Untitled"),
        ("633610", "633611", "CheckDigit", "Design Patterns: the check digit of 9780201633611 is wrong", "make it 9780201633610"),
        ("9780201633610", "020163361X", "Isbn", "Design Patterns: 020163361X is no ISBN of 13 digits", None),
    ],
)  # fmt: skip
def test_a_catalogue_that_breaks_a_constraint_makes_no_website(
    old: str, new: str, rule: str, message: str, fix: str | None, place: Path
) -> None:
    replace(place / "catalogue.xmi", old, new)
    result = run(place)
    assert [r.state for r in result.steps] == ["done", "done", "done", "failed", "not run", "not run"]
    error = next(f for f in result.findings if f.severity.name == "error")
    assert (error.rule, error.message, error.fix) == (rule, message, fix)
    assert str(error.location) == str(place / "build" / "catalogue.xmi")
    assert not (place / "out").exists()
    assert [p.name for p in (place / "build").iterdir()] == ["catalogue.xmi"]
    assert command("run", place / "chain.toml").code == 1
    replace(place / "catalogue.xmi", new, old)
    assert run(place)["pages"].state == "done"


def test_the_fixes_mend_what_they_say(place: Path) -> None:
    replace(place / "catalogue.xmi", ' title="Byte"', "")
    replace(place / "catalogue.xmi", "9780201633610", "9780201633611")
    run(place)
    catalogue = ModelView(
        EmfModel.load(place / "build" / "catalogue.xmi", place / "metamodels" / "catalogue2.ecore", "catalogue")
    )
    opening = ModelView(open_model(place / "hours.csv", name="opening"))
    v = EVL(catalogue, opening)
    function("constraints.py:constraints", place, Location("here"))(v, catalogue, opening)
    result = v.run(fix="first")
    assert [(done.title, done.error) for done in result.fixed] == [("call it Untitled", None), ("make it 9780201633610", None)]
    again = v.run()
    assert again
    assert {f.name for f in again.unsatisfied} == {"HasAuthor", "HasItem"}
