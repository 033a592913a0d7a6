"""The stored models: closed among themselves, movable, judged by EMF, and with a trace for every line that was generated."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import SourceError
from robosmi.files.files import digest
from robosmi.metamodels import ccode, migration
from robosmi.model.ecore.metamodels import BUILT_IN
from robosmi.transformations.chains.stages.models import stored_models
from robosmi.transformations.queries.plans.plan import plan_json
from robosmi.transformations.queries.reports.work import work_json
from tests.emf_judge import judge_same
from tests.running import run
from tests.transformations.m2t.truth import report_faults

HREF = re.compile(r'href="([^"]*)"')


@pytest.fixture
def output(migrated_study: Path) -> Path:
    """The output folder of each case study."""
    return migrated_study


@pytest.fixture
def plan(output: Path) -> Any:
    """The stored plan."""
    return robosmi.load_model(output / "models" / "plan.xmi")


def test_all_references_are_relative_and_lead_to_a_file_of_the_folder(output: Path) -> None:
    stored = sorted((output / "models").glob("*.xmi"))
    assert [path.name for path in stored] == ["code.xmi", "hardware.xmi", "plan.xmi", "platform.xmi"]
    hrefs = {path.name: HREF.findall(path.read_text()) for path in stored}
    assert hrefs["plan.xmi"]
    for name, links in hrefs.items():
        for link in links:
            file, _, fragment = link.partition("#")
            assert (file or name) in hrefs, f"{name}: {link}"
            assert fragment.startswith("/")


def test_no_model_knows_where_it_was_made(output: Path, tmp_path: Path) -> None:
    for path in output.rglob("*"):
        if path.is_file() and path.suffix != ".fzz":
            assert str(tmp_path) not in path.read_text(), path


def test_sources_are_byte_copies(output: Path, case_study: Path) -> None:
    copies = {path.name: path.read_bytes() for path in (output / "models" / "source").iterdir()}
    drawing = next(case_study.parent.glob("*.fzz"))
    assert copies == {case_study.name: case_study.read_bytes(), drawing.name: drawing.read_bytes()}


def test_the_plan_has_the_digest_of_everything_it_was_made_from(output: Path, plan: Any) -> None:
    recorded = {entry.path: entry.digest for entry in plan.inputs}
    folder = output / "models"
    stored = {str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file()} - {"plan.xmi"}
    assert recorded == {name: digest((folder / name).read_bytes()) for name in stored}


def generated_files(output: Path) -> Iterator[tuple[str, int]]:
    """Every generated text below the sketch's folder, with its number of lines."""
    for path in sorted(output.rglob("*")):
        name = str(path.relative_to(output))
        if path.is_file() and not name.startswith(("models/", ".robosmi")):
            yield name, path.read_text().count("\n")


def test_every_generated_line_has_exactly_one_trace(output: Path, plan: Any) -> None:
    covered: dict[str, list[int]] = {}
    for text in plan.trace.texts:
        covered.setdefault(text.path, []).extend(range(text.line, text.endLine + 1))
    expected = {name: list(range(1, count + 1)) for name, count in generated_files(output)}
    assert {name: sorted(lines) for name, lines in covered.items()} == expected


def test_every_trace_names_a_step_of_the_method_and_an_element(output: Path, plan: Any) -> None:
    steps = {"code", "hardware", "libraries", "generation"}
    assert {text.step for text in plan.trace.texts} == steps
    for text in plan.trace.texts:
        assert len(text.elements) > 0, f"{text.path}:{text.line} ({text.rule})"
    assert {link.step for link in plan.trace.links} <= steps
    assert all(link.sources and link.targets for link in plan.trace.links)


def test_a_retained_line_is_traced_to_the_code_it_was_copied_from(output: Path, plan: Any) -> None:
    unit = plan.program.units[0]
    source = (output / "models" / unit.path).read_text().splitlines()
    sketch = (output / plan.name / f"{plan.name}.ino").read_text().splitlines()
    checked = 0
    for text in plan.trace.texts:
        located = [e for e in text.elements if isinstance(e, ccode.Located)]
        if not text.path.endswith(".ino") or text.rule not in ("retained code", "retained statement") or not located:
            continue
        copied = {line.strip() for line in source[min(e.line for e in located) - 1 : max(e.endLine for e in located)]}
        checked += sum(line.strip() in copied for line in sketch[text.line - 1 : text.endLine] if line.strip())
    assert checked >= 10


def test_the_numbers_of_the_report_add_up(output: Path, plan: Any) -> None:
    report = (output / plan.name / "MIGRATION.md").read_text()
    said = plan_json(plan) | work_json(plan, {})
    assert report_faults(plan, said, report) == []
    files = re.findall(r"^(\d+) elements?: (.*)\.$", report, re.MULTILINE)
    assert len(files) == len(plan.program.units) + 2  # and what is declared elsewhere, and all together
    for total, parts in files:
        assert int(total) == sum(int(part.split()[0]) for part in parts.split(", "))
    assert int(files[0][0]) == len(plan.dispositions) == sum(int(total) for total, _ in files[1:]) > 0


def test_the_calls_of_the_plan_are_the_calls_of_the_program(case_study: Path, plan: Any) -> None:
    (unit,) = run("analyse", case_study, "--json").result["units"]
    standard = {a.name for a in plan.adapterUses if a.function.header.kind.name == "standard"}
    assert standard <= {"sprintf"}  # what the target has, and does otherwise
    assert {a.name: len(a.calls) for a in plan.adapterUses if a.name not in standard} == {
        c["name"]: c["count"] for c in unit["platform_calls"] if c["count"]
    }


def test_every_adapter_and_placeholder_belongs_to_a_name_that_is_adapted(plan: Any) -> None:
    adapted = {d.element.name for d in plan.dispositions if d.action is migration.Action.adapt}
    assert adapted == {a.name for a in plan.adapterUses} | {s.name for s in plan.symbolUses}


def test_a_declaration_whose_port_is_bound_is_rewritten_and_the_others_are_retained(plan: Any) -> None:
    ports = {b.element.name for b in plan.portBindings if b.choice and isinstance(b.element, ccode.Variable)}
    rewritten = {
        d.element.name
        for d in plan.dispositions
        if isinstance(d.element, ccode.Variable) and d.action is migration.Action.rewrite
    }
    assert rewritten == ports
    assert ports


def test_every_function_of_the_program_is_judged(plan: Any) -> None:
    judged = {id(d.element) for d in plan.dispositions}
    functions = [d for unit in plan.program.units for d in unit.declarations if isinstance(d, ccode.Function)]
    assert functions
    assert all(id(function) in judged for function in functions)


def test_emf_finds_nothing_and_would_write_the_same_bytes(output: Path, examples: Path) -> None:
    metamodels = [examples.parents[1] / "metamodels" / f"{metamodel}.ecore" for metamodel in BUILT_IN]
    for name in ("plan.xmi", "code.xmi", "hardware.xmi", "platform.xmi"):
        verdict = judge_same(metamodels, output / "models" / name)
        assert re.search(r"^OK \d+ objects, 1 roots, 0 diagnostics", verdict.text, re.MULTILINE), verdict.text


@pytest.mark.parametrize(("made", "text"), [(False, "there is no such folder"), (True, "this folder holds no migration")])
def test_a_folder_without_a_migration_is_named(made: bool, text: str, tmp_path: Path) -> None:
    if made:
        (tmp_path / "out").mkdir()
    with pytest.raises(SourceError, match=text) as caught:
        stored_models(tmp_path / "out")
    assert caught.value.location is not None
    assert caught.value.location.path == str(tmp_path / "out")
