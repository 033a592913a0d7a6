"""Targets as data: tables of a project beside the built-in ones, and what is said of one that is wrong."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from jinja2 import meta

import robosmi
from robosmi import resources
from robosmi.errors import PlatformDataError, SourceError, UsageError
from robosmi.generate.templates import Templates
from robosmi.project import defaults
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from tests.running import run

PROGRAM = Path(__file__).parent / "program"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the program, from which commands are run."""
    shutil.copytree(PROGRAM, tmp_path / "project")
    monkeypatch.chdir(tmp_path / "project")
    return tmp_path / "project"


def say(project: Path, text: str) -> Path:
    """Write the project's own defaults."""
    path = project / ".robosmi" / "platform_repo" / "defaults.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def test_a_projects_targets_add_to_the_built_in_ones(project: Path) -> None:
    say(project, '[targets.my-nano]\nplatform = "arduino"\nboard = "nano"\n')
    assert target_facts("my-nano").board == "nano"
    assert target_facts("uno").board == "uno"
    assert defaults()["readers"][".c"] == "c_source"
    outcome = run("migrate", "beacon.c", "--target", "my-nano", "-o", "out")
    assert outcome.code in (0, 1), outcome.err
    assert [t.name for t in load_models(project / "out" / "models" / "plan.xmi").repository.targets] == ["my-nano"]
    assert "fqbn: arduino:avr:nano\n" in (project / "out" / "beacon" / "sketch.yaml").read_text()


def test_of_two_files_the_nearer_one_counts_key_by_key(project: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    far = tmp_path / "far" / "platform_repo"
    far.mkdir(parents=True)
    (far / "defaults.toml").write_text('[rank]\ncandidates = 3\nranker = "tfidf"\n')
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path / "far"))
    say(project, "[rank]\ncandidates = 4\n")
    assert defaults()["rank"] == {"candidates": 4, "ranker": "tfidf"}
    say(project, "[rank]\ncandidates = 55\n")
    assert defaults()["rank"]["candidates"] == 55


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ('platform = "arduino"\nboard = "uno"\ngenerator = "arduino"', "'targets.x.generator' is 'arduino', which is none of: "),
        ('platform = "arduino"\nboard = "uno"\ntoolchain = "gcc"', "'targets.x.toolchain' is 'gcc', which is none of: "),
        ('platform = "arduino"\nboard = "uno"\nstructure = "loop"', "'targets.x.structure' is 'loop', which is none of: "),
        ('platform = "arduino"\nboard = "uno"\nlanguage = "Rust"', "'targets.x.language' is 'Rust', which is none of: C, C"),
        ('platform = "arduino"\nboard = "uno"\ncompiler = "gcc"', "'targets.x.compiler' is not a key of a target"),
        ('platform = "arduino"', "'targets.x.board' is missing"),
        ('board = "uno"', "'targets.x.platform' is missing"),
        ('platform = "mars"\nboard = "uno"', "'targets.x.platform' is 'mars', an unknown platform"),
    ],
)
def test_a_wrong_target_names_its_file_and_key(project: Path, table: str, message: str) -> None:
    path = say(project, f"[targets.x]\n{table}\n")
    with pytest.raises(PlatformDataError) as caught:
        target_facts("x")
    assert message in caught.value.message
    assert caught.value.location is not None
    assert caught.value.location.path == str(path)


def test_a_table_that_is_none_is_an_error_of_its_file(project: Path) -> None:
    path = say(project, 'targets = "uno"\n')
    with pytest.raises(PlatformDataError, match="'targets' must be a table") as caught:
        defaults()
    assert caught.value.location is not None
    assert caught.value.location.path == str(path)


def test_an_unknown_target_offers_the_nearest(project: Path) -> None:
    with pytest.raises(UsageError, match=r"unknown target 'nanno' \(did you mean 'nano'\?\)"):
        target_facts("nanno")


def full_name_and_clock(target: str) -> tuple[str, int]:
    model = target_facts(target).model
    assert model.platform is not None
    assert model.board is not None
    return str(model.platform.boardMappings[0].boardId), int(model.board.clockHertz)


def test_options_of_menus_stay_in_the_full_name_and_set_the_clock(project: Path) -> None:
    options = "STMicroelectronics:stm32:Nucleo_64:pnum=NUCLEO_F401RE,opt=o3std"  # its core is not there: nothing is refused
    assert full_name_and_clock(options)[0] == options
    assert full_name_and_clock("rp2040:rp2040:rpipico:freq=133") == ("rp2040:rp2040:rpipico:freq=133", 133_000_000)
    assert full_name_and_clock("rp2040:rp2040:rpipico:")[0] == "rp2040:rp2040:rpipico"


def test_options_of_a_core_that_is_not_installed_are_not_checked_and_that_is_said(project: Path) -> None:
    said = {}
    for board in ("esp32:esp32:esp32:PSRAM=lots", "rp2040:rp2040:rpipico:freq=133", "uno"):
        outcome = run("migrate", "beacon.c", "--target", board, "-o", "out", "--yes", "--json")
        assert outcome.code == 0
        said[board] = [finding["message"] for finding in outcome.document["findings"] if finding["rule"] == "RS814"]
    assert said == {
        "esp32:esp32:esp32:PSRAM=lots": [
            "the menu options of 'esp32:esp32:esp32:PSRAM=lots' are not checked: the core 'esp32:esp32' is not installed"
        ],
        "rp2040:rp2040:rpipico:freq=133": [],
        "uno": [],
    }


def test_of_boards_with_one_name_the_one_with_most_of_the_options_is_meant() -> None:
    assert target_facts("arduino:avr:pro:cpu=8MHzatmega328").board == "pro8mhz"
    assert target_facts("arduino:avr:pro:cpu=16MHzatmega328").board == "promini"


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ("freq=134", "menu 'freq' of 'rpipico' has no option '134'"),
        ("fast=1", "has no menu 'fast'"),
        ("freq", "is not the full name of a board"),
        ("freq=125,freq=133", "has the menu 'freq' twice"),
    ],
)
def test_an_unknown_menu_or_option_is_refused_as_compile_does_it(options: str, why: str) -> None:
    with pytest.raises(UsageError, match=why):
        target_facts(f"rp2040:rp2040:rpipico:{options}")


def test_options_that_choose_another_microcontroller_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    core = tmp_path / "hardware" / "arduino" / "avr"
    core.mkdir(parents=True)
    (core / "boards.txt").write_text(
        "nano.name=Nano\nnano.menu.cpu.atmega328=new\nnano.menu.cpu.atmega328.build.mcu=atmega328p\n"
        "nano.menu.cpu.atmega168=small\nnano.menu.cpu.atmega168.build.mcu=atmega168\n"
    )
    monkeypatch.setenv("ROBOSMI_CORE", str(core))
    with pytest.raises(UsageError, match=r"choose another board than 'nano'.*build\.mcu=atmega168"):
        target_facts("arduino:avr:nano:cpu=atmega168")


def test_the_project_files_have_the_options(project: Path) -> None:
    robosmi.migrate(["beacon.c"], "out", target="arduino:avr:nano:cpu=atmega328old")
    assert "fqbn: arduino:avr:nano:cpu=atmega328old" in (project / "out" / "beacon" / "sketch.yaml").read_text()
    assert "; arduino:avr:nano:cpu=atmega328old:" in (project / "out" / "beacon" / "platformio.ini").read_text()


def test_a_pin_by_its_other_name_is_the_pin(tmp_path: Path) -> None:
    """`D5` is GP5 of a Pico: the plan says so, and stays usable."""
    source = tmp_path / "lamp.c"
    source.write_text('#include "simpletools.h"\nint main() { high(5); }\n')
    robosmi.migrate([source], tmp_path / "out", target="pico", bind={"P5": "D5"})
    plan = load_models(tmp_path / "out" / "models" / "plan.xmi").plan
    assert [binding.choice for binding in plan.portBindings] == ["GP5"]
    assert run("check", tmp_path / "out" / "models" / "plan.xmi").code == 0


def test_a_pin_table_without_a_board_means_the_targets(project: Path) -> None:
    robosmi.migrate(["beacon.c"], "out", target="arduino:avr:mega")
    plan = load_models(project / "out" / "models" / "plan.xmi").plan
    assert plan.board is not None
    assert plan.board.name == "mega"


def test_a_pin_table_of_another_board_is_named_as_what_it_is(project: Path) -> None:
    table = project / "wiring.csv"
    table.write_text(table.read_text().replace("connector\n", "connector,board\n").replace("anode\n", "anode,nano\n"))
    with pytest.raises(SourceError) as caught:
        robosmi.migrate(["beacon.c"], "out", target="uno")
    assert caught.value.message == "wiring.csv has the board 'Arduino Nano' (Arduino Nano), the target is 'uno'"
    assert caught.value.fix is not None
    assert "drawing" not in caught.value.message + caught.value.fix


@pytest.mark.parametrize(("board", "lost"), [("uno", False), ("leonardo", True)])
def test_what_tone_takes_is_the_microcontrollers(tmp_path: Path, board: str, lost: bool) -> None:
    """On D5 the Uno has the PWM of Timer0, the Leonardo that of Timer3, which tone() takes there."""
    made = robosmi.migrate([PROGRAM.parent / "speaker" / "beacon.c"], tmp_path / "out", target=board)
    said = [f.message for f in made.findings if f.rule == "RS264"]
    assert any("Timer3" in message and "tone()" in message for message in said) == lost, said


@pytest.mark.parametrize("word", ["migrate", "analyse", "recommend", "hardware", "check"])
def test_the_data_beside_the_first_file_count_wherever_a_command_is_run(
    word: str, project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    say(project, "[rank]\ncandidates = many\n")  # damaged, so that whoever reads it says so
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    file = project / ("wiring.csv" if word in ("recommend", "hardware", "check") else "beacon.c")
    options: list[str | Path] = ["-o", tmp_path / "out"] if word == "migrate" else []
    outcome = run(word, file, *options)
    assert outcome.code == 3
    assert str(project / ".robosmi") in outcome.err


def test_the_data_of_the_current_folder_count_where_the_program_has_none(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    say(tmp_path / "elsewhere", '[targets.my-nano]\nplatform = "arduino"\nboard = "nano"\n')
    outcome = run("migrate", project / "beacon.c", "--target", "my-nano", "--dry-run", "-o", tmp_path / "out")
    assert outcome.code in (0, 1), outcome.err
    say(project, '[targets.my-mega]\nplatform = "arduino"\nboard = "mega"\n')
    outcome = run("migrate", project / "beacon.c", "--target", "my-nano", "--dry-run", "-o", tmp_path / "out")
    assert outcome.code == 2
    outcome = run("migrate", project / "beacon.c", "--target", "my-mega", "--dry-run", "-o", tmp_path / "out")
    assert outcome.code in (0, 1), outcome.err


@pytest.mark.parametrize("name", ["sketch.ino.j2", "sketch.yaml.j2", "adapters.h.j2", "own_header.h.j2"])
def test_the_page_names_the_values_that_the_sketchs_templates_use(name: str) -> None:
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "add-a-target.md").read_text(encoding="utf-8")
    named = {word for row in re.findall(r"^\| (`[^|]+`) \|", page, re.MULTILINE) for word in re.findall(r"`(\w+)", row)}
    template = (resources.built_in("templates") / "arduino" / name).read_text(encoding="utf-8")
    used = meta.find_undeclared_variables(Templates()._environment.parse(template))
    assert used
    assert used <= named | {"annotations"}
