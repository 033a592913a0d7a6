"""Files and names as Windows, its editors and its spreadsheets write them; and one path where the API takes several."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi import inputs
from robosmi.errors import SourceError
from robosmi.model.table import TableModel
from robosmi.project import load_project
from robosmi.transformations.chains.stages.program import sketch_name_of
from robosmi.transformations.t2m.c_source.side_file import read_side
from robosmi.transformations.t2m.pin_table import read_circuit, recognises
from tests.running import run

PROGRAM = '#include "simpletools.h"\nint main() { high(3); }\n'


@pytest.mark.parametrize(
    ("file", "name"),
    [
        ("blink.c", "blink"),
        ("con.c", "sketch_con"),
        ("COM1.c", "sketch_COM1"),
        ("Lpt9.cpp", "sketch_Lpt9"),
        ("com10.c", "com10"),
        ("console.c", "console"),
        (f"{'c' * 64}.c", "c" * 63),
        (f"_{'c' * 60}.c", f"sketch__{'c' * 55}"),
    ],
)
def test_the_name_of_a_sketch_is_one_that_the_ide_and_windows_take(file: str, name: str) -> None:
    assert sketch_name_of(Path(file)) == name


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-32"])
def test_settings_are_read_in_the_encoding_of_their_byte_order_mark(encoding: str, tmp_path: Path) -> None:
    (tmp_path / "robosmi.toml").write_bytes('[migrate]\r\ntarget = "uno"\r\n'.encode(encoding))
    assert load_project(tmp_path).target == "uno"
    (tmp_path / "a.c").write_text(PROGRAM)
    (tmp_path / "a.side").write_bytes(b"a.c\n>compiler=C\n".decode().encode(encoding))
    assert read_side(str(tmp_path / "a.side")).sources == [str(tmp_path / "a.c")]


def test_settings_in_no_known_encoding_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.side").write_bytes(b"a.c\n\xfc.c\n")
    with pytest.raises(SourceError, match="not UTF-8") as caught:
        read_side(str(tmp_path / "a.side"))
    assert "codec" not in caught.value.message


def test_a_source_keeps_its_bytes(tmp_path: Path) -> None:
    (tmp_path / "a.c").write_bytes(b"\xef\xbb\xbfint a;")
    assert inputs.read_text(tmp_path / "a.c", inputs.SOURCE) == "\ufeffint a;"


def test_backslashes_between_folders(tmp_path: Path) -> None:
    for folder in ("sub", "inc"):
        (tmp_path / folder).mkdir()
    (tmp_path / "sub" / "hw.csv").write_text("pin,part\nD2,Red LED\n")
    (tmp_path / "robosmi.toml").write_text("[migrate]\nhardware = 'sub\\hw.csv'\n")
    assert load_project(tmp_path).hardware == tmp_path / "sub" / "hw.csv"
    (tmp_path / "sub" / "a.c").write_text(PROGRAM)
    (tmp_path / "a.side").write_text("sub\\a.c\n-I .\\inc\n")
    project = read_side(str(tmp_path / "a.side"))
    assert (project.sources, project.include_dirs) == ([str(tmp_path / "sub" / "a.c")], [str(tmp_path / "inc")])


def test_a_file_whose_name_has_a_backslash_is_that_file(tmp_path: Path) -> None:
    (tmp_path / "sub\\hw.csv").write_text("pin,part\nD2,Red LED\n")
    (tmp_path / "robosmi.toml").write_text("[migrate]\nhardware = 'sub\\hw.csv'\n")
    assert load_project(tmp_path).hardware == tmp_path / "sub\\hw.csv"


@pytest.mark.parametrize(
    ("line", "separator"), [("sep=;", ";"), ('"sep=,"', ","), ("SEP=\t", "\t"), ("sep=|", "|"), ("sep=;;", ";")]
)
def test_a_table_that_says_its_separator(line: str, separator: str, tmp_path: Path) -> None:
    table = tmp_path / "pins.csv"
    table.write_bytes("\r\n".join([line, f"pin{separator}part", f"D2{separator}Red LED", f"D3{separator}", ""]).encode())
    assert recognises(table.read_bytes()) or separator == "|"
    with pytest.raises(SourceError) as caught:
        read_circuit(table)
    assert caught.value.location is not None
    assert caught.value.location.line == 4
    table.write_bytes("\r\n".join([line, f"pin{separator}part", f"D2{separator}Red LED", ""]).encode())
    done = run("hardware", table, "--json")
    assert [m["pin"] for m in done.result["mappings"]] == ["D2"]


def test_a_model_of_rows_keeps_the_line_that_says_the_separator(tmp_path: Path) -> None:
    path = tmp_path / "books.csv"
    path.write_bytes(b"sep=;\r\ntitle;pages\r\nGears;3\r\n")
    model = TableModel.load(path)
    assert [row.title for row in model.all_contents()] == ["Gears"]
    model.save()
    assert path.read_bytes() == b"sep=;\r\ntitle;pages\r\nGears;3\r\n"


def test_one_path_stands_for_a_list_of_one(tmp_path: Path) -> None:
    (tmp_path / "p.c").write_text(PROGRAM)
    (tmp_path / "hw.csv").write_text("pin,part\nD2,Red LED\n")
    alone: Any = {"include_dirs": tmp_path, "defines": "NAME=1"}  # which type checkers refuse
    one = robosmi.plan_migration(str(tmp_path / "p.c"), hardware=tmp_path / "hw.csv", **alone)
    several = robosmi.plan_migration(
        [tmp_path / "p.c"], hardware=tmp_path / "hw.csv", include_dirs=[tmp_path], defines=["NAME=1"]
    )
    assert [len(list(each.plan.eAllContents())) for each in (one, several)] == [len(list(one.plan.eAllContents()))] * 2
    assert len(robosmi.load_code([tmp_path / "p.c"]).units) == 1  # type: ignore[arg-type]
