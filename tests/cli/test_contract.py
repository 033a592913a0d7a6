"""The JSON contract of each command, key by key, on both case studies (design/contracts.md)."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from robosmi.cli.commands import doctor
from robosmi.cli.main import COMMANDS, FIRST_COMMANDS, GROUPS
from tests.running import run
from tests.tools import require_tools
from tests.transformations.t2m.fritzing.support import LABELS

UNIT_KEYS: dict[str, set[str]] = {
    "includes": {"name", "form", "line", "kind", "found"},
    "functions": {"name", "line", "end_line", "returns", "parameters", "storage"},
    "prototypes": {"name", "line"},
    "globals": {"name", "type", "line", "storage"},
    "macros": {"name", "line", "parameters"},
    "types": {"name", "kind", "line"},
    "platform_calls": {"name", "count", "lines", "header", "signature", "signature_source", "macro", "in_macro"},
    "unknown_calls": {"name", "count", "lines", "signature"},
    "standard_calls": {"name", "header", "explicit_include"},
    "platform_symbols": {"name", "kind", "lines"},
    "platform_types": {"name", "header", "lines"},
    "user_calls": {"name", "count", "lines"},
    "cogs": {"via", "function", "line"},
    "pin_uses": {"pin", "expression", "origin", "function", "direction", "line"},
}
"""List of a unit -> the keys of its entries."""

MAIN_KEYS = {"loop_kind", "loop_line", "statements_before", "statements_after", "hoisted_locals", "loop_exits"}
MAPPING_KEYS = {
    "board", "board_model_index", "pin", "board_connectors", "component", "component_model_index", "connectors", "role", "driver",
    "signal", "name", "via", "drives", "senses",
}  # fmt: skip
ROLES = {"Board", "Input", "Output", "Both", "Passive", "Power", "Decoration", "Unknown"}
ACTIONS = {"retain", "adapt", "drop", "hoist", "rewrite", "unsupported"}
PLAN_KEYS = {"dispositions", "call_sites", "functions", "bindings", "libraries", "tasks", "open_choices"}
CANDIDATE_KEYS = {"library", "header", "version", "score", "reasons"}
COMPILE_KEYS = {"ok", "fits", "fits_on", "tool", "flash_bytes", "ram_bytes", "libraries", "diagnostics"}


def drawing_of(source: Path) -> Path:
    """The one drawing beside a source."""
    return next(source.parent.glob("*.fzz"))


def test_analyse_has_all_keys_of_the_contract(case_study: Path) -> None:
    outcome = run("analyse", case_study, "--json")
    assert (outcome.code, outcome.err) == (0, "")
    (unit,) = outcome.result["units"]
    assert unit["path"] == str(case_study)
    for name, keys in UNIT_KEYS.items():
        assert all(set(entry) >= keys for entry in unit[name]), name
    assert set(unit["main"]) >= MAIN_KEYS
    assert set(unit["coverage"]) == {"calls_in_text", "calls_in_model", "unresolved"}
    assert unit["coverage"]["calls_in_text"] == unit["coverage"]["calls_in_model"] > 0
    assert {i["kind"] for i in unit["includes"]} <= {"standard", "platform", "local"}
    assert {c["signature_source"] for c in unit["platform_calls"]} <= {"header", "repository"}
    for use in unit["pin_uses"]:
        assert use["origin"] in ("literal", "constant", "array", "runtime", "convention")
        assert use["direction"] in ("in", "out", "both", "unknown")


def test_analyse_without_main_says_null_and_succeeds(cases: Path) -> None:
    outcome = run("analyse", cases / "no_main.c", "--json")
    assert outcome.code == 0
    assert outcome.result["units"][0]["main"] is None


def test_hardware_has_all_keys_of_the_contract(case_study: Path) -> None:
    outcome = run("hardware", drawing_of(case_study), "--json")
    assert (outcome.code, outcome.err) == (0, "")
    result = outcome.result
    assert [set(board) for board in result["boards"]] == [{"title", "model_index", "module_id"}]
    for component in result["components"]:
        assert set(component) >= {"title", "model_index", "module_id", "part_title", "role", "driver", "evidence"}
        assert component["role"] in ROLES
    assert result["mappings"]
    for mapping in result["mappings"]:
        assert set(mapping) >= MAPPING_KEYS
        assert mapping["signal"] in ("read", "write", "bus")
        assert all(set(c) == {"id", "name"} for c in [*mapping["board_connectors"], *mapping["connectors"]])


def test_hardware_names_are_the_papers(line_follower: Path) -> None:
    mappings = run("hardware", drawing_of(line_follower), "--json").result["mappings"]
    assert {m["pin"]: m["name"] for m in mappings} == {
        "D8": "BasicServo2WriteP1", "D9": "BasicServo1WriteP1", "D10": "HIH40302ReadP1", "D11": "HIH40301ReadP1",
        "D12": "Red633nmLED1WriteP1",
    }  # fmt: skip


@pytest.mark.parametrize("case", ["line_follower", "environmental_monitoring"])
def test_hardware_mapping_equals_the_labels(case: str, examples: Path) -> None:
    drawing = next((examples / case).glob("*.fzz"))
    expected = json.loads((LABELS / f"{drawing.stem}.expected.json").read_text())
    mappings = run("hardware", drawing, "--json").result["mappings"]
    keys = ("board_model_index", "pin", "component_model_index", "connectors", "signal")
    assert [{k: m[k] for k in keys} for m in mappings] == [{k: m[k] for k in keys} for m in expected["mappings"]]


def test_recommend_ranks_every_mapped_component_of_a_drawing(case_study: Path) -> None:
    outcome = run("recommend", drawing_of(case_study), "--json")
    mapped = {m["component_model_index"] for m in run("hardware", drawing_of(case_study), "--json").result["mappings"]}
    assert outcome.code == 0
    recommendations = outcome.result["recommendations"]
    assert {r["id"] for r in recommendations} == mapped
    for recommendation in recommendations:
        check_recommendation(recommendation)


def test_recommend_takes_components_as_json(tmp_path: Path) -> None:
    listed = tmp_path / "components.json"
    listed.write_text(
        json.dumps([{"id": "a", "title": "DHT22", "family": None}, {"id": "b", "title": "Basic Servo", "later_key": 1}])
    )
    outcome = run("recommend", "--components", listed, "--ranker", "tfidf", "--json")
    assert outcome.code == 0
    assert [r["id"] for r in outcome.result["recommendations"]] == ["a", "b"]
    for recommendation in outcome.result["recommendations"]:
        check_recommendation(recommendation)


def check_recommendation(recommendation: dict[str, Any]) -> None:
    """One recommendation in the contract's form, best candidate first."""
    assert set(recommendation) >= {"id", "decision", "confidence", "candidates"}
    assert recommendation["decision"] in ("library", "optional", "none")
    candidates = recommendation["candidates"]
    assert candidates
    assert all(set(c) >= CANDIDATE_KEYS for c in candidates)
    assert all(c["header"] == Path(c["header"]).name and "<" not in c["header"] for c in candidates)
    scores = [c["score"] for c in candidates]
    assert scores == sorted(scores, reverse=True)


def test_migrate_has_all_keys_of_the_contract(case_study: Path, tmp_path: Path) -> None:
    outcome = run("migrate", case_study, "-o", tmp_path / "out", "--json", "--yes")
    assert (outcome.code, outcome.err) == (0, "")
    result = outcome.result
    assert Path(result["sketch"]) == tmp_path / "out" / case_study.stem
    check_plan(result["plan"], outcome.document)
    listed = {artifact["path"] for artifact in outcome.document["artifacts"]}
    written = {str(path) for path in (tmp_path / "out").rglob("*") if path.is_file() and path.name != ".robosmi.json"}
    assert listed == written


def test_generate_has_the_keys_of_migrate(case_study: Path, tmp_path: Path) -> None:
    first = run("migrate", case_study, "-o", tmp_path / "out", "--json")
    again = run("generate", tmp_path / "out" / "models" / "plan.xmi", "-o", tmp_path / "again", "--json")
    assert again.code == 0
    check_plan(again.result["plan"], again.document)
    assert again.result["plan"] == first.result["plan"]
    assert [t["message"] for t in again.document["tasks"]] == [t["message"] for t in first.document["tasks"]]


def check_plan(plan: dict[str, Any], document: dict[str, Any]) -> None:
    """A plan in the contract's form, with numbers that add up."""
    assert set(plan) >= PLAN_KEYS
    assert set(plan["dispositions"]) == ACTIONS
    assert sum(plan["dispositions"].values()) > 0
    sites = plan["call_sites"]
    assert set(sites) == {"total", "with_body", "todo", "by_header"}
    assert sites["total"] == sites["with_body"] + sites["todo"] > 0
    for key in ("total", "with_body", "todo"):
        assert sites[key] == sum(header[key] for header in sites["by_header"].values())
    assert plan["tasks"] == len(document["tasks"])
    assert plan["open_choices"] == sum(choice["open"] for choice in [*plan["bindings"], *plan["libraries"]])


def test_the_eight_platform_functions_of_the_paper_are_adapted(line_follower: Path, tmp_path: Path) -> None:
    plan = run("migrate", line_follower, "-o", tmp_path / "out", "--json").result["plan"]
    assert {adapter["name"] for adapter in plan["adapters"]} == {
        "set_output", "set_direction", "waitcnt", "high", "low", "get_state", "drive_speed", "pause",
    }  # fmt: skip


def test_compile_has_all_keys_of_the_contract(case_study: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    run("migrate", case_study, "-o", tmp_path / "out")
    outcome = run("compile", tmp_path / "out", "--json")
    assert outcome.code == 0, outcome.document["findings"]
    result = outcome.result
    assert set(result) >= COMPILE_KEYS
    assert (result["ok"], result["fits"], result["fits_on"]) == (True, True, "uno")
    assert 0 < result["flash_bytes"] <= 32256
    assert 0 < result["ram_bytes"] <= 2048
    for library in result["libraries"]:
        assert set(library) >= {"name", "source"}
        assert library["source"] in ("installed", "stand-in")


def test_a_stand_in_is_named_on_the_console_and_not_copied_into_the_sketch(migrated: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    before = sorted(p.name for p in (migrated / "line_follower").iterdir())
    outcome = run("compile", migrated)
    assert outcome.code == 0
    assert "Servo (stand-in)" in outcome.out
    assert sorted(p.name for p in (migrated / "line_follower").iterdir()) == before


def test_metamodels_export_hands_out_the_five_files(tmp_path: Path) -> None:
    outcome = run("metamodels", "export", tmp_path / "ecore", "--json")
    assert outcome.code == 0
    assert set(outcome.result) >= {"written", "skipped", "missing"}
    names = {"ccode.ecore", "hardware.ecore", "migration.ecore", "platform.ecore", "trace.ecore"}
    assert {p.name for p in (tmp_path / "ecore").iterdir()} == names
    assert {Path(p).name for p in outcome.result["written"]} == names


def test_metamodels_generate_makes_a_package_of_an_exported_metamodel(tmp_path: Path) -> None:
    run("metamodels", "export", tmp_path / "ecore")
    outcome = run("metamodels", "generate", tmp_path / "ecore" / "trace.ecore", "-o", tmp_path / "py", "--json")
    assert outcome.code == 0
    assert outcome.result["written"] == [str(tmp_path / "py" / "trace" / "__init__.py")]
    assert "class TextTrace(" in (tmp_path / "py" / "trace" / "__init__.py").read_text()


@pytest.mark.processes
def test_doctor_says_of_every_tool_whether_it_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    outcome = run("doctor", "--json")
    assert outcome.code == 0
    tools = {tool["name"]: tool for tool in outcome.result["tools"]}
    assert all(set(tool) >= {"name", "needed_for", "found", "version", "fix", "gives"} for tool in tools.values())
    assert tools["pyecore"]["found"]
    assert tools["avr-g++"]["found"] is None
    assert tools["avr-g++"]["fix"]
    assert [name for name, tool in tools.items() if not tool["found"] and not tool["gives"]] == []
    assert "gives: uploading a compiled sketch" in run("doctor").out


@pytest.mark.processes
def test_doctor_groups_tools_by_what_they_are_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    tools = run("doctor", "--json").result["tools"]
    groups = list(dict.fromkeys(tool["purpose"] for tool in tools))
    assert groups[:5] == ["read and migrate", "compile", "upload", "run the original", "simulate"]
    upload = {tool["name"]: tool["found"] for tool in tools if tool["purpose"] == "upload"}
    assert upload.keys() >= {"avrdude", "esptool", "dfu-util", "bossac", "teensy_loader_cli", "arduino-cli", "serial port"}
    lines = run("doctor").out.splitlines()
    heads = [line for line in lines if line.partition(":")[0] in groups and not line.startswith(" ")]
    assert [head.partition(":")[0] for head in heads] == groups
    assert heads[0] == "read and migrate: ready"
    for group, head in zip(groups, heads, strict=True):
        missing = {tool["name"] for tool in tools if tool["purpose"] == group and not tool["found"]}
        assert set(head.partition(": missing ")[2].split(", ")) - {""} == missing


def test_a_port_that_may_not_be_opened_is_missing(tmp_path: Path) -> None:
    port, gone = tmp_path / "ttyACM0", tmp_path / "ttyACM1"
    port.touch()
    usable = doctor.port_status([str(port), str(gone)])
    assert (usable.found, usable.fix) == (str(port), None)
    refused = doctor.port_status([str(gone)])
    assert refused.found is None
    assert refused.fix
    assert str(gone) in refused.fix
    none = doctor.port_status([])
    assert none.found is None
    assert none.fix != refused.fix


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_its_options(command: str) -> None:
    outcome = run(command, "--help")
    assert outcome.code == 0
    assert outcome.out.startswith(f"usage: robosmi {command}")
    assert "--json" in outcome.out


def test_each_step_ends_with_the_command_that_follows(line_follower: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    steps = [("analyse", line_follower), ("migrate", line_follower, "-o", out, "--yes"), ("choose", out, "--reopen", "leftQTI")]
    steps += [("check", out), ("undo", out), ("undo", out, "--list")]
    following = [next(line for line in reversed(run(*step).out.splitlines()) if line) for step in steps]
    expected = ["migrate", "compile", "open", "compile", "open", "undo"]
    assert [line.split()[:3] for line in following] == [["next:", "robosmi", name] for name in expected]
    assert "next: " not in run("migrate", line_follower, "-o", out, "--yes", "--json").out
    assert "next: " not in run("migrate", line_follower, "-o", out, "--yes", "--dry-run").out


def test_the_summary_names_every_command() -> None:
    outcome = run("--help")
    assert outcome.code == 0
    assert all(outcome.out.count(f"\n    {command} ") == 1 for command in COMMANDS)
    assert all(f"\n{group}:\n" in outcome.out for group in GROUPS)
    first = next(line for line in outcome.out.splitlines() if line.startswith("first: "))
    assert first.split(": ", 1)[1].split(", ") == [f"robosmi {command}" for command in FIRST_COMMANDS]
    assert set(FIRST_COMMANDS) < set(COMMANDS)


@pytest.mark.parametrize("command", ["migrate", "parts"])
def test_a_commands_own_options_stand_before_those_of_every_command(command: str) -> None:
    text = run(command, "--help").out
    own, common = text.split("options of every command:")
    assert all(option in common and f"\n  {option}" not in own for option in ("--json", "--sarif", "--verbose", "--fail-on"))


def test_without_json_a_person_reads_text_on_stdout_and_errors_on_stderr(line_follower: Path) -> None:
    good = run("analyse", line_follower)
    bad = run("analyse", line_follower.parent / "missing.c")
    assert "drive_speed" in good.out
    assert good.err == ""
    assert bad.out == ""
    assert bad.err.startswith("robosmi: error: ")


def test_an_error_under_json_is_a_document_too(line_follower: Path) -> None:
    outcome = run("analyse", line_follower.parent / "missing.c", "--json")
    document = outcome.document
    assert (outcome.code, document["ok"], document["result"]) == (3, False, None)
    (finding,) = document["findings"]
    assert finding["severity"] == "error"
    assert finding["location"]["path"].endswith("missing.c")
    assert finding["fix"]
    assert "missing.c" in outcome.err


def test_an_input_beyond_a_limit_has_a_rule_of_its_own(tmp_path: Path) -> None:
    program = tmp_path / "long.c"
    program.write_text("int main(void) {" + "again();\n" * 10_001 + "}\n")
    outcome = run("analyse", program, "--json")
    (finding,) = outcome.document["findings"]
    assert (outcome.code, finding["rule"], finding["location"]["line"]) == (3, "RS912", 10_001)
    assert finding["fix"]
    assert "[RS912]" in outcome.err


def test_findings_keep_their_ids_over_runs(cases: Path) -> None:
    first, second = (run("analyse", cases / "syntax.c", "--json").document["findings"] for _ in range(2))
    assert first
    assert [f["id"] for f in first] == [f["id"] for f in second]


def test_a_file_name_that_is_no_text_is_printed_all_the_same(tmp_path: Path, cases: Path) -> None:
    source = tmp_path / os.fsdecode(b"robot\xff.c")
    source.write_bytes((cases / "first_main.c").read_bytes())
    done = subprocess.run([sys.executable, "-m", "robosmi", "analyse", source, "--json"], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["result"]["units"][0]["path"].endswith("robot\udcff.c")


def test_hardware_writes_a_picture_and_a_table(tmp_path: Path, examples: Path) -> None:
    drawing = examples / "line_follower" / "line_following_robot.fzz"
    outcome = run("hardware", drawing, "--svg", tmp_path / "a.svg", "--write-table", tmp_path / "a.csv", "--json")
    assert outcome.code == 0
    assert [a["kind"] for a in outcome.document["artifacts"]] == ["picture", "pin table"]
    assert (tmp_path / "a.svg").read_text().count("Basic Servo1") >= 1
    again = run("hardware", tmp_path / "a.csv", "--json")
    assert [m["name"] for m in again.result["mappings"]] == [m["name"] for m in outcome.result["mappings"]]
    assert run("hardware", drawing, "--write-table", tmp_path / "a.txt").code == 2
