"""Do the mirrors of EVL, ETL and Flock do what the real engines did? Each script has a port; compare.py judges the result.

Differences are listed here and in docs/reference, each with its reason: the engine's behaviour is a documented defect, and
users would be misled if the mirror followed it.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.epsilon.running import CASES, HERE, judge, names, run

DIFFERENT = {
    ("evl", "satisfies_leak"): "after a failed dependency the engine's self is another element",
    (
        "evl",
        "satisfies_several",
    ): "the engine's satisfiesAll looks at the first name only, its satisfiesOne of failing names is true",
}
KINDS = {"evl": 24, "etl": 25, "flock": 8}
ALL = [(kind, name) for kind in KINDS for name in names(kind)]
PORTED = [pytest.param(*case, id="/".join(case)) for case in ALL if case not in DIFFERENT]


def test_no_case_is_missing_and_each_has_a_port() -> None:
    assert {kind: len(names(kind)) for kind in KINDS} == KINDS
    ports = {(path.parent.name, path.stem) for path in (HERE / "ports").glob("*/*.py")}
    assert {port for port in ports if port[0] in KINDS} == set(ALL)


@pytest.mark.parametrize(("kind", "name"), PORTED)
def test_a_port_does_what_the_engine_did(kind: str, name: str, tmp_path: Path) -> None:
    run(kind, name, tmp_path)
    verdict = judge(kind, name, tmp_path, "--strict")
    assert verdict.equal, f"{verdict.line}\n{verdict.differences}"


@pytest.mark.parametrize(("kind", "name"), [pytest.param(*case, id="/".join(case)) for case in DIFFERENT])
def test_what_differs_is_a_declared_quirk_and_documented(kind: str, name: str, tmp_path: Path) -> None:
    run(kind, name, tmp_path)
    assert judge(kind, name, tmp_path).line.endswith("a declared quirk")
    page = (HERE.parents[1] / "docs" / "reference" / f"{kind}.md").read_text(encoding="utf-8")
    assert name in page


def test_the_judge_judges(tmp_path: Path) -> None:
    """A port that leaves a rule out is noticed."""
    run("evl", "basic_check", tmp_path)
    file = tmp_path / "expected.json"
    file.write_text(file.read_text(encoding="utf-8").replace("has no author", "has an author"), encoding="utf-8")
    assert judge("evl", "basic_check", tmp_path).line.startswith("DIFFERENT")
    assert (CASES / "evl" / "basic_check" / "expected.json").is_file()
