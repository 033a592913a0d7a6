"""RS345: a wrong pin in a finished program is found in the text itself, whatever made it."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import UsageError
from robosmi.metamodels import migration
from robosmi.project import Project
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.chains.stages import completion
from robosmi.transformations.chains.stages.compiler_errors import parsed_program
from robosmi.transformations.chains.stages.models import MigrationModels
from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.m2t.first_screen import decided, written
from robosmi.transformations.queries.flows.flow_reader import FlowReader
from robosmi.transformations.queries.macros.argument_places import TokenText
from robosmi.transformations.queries.plans.port_pins import PIN_RULE
from robosmi.transformations.queries.reports.work import Work
from robosmi.transformations.t2m.c_source.parsing.generated_pins import PinNames, PinPlace, follow_pins
from robosmi.transformations.t2m.c_source.parsing.generated_program import GeneratedProgram
from tests.running import run
from tests.tiers import sample
from tests.tools import require_engine, require_tools

CASES = Path(__file__).parent / "pin_faults"
PROGRAM = CASES / "robot.c"
FAULTS = tomllib.loads((CASES / "faults.toml").read_text())["fault"]


def fired(models: MigrationModels, old: str = "", new: str = "") -> list[migration.PlanFinding]:
    """What the check finds in the program of a plan in which one place is changed."""
    texts = {file.name: file.after or "" for file in completion.program(models).files}
    main = next(name for name in texts if name.endswith(".ino"))
    if old:
        assert texts[main].count(old) == 1, f"{old!r} is {texts[main].count(old)} times in the program"
        texts[main] = texts[main].replace(old, new)
    return completion.pin_check(models, parsed_program(models.plan, texts))


@pytest.fixture(scope="module")
def models() -> MigrationModels:
    return plan_migration([PROGRAM])


def test_a_right_program_has_no_finding(models: MigrationModels) -> None:
    assert [f.message for f in fired(models)] == []


@pytest.mark.parametrize("fault", FAULTS, ids=[fault["name"] for fault in FAULTS])
def test_each_planted_fault_is_found(fault: dict[str, str], models: MigrationModels) -> None:
    found = fired(models, fault["old"], fault["new"])
    assert found
    assert {f.rule for f in found} == {PIN_RULE}


def test_a_change_that_the_plan_lost_is_found() -> None:
    models = plan_migration([PROGRAM])
    next(b for b in models.plan.portBindings if b.sourcePin == 4).changes.clear()
    assert fired(models)


def test_a_look_up_that_the_plan_lost_is_found() -> None:
    models = plan_migration([PROGRAM])
    next(flow for flow in models.plan.portFlows if flow.changes).changes.clear()
    assert fired(models)


def test_a_file_that_the_parser_gives_up_is_not_called_ready(monkeypatch: pytest.MonkeyPatch) -> None:
    models = plan_migration([PROGRAM])
    monkeypatch.setattr("robosmi.transformations.t2m.c_source.parsing.clang.parse", lambda *_: None)
    texts = {file.name: file.after or "" for file in completion.program(models).files}
    found = completion.compiler_findings(models, parsed_program(models.plan, texts))
    assert [(f.rule, Path(f.path).name, "is not checked" in str(f.message)) for f in found] == [("RS337", "robot.c", True)]


CPP_PINS = Path(__file__).parent / "cpp_pins"
CONSTRUCTS = sorted([*CPP_PINS.glob("*.cpp"), *(folder for folder in CPP_PINS.iterdir() if folder.is_dir())])


def sources(program: Path) -> list[Path]:
    """The source files of a program that is one file or a folder."""
    return sorted(program.glob("*.cpp")) if program.is_dir() else [program]


@pytest.mark.parametrize("program", CONSTRUCTS, ids=lambda path: path.stem)
def test_a_pin_of_each_construct_of_cpp_moves_or_is_named(program: Path, tmp_path: Path) -> None:
    ports = {"P8": "D12"}
    if any(re.search(r"\b9\b", path.read_text()) for path in sources(program)):
        ports["P9"] = "D11"
    bound = robosmi.migrate(sources(program), tmp_path / "bound", bind=ports).models.plan
    assert [f.message for f in bound.findings if f.rule == PIN_RULE] == []
    assert not Work(bound).unread
    assert written(Work(bound)) == "nothing"
    named = {f.rule for f in bound.findings if f.line and f.rule in ("RS326", "RS327")}
    assert Work(bound).working == Work(bound).calls["total"] or named
    open_ = plan_migration(sources(program)).plan
    assert Work(open_).working < Work(open_).calls["total"] or written(Work(open_)) != "nothing"


@pytest.mark.parametrize("program", sample(CONSTRUCTS, 10), ids=lambda path: path.stem)
def test_the_sketch_of_each_construct_of_cpp_drives_the_pin_of_its_port(program: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    require_engine("simavr")
    robosmi.migrate(sources(program), tmp_path / "out", bind={"P8": "D12"})
    outcome = run("simulate", tmp_path / "out", "--seconds", "1", "--json")
    assert outcome.code == 0, outcome.err
    assert {e["pin"] for e in outcome.result["events"] if e.get("level") == 1} - {"D0", "D1"} == {"D12"}


HOSTILE = Path(__file__).parent / "hostile_pins"


def plan_of(case: str, bind: dict[str, str] | None = None, project: bool = True) -> MigrationModels:
    """The models of a program that misleads, with the pins of its project file."""
    path = HOSTILE / case
    files = [path] if path.is_file() else sorted(path.glob("*.c"))
    return plan_migration(
        files,
        bind=bind,
        project=None if project else Project(),
        hardware=pins if (pins := path.parent / "pins.csv").is_file() else None,
    )


def calls_ready(plan: migration.MigrationPlan) -> bool:
    counts = Work(plan).calls
    return counts["works"] == counts["total"]


@pytest.mark.parametrize(
    ("case", "bind"), [("c01_blockext.c", {"P3": "D9"}), ("c02_blockext2.c", {"P3": "D9", "P4": "D7", "P5": "D2"})]
)
def test_a_variable_declared_again_in_a_block_is_one_port(case: str, bind: dict[str, str]) -> None:
    models = plan_of(f"block_scope_extern/{case}", bind, project=False)
    assert [f.message for f in fired(models)] == []
    assert [flow.choice for flow in models.plan.portFlows] == ["target"]


def test_without_the_mend_the_check_finds_a_variable_declared_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(FlowReader, "_outer", lambda self, declared: ("element", id(declared)))
    assert fired(plan_of("block_scope_extern/c01_blockext.c"))
    assert fired(plan_of("block_scope_extern/c02_blockext2.c"))


OUTER = {
    "chosen.c": ("choose(1)(port(3))", "choose(0)(port(3))"),
    "member.c": ("get(0)->on(port(3))", "get(1)->on(port(3))"),
    "cast.c": ("((op)high)(port(3))", "(*(void (*)(int32_t))low)(port(3))"),
}
"""Program -> its calls whose callee has parentheses of its own, with the look-up at the right place."""


@pytest.mark.parametrize("case", OUTER)
def test_the_arguments_of_a_call_are_not_those_of_its_callee(case: str) -> None:
    models = plan_of(f"call_of_a_called_function/{case}")
    assert [f.message for f in fired(models)] == []
    text = next(file.after or "" for file in completion.program(models).files if file.name.endswith(".ino"))
    assert all(call in text for call in OUTER[case])


@pytest.mark.parametrize(("case", "line"), [("chosen.c", 7), ("member.c", 6), ("cast.c", 4)])
def test_without_the_mend_the_check_finds_the_other_list_of_arguments(
    case: str, line: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def first(self: TokenText, end: int) -> list[list[Token]] | None:
        start = self.at(end) - 1
        while self.tokens[start - 1][3] not in (";", "{", "}"):
            start -= 1
        return self.arguments(start)

    monkeypatch.setattr(TokenText, "last_arguments", first)
    assert line in {f.line for f in fired(plan_of(f"call_of_a_called_function/{case}"))}


def test_static_functions_of_one_name_have_ports_of_their_own() -> None:
    models = plan_of("static_names", {"P3": "D9", "P5": "D8"}, project=False)
    assert [f.message for f in fired(models)] == []
    assert calls_ready(models.plan)


def test_a_static_function_or_macro_of_another_file_leaves_an_adapter_its_name() -> None:
    models = plan_of("names_of_adapters", {"P5": "D8"}, project=False)
    files = {file.name.rpartition("/")[2]: file.after or "" for file in completion.program(models).files}
    assert "high_(3)" in files["b.cpp"]
    assert "low(3)" in files["c.cpp"]
    assert "void high(" in files["adapters.h"]
    assert "void low(" in files["adapters.h"]
    assert [f.message for f in fired(models)] == []
    assert {f.rule for f in models.plan.findings}.isdisjoint({"RS337"})
    assert Work(models.plan).calls["total"] == 3


def test_a_static_function_of_a_header_is_that_of_the_files_that_include_it() -> None:
    models = plan_of("names_in_a_header", {"P5": "D8"}, project=False)
    files = {file.name.rpartition("/")[2]: file.after or "" for file in completion.program(models).files}
    assert [files["a.ino"].count(f"{name}(8)") for name in ("high", "low")] == [1, 1]
    assert "high_(9)" in files["b.cpp"]
    assert "void high_(" in files["own.h"]
    assert fired(models) == []


def test_an_enumerator_that_is_a_word_of_cpp_is_renamed_and_moved() -> None:
    models = plan_of("renamed/words.c", {"private": "D9"}, project=False)
    text = next(file.after or "" for file in completion.program(models).files if file.name.endswith(".ino"))
    assert "enum { private_ = 9, public_ = 6 }" in text


@pytest.mark.parametrize("case", ["d01_twoa.c", "d06_macro_in_two"])
def test_ports_of_one_name_are_bound_by_their_numbers(case: str) -> None:
    models = plan_of(f"one_name_two_ports/{case}")
    bound = {b.sourcePin: b.pin.label for b in models.plan.portBindings if b.pin is not None}
    assert (bound[3], bound[5]) == ("D9", "D2")
    assert [f.message for f in fired(models)] == []


def test_a_name_of_two_ports_is_refused_with_their_numbers() -> None:
    with pytest.raises(UsageError) as caught:
        plan_of("one_name_two_ports/d02_dupstatic")
    assert "P3" in caught.value.message
    assert "P5" in caught.value.message


def test_without_the_mend_the_check_finds_two_ports_that_one_name_has_bound() -> None:
    models = plan_of("one_name_two_ports/d06_macro_in_two")
    three, five = (next(b for b in models.plan.portBindings if b.sourcePin == n) for n in (3, 5))
    three.name = five.name = "LED"
    five.connection, five.pin = three.connection, three.pin
    assert "P3, P5" in fired(models)[0].message


def test_calls_through_a_table_of_own_and_platform_functions_are_not_ready(tmp_path: Path) -> None:
    made = robosmi.migrate([HOSTILE / "function_pointer_ready" / "a02_fptable.c"], tmp_path / "out")
    assert {f.line for f in made.models.plan.findings if f.rule == PIN_RULE} == {9}
    assert not calls_ready(made.models.plan)
    assert written(Work(made.models.plan)) != "nothing"


def test_a_function_is_called_where_a_macro_has_its_name() -> None:
    models = plan_of("macros_named_as_functions/robot.c", {"P3": "D9", "P4": "D7", "P5": "D2"})
    text = next(file.after or "" for file in completion.program(models).files if file.name.endswith(".ino"))
    driven = [re.sub(r"port\((\d)\)", lambda m: {"3": "9", "4": "7", "5": "2"}[m[1]], line.strip()) for line in text.splitlines()]
    for line in ("high(9);", "if (input(7)) toggle(9);", "toggle(2);"):
        assert line in driven
    assert [f.message for f in fired(models)] == []
    assert calls_ready(models.plan)


def test_an_index_that_stands_before_its_array_is_followed() -> None:
    models = plan_of("indexes/q.c", {"P3": "D9", "P4": "D7", "P5": "D2", "P6": "D4"}, project=False)
    assert [b.sourcePin for b in models.plan.portBindings] == [3, 4, 5, 6]
    assert [f.message for f in fired(models)] == []


def test_the_designators_of_an_array_may_be_ranges_and_go_back() -> None:
    models = plan_of("indexes/ranges.c", project=False)
    assert sorted(b.sourcePin for b in models.plan.portBindings) == [3, 4, 7, 8, 10]
    assert [f.message for f in fired(models)] == []


def test_a_number_that_a_truth_value_takes_is_0_or_1() -> None:
    models = plan_of("converted/truths.c", project=False)
    assert sorted(b.sourcePin for b in models.plan.portBindings) == [1, 3, 5]
    assert [f.message for f in fired(models)] == []


def test_a_number_that_a_narrow_type_or_bit_field_takes_is_cut() -> None:
    models = plan_of("converted/widths.c", project=False)
    assert sorted(b.sourcePin for b in models.plan.portBindings) == [0, 1, 2, 3, 4, 5, 6, 7, 9, 10]
    assert [f.message for f in fired(models)] == []
    assert {f.rule for f in models.plan.findings}.isdisjoint({"RS326", "RS327"})


def test_what_a_bit_field_leaves_of_numbers_that_are_not_known_is_not_known() -> None:
    models = plan_of("converted/unknown_widths.c", project=False)
    [told] = [f.message for f in models.plan.findings if f.rule == "RS327"]
    assert "(lines 13, 14, 15)" in told


def test_a_negative_number_beside_an_unsigned_one_gives_no_port() -> None:
    """It is a large one there, so that `-1 < 0u` is 0; of that the list of ports says that it is not known."""
    models = plan_of("converted/signs.c", project=False)
    assert sorted(b.sourcePin for b in models.plan.portBindings) == [6, 16]
    assert [f.line for f in models.plan.findings if f.rule == "RS327"] == [5]


def test_calls_whose_ports_only_the_running_program_knows_are_not_said_to_need_nothing() -> None:
    work = Work(plan_of("indexes/run_time.c", {"P3": "D9"}, project=False).plan)
    assert work.calls["waits_for_port"] == 2
    assert "nothing" not in decided(work)


def test_a_program_that_calls_main_has_a_task(tmp_path: Path) -> None:
    made = robosmi.migrate([HOSTILE / "main_called" / "f04_mainrec.c"], tmp_path / "out")
    assert "RS337" in {f.rule for f in made.findings}
    assert written(Work(made.models.plan)) != "nothing"


@pytest.mark.parametrize("name", ["reg.c", "compound.c"])
def test_each_compound_assignment_of_a_register_compiles(name: str, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    made = robosmi.migrate([HOSTILE / "registers_nothing_open" / name], tmp_path / "out", bind={"P3": "D9"})
    assert robosmi.compile_sketch(made.sketch).ok


TEXTS = tomllib.loads((CASES / "followed.toml").read_text())["text"]


@pytest.mark.parametrize("text", TEXTS, ids=[text["name"] for text in TEXTS])
def test_what_reaches_a_pin_is_followed_through_cpp(text: dict[str, Any]) -> None:
    sketch = f'#include <Arduino.h>\n#include "adapters.h"\n{text["code"]}\n'.encode()
    program = GeneratedProgram({"robot.ino": sketch, "adapters.h": b"inline void high(int32_t p) { drive(p); }\n"}, "Arduino.h")
    functions = {"high": [PinPlace(0)], "port": [PinPlace(0, looked_up=True)]}
    names = PinNames(functions, frozenset({"port"}), {}, {"12": 1}, 255)
    assert [wrong.what for wrong in follow_pins(program, names).wrong] == text["what"]
