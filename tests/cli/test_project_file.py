"""`robosmi.toml`: what it may say, and what it may not."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.running import run, tree


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[migrate\n", "line 1"),
        ("[migrat]\n", "'migrat' is no table (did you mean 'migrate'?)"),
        ("target = 'mega'\n[bind]\n", "write [migrate] above the line with 'target'"),
        ('[migrate]\ntarge = "uno"\n', "'targe' is no key in [migrate] (did you mean 'target'?)"),
        ("[migrate]\ntarget = 3\n", ":2: [migrate] must hold texts only, and 'target' is none"),
        ('migrate = "uno"\n', "[migrate] must hold texts only"),
        ('[severity]\nRS310 = "eror"\n', "RS310 = 'eror' is no level (did you mean 'error'?)"),
        ('[[accept]]\nrule = "RS310"\n', "[[accept]] needs the texts rule, element and reason"),
        ("accept = 5\n", "'accept' must be a list of tables"),
        ("accept = nan\n", "'accept' must be a list of tables"),
        (f"accept = {'9' * 10_000}\n", "a number in it has more than 4300 digits"),
        ("accept = " + "[" * 50_000, "nested too deeply"),
        ('[libraries]\n"Basic Servo1" = ["Servo"]\n', "[libraries] must hold texts only"),
    ],
)
@pytest.mark.parametrize("command", ["analyse", "migrate"])
def test_a_wrong_project_file_is_refused(command: str, text: str, said: str, line_follower: Path, tmp_path: Path) -> None:
    project = line_follower.parent / "robosmi.toml"
    project.write_text(text)
    before = tree(tmp_path)
    outcome = run(command, line_follower, "-o", tmp_path / "out")
    assert outcome.code == 3
    assert str(project) in outcome.err
    assert said in outcome.err
    assert "\n  do: " in outcome.err
    assert tree(tmp_path) == before


def test_a_project_file_in_another_encoding_is_refused(line_follower: Path) -> None:
    (line_follower.parent / "robosmi.toml").write_bytes("# gr\xfc\xdfe\n".encode("latin-1"))
    assert run("analyse", line_follower).code == 3


@pytest.mark.parametrize(
    ("text", "code", "cause"),
    [
        ('[roles]\n"Basic Servo1" = "Actuator"\n', 2, "Actuator"),
        ('[roles]\n"Basic Servo9" = "Output"\n', 2, "did you mean 'Basic Servo"),
        ('[migrate]\nhardware = "nowhere.fzz"\n', 3, "nowhere.fzz"),
        ('[migrate]\nhardware = "line_following_robot.fzz"\n[bind]\nleftEye = "D2"\n', 2, "'leftEye' is no port"),
        (
            '[migrate]\nhardware = "line_following_robot.fzz"\n[libraries]\n"Basic Servo1" = "Sevro"\n',
            2,
            "unknown library 'Sevro'",
        ),
    ],
)
def test_a_project_file_that_names_what_is_not_there_is_refused(
    text: str, code: int, cause: str, line_follower: Path, tmp_path: Path
) -> None:
    if "hardware" not in text:
        text = '[migrate]\nhardware = "line_following_robot.fzz"\n' + text
    (line_follower.parent / "robosmi.toml").write_text(text)
    outcome = run("migrate", line_follower, "-o", tmp_path / "out")
    assert outcome.code == code
    assert cause in outcome.err
    assert "robosmi.toml" in outcome.err or "nowhere.fzz" in text
    assert not (tmp_path / "out").exists()


def test_choices_for_one_of_several_programs_in_a_folder_are_told_with_their_line(tmp_path: Path) -> None:
    text = '#include "simpletools.h"\nint {0} = 3;\nint main() {{ while (1) {{ high({0}); pause(5); }} }}\n'
    for name in ("lamp", "horn"):
        (tmp_path / f"{name}.c").write_text(text.format(name))
    assert run("migrate", tmp_path / "lamp.c", "-o", tmp_path / "one").code in (0, 1)
    assert run("choose", tmp_path / "one", "lamp=D4").code in (0, 1)
    project = tmp_path / "robosmi.toml"
    outcome = run("migrate", tmp_path / "horn.c", "-o", tmp_path / "two")
    assert outcome.code == 2
    line = project.read_text().splitlines().index('lamp = "D4"') + 1
    assert f"{project}:{line}: 'lamp' is no port of the program" in outcome.err
    assert "give each program its own folder" in outcome.err
    assert "its ports are: horn" in outcome.err
    outcome = run("migrate", tmp_path / "lamp.c", "-o", tmp_path / "two", "--bind", "lamb=D4")
    assert outcome.code == 2
    assert "robosmi.toml" not in outcome.err


@pytest.mark.parametrize(
    ("entry", "cause"),
    [
        ('[bind]\nleftQTI = "D99"\n', "'D99' is neither a pin"),
        ('[bind]\nleftQTI = "D9"\nP6 = "D8"\n', "is bound to two pins"),
        ('[libraries]\n"Basic Servo1" = "Sevro"\n', "unknown library 'Sevro'"),
        ('[libraries]\n"Basic Servo9" = "Servo"\n', "no component is called 'Basic Servo9'"),
    ],
)
def test_a_choice_of_the_project_file_that_cannot_be_is_told_with_its_line(
    entry: str, cause: str, line_follower: Path, tmp_path: Path
) -> None:
    text = f'[migrate]\nhardware = "line_following_robot.fzz"\n{entry}'
    project = line_follower.parent / "robosmi.toml"
    project.write_text(text)
    outcome = run("migrate", line_follower, "-o", tmp_path / "out")
    assert outcome.code == 2
    assert cause in outcome.err
    assert f"{project}:{text.count(chr(10))}: " in outcome.err


def add(source: Path, text: str) -> None:
    """Add to the project file beside a source."""
    with (source.parent / "robosmi.toml").open("a") as file:
        file.write(text)


@pytest.mark.parametrize(("level", "code", "severity"), [("error", 1, "error"), ("warning", 0, "warning")])
def test_a_severity_of_the_project_file_counts(level: str, code: int, severity: str, line_follower: Path, tmp_path: Path) -> None:
    add(line_follower, f'\n[severity]\nRS250 = "{level}"\n')
    outcome = run("migrate", line_follower, "-o", tmp_path / "out", "--json")
    assert outcome.code == code
    assert [f["severity"] for f in outcome.document["findings"] if f["rule"] == "RS250"] == [severity]


def test_a_rule_may_be_switched_off(line_follower: Path, tmp_path: Path) -> None:
    add(line_follower, '\n[severity]\nRS310 = "off"\n')
    assert "RS310" not in run("migrate", line_follower, "-o", tmp_path / "out", "--json").rules()


def test_an_accepted_finding_stays_listed_with_its_reason(cases: Path, tmp_path: Path) -> None:
    source = tmp_path / "syntax.c"
    source.write_bytes((cases / "syntax.c").read_bytes())
    assert run("analyse", source).code == 1
    add(source, '\n[[accept]]\nrule = "RS101"\nelement = "*"\nreason = "a known fault"\n')
    outcome = run("analyse", source, "--json")
    assert outcome.code == 0
    accepted = [f for f in outcome.document["findings"] if f["rule"] == "RS101"]
    assert accepted
    assert all(f["severity"] == "info" and f["evidence"]["accepted"] == "a known fault" for f in accepted)


def test_a_pin_table_without_a_board_is_of_the_target_that_the_project_file_names(tmp_path: Path) -> None:
    (tmp_path / "wiring.csv").write_text("pin,part\nD9,Red LED\n")
    assert run("hardware", tmp_path / "wiring.csv", "--json").result["boards"][0]["title"] == "Arduino Uno"
    (tmp_path / "robosmi.toml").write_text('[migrate]\ntarget = "leonardo"\n')
    assert run("hardware", tmp_path / "wiring.csv", "--json").result["boards"][0]["title"] == "Arduino Leonardo"
