"""Boards of installed Arduino cores, built by the core's own recipes: a toy core for this machine, and Debian's AVR core."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from robosmi.errors import MissingToolError, PlatformDataError, RobosmiError, SourceError, UsageError
from robosmi.transformations.knowledge.cores.core_folders import (
    BoardName,
    architectures,
    find_core,
    installed_cores,
)
from robosmi.transformations.knowledge.cores.core_properties import expand, read_properties, split
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.compiled_program import compile_into
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_tools

CASES = Path(__file__).parent / "cases"
TOY = CASES / "cores" / "toy"
SKETCH = CASES / "for_a_core"


def printed(program: Path) -> str:
    """What a program for this machine prints."""
    program.chmod(0o755)
    return subprocess.run([program], capture_output=True, text=True, check=True).stdout


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home without cores, libraries and settings."""
    home = tmp_path / "home"
    home.mkdir()
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("XDG_CACHE_HOME", str(home / "cache"))
    for name in ("ROBOSMI_CORE", "ROBOSMI_LIBRARIES", "ROBOSMI_PATH", "ROBOSMI_HOME", "XDG_DATA_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(home)
    return home


def installed(home: Path, version: str = "1.2.3", vendor: str = "lab") -> Path:
    """The toy core in the place where Arduino CLI puts it."""
    return Path(shutil.copytree(TOY, home / ".arduino15" / "packages" / vendor / "hardware" / "toy" / version))


def compiled(board: str, keep: Path | None = None) -> CompileReport:
    require_tools("gcc", "g++", "ar", "size", "objcopy")
    return compile_sketch(SKETCH, board, keep=keep)


def test_a_program_is_built_by_the_recipes_hooks_and_menus_of_the_core(home: Path, tmp_path: Path) -> None:
    installed(home)
    report = compiled("lab:toy:host", keep=tmp_path)
    assert report.ok, report.diagnostics
    assert report.fits
    assert [finding.rule for finding in report.diagnostics] == ["RS811"]
    assert (report.flash_limit, report.ram_limit) == (4_000_000, 65_536)
    assert 100 < (report.flash_bytes or 0) < 100_000
    assert [(library.name, library.version) for library in report.libraries] == [("Lamp", "2.0.0")]
    assert report.elf is not None
    assert report.hex is not None
    assert report.hex.suffix == ".bin"
    assert printed(report.elf) == "10000000L TOY_HOST\n"


def test_options_of_menus_change_the_build(home: Path, tmp_path: Path) -> None:
    installed(home)
    report = compiled("lab:toy:host:speed=fast,heap=tiny", keep=tmp_path)
    assert report.ok
    assert report.fits is False
    assert "RS805" in [finding.rule for finding in report.diagnostics]
    assert report.ram_limit == 16
    assert report.elf is not None
    assert printed(report.elf) == "200000000L TOY_HOST\n"


def test_the_second_build_takes_the_core_from_the_cache(home: Path) -> None:
    installed(home)
    assert compiled("lab:toy:host").ok
    archives = sorted((home / "cache" / "robosmi" / "archives").glob("core-*"))
    assert len(archives) == 1
    assert compiled("lab:toy:host").ok
    assert sorted((home / "cache" / "robosmi" / "archives").glob("core-*")) == archives


@pytest.mark.parametrize(
    ("board", "error", "place", "says"),
    [
        ("lab:toy:hast", UsageError, "boards.txt", "hast"),
        ("lab:toy:host:speed=slew", UsageError, "boards.txt", "slow"),
        ("lab:toy:host:sped=slow", UsageError, "boards.txt", "speed"),
        ("lab:toy:host:speed", UsageError, None, "VENDOR"),
        ("lab:*:host", UsageError, None, "VENDOR"),
        ("lab:../toy:host", UsageError, None, "VENDOR"),
        ("..:toy:host", UsageError, None, "VENDOR"),
        ("lab:toy:broken", SourceError, "gone", "install"),
        ("lab:toy:strange", MissingToolError, None, "nobody:toy"),
        ("lab:other:host", MissingToolError, None, "lab:other"),
        ("nobody:toy:host", MissingToolError, None, "nobody:toy"),
    ],
)
def test_what_a_full_name_gets_wrong_is_said(
    home: Path, board: str, error: type[RobosmiError], place: str | None, says: str
) -> None:
    installed(home)
    with pytest.raises(error) as caught:
        compile_sketch(SKETCH, board)
    assert says in f"{caught.value.message} {caught.value.fix}"
    assert (caught.value.location is not None and Path(caught.value.location.path).name) == (place or False)


def test_a_board_that_a_project_file_names_is_refused_with_its_line(home: Path, tmp_path: Path) -> None:
    installed(home)
    sketch = Path(shutil.copytree(SKETCH, tmp_path / "moved")) / "for_a_core"
    (sketch / "sketch.yaml").write_text("# board\ndefault_fqbn: lab:toy:hast\n")
    with pytest.raises(SourceError) as caught:
        compile_sketch(sketch)
    assert caught.value.location is not None
    assert (Path(caught.value.location.path).name, caught.value.location.line) == ("sketch.yaml", 2)


@pytest.mark.parametrize(
    ("old", "new", "error", "says"),
    [
        ("{build.f_cpu}", "{build.clock}", PlatformDataError, "build.clock"),
        ("recipe.size.pattern", "recipe.length.pattern", PlatformDataError, "recipe.size.pattern"),
        ("recipe.cpp.o.pattern=", "recipe.cpp.o.pattern=\nx=", PlatformDataError, "no command in 'recipe.cpp.o.pattern'"),
        ("recipe.size.regex=", "recipe.size.regex=^nothing ([0-9]+)\nx=", PlatformDataError, "'recipe.size.regex'"),
        ("compiler.cpp.cmd=g++", "compiler.cpp.cmd=toy-g++", MissingToolError, "toy-g++"),
        ("compiler.cpp.cmd=g++", "compiler.cpp.name=g++", PlatformDataError, "{compiler.cpp.cmd}"),
        ("version=1.2.3", "version", SourceError, "key=value"),
    ],
)
def test_a_damaged_core_is_named_and_nothing_is_written(
    home: Path, tmp_path: Path, old: str, new: str, error: type[RobosmiError], says: str
) -> None:
    platform = installed(home) / "platform.txt"
    platform.write_text(platform.read_text().replace(old, new))
    keep = tmp_path / "kept"
    keep.mkdir()
    with pytest.raises(error) as caught:
        compiled("lab:toy:host", keep)
    assert says in caught.value.message
    assert not list(keep.iterdir())


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('"import shutil, sys; shutil.move(*sys.argv[1:])"', "\"raise SystemExit('no key')\"", "no key"),
        ("recipe.c.combine.pattern=", "recipe.c.combine.pattern=true\nx=", "makes no for_a_core.elf"),
    ],
)
def test_a_step_that_fails_ends_the_build_with_what_it_said(home: Path, old: str, new: str, says: str) -> None:
    platform = installed(home) / "platform.txt"
    platform.write_text(platform.read_text().replace(old, new))
    report = compiled("lab:toy:host")
    assert not report.ok
    assert any(says in finding.message for finding in report.diagnostics)


def test_a_missing_converter_leaves_the_program_and_says_so(home: Path, tmp_path: Path) -> None:
    platform = installed(home) / "platform.txt"
    platform.write_text(platform.read_text().replace('"{compiler.path}objcopy"', '"{compiler.path}toy-objcopy"'))
    report = compiled("lab:toy:host", tmp_path)
    assert report.ok
    assert report.elf is not None
    assert report.hex is None
    assert [finding.rule for finding in report.diagnostics] == ["RS811", "RS812"]


def test_a_program_without_a_file_for_the_board_is_kept_all_the_same(home: Path, tmp_path: Path) -> None:
    platform = installed(home) / "platform.txt"
    platform.write_text(platform.read_text().replace('"{compiler.path}objcopy"', '"{compiler.path}toy-objcopy"'))
    require_tools("gcc", "g++", "ar", "size")
    report = compile_into(SKETCH, "lab:toy:host", into=tmp_path / "build")
    assert report.elf == tmp_path / "build" / "for_a_core.elf"
    assert [path["kind"] for path in report.artifacts()] == ["elf", "compilation database"]
    assert all(Path(path["path"]).is_file() for path in report.artifacts())


@pytest.mark.parametrize(
    ("left_out", "ram", "file"), [("recipe.size.regex.data=", False, ".bin"), ("recipe.output.tmp_file=", True, "")]
)
def test_what_a_core_does_not_say_is_not_made_up(home: Path, tmp_path: Path, left_out: str, ram: bool, file: str) -> None:
    platform = installed(home) / "platform.txt"
    lines = platform.read_text().splitlines(keepends=True)
    platform.write_text("".join(line for line in lines if not line.startswith(left_out)))
    report = compiled("lab:toy:host", tmp_path)
    assert report.fits
    assert (report.ram_bytes is not None) is ram
    assert (report.hex.suffix if report.hex is not None else "") == file


def test_a_tool_that_only_an_argument_names_is_named_when_it_is_missing(home: Path) -> None:
    platform = installed(home) / "platform.txt"
    platform.write_text(platform.read_text().replace("-DF_CPU", '"-I{runtime.tools.toy-cmsis.path}/include" -DF_CPU'))
    with pytest.raises(MissingToolError, match="toy-cmsis"):
        compiled("lab:toy:host")


# ---- where cores are found


def test_the_newest_version_counts_and_its_own_vendor_only(home: Path) -> None:
    for version, vendor in (("1.10.0", "lab"), ("1.9.2", "lab"), ("3.0.0", "other")):
        installed(home, version, vendor)
    assert find_core(BoardName("lab", "toy", "host")).folder.name == "1.10.0"
    assert [core.folder.name for core in installed_cores("toy")] == ["3.0.0", "1.10.0", "1.9.2"]


def test_folders_of_the_environment_go_first_and_serve_their_architecture_only(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    installed(home)
    mine = Path(shutil.copytree(TOY, tmp_path / "mine"))
    other = Path(shutil.copytree(TOY, tmp_path / "hardware" / "lab" / "esp32"))
    monkeypatch.setenv("ROBOSMI_CORE", f"{other}:{mine}")
    assert find_core(BoardName("lab", "toy", "host")).folder == mine
    assert find_core(BoardName("lab", "esp32", "host")).folder == other
    assert (architectures(mine), architectures(other)) == ({"toy", "mine"}, {"esp32"})


def test_a_folder_that_is_no_core_is_named_with_what_it_lacks(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (installed(home) / "boards.txt").unlink()
    monkeypatch.setenv("ROBOSMI_CORE", f"{tmp_path}:{tmp_path / 'gone'}")
    with pytest.raises(MissingToolError) as caught:
        find_core(BoardName("lab", "toy", "host"))
    fix = caught.value.fix or ""
    assert f"correct ROBOSMI_CORE ({tmp_path} has no boards.txt, {tmp_path / 'gone'} is no folder)" in fix
    assert "install it again (" in fix
    assert "1.2.3 has no boards.txt): arduino-cli core install lab:toy" in fix


def test_a_core_of_another_architecture_does_not_hide_the_installed_one(monkeypatch: pytest.MonkeyPatch) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    monkeypatch.setenv("ROBOSMI_CORE", str(TOY))
    assert compile_sketch(CASES / "blink").ok


def test_a_board_of_the_avr_core_without_data_is_built_by_its_recipes() -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    report = compile_sketch(CASES / "blink", "arduino:avr:gemma")
    assert report.ok
    assert report.fits
    assert (report.board, report.flash_limit) == ("arduino:avr:gemma", 5310)


# ---- files of properties


def test_properties_of_this_system_replace_general_ones(tmp_path: Path) -> None:
    path = tmp_path / "platform.txt"
    path.write_text("# a\n\nname = A = B\ntool.cmd=x\ntool.cmd.linux=l\ntool.cmd.macosx=m\ntool.cmd.windows=w\n")
    found = read_properties(path)
    assert found["name"] == "A = B"
    assert found["tool.cmd"] in "lmw"
    assert read_properties(tmp_path / "none.txt") == {}


def test_names_in_names_are_expanded_and_unknown_ones_and_circles_end() -> None:
    properties = {"a": "{tool.{b}}", "b": "x", "tool.x": "found", "c": "{d}", "d": "{c}", "e": "{e}{e}"}
    assert expand("{a} {unknown}", properties) == "found {unknown}"
    assert expand("{c}", properties) in ("{c}", "{d}")
    assert len(expand("{e}", properties)) < 1_000_000


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('"/a b/gcc" -c "-DX=\\"y\\""  z', ["/a b/gcc", "-c", "-DX=\\", 'y\\""', "z"]),
        ('\'-DNAME="Raspberry Pi"\' -DB="b"', ['-DNAME="Raspberry Pi"', '-DB="b"']),
        ('  a "" b"c d', ["a", "", 'b"c', "d"]),
        ("", []),
    ],
)
def test_quotes_count_at_the_beginning_of_an_argument(text: str, words: list[str]) -> None:
    assert split(text) == words
