"""What a compiler would take from names of files and from its environment has no effect on what it does."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.verify.toolchains.sketch import check_inside
from robosmi.verify.toolchains.toolchain_data import load_toolchains
from robosmi.verify.toolchains.tools import environment
from tests.running import run
from tests.tools import require_tools

MORE = 'int more; /* "-wrapper" "sh,-c,echo > {}" -x c++ s.ino */\n'
"""C++ that is also a list of options for gcc, which would run a command."""


@pytest.fixture
def sketch(tmp_path: Path) -> Path:
    folder = tmp_path / "s"
    folder.mkdir()
    (folder / "s.ino").write_text("void setup() {}\nvoid loop() {}\n")
    return folder


@pytest.mark.processes
@pytest.mark.parametrize("name", ["@more.cpp", "-specs=more.cpp", "-fplugin=more.c", "src/@more.cpp", "@more.ino", "-more.S"])
def test_a_file_that_a_compiler_takes_for_options_is_refused(name: str, sketch: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    reached = tmp_path / "reached"
    (sketch / "src").mkdir()
    for place in ("more.cpp", "src/more.cpp", name):
        (sketch / place).write_text(MORE.format(reached))
    outcome = run("compile", sketch, "--json")
    (finding,) = outcome.document["findings"]
    assert (outcome.code, finding["location"]["path"]) == (3, str(sketch / name))
    assert not reached.exists()


def test_such_files_of_a_program_get_other_names(tmp_path: Path) -> None:
    program = tmp_path / "program"
    program.mkdir()
    (program / "main.c").write_text(
        '#include "simpletools.h"\nint one(void); int two(void);\nint main() { pause(one() + two()); }\n'
    )
    (program / "@more.c").write_text("int one(void) { return 1; }\n")
    (program / "-specs=more.c").write_text("int two(void) { return 2; }\n")
    assert run("migrate", program, "-o", tmp_path / "out").code == 0
    made = [path.name for path in (tmp_path / "out" / "main").iterdir()]
    assert {"_@more.cpp", "_-specs=more.cpp"} <= {*made}
    assert not any(name.startswith(("@", "-")) for name in made)


@pytest.mark.processes
def test_gcc_takes_nothing_from_its_environment(sketch: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    hostile = tmp_path / "hostile"
    hostile.mkdir()
    for tool in ("as", "ld", "cc1", "cc1plus", "collect2", "lto1"):
        (hostile / tool).write_text(f"#!/bin/sh\necho {tool} >> {hostile}/reached\nexit 1\n")
        (hostile / tool).chmod(0o755)
    for header in ("Arduino.h", "stdint.h", "avr/io.h"):
        (hostile / header).parent.mkdir(exist_ok=True)
        (hostile / header).write_text("#error taken from the environment\n")
    for library in ("libc.a", "libm.a", "libgcc.a"):
        (hostile / library).write_text("no archive\n")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for name in ("CPATH", "C_INCLUDE_PATH", "CPLUS_INCLUDE_PATH", "COMPILER_PATH", "LIBRARY_PATH", "LD_RUN_PATH"):
        monkeypatch.setenv(name, str(hostile))
    monkeypatch.setenv("GCC_EXEC_PREFIX", f"{hostile}{os.sep}")
    for name in ("DEPENDENCIES_OUTPUT", "SUNPRO_DEPENDENCIES"):
        monkeypatch.setenv(name, str(hostile / "reached"))
    monkeypatch.setenv("GCC_COMPARE_DEBUG", "-O3")
    outcome = run("compile", sketch, "--json")
    assert (outcome.code, outcome.document["findings"]) == (0, [])
    assert not (hostile / "reached").exists()


@pytest.mark.parametrize("name", ["CPATH", "COMPILER_PATH", "GCC_EXEC_PREFIX", "DEPENDENCIES_OUTPUT", "GCC_COMPARE_DEBUG"])
def test_every_toolchain_unsets_what_gcc_takes(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(name, "hostile")
    assert [t.name for t in load_toolchains() if name in environment(t)] == []


def test_a_record_that_is_a_pipe_stops_what_works_on_the_folder(tmp_path: Path) -> None:
    (tmp_path / "blink").mkdir()
    os.mkfifo(tmp_path / ".robosmi.json")
    with pytest.raises(SourceError, match="named pipe"):
        check_inside(tmp_path / "blink")
