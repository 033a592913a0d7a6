"""The script of cases/etl/opposites, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import Q
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Node)
    def A(a: Any, n: Any) -> None:
        n.label = a.name

    @t.rule(L.Book, to=G.Edge)
    def B(b: Any, e: Any) -> None:
        e.label = b.name
        t.set(e, source=Q(b.authors).first(), target=Q(b.authors).last())

    @t.rule(L.Library, to=G.Graph)
    def L1(library: Any, g: Any) -> None:
        t.set(g, nodes=library.authors, edges=L.Book.all)

    @t.post
    def _() -> None:
        for n in G.Node.all:
            going, coming = (", ".join(e.label for e in edges) for edges in (n.outgoing, n.incoming))
            print(n.label, "out", going, "in", coming)

    return t
