"""The script of cases/etl/greedy, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Item, to=G.Node, greedy=True)
    def AnyItem(i: Any, n: Any) -> None:
        n.label = f"any {i.name}"

    @t.rule(L.Comic, to=G.Group)
    def OnlyComic(c: Any, n: Any) -> None:
        n.label = f"comic {c.name}"

    @t.rule(L.Book, to=G.Note, greedy=True)
    def AnyBook(b: Any, n: Any) -> None:
        n.text = b.name

    @t.post
    def _() -> None:
        for i in L.Item.all:
            kinds = ", ".join(e.eClass.name for e in t.equivalents(i))
            print(i.name, kinds, "first", t.equivalent(i).eClass.name)

    return t
