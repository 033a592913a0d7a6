"""CSV files as a model: types of columns, names, dialects, and lines that do not fit."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import ModelError, SourceError
from robosmi.model.table import TableModel

CASE = Path(__file__).parent / "drivers" / "cases" / "rows"


def test_columns_are_texts_unless_a_type_is_given() -> None:
    plain, typed = TableModel.load(CASE / "books.csv"), TableModel.load(CASE / "books.csv", types={"pages": int})
    assert [row.pages for row in plain.books.all] == ["120", "90", "48"]
    assert sum(row.pages for row in typed.books.all) == 258
    typed.books.all[0].pages = 7
    with pytest.raises(ModelError, match=r"books\.pages does not take 'x'"):
        typed.books.all[0].pages = "x"
    assert typed.books(title="new").pages is None


def test_a_column_with_a_space_has_a_python_name_too() -> None:
    ben = TableModel.load(CASE / "authors.csv").authors.all[1]
    assert ben.Full_Name == getattr(ben, "Full Name") == 'Ben "B" Bolt, Jr.'
    ben.Full_Name = "B"
    assert getattr(ben, "Full Name") == "B"


def test_delimiter_line_ends_and_quotes_are_kept(tmp_path: Path) -> None:
    content = b'a;b\r\n1;"x;y"\r\n2;"two\r\nlines"\r\n'
    (tmp_path / "t.csv").write_bytes(content)
    model = TableModel.load(tmp_path / "t.csv")
    assert [row.b for row in model.t.all] == ["x;y", "two\r\nlines"]
    model.save()
    assert (tmp_path / "t.csv").read_bytes() == content


def test_a_folder_is_a_model_of_several_tables(tmp_path: Path) -> None:
    model = TableModel.load(CASE)
    assert model.type_names() == ["authors", "books"]
    assert [type(row).__name__ for row in model.all_contents()] == ["authors"] * 2 + ["books"] * 3
    (tmp_path / "one.csv").write_text("a\n")
    with pytest.raises(ModelError, match="has 2 tables"):
        model.save(tmp_path / "one.csv")


@pytest.mark.parametrize(
    ("content", "line", "said"),
    [
        (b"", None, "no line with the names"),
        (b"a,b\n1,2\n1\n1,2,3\n", None, "line 3 has 1 cell instead of 2; line 4 has 3 cells instead of 2"),
        (b"a,a\n", 1, "a column has no name"),
        (b"a,\n", 1, "a column has no name"),
        (b"a,b\n1,\xff\n", 2, "no UTF-8"),
        (b'a,b\n"1,2\n', 2, "no CSV"),
        (b'a,b\n"1"x,2\n', 2, "no CSV"),
    ],
)
def test_lines_that_do_not_fit_are_said_together(content: bytes, line: int | None, said: str, tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_bytes(content)
    with pytest.raises(SourceError, match=said) as caught:
        TableModel.load(file)
    assert caught.value.location is not None
    assert caught.value.location.line == line


def test_a_cell_that_does_not_fit_its_type_is_said_with_its_line() -> None:
    with pytest.raises(SourceError, match="line 2: 'Gears' does not fit the column title; line 3"):
        TableModel.load(CASE / "books.csv", types={"title": int})


def test_an_empty_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="holds no CSV file") as raised:
        TableModel.load(tmp_path)
    assert raised.value.fix == "give another folder"


def test_a_folder_of_models_names_them(tmp_path: Path) -> None:
    (tmp_path / "models").mkdir()
    (tmp_path / "models" / "plan.xmi").write_text("")
    with pytest.raises(SourceError, match="holds no CSV file") as raised:
        TableModel.load(tmp_path)
    assert raised.value.fix == f"give one of its models: {tmp_path / 'models' / 'plan.xmi'}"
