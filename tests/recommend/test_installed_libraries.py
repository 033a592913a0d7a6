"""Folders of installed libraries: what is read, what is left out and why; the user's index beside the shipped one."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.recommend.component import ComponentQuery
from robosmi.transformations.chains.libraries import import_libraries
from robosmi.transformations.m2m.library_ranking import device_ranker, libraries_by_header, library_by_name, library_index
from robosmi.transformations.t2m.installed_libraries import read_libraries

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
    assert skipped["link"] == "it is a link to a folder that was read before"
    assert "was read before" in skipped["twice"]
    assert set(skipped) == {"no_headers", "ring", "link", "twice"}


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
