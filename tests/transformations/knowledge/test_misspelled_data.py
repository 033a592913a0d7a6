"""Misspellings in a person's own data: each is an error with its place and what was meant, and nothing of it is passed over."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError
from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.knowledge.board_models import board_file
from tests.running import run

LAMP = '{"editor": "wokwi", "parts": [{"type": "wokwi-arduino-uno", "id": "uno"}, {"type": "KIND", "id": "lamp"}],\n'
LAMP += '"connections": [["uno:13", "lamp:A", "", []]]}'


def drawing(folder: Path, kind: str = "wokwi-led") -> Path:
    """A lamp on D13 of an Arduino Uno."""
    (folder / "diagram.json").write_text(LAMP.replace("KIND", kind), encoding="utf-8")
    return folder / "diagram.json"


def data(folder: Path, name: str, text: str) -> Path:
    """A file of the project's own data."""
    path = folder / ".robosmi" / "platform_repo" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("name", "text", "line", "cause"),
    [
        ("parts/electrical.toml", '# mine\n[[part]]\nkind = "lamp"\nwords = ["led"]\n', 2, r"'part' is not a table of this file"),
        ("parts/electrical.toml", '[[Device]]\nkind = "lamp"\nwords = ["led"]\n', 1, r"did you mean 'device'\?"),
        ("parts/electrical.toml", '[device]\nkind = "lamp"\nwords = ["led"]\n', 1, r"must be \[\[device\]\]"),
        ("parts/electrical.toml", '\n[[device]]\nkind = "lamp"\nwords = ["led"]\nwant = ["pwm"]\n', 3, r"did you mean 'wants'\?"),
        ("parts/electrical.toml", '[[device]]\nkind = "lamp"\nwords = ["led"]\nwants = ["PWM"]\n', 2, r"did you mean 'pwm'\?"),
        (
            "parts/electrical.toml",
            '[[device]]\nkind = "lamp"\nwords = ["led"]\nwants = ["timer"]\n',
            2,
            "use one of: digital, pwm",
        ),
        ("parts/electrical.toml", '[[device]]\nkind = "lamp"\nwords = ["led"]\noutput = "pushpull"\n', 2, "'push-pull'"),
        ("parts/electrical.toml", "[board]\nsuply_ma = []\n", None, r"did you mean 'supply_ma'\?"),
        ("parts/electrical.toml", '[names]\nsda = "sda"\n', None, "'names.sda' is not a list of texts"),
        ("parts/electric.toml", '[[device]]\nkind = "lamp"\nwords = ["led"]\n', 1, r"did you mean 'electrical.toml'\?"),
        ("parts/Electrical.toml", '[[device]]\nkind = "lamp"\nwords = ["led"]\n', 1, r"did you mean 'electrical.toml'\?"),
        ("parts/mine.toml", '[[parts]]\nids.wokwi = ["wokwi-led"]\n', 1, r"'\[\[parts\]\]' is outside every \[\[part\]\]"),
        ("parts/mine.toml", '[[part]]\nids.wokwi = ["wokwi-led"]\ntitel = "Lamp"\n', 3, r"did you mean 'title'\?"),
        ("parts/mine.toml", '[[part]]\nids.wokwi = ["wokwi-led"]\n[bus]\nA = ["A"]\n', 3, "'bus' is not a key of a part"),
        (
            "boards/mine.toml",
            '[[drawnas]]\ntool = "wokwi"\nmodules = ["wokwi-arduino-uno"]\n',
            None,
            r"did you mean 'drawn_as'\?",
        ),
        (
            "boards/uno.toml",
            '[[drawn_as]]\ntool = "wokwi"\nmodules = ["wokwi-arduino-uno"]\nconectors = {}\n',
            None,
            r"did you mean 'connectors'\?",
        ),
    ],
)
def test_a_misspelling_is_an_error_with_its_place_and_what_was_meant(
    name: str, text: str, line: int | None, cause: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = data(tmp_path, name, text)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(PlatformDataError, match=cause) as refused:
        hardware(drawing(tmp_path))
    assert refused.value.location is not None
    assert Path(refused.value.location.path).resolve() == path.resolve()
    assert refused.value.location.line == line
    assert refused.value.fix


def test_letter_case_does_not_count_in_patterns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data(
        tmp_path,
        "parts/mine.toml",
        '[[ part ]]  # a lamp\nids.wokwi = ["wokwi-led"]\ntitle = "X"\nfamily = "lamps"\nconnectors = ["A"]\n',
    )
    data(tmp_path, "parts/electrical.toml", '[[device]]\nkind = "my lamp"\nfamilies = ["LAMPS*"]\nneeds_driver = true\n')
    monkeypatch.chdir(tmp_path)
    assert any("my lamp" in finding.message for finding in hardware(drawing(tmp_path)).findings)


def test_a_wired_connector_that_the_boards_file_says_nothing_of_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    built_in = board_file("uno")
    assert built_in is not None
    text = built_in.read_text(encoding="utf-8")
    head, _, tail = text.partition('tool = "wokwi"')
    assert 'D13 = ["13"]' in tail
    data(tmp_path, "boards/uno.toml", head + 'tool = "wokwi"' + tail.replace('D13 = ["13"]', "", 1))
    monkeypatch.chdir(tmp_path)
    made = hardware(drawing(tmp_path))
    assert made.result["mappings"] == []
    found = [finding for finding in made.findings if finding.rule == "RS257"]
    assert [(f.evidence["connectors"], f.fix) for f in found] == [
        (["13"], 'add D13 = ["13"] to [drawn_as.connectors] of tool "wokwi" in boards/uno.toml')
    ]


@pytest.mark.parametrize("name", ["roles.toml", "curated.toml"])
def test_a_chip_of_a_persons_own_has_the_role_that_is_told_of_its_type(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    path = drawing(tmp_path, "chip-led-lamp")
    assert {c["role"] for c in hardware(path).result["components"]} == {"Board", "Unknown"}  # its name tells nothing
    texts = {
        "roles.toml": '[[rule]]\nrole = "Output"\nwhy = "we made it"\nids.wokwi = ["chip-led-lamp"]\n',
        "curated.toml": '[[part]]\nids.wokwi = ["chip-led-lamp"]\nrole = "Output"\nwhy = "we made it"\n',
    }
    data(tmp_path, f"parts/{name}", texts[name])
    component = next(c for c in hardware(path).result["components"] if c["title"] == "lamp")
    assert component["role"] == "Output"
    assert "we made it" in component["evidence"]


def test_a_misspelling_ends_a_command_with_three(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data(tmp_path, "parts/electrical.toml", '[[part]]\nkind = "lamp"\n')
    monkeypatch.chdir(tmp_path)
    outcome = run("hardware", drawing(tmp_path))
    assert outcome.code == 3
    assert "electrical.toml:1: " in outcome.err
