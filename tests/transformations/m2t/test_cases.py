"""Generation, one folder a case: `cases/NAME/` holds `case.toml`, `input/`, and `expected/` with the files of the sketch.

case.toml: `about` (what the case shows); optional `files` (the units given, else all .c files of `input/`), `hardware` (an
example whose drawing is taken), `[bind]` and `[libraries]` (as the flags), `compiles` (why the sketch cannot compile: the
source's own fault), `adapters` (as the flag; placeholders for what a case expects of the program's text, since bodies are data
that have tests of their own), `shows_adapters` (true: the case is about `adapters.h`, which is expected, too). Every case also
has to compile with the bodies that there are.
`expected/verdicts.txt` has one line for each element that was judged (line, element, action, rule; for main also why), and
one for each place with a finding or task that is more than information.

Refresh after a wanted change: ROBOSMI_ACCEPT=1 pytest tests/transformations/m2t/test_cases.py writes `expected/` anew and
fails; read every line of `git diff`, then run without it.
"""

from __future__ import annotations

import os
import re
import shutil
import tomllib
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.chains.migrate import migrate
from robosmi.transformations.chains.stages.output import Generated
from tests.running import tree
from tests.tiers import sample
from tests.tools import require_tools
from tests.transformations.m2t.truth import overlaps, verdict_faults

FOLDER = Path(__file__).parent / "cases"
CASES = sorted(path.name for path in FOLDER.iterdir() if (path / "case.toml").is_file())
ACCEPT = "ROBOSMI_ACCEPT"
ADAPTERS = "adapters.h"
SKETCH = (".ino", ".cpp", ".h")


def options(name: str) -> dict[str, Any]:
    """What case.toml says."""
    return tomllib.loads((FOLDER / name / "case.toml").read_text())


def migrated(name: str, folder: Path, examples: Path, adapters: str | None = None) -> Generated:
    """A case's program, migrated in a copy of its folder; with adapters as the case says where nothing else is asked for."""
    said = options(name)
    shutil.copytree(FOLDER / name / "input", folder / "input")
    named = said.get("files") or sorted(p.name for p in (folder / "input").glob("*.c"))
    drawing = next((examples / said["hardware"]).glob("*.fzz")) if "hardware" in said else None
    files = [folder / "input" / file for file in named]
    return migrate(
        files, folder / "out", hardware=drawing, bind=said.get("bind"), libraries=said.get("libraries"),
        adapters=adapters or said.get("adapters", "placeholders"),
    )  # fmt: skip


def sketch_files(made: Generated) -> dict[str, str]:
    """The files of the sketch that a compiler reads, and the verdicts; without the version of the tool."""
    files = {path.name: path.read_text() for path in sorted(made.sketch.iterdir()) if path.suffix in SKETCH}
    files = {file: re.sub(r"Made by RoboSMi [^ ]+\. ", "Made by RoboSMi. ", text) for file, text in files.items()}
    return files | {"verdicts.txt": verdicts(made)}


def verdicts(made: Generated) -> str:
    """One line for each disposition, in the order of the source."""
    rows = []
    for disposition in made.models.plan.dispositions:
        element = disposition.element
        assert isinstance(element, ccode.Located)
        unit = ancestor_of_kind(element, ccode.SourceUnit)
        path = unit.path.rpartition("/")[2] if unit is not None else "elsewhere"
        why = f" ({'; '.join(disposition.reasons)})" if "main" in disposition.rules else ""
        shown = f"{path}:{element.line} {element_title(element)}: {disposition.action.name} {'+'.join(disposition.rules)}{why}"
        rows.append((path, element.startOffset, shown))
    found = [*made.models.plan.findings, *made.models.plan.tasks]
    said = {f"{f.path.rpartition('/')[2]}:{f.line} {f.severity.name} {f.rule}" for f in found if f.severity.name != "info"}
    return "".join(f"{line}\n" for line in [*(row[-1] for row in sorted(rows)), "", *sorted(said)])


def element_title(element: ccode.Located) -> str:
    """What an element is called in `verdicts.txt`."""
    kind = type(element).__name__
    if isinstance(element, ccode.Include):
        return f"#include {'<' if element.system else chr(34)}{element.header}{'>' if element.system else chr(34)}"
    name = element.name if isinstance(element, (ccode.Declaration, ccode.Macro)) else ""
    return f"{kind} {name}" if name else kind


@pytest.mark.parametrize("name", CASES)
def test_the_sketch_is_the_expected_one(name: str, tmp_path: Path, examples: Path) -> None:
    made = sketch_files(migrated(name, tmp_path, examples))
    if not options(name).get("shows_adapters"):
        assert made.pop(ADAPTERS).startswith("// Adapters for ")
    expected = FOLDER / name / "expected"
    if os.environ.get(ACCEPT):
        shutil.rmtree(expected, ignore_errors=True)
        expected.mkdir()
        for file, text in made.items():
            (expected / file).write_text(text)
        pytest.fail(f"{expected.name} of '{name}' was written anew: read the difference, then run without {ACCEPT}")
    wanted = {path.name: path.read_text() for path in sorted(expected.iterdir())}
    for file, text in made.items():
        assert text == wanted.get(file, ""), f"{name}/{file}"
    assert set(made) == set(wanted)


@pytest.mark.parametrize("name", sample(CASES, 28))
def test_every_element_has_one_verdict_and_a_second_run_changes_nothing(name: str, tmp_path: Path, examples: Path) -> None:
    made = migrated(name, tmp_path, examples, "filled")
    assert verdict_faults(made.models.plan) == []
    assert overlaps(made.models.plan) == []
    before = tree(tmp_path / "out")
    robosmi.generate_sketch(tmp_path / "out" / "models" / "plan.xmi", tmp_path / "again")
    shutil.rmtree(tmp_path / "input")
    again = tree(tmp_path / "again")
    assert again == before, "the stored plan gives the same bytes, without the source"
    shutil.copytree(FOLDER / name / "input", tmp_path / "input")
    shutil.rmtree(tmp_path / "again")


@pytest.mark.parametrize("name", sample(CASES, 28))
def test_the_sketch_compiles(name: str, tmp_path: Path, examples: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    made = migrated(name, tmp_path, examples, "filled")
    report = robosmi.compile_sketch(tmp_path / "out")
    said = [d.message for d in report.diagnostics]
    if "compiles" in options(name):
        assert not report.ok
    else:
        assert report.ok, said
        assert [f.message for f in made.models.plan.findings if f.rule == "RS337"] == []
        assert [d.message for d in report.diagnostics if d.location and d.location.path.endswith("adapters.h")] == []
    assert made.written


def test_no_case_is_left_over() -> None:
    """Every folder is a case, and every case says what it shows."""
    assert sorted(path.name for path in FOLDER.iterdir()) == CASES
    assert len({options(name)["about"] for name in CASES}) == len(CASES)
