"""Results that are cached between runs: the same ones, or none."""

from __future__ import annotations

import atexit
import os
import sys
import zipfile
from collections.abc import Callable
from datetime import date
from pathlib import Path
from typing import Any

import pytest
from msgspec import Struct

import robosmi
from robosmi.base.user_cache import CachedResults, code_version, write_cached


class Word(Struct):
    """A result with a field that has a default value."""

    text: str
    line: int = 1


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's cache folder; it does not exist yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "robosmi"


class Run:
    """What a run of a program sees of the cache, which it writes when it ends."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self._monkeypatch = monkeypatch

    def __call__(self, text: str, result: object = None, version: str = "1", kind: Any = Word, most: int = 3) -> Any:
        at_exit: list[Callable[[], None]] = []
        self._monkeypatch.setattr(atexit, "register", at_exit.append)
        results: CachedResults[Any] = CachedResults("words.json", version, kind, most)
        found = results.get(text)
        if found is None and result is not None:
            results.put(text, result)
        for write in at_exit:
            write()
        return found


@pytest.fixture
def run(cache: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs that share a cache folder."""
    return Run(monkeypatch)


def test_the_next_run_gets_the_same_result(run: Run) -> None:
    assert run("a", Word("é", 7)) is None
    assert run("a") == Word("é", 7)
    assert run("b") is None


def test_each_caller_gets_a_copy(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(atexit, "register", lambda write: None)
    results: CachedResults[Word] = CachedResults("words.json", "1", Word, 3)
    results.put("a", Word("b"))
    first = results.get("a")
    assert first is not None
    first.text = "changed"
    assert results.get("a") == Word("b")


def test_another_version_computes_again(run: Run) -> None:
    run("a", Word("b"))
    assert run("a", Word("c"), version="2") is None
    assert run("a", version="2") == Word("c")


def test_a_result_of_another_type_is_ignored(run: Run) -> None:
    run("a", {"text": 1}, kind=dict)
    assert run("a") is None


def test_concurrent_runs_keep_the_results_of_both(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    at_exit: list[Callable[[], None]] = []
    monkeypatch.setattr(atexit, "register", at_exit.append)
    for text in ("a", "b"):
        CachedResults("words.json", "1", Word, 3).put(text, Word(text))
    for write in at_exit:
        write()
    both: CachedResults[Word] = CachedResults("words.json", "1", Word, 3)
    assert (both.get("a"), both.get("b")) == (Word("a"), Word("b"))


def test_a_full_file_is_started_anew(run: Run) -> None:
    for text in "abcd":
        run(text, Word(text))
    assert [run(text) for text in "abcd"] == [None, None, None, Word("d")]


@pytest.mark.parametrize("value", [date(2026, 11, 26), float("inf"), float("nan"), b"a"])
def test_what_json_cannot_represent_is_not_cached(run: Run, value: object) -> None:
    run("a", {"value": value}, kind=dict)
    assert run("a", kind=dict) is None


@pytest.mark.parametrize("value", [1.0, 2**80, True, "\u20ac", [1, {"a": None}]])
def test_what_json_represents_is_cached_with_its_type(run: Run, value: object) -> None:
    run("a", {"value": value}, kind=dict)
    assert repr(run("a", kind=dict)) == repr({"value": value})


def spoilt(data: bytes) -> bytes:
    return data.replace(b"text", b"tent")


def cut(data: bytes) -> bytes:
    return data[: len(data) // 2]


def cut_in_its_head(data: bytes) -> bytes:
    return data[:1]


def zeroed(data: bytes) -> bytes:
    """As some file systems leave it after a power failure."""
    return bytes(len(data))


def emptied(data: bytes) -> bytes:
    return b""


@pytest.mark.parametrize("damage", [spoilt, cut, cut_in_its_head, zeroed, emptied])
def test_a_damaged_file_is_ignored_and_replaced(run: Run, cache: Path, damage: Callable[[bytes], bytes]) -> None:
    run("a", Word("b"))
    file = cache / "words.json"
    whole = file.read_bytes()
    assert damage(whole) != whole
    file.write_bytes(damage(whole))
    assert run("a", Word("b")) is None
    assert run("a") == Word("b")


@pytest.mark.skipif(sys.platform == "win32", reason="permissions as POSIX has them")
@pytest.mark.parametrize("mode", [0o620, 0o602])
def test_a_file_that_others_can_write_is_ignored(run: Run, cache: Path, mode: int) -> None:
    run("a", Word("b"))
    (cache / "words.json").chmod(mode)
    assert run("a") is None


@pytest.mark.skipif(sys.platform == "win32", reason="links as POSIX has them")
def test_a_link_is_ignored(run: Run, cache: Path) -> None:
    run("a", Word("b"))
    file = cache / "words.json"
    file.rename(cache / "other.json")
    file.symlink_to(cache / "other.json")
    assert run("a") is None


def test_without_a_cache_folder_nothing_is_cached(run: Run, cache: Path) -> None:
    cache.write_text("in the way", encoding="utf-8")
    run("a", Word("b"))
    assert run("a") is None
    assert cache.read_text(encoding="utf-8") == "in the way"


def test_a_failed_write_leaves_no_file(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(source: object, target: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr(os, "replace", full)
    write_cached("a", b"b")
    assert list(cache.iterdir()) == []


def test_the_version_of_code_changes_with_its_modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "versioned_a.py").write_text("x = 1\n", encoding="utf-8")
    (tmp_path / "versioned_b.py").write_text("y = 1\n", encoding="utf-8")
    before = code_version("versioned_a")
    assert code_version("versioned_a") == before
    assert code_version("versioned_a", "versioned_b") != before
    (tmp_path / "versioned_a.py").write_text("x = 10\n", encoding="utf-8")
    assert code_version("versioned_a") != before
    assert "versioned_a" not in sys.modules
    with pytest.raises(ModuleNotFoundError, match="versioned_c"):
        code_version("versioned_a", "versioned_c")


def test_the_version_of_code_in_an_archive_is_that_of_the_product(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with zipfile.ZipFile(tmp_path / "archive.zip", "w") as archive:
        archive.writestr("versioned_zipped.py", "x = 1\n")
    monkeypatch.syspath_prepend(str(tmp_path / "archive.zip"))
    assert code_version("versioned_zipped") == code_version("versioned_zipped")


def test_only_code_that_looks_at_the_owner_finds_files_in_the_cache() -> None:
    root = Path(robosmi.__file__).parent
    texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in root.rglob("*.py")}
    places = {name for name, text in texts.items() if "cache_dir()" in text and not name.startswith("transformations/")}
    locks = "verify/uploads/upload.py"  # files without content
    assert places == {"base/user_cache.py", "base/user_folders.py", "verify/toolchains/archives.py", locks}
