"""Chains do again what a changed driver reads, and tell a fault in a person's own code with its file, its line and its step."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from robosmi.chain import read_chain
from robosmi.chain.steps import files_of
from robosmi.errors import RobosmiError, RuleError, SourceError

HERE = Path(__file__).parent
ROOT = HERE.parents[1]


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A copy of the chain's folder."""
    return Path(shutil.copytree(HERE / "site", tmp_path / "site", ignore=shutil.ignore_patterns("__pycache__")))


def replace(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_a_changed_plug_in_reads_its_files_again(tmp_path: Path) -> None:
    notes = Path(shutil.copytree(HERE / "notes", tmp_path / "notes", ignore=shutil.ignore_patterns("__pycache__")))
    (notes / "notes.txt").rename(notes / "all.note")
    (notes / "chain.toml").write_text(
        (notes / "chain.toml").read_text().replace('notes.txt"\ndriver = "drivers.py:read', "all.note")
    )
    plugin = Path(shutil.copytree(HERE / "notes_plugin", tmp_path / "plugin"))
    (plugin / "notes_plugin.py").write_text(
        (notes / "drivers.py").read_text()
        + '\n\ndef register(registry):\n    registry.add("driver", ".note", "notes_plugin:Notes")\n'
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(plugin), str(ROOT)]), "PYTHONDONTWRITEBYTECODE": "1"}

    def said() -> str:
        words = [sys.executable, "-m", "robosmi", "run", "chain.toml"]
        done = subprocess.run(words, capture_output=True, text=True, env=environment, cwd=notes)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert "up to date" not in said()
    assert said().count("up to date") == 2
    replace(plugin / "notes_plugin.py", ".strip()", ".strip().upper()")
    assert "up to date" not in said()
    assert (notes / "out" / "all.txt").read_text() == "BUY WHEELS\nCHARGE\n"


@pytest.mark.parametrize(("old", "new", "said"), [
    ("    price = {", "    import nosuch\n    price = {", "the function of the step 'to_site' fails: .*No module named 'nosuch'"),
    ("        page.title =", "        import nosuch\n        page.title =", "the rule Page fails for .*No module named 'nosuch'"),
    ("def HasAuthor(b: Any)", "def HasAuthor()", "the constraint HasAuthor of Book has no parameter"),
    ("v.context(library.Book)", "v.kontext(library.Book)", "the function of the step 'constraints' fails: AttributeError"),
])  # fmt: skip
def test_a_fault_in_a_persons_functions_is_told_as_theirs(old: str, new: str, said: str, site: Path) -> None:
    replace(site / "rules.py", old, new)
    with pytest.raises(RuleError, match=said) as told:
        read_chain(site / "chain.toml").run()
    assert told.value.location is not None
    assert Path(told.value.location.path).name == "rules.py"
    assert "bug of robosmi: please" not in str(told.value.fix)
    assert "install robosmi" not in str(told.value.fix)


def test_a_function_of_another_language_is_told_as_such(site: Path) -> None:
    replace(site / "chain.toml", 'generate = "rules.py:pages"', 'generate = "rules.py:constraints"')
    replace(site / "rules.py", "def constraints(v: EVL, library: Any)", "def constraints(v: EVL, site: Any, library: Any = None)")
    replace(site / "chain.toml", '[[step]]\nvalidate = "rules.py:constraints"\nmodels = "library"\n', "")
    with pytest.raises(RobosmiError, match="the function of the step 'constraints' fails") as told:
        read_chain(site / "chain.toml").run()
    assert told.value.exit_code == 3


@pytest.mark.parametrize(("old", "new", "said"), [
    ('validate = "rules', 'validte = "rules', "has no action; 'validte' is no key (did you mean 'validate'?)"),
    ('metamodel = "site.ecore"', 'metamodel = "siite.ecore"', "and no step makes (did you mean 'site.ecore'?)"),
])  # fmt: skip
def test_a_misspelt_key_or_metamodel_is_told_with_the_nearest(old: str, new: str, said: str, site: Path) -> None:
    replace(site / "chain.toml", old, new)
    with pytest.raises(SourceError) as told:
        read_chain(site / "chain.toml").run()
    assert said in told.value.message


def test_a_step_that_changes_what_it_reads_is_done_again_for_the_steps_behind_it(site: Path) -> None:
    replace(
        site / "rules.py",
        "    price = {",
        '    for book in library.Book.all:\n        book.name = f"{book.name} II"\n    price = {',
    )
    replace(site / "rules.py", "def pages(g: Gen, site: Any) -> None:", "def pages(g: Gen, site: Any, library: Any) -> None:")
    replace(site / "rules.py", 'f"{p.title}.html"', 'f"{p.title} of {library.Book.all.first().name}.html"')
    replace(
        site / "chain.toml",
        'generate = "rules.py:pages"\nmodels = "site"',
        'generate = "rules.py:pages"\nmodels = ["site", "library"]',
    )
    read_chain(site / "chain.toml").run()
    first = sorted(path.name for path in (site / "out").glob("*.html"))
    assert any(" II" in name.partition(" of ")[2] for name in first)
    (site / "templates" / "page.html").write_text("{# new #}\n" + (site / "templates" / "page.html").read_text())
    again = read_chain(site / "chain.toml").run()
    assert {r.step.name: r.state for r in again.steps}["to_site"] == "done"
    assert sorted(path.name for path in (site / "out").glob("*.html")) == first


def test_a_change_of_a_metamodel_that_the_named_one_refers_to_is_seen(tmp_path: Path) -> None:
    boxes = Path(shutil.copytree(HERE / "boxes", tmp_path / "boxes"))
    chain = boxes / "chain.toml"
    assert read_chain(chain).run()["texts"].state == "done"
    assert (boxes / "out" / "boxes.txt").read_text(encoding="utf-8") == "anon\n"
    assert [step.state for step in read_chain(chain).run().steps] == ["up to date"] * 3
    replace(boxes / "base.ecore", "anon", "nobody")
    assert read_chain(chain).run()["texts"].state == "done"
    assert (boxes / "out" / "boxes.txt").read_text(encoding="utf-8") == "nobody\n"


def test_metamodels_that_refer_to_each_other_or_to_nothing_do_not_stop_a_chain(tmp_path: Path) -> None:
    boxes = Path(shutil.copytree(HERE / "boxes", tmp_path / "boxes"))
    assert [path.name for path in files_of([boxes / "top.ecore"])] == ["top.ecore", "base.ecore"]
    replace(
        boxes / "base.ecore",
        "</ecore:EPackage>",
        '<eClassifiers name="X" eSuperTypes="top.ecore#//Box no.ecore#//Y"/></ecore:EPackage>',
    )
    assert [path.name for path in files_of([boxes / "top.ecore"])] == ["top.ecore", "base.ecore"]
    (boxes / "base.ecore").write_text("<", encoding="utf-8")
    assert [path.name for path in files_of([boxes / "top.ecore"])] == ["top.ecore"]
