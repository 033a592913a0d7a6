"""The script of cases/etl/lazy, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Member, to=G.Group)
    def M(m: Any, g: Any) -> None:
        g.label = m.name
        t.set(g, inner=m.borrowed)
        t.set(g, members=m.borrowed)

    @t.rule(L.Comic, to=G.Node, lazy=True)
    def C(c: Any, n: Any) -> None:
        print("C", c.name)
        n.label = c.name
        t.set(n, remarks=c.authors)

    @t.rule(L.Author, to=G.Note, lazy=True)
    def A(a: Any, n: Any) -> None:
        print("A", a.name)
        n.text = a.name

    @t.rule(L.Journal, to=G.Node, lazy=True)
    def J(j: Any, n: Any) -> None:
        print("J", j.name)
        n.label = j.name

    @t.rule(L.Section, to=G.Node, lazy=True)
    def Never(s: Any, n: Any) -> None:
        print("never")

    return t
