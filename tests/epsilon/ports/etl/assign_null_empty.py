"""The script of cases/etl/assign_null_empty, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Group)
    def A(a: Any, g: Any) -> None:
        g.label = a.name
        t.set(g, main=a.mentor, members=a.books)

    @t.rule(L.Member, to=G.Group)
    def M(m: Any, g: Any) -> None:
        g.label = m.name
        t.set(g, members=[L.Author.all[0], L.Book.all[0], None, L.Author.all[0]])
        print(len(g.members))
        t.set(g, main=L.Book.all[0], label="text")
        print(as_string(g.label))

    return t
