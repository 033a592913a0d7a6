"""The notebooks of the line follower run, and show models, plans, findings, rankings and wirings as people want to see them."""

from __future__ import annotations

import asyncio
import base64
import os
import re
import shutil
from pathlib import Path
from typing import Any

import pytest
from lxml import etree, html

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode, hardware, migration
from robosmi.model import Session
from robosmi.query import Map
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.ranking import Candidate, Recommendation
from robosmi.report.notebook import Findings
from robosmi.transformations.chains.recommend import Recommendations

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "docs" / "examples" / "line_follower"
pytestmark = pytest.mark.processes  # a kernel runs the notebook


@pytest.fixture(scope="module")
def shown(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """What the notebook of the models shows."""
    return outputs_of("line_follower.ipynb", tmp_path_factory.mktemp("notebook") / "example")


@pytest.fixture(scope="module")
def stepped(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """What the notebook of the steps shows."""
    return outputs_of("step_by_step.ipynb", tmp_path_factory.mktemp("notebook") / "example")


def outputs_of(name: str, folder: Path) -> dict[str, str]:
    """A notebook, run in a copy of its folder: last line of each cell of code -> what it shows, as HTML or text."""
    nbformat = pytest.importorskip("nbformat")
    client = pytest.importorskip("nbclient")
    shutil.copytree(EXAMPLE, folder)
    notebook = nbformat.read(folder / name, as_version=4)
    nbformat.validate(notebook)
    before = dict(os.environ)
    os.environ |= {"ROBOSMI_HOME": str(folder / "home"), "PYTHONPATH": str(ROOT), "IPYTHONDIR": str(folder / "ipython")}
    try:
        asyncio.run(client.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(folder)}}).async_execute())
    finally:
        os.environ.clear()
        os.environ.update(before)
    found = {}
    for cell in notebook.cells:
        if cell.cell_type == "code":
            found[cell.source.splitlines()[-1]] = _shown(cell.outputs)
    return found


def _shown(outputs: list[Any]) -> str:
    texts = []
    for output in outputs:
        data = output.get("data", {})
        texts.append(str(data.get("text/html") or data.get("text/plain") or output.get("text", "")))
    return "\n".join(texts)


def test_each_step_of_a_migration_shows_its_result(stepped: dict[str, str]) -> None:
    def of(beginning: str) -> str:
        return next(text for line, text in stepped.items() if line.startswith(beginning))

    assert "<img" in of("circuit")
    assert re.search(r"'Arduino Uno.D8',\s+'Basic Servo2.pulse'", of("sorted("))
    assert "HIH40302ReadP1" in of("Q(plan.connections)")
    assert re.search(r"adapt +#+ \d", of('print("\\n".join(f"{action'))
    assert "Servo" in of("robosmi.recommend_libraries")
    assert "leftQTI" in stepped["plan"]
    assert "const int32_t leftQTI" in of('print("\\n".join((made.sketch')


def test_a_program_is_a_tree(shown: dict[str, str]) -> None:
    tree = html.fromstring(shown["program"])
    assert tree.xpath("//details/summary[starts-with(., 'SourceUnit')]")
    assert "GetQTIState" in shown["program"]


def test_a_circuit_is_a_picture_with_its_components(shown: dict[str, str]) -> None:
    (data,) = re.findall(r'src="data:image/svg\+xml;base64,([^"]+)"', shown["circuit"])
    picture = etree.fromstring(base64.b64decode(data))
    assert picture.tag == "{http://www.w3.org/2000/svg}svg"
    assert "Basic Servo1" in shown["circuit"]


def test_findings_are_a_table_the_worst_first(shown: dict[str, str]) -> None:
    (key,) = [k for k in shown if k.endswith(".findings")]
    rules = [cell.text for row in html.fromstring(shown[key]).iter("tr") for cell in row.findall("td")[1:2]]
    assert rules == ["RS250", "RS240", "RS240"]


def test_a_ranking_names_libraries_with_reasons(shown: dict[str, str]) -> None:
    assert "Servo" in shown["ranking"]
    assert "<table" in shown["ranking"]


def test_a_plan_shows_what_is_open_and_its_wiring(shown: dict[str, str]) -> None:
    assert shown["models.plan"].count("<i>open</i>") >= 2
    assert "data:image/svg+xml" in shown["models.plan"]
    assert "abdrive.left_servo" in shown["Q(models.plan.portBindings).select(lambda b: b.open)"]
    assert "<i>open</i>" not in shown["made"]
    assert "13 of 13 calls have a body" in shown["made"]


def test_every_cell_shows_something_and_the_sketch_is_printed(shown: dict[str, str]) -> None:
    silent = [line for line, text in shown.items() if not text and not line.startswith(("import", "from"))]
    assert silent == []
    assert any("void setup()" in text for text in shown.values())


def test_texts_of_strangers_stay_text_in_a_notebook() -> None:
    odd = "<script>alert(1)</script>&\"'"
    finding = Finding("RS1", Severity.error, odd, Location(odd, 1), fix=odd)
    circuit = hardware.Circuit(name=odd)
    circuit.components.append(hardware.Component(title=odd, partTitle=odd, elementId="1", role=hardware.Role.Input))
    plan = migration.MigrationPlan(name=odd, circuit=circuit)
    plan.portBindings.append(migration.PortBinding(name=odd, choice=odd))
    program = ccode.Program(name=odd)
    program.units.append(ccode.SourceUnit(path=odd))
    component, candidate = ComponentQuery(odd, odd), Candidate(odd, odd, odd, 1.0, (odd,))
    ranking = Recommendations([component], [Recommendation(odd, "library", 1.0, (candidate,), (odd,))])
    for value in (Findings([finding]), circuit, plan, program, ranking):
        text = value._repr_html_()
        assert "alert(1)" in text
        assert "<script" not in text
        assert html.fromstring(f"<div>{text}</div>").xpath("//script") == []


def test_references_maps_and_sessions_are_tables(tmp_path: Path) -> None:
    plan = migration.MigrationPlan(name="blink")
    plan.portBindings.extend(migration.PortBinding(name=f"<b>{n}</b>") for n in range(2))
    ecore = tmp_path / "shelf.ecore"
    ecore.write_text(
        '<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" '
        'xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="shelf" nsURI="http://nowhere/shelf" nsPrefix="shelf"/>'
    )
    session = Session()
    session.metamodel(ecore)
    shown = {
        "2 elements": getattr(plan.portBindings, "_repr_html_", str)(),
        "key": Map({"<i>": plan.portBindings[0]})._repr_html_(),
        "shelf.ecore": session._repr_html_(),
    }
    for words, text in shown.items():
        assert words in text
        assert text.count("<tr") >= 2
        assert "<b>" not in text
        assert "<i>" not in text


def test_long_results_are_cut_and_say_so() -> None:
    many = Findings(Finding("RS1", Severity.info, f"m{n}") for n in range(300))
    assert "... and 100 more" in many._repr_html_()
    program = ccode.Program(name="many")
    program.units.extend(ccode.SourceUnit(path=f"{n}.c") for n in range(1000))
    text = program._repr_html_()
    assert len(text) < 100_000
    assert "more</p>" in text


def test_the_notebook_is_stored_without_its_outputs() -> None:
    text = (EXAMPLE / "line_follower.ipynb").read_text(encoding="utf-8")
    assert text.count('"outputs": []') == text.count('"cell_type": "code"')
