"""Findings in SARIF 2.1.0: what the Multitool says of them, places in characters, fingerprints that stay, fixes that mend."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from robosmi.diagnostics import Finding, FlowStep, Location, Severity, Task, TextEdit
from robosmi.report import Report
from robosmi.report.sarif import FINGERPRINT, sarif_document, sarif_text
from tests.copies import Copies
from tests.running import run
from tests.sarif_judge import TOOL, complaints
from tests.tools import require_tools

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = """#include "simpletools.h"
static volatile int ready;
void measure(void *par) { pause(100); ready = 1; }
int main(void) {
  cognew(measure, 0);
  /* für alle */ pause(70 * 1000);
  print("%d", time(0));
  while (!ready);
}
"""


def the_run(path: Path) -> dict[str, Any]:
    """The one run of a SARIF file."""
    (one,) = json.loads(path.read_text(encoding="utf-8"))["runs"]
    return dict(one)


def of_rule(log: dict[str, Any], rule: str) -> list[dict[str, Any]]:
    """The results of a rule."""
    return [result for result in log["results"] if result["ruleId"] == rule]


@pytest.fixture
def migrated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, copies: Copies) -> dict[str, Any]:
    """What migrating the program above finds, in a folder that has all of it."""

    def fill(folder: Path) -> None:
        monkeypatch.chdir(folder)
        Path("robot.c").write_text(PROGRAM, encoding="utf-8")
        run("migrate", "robot.c", "-o", "out", "--widths", "keep", "--sarif", "found.sarif")

    copies.into(tmp_path, "robot in SARIF", fill)
    monkeypatch.chdir(tmp_path)
    return the_run(tmp_path / "found.sarif")


def test_the_multitool_has_nothing_to_complain_of(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_tools("sarif-multitool")
    example = ROOT / "docs" / "examples" / "line_follower"
    (tmp_path / "robot.c").write_text(PROGRAM, encoding="utf-8")
    (tmp_path / "odd name #1.c").write_text("int main(void) { return missing(1); }\n// caf\u00e9\n", encoding="latin-1")
    monkeypatch.chdir(tmp_path)
    run("analyse", "odd name #1.c", "--sarif", "odd.sarif")
    run("migrate", "robot.c", "-o", "out", "--widths", "keep", "--sarif", "migrate.sarif")
    run("hardware", example / "line_following_robot.fzz", "--sarif", "hardware.sarif")
    run("check", "out/models/plan.xmi", "--sarif", "check.sarif")
    run("explain", "--sarif", "none.sarif")
    run("analyse", "missing.c", "--sarif", "missing.sarif")
    run("migrate", "--sarif", "usage.sarif")
    made = sorted(tmp_path.glob("*.sarif"))
    assert len(made) == 7
    assert complaints(made) == []


def test_the_judge_is_heard(tmp_path: Path) -> None:
    require_tools("sarif-multitool")
    log = sarif_document(Report("check", findings=[Finding("RS311", Severity.info, "a")]), 0)
    del log["runs"][0]["tool"]["driver"]["informationUri"]
    (tmp_path / "wrong.sarif").write_text(json.dumps(log))
    assert any("SARIF2005" in said for said in complaints([tmp_path / "wrong.sarif"]))
    assert TOOL.is_file()


def test_columns_count_characters_and_show_their_text(migrated: dict[str, Any]) -> None:
    assert migrated["columnKind"] == "unicodeCodePoints"
    (found,) = of_rule(migrated, "RS313")
    place = found["locations"][0]["physicalLocation"]
    assert place["artifactLocation"] == {"uri": "robot.c", "uriBaseId": "SRCROOT"}
    assert place["region"]["snippet"]["text"] == "70 * 1000"
    line = PROGRAM.splitlines()[place["region"]["startLine"] - 1]
    assert line[place["region"]["startColumn"] - 1 : place["region"]["endColumn"] - 1] == "70 * 1000"
    assert place["contextRegion"]["snippet"]["text"].splitlines()[1] == line


def test_a_code_flow_has_the_steps_in_order(migrated: dict[str, Any]) -> None:
    (found,) = of_rule(migrated, "RS323")
    (thread,) = found["codeFlows"][0]["threadFlows"]
    steps = [step["location"] for step in thread["locations"]]
    assert [step["physicalLocation"]["region"]["startLine"] for step in steps] == [5, 3, 8]
    assert steps[0]["message"]["text"] == "'cognew' starts code on another core."


def test_a_fix_mends_what_is_found(migrated: dict[str, Any], tmp_path: Path) -> None:
    lines = PROGRAM.splitlines(keepends=True)
    fixes = [fix for rule in ("RS313", "RS324") for result in of_rule(migrated, rule) for fix in result["fixes"]]
    assert len(fixes) == 2
    edits = [r for fix in fixes for change in fix["artifactChanges"] for r in change["replacements"]]
    for edit in sorted(edits, key=lambda e: -int(e["deletedRegion"]["startLine"])):
        region = edit["deletedRegion"]
        line = lines[region["startLine"] - 1]
        start, end = region["startColumn"] - 1, region["endColumn"] - 1
        lines[region["startLine"] - 1] = line[:start] + edit["insertedContent"]["text"] + line[end:]
    (tmp_path / "mended.c").write_text("".join(lines), encoding="utf-8")
    assert "70L * 1000" in "".join(lines)
    run("migrate", "mended.c", "-o", "mended", "--widths", "keep", "--sarif", "mended.sarif")
    rules = {result["ruleId"] for result in the_run(tmp_path / "mended.sarif")["results"]}
    assert rules.isdisjoint({"RS313", "RS324"})
    assert "RS323" in rules


def test_fingerprints_stay_when_lines_are_added_above(migrated: dict[str, Any], tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text("// new\n\n" + PROGRAM.replace("  while", "\twhile"), encoding="utf-8")
    run("migrate", "robot.c", "-o", "out", "--widths", "keep", "--sarif", "again.sarif")
    again = the_run(tmp_path / "again.sarif")

    def prints(log: dict[str, Any]) -> list[tuple[str, str]]:
        return sorted((r["ruleId"], r["partialFingerprints"][FINGERPRINT]) for r in log["results"])

    assert prints(again) == prints(migrated)
    assert len(set(prints(again))) == len(prints(again))
    lines = [r["locations"][0]["physicalLocation"]["region"]["startLine"] for r in of_rule(again, "RS323")]
    assert lines == [10]


def test_alike_findings_have_fingerprints_of_their_own() -> None:
    same = [Finding("RS311", Severity.warning, "too wide", Location("none.c", line)) for line in (3, 9)]
    (run_,) = sarif_document(Report("check", findings=same), 0)["runs"]
    first, second = (result["partialFingerprints"][FINGERPRINT] for result in run_["results"])
    assert first.rsplit(":", 1) == [second.rsplit(":", 1)[0], "1"]
    assert second.endswith(":2")


def test_a_rule_has_help_and_its_usual_level(migrated: dict[str, Any]) -> None:
    rules = migrated["tool"]["driver"]["rules"]
    for result in migrated["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
    (wide,) = [rule for rule in rules if rule["id"] == "RS313"]
    assert wide["name"] == "ResultTooWide"
    assert wide["defaultConfiguration"] == {"level": "warning"}
    assert "pause(60 * 1000);" in wide["help"]["text"]
    assert wide["help"]["markdown"].startswith("# RS313 ResultTooWide")


def test_tasks_accepted_findings_and_rules_of_others_are_in_it() -> None:
    said = Report(
        "check",
        findings=[Finding("MY001", Severity.info, "odd.", element="plan.xmi#1", evidence={"accepted": "looked at"})],
        tasks=[Task("RS501", Severity.warning, "write it", fix="in adapters.h")],
    )
    (log,) = sarif_document(said, 1)["runs"]
    (mine, task) = log["results"]
    assert mine["suppressions"] == [{"kind": "external", "status": "accepted", "justification": "looked at"}]
    assert mine["message"]["text"] == "odd."
    assert mine["locations"][0]["logicalLocations"][0]["fullyQualifiedName"] == "plan.xmi#1"
    assert task["properties"] == {"id": said.tasks[0].id, "kind": "task", "advice": "in adapters.h"}
    assert log["invocations"] == [{"executionSuccessful": True, "exitCode": 1}]


def test_places_outside_of_the_base_damaged_places_and_links(tmp_path: Path) -> None:
    base = tmp_path / "a b"
    base.mkdir()
    (base / "in.c").write_bytes(b"int a;\n\xc3\xa4\xc3\xa4 = 1;\nx\xff = 1;\n")
    (tmp_path / "out.bin").write_bytes(b"PK\0\0")
    at = [
        Location(str(base / "in.c"), 2, 5, 2, 6),  # behind two letters of two bytes each
        Location(str(base / "in.c"), 3, 3),  # behind a byte that is no UTF-8
        Location(str(base / "in.c"), 99, 5),
        Location(str(base / "in.c"), 1, 99),
        Location(str(tmp_path / "out.bin"), 3, 5),
        Location(str(tmp_path / "gone.c"), 3, 5),
    ]
    steps = (FlowStep(at[0], "first"),)
    edits = (TextEdit(at[3], "x"),)
    found = [Finding("RS311", Severity.info, f"n{n}", place, steps=steps, edits=edits) for n, place in enumerate(at)]
    (log,) = sarif_document(Report("check", findings=found), 0, base)["runs"]
    places = [result["locations"][0]["physicalLocation"] for result in log["results"]]
    regions = [{k: v for k, v in p["region"].items() if k != "snippet"} for p in places]
    assert regions == [
        {"startLine": 2, "startColumn": 3, "endLine": 2, "endColumn": 4},
        {"startLine": 3, "startColumn": 3},
        {"startLine": 1, "endLine": 4},
        {"startLine": 1},
        {"byteOffset": 0, "byteLength": 4},
        {"byteOffset": 0, "byteLength": 0},
    ]
    assert places[0]["artifactLocation"] == {"uri": "in.c", "uriBaseId": "SRCROOT"}
    assert places[4]["artifactLocation"]["uriBaseId"] == "OTHERROOT"
    assert log["originalUriBaseIds"]["SRCROOT"]["uri"] == f"file://{tmp_path}/a%20b/"
    assert all("fixes" not in result for result in log["results"])  # a place that is not told is not changed


def test_the_root_of_a_repository_is_the_base(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "a.c").write_text("int main(void) { return f(1); }\n")
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    monkeypatch.chdir(tmp_path / "sub")
    run("analyse", "a.c", "--sarif", "a.sarif")
    (found,) = of_rule(the_run(tmp_path / "sub" / "a.sarif"), "RS109")
    assert found["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "sub/a.c"


def test_the_same_findings_give_the_same_bytes() -> None:
    said = Report("check", findings=[Finding("RS311", Severity.info, "a", Location("a.c", 1))])
    assert sarif_text(said, 0) == sarif_text(said, 0)


def test_an_error_that_stops_a_command_is_in_the_file(tmp_path: Path) -> None:
    outcome = run("analyse", tmp_path / "missing.c", f"--sarif={tmp_path / 'a.sarif'}")
    assert outcome.code == 3
    log = the_run(tmp_path / "a.sarif")
    assert [result["ruleId"] for result in log["results"]] == ["RS902"]
    assert log["invocations"] == [{"executionSuccessful": False, "exitCode": 3}]


def test_a_file_of_another_kind_is_not_written_over(tmp_path: Path) -> None:
    program = tmp_path / "a.c"
    program.write_text("int main(void) { return 0; }\n")
    outcome = run("analyse", program, "--sarif", program)
    assert outcome.code == 5
    assert program.read_text().startswith("int main")
    document = run("analyse", program, "--sarif", tmp_path / "new.sarif", "--json").document
    assert document["artifacts"] == [{"path": str(tmp_path / "new.sarif"), "kind": "sarif"}]
    assert run("analyse", program, "--sarif", tmp_path / "new.sarif").code == 0
    assert run("analyse", program, "--sarif", program / "a.sarif").code == 3


def test_what_the_command_has_made_is_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text(PROGRAM, encoding="utf-8")
    sketch = tmp_path / "out" / "robot" / "robot.ino"
    outcome = run("migrate", tmp_path / "robot.c", "-o", tmp_path / "out", "--sarif", sketch)
    assert (outcome.code, "writes this file itself" in outcome.err) == (5, True)
    assert "void setup()" in sketch.read_text()


def test_a_link_is_not_replaced_and_a_name_may_be_too_long(tmp_path: Path) -> None:
    (tmp_path / "robot.c").write_text(PROGRAM, encoding="utf-8")
    (tmp_path / "empty").touch()
    (tmp_path / "linked.sarif").symlink_to("empty")
    outcome = run("analyse", tmp_path / "robot.c", "--sarif", tmp_path / "linked.sarif")
    assert (outcome.code, "is a link" in outcome.err) == (5, True)
    assert (tmp_path / "linked.sarif").is_symlink()
    outcome = run("analyse", tmp_path / "robot.c", "--sarif", tmp_path / ("n" * 300))
    assert (outcome.code, "File name too long" in outcome.err) == (3, True)
