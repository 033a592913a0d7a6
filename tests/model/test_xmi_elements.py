"""What the reader makes are pyecore's own elements: they know what those know that pyecore loads, and take the same changes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from pyecore.ecore import EObject
from pyecore.resources import URI, ResourceSet

from robosmi.errors import ModelError
from robosmi.model.elements.structure import walk
from robosmi.model.xmi.xmi_reader import read_documents
from tests.model.kitchen import BENCH, KITCHEN, classes, kitchen, saved

SAMPLE = """<?xml version="1.0" encoding="UTF-8"?>
<kitchen:Root xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" \
xmlns:kitchen="http://lab/kitchen" name="r" main="//@items.1">
  <items name="a" i="3" uses="//@items.1 //@items.2" links="/ //@items.0/@leaves.0 /">
    <tags>x</tags>
    <leaves name="l" to="//@items.2"/>
    <leaves xsi:type="kitchen:SpecialLeaf" name="m"/>
  </items>
  <items name="b" usedBy="//@items.0" next="//@items.2"/>
  <items name="c" usedBy="//@items.0" prev="//@items.1">
    <req name="q"/>
  </items>
  <one name="o"/>
</kitchen:Root>
"""


def state(root: Any) -> list[Any]:
    """Everything that pyecore knows of the elements of a model, in a form that two models can be compared by."""
    elements = list(walk(root))
    names = {id(element): number for number, element in enumerate(elements)}

    def shown(value: Any) -> Any:
        return (
            names.get(id(value), "elsewhere") if isinstance(value, EObject) and hasattr(value, "_inverse_rels") else repr(value)
        )

    found = []
    for element in elements:
        features = {}
        for feature in element.eClass.eAllStructuralFeatures():
            value = element.eGet(feature)
            features[feature.name] = [shown(v) for v in value] if feature.many else shown(value)
        links = sorted((str(names.get(id(owner))), feature.name) for owner, feature in element._inverse_rels)
        container = element.eContainer()
        place = element.eContainmentFeature()
        known = sorted(f.name for f in element._isset)
        found.append((element.eClass.name, features, shown(container), place and place.name, known, links))
    return found


def both(tmp_path: Path) -> list[Any]:
    """The same model as our reader and as pyecore's resource make it, of the same metamodel."""
    file = tmp_path / "sample.xmi"
    file.write_text(SAMPLE, encoding="utf-8")
    resources = ResourceSet()
    metamodels = kitchen("pyecore")
    for uri in metamodels.uris():
        resources.metamodel_registry[uri] = metamodels.get(uri)
    theirs = resources.get_resource(URI(str(file))).contents[0]
    return [next(iter(read_documents(file, metamodels).values())).roots[0], theirs]


def test_both_readers_know_the_same(tmp_path: Path) -> None:
    ours, theirs = both(tmp_path)
    assert isinstance(ours, EObject)
    assert type(ours) is type(theirs)
    assert len(state(ours)) == 8
    assert state(ours) == state(theirs)


CHANGES: dict[str, Callable[[Any], object]] = {
    "a value": lambda r: setattr(r.items[0], "i", 9),
    "a value that was not there": lambda r: setattr(r.items[1], "text", "new"),
    "no value": lambda r: setattr(r.items[0], "i", None),
    "a tag": lambda r: r.items[0].tags.append("y"),
    "a reference": lambda r: setattr(r.items[0].leaves[0], "to", r.items[0]),
    "no reference": lambda r: setattr(r, "main", None),
    "an opposite": lambda r: setattr(r.items[0], "next", r.items[1]),
    "no opposite": lambda r: setattr(r.items[1], "next", None),
    "a link less": lambda r: r.items[0].uses.remove(r.items[1]),
    "a link more": lambda r: r.items[2].uses.append(r.items[1]),
    "a part less": lambda r: r.items.remove(r.items[0]),
    "a part that moves": lambda r: r.items[2].leaves.append(r.items[0].leaves[1]),
    "a single part that moves": lambda r: setattr(r, "one", r.items[2].req),
    "no part": lambda r: setattr(r, "one", None),
    "a part from a collection": lambda r: r.items.pop(0),
    "all parts": lambda r: r.items[0].leaves.clear(),
    "a deleted element": lambda r: r.items[1].delete(),
    "a deleted element with parts": lambda r: r.items[0].delete(),
    "a deleted target": lambda r: r.items[2].delete(),
}


@pytest.mark.parametrize("change", CHANGES)
def test_changes_do_the_same_to_both(change: str, tmp_path: Path) -> None:
    ours, theirs = both(tmp_path)
    before = state(ours)
    for root in (ours, theirs):
        CHANGES[change](root)
    assert state(ours) == state(theirs)
    assert state(ours) != before


def test_changes_before_anything_was_looked_at_do_the_same(tmp_path: Path) -> None:
    """The containers that are made late must know what was there before the change."""
    for change in CHANGES.values():
        ours, theirs = both(tmp_path)
        for root in (ours, theirs):
            change(root)
        assert state(ours) == state(theirs)


def test_listeners_hear_of_changes(tmp_path: Path) -> None:
    from pyecore.notification import EObserver

    heard: list[str] = []
    root = both(tmp_path)[0]
    EObserver(root.items[0], notifyChanged=lambda notification: heard.append(notification.feature.name))
    root.items[0].i = 5
    root.items[1].i = 5
    root.items[0].tags.append("z")
    assert heard == ["i", "tags"]


@pytest.mark.parametrize("loader", ["own", "pyecore"])
def test_defaults_are_emfs(loader: str, tmp_path: Path) -> None:
    """pyecore itself gives None for an enumeration's default that is named by its text, and for a short or a byte."""
    k = SimpleNamespace(**classes(kitchen(loader)))
    file = tmp_path / "a.xmi"
    saved(k.Root(name="r", items=[k.Item(name="a")]) if loader == "own" else _with_item(k), file)
    item = next(iter(read_documents(file, kitchen(loader)).values())).roots[0].items[0]
    assert (item.kind.name, item.kindD.name, item.iD42, item.strD, item.by, item.c) == ("alpha", "beta", 42, "dflt", b"\0", "\0")


def _with_item(k: Any) -> Any:
    root = k.Root(name="r")
    root.items.append(k.Item(name="a"))
    return root


def test_elements_of_ours_stay_strict(tmp_path: Path) -> None:
    file = tmp_path / "sample.xmi"
    file.write_text(SAMPLE, encoding="utf-8")
    item = next(iter(read_documents(file, kitchen()).values())).roots[0].items[0]
    with pytest.raises(ModelError, match="Item has no feature 'nmae'"):
        item.nmae = "x"
    with pytest.raises(ModelError):
        item.kind = "beta"
    assert KITCHEN.parent == BENCH.parent
