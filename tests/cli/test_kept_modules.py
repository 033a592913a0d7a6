"""Modules that the command loads from the file of an earlier one: those that Python would find and load itself, and no others."""

from __future__ import annotations

import atexit
import os
import py_compile
import subprocess
import sys
from collections.abc import Callable
from importlib.machinery import EXTENSION_SUFFIXES, ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import cache_from_source, module_from_spec
from pathlib import Path

import pytest

from robosmi.cli import kept_modules
from robosmi.cli.kept_modules import KeptModules

NAME = "modules/own"
ASKED = "package.made"
COMMAND = """
import sys
from robosmi.__main__ import start
sys.argv = ["robosmi", "analyse", "no such file.c"]
start()
import robosmi.cli.main as module
loader = module.__loader__
print(type(loader).__name__, module.__file__, module.__cached__, len(loader.get_source(module.__name__)) > 99)
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a module and its bytecode; beside it a folder that is searched before, and an empty cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = tmp_path / "package"
    folder.mkdir()
    (tmp_path / "first").mkdir()
    write(folder / "made.py", 1)
    return folder


def write(source: Path, value: int) -> None:
    source.parent.mkdir(exist_ok=True)
    source.write_text(f"value = {value}\n", encoding="utf-8")
    py_compile.compile(str(source))


def asked(folder: Path) -> ModuleSpec | None:
    """How a process finds the module; what it does not find among the kept ones is kept when it ends."""
    finder = KeptModules(NAME)
    found = finder.find_spec(ASKED, [str(folder.parent / "first"), str(folder), "/elsewhere"])
    finder.write()
    return found


def value_of(found: ModuleSpec | None) -> int:
    assert found is not None
    assert found.loader is not None
    module = module_from_spec(found)
    found.loader.exec_module(module)
    value: int = module.value
    return value


def kept() -> Path:
    return Path(os.environ["XDG_CACHE_HOME"], "robosmi", NAME)


def test_a_kept_module_is_found_as_python_finds_it(folder: Path) -> None:
    assert asked(folder) is None
    found, expected = asked(folder), PathFinder.find_spec(ASKED, [str(folder)])
    assert found is not None
    assert expected is not None
    assert (found.name, found.origin, found.cached) == (expected.name, expected.origin, expected.cached)
    assert found.has_location
    assert found.submodule_search_locations is None
    assert value_of(found) == 1


def test_a_kept_package_is_one(folder: Path) -> None:
    (folder / "made.py").unlink()
    write(folder / "made" / "__init__.py", 2)
    assert asked(folder) is None
    found = asked(folder)
    assert found is not None
    assert found.submodule_search_locations == [str(folder / "made")]
    assert value_of(found) == 2


def test_its_code_names_the_source_and_its_loader_gives_the_text(folder: Path) -> None:
    asked(folder)
    found = asked(folder)
    assert found is not None
    assert isinstance(found.loader, SourceFileLoader)
    code = found.loader.get_code(ASKED)
    assert code is not None
    assert code.co_filename == str(folder / "made.py")
    again = found.loader.get_code(ASKED)
    assert again is not None
    assert again.co_code == code.co_code
    assert found.loader.get_source(ASKED) == "value = 1\n"


def edited(folder: Path) -> None:
    write(folder / "made.py", 2)


def edited_with_the_old_time(folder: Path) -> None:
    """As `cp -p` and `touch -d` do."""
    source = folder / "made.py"
    before = source.stat()
    source.write_text("value = 2\n", encoding="utf-8")
    os.utime(source, ns=(before.st_atime_ns, before.st_mtime_ns))
    py_compile.compile(str(source), doraise=True)


def replaced(folder: Path) -> None:
    write(folder / "other.py", 2)
    (folder / "other.py").replace(folder / "made.py")
    py_compile.compile(str(folder / "made.py"))


def hidden_by_a_package(folder: Path) -> None:
    write(folder / "made" / "__init__.py", 2)


def now_in_the_folder_before(folder: Path) -> None:
    write(folder.parent / "first" / "made.py", 2)


CHANGES = [edited, edited_with_the_old_time, replaced, hidden_by_a_package, now_in_the_folder_before]


@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_module_is_loaded_by_python_and_then_kept(folder: Path, change: Callable[[Path], None]) -> None:
    asked(folder)
    assert value_of(asked(folder)) == 1
    change(folder)
    assert asked(folder) is None
    assert value_of(asked(folder)) == 2


def test_a_removed_module_is_not_found(folder: Path) -> None:
    asked(folder)
    (folder / "made.py").unlink()
    assert asked(folder) is None
    assert asked(folder) is None


def test_a_module_of_another_folder_is_not_found(folder: Path, tmp_path: Path) -> None:
    asked(folder)
    write(tmp_path / "second" / "made.py", 2)
    assert asked(tmp_path / "second") is None
    assert value_of(asked(tmp_path / "second")) == 2
    assert asked(folder) is None
    assert value_of(asked(folder)) == 1


def test_what_is_no_source_is_left_to_python_and_not_sought_again(folder: Path) -> None:
    (folder / "made.py").unlink()
    suffix = next(suffix for suffix in EXTENSION_SUFFIXES if suffix.startswith("."))
    (folder / f"made{suffix}").write_bytes(b"")
    assert asked(folder) is None
    assert kept().exists()
    written = kept().stat().st_mtime_ns
    assert asked(folder) is None
    assert kept().stat().st_mtime_ns == written


def test_a_module_of_a_relative_path_is_left_to_python(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    for path in ([""], ["."], None):
        monkeypatch.setattr(sys, "path", ["", str(folder)])
        finder = KeptModules(NAME)
        assert finder.find_spec("made", path) is None
        finder.write()
    assert not kept().exists()


def test_a_module_of_the_path_of_python_is_kept(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [str(folder)])
    finder = KeptModules(NAME)
    assert finder.find_spec("made") is None
    finder.write()
    finder = KeptModules(NAME)
    assert value_of(finder.find_spec("made")) == 1
    monkeypatch.setattr(sys, "path", [str(folder), "/of/a/user"])
    assert finder.find_spec("made") is None


def test_what_is_imported_while_modules_are_kept_is_left_to_python(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked(folder)
    write(folder / "second.py", 2)
    asked(folder)
    finder = KeptModules(NAME)
    path = [str(folder.parent / "first"), str(folder)]
    assert value_of(finder.find_spec(ASKED, path)) == 1
    assert finder.find_spec("package.second", path) is None
    found: list[ModuleSpec | None] = []
    monkeypatch.setattr(kept_modules, "keep", lambda name, data: found.append(finder.find_spec(ASKED, path)))
    finder.write()
    assert found == [None]


def test_files_are_started_anew_beyond_their_limit(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept_modules, "MOST_MODULES", 1)
    asked(folder)
    write(folder / "second.py", 2)
    assert asked(folder) is None  # the folder has changed
    assert value_of(asked(folder)) == 1
    path = [str(folder.parent / "first"), str(folder)]
    finder = KeptModules(NAME)
    finder.find_spec("package.second", path)
    finder.write()
    assert KeptModules(NAME).find_spec(ASKED, path) is None
    assert value_of(KeptModules(NAME).find_spec("package.second", path)) == 2


def test_finders_before_that_of_python_come_first(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "meta_path", ["of a tool", PathFinder, "of an editable installation"])
    monkeypatch.setattr(atexit, "register", lambda write: None)
    kept_modules.keep_modules()
    assert [type(finder) for finder in sys.meta_path] == [str, KeptModules, type, str]
    monkeypatch.setattr(sys, "meta_path", ["of a tool"])
    kept_modules.keep_modules()
    assert [*map(str, sys.meta_path)] == ["of a tool"]


def test_what_changes_while_it_is_kept_is_not_kept(folder: Path) -> None:
    finder = KeptModules(NAME)
    finder.find_spec(ASKED, [str(folder)])
    hidden_by_a_package(folder)
    finder.write()
    assert not kept().exists()


def test_a_module_without_bytecode_is_not_compiled_to_keep_it(folder: Path) -> None:
    Path(cache_from_source(str(folder / "made.py"))).unlink()
    asked(folder)
    assert not kept().exists()


def spoilt_code(data: bytes) -> bytes:
    return data[:-9] + bytes([data[-9] ^ 1]) + data[-8:]


def spoilt_index(data: bytes) -> bytes:
    place = data.index(b"made.py")
    return data[:place] + b"M" + data[place + 1 :]


def of_another_build(data: bytes) -> bytes:
    build = sys.version.partition(" ")[0].encode()
    return data.replace(build, build.replace(b"3", b"2"), 1)


def cut(data: bytes) -> bytes:
    return data[: len(data) // 2]


def cut_in_its_head(data: bytes) -> bytes:
    return data[:9]


def zeroed_behind_its_head(data: bytes) -> bytes:
    """As some file systems leave it after a power failure."""
    head = data.index(b"\n") + 1
    return data[:head] + bytes(len(data) - head)


def emptied(data: bytes) -> bytes:
    return b""


DAMAGE = [spoilt_code, spoilt_index, of_another_build, cut, cut_in_its_head, zeroed_behind_its_head, emptied]


@pytest.mark.parametrize("change", DAMAGE)
def test_what_is_not_whole_or_of_another_python_is_kept_anew(folder: Path, change: Callable[[bytes], bytes]) -> None:
    asked(folder)
    kept().write_bytes(change(kept().read_bytes()))
    assert asked(folder) is None
    assert value_of(asked(folder)) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="permissions as POSIX has them")
def test_a_file_that_others_can_write_is_passed_over(folder: Path) -> None:
    asked(folder)
    kept().chmod(0o666)
    assert asked(folder) is None
    assert value_of(asked(folder)) == 1


def test_files_of_few_installations_are_kept(folder: Path) -> None:
    for number in range(kept_modules.MOST + 2):
        finder = KeptModules(f"{kept_modules.FOLDER}/{number}")
        finder.find_spec(ASKED, [str(folder)])
        finder.write()
        os.utime(kept().parent / str(number), ns=(number, number))
    assert {file.name for file in kept().parent.iterdir()} == {str(number) for number in range(2, kept_modules.MOST + 2)}


def run(cache: Path, *options: str) -> str:
    environment = {name: text for name, text in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    command = [sys.executable, *options, "-c", COMMAND]
    return subprocess.run(
        command, env=environment | {"XDG_CACHE_HOME": str(cache)}, capture_output=True, text=True, check=True
    ).stdout


def test_a_command_takes_the_modules_of_the_one_before(tmp_path: Path) -> None:
    run(tmp_path, "-B")
    assert not (tmp_path / "robosmi" / kept_modules.FOLDER).exists()
    found = [run(tmp_path) for _ in range(3)]  # the first one may write bytecode, which changes folders
    assert found[0].startswith("SourceFileLoader ")
    assert found[2] == found[0].replace("SourceFileLoader", "_Loader")


def test_where_nothing_can_be_kept_python_loads_all_modules(tmp_path: Path) -> None:
    (tmp_path / "robosmi").write_text("in the way", encoding="utf-8")
    assert run(tmp_path).startswith("SourceFileLoader ")
    assert run(tmp_path).startswith("SourceFileLoader ")
