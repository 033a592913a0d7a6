"""Adapter files as they are loaded and cached, and where they are searched."""

from __future__ import annotations

import atexit
from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi import resources
from robosmi.base.user_cache import CachedResults
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.adapters import adapter_data
from robosmi.transformations.knowledge.adapters.adapter_data import adapter_paths, load
from robosmi.transformations.knowledge.adapters.adapter_files import adapter_file
from robosmi.transformations.knowledge.adapters.adapter_index import AdapterIndex, adapter_index
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterFile
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces

FOLDERS = sorted(path for path in resources.built_in("platform_repo").glob("*/adapters/*") if path.is_dir())
LOW = """//# header tools.h
//# adapter low
//#   for: void low(int pin)
//#   kind: oneToOne
//#   needs: latch
void low(int pin) {{ {} }}
"""
LATCH = "//# header latch.h\n//# helper latch\n//#   table: port_pins 4\nint latch = port_pins[0];\n"


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's cache folder; it does not exist yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "robosmi"


@pytest.fixture
def new_run(monkeypatch: pytest.MonkeyPatch) -> Callable[[], list[Path]]:
    """A function that ends a run and begins another: it writes the cache and returns the list of files that are parsed next."""

    def start() -> list[Path]:
        adapter_data._PARSED._write()
        parsed: list[Path] = []

        def counted(path: Path, text: str) -> AdapterFile:
            parsed.append(path)
            return adapter_file(path, text)

        fresh = CachedResults("adapters.json", "test", AdapterFile, 400)
        monkeypatch.setattr(adapter_data, "_PARSED", fresh)
        monkeypatch.setattr(adapter_data, "adapter_file", counted)
        return parsed

    monkeypatch.setattr(atexit, "register", lambda write: None)
    monkeypatch.setattr(adapter_data, "_PARSED", CachedResults("adapters.json", "test", AdapterFile, 400))
    return start


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda f: f"{f.parents[1].name}-{f.name}")
def test_cached_files_equal_parsed_ones(folder: Path, new_run: Callable[[], list[Path]]) -> None:
    paths = adapter_paths(folder)
    new_run()
    first = [load(path) for path in paths]
    parsed = new_run()
    again = [load(path) for path in paths]
    assert parsed == []
    assert repr(again) == repr(first) == repr([adapter_file(path, path.read_text("utf-8")) for path in paths])


def test_an_edited_file_is_parsed_again(tmp_path: Path, new_run: Callable[[], list[Path]]) -> None:
    folder = written(tmp_path / "a")
    new_run()
    load(folder / "tools.cpp")
    (folder / "tools.cpp").write_text(LOW.format("high();"))
    parsed = new_run()
    assert load(folder / "tools.cpp").pieces[0].text == "void low(int pin) { high(); }"
    assert parsed == [folder / "tools.cpp"]


def test_a_copy_of_a_file_has_its_own_locations(tmp_path: Path, new_run: Callable[[], list[Path]]) -> None:
    first, second = written(tmp_path / "a"), written(tmp_path / "b")
    for folder in (first, second):
        assert load(folder / "tools.cpp").pieces[0].location == Location(str(folder / "tools.cpp"), 2)


def test_a_damaged_cache_is_ignored(tmp_path: Path, cache: Path, new_run: Callable[[], list[Path]]) -> None:
    folder = written(tmp_path / "a")
    new_run()
    found = load(folder / "tools.cpp")
    new_run()
    file = cache / "adapters.json"
    file.write_bytes(file.read_bytes().replace(b"low();", b"bad();"))
    parsed = new_run()
    assert load(folder / "tools.cpp") == found
    assert parsed == [folder / "tools.cpp"]


def test_a_wrong_file_is_an_error_each_time(tmp_path: Path, new_run: Callable[[], list[Path]]) -> None:
    path = written(tmp_path / "a") / "tools.cpp"
    path.write_text(LOW.format("low(;"))
    for _ in range(2):
        new_run()
        with pytest.raises(PlatformDataError, match="closed"):
            load(path)


def written(folder: Path, text: str = "low();") -> Path:
    """A folder with two adapter files."""
    folder.mkdir()
    (folder / "tools.cpp").write_text(LOW.format(text))
    (folder / "latch.cpp").write_text(LATCH)
    return folder


def test_needs_are_found_in_other_files(tmp_path: Path) -> None:
    folder = written(tmp_path / "a")
    needed = AdapterPieces(AdapterIndex([folder])).needed([("tools.h", "low")], "atmega328p").pieces
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
    assert caught.value.fix == "rename it to tools.cpp"


def test_variants_are_for_microcontrollers_that_there_are(tmp_path: Path) -> None:
    text = LOW.format("low();").replace("//#   needs: latch\n", "//#   mcu: atmega382p\n")
    (tmp_path / "tools.cpp").write_text(text)
    assert AdapterIndex([tmp_path]).files("tools.h")
    with pytest.raises(PlatformDataError, match=r"'atmega382p'.*did you mean 'atmega328p'") as caught:
        AdapterIndex([tmp_path], ["atmega328p"]).files("tools.h")
    assert (caught.value.location, caught.value.fix) == (Location(str(tmp_path / "tools.cpp"), 2), "use: atmega328p")
    assert "atmega2560" in adapter_index("arduino", "propeller").mcus


def test_folders_of_a_project_go_before_the_built_in_ones(tmp_path: Path) -> None:
    own = tmp_path / ".robosmi" / "platform_repo" / "arduino" / "adapters" / "propeller"
    own.mkdir(parents=True)
    assert adapter_index("arduino", "propeller", tmp_path).folders == [own, FOLDERS[0]]
    assert adapter_index("arduino", "unheard-of", tmp_path).folders == []


def test_files_of_the_hardware_layer_are_one_group(tmp_path: Path) -> None:
    """One for all architectures does not hide that for the target's, whichever is read first."""
    folder = tmp_path / "adapters"
    (folder / "hal").mkdir(parents=True)
    (folder / "hal" / "api.cpp").write_text("//# header hal\n//# helper Io\nint of_all;\n")
    (folder / "hal" / "avr.cpp").write_text("//# header hal\n//# architecture avr\n//# helper Io\nint of_avr;\n")
    index = AdapterIndex([folder])
    assert index.headers == ["hal"]
    texts = [AdapterPieces(index, architecture=name).needed([("hal", "Io")], "m").pieces[0].text for name in ("avr", "esp32")]
    assert texts == ["int of_avr;", "int of_all;"]


def test_a_file_of_the_hardware_layer_says_so(tmp_path: Path) -> None:
    (tmp_path / "hal").mkdir()
    (tmp_path / "hal" / "avr.cpp").write_text("//# header tools.h\n//# helper Io\nint io;\n")
    with pytest.raises(PlatformDataError) as caught:
        AdapterIndex([tmp_path]).files("hal")
    assert caught.value.location == Location(str(tmp_path / "hal" / "avr.cpp"), 1)


@pytest.mark.parametrize("marker", ["architecture: rp2400", "limit rp2400: none"])
def test_a_variant_of_a_person_for_an_unknown_architecture_is_refused(tmp_path: Path, marker: str) -> None:
    own = tmp_path / "adapters"
    own.mkdir()
    (own / "tools.cpp").write_text(f"//# header tools.h\n//# helper Io\n//#   {marker}\nint io;\n")
    with pytest.raises(PlatformDataError, match=r"unknown architecture 'rp2400' \(did you mean 'rp2040'\?\)") as caught:
        adapter_index("arduino", "propeller", beside=tmp_path).files("tools.h")
    assert caught.value.location == Location(str(own / "tools.cpp"), 2)
    (own / "tools.cpp").write_text((own / "tools.cpp").read_text().replace("rp2400", "rp2040"))
    assert adapter_index("arduino", "propeller", beside=tmp_path).files("tools.h")
