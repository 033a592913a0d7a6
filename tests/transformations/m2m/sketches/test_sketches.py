"""Sketches on other boards of their platform: the text stays but for pins and what behaves differently; nothing is lost."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.running import Outcome, run

HERE = Path(__file__).parent


def migrated(name: str, out: Path, *words: str, target: str = "pico", source: str = "uno") -> Outcome:
    folder = HERE / name
    sketch = next(iter(sorted(folder.glob("*.ino"), key=lambda path: path.stem != folder.name)))
    return run("migrate", sketch, "--from", source, "--target", target, "-o", out, "--yes", "--json", *words)


def text(out: Path, name: str) -> str:
    return (out / name).read_text(encoding="utf-8")


def changed(out: Path, name: str) -> dict[int, str]:
    """Line of the sketch -> its new text, where that differs."""
    before = (HERE / name / f"{name}.ino").read_text(encoding="utf-8").splitlines()
    after = text(out, f"{name}/{name}.ino").splitlines()
    assert len(before) == len(after)
    return {number: new for number, (old, new) in enumerate(zip(before, after, strict=True), 1) if old != new}


def tasks(outcome: Outcome, rule: str) -> list[dict[str, Any]]:
    return [task for task in outcome.document["tasks"] if task["rule"] == rule]


def pins(outcome: Outcome) -> dict[str, str]:
    """What a binding is called by its number on the source board -> its pin."""
    bindings = outcome.result["plan"]["bindings"]
    return {(each["names"] or [each["name"]])[-1]: each["pin"] for each in bindings}


@pytest.mark.parametrize(
    ("name", "target"),
    [*((name, board) for name in ("pins", "classes", "tabs") for board in ("nano", "mega")), ("inherited", "mega")],
)
def test_a_sketch_needs_no_edit_on_a_board_with_the_same_pins(name: str, target: str, tmp_path: Path) -> None:
    outcome = migrated(name, tmp_path, target=target)
    assert outcome.code == 0
    for file in (path for path in (HERE / name).rglob("*") if path.is_file()):
        made = tmp_path / name / file.relative_to(HERE / name)
        assert made.read_bytes().split() == file.read_bytes().split()  # line ends may differ
    assert not tasks(outcome, "RS347")
    assert not (tmp_path / name / "adapters.h").exists()


def test_a_number_of_a_pin_is_looked_up_where_it_could_be_a_channel(tmp_path: Path) -> None:
    """14 is A0 on an Uno and another pin on a Mega; 0 is A0 on both (see `inherited`)."""
    sketch = tmp_path / "inherited" / "inherited.ino"
    shutil.copytree(HERE / "inherited", sketch.parent)
    sketch.write_text(sketch.read_text(encoding="utf-8").replace("EYE 0", "EYE 14"), encoding="utf-8")
    out = tmp_path / "out"
    assert run("migrate", sketch, "--from", "uno", "--target", "mega", "-o", out, "--yes", "--json").code == 0
    assert "analogRead(port_of_channel(channel))" in text(out, "inherited/Parts.cpp")


def test_a_pin_shared_with_a_bus_stays_where_the_processor_does(tmp_path: Path) -> None:
    """A regression: servos on the pins of Serial were given others on a Nano."""
    assert migrated("shared_with_serial", tmp_path, target="nano").code == 0
    assert not changed(tmp_path, "shared_with_serial")


@pytest.mark.parametrize(
    ("target", "lines"),
    [
        ("pico", {1: "int far = 26;", 2: "const int near = 27;", 10: "  Serial.println(analogRead(26));"}),
        ("mega", {1: "int far = A7;"}),
    ],
)
def test_pins_that_only_measure_have_numbers_names_and_channels(target: str, lines: dict[int, str], tmp_path: Path) -> None:
    outcome = migrated("analog_pins", tmp_path, target=target, source="nano")
    assert lines.items() <= changed(tmp_path, "analog_pins").items()
    assert len([line for line in changed(tmp_path, "analog_pins").values() if "Read" in line or "int" in line]) == len(lines)
    assert not [finding for finding in outcome.document["findings"] if finding["rule"] in ("RS326", "RS327")]


def test_a_number_that_is_no_pin_of_the_board_is_told(tmp_path: Path) -> None:
    outcome = migrated("no_such_pins", tmp_path)
    [finding] = [finding for finding in outcome.document["findings"] if finding["rule"] == "RS326"]
    assert re.findall(r"\b2\d\b", finding["message"]) == ["21", "22", "25"]
    assert changed(tmp_path, "no_such_pins") == {}


def test_every_place_of_a_pin_changes_with_its_port(tmp_path: Path) -> None:
    said = {
        "BUZZER": "GP15",
        "D7": "GP2",
        "3": "GP3",
        "D5": "GP17",
        "RED": "GP19",
        "D12": "GP20",
        "A3": "GP21",
        "D13": "LED_BUILTIN",
    }
    outcome = migrated("pins", tmp_path, *(word for port, pin in said.items() for word in ("--bind", f"{port}={pin}")))
    assert outcome.code == 0
    made = changed(tmp_path, "pins")
    assert made[5] == "#define BUZZER 15"
    assert made[7] == "const int relay = 2;"
    assert made[8] == "const byte motors[] = { 3, 17 };"
    assert made[9].startswith("enum Lamps { RED = 19, GREEN = ")
    assert made[10].startswith("LiquidCrystal lcd(20, 11, 6, 4, ")
    assert made[10].endswith(", 25);")
    assert made[11].endswith(", 21);")
    assert re.search(r"analogRead\(2[678]\) / 4", made[28])
    assert re.search(r"attachInterrupt\(digitalPinToInterrupt\(3\), onEdge", made[20])
    assert not {26, 27} & set(made)
    assert not tasks(outcome, "RS345")


def test_pins_without_a_drawing_are_proposed_by_abilities_and_left_to_approve(tmp_path: Path) -> None:
    outcome = migrated("pins", tmp_path)
    bound = pins(outcome)
    assert {bound["A0"], bound["A1"]} <= {"GP26", "GP27", "GP28"}
    assert len(set(bound.values())) == len(bound)
    assert len(tasks(outcome, "RS347")) == 1


def test_methods_of_one_name_are_told_apart_by_their_classes(tmp_path: Path) -> None:
    said = ("--bind", "D4=GP20", "--bind", "D5=GP21", "--bind", "D7=GP22")
    outcome = migrated("wrapped", tmp_path, *said)
    assert outcome.code == 0
    made = text(tmp_path, "wrapped/wrapped.ino")
    for line in (
        "leg.attach(4, 21);",
        "lamp.attach(6, 22);",
        "leg.set(30);",
        "lamp.set(22);",
        "hip.attach(port(pin), 544, 2400);",
    ):
        assert f"  {line}\n" in made
    assert re.search(r"\b20, +// 4:", text(tmp_path, "wrapped/moved_pins.h"))
    assert not [finding for finding in outcome.document["findings"] if finding["rule"] in ("RS341", "RS345")]


def test_a_task_is_gone_once_persons_have_said_all_pins(tmp_path: Path) -> None:
    outcome = migrated("tabs", tmp_path, "--bind", "LAMP=GP9")
    assert outcome.code == 0
    assert not tasks(outcome, "RS347")
    assert changed(tmp_path, "tabs") == {2: "const int LAMP = 9;"}


def test_members_of_classes_are_followed_to_where_objects_are_made(tmp_path: Path) -> None:
    outcome = migrated("classes", tmp_path, "--bind", "D5=GP20", "--bind", "D6=GP21", "--bind", "D7=GP22")
    assert changed(tmp_path, "classes") == {3: "Wheel left(20);", 4: "Wheel right = Wheel(21);"}
    assert "int lamp = 22" in text(tmp_path, "classes/Wheel.h")
    assert not tasks(outcome, "RS345")


def test_what_differs_is_cured_by_rule_and_the_rest_is_a_task(tmp_path: Path) -> None:
    outcome = migrated("cures", tmp_path, "--bind", "D9=GP9", "--bind", "D8=GP8")
    made = changed(tmp_path, "cures")
    assert made[13] == "  arm.attach(9, 544, 2400);"
    assert "while (!Serial && millis() < " in made[12]
    assert "EEPROM.begin(1024);" in made[11]
    assert made[16] == "  } EEPROM.commit();"
    assert made[17] == "  EEPROM.update(7, index_); EEPROM.commit();"
    assert made[21] == "  row.index = index_;"
    left = {(task["location"]["line"], task["message"].split(": ")[1]) for task in tasks(outcome, "RS346")}
    assert left == {(22, "other_register")}


def test_a_drawing_of_the_new_board_binds_the_pins(tmp_path: Path) -> None:
    outcome = migrated("drawn", tmp_path, "--hardware", str(HERE / "drawn" / "pico.json"))
    assert changed(tmp_path, "drawn") == {1: "const int TRIG = 3;", 2: "const int ECHO = 4;"}
    assert not tasks(outcome, "RS347")


def test_a_part_at_the_same_pin_of_a_like_board_needs_no_choice(tmp_path: Path) -> None:
    outcome = migrated("drawn", tmp_path, "--hardware", str(HERE / "drawn" / "mega.json"), target="mega")
    assert changed(tmp_path, "drawn") == {}
    assert not tasks(outcome, "RS330")


def test_a_drawing_of_another_board_is_refused(tmp_path: Path) -> None:
    assert migrated("drawn", tmp_path, "--hardware", str(HERE / "drawn" / "mega.json")).code == 3


@pytest.mark.parametrize(("target", "lines"), [("uno", [4, 5, 8]), ("pico", [])])
def test_calls_of_ports_without_pins_are_told_where_the_core_does_not_check_them(
    target: str, lines: list[int], tmp_path: Path
) -> None:
    outcome = migrated("unwired", tmp_path, "--bind", "horn=none", "--bind", "bell=none", source="mega", target=target)
    assert outcome.code == 0
    assert sorted(task["location"]["line"] for task in tasks(outcome, "RS346")) == lines
    assert "255" in text(tmp_path, "unwired/unwired.ino")


@pytest.mark.parametrize(
    ("target", "expected"),
    [
        ("nano", {"SDA": ("A4", "A4"), "SCL": ("A5", "A5"), "MOSI": ("D11", "D11"), "RX": ("D0", "D0")}),
        ("mega", {"SDA": ("A4", "D20"), "SCL": ("A5", "D21"), "MOSI": ("D11", "D51"), "RX": ("D0", "D0")}),
        ("pico", {"SDA": ("A4", "GP4"), "SCL": ("A5", "GP5"), "MOSI": ("D11", "GP19"), "RX": ("D0", "USB")}),
        ("uno-r4-minima", {"SDA": ("A4", "A4"), "RX": ("D0", "USB")}),
    ],
)
def test_the_pins_of_buses_stand_in_the_report_and_those_that_move_are_checks(
    target: str, expected: dict[str, tuple[str, str]], tmp_path: Path
) -> None:
    outcome = migrated("buses", tmp_path, target=target)
    rows = re.findall(r"\| (\w+) (\w+) \|  \| (\w+) \| (\w+) \|", text(tmp_path, "buses/MIGRATION.md"))
    found = {signal: (old, new) for _, signal, old, new in rows}
    assert {signal: found[signal] for signal in expected} == expected
    checks = " ".join(item["message"] for item in outcome.result["plan"]["work"]["check"]["items"])
    for bus, signal in (("Wire", "SDA"), ("SPI", "MOSI"), ("Serial ", "RX")):
        if signal in expected:
            old, new = expected[signal]
            assert (bus in checks) == (old != new)


def test_the_old_and_the_new_wiring_stand_side_by_side(tmp_path: Path) -> None:
    migrated("buses", tmp_path / "buses")
    migrated("tabs", tmp_path / "tabs", "--bind", "LAMP=GP9")
    boards = r"\| signal \| part \| Arduino Uno \(5 V\) \| Raspberry Pi Pico \(3.3 V\) \|"
    for name, row in (("tabs", "| LAMP |  | D6 | GP9 | moves |"), ("buses", "| Wire SDA |  | A4 | GP4 | moves |")):
        report = text(tmp_path / name, f"{name}/MIGRATION.md")
        assert re.search(boards, report)
        assert row in report
        run("report", tmp_path / name, "-o", tmp_path / f"{name}.html")
        page = (tmp_path / f"{name}.html").read_text(encoding="utf-8")
        cells = row.strip("| ").replace(" |  | ", " | ").split(" | ")
        assert all(f"<td>{cell}</td>" in page for cell in cells)


def test_ports_of_a_sketch_are_not_proposed_on_pins_of_its_serial_ports(tmp_path: Path) -> None:
    outcome = migrated("serial_ports", tmp_path, source="mega")
    assert not {"GP0", "GP1"} & set(pins(outcome).values())


def test_a_converter_with_more_steps_gets_the_full_scale_of_the_old_board(tmp_path: Path) -> None:
    outcome = migrated("esp32", tmp_path, target="esp32")
    assert changed(tmp_path, "esp32") == {4: "void setup() { analogReadResolution(10);"}
    told = {task["location"]["line"]: task["message"] for task in tasks(outcome, "RS346") if "unsuitable" in task["message"]}
    assert set(told) == {1, 2}
    assert "ESP32Servo" in told[1]
    assert "FS_EspSoftwareSerial" in told[2]


def test_headers_that_nobody_has_stop_nothing(tmp_path: Path) -> None:
    outcome = migrated("libraries", tmp_path, "--bind", "D2=GP16", "--bind", "horn=GP4")
    assert outcome.code in (0, 1)
    assert changed(tmp_path, "libraries") == {3: "#define SENSOR 16"}
    assert [task["location"]["line"] for task in tasks(outcome, "RS346")] == [5]


def test_a_sketch_without_setup_is_refused_with_its_cause(tmp_path: Path) -> None:
    outcome = migrated("bad/no_setup", tmp_path)
    assert outcome.code == 3
    finding = outcome.document["findings"][0]
    assert "setup" in finding["message"]
    assert finding["location"]["path"].endswith("no_setup.ino")


def test_a_sketch_in_utf_16_becomes_one_in_utf_8(tmp_path: Path) -> None:
    assert migrated("bad/utf16", tmp_path, "--bind", "D7=GP3").code == 0
    assert "digitalWrite(3, HIGH)" in text(tmp_path, "utf16/utf16.ino")


def test_a_function_in_two_tabs_is_told_with_its_line(tmp_path: Path) -> None:
    outcome = migrated("bad/twice", tmp_path)
    told = {task["location"]["path"].rpartition("/")[2]: task["location"]["line"] for task in tasks(outcome, "RS504")}
    assert told.get("second.ino") == 1 or told.get("twice.ino") == 3


def test_assembler_stays_and_is_a_task(tmp_path: Path) -> None:
    outcome = migrated("bad/assembler", tmp_path, "--bind", "D4=GP4")
    assert 'asm volatile("nop");' in text(tmp_path, "assembler/assembler.ino")
    assert [task["location"]["line"] for task in tasks(outcome, "RS346")] == [6]


def test_a_sketch_in_a_folder_of_another_name_keeps_its_own(tmp_path: Path) -> None:
    assert migrated("bad/other_name", tmp_path).code == 0
    assert (tmp_path / "robot" / "robot.ino").is_file()


def test_an_unknown_source_board_is_refused(tmp_path: Path) -> None:
    assert migrated("tabs", tmp_path, source="umo").code == 2


def test_a_board_that_nobody_said_is_told(tmp_path: Path) -> None:
    outcome = run("migrate", HERE / "tabs" / "tabs.ino", "--target", "pico", "-o", tmp_path, "--yes", "--json")
    assert "RS115" in outcome.rules()


def test_names_that_the_new_core_lacks_and_an_error_that_it_reaches_are_tasks(tmp_path: Path) -> None:
    outcome = migrated("absent", tmp_path, source="mega")
    lacking = [task for task in tasks(outcome, "RS346") if "absent_name" in task["message"]]
    assert [task["location"]["line"] for task in lacking] == [4, 5, 6]
    assert [task["location"]["line"] for task in tasks(outcome, "RS504") if "#error" in task["message"]] == [12]


def test_an_error_that_the_board_does_not_reach_is_no_task(tmp_path: Path) -> None:
    outcome = migrated("absent", tmp_path, source="mega", target="mega")
    assert not tasks(outcome, "RS504")


def test_each_line_that_the_compiler_refuses_is_a_task(tmp_path: Path) -> None:
    outcome = migrated("refused", tmp_path)
    assert [task["location"]["line"] for task in tasks(outcome, "RS504")] == list(range(3, 15))


def test_the_eeprom_is_begun_where_setup_does_not_include_it(tmp_path: Path) -> None:
    outcome = migrated("eeprom_elsewhere", tmp_path)
    assert outcome.code == 0
    assert text(tmp_path, "eeprom_elsewhere/eeprom_elsewhere.ino").splitlines()[:4] == [
        "#include <EEPROM.h>",
        '#include "store.h"',
        "",
        "void setup() { EEPROM.begin(1024);",
    ]
    assert text(tmp_path, "eeprom_elsewhere/store.cpp").count("EEPROM.commit();") == 1
    assert not tasks(outcome, "RS504")


def test_a_library_of_another_name_than_its_header_is_told_where_it_does_not_run(tmp_path: Path) -> None:
    found = [task["location"]["line"] for task in tasks(migrated("of_header", tmp_path), "RS346")]
    assert found == [1]


def test_a_macro_in_a_file_of_its_own_follows_the_name_that_it_stands_for(tmp_path: Path) -> None:
    assert migrated("renamed_macro", tmp_path).code in (0, 1)
    assert text(tmp_path, "renamed_macro/conf.h").splitlines()[-1] == "#define SHOWN index_"
    assert "int index_ = 3;" in text(tmp_path, "renamed_macro/renamed_macro.ino")


def test_ports_that_only_a_person_names_are_bound_beside_the_proposed(tmp_path: Path) -> None:
    outcome = migrated("flash_pins", tmp_path, "--bind", "D2=GP5", "--bind", "D4=GP6")
    assert outcome.code == 0
    assert re.search(r"\b5, +// 2:.*\n.*\n +6, +// 4:", text(tmp_path, "flash_pins/moved_pins.h"))


@pytest.mark.parametrize(
    ("target", "pin", "lines"), [("pico", "GP16", [10]), ("mega", "D18", [10]), ("mega", "D2", []), ("nano", "D2", [])]
)
def test_a_number_of_an_interrupt_that_stays_is_a_task_where_its_port_has_another(
    target: str, pin: str, lines: list[int], tmp_path: Path
) -> None:
    outcome = migrated("interrupts", tmp_path, "--bind", f"D2={pin}", target=target)
    assert outcome.code in (0, 1)
    assert [task["location"]["line"] for task in tasks(outcome, "RS346")] == lines


def test_what_calls_of_a_lambda_and_its_default_arguments_give_are_ports(tmp_path: Path) -> None:
    outcome = migrated("lambdas", tmp_path, *(f"--bind=D{old}=GP{new}" for old, new in ((7, 2), (8, 3), (9, 4), (12, 5))))
    assert outcome.code in (0, 1)
    assert "out(2);\n  out(4);" in text(tmp_path, "lambdas/lambdas.ino")
    table = text(tmp_path, "lambdas/moved_pins.h")
    assert re.search(r" 3, +// 8:", table)
    assert re.search(r" 5, +// 12:", table)


def test_a_sketch_none_of_whose_ports_has_a_pin_is_not_ready(tmp_path: Path) -> None:
    outcome = migrated("flash_pins", tmp_path)
    assert outcome.result["plan"]["work"]["calls"]["waits_for_port"] == 3
    assert "Needs you: 3 calls" in text(tmp_path, "flash_pins/MIGRATION.md")


def test_a_call_made_by_a_macro_that_is_passed_to_another_changes_no_part_of_a_word(tmp_path: Path) -> None:
    migrated("passed_macro", tmp_path, "--bind", "D2=GP16", "--bind", "D3=GP14", "--bind", "D9=GP7")
    made = text(tmp_path, "passed_macro/passed_macro.ino")
    assert "void setup() { OUTS(MODE) pinMode(" in made
    assert "#define MODE(n) pinMode(port(n), OUTPUT);" in made


def test_all_names_that_are_no_ports_are_told_at_once(tmp_path: Path) -> None:
    (finding,) = migrated("tabs", tmp_path, "--bind", "horn=GP3", "--bind", "bell=GP4").document["findings"]
    assert finding["rule"] == "RS901"
    assert "'horn'" in finding["message"]
    assert "'bell'" in finding["message"]


def test_a_lambda_that_is_handed_to_a_function_is_followed_to_its_calls(tmp_path: Path) -> None:
    outcome = migrated("handed", tmp_path, "--bind=D6=GP2")
    assert outcome.code == 0
    assert {"RS326", "RS327"} & outcome.rules() == {"RS326"}
    made = text(tmp_path, "handed/handed.ino")
    assert "pinMode(port(p), OUTPUT)" in made
    assert re.search(r" 2, +// 6:", text(tmp_path, "handed/moved_pins.h"))
    assert "int16_t wide" in made


def test_all_pins_that_the_board_does_not_have_are_told_at_once(tmp_path: Path) -> None:
    outcome = migrated("handed", tmp_path, "--bind=D6=GP99", "--bind=D7=X1")
    assert outcome.code == 2
    assert "'GP99'" in outcome.err
    assert "'X1'" in outcome.err


def test_the_address_of_an_object_is_no_pin(tmp_path: Path) -> None:
    assert migrated("wire_object", tmp_path).code in (0, 1)
    assert "display(128, 64, &Wire, -1)" in text(tmp_path, "wire_object/wire_object.ino")
