"""The script of cases/etl/extends, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Named, to=G.Element, abstract=True)
    def Named2Element(n: Any, e: Any) -> None:
        print("Named2Element", n.name)
        e.label = f"<{n.name}>"

    def after_1900(i: Any) -> Any:
        print("guard", i.name)
        return i.year > 1900

    @t.rule(L.Item, to=G.Node, abstract=True, extends=Named2Element, guard=after_1900)
    def Item2Node(i: Any, n: Any) -> None:
        print("Item2Node", i.name)
        n.weight = i.year

    @t.rule(L.Book, to=G.Node, extends=Item2Node, guard=lambda b: b.price > 10)
    def Book2Node(b: Any, n: Any) -> None:
        print("Book2Node", b.name)
        n.visible = False

    @t.rule(L.Journal, to=G.Group, extends=Item2Node)
    def Journal2Node(j: Any, n: Any) -> None:
        print("Journal2Node", j.name)
        n.label = f"{n.label}{j.issue}"

    return t
