"""`robosmi adapters`, adapter files of a project and of a user, and what persons write into a generated program."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

import pytest

from tests.running import Outcome, run
from tests.tools import require_tools

SOURCE = Path(__file__).parent / "adapters" / "tilt.c"
OWN = """//# header s3.h
//# adapter s3_ping
//#   for: int32_t s3_ping(int32_t Pin)
//#   kind: oneToMany
//#   needs: simpletools.h/pulse_in
//#   pin: Pin digital in
//#   limit: only level
inline int32_t s3_ping(int32_t Pin) {
  return pulse_in(Pin, 1) - 5000;
}
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with the program, and a user without data."""
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    folder = tmp_path / "project"
    folder.mkdir()
    shutil.copy(SOURCE, folder)
    (folder / "robosmi.toml").touch()
    monkeypatch.chdir(folder)
    return folder


def migrated(project: Path) -> Outcome:
    return run("migrate", project / "tilt.c", "-o", project / "out", "--json")


def sites(outcome: Outcome) -> tuple[int, int]:
    found = outcome.document["result"]["plan"]["call_sites"]
    return found["with_body"], found["todo"]


def write_body(
    project: Path, name: str = "s3_ping", body: str = "return pulseIn(Pin, HIGH) - 5000;", program: str = "tilt"
) -> None:
    path = project / "out" / program / "adapters.h"
    text, count = re.subn(rf"({name}\(int32_t \w+\)) \{{.*?^\}}", rf"\1 {{\n  {body}\n}}", path.read_text(), flags=re.S | re.M)
    assert count == 1
    path.write_text(text)


@pytest.mark.processes
@pytest.mark.parametrize("place", ["project/adapters", "home/adapters"])
def test_own_adapter_files_go_before_the_built_in_ones(place: str, project: Path) -> None:
    assert sites(migrated(project)) == (1, 2)
    folder = project.parent / place
    folder.mkdir(parents=True)
    (folder / "s3.cpp").write_text(OWN)
    outcome = migrated(project)
    assert sites(outcome) == (2, 1)
    assert "return pulse_in(Pin, 1) - 5000;" in (project / "out" / "tilt" / "adapters.h").read_text()
    rows = run("adapters", "list", "--json").document["result"]["adapters"]
    mine = [row for row in rows if row["function"] == "s3_ping"]
    assert mine == [
        {
            "function": "s3_ping", "header": "s3.h", "kind": "1:n", "source": place.split("/")[0].replace("home", "user"),
            "status": "care", "limits": ["only level"],
        }
    ]  # fmt: skip


def test_the_list_ends_with_how_many_functions_have_an_adapter() -> None:
    rows = run("adapters", "list", "--json").document["result"]["adapters"]
    lines = run("adapters", "list").out.splitlines()
    filled = sum(row["status"] in ("filled", "care") for row in rows)
    assert lines[-1] == f"{filled} of {len(rows)} functions have an adapter"
    assert sum(line.startswith("simpletools.h ") for line in lines) == sum(row["header"] == "simpletools.h" for row in rows)


def test_other_code_in_a_folder_of_that_name_is_left_alone(project: Path) -> None:
    (project / "adapters").mkdir()
    (project / "adapters" / "usb.cpp").write_text("// an adapter for USB\nint main() {}\n")
    assert sites(migrated(project)) == (1, 2)


@pytest.mark.processes
def test_a_file_in_another_language_is_not_for_the_target(project: Path) -> None:
    (project / "adapters").mkdir()
    (project / "adapters" / "s3.c").write_text(OWN.replace("inline", "static inline"))
    assert sites(migrated(project)) == (1, 2)
    outcome = run("migrate", project / "tilt.c", "-o", project / "out-c", "--target", "avr-c", "--json")
    assert sites(outcome) == (2, 1)


@pytest.mark.parametrize(
    ("old", "new", "line", "said", "fix"),
    [
        ("pulse_in(Pin", "pulse_inn(Pin", 9, "'pulse_inn' was not declared", "correct it"),
        (
            "//#   needs: simpletools.h/pulse_in\n",
            "",
            8,
            "'pulse_in' was not declared",
            "add `//#   needs: simpletools.h/pulse_in`",
        ),
        (
            "needs: simpletools.h/pulse_in",
            "needs: simpletools.h/pulse_inn",
            2,
            "'simpletools.h/pulse_inn'",
            "",
        ),
        ("- 5000;\n}", "- 5000;\n", 8, "'{' is never closed", "close each bracket"),
        ("pin: Pin", "pin: Pni", 6, "no parameter 'Pni' (did you mean 'Pin'?)", "correct the name"),
        (
            "//#   limit: only level",
            "//#   mcu: atmega382p",
            2,
            "'atmega382p'",
            "use: ",
        ),
    ],
)
def test_a_bad_adapter_file_is_an_error_and_the_old_sketch_stays(
    old: str, new: str, line: int, said: str, fix: str, project: Path
) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    migrated(project)
    before = {path: path.read_bytes() for path in (project / "out").rglob("*") if path.is_file()}
    (project / "adapters").mkdir()
    path = project / "adapters" / "s3.cpp"
    path.write_text(OWN.replace(old, new))
    outcome = run("migrate", project / "tilt.c", "-o", project / "out")
    assert outcome.code == 3
    assert f"{path}:{line}: " in outcome.err
    assert said in outcome.err
    assert fix in outcome.err
    assert {path: path.read_bytes() for path in (project / "out").rglob("*") if path.is_file()} == before


def test_a_body_that_a_person_wrote_counts_as_filled(project: Path) -> None:
    migrated(project)
    write_body(project)
    outcome = migrated(project)
    assert sites(outcome) == (2, 1)
    assert [task["message"] for task in outcome.document["tasks"] if "s3_ping" in task["message"]] == []
    report = (project / "out" / "tilt" / "MIGRATION.md").read_text()
    assert "1 needs a pin, 1 needs a body" in report
    assert "written by you" in report
    first = {path: path.read_bytes() for path in (project / "out").rglob("*") if path.is_file()}
    assert sites(migrated(project)) == (2, 1)
    assert {path: path.read_bytes() for path in (project / "out").rglob("*") if path.is_file()} == first
    again = run("generate", project / "out" / "models" / "plan.xmi", "-o", project / "other", "--json")
    assert sites(again) == (1, 2)  # where the body is not there, it is still to be written


@pytest.mark.parametrize("body", ["// TODO: complete method\n  return 0;", "(void)Pin;\n  return 0; // not supported"])
def test_a_placeholder_that_does_nothing_still_is_to_be_written(body: str, project: Path) -> None:
    migrated(project)
    write_body(project, body=body)
    assert sites(migrated(project)) == (1, 2)


@pytest.mark.processes
@pytest.mark.parametrize("body", ["(void)Pin;\n  return 0;", "// nothing to measure on this robot\n  (void)Pin;\n  return 0;"])
def test_a_body_that_does_nothing_on_purpose_counts_as_filled(body: str, project: Path) -> None:
    migrated(project)
    write_body(project, body=body)
    assert sites(migrated(project)) == (2, 1)
    assert "s3_ping" in run("adapters", "save", project / "out", "--as", "user").out


def test_a_ticked_task_is_done_and_becomes_no_conflict(project: Path) -> None:
    migrated(project)
    path = project / "out" / "tilt" / "MIGRATION.md"
    text = path.read_text()
    path.write_text(text.replace("- [ ] write the body of 'int32_t s3_ping", "- [x] write the body of 'int32_t s3_ping"))
    source = project / "tilt.c"
    source.write_text(source.read_text().replace("  while (1) {", "  s3_ping(4);\n  while (1) {"))
    outcome = migrated(project)
    done = [task["message"] for task in outcome.document["tasks"] if task["evidence"].get("done")]
    assert [message[:40] for message in done] == ["write the body of 'int32_t s3_ping(int32"]
    assert "- [x] write the body of 'int32_t s3_ping(int32_t Pin)', called 2 times" in path.read_text()
    source.write_text(SOURCE.read_text().replace("s3_ping(5)", "1"))
    outcome = migrated(project)
    assert "<<<<<<<" not in path.read_text()
    assert "[x]" not in path.read_text()
    assert [finding["rule"] for finding in outcome.document["findings"] if finding["severity"] == "error"] == []


def test_what_was_written_for_a_call_that_goes_stays_with_a_word(project: Path) -> None:
    migrated(project)
    write_body(project)
    migrated(project)
    source = project / "tilt.c"
    source.write_text(SOURCE.read_text().replace("s3_ping(5)", "1"))
    outcome = migrated(project)
    said = [finding["message"] for finding in outcome.document["findings"] if finding["rule"] == "RS527"]
    assert said == ["'s3_ping' is no longer called or has another body; your body is disabled at the end of the file"]
    text = (project / "out" / "tilt" / "adapters.h").read_text()
    assert "<<<<<<<" not in text
    assert text.endswith("int32_t s3_ping(int32_t Pin) {\n  return pulseIn(Pin, HIGH) - 5000;\n}\n#endif\n")
    assert text.count("s3_ping(") == 2  # its comment, and itself
    outcome = migrated(project)
    assert [finding for finding in outcome.document["findings"] if finding["rule"] == "RS527"] == []
    assert (project / "out" / "tilt" / "adapters.h").read_text() == text
    source.write_text(SOURCE.read_text())
    assert sites(migrated(project)) == (1, 2)


@pytest.mark.processes
@pytest.mark.parametrize("whose", ["user", "project"])
def test_bodies_are_saved_for_the_next_program(whose: str, project: Path) -> None:
    migrated(project)
    write_body(project)
    outcome = run("adapters", "save", project / "out", "--as", whose, "--json")
    folder = project if whose == "project" else project.parent / "home"
    path = folder / "adapters" / "s3.cpp"
    assert outcome.document["result"] == {
        "adapters": [
            {
                "function": "s3_ping",
                "header": "s3.h",
                "kind": "semantic",
                "source": whose,
                "status": "filled",
                "limits": [],
            }
        ],
        "written": [str(path)],
    }
    assert "//#   pin: Pin digital both\n" in path.read_text()
    assert sites(migrated(project)) == (2, 1)
    text = (project / "out" / "tilt" / "adapters.h").read_text()
    assert "inline int32_t s3_ping(int32_t Pin) {\n  return pulseIn(Pin, HIGH) - 5000;\n}" in text
    assert "#if 0" not in text
    write_body(project, "s3_setVolume", "digitalWrite(Volume, !digitalRead(Volume));")
    run("adapters", "save", project / "out", "--as", whose)
    assert path.read_text().count("//# adapter ") == 2
    assert sites(migrated(project)) == (3, 0)
    shown = run("adapters", "show", "s3_setVolume", "--json").document["result"]["adapters"]
    assert [(each["source"], "digitalRead" in each["text"]) for each in shown] == [(whose, True)]


@pytest.mark.processes
def test_an_earlier_body_in_the_file_is_kept_beside_it(project: Path) -> None:
    migrated(project)
    write_body(project)
    assert run("adapters", "save", project / "out", "--as", "project").code == 0
    file = project / "adapters" / "s3.cpp"
    mine = file.read_text().replace("- 5000", "- 4999  // mine")
    file.write_text(mine)
    outcome = run("adapters", "save", project / "out", "--as", "project", "--json")
    assert [f["rule"] for f in outcome.document["findings"]] == ["RS528"]
    assert "s3.cpp.orig" in outcome.document["findings"][0]["message"]
    assert (project / "adapters" / "s3.cpp.orig").read_text() == mine
    assert "- 5000" in file.read_text()
    assert run("adapters", "save", project / "out", "--as", "project").code == 0
    assert not (project / "adapters" / "s3.cpp.orig.2").exists()


@pytest.mark.processes
def test_a_body_that_does_not_compile_is_not_saved(project: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    migrated(project)
    write_body(project, "s3_setVolume", "tilt_of(Volume);")
    outcome = run("adapters", "save", project / "out", "--as", "project")
    assert outcome.code == 3
    assert "the body of 's3_setVolume' does not compile alone" in outcome.err
    assert "'tilt_of' was not declared" in outcome.err
    assert "nothing was saved" in outcome.err
    assert not (project / "adapters").exists()
    write_body(project, "s3_setVolume", "digitalWrite(Volume, !digitalRead(Volume));")
    assert run("adapters", "save", project / "out", "--as", "project").code == 0


@pytest.mark.processes
def test_a_body_that_uses_a_pin_of_the_sketch_is_told_how_adapter_files_name_pins(project: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    drawing = project / "lamp.csv"
    for path in (project / "lamp.c", drawing):
        shutil.copy(SOURCE.parent / path.name, path)
    plan = run("migrate", project / "lamp.c", "--hardware", drawing, "-o", project / "out", "--json")
    pin = "lampWriteP1"
    assert plan.code == 0
    write_body(project, "s3_setVolume", f"digitalWrite({pin}, Volume);", "lamp")
    outcome = run("adapters", "save", project / "out", "--as", "project")
    assert outcome.code == 3
    assert f"'{pin}' is a pin of this sketch" in outcome.err
    assert "//# port: CONSTANT = LIBRARY.NAME NUMBER digital out" in outcome.err


def test_a_body_for_a_function_of_no_known_header_is_told_alone(project: Path) -> None:
    shutil.copy(SOURCE.parent / "beep.c", project)
    run("migrate", project / "beep.c", "-o", project / "out", "--yes")
    adapters = project / "out" / "beep" / "adapters.h"
    text = adapters.read_text()
    assert "// TODO: complete method" in text
    adapters.write_text(text.replace("// TODO: complete method", "pinMode(argument1, OUTPUT);"))
    outcome = run("adapters", "save", project / "out", "--as", "project", "--json")
    assert [f["message"] for f in outcome.document["findings"]] == [
        "'beep_twice' is not a function of a known header, so its body cannot be saved"
    ]


@pytest.mark.processes
def test_a_body_that_needs_the_sketch_keeps_no_other_from_being_saved(project: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    migrated(project)
    write_body(project)
    write_body(project, "s3_setVolume", "tilt_of(Volume);")
    outcome = run("adapters", "save", project / "out", "--as", "project", "--json")
    assert outcome.code == 1
    assert [row["function"] for row in outcome.document["result"]["adapters"]] == ["s3_ping"]
    (finding,) = outcome.document["findings"]
    assert (finding["rule"], finding["severity"]) == ("RS528", "error")
    assert "the body of 's3_setVolume' does not compile alone: 'tilt_of' was not declared" in finding["message"]
    text = (project / "adapters" / "s3.cpp").read_text()
    assert "//# adapter s3_ping\n" in text
    assert "s3_setVolume" not in text


def test_nothing_to_save_and_no_project_say_so(project: Path) -> None:
    migrated(project)
    outcome = run("adapters", "save", project / "out", "--json")
    assert [finding["rule"] for finding in outcome.document["findings"]] == ["RS528"]
    assert not (project.parent / "home" / "adapters").exists()
    (project / "robosmi.toml").unlink()
    write_body(project)
    outcome = run("adapters", "save", project / "out", "--as", "project")
    assert outcome.code == 3
    assert "create an empty robosmi.toml next to the source" in outcome.err


def test_adapters_are_listed_with_what_they_do_not_do(project: Path) -> None:
    rows = run("adapters", "list", "--json").document["result"]["adapters"]
    assert {tuple(row) for row in rows} == {("function", "header", "kind", "source", "status", "limits")}
    by_name = {(row["header"], row["function"]): row for row in rows}
    assert by_name["ping.h", "ping_cm"] == {
        "function": "ping_cm", "header": "ping.h", "kind": "1:1", "source": "built-in", "status": "filled", "limits": [],
    }  # fmt: skip
    assert by_name["simpletools.h", "freqout"]["status"] == "care"
    assert by_name["wifi.h", "wifi_start"]["status"] == "unsupported"
    assert by_name["wifi.h", "wifi_start"]["limits"] != [""]
    todo = run("adapters", "show", "cal_activityBot", "--json").document["result"]["adapters"]
    assert [(row["header"], row["status"], row["signatures"], row["text"]) for row in todo] == [
        ("abcalibrate.h", "todo", ["void cal_activityBot()"], ""),
        ("abcalibrate360.h", "todo", ["void cal_activityBot(void)"], ""),
    ]
    assert "robosmi adapters save OUT" in run("adapters", "show", "abcalibrate.h/cal_activityBot").out
    assert by_name["wifi.h", "wifi_start"]["limits"][0] in run("adapters", "show", "wifi_start").out
    outcome = run("adapters", "show", "pingg")
    assert outcome.code == 2
    assert "did you mean 'ping'?" in outcome.err
    assert "return ping(pin) / 58;" in run("adapters", "show", "ping.h/ping_cm").out


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize("linked", ["models", "models/plan.xmi", "tilt", "tilt/adapters.h"])
def test_nothing_is_saved_out_of_a_folder_that_a_link_leads_out_of(linked: str, project: Path) -> None:
    migrated(project)
    write_body(project)
    outside = project.parent / "outside"
    (project / "out" / linked).rename(outside)
    (project / "out" / linked).symlink_to(outside)
    outcome = run("adapters", "save", project / "out")
    assert outcome.code == 3, outcome.err
    assert "link" in outcome.err
    assert not list((project.parent / "home").rglob("s3*"))


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize("linked", ["adapters", "adapters/s3.cpp"])
def test_nothing_is_saved_out_of_the_project_through_a_link(linked: str, project: Path) -> None:
    migrated(project)
    write_body(project)
    secret = project.parent / "secret"
    (project / linked).parent.mkdir(exist_ok=True)
    if linked == "adapters":
        secret.mkdir()
    else:
        secret.write_text("mine\n")
    (project / linked).symlink_to(secret)
    outcome = run("adapters", "save", project / "out", "--as", "project")
    assert outcome.code == 3
    assert "is outside the project's folder" in outcome.err or "is a link" in outcome.err
    assert "mine" not in outcome.err
    assert list(secret.iterdir()) == [] if linked == "adapters" else secret.read_text() == "mine\n"
    assert (project / linked).is_symlink()


@pytest.mark.processes
@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_adapters_may_lie_elsewhere_in_the_project_by_a_link(project: Path) -> None:
    migrated(project)
    write_body(project)
    (project / "shared").mkdir()
    (project / "adapters").symlink_to("shared")
    assert run("adapters", "save", project / "out", "--as", "project").code == 0
    assert (project / "shared" / "s3.cpp").is_file()


GLOW = """//# header glow.h

//# adapter glow_pulses
//#   for: int glow_pulses(int pin, int count)
//#   kind: oneToOne
//#   pin: pin digital out
inline int32_t glow_pulses(int32_t pin, int32_t count) {
  digitalWrite(pin, count & 1);
  return count;
}
"""


@pytest.mark.processes
@pytest.mark.parametrize(
    ("begin", "call"),
    [
        ('#include "glow.h"\n', "glow_pulses(9, 3);"),
        ('#include "glow.h"\n', "int (*f)(int, int) = glow_pulses; f(9, 3);"),
        ("int glow_pulses(int pin, int count);\nint stick = 9;\n", "glow_pulses(stick, 3);"),
        ("", "glow_pulses(9, 3);"),
        ('#include "propeller.h"\n', "setpin(9, 1);"),
    ],
    ids=["header", "pointer", "declared", "unknown", "platform"],
)
def test_a_declared_pin_of_an_adapter_is_a_port_of_the_program(begin: str, call: str, project: Path) -> None:
    (project / "glow.h").write_text("int glow_pulses(int pin, int count);\n")
    (project / "adapters").mkdir()
    (project / "adapters" / "glow.cpp").write_text(GLOW)
    (project / "stick.c").write_text(f'#include "simpletools.h"\n{begin}int main() {{ {call} }}\n')
    (project / "w.csv").write_text("pin,part,title\nD9,Servo,arm\nD4,Red LED,lamp\n")
    given = ("migrate", project / "stick.c", "--hardware", project / "w.csv", "-o", project / "out", "--library", "arm=none")
    assert run(*given).code == 0
    sketch = project / "out" / "stick" / "stick.ino"
    assert re.search(r"\((255|port\(9\))|stick\s*=\s*255", sketch.read_text())
    assert not re.search(r"(glow_pulses|setpin|f)\(9|stick\s*=\s*9", sketch.read_text())
    assert run(*given, "--bind", "P9=D4").code == 0
    assert re.search(r"\((lampWriteP1|port\(9\))|stick\s*=\s*lampWriteP1", sketch.read_text())


@pytest.mark.processes
def test_a_library_that_an_adapter_declares_and_does_not_include_is_refused(project: Path) -> None:
    (project / "glow.h").write_text("int glow_pulses(int pin, int count);\n")
    (project / "adapters").mkdir()
    adapter = project / "adapters" / "glow.cpp"
    adapter.write_text(GLOW.replace("//#   kind:", "//#   library: NewPing\n//#   kind:", 1))
    (project / "stick.c").write_text('#include "simpletools.h"\n#include "glow.h"\nint main() { glow_pulses(9, 3); }\n')
    outcome = run("migrate", project / "stick.c", "-o", project / "out")
    assert outcome.code == 3
    assert "'glow_pulses' declares the library 'NewPing', and its text includes no header of it" in outcome.err
    assert not (project / "out").exists()
    adapter.write_text(f"\ufeff{GLOW}", encoding="utf-8")  # as some editors write it
    assert run("migrate", project / "stick.c", "-o", project / "out").code == 0


@pytest.mark.processes
@pytest.mark.parametrize(
    ("include", "message", "fix"),
    [
        ("<Wire.h>", "its text includes no header of it, and <Wire.h> is none", "include: <NewPing.h>"),
        ("<NewPing.h>", "", ""),
        ('"NewPing.h"', "", ""),
    ],
)
def test_an_include_of_another_library_than_the_declared_one_is_refused(
    include: str, message: str, fix: str, project: Path
) -> None:
    (project / "glow.h").write_text("int glow_pulses(int pin, int count);\n")
    (project / "adapters").mkdir()
    declared = GLOW.replace("//#   kind:", f"//#   library: NewPing\n//#   include: {include}\n//#   kind:", 1)
    (project / "adapters" / "glow.cpp").write_text(declared)
    (project / "stick.c").write_text('#include "simpletools.h"\n#include "glow.h"\nint main() { glow_pulses(9, 3); }\n')
    outcome = run("migrate", project / "stick.c", "-o", project / "out")
    assert outcome.code == (3 if message else 0), outcome.err
    assert message in outcome.err
    assert fix in outcome.err
    assert (project / "out").exists() == (not message)


def test_an_include_that_nobody_knows_is_refused(project: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    (project / "glow.h").write_text("int glow_pulses(int pin, int count);\n")
    (project / "adapters").mkdir()
    (project / "adapters" / "glow.cpp").write_text(GLOW.replace("//#   kind:", "//#   include: <Gloww.h>\n//#   kind:", 1))
    (project / "stick.c").write_text('#include "simpletools.h"\n#include "glow.h"\nint main() { glow_pulses(9, 3); }\n')
    outcome = run("migrate", project / "stick.c", "-o", project / "out")
    assert outcome.code == 3
    assert "'Gloww.h', which it includes, is neither installed nor a header of a known library" in outcome.err
    assert not (project / "out").exists()


@pytest.mark.parametrize(
    ("name", "old", "new", "message"),
    [
        ("glow", "//#   kind:", "//#   setup: nosuch();\n//#   kind:", "'nosuch();' of its setup: 'nosuch' was not declared"),
        ("gloww", "", "", "the adapter file is for 'glow.h'"),
        ("glow", "int glow_pulses(", "void glow_pulses(", "'void glow_pulses(int pin, int count)'"),
    ],
)
def test_an_own_adapter_is_held_against_what_it_says(name: str, old: str, new: str, message: str, project: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    (project / "glow.h").write_text("int glow_pulses(int pin, int count);\n")
    (project / "adapters").mkdir()
    (project / "adapters" / f"{name}.cpp").write_text(GLOW.replace(old, new, 1))
    (project / "stick.c").write_text('#include "simpletools.h"\n#include "glow.h"\nint main() { glow_pulses(9, 3); }\n')
    outcome = run("migrate", project / "stick.c", "-o", project / "out")
    assert outcome.code == 3, outcome.out
    assert message in outcome.err
    assert f"{name}.cpp:" in outcome.err
    assert not (project / "out").exists()


def test_a_known_function_keeps_giving_something_back(project: Path) -> None:
    (project / "adapters").mkdir()
    text = (
        "//# header ping.h\n\n//# adapter ping_cm\n//#   for: void ping_cm(int pin)\n//#   kind: semantic\n//#   fidelity: none\n"
    )
    (project / "adapters" / "ping.cpp").write_text(f"{text}inline void ping_cm(int32_t) {{}}\n")
    (project / "stick.c").write_text('#include "simpletools.h"\n#include "ping.h"\nint main() { ping_cm(9); }\n')
    outcome = run("migrate", project / "stick.c", "-o", project / "out")
    assert outcome.code == 3
    assert "'ping_cm' is for 'void ping_cm(int pin)', and ping.h declares 'int ping_cm(int pin)'" in outcome.err


def test_adapters_beside_a_program_without_a_project_file_are_told(project: Path) -> None:
    (project / "adapters").mkdir()
    (project / "adapters" / "glow.cpp").write_text(GLOW)
    (project / "stick.c").write_text('#include "simpletools.h"\nint main() { high(9); }\n')
    (project / "robosmi.toml").unlink(missing_ok=True)
    told = run("migrate", project / "stick.c", "-o", project / "out", "--json").document["findings"]
    assert [Path(f["location"]["path"]).name for f in told if f["rule"] == "RS529"] == ["adapters"]
    (project / "robosmi.toml").write_text("")
    assert "RS529" not in run("migrate", project / "stick.c", "-o", project / "out", "--json").rules()
    (project / "adapters").rename(project / "adapter")
    told = run("migrate", project / "stick.c", "-o", project / "out", "--json").document["findings"]
    assert [(f["message"], f["fix"]) for f in told if f["rule"] == "RS529"] == [
        ("the adapter files are not read: their folder is not called 'adapters'", "rename it to 'adapters'")
    ]
