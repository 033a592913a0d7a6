"""A save in place keeps what the model does not own: layout, comments, encoding, foreign parts; an edit changes few lines."""

from __future__ import annotations

from collections.abc import Callable
from difflib import unified_diff
from pathlib import Path
from typing import Any

import pytest

from robosmi.model import EmfModel, open_model
from robosmi.model.xmi.xmi_writer import to_xmi

SPLIT = Path(__file__).parent / "split"
LAYOUTS = Path(__file__).parent / "layouts"
COMMENTED = LAYOUTS / "commented.xmi"


def opened(path: Path) -> Any:
    return open_model(path, metamodel=SPLIT / "g.ecore")


def canonical(path: Path) -> bytes:
    return to_xmi({"m.xmi": opened(path).roots})["m.xmi"]


def changed(old: bytes, new: bytes) -> list[str]:
    """The lines of a diff without its head."""
    before, after = (each.decode("latin-1").splitlines() for each in (old, new))
    return [line for line in unified_diff(before, after, n=0, lineterm="") if line[:1] in "+-" and line[:3] not in ("+++", "---")]


@pytest.mark.parametrize("newline", [b"\n", b"\r\n"])
@pytest.mark.parametrize("encoding", ["ASCII", "ISO-8859-1", "UTF-8", "UTF-16"])
def test_a_file_that_was_not_edited_keeps_its_bytes(encoding: str, newline: bytes, tmp_path: Path) -> None:
    text = COMMENTED.read_text().replace("ASCII", encoding).replace("\n", newline.decode())
    (tmp_path / "m.xmi").write_bytes(before := text.encode(encoding))
    model = opened(tmp_path / "m.xmi")
    assert [finding.rule for finding in model.findings] == ["RS610", "RS610"]
    model.save()
    assert (tmp_path / "m.xmi").read_bytes() == before
    model.save(tmp_path / "copy.xmi")
    assert (tmp_path / "copy.xmi").read_bytes() == before
    model.save(tmp_path / "copy.json")
    assert [finding.rule for finding in model.findings] == ["RS610", "RS610", "RS612"]


@pytest.mark.parametrize("case", sorted(LAYOUTS.glob("*_elsewhere")), ids=lambda path: path.name)
def test_a_model_without_comments_is_as_emf_writes_it_in_another_place(case: Path, tmp_path: Path) -> None:
    (tmp_path / "m.xmi").write_bytes(before := (case / "m.xmi").read_bytes())
    model = EmfModel.load(tmp_path / "m.xmi", case / "m.ecore")
    model.save(tmp_path / "copy.xmi")
    assert (tmp_path / "copy.xmi").read_bytes() == (case / "emf.xmi").read_bytes()
    model.save()
    assert (tmp_path / "m.xmi").read_bytes() == before


def test_an_edit_of_one_of_several_roots_changes_its_line(tmp_path: Path) -> None:
    (tmp_path / "m.xmi").write_bytes(before := (LAYOUTS / "several_roots.xmi").read_bytes())
    model = opened(tmp_path / "m.xmi")
    model.Group.all[1].name = "c"
    model.Group.all[0].nodes[0].weight = 2
    model.save()
    assert changed(before, (tmp_path / "m.xmi").read_bytes()) == [
        """-     <nodes weight="1" name="n1" xmi:id="_1" />""",
        """+     <nodes weight="2" name="n1" xmi:id="_1" />""",
        """-  <g:Group xmi:id="_b" name='b' />""",
        """+  <g:Group xmi:id="_b" name="c" />""",
    ]


def rename(m: Any) -> None:
    m.Node.all[1].name = "ß"


def reweigh(m: Any) -> None:
    m.Node.all[2].weight = 7


def add(m: Any) -> None:
    m.Group.all[0].nodes.insert(1, m.Node(name="new"))


def add_first_out(m: Any) -> None:
    m.Group.all[0].edges.append(m.Edge(name="f", source=m.Node.all[2]))


def remove(m: Any) -> None:
    m.delete(m.Node.all[2])


def add_group(m: Any) -> None:
    m.roots[0].groups.append(m.Group(name="b", nodes=[m.Node(name="x")]))


def swap(m: Any) -> None:
    nodes = m.Group.all[0].nodes
    first = nodes[0]
    nodes.remove(first)
    nodes.append(first)


def empty(m: Any) -> None:
    m.delete(m.Group.all[0])


EDITS: list[tuple[Callable[[Any], None], int]] = [
    (rename, 2), (reweigh, 2), (add, 1), (add_first_out, 3), (remove, 2), (add_group, 3), (swap, 4), (empty, 20),
]  # fmt: skip


@pytest.mark.parametrize(("edit", "most"), EDITS)
def test_an_edit_changes_few_lines(edit: Callable[[Any], None], most: int, tmp_path: Path) -> None:
    path = tmp_path / "m.xmi"
    path.write_bytes(before := COMMENTED.read_bytes())
    model = opened(path)
    edit(model)
    wanted = to_xmi({"m.xmi": model.roots})["m.xmi"]
    model.save()
    after = path.read_bytes()
    assert canonical(path) == wanted
    assert len(changed(before, after)) <= most, "\n".join(changed(before, after))
    for kept in (b"<!--Version_7.1.0-->", b"<?tool keep this?>", b"<!-- end -->", b"xmi:Documentation", b"st:Block", b"20131001"):
        assert kept in after
    model.Graph.all[0].name = "again"
    model.save()
    assert opened(path).Graph.all[0].name == "again"
    assert b"<!-- end -->" in path.read_bytes()


def test_a_file_that_somebody_else_changed_is_kept_beside(tmp_path: Path) -> None:
    path = tmp_path / "m.xmi"
    path.write_bytes(COMMENTED.read_bytes())
    model = opened(path)
    path.write_bytes(theirs := COMMENTED.read_bytes().replace(b"<!-- end -->", b"<!-- theirs -->"))
    model.Node.all[0].name = "mine"
    model.save()
    assert (tmp_path / "m.xmi.orig").read_bytes() == theirs
    assert opened(path).Node.all[0].name == "mine"


def test_comments_of_a_metamodel_that_is_edited_stay_in_it(tmp_path: Path) -> None:
    path = tmp_path / "g.ecore"
    path.write_bytes(before := (SPLIT / "g.ecore").read_bytes().replace(b"?>\n", b"?>\n<!-- by hand -->\n", 1))
    model = EmfModel.load(path)
    model.EClass.all[0].name = "Named2"
    model.save()
    assert path.read_bytes() == before.replace(b'"Named"', b'"Named2"').replace(b"#//Named", b"#//Named2")
    assert not (tmp_path / "g.ecore.orig").exists()
