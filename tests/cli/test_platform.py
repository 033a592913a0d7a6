"""`platform import` and what commands do with a platform of the user's own, or with one that nobody knows."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.running import run

BOARD = Path(__file__).parents[1] / "transformations" / "t2m" / "platform_headers" / "board"
BLINK = BOARD / "programs" / "blink.c"


@pytest.fixture(autouse=True)
def _own_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))


def test_an_imported_platform_is_known_by_its_name(tmp_path: Path) -> None:
    outcome = run("platform", "import", BOARD, "--name", "board", "--json")
    assert outcome.code == 0
    result = outcome.result
    assert {"platform", "added", "skipped", "missing", "written"} <= set(result)
    assert [row["header"] for row in result["added"]] == ["board.h", "bus/wire.h", "motor.h", "servo.hpp"]
    assert all(Path(path).is_file() and tmp_path in Path(path).parents for path in result["written"])
    assert {entry["kind"] for entry in outcome.document["artifacts"]} == {"platform"}
    assert outcome.rules() == {"RS110", "RS111"}
    unit = run("analyse", BLINK, "--source-platform", "board", "--json").result["units"][0]
    calls = {call["name"]: (call["header"], call["signature"], call["signature_source"]) for call in unit["platform_calls"]}
    assert calls == {
        "board_init": ("board.h", "void board_init(void)", "repository"),
        "board_write": ("board.h", "void board_write(int pin, int level)", "repository"),
        "motor_speed": ("motor.h", "void motor_speed(motor_id which, int percent)", "repository"),
        "ticks_of": ("board.h", "ticks_of(...)", "repository"),
        "wire_open": ("bus/wire.h", "wire_t wire_open(int sda, int scl, wire_mode mode)", "repository"),
    }
    assert [call["name"] for call in unit["unknown_calls"]] == ["mystery"]
    assert {(s["name"], s["kind"]) for s in unit["platform_symbols"]} == {
        ("BOARD_LED", "macro"), ("LEVEL_HIGH", "constant"), ("OUT", "register"), ("TIMER", "register"),
    }  # fmt: skip
    assert {t["name"] for t in unit["platform_types"]} == {"wire_t", "channel_t"}
    assert {(i["name"], i["kind"]) for i in unit["includes"]} == {("board.h", "platform"), ("motor.h", "platform")}
    assert unit["coverage"]["unresolved"] == []


def test_an_imported_platform_can_be_migrated_from(tmp_path: Path) -> None:
    assert run("platform", "import", BOARD, "--name", "board").code == 0
    outcome = run("migrate", BLINK, "--source-platform", "board", "-o", tmp_path / "out", "--yes", "--json")
    assert outcome.code in (0, 1)
    assert (tmp_path / "out" / "blink" / "blink.ino").is_file()


def test_a_platform_nobody_knows_still_works() -> None:
    outcome = run("analyse", BLINK, "--source-platform", "generic", "--json")
    assert outcome.code == 0
    unit = outcome.result["units"][0]
    signatures = {call["name"]: call["signature"] for call in unit["unknown_calls"]}
    assert signatures["board_write"] == "void board_write(int, int)"
    assert set(signatures) == {"board_init", "board_write", "motor_speed", "mystery", "ticks_of", "wire_open"}
    assert unit["coverage"]["unresolved"] == []


def test_a_second_import_adds_and_keeps_the_settings(tmp_path: Path) -> None:
    assert run("platform", "import", BOARD / "include", "--name", "board", "-D", "BOARD_REVISION_2").code == 0
    settings = tmp_path / "home" / "platform_repo" / "board" / "platform.toml"
    settings.write_text(settings.read_text().replace("int_bits = 32", "int_bits = 16"))
    outcome = run("platform", "import", BOARD / "drivers", "--name", "board", "--json")
    assert outcome.result["known"] == 4
    assert [Path(path).name for path in outcome.result["written"]] == ["api.json"]
    assert "int_bits = 16" in settings.read_text()
    assert 'defines = ["BOARD_REVISION_2"]' in settings.read_text()
    headers = json.loads((settings.parent / "api.json").read_text())["headers"]
    assert "board_second_revision" in headers["board.h"]["functions"]


def test_what_a_known_platform_means_is_taken_over(tmp_path: Path) -> None:
    (tmp_path / "headers").mkdir()
    (tmp_path / "headers" / "simpletools.h").write_text("void high(int pin);\nvoid pulse(int pin, int time);\n")
    (tmp_path / "p.c").write_text('#include "simpletools.h"\nint main() { high(5); pulse(6, 1); cogstart(0, 0, 0, 0); }\n')
    assert run("platform", "import", tmp_path / "headers", "--name", "mine", "--like", "propeller").code == 0
    unit = run("analyse", tmp_path / "p.c", "--source-platform", "mine", "--json").result["units"][0]
    assert [(use["function"], use["pin"]) for use in unit["pin_uses"]] == [("high", 5)]
    assert [call["name"] for call in unit["platform_calls"]] == ["high", "pulse"]
    assert [call["name"] for call in unit["unknown_calls"]] == ["cogstart"]


@pytest.mark.parametrize(
    ("words", "code", "cause"),
    [
        (["--name", "propeller"], 2, "a built-in platform"),
        (["--name", "parts"], 2, "a built-in platform"),
        (["--name", "../x"], 2, "not a valid platform name"),
        (["--name", ""], 2, "not a valid platform name"),
        (["--name", "x", "--like", "propellor"], 2, "did you mean 'propeller'?"),
        ([], 2, "--name"),
    ],
)
def test_wrong_usage(words: list[str], code: int, cause: str) -> None:
    outcome = run("platform", "import", BOARD, *words)
    assert outcome.code == code
    assert cause in outcome.err
    assert "\n  do: " in outcome.err


def test_no_headers_and_damaged_data(tmp_path: Path) -> None:
    assert run("platform", "import", tmp_path / "none", "--name", "x").code == 3
    assert run("platform", "import", BOARD, "--name", "x").code == 0
    folder = tmp_path / "home" / "platform_repo" / "x"
    settings = (folder / "platform.toml").read_text()
    (folder / "platform.toml").write_text(settings.replace('like = "generic"', 'like = "x"'))
    outcome = run("platform", "import", BOARD / "include", "--name", "x")
    assert outcome.code == 3
    assert "builds on itself" in outcome.err
    (folder / "platform.toml").write_text(settings)
    (folder / "api.json").write_text("[")
    assert "damaged" in run("platform", "import", BOARD, "--name", "x", "--like", "generic").err
