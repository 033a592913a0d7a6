"""Headers of a platform become its API: what is declared where and as what, what is left out and why."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.platform_headers import ApiFound, read_headers

BOARD = Path(__file__).parent / "board"


@pytest.fixture(scope="module")
def found() -> ApiFound:
    """The board's headers, read."""
    return read_headers(BOARD, ApiIndex.load("generic"))


def test_headers_are_named_as_they_are_included(found: ApiFound) -> None:
    assert set(found.headers) == {"board.h", "bus/wire.h", "motor.h", "servo.hpp"}
    assert found.headers["board.h"]["includes"] == ["stdint.h", "bus/wire.h"]
    assert found.headers["bus/wire.h"]["includes"] == ["board.h", "vendor/secret.h"]
    assert found.missing == ["vendor/secret.h"]


def test_functions_have_the_signatures_of_the_text(found: ApiFound) -> None:
    assert found.headers["board.h"]["functions"] == {
        "board_each": ["void", "(void (*visit)(int pin, int level))"],
        "board_elapsed": ["uint32_t", "(uint32_t since)"],
        "board_init": ["void", "(void)"],
        "board_micros": ["unsigned long long", "()"],
        "board_on_edge": ["handler_t", "(int pin, handler_t handler)"],
        "board_read": ["int", "(int pin)"],
        "board_text": ["char *", "(channel_t *from, char text[], const char *format, ...)"],
        "board_write": ["void", "(int pin, int level)"],
    }, "what BOARD_REVISION_2 alone has is left out"
    assert found.headers["bus/wire.h"]["functions"]["wire_open"] == ["wire_t", "(int sda, int scl, wire_mode mode)"]


def test_macros_variables_constants_types_and_registers(found: ApiFound) -> None:
    board = found.headers["board.h"]
    assert {name for name, like in board["macros"].items() if like} == {"ticks_of"}
    assert {"BOARD_LED", "BOARD_CLOCK", "BOARD_H", "OUT", "PORT_OUT", "INLINE", "BOARD_PINS"} <= set(board["macros"])
    assert board["vars"] == {
        "TIMER": "volatile unsigned int",
        "board_name": "const char[]",
        "board_ticks": "volatile uint32_t",
    }
    assert board["consts"] == ["LEVEL_HIGH", "LEVEL_LOW", "MODE_IN", "MODE_OUT"]
    assert board["types"] == {
        "channel": "struct", "channel_t": "typedef", "handler_t": "typedef", "level": "enum", "pin_mode_t": "typedef",
    }  # fmt: skip
    assert board["registers"] == ["OUT", "PORT_OUT", "TIMER"], "a shared variable is volatile too, and no register"


def test_a_default_belongs_to_each_header_that_gives_it(found: ApiFound) -> None:
    assert "BOARD_PINS" in found.headers["board.h"]["macros"]
    assert "BOARD_PINS" in found.headers["bus/wire.h"]["macros"]


def test_classes_and_namespaces(found: ApiFound) -> None:
    servo = found.headers["servo.hpp"]
    assert servo["types"] == {"drivers::Servo": "class", "drivers::Side": "enum"}
    assert servo["functions"] == {
        "drivers::Servo::Servo": ["", "(int pin)"],
        "drivers::Servo::read": ["int", "()"],
        "drivers::Servo::write": ["void", "(int angle)"],
        "drivers::center": ["void", "(Servo &servo)"],
    }


def test_what_is_left_out_is_named_with_the_reason(found: ApiFound) -> None:
    skipped = {str(Path(path).relative_to(BOARD)): why for path, why in found.skipped.items()}
    assert set(skipped) == {"drivers/binary.h", "drivers/motor/motor.h", "html/board.h"}
    assert "binary" in skipped["drivers/binary.h"]
    assert "motor_damaged" in skipped["drivers/motor/motor.h"]
    assert "another header has the same name" in skipped["html/board.h"]
    assert set(found.headers["motor.h"]["functions"]) == {"motor_speed", "motor_stop"}


def test_links_and_closed_folders_do_not_matter(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "a.h").write_text("int a(void);\n")
    (tmp_path / "a" / "ring").symlink_to(tmp_path)
    (tmp_path / "a" / "gone.h").symlink_to(tmp_path / "nowhere.h")
    (tmp_path / "self.h").symlink_to(tmp_path / "self.h")
    read = read_headers(tmp_path, ApiIndex.load("generic"))
    assert set(read.headers) == {"a.h"}
    assert {Path(path).name for path in read.skipped} == {"gone.h", "self.h"}


def test_a_folder_without_headers_is_refused(tmp_path: Path) -> None:
    for folder in (tmp_path, tmp_path / "none"):
        with pytest.raises(SourceError) as caught:
            read_headers(folder, ApiIndex.load("generic"))
        assert caught.value.fix
