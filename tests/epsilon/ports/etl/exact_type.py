"""The script of cases/etl/exact_type, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import Q
from robosmi.query.values import as_string
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Book, to=G.Node)
    def B(b: Any, n: Any) -> None:
        n.label = b.name

    @t.rule(L.Member, to=G.Group)
    def M(m: Any, g: Any) -> None:
        g.label = m.name
        t.set(g, members=m.borrowed, main=Q(m.borrowed).first())

    @t.rule(L.Section, to=G.Group)
    def S(s: Any, g: Any) -> None:
        g.label = s.name
        t.set(g, inner=s.items)
        for i in s.items:
            found = t.equivalents(i)
            kinds = ", ".join(e.eClass.name for e in found) if found is not None else "none"
            print(i.name, as_string(t.equivalent(i) is not None), kinds)

    return t
