"""The generator of Python packages on small metamodels, one for each trap: a case is a folder.

`*.ecore` is generated into a package `made` (only the files in `given.txt`, if it is there); `X.mixins.txt` lies in package X
as `mixins.py`. `use.txt` is a doctest of the packages, and its code passes `mypy --strict`; `findings.txt` has the findings,
`refused.txt` the reasons against generating anything.
"""

from __future__ import annotations

import doctest
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import RobosmiError
from robosmi.generate.packages import GeneratedPackages, generate_packages

ROOT = Path(__file__).parents[3]
CASES = sorted((Path(__file__).parent / "cases").iterdir())
GOOD = [case for case in CASES if not (case / "refused.txt").exists()]
OBJECTED = {"ecore_bases": "EMF makes no dynamic objects of classes that inherit from Ecore's abstract ones"}
REFUSED = [case for case in CASES if (case / "refused.txt").exists()]


def generate(case: Path, work: Path) -> GeneratedPackages:
    """Generate a case into `work/made`."""
    for mixin in case.glob("*.mixins.txt"):
        target = work / "made" / mixin.name.split(".")[0] / "mixins.py"
        target.parent.mkdir(parents=True)
        shutil.copy(mixin, target)
    given = case / "given.txt"
    paths = [case / name for name in given.read_text().split()] if given.exists() else sorted(case.glob("*.ecore"))
    return generate_packages(paths, work / "made")


@pytest.fixture
def importable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder on Python's path, whose packages are forgotten afterwards."""
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    yield tmp_path
    for name in [name for name in sys.modules if name.split(".")[0] == "made"]:
        del sys.modules[name]


def names(cases: list[Path]) -> list[str]:
    """The names of cases."""
    return [case.name for case in cases]


def judged(case: Path) -> Any:
    """A case for `parametrize`, with the mark that EMF objects to its models, if it does."""
    marks = [pytest.mark.emf_objects(OBJECTED[case.name])] if case.name in OBJECTED else []
    return pytest.param(case, id=case.name, marks=marks)


@pytest.mark.parametrize("case", [judged(case) for case in GOOD])
def test_generated_packages_do_what_the_case_says(case: Path, importable: Path) -> None:
    generate(case, importable)
    test = doctest.DocTestParser().get_doctest((case / "use.txt").read_text(), {}, case.name, str(case / "use.txt"), 0)
    assert test.examples
    said: list[str] = []
    result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE, verbose=False).run(test, out=said.append)
    assert result.failed == 0, "".join(said)


@pytest.mark.parametrize("case", GOOD, ids=names(GOOD))
def test_a_second_run_makes_the_same_bytes(case: Path, tmp_path: Path) -> None:
    first = generate(case, tmp_path)
    assert first.written
    before = {path: path.read_bytes() for path in first.written}
    again = generate_packages(sorted({first.sources[path] for path in first.written}), tmp_path / "made")
    assert (again.written, again.removed) == ([], [])
    assert {path: path.read_bytes() for path in again.unchanged} == before


@pytest.mark.parametrize("case", GOOD, ids=names(GOOD))
def test_what_is_not_as_the_metamodel_says_is_found(case: Path, tmp_path: Path) -> None:
    made = generate(case, tmp_path)
    expected = case / "findings.txt"
    said = sorted(
        f"{f.rule} {f.severity.name} {Path(f.location.path).name}:{f.location.line} {f.message}"
        for f in made.findings
        if f.location
    )
    if expected.exists():
        assert said == sorted(expected.read_text().splitlines())
    else:
        assert [line for line in said if not line.startswith("RS602")] == []


@pytest.mark.parametrize("case", REFUSED, ids=names(REFUSED))
def test_a_metamodel_that_cannot_be_used_is_refused_with_all_reasons(case: Path, tmp_path: Path) -> None:
    with pytest.raises(RobosmiError) as caught:
        generate(case, tmp_path)
    text = str(caught.value).replace(f"{case}/", "")
    first, *reasons = (case / "refused.txt").read_text().splitlines()
    assert first in text.splitlines()[0]
    assert [line.strip() for line in text.splitlines()[1 : 1 + len(reasons)]] == reasons
    assert caught.value.exit_code == 3
    assert caught.value.fix
    assert not (tmp_path / "made").exists()


def python(*words: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run a Python module; it finds this project and no configuration of it."""
    environment = {**os.environ, "MYPYPATH": str(ROOT)}
    return subprocess.run([sys.executable, "-m", *words], cwd=cwd, capture_output=True, text=True, check=False, env=environment)


@pytest.mark.exhaustive
def test_generated_packages_and_their_use_pass_mypy_strict_without_configuration(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    for case in GOOD:
        generate(case, tmp_path / case.name)
        examples = doctest.DocTestParser().get_examples((case / "use.txt").read_text())
        lines = "".join(e.source for e in examples).replace("from made", f"from {case.name}.made")
        (tmp_path / f"use_{case.name}.py").write_text(lines)
    (tmp_path / "found.py").write_text("from robosmi.model.strict import Element\n\nElement().nonsense()\n")
    assert "found.py:3" in python("mypy", "--config-file=", "--follow-imports=silent", "found.py", cwd=tmp_path).stdout
    done = python(
        "mypy", "--strict", "--config-file=", "--follow-imports=silent", *(f"use_{case.name}.py" for case in GOOD), cwd=tmp_path
    )
    assert done.returncode == 0, done.stdout


def test_generated_packages_are_as_ruff_formats_them(tmp_path: Path) -> None:
    pytest.importorskip("ruff")
    for case in GOOD:
        generate(case, tmp_path / case.name)
    done = python("ruff", "format", "--isolated", "--diff", "--exclude", "mixins.py", ".", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    done = python("ruff", "check", "--isolated", "--select", "F,E4,E7,E9,I", ".", cwd=tmp_path)
    assert done.returncode == 0, done.stdout
