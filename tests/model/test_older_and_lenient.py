"""Models of an older version of one's own metamodel, and models that violate multiplicities, are read where one asks for it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.chain import read_chain
from robosmi.diagnostics import Severity
from robosmi.errors import RobosmiError, RuleError
from robosmi.model import Session, open_model, versions
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.driver import Model
from robosmi.model.emf import EmfModel
from robosmi.plugins import Registry, registry
from robosmi.query import ModelView
from robosmi.query.expression import evaluate
from robosmi.transform import Flock, ModelMigration
from robosmi.validate import EVL, Fail

HERE = Path(__file__).parent / "older"
OLD = "http://robosmi.org/test/doors/1"
MODEL, METAMODEL, UNNAMED = HERE / "house.xmi", HERE / "doors2.ecore", HERE / "unnamed.xmi"


def rules(f: Flock) -> None:
    """From version 1 to 2: doors are gates, and titles are labels."""
    f.retype("Door", "Gate")

    @f.migrate("Door")
    def _(o: Any, m: Any) -> None:
        m.label = o.title


@pytest.fixture
def registered(monkeypatch: pytest.MonkeyPatch) -> None:
    """The step, registered as a plug-in does it."""
    entries = {**registry().entries, versions.KIND: {OLD: "the step"}}
    monkeypatch.setattr(versions, "registry", lambda: Registry(entries))
    monkeypatch.setattr(versions, "load", {"the step": ModelMigration(HERE / "doors1.ecore", rules)}.__getitem__)


@pytest.mark.usefixtures("registered")
@pytest.mark.parametrize(
    "opened",
    [
        lambda: EmfModel.load(MODEL, METAMODEL, "H"),
        lambda: open_model(MODEL, name="H", metamodel=METAMODEL),
        lambda: Session().open_model(MODEL, name="H", metamodel=METAMODEL),
    ],
)
def test_a_model_of_an_older_version_of_ones_own_metamodel_is_migrated(opened: Callable[[], Model], tmp_path: Path) -> None:
    model = opened()
    assert evaluate("Gate.all.label", [model]) == ["front", "back"]
    assert ModelView(model).House.all.first().doors.size() == 2
    ModelView(model).save(tmp_path / "new.xmi")
    again = EmfModel.load(tmp_path / "new.xmi", METAMODEL, "H")
    assert evaluate("Gate.all.label", [again]) == ["front", "back"]
    assert OLD.encode() in MODEL.read_bytes()


def test_migrations_follow_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    first = ModelMigration(HERE / "doors1.ecore", rules, Metamodel.load(METAMODEL))
    second = ModelMigration(METAMODEL, lambda f: f.retype("Gate", "Portal"))
    entries = {**registry().entries, versions.KIND: {OLD: "first", OLD[:-1] + "2": "second"}}
    monkeypatch.setattr(versions, "registry", lambda: Registry(entries))
    monkeypatch.setattr(versions, "load", {"first": first, "second": second}.__getitem__)
    for _ in range(2):  # the steps are kept, and their models are not
        model = EmfModel.load(MODEL, HERE / "doors3.ecore", "H")
        assert evaluate("Portal.all.label", [model]) == ["front", "back"]


@pytest.mark.parametrize(
    ("rules", "said"),
    [
        (lambda f: f.retype("Door", "Gate"), "the new metamodel has no type 'Gate' that can have elements"),
        (lambda f: f.migrate("Door")(lambda o, m: setattr(m, "label", o.title)), "the rule 'migrate Door' fails"),
        (lambda f: None, "no such type that can have elements: 2 of doors::Door"),
    ],
)
def test_a_step_to_a_middle_version_that_names_none_is_told_how(
    rules: Callable[[Flock], Any], said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps = {"first": ModelMigration(HERE / "doors1.ecore", rules), "second": ModelMigration(METAMODEL, lambda f: None)}
    entries = {**registry().entries, versions.KIND: {OLD: "first", OLD[:-1] + "2": "second"}}
    monkeypatch.setattr(versions, "registry", lambda: Registry(entries))
    monkeypatch.setattr(versions, "load", steps.__getitem__)
    with pytest.raises(RuleError, match=said) as told:
        EmfModel.load(MODEL, HERE / "doors3.ecore", "H")
    fix = str(told.value.fix)
    assert f"the step of '{OLD}' leads to http://robosmi.org/test/doors/3" in fix
    assert f"if it leads to '{OLD[:-1]}2', write ModelMigration(OLD, rules, Metamodel.load(FILE)) with its file" in fix
    assert len(fix) < 1200


@pytest.mark.parametrize(
    ("rules", "left_out"),
    [
        (lambda f: None, {"doors::Door": 2}),
        (lambda f: f.retype("Door", "Gate", when=lambda o: o.title == "front"), {"doors::Door": 1}),
        (lambda f: f.delete("Door", when=lambda o: o.title == "front"), {"doors::Door": 1}),
        (lambda f: f.delete("Door"), {}),
        (lambda f: f.retype("Door", "Gate"), {}),
        (lambda f: f.migrate("Door"), {}),
    ],
)
def test_elements_that_a_step_would_lose_without_a_word_are_told(rules: Callable[[Flock], Any], left_out: dict[str, int]) -> None:
    f = Flock(EmfModel.load(MODEL, HERE / "doors1.ecore"), EmfModel((), METAMODEL))
    rules(f)
    f.run()
    assert f.left_out == left_out
    step = ModelMigration(HERE / "doors1.ecore", rules, Metamodel.load(METAMODEL))
    (root,) = EmfModel.load(MODEL, HERE / "doors1.ecore").roots
    if not left_out:
        assert len(step({MODEL: root})) == 1
        return
    with pytest.raises(RuleError, match=rf"{OLD}: elements are left out .*: {left_out['doors::Door']} of doors::Door") as told:
        step({MODEL: root})
    assert told.value.fix == 'write what becomes of them: retype("doors::Door", NEW), delete("doors::Door") or a rule'


def test_a_chain_warns_of_elements_that_its_migration_leaves_out(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(HERE, tmp_path / "older"))
    (step,) = (each for each in read_chain(folder / "migration.toml").run().steps if each.findings)
    (found,) = step.findings
    assert (found.rule, found.severity) == ("RS530", Severity.warning)
    assert found.message.endswith("no such type that can have elements: 2 of doors::Door")


def test_a_rule_for_elements_that_become_nothing_is_told_so() -> None:
    f = Flock(EmfModel.load(MODEL, HERE / "doors1.ecore"), EmfModel((), HERE / "doors3.ecore"))
    f.migrate("Door")(lambda o, m: setattr(m, "label", o.title))
    with pytest.raises(RuleError, match="the rule 'migrate Door' fails") as told:
        f.run()
    assert told.value.fix == (
        "elements of Door become nothing, since the new metamodel has no such type, or they are deleted: "
        'write retype("Door", NEW), or ask whether there is a migrated element'
    )


@pytest.mark.usefixtures("registered")
def test_a_chain_reads_an_older_model(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(HERE, tmp_path / "older"))
    result = read_chain(folder / "chain.toml").run()
    assert [(step.state, step.findings) for step in result.steps] == [("done", []), ("done", [])]


@pytest.mark.usefixtures("registered")
def test_a_model_of_a_namespace_without_a_step_is_refused_as_before(tmp_path: Path) -> None:
    other = tmp_path / "other.xmi"
    other.write_text(MODEL.read_text(encoding="utf-8").replace(OLD, "http://robosmi.org/test/strange"), encoding="utf-8")
    with pytest.raises(RobosmiError, match=r"'http://robosmi\.org/test/strange' belongs to no metamodel known here"):
        EmfModel.load(other, METAMODEL)


def test_without_a_step_an_older_model_is_refused() -> None:
    with pytest.raises(RobosmiError, match="belongs to no metamodel known here"):
        EmfModel.load(MODEL, METAMODEL)


def test_a_missing_value_is_a_finding_unless_strict() -> None:
    with pytest.raises(RobosmiError, match="Gate has no 'label', which it needs"):
        EmfModel.load(UNNAMED, METAMODEL, strict=True)
    models: list[Any] = [EmfModel.load(UNNAMED, METAMODEL), open_model(UNNAMED, metamodel=METAMODEL, lenient=True)]
    for model in models:
        assert [finding.rule for finding in model.findings] == ["RS608"]
        v = EVL(model)
        v.context("Gate").constraint(name="Named")(lambda gate: gate.label is not None or Fail("none"))
        assert [finding.message for finding in v.run().unsatisfied] == ["none"]


def test_what_is_no_multiplicity_is_refused_all_the_same(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.xmi"
    wrong.write_text(UNNAMED.read_text(encoding="utf-8").replace('label="front"', 'lable="front"'), encoding="utf-8")
    with pytest.raises(RobosmiError, match="lable"):
        EmfModel.load(wrong, METAMODEL, lenient=True)


@pytest.mark.emf_objects("the chain compares what is there before the fix, too, which lacks a required value")
def test_a_chain_finds_and_mends_what_is_missing(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(HERE, tmp_path / "older"))
    chain = folder / "lenient.toml"
    assert [step.state for step in read_chain(chain).run().steps] == ["done", "failed"]
    mended = read_chain(chain).run(fix="first")
    assert mended.steps[-1].state == "done"
    assert evaluate("Gate.all.label", [EmfModel.load(folder / "unnamed.xmi", METAMODEL, "H")]) == ["front", "side"]
    chain.write_text(chain.read_text(encoding="utf-8").replace("= true", '= "yes"'), encoding="utf-8")
    with pytest.raises(RobosmiError, match="'lenient' of step 1 is neither true nor false"):
        read_chain(chain)
