"""Chains: what is done when something changes, what a dry run shows, and what is wrong with a chain.

`site` is a chain over two technologies (XMI and CSV): loaded, validated, transformed, made into files.
"""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.chain import Chain, ChainResult, read_chain
from robosmi.chain.languages import DOES
from robosmi.errors import RobosmiError, RuleError, SourceError, StoppedError
from robosmi.metamodels import trace
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.transform import ETL, Trace
from tests.emf_judge import judge
from tests.running import run as command, tree

SITE = Path(__file__).parent / "site"
TRACE = Path(__file__).parents[2] / "metamodels" / "trace.ecore"
ALL = ["load library", "load prices", "constraints", "to_site", "pages"]


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A copy of the chain's folder."""
    shutil.copytree(SITE, tmp_path / "site", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path / "site"


def run(site: Path, **options: Any) -> ChainResult:
    return read_chain(site / "chain.toml").run(**options)


def done(result: ChainResult) -> list[str]:
    """The steps that were not up to date."""
    return [r.step.name for r in result.steps if r.state != "up to date"]


def replace(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_a_chain_is_done_once_and_then_up_to_date(site: Path) -> None:
    first = run(site)
    assert [r.step.name for r in first.steps] == ALL
    assert [r.state for r in first.steps] == ["done"] * 5
    assert all(r.seconds > 0 for r in first.steps)
    assert first.seconds >= sum(r.seconds for r in first.steps)
    assert sorted(p.name for p in (site / "out").glob("*.html")) == [
        "Ants.html",
        "Boards.html",
        "Propellers.html",
        "Zap.html",
        "index.html",
    ]
    assert "<b>8.25</b>" in (site / "out" / "Ants.html").read_text()
    before = tree(site)
    assert done(run(site)) == []
    assert tree(site) == before


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        ("library.xmi", 'name="Ants"', 'name="Wasps"', ["load library", "constraints", "to_site", "pages"]),
        ("library.xmi", 'year="1999"', 'year="1998"', ["load library", "constraints", "to_site"]),
        ("library.ecore", 'name="library"', 'name="library" ', ["load library", "constraints", "to_site"]),
        ("prices.csv", "8.25", "9", ["load prices", "to_site", "pages"]),
        ("templates/page.html", "<b>", "<i>", ["pages"]),
        ("site.ecore", 'name="site"', 'name="site" ', ["to_site", "pages"]),
        ("rules.py", "has no author", "lacks an author", ["constraints", "to_site", "pages"]),
        ("chain.toml", 'models = "site"', 'models = ["site"]', []),
        ("chain.toml", 'file = "build/site.xmi"', 'file = "site.xmi"', ["to_site"]),
    ],
)  # fmt: skip
def test_only_what_depends_on_a_change_is_done_again(file: str, old: str, new: str, expected: list[str], site: Path) -> None:
    """A step behind one that made the same again is not done: a year is not on the site."""
    run(site)
    replace(site / file, old, new)
    assert done(run(site)) == expected
    assert done(run(site)) == []


def test_a_missing_output_is_made_again(site: Path) -> None:
    run(site)
    (site / "out" / "Ants.html").unlink()
    assert done(run(site)) == ["pages"]
    (site / "build" / "site.xmi").unlink()
    assert done(run(site)) == ["to_site"]
    assert (site / "out" / "Ants.html").is_file()


def test_what_a_person_wrote_in_a_page_is_kept_and_said(site: Path) -> None:
    run(site)
    replace(site / "out" / "Ants.html", "<h1>", "<h1 class='mine'>")
    replace(site / "out" / "Ants.html", "nothing yet", "ants are small")
    replace(site / "prices.csv", "8.25", "9")
    result = run(site)
    text = (site / "out" / "Ants.html").read_text()
    assert "<h1 class='mine'>" in text
    assert "ants are small" in text
    assert "<b>9</b>" in text
    assert [f.rule for f in result.findings] == ["RS512"]
    assert result["pages"].written == ["out/.robosmi/pages.sha256", "out/.robosmi/pages/Ants.html", "out/Ants.html"]
    again = run(site)
    assert done(again) == []
    assert [f.rule for f in again.findings] == ["RS512"], "a step that is up to date says what it said"


def test_without_keep_the_engine_has_its_way(site: Path) -> None:
    run(site, keep=False)
    replace(site / "out" / "Ants.html", "<h1>", "<h1 class='mine'>")
    run(site, keep=False)
    assert "mine" not in (site / "out" / "Ants.html").read_text()


def test_a_model_that_a_person_changed_is_not_written_over(site: Path) -> None:
    run(site)
    replace(site / "build" / "site.xmi", "Ants", "Bugs")
    replace(site / "prices.csv", "8.25", "9")
    before = (site / "build" / "site.xmi").read_bytes()
    with pytest.raises(StoppedError, match=r"'build/site.xmi' was changed since the step 'to_site' made it") as stopped:
        run(site)
    assert stopped.value.fix
    assert (site / "build" / "site.xmi").read_bytes() == before


def test_force_makes_a_model_anew_that_a_person_changed_and_keeps_theirs_beside_it(site: Path) -> None:
    run(site)
    made = site / "build" / "site.xmi"
    replace(made, "Ants", "Bugs")
    theirs = made.read_bytes()
    before = tree(site)
    run(site, dry_run=True, force=True)
    assert tree(site) == before
    result = run(site, force=True)
    assert "Ants" in made.read_text()
    assert (site / "build" / "site.xmi.orig").read_bytes() == theirs
    assert [(f.rule, f.severity.name) for f in result["to_site"].findings] == [("RS531", "info")]
    assert "site.xmi.orig" in result["to_site"].findings[0].message
    replace(made, "Ants", "Wasps")
    run(site, force=True)
    assert "Wasps" in (site / "build" / "site.xmi.orig.2").read_text()
    assert (site / "build" / "site.xmi.orig").read_bytes() == theirs
    assert done(run(site)) == []


def test_a_dry_run_writes_nothing_and_shows_what_would_change(site: Path) -> None:
    before = tree(site)
    result = run(site, dry_run=True)
    assert tree(site) == before
    assert [r.state for r in result.steps] == ["would run"] * 5
    assert "+++ b/Ants.html" in result.diff()
    run(site)
    replace(site / "prices.csv", "8.25", "9")
    before = tree(site)
    result = run(site, dry_run=True)
    assert done(result) == ["load prices", "to_site", "pages"]
    assert "-<b>8.25</b>\n+<b>9</b>" in result.diff()
    assert tree(site) == before


def test_force_does_every_step(site: Path) -> None:
    run(site)
    result = run(site, force=True)
    assert done(result) == ALL
    assert result["pages"].written == []


def test_a_failed_validation_stops_the_steps_that_use_its_models(site: Path) -> None:
    replace(site / "rules.py", "len(b.authors) > 0", "len(b.authors) > 5")
    result = run(site)
    assert [r.state for r in result.steps] == ["done", "done", "failed", "not run", "not run"]
    assert [f.severity.name for f in result.findings] == ["error"] * 4
    assert not (site / "out").exists()
    assert [r.state for r in run(site).steps] == ["up to date", "up to date", "failed", "not run", "not run"]
    replace(site / "chain.toml", 'validate = "rules.py:constraints"', 'validate = "rules.py:constraints"\nstop_at = "never"')
    assert (run(site)["pages"].state) == "done"


FIXABLE = """
    @book.constraint
    def HasAuthor(b: Any) -> Any:
        write = lambda: b.authors.append(library.Author.all[0])
        return len(b.authors) > 0 or Fail(f"{b.name} has no author", Fix("take the first author", write))
"""


def _without_author(site: Path, fix: str = FIXABLE) -> None:
    """The chain with a book that has no author, and a fix for that."""
    text = (site / "rules.py").read_text()
    start, stop = text.index("    @book.constraint"), text.index("    @book.critique")
    (site / "rules.py").write_text(text[:start] + fix.strip("\n") + "\n\n" + text[stop:])
    replace(site / "rules.py", "import EVL, Fail", "import EVL, Fail, Fix")
    model = EmfModel.load(site / "library.xmi", site / "library.ecore")
    next(b for b in model.all_contents() if getattr(b, "name", "") == "Ants").authors.clear()
    model.save()


def test_a_run_performs_fixes_and_stores_the_models_that_they_change(site: Path) -> None:
    _without_author(site)
    assert run(site)["constraints"].state == "failed"
    before = tree(site)
    assert run(site, dry_run=True, fix="first")["constraints"].state == "failed"
    assert tree(site) == before
    result = run(site, fix="first")
    assert result["constraints"].fixed == ["library!Book //@sections.1/@items.0: take the first author"]
    assert result["constraints"].written == ["library.xmi"]
    assert [r.state for r in result.steps if r.step.kind != "load"] == ["done", "done", "done"]
    book = EmfModel.load(site / "library.xmi", site / "library.ecore").element("//@sections.1/@items.0")
    assert book is not None
    assert len(book.authors) == 1
    judge([site / "library.ecore"], site / "library.xmi")
    before = tree(site)
    assert done(run(site, fix="first")) == []
    assert tree(site) == before


RULES = """
from robosmi.validate import EVL, Fail, Fix

def rules(v, m):
    @v.context("Graph").constraint
    def HasAName(g):
        return g.name != "plain" or Fail("plain", Fix("rename it", lambda g: setattr(g, "name", "renamed")))
"""
YAML = """# by hand
eClass: http://example.org/g#//Graph
name: plain
"""
RENAMING = """
[[step]]
load = "m"
file = "m.yaml"
metamodel = "g.ecore"

[[step]]
validate = "rules.py:rules"
models = "m"
"""
GRAPHS = Path(__file__).parents[1] / "model" / "split" / "g.ecore"


def test_the_old_file_of_a_model_that_loses_comments_is_kept_once(tmp_path: Path) -> None:
    for name, text in (("rules.py", RULES), ("m.yaml", YAML), ("chain.toml", RENAMING), ("g.ecore", GRAPHS.read_text())):
        (tmp_path / name).write_text(text)
    result = read_chain(tmp_path / "chain.toml").run(fix="first")
    assert [f.rule for f in result.findings] == ["RS524"]
    assert "m.yaml.orig" in result.findings[0].message
    assert (tmp_path / "m.yaml.orig").read_text() == YAML
    assert 'name: "renamed"' in (tmp_path / "m.yaml").read_text()
    assert [path.name for path in tmp_path.glob("*.orig*")] == ["m.yaml.orig"]


def test_a_model_that_a_fix_changes_keeps_its_comments(site: Path) -> None:
    _without_author(site)
    text = (site / "library.xmi").read_text()
    end = text.rindex("</")
    (site / "library.xmi").write_text(f"{text[:end]}<!-- Ants: ask Ann -->\n{text[end:]}")
    result = run(site, fix="first")
    assert result["constraints"].written == ["library.xmi"]
    assert [f for f in result.findings if f.rule == "RS524"] == []
    assert not (site / "library.xmi.orig").exists()
    assert b"<!-- Ants: ask Ann -->\n</" in (site / "library.xmi").read_bytes()


def test_the_error_of_a_later_step_names_the_models_that_fixes_have_changed(site: Path) -> None:
    _without_author(site)
    replace(site / "rules.py", "whole.title = library_.name", "whole.title = library_.nme")
    with pytest.raises(RuleError, match=r"nme.*; fixes of a step before it had changed 'library.xmi', which stays"):
        run(site, fix="first")
    with pytest.raises(RuleError) as raised:
        run(site)
    assert "had changed" not in str(raised.value)


def test_a_function_chooses_the_fix(site: Path) -> None:
    _without_author(site)
    assert run(site, fix=lambda unsatisfied: None)["constraints"].state == "failed"
    assert run(site, fix=lambda unsatisfied: unsatisfied.fixes[-1])["constraints"].state == "done"


def test_a_fix_that_fails_is_undone_and_said(site: Path) -> None:
    author = "b.authors.append(library.Author.all[0])"
    _without_author(site, FIXABLE.replace(author, f"({author}, [][0])"))
    before = (site / "library.xmi").read_bytes()
    result = run(site, fix="first")["constraints"]
    assert result.state == "failed"
    assert result.findings[0].rule == "RS533"
    assert "IndexError" in result.findings[0].message
    assert result.fixed == []
    assert (site / "library.xmi").read_bytes() == before


def test_a_fix_of_a_model_that_a_step_makes_is_not_performed(site: Path) -> None:
    with (site / "rules.py").open("a") as file:
        file.write(
            "\n\ndef titles(v: EVL, site: Any) -> None:\n"
            '    """Titles are loud."""\n'
            '    shout = Fix("shout", lambda p: setattr(p, "title", p.title.upper()))\n'
            '    v.context(site.Page).constraint(name="Loud", fixes=[shout])(lambda p: p.title.isupper())\n'
        )
    replace(site / "rules.py", "import EVL, Fail", "import EVL, Fail, Fix")
    replace(
        site / "chain.toml", "[[step]]\ngenerate", '[[step]]\nvalidate = "rules.py:titles"\nmodels = "site"\n\n[[step]]\ngenerate'
    )
    result = run(site, fix="first")["titles"]
    assert result.state == "failed"
    assert result.fixed == []
    assert {f.rule for f in result.findings} == {"RS532", "Loud"}


def test_what_rules_print_is_no_part_of_the_json(site: Path) -> None:
    said = '    """Every book has an author."""\n'
    replace(site / "rules.py", said, f'{said}    print("noise")\n')
    outcome = command("run", site / "chain.toml", "--json")
    assert json.loads(outcome.out)["ok"]
    assert "noise" in outcome.err
    assert "noise" in command("run", site / "chain.toml", "--force").out


def test_the_command_performs_fixes(site: Path) -> None:
    _without_author(site)
    assert command("run", site / "chain.toml", "--json").code == 1
    outcome = command("run", site / "chain.toml", "--fix", "--json")
    steps = {s["name"]: s for s in outcome.result["steps"]}
    assert len(steps["constraints"]["fixed"]) == 1
    assert steps["pages"]["state"] == "done"


def test_findings_say_the_file_of_the_model(site: Path) -> None:
    replace(site / "rules.py", "b.year > 1900", "b.year > 2000")
    findings = run(site).findings
    assert [f.message for f in findings] == ["Ants is old"]
    assert [(str(f.location), f.element) for f in findings] == [
        (str(site / "library.xmi"), "library!Book //@sections.1/@items.0")
    ]


def test_a_trace_is_saved_beside_the_models_and_refers_to_them(site: Path) -> None:
    replace(site / "chain.toml", 'file = "build/site.xmi"', 'file = "build/site.xmi"\ntrace = "traces/site.xmi"')
    assert run(site)["to_site"].written == ["build/site.xmi", "traces/site.xmi"]
    file = site / "traces" / "site.xmi"
    text = file.read_text()
    assert 'href="../library.xmi#//@sections.1/@items.0"' in text
    assert 'href="../build/site.xmi#//@pages.2"' in text
    judge([TRACE, site / "library.ecore", site / "site.ecore"], file)
    metamodels = [trace, *Metamodel.load(site / "library.ecore", site / "site.ecore").packages]
    links = Trace.of_model(EmfModel.load(file, metamodels).roots[0]).links
    assert [(link.source.name, link.targets[0].title) for link in links if link.rule == "Page"] == [
        (name, name) for name in ("Propellers", "Boards", "Ants", "Zap")
    ]
    assert done(run(site)) == []
    file.unlink()
    assert done(run(site)) == ["to_site"]
    replace(file, "Page", "Sheet")
    with pytest.raises(StoppedError, match=r"'traces/site.xmi' was changed"):
        run(site)


def test_a_dry_run_saves_no_trace(site: Path) -> None:
    replace(site / "chain.toml", 'file = "build/site.xmi"', 'file = "build/site.xmi"\ntrace = "traces/site.xmi"')
    assert run(site, dry_run=True)["to_site"].written == ["build/site.xmi", "traces/site.xmi"]
    assert not (site / "traces").exists()


def test_a_step_that_fails_leaves_the_earlier_ones_done(site: Path) -> None:
    replace(site / "templates" / "page.html", "p.price", "p.prise")
    with pytest.raises(RobosmiError, match="prise"):
        run(site)
    assert not (site / "out").exists()
    replace(site / "templates" / "page.html", "p.prise", "p.price")
    assert done(run(site)) == ["pages"]


def test_a_run_that_was_killed_while_it_wrote_a_model_does_not_take_its_own_file_for_an_edit(site: Path) -> None:
    run(site)
    state = site / ".robosmi" / "chains" / "chain.json"
    replace(site / "prices.csv", "8.25", "9")
    child = os.fork()
    if child == 0:

        def killed(*_: Any) -> Any:
            (site / "build" / "site.xmi").write_text("half")
            os._exit(1)

        DOES["transform"] = killed
        run(site)
    os.waitpid(child, 0)
    assert json.loads(state.read_text())["steps"]["to_site"]["outputs"] == {}
    assert "to_site" in done(run(site))
    assert "<b>9</b>" in (site / "out" / "Ants.html").read_text()


# In Python


def shout(t: ETL, a: Any, b: Any) -> None:
    """A page for each page, louder."""

    @t.rule(a.Page, to=[b.Page])
    def Page(x: Any, y: Any) -> None:
        y.title = x.title.upper()


def louder(t: ETL, b: Any, c: Any) -> None:
    """Louder still."""
    shout(t, b, c)


def test_a_function_sets_the_options_of_its_language(site: Path) -> None:
    rules = site / "rules.py"
    replace(rules, "    price = {row.title", '    t.schedule = "demand"\n    price = {row.title')
    text = '    """A file for each page, and an index."""\n'
    replace(rules, text, text + '    g.give(values={"sign": "eur"}, filters={"loud": str.upper})\n')
    replace(site / "templates" / "page.html", "{{ p.price }}", "{{ sign | loud }} {{ p.price }}")
    run(site)
    assert "<b>EUR 8.25</b>" in (site / "out" / "Ants.html").read_text()
    replace(rules, '"demand"', '"demnd"')
    with pytest.raises(RobosmiError, match="there is no schedule 'demnd'"):
        run(site)


def test_a_chain_in_python_and_its_graph(site: Path) -> None:
    run(site)
    c = Chain(site, "second")
    c.load("a", "build/site.xmi", metamodel="site.ecore")
    c.transform(shout, models="a", makes="b", metamodel="site.ecore")
    c.transform(louder, models="b", makes="c", metamodel="site.ecore", file="c.xmi", step="again")
    graph = c.graph()
    assert set(graph.predecessors("step shout")) >= {"model a", "file site.ecore"}
    assert set(graph.successors("step again")) == {"model c", "file c.xmi"}
    assert graph.nodes["model b"]["kind"] == "model"
    assert c.run()["again"].written == ["c.xmi"]
    assert "ANTS" in (site / "c.xmi").read_text()
    (site / "c.xmi").unlink()
    assert done(c.run()) == ["again"], "the model in memory is made for it without a word"


def test_steps_are_done_in_the_order_of_what_they_need(site: Path) -> None:
    c = Chain(site, "turned")
    c.transform(louder, models="b", makes="c", metamodel="site.ecore", file="c.xmi", step="second")
    c.transform(shout, models="a", makes="b", metamodel="site.ecore", file="b.xmi", step="first")
    c.load("a", "build/site.xmi", metamodel="site.ecore")
    run(site)
    assert [s.name for s in c.check()] == ["load a", "first", "second"]


def test_models_of_one_metamodel_are_merged_and_changed_in_place(site: Path) -> None:
    """Every step that names an .ecore file has the same metamodel, so that elements may go from model to model."""
    shutil.copy(site / "library.xmi", site / "second.xmi")

    def merged(t: ETL, one: Any, other: Any, both: Any) -> None:
        @t.rule(one.Library, to=both.Library)
        def Whole(a: Any, whole: Any) -> None:
            whole.name = a.name
            for feature in ("sections", "authors", "members"):
                getattr(whole, feature).extend([x for m in (one, other) for x in getattr(m.Library.all[0], feature)])

    def louder_books(t: ETL, both: Any, loud: Any) -> None:
        @t.post
        def moved() -> None:
            for book in both.Book.all:
                book.name = book.name.upper()
            loud.model.add(both.roots[0])

    books = len(EmfModel.load(site / "library.xmi", site / "library.ecore").all_of_kind("Book"))
    c = Chain(site, "merge")
    for name, file in (("one", "library.xmi"), ("other", "second.xmi")):
        c.load(name, file, metamodel="library.ecore")
    c.transform(merged, models=["one", "other"], makes="both", metamodel="library.ecore")
    c.transform(louder_books, models="both", makes="loud", metamodel="library.ecore", file="loud.xmi")
    c.run()
    loud = EmfModel.load(site / "loud.xmi", site / "library.ecore").all_of_kind("Book")
    assert len(loud) == 2 * books
    assert all(book.name.isupper() for book in loud)


def test_a_run_that_is_kept_takes_a_metamodel_that_has_changed(site: Path) -> None:
    kept = read_chain(site / "chain.toml").start()
    kept.run()
    replace(site / "site.ecore", 'name="price"', 'name="price" lowerBound="0"')
    assert [r.step.name for r in kept.run().steps if r.state != "up to date"] == ["to_site", "pages"]
    assert type(kept.value("library").Book.all[0]).__name__ == "Book"
    assert kept.value("library", type(kept.value("library"))) is kept.value("library")
    with pytest.raises(RuleError, match=r"the step of 'library' made .*; expected is int"):
        kept.value("library", int)


# Bad input: nothing is done


def wrong(site: Path, kind: type[RobosmiError] = SourceError) -> RobosmiError:
    before = tree(site)
    with pytest.raises(kind) as raised:
        run(site)
    assert {n: d for n, d in tree(site).items() if "__pycache__" not in n} == {
        n: d for n, d in before.items() if "__pycache__" not in n
    }
    assert raised.value.location is not None
    assert raised.value.fix
    return raised.value


def test_a_chain_with_a_circle(site: Path) -> None:
    with (site / "chain.toml").open("a") as file:
        file.write('\n[[step]]\ntransform = "rules.py:to_site"\nname = "back"\nmodels = "site"\nmakes = "again"\n')
        file.write('metamodel = "site.ecore"\nfile = "prices.csv"\n')
    replace(site / "chain.toml", 'file = "prices.csv"\n\n', 'file = "out2.csv"\ndriver = "rows"\n\n')
    (site / "out2.csv").write_text("a\n")
    replace(site / "chain.toml", 'load = "prices"\nfile = "out2.csv"', 'load = "prices"\nfile = "prices.csv"')
    error = wrong(site)
    assert "the chain goes in a circle" in error.message
    assert "step back" in error.message
    assert "step to_site" in error.message
    assert str(error.location) == str(site / "chain.toml")


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [
        ("library.xmi", "libary.xmi", "reads 'libary.xmi', which does not exist and no step makes"),
        ("site.ecore", "sites.ecore", "reads 'sites.ecore', which does not exist"),
        ('templates = "templates"', 'templates = "template"', "reads 'template', which does not exist"),
        ('models = "site"', 'models = "sight"', "uses the model 'sight', which no step makes (did you mean 'site'?)"),
        ('makes = "site"', 'makes = "library"', "two steps make the model library"),
        ('folder = "out"', 'folder = "build/site.xmi"', "two steps make the file build/site.xmi"),
        ('load = "prices"', 'load = "prices"\nname = "load library"', "two steps are called 'load library'"),
        ('load = "prices"', 'lood = "prices"', "step 2 has no action"),
        ('load = "prices"', 'load = "prices"\ngenerate = "x"', "step 2 has two actions: load and generate"),
        ('file = "prices.csv"', 'fiel = "prices.csv"', "'fiel' is no key of load (did you mean 'file'?)"),
        ('file = "prices.csv"', "", "step 2 (load = 'prices') has no 'file'"),
        ('file = "prices.csv"', "file = 3", "'file' of step 2 is no text"),
        ('load = "prices"', "load = 3", "'load' of step 2 is no text"),
        ('load = "prices"', 'load = "prices"\nname = "../x"', "'../x' cannot be a step's name"),
        ("[[step]]", "[[stepp]]", "'stepp' is no table of a chain"),
        ("[[step]]", "step = 1 #", "no TOML"),
        ('file = "build/site.xmi"', 'trace = "t.xmi"', "saves a trace, which cannot refer to the model 'site': it has no file"),
        ('"rules.py:pages"', '"rules.py:page"', "has no function 'page' (did you mean 'pages'?)"),
        ('"rules.py:pages"', '"rule.py:pages"', "there is no file"),
        ('"rules.py:pages"', '"nowhere.at.all:pages"', "cannot be imported"),
        ('"rules.py:pages"', '"pages"', "names no function"),
        ('"rules.py:constraints"', '"rules.py:constraints"\nstop_at = "eror"', "stop_at = 'eror' is no level"),
    ],
)  # fmt: skip
def test_a_wrong_chain(old: str, new: str, cause: str, site: Path) -> None:
    replace(site / "chain.toml", old, new)
    error = wrong(site)
    assert cause in error.message
    assert error.location is not None
    assert error.location.path == str(site / "chain.toml")


def test_a_chain_without_steps_and_one_that_is_not_there(site: Path) -> None:
    (site / "chain.toml").write_text("")
    assert "has no steps" in wrong(site).message
    (site / "chain.toml").unlink()
    assert "does not exist" in wrong(site).message


@pytest.mark.parametrize(
    ("old", "new", "line", "cause"),
    [
        ("def pages(g: Gen, site: Any) -> None:", "def pages(g: Gen, site: Any -> None:", 40, "does not parse"),
        ("from typing import Any", "from typing import Anny", 5, "ImportError"),
    ],
)
def test_code_that_cannot_be_imported(old: str, new: str, line: int, cause: str, site: Path) -> None:
    replace(site / "rules.py", old, new)
    error = wrong(site, RuleError)
    assert cause in error.message
    assert str(error.location) == f"{site / 'rules.py'}:{line}"


def test_a_model_that_cannot_be_read(site: Path) -> None:
    replace(site / "library.xmi", 'year="1999"', 'years="1999"')
    assert "has no feature 'years'" in wrong(site, RobosmiError).message


@pytest.mark.parametrize(
    ("old", "new", "step"),
    [
        ("def pages(g: Gen, site: Any)", "def pages(g: Gen, sight: Any)", "pages"),
        (
            "def to_site(t: ETL, library: Any, prices: Any, site: Any)",
            "def to_site(t: ETL, library: Any, prices: Any)",
            "to_site",
        ),
        ("def constraints(v: EVL, library: Any)", "def constraints(v: EVL, library: Any, prices: Any)", "constraints"),
    ],
)
def test_a_function_that_does_not_take_its_models_is_refused_before_the_first_step(
    old: str, new: str, step: str, site: Path
) -> None:
    replace(site / "rules.py", old, new)
    error = wrong(site, RuleError)
    assert error.message.startswith(f"the function of the step '{step}' does not fit")
    assert error.location is not None
    assert error.location.path.endswith("rules.py")


def test_a_damaged_state_is_said(site: Path) -> None:
    run(site)
    (site / ".robosmi" / "chains" / "chain.json").write_text('{"schema": "robosmi-chain/1", "steps": {"x": {"y": 1}}}')
    assert "the record of the last run cannot be read" in wrong(site).message


# The command


def test_the_command_says_the_steps_with_state_and_time(site: Path) -> None:
    outcome = command("run", site / "chain.toml", "--json")
    assert outcome.code == 0
    steps = outcome.result["steps"]
    assert [(s["name"], s["state"]) for s in steps] == [(name, "done") for name in ALL]
    assert all(s["seconds"] > 0 for s in steps)
    assert {str(site / "build" / "site.xmi"), str(site / "out" / "Ants.html")} <= {
        a["path"] for a in outcome.document["artifacts"]
    }
    text = command("run", site / "chain.toml").out
    assert text.count("up to date") == 5
    assert " ms" in text


def test_the_command_keeps_edits_shows_dry_runs_and_has_the_exit_codes_of_the_contract(site: Path) -> None:
    assert command("run", site / "chain.toml").code == 0
    replace(site / "out" / "Ants.html", "<h1>", "<h1 class='mine'>")
    replace(site / "prices.csv", "8.25", "9")
    assert "+<b>9</b>" in command("run", site / "chain.toml", "--dry-run").out
    assert "8.25" in (site / "out" / "Ants.html").read_text()
    assert command("run", site / "chain.toml").code == 0
    assert "mine" in (site / "out" / "Ants.html").read_text()
    replace(site / "out" / "Ants.html", "<b>9</b>", "<b>cheap</b>")
    replace(site / "prices.csv", "Ants,9", "Ants,10")
    outcome = command("run", site / "chain.toml", "--json")
    assert outcome.code == 1
    assert outcome.rules() == {"RS511", "RS512"}
    assert "<<<<<<< yours\n<b>cheap</b>\n" in (site / "out" / "Ants.html").read_text()
    assert "cheap" in (site / "out" / "Ants.html.orig").read_text()
    replace(site / "prices.csv", "Ants,10", "Ants,11")
    assert command("run", site / "chain.toml").code == 5
    assert command("run", site / "nothing.toml").code == 3
