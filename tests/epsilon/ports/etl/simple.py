"""The script of cases/etl/simple, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import Q
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Library, to=G.Graph)
    def Library2Graph(library: Any, g: Any) -> None:
        g.label = library.name
        t.set(g, nodes=library.sections)
        g.nodes.extend(list(t.equivalent(library.authors)))

    @t.rule(L.Section, to=G.Group)
    def Section2Group(s: Any, g: Any) -> None:
        g.label = s.name
        t.set(g, inner=s.sections)
        g.inner.extend(list(t.equivalent(s.items)))
        t.set(g, main=Q(s.items).first())

    @t.rule(L.Book, to=G.Node)
    def Book2Node(b: Any, n: Any) -> None:
        n.label = f"{b.name} {b.year}"
        n.weight = len(b.authors)

    @t.rule(L.Author, to=G.Node)
    def Author2Node(a: Any, n: Any) -> None:
        n.label = a.name
        n.shape = G.Shape.star

    return t
