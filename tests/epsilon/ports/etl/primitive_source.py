"""The script of cases/etl/primitive_source, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Node)
    def A(a: Any, n: Any) -> None:
        print("A", a.name)
        n.label = a.name
        n.remarks.append(t.equivalent(a.name))

    @t.rule(str, to=G.Note)
    def T(s: str, n: Any) -> None:
        print("T", s)
        n.text = s.upper()

    @t.rule(L.Book, to=G.Group)
    def B(b: Any, n: Any) -> None:
        print("B", b.name)
        n.label = b.name
        for tag in b.tags:
            n.remarks.append(t.equivalent(tag))

    @t.post
    def _() -> None:
        for text in ("spin", "Ada", "new"):
            print(t.equivalent(text).text)

    return t
