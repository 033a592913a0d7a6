"""Built data of adapter files, and where adapters are looked for."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi import resources
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.adapter_data import adapter_paths, build, load, main
from robosmi.transformations.knowledge.adapter_files import read_adapter_file
from robosmi.transformations.knowledge.adapter_index import AdapterIndex, adapter_index
from robosmi.transformations.queries.adapter_needs import AdapterPieces

FOLDERS = sorted(path for path in resources.built_in("platform_repo").glob("*/adapters/*") if path.is_dir())
LOW = """//# header tools.h
//# adapter low
//#   for: void low(int pin)
//#   kind: oneToOne
//#   needs: latch
void low(int pin) {{ {} }}
"""
LATCH = "//# header latch.h\n//# helper latch\n//#   table: port_pins 4\nint latch = port_pins[0];\n"


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda f: f"{f.parents[1].name}-{f.name}")
def test_the_data_is_built_from_the_files_as_they_are(folder: Path) -> None:
    stale = [path.name for path, text in build(folder).items() if not path.is_file() or path.read_text("utf-8") != text]
    assert stale == [], "run `make adapter-data`"
    assert {p.with_suffix("") for p in folder.rglob("*.json")} == {p.with_suffix("") for p in adapter_paths(folder)}


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda f: f"{f.parents[1].name}-{f.name}")
def test_data_say_what_the_files_say(folder: Path) -> None:
    """All but the names in `needs`, which are complete in data."""
    for path in adapter_paths(folder):
        for stored, parsed in zip(load(path).pieces, read_adapter_file(path), strict=True):
            assert [name.rpartition("/")[2] for name in stored.needs] == [name.rpartition("/")[2] for name in parsed.needs]
            assert all("/" in name for name in stored.needs)
            assert replace(stored, needs=[]) == replace(parsed, needs=[])


def written(folder: Path, text: str = "low();") -> Path:
    """A folder with two adapter files and their data."""
    folder.mkdir()
    (folder / "tools.cpp").write_text(LOW.format(text))
    (folder / "latch.cpp").write_text(LATCH)
    for path, data in build(folder).items():
        path.write_text(data)
    return folder


def test_a_file_that_was_edited_is_read_itself(tmp_path: Path) -> None:
    folder = written(tmp_path / "a")
    assert load(folder / "tools.cpp").pieces[0].needs == ["latch.h/latch"]
    (folder / "tools.cpp").write_text(LOW.format("high();"))
    (piece,) = load(folder / "tools.cpp").pieces
    assert (piece.text, piece.needs) == ("void low(int pin) { high(); }", ["latch"])
    (folder / "latch.json").write_text("{")
    assert load(folder / "latch.cpp").pieces[0].tables[0].size == 4
    (needed,) = [AdapterPieces(AdapterIndex([folder])).needed([("tools.h", "low")], "atmega328p").pieces]
    assert [p.name for p in needed] == ["latch", "low"]


def test_a_piece_of_an_earlier_folder_counts_first(tmp_path: Path) -> None:
    built, own = written(tmp_path / "built"), tmp_path / "own"
    own.mkdir()
    (own / "tools.cpp").write_text(LOW.format("mine();").replace("//#   needs: latch\n", ""))
    pieces = AdapterPieces(AdapterIndex([own, built]))
    assert [p.text for p in pieces.needed([("tools.h", "low")], "atmega328p").pieces] == ["void low(int pin) { mine(); }"]
    assert pieces.key("latch", "tools.h") == ("latch.h", "latch")


def test_a_file_has_the_name_of_its_header(tmp_path: Path) -> None:
    (tmp_path / "tool.cpp").write_text(LOW.format("low();"))
    with pytest.raises(PlatformDataError, match=r"is for 'tools.h'") as caught:
        AdapterIndex([tmp_path]).files("tool.h")
    assert caught.value.fix == "call it tools.cpp"


def test_variants_are_for_microcontrollers_that_there_are(tmp_path: Path) -> None:
    text = LOW.format("low();").replace("//#   needs: latch\n", "//#   mcu: atmega382p\n")
    (tmp_path / "tools.cpp").write_text(text)
    assert AdapterIndex([tmp_path]).files("tools.h")
    with pytest.raises(PlatformDataError, match=r"'atmega382p', a microcontroller .*did you mean 'atmega328p'") as caught:
        AdapterIndex([tmp_path], ["atmega328p"]).files("tools.h")
    assert (caught.value.location, caught.value.fix) == (Location(str(tmp_path / "tools.cpp"), 2), "use: atmega328p")
    assert "atmega2560" in adapter_index("arduino", "propeller").mcus


def test_folders_of_a_project_go_before_the_built_in_ones(tmp_path: Path) -> None:
    own = tmp_path / ".robosmi" / "platform_repo" / "arduino" / "adapters" / "propeller"
    own.mkdir(parents=True)
    assert adapter_index("arduino", "propeller", tmp_path).folders == [own, FOLDERS[0]]
    assert adapter_index("arduino", "unheard-of", tmp_path).folders == []


def test_data_are_built_for_folders_and_for_single_files(tmp_path: Path) -> None:
    folder = written(tmp_path / "a")
    (folder / "sys").mkdir()
    (folder / "sys" / "more.cpp").write_text(LOW.format("low();").replace("tools.h", "sys/more.h"))
    there = build(folder)
    for data in there:
        data.unlink(missing_ok=True)
    assert main([str(folder / "tools.cpp"), str(folder / "sys" / "more.cpp")]) == 0
    assert {path: path.read_text() for path in folder.rglob("*.json")} == {
        path: text for path, text in there.items() if path.name != "latch.json"
    }
    assert main([str(folder)]) == 0
    assert {path: path.read_text() for path in folder.rglob("*.json")} == there


def test_what_is_no_adapter_file_and_no_folder_of_them_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder, empty = written(tmp_path / "a"), tmp_path / "empty"
    empty.mkdir()
    (folder / "tools.cpp").write_text(LOW.format("high();"))
    before = (folder / "tools.json").read_text()
    for wrong in (folder / "tools.json", folder / "tool.cpp", tmp_path / "nothing", empty):
        assert main([str(folder), str(wrong)]) == 1
        said = capsys.readouterr().err
        assert said.startswith(f"{wrong}: this is no adapter file and no folder that has one\n  do: ")
    assert (folder / "tools.json").read_text() == before
