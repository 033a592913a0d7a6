"""Does the mirror of EGL and EGX make the files that the real engine made? Each script is ported; compare.py judges the result.

All results are equal, including messages and their order. Where the mirror differs (docs/reference/egl.md), the port says so.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.epsilon.egl_running import run_steps
from tests.epsilon.running import HERE, judge, names

ALL = names("egl")
WORDS = {"region_twice"}
"""Cases whose error message is worded differently from the engine's."""


def test_no_case_is_missing_and_each_has_a_port() -> None:
    assert len(ALL) == 17
    assert {path.stem for path in (HERE / "ports" / "egl").glob("*.py")} == set(ALL)


@pytest.mark.parametrize("name", ALL)
def test_a_port_makes_what_the_engine_made(name: str, tmp_path: Path) -> None:
    run_steps(name, tmp_path)
    verdict = judge("egl", name, tmp_path, *([] if name in WORDS else ["--strict"]))
    assert verdict.equal, f"{verdict.line}\n{verdict.differences}"


def test_the_judge_judges(tmp_path: Path) -> None:
    """A file with one additional character is noticed."""
    run_steps("region_gone", tmp_path)
    file = tmp_path / "step2" / "o.txt"
    file.write_text(file.read_text(encoding="utf-8") + "x", encoding="utf-8")
    assert judge("egl", "region_gone", tmp_path).line.startswith("DIFFERENT")
