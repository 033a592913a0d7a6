"""The script of cases/etl/extends_many, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Book, to=G.Node)
    def Book2Node(b: Any, n: Any) -> None:
        print("base", b.name)
        n.label = f"base {b.name}"

    @t.rule(L.Item, to=G.Node, abstract=True)
    def Mark(i: Any, n: Any) -> None:
        print("mark", i.name)
        n.shape = G.Shape.star
        n.label += "!"

    @t.rule(L.Comic, to=G.Group, extends=[Book2Node, Mark])
    def Comic2Group(c: Any, g: Any) -> None:
        print("own", c.name)
        g.label += "?"

    return t
