"""`robosmi libraries install`: from a zip file, a folder or the library manager; what is refused; the version in a sketch."""

from __future__ import annotations

import io
import shutil
import zipfile
from pathlib import Path

import pytest

from tests.running import run

DESCRIBED = Path(__file__).resolve().parents[1] / "recommend" / "data" / "libraries" / "described"
"""The library 'Described Sensor' 1.2.3."""
SERVO = Path(__file__).resolve().parent / "libraries" / "Servo"
"""A library 'Servo' 7.8.9, so that its version is not that of the index."""
NAME = "Described Sensor"


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of libraries; the user has an index of their own."""
    monkeypatch.setenv("ROBOSMI_LIBRARIES", str(tmp_path / "libraries"))
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    return tmp_path / "libraries"


def zipped(folder: Path, path: Path, top: str = "described-1.2.3/") -> Path:
    """A zip file of a library, as its author publishes it."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(each for each in folder.rglob("*") if each.is_file()):
            archive.write(file, f"{top}{file.relative_to(folder).as_posix()}")
    return path


def files_in(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("top", ["described-1.2.3/", "", None])
def test_a_library_is_installed_from_a_zip_file_or_a_folder(top: str | None, home: Path, tmp_path: Path) -> None:
    source = DESCRIBED if top is None else zipped(DESCRIBED, tmp_path / "library.zip", top)
    outcome = run("libraries", "install", f"{NAME}@1.2.3", "--from", source, "--json")
    assert outcome.code == 0
    place = home / "Described_Sensor"
    assert outcome.result | {"name": NAME, "version": "1.2.3", "folder": str(place), "tool": None} == outcome.result
    assert [each["name"] for each in outcome.result["installed"]] == [NAME]
    assert files_in(place) == files_in(DESCRIBED)
    assert [path.name for path in home.iterdir()] == ["Described_Sensor"]
    assert run("libraries", "show", NAME, "--json").result["version"] == "1.2.3"
    again = run("libraries", "install", NAME, "--from", source, "--json")
    assert (again.code, again.result["installed"]) == (0, [])


def test_other_content_is_replaced_on_request(home: Path, tmp_path: Path) -> None:
    run("libraries", "install", NAME, "--from", DESCRIBED)
    (home / "Described_Sensor" / "mine.h").write_text("// mine\n", encoding="utf-8")
    refused = run("libraries", "install", NAME, "--from", DESCRIBED, "--json")
    assert refused.code == 5
    assert (home / "Described_Sensor" / "mine.h").is_file()
    assert run("libraries", "install", NAME, "--from", DESCRIBED, "--replace").code == 0
    assert files_in(home / "Described_Sensor") == files_in(DESCRIBED)
    assert [path.name for path in home.iterdir()] == ["Described_Sensor"]


def test_a_library_that_cannot_be_replaced_stays(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert run("libraries", "install", NAME, "--from", DESCRIBED).code == 0
    folder = home / "Described_Sensor"
    (folder / "notes.txt").write_text("mine")
    before, rename = files_in(folder), Path.rename

    def full(path: Path, target: Path) -> Path:
        if path.name == "new":
            raise OSError(28, "No space left on device")
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", full)
    assert run("libraries", "install", NAME, "--from", DESCRIBED, "--replace").code == 3
    assert files_in(folder) == before
    assert [path.name for path in home.iterdir()] == ["Described_Sensor"]


@pytest.mark.parametrize("name", ["Servo", f"{NAME}@9.9.9", "-v", "../x", ""])
def test_another_name_or_version_is_refused(name: str, home: Path) -> None:
    assert run("libraries", "install", "--from", DESCRIBED, "--json", "--", name).code == 2
    assert not home.exists()


def test_what_is_no_library_is_refused(home: Path, tmp_path: Path) -> None:
    hostile = tmp_path / "hostile.zip"
    with zipfile.ZipFile(hostile, "w") as archive:
        archive.writestr("a/library.properties", f"name={NAME}\nversion=1\n")
        archive.writestr("a/../../escaped.h", "")
    junk = tmp_path / "junk.zip"
    junk.write_bytes(b"PK\x03\x04 and no more")
    cut = tmp_path / "cut.zip"
    whole = io.BytesIO(zipped(DESCRIBED, cut).read_bytes())
    cut.write_bytes(whole.getvalue()[: len(whole.getvalue()) // 2])
    for source in (hostile, junk, cut, DESCRIBED / "src", DESCRIBED / "library.properties", tmp_path / "nowhere"):
        refused = run("libraries", "install", NAME, "--from", source, "--json")
        assert refused.code == 3, source
        assert refused.document["findings"][0]["location"]["path"] == str(source)
    assert not home.exists()
    assert not (tmp_path / "escaped.h").exists()


def test_links_of_a_library_are_not_followed(home: Path, tmp_path: Path) -> None:
    source = Path(shutil.copytree(DESCRIBED, tmp_path / "described"))
    (tmp_path / "secret.txt").write_text("secret", encoding="utf-8")
    (source / "src" / "secret.h").symlink_to(tmp_path / "secret.txt")
    (source / "src" / "up").symlink_to(source)
    assert run("libraries", "install", NAME, "--from", source).code == 0
    assert files_in(home / "Described_Sensor") == files_in(DESCRIBED)


MANAGER = """#!/bin/sh
echo "$@" > "{log}"
[ "$3" = "Nothing" ] && echo "Library 'Nothing' not found" >&2 && exit 7
cp -r "{library}" "$ROBOSMI_LIBRARIES/Described_Sensor"
"""


@pytest.mark.processes
def test_the_library_manager_installs_where_it_is_there(home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    log = tmp_path / "log"
    manager = tmp_path / "bin" / "arduino-cli"
    manager.parent.mkdir()
    manager.write_text(MANAGER.format(log=log, library=DESCRIBED), encoding="utf-8")
    manager.chmod(0o755)
    home.mkdir()
    monkeypatch.setenv("PATH", f"{manager.parent}:/usr/bin:/bin")
    failed = run("libraries", "install", "Nothing", "--json")
    assert failed.code == 3
    assert "not found" in failed.document["findings"][0]["message"]
    outcome = run("libraries", "install", f"{NAME}@1.2.3", "--json")
    assert outcome.code == 0
    assert log.read_text(encoding="utf-8") == f"lib install {NAME}@1.2.3\n"
    assert outcome.result | {"version": "1.2.3", "tool": "arduino-cli"} == outcome.result
    assert [each["name"] for each in outcome.result["installed"]] == [NAME]


def test_a_library_manager_that_is_missing_is_said(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert run("libraries", "install", NAME, "--json").code == 4
    assert run("libraries", "install", NAME, "--platform", "avr-c", "--json").code == 2


def test_the_version_reaches_the_sketch(line_follower: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    run("migrate", line_follower, "-o", out)
    outcome = run("libraries", "install", "Servo", "--from", SERVO, "--pin", out, "--json")
    assert (outcome.code, outcome.result["pinned"]) == (0, True)
    assert "- Servo (7.8.9)" in (out / "line_follower" / "sketch.yaml").read_text(encoding="utf-8")
    assert "Servo @ 7.8.9" in (out / "line_follower" / "platformio.ini").read_text(encoding="utf-8")
    assert run("generate", out / "models" / "plan.xmi", "-o", out).code == 0
    assert "- Servo (7.8.9)" in (out / "line_follower" / "sketch.yaml").read_text(encoding="utf-8")
    before = files_in(out)
    other = run("libraries", "install", NAME, "--from", DESCRIBED, "--pin", out, "--json")
    assert (other.code, other.result["pinned"]) == (0, False)
    assert files_in(out) == before
    assert run("libraries", "install", NAME, "--from", DESCRIBED, "--pin", tmp_path / "nowhere", "--json").code == 3
    new = tmp_path / "new"
    run("migrate", line_follower, "-o", new)
    assert "- Servo (7.8.9)" in (new / "line_follower" / "sketch.yaml").read_text(encoding="utf-8")


def test_a_path_in_place_of_the_name_gets_the_option_for_it() -> None:
    refused = run("libraries", "install", DESCRIBED, "--json")
    assert refused.code == 2
    assert refused.document["findings"][0]["fix"] == f"give its name, and the file as --from {DESCRIBED}"
