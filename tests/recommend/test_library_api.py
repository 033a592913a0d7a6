"""What libraries offer: kept in the index in one spelling, read when asked for, and shown; the shipped facts and damaged ones."""

from __future__ import annotations

import gzip
import json
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError, SourceError, UsageError
from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.library_api import ApiClass, ApiFunction, HeaderApi, LibraryApi, packed, unpacked
from robosmi.transformations.knowledge.libraries.library_ranking import library_api
from robosmi.transformations.t2m.library_index import build
from tests.running import run

DATA = Path(__file__).parent / "data"


@pytest.fixture
def api_facts(tmp_path: Path) -> Path:
    """What the headers of the tiny libraries declare, as the builder wants it."""
    path = tmp_path / "api.jsonl.gz"
    path.write_bytes(gzip.compress((DATA / "tiny_api.jsonl").read_bytes()))
    return path


@pytest.fixture
def with_api(tiny_facts: Path, api_facts: Path, tmp_path: Path) -> LibraryIndex:
    build(tiny_facts, tmp_path / "api.sqlite", api_facts)
    return LibraryIndex(tmp_path / "api.sqlite")


def _of(index: LibraryIndex, name: str) -> LibraryApi:
    library = index.library_named(name)
    assert library is not None
    return LibraryApi(library.name, library.version, index.api(library.id))


def test_what_an_index_keeps(with_api: LibraryIndex) -> None:
    (header,) = _of(with_api, "Servo").headers
    servo = header.classes[0]
    assert servo == ApiClass(
        "Servo",
        "class",
        ("Motor<int, char>", "tools::Part"),
        ("()",),
        (
            ApiFunction("attach", "(int pin)", "uint8_t"),
            ApiFunction("find", "(const char *name, uint8_t &size)", "const Servo *", static=True),
            ApiFunction("operator bool", "() const"),
            ApiFunction("state", "()", "enum State"),
        ),
    )
    assert [method.signature for method in servo.methods] == [
        "uint8_t attach(int pin)", "static const Servo *find(const char *name, uint8_t &size)", "operator bool() const",
        "enum State state()",
    ]  # fmt: skip
    assert header.functions == (ApiFunction("turn", "(int a=1)", "void"),)
    assert header.constants == {"END": '"\\n"', "MOST": "12"}
    assert header.enums == {"State": ("ON", "OFF"), "": ("X",)}
    assert _of(with_api, "Base").headers == ()


def test_methods_with_those_that_are_inherited(with_api: LibraryIndex) -> None:
    api = _of(with_api, "Servo")
    assert [method.name for method in api.methods("Servo")] == ["attach", "find", "operator bool", "state", "weight"]
    assert [method.parameters for method in api.methods("Part") if method.name == "attach"] == ["(long pin)"], "a ring of bases"
    assert api.methods("Nobody") == []
    assert api.class_named("Part") is api.class_named("tools::Part")


def test_same_facts_same_bytes(tiny_facts: Path, api_facts: Path, with_api: LibraryIndex, tmp_path: Path) -> None:
    build(tiny_facts, tmp_path / "again.sqlite", api_facts)
    assert (tmp_path / "again.sqlite").read_bytes() == with_api.path.read_bytes()


def test_nobody_who_does_not_ask_reads_it(with_api: LibraryIndex) -> None:
    asked: list[str] = []
    with_api._db.set_trace_callback(asked.append)
    for number in range(len(with_api)):
        with_api.library(number)
    with_api.facts("servo"), with_api.postings("servo"), with_api.headers_named("Servo.h")
    assert asked
    assert not [sql for sql in asked if "api" in sql]


def test_an_index_without_it_knows_nothing(with_api: LibraryIndex) -> None:
    """Indexes that were made before have no such table."""
    with closing(sqlite3.connect(with_api.path)) as db:
        db.executescript("DROP TABLE api; VACUUM")
    old = LibraryIndex(with_api.path)
    assert _of(old, "Servo").headers == ()
    assert old.postings("servo") == with_api.postings("servo")


@pytest.mark.parametrize("blob", [b"", b"no zlib", packed([])[:4], b"x\x9c\x03\x00\x00\x00\x00\x01"])
def test_what_is_damaged_is_said(with_api: LibraryIndex, blob: bytes) -> None:
    with closing(sqlite3.connect(with_api.path)) as db:
        db.execute("UPDATE api SET headers = ?", (blob,))
        db.commit()
    with pytest.raises(PlatformDataError, match="what library 3 offers cannot be read"):
        _of(LibraryIndex(with_api.path), "Servo")


def test_packed_and_unpacked() -> None:
    headers = (HeaderApi("ä.h", "ä.h", constants={"A": '"é"'}), HeaderApi("b.h", "ä.h", enums={"": ("X", "Y")}))
    assert unpacked(packed(headers)) == headers
    assert unpacked(packed(())) == ()
    assert [bool(header) for header in (*headers, HeaderApi("c.h", "c.h"))] == [True, True, False]


@pytest.mark.parametrize(
    "line",
    [
        "{", "[]", '{"library": 5}', '{"library": "A"}',
        '{"library": "A", "header": "a.h", "main": "a.h", "classes": [5], "functions": [], "constants": {}, "enums": {}}',
        '{"library": "A", "header": "a.h", "main": "a.h", "classes": [], "functions": [["f"]], "constants": {}, "enums": {}}',
        '{"library": "A", "header": "a.h", "main": "a.h", "classes": [], "functions": [], "constants": [], "enums": {}}',
        '{"library": "A", "header": "a.h", "main": "a.h", "classes": [], "functions": [], "constants": {}, "enums": {"E": "X"}}',
    ],
)  # fmt: skip
def test_wrong_facts(tiny_facts: Path, tmp_path: Path, line: str) -> None:
    path = tmp_path / "wrong.gz"
    path.write_bytes(gzip.compress(f"{(DATA / 'tiny_api.jsonl').read_text().splitlines()[0]}\n{line}\n".encode()))
    with pytest.raises(SourceError, match="a header's declarations") as caught:
        build(tiny_facts, tmp_path / "index.sqlite", path)
    assert caught.value.location is not None
    assert caught.value.location.line == 2
    with pytest.raises(SourceError, match="cannot be read"):
        build(tiny_facts, tmp_path / "index.sqlite", tmp_path / "absent")
    assert not (tmp_path / "index.sqlite").exists()


def test_the_shipped_index_says_what_libraries_offer() -> None:
    dht = library_api("dht sensor library")
    assert (dht.library, [header.file for header in dht.headers]) == ("DHT sensor library", ["DHT.h"])
    assert "float readTemperature(bool S=false, bool force=false)" in [m.signature for m in dht.methods("DHT")]
    servo = library_api("Servo").class_named("Servo")
    assert servo is not None
    assert {"attach", "write", "writeMicroseconds", "read"} <= {method.name for method in servo.methods}
    with pytest.raises(UsageError, match="unknown library"):
        library_api("No such library")


def test_the_shipped_facts_are_those_of_the_source(shared_facts: Path) -> None:
    """Every class of the source is there, and every method but calls of macros (no type)."""
    with gzip.open(shared_facts / "api.jsonl.gz", "rt") as lines:
        rows = [json.loads(line) for line in lines]
    listed: dict[str, list[tuple[str, int]]] = {}
    for row in rows:
        for declared in row["classes"]:
            methods = {tuple(m) for m in declared["methods"] if m[2] or m[0].startswith("operator")}
            listed.setdefault(row["library"], []).append((declared["name"], len(methods)))
    wrong = [name for name, classes in listed.items() if classes != [(c.name, len(c.methods)) for c in library_api(name).classes]]
    assert wrong == []


def test_show() -> None:
    shown = run("libraries", "show", "DHT sensor library", "--json")
    assert shown.code == 0
    assert (shown.result["header"], shown.result["depends"]) == ("DHT.h", ["Adafruit Unified Sensor"])
    (header,) = shown.result["api"]
    assert header["classes"][0]["constructors"] == ["DHT(uint8_t pin, uint8_t type, uint8_t count=6)"]
    assert header["classes"][0]["methods"][1]["signature"] == "float readTemperature(bool S=false, bool force=false)"
    text = run("libraries", "show", "DHT sensor library").out
    assert "      float readHumidity(bool force=false)\n" in text
    missing = run("libraries", "show", "DHT.h")
    assert missing.code == 2
    assert "belongs to 'DHT sensor library'" in missing.err
