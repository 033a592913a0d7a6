"""A plug-in as it is installed: an entry point whose reader, endings and target every command then knows."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Any

import pytest

from robosmi.plugin_contracts import KINDS
from robosmi.plugins import others_may_offer

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PROGRAM = HERE.parent / "targets" / "program" / "beacon.c"


def command(*words: str | Path, path: Path, code: int | None = None, **variables: str) -> dict[str, Any]:
    """Run a command in a process with plug-ins on its path; `code` is the expected exit code, 0 or 1 if None."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(path), str(ROOT)])} | variables
    done = subprocess.run(
        [sys.executable, "-m", "robosmi", *map(str, words), "--json"], capture_output=True, text=True, env=environment, cwd=path
    )
    assert done.returncode in ((0, 1) if code is None else (code,)), done.stderr
    document: dict[str, Any] = json.loads(done.stdout)
    return document


def installed(folder: Path, *names: str) -> Path:
    """A folder with these plug-ins, to be on the path."""
    place = folder / "plugin"
    for name in names:
        shutil.copytree(HERE / name, place, dirs_exist_ok=True)
    return place


def stored_plan(folder: Path, path: Path) -> tuple[Path, list[dict[str, Any]]]:
    """The plan of a migration in a process with plug-ins, and the findings of the migration."""
    (folder / "wired.csv").write_text("pin,part\nD3,Red LED\nD5,Pushbutton\n")
    shutil.copy(PROGRAM, folder / "beacon.c")
    document = command("migrate", folder / "beacon.c", "--hardware", folder / "wired.csv", "-o", folder / "out", path=path)
    return next((folder / "out").rglob("plan.xmi")), document["findings"]


def test_constraints_of_a_plug_in_add_to_the_built_in_ones(tmp_path: Path) -> None:
    path = installed(tmp_path, "checks")
    plan, findings = stored_plan(tmp_path, path)
    built_in = command("check", plan, path=tmp_path)
    added = command("check", plan, path=path)
    assert added["result"]["models"][0]["constraints"] == built_in["result"]["models"][0]["constraints"] + 1
    found = [finding["message"] for finding in added["findings"] if finding["rule"] == "CH001"]
    assert found
    assert [finding["message"] for finding in findings if finding["rule"] == "CH001"] == found
    assert not any(finding["rule"] == "CH001" for finding in built_in["findings"])


def test_what_a_plug_in_prints_is_no_part_of_the_document(tmp_path: Path) -> None:
    path = installed(tmp_path, "checks")
    plan, _ = stored_plan(tmp_path, path)
    assert command("check", plan, path=path, CHECKS_PLUGIN="prints")["schema"] == "robosmi/1"


def test_a_constraint_whose_id_is_taken_is_refused_with_its_plug_in(tmp_path: Path) -> None:
    path = installed(tmp_path, "checks")
    plan, _ = stored_plan(tmp_path, path)
    (finding,) = command("check", plan, path=path, code=3, CHECKS_PLUGIN="taken")["findings"]
    assert finding["message"] == "the id 'RS702' of the constraint has_our_id of checks 2.1 is taken by a built-in rule"
    assert finding["fix"] == "give it a unique id"


@pytest.mark.parametrize(("offer", "said"), [
    ("rule", "the id 'RS203' of the constraint has_the_id_of_a_reader of checks 2.1 is taken by a built-in rule"),
    ("twice", "the id 'CH001' of the constraint is_not_called_beacon of checks 2.1 is taken by one of checks 2.1"),
])  # fmt: skip
def test_an_id_of_a_rule_or_of_another_metamodel_is_taken(offer: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "wired.csv").write_text("pin,part\nD3,Red LED\nD5,Pushbutton\n")
    path = installed(tmp_path, "checks")
    for words in (["check"], ["hardware"]):
        (finding,) = command(*words, tmp_path / "wired.csv", path=path, code=3, CHECKS_PLUGIN=offer)["findings"]
        assert finding["message"] == said
        assert finding["location"]["path"].endswith("checks_plugin.py")


def test_constraints_of_a_plug_in_are_asked_about_a_drawing(tmp_path: Path) -> None:
    (tmp_path / "wired.csv").write_text("pin,part\nD3,Red LED\nD5,Pushbutton\n")
    path = installed(tmp_path, "checks")
    for word in ("check", "hardware"):
        findings = command(word, tmp_path / "wired.csv", path=path, CHECKS_PLUGIN="drawings")["findings"]
        (found,) = [finding for finding in findings if finding["rule"].startswith("CH")]
        assert (found["rule"], found["location"]["path"].rpartition("/")[2]) == ("CH002", "wired.csv"), word


def test_a_constraint_of_a_plug_in_without_a_page_is_known_to_explain(tmp_path: Path) -> None:
    (finding,) = command("explain", "CH001", path=installed(tmp_path, "checks"), code=2)["findings"]
    assert finding["message"] == "'CH001' is the constraint is_not_called_beacon of checks 2.1, which has no page"


def test_a_kind_or_name_that_nothing_asks_for_is_told(tmp_path: Path) -> None:
    (tmp_path / "wired.csv").write_text("pin,part\nD3,Red LED\n")
    findings = command("hardware", tmp_path / "wired.csv", path=installed(tmp_path, "checks"), CHECKS_PLUGIN="misspelt")[
        "findings"
    ]
    told = [finding["message"].partition(": ")[2] for finding in findings if finding["rule"] == "RS908"]
    assert sorted(told) == [
        "'Circuit' names no class (NAMESPACE#CLASS)",
        "no metamodel is called 'hardwr' (did you mean 'hardware'?)",
        "nothing asks for content of the kind 'drawing reeder' (did you mean 'drawing reader'?)",
    ]


def test_a_plug_in_that_cannot_be_loaded_is_named_and_the_others_work(tmp_path: Path) -> None:
    path = installed(tmp_path, "broken", "beacon")
    (tmp_path / "wired.beacon").write_text("D3 Red LED\n")
    document = command("hardware", tmp_path / "wired.beacon", path=path)
    (finding,) = [finding for finding in document["findings"] if finding["rule"] == "RS908"]
    assert finding["severity"] == "warning"
    for word in ("broken 0.3", "broken_plugin:register", "a_package_that_nobody_has"):
        assert word in finding["message"]
    assert finding["fix"] == "mend, update or uninstall broken"
    tools = {tool["name"]: tool for tool in command("doctor", path=path)["result"]["tools"]}
    assert tools["beacon"]["version"] == "1.0"
    assert tools["broken 0.3"]["found"] is None
    assert tools["broken 0.3"]["fix"]


def test_doctor_lists_every_kind_of_content_with_the_plug_ins_that_register_it(tmp_path: Path) -> None:
    path = installed(tmp_path, "beacon", "checks")
    listed = command("doctor", path=path, CHECKS_PLUGIN="misspelt")["result"]["content"]
    assert [each["kind"] for each in listed] == list(KINDS)
    registered = {each["kind"]: [(one["name"], one["owner"]) for one in each["registered"]] for each in listed}
    assert ("beacon", "beacon 1.0") in registered["drawing reader"]
    assert ("kicad", None) in registered["drawing reader"]
    assert [owner for name, owner in registered["constraints"] if name == "migration"] == [None, "checks 2.1"]
    assert "drawing reeder" not in registered


@pytest.mark.parametrize("wrong", ["gives_nothing", "takes_one", "nobody"])
def test_doctor_lists_an_engine_that_cannot_be_used(wrong: str, tmp_path: Path) -> None:
    path = installed(tmp_path, "wrong")
    tools = command("doctor", path=path, WRONG_PLUGIN=f"engine=simavr={wrong}")["result"]["tools"]
    (engine,) = [tool for tool in tools if tool["name"] == "simavr"]
    assert engine["found"] is None
    assert "plug-in wrong 0.2" in engine["needed_for"]
    assert "wrong" in engine["fix"]


def test_an_exception_out_of_a_plug_in_names_the_plug_in(tmp_path: Path) -> None:
    (tmp_path / "robot.failing").write_text("x")
    (finding,) = command("hardware", tmp_path / "robot.failing", path=installed(tmp_path, "checks"), code=3)["findings"]
    assert finding["message"] == "the plug-in checks 2.1 raised KeyError: 'wiring'"
    assert finding["location"]["path"].endswith("checks_plugin.py")
    assert "bug of robosmi" not in finding["fix"]


def test_a_plug_in_that_ends_the_program_is_an_error_and_no_success(tmp_path: Path) -> None:
    (tmp_path / "robot.failing").write_text("x")
    path = installed(tmp_path, "checks")
    (finding,) = command("hardware", tmp_path / "robot.failing", path=path, code=3, CHECKS_PLUGIN="exits")["findings"]
    assert finding["message"] == "the plug-in checks 2.1 raised SystemExit: 0"
    assert finding["location"]["path"].endswith("checks_plugin.py")
    (tmp_path / "wired.csv").write_text("pin,part\nD3,Red LED\n")
    document = command("hardware", tmp_path / "wired.csv", path=path, CHECKS_PLUGIN="exits at once")
    (finding,) = [finding for finding in document["findings"] if finding["rule"] == "RS908"]
    assert "SystemExit" in finding["message"]


def test_a_plug_in_brings_a_reader_with_its_ending_and_a_target(tmp_path: Path) -> None:
    plugin = tmp_path / "plugin"
    shutil.copytree(HERE / "beacon", plugin)
    (tmp_path / "wired.beacon").write_text("D3 Red LED\nD5 Pushbutton\n")
    shutil.copy(PROGRAM, tmp_path / "beacon.c")
    document = command(
        "migrate", tmp_path / "beacon.c", "--hardware", tmp_path / "wired.beacon", "--target", "beacon", "-o", tmp_path / "out",
        path=plugin,
    )  # fmt: skip
    assert document["command"] == "migrate"
    project = (tmp_path / "out" / "beacon" / "sketch.yaml").read_text()
    assert "arduino:avr:pro" in project


def test_a_plug_in_brings_parts_with_the_ports_that_they_have(tmp_path: Path) -> None:
    drawing = HERE.parent / "transformations" / "constraints" / "drawings" / "RS244_holds.fz"
    text = drawing.read_text()
    (tmp_path / "lamp.fz").write_text(text.replace("5mmColorLEDModuleID", "beacon_lamp_1"))

    def lamp(path: Path) -> dict[str, Any]:
        done = command("hardware", tmp_path / "lamp.fz", path=path)["result"]
        found: dict[str, Any] = next(c for c in done["components"] if c["module_id"] == "beacon_lamp_1")
        return found | {"names": [c["name"] for m in done["mappings"] for c in m["connectors"]]}

    known, unknown = lamp(installed(tmp_path, "beacon")), lamp(tmp_path)
    assert (known["part_title"], known["role"], known["evidence"]) == ("Beacon lamp", "Output", "catalogue of parts: it is lit")
    assert unknown["part_title"] != "Beacon lamp"  # its role is told by its label
    assert "IN" in known["names"]
    assert "IN" not in unknown["names"]


def test_without_the_plug_in_nobody_knows_its_files(tmp_path: Path) -> None:
    from tests.running import run

    (tmp_path / "wired.beacon").write_text("D3 Red LED\n")
    outcome = run("hardware", tmp_path / "wired.beacon")
    assert outcome.code == 3
    assert "no drawing reader for '.beacon' files" in outcome.err


def test_a_plug_in_that_takes_the_place_of_a_built_in_reader_is_told_where_that_is_asked_for(tmp_path: Path) -> None:
    path = installed(tmp_path, "beacon", "checks")
    (tmp_path / "wired.csv").write_text("pin,part\nD3,Red LED\n")
    (tmp_path / "wired.beacon").write_text("D3 Red LED\n")
    document = command("hardware", tmp_path / "wired.csv", path=path, CHECKS_PLUGIN="replaces")
    (finding,) = [finding for finding in document["findings"] if finding["rule"] == "RS910"]
    assert finding["severity"] == "warning"
    assert finding["message"] == "the drawing reader 'pin_table' is that of the plug-in checks 2.1, not the built-in one"
    assert finding["fix"].startswith("uninstall checks if ")
    other = command("hardware", tmp_path / "wired.beacon", path=path, CHECKS_PLUGIN="replaces")
    assert not [finding for finding in other["findings"] if finding["rule"] == "RS910"]


@pytest.mark.parametrize("given", ["gives nothing", "gives texts"])
def test_a_reader_that_gives_no_circuit_is_a_fault_of_its_plug_in(given: str, tmp_path: Path) -> None:
    (tmp_path / "robot.failing").write_text("x")
    path = installed(tmp_path, "checks")
    (finding,) = command("hardware", tmp_path / "robot.failing", path=path, code=3, CHECKS_PLUGIN=given)["findings"]
    assert finding["message"].startswith("the drawing reader 'failing' of the plug-in checks 2.1 gives ")
    assert finding["fix"].startswith("report it to the authors of checks: ")
    assert finding["location"]["path"].endswith("robot.failing")


def test_constraints_that_are_not_there_are_named_and_the_others_run(tmp_path: Path) -> None:
    path = installed(tmp_path, "checks")
    plan, _ = stored_plan(tmp_path, path)
    document = command("check", plan, path=path, CHECKS_PLUGIN="dangling")
    (finding,) = [finding for finding in document["findings"] if finding["rule"] == "RS908"]
    assert "checks 2.1" in finding["message"]
    assert "checks_plugin:nothing" in finding["message"]
    assert [finding["rule"] for finding in document["findings"] if finding["rule"] == "CH001"]
    tools = [
        tool for tool in command("doctor", path=path, CHECKS_PLUGIN="dangling")["result"]["tools"] if "checks" in tool["name"]
    ]
    assert [tool["found"] is None for tool in tools] == [False, True]
    assert "checks_plugin:nothing" in str(tools[1])


def test_a_folder_of_data_that_is_not_there_is_said_and_its_plug_in_listed(tmp_path: Path) -> None:
    path = installed(tmp_path, "beacon")
    (path / "beacon_plugin.py").write_text("def register(registry):\n    registry.add_data('/nowhere/at/all')\n")
    tools = [tool for tool in command("doctor", path=path)["result"]["tools"] if "beacon" in tool["name"]]
    assert [tool["found"] is None for tool in tools] == [False, True]
    assert "/nowhere/at/all" in str(tools[1])


OURS = "[console_scripts]\nx = y:z\n\n[robosmi.transformations]\nbuiltin = robosmi.transformations:registry\n\n[last]\na = b:c\n"


@pytest.mark.parametrize(
    ("name", "text", "offers"),
    [
        ("a-1.dist-info", OURS, False),
        ("a-1.dist-info", OURS.replace("builtin = ", "checks = checks_plugin:register\nbuiltin = "), True),
        ("a.egg-info", "[robosmi.transformations]\nchecks=checks_plugin:register", True),
        ("EGG-INFO", "[robosmi.transformations]\nchecks=checks_plugin:register", True),
        ("a-1.dist-info", "[another.group]\nrobosmi.transformations = a:b\n", False),
        ("a-1.dist-info", "[robosmi.transformations]\n\udcff = a:b", True),
        ("a.egg", "", True),
        ("a", "[robosmi.transformations]\nchecks = checks_plugin:register\n", False),
    ],
)
def test_whether_others_offer_something_is_seen_at_a_glance(
    name: str, text: str, offers: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "meta_path", [PathFinder])  # another test may have loaded a package that brings a finder
    (tmp_path / name).mkdir()
    (tmp_path / name / "entry_points.txt").write_text(text, errors="surrogateescape")
    assert others_may_offer([str(tmp_path / "nowhere"), str(tmp_path)]) is offers


def test_an_archive_on_the_path_may_offer_something(tmp_path: Path) -> None:
    (tmp_path / "all.zip").write_bytes(b"")
    assert others_may_offer([str(tmp_path / "all.zip")])


WRONG_OFFERS = [
    (
        "generator=arduino_sketch=takes_one",
        "cannot be called as it has to be: takes_one() takes 1 positional argument but 2 were given",
    ),
    ("generator=arduino_sketch=gives_nothing", "gives None, not a Generation"),
    (
        "drawing reader=pin_table=takes_one",
        "cannot be called as it has to be: takes_one() got an unexpected keyword argument 'roles'",
    ),
    ("drawing reader=pin_table=text", "cannot be called as it has to be: 'str' object is not callable"),
    ("program reader=c_source=gives_nothing", "gives None, not a program and its findings"),
]
"""What the plug-in `wrong` offers, and the expected message."""
WRONG_RESULTS = [
    ("ranker=devices=gives_nothing", "recommend wired.csv", "gives None, which has no 'rank'"),
    ("parts reader=fritzing=gives_nothing", "parts import .", "gives None, which has no 'parts'"),
]
"""What the plug-in `wrong` offers, the command that uses it, and the expected message."""


@pytest.mark.parametrize(("offered", "said"), WRONG_OFFERS)
def test_what_a_plug_in_offers_in_the_wrong_form_is_named_with_the_form_expected(offered: str, said: str, tmp_path: Path) -> None:
    path = installed(tmp_path, "wrong")
    kind, name, _ = offered.split("=")
    (tmp_path / "wired.csv").write_text("pin,part\nD3,Red LED\nD5,Pushbutton\n")
    shutil.copy(PROGRAM, tmp_path / "beacon.c")
    words: list[str | Path] = ["migrate", tmp_path / "beacon.c", "--hardware", tmp_path / "wired.csv", "-o", tmp_path / "out"]
    finding = command(*words, path=path, code=3, WRONG_PLUGIN=offered)["findings"][0]
    assert finding["message"] == f"the {kind} '{name}' of the plug-in wrong 0.2 {said}"
    assert finding["fix"] == f"report it to the authors of wrong: {KINDS[kind].contract()}"
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("offered", "words", "said"), WRONG_RESULTS)
def test_a_result_that_nobody_can_use_is_a_fault_of_its_plug_in(offered: str, words: str, said: str, tmp_path: Path) -> None:
    path = installed(tmp_path, "wrong")
    kind, name, _ = offered.split("=")
    (tmp_path / "wired.csv").write_text("pin,part\nD3,Red LED\nD5,Pushbutton\n")
    given = [tmp_path / word if (tmp_path / word).exists() else word for word in words.split()]
    finding = command(*given, path=path, code=3, WRONG_PLUGIN=offered)["findings"][0]
    assert finding["message"].startswith(f"the {kind} '{name}' of the plug-in wrong 0.2 {said}")
    assert finding["fix"] == f"report it to the authors of wrong: {KINDS[kind].contract()}"


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("HasNoTypes", "cannot be called as it has to be: Can't instantiate abstract class HasNoTypes "),
        ("TakesNoName", "cannot be called as it has to be: "),
        ("gives_a_text", "gives 'no function at all', not a Model"),
    ],
)
def test_a_driver_in_the_wrong_form_is_named_with_the_form_expected(wrong: str, said: str, tmp_path: Path) -> None:
    path = installed(tmp_path, "wrong")
    (tmp_path / "robots.wrong").write_text("x")
    words: list[str | Path] = ["check", tmp_path / "robots.wrong"]
    (finding,) = command(*words, path=path, code=3, WRONG_PLUGIN=f"driver=.wrong={wrong}")["findings"]
    assert finding["message"].startswith(f"the driver '.wrong' of the plug-in wrong 0.2 {said}")
    assert finding["fix"] == f"report it to the authors of wrong: {KINDS['driver'].contract()}"


def test_a_wrong_call_within_the_code_of_a_plug_in_is_told_at_its_line(tmp_path: Path) -> None:
    path = installed(tmp_path, "wrong")
    (tmp_path / "wired.csv").write_text("pin,part\n")
    words: list[str | Path] = ["hardware", tmp_path / "wired.csv"]
    finding = command(*words, path=path, code=3, WRONG_PLUGIN="drawing reader=pin_table=raises")["findings"][0]
    assert finding["message"].startswith("the plug-in wrong 0.2 raised TypeError: ")
    assert finding["location"]["path"].endswith("wrong_plugin.py")


def test_why_a_plug_in_is_missing_is_said_where_a_command_fails_for_want_of_it(tmp_path: Path) -> None:
    path = installed(tmp_path, "broken")
    (tmp_path / "robot.dots").write_text("x")
    commands: list[list[str | Path]] = [
        ["hardware", tmp_path / "robot.dots"],
        ["check", tmp_path / "robot.dots"],
        ["migrate", PROGRAM, "--hardware", tmp_path / "robot.dots", "-o", tmp_path / "out"],
    ]
    for words in commands:
        failed, broken = command(*words, path=path, code=3)["findings"]
        assert failed["severity"] == "error"
        assert broken["rule"] == "RS908"
        assert "a_package_that_nobody_has" in broken["message"]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(path), str(ROOT)])}
    line = [sys.executable, "-m", "robosmi", "hardware", "robot.dots", "--sarif", "found.sarif"]
    done = subprocess.run(line, capture_output=True, text=True, env=environment, cwd=tmp_path)
    assert "no drawing reader for '.dots' files" in done.stderr
    assert "robosmi: warning: the plug-in broken 0.3 ('broken_plugin:register') cannot be loaded: " in done.stderr
    assert "do: mend, update or uninstall broken" in done.stderr
    told = [result["ruleId"] for result in json.loads((tmp_path / "found.sarif").read_text())["runs"][0]["results"]]
    assert "RS908" in told
