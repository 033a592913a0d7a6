"""The form of a file, its byte order mark and line ends, survives whatever becomes of its text."""

from __future__ import annotations

import codecs

import pytest

from robosmi.files.files import digest
from robosmi.generate.text_form import has_digest, read, same_text

FORMS = [
    b"", b"a", b"a\n", b"a\nb", b"a\r\nb\r\n", b"a\r\nb", b"a\rb\r", b"a\r\nb\nc\rd", b"\n\r\n\r", b"a\r\r\nb\n",
    codecs.BOM_UTF8, codecs.BOM_UTF8 + b"a\r\nb", "Größe\r\nΩ\n".encode(), b"\ta \t\r\n\n\n",
]  # fmt: skip


@pytest.mark.parametrize("data", FORMS, ids=repr)
def test_a_text_that_nobody_changed_is_written_byte_for_byte(data: bytes) -> None:
    file = read(data)
    assert "\r" not in file.text
    assert file.written(file.text) == data


@pytest.mark.parametrize(
    ("data", "text", "expected"),
    [
        (b"a\r\nb\r\n", "a\nx\nb\n", b"a\r\nx\r\nb\r\n"),
        (b"a\r\nb\r\n", "x", b"x"),
        (b"a\rb\r", "b\na\n", b"b\ra\r"),
        (b"a\r\nb\nc\r\n", "new\na\nb\nc\n", b"new\r\na\r\nb\nc\r\n"),
        (b"a\nb\r\nc\n", "b\nnew\n", b"b\r\nnew\n"),
        (b"a\nb\r\nc\nd\n", "c\nd\nb\na\n", b"c\nd\nb\r\na\n"),
        (b"a\r\nb\nc\r\nlast", "a\nb\nc\nlast\nmore\n", b"a\r\nb\nc\r\nlast\r\nmore\r\n"),
        (codecs.BOM_UTF8 + b"a\n", "b\n", codecs.BOM_UTF8 + b"b\n"),
        (b"", "a\nb\n", b"a\nb\n"),
        (b"one line", "a\nb\n", b"a\nb\n"),
    ],
)
def test_a_new_text_has_the_form_of_the_file(data: bytes, text: str, expected: bytes) -> None:
    assert read(data).written(text) == expected


def test_bytes_of_another_encoding_go_through_unchanged() -> None:
    data = "// größer\r\nx\r\n".encode("latin-1")
    with pytest.raises(UnicodeDecodeError):
        read(data)
    file = read(data, errors="surrogateescape")
    assert file.written("y\n" + file.text) == b"y\r\n" + data


def test_a_text_that_is_read_as_it_is_keeps_its_carriage_returns_in_the_text() -> None:
    file = read(codecs.BOM_UTF8 + b"a\r\nb\rc\n", as_it_is=True)
    assert file.text == "a\r\nb\rc\n"
    assert file.written("x\r\ny\n") == codecs.BOM_UTF8 + b"x\r\ny\n"


def test_the_same_text_in_another_form_is_known_as_the_same() -> None:
    made = b"a\nb\n"
    for form in (made, b"a\r\nb\r\n", codecs.BOM_UTF8 + b"a\nb\r\n"):
        assert same_text(form, made)
        assert has_digest(form, digest(made))
    for other in (b"a\nb", b"a\nb\n\n", b"a \nb\n", b"\xff"):
        assert not same_text(other, made)
        assert not has_digest(other, digest(made))
    assert not same_text(made, None)
