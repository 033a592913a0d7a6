"""The script of cases/etl/lazy_greedy, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.pre
    def _() -> None:
        L.Author.all[-1].mentor = L.Author.all[0]

    @t.rule(L.Library, to=G.Graph)
    def L1(library: Any, g: Any) -> None:
        g.label = library.name
        t.set(g, nodes=L.Item.all)
        g.nodes.append(t.equivalent(library.authors[0]))

    @t.rule(L.Item, to=G.Node, lazy=True, greedy=True, name="I")
    def item(i: Any, n: Any) -> None:
        print("I", i.name)
        n.label = i.name

    @t.rule(L.Book, to=G.Group)
    def B(b: Any, g: Any) -> None:
        print("B", b.name)
        g.label = f"b {b.name}"

    @t.rule(L.Author, to=G.Group, lazy=True)
    def A(a: Any, g: Any) -> None:
        print("A", a.name)
        g.label = a.name
        t.set(g, main=a.mentor)
        print("A end", a.name)
        g.members.append(t.equivalent(a.mentor))

    return t
