"""The compile check on whole sketches, with the real tools. Each case is a folder of files in `cases`."""

from __future__ import annotations

import hashlib
import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from robosmi.errors import MissingToolError, SourceError, UsageError
from robosmi.verify.toolchains.compile_report import RULES, CompileReport
from robosmi.verify.toolchains.libraries import read_files
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_tools

CASES = Path(__file__).parent / "cases"
LIBRARIES = Path(__file__).parent / "libraries"
needs_tools = pytest.mark.usefixtures("toolchain_installed")


@pytest.fixture
def toolchain_installed() -> None:
    """The tools and the core are there, or the test does not run."""
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")


@pytest.fixture(autouse=True)
def own_home(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """No library, core or setting of the user's; a cache that all tests share."""
    home = tmp_path_factory.getbasetemp() / "home"
    home.mkdir(exist_ok=True)
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("XDG_CACHE_HOME", str(home / "cache"))
    for name in ("ROBOSMI_CORE", "ROBOSMI_LIBRARIES", "ROBOSMI_PATH", "ROBOSMI_HOME", "XDG_DATA_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(home)


def compiled(case: str, board: str | None = None) -> CompileReport:
    """The report of a case."""
    return compile_sketch(CASES / case, board)


def said(report: CompileReport) -> list[tuple[str, str, int | None, str]]:
    """Rule, file name, line and message of each finding."""
    return [
        (f.rule, Path(f.location.path).name if f.location else "", f.location.line if f.location else None, f.message)
        for f in report.diagnostics
    ]


@needs_tools
@pytest.mark.parametrize(
    ("board", "flash", "ram"), [("uno", 930, 9), ("nano", 930, 9), ("mega", 1548, 9), ("leonardo", 4130, 149)]
)
def test_blink_has_the_measured_size_on_each_board(board: str, flash: int, ram: int) -> None:
    """Sizes as measured with Debian's versions, research/arduino-verification.md section 2."""
    report = compiled("blink", board)
    assert report.ok
    assert report.fits
    assert report.fits_on == board == report.board
    assert report.flash_bytes == pytest.approx(flash, abs=40)
    assert report.ram_bytes == pytest.approx(ram, abs=4)
    assert report.diagnostics == ()
    assert report.libraries == ()
    assert report.exit_code == 0


@needs_tools
@pytest.mark.parametrize("path", ["blink", "blink/blink", "blink/blink/blink.ino"])
def test_the_generated_folder_the_sketch_and_its_file_are_the_same(path: str) -> None:
    assert compiled(path).flash_bytes == compiled("blink").flash_bytes


@needs_tools
def test_a_relative_path_gives_relative_places(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(CASES)
    place = compile_sketch(Path("syntax_error")).diagnostics[0].location
    assert str(place) == "syntax_error/syntax_error/syntax_error.ino:7:3"


@needs_tools
def test_further_sources_are_compiled_too() -> None:
    report = compiled("adapters")
    assert report.ok
    assert report.diagnostics == ()


@needs_tools
@pytest.mark.parametrize(
    ("case", "finding"),
    [
        ("syntax_error", ("RS801", "syntax_error.ino", 7, "expected ';' before 'delay'")),
        ("undeclared_in_adapter", ("RS801", "adapter.cpp", 6, "'HIHG' was not declared in this scope")),
        ("several_files", ("RS801", "b_steps.ino", 3, "'undeclared' was not declared in this scope")),
        ("missing_header", ("RS803", "missing_header.ino", 5, "Unheard_Of.h: No such file or directory")),
        ("undefined", ("RS804", "undefined.ino", 2, "undefined reference to `set_everything(int)'")),
        ("assembler", ("RS801", "assembler.ino", 3, "the assembler rejects an instruction: bad expression")),
    ],
)
def test_an_error_is_reported_at_its_place(case: str, finding: tuple[str, str, int, str]) -> None:
    report = compiled(case)
    assert not report.ok
    assert report.fits is None
    assert report.exit_code == 6
    assert said(report) == [finding]
    assert (report.flash_bytes, report.ram_bytes, report.fits_on) == (None, None, None)


@needs_tools
def test_a_missing_header_says_what_to_do() -> None:
    (finding,) = compiled("missing_header").diagnostics
    assert finding.fix is not None
    assert "Unheard_Of.h" in finding.fix
    assert "ROBOSMI_LIBRARIES" in finding.fix


@needs_tools
def test_a_missing_header_names_the_libraries_that_offer_it() -> None:
    (finding,) = compiled("missing_library").diagnostics
    assert finding.rule == "RS803"
    assert finding.listed("libraries")[0] == "Adafruit BMP085 Library"
    assert finding.fix is not None
    assert "libraries that have it: 'Adafruit BMP085 Library'" in finding.fix
    (unknown,) = compiled("missing_header").diagnostics
    assert "libraries" not in unknown.evidence, "no library offers it"


@needs_tools
def test_without_an_index_of_libraries_a_missing_header_is_still_reported(tmp_path: Path) -> None:
    own = tmp_path / ".robosmi/platform_repo/arduino/libraries/index.sqlite"
    own.parent.mkdir(parents=True)
    own.write_bytes(b"no index")
    (finding,) = compile_sketch(CASES / "missing_library", project=tmp_path).diagnostics
    assert (finding.rule, finding.evidence) == ("RS803", {"header": "Adafruit_BMP085.h"})


@needs_tools
def test_warnings_of_the_sketch_are_reported() -> None:
    report = compiled("warnings")
    assert report.ok
    assert report.exit_code == 0
    assert [(f.rule, f.evidence["option"]) for f in report.diagnostics] == [
        ("RS802", "-Wunused-variable"),
        ("RS802", "-Woverflow"),
        ("RS802", "-Wparentheses"),
    ]


@needs_tools
@pytest.mark.parametrize(
    ("case", "fits_on", "memory", "limit"),
    [("too_much_flash", "mega", "flash", 32256), ("too_much_ram", "mega", "RAM", 2048), ("too_big_for_all", None, "RAM", 2048)],
)
def test_too_big_is_no_compile_error_and_names_a_board(case: str, fits_on: str | None, memory: str, limit: int) -> None:
    report = compiled(case)
    assert (report.ok, report.fits, report.fits_on, report.exit_code) == (True, False, fits_on, 1)
    (finding,) = report.errors
    assert finding.rule == "RS805"
    assert memory in finding.message
    assert str(limit) in finding.message
    assert finding.fix is not None
    assert ("mega" in finding.fix) is bool(fits_on)
    assert (report.flash_bytes or 0) > (report.flash_limit or 0) or (report.ram_bytes or 0) > (report.ram_limit or 0)


@needs_tools
def test_little_ram_is_a_warning() -> None:
    report = compiled("little_ram")
    assert report.fits
    assert [f.rule for f in report.diagnostics] == ["RS807"]


@needs_tools
@pytest.mark.parametrize("board", ["uno", "nano", "mega", "leonardo"])
@pytest.mark.parametrize(("case", "library"), [("servo", "Servo"), ("dht", "DHT sensor library"), ("infrared", "IRremote")])
def test_a_stand_in_is_used_and_named(case: str, library: str, board: str) -> None:
    report = compiled(case, board)
    assert report.ok
    assert report.fits
    assert [(used.name, used.source) for used in report.libraries] == [(library, "stand-in")]
    assert [f.rule for f in report.diagnostics] == ["RS806"]
    assert library in report.diagnostics[0].message


@needs_tools
def test_an_installed_library_goes_before_a_stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its own dependency is found too, its examples are not compiled, one for another processor is passed over."""
    monkeypatch.setenv("ROBOSMI_LIBRARIES", str(LIBRARIES))
    report = compiled("servo")
    assert report.ok
    assert report.diagnostics == ()
    assert [(u.name, u.source, u.version) for u in report.libraries] == [
        ("Servo", "installed", "9.9.9"),
        ("Helper", "installed", ""),
    ]


@needs_tools
def test_a_library_for_another_architecture_comes_last(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As Arduino's builder has it: it is compiled, and the user is warned."""
    for name, architecture in (("Lamp", "esp32"), ("Lamps", "*")):
        (tmp_path / "libraries" / name).mkdir(parents=True)
        (tmp_path / "libraries" / name / "Lamp.h").write_text("#define LAMP 13\n")
        (tmp_path / "libraries" / name / "library.properties").write_text(f"name={name}\narchitectures={architecture}\n")
    monkeypatch.setenv("ROBOSMI_LIBRARIES", str(tmp_path / "libraries"))
    (tmp_path / "lamp").mkdir()
    (tmp_path / "lamp" / "lamp.ino").write_text("#include <Lamp.h>\nvoid setup() { pinMode(LAMP, OUTPUT); }\nvoid loop() {}\n")
    fitting = compile_sketch(tmp_path / "lamp", "uno")
    assert ([used.name for used in fitting.libraries], fitting.diagnostics) == (["Lamps"], ())
    (tmp_path / "libraries" / "Lamps" / "Lamp.h").unlink()
    other = compile_sketch(tmp_path / "lamp", "uno")
    assert other.ok
    assert [used.name for used in other.libraries] == ["Lamp"]
    assert [finding.rule for finding in other.diagnostics] == ["RS813"]


@needs_tools
def test_a_library_of_the_core_is_installed() -> None:
    assert [(used.name, used.source) for used in compiled("wire").libraries] == [("Wire", "installed")]


@needs_tools
def test_the_board_comes_from_the_project_file_unless_asked_for() -> None:
    assert compiled("for_mega").board == "mega"
    assert not compiled("for_mega", "uno").ok
    assert compiled("for_mega", "arduino:avr:mega").ok


def test_an_unknown_board_is_an_error_with_its_place() -> None:
    with pytest.raises(SourceError, match=r"sketch\.yaml:3: unknown board 'arduino:avr:unno' \(did you mean"):
        compiled("unknown_board")
    with pytest.raises(UsageError, match="unknown board 'unno'"):
        compiled("blink", "unno")


def test_no_sketch_is_an_error_of_the_source(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="no sketch found"):
        compile_sketch(tmp_path)
    with pytest.raises(SourceError, match="no such file"):
        compile_sketch(tmp_path / "nothing")
    for name in ("blink", "adapters"):
        (tmp_path / name).symlink_to(CASES / name / name)
    with pytest.raises(UsageError, match="several sketches: adapters, blink"):
        compile_sketch(tmp_path)


def test_missing_tools_are_named_with_the_command_that_installs_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(MissingToolError, match="not installed: avr-gcc, avr-g\\+\\+") as caught:
        compiled("blink")
    assert caught.value.exit_code == 4
    assert (caught.value.fix or "").startswith("sudo apt install gcc-avr binutils-avr")


def test_a_missing_core_is_named_with_its_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_CORE", str(tmp_path))
    with pytest.raises(MissingToolError, match="names a folder without Arduino AVR core"):
        compiled("blink")


def digest(folder: Path) -> dict[str, str]:
    """Every file of a folder with the digest of its content, and the time it was changed."""
    return {
        str(path.relative_to(folder)): f"{path.stat().st_mtime_ns} {hashlib.sha256(path.read_bytes()).hexdigest()}"
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


@needs_tools
def test_two_runs_say_the_same_and_leave_the_folder_as_it_was() -> None:
    before = digest(CASES)
    first, second = (json.dumps(compiled("servo").to_json() | {"seconds": 0}) for _ in range(2))
    assert first == second
    assert digest(CASES) == before


@needs_tools
def test_a_cache_that_cannot_be_written_is_no_obstacle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert compiled("servo").ok


@needs_tools
def test_the_core_is_compiled_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    compiled("blink")
    kept = digest(tmp_path)
    archives = [name.rpartition("/")[2] for name in kept if "/archives/" in name]
    checks = [name for name in kept if "/boards/" in name]  # the board's file held against the core, kept beside
    assert (len(kept), len(archives), len(checks)) == (2, 1, 1)
    assert archives[0].startswith("core-uno-")
    compiled("blink")
    assert digest(tmp_path) == kept


@needs_tools
def test_compiles_at_the_same_time_do_not_disturb_each_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With an empty cache all make the same archives. A regression: one was replaced while another compile linked with it."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    with ThreadPoolExecutor(4) as pool:
        reports = list(pool.map(lambda _: compiled("servo"), range(4)))
    assert [report.ok for report in reports] == [True] * 4
    assert sorted(path.name.partition("-")[0] for path in (tmp_path / "robosmi" / "archives").iterdir()) == ["Servo", "core"]


@needs_tools
def test_the_program_can_be_kept(tmp_path: Path) -> None:
    report = compile_sketch(CASES / "blink", keep=tmp_path)
    assert report.hex == tmp_path / "blink.hex"
    assert report.hex.read_text().startswith(":")
    assert report.elf == tmp_path / "blink.elf"
    assert report.elf.read_bytes().startswith(b"\x7fELF")


@needs_tools
def test_a_file_with_another_name_than_its_folder_is_a_warning(tmp_path: Path) -> None:
    (tmp_path / "robot.ino").write_bytes(b"\xef\xbb\xbfvoid setup() {}\r\nvoid loop() {}\r\n")
    assert [f.rule for f in compile_sketch(tmp_path).diagnostics] == ["RS808"]


def test_the_json_form_is_the_contract_s() -> None:
    report = CompileReport(True, True, "a", "a", "tool", 1, 2, 3, 4)
    wanted = {"ok", "fits", "fits_on", "tool", "flash_bytes", "ram_bytes", "libraries", "diagnostics"}
    assert wanted <= set(report.to_json())
    assert all(meaning for meaning in RULES.values())


@pytest.mark.parametrize(
    ("rule", "names"),
    [
        (r"x.o: a.h b.h", ["a.h", "b.h"]),
        ("x.o: a.h \\\n ../b.h\n", ["a.h", "../b.h"]),
        (r"x.o: a\ b.h c.h", ["a b.h", "c.h"]),
        ("x.o: a\\\tb.h c.h", ["a\tb.h", "c.h"]),
        (r"x.o: a\\\ b.h", [r"a\ b.h"]),
        (r"x.o: a\\ b.h", ["a\\", "b.h"]),
        (r"x.o: a\b.h", [r"a\b.h"]),
        (r"x.o: a\#b.h $$c.h", ["a#b.h", "$c.h"]),
    ],
)
def test_files_of_a_make_rule_have_their_own_names(rule: str, names: list[str]) -> None:
    assert read_files(rule) == names


@needs_tools
@pytest.mark.parametrize("precompiled", ["x.h.gch", "x.h.gch/c", "y.h.gch"])
def test_a_precompiled_header_elsewhere_is_refused(tmp_path: Path, precompiled: str) -> None:
    sketch, headers = tmp_path / "sketch", tmp_path / "headers"
    for folder in (sketch, headers):
        folder.mkdir()
    (sketch / "sketch.ino").write_text("void setup() {}\nvoid loop() {}\n")
    (sketch / "part.c").write_text('#define NAMED "../headers/x.h"\n#include NAMED\n')
    (headers / "x.h").write_text('#include "y.h"\n')
    (headers / "y.h").write_text("int y;\n")
    assert compile_sketch(sketch, "uno").ok
    (headers / precompiled).parent.mkdir(exist_ok=True)
    (headers / precompiled).write_bytes(b"gpch")
    with pytest.raises(SourceError, match="a precompiled header"):
        compile_sketch(sketch, "uno")
