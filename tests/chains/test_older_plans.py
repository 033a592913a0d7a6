"""A plan that an older version of the metamodel wrote loads in the current one, by a few rules of migration.

The older version is made here from the current one: an attribute and a class had other names, an attribute was in another unit.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import RuleError, SourceError
from robosmi.files.files import digest
from robosmi.metamodels import migration
from robosmi.model import load_model, versions
from robosmi.plugins import Registry, registry
from robosmi.transform import Flock
from robosmi.transform.migration import ModelMigration
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.queries.text_changes import all_changes
from tests.running import run, tree

ROOT = Path(__file__).parents[2]
OLD, NEW = "http://robosmi.org/migration/0", "http://robosmi.org/migration/2"


def rules(f: Flock) -> None:
    """From version 0 to 1: sourcePin was called port, Connection was called Wiring, confidences were percentages."""
    f.retype("Wiring", "Connection")

    @f.migrate("PortBinding")
    def _(o: Any, m: Any) -> None:
        m.sourcePin = o.port

    @f.migrate("Decision")
    def _(o: Any, m: Any) -> None:
        m.confidence = o.percent / 100


def renamed(text: str) -> str:
    """The current metamodel as version 0 had it."""
    text = text.replace(NEW, OLD).replace('name="sourcePin"', 'name="port"').replace('name="Connection"', 'name="Wiring"')
    return text.replace("#//Connection", "#//Wiring").replace('name="confidence"', 'name="percent"')


@pytest.fixture(scope="module")
def sketch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("sketch") / "out"
    robosmi.migrate([ROOT / "docs" / "examples" / "line_follower" / "line_follower.c"], out)
    return out / "models"


@pytest.fixture
def old_plan(sketch: Path, tmp_path: Path) -> Path:
    """The stored models, with a plan of version 0."""
    for file in sketch.rglob("*"):
        if file.is_file():
            target = tmp_path / "models" / file.relative_to(sketch)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(file.read_bytes())
    plan = tmp_path / "models" / "plan.xmi"
    text = plan.read_text(encoding="utf-8").replace(NEW, OLD).replace(" sourcePin=", " port=")
    text = re.sub(r' confidence="([^"]+)"', lambda m: f' percent="{float(m[1]) * 100}"', text)
    text = text.replace('xsi:type="migration:Connection"', 'xsi:type="migration:Wiring"')
    plan.write_text(text, encoding="utf-8")
    return plan


@pytest.fixture
def step(tmp_path: Path) -> ModelMigration:
    """The step from 0 to 1."""
    for name in ("ccode", "hardware", "platform", "trace"):
        (tmp_path / f"{name}.ecore").write_bytes((ROOT / "metamodels" / f"{name}.ecore").read_bytes())
    ecore = tmp_path / "migration0.ecore"
    ecore.write_text(renamed((ROOT / "metamodels" / "migration.ecore").read_text(encoding="utf-8")), encoding="utf-8")
    return ModelMigration(ecore, rules)


@pytest.fixture
def registered(step: ModelMigration, monkeypatch: pytest.MonkeyPatch) -> ModelMigration:
    """The step, registered as content does it."""
    entries = {**registry().entries, versions.KIND: {OLD: "the step"}}
    monkeypatch.setattr(versions, "registry", lambda: Registry(entries))
    monkeypatch.setattr(versions, "load", {"the step": step}.__getitem__)
    return step


def summary(plan: migration.MigrationPlan) -> list[Any]:
    """The facts of a plan that must survive the migration."""
    return [
        [(b.name, b.sourcePin, round(b.confidence, 9)) for b in plan.portBindings],
        [(b.connection and b.connection.name, b.pin and b.pin.label) for b in plan.portBindings],
        [(c.name, c.signal.name, [x.connectorId for x in c.connectors]) for c in plan.connections],
        [(d.action.name, *d.rules, d.element and d.element.line) for d in plan.dispositions],
        [(e.startOffset, e.endOffset, e.replacement, e.unit and e.unit.path) for e in all_changes(plan)],
        [(t.rule, t.message) for t in plan.tasks],
        [(i.path, i.digest) for i in plan.inputs],
        [(x.rule, len(x.sources), len(x.targets)) for x in (plan.trace.links if plan.trace else [])],
        plan.board and plan.board.name,
        plan.source and plan.source.name,
    ]  # fmt: skip


@pytest.mark.usefixtures("registered")
def test_an_older_plan_is_the_same_as_the_current_one(old_plan: Path, sketch: Path) -> None:
    old, current = load_model(old_plan), load_model(sketch / "plan.xmi")
    assert isinstance(old, migration.MigrationPlan)
    assert isinstance(current, migration.MigrationPlan)
    assert summary(old) == summary(current)
    assert len(current.portBindings) > 2


@pytest.mark.usefixtures("registered")
def test_a_sketch_is_generated_from_an_older_plan(old_plan: Path, sketch: Path, tmp_path: Path) -> None:
    assert load_models(old_plan).plan.name == "line_follower"
    robosmi.generate_sketch(old_plan, tmp_path / "old")
    robosmi.generate_sketch(sketch / "plan.xmi", tmp_path / "current")
    for file in (tmp_path / "current").rglob("*"):
        if file.is_file():
            assert (tmp_path / "old" / file.relative_to(tmp_path / "current")).read_bytes() == file.read_bytes(), file.name


def test_an_older_plan_without_a_step_is_refused(old_plan: Path) -> None:
    for read in (load_model, load_models):
        with pytest.raises(SourceError, match=f"the model is of '{OLD}', and this version of RoboSMi reads '{NEW}'") as refused:
            read(old_plan)
        assert refused.value.fix == "migrate the program again"
        assert str(refused.value.location) == f"{old_plan}:2"


@pytest.mark.parametrize("words", [["check"], ["generate", "-o", "{folder}/sketch"], ["query", "1"]], ids=" ".join)
def test_commands_refuse_an_older_plan(words: list[str], old_plan: Path, tmp_path: Path) -> None:
    before = tree(tmp_path)
    command, *options = words
    outcome = run(command, old_plan, *(option.format(folder=tmp_path) for option in options), "--json")
    assert outcome.code != 0
    [finding] = outcome.document["findings"]
    assert finding["fix"] == "migrate the program again"
    assert (finding["location"]["path"], finding["location"]["line"]) == (str(old_plan), 2)
    assert tree(tmp_path) == before


def test_a_program_can_be_migrated_over_an_older_plan(tmp_path: Path) -> None:
    program = ROOT / "docs" / "examples" / "line_follower" / "line_follower.c"
    assert run("migrate", program, "-o", tmp_path / "out").code == 0
    plan, record = tmp_path / "out" / "models" / "plan.xmi", tmp_path / "out" / ".robosmi.json"
    current = plan.read_bytes()
    plan.write_bytes(current.replace(NEW.encode(), OLD.encode()))
    record.write_text(record.read_text().replace(digest(current), digest(plan.read_bytes())))
    outcome = run("migrate", program, "-o", tmp_path / "out", "--json")
    assert outcome.code == 0
    [warning] = [finding for finding in outcome.document["findings"] if finding["rule"] == "RS414"]
    assert OLD in warning["message"]
    assert plan.read_bytes() == current


def test_a_step_that_forgets_a_renamed_root_is_refused(old_plan: Path, registered: ModelMigration) -> None:
    registered.rules = lambda f: f.delete("MigrationPlan")
    with pytest.raises(RuleError, match=r"migrating .* leaves \d+ roots instead of one"):
        load_model(old_plan)


def test_current_plans_do_not_ask_for_steps(sketch: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(versions, "registry", lambda: pytest.fail("asked"))
    assert isinstance(load_model(sketch / "plan.xmi"), migration.MigrationPlan)
