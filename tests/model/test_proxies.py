"""Reading and validating are two things: bounds and references that lead nowhere are findings, and proxies stay when saved."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, SourceError
from robosmi.model import EmfModel, Session, open_model
from robosmi.model.elements.proxies import proxy_uri
from tests.emf_judge import look
from tests.recording.written_models import FOLDER
from tests.running import run

SPLIT = Path(__file__).parent / "split"
CIRCLES = Path(__file__).parent / "circles"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of models; what is written there is not judged by itself, for EMF says rightly what is unresolved."""
    monkeypatch.delenv(FOLDER, raising=False)
    shutil.copytree(SPLIT, tmp_path, dirs_exist_ok=True)
    return tmp_path


def opened(folder: Path, name: str, **options: Any) -> Any:
    return open_model(folder / name, metamodel=folder / "g.ecore", **options)


def rules(model: EmfModel) -> list[tuple[str, int | None]]:
    return [(finding.rule, finding.location.line if finding.location else None) for finding in model.findings]


def test_missing_values_are_findings_of_one_kind_each(folder: Path) -> None:
    text = (folder / "g.ecore").read_text().replace('name="weight"', 'name="weight" lowerBound="1"')
    (folder / "g.ecore").write_text(text.replace('name="name"', 'name="name" lowerBound="1"'))
    (folder / "ok.xmi").write_text((folder / "ok.xmi").read_text().replace(' name="n1"', "").replace(' name="n2"', ""))
    model = opened(folder, "ok.xmi")
    assert rules(model) == [("RS608", 4)]
    assert "1 more" in model.findings[0].message
    (other,) = model.findings[0].listed("more")
    assert (other["location"]["line"], other["message"]) == (5, "Node has no 'name', which it needs")
    shown = [
        run("check", folder / "ok.xmi", "--metamodel", folder / "g.ecore", *options).out.count("Node has no 'name'")
        for options in ((), ("-v",))
    ]
    assert shown == [1, 2]
    for options in ({"strict": True}, {"lenient": False}):
        with pytest.raises(ModelError, match="Node has no 'name'"):
            opened(folder, "ok.xmi", **options)


def test_a_missing_neighbour_leaves_proxies_that_are_saved(folder: Path) -> None:
    (folder / "ok.xmi").unlink()
    before = (folder / "w.xmi").read_bytes()
    model = opened(folder, "w.xmi")
    (edge,) = model.Edge.all
    assert proxy_uri(edge.source) == "ok.xmi#//@groups.0/@nodes.1"
    assert (edge.source.name, isinstance(edge.source, model.Node), model.Node.all) == (None, True, [])
    assert rules(model) == [("RS609", 4)]
    with pytest.raises(ModelError, match="stands for an element that was not found"):
        edge.source.name = "lost"
    edge.name = "renamed"
    model.save()
    assert (folder / "w.xmi").read_bytes() == before.replace(b'"x"', b'"renamed"')
    (folder / "sub").mkdir()
    model.save(folder / "sub" / "w.xmi")
    shutil.copy(SPLIT / "ok.xmi", folder)
    assert opened(folder, "sub/w.xmi").Edge.all[0].source.name == "n2"
    (folder / "v.xmi").write_bytes(before.replace(b"ok.xmi", b"no.xmi"))
    with pytest.raises(SourceError, match=r"no\.xmi"):
        opened(folder, "v.xmi", strict=True)


def test_a_missing_part_is_a_proxy_and_no_empty_element(folder: Path) -> None:
    (folder / "q.xmi").unlink()
    model = opened(folder, "p.xmi")
    model.roots[0].groups.append(model.Group(name="second"))
    model.save()
    assert b'<groups href="q.xmi#/"/>\n  <groups name="second"/>' in (folder / "p.xmi").read_bytes()
    assert "q.xmi" in look([folder / "g.ecore"], folder / "p.xmi").text


def test_foreign_fragments_stay_and_a_hook_resolves_them(folder: Path) -> None:
    foreign = (folder / "ok.xmi").read_text().replace("//@groups.0/@nodes.0", "n1?type=Node")
    (folder / "ok.xmi").write_text(foreign)
    model = opened(folder, "ok.xmi")
    assert (proxy_uri(model.Edge.all[0].source), rules(model)) == ("n1?type=Node", [("RS609", 6)])
    model.save()
    assert (folder / "ok.xmi").read_text() == foreign
    model.save(folder / "copy.xmi")
    assert 'source="n1?type=Node"' in (folder / "copy.xmi").read_text()
    asked = []

    def by_name(uri: str, file: Path, roots: list[Any]) -> Any:
        asked.append((uri, file.name))
        return next((node for node in roots[0].groups[0].nodes if node.name == uri.partition("?")[0]), None)

    resolved: Any = Session(resolve=by_name).open_model(folder / "ok.xmi", metamodel=folder / "g.ecore")
    assert (resolved.Edge.all[0].source.name, rules(resolved), asked) == ("n1", [], [("n1?type=Node", "ok.xmi")])
    assert list(resolved.Node.all[0].out) == resolved.Edge.all
    resolved.save()
    assert (folder / "ok.xmi").read_text() == foreign
    resolved.Edge.all[0].name = "renamed"
    resolved.save()
    assert (folder / "ok.xmi").read_text() == foreign.replace('"e"', '"renamed"')
    resolved.Edge.all[0].source = resolved.Node.all[1]
    resolved.save()
    assert 'source="//@groups.0/@nodes.1"' in (folder / "ok.xmi").read_text()


def test_a_hook_is_asked_again_when_a_further_file_is_open(folder: Path) -> None:
    link = "app:/#n2?type=Node"
    (folder / "w.xmi").write_text((folder / "w.xmi").read_text().replace("ok.xmi#//@groups.0/@nodes.1", link))
    (folder / "v.xmi").write_text((folder / "w.xmi").read_text().replace("n2?", "nobody?"))
    before = {file: file.read_bytes() for file in folder.glob("*.xmi")}
    asked = []

    def by_name(uri: str, file: Path, roots: list[Any]) -> Any:
        asked.append((uri, file.name))
        name = uri.partition("#")[2].partition("?")[0]
        known: list[Any] = [each for model in session.models for each in model.all_of_kind("Node")]
        return next((node for node in known if node.name == name), None)

    session = Session(resolve=by_name)
    models: list[Any] = [session.open_model(folder / name, metamodel=folder / "g.ecore") for name in ("w.xmi", "v.xmi")]
    (w, v), edge = models, models[0].Edge.all[0]
    assert (proxy_uri(edge.source), rules(w), rules(v)) == (link, [("RS609", 4)], [("RS609", 4)])
    ok: Any = session.open_model(folder / "ok.xmi", metamodel=folder / "g.ecore")
    assert (edge.source, list(edge.source.out)) == (ok.Node.all[1], [edge])
    assert (rules(w), rules(v), asked[0]) == ([], [("RS609", 4)], (link, "w.xmi"))
    assert session.save_all() == []
    assert {file: file.read_bytes() for file in before} == before
    edge.source.name = "renamed"
    assert session.save_all() == [folder / "ok.xmi"]


def test_what_a_hook_finds_is_no_fault_of_the_file(folder: Path) -> None:
    (folder / "w.xmi").write_text((folder / "w.xmi").read_text().replace("ok.xmi#", "app:/#"))
    (folder / "v.xmi").write_text((folder / "w.xmi").read_text().replace("app:/#", "lost.xmi#"))
    session = Session(resolve=lambda uri, file, roots: None if gone else ok.Node.all[1])
    gone = False
    ok: Any = session.open_model(folder / "ok.xmi", metamodel=folder / "g.ecore")
    for name in ("w.xmi", "v.xmi"):
        gone = False
        for strict in (False, True):
            model: Any = session.open_model(folder / name, metamodel=folder / "g.ecore", strict=strict)
            assert (model.Edge.all[0].source, rules(model)) == (ok.Node.all[1], [])
        gone = True
        with pytest.raises((ModelError, SourceError), match=r"app:/|lost\.xmi"):
            session.open_model(folder / name, metamodel=folder / "g.ecore", strict=True)


@pytest.mark.parametrize("uri", ["pathmap://LIB/", "platform:/plugin/org.lib/", "http://example.org/models/"])
def test_uris_are_mapped_to_files(folder: Path, uri: str) -> None:
    (folder / "w.xmi").write_text((folder / "w.xmi").read_text().replace("ok.xmi", f"{uri}ok.xmi"))
    assert rules(opened(folder, "w.xmi")) == [("RS609", 4)]
    before = {file: file.read_bytes() for file in folder.glob("*.xmi")}
    session = Session(uris={uri: folder})
    model: Any = session.open_model(folder / "w.xmi", metamodel=folder / "g.ecore")
    assert (model.Edge.all[0].source.name, rules(model)) == ("n2", [])
    assert session.save_all() == []
    model.save()
    assert {file: file.read_bytes() for file in before} == before
    node = model.Edge.all[0].source
    node.group.nodes.insert(0, model.Node(name="first"))
    session.save_all()
    assert f'href="{uri}ok.xmi#//@groups.0/@nodes.2"' in (folder / "w.xmi").read_text()


def test_a_place_in_a_workspace_is_found_above_the_file(folder: Path) -> None:
    (folder / "org.lib").mkdir()
    (folder / "ok.xmi").rename(folder / "org.lib" / "ok.xmi")
    (folder / "w.xmi").write_text((folder / "w.xmi").read_text().replace("ok.xmi", "platform:/resource/org.lib/ok.xmi"))
    assert opened(folder, "w.xmi").Edge.all[0].source.name == "n2"


def test_a_reference_to_a_proxy_may_be_set_and_deleted(folder: Path) -> None:
    (folder / "ok.xmi").unlink()
    model = opened(folder, "w.xmi")
    edge = model.Edge.all[0]
    other = model.Edge(name="y", target=edge.source)
    model.Group.all[0].edges.append(other)
    model.save()
    assert (folder / "w.xmi").read_text().count('href="ok.xmi#//@groups.0/@nodes.1"') == 2
    edge.source = None
    model.save()
    assert (folder / "w.xmi").read_text().count('href="ok.xmi#//@groups.0/@nodes.1"') == 1


def test_check_and_query_say_what_is_odd(folder: Path) -> None:
    (folder / "ok.xmi").unlink()
    args = [str(folder / "w.xmi"), "--metamodel", str(folder / "g.ecore")]
    for command in (["check", *args], ["query", args[0], "Edge.all.name", *args[1:]]):
        done = run(*command, "--json").document
        assert [finding["rule"] for finding in done["findings"]] == ["RS609"], done


def test_a_reference_to_nothing_in_its_own_file_is_to_be_corrected_there(folder: Path) -> None:
    (folder / "ok.xmi").write_text(
        (folder / "ok.xmi").read_text().replace('target="//@groups.0/@nodes.1"', 'target="//@nodes.9"')
    )
    (finding,) = opened(folder, "ok.xmi").findings
    assert (finding.rule, finding.location and finding.location.line) == ("RS609", 6)
    assert "correct the reference in this file" in str(finding.fix)


@pytest.mark.parametrize(
    ("link", "told"), [("//@groups.0", "it takes Node, not Group"), ("new.xmi#//@groups.0/@nodes.0", "not Node of '")]
)
def test_what_a_feature_takes_is_told_and_two_versions_by_their_namespaces(link: str, told: str, folder: Path) -> None:
    """A neighbour of another version that refers back: classes of one name are told apart."""
    text, target = (folder / "ok.xmi").read_text(), 'target="//@groups.0/@nodes.1"'
    for version, file, back in (("/2", "new.xmi", "ok.xmi#//@groups.0/@nodes.0"), ("", "ok.xmi", link)):
        edge = f'><target href="{back}"/></edges>' if "#" in back else f' target="{back}"/>'
        (folder / file).write_text(text.replace(f" {target}/>", edge).replace("example.org/g", f"example.org/g{version}"))
    (folder / "g2.ecore").write_text((folder / "g.ecore").read_text().replace("example.org/g", "example.org/g/2"))
    with pytest.raises(ModelError, match="contradicts its metamodel") as refused:
        open_model(folder / "ok.xmi", metamodel=[folder / "g.ecore", folder / "g2.ecore"])
    assert told in str(refused.value)
    assert "ok.xmi:6: Edge.target does not take <" in str(refused.value)


@pytest.mark.parametrize("way", ["append", "extend", "insert", "assign", "opposite", "constructor", "without opposite"])
def test_nothing_is_put_into_a_proxy_for_it_would_not_be_saved(way: str, folder: Path) -> None:
    (folder / "q.xmi").unlink()
    model = opened(folder, "p.xmi")
    group, node = model.roots[0].groups[0], model.Node(name="n")
    ways: dict[str, Callable[[], object]] = {
        "append": lambda: group.nodes.append(node),
        "extend": lambda: group.nodes.extend([node]),
        "insert": lambda: group.nodes.insert(0, node),
        "assign": lambda: setattr(group, "nodes", [node]),
        "opposite": lambda: setattr(node, "group", group),
        "constructor": lambda: model.Node(name="m", group=group),
        "without opposite": lambda: group.edges.append(model.Edge(name="e")),
    }
    with pytest.raises(ModelError, match=r"proxy 'q\.xmi#/'> stands for an element that was not found"):
        ways[way]()
    assert (node.group, node.eContainer(), list(group.nodes), list(group.edges)) == (None, None, [], [])
    assert [each.name for each in model.Node.all] == ["n"]


@pytest.mark.parametrize("links", [{"a": "b", "b": "a"}, {"a": "a"}, {"a": "b", "b": "c", "c": "a"}])
def test_a_circle_of_files_ends_at_a_proxy(links: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Eclipse EMF reads each file and finds no end when it walks through them."""
    monkeypatch.delenv(FOLDER, raising=False)
    text = (SPLIT / "p.xmi").read_text().replace("g:Graph", "t:Tree").replace("xmlns:g=", "xmlns:t=").replace('/g"', '/t"')
    for own, other in links.items():
        (tmp_path / f"{own}.xmi").write_text(text.replace("groups", "parts").replace("q.xmi", f"{other}.xmi"))
    session = Session()
    model: Any = session.open_model(tmp_path / "a.xmi", metamodel=CIRCLES / "tree.ecore")
    (finding,) = model.findings
    assert (finding.rule, Path(finding.location.path).stem) == ("RS609", list(links)[-1])
    assert "contain itself" in finding.message
    last = model.roots[0]
    for _ in links:
        (last,) = last.parts
    assert proxy_uri(last) == "a.xmi#/"
    assert session.save_all() == []
    model.roots[0].name = "changed"
    assert [path.name for path in session.save_all()] == ["a.xmi"]
    with pytest.raises(ModelError, match="contain itself"):
        open_model(tmp_path / "a.xmi", metamodel=CIRCLES / "tree.ecore", strict=True)


def test_a_value_that_its_type_does_not_take_stays_in_the_file(folder: Path) -> None:
    """As in Eclipse EMF, the rest of the model is read; EMF would not save the value."""
    text = (folder / "ok.xmi").read_text()
    bad = text.replace('weight="1"', 'weight="0x0"').replace('weight="2"', 'weight="0x1"')
    (folder / "ok.xmi").write_text(bad)
    model = opened(folder, "ok.xmi")
    assert (rules(model), [node.weight for node in model.Node.all]) == ([("RS610", 4)], [0, 0])
    assert (
        model.findings[0].message == "Node.weight: '0x0' is no whole number, so it is not in the model (and 1 more of this kind)"
    )
    for name in ("ok.xmi", "copy.xmi"):
        model.save(folder / name)
        assert (folder / name).read_text() == bad
    model.Node.all[0].weight = 7
    model.save()
    assert (folder / "ok.xmi").read_text() == bad.replace("0x0", "7")
    with pytest.raises(ModelError, match="'0x1' is no whole number"):
        opened(folder, "ok.xmi", strict=True)


def test_a_large_file_keeps_what_is_not_in_its_model(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robosmi.model.xmi.saved_places._LARGE", 0)
    nodes = "\n".join(f'    <nodes name="m{number}"/>' for number in range(300))
    text = (folder / "ok.xmi").read_text().replace("    <edges", f"{nodes}\n    <edges")
    (folder / "ok.xmi").write_text(text := text.replace("<groups ", '<groups xmlns:z="http://z" z:key="1" '))
    opened(folder, "ok.xmi").save()
    assert (folder / "ok.xmi").read_text() == text
