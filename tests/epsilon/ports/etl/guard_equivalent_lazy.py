"""The script of cases/etl/guard_equivalent_lazy, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import Q
from robosmi.query.values import as_string
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Node)
    def A(a: Any, n: Any) -> None:
        n.label = a.name

    def author_is_missing(b: Any) -> bool:
        e = Q(b.authors).first()
        if e is None:
            return False
        print(b.name, as_string(t.equivalent(e) is not None))
        return t.equivalent(e) is None

    @t.rule(L.Book, to=G.Group, guard=author_is_missing)
    def B(b: Any, g: Any) -> None:
        g.label = b.name
        t.set(g, main=Q(b.authors).first())

    @t.rule(L.Member, to=G.Note)
    def M(m: Any, n: Any) -> None:
        n.text = m.name
        t.set(n, about=Q(m.borrowed).first())

    @t.rule(L.Comic, to=G.Node, lazy=True)
    def Z(c: Any, n: Any) -> None:
        n.label = f"lazy {c.name}"

    return t
