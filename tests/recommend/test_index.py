"""The index file and its builder: what is kept, same bytes, damaged files, wrong facts."""

from __future__ import annotations

import gc
import gzip
import json
import sqlite3
import threading
import zlib
from pathlib import Path

import pytest

from robosmi import resources
from robosmi.errors import PlatformDataError, SourceError
from robosmi.recommend.index import LibraryIndex, is_named_like
from robosmi.transformations.t2m.library_index import build, main


def test_what_is_kept(tiny: LibraryIndex) -> None:
    assert tiny.names() == ["Base", "Base Sensor", "Motor Kit", "Servo", "Twins"]
    assert (len(tiny), tiny.documents) == (5, 7)
    kit = tiny.library_named("Motor Kit")
    assert kit is not None
    assert (kit.id, kit.version, kit.author, kit.copies, kit.origin) == (2, "1.0", "A. Person", 1, "a/kit@c0:lib")
    assert (kit.architectures, kit.depends, kit.main) == (("esp32",), ("Base (>=1.0)", "Nowhere"), ("MotorKit.h",))
    assert tiny.header(4).file == "inner.h"
    assert tiny.postings("servo") == ((4, 5), (4, 300))
    assert tiny.postings("absent") == ((), ())


def test_the_header_named_like_the_library_is_the_one(tiny: LibraryIndex) -> None:
    assert tiny.library(0).header == "Base.h"
    assert tiny.library(4).header == "alike.h"
    assert is_named_like("Adafruit_MCP4725.h", "Adafruit MCP4725")
    assert not is_named_like("DHT.h", "DHT sensor library")


def test_same_facts_same_bytes(tiny_facts: Path, tmp_path: Path) -> None:
    build(tiny_facts, tmp_path / "one" / "a.sqlite")
    build(tiny_facts, tmp_path / "b.sqlite")
    build(tiny_facts, tmp_path / "b.sqlite")
    assert (tmp_path / "one" / "a.sqlite").read_bytes() == (tmp_path / "b.sqlite").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["b.sqlite", "one", "tiny.jsonl.gz"], "nothing is left behind"


def test_the_shipped_index_is_what_the_facts_give(shared_facts: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.sqlite"
    assert build(shared_facts / "index.jsonl.gz", again, shared_facts / "api.jsonl.gz") == (1609, 3667)
    shipped = resources.built_in("platform_repo") / "arduino/libraries/index.sqlite"
    assert shipped.stat().st_size < 8_500_000
    if "ng" in zlib.ZLIB_RUNTIME_VERSION:
        pytest.skip("this Python compresses with zlib-ng, whose bytes differ from those of zlib")
    assert again.read_bytes() == shipped.read_bytes()


def test_no_addresses_of_people_are_shipped() -> None:
    index = LibraryIndex(resources.built_in("platform_repo") / "arduino/libraries/index.sqlite")
    authors = [index.library(number).author for number in range(len(index))]
    index.close()
    assert not [author for author in authors if "@" in author.replace(" @ ", "")]


def test_threads_share_an_index(tiny: LibraryIndex) -> None:
    found: list[int] = []
    threads = [threading.Thread(target=lambda: found.append(len(tiny.names()))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [5] * 4


@pytest.mark.parametrize("content", [None, b"", b"no database at all, but some text " * 40])
def test_damaged_index(tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "index.sqlite"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(PlatformDataError, match="index of libraries cannot be used"):
        LibraryIndex(path)


def test_a_cut_index_is_damaged(tiny: LibraryIndex, tmp_path: Path) -> None:
    path = tmp_path / "cut.sqlite"
    path.write_bytes(tiny.path.read_bytes()[:5000])
    with pytest.raises(PlatformDataError):
        LibraryIndex(path).names()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": ""}, "not a library with a name"),
        ({"main": []}, "has no main header"),
        ({"headers": [{"file": "a.h"}]}, "lacks file, main or raw"),
        ({"headers": [{"file": "a.h", "main": True, "raw": {"a": 0}}]}, "not a whole number above 0"),
    ],
)
def test_wrong_facts(tmp_path: Path, change: dict[str, object], message: str) -> None:
    good = {"name": "A", "main": ["a.h"], "headers": []}
    path = tmp_path / "facts.gz"
    path.write_bytes(gzip.compress(f"{json.dumps(good)}\n{json.dumps({**good, 'name': 'B', **change})}\n".encode()))
    with pytest.raises(SourceError, match=message) as caught:
        build(path, tmp_path / "index.sqlite")
    assert caught.value.location is not None
    assert caught.value.location.line == 2
    assert not (tmp_path / "index.sqlite").exists()


def test_command_line(tiny_facts: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(tiny_facts), str(tmp_path / "i.sqlite")]) == 0
    assert "5 libraries, 7 headers" in capsys.readouterr().out
    assert main([]) == 2
    (tmp_path / "twice.gz").write_bytes(gzip.compress(b'{"name": "A", "main": ["a.h"], "headers": []}\n' * 2))
    assert main([str(tmp_path / "twice.gz"), str(tmp_path / "x")]) == 3
    assert main([str(tmp_path / "absent"), str(tmp_path / "x")]) == 3
    (tmp_path / "text.gz").write_bytes(gzip.compress(b"{}\n{,"))
    assert main([str(tmp_path / "text.gz"), str(tmp_path / "x")]) == 3


def test_a_forgotten_index_closes_its_file(tiny_facts: Path, tmp_path: Path) -> None:
    """Python 3.13 warns of a connection that nobody closed."""
    build(tiny_facts, tmp_path / "own.sqlite")
    index = LibraryIndex(tmp_path / "own.sqlite")
    db = index._db
    del index
    gc.collect()
    with pytest.raises(sqlite3.ProgrammingError, match="closed"):
        db.execute("SELECT 1")


def test_libraries_that_are_read_at_once(tiny: LibraryIndex) -> None:
    assert tiny.libraries([3, 0, 3]) == [tiny.library(3), tiny.library(0), tiny.library(3)]
    assert tiny.libraries([]) == []
    with pytest.raises(PlatformDataError, match="library 99 is missing"):
        tiny.libraries([1, 99])


def test_libraries_are_read_again_when_there_were_many_others(tiny: LibraryIndex, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robosmi.recommend.index._REMEMBERED", 2)
    first = tiny.libraries([0, 1, 2])
    assert tiny.libraries([2, 3, 0])[::2] == [first[2], first[0]]


def test_how_many_libraries_have_a_word(tiny: LibraryIndex) -> None:
    words = [*tiny.terms_from("", 1000), "nobody has this"]
    expected = {word: found for word in words if (found := len(tiny.facts(word)[0]))}
    assert expected
    assert tiny.spread(words) == expected
