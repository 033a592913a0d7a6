"""Programs for the Raspberry Pi Pico: by the core that stands in for its own, and by its own where that is installed."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.base.data_text import as_texts
from robosmi.errors import SourceError
from robosmi.transformations.knowledge.cores.core_folders import BoardName, find_core
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.compiled_program import compile_into
from robosmi.verify.toolchains.toolchain import compile_sketch
from robosmi.verify.uploads.upload import upload_sketch
from tests.running import run
from tests.tools import require_tools

CASES = Path(__file__).parent / "cases"
ALL = CASES / "all_of_the_pico"
PICO = BoardName("rp2040", "rp2040", "rpipico")
TOOLS = ("arm-none-eabi-gcc", "arm-none-eabi-g++")


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where this run keeps the archives of cores."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(autouse=True)
def home(tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home without installed cores."""
    home = tmp_path / "home"
    home.mkdir()
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    for name in ("ROBOSMI_CORE", "ROBOSMI_LIBRARIES"):
        monkeypatch.delenv(name, raising=False)
    return home


def compiled(board: str, sketch: Path = ALL) -> CompileReport:
    require_tools(*TOOLS)
    report = compile_sketch(sketch, board)
    assert report.ok, "\n".join(str(finding) for finding in report.diagnostics)
    return report


def test_the_stand_in_has_what_sketches_and_libraries_take_of_a_core() -> None:
    report = compiled("pico")
    assert [(finding.rule, finding.evidence) for finding in report.diagnostics] == [("RS806", {"core": "rp2040:rp2040"})]
    assert report.fits
    assert report.stand_in_core == "rp2040:rp2040"
    assert {library.source for library in report.libraries} == {"stand-in"}
    assert 10_000 < (report.flash_bytes or 0) < 100_000
    assert (report.flash_limit, report.ram_limit) == (2_093_056, 262_144)
    assert report.commands
    assert all("--target=arm-none-eabi" in as_texts(entry["arguments"]) for entry in report.commands)


@pytest.mark.parametrize("board", ["picow", "rp2040:rp2040:rpipicow", "rp2040:rp2040:rpipicow:freq=125"])
def test_a_board_with_data_is_known_by_its_full_name_and_options(board: str) -> None:
    report = compiled(board, CASES / "blink")
    assert report.board == "picow"
    assert [finding.rule for finding in report.diagnostics] == ["RS806"]


def test_the_command_names_the_stand_in_and_a_folder_that_is_no_core(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_tools(*TOOLS)
    outcome = run("compile", CASES / "blink", "--board", "pico", "-o", tmp_path / "made", "--json")
    assert outcome.code == 0
    assert outcome.document["result"]["stand_in_core"] == "rp2040:rp2040"
    monkeypatch.setenv("ROBOSMI_CORE", str(tmp_path))
    outcome = run("compile", CASES / "blink", "--board", "pico", "-o", tmp_path / "made")
    assert "stand-in" in outcome.out
    assert f"'rp2040:rp2040' is not installed ({tmp_path} has no boards.txt)" in outcome.out + outcome.err


def test_a_header_that_a_library_takes_of_the_core_is_no_library_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    require_tools(*TOOLS)
    for name, text in (("strips/Strips.h", "hardware/pio.h"), ("lit/lit.ino", "Strips.h")):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text(f"#include <{text}>\n")
    monkeypatch.setenv("ROBOSMI_LIBRARIES", str(tmp_path))
    missing = next(finding for finding in compile_sketch(tmp_path / "lit", "pico").diagnostics if finding.rule == "RS803")
    assert missing.fix is not None
    assert missing.fix.startswith("install the core")


def test_no_program_with_the_stand_in_goes_on_a_board(tmp_path: Path) -> None:
    require_tools(*TOOLS)
    made = tmp_path / "made"
    made.mkdir()
    compile_into(CASES / "blink", "pico", into=made)
    with pytest.raises(SourceError, match="rp2040:rp2040"):
        upload_sketch(CASES / "blink", "/dev/none", kept_in=made)


def test_an_installed_core_goes_before_the_stand_in(home: Path) -> None:
    assert find_core(PICO).stand_in
    place = home / ".arduino15" / "packages" / "rp2040" / "hardware" / "rp2040" / "4.0.0"
    shutil.copytree(CASES / "cores" / "toy", place)
    found = find_core(PICO)
    assert (found.stand_in, found.folder) == (False, place)


def test_without_its_compiler_the_cause_is_named(monkeypatch: pytest.MonkeyPatch, home: Path) -> None:
    monkeypatch.setenv("PATH", str(home))
    outcome = run("compile", CASES / "blink", "--board", "pico", "-o", home / "made")
    assert outcome.code == 4
    assert "arm-none-eabi" in outcome.err
    assert "gcc-arm-none-eabi" in outcome.err
