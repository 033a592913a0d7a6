"""The picture of rooms and arrows in docs/architecture.md is that of the code, and the program that draws it is right."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest

from tests import floor_plan
from tests.floor_plan import ABOVE, LOOSE, House, Room

SVG = "{http://www.w3.org/2000/svg}"


def plan(*lines: str) -> House:
    """A house from lines `module: imported imported`; a module that another one is in is a package."""
    imports = {module: set(names.split()) for module, _, names in (line.partition(":") for line in lines)}
    return House(imports, [name for name in imports if any(other.startswith(f"{name}.") for other in imports)])


def arrows(house: House, group: str) -> list[tuple[str, str]]:
    """The arrows between the members of a group, by the last part of their names."""
    return sorted((a[-1], b[-1]) for a, b in house.arrows(tuple(group.split("."))).edges)


def test_the_picture_is_that_of_the_code() -> None:
    assert floor_plan.DOT.read_text(encoding="utf-8") == floor_plan.dot_text(floor_plan.house()), "make floor-plan"


def test_the_drawn_picture_has_the_rooms_and_arrows_of_the_plan() -> None:
    text = floor_plan.DOT.read_text(encoding="utf-8")
    groups = re.findall(r'subgraph "([^"]+)"', text)
    rooms = re.findall(r'^ +"([^"]+)" \[label=', text, re.MULTILINE)
    leads = [f"{a}->{b}" for a, b in re.findall(r'^ +"([^"]+)" -> "([^"]+)"', text, re.MULTILINE)]
    assert len(groups) > 2
    assert len(rooms) > len(groups)
    assert len(leads) > len(rooms)
    drawn = ElementTree.parse(floor_plan.SVG).getroot()
    for kind, names in (("cluster", groups), ("node", rooms), ("edge", leads)):
        titles = [part.findtext(f"{SVG}title") for part in drawn.iter(f"{SVG}g") if part.get("class") == kind]
        assert sorted(map(str, titles)) == sorted(names), f"make floor-plan: {kind}"


def test_no_rooms_of_the_code_import_one_another() -> None:
    house = floor_plan.house()
    plans = [house.arrows(group) for group in house.groups()]
    assert [(a, b) for graph in plans for a, b in graph.edges if graph.edges[a, b]["circle"]] == []


def test_the_page_of_the_architecture_begins_with_the_picture() -> None:
    page = floor_plan.SVG.with_name("architecture.md").read_text(encoding="utf-8")
    assert "](architecture.svg)" in page.partition("\n## ")[0]


def test_an_arrow_that_follows_from_others_is_left_out() -> None:
    house = plan("p:", "p.a:", "p.a.x: p.b.y p.c.z", "p.b:", "p.b.y: p.c.z.name", "p.c:", "p.c.z: os")
    assert arrows(house, "p") == [("a", "b"), ("b", "c")]
    assert house.all_arrows(("p",)).number_of_edges() == 3


def test_groups_are_joined_by_one_arrow() -> None:
    house = plan(
        "p:", "p.a:", "p.a.m:", "p.a.m.x: p.b.m.y p.b.n.z p.a.n.w", "p.a.n:", "p.a.n.w: p.b.n.z",
        "p.b:", "p.b.m:", "p.b.m.y:", "p.b.n:", "p.b.n.z:",
    )  # fmt: skip
    assert house.groups() == [("p",), ("p", "a"), ("p", "b")]
    assert [arrows(house, group) for group in ("p", "p.a", "p.b")] == [[("a", "b")], [("m", "n")], []]
    text = floor_plan.dot_text(house)
    assert '  "p.a.n" -> "p.b.m" [ltail="cluster_p.a", lhead="cluster_p.b"];' in text
    assert text.count("->") == 2


def test_rooms_that_import_one_another_are_joined_in_red() -> None:
    house = plan("p:", "p.a:", "p.a.x: p.b.y", "p.b:", "p.b.y: p.a.x p.c.z", "p.c:", "p.c.z:")
    assert arrows(house, "p") == [("a", "b"), ("b", "a"), ("b", "c")]
    assert [line.split()[0] for line in floor_plan.dot_text(house).splitlines() if "c0392b" in line] == ['"p.a"', '"p.b"']


@pytest.mark.parametrize(("loose", "room"), [("os", LOOSE), ("p.a.x", ABOVE), ("p.other", ABOVE)])
def test_loose_modules_of_a_group_are_a_room_below_or_above_its_rooms(loose: str, room: str) -> None:
    house = plan("p:", "p.base:", f"p.face: {loose}", "p.other: p.a.x", "p.a:", "p.a.x: p.base", "p.__main__: p.face")
    expected: list[Room] = [("p", ABOVE), ("p", LOOSE), ("p", "a")]
    assert house.rooms == expected
    assert "face" in house.loose(("p", room))
    assert arrows(house, "p") == [(ABOVE, "a"), ("a", LOOSE)]
