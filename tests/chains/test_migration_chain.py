"""The chain of a migration: an answer does again what depends on it, inputs are read once, a step can be another."""

from __future__ import annotations

import doctest
import gc
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, get_type_hints

import pytest

from robosmi.chain.run import named
from robosmi.chain.steps import Step, StepResult
from robosmi.errors import RuleError
from robosmi.metamodels import migration
from robosmi.project import Project, default_number
from robosmi.transformations.chains import migrate as chain_module
from robosmi.transformations.chains.analyse import analyse
from robosmi.transformations.chains.hardware import hardware, hardware_chain
from robosmi.transformations.chains.library_steps import library_decisions
from robosmi.transformations.chains.migrate import migrate, migration_chain, plan_migration
from robosmi.transformations.m2m.choices.library_choice import LibraryModels
from tests.new_objects import only_new_objects

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "docs" / "examples"
FOLLOWER = EXAMPLES / "line_follower"
MONITOR = EXAMPLES / "environmental_monitoring"
PROGRAM = sorted(MONITOR.glob("*.c"))
DRAWING = MONITOR / "environmental_monitoring_robot.fzz"


class Told:
    """The names of the steps that were done, in their order."""

    def __init__(self) -> None:
        self.steps: list[str] = []

    def __call__(self, step: Step, result: StepResult | None) -> None:
        if result is not None:
            self.steps.append(step.name)


def given(**more: Any) -> dict[str, Any]:
    """The inputs of the monitoring robot's migration."""
    names = ("project", "target_name", "source_platform", "history", "adapters", "widths")
    none = {**dict.fromkeys(names), "include_dirs": (), "defines": ()}
    return {**none, "files": PROGRAM, "hardware": DRAWING, "libraries": {}, "bind": {}, **more}


def test_an_answer_does_again_what_depends_on_it_and_gives_the_plan_that_flags_give() -> None:
    told = Told()
    run = migration_chain().start(progress=told, **given())
    first = run.value("models").to_files()
    everything = list(told.steps)
    assert "read the program" in everything
    told.steps.clear()
    run.give(libraries=_answers(run))
    again = run.value("models").to_files()
    assert told.steps == ["collect the libraries that persons chose", "choose libraries", "put the plan together"]
    assert again != first
    fresh = plan_migration(PROGRAM, hardware=DRAWING, libraries=_answers(run)).to_files()
    assert again == fresh
    run.give(libraries={})
    assert run.value("models").to_files() == first


def _answers(run: Any) -> dict[str, str]:
    """An answer for each component: none needs a library."""
    choices = run.value("library_decisions")[0]
    return {f"#{choice.component.elementId}": "none" for choice in choices}


def test_another_drawing_does_not_read_the_program_again() -> None:
    told = Told()
    run = migration_chain().start(progress=told, **given(project=Project()))
    run.value("models")
    told.steps.clear()
    run.give(hardware=FOLLOWER / "line_following_robot.fzz")
    changed = run.value("models").to_files()
    assert "read the drawing" in told.steps
    assert {"read the program", "look up the target"} & {*told.steps} == set()
    assert "judge the program's elements" in told.steps  # a board with another microcontroller has other adapters
    assert changed == plan_migration(PROGRAM, project=Project(), hardware=FOLLOWER / "line_following_robot.fzz").to_files()


def _sure_of_nothing(table: str, key: str) -> float:
    return 1.01 if (table, key) == ("choices", "limit") else default_number(table, key)


def test_what_a_person_answers_is_asked_for_once_and_is_in_the_sketch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = (FOLLOWER / "line_follower.c").read_bytes()
    (tmp_path / "line_follower.c").write_bytes(source)  # no robosmi.toml beside it
    monkeypatch.setattr(chain_module, "default_number", _sure_of_nothing)
    asked: list[Sequence[Mapping[str, Any]]] = []

    def ask(choices: Sequence[Mapping[str, Any]]) -> Mapping[str, str]:
        asked.append(choices)
        return {f"#{choice['component_model_index']}": "none" for choice in choices}

    told = Told()
    made = migrate(
        [tmp_path / "line_follower.c"],
        tmp_path / "out",
        hardware=FOLLOWER / "line_following_robot.fzz",
        ask=ask,
        progress=told,
        history=str(tmp_path / "history.sqlite"),
        adapters=None,
    )
    assert len(asked) == 1
    assert asked[0]
    assert [c.component.title for c in made.models.plan.libraryChoices if c.open and c.component is not None] == []
    assert {told.steps.count(name) for name in ("read the program", "read the drawing", "judge the program's elements")} == {1}
    assert told.steps.count("choose libraries") == 2


OPENED = """
import json, os, sys
seen = []
sys.addaudithook(lambda event, args: seen.append(args[0]) if event == "open" and isinstance(args[0], (str, bytes)) else None)
import robosmi
robosmi.migrate([sys.argv[1]], sys.argv[3], hardware=sys.argv[2])
paths = [os.path.realpath(os.fsdecode(p)) for p in seen]
print(json.dumps([paths.count(os.path.realpath(name)) for name in sys.argv[1:3]]))
"""


@pytest.mark.parametrize("table", [False, True], ids=["drawing", "pin table"])
def test_each_input_is_read_once(table: bool, tmp_path: Path) -> None:
    drawing = (
        ROOT / "tests/transformations/t2m/drawing_readers/pin_table/robot.csv" if table else FOLLOWER / "line_following_robot.fzz"
    )
    command = [sys.executable, "-c", OPENED, str(FOLLOWER / "line_follower.c"), str(drawing), str(tmp_path / "out")]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    assert json.loads(done.stdout) == [1, 1]


def test_a_step_can_be_another_persons() -> None:
    """A researcher's own decision about libraries: none is ever needed; everything else is as it was."""

    def never(drawing: Any, board: Any, target: Any) -> tuple[list[migration.LibraryChoice], LibraryModels]:
        reached = {c.component.elementId: c.component for c in drawing.hardware.connections}
        made = [
            migration.LibraryChoice(component=c, choice="none", chosenBy=migration.ChosenBy.rule, confidence=1.0)
            for c in reached.values()
        ]
        return made, LibraryModels(target, board)

    chain = migration_chain()
    chain.replace("choose libraries", never)
    plan = plan_migration([FOLLOWER / "line_follower.c"], chain=chain).plan
    usual = plan_migration([FOLLOWER / "line_follower.c"]).plan
    assert {c.choice for c in plan.libraryChoices} == {"none"}
    assert {c.choice for c in usual.libraryChoices} != {"none"}
    assert [d.action for d in plan.dispositions] == [d.action for d in usual.dispositions]
    assert [b.choice for b in plan.portBindings] == [b.choice for b in usual.portBindings]


def _none(drawing: Any) -> Any:
    return None


def _half(drawing: Any) -> Any:
    return [], "no libraries"


def _no_choices(drawing: Any, board: Any, target: Any) -> Any:
    return [7], LibraryModels(target, board)


def _raises(drawing: Any) -> Any:
    return drawing["hardware"]


@pytest.mark.parametrize(
    ("function", "said"),
    [
        (_none, "made None for 'library_decisions'; expected is tuple[list[LibraryChoice], LibraryModels]"),
        (_half, "made a tuple of 2 (list, str) for 'library_decisions'; expected is tuple"),
        (_no_choices, "the step 'put the plan together' of the chain 'migrate', in which 'choose libraries' was replaced, fails"),
        (_raises, "the step 'choose libraries' of the chain 'migrate', in which 'choose libraries' was replaced, fails"),
    ],
)
def test_what_a_persons_step_makes_wrong_is_said_with_the_step_and_what_is_expected(function: Any, said: str) -> None:
    chain = migration_chain()
    chain.replace("choose libraries", function)
    with pytest.raises(RuleError) as wrong:
        plan_migration([FOLLOWER / "line_follower.c"], chain=chain)
    assert said in str(wrong.value)
    assert "do: " in str(wrong.value)


def test_the_page_says_what_each_step_makes() -> None:
    page = (ROOT / "docs" / "how-to" / "change-a-step.md").read_text(encoding="utf-8")
    rows = [f"| {s.name} | `{s.makes}` | `{named(get_type_hints(s.function)['return'])}` |" for s in _calls()]
    assert re.findall(r"^\| [^|]+ \| `[^|]+` \| `[^|]+` \|$", page, re.MULTILINE) == rows


def _calls() -> list[Step]:
    return [step for step in migration_chain().steps if step.function is not None]


def test_a_step_that_was_not_replaced_is_not_wrapped() -> None:
    chain = migration_chain()
    chain.replace("choose libraries", library_decisions)
    chain.replace("open the history", _raises_at_once)
    with pytest.raises(RuleError, match="'open the history' was replaced"):
        plan_migration([FOLLOWER / "line_follower.c"], chain=chain)
    with pytest.raises(TypeError):
        plan_migration([FOLLOWER / "line_follower.c"], bind=7)  # type: ignore[arg-type]


def _raises_at_once() -> Any:
    raise ZeroDivisionError


def test_the_examples_of_the_page_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = ROOT / "docs" / "how-to" / "change-a-step.md"
    for name in ("line_follower.c", "line_following_robot.fzz"):
        shutil.copy(FOLLOWER / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    names: dict[str, Any] = {}
    exec(compile(blocks[0], str(page), "exec"), names)
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    for number, block in enumerate(blocks[1:], 1):
        case = parser.get_doctest(block, names, f"block {number}", str(page), 0)
        said: list[str] = []
        assert runner.run(case, out=said.append, clear_globs=False).failed == 0, "".join(said)
        names = case.globs


def _nothing() -> list[Any]:
    return []


def test_analyse_and_hardware_are_chains_too() -> None:
    told = Told()
    hardware(FOLLOWER / "line_following_robot.fzz", progress=told)
    assert told.steps == ["read the drawing", "check the circuit", "put the result together"]
    told.steps.clear()
    analyse([FOLLOWER / "line_follower.c"], source_platform="propeller", progress=told)
    steps = ["look up the source platform", "look up the source board", "read the program", "analyse the program"]
    assert told.steps == steps
    unchecked = hardware_chain()
    unchecked.replace("check the circuit", _nothing)
    assert {f.rule for f in hardware(FOLLOWER / "line_following_robot.fzz", chain=unchecked).findings} == set()


def test_models_of_migrations_are_let_go() -> None:
    """A program that migrates many others holds the models of none, but for those that the constraints saw last."""

    def plans() -> int:
        gc.collect()
        return sum(isinstance(one, migration.MigrationPlan) for one in gc.get_objects())

    with only_new_objects():
        for _ in range(4):
            plan_migration(
                [FOLLOWER / "line_follower.c"], hardware=FOLLOWER / "line_following_robot.fzz", bind={"leftQTI": "D10"}
            )
        assert plans() <= 1
