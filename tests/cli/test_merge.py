"""`robosmi merge`: exit code, document, text, and what is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.model import open_model
from tests.running import run

SPLIT = Path(__file__).parents[1] / "model" / "split"
SOURCE = (SPLIT / "ok.xmi").read_text()
METAMODEL = ("--metamodel", SPLIT / "g.ecore")


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    """A base with a comment, and two models of it that changed the weight of a node and of another."""
    texts = {
        "base": SOURCE,
        "a": SOURCE.replace("<groups", "<!-- a note -->\n  <groups").replace('weight="1"', 'weight="5"'),
        "b": SOURCE.replace('weight="2"', 'weight="6"'),
    }
    for name, text in texts.items():
        (tmp_path / f"{name}.xmi").write_text(text)
    return [tmp_path / f"{name}.xmi" for name in texts]


def test_what_both_changed_is_written_in_the_layout_of_the_first(files: list[Path], tmp_path: Path) -> None:
    done = run("merge", *files, "-o", tmp_path / "m.xmi", *METAMODEL, "--json")
    assert (done.code, done.document["ok"], done.result["conflicts"]) == (0, True, [])
    assert done.document["artifacts"] == [{"path": str(tmp_path / "m.xmi"), "kind": "model"}]
    assert (tmp_path / "m.xmi").read_text() == files[1].read_text().replace('weight="2"', 'weight="6"')


@pytest.mark.parametrize("ending", [".xmi", ".json", ".yaml"])
def test_the_merged_model_may_take_the_place_of_the_first(files: list[Path], ending: str) -> None:
    given = [path.with_suffix(ending) for path in files]
    for path, target in zip(files, given, strict=True):
        if path != target:
            open_model(path, metamodel=METAMODEL[1]).save(target)
    assert run("merge", *given, "-o", given[1], *METAMODEL).code == 0
    assert [node.weight for node in open_model(given[1], metamodel=METAMODEL[1]).Node.all][:2] == [5, 6]


def test_with_conflicts_nothing_is_written(files: list[Path], tmp_path: Path) -> None:
    files[2].write_text(SOURCE.replace('weight="1"', 'weight="7"').replace('weight="2"', 'weight="6"'))
    target = tmp_path / "m.xmi"
    before = [path.read_bytes() for path in files]
    done = run("merge", *files, "-o", target, *METAMODEL, "--json")
    assert (done.code, done.document["ok"], done.document["artifacts"], target.exists()) == (1, False, [], False)
    (conflict,) = done.result["conflicts"]
    assert {key: conflict[key] for key in ("element", "feature", "base", "a", "b")} == {
        "element": "//@groups.0/@nodes.0", "feature": "weight", "base": 1, "a": 5, "b": 7,
    }  # fmt: skip
    (finding,) = done.document["findings"]
    assert (finding["rule"], finding["element"], finding["location"]["path"]) == ("RS660", conflict["element"], str(files[1]))
    assert finding["location"]["line"] == 5
    assert 'weight="5"' in files[1].read_text().splitlines()[4]
    text = run("merge", *files, "-o", files[1], *METAMODEL)
    assert (text.code, [path.read_bytes() for path in files]) == (1, before)
    assert "RS660" in text.out + text.err


@pytest.mark.parametrize(("side", "weight"), [("a", "5"), ("b", "7")])
def test_a_side_may_win_the_conflicts(files: list[Path], side: str, weight: str) -> None:
    files[2].write_text(SOURCE.replace('weight="1"', 'weight="7"').replace('weight="2"', 'weight="6"'))
    done = run("merge", *files, "-o", files[1], *METAMODEL, "--take", side, "--json")
    assert (done.code, len(done.result["conflicts"])) == (0, 1)
    written = files[1].read_text()
    assert f'weight="{weight}"' in written
    assert 'weight="6"' in written
    assert "a note" in written


def test_a_file_that_is_no_model_stays(files: list[Path], tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    done = run("merge", *files, "-o", tmp_path / "notes.txt", *METAMODEL, "--json")
    assert done.code not in (0, 1)
    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_files_of_git_without_an_ending_are_read_by_their_content(files: list[Path], tmp_path: Path) -> None:
    named = [path.rename(tmp_path / f".merge_file_{path.stem}") for path in files]
    done = run("merge", *named, "-o", named[1], *METAMODEL)
    assert done.code == 0
    assert 'weight="6"' in named[1].read_text()
