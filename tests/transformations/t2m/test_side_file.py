"""Project files of SimpleIDE: the sources, folders, macros and libraries of a program, found beside it or given."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import SourceError
from robosmi.transformations.t2m.c_source.side_file import read_side
from tests.running import run

FOLDER = Path(__file__).parent / "side"


def test_what_a_project_file_says() -> None:
    made = read_side(str(FOLDER / "robot" / "robot.side"))
    names = [Path(source).relative_to(FOLDER).as_posix() for source in made.sources]
    assert names == ["robot/robot.c", "robot/eyes.c", "libturn/turn.c"], "a library's first file only tries it out"
    assert [Path(folder).name for folder in made.include_dirs] == ["include", "libturn"]
    assert made.defines == ["NEAR=5"]
    said = [(f.rule, f.message, f.location.line if f.location else 0) for f in made.findings]
    assert said == [
        ("RS112", "'eyes.spin' was left out: it is not C", 4),
        ("RS112", "'gone.c' was left out: no such file", 5),
    ]


@pytest.mark.parametrize("given", ["robot.c", "robot.side"])
def test_the_whole_program_is_moved(given: str, tmp_path: Path) -> None:
    made = robosmi.migrate([FOLDER / "robot" / given], tmp_path / "out")
    files = sorted(path.name for path in made.sketch.iterdir() if path.suffix in (".ino", ".cpp", ".h"))
    assert files == ["adapters.h", "eyes.cpp", "eyes.h", "robot.ino", "settings.h", "turn.cpp", "turn.h"]
    rules = [f.rule for f in made.models.plan.findings]
    assert rules.count("RS112") == 2


def test_a_project_file_that_does_not_list_the_source_is_another_programs(tmp_path: Path) -> None:
    shutil.copy(FOLDER / "libturn" / "libturn.c", tmp_path / "other.c")
    (tmp_path / "other.side").write_text("robot.c\n>compiler=C\n")
    (tmp_path / "turn.h").write_text("void turn(int degrees);\n")
    made = robosmi.migrate([tmp_path / "other.c"], tmp_path / "out")
    assert [unit.path for unit in made.models.program.units] == ["source/other.c", "source/turn.h"]


def test_headers_beside_the_archives_of_libraries_are_found(tmp_path: Path) -> None:
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "eyes.h").write_text("int eyes_see(int side);\n")
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "robot.c").write_text('#include "eyes.h"\nint main() { return eyes_see(1); }\n')
    (tmp_path / "src" / "robot.side").write_text("robot.c\n-I ./\n-L ./../lib\n>linker::-leyes\n")
    made = robosmi.migrate([tmp_path / "src" / "robot.c"], tmp_path / "out")
    assert "int32_t eyes_see(int32_t side)" in (made.sketch / "eyes.h").read_text()
    assert "RS103" not in [f.rule for f in made.models.plan.findings]


def test_several_files_that_are_given_are_the_program(tmp_path: Path) -> None:
    files = [FOLDER / "robot" / "robot.c", FOLDER / "robot" / "eyes.c"]
    made = robosmi.migrate(files, tmp_path / "out", include_dirs=[FOLDER / "include", FOLDER / "libturn"])
    assert "source/turn.c" not in [unit.path for unit in made.models.program.units]


@pytest.mark.parametrize(
    ("text", "said"),
    [(b">compiler=C\n", "lists no C source"), (b"\xff\xfe\x00", "cannot be read")],
)
def test_a_project_file_of_no_use_is_refused(text: bytes, said: str, tmp_path: Path) -> None:
    (tmp_path / "empty.side").write_bytes(text)
    with pytest.raises(SourceError, match=said):
        robosmi.migrate([tmp_path / "empty.side"], tmp_path / "out")


def test_a_project_file_is_analysed_as_what_it_lists() -> None:
    found = run("analyse", FOLDER / "robot" / "robot.side", "--json").document["result"]["units"]
    listed = read_side(str(FOLDER / "robot" / "robot.side")).sources
    assert [unit["path"] for unit in found] == listed
