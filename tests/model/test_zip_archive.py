"""Archives that are made to burst: limits hold while unpacking, for every method."""

from __future__ import annotations

import io
import resource
import struct
import subprocess
import sys
import zipfile

import pytest

from robosmi.errors import SourceError
from robosmi.files.zip_archive import FREE_BYTES, MOST_RATIO, entries, unpacked

METHODS = [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA]
TEXT = b"".join(b"<wire number='%d'/>\n" % number for number in range(5000))


def archive(content: bytes, method: int, name: str = "a.txt") -> bytes:
    """An archive with one entry."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", method) as made:
        made.writestr(name, content)
    return stream.getvalue()


def read(data: bytes, most: int = 1 << 26) -> bytes:
    """The first entry's bytes."""
    return unpacked(data, entries(data, "a.zip", 10)[0], "a.zip", most)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("content", [TEXT, b"", b"x"])
def test_every_method_gives_what_was_packed(content: bytes, method: int) -> None:
    assert read(archive(content, method)) == content
    assert read(archive(content, method), len(content)) == content


@pytest.mark.parametrize("method", METHODS)
def test_a_byte_more_than_there_may_be_is_refused(method: int) -> None:
    with pytest.raises(SourceError, match="has more than"):
        read(archive(TEXT, method), len(TEXT) - 1)


@pytest.mark.parametrize("method", METHODS[1:])
def test_what_is_packed_too_tightly_is_refused(method: int) -> None:
    data = archive(b"\0" * (FREE_BYTES * 8), method)
    assert len(data) * MOST_RATIO < FREE_BYTES * 8
    with pytest.raises(SourceError, match=f"more than {MOST_RATIO} times"):
        read(data)


@pytest.mark.parametrize("method", METHODS[1:])
def test_a_bomb_takes_no_memory(method: int) -> None:
    """In a process of its own that may have 200 MB, of which the interpreter takes some."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", method) as made, made.open("a.txt", "w") as entry:
        for _ in range(150):
            entry.write(bytes(1 << 20))
    code = (
        "import sys\n"
        "from robosmi.files.zip_archive import entries, unpacked\n"
        "data = sys.stdin.buffer.read()\n"
        "try: unpacked(data, entries(data, 'a', 9)[0], 'a', 64 << 20)\n"
        "except Exception as error: print(type(error).__name__, error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], input=stream.getvalue(), capture_output=True, check=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (200 << 20, 200 << 20)),
    )  # fmt: skip
    assert done.stdout.startswith(b"SourceError")


def test_a_dictionary_larger_than_memory_is_not_made() -> None:
    data = bytearray(archive(TEXT, zipfile.ZIP_LZMA))
    head = data.index(struct.pack("<H", 5), 30 + len("a.txt"))
    struct.pack_into("<I", data, head + 3, 0xFFFF_FFFF)
    assert read(bytes(data)) == TEXT


def test_what_the_heads_say_is_not_believed() -> None:
    data = archive(TEXT, zipfile.ZIP_DEFLATED)
    listed = entries(data, "a.zip", 10)[0]
    listed.file_size = 3
    assert unpacked(data, listed, "a.zip", 1 << 20) == TEXT
    listed.header_offset = len(data) - 5
    with pytest.raises(zipfile.BadZipFile, match="outside"):
        unpacked(data, listed, "a.zip", 1 << 20)


@pytest.mark.parametrize("method", METHODS)
def test_a_damaged_entry_is_told_from_a_sound_one(method: int) -> None:
    data = bytearray(archive(TEXT, method))
    data[len(data) // 3] ^= 0x55
    with pytest.raises((zipfile.BadZipFile, SourceError)):
        read(bytes(data))


def test_a_method_that_is_not_known_is_named() -> None:
    data = bytearray(archive(TEXT, zipfile.ZIP_DEFLATED))
    struct.pack_into("<H", data, data.index(b"PK\x01\x02") + 10, 93)
    with pytest.raises(SourceError, match="packed by the method 93"):
        read(bytes(data))


def test_an_archive_in_an_archive_stays_packed() -> None:
    inner = archive(TEXT, zipfile.ZIP_DEFLATED)
    assert read(archive(inner, zipfile.ZIP_STORED)) == inner


def test_too_many_entries_are_refused_before_they_are_listed() -> None:
    with pytest.raises(SourceError, match="has 1 entries, more than 0"):
        entries(archive(b"", zipfile.ZIP_STORED), "a.zip", 0)
