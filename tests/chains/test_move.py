"""`migrate OUT --target NAME -o NEW`: a plan for one board made again for another, without deciding twice."""

from __future__ import annotations

import csv
import io
import re
import shutil
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from robosmi.cli.commands.migrate import ask_pins
from robosmi.errors import StoppedError
from robosmi.transformations.chains.move import migrate_or_move
from robosmi.transformations.chains.stages.models import stored_models
from tests.running import run

MOVES, ROOT = Path(__file__).parent / "moves", Path(__file__).parents[2]


def case(name: str, examples: Path, folder: Path) -> Path:
    """The output folder of a case study for the Uno; the program is in `folder/input`."""
    shutil.copytree(examples / name, folder / "input")
    assert run("migrate", folder / "input" / f"{name}.c", "-o", folder / "uno").code == 0
    return folder / "uno"


@pytest.fixture(scope="module")
def uno(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An output folder for the Uno, which no test changes; nothing is known of where its sources were."""
    return case("line_follower", ROOT / "docs" / "examples", tmp_path_factory.mktemp("uno"))


@pytest.fixture
def own(uno: Path, tmp_path: Path) -> Path:
    """A copy of it, which a test may change."""
    return shutil.copytree(uno, tmp_path / "own")


def files_in(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def move(out: Path, new: Path, *words: str | Path, target: str = "pico", code: int = 0) -> Any:
    """The result of a move, which leaves the former folder as it is."""
    before = files_in(out)
    done = run("migrate", out, "--target", target, "-o", new, *words, "--json")
    assert done.code == code, done.err
    assert files_in(out) == before
    return done.document


def pins(new: Path) -> dict[str, str]:
    """Port -> pin of a plan."""
    plan = stored_models(new).plan
    return {str(b.name): str(b.connection.pin.label) for b in plan.portBindings if b.connection and b.connection.pin}


def changes(document: Any) -> dict[str, Any]:
    return {change["subject"]: change for change in document["result"]["moved"]["changes"]}


def test_choices_follow_their_parts_to_the_pins_of_the_new_drawing(uno: Path, tmp_path: Path) -> None:
    document = move(uno, tmp_path / "pico", "--hardware", MOVES / "line_follower_pico.csv")
    bound = {"leftQTI": "GP27", "rightQTI": "GP26", "abdrive.left_servo": "GP3", "abdrive.right_servo": "GP2", "LED": "GP15"}
    assert pins(tmp_path / "pico") == bound
    moved = document["result"]["moved"]
    assert (moved["from"], moved["to"], moved["open"], moved["lost"], moved["pins_proposed"]) == ("uno", "pico", 0, 0, False)
    kinds = {name: change["kind"] for name, change in changes(document).items()}
    assert kinds["leftQTI"] == kinds["abdrive.left_servo"] == kinds["Basic Servo1"] == "kept"
    assert kinds["LED"] == "proposed"
    assert moved["kept"] == 6
    assert changes(document)["leftQTI"]["before"].startswith("D10 ")
    assert changes(document)["leftQTI"]["after"].startswith("GP27 ")
    report = (tmp_path / "pico" / "line_follower" / "MIGRATION.md").read_text()
    assert "| leftQTI | D10 (HIH4030 2) | GP27 (HIH4030 2) | kept |" in report
    page = tmp_path / "page.html"
    assert run("report", tmp_path / "pico", "-o", page).code == 0
    assert "<td>D10 (HIH4030 2)</td><td>GP27 (HIH4030 2)</td>" in page.read_text()


@pytest.mark.parametrize("study", ["line_follower", "environmental_monitoring"])
def test_without_a_drawing_pins_are_proposed_and_wait_for_approval(study: str, uno: Path, examples: Path, tmp_path: Path) -> None:
    out, new = uno if study == "line_follower" else case(study, examples, tmp_path), tmp_path / "pico"
    harmed = {"line_follower": {"GP10", "GP11"}, "environmental_monitoring": set()}[study]
    document = move(out, new, code=int(bool(harmed)))
    assert borne_too_little(document) == harmed
    moved = document["result"]["moved"]
    assert moved["pins_proposed"]
    assert moved["open"] == moved["lost"] == 0
    assert "RS348" in {finding["rule"] for finding in document["findings"]}
    table = new / "models" / "source" / f"{study}_pico.csv"
    before, after = pins(out), pins(new)
    assert before.keys() == after.keys()
    assert len(set(after.values())) == len(set(before.values()))
    assert all(pin in table.read_text() for pin in after.values())
    # a person gives the table back as the drawing: that is the approval
    approved = move(out, new, "--hardware", table, code=int(bool(harmed)))
    assert borne_too_little(approved) == harmed
    assert not approved["result"]["moved"]["pins_proposed"]
    assert "RS348" not in {finding["rule"] for finding in approved["findings"]}
    assert pins(new) == after


def borne_too_little(document: Any) -> set[str]:
    """The pins that get a higher voltage than they bear (RS258), with the advice about resistors."""
    found = [finding for finding in document["findings"] if finding["rule"] == "RS258"]
    assert all("kilo-ohms" in finding["fix"] and finding["severity"] == "error" for finding in found)
    return {pin for finding in found for pin in re.findall(r"to (\w+), which bears", finding["message"])}


def test_a_proposal_feeds_a_sensor_so_that_its_output_harms_no_pin_or_says_that_it_does(tmp_path: Path) -> None:
    """A DHT22 works with 3.3 V; the two rangers need 5 V, and one of them has a resistor at its echo."""
    (tmp_path / "ping.c").write_text(
        '#include "simpletools.h"\nint main() { high(3); print("%d", input(4) + input(5) + input(6)); }\n'
    )
    rows = (
        "D3,HC-SR04,eye,Trig,,5", "D4,HC-SR04,eye,Echo,,5", "D5,HC-SR04,ear,Echo,R1,5",
        "D6,DHT22,air,Data,,5", "D7,Basic Servo,arm,pulse,,5", "D8,Pushbutton,bell,1,,5",
    )  # fmt: skip
    (tmp_path / "uno.csv").write_text("\n".join(("pin,part,title,connector,through,volts", *rows)))
    uno = tmp_path / "uno"
    assert run("migrate", tmp_path / "ping.c", "--hardware", tmp_path / "uno.csv", "--target", "uno", "-o", uno).code == 0
    document = move(uno, tmp_path / "pico", code=1)
    assert borne_too_little(document) == {"GP4", "GP8"}
    table = (tmp_path / "pico" / "models" / "source" / "ping_pico.csv").read_text()
    fed = {row["title"]: row["volts"] for row in csv.DictReader(io.StringIO(table))}
    assert fed == {"eye": "5", "ear": "5", "air": "3.3", "arm": "5", "bell": "5"}


def test_a_person_approves_the_pins_at_a_terminal_or_nothing_is_written(uno: Path, tmp_path: Path) -> None:
    new = tmp_path / "pico"
    with pytest.raises(StoppedError):
        migrate_or_move([uno], new, target="pico", ask_pins=lambda rows: False)
    assert not new.exists()
    seen: list[Mapping[str, str]] = []

    def agrees(rows: Sequence[Mapping[str, str]]) -> bool:
        seen.extend(rows)
        return True

    made = migrate_or_move([uno], new, target="pico", ask_pins=agrees)
    assert {row["ports"] for row in seen} >= {"leftQTI", "rightQTI"}
    assert not made.result()["moved"]["pins_proposed"]


@pytest.mark.parametrize(("answer", "approved"), [("y", True), ("", False), ("no", False)])
def test_the_proposed_pins_are_shown_before_the_question(answer: str, approved: bool) -> None:
    rows, out = [{"before": "D10", "pin": "GP27", "name": "HIH40302ReadP1", "ports": "leftQTI"}], io.StringIO()
    assert ask_pins(rows, answer=lambda _: answer, out=out) is approved
    assert all(text in out.getvalue() for text in ("D10", "GP27", "leftQTI"))


def test_from_uno_to_mega_a_label_is_no_pin_of_the_new_drawing(uno: Path, tmp_path: Path) -> None:
    """[bind] has leftQTI on D10; on the new board an LED is there, and the sensor is what was meant."""
    move(uno, tmp_path / "mega", "--hardware", MOVES / "line_follower_mega.csv", target="mega")
    found = pins(tmp_path / "mega")
    assert (found["leftQTI"], found["rightQTI"], found["LED"]) == ("D25", "D24", "D10")


def test_from_uno_to_mega_pins_of_one_name_are_proposed(uno: Path, tmp_path: Path) -> None:
    move(uno, tmp_path / "mega", target="mega")
    assert pins(tmp_path / "mega") == pins(uno)


def test_a_choice_for_a_part_that_is_not_drawn_any_more_is_lost_and_open(uno: Path, tmp_path: Path) -> None:
    document = move(uno, tmp_path / "pico", "--hardware", MOVES / "one_servo_pico.csv")
    change = changes(document)["abdrive.left_servo"]
    assert (change["kind"], change["after"]) == ("lost", "")
    assert "Basic Servo2" in change["why"]
    assert changes(document)["Basic Servo2"]["kind"] == "lost"
    assert document["result"]["moved"]["open"] == 1
    assert document["result"]["moved"]["lost"] == 2
    assert "abdrive.left_servo" not in pins(tmp_path / "pico")


def test_a_library_that_cannot_work_on_the_new_board_is_not_kept(uno: Path, tmp_path: Path) -> None:
    document = move(uno, tmp_path / "esp32", "--hardware", MOVES / "line_follower_esp32.csv", target="esp32")
    change = changes(document)["Basic Servo1"]
    assert change["kind"] == "lost"
    assert "ESP32Servo" in change["why"]
    chosen = {c["component"]: c["library"] for c in document["result"]["plan"]["libraries"]}
    assert chosen["Basic Servo1"] != "Servo"


def test_a_table_of_the_target_goes_before_bind(own: Path, tmp_path: Path) -> None:
    (own / "robosmi.toml").write_text(
        '[bind]\nleftQTI = "D10"\nLED = "HIH40301ReadP1"\n[bind.pico]\nleftQTI = "GP26"\nrightQTI = "GP27"\nLED = "GP15"\n'
        '[bind.esp32]\nLED = "IO4"\n[bind.mega.abdrive]\nleft_servo = "none"\n'
    )
    document = move(own, tmp_path / "pico", "--hardware", MOVES / "line_follower_pico.csv")
    assert (pins(tmp_path / "pico")["leftQTI"], pins(tmp_path / "pico")["LED"]) == ("GP26", "GP15")
    assert changes(document)["leftQTI"]["kind"] == "decided"
    assert changes(document)["abdrive.left_servo"]["kind"] == "kept"


def test_a_pin_in_bind_that_is_not_in_the_plan_does_not_become_one_of_the_new_board(own: Path, tmp_path: Path) -> None:
    """D5 was written for the Uno, and the Pico takes it for GP5; nobody has said that this is meant."""
    (own / "robosmi.toml").write_text('[bind]\nLED = "D5"\n')
    document = move(own, tmp_path / "pico", "--hardware", MOVES / "line_follower_pico.csv")
    assert pins(tmp_path / "pico")["LED"] == "GP15"
    change = changes(document)["LED"]
    assert change["kind"] == "lost"
    assert "[bind.pico]" in change["why"]


def test_a_wrong_pin_of_the_targets_table_is_told_with_its_line(own: Path, tmp_path: Path) -> None:
    (own / "robosmi.toml").write_text('[bind]\nLED = "none"\n\n[bind.pico]\nleftQTI = "D77"\n')
    document = move(own, tmp_path / "pico", "--hardware", MOVES / "line_follower_pico.csv", code=2)
    place = document["findings"][0]["location"]
    assert (place["path"], place["line"]) == (str(own / "robosmi.toml"), 5)


def test_what_is_decided_on_the_new_board_is_kept_there_and_for_it_alone(examples: Path, tmp_path: Path) -> None:
    out, new, drawing = case("line_follower", examples, tmp_path), tmp_path / "pico", MOVES / "one_servo_pico.csv"
    move(out, new, "--hardware", drawing)
    assert run("choose", new, "abdrive.left_servo=GP5").code == 0
    told = {str(c.subject): (c.kind.name, str(c.after)) for c in stored_models(new).plan.move.changes}  # type: ignore[union-attr]
    assert told["abdrive.left_servo"] == ("decided", "GP5")
    project = tomllib.loads((tmp_path / "input" / "robosmi.toml").read_text())["bind"]
    assert project["pico"] == {"abdrive.left_servo": "GP5"}
    assert project["P12"] == "BasicServo2WriteP1"
    document = move(out, new, "--hardware", drawing)
    assert changes(document)["abdrive.left_servo"]["after"] == "GP5"
    assert document["result"]["moved"]["open"] == 0


def test_a_plan_of_another_version_of_the_tool_is_moved(own: Path, tmp_path: Path) -> None:
    plan = own / "models" / "plan.xmi"
    plan.write_text(re.sub('toolVersion="[^"]*"', 'toolVersion="0.0.1"', plan.read_text()))
    assert move(own, tmp_path / "pico", code=1)["result"]["moved"]["from"] == "uno"


@pytest.mark.parametrize("where", ["same", "inside", "around"])
def test_the_new_folder_is_neither_the_former_one_nor_in_it(where: str, uno: Path) -> None:
    new = {"same": uno, "inside": uno / "pico", "around": uno.parent}[where]
    before = files_in(uno)
    done = run("migrate", uno, "--target", "pico", "-o", new, "--json")
    assert done.code == 2
    assert files_in(uno) == before
    assert str(new) in done.document["findings"][0]["message"]


def test_a_move_needs_a_board(uno: Path, tmp_path: Path) -> None:
    done = run("migrate", uno, "-o", tmp_path / "new", "--json")
    assert done.code == 2
    assert "--target" in done.document["findings"][0]["fix"]
    assert not (tmp_path / "new").exists()


def test_a_folder_that_is_no_output_is_refused(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    done = run("migrate", tmp_path / "empty", "--target", "pico", "-o", tmp_path / "new", "--json")
    assert done.code == 3
    assert "output folder" in done.document["findings"][0]["fix"]
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("damage", ["digest", "newer", "torn"])
def test_a_damaged_folder_is_refused_with_its_cause(damage: str, own: Path, tmp_path: Path) -> None:
    plan = own / "models" / "plan.xmi"
    if damage == "digest":
        (own / "models" / "source" / "line_follower.c").write_text("int main(void) { return 0; }\n")
    elif damage == "newer":
        plan.write_text(plan.read_text().replace("http://robosmi.org/migration/2", "http://robosmi.org/migration/99"))
    else:
        plan.write_text(plan.read_text()[:900])
    document = move(own, tmp_path / "pico", code=3)
    assert document["findings"][0]["location"]["path"].startswith(str(own))
    assert document["findings"][0]["fix"]
    assert not (tmp_path / "pico").exists()


def test_a_board_with_too_few_pins_is_refused(uno: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "data" / "platform_repo" / "arduino" / "boards"
    folder.mkdir(parents=True)
    shutil.copy(MOVES / "tiny.toml", folder)
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path / "data"))
    document = move(uno, tmp_path / "new", target="tiny", code=3)
    assert "1 free pin" in document["findings"][0]["message"]
