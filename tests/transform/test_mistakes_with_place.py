"""The error message for a mistake in a rule, a constraint or a chain's step names the file, the line, and the rule or step."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.chain import read_chain
from robosmi.errors import RobosmiError, SourceError, UsageError
from robosmi.model.elements.driver import UnknownTypeError
from robosmi.transform import ETL
from robosmi.validate import EVL
from tests.library import empty, library

SITE = Path(__file__).parents[1] / "chain" / "site"


def test_a_type_that_is_not_there_is_told_with_its_rule() -> None:
    t = ETL(library("L"), empty("graph", "G"))

    @t.rule("Book", to=["Nod"])
    def B(b: Any, n: Any) -> None: ...

    with pytest.raises(
        UnknownTypeError, match=r"the target 'n' of the rule B: there is no type 'Nod' \(did you mean 'Node'\?\)"
    ) as told:
        t.run()
    assert str(told.value.location).partition(":")[0].endswith("test_mistakes_with_place.py")


def test_a_type_that_is_not_there_is_told_with_its_context() -> None:
    v = EVL(library("L"))

    @v.context("Boook").constraint
    def Known(b: Any) -> bool:
        return True

    with pytest.raises(UnknownTypeError, match=r"the context Boook: there is no type 'Boook' \(did you mean 'Book'\?\)") as told:
        v.run()
    assert str(told.value.location).partition(":")[0].endswith("test_mistakes_with_place.py")


def test_a_misspelt_option_of_a_rule_is_told_with_the_nearest() -> None:
    t = ETL(library("L"), empty("graph", "G"))
    options: dict[str, Any] = {"gaurd": lambda b: True}
    with pytest.raises(UsageError, match=r"a rule has no option 'gaurd' \(did you mean 'guard'\?\)") as told:

        @t.rule("Book", to=["Node"], **options)
        def B(b: Any, n: Any) -> None: ...

    assert told.value.location is not None


@pytest.mark.parametrize(("old", "new", "said"), [
    ('template="page.html"', 'template="pag.html"', "there is no template 'pag.html'"),
    ("site.Page, template", "site.Paeg, template", r"there is no type 'Paeg' \(did you mean 'Page'\?\)"),
    ("library.Book, to=", "library.Boook, to=", r"there is no type 'Boook' \(did you mean 'Book'\?\)"),
    ("v.context(library.Book)", "v.context(library.Boook)", r"there is no type 'Boook' \(did you mean 'Book'\?\)"),
])  # fmt: skip
def test_a_mistake_in_a_function_of_a_chain_is_told_with_its_line(old: str, new: str, said: str, tmp_path: Path) -> None:
    site = shutil.copytree(SITE, tmp_path / "site", ignore=shutil.ignore_patterns("__pycache__"))
    text = (site / "rules.py").read_text()
    assert old in text
    (site / "rules.py").write_text(text.replace(old, new))
    with pytest.raises(RobosmiError, match=said) as told:
        read_chain(site / "chain.toml").run()
    place = told.value.location
    assert place is not None
    assert Path(place.path).name == "rules.py"
    if "template" not in old:  # a missing template is only found when the rule runs
        assert place.line == 1 + text[: text.index(old)].count("\n")


def test_ecore_is_told_where_it_is_written_with_a_capital(tmp_path: Path) -> None:
    site = shutil.copytree(SITE, tmp_path / "site", ignore=shutil.ignore_patterns("__pycache__"))
    (site / "chain.toml").write_text('[[step]]\nload = "meta"\nfile = "site.ecore"\nmetamodel = "Ecore"\n')
    with pytest.raises(SourceError, match=r"reads 'Ecore', which does not exist and no step makes \(did you mean 'ecore'\?\)"):
        read_chain(site / "chain.toml").run()
