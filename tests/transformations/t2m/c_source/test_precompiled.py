"""Precompiled headers change nothing but the time: the model is the same, whatever the files contain and become."""

from __future__ import annotations

import multiprocessing
import os
import shutil
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import pytest

from robosmi.diagnostics import Finding
from robosmi.errors import RobosmiError
from robosmi.metamodels import ccode
from robosmi.model.xmi.xmi_writer import to_xmi
from robosmi.query import all_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.on_demand import open_program
from robosmi.transformations.t2m.c_source.parsing import precompiled
from robosmi.transformations.t2m.c_source.parsing.headers import Folders
from robosmi.transformations.t2m.c_source.parsing.invocation import arguments
from robosmi.transformations.t2m.c_source.parsing.source import read_source

HERE = Path(__file__).parent / "precompiled"
PROGRAMS = sorted(path.name for path in HERE.iterdir() if path.suffix in (".c", ".cpp"))
TIMES = precompiled.MANY + 1
CORPUS = os.environ.get("ROBOSMI_CORPUS", "")


@pytest.fixture(autouse=True)
def early(monkeypatch: pytest.MonkeyPatch) -> None:
    """Precompile small headers too, from the second file on."""
    monkeypatch.setattr(precompiled, "LEAST", 0)
    monkeypatch.setattr(precompiled, "ENOUGH", 2)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The programs with their headers, at a place that no other test has seen."""
    return Path(shutil.copytree(HERE, tmp_path / "programs"))


def kept(path: Path, *folders: Path) -> precompiled.Beginning | None:
    """The precompiled header that is used for a file, None if there is none."""
    api, source, names = ApiIndex.load("propeller"), read_source(path), list(map(str, folders))
    return precompiled.beginning(source, api, arguments(api, source.language, names, ()), Folders(names))


def read(path: Path, *folders: Path) -> tuple[bytes, list[Finding]]:
    """The model as XMI, and the findings."""
    try:
        program, findings = read_program(path, include_dirs=folders)
    except RobosmiError as error:
        return str(error).encode(), []
    return to_xmi({"code.xmi": program})["code.xmi"], findings


def calls(path: Path, *folders: Path) -> list[tuple[str, str | None]]:
    """The names of what is called, with the headers that declare them."""
    program, _ = read_program(path, include_dirs=folders)
    return [(str(call.calleeName), call.callee.header) for call in all_of_kind(program, ccode.Call) if call.callee]


@pytest.mark.parametrize("name", PROGRAMS)
def test_each_reading_gives_the_same(name: str, folder: Path) -> None:
    first = read(folder / name, folder / "include")
    for _ in range(TIMES):
        assert read(folder / name, folder / "include") == first


@pytest.mark.parametrize("name", PROGRAMS)
def test_the_view_on_demand_is_the_same_too(name: str, folder: Path) -> None:
    def seen() -> list[tuple[str, ...]]:
        try:
            model = open_program(folder / name, include_dirs=[folder / "include"])
            return [
                (kind, str(getattr(one, "name", None) or getattr(one, "calleeName", None)), str(one.startOffset))
                for kind in ("Function", "Variable", "Call", "MacroUse", "Include")
                for one in all_of_kind(model, kind)
            ]
        except RobosmiError as error:
            return [(str(error),)]

    first = seen()
    assert [seen() for _ in range(precompiled.ENOUGH)] == [first] * precompiled.ENOUGH


@pytest.mark.parametrize(
    ("name", "headers"),
    [
        ("plain.c", ["board.h", "motor.h"]),
        ("code_between.c", ["board.h"]),
        ("missing_header.c", ["board.h"]),
        ("beside.c", ["beside.h", "board.h"]),
        ("included_again.c", ["unguarded.h", "board.h"]),
        ("marked_crlf.c", ["board.h"]),
    ],
)
def test_what_a_text_begins_with_is_kept_from_the_second_reading_on(name: str, headers: list[str], folder: Path) -> None:
    assert kept(folder / name, folder / "include") is None
    found = kept(folder / name, folder / "include")
    assert found is not None
    assert list(dict.fromkeys(Path(p).name for p in found.inclusions if p.startswith(str(folder)))) == headers
    assert "#include" not in found.blank((folder / name).read_bytes())[: found.end].decode()
    assert len(found.blank((folder / name).read_bytes())) == (folder / name).stat().st_size


@pytest.mark.parametrize("name", ["macro_before.c", "condition_before.c", "broken_header.c", "object.cpp"])
def test_headers_that_mean_something_else_elsewhere_are_not_kept(name: str, folder: Path) -> None:
    assert [kept(folder / name, folder / "include") for _ in range(TIMES)] == [None] * TIMES


@pytest.mark.parametrize("comment", ["/* never closed", "/*/"])
def test_an_include_with_a_comment_that_never_ends_is_not_kept(comment: str, folder: Path) -> None:
    path = folder / "open_comment.c"
    path.write_text(f'#include "board.h" {comment}\nint main() {{ return get_input(LED); }}\n')
    first = read(path, folder / "include")
    assert [read(path, folder / "include") for _ in range(3)] == [first] * 3
    assert kept(path, folder / "include") is None


def test_programs_with_the_same_beginning_share_it(folder: Path) -> None:
    for name in ("plain.c", "damaged.c"):
        read(folder / name, folder / "include")
    found = kept(folder / "plain.c", folder / "include")
    other = kept(folder / "damaged.c", folder / "include")
    assert found is not None
    assert other is not None
    assert found.file == other.file
    assert found.end > other.end, "the comments differ"


def test_more_headers_are_kept_when_many_begin_with_them(folder: Path) -> None:
    read(folder / "code_between.c", folder / "include")
    read(folder / "code_between.c", folder / "include")
    short = [kept(folder / "plain.c", folder / "include") for _ in range(precompiled.MANY - 1)]
    assert all(one is not None and len(one.inclusions) < 3 for one in short)
    longer = kept(folder / "plain.c", folder / "include")
    assert longer is not None
    assert len(longer.inclusions) == 3


@pytest.mark.parametrize(("lines", "times"), [(100, 0), (5_000, 3)])
def test_headers_that_are_read_again_in_less_time_are_not_kept(
    lines: int, times: int, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(precompiled, "LEAST", 60_000)
    with (folder / "include" / "motor.h").open("a") as header:
        header.write("int unused;\n" * lines)
    assert sum(kept(folder / "plain.c", folder / "include") is not None for _ in range(4)) == times


def test_a_header_that_was_changed_counts_at_once(folder: Path) -> None:
    board = folder / "include" / "board.h"
    for _ in range(3):
        read(folder / "plain.c", folder / "include")
    before = board.stat()
    board.write_text(board.read_text().replace("get_input", "got_input"))  # same length, and the parser sees seconds only
    os.utime(board, ns=(before.st_atime_ns, before.st_mtime_ns + 1))
    (folder / "plain.c").write_text((folder / "plain.c").read_text().replace("get_input", "got_input"))
    assert ("got_input", "include/board.h") in calls(folder / "plain.c", folder / "include")


def test_the_parser_itself_notices_a_change_behind_our_back(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precompiled.Beginning, "current", True)
    for _ in range(3):
        read(folder / "plain.c", folder / "include")
    board = folder / "include" / "board.h"
    board.write_text(board.read_text().replace("get_input(int pin);", "get_input(int pin, int more);\nint another(void);"))
    source = (folder / "plain.c").read_text().replace("counter++", "another()")
    (folder / "plain.c").write_text(source)
    assert ("another", "include/board.h") in calls(folder / "plain.c", folder / "include")


def test_a_header_that_comes_to_stand_before_another_counts_at_once(folder: Path) -> None:
    first = folder / "first"
    first.mkdir()
    for _ in range(3):
        read(folder / "plain.c", first, folder / "include")
    (first / "board.h").write_text("int get_input(int pin);\nint only_here(void);\n")
    (folder / "plain.c").write_text('#include "board.h"\n#include "motor.h"\nint main() { return only_here(); }\n')
    assert calls(folder / "plain.c", first, folder / "include") == [("only_here", "first/board.h")]


def test_a_header_that_comes_to_stand_beside_another_counts_at_once(folder: Path) -> None:
    inner = folder / "include" / "inner"
    inner.mkdir()
    (inner / "drive.h").write_text('#include "board.h"\n')
    program = folder / "inner.c"
    program.write_text('#include "inner/drive.h"\nint main() { return only_here(); }\n')
    for _ in range(3):
        assert calls(program, folder / "include") == [("only_here", "")]
    (inner / "board.h").write_text("int only_here(void);\n")
    assert calls(program, folder / "include") == [("only_here", "include/inner/board.h")]


def test_a_header_that_is_gone_is_missing(folder: Path) -> None:
    for _ in range(3):
        read(folder / "plain.c", folder / "include")
    (folder / "include" / "motor.h").unlink()
    _, findings = read(folder / "plain.c", folder / "include")
    assert [f.rule for f in findings if "motor.h" in f.message] == ["RS103"]


def test_without_a_place_to_keep_it_all_goes_as_before(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(**_: object) -> None:
        raise OSError("no space left on device")

    mine = precompiled._Kept()
    monkeypatch.setattr(precompiled, "_kept", lambda process: mine)
    monkeypatch.setattr(tempfile, "TemporaryDirectory", full)
    first = read(folder / "plain.c", folder / "include")
    assert [read(folder / "plain.c", folder / "include") for _ in range(2)] == [first] * 2
    assert kept(folder / "plain.c", folder / "include") is None


def test_what_was_kept_may_vanish(folder: Path) -> None:
    first = read(folder / "plain.c", folder / "include")
    read(folder / "plain.c", folder / "include")
    found = kept(folder / "plain.c", folder / "include")
    assert found is not None
    Path(found.file).unlink()
    assert read(folder / "plain.c", folder / "include") == first
    Path(found.file).write_bytes(b"no precompiled header")
    assert read(folder / "plain.c", folder / "include") == first


def test_threads_share_what_is_kept(folder: Path) -> None:
    first = read(folder / "plain.c", folder / "include")
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(lambda _: read(folder / "plain.c", folder / "include"), range(40))) == [first] * 40


def _read_often(folder: Path) -> list[str]:
    for _ in range(3):
        read(folder / "plain.c", folder / "include")
    found = kept(folder / "plain.c", folder / "include")
    return [found.file] if found is not None else []


@pytest.mark.parametrize("method", [m for m in ("spawn", "fork") if m in multiprocessing.get_all_start_methods()])
def test_a_worker_leaves_nothing_behind(method: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with (folder / "include" / "motor.h").open("a") as header:
        header.write("int unused;\n" * 10_000)  # so that it is kept in a process that knows nothing of this one's settings
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context(method)) as pool:
        (file,) = pool.submit(_read_often, folder).result()
        assert Path(file).exists()
    assert not Path(file).exists()
    assert not Path(file).parent.exists()


def test_no_more_than_so_many_are_kept(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precompiled, "MOST", 2)
    programs = ["plain.c", "beside.c", "undeclared.c"]
    made = []
    for name in programs:
        kept(folder / name, folder / "include")
        made.append(kept(folder / name, folder / "include"))
    assert [one is not None and Path(one.file).exists() for one in made] == [False, True, True]


@pytest.mark.skipif(not CORPUS, reason="ROBOSMI_CORPUS does not name a folder with the corpus")
def test_real_programs_give_the_same_with_it_and_without(monkeypatch: pytest.MonkeyPatch) -> None:
    from tests.bench.c_source import corpus, headers

    folders = [Path(name) for name in headers()]

    def models() -> Iterator[tuple[bytes, list[Finding]] | str]:
        for path in corpus():
            try:
                yield read(path, *folders)
            except RobosmiError as error:
                yield str(error)

    monkeypatch.setattr(precompiled, "ENOUGH", 10**9)
    plain = list(models())
    monkeypatch.setattr(precompiled, "ENOUGH", 1)
    assert list(models()) == plain
