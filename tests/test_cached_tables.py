"""Tables of the platform repository that are kept between runs: what the file says now, and each caller has his own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

CODE = """
import sys
from pathlib import Path
from robosmi.base import data_text
read, made = data_text.toml_of, []
def counted(text):
    made.append(text)
    return read(text)
data_text.toml_of = counted
from robosmi.project import read_data
try:
    first, second = (read_data(Path(sys.argv[1])) for _ in range(2))
except Exception as error:
    print(error, len(made), sep="|", end="")
else:
    first["changed"] = True
    first.get("inner", {}).clear()
    print(second, read_data(Path(sys.argv[1])) == second, len(made), sep="|", end="")
"""


def said(path: Path) -> str:
    environment = {**os.environ, "XDG_CACHE_HOME": str(path.parent / "cache")}
    return subprocess.run(
        [sys.executable, "-c", CODE, str(path)], env=environment, capture_output=True, text=True, check=True
    ).stdout


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """A file with a table."""
    path = tmp_path / "table.toml"
    path.write_text('name = "a"\nnumbers = [1, 2.5, true]\n[inner]\nx = "\\u00e9"\n', encoding="utf-8")
    return path


VALUE = "{'name': 'a', 'numbers': [1, 2.5, True], 'inner': {'x': 'é'}}|True|"


def test_a_table_is_read_once_and_each_caller_has_his_own(table: Path) -> None:
    assert said(table) == VALUE + "1"
    assert said(table) == VALUE + "0"


def test_a_changed_file_is_read_again(table: Path) -> None:
    said(table)
    table.write_text('name = "b"\n', encoding="utf-8")
    assert said(table) == "{'name': 'b'}|True|1"


def test_a_date_is_not_kept_and_a_mistake_is_told_each_time(table: Path) -> None:
    table.write_text("day = 2026-11-23\n", encoding="utf-8")
    assert [said(table).rpartition("|")[2] for _ in range(2)] == ["3", "3"]
    table.write_text("day = \n", encoding="utf-8")
    assert "Invalid value (at line 1, column 7)" in said(table)
    assert [said(table).rpartition("|")[2] for _ in range(2)] == ["1", "1"]


def test_where_nothing_can_be_kept_the_file_is_read(table: Path) -> None:
    (table.parent / "cache").write_text("in the way", encoding="utf-8")
    assert said(table) == said(table) == VALUE + "1"
