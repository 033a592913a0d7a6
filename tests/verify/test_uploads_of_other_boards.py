"""Uploads to boards that are no AVR: copies to a drive, and tools that are data; all refusals name a cause and a cure."""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
import sys
from pathlib import Path

import pytest

from robosmi.errors import MissingToolError, SourceError, UploadError, UsageError
from robosmi.verify.toolchains.build_record import BuildRecord
from robosmi.verify.toolchains.compiled_program import digests
from robosmi.verify.toolchains.sketch import find_sketch
from robosmi.verify.uploads.upload import upload_sketch
from tests.running import run

CASES = Path(__file__).parent / "cases"
PICO = "UF2 Bootloader v2.0\nModel: Raspberry Pi RP2\nBoard-ID: RPI-RP2\n"
PICO_2 = "UF2 Bootloader v1.0\nModel: Raspberry Pi RP2350\nBoard-ID: RP2350\n"


def uf2(parts: int = 3) -> bytes:
    """A UF2 file of some parts of 256 bytes."""
    blocks = []
    for number in range(parts):
        words = (0x9E5D5157, 0x2000, 0x10000000 + 256 * number, 256, number, parts, 0xE48BFF56)
        head = b"UF2\n" + b"".join(word.to_bytes(4, "little") for word in words)
        blocks.append(head + bytes(476) + (0x0AB16F30).to_bytes(4, "little"))
    return b"".join(blocks)


def intel_hex(start: int, data: bytes) -> bytes:
    """An Intel HEX file of a few bytes from an address on."""
    high = (start >> 16).to_bytes(2, "big")
    records = [
        b"\x02\x00\x00\x04" + high,
        bytes([len(data)]) + (start & 0xFFFF).to_bytes(2, "big") + b"\x00" + data,
        b"\x00\x00\x00\x01",
    ]
    return b"".join(b":" + (r + bytes([-sum(r) & 0xFF])).hex().upper().encode() + b"\n" for r in records)


def kept(folder: Path, board: str, ending: str, program: bytes, stand_in: str = "") -> Path:
    """An output folder with a compiled program for a board, as `compile` leaves it."""
    out = Path(shutil.copytree(CASES / "blink", folder / "out"))
    sketch, _ = find_sketch(out)
    build = out / "build"
    build.mkdir()
    made = hashlib.sha256(program).hexdigest()
    record = BuildRecord(board, True, (), digests(sketch, build), made, {}, {}, stand_in)
    (build / "blink.build.json").write_bytes(record.to_bytes())
    (build / f"blink.ino{ending}").write_bytes(program)
    return out


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that is all of PATH, and no other upload at the ports."""
    folder = tmp_path / "tools"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.setattr("robosmi.verify.uploads.upload.cache_dir", lambda: tmp_path / "cache")
    return folder


@pytest.fixture
def mounted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The place where drives are mounted, instead of the system's."""
    folder = tmp_path / "media"
    folder.mkdir()
    monkeypatch.setattr("robosmi.verify.uploads.upload.glob", lambda _: sorted(str(path) for path in folder.iterdir()))
    return folder


def drive(mounted: Path, name: str = "RPI-RP2", info: str = PICO, marker: str = "INFO_UF2.TXT") -> Path:
    (mounted / name).mkdir()
    (mounted / name / marker).write_text(info)
    return mounted / name


def tool(folder: Path, name: str, *, says: str = "", code: int = 0) -> Path:
    """A stand-in for a tool on PATH: it writes down its arguments, says something and ends with a code."""
    path, asked = folder / name, folder / f"{name}.asked"
    path.write_text(
        f"#!{sys.executable}\nimport sys\n"
        "if sys.argv[1:2] in (['version'], ['--version'], ['--help']): print('tool 1.9.1'); sys.exit(0)\n"
        f"open({str(asked)!r}, 'a').write('\\n'.join(sys.argv[1:]) + '\\n')\n"
        f"sys.stderr.write({says!r})\nsys.exit({code})\n"
    )
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return asked


# ---- copies to a drive


@pytest.mark.parametrize("board", ["pico", "picow", "nano-rp2040"])
@pytest.mark.parametrize("named", [True, False])
def test_the_program_is_copied_to_the_drive(board: str, named: bool, tmp_path: Path, mounted: Path, tools: Path) -> None:
    place = drive(mounted)
    done = upload_sketch(kept(tmp_path, board, ".uf2", uf2()), str(place) if named else None)
    assert (place / "blink.ino.uf2").read_bytes() == uf2()
    assert (done.bytes, done.board, done.port, done.sent) == (768, board, str(place), True)


def test_nothing_is_copied_in_a_dry_run(tmp_path: Path, mounted: Path, tools: Path) -> None:
    place = drive(mounted)
    assert not upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()), dry_run=True).sent
    assert [path.name for path in place.iterdir()] == ["INFO_UF2.TXT"]


def test_without_a_drive_it_says_how_to_get_one(tmp_path: Path, mounted: Path, tools: Path) -> None:
    drive(mounted, "RP2350", PICO_2)
    (mounted / "stick").mkdir()
    with pytest.raises(UploadError, match=r"no drive .*RPI-RP2.*RP2350") as refused:
        upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()))
    assert "BOOTSEL" in (refused.value.fix or "")


def test_two_boards_that_wait_are_not_chosen_from(tmp_path: Path, mounted: Path, tools: Path) -> None:
    drive(mounted), drive(mounted, "RPI-RP21")
    with pytest.raises(UploadError, match="2 boards wait") as refused:
        upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()))
    assert "--port" in (refused.value.fix or "")
    assert not list(mounted.glob("*/*.uf2"))


@pytest.mark.parametrize(
    ("info", "cause"), [(PICO_2, "another board"), ("nonsense", "another board"), (None, "has no INFO_UF2.TXT")]
)
def test_a_named_drive_of_another_board_gets_nothing(
    info: str | None, cause: str, tmp_path: Path, mounted: Path, tools: Path
) -> None:
    place = drive(mounted, info=info) if info is not None else mounted
    with pytest.raises(UploadError, match=cause):
        upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()), str(place))
    assert not list(mounted.rglob("*.uf2"))


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write everywhere")
def test_a_drive_that_may_not_be_written_is_told(tmp_path: Path, mounted: Path, tools: Path) -> None:
    place = drive(mounted)
    place.chmod(0o555)
    with pytest.raises(UploadError, match="did not take the program"):
        upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()))


def test_a_drive_that_is_full_is_told(tmp_path: Path, mounted: Path, tools: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drive(mounted)

    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("robosmi.verify.uploads.upload.os.write", full)
    with pytest.raises(UploadError, match="No space left on device after 0 of 1536 bytes"):
        upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()))


def test_a_board_that_restarts_before_the_copy_ends_has_its_program(
    tmp_path: Path, mounted: Path, tools: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = drive(mounted)

    def restarts(_: int) -> None:
        shutil.rmtree(place)
        raise OSError(5, "Input/output error")

    monkeypatch.setattr("robosmi.verify.uploads.upload.os.fsync", restarts)
    assert upload_sketch(kept(tmp_path, "pico", ".uf2", uf2())).sent


def test_a_running_board_is_made_a_drive_by_its_port(
    tmp_path: Path, mounted: Path, tools: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    touched: list[tuple[str, int]] = []

    def touch(port: str, baud: int) -> None:
        touched.append((port, baud))
        drive(mounted)

    monkeypatch.setattr("robosmi.verify.uploads.serial_ports.touch", touch)
    assert upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()), "/dev/ttyACM7").port == str(mounted / "RPI-RP2")
    assert touched == [("/dev/ttyACM7", 1200)]


def test_a_port_that_is_not_there_is_told(tmp_path: Path, mounted: Path, tools: Path) -> None:
    with pytest.raises(UploadError, match="/dev/ttyNONE") as refused:
        upload_sketch(kept(tmp_path, "pico", ".uf2", uf2()), "/dev/ttyNONE")
    assert "BOOTSEL" in (refused.value.fix or "")


@pytest.mark.parametrize(
    ("program", "cause"), [(b"no blocks", "not a UF2 file"), (uf2()[:-1], "not a UF2 file"), (uf2(9000), "too big")]
)
def test_a_program_that_the_board_cannot_take_is_refused(
    program: bytes, cause: str, tmp_path: Path, mounted: Path, tools: Path
) -> None:
    drive(mounted)
    with pytest.raises(SourceError, match=cause):
        upload_sketch(kept(tmp_path, "pico", ".uf2", program))
    assert not list(mounted.rglob("*.uf2"))


def test_a_program_with_the_stand_in_core_is_refused(tmp_path: Path, mounted: Path, tools: Path) -> None:
    drive(mounted)
    with pytest.raises(SourceError, match="stand-in for the core"):
        upload_sketch(kept(tmp_path, "pico", ".uf2", uf2(), "arduino-pico"))


def test_a_nucleo_takes_a_file_on_the_drive_of_its_debugger(tmp_path: Path, mounted: Path, tools: Path) -> None:
    drive(mounted, "NODE_F103RB", "", "MBED.HTM")
    place = drive(mounted, "NODE_F401RE", "", "MBED.HTM")
    done = upload_sketch(kept(tmp_path, "nucleo-f401re", ".bin", b"\x01" * 99))
    assert (done.port, done.bytes) == (str(place), 99)
    assert (place / "blink.ino.bin").is_file()


# ---- tools


TOOLS = {
    "esp32": ("esptool", ".bin", ["--chip", "esp32", "write_flash", "0x10000", "blink.ino.bin", "/dev/null"]),
    "esp32c3": ("esptool.py", ".bin", ["--chip", "esp32c3", "blink.ino.bin"]),
    "teensy40": ("teensy_loader_cli", ".hex", ["--mcu=TEENSY40", "blink.ino.hex"]),
    "uno-r4-minima": ("dfu-util", ".bin", ["--device", "0x2341:0x0069,0x2341:0x0369", "-D", "blink.ino.bin"]),
    "nano33ble": ("bossac", ".bin", ["--port=null", "-e", "-w", "blink.ino.bin"]),
}
PROGRAMS = {".bin": b"\x01" * 99, ".hex": intel_hex(0x60000000, b"\x01" * 99)}
NEED_A_PORT = ("esp32", "esp32c3", "nano33ble")


@pytest.fixture
def awake(monkeypatch: pytest.MonkeyPatch) -> None:
    """A board that is at its port again after each touch."""
    monkeypatch.setattr("robosmi.verify.uploads.serial_ports.touch", lambda port, baud: None)
    monkeypatch.setattr("robosmi.verify.uploads.serial_ports.comes_back", lambda port, *_: port)


@pytest.mark.processes
@pytest.mark.parametrize("board", TOOLS)
def test_each_tool_gets_the_program_of_its_board(board: str, tmp_path: Path, tools: Path, awake: None) -> None:
    name, ending, expected = TOOLS[board]
    asked = tool(tools, name)
    done = upload_sketch(kept(tmp_path, board, ending, PROGRAMS[ending]), "/dev/null" if board in NEED_A_PORT else None)
    words = asked.read_text().splitlines()
    assert set(expected) <= set(words)
    assert (done.bytes, done.board, done.sent) == (99, board, True)
    assert done.tool.endswith(" 1.9.1")
    assert bool(done.note) == board.startswith("esp32")


@pytest.mark.parametrize("board", TOOLS)
def test_a_tool_that_is_missing_is_named_with_its_package(board: str, tmp_path: Path, tools: Path) -> None:
    ending = TOOLS[board][1]
    with pytest.raises(MissingToolError, match=TOOLS[board][0].removesuffix(".py")) as refused:
        upload_sketch(kept(tmp_path, board, ending, PROGRAMS[ending]), "/dev/null")
    assert "install" in (refused.value.fix or "")


@pytest.mark.processes
@pytest.mark.parametrize("board", NEED_A_PORT)
def test_a_tool_that_needs_a_port_says_so(board: str, tmp_path: Path, tools: Path) -> None:
    tool(tools, TOOLS[board][0])
    with pytest.raises(UsageError, match="no port") as refused:
        upload_sketch(kept(tmp_path, board, TOOLS[board][1], PROGRAMS[TOOLS[board][1]]))
    assert "--port" in (refused.value.fix or "")


@pytest.mark.processes
@pytest.mark.parametrize(
    ("board", "says", "cause"),
    [
        ("esp32", "A fatal error occurred: Failed to connect to ESP32: No serial data received.", "no 'ESP32"),
        ("esp32", "A fatal error occurred: This chip is ESP32-C3 not ESP32. Wrong chip argument?", "another board"),
        ("uno-r4-minima", "dfu-util: No DFU capable USB device available", "waits for a program"),
        ("teensy40", "Unable to open device (hint: try -w option)", "takes a program"),
        ("nano33ble", "No device found on null", "waits for a program"),
        ("nano33ble", "something else went wrong", "bossac failed: something else went wrong"),
    ],
)
def test_what_a_tool_says_is_told_with_what_to_do(
    board: str, says: str, cause: str, tmp_path: Path, tools: Path, awake: None
) -> None:
    name, ending, _ = TOOLS[board]
    tool(tools, name, says=says, code=1)
    with pytest.raises(UploadError, match=cause) as refused:
        upload_sketch(kept(tmp_path, board, ending, PROGRAMS[ending]), "/dev/null" if board in NEED_A_PORT else None)
    assert refused.value.fix


@pytest.mark.processes
def test_an_esp32_that_does_not_answer_is_tried_more_slowly(tmp_path: Path, tools: Path) -> None:
    asked = tool(tools, "esptool", says="Failed to connect", code=2)
    with pytest.raises(UploadError):
        upload_sketch(kept(tmp_path, "esp32", ".bin", PROGRAMS[".bin"]), "/dev/null")
    words = asked.read_text().splitlines()
    assert [words[n + 1] for n, word in enumerate(words) if word == "--baud"] == ["921600", "115200"]


def test_a_board_without_a_way_is_refused(tmp_path: Path, tools: Path) -> None:
    out = kept(tmp_path, "zero", ".bin", b"\x01")
    done = run("upload", out, "--port", "/dev/null", "--json")
    assert done.code != 0
    assert "no upload method is known for 'zero'" in done.document["findings"][0]["message"]
