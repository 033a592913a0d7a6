"""The script of cases/etl/trace_use, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Node)
    def A(a: Any, n: Any) -> None:
        n.label = a.name

    @t.rule(L.Member, to=G.Node)
    def M(m: Any, n: Any) -> None:
        n.label = m.name

    @t.rule(L.Author, to=G.Note)
    def A2(a: Any, n: Any) -> None:
        n.text = a.name

    @t.post
    def _() -> None:
        for link in t.trace:
            print(link.rule, link.source.name, len(link.targets))

    return t
