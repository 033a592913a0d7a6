"""Programs that get on boards: through the real tool to stand-ins for boot loaders, and what is said where they do not."""

from __future__ import annotations

import itertools
import json
import os
import re
import shutil
import stat
import subprocess
import sys
import termios
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from robosmi.errors import MissingToolError, RobosmiError, SourceError, UploadError, UsageError
from robosmi.verify.toolchains.boards import load_boards
from robosmi.verify.toolchains.compiled_program import compile_into
from robosmi.verify.uploads import serial_ports
from robosmi.verify.uploads.upload import _alone, upload_sketch
from tests.running import run
from tests.tools import require_tools
from tests.verify.boot_loaders import waiting

AVR_BOARDS = [board for board in load_boards("arduino") if board.architecture == "avr"]

CASES = Path(__file__).parent / "cases"
CORE = Path("/usr/share/arduino/hardware/arduino/avr")
SAYS = json.loads((Path(__file__).parent / "uploader_says.json").read_text(encoding="utf-8"))
TOOLS = ("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
UNO, LEONARDO, MEGA = ("uno", "arduino", "1e950f"), ("leonardo", "avr109", "1e9587"), ("mega", "wiring", "1e9801")


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Output folders with a compiled sketch, one for each board; a record names its files by their paths in the folder."""
    require_tools(*TOOLS)
    made: dict[str, Path] = {}

    def of(board: str) -> Path:
        if board not in made:
            made[board] = tmp_path_factory.mktemp(board) / "out"
            shutil.copytree(CASES / "blink", made[board])
            assert compile_into(made[board], board).fits
        return made[board]

    return of


@pytest.fixture
def blink(compiled: Callable[[str], Path], tmp_path: Path) -> Callable[[str], Path]:
    """A copy of one of them."""

    def of(board: str) -> Path:
        shutil.rmtree(tmp_path / "out", ignore_errors=True)
        return Path(shutil.copytree(compiled(board), tmp_path / "out"))

    return of


@dataclass(frozen=True)
class StandIn:
    """The stand-in for the tool."""

    folder: Path

    def says(self, *runs: tuple[int, str]) -> None:
        """Set the outputs of the stand-in's next runs."""
        (self.folder / "says").write_text(json.dumps(runs))

    def asked(self) -> list[list[str]]:
        """The arguments of its runs."""
        path = self.folder / "asked"
        return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


@pytest.fixture
def stand_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> StandIn:
    """A stand-in for the uploading tool, found before the real one on PATH."""
    folder = tmp_path / "tools"
    folder.mkdir()
    tool = folder / "avrdude"
    tool.write_text(f"#!{sys.executable}\n" + (Path(__file__).parent / "stand_in_avrdude.py").read_text())
    tool.chmod(tool.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{folder}:{os.environ['PATH']}")
    monkeypatch.setattr(
        "robosmi.verify.uploads.upload.cache_dir", lambda: tmp_path / "cache"
    )  # other tests use the same port meanwhile
    return StandIn(folder)


# ---- with the real tool


@pytest.mark.parametrize(("board", "programmer", "signature"), [UNO, LEONARDO, MEGA])
def test_what_the_board_holds_is_the_program(board: str, programmer: str, signature: str, blink: Callable[[str], Path]) -> None:
    require_tools("avrdude")
    out = blink(board)
    with waiting(programmer, signature) as waits:
        done = upload_sketch(out, waits.port)
        written = waits.image()
        assert (termios.B1200 in waits.speeds) == (board == "leonardo")
    program = _bytes_of((out / "build" / "blink.hex").read_text())
    assert written[: len(program)] == program
    assert set(written[len(program) :]) <= {0xFF}  # the rest of the last page
    assert (done.bytes, done.board, done.sent) == (len(program), board, True)
    assert re.fullmatch(r"avrdude \d+\.\d+", done.tool)


@pytest.mark.parametrize(("board", "programmer", "signature"), [UNO, LEONARDO, MEGA])
def test_another_board_than_the_program_was_compiled_for_gets_nothing(
    board: str, programmer: str, signature: str, blink: Callable[[str], Path]
) -> None:
    require_tools("avrdude")
    out = blink(board)
    other = "1e9801" if board != "mega" else "1e950f"
    with waiting(programmer, other) as waits:
        with pytest.raises(UploadError, match=f"another board .* {other} .*{signature}"):
            upload_sketch(out, waits.port)
        assert waits.flash == {}


@pytest.mark.parametrize(("board", "programmer", "signature"), [UNO, LEONARDO, MEGA])
def test_a_byte_that_is_not_as_sent_is_an_error(
    board: str, programmer: str, signature: str, blink: Callable[[str], Path]
) -> None:
    require_tools("avrdude")
    out = blink(board)
    with waiting(programmer, signature, spoils=40) as waits, pytest.raises(UploadError, match="not what was sent"):
        upload_sketch(out, waits.port)


def test_a_port_that_is_not_there(blink: Callable[[str], Path]) -> None:
    require_tools("avrdude")
    for board in ("uno", "leonardo", "mega"):
        with pytest.raises(UploadError, match="there is no port '/dev/ttyNONE'") as refused:
            upload_sketch(blink(board), "/dev/ttyNONE")
        assert "connect the board" in (refused.value.fix or "")


# ---- what the tool is asked


@pytest.mark.parametrize("case", ["blink", "plain_c"])
def test_each_board_is_asked_for_as_the_core_asks_and_the_real_tool_takes_it(case: str, tmp_path: Path) -> None:
    """Judges are the core's own boards.txt, and the real tool's reading of its arguments, which ends at the port."""
    require_tools(*TOOLS, "avrdude")
    shutil.copytree(CASES / case, tmp_path / "out")
    compile_into(tmp_path / "out", "uno")
    (record,) = (tmp_path / "out" / "build").glob("*.build.json")
    text, names = record.read_text(), {board.name: board.full_names for board in AVR_BOARDS}
    assert len(names) == 16
    for name, full_names in names.items():
        record.write_text(text.replace('"uno"', f'"{name}"'))
        done = upload_sketch(tmp_path / "out", "/dev/ttyNONE", dry_run=True)
        told = dict(itertools.pairwise(done.command))
        facts = _facts()[full_names[0]]
        assert (told["-c"], told["-b"], told["-p"]) == (facts["protocol"], facts["speed"], facts["mcu"]), name
        if told["-c"] != "wiring":  # which goes on for ever without a port; it is started in the tests above
            said = subprocess.run(done.command, capture_output=True, text=True, cwd=record.parent, timeout=60, check=False)
            assert "/dev/ttyNONE: No such file" in said.stderr, said.stderr


def test_boards_that_wait_for_a_program_only_after_a_touch_are_those_of_the_core() -> None:
    require_tools("arduino-core-avr")
    touched = {board.name for board in AVR_BOARDS if board.boot_loader and board.boot_loader.touch_baud == 1200}
    assert touched == {board.name for board in AVR_BOARDS if _facts()[board.full_names[0]]["touch"] == "true"}


def test_the_boot_loaders_of_the_boards_take_what_the_core_says() -> None:
    require_tools("arduino-core-avr")
    for board in AVR_BOARDS:
        assert board.boot_loader is not None
        assert str(board.boot_loader.takes_bytes) == _facts()[board.full_names[0]]["maximum_size"], board.name
        assert board.flash_bytes == board.boot_loader.takes_bytes


def test_a_board_that_was_sold_with_two_baud_rates_is_tried_with_both(blink: Callable[[str], Path], stand_in: StandIn) -> None:
    out = blink("nano")
    stand_in.says((1, SAYS["silent"]["7.1 arduino"]))
    assert upload_sketch(out, "/dev/null").sent
    assert [asked[asked.index("-b") + 1] for asked in stand_in.asked()] == ["115200", "57600"]
    stand_in.says(*[(1, "")] * 2, (1, SAYS["silent"]["6.3 arduino"]))
    with pytest.raises(UploadError, match="no 'Arduino Nano' answers"):
        upload_sketch(out, "/dev/null", baud=19200)
    assert stand_in.asked()[-1][7] == "19200"


@pytest.mark.parametrize(
    ("kind", "which", "message"),
    [
        (kind, which, message)
        for kind, message in {
            "no port": "there is no port '/dev/null'",
            "denied": "you may not use the port",
            "busy": "the port '/dev/null' is in use",
            "silent": "no 'Arduino Uno' answers at the port",
            "other board": r"has the signature 1e9801 \(atmega2560: mega, megaadk\), 1e950f \(atmega328p\) is wanted",
            "mismatch": "what the board holds is not what was sent",
            "no signature": "does not tell its signature",
            "unknown": "avrdude failed: avrdude: error at something new",
        }.items()
        for which in SAYS[kind]
    ],
)
def test_what_the_tool_says_becomes_a_cause_and_an_advice(
    kind: str, which: str, message: str, blink: Callable[[str], Path], stand_in: StandIn
) -> None:
    stand_in.says((1, SAYS[kind][which]))
    with pytest.raises(UploadError, match=message) as refused:
        upload_sketch(blink("uno"), "/dev/null")
    assert refused.value.fix
    assert refused.value.exit_code == 6


# ---- what is not sent


def test_a_sketch_that_is_not_compiled(tmp_path: Path, stand_in: StandIn) -> None:
    shutil.copytree(CASES / "blink", tmp_path / "out")
    outcome = run("upload", tmp_path / "out", "--port", "/dev/null")
    assert outcome.code == 3
    assert f"compile it: robosmi compile {tmp_path / 'out'}" in outcome.err
    assert stand_in.asked() == []


def _edited(sketch: Path) -> None:
    (sketch / "blink.ino").write_text((sketch / "blink.ino").read_text() + "// more\n")


def _new(sketch: Path) -> None:
    (sketch / "new.h").write_text("")


def _gone(sketch: Path) -> None:
    (sketch / "blink.ino").rename(sketch / "src.txt")
    (sketch / "blink.ino").write_text("void setup() {}\nvoid loop() {}\n")


def _another_program(sketch: Path) -> None:
    path = sketch.parent / "build" / "blink.hex"
    path.write_text(":00000001FF\n")


def _damaged_record(sketch: Path) -> None:
    (sketch.parent / "build" / "blink.build.json").write_text('{"schema": "robosmi-build/1", "board": 3')


def _unknown_board(sketch: Path) -> None:
    path = sketch.parent / "build" / "blink.build.json"
    path.write_text(path.read_text().replace('"uno"', '"nuo"'))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (_edited, r"blink\.ino: .* since the sketch was compiled"),
        (_new, r"new\.h: .* since the sketch was compiled"),
        (_gone, r"since the sketch was compiled, and 1 more"),
        (_another_program, "has changed since it was compiled"),
        (_damaged_record, "the record of the program is damaged"),
        (_unknown_board, "unknown board 'nuo'"),
    ],
)
def test_a_program_that_is_not_of_the_sketch_as_it_stands(
    change: Callable[[Path], None], message: str, blink: Callable[[str], Path], stand_in: StandIn
) -> None:
    out = blink("uno")
    change(out / "blink")
    with pytest.raises(SourceError, match=message) as refused:
        upload_sketch(out, "/dev/null")
    assert "compile" in (refused.value.fix or "")
    assert stand_in.asked() == []


def test_a_file_beside_the_sketch_s_folder_that_it_includes_is_part_of_the_program(tmp_path: Path, stand_in: StandIn) -> None:
    require_tools(*TOOLS)
    out = Path(shutil.copytree(CASES / "blink", tmp_path / "out"))
    sketch = out / "blink" / "blink.ino"
    sketch.write_text(f'#include "../shared.h"\n{sketch.read_text()}')
    (out / "shared.h").write_text("#define SHARED 1\n")
    assert compile_into(out).fits
    assert upload_sketch(out, "/dev/null").sent
    (out / "shared.h").write_text("#define SHARED 2\n")
    with pytest.raises(SourceError, match="was changed since the sketch was compiled") as refused:
        upload_sketch(out, "/dev/null")
    assert str(refused.value.location) == str(out / "shared.h")


def test_a_port_that_is_a_path_from_here_is_found(
    blink: Callable[[str], Path], stand_in: StandIn, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = blink("uno")
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    Path("port").symlink_to("/dev/null")
    assert upload_sketch(out, "port").port == str(tmp_path / "here" / "port")


def test_two_uploads_to_one_port_do_not_meet(blink: Callable[[str], Path], stand_in: StandIn, tmp_path: Path) -> None:
    out = blink("uno")
    with _alone("/dev/null"), pytest.raises(UploadError, match="another upload to '/dev/null' is running"):
        upload_sketch(out, "/dev/null")
    assert stand_in.asked() == []
    assert upload_sketch(out, "/dev/null").sent


def test_notes_in_markdown_are_no_part_of_the_program(blink: Callable[[str], Path], stand_in: StandIn) -> None:
    out = blink("uno")
    (out / "blink" / "MIGRATION.md").write_text("- [x] done\n")
    assert upload_sketch(out, "/dev/null").sent


def test_a_program_with_stand_ins(tmp_path: Path, stand_in: StandIn) -> None:
    require_tools(*TOOLS)
    shutil.copytree(CASES / "servo", tmp_path / "out")
    compile_into(tmp_path / "out")
    outcome = run("upload", tmp_path / "out", "--port", "/dev/null", "--json")
    assert outcome.code == 3
    (finding,) = outcome.document["findings"]
    assert "stand-ins" in finding["message"]
    assert finding["fix"].startswith("install 'Servo'")
    assert stand_in.asked() == []


def test_a_program_with_a_body_to_be_written_needs_a_word(blink: Callable[[str], Path], stand_in: StandIn) -> None:
    out = blink("uno")
    (out / "blink" / "adapters.h").write_text("int read() {\n  // TODO: complete method\n  return 0;\n}\n")
    compile_into(out, "uno")
    with pytest.raises(SourceError, match="a body is still to be written") as refused:
        upload_sketch(out, "/dev/null")
    assert str(refused.value.location) == f"{out / 'blink' / 'adapters.h'}:2"
    assert upload_sketch(out, "/dev/null", unfinished=True).sent


def test_a_program_that_the_boot_loader_cannot_take(tmp_path: Path, stand_in: StandIn) -> None:
    """32,600 bytes fit on the microcontroller, so that the C program compiles; the Uno's boot loader takes 32,256 of them."""
    require_tools(*TOOLS)
    folder = tmp_path / "out" / "big"
    folder.mkdir(parents=True)
    text = "#include <avr/pgmspace.h>\nconst char table[32300] PROGMEM = {1};\n"
    text += "int main(int n, char **a) {\n  (void)a;\n  return pgm_read_byte(table + n);\n}\n"
    (folder / "big.c").write_text(text)
    (folder / "Makefile").write_text("BOARD := uno\n")
    assert compile_into(tmp_path / "out").fits
    with pytest.raises(SourceError, match=r"too big for 'uno': 32\d+ bytes, the limit is 32256"):
        upload_sketch(tmp_path / "out", "/dev/null")
    assert stand_in.asked() == []


def test_without_the_tool_it_is_named_with_its_package(blink: Callable[[str], Path], monkeypatch: pytest.MonkeyPatch) -> None:
    out = blink("uno")
    monkeypatch.setenv("PATH", str(out))
    with pytest.raises(MissingToolError, match="not installed: avrdude") as missing:
        upload_sketch(out, "/dev/null")
    assert missing.value.fix == "sudo apt install avrdude"


def test_a_port_without_a_name(blink: Callable[[str], Path], stand_in: StandIn) -> None:
    out = blink("uno")
    with pytest.raises(UsageError, match="the port's name is empty"):
        upload_sketch(out, " ")
    outcome = run("upload", out, "--json")
    assert outcome.code == 2
    assert "--port" in outcome.document["findings"][0]["fix"]
    assert stand_in.asked() == []


def test_a_dry_run_sends_nothing(blink: Callable[[str], Path], stand_in: StandIn) -> None:
    out = blink("leonardo")
    outcome = run("upload", out, "--port", "/dev/ttyNONE", "--dry-run", "--json")
    assert outcome.code == 0
    assert outcome.result["sent"] is False
    assert " -p atmega32u4 -c avr109 -P /dev/ttyNONE -b 57600 " in outcome.result["command"]
    assert stand_in.asked() == []


def test_a_tool_that_does_not_end_is_ended(
    blink: Callable[[str], Path], stand_in: StandIn, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = blink("uno")
    (stand_in.folder / "avrdude").write_text('#!/bin/sh\n[ "$1" = -v ] && exit 0\nsleep 60\n')
    monkeypatch.setattr("robosmi.base.data_tables.DataTable.decimal", lambda self, key: 0.5)
    started = time.monotonic()
    with pytest.raises(RobosmiError, match="exceeded") as ended:
        upload_sketch(out, "/dev/null")
    assert time.monotonic() - started < 20
    assert "incomplete program" in (ended.value.fix or "")


def test_the_sketch_s_own_folder_and_another_build_folder(blink: Callable[[str], Path], stand_in: StandIn) -> None:
    out = blink("uno")
    sketch = out / "blink"
    assert compile_into(sketch, "uno").hex == sketch / "build" / "blink.hex"  # this folder was made by no run of ours
    assert upload_sketch(sketch, "/dev/null").sent
    compile_into(out, "nano", into=out / "else where")
    assert upload_sketch(out, "/dev/null", kept_in=out / "else where").board == "nano"


# ---- ports


def test_a_touched_port_was_opened_at_its_baud_rate() -> None:
    with waiting("avr109", "1e9587") as waits:
        serial_ports.touch(waits.port, 1200)
        assert termios.tcgetattr(waits.master)[4] == termios.B1200


@pytest.mark.parametrize("name", ["board", "board2"])
def test_a_board_comes_back_at_its_port_or_at_a_new_one(name: str, tmp_path: Path) -> None:
    port, other = tmp_path / "board", tmp_path / "boardX"
    port.touch()
    other.touch()

    def leave() -> None:
        time.sleep(0.1)
        port.unlink()
        time.sleep(0.2)
        (tmp_path / name).touch()

    thread = threading.Thread(target=leave)
    thread.start()
    assert serial_ports.comes_back(str(port), [str(tmp_path / "board*")], 5, 5) == str(tmp_path / name)
    thread.join()


def test_a_board_that_does_not_leave_keeps_its_port_and_one_that_stays_away_has_none(tmp_path: Path) -> None:
    port = tmp_path / "board"
    port.touch()
    assert serial_ports.comes_back(str(port), [], 0.1, 0.1) == str(port)
    port.unlink()
    assert serial_ports.comes_back(str(port), [], 0.1, 0.1) is None


# ---- facts


def _facts() -> dict[str, dict[str, str]]:
    """What boards.txt of the core says of uploads, by the boards' full names."""
    text = (CORE / "boards.txt").read_text(encoding="utf-8")
    values = dict(line.split("=", 1) for line in text.splitlines() if "=" in line and not line.startswith("#"))
    chosen = {
        "diecimila": "atmega328", "nano": "atmega328", "mega": "atmega2560", "mini": "atmega328", "bt": "atmega328",
        "lilypad": "atmega328", "pro": "16MHzatmega328",
    }  # fmt: skip
    facts = {}
    for full_name in [name for board in AVR_BOARDS for name in board.full_names[:1]]:
        _, _, board, *options = full_name.split(":")
        cpu = options[0].partition("=")[2] if options else chosen.get(board, "")

        def of(key: str, board: str = board, cpu: str = cpu) -> str:
            return values.get(f"{board}.menu.cpu.{cpu}.{key}") or values.get(f"{board}.{key}", "")

        facts[full_name] = {
            "protocol": of("upload.protocol"), "speed": of("upload.speed"), "mcu": of("build.mcu"),
            "maximum_size": of("upload.maximum_size"), "touch": of("upload.use_1200bps_touch"),
        }  # fmt: skip
    return facts


def _bytes_of(text: str) -> bytes:
    """The bytes of an Intel HEX text without gaps."""
    records = [bytes.fromhex(line[1:]) for line in text.split()]
    return b"".join(record[4:-1] for record in records if record[3] == 0)
