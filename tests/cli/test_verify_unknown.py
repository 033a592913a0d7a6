"""`robosmi verify` of a program whose header is missing and whose functions nobody knows: they are stubbed on both sides."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.transformations.verification.originals import with_stubs
from tests.running import run
from tests.tools import require_verification

PROGRAM = Path(__file__).parent / "unknown_functions" / "unknown.c"
FUNCTIONS = {"beacon", "say", "drive_pins"}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated program."""
    require_verification("simavr")
    out = tmp_path_factory.mktemp("unknown") / "out"
    pins = ("--bind", "P5=D7", "--bind", "P12=none", "--bind", "P13=none")
    assert run("migrate", PROGRAM, "-o", out, *pins).code in (0, 1)
    return out


@pytest.fixture
def out(made: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    shutil.copytree(made, tmp_path / "out")
    return tmp_path / "out"


def verified(out: Path) -> Any:
    return run("verify", out, "--budget", "1", "--json").result


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


@pytest.mark.processes
def test_what_is_unknown_is_not_the_end_and_makes_the_comparison_partial(out: Path) -> None:
    result = verified(out)
    assert result["verdict"] == "no-difference-found"
    assert set(result["stubbed"]) >= {*FUNCTIONS, "speech.h", "SAY_PAUSE = 1"}
    assert result["partial"] is True
    assert result["compared"] == {"outputs": 1, "of": 1, "lines_pct": 100.0}
    assert run("verify", out, "--budget", "1", "--require-coverage", "50").code == 1
    report = (out / "unknown" / "MIGRATION.md").read_text().split("\n- ")[0]
    assert [name for name in (*FUNCTIONS, "speech.h") if name not in report.replace("\\_", "_")] == []


@pytest.mark.processes
def test_faults_of_the_rest_are_found(out: Path) -> None:
    change(out / "unknown" / "unknown.ino", "pause(200)", "pause(300)")
    assert verified(out)["verdict"] == "different"


@pytest.mark.processes
def test_bodies_and_values_of_a_person_are_those_of_both_sides(out: Path) -> None:
    adapters = out / "unknown" / "adapters.h"
    text = adapters.read_text()
    at = text.index("// TODO: complete method", text.index("void beacon("))
    adapters.write_text(f"{text[:at]}digitalWrite(7, HIGH); delay(50);{text[at:].partition(chr(10))[2]}")
    change(adapters, "SAY_PAUSE = 1;", "SAY_PAUSE = 250;")
    result = verified(out)
    assert result["verdict"] == "no-difference-found", result["first_difference"]
    assert "beacon" in result["stubbed"]
    assert "SAY_PAUSE = 250" in result["stubbed"]


def test_a_stub_replaces_the_body_alone() -> None:
    function = "// what it does\nint32_t f(int a) {\n  if (a) { return 3; }\n  return 4;\n}"
    text = f"int before;\n{function}\nvoid g() {{ f(1); }}\nint *h() {{ return 0; }}\n"
    made = with_stubs(text, {"f", "g", "h"})
    assert "if" not in made
    assert "int before;" in made
    assert made.count("return {};") == 2
    assert with_stubs(text, {"k"}) == text
