"""Damaged XMI: every problem is told with its line, nothing crashes, nothing is expanded or fetched, and an old file stays whole.

The cases are files: `xmi/bad/NAME.xmi` with the problems that must be told, one a line, in `NAME.txt`.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from robosmi.errors import ModelError, RobosmiError, SourceError
from robosmi.files.files import write_atomic
from robosmi.model.elements.structure import walk
from robosmi.model.xmi.xmi_reader import DamagedModelError, UnreadableModelError, read_documents
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.emf_judge import judge
from tests.model.kitchen import BENCH, FOLDER, KITCHEN, again, classes, kitchen, saved

ROOT = Path(__file__).parents[2]
HEAD = (
    '<kitchen:Root xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
    'xmlns:kitchen="http://lab/kitchen" name="r"'
)
CALL = HEAD.replace("kitchen:Root", "benchmm:Call").replace("kitchen", "benchmm").replace("lab/benchmm", "robosmi/bench") + ">"


def problems(path: Path, loader: str = "own") -> list[str]:
    """What is wrong with a file, as `line: text`."""
    with pytest.raises((DamagedModelError, UnreadableModelError)) as caught:
        read_documents(path, kitchen(loader))
    assert isinstance(caught.value, (DamagedModelError, UnreadableModelError))
    return [f"{location.line}: {text}" for location, text in caught.value.problems]


@pytest.mark.parametrize("loader", ["own", "pyecore"])
@pytest.mark.parametrize("path", sorted((FOLDER / "bad").glob("*.xmi")), ids=lambda p: p.stem)
def test_all_problems_are_told_with_their_lines(path: Path, loader: str) -> None:
    assert problems(path, loader) == path.with_suffix(".txt").read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize("path", sorted((FOLDER / "bad").glob("*.xmi")), ids=lambda p: p.stem)
def test_a_damaged_file_is_the_users_mistake_with_a_place_and_an_advice(path: Path) -> None:
    with pytest.raises((SourceError, ModelError)) as caught:
        read_documents(path, kitchen())
    assert caught.value.exit_code == 3
    assert caught.value.fix
    assert caught.value.location is not None
    assert caught.value.location.path == str(path)
    assert caught.value.location.line


def test_lines_beyond_65535_are_told(tmp_path: Path) -> None:
    file = tmp_path / "long.xmi"
    file.write_text(
        f'{HEAD} main="//@items.7">\n' + '<items name="a"/>\n' * 5 + "\n" * 100_000 + '<items nmae="b"/>\n</kitchen:Root>'
    )
    assert problems(file) == [
        "1: Root.main: '//@items.7' leads to nothing",
        "100007: Item has no feature 'nmae' (did you mean 'name'?)",
        "100007: Item has no 'name', which it needs",
    ]


def test_bounds_may_be_left_unchecked(tmp_path: Path) -> None:
    (tmp_path / "a.xmi").write_text(f"{HEAD}><items/></kitchen:Root>")
    found = read_documents(tmp_path / "a.xmi", kitchen(), strict=False)
    assert len(found[tmp_path / "a.xmi"].roots[0].items) == 1
    with pytest.raises(ModelError, match="has no 'name'"):
        read_documents(tmp_path / "a.xmi", kitchen())


def test_an_expansion_bomb_costs_nothing(tmp_path: Path) -> None:
    entities = "".join(f'<!ENTITY e{n + 1} "{f"&e{n};" * 10}">' for n in range(9))
    file = tmp_path / "bomb.xmi"
    file.write_text(f'<!DOCTYPE x [<!ENTITY e0 "lol">{entities}]>\n{HEAD} name2="&e9;"/>')
    start = time.perf_counter()
    assert problems(file) == ["1: a model with a DOCTYPE is refused"]
    assert time.perf_counter() - start < 1


def deep(depth: int) -> str:
    """A chain of calls, each the argument of the one before."""
    return CALL + '<args xsi:type="benchmm:Call">' * depth + "</args>" * depth + "</benchmm:Call>"


@pytest.mark.parametrize("loader", ["own", "pyecore"])
def test_nothing_recurses_over_depth(loader: str, tmp_path: Path) -> None:
    """Neither reading nor writing nor the walk; pyecore's own setters cope as well, since asking for the resource is a loop."""
    metamodel = kitchen(loader, BENCH)
    file = tmp_path / "deep.xmi"
    file.write_text(deep(3000))
    document = next(iter(read_documents(file, metamodel).values()))
    elements = list(walk(document.roots[0]))
    assert len(elements) == 3001
    elements[-1].line = 7
    assert elements[-1].eResource is None
    data = saved(document.roots, file)
    assert again(file, metamodel) == data
    assert data.count(b'line="7"') == 1


def test_100_000_levels_are_read(tmp_path: Path) -> None:
    file = tmp_path / "deep.xmi"
    file.write_text(deep(100_000))
    document = next(iter(read_documents(file, kitchen("own", BENCH)).values()))
    assert sum(1 for _ in walk(document.roots[0])) == 100_001


def test_emf_takes_a_depth_of_200(tmp_path: Path) -> None:
    file = tmp_path / "deep.xmi"
    file.write_text(deep(200))
    data = again(file, kitchen("own", BENCH))
    file.write_bytes(data)
    judge([BENCH], file)


def test_containment_across_files_may_not_close_a_circle(tmp_path: Path) -> None:
    for own, other in (("a", "b"), ("b", "a")):
        (tmp_path / f"{own}.xmi").write_text(f'{CALL}\n<args xsi:type="benchmm:Call" href="{other}.xmi#/"/></benchmm:Call>')
    with pytest.raises(DamagedModelError) as caught:
        read_documents(tmp_path / "a.xmi", kitchen("own", BENCH))
    assert [(Path(p.path).name, p.line, text) for p, text in caught.value.problems] == [
        ("b.xmi", 2, "Call.args would make <Call name='r'> contain itself")
    ]


def test_an_element_that_contains_itself_is_refused() -> None:
    k = SimpleNamespace(**classes(kitchen("own", BENCH)))
    outer, inner = k.Call(name="outer"), k.Call(name="inner")
    before = to_xmi({"a.xmi": outer})
    with pytest.raises(ModelError, match="cannot be put into"):
        outer.args.append(outer)
    assert to_xmi({"a.xmi": outer}) == before
    outer.args.append(inner)
    with pytest.raises(ModelError, match="cannot be put into"):
        inner.args.append(outer)
    assert (list(outer.args), list(inner.args)) == ([inner], [])


@pytest.mark.parametrize(("were_read", "refusal"), [(True, ModelError), (False, RecursionError)])
def test_an_element_of_pyecore_that_contains_itself_is_not_written(
    were_read: bool, refusal: type[Exception], tmp_path: Path
) -> None:
    metamodels = kitchen.__wrapped__("pyecore", BENCH)  # new classes: the reader makes pyecore's own a little like ours
    if were_read:
        (tmp_path / "a.xmi").write_text(f"{CALL}</benchmm:Call>")
        read_documents(tmp_path / "a.xmi", metamodels)
    k = SimpleNamespace(**classes(metamodels))
    outer, inner = k.Call(name="outer"), k.Call(name="inner")
    to_xmi({"a.xmi": outer})
    outer.args.append(inner)
    with pytest.raises(refusal, match=r"contains itself|recursion"):
        inner.args.append(outer)
    with pytest.raises(ModelError, match=r"contains <Call name='outer'>"):
        to_xmi({"a.xmi": outer})


def test_an_element_in_two_containers_is_not_written() -> None:
    k = SimpleNamespace(**classes(kitchen("own", BENCH)))
    first, second, part = k.Call(name="a"), k.Call(name="b"), k.Call(name="c")
    first.args.append(part)
    list_of_second = second.args
    list_of_second.map[part] = 0  # as no setter of pyecore's would
    list_of_second.items.append(part)
    with pytest.raises(ModelError, match=r"<Call name='b'>\.args contains <Call name='c'>, whose container is <Call name='a'>"):
        to_xmi({"a.xmi": second})


def test_a_truncation_anywhere_is_told_and_nothing_else_comes_out(tmp_path: Path) -> None:
    data = (FOLDER / "good" / "xmi_ids_everywhere.xmi").read_bytes()
    file = tmp_path / "cut.xmi"
    for length in range(0, len(data.rstrip()) - 1, 7):
        file.write_bytes(data[:length])
        with pytest.raises(RobosmiError) as caught:
            read_documents(file, kitchen())
        assert caught.value.location is not None


SAVE = """
import resource, signal, sys
from pathlib import Path
from robosmi.model import save_model
from robosmi.metamodels import ccode
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
model = ccode.Program(name="p", units=[ccode.SourceUnit(path=f"{n}.c") for n in range(20_000)])
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
save_model(model, Path(sys.argv[1]))
"""


def run(script: str, *arguments: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", script, *map(str, arguments)], capture_output=True, text=True, cwd=ROOT, check=False
    )


def test_a_full_disk_leaves_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "model.xmi"
    target.write_text("old")
    done = run(SAVE, target)
    assert "cannot write here: File too large" in done.stderr
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["model.xmi"]


KILL = """
import os, signal, sys
from pathlib import Path
import robosmi.files.files as files
from robosmi.model import save_model
from robosmi.metamodels import ccode
real = os.replace
def killed(source, target):
    os.kill(os.getpid(), signal.SIGKILL)
os.replace = killed
save_model(ccode.Program(name="new"), Path(sys.argv[1]))
"""


def test_a_kill_before_the_rename_leaves_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "model.xmi"
    target.write_text("old")
    assert run(KILL, target).returncode == -signal.SIGKILL
    assert target.read_text() == "old"


def test_a_file_is_on_disk_before_it_takes_the_place_of_the_old(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    order: list[str] = []
    monkeypatch.setattr(os, "fsync", lambda descriptor: order.append("written"))
    rename = os.replace

    def noted(source: Any, target: Any) -> None:
        order.append("renamed")
        rename(source, target)

    monkeypatch.setattr(os, "replace", noted)
    write_atomic(tmp_path / "a.txt", b"x")
    assert order == ["written", "renamed"]


def test_a_refused_model_leaves_the_old_file(tmp_path: Path) -> None:
    from robosmi.model.emf import EmfModel

    k = SimpleNamespace(**classes(kitchen()))
    target = tmp_path / "model.xmi"
    target.write_text("old")
    root = k.Root(name="r", main=k.Item(name="out"))
    with pytest.raises(ModelError, match="in none of the models"):
        EmfModel(root, kitchen().packages).save(target)
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["model.xmi"]


def test_a_metamodel_that_cannot_be_read_is_told_as_such(tmp_path: Path) -> None:
    from robosmi.model.ecore.metamodels import Metamodels

    (tmp_path / "kitchen.ecore").write_text("<nothing/>")
    file = tmp_path / "x.xmi"
    shutil.copy(FOLDER / "good" / "schemalocation.xmi", file)
    file.write_text(file.read_text().replace("../../../emf/kitchen.ecore", "kitchen.ecore"))
    with pytest.raises(UnreadableModelError, match="no EPackage"):
        read_documents(file, Metamodels())
    assert KITCHEN.is_file()
