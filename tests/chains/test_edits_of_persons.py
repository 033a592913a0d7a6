"""What a person changed is merged or stops the run, and is never lost; what no run made stays where it is."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import StoppedError
from tests.running import run, tree

TEXTS = [
    "line_follower/line_follower.ino",
    "line_follower/adapters.h",
    "line_follower/sketch.yaml",
    "line_follower/MIGRATION.md",
]
MODELS = [
    "models/code.xmi",
    "models/hardware.xmi",
    "models/platform.xmi",
    "models/plan.xmi",
    "models/source/line_follower.c",
]


@pytest.mark.parametrize("name", MODELS)
def test_migrate_stops_before_an_edit_of_a_model_and_names_the_file(name: str, migrated: Path, line_follower: Path) -> None:
    (migrated / name).write_bytes((migrated / name).read_bytes() + b"\n")
    before = tree(migrated)
    outcome = run("migrate", line_follower, "-o", migrated)
    assert outcome.code == 5
    assert f"'{name}' was changed since the last run" in outcome.err
    assert "do: move the file away" in outcome.err
    assert tree(migrated) == before


@pytest.mark.parametrize("name", TEXTS)
def test_an_edit_of_a_text_is_kept_by_migrate_and_generate(name: str, migrated: Path, line_follower: Path) -> None:
    edited = (migrated / name).read_bytes() + b"\n// mine\n"
    (migrated / name).write_bytes(edited)
    first = run("migrate", line_follower, "-o", migrated, "--json")
    assert first.code == 0
    assert [f["location"]["path"] for f in first.document["findings"] if f["rule"] == "RS512"] == [str(migrated / name)]
    assert (migrated / name).read_bytes() == edited
    before = tree(migrated)
    assert run("generate", migrated / "models" / "plan.xmi", "-o", migrated).code == 0
    assert run("migrate", line_follower, "-o", migrated).code == 0
    assert tree(migrated) == before, "a further run changes something"


def test_an_edit_and_a_changed_source_are_merged_and_lines_are_still_traced(migrated: Path, line_follower: Path) -> None:
    sketch = migrated / "line_follower" / "line_follower.ino"
    sketch.write_text("// my head\n// and more\n" + sketch.read_text() + "// my tail\n")
    line_follower.write_text(line_follower.read_text().replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
    assert run("migrate", line_follower, "-o", migrated).code == 0
    lines = sketch.read_text().splitlines()
    assert lines[:2] == ["// my head", "// and more"]
    assert lines[-1] == "// my tail"
    assert any("drive_speed(1, 1);" in line for line in lines)
    plan = robosmi.load_model(migrated / "models" / "plan.xmi")
    setup = next(t for t in plan.trace.texts if t.path.endswith(".ino") and t.rule == "setup")
    assert lines[setup.line - 1] == "void setup() {"


def test_an_edit_of_a_line_that_is_made_anew_is_a_marked_conflict_and_the_old_file_is_kept(
    migrated: Path, line_follower: Path
) -> None:
    sketch = migrated / "line_follower" / "line_follower.ino"
    old = sketch.read_text().replace("drive_speed(0, 0)", "drive_speed(2, 2)")
    assert old != sketch.read_text()
    sketch.write_text(old)
    line_follower.write_text(line_follower.read_text().replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
    outcome = run("migrate", line_follower, "-o", migrated, "--json")
    assert outcome.code == 1
    assert "RS511" in outcome.rules()
    text = sketch.read_text()
    assert text.index("<<<<<<< yours") < text.index("drive_speed(2, 2)") < text.index("drive_speed(1, 1)") < text.index(">>>>>>>")
    assert (sketch.parent / "line_follower.ino.orig").read_text() == old
    before = tree(migrated)
    again = run("migrate", line_follower, "-o", migrated)
    assert "RS516" in again.out
    assert f"next: solve the conflicts in {sketch}, then migrate again" in again.out
    assert "Needs you: 1 conflict to solve" in (sketch.parent / "MIGRATION.md").read_text()
    assert tree(migrated) == before, "a further run changes something while nobody has decided"
    line_follower.write_text(line_follower.read_text().replace("drive_speed(1, 1)", "drive_speed(3, 3)"))
    assert run("migrate", line_follower, "-o", migrated).code == 5
    assert tree(migrated) == before


def test_a_conflict_is_in_the_report_with_its_place_and_both_texts_until_somebody_decides(
    migrated: Path, line_follower: Path
) -> None:
    sketch, report = migrated / "line_follower" / "line_follower.ino", migrated / "line_follower" / "MIGRATION.md"
    sketch.write_text(sketch.read_text().replace("drive_speed(0, 0)", "drive_speed(2, 2)"))
    line_follower.write_text(line_follower.read_text().replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
    outcome = run("migrate", line_follower, "-o", migrated, "--json")
    lines = sketch.read_text().split("\n")
    line = lines.index("<<<<<<< yours") + 1
    (task,) = [task for task in outcome.document["tasks"] if task["rule"] == "RS511"]
    assert task["location"]["line"] == line
    said = report.read_text()
    section = said[said.index("## Conflicts") : said.index("## Findings")]
    assert f"- `line_follower/line_follower.ino`, line {line}" in section
    yours, made = (
        next(part for part in section.split("\n") if part.startswith(f"  - {who}: ")) for who in ("yours", "generated")
    )
    assert "drive_speed(2, 2)" in yours
    assert "drive_speed(1, 1)" in made
    assert "Decide which lines" in section
    sketch.write_text(sketch.read_text().replace("<<<<<<< yours\n", ""))
    damaged = [task["message"] for task in run("migrate", line_follower, "-o", migrated, "--json").document["tasks"]]
    assert "a conflict's markers are damaged: decide which lines stay" in damaged
    last = lines.index(">>>>>>> generated")
    mine = lines[line : next(n for n, text in enumerate(lines) if text.startswith("||||||| "))]
    sketch.write_text("\n".join([*lines[: line - 1], *mine, *lines[last + 1 :]]))
    assert "RS511" not in {task["rule"] for task in run("migrate", line_follower, "-o", migrated, "--json").document["tasks"]}
    assert "## Conflicts" not in report.read_text()
    assert "drive_speed(2, 2)" in sketch.read_text()


def test_an_output_from_before_there_was_a_record_is_taken_over(migrated: Path, line_follower: Path) -> None:
    shutil.rmtree(migrated / ".robosmi")
    assert run("migrate", line_follower, "-o", migrated).code == 0
    shutil.rmtree(migrated / ".robosmi")
    for name in TEXTS[:2]:
        (migrated / name).write_text("mine\n")
    with pytest.raises(StoppedError) as stopped:
        robosmi.migrate([line_follower], migrated)
    assert all(name in stopped.value.message for name in TEXTS[:2])


def test_a_dry_run_does_not_touch_an_edited_file(migrated: Path, line_follower: Path) -> None:
    (migrated / TEXTS[0]).write_text((migrated / TEXTS[0]).read_text() + "// mine\n")
    before = tree(migrated)
    assert run("migrate", line_follower, "-o", migrated, "--dry-run").code == 0
    assert tree(migrated) == before


def test_a_foreign_file_of_the_same_name_stops_the_run(line_follower: Path, tmp_path: Path) -> None:
    sketch = tmp_path / "out" / "line_follower" / "line_follower.ino"
    sketch.parent.mkdir(parents=True)
    sketch.write_text("void setup() {}\nvoid loop() {}\n")
    before = tree(tmp_path)
    outcome = run("migrate", line_follower, "-o", tmp_path / "out")
    assert outcome.code == 5
    assert "'line_follower/line_follower.ino' was not made by robosmi" in outcome.err
    assert tree(tmp_path) == before


def test_files_that_no_run_made_stay(migrated: Path, line_follower: Path) -> None:
    mine = [migrated / "notes.txt", migrated / "line_follower" / "motor.h", migrated / "models" / "old" / "plan.xmi"]
    for path in mine:
        path.parent.mkdir(exist_ok=True)
        path.write_text("mine")
    source = line_follower.read_text()
    line_follower.write_text(source.replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
    assert run("migrate", line_follower, "-o", migrated).code == 0
    assert run("generate", migrated / "models" / "plan.xmi", "-o", migrated).code == 0
    assert all(path.read_text() == "mine" for path in mine)


def test_a_changed_source_is_migrated_anew(migrated: Path, line_follower: Path) -> None:
    line_follower.write_text(line_follower.read_text().replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
    assert run("migrate", line_follower, "-o", migrated).code == 0
    assert "drive_speed(1, 1);" in (migrated / "line_follower" / "line_follower.ino").read_text()


def test_a_file_that_a_run_no_longer_makes_is_removed_unless_it_was_edited(line_follower: Path, tmp_path: Path) -> None:
    helper = line_follower.parent / "helper.c"
    helper.write_text("int twice(int x) {\n  return 2 * x;\n}\n")
    other = line_follower.parent / "other.c"
    other.write_text("int thrice(int x) {\n  return 3 * x;\n}\n")
    robosmi.migrate([line_follower, helper, other], tmp_path / "out")
    made = tmp_path / "out" / "line_follower"
    assert (made / "helper.cpp").is_file()
    (made / "other.cpp").write_text((made / "other.cpp").read_text() + "// mine\n")
    robosmi.migrate([line_follower], tmp_path / "out")
    assert not (made / "helper.cpp").exists()
    assert (made / "other.cpp").read_text().endswith("// mine\n")


def test_a_removed_file_is_made_again(migrated: Path, line_follower: Path) -> None:
    before = tree(migrated)
    (migrated / "line_follower" / "adapters.h").unlink()
    robosmi.migrate([line_follower], migrated)
    assert tree(migrated) == before


def test_an_edit_that_was_taken_back_no_longer_stops_the_run(migrated: Path, line_follower: Path) -> None:
    plan = migrated / "models" / "plan.xmi"
    text = plan.read_bytes()
    plan.write_bytes(text + b"\n")
    assert run("migrate", line_follower, "-o", migrated).code == 5
    plan.write_bytes(text)
    assert run("migrate", line_follower, "-o", migrated).code == 0


def test_migrate_stops_at_an_edited_plan_even_after_generate_has_followed_it(migrated: Path, line_follower: Path) -> None:
    plan = migrated / "models" / "plan.xmi"
    plan.write_text(plan.read_text().replace('toolVersion="', 'toolVersion="edited '))
    assert run("migrate", line_follower, "-o", migrated).code == 5
    assert run("generate", plan, "-o", migrated).code == 0
    outcome = run("migrate", line_follower, "-o", migrated)
    assert outcome.code == 5
    assert "'models/plan.xmi' was changed since the last run" in outcome.err
    assert 'toolVersion="edited ' in plan.read_text()


def test_the_record_lists_every_file_with_its_digest(migrated: Path) -> None:
    record = json.loads((migrated / ".robosmi.json").read_text())
    files = {name: digest for name, digest in tree(migrated).items() if digest != "folder" and name != ".robosmi.json"}
    assert record["files"] == files


def test_nothing_is_left_behind_by_a_run(migrated: Path, line_follower: Path, tmp_path: Path) -> None:
    run("migrate", line_follower, "-o", migrated)
    (migrated / "line_follower" / "adapters.h").write_text("mine")
    run("migrate", line_follower, "-o", migrated)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["input", "out"]
    assert sorted(p.name for p in migrated.iterdir()) == [".robosmi", ".robosmi.json", "line_follower", "models"]


ARM = (
    '#include "simpletools.h"\n#include "servo.h"\nvoid grip(int angle);\nint main() {{ while (1) {{ grip(3); high(5); {} }} }}\n'
)
ROWS = "pin,part,title\nD5,Red LED,LED A\n"


@pytest.fixture
def arm(tmp_path: Path) -> tuple[Path, Path]:
    """A program with a servo and a function that is still to be written, migrated by a pin table; and the output folder."""
    program, out = tmp_path / "arm.c", tmp_path / "out"
    program.write_text(ARM.format("servo_angle(9, 900);"))
    (tmp_path / "arm.csv").write_text(ROWS + "D9,Basic Servo,Servo A\n")
    (tmp_path / "robosmi.toml").write_text(
        '[migrate]\nhardware = "arm.csv"\n[libraries]\n"Servo A" = "Servo"\n[bind]\nP5 = "D5"\nP9 = "D9"\n'
    )
    assert run("migrate", program, "-o", out).code in (0, 1)
    assert "#include <Servo.h>" in (out / "arm" / "arm.ino").read_text()
    return program, out


def without_servo(program: Path) -> None:
    """The program and its drawing without the servo."""
    program.write_text(ARM.format("low(5);"))
    (program.parent / "arm.csv").write_text(ROWS)
    (program.parent / "robosmi.toml").write_text('[migrate]\nhardware = "arm.csv"\n[bind]\nP5 = "D5"\n')


def test_an_include_that_a_kept_body_needs_stays_when_its_component_leaves_the_drawing(arm: tuple[Path, Path]) -> None:
    program, out = arm
    sketch = out / "arm" / "arm.ino"
    body = "  static Servo mine;\n  mine.write(angle);\n"
    sketch.write_text(sketch.read_text().replace("  // TODO: complete method\n  (void)angle;\n", body))
    without_servo(program)
    outcome = run("migrate", program, "-o", out, "--json")
    assert "#include <Servo.h>" in sketch.read_text()
    assert body in sketch.read_text()
    (told,) = [f for f in outcome.document["findings"] if "Servo.h" in f["message"]]
    assert "your code uses 'Servo'" in told["message"]
    assert "- Servo (" in (out / "arm" / "sketch.yaml").read_text()
    before = tree(out)
    run("migrate", program, "-o", out)
    assert tree(out) == before


def test_libraries_that_a_person_includes_are_in_the_project_files(arm: tuple[Path, Path]) -> None:
    program, out = arm
    without_servo(program)
    run("migrate", program, "-o", out)
    sketch, project = out / "arm" / "arm.ino", [out / "arm" / name for name in ("sketch.yaml", "platformio.ini")]
    assert not any("Servo" in path.read_text() for path in project)
    text = sketch.read_text()
    sketch.write_text(f"#include <Servo.h>\n#include <EEPROM.h>\n{text}")
    run("migrate", program, "-o", out)
    assert all("Servo" in path.read_text() for path in project)
    assert not any("EEPROM" in path.read_text() for path in project)  # comes with the core
    sketch.write_text(text)
    run("migrate", program, "-o", out)
    assert not any("Servo" in path.read_text() for path in project)


def test_an_include_that_nothing_needs_goes_with_its_component(arm: tuple[Path, Path]) -> None:
    program, out = arm
    sketch = out / "arm" / "arm.ino"
    sketch.write_text(sketch.read_text() + "\n// mine\nint count;\n")
    without_servo(program)
    run("migrate", program, "-o", out)
    assert "Servo.h" not in sketch.read_text()
    assert "int count;" in sketch.read_text()


def test_a_placeholder_that_was_given_a_meaning_is_done(tmp_path: Path) -> None:
    """What stands is compared with what is made: another declaration, a macro, or the same value without the words TODO."""
    program, output = tmp_path / "turn.c", tmp_path / "out"
    program.write_text('#include "simpletools.h"\nint main() { print("%d %d %d", FIRST_OF_ALL, SECOND_OF_ALL, LAST_OF_ALL); }\n')
    header = output / "turn" / "adapters.h"

    def left() -> list[str]:
        plan = robosmi.migrate([program], output).models.plan
        return [t.message.split("'")[1] for t in plan.tasks if t.rule == "RS502" and not t.done]

    assert left() == ["FIRST_OF_ALL", "LAST_OF_ALL", "SECOND_OF_ALL"]
    text = header.read_text()
    lines = {name: next(line for line in text.splitlines() if f" {name} = " in line) for name in left()}
    text = text.replace(lines["FIRST_OF_ALL"], "#define FIRST_OF_ALL 7")
    text = text.replace(lines["LAST_OF_ALL"], lines["LAST_OF_ALL"].partition("  //")[0])
    header.write_text(text)
    assert left() == ["SECOND_OF_ALL"]
    assert re.search("^- \\[x\\] .*'FIRST_OF_ALL'", (output / "turn" / "MIGRATION.md").read_text(), re.MULTILINE)
    assert "#define FIRST_OF_ALL 7" in header.read_text()
    before = tree(output)
    assert left() == ["SECOND_OF_ALL"]
    assert tree(output) == before
