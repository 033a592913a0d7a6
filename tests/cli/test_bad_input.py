"""Inputs that cannot be used: a message with the place, the cause and what to do, the contract's code, nothing half-written."""

from __future__ import annotations

import resource
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.running import Outcome, run, tree

UNREADABLE = Path("/proc/self/mem")
"""A file that is there and that even root cannot read from its start (Linux)."""


def check_refused(outcome: Outcome, code: int, *said: str) -> None:
    """Check that a run was refused with this exit code and message, and with advice."""
    assert outcome.code == code, outcome.err
    assert outcome.out == ""
    for text in said:
        assert text in outcome.err
    assert "\n  do: " in outcome.err


SOURCES = [
    ("missing.c", "no such file"),
    ("binary.c", "binary"),
    ("prose.c", "not C source"),
    ("two_boards.fz", "no program reader for '.fz' files"),
    ("truncated.fzz", "no program reader for '.fzz' files"),
    ("no_sources", "folder"),
]
DRAWINGS = [
    ("missing.fzz", "no such file"),
    ("empty.fz", "empty"),
    ("truncated.fzz", "damaged"),
    ("junk.fzz", "ZIP archive"),
    ("other.fz", "not a Fritzing sketch"),
    ("unclosed.fz", "not well-formed"),
    ("no_board.fz", "no board"),
    ("prose.c", "no drawing reader for '.c' files"),
    (".", "no drawing reader"),
]


@pytest.mark.parametrize("command", ["analyse", "migrate"])
@pytest.mark.parametrize(("name", "cause"), SOURCES)
def test_a_source_that_cannot_be_read_is_refused(command: str, name: str, cause: str, cases: Path, tmp_path: Path) -> None:
    output = tmp_path / ("out" if command == "migrate" else "code.xmi")
    outcome = run(command, cases / name, "-o", output)
    check_refused(outcome, 3, str(cases / name), cause)
    assert tree(tmp_path) == {}


def test_an_empty_source_is_a_program_that_has_nothing_to_migrate(cases: Path, tmp_path: Path) -> None:
    assert run("analyse", cases / "empty.c").code == 0
    check_refused(run("migrate", cases / "empty.c", "-o", tmp_path / "out"), 3, "no main function")


@pytest.mark.parametrize("command", ["hardware", "recommend", "migrate"])
@pytest.mark.parametrize(("name", "cause"), DRAWINGS)
def test_a_drawing_that_cannot_be_used_is_refused(command: str, name: str, cause: str, cases: Path, tmp_path: Path) -> None:
    words: dict[str, list[str | Path]] = {
        "hardware": ["hardware", cases / name, "-o", tmp_path / "hardware.xmi"],
        "recommend": ["recommend", cases / name],
        "migrate": ["migrate", cases / "first_main.c", "--hardware", cases / name, "-o", tmp_path / "out"],
    }
    check_refused(run(*words[command]), 3, str(cases / name), cause)
    assert tree(tmp_path) == {}


def test_syntax_errors_are_findings_of_a_sketch_that_is_made_all_the_same(cases: Path, tmp_path: Path) -> None:
    outcome = run("migrate", cases / "syntax.c", "-o", tmp_path / "out", "--json")
    assert outcome.code == 1
    assert any(f["severity"] == "error" and f["location"]["line"] == 4 for f in outcome.document["findings"])
    assert "RS504" in (tmp_path / "out" / "syntax" / "MIGRATION.md").read_text()


def test_a_program_without_main_is_not_migrated(cases: Path, tmp_path: Path) -> None:
    check_refused(
        run("migrate", cases / "no_main.c", "-o", tmp_path / "out"), 3, "no_main.c", "no main function", "analyse works without"
    )
    assert tree(tmp_path) == {}


def test_a_program_with_two_mains_is_not_migrated(cases: Path, tmp_path: Path) -> None:
    outcome = run("migrate", cases / "first_main.c", cases / "second_main.c", "-o", tmp_path / "out")
    check_refused(outcome, 3, "second_main.c:3:", "main is defined twice", "first_main.c:3")
    assert tree(tmp_path) == {}


def test_two_mains_are_analysed(cases: Path) -> None:
    outcome = run("analyse", cases / "first_main.c", cases / "second_main.c", "--json")
    assert outcome.code == 0
    assert [bool(unit["main"]) for unit in outcome.result["units"]] == [True, True]


def test_two_boards_are_analysed_but_not_migrated_to(cases: Path, tmp_path: Path) -> None:
    boards = run("hardware", cases / "two_boards.fz", "--json").result["boards"]
    assert [b["title"] for b in boards] == ["Uno", "Duo"]
    outcome = run("migrate", cases / "first_main.c", "--hardware", cases / "two_boards.fz", "-o", tmp_path / "out")
    check_refused(outcome, 3, "two_boards.fz", "2 boards", "'Uno' (#1)", "'Duo' (#2)")
    assert tree(tmp_path) == {}


def test_a_file_given_twice_is_wrong_usage(cases: Path, tmp_path: Path) -> None:
    spelled = cases / ".." / cases.name / "first_main.c"
    check_refused(run("migrate", cases / "first_main.c", spelled, "-o", tmp_path / "out"), 2, "given twice")


@pytest.mark.skipif(not UNREADABLE.exists(), reason="this system has no file that nobody can read")
@pytest.mark.parametrize("command", ["analyse", "migrate"])
def test_a_file_that_cannot_be_read_is_refused(command: str, tmp_path: Path) -> None:
    (tmp_path / "memory.c").symlink_to(UNREADABLE)
    check_refused(run(command, tmp_path / "memory.c", "-o", tmp_path / "out"), 3, "memory.c", "cannot be read")
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(not UNREADABLE.exists(), reason="this system has no file that nobody can read")
def test_a_drawing_that_cannot_be_opened_is_refused(tmp_path: Path) -> None:
    (tmp_path / "memory.fzz").symlink_to(UNREADABLE)
    check_refused(run("hardware", tmp_path / "memory.fzz"), 3, "memory.fzz")


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ("{", "not JSON"),
        ("{}", "list"),
        ('[{"title": "x"}]', "'id'"),
        ('[{"id": "x", "title": 3}]', "'title'"),
    ],
)
def test_components_that_are_none_are_refused(text: str, cause: str, tmp_path: Path) -> None:
    listed = tmp_path / "components.json"
    listed.write_text(text)
    check_refused(run("recommend", "--components", listed), 3, str(listed), cause)


# --- stored plans


def changed(file: Path, old: str, new: str) -> None:
    """Replace a text that must be there."""
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def no_code(models: Path) -> None:
    (models / "code.xmi").unlink()


def no_source(models: Path) -> None:
    (models / "source" / "line_follower.c").unlink()


def other_source(models: Path) -> None:
    changed(models / "source" / "line_follower.c", "drive_speed(0, 0)", "drive_speed(1, 0)")


def other_drawing(models: Path) -> None:
    drawing = models / "source" / "line_following_robot.fzz"
    drawing.write_bytes(drawing.read_bytes() + b" ")


def other_code(models: Path) -> None:
    changed(models / "code.xmi", "leftQTI", "leftEye")


def other_hardware(models: Path) -> None:
    changed(models / "hardware.xmi", "Basic Servo2", "Basic Servo7")


def other_platform(models: Path) -> None:
    changed(models / "platform.xmi", "arduino:avr:uno", "arduino:avr:one")


def cut_short(models: Path) -> None:
    plan = models / "plan.xmi"
    plan.write_bytes(plan.read_bytes()[:5000])


def emptied(models: Path) -> None:
    (models / "plan.xmi").write_bytes(b"")


def unknown_feature(models: Path) -> None:
    changed(models / "plan.xmi", "sourcePin=", "sourcePim=")


def unknown_literal(models: Path) -> None:
    changed(models / "plan.xmi", 'chosenBy="person"', 'chosenBy="persn"')


def no_number(models: Path) -> None:
    changed(models / "plan.xmi", 'sourcePin="6"', 'sourcePin="six"')


def leads_nowhere(models: Path) -> None:
    changed(models / "plan.xmi", "@pins.8", "@pins.888")


def wrong_kind(models: Path) -> None:
    changed(models / "plan.xmi", "code.xmi#//@units.0/@declarations.0", "code.xmi#/")


def no_name(models: Path) -> None:
    changed(models / "plan.xmi", ' name="line_follower"', "")


def evil_name(models: Path) -> None:
    changed(models / "plan.xmi", ' name="line_follower"', ' name="../../evil"')


def evil_input(models: Path) -> None:
    changed(models / "plan.xmi", 'path="source/line_follower.c"', 'path="../../input/line_follower.c"')


def no_program(models: Path) -> None:
    changed(models / "plan.xmi", '<program href="code.xmi#/"/>', "")


def no_board(models: Path) -> None:
    changed(models / "plan.xmi", '<board href="platform.xmi#//@boards.0"/>', "")


def no_circuit(models: Path) -> None:
    changed(models / "plan.xmi", '<circuit href="hardware.xmi#/"/>', "")


def with_doctype(models: Path) -> None:
    changed(models / "plan.xmi", "<migration:MigrationPlan", "<!DOCTYPE plan><migration:MigrationPlan")


DAMAGES: list[tuple[Callable[[Path], None], tuple[str, ...]]] = [
    (no_code, ("plan.xmi", "'code.xmi' cannot be read")),
    (no_source, ("source/line_follower.c", "cannot be read")),
    (other_source, ("source/line_follower.c", "digest differs")),
    (other_drawing, ("source/line_following_robot.fzz", "digest differs")),
    (other_code, ("code.xmi", "digest differs")),
    (other_hardware, ("hardware.xmi", "digest differs")),
    (other_platform, ("platform.xmi", "digest differs")),
    (cut_short, ("plan.xmi:", "not well-formed")),
    (emptied, ("plan.xmi", "empty")),
    (unknown_feature, ("plan.xmi:", "PortBinding has no feature 'sourcePim' (did you mean 'sourcePin'?)")),
    (unknown_literal, ("plan.xmi:", "'persn' is no literal of ChosenBy (did you mean 'person'?)")),
    (no_number, ("plan.xmi:", "'six' is no whole number")),
    (leads_nowhere, ("plan.xmi:", "@pins.888' leads to nothing")),
    (wrong_kind, ("plan.xmi:", "does not take")),
    (no_name, ("plan.xmi:2", "MigrationPlan has no 'name'")),
    (evil_name, ("plan.xmi", "'../../evil' cannot be a sketch's name")),
    (evil_input, ("outside",)),
    (no_program, ("plan.xmi", "the plan has no program")),
    (no_board, ("plan.xmi", "the plan has no target board")),
    (no_circuit, ("plan.xmi", "which is in none of the models")),
    (with_doctype, ("plan.xmi:2", "DOCTYPE")),
]


@pytest.mark.parametrize(("damage", "said"), DAMAGES, ids=[damage.__name__ for damage, _ in DAMAGES])
def test_a_plan_that_is_damaged_is_refused(
    damage: Callable[[Path], None], said: tuple[str, ...], migrated: Path, tmp_path: Path
) -> None:
    damage(migrated / "models")
    before = tree(tmp_path)
    check_refused(run("generate", migrated / "models" / "plan.xmi", "-o", tmp_path / "again"), 3, *said)
    check_refused(run("generate", migrated / "models" / "plan.xmi", "-o", migrated), 3, *said)
    assert tree(tmp_path) == before


@pytest.mark.parametrize(
    ("name", "cause"),
    [
        ("missing.xmi", "cannot be read"),
        (".", "cannot be read"),
        ("prose.c", "not well-formed"),
        ("binary.c", "not well-formed"),
        ("no_plan.xmi", "this model is a Trace, not a migration plan"),
        ("two_boards.fz", "belongs to no metamodel known here"),
    ],
)
def test_a_plan_that_is_no_plan_is_refused(name: str, cause: str, cases: Path, tmp_path: Path) -> None:
    check_refused(run("generate", cases / name, "-o", tmp_path / "out"), 3, cause)
    assert tree(tmp_path) == {}


def test_a_code_model_is_no_plan(migrated: Path, tmp_path: Path) -> None:
    check_refused(
        run("generate", migrated / "models" / "code.xmi", "-o", tmp_path / "again"),
        3,
        "code.xmi",
        "a Program, not a migration plan",
    )


def test_a_missing_model_is_said_once(migrated: Path, tmp_path: Path) -> None:
    no_code(migrated / "models")
    outcome = run("generate", migrated / "models" / "plan.xmi", "-o", tmp_path / "again")
    assert outcome.err.count("cannot be read") == 1


# --- places to write to


@pytest.mark.parametrize("inside", ["", "deeper", "deeper/still"])
def test_an_output_folder_that_is_a_file_is_refused(inside: str, line_follower: Path, tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("mine")
    before = tree(tmp_path)
    outcome = run("migrate", line_follower, "-o", tmp_path / "taken" / inside)
    check_refused(outcome, 3, "taken", "a file is in the place of the output folder")
    assert "give another output folder" in outcome.err
    assert tree(tmp_path) == before


def test_links_that_lead_to_each_other_are_no_output_folder_and_no_sketch(line_follower: Path, tmp_path: Path) -> None:
    (tmp_path / "one").symlink_to("two")
    (tmp_path / "two").symlink_to("one")
    check_refused(run("migrate", line_follower, "-o", tmp_path / "one"), 3, "one", "a broken link")
    outcome = run("compile", tmp_path / "one")
    assert outcome.code == 3
    assert "the path is a broken link" in outcome.err
    assert "robosmi migrate" in outcome.err


@pytest.mark.parametrize("end", [b"\r", b"\n\r", b"\r\n", b"\r\r\n"])
def test_line_ends_of_other_systems_are_line_ends(end: bytes, tmp_path: Path) -> None:
    text = """#include "simpletools.h"  // tools
#define DOUBLE(x) (2 * (x))
// main
int main() {
  print(
    "%d", DOUBLE(40000));
}"""
    lines = text.splitlines()
    source, plain = tmp_path / "ends.c", tmp_path / "plain" / "ends.c"
    plain.parent.mkdir()
    source.write_bytes(end.join(line.encode() for line in lines))
    plain.write_text("\n".join(lines))
    for path, out in ((source, "out"), (plain, "plain_out")):
        assert run("migrate", path, "-o", tmp_path / out).code == 0
    made, wanted = ((tmp_path / out / "ends" / "ends.ino").read_text().split() for out in ("out", "plain_out"))
    assert made == wanted
    before = tree(tmp_path / "out")
    assert run("migrate", source, "-o", tmp_path / "out").code == 0
    assert tree(tmp_path / "out") == before


@pytest.mark.parametrize("name", ["line_follower", "models", "models/source"])
def test_a_file_where_a_folder_is_to_be_made_is_refused(name: str, line_follower: Path, tmp_path: Path) -> None:
    place = tmp_path / "out" / name
    place.parent.mkdir(parents=True)
    place.write_text("mine")
    before = tree(tmp_path)
    check_refused(run("migrate", line_follower, "-o", tmp_path / "out"), 3, str(place), "a file is in the place of a folder")
    assert tree(tmp_path) == before


@pytest.mark.parametrize(
    "name", ["line_follower/line_follower.ino", "models/plan.xmi", ".robosmi.json", "line_follower/sketch.yaml"]
)
def test_a_folder_where_a_file_is_to_be_written_is_refused(name: str, line_follower: Path, tmp_path: Path) -> None:
    (tmp_path / "out" / name).mkdir(parents=True)
    before = tree(tmp_path)
    check_refused(run("migrate", line_follower, "-o", tmp_path / "out"), 3, name, "a folder is in the place of a file")
    assert tree(tmp_path) == before


@pytest.mark.skipif(not UNREADABLE.exists(), reason="this system has no folder that nobody can write to")
def test_a_folder_that_cannot_be_written_is_refused(line_follower: Path) -> None:
    check_refused(run("migrate", line_follower, "-o", "/proc/self/out"), 3, "/proc/self/out", "cannot write here")


@pytest.mark.parametrize("most", [2_000, 10_000])
def test_a_disk_without_room_is_said_and_the_old_sketch_stays(most: int, migrated: Path, line_follower: Path) -> None:
    line_follower.write_text(line_follower.read_text().replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
    before = tree(migrated)
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, hard))
    try:
        outcome = run("migrate", line_follower, "-o", migrated)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    check_refused(outcome, 3, str(migrated), "cannot write here")
    assert tree(migrated) == before
    assert run("migrate", line_follower, "-o", migrated).code == 0


@pytest.mark.parametrize(
    "words",
    [
        ["analyse", "input/line_follower.c", "-o"],
        ["hardware", "input/line_following_robot.fzz", "-o"],
        ["metamodels", "export"],
    ],
)
def test_a_model_cannot_be_stored_below_a_file(
    words: list[str], line_follower: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    before = tree(tmp_path)
    check_refused(run(*words, line_follower / "below"), 3, "cannot write here")
    assert tree(tmp_path) == before


def test_an_output_name_that_is_too_long_is_refused(line_follower: Path, tmp_path: Path) -> None:
    before = tree(tmp_path)
    check_refused(run("migrate", line_follower, "-o", tmp_path / ("x" * 300)), 3, "too long")
    assert tree(tmp_path) == before


@pytest.mark.parametrize("command", ["analyse", "migrate", "generate"])
def test_a_link_that_leads_to_itself_is_refused(command: str, tmp_path: Path) -> None:
    (tmp_path / "loop.c").symlink_to("loop.c")
    outcome = run(command, tmp_path / "loop.c", "-o", tmp_path / "out")
    assert outcome.code == 3
    assert "loop.c" in outcome.err


def test_a_model_cannot_be_stored_over_a_folder(line_follower: Path, tmp_path: Path) -> None:
    (tmp_path / "code.xmi").mkdir()
    check_refused(run("analyse", line_follower, "-o", tmp_path / "code.xmi"), 3, "code.xmi", "ordinary file")
    assert tree(tmp_path / "code.xmi") == {}


def test_a_damaged_record_of_the_last_run_stops_the_next(migrated: Path, line_follower: Path) -> None:
    (migrated / ".robosmi.json").write_text('{"files": ["x"')
    before = tree(migrated)
    check_refused(run("migrate", line_follower, "-o", migrated), 3, ".robosmi.json", "the record of the last run cannot be read")
    assert tree(migrated) == before


def test_a_record_that_names_files_outside_is_refused(migrated: Path, line_follower: Path) -> None:
    (migrated / ".robosmi.json").write_text('{"files": {"../input/line_follower.c": "0"}}')
    check_refused(run("migrate", line_follower, "-o", migrated), 3, ".robosmi.json", "outside")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("missing.ecore", "the metamodel does not exist"),
        ("prose.c", "not well-formed XML"),
        ("no_plan.xmi", "no EPackage"),
        ("other.fz", "no EPackage"),
    ],
)
def test_a_metamodel_that_is_none_is_refused(name: str, said: str, cases: Path, tmp_path: Path) -> None:
    check_refused(run("metamodels", "generate", cases / name, "-o", tmp_path / "py"), 3, name, said)
    assert tree(tmp_path) == {}


@pytest.mark.parametrize("name", ["missing", "cases"])
def test_a_folder_without_a_sketch_is_not_compiled(name: str, cases: Path) -> None:
    outcome = run("compile", cases.parent / name)
    assert outcome.code == 3
    assert str(cases.parent / name) in outcome.err


def test_an_unknown_board_is_wrong_usage(migrated: Path) -> None:
    check_refused(run("compile", migrated, "--board", "unoo"), 2, "unoo", "uno")


def test_a_pin_table_with_a_pin_that_the_board_has_not_is_refused_and_the_old_sketch_stays(
    line_follower: Path, tmp_path: Path
) -> None:
    (line_follower.parent / "robosmi.toml").unlink()
    table = tmp_path / "table.csv"
    table.write_text("pin,part\nD9,Red LED\n")
    assert run("migrate", line_follower, "-o", tmp_path / "out", "--hardware", table).code == 0
    before = tree(tmp_path / "out")
    table.write_text("pin,part\nD99,Red LED\n")
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--hardware", table)
    check_refused(outcome, 3, "wired to D99", "wire it to one of the board's pins: D0, D1")
    assert tree(tmp_path / "out") == before


def test_a_report_does_not_say_none_where_its_findings_stand_among_what_is_to_be_done(cases: Path, tmp_path: Path) -> None:
    run("migrate", cases / "syntax.c", "-o", tmp_path / "out")
    findings = (tmp_path / "out" / "syntax" / "MIGRATION.md").read_text().partition("## Findings\n")[2].partition("\n## ")[0]
    assert "\nNone.\n" not in findings


def test_an_error_of_several_places_has_a_line_for_each(tmp_path: Path) -> None:
    """What follows the first line is indented, so that no name in it passes for a message of its own."""
    model = tmp_path / "plan.xmi"
    said = run("migrate", "docs/examples/line_follower/line_follower.c", "-o", str(tmp_path / "out"))
    assert said.code == 0, said.err
    text = (tmp_path / "out" / "models" / "plan.xmi").read_text()
    model.write_text(text.replace(' name="line_follower"', ' nme="line_follower" bogus="1"', 1))
    outcome = run("generate", str(model), "-o", str(tmp_path / "again"))
    lines = outcome.err.splitlines()
    assert outcome.code == 3
    assert "\\n" not in outcome.err
    assert [line for line in lines if not line.startswith("  ")] == lines[:1]
    assert sum("has no feature" in line for line in lines) == 2
