"""The script of cases/etl/two_targets, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import Q
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Book, to=[G.Node, G.Edge, G.Note])
    def B(b: Any, n: Any, e: Any, note: Any) -> None:
        n.label = b.name
        e.label = f"e{b.name}"
        e.source = n
        note.text = b.name
        note.about = n
        n.remarks.append(note)

    @t.rule(L.Author, to=G.Group)
    def A(a: Any, g: Any) -> None:
        g.label = a.name
        t.set(g, main=Q(a.books).first())

    @t.rule(L.Library, to=G.Graph)
    def L1(library: Any, g: Any) -> None:
        g.label = library.name
        books = L.Book.all_of_type
        g.nodes.extend([t.equivalent(b, "B") for b in books])
        g.edges.extend([e for b in books for e in t.equivalents(b).of_type(G.Edge)])

    return t
