"""Folders of installed libraries: what is read, what is left out and why; the user's index beside the shipped one."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.recommend.component import ComponentQuery
from robosmi.transformations.chains.libraries import import_libraries
from robosmi.transformations.knowledge.libraries.library_ranking import (
    device_ranker,
    libraries_by_header,
    library_api,
    library_by_name,
    library_index,
    unsuitable,
)
from robosmi.transformations.t2m.installed_libraries import read_libraries
from tests.running import run

LIBRARIES = Path(__file__).parent / "data" / "libraries"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A copy, in which links and rings may be made."""
    return Path(shutil.copytree(LIBRARIES, tmp_path / "libraries"))


@pytest.fixture(autouse=True)
def _own_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))


def test_what_is_read_of_a_library(folder: Path) -> None:
    rows = {row["name"]: row for row in read_libraries(folder).rows}
    assert set(rows) == {"plain", "Described Sensor", "broken", "Manifest", "latin"}
    described = rows["Described Sensor"]
    assert (described["version"], described["architectures"], described["main"]) == ("1.2.3", ["avr", "samd"], ["Described.h"])
    assert described["depends"] == ["Servo", "Plain (>=1.0)"]
    assert [header["file"] for header in described["headers"]] == ["Described.h", "inner.h"], "examples are no headers"
    assert described["headers"][0]["includes"] == ["Wire.h", "inner.h"]
    assert described["keyword_classes"] == ["DescribedSensor"]
    assert described["meta_terms"]["xyz123"] == 1
    manifest = rows["Manifest"]
    assert (manifest["version"], manifest["architectures"], manifest["depends"]) == ("0.1", ["avr"], ["Servo"])


def test_the_newest_of_several_versions_is_read(tmp_path: Path) -> None:
    for folder, version in (("a", "1.9.0"), ("b", "1.10.0"), ("c", "1.9.5")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "library.properties").write_text(f"name=Thing\nversion={version}\n")
        (tmp_path / folder / "Thing.h").write_text("class Thing {};\n")
    found = read_libraries(tmp_path)
    assert [row["version"] for row in found.rows] == ["1.10.0"]
    reason = f"the library 'Thing' is already read from {tmp_path / 'b'} in version 1.10.0"
    assert found.skipped == {str(tmp_path / name): reason for name in "ac"}


def test_comments_and_strings_are_counted_but_are_no_identifiers(folder: Path) -> None:
    header = next(row for row in read_libraries(folder).rows if row["name"] == "plain")["headers"][0]
    assert header["raw"]["robosense"] == header["raw"]["cm"] == 1
    assert {"read", "distance", "plain"} <= set(header["idents"])
    assert not {"robosense", "cm", "class", "int"} & set(header["idents"])


def test_what_is_left_out_is_named_with_the_reason(folder: Path) -> None:
    (folder / "ring").symlink_to(folder)
    (folder / "link").symlink_to(folder / "plain")
    (folder / "latin" / "gone.h").symlink_to(folder / "nowhere.h")
    skipped = {Path(path).name: reason for path, reason in read_libraries(folder).skipped.items()}
    assert skipped["no_headers"] == skipped["ring"] == "it has no header"
    assert skipped["link"].startswith("it is a link")
    assert "already read" in skipped["twice"]
    assert "names no library" in skipped["library.properties"]
    assert set(skipped) == {"no_headers", "ring", "link", "twice", "library.properties"}


def test_one_library_and_a_platformio_project(folder: Path, tmp_path: Path) -> None:
    assert [row["name"] for row in read_libraries(folder / "described").rows] == ["Described Sensor"]
    project = tmp_path / "project"
    shutil.copytree(folder / "plain", project / ".pio/libdeps/uno/plain")
    shutil.copytree(folder / "manifest", project / "lib/manifest")
    (project / "platformio.ini").touch()
    assert {row["name"] for row in read_libraries(project).rows} == {"plain", "Manifest"}
    with pytest.raises(SourceError, match="no such folder"):
        read_libraries(tmp_path / "absent")


def test_an_imported_library_is_found_marked_and_brings_its_dependencies(folder: Path) -> None:
    before = len(library_index())
    done = import_libraries(folder, "arduino")
    assert ("Described Sensor", "1.2.3") in done.added
    assert len(library_index()) == before + 5
    answer = device_ranker(architecture="avr").rank(ComponentQuery("1", "XYZ123 breakout"))
    assert (answer.candidates[0].library, answer.candidates[0].version) == ("Described Sensor", "1.2.3")
    assert "installed here" in answer.candidates[0].reasons
    assert library_by_name("Described Sensor").depends == ("Servo", "plain")
    assert [library.name for library in libraries_by_header("Described.h")] == ["Described Sensor"]


def test_registers_in_a_library_for_all_processors_bind_it_to_those_that_have_them() -> None:
    import_libraries(LIBRARIES.with_name("registers"), "arduino")
    assert library_by_name("Bare Registers").library.registers == ("TCCR1A", "DDRB", "TIMER1_COMPA_vect")
    assert library_by_name("Asks First").library.registers == ()
    assert "TCCR1A" in unsuitable("Bare Registers", "arduino", "rp2040")
    assert unsuitable("Bare Registers", "arduino", "avr") == unsuitable("Asks First", "arduino", "rp2040") == ""


def test_a_second_import_adds_and_replaces(folder: Path, tmp_path: Path) -> None:
    import_libraries(folder / "plain", "arduino")
    properties = folder / "described" / "library.properties"
    import_libraries(folder / "described", "arduino")
    properties.write_text(properties.read_text().replace("1.2.3", "2.0"))
    done = import_libraries(folder / "described", "arduino")
    assert done.known == 2
    assert library_by_name("Described Sensor").version == "2.0"
    done.index.with_suffix(".jsonl.gz").write_bytes(b"damaged")
    assert import_libraries(folder / "plain", "arduino").known == 1


def test_an_installed_library_hides_the_shipped_one_of_its_name(tmp_path: Path) -> None:
    mine = tmp_path / "mine" / "Servo"
    mine.mkdir(parents=True)
    (mine / "Servo.h").write_text("class Servo { void attach(int pin); };\n")
    (mine / "library.properties").write_text("name=Servo\nversion=99.0\narchitectures=avr\n")
    shipped = library_by_name("Servo")
    import_libraries(tmp_path / "mine", "arduino")
    index = library_index()
    own = library_by_name("Servo")
    assert (own.version, own.library.installed, shipped.library.installed) == ("99.0", True, False)
    assert index.copies[own.library.id] == index.copies[shipped.library.id]
    answer = device_ranker(architecture="avr").rank(ComponentQuery("1", "Basic Servo", family="Servo"))
    assert [c.version for c in answer.candidates if c.library == "Servo"] == ["99.0"]
    assert answer.candidates[0].library == "Servo"
    assert {index.header(number).library for number in index.postings("attach")[0]}.isdisjoint({shipped.library.id})


def test_what_an_installed_library_offers_is_read_from_its_headers(folder: Path) -> None:
    import_libraries(folder, "arduino")
    api = library_api("Described Sensor")
    assert [(header.file, header.include) for header in api.headers] == [("Described.h", "Described.h")], (
        "inner.h declares nothing"
    )
    assert [(each.name, each.bases) for each in api.classes] == [("DescribedSensor", ("Base",))]
    assert library_api("DHT sensor library").class_named("DHT") is not None, "shipped facts are there as before"


def test_headers_of_the_library_that_a_main_one_includes_count_and_no_others(tmp_path: Path) -> None:
    root = tmp_path / "mine" / "Deep" / "src"
    (root / "inner").mkdir(parents=True)
    long = "x" * 5000
    (root / "Deep.h").write_text(
        f'#include "inner/one.h"\n#include <Arduino.h>\n#include "../../../secret.h"\n#include "{long}"\n// #include "no.h"\n'
        '#include "a\0b.h"\n#include "loop.h"\nclass Deep : public One { public: void go(); };\n'
    )
    (root / "inner" / "one.h").write_text('#include "two.h"\n#include "Deep.h"\nclass One { public: void start(int n); };\n')
    (root / "inner" / "two.h").write_text("#define TWO 2\n")
    (root / "no.h").write_text("#define NO 1\n")
    (root / "loop.h").symlink_to(root / "loop.h")
    (tmp_path / "secret.h").write_text("#define SECRET 1\n")
    (root.parent / "library.properties").write_text("name=Deep\nversion=1\n")
    import_libraries(tmp_path / "mine", "arduino")
    api = library_api("Deep")
    assert [(h.file, h.include) for h in api.headers] == [("Deep.h", "Deep.h"), ("one.h", "Deep.h"), ("two.h", "Deep.h")]
    assert [method.signature for method in api.methods("Deep")] == ["void go()", "void start(int n)"]


def test_an_installed_library_offers_what_it_has_not_what_the_shipped_one_had(tmp_path: Path) -> None:
    mine = tmp_path / "mine" / "Servo"
    mine.mkdir(parents=True)
    (mine / "Servo.h").write_text("class Servo { public: void turn(int angle); };\n")
    assert "attach" in {method.name for method in library_api("Servo").methods("Servo")}
    import_libraries(tmp_path / "mine", "arduino")
    assert [method.name for method in library_api("Servo").methods("Servo")] == ["turn"]


@pytest.mark.parametrize(
    "text", ["class A {", "}}}", "#if X\n#if Y\nclass A { public: void f(", "\xff\xfe\0", "/* open", 'class A { public: "']
)
def test_a_header_that_is_damaged_gives_what_can_be_read(tmp_path: Path, text: str) -> None:
    mine = tmp_path / "mine" / "Torn"
    mine.mkdir(parents=True)
    (mine / "Torn.h").write_bytes(f"#define TORN 1\n{text}".encode("latin-1"))
    assert ("Torn", "") in import_libraries(tmp_path / "mine", "arduino").added
    assert library_api("Torn").headers[0].constants == {"TORN": "1"}


def _library(folder: Path, properties: bytes | None, header: str = "A.h") -> None:
    folder.mkdir(parents=True)
    (folder / header).write_text("class A { public: void a(); };\n")
    if properties is not None:
        (folder / "library.properties").write_bytes(properties)


def test_names_are_never_paths_or_sql(tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    _library(mine / "a", b"name=../../etc/passwd\nversion=../..\n")
    _library(mine / "b", b"name=x'); DROP TABLE library; --\nversion=1'; --\ndepends=', ; DROP, ../y\n")
    before = sorted(path for path in tmp_path.rglob("*") if "home" not in path.parts)
    done = import_libraries(mine, "arduino")
    assert done.added == [("../../etc/passwd", "../.."), ("x'); DROP TABLE library; --", "1'; --")]
    for name, version in done.added:
        assert library_by_name(name).version == version
        assert [method.name for method in library_api(name).methods("A")] == ["a"]
    assert sorted(path for path in tmp_path.rglob("*") if "home" not in path.parts) == before
    assert sorted(path.name for path in (tmp_path / "home").rglob("*") if path.is_file()) == [
        "installed.jsonl.gz", "installed.sqlite",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "properties",
    [bytes(range(256)) * 3, b"version=1\n", b"name=\nversion=1\n", "name=Wide\n".encode("utf-16"), b"name=" + b"L" * 1000],
)
def test_broken_properties_leave_the_name_of_the_folder(tmp_path: Path, properties: bytes) -> None:
    _library(tmp_path / "mine" / "Folder", properties)
    done = import_libraries(tmp_path / "mine", "arduino")
    assert [name for name, _ in done.added] == ["Folder"]
    assert list(done.skipped.values()) == ["it names no library; RoboSMi uses the folder's name"]


@pytest.mark.parametrize(
    "manifest", ["[1, 2]", "[" * 100_000, '{"name": "a\\nb \\ud800", "version": {"x": 1}, "headers": 5}', "{}"]
)
def test_broken_manifests(tmp_path: Path, manifest: str) -> None:
    _library(tmp_path / "mine" / "Folder", None)
    (tmp_path / "mine" / "Folder" / "library.json").write_text(manifest)
    ((name, _),) = import_libraries(tmp_path / "mine", "arduino").added
    assert name in ("Folder", "a b")


def test_one_name_that_cannot_be_kept_loses_no_other_library(tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    _library(mine / "Good", b"name=Good\n")
    _library(mine / "Line", b"name=Line\n", "a\nb.h")
    _library(mine / "Bytes", b"name=Bytes\n", os.fsdecode(b"\xff\xfe.h"))
    Path(os.fsdecode(bytes(mine) + b"/\xff\xfe")).mkdir()
    (mine / "round").symlink_to("round")
    (mine / "up").symlink_to("..")
    (mine / "Good" / "directory.h").mkdir()
    os.mkfifo(mine / "Good" / "pipe.h")
    done = import_libraries(mine, "arduino")
    assert done.added == [("Good", "")]
    assert sum("characters" in reason for reason in done.skipped.values()) == 2
    assert run("libraries", "import", mine, "--json").code == 0
    assert run("libraries", "import", mine).code == 0
